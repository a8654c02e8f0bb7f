//! What OBJ files say, and what of them says nothing.
//!
//! Long because: one test for each thing that a file may say.

use super::Parsed;
use super::meshes::MeshScene;
use crate::Scene;
use radiosity_geometry::{DVec3, PolygonMesh, Shape};

fn read(obj: impl AsRef<[u8]>) -> Result<Parsed, String> {
    MeshScene::new(obj).parse("model.obj", " }")
}

fn mesh(scene: &Scene) -> &PolygonMesh {
    match &scene.surfaces[0].shape {
        Shape::Mesh(mesh) => mesh,
        _ => panic!("no mesh"),
    }
}

/// How many corners each face has.
fn corner_counts(scene: &Scene) -> Vec<usize> {
    mesh(scene).faces.iter().map(Vec::len).collect()
}

/// The sum of the areas of faces; as vectors, so that those that face back count against it.
fn area(scene: &Scene) -> DVec3 {
    let polygons = scene.surfaces[0].shape.polygons().unwrap();
    polygons.iter().map(|(_, p)| p.area_vector()).sum()
}

/// A rectangle of area 6 that faces up.
const PLATE: &str = "v 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\nf 1 2 3 4\n";

#[track_caller]
fn assert_is_plate(obj: impl AsRef<[u8]>) -> Parsed {
    let scene = read(obj).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(corner_counts(&scene), [4]);
    assert_eq!(area(&scene), DVec3::new(0.0, 0.0, 6.0));
    scene
}

#[test]
fn marks_and_ends_of_lines_are_no_part_of_a_file() {
    assert_is_plate(format!("\u{feff}{PLATE}"));
    assert_is_plate(PLATE.replace("v 3 2 0", "\u{feff}v 3 2 0"));
    assert_is_plate(PLATE.replace('\n', "\r\n"));
    assert_is_plate(PLATE.replace('\n', "\r"));
    assert_is_plate(PLATE.replacen('\n', "\r", 2));
}

#[test]
fn only_polygons_are_faces() {
    assert_is_plate(format!("{PLATE}v 9 9 9\nl 1 3 5\np 5\nl 2 4\n"));
}

#[test]
fn numbers_after_the_coordinates_change_nothing() {
    assert_is_plate(PLATE.replace(" 0\nv", " 0 0.25\nv"));
    assert_is_plate(PLATE.replacen(" 0\nv", " 0 1 0.5 0\nv", 1));
    assert_is_plate(PLATE.replace(" 0\nv", " 0 1 1 0 1 # ochre\nv"));
}

#[test]
fn what_no_face_uses_is_not_looked_at() {
    let unused =
        "vt -nan(ind)\nvt\nvn 1 0\nvp x\ns off\nusemtl\nusemtl \ng\nmtllib\nv 1 2\nv nan 0 0\n";
    let scene = assert_is_plate(format!("{PLATE}{unused}"));
    assert!(scene.notes.is_empty(), "{:?}", scene.notes);
    assert_is_plate(PLATE.replace("f 1 2 3 4", "f 1//7 2//8 3/9/9 4/ # floor"));
    assert_is_plate(PLATE.replace("f 1 2 3 4", "fo -4 -3 \\\n -2 -1"));
    let error = read(PLATE.replace("v 3 2 0", "v 3 2,5 0")).unwrap_err();
    assert!(error.contains("decimals take a point") && error.contains("model.obj:3:1"));
    let error = read(PLATE.replace("v 3 2 0", "v 3 inf 0")).unwrap_err();
    assert!(error.contains("vertex 3 is out of range") && error.contains("model.obj:3:1"));
}

#[test]
fn what_is_not_known_is_noted() {
    let scene = assert_is_plate(format!("{PLATE}curv 0 1 1 2\ncurv 1 0\nend\n"));
    let note = "surface `thing`: model.obj: 3 statements are not known and left out, first `curv` \
                in line 6";
    assert_eq!(scene.notes, [note]);
}

#[test]
fn names_may_hold_number_signs() {
    let named = PLATE.replace("f 1", "usemtl Material #25 # b\nf 1");
    let scene = MeshScene::new(named);
    let extra = " }\nmaterials = { \"Material #25 # b\" = \"b\" }";
    assert!(scene.parse("model.obj", extra).is_ok());
}

