//! Where things are kept: in a checkout, or around an installed command.

use super::scene_args::OutsideArgs;
use super::shipped;
use super::terminal::tell;
use crate::error::Error;
use etcetera::{BaseStrategy, choose_base_strategy};
use radiosity::Project;
use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// The folders that a command uses unless told otherwise.
#[derive(Clone, Debug)]
pub struct Folders {
    /// Scenes that can be called by name, beside those in the program.
    pub scenes: PathBuf,
    /// Cached artifacts.
    pub cache: PathBuf,
    /// Pictures.
    pub output: PathBuf,
}

/// What names of scene files end in.
const ENDINGS: [&str; 2] = ["toml", "vs3"];

fn is_of_scene(ending: &OsStr) -> bool {
    ENDINGS.iter().any(|known| ending == *known)
}

impl Folders {
    /// Everything in a checkout of the project.
    pub fn checkout(root: &Path) -> Folders {
        Folders {
            scenes: root.join("scenes"),
            cache: root.join("cache"),
            output: root.join("out"),
        }
    }

    /// Scenes and pictures in the working folder, artifacts in the platform's cache folder.
    pub fn installed() -> Folders {
        let cache = match choose_base_strategy() {
            Ok(platform) => platform.cache_dir().join("radiosity"),
            Err(_) => PathBuf::from("cache"),
        };
        Folders {
            scenes: PathBuf::from("scenes"),
            cache,
            output: PathBuf::from("out"),
        }
    }

    /// Loads a scene by the path of its file, or by its name.
    pub(crate) fn load(&self, wanted: &Path, outside: OutsideArgs) -> Result<Project, Error> {
        let project = match self.path_of(wanted) {
            Some(path) => Project::open_with(&path, outside.mesh_files())?,
            None => match shipped::open(wanted) {
                Some(project) => project?,
                None => return Err(self.no_scene(wanted)),
            },
        };
        for note in &project.notes {
            tell(&format!("note: {note}"));
        }
        Ok(project)
    }

    /// The file of a scene; there may be none of this name.
    fn path_of(&self, wanted: &Path) -> Option<PathBuf> {
        let is_path = wanted.components().count() > 1
            || wanted.extension().is_some_and(is_of_scene)
            || wanted.is_file();
        if is_path {
            return Some(wanted.to_owned());
        }
        let with_ending = |ending| {
            let mut name = self.scenes.join(wanted).into_os_string();
            name.push(".");
            name.push(ending);
            PathBuf::from(name)
        };
        let mut named = ENDINGS.into_iter().map(with_ending);
        named.find(|path| path.is_file())
    }

    fn no_scene(&self, wanted: &Path) -> Error {
        let names = self.names().join(", ");
        let what = match wanted.is_dir() {
            true => "is a folder, not a scene",
            false => "is no scene and no file",
        };
        Error::with_help(
            format!("`{}` {what}", wanted.display()),
            match ENDINGS
                .map(|ending| wanted.with_extension(ending))
                .into_iter()
                .find(|p| p.is_file())
            {
                Some(path) => format!("did you mean `{}`?", path.display()),
                None => format!("give the path of a scene file (.toml, .vs3), or a name: {names}"),
            },
        )
    }

    /// What scenes can be called by name.
    fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(&self.scenes).into_iter().flatten();
        let in_folder = entries.filter_map(|entry| {
            let path = entry.ok()?.path();
            let is_scene = is_of_scene(path.extension()?);
            is_scene.then(|| path.file_stem()?.to_str().map(str::to_owned))?
        });
        let shipped = shipped::names().map(str::to_owned);
        let names: BTreeSet<String> = in_folder.chain(shipped).collect();
        names.into_iter().collect()
    }
}
