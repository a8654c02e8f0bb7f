//! View factors of a closed box, cut finer and finer, beside View3D.
//!
//! View3D 3.5 (C, one thread) took these seconds on a processor like the one that the tables of the
//! README are made on, and had an rms error of 3.7e-6 at 313 rectangles. It is not run here: its
//! figures are constants, and seconds on other machines compare to them only roughly.

use crate::Error;
use crate::figure::{Figure, Target, show};
use crate::generated::generated;
use radiosity::form_factors::{Estimation, Estimator, FormFactors};
use radiosity::geometry::Mesh;
use radiosity::scene::Scene;
use radiosity::{By, FactorTable};
use radiosity_generate::nested_box;
use std::path::Path;
use std::time::Instant;

/// A size of the box, the tolerance at which its factors, aggregate to those between the 313
/// rectangles, are as accurate as View3D's at 313, and what View3D takes when told of the
/// obstruction apart, which is its faster form.
struct Size {
    elements: u32,
    tolerance: f64,
    view3d_seconds: f64,
    runs: u32,
}

const SIZES: [Size; 4] = [
    Size {
        elements: 313,
        tolerance: 8e-4,
        view3d_seconds: 0.24,
        runs: 7,
    },
    Size {
        elements: 1252,
        tolerance: 0.006,
        view3d_seconds: 2.2,
        runs: 5,
    },
    Size {
        elements: 5008,
        tolerance: 0.05,
        view3d_seconds: 20.0,
        runs: 2,
    },
    Size {
        elements: 20032,
        tolerance: 0.1,
        view3d_seconds: 398.0,
        runs: 1,
    },
];
const VIEW3D_RMS: f64 = 3.7e-6;
/// How many times faster than View3D.
const PROMISE: f64 = 10.0;
/// Plates in the box, for which there is no exact answer.
const OBSTACLES: u32 = 200;

pub(crate) fn run(root: &Path, json: bool) -> Result<(), Error> {
    let exact = exact(root)?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let pool = pool.map_err(|error| format!("cannot start a thread: {error}"))?;
    for size in &SIZES {
        let mut figures = pool.install(|| measure(root, size, &exact))?;
        figures.extend(pool.install(|| among_plates(root, size))?);
        show(&figures, json);
    }
    Ok(())
}

/// Time and error, on one thread.
fn measure(root: &Path, size: &Size, exact: &[f32]) -> Result<Vec<Figure>, Error> {
    let (scene, mesh) = boxed(root, size.elements, 0)?;
    let (seconds, made) = best(&mesh, size);
    let table = FactorTable::new(&scene, &mesh, &made, By::Group)?;
    let square = |(k, &exact): (usize, &f32)| {
        let (i, j) = (k / table.size(), k % table.size());
        (table.factor(i, j) - f64::from(exact)).powi(2)
    };
    let squares: f64 = exact.iter().enumerate().map(square).sum();
    let rms = (squares / exact.len() as f64).sqrt();
    let off = made.rows.iter().map(|row| (row.fronts - 1.0).abs());
    let off = off.sum::<f64>() / made.rows.len() as f64;
    let figure = |what: &str, value: f64, unit, target| {
        let name = format!("view_factors.{}.{what}", size.elements);
        Figure::new(name, Some(value), unit, target)
    };
    let as_good = Some(Target::Between(0.0, 1e6 * VIEW3D_RMS));
    let faster = Some(Target::AtLeast(PROMISE));
    Ok(vec![
        figure(
            "tolerance",
            1e3 * size.tolerance,
            "thousandths, of a row",
            None,
        ),
        figure("rms", 1e6 * rms, "millionths, aggregate to 313", as_good),
        figure("rows_off", 1e6 * off, "millionths off 1, on average", None),
        figure("seconds", seconds, "s, one thread", None),
        figure(
            "speedup",
            size.view3d_seconds / seconds,
            "times View3D",
            faster,
        ),
    ])
}

/// The same among plates.
fn among_plates(root: &Path, size: &Size) -> Result<Vec<Figure>, Error> {
    let (_, mesh) = boxed(root, size.elements, OBSTACLES)?;
    let (seconds, made) = best(&mesh, size);
    let off = made.rows.iter().map(|row| row.fronts + row.backs - 1.0);
    let off = off.sum::<f64>() / made.rows.len() as f64;
    let figure = |what: &str, value: f64, unit| {
        let name = format!("view_factors.{}.plates.{what}", size.elements);
        Figure::new(name, Some(value), unit, None)
    };
    Ok(vec![
        figure("seconds", seconds, "s, one thread"),
        figure(
            "rows_off",
            1e6 * off,
            "millionths: fronts and backs off 1, on average",
        ),
    ])
}

/// The best of several runs, in seconds.
fn best(mesh: &Mesh, size: &Size) -> (f64, FormFactors) {
    let estimator = Estimator::Accurate {
        tolerance: size.tolerance,
    };
    let once = || {
        let start = Instant::now();
        let made = Estimation::new(mesh, estimator).run();
        (start.elapsed().as_secs_f64(), made)
    };
    let runs = (1..size.runs).map(|_| once());
    runs.fold(once(), |best, run| if run.0 < best.0 { run } else { best })
}

fn boxed(root: &Path, elements: u32, obstacles: u32) -> Result<(Scene, Mesh), Error> {
    let text = nested_box::vs3(root, elements, obstacles)?;
    generated("box.vs3", &text)
}

/// The exact factors between the 313 rectangles, by rows.
fn exact(root: &Path) -> Result<Vec<f32>, Error> {
    let path = root.join("tests/data/box313/form-factors.npy");
    let bytes = std::fs::read(&path);
    let bytes = bytes.map_err(|e| format!("cannot read {}: {e}", path.display()))?;
    let count = nested_box::PARENTS.pow(2) as usize;
    let values = bytes[bytes.len().saturating_sub(4 * count)..]
        .as_chunks::<4>()
        .0;
    Ok(values
        .iter()
        .map(|&bytes| f32::from_le_bytes(bytes))
        .collect())
}