#[test]
fn errors_point_to_their_lines() {
    for (face, message) in [
        ("f 0 1 2", "there is no vertex 0"),
        ("f 1 2 -5", "there is no vertex -5"),
        ("f 1 2 5", "there is no vertex 5"),
        ("f 1 2 x", "`x` is no vertex"),
    ] {
        let obj = PLATE.replace("f 1", &format!("g \\\n a\n{face}\nf 1"));
        let error = read(obj).unwrap_err();
        assert!(error.contains(message), "{error}");
        assert!(error.contains("model.obj:7:1"), "{error}");
    }
}

/// In the middle of an edge, twice, or on the way to a point and back.
#[test]
fn corners_that_turn_nothing_are_left_out() {
    let points = "v 1 0 0\nv 2 0 0\nv 3 0.7 0\nv 5 0 0\nv 0 2 0\n";
    for face in [
        "f 1 5 2 3 4",
        "f 5 6 2 3 4 1",
        "f 1 5 6 2 7 3 4",
        "f 1 2 2 3 4",
        "f 1 2 3 4 9 1",
        "f 1 2 8 2 3 4",
        "f 4 1 1 5 6 8 2 7 7 3 9 4",
    ] {
        assert_is_plate(PLATE.replace("f 1 2 3 4", &format!("{points}{face}")));
    }
}

/// In files of six digits corners lie beside their edges.
#[test]
fn rounding_makes_no_corners() {
    let area_of = |points: &str, face: &str| {
        let scene = read(PLATE.replace("f 1 2 3 4", &format!("{points}{face}"))).unwrap();
        assert!((area(&scene).z - 6.0).abs() < 1e-4);
        corner_counts(&scene)
    };
    let beside = "v 1 1e-6 0\nv 2 -1e-6 0\nv 3.000001 0.7 1e-6\n";
    assert_eq!(area_of(beside, "f 1 5 6 2 7 3 4"), [4]);
    // A slit of which the sides have changed places.
    let slit = "v 1.500001 0 0\nv 1.5 1 0\nv 1.499999 0 0\n";
    area_of(slit, "f 1 5 6 7 2 3 4");
    // Neither narrow faces nor short edges are rounding.
    let narrow = "v 0 0 0\nv 9 0 0\nv 9 1e-6 0\nv 0 1e-6 0\nv 4 2e-8 0\nf 1 2 3 4\nf 1 2 5\n";
    assert_eq!(corner_counts(&read(narrow).unwrap()), [4, 3]);
}

#[test]
fn faces_without_area_are_left_out_with_a_note() {
    let scene = assert_is_plate(format!(
        "{PLATE}v 6 0 0\nf 1 2 1\nf 1 2 5\nf 1 1 1 1\nf 2\nf\n"
    ));
    let note = "surface `thing`: model.obj: 5 faces without area left out, first at line 7";
    assert_eq!(scene.notes, [note]);
    assert_eq!(scene.surfaces[0].polygons, [0]);
}

#[test]
fn faces_that_cross_themselves_are_refused() {
    let star = "v 0 3 0\nv -2 -3 0\nv 3 1 0\nv -3 1 0\nv 2 -3 0\nf 1 2 3 4 5\n";
    for (obj, line) in [(PLATE.replace("f 1 2 3", "f 1 3 2"), 5), (star.into(), 6)] {
        let error = read(obj).unwrap_err();
        assert!(error.contains("this face crosses itself"), "{error}");
        assert!(error.contains(&format!("model.obj:{line}:1")), "{error}");
    }
}

/// The distance of each corner of a mesh from the inside of each edge is more than 0: where faces
/// meet, they share corners.
fn assert_no_corner_is_inside_an_edge(scene: &Scene) {
    let PolygonMesh { positions, faces } = mesh(scene);
    for face in faces {
        for (k, &from) in face.iter().enumerate() {
            let to = face[(k + 1) % face.len()];
            let [from, to] = [from, to].map(|corner| positions[corner as usize]);
            for &corner in faces.iter().flatten() {
                let corner = positions[corner as usize];
                let detour = from.distance(corner) + corner.distance(to) - from.distance(to);
                let is_end = corner == from || corner == to;
                assert!(is_end || detour > 1e-9, "{corner} on {from} to {to}");
            }
        }
    }
}

