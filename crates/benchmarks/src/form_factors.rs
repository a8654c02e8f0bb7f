//! How fast form factors are, and what the accurate ones cost, side by side with the course's.

use crate::Error;
use crate::baseline::Baseline;
use crate::figure::{Figure, Target, show};
use crate::machine;
use crate::timing::{best_seconds, median};
use radiosity::form_factors::{Estimation, Estimator, Mode};
use radiosity::geometry::{Discretization, Mesh};
use radiosity::scene::Scene;
use radiosity::{Context, Project, cells, estimate, solve, subdivide};
use std::path::Path;
use std::time::Instant;

/// Patches along each edge of the course's rectangles, how often each is timed beside the course's
/// program, and how many times faster than that it is promised to be.
const SIZES: [(u32, u32, Option<f64>); 4] = [
    (12, 7, Some(600.0)),
    (24, 7, Some(1000.0)),
    (48, 3, None),
    (72, 1, None),
];
/// The accurate mode is timed so often.
const ROUNDS: u32 = 7;
/// In a round the best of so many runs counts.
const RUNS: u32 = 3;
/// Seconds that 48 patches along each edge, 27,648 in all, may take.
const MOST_SECONDS: f64 = 4.0;
/// The course program's own rate.
const COURSE_RATE: f64 = 8.5e6;
/// Multiplications, additions and divisions that a pair of points costs: a squared distance, half a
/// division and five products.
const OPERATIONS: f64 = 13.0;
/// Every so many rows are enough to know the baseline's rate.
const ROW_STRIDE: usize = 36;

/// A tolerance at which the accurate mode has a hundredth of the course's error, and one that
/// stands for the truth.
const TOLERANCE: f64 = 0.01;
const CONVERGED: f64 = 3e-5;

pub(crate) fn run(root: &Path, json: bool) -> Result<(), Error> {
    let mut project = Project::open(&root.join("scenes/cornell-course.toml"))?;
    let mesh = cut(&project.scene, SIZES[0].0)?;
    let baseline = Baseline::new(&mesh);
    let peak = machine::peak();
    let (of_sizes, rate) = sizes(&project.scene, &baseline, peak)?;
    let mut figures = vec![
        Figure::new(
            "form_factors.baseline.rate".to_owned(),
            Some(1e-6 * rate),
            "million point pairs/s, one thread, at best",
            Some(Target::AtLeast(1e-6 * COURSE_RATE)),
        ),
        Figure::new(
            "form_factors.peak".to_owned(),
            Some(1e-9 * peak),
            "billion multiplications and additions/s, one thread",
            None,
        ),
    ];
    figures.extend(of_sizes);
    figures.extend(instruction_sets());
    figures.extend(accuracy(&mut project, &baseline)?);
    show(&figures, json);
    Ok(())
}

fn cut(scene: &Scene, divisions: u32) -> Result<Mesh, Error> {
    let params = Discretization::uniform(divisions);
    Ok(subdivide(scene, &params, Context::default())?.mesh)
}

/// Pairs of points per second, on one thread.
fn baseline_rate(baseline: &Baseline<'_>) -> f64 {
    let start = Instant::now();
    let (mut sum, mut pairs) = (0.0, 0);
    for i in (0..baseline.mesh.patches.len()).step_by(ROW_STRIDE) {
        let (of_row, pairs_of_row) = baseline.row(i);
        sum += of_row;
        pairs += pairs_of_row;
    }
    std::hint::black_box(sum);
    pairs as f64 / start.elapsed().as_secs_f64()
}

/// How many pairs of points the course's program tries.
fn point_pairs(mesh: &Mesh) -> f64 {
    let square = |count: usize| (count * count) as f64;
    let faces = mesh.faces.iter();
    let of_faces: f64 = faces.map(|face| square(face.patches().len())).sum();
    81.0 * (square(mesh.patches.len()) - of_faces) / 2.0
}

/// What the course's loop takes for all rows.
pub(crate) fn baseline_seconds(mesh: &Mesh) -> f64 {
    point_pairs(mesh) / baseline_rate(&Baseline::new(mesh))
}

/// An estimator beside the baseline.
struct Race {
    /// The shortest that the estimator took.
    seconds: f64,
    /// Of the baseline at its best, in pairs of points per second.
    rate: f64,
    /// How many times longer the baseline takes: the middle of all rounds.
    ratio: f64,
}

impl Race {
    /// In turn, since machines are faster in one minute than in the next.
    fn run(baseline: &Baseline<'_>, mesh: &Mesh, estimator: Estimator, rounds: u32) -> Race {
        let round = |_| {
            let rate = baseline_rate(baseline);
            let seconds = best_seconds(RUNS.min(rounds), || {
                std::hint::black_box(Estimation::new(mesh, estimator).run());
            });
            (seconds, rate)
        };
        let rounds: Vec<(f64, f64)> = (0..rounds).map(round).collect();
        let ratio = |&(seconds, rate): &(f64, f64)| point_pairs(mesh) / rate / seconds;
        Race {
            seconds: rounds.iter().map(|r| r.0).fold(f64::INFINITY, f64::min),
            rate: rounds.iter().map(|r| r.1).fold(0.0, f64::max),
            ratio: median(rounds.iter().map(ratio).collect()),
        }
    }
}

