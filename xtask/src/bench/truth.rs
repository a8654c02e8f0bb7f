//! Radiosities and smooth pictures of every mode against the oracle.
//!
//! The oracle is noisy, but tells how much; what is reported is without its noise.

use super::{Figure, Target};
use radiosity::compare::{Errors, Table, compare_pictures, compare_tables};
use radiosity::geometry::Mesh;
use radiosity::image::{Decoded, Image};
use radiosity::reference::{Tracer, cell_means};
use radiosity::renderer::Shading;
use radiosity::scene::{Mode, Scene, load};
use radiosity::{Error, Pipeline, Silent, Sources, cells, radiosity_table, reference_table};
use std::path::Path;
use std::time::Instant;

const SCENES: [&str; 5] = [
    "cornell",
    "cornell-triangles",
    "cornell-closed",
    "furnace",
    "knot",
];

/// Name, mode, points along an edge, pairs. The regular rule of 3 x 3 points is the course's; as
/// many random pairs take the same time.
const MODES: [(&str, Mode, u32, Option<u32>); 5] = [
    ("regular-2", Mode::Regular, 2, None),
    ("regular-3", Mode::Regular, 3, None),
    ("regular-4", Mode::Regular, 4, None),
    ("monte-carlo-81", Mode::MonteCarlo, 1, Some(81)),
    ("accurate-0.01", Mode::Accurate, 1, None),
];
/// Of the accurate mode: its errors are then far below those of the patches.
const TOLERANCE: f64 = 0.01;

/// Random walks of the oracle, shared by all patches.
const WALKS: usize = 40_000_000;
/// Size of the pictures, and passes of each of the two that the oracle makes.
const PICTURE: (u32, u32) = (320, 240);
/// So many times as many samples where a pixel shows several faces.
const ADAPTIVE: u32 = 16;
const PASSES: u32 = 16;
/// Passes by which the oracle's speed is measured.
const SPEED_PASSES: u32 = 3;

/// What the modes are judged by.
struct Oracle {
    table: Table,
    picture: Decoded,
    /// Root mean square errors, in percent of the mean.
    table_noise: f64,
    picture_noise: f64,
}

/// The errors of one mode, in percent.
struct Accuracy {
    rmse: f64,
    bias: f64,
    picture_rmse: f64,
    /// Time of the form factors.
    seconds: f64,
}

pub(super) fn run(root: &Path, json: bool) -> Result<(), Error> {
    let mut rows = Vec::new();
    let mut of_oracle = Vec::new();
    for name in SCENES {
        let mut scene = load(&root.join(format!("scenes/{name}.toml")))?;
        if ["cornell", "knot"].contains(&name) {
            of_oracle.push(speed(&scene)?);
        }
        (scene.image.width, scene.image.height) = PICTURE;
        // The error is to be that of the light, not of the samples along edges.
        scene.image.adaptive = ADAPTIVE;
        let oracle = Oracle::of(&scene)?;
        of_oracle.extend(oracle.noise(name));
        let mut row = format!("| `{name}` |");
        for (mode_name, mode, points, pairs) in MODES {
            let settings = &mut scene.form_factors;
            (settings.mode, settings.points, settings.pairs) = (mode, points, pairs);
            settings.tolerance = TOLERANCE;
            let accuracy = oracle.judge(&scene)?;
            let described = described(accuracy.as_ref());
            eprintln!("{name}, {mode_name}: {described}");
            row += &format!(" {described} |");
            if json {
                let figures = figures(name, mode_name, accuracy.as_ref());
                figures.iter().for_each(Figure::print);
            }
        }
        rows.push(row);
    }
    if json {
        of_oracle.iter().for_each(Figure::print);
    } else {
        print_table(&rows);
        of_oracle.iter().for_each(Figure::say);
    }
    Ok(())
}

impl Oracle {
    fn of(scene: &Scene) -> Result<Oracle, Error> {
        let pipeline = Pipeline::new(scene, None, &Silent)?;
        let mesh = pipeline.mesh();
        let walks = WALKS.div_ceil(mesh.patches.len()) as u32;
        let means = cell_means(scene, mesh, walks, 1, &|_| ());
        let [a, b] = [trace(scene, 2)?, trace(scene, 3)?];
        // Half their difference has the variance of their mean.
        let halves = picture_rmse(&a, &decoded(b.clone()), scene)?;
        let mean = |(a, b): (&[f32; 3], &[f32; 3])| std::array::from_fn(|c| 0.5 * (a[c] + b[c]));
        let pixels = a.pixels.iter().zip(&b.pixels).map(mean).collect();
        let table = reference_table(scene, mesh, &means);
        let itself = table_errors(scene, mesh, &table, &table)?;
        Ok(Oracle {
            table,
            table_noise: itself.noise_percent.unwrap_or(0.0),
            picture: decoded(Image { pixels, ..a }),
            picture_noise: 0.5 * halves,
        })
    }

    fn noise(&self, scene: &str) -> [Figure; 2] {
        let noises = [
            ("radiosity", self.table_noise),
            ("picture", self.picture_noise),
        ];
        noises.map(|(what, noise)| {
            let name = format!("oracle.{scene}.{what}_noise");
            Figure::new(name, Some(noise), "%", None)
        })
    }

