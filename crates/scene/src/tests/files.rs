//! Which files are read, and how much of them.

#![cfg(unix)]

use super::load;
use super::meshes::MeshScene;
use crate::{Help, MeshFiles};
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::Command;

const PLATE: &str = "v 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\nf 1 2 3 4\n";

fn make_pipe(path: &Path) {
    assert!(Command::new("mkfifo").arg(path).status().unwrap().success());
}

/// Opening a pipe that nobody writes to would wait for ever.
#[test]
fn pipes_devices_and_folders_are_not_opened() {
    let place = MeshScene::new(PLATE);
    make_pipe(&place.path("pipe.toml"));
    make_pipe(&place.path("pipe.obj"));
    symlink("/dev/zero", place.path("zero.vs3")).unwrap();
    for scene in ["pipe.toml", "zero.vs3"] {
        let error = load(&place.path(scene), MeshFiles::InFolder)
            .unwrap_err()
            .to_string();
        assert!(
            error.contains("cannot read the scene: it is a pipe or a device"),
            "{error}"
        );
    }
    let error = place.parse("pipe.obj", " }").unwrap_err();
    assert!(
        error.contains("cannot read the mesh `pipe.obj`: it is a pipe"),
        "{error}"
    );
    let error = place.parse(".", " }").unwrap_err();
    assert!(error.contains("it is a folder"), "{error}");
}

#[test]
fn meshes_are_in_the_folder_of_the_scene() {
    let (place, other) = (MeshScene::new(PLATE), MeshScene::new(PLATE));
    std::fs::create_dir(place.path("parts")).unwrap();
    std::fs::copy(place.path("model.obj"), place.path("parts/a.obj")).unwrap();
    symlink("../model.obj", place.path("parts/b.obj")).unwrap();
    symlink(other.path("model.obj"), place.path("c.obj")).unwrap();
    symlink(other.path(""), place.path("others")).unwrap();
    for inside in [
        "model.obj",
        "./parts/a.obj",
        "parts/../model.obj",
        "parts/b.obj",
    ] {
        place
            .parse(inside, " }")
            .unwrap_or_else(|error| panic!("{error}"));
    }
    let elsewhere = other.path("model.obj").display().to_string();
    for outside in ["c.obj", "others/model.obj", &elsewhere] {
        std::fs::write(place.path("scene.toml"), MeshScene::text(outside, " }")).unwrap();
        let error = load(&place.path("scene.toml"), MeshFiles::InFolder).unwrap_err();
        assert_eq!(error.title(), "the mesh is outside of the scene's folder");
        assert_eq!(error.help(), Some(&Help::MeshFolder));
        let scene = load(&place.path("scene.toml"), MeshFiles::Anywhere);
        assert_eq!(scene.unwrap().surfaces.len(), 1);
    }
}

#[test]
fn scenes_in_other_encodings_and_formats_are_told_apart() {
    let place = MeshScene::new(PLATE);
    let error = |bytes: &[u8]| {
        std::fs::write(place.path("scene.toml"), bytes).unwrap();
        let error = load(&place.path("scene.toml"), MeshFiles::InFolder);
        error.unwrap_err().to_string()
    };
    let in_utf_16 = error(b"\xff\xfe[\0m\0");
    assert!(
        in_utf_16.contains("the scene is text in UTF-16"),
        "{in_utf_16}"
    );
    assert!(in_utf_16.contains("save it as UTF-8"), "{in_utf_16}");
    let in_latin_1 = error(b"# caf\xe9\n");
    assert!(in_latin_1.contains("no text in UTF-8"), "{in_latin_1}");
    assert!(error(b"glTF\x02\0\0\0").contains("a binary glTF file"));
    let marked = format!("\u{feff}{}", MeshScene::text("model.obj", " }"));
    std::fs::write(place.path("scene.toml"), marked).unwrap();
    assert!(load(&place.path("scene.toml"), MeshFiles::InFolder).is_ok());
}
