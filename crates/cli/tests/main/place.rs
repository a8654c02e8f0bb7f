//! A folder with a scene, where the command runs.

#![allow(dead_code, reason = "each test file uses some of it")]

use assert_cmd::Command;
use serde_json::Value;
use std::fs;
use std::path::PathBuf;
use tempfile::TempDir;

/// A small room with a lamp, a triangle and a mesh.
pub(crate) const SCENE: &str = r#"
[camera]
position = [0.5, 0.5, 3]
look_at = [0.5, 0.5, 0]
vertical_fov = 30

[image]
width = 16
height = 12

[discretization]
divisions = 3

[materials.white]
reflectance = 0.7

[materials.lamp]
reflectance = 0
emission = [4, 3, 2]

[[surfaces]]
name = "floor"
material = "white"
parallelogram = { corner = [0, 0, 1], edge_a = [1, 0, 0], edge_b = [0, 0, -1] }

[[surfaces]]
name = "lamp, the only one"
material = "lamp"
divisions = 1
parallelogram = { corner = [0.3, 1, 0.3], edge_a = [0.4, 0, 0], edge_b = [0, 0, 0.4] }

[[surfaces]]
name = "wing"
material = "white"
divisions = 2
triangle = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]

[[surfaces]]
name = "block"
material = "white"
mesh = { file = "block.obj" }
"#;

const BLOCK: &str = "v 0.6 0.2 0.2\nv 0.9 0.2 0.2\nv 0.9 0.2 0.5\nv 0.6 0.2 0.5\n\
    v 0.6 0.4 0.35\nf 4 3 2 1\nf 1 5 4\nf 4 5 3\n";

/// A folder with the scene, where the command runs.
pub(crate) struct Place(pub(crate) TempDir);

impl Place {
    pub(crate) fn new() -> Place {
        let place = Place(TempDir::new().unwrap());
        place.write("room.toml", SCENE);
        place.write("block.obj", BLOCK);
        place
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).unwrap();
    }

    /// The paths of the artifacts in the cache `c`, by name.
    pub(crate) fn artifacts(&self) -> Vec<PathBuf> {
        let files = fs::read_dir(self.path("c")).into_iter().flatten();
        let mut paths: Vec<PathBuf> = files.map(|file| file.unwrap().path()).collect();
        paths.retain(|path| path.extension().is_some_and(|ending| ending == "bin"));
        paths.sort();
        paths
    }

    /// The path of the only artifact of a stage in the cache `c`.
    pub(crate) fn artifact(&self, stage: &str) -> PathBuf {
        let name = |path: &PathBuf| path.file_name().unwrap().to_string_lossy().into_owned();
        let mut artifacts = self.artifacts();
        artifacts.retain(|path| name(path).starts_with(&format!("{stage}-")));
        let [artifact] = <[PathBuf; 1]>::try_from(artifacts).expect("one file of the stage");
        artifact
    }

    /// Runs with `arguments` apart by spaces; exit code, standard output and error.
    pub(crate) fn run(&self, arguments: &str) -> (i32, String, String) {
        let output = self.command(arguments).output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        (
            output.status.code().unwrap(),
            text(output.stdout),
            text(output.stderr),
        )
    }

    pub(crate) fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_radiosity"));
        command
            .args(arguments.split_whitespace())
            .current_dir(self.0.path())
            .env("XDG_CACHE_HOME", self.path("platform-cache"));
        command
    }

    pub(crate) fn succeed(&self, arguments: &str) -> String {
        let (code, stdout, stderr) = self.run(arguments);
        assert_eq!(code, 0, "{arguments}: {stderr}");
        stdout
    }

    pub(crate) fn json(&self, arguments: &str) -> Value {
        let stdout = self.succeed(&format!("{arguments} --json"));
        assert_eq!(stdout.lines().count(), 1, "exactly one line: {stdout}");
        serde_json::from_str(&stdout).unwrap()
    }

    /// The message of a run that must fail, with its exit code.
    pub(crate) fn fail(&self, arguments: &str) -> (i32, String) {
        let (code, stdout, stderr) = self.run(arguments);
        assert_ne!(code, 0, "{arguments}: {stdout}");
        assert!(!stderr.contains("panicked"), "{stderr}");
        (
            code,
            stderr.replace(&self.0.path().display().to_string(), "PLACE"),
        )
    }
}