    /// Renders a scene and compares; `None` if it has no solution.
    fn judge(&self, scene: &Scene) -> Result<Option<Accuracy>, Error> {
        let pipeline = Pipeline::new(scene, None, &Silent)?;
        let solved = match pipeline.solution(Sources::Cached) {
            Err(Error::Unsolvable { .. }) => return Ok(None),
            solved => solved?,
        };
        let found = radiosity_table(
            scene,
            pipeline.mesh(),
            &pipeline.mean_radiosity(&solved.light),
        );
        let all = table_errors(scene, pipeline.mesh(), &found, &self.table)?;
        let smooth = pipeline.pictures(&solved.light, &[Shading::Smooth])?;
        let squares = picture_rmse(&smooth[0], &self.picture, scene)?.powi(2);
        Ok(Some(Accuracy {
            rmse: all.rmse_percent_without_noise(),
            bias: all.bias_percent,
            picture_rmse: (squares - self.picture_noise.powi(2)).max(0.0).sqrt(),
            seconds: solved.form_factors.seconds,
        }))
    }
}

/// Over the patches that do not emit; over all, where all emit.
fn table_errors(
    scene: &Scene,
    mesh: &Mesh,
    found: &Table,
    reference: &Table,
) -> Result<Errors, Error> {
    let mut cells = cells(scene, mesh);
    if cells.iter().all(|cell| cell.emits) {
        cells.iter_mut().for_each(|cell| cell.emits = false);
    }
    let errors = compare_tables(&cells, found, reference);
    let errors = errors.map_err(|error| Error::Input(error.to_string()))?;
    Ok(errors[errors.len() - 1].1)
}

fn trace(scene: &Scene, seed: u64) -> Result<Image, Error> {
    let mut tracer = tracer(scene, seed)?;
    (0..PASSES).for_each(|_| tracer.pass(&|_| ()));
    let traced = tracer.picture();
    let to_f32 = |pixel: &[f64; 3]| pixel.map(|channel| channel as f32);
    Ok(Image {
        width: traced.width,
        height: traced.height,
        pixels: traced.radiance.iter().map(to_f32).collect(),
    })
}

fn tracer(scene: &Scene, seed: u64) -> Result<Tracer<'_>, Error> {
    let camera = scene
        .camera
        .as_ref()
        .ok_or_else(|| Error::no_camera(scene))?;
    Tracer::new(scene, camera, seed).map_err(|error| Error::Mesh(error.to_string()))
}

fn decoded(image: Image) -> Decoded {
    Decoded {
        image,
        levels: false,
    }
}

/// Over the pixels that the reference shows unclamped, in percent of their mean.
fn picture_rmse(found: &Image, reference: &Decoded, scene: &Scene) -> Result<f64, Error> {
    let errors = compare_pictures(
        found,
        reference,
        None,
        scene.image.exposure.factor().unwrap_or(0.0),
    );
    let errors = errors.map_err(|error| Error::Input(error.to_string()))?;
    Ok(errors[errors.len() - 1].1.rmse_percent)
}

fn speed(scene: &Scene) -> Result<Figure, Error> {
    let mut tracer = tracer(scene, 1)?;
    let start = Instant::now();
    (0..SPEED_PASSES).for_each(|_| tracer.pass(&|_| ()));
    let threads = rayon::current_num_threads() as f64;
    let rate = tracer.vertices() as f64 / start.elapsed().as_secs_f64() / threads;
    Ok(Figure::new(
        format!("oracle.{}.vertices", scene.name),
        Some(1e-6 * rate),
        "million path vertices/s/thread",
        Some(Target::AtLeast(5.0)),
    ))
}

fn figures(scene: &str, mode: &str, accuracy: Option<&Accuracy>) -> [Figure; 4] {
    // What the course program is known to reach.
    let course = (scene, mode) == ("cornell", "regular-3");
    let known = |value: f64| course.then_some(Target::Between(value - 0.1, value + 0.1));
    let figure = |what: &str, value: fn(&Accuracy) -> f64, unit, target| {
        let name = format!("truth.{scene}.{mode}.{what}");
        Figure::new(name, accuracy.map(value), unit, target)
    };
    [
        figure("radiosity_rmse", |a| a.rmse, "%", known(4.50)),
        figure("radiosity_bias", |a| a.bias, "%", known(1.63)),
        figure("smooth_picture_rmse", |a| a.picture_rmse, "%", None),
        figure("form_factor_seconds", |a| a.seconds, "s", None),
    ]
}

fn described(accuracy: Option<&Accuracy>) -> String {
    accuracy.map_or_else(
        || "no solution".to_owned(),
        |a| format!("{:.2} %, {:+.2} %; {:.2} %", a.rmse, a.bias, a.picture_rmse),
    )
}

fn print_table(rows: &[String]) {
    let modes = MODES.map(|(name, ..)| name);
    println!("| scene | {} |", modes.join(" | "));
    println!("|---|{}", "---|".repeat(modes.len()));
    rows.iter().for_each(|row| println!("{row}"));
    println!("\nRMSE, bias of the radiosities; RMSE of the smooth picture\n");
}
