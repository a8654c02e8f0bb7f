//! What can go wrong.

use crate::remedy::Remedy;
use radiosity_cache::{CacheError, Changed};
use radiosity_form_factors::Mode;
use radiosity_geometry::{Discretization, LEAST_SIZE, MeshError, count_patches};
use radiosity_params::OutOfRange;
use radiosity_scene::{FileKind, Scene, SceneError, suggestion};
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
    /// A light or a surface was asked for that the scene does not have.
    #[error("there is no {what} `{name}`")]
    NotInScene {
        /// What was asked for.
        what: &'static str,
        /// What it was called.
        name: String,
        /// What there is.
        help: String,
    },
    /// A parameter has a value that its stage cannot use.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
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
            Error::Scene(_) | Error::NoLight { .. } | Error::OutOfRange(_) => None,
            Error::NotInScene { help, .. } => Some(Remedy::words(help)),
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

    /// Something of this name was asked for, and there are others.
    pub(crate) fn not_in_scene<'n>(
        what: &'static str,
        name: &str,
        known: impl Iterator<Item = &'n str> + Clone,
    ) -> Error {
        Error::NotInScene {
            what,
            name: name.to_owned(),
            help: suggestion(name, known).unwrap_or_else(|| format!("the scene has no {what}")),
        }
    }

    /// A picture was asked of a scene without a camera.
    pub fn no_camera(scene: &Scene) -> Error {
        Error::NoCamera { file: scene.kind }
    }

    /// Names the surface that a mesh error is about.
    pub fn of_mesh(scene: &Scene, params: &Discretization, error: &MeshError) -> Error {
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
                "a patch of `{}` is {size:.1e} large, where coordinates are up to {largest:.1e}: \
                 they leave no digits for it (at least {:.1e} is needed)",
                name(surface),
                LEAST_SIZE * largest,
            ),
            MeshError::TooManyPatches => return too_many_patches(scene, params),
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
            SolveError::NoRows => Error::Unsolvable {
                problem: error.to_string(),
                remedy: Remedy::words("solve by conjugate gradients"),
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
fn too_many_patches(scene: &Scene, params: &Discretization) -> Error {
    let by_faces = params.by_faces();
    let faces = by_faces.of_shapes(scene.shapes());
    let (problem, remedy) = match count_patches(&faces, by_faces.default) {
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
    use radiosity_geometry::{DVec3, PolygonMesh, Shape};
    use radiosity_scene::Material;

    #[test]
    fn what_helps_a_mesh_is_not_what_helps_a_square() {
        let corners = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
        let said = |shape: Shape| {
            let mut scene = Scene::new("s");
            let grey = scene.add_material(Material::reflecting("grey", [0.5; 3]));
            scene.add_surface("s", shape, grey);
            let params = Discretization::default();
            let error = Error::of_mesh(&scene, &params, &MeshError::TooManyPatches);
            format!("{error}: {}", error.remedy().unwrap())
        };
        let of_triangle = said(Shape::Triangle([corners[0], corners[1], corners[2]]));
        assert!(
            of_triangle.contains("the subdivision gives more than 1,048,576"),
            "{of_triangle}"
        );
        let of_mesh = said(Shape::Mesh(PolygonMesh {
            positions: corners,
            faces: vec![vec![0, 1, 2]; (1 << 20) + 1],
        }));
        assert!(of_mesh.contains("coarser meshes"), "{of_mesh}");
        assert!(
            !of_mesh.contains("subdivision") && !of_mesh.contains("fewer patches"),
            "{of_mesh}"
        );
    }
}
