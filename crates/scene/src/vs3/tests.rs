//! What View3D's files mean, and what is said of wrong ones.

use crate::Scene;
use crate::tests::Parsed;
use proptest::prelude::*;
use radiosity_geometry::{Discretization, Mesh, subdivide};
use std::fmt::Write;
use std::path::Path;

/// A floor with a rug on it, a lid that is a triangle, and a screen.
const GOOD: &str = "T a room, or less / with a title
! a comment
C encl=1 eps=0.0001
F 3
V 1 0 0 0
V 2 2 0 0   ! the end of a line
V 3 2 2 0
V 4 0 2 0
v 5 0.5 0.5 0
V 6 1.5 0.5 0
V 7 1.5 1.5 0
V 8 0.5 1.5 0
V 9 0 0 3
V 10 0 2 3
V 11 2 2 3
  S 1 1 2 3 4 0 0 0.9 floor
S 2 5 6 7 8 1 0 0.5 the rug / a comment
S 3 9 10 11 0 0 1 0.9 floor
O 4 5 6 7 8 0 0 0.9 screen
*
S 5 this is not read
";

fn parse(text: &str) -> Result<Parsed, String> {
    crate::tests::parse(Path::new("scenes/room.vs3"), text).map_err(|error| error.to_string())
}

fn mesh(scene: &Scene) -> Mesh {
    let params = Discretization::uniform(1);
    subdivide(&params.of_shapes(scene.shapes()), params.default).unwrap()
}

#[test]
fn a_file_means_what_it_says() {
    let scene = parse(GOOD).unwrap();
    assert_eq!(scene.name, "room");
    assert!(scene.closed && scene.camera.is_none());
    assert_eq!(scene.notes, ["`C eps=0.0001` in line 3 is not used"]);
    let names: Vec<[&str; 2]> = scene
        .surfaces
        .iter()
        .map(|surface| [&surface.name[..], &surface.group[..]])
        .collect();
    let expected = [
        ["floor (1)", "floor (1)"],
        ["the rug", "the rug"],
        ["floor (3)", "floor (1)"],
        ["screen", "screen"],
    ];
    assert_eq!(names, expected);
    let reflectance =
        |surface: usize| scene.materials[scene.surfaces[surface].materials[0]].reflectance[0];
    assert!((reflectance(0) - 0.1).abs() < 1e-12 && reflectance(1) == 0.5);
    assert!(scene.surfaces[3].is_obstruction);
}

#[test]
fn a_base_lacks_what_lies_on_it() {
    let mesh = mesh(&parse(GOOD).unwrap());
    let area = |surface: usize| {
        let of_it = mesh.patches.iter().filter(|p| p.surface.index() == surface);
        of_it.map(|patch| patch.area).sum::<f64>()
    };
    let areas = [0, 1, 2, 3].map(area);
    let expected = [3.0, 1.0, 2.0, 0.0];
    assert!(
        areas
            .iter()
            .zip(expected)
            .all(|(a, b)| (a - b).abs() < 1e-12),
        "{areas:?}"
    );
    let up = |surface: usize| mesh.patches.iter().find(|p| p.surface.index() == surface);
    assert_eq!([0, 1, 2].map(|k| up(k).unwrap().normal.z), [1.0, 1.0, -1.0]);
}

#[test]
fn a_covered_base_has_no_row() {
    let text = GOOD.replace("S 2 5 6 7 8 1 0", "S 2 1 2 3 4 1 0");
    let scene = parse(&text).unwrap();
    let names: Vec<&str> = scene
        .surfaces
        .iter()
        .map(|surface| &surface.name[..])
        .collect();
    assert_eq!(names, ["the rug", "floor (3)", "screen"]);
    assert_eq!(
        scene.notes[1],
        "surface 1 is covered by those on it, and has no row"
    );
}

#[test]
fn an_obstruction_may_be_a_base() {
    let text = GOOD.replace(
        "O 4 5 6 7 8 0 0 0.9 screen",
        "S 5 5 6 7 8 4 0 1 picture\nO 4 1 2 3 4",
    );
    assert_eq!(mesh(&parse(&text).unwrap()).faces.len(), 4 + 4);
}

