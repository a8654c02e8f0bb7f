//! Surfaces into patches: nothing is lost, everything is found again, bad input is named.

mod shapes;

use proptest::prelude::*;
use radiosity_geometry::{
    Camera, CameraError, DVec3, Divisions, FaceId, Grid, Mesh, MeshError, PolygonMesh, Shape,
    ShapeError, Surface, SurfaceId, count_patches, subdivide,
};
use shapes::{icosphere, mesh_of, parallelogram};

fn cut(shape: Shape, divisions: Divisions) -> Mesh {
    let surfaces = [Surface {
        shape,
        divisions: None,
    }];
    let mesh = subdivide(&surfaces, divisions).unwrap();
    assert_eq!(count_patches(&surfaces, divisions), Ok(mesh.patches.len()));
    mesh
}

fn triangle() -> Shape {
    Shape::Triangle([
        DVec3::ZERO,
        DVec3::new(3.0, 0.0, 1.0),
        DVec3::new(1.0, 2.0, 0.0),
    ])
}

fn trapezoid() -> Shape {
    let corners = [[0.0, 0.0], [4.0, 0.0], [2.0, 2.0], [0.5, 2.0]];
    Shape::Quad(corners.map(|[x, y]| DVec3::new(x, y, 1.0)))
}

fn any_shape() -> impl Strategy<Value = Shape> {
    prop_oneof![
        Just(triangle()),
        Just(trapezoid()),
        Just(parallelogram(
            [1.0, 2.0, 3.0],
            [2.0, 1.0, 0.0],
            [0.0, 1.0, 3.0]
        )),
    ]
}

#[test]
fn rectangles_are_cut_in_row_order() {
    let mesh = cut(
        parallelogram([0.0; 3], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0]),
        Divisions::Count { a: 2, b: 3 },
    );
    let cells: Vec<[u32; 2]> = mesh.patches.iter().map(|p| p.cell).collect();
    assert_eq!(cells, [[0, 0], [0, 1], [0, 2], [1, 0], [1, 1], [1, 2]]);
    assert_eq!(mesh.patches[5].centroid, DVec3::new(1.5, 2.5, 0.0));
    assert_eq!(mesh.patches[5].normal, DVec3::Z);
    assert_eq!(mesh.patches[5].area, 1.0);
    assert_eq!(
        (mesh.patches[5].face, mesh.patches[5].surface),
        (FaceId(0), SurfaceId(0))
    );
}

