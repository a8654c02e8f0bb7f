//! What the machine can do, and what other instruction sets of it do.

use radiosity_simd::{Float, InstructionSet, Kernel, LANES, Simd, dispatch};
use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// So many sums at once keep all pipes of today's processors busy.
const SUMS: usize = 16;
const ROUNDS: u32 = 4_000_000;

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
pub(super) fn peak() -> f64 {
    let once = |_| {
        let start = Instant::now();
        std::hint::black_box(dispatch(Busy));
        let operations = 2.0 * f64::from(ROUNDS) * (SUMS * LANES) as f64;
        operations / start.elapsed().as_secs_f64()
    };
    (0..3).map(once).fold(0.0, f64::max)
}

/// The most memory that this process has had, in bytes, where the system tells.
pub(super) fn most_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(1024.0 * kilobytes)
}

/// The seconds that each instruction set of the machine takes for the form factors of a scene: the best
/// of several runs of this program.
pub(super) fn seconds_by_set(scene: &Path, divisions: u32) -> Vec<(&'static str, Option<f64>)> {
    let run = |set: InstructionSet| {
        let output = Command::new(std::env::current_exe().ok()?)
            .args(["form-factors", "--json", "--no-cache", "--patches"])
            .arg(divisions.to_string())
            .arg(scene)
            .env("RADIOSITY_SIMD", set.name())
            .output()
            .ok()?;
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).ok()?;
        report["stages"]["form_factors"]["seconds"].as_f64()
    };
    let best = |set: InstructionSet| {
        let runs = (0..5).filter_map(|_| run(set));
        (set.name(), runs.reduce(f64::min))
    };
    InstructionSet::available().into_iter().map(best).collect()
}
