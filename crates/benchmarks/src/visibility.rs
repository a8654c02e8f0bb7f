//! Segments between patches, among 70,000 triangles, beside Embree.
//!
//! Embree (Debian's `libembree-dev`) is no dependency: `embree.c` is compiled by the system's C
//! compiler when the bench runs, and left out with a message where that fails.

use crate::Error;
use crate::figure::{Figure, Target, show};
use crate::generated::generated;
use radiosity::form_factors::{Estimation, Estimator};
use radiosity::geometry::{DVec3, MergedFaces, Mesh, Occluders, Patch, SegmentPacket};
use radiosity_generate::blob;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

const TRIANGLES: u32 = 70_000;
/// Bundles of eight segments, each between two patches.
const BUNDLES: usize = 50_000;
const LANES: usize = 8;
/// How many times Embree's rate is promised.
const PROMISE: f64 = 1.5;
/// At which the whole stage is timed.
const TOLERANCE: f64 = 0.01;

pub(crate) fn run(root: &Path, json: bool) -> Result<(), Error> {
    let text = blob::vs3(TRIANGLES)?;
    let (_, mesh) = generated("blob.vs3", &text)?;
    let walls = MergedFaces::new(&mesh);
    let occluders = Occluders::of_walls(&walls);
    let bundles = bundles(&mesh, &walls);
    let (seconds, blocked) = ours(&occluders, &bundles);
    let segments = (LANES * BUNDLES) as f64;
    let rate = 1e-6 * segments / seconds;
    let figure = |name: &str, value: Option<f64>, unit, target| {
        Figure::new(format!("visibility.{name}"), value, unit, target)
    };
    let million = "million segments/s, one thread";
    let share = |blocked: usize| Some(100.0 * blocked as f64 / segments);
    let mut figures = vec![
        figure("rate", Some(rate), million, None),
        figure("blocked", share(blocked), "% of the segments", None),
    ];
    match embree(root, &walls, &bundles) {
        Ok((seconds, blocked)) => {
            let theirs = 1e-6 * segments / seconds;
            let promise = Some(Target::AtLeast(PROMISE));
            figures.push(figure("embree.rate", Some(theirs), million, None));
            figures.push(figure(
                "embree.blocked",
                share(blocked),
                "% of the segments",
                None,
            ));
            figures.push(figure(
                "speedup",
                Some(rate / theirs),
                "times Embree",
                promise,
            ));
        }
        Err(problem) => eprintln!("no Embree to compare with: {problem}"),
    }
    let start = Instant::now();
    let tolerance = TOLERANCE;
    std::hint::black_box(Estimation::new(&mesh, Estimator::Accurate { tolerance }).run());
    let seconds = Some(start.elapsed().as_secs_f64());
    let what = "s, all factors of the 1,944 patches";
    figures.push(figure("stage.seconds", seconds, what, None));
    show(&figures, json);
    Ok(())
}

/// Eight segments between random points of two patches that face each other, as the estimators ask.
fn bundles(mesh: &Mesh, walls: &MergedFaces) -> Vec<SegmentPacket> {
    let mut rng = Pcg64Mcg::seed_from_u64(0);
    let mut bundles = Vec::with_capacity(BUNDLES);
    let wall = |patch: &Patch| walls.of_face[patch.face.index()];
    while bundles.len() < BUNDLES {
        let [i, j] = [0; 2].map(|_| &mesh.patches[rng.random_range(0..mesh.patches.len())]);
        if wall(i) == wall(j) {
            continue;
        }
        let mut points = |patch: &Patch| {
            let points: [DVec3; LANES] =
                std::array::from_fn(|_| patch.polygon.bilinear(rng.random(), rng.random()));
            [0, 1, 2].map(|axis| points.map(|point| point[axis]))
        };
        bundles.push(SegmentPacket {
            points: [points(i), points(j)],
            faces: [i, j].map(|patch| [wall(patch); LANES]),
        });
    }
    bundles
}

/// Seconds of the fastest of several rounds, and how many segments are blocked.
fn ours(occluders: &Occluders, bundles: &[SegmentPacket]) -> (f64, usize) {
    let once = |_| {
        let start = Instant::now();
        let blocked = bundles
            .iter()
            .map(|bundle| occluders.blocked_of(bundle, !0).count_ones());
        let blocked = blocked.sum::<u32>() as usize;
        (start.elapsed().as_secs_f64(), blocked)
    };
    let rounds = (0..5).map(once);
    rounds.fold((f64::INFINITY, 0), |best, round| {
        if round.0 < best.0 { round } else { best }
    })
}

/// The same by Embree.
fn embree(
    root: &Path,
    walls: &MergedFaces,
    bundles: &[SegmentPacket],
) -> Result<(f64, usize), String> {
    let program = compiled(root)?;
    let input = root.join("out/embree-input.bin");
    std::fs::create_dir_all(root.join("out"))
        .and_then(|()| std::fs::write(&input, input_of(walls, bundles)))
        .map_err(|error| format!("cannot write {}: {error}", input.display()))?;
    let output = Command::new(program).arg(&input).output();
    let _ = std::fs::remove_file(&input);
    let output = output.map_err(|error| error.to_string())?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let mut words = text.split_whitespace();
    let parsed = words
        .next()
        .and_then(|s| s.parse().ok())
        .zip(words.next().and_then(|n| n.parse().ok()));
    parsed.ok_or_else(|| String::from_utf8_lossy(&output.stderr).into_owned())
}

fn compiled(root: &Path) -> Result<PathBuf, String> {
    let program = root.join("target/embree-bench");
    let output = Command::new("cc")
        .args(["-O3", "-march=native", "-o"])
        .arg(&program)
        .arg(root.join("crates/benchmarks/src/embree.c"))
        .arg("-lembree3")
        .output()
        .map_err(|error| format!("cc: {error}"))?;
    let complaint = String::from_utf8_lossy(&output.stderr);
    let first = complaint.lines().next().unwrap_or("cc failed");
    output
        .status
        .success()
        .then_some(program)
        .ok_or_else(|| first.to_owned())
}

/// What `embree.c` reads: quads are two triangles.
fn input_of(walls: &MergedFaces, bundles: &[SegmentPacket]) -> Vec<u8> {
    let mut corners: Vec<f32> = Vec::new();
    for polygon in &walls.polygons {
        let all = polygon.corners();
        for k in 1..all.len() - 1 {
            let triangle = [all[0], all[k], all[k + 1]];
            corners.extend(
                triangle
                    .iter()
                    .flat_map(|corner| corner.as_vec3().to_array()),
            );
        }
    }
    let counts = [corners.len() as u64 / 9, bundles.len() as u64];
    let mut bytes: Vec<u8> = counts
        .iter()
        .flat_map(|count| count.to_le_bytes())
        .collect();
    bytes.extend(corners.iter().flat_map(|number| number.to_le_bytes()));
    for bundle in bundles {
        let numbers = bundle.points.iter().flatten().flatten();
        bytes.extend(numbers.flat_map(|&number| (number as f32).to_le_bytes()));
    }
    bytes
}
