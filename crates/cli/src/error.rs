//! What can go wrong, as a command says it: with its flags, and with an exit code.

use radiosity::Remedy;
use radiosity::cache::{CacheError, Changed};
use radiosity::scene::{Help, SceneError};
use std::io;
use std::path::PathBuf;

/// Why a command ended without its result.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Error {
    /// A stage.
    #[error(transparent)]
    Engine(#[from] radiosity::Error),
    /// What the command was told, or a file that it was to read.
    #[error("{problem}")]
    Input {
        problem: String,
        help: Option<String>,
    },
    /// The cache folder that the command is about, which it cannot do without.
    #[error(transparent)]
    CacheFolder(CacheError),
    /// A result cannot be written.
    #[error("cannot write {}: {error}", path.display())]
    Output {
        path: PathBuf,
        #[source]
        error: io::Error,
    },
    #[error("cannot start threads: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
}

impl From<SceneError> for Error {
    fn from(error: SceneError) -> Error {
        Error::Engine(error.into())
    }
}

impl From<Changed> for Error {
    fn from(error: Changed) -> Error {
        Error::Engine(error.into())
    }
}

impl Error {
    /// An input that is wrong, where the problem tells what to do.
    pub(crate) fn input(problem: impl Into<String>) -> Error {
        Error::Input {
            problem: problem.into(),
            help: None,
        }
    }

    /// An input that is wrong, and what to do.
    pub(crate) fn with_help(problem: impl Into<String>, help: impl Into<String>) -> Error {
        Error::Input {
            problem: problem.into(),
            help: Some(help.into()),
        }
    }

    /// The exit code of the command.
    pub(crate) fn exit_code(&self) -> u8 {
        use radiosity::Error as Engine;
        match self {
            Error::Engine(Engine::Cache(_)) | Error::CacheFolder(_) | Error::Output { .. } => 1,
            Error::Engine(Engine::Resources { .. }) | Error::Threads(_) => 4,
            Error::Engine(Engine::Unsolvable { .. }) => 5,
            // Those of files are errors of the scene.
            Error::Engine(Engine::OutOfRange(_)) => 2,
            Error::Engine(_) | Error::Input { .. } => 3,
        }
    }

    /// All that is printed.
    pub(crate) fn report(&self) -> String {
        if let Error::Engine(radiosity::Error::Scene(error)) = self {
            // It shows the place in the file.
            let help = error.help().map(scene_help);
            return format!("error: {}", error.report(help.as_deref()));
        }
        if let Error::Engine(radiosity::Error::OutOfRange(error)) = self {
            return format!("error: {} must be {}", flag_of(error.key), error.range);
        }
        match self.help() {
            Some(help) => format!("error: {self}\n   = help: {help}"),
            None => format!("error: {self}"),
        }
    }

    fn help(&self) -> Option<String> {
        match self {
            Error::Engine(error) => error.remedy().as_ref().map(by_flags),
            Error::Input { help, .. } => help.clone(),
            Error::CacheFolder(_) => Some("choose another folder with --cache".to_owned()),
            Error::Output { error, .. } => (error.kind() == io::ErrorKind::NotFound)
                .then(|| "make the folder first".to_owned()),
            Error::Threads(_) => Some("use fewer (--threads)".to_owned()),
        }
    }
}

/// The flag of a parameter: of most it is called the same.
fn flag_of(key: &str) -> String {
    match key {
        "width" | "height" => "--size".to_owned(),
        "method" => "--solver".to_owned(),
        "directions" => "--gather".to_owned(),
        _ => format!("--{}", key.replace('_', "-")),
    }
}

/// What mends a scene or mesh file, by the flags that there are for it.
fn scene_help(help: &Help) -> String {
    match help {
        Help::MeshFolder => format!("{help}: --allow-outside"),
        _ => help.to_string(),
    }
}

/// A remedy, and the flags that there are for it.
fn by_flags(remedy: &Remedy) -> String {
    let flags = match remedy {
        Remedy::Camera => ", or use `solve`",
        Remedy::SceneFile => ", or use `form-factors`",
        Remedy::AccurateEstimator | Remedy::AccurateEstimatorOrDarker => " (--mode accurate)",
        Remedy::MoreSweeps => " (--max-sweeps)",
        Remedy::FewerPatches { .. } => {
            " (--divisions, or a larger --max-patch-edge; keys of surfaces count before flags)"
        }
        Remedy::SmallerPictures => " (--size)",
        Remedy::SmallerExport => " (--by surface, or a .csv with --sparse 1e-6)",
        Remedy::CacheFolder | Remedy::CacheDisk => " (--cache, --no-cache)",
        _ => "",
    };
    format!("{remedy}{flags}")
}
