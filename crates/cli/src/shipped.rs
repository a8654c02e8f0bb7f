//! The scenes of the folder `scenes/`, in the program: an installed command finds them by name,
//! wherever it runs.

use radiosity::scene::MeshFiles;
use radiosity::{Error, Project};
use std::path::Path;

macro_rules! in_scenes {
    ($include:ident, $file:literal) => {
        $include!(concat!("../../../scenes/", $file))
    };
}

const SCENES: [(&str, &str); 7] = [
    ("cornell", in_scenes!(include_str, "cornell.toml")),
    (
        "cornell-closed",
        in_scenes!(include_str, "cornell-closed.toml"),
    ),
    (
        "cornell-course",
        in_scenes!(include_str, "cornell-course.toml"),
    ),
    (
        "cornell-course-triangles",
        in_scenes!(include_str, "cornell-course-triangles.toml"),
    ),
    (
        "cornell-triangles",
        in_scenes!(include_str, "cornell-triangles.toml"),
    ),
    ("furnace", in_scenes!(include_str, "furnace.toml")),
    ("knot", in_scenes!(include_str, "knot.toml")),
];

const MESHES: MeshFiles =
    MeshFiles::InMemory(&[("knot.obj", in_scenes!(include_bytes, "knot.obj"))]);

/// What they are called.
pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    SCENES.iter().map(|(name, _)| *name)
}

/// The scene of this name, if there is one.
pub(crate) fn open(name: &Path) -> Option<Result<Project, Error>> {
    let (name, text) = SCENES.iter().find(|(known, _)| name == Path::new(known))?;
    let path = format!("{name}.toml");
    Some(Project::parse_with(path.as_ref(), text, MESHES))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All files of the folder are in the program, as they are.
    #[test]
    fn shipped_scenes_are_those_of_the_folder() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
        let entries = std::fs::read_dir(&folder).unwrap();
        let paths = entries.map(|entry| entry.unwrap().path());
        let scenes = paths.filter(|path| path.extension().is_some_and(|ending| ending == "toml"));
        let mut found: Vec<String> = scenes
            .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
            .collect();
        found.sort();
        assert_eq!(found, names().collect::<Vec<_>>());
        for name in names() {
            let from_file = Project::open(&folder.join(format!("{name}.toml"))).unwrap();
            let from_program = open(Path::new(name)).unwrap().unwrap();
            assert_eq!(format!("{from_program:?}"), format!("{from_file:?}"));
        }
    }
}
