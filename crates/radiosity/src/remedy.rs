//! What mends an error.

use std::fmt::{self, Display, Formatter};

/// What mends an error, in words that hold for any program. Whoever has flags or buttons for it
/// names them.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Remedy {
    /// A camera in the scene file.
    Camera,
    /// Another kind of scene file: those of View3D hold neither camera nor light.
    SceneFile,
    /// The accurate estimator.
    AccurateEstimator,
    /// Lower reflectances of the surfaces that are named, or the accurate estimator.
    AccurateEstimatorOrDarker,
    /// Lower reflectances, or more sweeps of the solver.
    MoreSweeps,
    /// Fewer patches, of which about so many fit, if that is known.
    FewerPatches {
        /// How many.
        fit: Option<u64>,
    },
    /// Smaller pictures.
    SmallerPictures,
    /// A table of fewer rows, or of fewer entries.
    SmallerExport,
    /// Another folder for the cache, or none.
    CacheFolder,
    /// The same, on another disk.
    CacheDisk,
    /// The same run again, which makes anew what is damaged.
    RunAgain,
    /// Something else.
    Words(String),
}

impl Remedy {
    pub(crate) fn words(text: &str) -> Remedy {
        Remedy::Words(text.to_owned())
    }
}

impl Display for Remedy {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let text = match self {
            Remedy::Camera => "add a [camera] with `position`, `look_at` and `vertical_fov`",
            Remedy::SceneFile => {
                "a View3D file (.vs3) holds neither camera nor light: write its surfaces into a \
                 scene file (.toml) with a [camera] and a material that emits"
            }
            Remedy::AccurateEstimator => "use the accurate estimator",
            Remedy::AccurateEstimatorOrDarker => {
                "lower the reflectances there, or use the accurate estimator"
            }
            Remedy::MoreSweeps => "lower the reflectances, or allow more sweeps",
            Remedy::FewerPatches { fit: None } => "cut surfaces into fewer patches",
            Remedy::FewerPatches { fit: Some(fit) } => {
                let fit = crate::words::grouped(*fit);
                return write!(f, "cut surfaces into fewer patches: about {fit} fit");
            }
            Remedy::SmallerPictures => "make them smaller",
            Remedy::SmallerExport => "export by surface or group, or leave small entries out",
            Remedy::CacheFolder => "keep the cache in another folder, or keep none",
            Remedy::CacheDisk => "keep the cache on another disk, or keep none",
            Remedy::RunAgain => "run the same again, which makes anew what is damaged",
            Remedy::Words(text) => text,
        };
        f.write_str(text)
    }
}
