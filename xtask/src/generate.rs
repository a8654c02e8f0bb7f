//! `cargo xtask generate`: scenes and meshes that follow a rule, as files.

use clap::Subcommand;
use radiosity_generate::{blob, knot, nested_box};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

#[derive(Clone, Debug, Subcommand)]
pub(crate) enum Generated {
    /// scenes/knot.obj: a tube along a trefoil knot
    Knot,
    /// A View3D scene: the closed box of `tests/data/box313`, its 313 rectangles cut finer, those
    /// of one rectangle combined, with plates that stand in the way
    Box {
        /// How many rectangles: 313 times a square number
        #[arg(long, default_value = "1252")]
        elements: u32,
        /// How many plates
        #[arg(long, default_value = "0")]
        obstacles: u32,
        /// The file [default: out/box-ELEMENTS-OBSTACLES.vs3]
        #[arg(long, short)]
        output: Option<PathBuf>,
    },
    /// A View3D scene: a dented ball of many triangles that stand in the way, in a box of 1,944
    /// patches
    Blob {
        /// About how many triangles
        #[arg(long, default_value = "70000")]
        triangles: u32,
        /// The file [default: out/blob-TRIANGLES.vs3]
        #[arg(long, short)]
        output: Option<PathBuf>,
    },
}

pub(crate) fn run(what: &Generated, root: &Path) -> ExitCode {
    let made = match what {
        Generated::Knot => Ok((root.join("scenes/knot.obj"), knot::obj())),
        Generated::Box {
            elements,
            obstacles,
            output,
        } => nested_box::vs3(root, *elements, *obstacles).map(|text| {
            let usual = || root.join(format!("out/box-{elements}-{obstacles}.vs3"));
            (output.clone().unwrap_or_else(usual), text)
        }),
        Generated::Blob { triangles, output } => blob::vs3(*triangles).map(|text| {
            let usual = || root.join(format!("out/blob-{triangles}.vs3"));
            (output.clone().unwrap_or_else(usual), text)
        }),
    };
    match made.and_then(|(path, text)| write(&path, &text).map(|()| path)) {
        Ok(path) => {
            println!("{}", path.display());
            ExitCode::SUCCESS
        }
        Err(problem) => {
            eprintln!("error: {problem}");
            ExitCode::FAILURE
        }
    }
}

fn write(path: &Path, text: &str) -> Result<(), String> {
    if let Some(folder) = path.parent() {
        // If it cannot be made, the file cannot be written either.
        let _ = std::fs::create_dir_all(folder);
    }
    std::fs::write(path, text).map_err(|error| format!("cannot write {}: {error}", path.display()))
}
