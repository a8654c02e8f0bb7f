//! A face as a camera sees it: linear functions of the place on the film.

use crate::camera::Camera;
use crate::mesh::{Face, FaceId};
use glam::{DVec2, DVec3};
use radiosity_simd::Simd;

/// A linear function of a place on the film, which is in pixels from the top left corner.
#[derive(Clone, Copy, Debug)]
pub struct Linear {
    origin: f64,
    across: f64,
    down: f64,
}

/// A face as the camera sees it.
#[derive(Clone, Debug)]
pub struct SeenFace {
    /// The face.
    pub id: FaceId,
    /// Whether it shows its front.
    pub front: bool,
    /// The inverse of the view depth.
    pub inverse_depth: Linear,
    /// The coordinates on the face, as [`Location::on_face`](crate::Location) has them, times the
    /// inverse depth; none for quads that are no parallelograms.
    pub coordinates: Option<[Linear; 2]>,
    /// Not negative within.
    pub(super) edges: [Linear; 4],
}

/// How a camera looks at faces.
pub(super) struct Viewed<'a> {
    pub(super) camera: &'a Camera,
    /// The directions of the film.
    pub(super) film: [DVec3; 3],
    /// How far faces are set back for each that others in their plane are to be seen before: backs
    /// behind fronts, and faces behind those that lie on them.
    pub(super) tolerance: f64,
    /// How many of them lie on each other, at most.
    pub(super) layers: u32,
}

impl Linear {
    /// The product of a vector with the directions of the film.
    fn of(vector: DVec3, film: &[DVec3; 3]) -> Linear {
        let [origin, across, down] = film.map(|direction| vector.dot(direction));
        Linear {
            origin,
            across,
            down,
        }
    }

    /// The value at a place.
    pub fn at(&self, place: DVec2) -> f64 {
        self.origin + self.across * place.x + self.down * place.y
    }

    /// How much it may differ from its value at the centre of a square of a half-width.
    pub(super) fn spread(&self, half: f64) -> f64 {
        half * (self.across.abs() + self.down.abs())
    }

    /// The values at places relative to one where the value is known.
    #[inline(always)]
    pub fn around<S: Simd>(&self, simd: S, known: f64, [x, y]: [S::F64; 2]) -> S::F64 {
        simd.splat_f64(known) + x * simd.splat_f64(self.across) + y * simd.splat_f64(self.down)
    }
}

impl SeenFace {
    /// A face below so many others in its plane.
    pub(super) fn new(
        (id, face): (FaceId, &Face),
        layer: u32,
        viewed: &Viewed<'_>,
    ) -> Option<SeenFace> {
        let Viewed { camera, film, .. } = viewed;
        let corners = face.polygon.padded_corners();
        let [a, b, c, d] = corners.map(|corner| corner - camera.position());
        let height = face.normal.dot(a);
        let side = height.signum();
        let front = height < 0.0;
        let steps = if front { layer } else { viewed.layers + 1 };
        let set_back = side * f64::from(steps) * viewed.tolerance;
        let depth = face.normal / (height + set_back);
        let edge = |from: DVec3, to: DVec3| Linear::of(side * from.cross(to), film);
        // A triangle's last corner is stored twice.
        let (along_u, along_v) = (b - a, d - a);
        let area = along_u.cross(along_v).dot(face.normal);
        let coordinate = |dual: DVec3| Linear::of(dual / area - dual.dot(a) / area * depth, film);
        let is_affine = face.polygon.is_triangle() || face.polygon.is_parallelogram();
        let seen = SeenFace {
            id,
            front,
            inverse_depth: Linear::of(depth, film),
            coordinates: is_affine.then(|| {
                [
                    coordinate(along_v.cross(face.normal)),
                    coordinate(face.normal.cross(along_u)),
                ]
            }),
            edges: [edge(a, b), edge(b, c), edge(c, d), edge(d, a)],
        };
        let is_finite = depth.is_finite() && height != 0.0;
        is_finite.then_some(seen)
    }

    /// Whether no place of a square around a centre shows the face.
    pub(super) fn misses(&self, center: DVec2, half: f64) -> bool {
        let is_below = |linear: &Linear| linear.at(center) + linear.spread(half) < 0.0;
        is_below(&self.inverse_depth) || self.edges.iter().any(is_below)
    }

    /// Whether all places of a square lie within its edges.
    pub(super) fn covers(&self, center: DVec2, half: f64) -> bool {
        let is_above = |linear: &Linear| linear.at(center) - linear.spread(half) >= 0.0;
        self.edges.iter().all(is_above)
    }
}
