//! What is said of black pictures, and of closed scenes that are not.

use crate::place::Place;
use crate::room::{BOX, ORDINARY, Room, corner, place, text_of};

fn said(place: &Place, command: &str) -> String {
    let (code, stdout, stderr) = place.run(command);
    assert_eq!(code, 0, "{stderr}");
    stdout + &stderr
}

const RENDER: &str = "render room.toml --no-cache --shading constant --output out";

#[test]
fn nothing_is_said_of_ordinary_pictures() {
    let said = said(&place(&ORDINARY), RENDER);
    assert!(!said.contains("warning"), "{said}");
}

#[test]
fn walls_turned_outwards_are_named() {
    let place = place(&Room {
        inwards: false,
        ..ORDINARY
    });
    let found = said(&place, RENDER);
    assert!(found.contains("% of the light meets backs"), "{found}");
    assert!(
        found.contains("lamps shine on those of `back`, `floor`, `front`, `left`, `right`"),
        "{found}"
    );
    assert!(
        found.contains("is black: the camera sees only backs, of `back`"),
        "{found}"
    );
    let solved = said(&place, "solve room.toml --no-cache");
    assert!(solved.contains("lamps shine on those of"), "{solved}");
}

#[test]
fn scenes_without_light_are_told() {
    let place_of = |emission| {
        place(&Room {
            emission,
            ..ORDINARY
        })
    };
    for command in [RENDER, "solve room.toml --no-cache", "check room.toml"] {
        let found = said(&place_of(0.0), command);
        assert!(found.contains("warning: nothing emits light"), "{found}");
    }
    let dimmed = place_of(1.0);
    dimmed.write(
        "room.toml",
        &format!("{}[lights.lamp]\ndim = 0\n", text_of(&ORDINARY)),
    );
    let found = said(&dimmed, "check room.toml");
    assert!(
        found.contains("warning: all lights are dimmed to nothing"),
        "{found}"
    );
    let dark = said(&place_of(1.0), "solve room.toml --no-cache --dim lamp=0");
    assert!(
        dark.contains("warning: all lights are dimmed to nothing"),
        "{dark}"
    );
}

/// A lamp that is red alone has nothing left once its red is taken.
#[test]
fn lights_that_are_tinted_to_nothing_are_told() {
    let (place, text) = (place(&ORDINARY), text_of(&ORDINARY));
    let red = text.replace("emission = 1", "emission = [1, 0, 0]");
    place.write("red.toml", &red);
    place.write(
        "tinted.toml",
        &format!("{red}[lights.lamp]\ntint = [0, 1, 1]\n"),
    );
    let expected = "warning: nothing is left of the lights as they are dimmed and tinted";
    for command in [
        "solve red.toml --no-cache --tint lamp=0,1,1",
        "solve tinted.toml --no-cache",
        "check tinted.toml",
    ] {
        let found = said(&place, command);
        assert!(found.contains(expected), "{command}: {found}");
    }
    for command in ["solve red.toml --no-cache", "check red.toml"] {
        let found = said(&place, command);
        assert!(!found.contains("warning"), "{command}: {found}");
    }
}

/// Of two faces in one plane the smaller one counts, or the later one of equal ones: a shade over
/// all of the lamp takes its light, one over half of it does not.
#[test]
fn covered_lamps_are_told() {
    let (place, text) = (place(&ORDINARY), text_of(&ORDINARY));
    let shade = |from: f64| {
        format!(
            "{text}[[surfaces]]\nname = \"shade\"\nmaterial = \"white\"\n\
             quad = [[{from}, 0.5, 1], [{from}, 2.5, 1], [1.5, 2.5, 1], [1.5, 0.5, 1]]\n"
        )
    };
    place.write("whole.toml", &shade(0.5));
    place.write("half.toml", &shade(1.0));
    let accurate = "solve whole.toml --no-cache --mode accurate";
    for command in [accurate, "check whole.toml"] {
        let found = said(&place, command);
        assert!(
            found.contains("warning: other surfaces cover all that emits light"),
            "{command}: {found}"
        );
    }
    for command in [
        "solve half.toml --no-cache",
        "check half.toml",
        "solve whole.toml --no-cache --mode regular",
    ] {
        let found = said(&place, command);
        assert!(!found.contains("black"), "{command}: {found}");
    }
}

