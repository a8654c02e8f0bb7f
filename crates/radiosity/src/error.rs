//! What can go wrong, for people and for exit codes.

use radiosity_cache::{CacheError, Changed};
use radiosity_geometry::{Divisions, LEAST_SIZE, MeshError, count_patches};
use radiosity_scene::{FileKind, Mode, Scene, SceneError};
use radiosity_solver::SolveError;
use std::path::PathBuf;

/// Why a run ended without its result.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A scene or mesh file is wrong.
    #[error("{0}")]
    Scene(#[from] SceneError),
    /// No scene goes by that name.
    #[error("error: there is no scene `{wanted}`\n   = help: {help}")]
    NoSuchScene {
        /// What was asked for.
        wanted: String,
        /// What there is.
        help: String,
    },
    /// Another input is wrong.
    #[error("error: {0}")]
    Input(String),
    /// A picture was asked of a scene without a camera.
    #[error(
        "error: the scene has no camera\n   = help: add a [camera] with `position`, `look_at` and `vertical_fov`, or use `solve`"
    )]
    NoCamera,
    /// The same of a scene whose file cannot hold one.
    #[error(
        "error: the scene has no camera\n   = help: a View3D file (.vs3) holds neither camera nor light: use `form-factors`, or write its surfaces into a scene file (.toml) with a [camera] and a material that emits"
    )]
    NoCameraInView3D,
    /// The surfaces cannot be cut into patches.
    #[error("error: {0}")]
    Mesh(String),
    /// The machine is too small.
    #[error("error: {problem}\n   = help: {remedy}")]
    Resources {
        /// What is missing.
        problem: String,
        /// What to do.
        remedy: String,
    },
    /// The system of equations has no solution.
    #[error("error: {problem}\n   = help: {remedy}")]
    Unsolvable {
        /// Why, and at which surfaces.
        problem: String,
        /// What to do.
        remedy: String,
    },
    /// The cache folder cannot be used.
    #[error("error: {0}\n   = help: choose another folder with --cache, or use --no-cache")]
    Cache(#[from] CacheError),
    /// Nor can the one that a command is about, which cannot do without.
    #[error("error: {0}\n   = help: choose another folder with --cache")]
    CacheFolder(CacheError),
    /// A file of the cache was changed while a result was made of it.
    #[error(
        "error: {0}: the result is not written\n   = help: run the same command again, which makes anew what is damaged"
    )]
    Changed(#[from] Changed),
    /// A result cannot be written.
    #[error("error: cannot write {}: {error}", path.display())]
    Output {
        /// The file.
        path: PathBuf,
        /// What went wrong.
        #[source]
        error: std::io::Error,
    },
}

impl Error {
    /// The exit code of the command.
    pub fn exit_code(&self) -> u8 {
        match self {
            Error::Cache(_) | Error::CacheFolder(_) | Error::Output { .. } => 1,
            Error::Scene(_)
            | Error::NoSuchScene { .. }
            | Error::NoCamera
            | Error::NoCameraInView3D
            | Error::Input(_)
            | Error::Mesh(_)
            | Error::Changed(_) => 3,
            Error::Resources { .. } => 4,
            Error::Unsolvable { .. } => 5,
        }
    }

    /// A picture was asked of a scene without a camera.
    pub fn no_camera(scene: &Scene) -> Error {
        match scene.kind {
            FileKind::Toml => Error::NoCamera,
            FileKind::View3D => Error::NoCameraInView3D,
        }
    }

    /// Names the surface that a mesh error is about.
    pub fn of_mesh(scene: &Scene, error: &MeshError) -> Error {
        let name = |id: &radiosity_geometry::SurfaceId| &scene.surfaces[id.index()].name;
        Error::Mesh(match error {
            MeshError::Shape { surface, error } => format!("surface `{}` {error}", name(surface)),
            MeshError::TwoCountsOnTriangle { surface, a, b } => format!(
                "surface `{}` is made of triangles, which take one count, not {a}x{b}",
                name(surface)
            ),
            MeshError::NoDivisions { surface } => {
                let name = name(surface);
                format!(
                    "surface `{name}` has no usable subdivision: counts and lengths must be positive"
                )
            }
            MeshError::NoDigits {
                surface,
                size,
                largest,
            } => format!(
                "a patch of `{}` is {size:.1e} large, where coordinates are up to {largest:.1e}: they leave \
                 no digits for it (at least {:.1e} is needed)\n   = help: move the scene to the origin, or \
                 leave out what is far away",
                name(surface),
                LEAST_SIZE * largest,
            ),
            MeshError::TooManyPatches => too_many_patches(scene),
            MeshError::Empty => error.to_string(),
        })
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
                        Mode::Accurate => "lower the reflectances there",
                        Mode::Regular | Mode::MonteCarlo => {
                            "estimate the form factors with --mode accurate, or lower the \
                             reflectances there"
                        }
                    }
                    .to_owned(),
                }
            }
            SolveError::Worthless { .. } => Error::Unsolvable {
                problem: error.to_string(),
                remedy: "lower the reflectances, or allow more with --max-sweeps".to_owned(),
            },
            SolveError::NotFinite { patch } | SolveError::OutOfRange { patch } => {
                Error::Unsolvable {
                    problem: format!("{error}; it belongs to `{}`", name_of(*patch)),
                    remedy: "use numbers of ordinary size in the scene".to_owned(),
                }
            }
        }
    }
}

/// Cutting surfaces less helps, unless there are as many before anything is cut.
fn too_many_patches(scene: &Scene) -> String {
    match count_patches(&scene.undivided(), Divisions::uniform(1)) {
        Err(MeshError::TooManyPatches) => {
            "the scene has more than 1,048,576 faces, each of which is a patch at least\n   \
             = help: use coarser meshes, or split the scene"
        }
        _ => {
            "the subdivision gives more than 1,048,576 patches\n   \
             = help: cut surfaces less (--patches, or a larger --max-patch-edge or `divisions` of \
             surfaces)"
        }
    }
    .to_owned()
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
        let said = |scene: &Scene| Error::of_mesh(scene, &MeshError::TooManyPatches).to_string();
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
            !of_mesh.contains("subdivision") && !of_mesh.contains("--patches"),
            "{of_mesh}"
        );
    }
}
