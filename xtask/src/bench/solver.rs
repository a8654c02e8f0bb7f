//! How near the solver comes to the speed of memory, what each method takes, and the course's loop
//! beside them.

use super::{Figure, Target, best_seconds, course, median};
use radiosity::cache::Store;
use radiosity::form_factors::FormFactors;
use radiosity::matrix::SymmetricMatrix;
use radiosity::scene::{Mode, Scene, load};
use radiosity::solver::{Convergence, Method, relit};
use radiosity::{Error, Pipeline, Silent, Sources};
use rayon::prelude::*;
use std::path::Path;

/// Patches along each edge of the course's rectangles: 1,728, 6,912 and 27,648 patches.
const SIZES: [u32; 3] = [12, 24, 48];
/// Good enough to know how many passes a solution takes.
const TOLERANCE: f64 = 0.01;
/// Reflectances of the closed room.
const REFLECTANCES: [f64; 3] = [0.5, 0.9, 0.95];
const RESIDUALS: [f64; 2] = [1e-3, 1e-6];

/// Of the bandwidth, for one light; how much longer four may take; how many passes; how many times
/// faster than the course's 40 sweeps.
const BANDWIDTH: f64 = 70.0;
const FOUR_LIGHTS: f64 = 1.3;
const MOST_PASSES: f64 = 12.0;
const MOST_STEPS: f64 = 15.0;
const COURSE: f64 = 60.0;

pub(super) fn run(root: &Path, json: bool) -> Result<(), Error> {
    let folder = tempfile::tempdir().map_err(|error| Error::Output {
        path: std::env::temp_dir(),
        error,
    })?;
    let store = Store::new(folder.path());
    let mut figures = Vec::new();
    for divisions in SIZES {
        let cornell = scene(root, "cornell", divisions)?;
        let made = form_factors(&cornell, &store)?;
        figures.extend(passes(&made));
        figures.extend(methods(cornell, &made)?);
        figures.push(beside_the_course(&made, &figures));
        let closed = scene(root, "cornell-closed", divisions)?;
        let made = form_factors(&closed, &store)?;
        for reflectance in REFLECTANCES {
            let mut closed = closed.clone();
            closed.name = format!("closed_{reflectance}");
            for material in &mut closed.materials {
                material.reflectance = [reflectance; 3];
            }
            figures.extend(methods(closed, &made)?);
        }
        super::show(&figures, json);
        figures.clear();
    }
    super::show(&[relighting()], json);
    Ok(())
}

fn scene(root: &Path, name: &str, divisions: u32) -> Result<Scene, Error> {
    let mut scene = load(&root.join(format!("scenes/{name}.toml")))?;
    scene.divisions = radiosity::geometry::Divisions::uniform(divisions);
    scene.form_factors.mode = Mode::Accurate;
    scene.form_factors.tolerance = TOLERANCE;
    Ok(scene)
}

/// From a mapped file: the first time they are made, the second they are read.
fn form_factors(scene: &Scene, store: &Store) -> Result<FormFactors, Error> {
    let pipeline = Pipeline::new(scene, Some(store), &Silent)?;
    pipeline.form_factors(Sources::Cached)?;
    Ok(pipeline.form_factors(Sources::Cached)?.form_factors)
}

/// So many runs: the shorter, the more.
fn runs(patches: usize) -> u32 {
    match patches {
        0..5_000 => 150,
        5_000..10_000 => 30,
        _ => 5,
    }
}

