//! What the documents show is run: commands and scenes. Programs are compiled by the doc tests of
//! `radiosity`.

use crate::place::Place;
use std::fs;
use std::path::{Path, PathBuf};

/// The root of the checkout.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The documents for users.
fn documents() -> Vec<(String, String)> {
    let folder = fs::read_dir(root().join("docs")).unwrap();
    let pages = folder.map(|entry| entry.unwrap().path());
    let pages = pages.filter(|path| path.extension().is_some_and(|ending| ending == "md"));
    let all = pages.chain([root().join("README.md")]);
    let text = |path: PathBuf| {
        (
            path.display().to_string(),
            fs::read_to_string(path).unwrap(),
        )
    };
    let mut documents: Vec<_> = all.map(text).collect();
    documents.sort();
    documents
}

/// The blocks of a language in a document.
fn blocks<'t>(text: &'t str, language: &str) -> Vec<&'t str> {
    let fence = format!("```{language}\n");
    let after = text.split(&fence).skip(1);
    after
        .map(|rest| rest.split("```").next().unwrap())
        .collect()
}

/// The scene that the documents show, the mesh that it needs, and one of View3D.
fn place() -> Place {
    let place = Place::new();
    let scenes = fs::read_to_string(root().join("docs/scenes.md")).unwrap();
    place.write("room.toml", blocks(&scenes, "toml")[0]);
    let block = fs::read_to_string(place.path("block.obj")).unwrap();
    place.write("statue.obj", &block.replacen("f ", "g base\nf ", 1));
    let (vertices, faces) = block.split_once("f ").unwrap();
    let (first, others) = faces.split_once('\n').unwrap();
    let of_blender = format!("{vertices}usemtl Lamp\nf {first}\nusemtl Red.001\n{others}");
    place.write("myroom.obj", &of_blender);
    let square = |k: u32, z: u32, order: [u32; 4]| {
        let corners = [[0, 0], [1, 0], [1, 1], [0, 1]];
        let lines = (1u32..).zip(corners);
        let vertices: String = lines
            .map(|(n, [x, y])| format!("V {} {x} {y} {z}\n", 4 * k + n))
            .collect();
        let [a, b, c, d] = order.map(|n| 4 * k + n);
        format!("{vertices}S {} {a} {b} {c} {d} 0 0 0.9 plate-{k}\n", k + 1)
    };
    let plates = square(0, 0, [1, 2, 3, 4]) + &square(1, 1, [4, 3, 2, 1]);
    place.write("room.vs3", &format!("F 3\n{plates}"));
    place
}

/// The arguments of the commands that a document shows; those of other programs are left out.
fn commands(text: &str) -> Vec<String> {
    let lines = blocks(text, "console").into_iter().flat_map(str::lines);
    let commands = lines.filter_map(|line| line.strip_prefix("$ "));
    let without_comment = commands.map(|line| line.split(" #").next().unwrap().trim());
    let arguments = without_comment.filter_map(|line| {
        let arguments = line.strip_prefix("radiosity ");
        arguments.or_else(|| line.strip_prefix("cargo xtask "))
    });
    // A chore of the checkout.
    let of_command = arguments.filter(|line| *line != "ci");
    of_command.map(str::to_owned).collect()
}

#[test]
fn commands_in_documents_succeed() {
    let place = place();
    let mut count = 0;
    for (path, text) in documents() {
        for arguments in commands(&text) {
            let (code, _, stderr) = place.run(&arguments);
            assert_eq!(code, 0, "{path}: {arguments}\n{stderr}");
            count += 1;
        }
    }
    assert!(count > 15, "{count} commands were found");
}

/// Whole scenes as they are, parts of scenes behind the scene that the documents show.
#[test]
fn scenes_in_documents_are_read() {
    let place = place();
    let whole = fs::read_to_string(place.path("room.toml")).unwrap();
    let mut count = 0;
    for (path, text) in documents() {
        for scene in blocks(&text, "toml") {
            let lit = "[[surfaces]]\nname = \"tube\"\nmaterial = \"tube\"\n\
                quad = [[0, 2, 0], [1, 2, 0], [1, 2, 1], [0, 2, 1]]\n";
            let scene = match scene {
                _ if scene.contains("[[surfaces]]") => scene.to_owned(),
                _ if scene.contains("[materials.tube]") => format!("{whole}\n{lit}\n{scene}"),
                _ => format!("{whole}\n{scene}"),
            };
            place.write("snippet.toml", &scene);
            let (code, _, stderr) = place.run("check snippet.toml");
            assert_eq!(code, 0, "{path}: {stderr}");
            count += 1;
        }
    }
    assert!(count >= 3, "{count} scenes were found");
}
