//! The command `radiosity`, which `cargo xtask` shares: arguments, progress, reports and exit codes
//! around the engine.

mod args;
mod cache_args;
mod cache_folder;
mod check;
mod check_report;
mod choices;
mod compare;
mod compare_args;
mod display;
mod display_image;
mod display_quantity;
mod error;
mod estimate_args;
mod fit;
mod folders;
mod form_factors;
mod help;
mod image_args;
mod input;
mod inspect;
mod light_args;
mod lines;
mod parse;
mod plot;
mod printable;
mod reference;
mod reference_args;
mod reference_report;
mod report;
mod run;
mod save;
mod scene_args;
mod series;
mod shipped;
mod show_args;
mod signals;
mod solve_report;
mod solver_args;
mod terminal;
mod thumbnail;
mod usage;
mod view_args;

pub use args::{
    CheckArgs, Command, DisplayCommand, FormFactorsCommand, InspectCommand, SolveCommand,
};
pub use cache_args::{CacheAction, CacheCommand, CleanArgs};
pub use compare_args::CompareCommand;
pub use estimate_args::{CacheArgs, EstimateArgs, FactorArgs, OutputArgs, ThreadArgs};
pub use folders::Folders;
pub use help::with_examples;
pub use image_args::{DisplayArgs, ImageArgs};
pub use light_args::LightArgs;
pub use reference_args::ReferenceCommand;
pub use run::run;
pub use scene_args::{OutsideArgs, SceneArgs};
pub use show_args::ShowArgs;
pub use solver_args::SolveArgs;
pub use usage::parse_command_line;
pub use view_args::ViewArgs;

/// For the end of help texts.
pub const EXIT_CODES: &str = "\
Exit codes:
  0  done; also with warnings, such as a solution that did not reach its residual
  1  a file cannot be written, or another failure
  2  the command line is wrong
  3  the scene or another input is wrong, or a cached file was changed while in use
  4  the machine has too little memory or disk
  5  the system of equations has no solution";