/// Passes over the matrix against the bandwidth of memory. Both are timed in turn, since memory is
/// not always as fast: the shares are the middle ones of all rounds.
fn passes(made: &FormFactors) -> Vec<Figure> {
    let patches = made.exchange.size();
    let mapped = &made.exchange;
    let in_memory = SymmetricMatrix::new(patches, mapped.values().to_vec());
    let in_memory = in_memory.expect("they are as many as before");
    let seconds = |matrix: &SymmetricMatrix, lights: usize| {
        let mut x = vec![[1.0; 3]; patches * lights];
        best_seconds(2, || {
            std::hint::black_box(matrix.sweep(&mut x, lights, &mut |_, _, _| ()));
        })
    };
    let round = |_| {
        let read = best_seconds(2, || {
            std::hint::black_box(sum(mapped.values()));
        });
        let pass = seconds(mapped, 1);
        let four = seconds(mapped, 4);
        [read, pass, seconds(&in_memory, 1), four]
    };
    let rounds: Vec<[f64; 4]> = (0..runs(patches)).map(round).collect();
    let of_rounds = |figure: fn(&[f64; 4]) -> f64| median(rounds.iter().map(figure).collect());
    let figure = |what: &str, value: f64, unit, target: Option<Target>| {
        let name = format!("solver.{patches}.{what}");
        Figure::new(name, Some(value), unit, target.filter(|_| patches > 10_000))
    };
    let bytes = 4e-9 * mapped.values().len() as f64;
    let most = Some(Target::AtLeast(BANDWIDTH));
    vec![
        figure(
            "read",
            bytes / of_rounds(|round| round[0]),
            "GB/s, all threads",
            None,
        ),
        figure(
            "pass",
            1e3 * of_rounds(|round| round[1]),
            "ms for one light, from a mapped file",
            None,
        ),
        figure(
            "pass.bandwidth",
            100.0 * of_rounds(|[read, pass, ..]| read / pass),
            "% of that",
            most,
        ),
        figure(
            "pass.memory",
            100.0 * of_rounds(|[read, _, pass, _]| read / pass),
            "% of that, from memory",
            most,
        ),
        figure(
            "pass.four_lights",
            of_rounds(|[_, pass, _, four]| four / pass),
            "times the pass for one",
            Some(Target::Between(0.0, FOUR_LIGHTS)),
        ),
    ]
}

/// Reads all numbers.
fn sum(values: &[f32]) -> f32 {
    let chunk = |chunk: &[f32]| {
        let mut sums = [0.0; 64];
        for values in chunk.as_chunks::<64>().0 {
            sums.iter_mut()
                .zip(values)
                .for_each(|(sum, value)| *sum += value);
        }
        sums.iter().sum::<f32>()
    };
    values.par_chunks(1 << 16).map(chunk).sum()
}

/// What each method takes to each residual.
fn methods(mut scene: Scene, made: &FormFactors) -> Result<Vec<Figure>, Error> {
    let mut figures = Vec::new();
    for (name, method) in Method::RIVALS {
        let name = name.to_lowercase().replace([' ', '-'], "_");
        for residual in RESIDUALS {
            scene.solver.tolerance = residual;
            let pipeline = Pipeline::new(&scene, None, &Silent)?;
            let patches = pipeline.mesh().patches.len();
            let report = pipeline.solve_by(method, made)?.report;
            let seconds = best_seconds(runs(patches).div_ceil(5), || {
                std::hint::black_box(pipeline.solve_by(method, made).is_ok());
            });
            let promise = match (&scene.name[..], &name[..]) {
                ("cornell", "over_relaxation") if residual < 1e-5 => Some(MOST_PASSES),
                ("closed_0.95", "conjugate_gradients") if residual < 1e-5 => Some(MOST_STEPS),
                _ => None,
            };
            let name = format!("solver.{patches}.{}.{name}.{residual:e}", scene.name);
            let target = promise.map(|most| Target::Between(0.0, most));
            figures.push(Figure::new(
                format!("{name}.passes"),
                Some(passes_of(&report)),
                "",
                target,
            ));
            figures.push(Figure::new(
                format!("{name}.ms"),
                Some(1e3 * seconds),
                "ms",
                None,
            ));
        }
    }
    Ok(figures)
}

/// Conjugate gradients take one more to be sure of the last.
fn passes_of(report: &Convergence) -> f64 {
    let extra = usize::from(report.method == Method::ConjugateGradients);
    (report.residuals.len() + extra) as f64
}

/// The course's sweeps beside the default solution of the same scene.
fn beside_the_course(made: &FormFactors, figures: &[Figure]) -> Figure {
    let patches = made.exchange.size();
    let ours = format!("solver.{patches}.cornell.over_relaxation.1e-6.ms");
    let ours = figures.iter().find(|figure| figure.name == ours);
    let ours = ours.and_then(|figure| figure.value);
    let course = 1e3 * course::seconds(made);
    let target = (patches < 2000).then_some(Target::AtLeast(COURSE));
    let unit = "times faster than the course's 40 sweeps";
    let name = format!("solver.{patches}.cornell.speedup");
    Figure::new(name, ours.map(|ours| course / ours), unit, target)
}

/// A frame of 10,000 patches in which four lamps are dimmed.
fn relighting() -> Figure {
    let lights = vec![vec![[1.0, 0.5, 0.25]; 10_000]; 4];
    let seconds = best_seconds(100, || {
        std::hint::black_box(relit(&lights, &[[0.1, 0.2, 0.3]; 4]));
    });
    let unit = "us for 10,000 patches and 4 lights";
    Figure::new("solver.relight".to_owned(), Some(1e6 * seconds), unit, None)
}
