//! Rooms with one fault each, in View3D's format: which surfaces are named.

use super::*;
use crate::{Context, Project, subdivide};

/// The faces of a room of 2 x 3 x 1 by corners 0 to 7, of which bits tell the coordinates, but for
/// its lid; turned inwards.
const ROOM: [(&str, &[usize]); 5] = [
    ("floor", &[0, 1, 3, 2]),
    ("left", &[0, 2, 6, 4]),
    ("right", &[1, 5, 7, 3]),
    ("front", &[0, 4, 5, 1]),
    ("back", &[2, 3, 7, 6]),
];
const LID: (&str, &[usize]) = ("lid", &[4, 6, 7, 5]);
/// Where further vertices are.
const MORE: usize = 8;

type Face<'a> = (&'a str, &'a [usize]);

/// The warnings of a scene of these faces between the corners of the room and more vertices.
fn warned(faces: &[Face<'_>], more: &[[f64; 3]]) -> Vec<String> {
    let corner = |k: usize| [2 * (k & 1), 3 * (k >> 1 & 1), k >> 2].map(|x| x as f64);
    let vertices: Vec<[f64; 3]> = (0..MORE).map(corner).chain(more.iter().copied()).collect();
    let mut text = "T a room\nC encl=1\nF 3\n".to_owned();
    for (k, [x, y, z]) in vertices.iter().enumerate() {
        text += &format!("V {} {x} {y} {z}\n", k + 1);
    }
    for (k, (name, corners)) in faces.iter().enumerate() {
        let vertex = |n: usize| corners.get(n).map_or(0, |corner| corner + 1);
        let [a, b, c, d] = [0, 1, 2, 3].map(vertex);
        text += &format!("S {} {a} {b} {c} {d} 0 0 0.9 {name}\n", k + 1);
    }
    let project = Project::parse("room.vs3".as_ref(), &text).unwrap();
    let params = &project.params.discretization;
    let patches = subdivide(&project.scene, params, Context::default()).unwrap();
    warnings(&project.scene, &patches.mesh)
}

/// The one warning there is.
fn only(warnings: &[String]) -> &str {
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    warnings[0]
        .strip_prefix("warning: the scene calls itself closed and is not: ")
        .unwrap()
}

/// A box without a bottom, whose lower corners stand on the floor of the room.
const BOX_CORNERS: [[f64; 3]; 8] = [
    [0.5, 1.0, 0.0],
    [1.5, 1.0, 0.0],
    [0.5, 2.0, 0.0],
    [1.5, 2.0, 0.0],
    [0.5, 1.0, 0.4],
    [1.5, 1.0, 0.4],
    [0.5, 2.0, 0.4],
    [1.5, 2.0, 0.4],
];
const BOX: [Face<'static>; 5] = [
    ("top", &[12, 13, 15, 14]),
    ("west", &[8, 12, 14, 10]),
    ("east", &[9, 11, 15, 13]),
    ("south", &[8, 9, 13, 12]),
    ("north", &[10, 14, 15, 11]),
];

#[test]
fn a_box_on_the_floor_does_not_bound_the_hole_above() {
    let mut faces = [&ROOM[..], &BOX[..]].concat();
    let warned_open = warned(&faces, &BOX_CORNERS);
    assert_eq!(
        only(&warned_open),
        "edges of `back`, `front`, `left`, `right` have no neighbour: a surface is missing there, \
         or corners do not meet"
    );
    faces.push(LID);
    assert!(warned(&faces, &BOX_CORNERS).is_empty());
    // Without its top the box is a hole.
    faces.retain(|(name, _)| *name != "top");
    let warned_box = warned(&faces, &BOX_CORNERS);
    let expected = "edges of `east`, `north`, `south`, `west` have no neighbour";
    assert!(only(&warned_box).starts_with(expected), "{warned_box:?}");
}

/// A box that is lifted by more than files round to stands on nothing.
#[test]
fn a_box_above_the_floor_is_open_below() {
    let faces = [&ROOM[..], &[LID], &BOX[..]].concat();
    let lifted = |height: f64| BOX_CORNERS.map(|[x, y, z]| [x, y, z + height]);
    assert!(warned(&faces, &lifted(1e-6)).is_empty());
    let warned = warned(&faces, &lifted(1e-3));
    let expected = "edges of `east`, `north`, `south`, `west` have no neighbour";
    assert!(only(&warned).starts_with(expected), "{warned:?}");
}

/// The right wall is in two halves, beside a floor and a lid of one piece.
#[test]
fn long_edges_may_run_along_several_short_ones() {
    let halves: [Face<'_>; 2] = [("right-1", &[1, 5, 9, 8]), ("right-2", &[8, 9, 7, 3])];
    let mut faces = [&ROOM[..], &[LID], &halves[..]].concat();
    faces.retain(|(name, _)| *name != "right");
    let middle = [[2.0, 1.0, 0.0], [2.0, 1.0, 1.0]];
    assert!(warned(&faces, &middle).is_empty());
    faces.retain(|(name, _)| *name != "right-2");
    let warned = warned(&faces, &middle);
    let expected = "edges of `back`, `floor`, `lid`, `right-1` have no neighbour";
    assert!(only(&warned).starts_with(expected), "{warned:?}");
}

/// Each triangle of the lid and each wall beside it has one edge where they do not agree.
#[test]
fn of_a_turned_lid_the_walls_are_not_named() {
    let lid: [Face<'_>; 4] = [
        ("lid-1", &[6, 4, 8]),
        ("lid-2", &[7, 6, 8]),
        ("lid-3", &[5, 7, 8]),
        ("lid-4", &[4, 5, 8]),
    ];
    let faces = [&ROOM[..], &lid[..]].concat();
    let warned = warned(&faces, &[[1.0, 1.5, 1.0]]);
    assert_eq!(
        only(&warned),
        "`lid-1`, `lid-2`, `lid-3`, `lid-4` face the other way than their neighbours: reverse the \
         order of the corners"
    );
}

/// Three walls and the three across from them: nothing tells which half is right.
#[test]
fn of_two_equal_sides_both_are_named() {
    let mut faces = [&ROOM[..], &[LID]].concat();
    let turned: [Face<'_>; 3] = [
        ("lid", &[5, 7, 6, 4]),
        ("right", &[3, 7, 5, 1]),
        ("back", &[6, 7, 3, 2]),
    ];
    for (name, corners) in turned {
        let face = faces.iter_mut().find(|face| face.0 == name);
        face.unwrap().1 = corners;
    }
    let warned = warned(&faces, &[]);
    assert_eq!(
        only(&warned),
        "`back`, `floor`, `front`, `left`, `lid`, `right` face the other way than their \
         neighbours: reverse the order of the corners of those that face outwards"
    );
}

#[test]
fn turned_faces_and_holes_are_both_told() {
    let mut faces = ROOM.to_vec();
    faces[1].1 = &[4, 6, 2, 0];
    let warned = warned(&faces, &[]);
    assert_eq!(warned.len(), 2, "{warned:?}");
    assert!(
        warned[0].contains("`left` faces the other way"),
        "{warned:?}"
    );
    assert!(
        warned[1].contains("edges of `back`, `front`, `left`, `right` have"),
        "{warned:?}"
    );
}
