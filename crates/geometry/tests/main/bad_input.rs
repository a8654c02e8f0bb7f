//! Shapes and divisions that cannot be cut are named, with what is wrong.

use crate::subdivision::triangle;
use radiosity_geometry::{
    DVec3, Divisions, MeshError, PolygonMesh, Shape, ShapeError, Surface, SurfaceId, subdivide,
};
use radiosity_test_kit::{parallelogram, quad, surface, surfaces};

#[test]
fn bad_shapes_are_explained() {
    let nan = DVec3::new(f64::NAN, 0.0, 0.0);
    let error = |shape| match subdivide(&surfaces([triangle(), shape]), Divisions::uniform(1)) {
        Err(MeshError::Shape {
            surface: SurfaceId(1),
            error,
        }) => error,
        other => panic!("{other:?}"),
    };
    let mesh = |positions: Vec<DVec3>, faces| Shape::Mesh(PolygonMesh { positions, faces });
    let xy = vec![DVec3::ZERO, DVec3::X, DVec3::Y, 2.0 * DVec3::X];
    assert_eq!(
        error(parallelogram([0.0; 3], [1.0, 2.0, 3.0], [2.0, 4.0, 6.0])),
        ShapeError::NoArea
    );
    assert_eq!(
        error(parallelogram([0.0; 3], [0.0; 3], [2.0, 4.0, 6.0])),
        ShapeError::NoArea
    );
    assert_eq!(error(Shape::Triangle([DVec3::X; 3])), ShapeError::NoArea);
    assert_eq!(
        error(Shape::Triangle([nan, DVec3::X, DVec3::Y])),
        ShapeError::OutOfRange
    );
    assert_eq!(
        error(parallelogram(
            [1.1e30, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0]
        )),
        ShapeError::OutOfRange
    );
    assert_eq!(
        error(quad([
            [0.0; 3],
            [1.0, 0.0, 0.0],
            [0.2, 0.2, 0.0],
            [0.0, 1.0, 0.0]
        ])),
        ShapeError::NotConvex
    );
    assert_eq!(
        error(quad([
            [0.0; 3],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [1.0, 1.0, 0.0]
        ])),
        ShapeError::NotConvex
    );
    assert!(matches!(
        error(quad([
            [0.0; 3],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.1],
            [0.0, 1.0, 0.0]
        ])),
        ShapeError::NotPlanar { .. }
    ));
    assert_eq!(error(mesh(xy.clone(), vec![])), ShapeError::Empty);
    assert_eq!(
        error(mesh(xy.clone(), vec![vec![0, 1, 2], vec![0, 1, 4]])),
        ShapeError::IndexOutOfRange {
            face: 1,
            index: 4,
            count: 4
        }
    );
    assert_eq!(
        error(mesh(xy.clone(), vec![vec![0, 1]])),
        ShapeError::CornerCount {
            face: 0,
            corners: 2
        }
    );
    let bow_tie = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    assert_eq!(
        error(mesh(
            bow_tie.map(DVec3::from).to_vec(),
            vec![vec![0, 1, 2, 3]]
        )),
        ShapeError::FaceCrossesItself { face: 0 }
    );
    assert_eq!(
        error(mesh(xy, vec![vec![0, 1, 2], vec![0, 1, 3]])),
        ShapeError::FaceWithoutArea { face: 1 }
    );
}

#[test]
fn bad_divisions_are_explained() {
    let cut = |divisions| {
        let surface = Surface {
            divisions: Some(divisions),
            ..surface(triangle())
        };
        subdivide(&[surface], Divisions::uniform(1))
            .map(|_| ())
            .unwrap_err()
    };
    let surface = SurfaceId(0);
    assert_eq!(
        cut(Divisions::Count { a: 2, b: 3 }),
        MeshError::TwoCountsOnTriangle {
            surface,
            a: 2,
            b: 3
        }
    );
    assert_eq!(
        cut(Divisions::uniform(0)),
        MeshError::NoDivisions { surface }
    );
    assert_eq!(
        cut(Divisions::MaxEdge(-1.0)),
        MeshError::NoDivisions { surface }
    );
    assert_eq!(
        cut(Divisions::MaxEdge(f64::NAN)),
        MeshError::NoDivisions { surface }
    );
    assert_eq!(cut(Divisions::uniform(u32::MAX)), MeshError::TooManyPatches);
    assert_eq!(cut(Divisions::MaxEdge(1e-300)), MeshError::TooManyPatches);
    assert_eq!(
        subdivide(&[], Divisions::uniform(1)).unwrap_err(),
        MeshError::Empty
    );
}

/// A unit square far from the origin: where a hundred times the rounding of coordinates is more
/// than a patch, it is refused.
#[test]
fn patches_need_digits() {
    let square = |away: f64| {
        let square = parallelogram([away, -away, 0.5], DVec3::X, DVec3::Y);
        subdivide(&[surface(square)], Divisions::uniform(2))
    };
    assert!(square(4.9e9).is_ok());
    for away in [5.1e9, 1e12, 1e15] {
        let error = square(away).unwrap_err();
        assert!(
            matches!(
                error,
                MeshError::NoDigits {
                    surface: SurfaceId(0),
                    ..
                }
            ),
            "{error}"
        );
    }
}
