//! Triangles whose longest edge is at least twice their height.

use proptest::prelude::*;
use radiosity_geometry::{
    DVec3, Divisions, Mesh, PolygonMesh, Shape, Surface, count_patches, subdivide,
};
use std::f64::consts::TAU;

/// A triangle, and how long edges of patches may be.
#[derive(Clone, Debug)]
pub(crate) struct Sliver {
    pub(crate) corners: [DVec3; 3],
    pub(crate) max_edge: f64,
}

impl Sliver {
    fn cut(&self, shape: Shape) -> Mesh {
        let surfaces = [Surface {
            shape,
            divisions: Some(Divisions::MaxEdge(self.max_edge)),
        }];
        let mesh = subdivide(&surfaces, Divisions::uniform(1)).unwrap();
        let count = count_patches(&surfaces, Divisions::uniform(1));
        assert_eq!(count, Ok(mesh.patches.len()));
        mesh
    }

    pub(crate) fn alone(&self) -> Mesh {
        self.cut(Shape::Triangle(self.corners))
    }

    pub(crate) fn in_mesh(&self) -> Mesh {
        let (positions, faces) = (self.corners.to_vec(), vec![vec![0, 1, 2]]);
        self.cut(Shape::Mesh(PolygonMesh { positions, faces }))
    }

    pub(crate) fn length(&self, edge: usize) -> f64 {
        self.corners[edge].distance(self.corners[(edge + 1) % 3])
    }

    pub(crate) fn longest_edge(&self) -> usize {
        let longer = |&a: &usize, &b: &usize| self.length(a).total_cmp(&self.length(b));
        (0..3).max_by(longer).unwrap()
    }
}

/// Triangles whose longest edge is at least twice their height; their feet are anywhere, often at
/// an end.
pub(crate) fn any_sliver() -> impl Strategy<Value = Sliver> {
    let foot = prop_oneof![2 => 0.0..1.0, 1 => Just(0.0), 1 => 0.0..0.1, 1 => Just(1.0)];
    let height = prop_oneof![1 => 0.01..0.499, 1 => (-14.0..-1.0).prop_map(f64::exp2)];
    let pieces = prop_oneof![1 => 4.01..9.0, 2 => (2.1f64..7.5).prop_map(f64::exp2)];
    let turn = (0.0..TAU, -1.0..1.0f64, 0.0..TAU, 0usize..3);
    (foot, height, pieces, turn).prop_map(|(foot, height, pieces, turn)| {
        let (foot, height): (f64, f64) = (foot, height);
        let (angle, z, spin, first): (f64, f64, f64, usize) = turn;
        // The longest edge stays the longest.
        let most = (1.0 - foot.max(1.0 - foot).powi(2)).sqrt();
        let height = if most < 0.02 {
            height
        } else {
            height.min(most)
        };
        let r = f64::sqrt(1.0 - z * z);
        let normal = DVec3::new(r * angle.cos(), r * angle.sin(), z);
        let (u, v) = normal.any_orthonormal_pair();
        let (u, v) = (
            u * spin.cos() + v * spin.sin(),
            v * spin.cos() - u * spin.sin(),
        );
        let mut corners = [DVec3::ZERO, u, foot * u + height * v].map(|p| 3.0 * p);
        corners.rotate_left(first);
        Sliver {
            corners,
            max_edge: 3.0 / pieces,
        }
    })
}
