//! Which scene, and how it is cut, on the command line.

use super::folders::Folders;
use super::parse::parse_counts;
use crate::error::Error;
use clap::Args;
use radiosity::Project;
use radiosity::geometry::{Discretization, Divisions};
use radiosity::scene::MeshFiles;
use std::path::PathBuf;

/// Which scene.
#[derive(Debug, Args)]
pub struct SceneArgs {
    /// A scene file, or the name of one in `scenes/`
    #[arg(default_value = "cornell")]
    pub scene: PathBuf,
    #[command(flatten)]
    #[allow(missing_docs, reason = "a comment here would replace the help text")]
    pub outside: OutsideArgs,
    /// Patches along each edge of a surface, as N or AxB [default: the scene's, or 12]
    ///
    /// Surfaces with divisions of their own keep them.
    #[arg(
        long,
        alias = "patches",
        value_name = "N",
        value_parser = parse_counts,
        conflicts_with = "max_patch_edge",
    )]
    pub divisions: Option<(u32, u32)>,
    /// Longest edge of a patch, in scene units, instead of --divisions
    #[arg(long, value_name = "LENGTH", allow_negative_numbers = true)]
    pub max_patch_edge: Option<f64>,
}

impl SceneArgs {
    /// The scene, with its parameters as far as these flags change them.
    pub(super) fn load(&self, folders: &Folders) -> Result<Project, Error> {
        let mut project = folders.load(&self.scene, self.outside)?;
        self.apply(&mut project.params.discretization);
        Ok(project)
    }

    fn apply(&self, params: &mut Discretization) {
        let counts = self.divisions.map(|(a, b)| Divisions::Count { a, b });
        set(&mut params.default, counts);
        let length = self.max_patch_edge.map(Divisions::MaxEdge);
        set(&mut params.default, length);
    }
}

/// The value of a flag, if it is given.
pub(super) fn set<T>(param: &mut T, flag: Option<T>) {
    if let Some(value) = flag {
        *param = value;
    }
}

/// Which files a scene may name.
#[derive(Clone, Copy, Debug, Args)]
pub struct OutsideArgs {
    /// Read meshes outside of the scene's folder, too
    #[arg(long)]
    pub allow_outside: bool,
}

impl OutsideArgs {
    pub(super) fn mesh_files(self) -> MeshFiles {
        match self.allow_outside {
            true => MeshFiles::Anywhere,
            false => MeshFiles::InFolder,
        }
    }
}