/// A lamp that faces out of a room without a ceiling.
#[test]
fn light_that_leaves_the_scene_is_told() {
    let (place, text) = (place(&ORDINARY), text_of(&ORDINARY));
    let down = "[0.5, 0.5, 1.0], [0.5, 2.5, 1.0], [1.5, 2.5, 1.0], [1.5, 0.5, 1.0]";
    let up = "[1.5, 0.5, 1.0], [1.5, 2.5, 1.0], [0.5, 2.5, 1.0], [0.5, 0.5, 1.0]";
    assert!(text.contains(down));
    place.write("out.toml", &text.replace(down, up));
    let found = said(&place, "solve out.toml --no-cache");
    assert!(
        found.contains("warning: 100 % of the light leaves the scene: lamps may face outwards"),
        "{found}"
    );
    let found = said(&place, "solve room.toml --no-cache");
    assert!(!found.contains("warning"), "{found}");
}

#[test]
fn cameras_that_see_nothing_are_told() {
    let (beside, text) = (place(&ORDINARY), text_of(&ORDINARY));
    beside.write(
        "room.toml",
        &text
            .replace("[1, 1.5, 0.5]", "[1, 9, 0.5]")
            .replace("[1.0, 3.0, 0.5]", "[1, 12, 0.5]"),
    );
    let found = said(&beside, RENDER);
    assert!(
        found.contains("is black: the camera sees nothing: move it"),
        "{found}"
    );
}

/// View3D's scenes say whether they are closed.
#[test]
fn closed_scenes_with_holes_or_turned_walls_are_told() {
    let place = Place::new();
    let scene = |walls: &[(&str, [u32; 4])]| {
        let vertices = (0..8).map(|k| {
            let [x, y, z] = corner(k);
            format!("V {} {x} {y} {z}\n", k + 1)
        });
        let surfaces = walls.iter().zip(1..).map(|((name, corners), number)| {
            let [a, b, c, d] = corners.map(|corner| corner + 1);
            format!("S {number} {a} {b} {c} {d} 0 0 0.9 {name}\n")
        });
        let parts: [String; 2] = [vertices.collect(), surfaces.collect()];
        format!("T a box\nC encl=1\nF 3\n{}End\n", parts.concat())
    };
    let lid = ("lid", [4, 6, 7, 5]);
    let mut walls = BOX.to_vec();
    place.write("box.vs3", &scene(&walls));
    // What rows tell after the form factors, `check` tells before them, in the same words.
    let run = |place: &Place| {
        let warnings = |text: String| -> Vec<String> {
            let lines = text.lines().filter(|line| line.contains("warning"));
            lines.map(str::to_owned).collect()
        };
        let after = warnings(said(place, "form-factors box.vs3 --no-cache"));
        assert_eq!(warnings(said(place, "check box.vs3")), after);
        after.concat()
    };
    let found = run(&place);
    assert!(
        found.contains("calls itself closed and is not: edges of `back`, `front`, `left`, `right`"),
        "{found}"
    );
    walls.push(lid);
    place.write("box.vs3", &scene(&walls));
    assert!(!run(&place).contains("warning"));
    // A plate in the middle of the box, which only blocks, opens nothing.
    let plate = "V 9 0.5 0.5 0.5\nV 10 1.5 0.5 0.5\nV 11 1.5 1.5 0.5\n\
        O 7 9 10 11 0 0 0 0.9 plate\nEnd\n";
    place.write("box.vs3", &scene(&walls).replace("End\n", plate));
    assert!(!run(&place).contains("warning"));
    walls[5].1.reverse();
    place.write("box.vs3", &scene(&walls));
    let found = run(&place);
    assert!(
        found.contains("`lid` faces the other way than its neighbours"),
        "{found}"
    );
}
