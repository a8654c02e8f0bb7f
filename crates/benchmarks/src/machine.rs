//! What the machine can do, and what other instruction sets of it do.

use crate::Error;
use radiosity::geometry::Discretization;
use radiosity::{Context, Project, estimate, subdivide};
use radiosity_simd::{Float, InstructionSet, Kernel, LANES, Simd, dispatch};
use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// So many sums at once keep all pipes of today's processors busy.
const SUMS: usize = 16;
const ROUNDS: u32 = 4_000_000;
/// Of each instruction set.
const PROCESSES: u32 = 5;

/// Multiplies and adds in registers, all the time.
struct Busy;

impl Kernel for Busy {
    type Output = f32;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> f32 {
        let factor = simd.splat_f32(0.999_999);
        let addend = simd.splat_f32(1e-6);
        let mut sums: [S::F32; SUMS] = [addend; SUMS];
        for _ in 0..ROUNDS {
            for sum in &mut sums {
                *sum = *sum * factor + addend;
            }
        }
        let total = sums.into_iter().reduce(|a, b| a + b);
        total.map_or(0.0, |total| total.lanes().iter().sum())
    }
}

/// Multiplications and additions in single precision per second, on one thread. None are fused, as
/// nowhere in this project.
pub(crate) fn peak() -> f64 {
    let once = |_| {
        let start = Instant::now();
        std::hint::black_box(dispatch(Busy));
        let operations = 2.0 * f64::from(ROUNDS) * (SUMS * LANES) as f64;
        operations / start.elapsed().as_secs_f64()
    };
    (0..3).map(once).fold(0.0, f64::max)
}

/// The most memory that this process has had, in bytes, where the system tells.
pub(crate) fn most_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(1024.0 * kilobytes)
}

/// The seconds that each instruction set of the machine takes for the form factors of
/// `cornell-course` by
/// the regular rule: the best of several processes, since each keeps to one set.
pub(crate) fn seconds_by_set(divisions: u32) -> Vec<(&'static str, Option<f64>)> {
    let best = |set: InstructionSet| {
        let runs = (0..PROCESSES).filter_map(|_| seconds_on(set, divisions));
        (set.name(), runs.reduce(f64::min))
    };
    InstructionSet::available().into_iter().map(best).collect()
}

/// What another process of this program prints, if it does.
fn seconds_on(set: InstructionSet, divisions: u32) -> Option<f64> {
    let output = Command::new(std::env::current_exe().ok()?)
        .args(["regular", &divisions.to_string()])
        .env("RADIOSITY_SIMD", set.name())
        .output()
        .ok()?;
    let printed = String::from_utf8_lossy(&output.stdout);
    printed.trim().parse().ok()
}

/// What the form factors of `cornell-course` take here and now.
pub(crate) fn print_regular_seconds(root: &Path, divisions: u32) -> Result<(), Error> {
    let Project { scene, params, .. } = Project::open(&root.join("scenes/cornell-course.toml"))?;
    let patches = subdivide(
        &scene,
        &Discretization::uniform(divisions),
        Context::default(),
    )?;
    let factors = estimate(&patches, &params.form_factors)?;
    println!("{}", factors.made()?.origin.seconds);
    Ok(())
}
