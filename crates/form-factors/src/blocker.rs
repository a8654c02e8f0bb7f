//! What stands between two patches: whether it hides all, nothing, or some of one from the other.

use radiosity_geometry::{DVec3, Face};

/// A face as the half-spaces that make it: its plane first, then one through each edge, facing
/// inwards. A triangle has its last edge twice.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Blocker {
    pub(crate) planes: [Plane; PLANES],
}

pub(crate) const PLANES: usize = 5;
const EDGES: usize = PLANES - 1;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane {
    pub(crate) normal: DVec3,
    pub(crate) offset: f64,
}

/// The heights of a patch's corners (the last of a triangle twice) over each plane of a blocker.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Heights([[f64; 4]; PLANES]);

/// What a blocker does to a pair of patches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Effect {
    Nothing,
    Hides,
    Partly,
}

impl Plane {
    fn through(point: DVec3, normal: DVec3) -> Plane {
        Plane {
            normal,
            offset: normal.dot(point),
        }
    }

    fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.offset
    }
}

impl Blocker {
    pub(crate) fn new(face: &Face) -> Blocker {
        let corners = face.polygon.corners();
        let edge = |k: usize| {
            let k = k.min(corners.len() - 1);
            let (from, to) = (corners[k], corners[(k + 1) % corners.len()]);
            Plane::through(from, face.normal.cross(to - from).normalize())
        };
        let plane = Plane::through(corners[0], face.normal);
        Blocker {
            planes: [plane, edge(0), edge(1), edge(2), edge(3)],
        }
    }

    pub(crate) fn heights(&self, corners: &[DVec3; 4]) -> Heights {
        Heights(self.planes.map(|plane| corners.map(|c| plane.height(c))))
    }
}

impl Heights {
    /// What the blocker does to segments between two patches, by the segments between their
    /// corners: all others cross its plane within the hull of where these do. Heights up to
    /// `tolerance` count as zero.
    pub(crate) fn effect(&self, other: &Heights, tolerance: f64) -> Effect {
        let ([plane_i, edges_i @ ..], [plane_j, edges_j @ ..]) = (&self.0, &other.0);
        let above = |heights: &[f64; 4]| heights.iter().all(|&h| h >= -tolerance);
        let below = |heights: &[f64; 4]| heights.iter().all(|&h| h <= tolerance);
        let one_side = above(plane_i) && above(plane_j) || below(plane_i) && below(plane_j);
        let beside = (0..EDGES).any(|e| below(&edges_i[e]) && below(&edges_j[e]));
        if one_side || beside {
            return Effect::Nothing;
        }
        let opposite = above(plane_i) && below(plane_j) || below(plane_i) && above(plane_j);
        if !opposite {
            return Effect::Partly;
        }
        let mut hides = true;
        for (edge_i, edge_j) in edges_i.iter().zip(edges_j) {
            let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
            for a in 0..4 {
                for b in 0..4 {
                    // The height over the edge where the segment crosses the plane.
                    let (to_plane_i, to_plane_j) = (plane_i[a].abs(), plane_j[b].abs());
                    let across = to_plane_i + to_plane_j;
                    if across > 0.0 {
                        let at = (edge_i[a] * to_plane_j + edge_j[b] * to_plane_i) / across;
                        least = least.min(at);
                        most = most.max(at);
                    }
                }
            }
            if most <= tolerance {
                return Effect::Nothing;
            }
            hides &= least >= -tolerance;
        }
        if hides { Effect::Hides } else { Effect::Partly }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use radiosity_geometry::{Divisions, Shape, Surface, subdivide};

    fn square(center: DVec3, edge: f64) -> Shape {
        Shape::Parallelogram {
            corner: center - 0.5 * edge * (DVec3::X + DVec3::Y),
            edge_a: edge * DVec3::X,
            edge_b: edge * DVec3::Y,
        }
    }

    fn effect(between: Shape) -> Effect {
        let shapes = [
            square(DVec3::ZERO, 1.0),
            between,
            square(2.0 * DVec3::Z, 1.0),
        ];
        let surfaces = shapes.map(|shape| Surface {
            shape,
            divisions: None,
        });
        let mesh = subdivide(&surfaces, Divisions::uniform(1)).unwrap();
        let blocker = Blocker::new(&mesh.faces[1]);
        let heights =
            [0, 2].map(|k: usize| blocker.heights(mesh.faces[k].polygon.padded_corners()));
        let [one, other] = [(0, 1), (1, 0)].map(|(i, j)| heights[i].effect(&heights[j], 1e-12));
        assert_eq!(one, other);
        one
    }

    #[test]
    fn effects_of_squares_between_squares() {
        assert_eq!(effect(square(DVec3::Z, 1.0)), Effect::Hides);
        assert_eq!(effect(square(DVec3::Z, 0.9)), Effect::Partly);
        assert_eq!(
            effect(square(DVec3::new(0.99, 0.0, 1.0), 1.0)),
            Effect::Partly
        );
        assert_eq!(
            effect(square(DVec3::new(1.0, 0.0, 1.0), 1.0)),
            Effect::Nothing
        );
        assert_eq!(
            effect(square(DVec3::new(0.0, 0.0, 2.5), 1.0)),
            Effect::Nothing
        );
        // On the plane of one of them it hides nothing, whatever it covers.
        assert_eq!(
            effect(square(DVec3::new(0.0, 0.0, 2.0), 3.0)),
            Effect::Nothing
        );
    }

    #[test]
    fn a_triangle_hides_what_its_edges_enclose() {
        let triangle = |size: f64| {
            let corner = |x: f64, y: f64| DVec3::new(size * x, size * y, 1.0);
            Shape::Triangle([corner(-1.0, -1.0), corner(1.0, -1.0), corner(0.0, 1.0)])
        };
        assert_eq!(effect(triangle(5.0)), Effect::Hides);
        assert_eq!(effect(triangle(1.0)), Effect::Partly);
    }
}