/// Commas and `=` part words, only the first letter of a line counts, and DOS leaves its marks.
#[test]
fn lines_are_read_as_view3d_does() {
    let controls = |line: &str| parse(&GOOD.replace("C encl=1 eps=0.0001", line)).unwrap();
    assert!(!controls("C encl=0,list=2").closed);
    assert!(controls("C encl = 1").closed);
    let scene = controls("C encl=1,eps=1e-4");
    assert_eq!(scene.notes, ["`C eps=1e-4` in line 3 is not used"]);
    let text = GOOD
        .replace("V 1 0 0 0", "Vertex 1 0,0, 0\nX nothing")
        .replace("*\n", "End of data\n");
    let areas = |text: &str| mesh(&parse(text).unwrap()).total_area();
    assert_eq!(areas(&text), areas(GOOD));
    assert_eq!(
        areas(&format!("\u{feff}{}", GOOD.replace("*\n", "\u{1a}\n"))),
        areas(GOOD)
    );
}

/// One mistake per line; the messages are in the snapshot, to be read as a user would.
#[test]
fn mistakes_are_explained() {
    let mistakes = [
        ("F 3", "F 3a"),
        ("F 3", "F 2"),
        ("F 3", "M 1 1 2 3 4"),
        ("O 4 5 6 7 8", "Null 4 8 7 6 5"),
        ("F 3", "Q 1"),
        ("V 3 2 2 0", "V 3 2 2"),
        ("V 3 2 2 0", "V 3 2 two 0"),
        ("V 3 2 2 0", "V 3 2 nan 0"),
        ("V 3 2 2 0", "V 2 2 2 0"),
        ("V 3 2 2 0", "V 3 2,0 2,0 0,0"),
        ("V 3 2 2 0", "V 3 2 2 1"),
        ("S 1 1 2 3 4", "S 1 1 2 3 44"),
        ("S 1 1 2 3 4", "S 1 1 3 2 4"),
        ("S 1 1 2 3 4", "S 1 1 1 3 4"),
        ("0 0 0.9 floor", "0 0 1.9 floor"),
        ("0 0 0.9 floor", "0 0"),
        ("0 0 0.9 floor", "7 0 0.9 floor"),
        ("S 2 5 6 7 8 1 0", "S 1 5 6 7 8 1 0"),
        ("S 2 5 6 7 8 1 0", "S 2 5 6 7 8 2 0"),
        ("S 2 5 6 7 8 1 0", "S 2 8 7 6 5 1 0"),
        (
            "O 4 5 6 7 8 0 0 0.9 screen",
            "S 9 5 6 7 8 4 4 1\nO 4 5 6 7 8",
        ),
        ("O 4 5 6 7 8 0 0 0.9 screen", "S 9 5 6 7 8 1 0 1"),
        ("V 7 1.5 1.5 0", "V 7 2.5 2.5 0"),
        (
            "V 7 1.5 1.5 0\nV 8 0.5 1.5 0",
            "V 7 1.5 1.5 1\nV 8 0.5 1.5 1",
        ),
        ("V 1 0 0 0", "E"),
    ];
    let mut report = String::new();
    for (from, to) in mistakes {
        assert!(GOOD.contains(from), "{from}");
        let error = parse(&GOOD.replacen(from, to, 1)).expect_err(to);
        let line = |text: &str| text.replace('\n', " | ");
        writeln!(report, "{}  =>  {}\n{error}\n", line(from), line(to)).unwrap();
    }
    insta::assert_snapshot!(report);
}

proptest! {
    /// Whatever a damaged file says: an error or a scene, never a panic.
    #[test]
    fn damaged_files_do_no_harm(at in 0usize..450, cut in 0usize..20, insert in "[ -~\n]{0,8}") {
        let mut text = GOOD.to_owned();
        let start = at.min(text.len());
        let end = (start + cut).min(text.len());
        text.replace_range(start..end, &insert);
        if let Ok(scene) = parse(&text) {
            let params = Discretization::uniform(1);
            let _ = subdivide(&params.of_shapes(scene.shapes()), params.default);
        }
    }
}
