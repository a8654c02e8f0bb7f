//! What can go wrong.

use crate::remedy::Remedy;
use radiosity_cache::{CacheError, Changed};
use radiosity_geometry::{Divisions, LEAST_SIZE, MeshError, count_patches};
use radiosity_scene::{FileKind, Mode, Scene, SceneError};
use radiosity_solver::SolveError;

/// Why a stage ended without its result. What mends it is [`Error::remedy`].
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A scene or mesh file is wrong. The report shows where, and how to mend it.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A picture was asked of a scene without a camera.
    #[error("the scene has no camera")]
    NoCamera {
        /// The kind of the scene's file.
        file: FileKind,
    },
    /// A material emits, and no light of the scene does so by it.
    #[error("material `{material}` emits but belongs to no light of the scene")]
    NoLight {
        /// Its name.
        material: String,
    },
    /// The errors of form factors were asked of an estimator that does not tell them.
    #[error("the form factors know nothing of their errors")]
    NoErrors,
    /// The surfaces cannot be cut into patches.
    #[error("{problem}")]
    Mesh {
        /// What is wrong, and with which surface.
        problem: String,
        /// What to do, if the problem does not say it.
        remedy: Option<Remedy>,
    },
    /// The machine is too small.
    #[error("{problem}")]
    Resources {
        /// What is missing.
        problem: String,
        /// What to do.
        remedy: Remedy,
    },
    /// The system of equations has no solution.
    #[error("{problem}")]
    Unsolvable {
        /// Why, and at which surfaces.
        problem: String,
        /// What to do.
        remedy: Remedy,
    },
    /// The cache folder cannot be used.
    #[error(transparent)]
    Cache(#[from] CacheError),
    /// A file of the cache was changed while a result was made of it.
    #[error("{0}: the result is not written")]
    Changed(#[from] Changed),
}

impl Error {
    /// What mends it, if the message does not say it already.
    pub fn remedy(&self) -> Option<Remedy> {
        match self {
            Error::Scene(_) | Error::NoLight { .. } => None,
            Error::NoCamera { file } => Some(match file {
                FileKind::Toml => Remedy::Camera,
                FileKind::View3D => Remedy::SceneFile,
            }),
            Error::NoErrors => Some(Remedy::AccurateEstimator),
            Error::Mesh { remedy, .. } => remedy.clone(),
            Error::Resources { remedy, .. } | Error::Unsolvable { remedy, .. } => {
                Some(remedy.clone())
            }
            Error::Cache(_) => Some(Remedy::CacheFolder),
            Error::Changed(_) => Some(Remedy::RunAgain),
        }
    }

    /// A picture was asked of a scene without a camera.
    pub fn no_camera(scene: &Scene) -> Error {
        Error::NoCamera { file: scene.kind }
    }

    /// Names the surface that a mesh error is about.
    pub fn of_mesh(scene: &Scene, error: &MeshError) -> Error {
        let name = |id: &radiosity_geometry::SurfaceId| &scene.surfaces[id.index()].name;
        let problem = match error {
            MeshError::Shape { surface, error } => format!("surface `{}` {error}", name(surface)),
            MeshError::TwoCountsOnTriangle { surface, a, b } => format!(
                "surface `{}` is made of triangles, which take one count, not {a}x{b}",
                name(surface)
            ),
            MeshError::NoDivisions { surface } => format!(
                "surface `{}` has no usable subdivision: counts and lengths must be positive",
                name(surface)
            ),
            MeshError::NoDigits {
                surface,
                size,
                largest,
            } => format!(
                "a patch of `{}` is {size:.1e} large, where coordinates are up to {largest:.1e}: they leave \
                 no digits for it (at least {:.1e} is needed)",
                name(surface),
                LEAST_SIZE * largest,
            ),
            MeshError::TooManyPatches => return too_many_patches(scene),
            MeshError::Empty => error.to_string(),
        };
        let is_far = matches!(error, MeshError::NoDigits { .. });
        let remedy = is_far
            .then(|| Remedy::words("move the scene to the origin, or leave out what is far away"));
        Error::Mesh { problem, remedy }
    }

    /// Names the surfaces of the patches that a solver error is about.
    pub(crate) fn of_solver(
        error: &SolveError,
        mode: Mode,
        name_of: impl Fn(usize) -> String,
    ) -> Error {
        match error {
            SolveError::Diverges { worst_patches, .. } => {
                let mut names: Vec<String> = Vec::new();
                for name in worst_patches.iter().map(|&patch| name_of(patch)) {
                    if !names.contains(&name) {
                        names.push(name);
                    }
                }
                let names = names.join("`, `");
                Error::Unsolvable {
                    problem: format!("{error}; the worst rows belong to `{names}`"),
                    remedy: match mode {
                        Mode::Accurate => Remedy::words("lower the reflectances there"),
                        Mode::Regular | Mode::MonteCarlo => Remedy::AccurateEstimatorOrDarker,
                    },
                }
            }
            SolveError::Worthless { .. } => Error::Unsolvable {
                problem: error.to_string(),
                remedy: Remedy::MoreSweeps,
            },
            SolveError::NotFinite { patch } | SolveError::OutOfRange { patch } => {
                Error::Unsolvable {
                    problem: format!("{error}; it belongs to `{}`", name_of(*patch)),
                    remedy: Remedy::words("use numbers of ordinary size in the scene"),
                }
            }
        }
    }
}

/// Cutting surfaces less helps, unless there are as many before anything is cut.
fn too_many_patches(scene: &Scene) -> Error {
    let (problem, remedy) = match count_patches(&scene.undivided(), Divisions::uniform(1)) {
        Err(MeshError::TooManyPatches) => (
            "the scene has more than 1,048,576 faces, each of which is a patch at least",
            Remedy::words("use coarser meshes, or split the scene"),
        ),
        _ => (
            "the subdivision gives more than 1,048,576 patches",
            Remedy::FewerPatches { fit: None },
        ),
    };
    Error::Mesh {
        problem: problem.to_owned(),
        remedy: Some(remedy),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use radiosity_geometry::{DVec3, PolygonMesh, Shape, Surface};

    const SCENE: &str = "[discretization]\ndivisions = 1\n[materials.m]\nreflectance = 0.5\n\
        [[surfaces]]\nname = \"s\"\nmaterial = \"m\"\ntriangle = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\n";

    #[test]
    fn what_helps_a_mesh_is_not_what_helps_a_square() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("s.toml");
        std::fs::write(&path, SCENE).unwrap();
        let mut scene = radiosity_scene::load(&path).unwrap();
        let said = |scene: &Scene| {
            let error = Error::of_mesh(scene, &MeshError::TooManyPatches);
            format!("{error}: {}", error.remedy().unwrap())
        };
        let of_squares = said(&scene);
        assert!(
            of_squares.contains("the subdivision gives more than 1,048,576"),
            "{of_squares}"
        );
        let mesh = PolygonMesh {
            positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
            faces: vec![vec![0, 1, 2]; (1 << 20) + 1],
        };
        scene.geometry = vec![Surface {
            shape: Shape::Mesh(mesh),
            divisions: None,
        }];
        let of_mesh = said(&scene);
        assert!(of_mesh.contains("coarser meshes"), "{of_mesh}");
        assert!(
            !of_mesh.contains("subdivision") && !of_mesh.contains("fewer patches"),
            "{of_mesh}"
        );
    }
}
