//! Where things are kept: in a checkout, or around an installed command.

use super::scene_args::OutsideArgs;
use super::terminal::tell;
use crate::error::Error;
use etcetera::{BaseStrategy, choose_base_strategy};
use radiosity::Project;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// The folders that a command uses unless told otherwise.
#[derive(Clone, Debug)]
pub struct Site {
    /// Scenes that can be called by name.
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

impl Site {
    /// Everything in a checkout of the project.
    pub fn checkout(root: &Path) -> Site {
        Site {
            scenes: root.join("scenes"),
            cache: root.join("cache"),
            output: root.join("out"),
        }
    }

    /// Scenes and pictures in the working folder, artifacts in the platform's cache folder.
    pub fn installed() -> Site {
        let cache = match choose_base_strategy() {
            Ok(platform) => platform.cache_dir().join("radiosity"),
            Err(_) => PathBuf::from("cache"),
        };
        Site {
            scenes: PathBuf::from("scenes"),
            cache,
            output: PathBuf::from("out"),
        }
    }

    /// Loads a scene by the path of its file, or by its name.
    pub(crate) fn load(&self, wanted: &Path, outside: OutsideArgs) -> Result<Project, Error> {
        let project = Project::open_with(&self.path_of(wanted)?, outside.mesh_files())?;
        for note in &project.notes {
            tell(&format!("note: {note}"));
        }
        Ok(project)
    }

    fn path_of(&self, wanted: &Path) -> Result<PathBuf, Error> {
        let is_path = wanted.components().count() > 1
            || wanted.extension().is_some_and(is_of_scene)
            || wanted.is_file();
        if is_path {
            return Ok(wanted.to_owned());
        }
        let with_ending = |ending| {
            let mut name = self.scenes.join(wanted).into_os_string();
            name.push(".");
            name.push(ending);
            PathBuf::from(name)
        };
        let mut named = ENDINGS.into_iter().map(with_ending);
        if let Some(named) = named.find(|path| path.is_file()) {
            return Ok(named);
        }
        Err(Error::with_help(
            format!("there is no scene `{}`", wanted.display()),
            self.what_there_is(),
        ))
    }

    fn what_there_is(&self) -> String {
        let entries = std::fs::read_dir(&self.scenes).into_iter().flatten();
        let mut names: Vec<String> = entries
            .filter_map(|entry| {
                let path = entry.ok()?.path();
                let is_scene = is_of_scene(path.extension()?);
                is_scene.then(|| path.file_stem()?.to_str().map(str::to_owned))?
            })
            .collect();
        names.sort();
        let folder = self.scenes.display();
        if names.is_empty() {
            format!("give the path of a scene file; there are none in {folder}")
        } else {
            format!(
                "give the path of a scene file, or a name: {}",
                names.join(", ")
            )
        }
    }
}