/// A wall of 6 x 2 in a quad, above it two of 3 x 1 that meet in the middle of its edge, and one of
/// 6 x 1 below, which has that edge's other corners as well.
#[test]
fn corners_on_edges_stay_where_other_faces_have_corners() {
    let walls = "v 0 0 0\nv 6 0 0\nv 6 2 0\nv 3 2 0\nv 0 2 0\nv 6 3 0\nv 3 3 0\nv 0 3 0\nv 2 0 0\n\
        v 0 -1 0\nv 6 -1 0\nv 3 2 0\n";
    let upper = "f 4 3 6 7\nf 5 12 7 8\n";
    let scene = read(format!("{walls}f 1 2 3 4 5\n{upper}f 10 11 2 9 1\n")).unwrap();
    assert_eq!(area(&scene), DVec3::new(0.0, 0.0, 12.0 + 6.0 + 6.0));
    assert_eq!(corner_counts(&scene), [3, 3, 3, 4, 4, 4]);
    assert_no_corner_is_inside_an_edge(&scene);
    let alone = read(format!("{walls}f 1 9 2 3 4 5\nf 10 11 2 9 1\n")).unwrap();
    assert_eq!(corner_counts(&alone), [4, 4]);
}

/// An L of which each edge has two such corners, and a triangle likewise.
#[test]
fn every_edge_may_have_such_corners() {
    let corners = [(0, 0), (6, 0), (6, 3), (3, 3), (3, 6), (0, 6)];
    for corners in [&corners[..], &[(0, 0), (6, 0), (0, 6)]] {
        let mut vertices = String::new();
        let mut tips = String::new();
        let count = 3 * corners.len();
        for (k, &(x, y)) in corners.iter().enumerate() {
            let (to_x, to_y) = corners[(k + 1) % corners.len()];
            for step in 0..3 {
                let at = |from: i32, to: i32| from + (to - from) * step / 3;
                vertices += &format!("v {} {} 0\n", at(x, to_x), at(y, to_y));
            }
            let (first, second) = (3 * k + 2, 3 * k + 3);
            tips += &format!("f {second} {first} {}\n", count + 1);
        }
        let all: Vec<String> = (1..=count).map(|k| k.to_string()).collect();
        let obj = format!("{vertices}v 1 1 5\nf {}\n{tips}", all.join(" "));
        let scene = read(obj).unwrap();
        assert_no_corner_is_inside_an_edge(&scene);
        let of_it = scene.surfaces[0].polygons.iter().filter(|&&k| k == 0);
        assert_eq!(of_it.count(), count - 2, "triangles of all corners");
    }
}

#[test]
fn the_size_of_a_polygon_does_not_matter() {
    let l = [(4, 0), (4, 2), (2, 2), (2, 4), (0, 4), (0, 0)];
    for size in [1e-18, 1e-7, 1.0, 1e12, 1e25] {
        let at = |&(x, y): &(i32, i32)| {
            format!("v {:e} {:e} 0\n", size * f64::from(x), size * f64::from(y))
        };
        let vertices: String = l.iter().map(at).collect();
        let scene = read(format!("{vertices}f 1 2 3 4 5 6\n")).unwrap();
        let error = (area(&scene).z / (12.0 * size * size) - 1.0).abs();
        assert!(error < 1e-12, "{size}: {error}");
    }
}

#[test]
fn other_formats_are_told_by_name() {
    let mut binary_stl = vec![b' '; 80];
    binary_stl.extend(1u32.to_le_bytes());
    binary_stl.extend([0; 50]);
    let utf_16: Vec<u8> = [0xff, 0xfe]
        .into_iter()
        .chain(PLATE.bytes().flat_map(|b| [b, 0]))
        .collect();
    for (bytes, name) in [
        (&binary_stl[..], "a binary STL file"),
        (b" solid a\n facet normal 0 0 1\n", "an ASCII STL file"),
        (&utf_16, "text in UTF-16"),
        (b"\x1f\x8b\x08\0\0", "compressed by gzip"),
        (b"PK\x03\x04", "a ZIP archive"),
        (b"ply\r\nformat", "a PLY file"),
        (b"glTF\x02\0\0\0", "a binary glTF file"),
        (b"{\n \"asset\": {}", "a JSON file (glTF or another)"),
        (b"<?xml version", "an XML file"),
        (b"OFF\n3 1 0", "an OFF file"),
        (b"MM\x01\0\0", "a binary file of a format that is not known"),
    ] {
        let error = read(bytes).unwrap_err();
        let expected = format!("the mesh is {name}");
        assert!(
            error.contains(&expected) && error.contains("help: "),
            "{error}"
        );
    }
}
