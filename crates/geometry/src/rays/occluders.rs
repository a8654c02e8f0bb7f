//! What rays and segments meet: closest hits for pictures, any hits for visibility.

use crate::bounds::Aabb;
use crate::coplanar::merged_faces::MergedFaces;
use crate::mesh::{Face, FaceId, Mesh};
use crate::polygon::Polygon;
use crate::rays::bvh::Bvh;
use crate::rays::bvh_build::build;
use crate::rays::face_block::FaceBlock;
use crate::rays::ray::Ray;
use crate::rays::ray_query::{Blocked, Reach};
use glam::DVec3;
use radiosity_simd::dispatch;

/// The undivided faces of a mesh, ready for rays. Both sides of a face block.
///
/// ```
/// use radiosity_geometry::{DVec3, Divisions, Occluders, Ray, Shape, Surface, subdivide};
///
/// let floor = Surface {
///     shape: Shape::Triangle([DVec3::ZERO, DVec3::X, DVec3::Y]),
///     divisions: None,
/// };
/// let occluders = Occluders::new(&subdivide(&[floor], Divisions::uniform(1))?);
/// let down = Ray::new(DVec3::new(0.2, 0.2, 3.0), DVec3::NEG_Z);
/// let hit = occluders.closest_hit(&down, 0.0, f64::INFINITY, None).unwrap();
/// assert_eq!((hit.t, hit.face.index(), hit.front), (3.0, 0, true));
/// assert!(!occluders.any_hit(&down, 0.0, 2.9, None));
/// # Ok::<(), radiosity_geometry::MeshError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Occluders {
    pub(crate) faces: Vec<Occluder>,
    pub(crate) tree: Bvh,
    /// The faces of each leaf of the tree.
    pub(crate) blocks: Vec<FaceBlock>,
    /// Heights up to this count as "in the plane": the rounding of coordinates of this scene.
    pub(crate) plane_tolerance: f64,
    /// How many faces lie on each other above each face; empty if that is nowhere told.
    layers: Vec<u32>,
}

/// Two lines of memory.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Occluder {
    pub(crate) corners: [DVec3; 4],
    pub(crate) normal: DVec3,
    pub(crate) offset: f64,
}

/// Where a ray meets a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Ray parameter.
    pub t: f64,
    /// The face.
    pub face: FaceId,
    /// Whether the ray meets a front: the side that the normal points to, unless the face is
    /// [bare](crate::Face::is_bare).
    pub front: bool,
    /// Of a front, whether a back lies in the same place.
    pub backed: bool,
}

/// Rounding of coordinates, relative to the largest of them.
const RELATIVE_PLANE_TOLERANCE: f64 = 1e-12;

impl Occluder {
    fn new(polygon: &Polygon) -> Occluder {
        let (corners, normal) = (*polygon.padded_corners(), polygon.normal());
        Occluder {
            corners,
            normal,
            offset: normal.dot(corners[0]),
        }
    }

    pub(crate) fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.offset
    }

    /// Whether the face crosses the segment from `p` to `q`, with both ends more than
    /// `tolerance` from its plane.
    pub(crate) fn cuts(&self, p: DVec3, q: DVec3, tolerance: f64) -> bool {
        let (at_p, at_q) = (self.height(p), self.height(q));
        at_p.max(at_q) > tolerance
            && at_p.min(at_q) < -tolerance
            && Ray::new(p, q - p).pierces(&self.corners)
    }
}

impl Occluders {
    /// Prepares all faces of a mesh.
    pub fn new(mesh: &Mesh) -> Occluders {
        let polygons: Vec<Polygon> = mesh.faces.iter().map(|face| face.polygon).collect();
        let bare: Vec<bool> = mesh.faces.iter().map(Face::is_bare).collect();
        let mut occluders = Occluders::of(&polygons, &bare);
        if !mesh.covers.covered().is_empty() {
            let ids = (0..mesh.faces.len() as u32).map(FaceId);
            occluders.layers = ids.map(|id| mesh.covers.layer(id)).collect();
        }
        occluders
    }

    /// Prepares walls; a [`FaceId`] is then a wall's.
    pub fn of_walls(walls: &MergedFaces) -> Occluders {
        Occluders::of(&walls.polygons, &walls.bare)
    }

