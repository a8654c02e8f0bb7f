//! Surfaces that lie on others: what is said of them, where their power goes, and what is seen.

use crate::place::Place;
use std::fs;

/// A closed room with a lamp in the plane of the ceiling, seen from below.
fn room(mode: &str) -> String {
    let wall = |name: &str, corner: &str, edge_a: &str, edge_b: &str| {
        format!(
            "[[surfaces]]\nname = \"{name}\"\nmaterial = \"white\"\n\
             parallelogram = {{ corner = {corner}, \
             edge_a = {edge_a}, edge_b = {edge_b} }}\n"
        )
    };
    let (o, far) = ("[0, 0, 0]", "[2, 3, 1]");
    let walls = [
        wall("floor", o, "[2, 0, 0]", "[0, 3, 0]"),
        wall("left", o, "[0, 3, 0]", "[0, 0, 1]"),
        wall("front", o, "[0, 0, 1]", "[2, 0, 0]"),
        wall("ceiling", far, "[0, -3, 0]", "[-2, 0, 0]"),
        wall("right", far, "[0, 0, -1]", "[0, -3, 0]"),
        wall("back", far, "[-2, 0, 0]", "[0, 0, -1]"),
        wall("lamp", "[1.3, 2.1, 1]", "[0, -1.4, 0]", "[-0.8, 0, 0]").replace("white", "lamp"),
    ];
    format!(
        "[camera]\nposition = [0.9, 1.4, 0.2]\nlook_at = [0.9, 1.4, 1]\nup = [0, 1, 0]\n\
         vertical_fov = 20\n\
         [image]\nwidth = 24\nheight = 24\n[discretization]\ndivisions = 5\n\
         [form_factors]\nmode = \"{mode}\"\n\
         [materials.white]\nreflectance = 0.6\n[materials.lamp]\nreflectance = 0\nemission = 1\n{}",
        walls.concat()
    )
}

fn place(mode: &str) -> Place {
    let place = Place::new();
    place.write("room.toml", &room(mode));
    place
}

#[test]
fn all_power_is_absorbed() {
    let report = place("accurate").json("solve room.toml --no-cache");
    let energy = &report["stages"]["solve"]["energy_balance"];
    let watts = |of: &str| energy[of][0].as_f64().unwrap();
    assert!((watts("emitted") - 1.4 * 0.8).abs() < 1e-9);
    assert!((watts("absorbed") / watts("emitted") - 1.0).abs() < 1e-4);
    assert_eq!(report["stages"]["form_factors"]["rows_unbalanced"], 0);
}

#[test]
fn surfaces_are_named() {
    let place_of = |mode: &str| {
        let (_, _, stderr) = place(mode).run("form-factors room.toml --no-cache");
        stderr
    };
    let note = place_of("accurate");
    assert!(note.contains("note: `lamp` lies on `ceiling`"), "{note}");
    let warning = place_of("regular");
    assert!(
        warning.contains("warning: `lamp` lies on `ceiling`"),
        "{warning}"
    );
    for (mode, note) in [("accurate", note), ("regular", warning)] {
        let line = note.lines().find(|line| line.contains("lies on")).unwrap();
        let said = place(mode).succeed("check room.toml");
        assert!(said.contains(line), "{said}");
    }
}

/// Of the only picture, by channel.
fn radiances(place: &Place) -> Vec<f32> {
    let file = fs::read_dir(place.path("out")).unwrap().next().unwrap();
    let bytes = fs::read(file.unwrap().path()).unwrap();
    let pixels = bytes[bytes.len() - 24 * 24 * 12..].as_chunks::<4>().0;
    pixels
        .iter()
        .map(|&bytes| f32::from_le_bytes(bytes))
        .collect()
}

/// In one plane rounding would decide, pixel by pixel.
#[test]
fn pictures_show_what_lies_on_top() {
    for mode in ["accurate", "regular"] {
        let place = place(mode);
        place.json("render room.toml --no-cache --shading constant --format pfm --output out");
        let radiances = radiances(&place);
        // The lamp fills the picture, and reflects nothing.
        let first = radiances[0];
        assert!(
            first > 0.0 && radiances.iter().all(|r| *r == first),
            "{mode} {radiances:?}"
        );
    }
}

/// A wall of two faces with a picture and another on it: from the front no back is seen.
#[test]
fn walls_of_two_faces_show_what_lies_on_them() {
    let quad = |name: &str, [low, high]: [f64; 2], is_front: bool| {
        let mut corners = [
            [low, low, 0.0],
            [high, low, 0.0],
            [high, high, 0.0],
            [low, high, 0.0],
        ];
        if !is_front {
            corners.reverse();
        }
        format!("[[surfaces]]\nname = \"{name}\"\nmaterial = \"lamp\"\nquad = {corners:?}\n")
    };
    let mut faces = [
        quad("back", [-2.0, 2.0], false),
        quad("front", [-2.0, 2.0], true),
        quad("picture", [-0.2, 0.3], true),
        quad("stamp", [-0.1, 0.1], true),
    ];
    for turn in 0..4 {
        faces.rotate_left(turn);
        let place = Place::new();
        let text = format!(
            "[camera]\nposition = [0.1, 0.2, 1]\nlook_at = [0, 0, 0]\nvertical_fov = 40\n\
             [image]\nwidth = 24\nheight = 24\n[materials.lamp]\nreflectance = 0\nemission = 1\n{}",
            faces.concat()
        );
        place.write("room.toml", &text);
        place.json(
            "render room.toml --no-cache --patches 2 --shading constant --format pfm --output out",
        );
        let radiances = radiances(&place);
        assert!(
            radiances.iter().all(|r| *r == radiances[0] && *r > 0.0),
            "{turn} {radiances:?}"
        );
    }
}
