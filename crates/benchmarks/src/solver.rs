//! How near the solver comes to the speed of memory, what each method takes, and the course's loop
//! beside them.

mod bandwidth;

use crate::Error;
use crate::course;
use crate::figure::{Figure, Target, show};
use crate::timing::best_seconds;
use bandwidth::passes;
use radiosity::cache::Store;
use radiosity::form_factors::{self, FormFactors, Mode};
use radiosity::geometry::Discretization;
use radiosity::scene::Scene;
use radiosity::solver::{Convergence, Method, Params, superpose};
use radiosity::stages::{Factors, Patches};
use radiosity::{Context, Project, Silent, estimate, subdivide};
use std::path::Path;

/// Patches along each edge of the course's rectangles: 1,728, 6,912 and 27,648 patches.
const SIZES: [u32; 3] = [12, 24, 48];
/// Good enough to know how many passes a solution takes.
const FACTORS: form_factors::Params = form_factors::Params {
    mode: Mode::Accurate,
    points: 3,
    pairs: None,
    seed: 0,
    tolerance: 0.01,
    closure: false,
};
/// Reflectances of the closed room.
const REFLECTANCES: [f64; 3] = [0.5, 0.9, 0.95];
const RESIDUALS: [f64; 2] = [1e-3, 1e-6];

/// How many passes, and how many times faster than the course's 40 sweeps.
const MOST_PASSES: f64 = 12.0;
const MOST_STEPS: f64 = 15.0;
const COURSE: f64 = 60.0;

pub(crate) fn run(root: &Path, json: bool) -> Result<(), Error> {
    let folder = tempfile::tempdir()?;
    let store = Store::new(folder.path());
    let context = Context::new(Some(&store), &Silent);
    let mut figures = Vec::new();
    for divisions in SIZES {
        let cornell = scene(root, "cornell")?;
        let patches = cached(&cornell, divisions, context)?;
        let factors = estimate(&patches, &FACTORS)?;
        let made = factors.made()?;
        let made = &made.form_factors;
        figures.extend(passes(made));
        figures.extend(methods(&factors)?);
        figures.push(beside_the_course(made, &figures));
        for reflectance in REFLECTANCES {
            let mut closed = scene(root, "cornell-closed")?;
            closed.name = format!("closed_{reflectance}");
            for material in &mut closed.materials {
                material.reflectance = [reflectance; 3];
            }
            let patches = cached(&closed, divisions, context)?;
            figures.extend(methods(&estimate(&patches, &FACTORS)?)?);
        }
        show(&figures, json);
        figures.clear();
    }
    show(&[relighting()], json);
    Ok(())
}

fn scene(root: &Path, name: &str) -> Result<Scene, Error> {
    Ok(Project::open(&root.join(format!("scenes/{name}.toml")))?.scene)
}

/// Patches whose form factors are cached, and so mapped from a file when they are asked for.
fn cached<'a>(
    scene: &'a Scene,
    divisions: u32,
    context: Context<'a>,
) -> Result<Patches<'a>, Error> {
    let patches = subdivide(scene, &Discretization::uniform(divisions), context)?;
    estimate(&patches, &FACTORS)?.made()?;
    Ok(patches)
}

/// So many runs: the shorter, the more.
fn runs(patches: usize) -> u32 {
    match patches {
        0..5_000 => 150,
        5_000..10_000 => 30,
        _ => 5,
    }
}

/// What each method takes to each residual.
fn methods(factors: &Factors<'_>) -> Result<Vec<Figure>, Error> {
    let patches = factors.patches();
    let (scene, patches) = (&patches.scene().name, patches.mesh.patches.len());
    // Held, so that they are not read for each solution.
    let _held = factors.made()?;
    let mut figures = Vec::new();
    for (name, params) in Params::default().by_each_method() {
        let name = name.to_lowercase().replace([' ', '-'], "_");
        for residual in RESIDUALS {
            let params = Params { residual, ..params };
            let report = factors.solution(&params)?.report;
            let seconds = best_seconds(runs(patches).div_ceil(5), || {
                std::hint::black_box(factors.solution(&params).is_ok());
            });
            let promise = match (&scene[..], &name[..]) {
                ("cornell", "over_relaxation") if residual < 1e-5 => Some(MOST_PASSES),
                ("closed_0.95", "conjugate_gradients") if residual < 1e-5 => Some(MOST_STEPS),
                _ => None,
            };
            let name = format!("solver.{patches}.{scene}.{name}.{residual:e}");
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
    let patches = made.areas.len();
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
        std::hint::black_box(superpose(&lights, &[[0.1, 0.2, 0.3]; 4]));
    });
    let unit = "us for 10,000 patches and 4 lights";
    Figure::new("solver.relight".to_owned(), Some(1e6 * seconds), unit, None)
}