    fn of(polygons: &[Polygon], bare: &[bool]) -> Occluders {
        let boxes: Vec<Aabb> = polygons.iter().map(Polygon::bounds).collect();
        let plane_tolerance =
            plane_tolerance(&boxes.iter().copied().fold(Aabb::EMPTY, Aabb::union));
        // A ray within the side of a flat box must find it.
        let boxes: Vec<Aabb> = boxes.iter().map(|b| b.grown(plane_tolerance)).collect();
        let faces: Vec<Occluder> = polygons.iter().map(Occluder::new).collect();
        let tree = build(&boxes);
        Occluders {
            blocks: tree
                .leaves
                .iter()
                .map(|leaf| FaceBlock::new(leaf.items().map(|item| (&faces[item], bare[item]))))
                .collect(),
            faces,
            tree,
            plane_tolerance,
            layers: Vec::new(),
        }
    }

    /// The face in a lane of a block.
    pub(crate) fn face(&self, block: usize, lane: usize) -> FaceId {
        FaceId(self.tree.leaves[block].items[lane])
    }

    /// Heights over a plane up to this count as in it: the rounding of coordinates of this scene.
    pub fn plane_tolerance(&self) -> f64 {
        self.plane_tolerance
    }

    /// The first face that a ray meets at a parameter in `from..=to`, other than `except`.
    ///
    /// Where a front and a back lie in one place, in the same plane up to the rounding of
    /// coordinates, the ray meets the front: walls made of two faces show their fronts to either
    /// side. Of two fronts the ray meets the one that [lies on](crate::Covers) the other. Else, of
    /// two hits at the same parameter the face that comes first wins.
    pub fn closest_hit(
        &self,
        ray: &Ray,
        from: f64,
        to: f64,
        except: Option<FaceId>,
    ) -> Option<Hit> {
        dispatch(self.reach(ray, from, to, except).closest_hit())
    }

    /// The first face that a ray from a point of a face meets. The face itself and others in its
    /// plane are not met: rounding may put the point on either side of them.
    pub fn closest_hit_from(&self, face: FaceId, ray: &Ray) -> Option<Hit> {
        let from = self.in_plane(face, ray);
        self.closest_hit(ray, from, f64::INFINITY, Some(face))
    }

    /// The length, in parameters of a ray, along which it is in the plane of a face that it
    /// crosses there, up to the rounding of coordinates.
    pub(crate) fn in_plane(&self, face: FaceId, ray: &Ray) -> f64 {
        self.plane_tolerance / self.faces[face.index()].normal.dot(ray.direction).abs()
    }

    /// By how much of its parameter a ray is to meet a face later, since others lie on it.
    pub(crate) fn set_back(&self, face: FaceId, ray: &Ray) -> f64 {
        match self.layers.get(face.index()) {
            None | Some(0) => 0.0,
            Some(&layer) => 2.0 * f64::from(layer) * self.in_plane(face, ray),
        }
    }

    /// Whether a ray meets any face at a parameter in `from..=to`, other than `except`.
    pub fn any_hit(&self, ray: &Ray, from: f64, to: f64, except: Option<FaceId>) -> bool {
        dispatch(self.reach(ray, from, to, except).any_hit())
    }

    pub(crate) fn reach<'a>(
        &'a self,
        ray: &'a Ray,
        from: f64,
        to: f64,
        except: Option<FaceId>,
    ) -> Reach<'a> {
        Reach {
            occluders: self,
            ray,
            from,
            to,
            except,
        }
    }

    /// Whether a face other than `i` and `j` cuts the open segment from `p` on face `i` to `q`
    /// on face `j`.
    ///
    /// A face whose plane contains an end of the segment does not cut it: a cover that lies
    /// exactly on a face does not hide it. Segments that graze an edge are decided by rounding,
    /// but the same way from either end.
    pub fn blocked(&self, i: FaceId, p: DVec3, j: FaceId, q: DVec3) -> bool {
        dispatch(Blocked::new(self, [i, j], ordered(p, q)))
    }
}

/// The rounding of coordinates as large as those of a box.
pub(crate) fn plane_tolerance(bounds: &Aabb) -> f64 {
    RELATIVE_PLANE_TOLERANCE * bounds.min.abs().max(bounds.max.abs()).max_element()
}

/// The ends of a segment in an order that does not depend on which one was named first.
pub(crate) fn ordered(p: DVec3, q: DVec3) -> [DVec3; 2] {
    if p.to_array() <= q.to_array() {
        [p, q]
    } else {
        [q, p]
    }
}
