//! Surfaces into patches: nothing is lost, everything is found again.

use proptest::prelude::*;
use radiosity_geometry::{
    DVec3, Divisions, FaceId, FaceOrder, Grid, Mesh, PolygonMesh, Shape, Surface, SurfaceId,
    count_patches, subdivide, subdivide_in,
};
use radiosity_test_kit::{icosphere, mesh_of, parallelogram, surface};

fn cut(shape: Shape, divisions: Divisions) -> Mesh {
    let surfaces = [surface(shape)];
    let mesh = subdivide(&surfaces, divisions).unwrap();
    assert_eq!(count_patches(&surfaces, divisions), Ok(mesh.patches.len()));
    mesh
}

pub(crate) fn triangle() -> Shape {
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

/// With a quad that is not planar, and so two faces.
#[test]
fn faces_keep_the_callers_order() {
    let positions = [
        [0, 0, 0],
        [1, 0, 0],
        [1, 1, 1],
        [0, 1, 0],
        [9, 9, 9],
        [8, 9, 9],
        [9, 8, 9],
    ];
    let position = |p: [i32; 3]| DVec3::from(p.map(f64::from));
    let mesh = Shape::Mesh(PolygonMesh {
        positions: positions.map(position).to_vec(),
        faces: vec![
            vec![4, 5, 6],
            vec![0, 1, 2, 3],
            vec![6, 5, 4],
            vec![0, 1, 3],
        ],
    });
    let surfaces = [surface(mesh)];
    let given = subdivide(&surfaces, Divisions::default()).unwrap();
    let ranges = given.patches_of_surface(SurfaceId(0));
    assert_eq!(ranges, [0..1, 1..3, 3..4, 4..5]);
    let curve = subdivide_in(FaceOrder::Curve, &surfaces, Divisions::default()).unwrap();
    let inputs =
        |mesh: &Mesh| -> Vec<u32> { mesh.faces.iter().map(|face| face.input_index).collect() };
    assert_eq!(inputs(&given), [0, 1, 1, 2, 3]);
    assert_ne!(inputs(&curve), inputs(&given));
    let ranges = std::panic::catch_unwind(|| curve.patches_of_surface(SurfaceId(0)));
    assert!(ranges.is_err(), "there is no range for each");
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
        let mesh = mesh_of([Shape::Mesh(PolygonMesh {
            positions: positions.clone(),
            faces: vec![face],
        })]);
        mesh.patches
            .iter()
            .map(|p| p.polygon.corners().len())
            .collect::<Vec<_>>()
    };
    assert_eq!(faces_of(vec![0, 1, 2, 3]), [4]);
    assert_eq!(faces_of(vec![0, 1, 4, 3]), [3, 3], "a folded quad");
    assert_eq!(faces_of(vec![0, 1, 5, 3]), [3, 3], "a reflex corner");
    let concave = mesh_of([Shape::Mesh(PolygonMesh {
        positions: positions.clone(),
        faces: vec![vec![0, 1, 5, 3]],
    })]);
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
    let mesh = mesh_of([Shape::Mesh(icosphere(4))]);
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
