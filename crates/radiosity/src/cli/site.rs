//! Where things are kept: in a checkout, or around an installed command.

use super::terminal::tell;
use crate::error::Error;
use etcetera::{BaseStrategy, choose_base_strategy};
use radiosity_scene::{Scene, load};
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
    pub(crate) fn load(&self, wanted: &str) -> Result<Scene, Error> {
        let scene = load(&self.path_of(wanted)?)?;
        for note in &scene.notes {
            tell(&format!("note: {note}"));
        }
        Ok(scene)
    }

    fn path_of(&self, wanted: &str) -> Result<PathBuf, Error> {
        let endings = [".toml", ".vs3"];
        let is_path = wanted.contains(['/', '\\']) || endings.iter().any(|e| wanted.ends_with(e));
        if is_path || Path::new(wanted).is_file() {
            return Ok(wanted.into());
        }
        let mut named = endings
            .map(|ending| self.scenes.join(format!("{wanted}{ending}")))
            .into_iter();
        if let Some(named) = named.find(|path| path.is_file()) {
            return Ok(named);
        }
        Err(Error::NoSuchScene {
            wanted: wanted.to_owned(),
            help: self.what_there_is(),
        })
    }

    fn what_there_is(&self) -> String {
        let entries = std::fs::read_dir(&self.scenes).into_iter().flatten();
        let mut names: Vec<String> = entries
            .filter_map(|entry| {
                let path = entry.ok()?.path();
                let ending = path.extension()?;
                let is_scene = ending == "toml" || ending == "vs3";
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