/// The regular rule as patches grow more, and the baseline's best rate.
fn sizes(scene: &Scene, baseline: &Baseline<'_>, peak: f64) -> Result<(Vec<Figure>, f64), Error> {
    let mut figures = Vec::new();
    let mut best_rate: f64 = 0.0;
    let mut last: Option<(f64, f64)> = None;
    for (divisions, rounds, promise) in SIZES {
        let mesh = cut(scene, divisions)?;
        let patches = mesh.patches.len() as f64;
        let regular = Estimator::Regular { points: 3 };
        let Race {
            seconds,
            rate,
            ratio,
        } = Race::run(baseline, &mesh, regular, rounds);
        best_rate = best_rate.max(rate);
        let mut add = |what: &str, value: f64, unit, target| {
            let name = format!("form_factors.regular.{divisions}.{what}");
            figures.push(Figure::new(name, Some(value), unit, target));
        };
        let limit = (divisions == 48).then_some(Target::Between(0.0, MOST_SECONDS));
        add("seconds", seconds, "s", limit);
        add(
            "speedup",
            ratio,
            "times the baseline",
            promise.map(Target::AtLeast),
        );
        let operations = OPERATIONS * point_pairs(&mesh) / seconds;
        let share = 100.0 * operations / (peak * rayon::current_num_threads() as f64);
        add("share_of_peak", share, "%, had all pairs been tried", None);
        let bytes = 4.0 * patches * (patches - 1.0) / 2.0;
        add("matrix", 1e-6 * bytes, "MB", None);
        if let Some(most) = machine::most_memory() {
            add("memory", 1e-6 * most, "MB at most", None);
        }
        if let Some((fewer, shorter)) = last {
            let exponent = (seconds / shorter).ln() / (patches / fewer).ln();
            add(
                "exponent",
                exponent,
                "of the patches, from the size before",
                None,
            );
        }
        last = Some((patches, seconds));
    }
    Ok((figures, best_rate))
}

/// The same on each instruction set.
fn instruction_sets() -> Vec<Figure> {
    let divisions = SIZES[1].0;
    let figure = |(set, seconds): (&str, Option<f64>)| {
        let name = format!("form_factors.regular.{divisions}.{set}");
        Figure::new(name, seconds, "s, as a program of its own", None)
    };
    let seconds = machine::seconds_by_set(divisions);
    seconds.into_iter().map(figure).collect()
}

/// The accurate mode against the course's rule, by time and by radiosities.
fn accuracy(project: &mut Project, baseline: &Baseline<'_>) -> Result<Vec<Figure>, Error> {
    let mut by = |mode, tolerance| {
        let params = &mut project.params.form_factors;
        (params.mode, params.points, params.tolerance) = (mode, 3, tolerance);
        radiosities(project)
    };
    let course = by(Mode::Regular, TOLERANCE)?;
    let truth = by(Mode::Accurate, CONVERGED)?;
    let accurate = by(Mode::Accurate, TOLERANCE)?;
    let mesh = cut(&project.scene, SIZES[0].0)?;
    let tolerance = TOLERANCE;
    let race = Race::run(baseline, &mesh, Estimator::Accurate { tolerance }, ROUNDS);
    let errors = [&course, &accurate].map(|found| 100.0 * relative_error(found, &truth));
    let figure = |name: &str, value: f64, unit, target| {
        Figure::new(format!("form_factors.{name}"), Some(value), unit, target)
    };
    let hundred = Some(Target::AtLeast(100.0));
    Ok(vec![
        figure("regular.12.radiosity_error", errors[0], "%", None),
        figure("accurate.12.radiosity_error", errors[1], "%", None),
        figure(
            "accurate.12.accuracy",
            errors[0] / errors[1],
            "times the baseline",
            hundred,
        ),
        figure("accurate.12.seconds", race.seconds, "s", None),
        figure(
            "accurate.12.speedup",
            race.ratio,
            "times the baseline",
            hundred,
        ),
    ])
}

/// Of the patches that do not emit.
fn radiosities(project: &Project) -> Result<Vec<[f32; 3]>, Error> {
    let Project { scene, params, .. } = project;
    let patches = subdivide(scene, &params.discretization, Context::default())?;
    let factors = estimate(&patches, &params.form_factors)?;
    let radiosity = solve(&factors, &params.solver)?.light()?.radiosity;
    let cells = cells(scene, &patches.mesh);
    let lit = radiosity.into_iter().zip(&cells);
    let lit = lit.filter(|(_, cell)| !cell.emits);
    Ok(lit.map(|(radiosity, _)| radiosity).collect())
}

/// Of the squares of all channels.
fn relative_error(found: &[[f32; 3]], truth: &[[f32; 3]]) -> f64 {
    let pairs = || found.as_flattened().iter().zip(truth.as_flattened());
    let squares = |error: fn(f64, f64) -> f64| -> f64 {
        pairs()
            .map(|(&a, &b)| error(f64::from(a), f64::from(b)).powi(2))
            .sum()
    };
    (squares(|a, b| a - b) / squares(|_, b| b)).sqrt()
}
