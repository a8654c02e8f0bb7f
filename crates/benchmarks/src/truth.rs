//! Radiosities and smooth pictures of every mode against the oracle.
//!
//! The oracle is noisy, but tells how much; what is reported is without its noise.

mod oracle;

use crate::Error;
use crate::figure::{Figure, Target};
use oracle::{Accuracy, Oracle, tracer};
use radiosity::Project;
use radiosity::form_factors::{Mode, Params};
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

/// Size of the pictures.
const PICTURE: (u32, u32) = (320, 240);
/// So many times as many samples where a pixel shows several faces.
const ADAPTIVE: u32 = 16;
/// Passes by which the oracle's speed is measured.
const SPEED_PASSES: u32 = 3;

pub(crate) fn run(root: &Path, json: bool) -> Result<(), Error> {
    let mut rows = Vec::new();
    let mut of_oracle = Vec::new();
    for name in SCENES {
        let mut project = Project::open(&root.join(format!("scenes/{name}.toml")))?;
        if ["cornell", "knot"].contains(&name) {
            of_oracle.push(speed(&project)?);
        }
        let image = &mut project.params.image;
        (image.width, image.height) = PICTURE;
        // The error is to be that of the light, not of the samples along edges.
        image.adaptive = ADAPTIVE;
        let oracle = Oracle::of(&project)?;
        of_oracle.extend(oracle.noise(name));
        let mut row = format!("| `{name}` |");
        for (mode_name, mode, points, pairs) in MODES {
            project.params.form_factors = Params {
                mode,
                points,
                pairs,
                tolerance: TOLERANCE,
                ..Params::default()
            };
            let accuracy = oracle.judge(&project)?;
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

fn speed(project: &Project) -> Result<Figure, Error> {
    let mut tracer = tracer(project, 1)?;
    let start = Instant::now();
    (0..SPEED_PASSES).for_each(|_| tracer.pass(&|_| ()));
    let threads = rayon::current_num_threads() as f64;
    let rate = tracer.vertices() as f64 / start.elapsed().as_secs_f64() / threads;
    Ok(Figure::new(
        format!("oracle.{}.vertices", project.scene.name),
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