#[test]
fn a_target_edge_length_gives_the_fewest_cells() {
    let rectangle = parallelogram([0.0; 3], [2.0, 0.0, 0.0], [0.0, 0.9, 0.0]);
    assert_eq!(
        cut(rectangle, Divisions::MaxEdge(0.5)).faces[0].grid,
        Grid::Quad { a: 4, b: 2 }
    );
    let tenth = parallelogram([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let grid = cut(tenth, Divisions::MaxEdge(0.1)).faces[0].grid;
    assert_eq!(
        grid,
        Grid::Quad { a: 10, b: 10 },
        "rounding must not add a cell"
    );
}

#[test]
fn mesh_faces_are_patches_unless_a_length_or_the_surface_says_otherwise() {
    let surface = |divisions| Surface {
        shape: Shape::Mesh(icosphere(1)),
        divisions,
    };
    let patches = |divisions, default| count_patches(&[surface(divisions)], default).unwrap();
    assert_eq!(patches(None, Divisions::uniform(12)), 80);
    assert_eq!(
        patches(Some(Divisions::uniform(3)), Divisions::uniform(12)),
        720
    );
    assert!(patches(None, Divisions::MaxEdge(0.1)) > 1000);
}

#[test]
fn planar_quads_of_a_mesh_stay_quads_and_others_become_triangles() {
    let positions = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
        [1.0, 1.0, 0.5],
        [0.2, 0.2, 0.0],
    ];
    let positions: Vec<DVec3> = positions.map(DVec3::from).to_vec();
    let faces_of = |face: Vec<u32>| {
        let mesh = mesh_of(PolygonMesh {
            positions: positions.clone(),
            faces: vec![face],
        });
        mesh.patches
            .iter()
            .map(|p| p.polygon.corners().len())
            .collect::<Vec<_>>()
    };
    assert_eq!(faces_of(vec![0, 1, 2, 3]), [4]);
    assert_eq!(faces_of(vec![0, 1, 4, 3]), [3, 3], "a folded quad");
    assert_eq!(faces_of(vec![0, 1, 5, 3]), [3, 3], "a reflex corner");
    let concave = mesh_of(PolygonMesh {
        positions: positions.clone(),
        faces: vec![vec![0, 1, 5, 3]],
    });
    assert!(
        (concave.total_area() - 0.2).abs() < 1e-12,
        "cut along the inner diagonal"
    );
    assert!(
        concave
            .faces
            .iter()
            .all(|f| f.normal == DVec3::Z && f.input_index == 0)
    );
}

#[test]
fn neighbouring_faces_of_a_mesh_are_close_in_memory() {
    let mesh = mesh_of(icosphere(4));
    let mut inputs: Vec<u32> = mesh.faces.iter().map(|f| f.input_index).collect();
    let steps = mesh
        .patches
        .windows(2)
        .map(|p| p[0].centroid.distance(p[1].centroid));
    let mean_step = steps.sum::<f64>() / (mesh.patches.len() - 1) as f64;
    assert!(
        mean_step < 0.15,
        "a random order would step by 1.33 on average, not {mean_step}"
    );
    inputs.sort_unstable();
    assert!(
        inputs.into_iter().eq(0..5120),
        "every input face stands in the order once"
    );
}

#[test]
fn bad_shapes_are_explained() {
    let nan = DVec3::new(f64::NAN, 0.0, 0.0);
    let error = |shape| {
        let surfaces = [
            Surface {
                shape: triangle(),
                divisions: None,
            },
            Surface {
                shape,
                divisions: None,
            },
        ];
        match subdivide(&surfaces, Divisions::uniform(1)) {
            Err(MeshError::Shape {
                surface: SurfaceId(1),
                error,
            }) => error,
            other => panic!("{other:?}"),
        }
    };
    let mesh = |positions: Vec<DVec3>, faces| Shape::Mesh(PolygonMesh { positions, faces });
    let quad = |corners: [[f64; 3]; 4]| Shape::Quad(corners.map(DVec3::from));
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
            shape: triangle(),
            divisions: Some(divisions),
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

/// The course's camera: where the corners of its lamp appear is known.
#[test]
fn the_camera_projects_as_the_course_does() {
    let direction = DVec3::new(0.0, -0.042612, -1.0);
    let position = DVec3::new(50.0, 52.0, 295.6);
    let camera = Camera::new(position, direction, DVec3::Y, 28.79932, 130.0).unwrap();
    let meets_lamp = |x: f64, y: f64| {
        let ray = camera.ray(x / 640.0, y / 480.0, 640.0 / 480.0);
        ray.at((79.99 - ray.origin.y) / ray.direction.y)
    };
    // A tenth of a pixel, the precision of the reference, is 0.03 units across and, at this
    // grazing view, 0.5 units along.
    let (near_left, far_right) = (meets_lamp(275.3, 75.0), meets_lamp(357.6, 85.9));
    assert!((near_left.x - 40.0).abs() < 0.05 && (near_left.z - 85.0).abs() < 0.5);
    assert!((far_right.z - 65.0).abs() < 0.5);
    assert!((meets_lamp(364.7, 75.0).x - 60.0).abs() < 0.05);
}

#[test]
fn impossible_cameras_are_refused() {
    let camera = |direction, up, fov, near| {
        Camera::new(DVec3::ZERO, direction, up, fov, near)
            .map(|_| ())
            .unwrap_err()
    };
    assert_eq!(
        camera(DVec3::ZERO, DVec3::Y, 30.0, 0.0),
        CameraError::NoDirection
    );
    assert_eq!(
        camera(DVec3::Y, DVec3::Y, 30.0, 0.0),
        CameraError::UpParallel
    );
    let oblique = DVec3::new(0.1, -0.3, 0.2);
    assert_eq!(
        camera(oblique, 3.0 * oblique, 30.0, 0.0),
        CameraError::UpParallel
    );
    assert_eq!(
        camera(DVec3::Z, DVec3::Y, 180.0, 0.0),
        CameraError::FieldOfView
    );
    assert_eq!(
        camera(DVec3::Z, DVec3::Y, f64::NAN, 0.0),
        CameraError::FieldOfView
    );
    assert_eq!(camera(DVec3::Z, DVec3::Y, 30.0, -1.0), CameraError::Near);
}

proptest! {
    /// Patches tile their surface: areas add up, normals agree, edges stay below the target.
    #[test]
    fn patches_tile_the_surface(shape in any_shape(), n in 1u32..9, length in 0.2f64..3.0) {
        let whole = cut(shape.clone(), Divisions::uniform(1)).total_area();
        for divisions in [Divisions::uniform(n), Divisions::MaxEdge(length)] {
            let mesh = cut(shape.clone(), divisions);
            prop_assert!((mesh.total_area() / whole - 1.0).abs() < 1e-12);
            for patch in &mesh.patches {
                prop_assert!(patch.polygon.normal().distance(mesh.faces[0].normal) < 1e-9);
                prop_assert!(patch.area > 0.0);
                if let Divisions::MaxEdge(length) = divisions {
                    prop_assert!(patch.polygon.longest_edge() <= length * (1.0 + 1e-9));
                }
            }
        }
    }

    /// A point of a patch is located in that patch, at the coordinates that give the point.
    #[test]
    fn points_are_located_in_their_patch(
        shape in any_shape(), n in 1u32..9, s in 0.02f64..0.98, t in 0.02f64..0.98
    ) {
        let mesh = cut(shape, Divisions::uniform(n));
        for (index, patch) in mesh.patches.iter().enumerate() {
            let polygon = &patch.polygon;
            let point = if polygon.is_triangle() {
                let (s, t) = if s + t < 0.99 { (s, t) } else { (0.5 * s, 0.5 * t) };
                polygon.barycentric(s, t)
            } else {
                polygon.bilinear(s, t)
            };
            let found = mesh.locate(patch.face, point);
            prop_assert_eq!(found.patch, index);
            let again = if polygon.is_triangle() {
                polygon.barycentric(found.on_patch.x, found.on_patch.y)
            } else {
                polygon.bilinear(found.on_patch.x, found.on_patch.y)
            };
            prop_assert!(again.distance(point) < 1e-12);
        }
    }
}

/// A unit square far from the origin: where a hundred times the rounding of coordinates is more than a patch,
/// it is refused.
#[test]
fn patches_need_digits() {
    let square = |away: f64| {
        let corner = DVec3::new(away, -away, 0.5);
        let surface = Surface {
            shape: Shape::Parallelogram {
                corner,
                edge_a: DVec3::X,
                edge_b: DVec3::Y,
            },
            divisions: None,
        };
        subdivide(&[surface], Divisions::uniform(2))
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
