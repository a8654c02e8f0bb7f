//! Eight faces side by side: what a ray meets in a leaf.

use crate::rays::occluders::Occluder;
use crate::rays::ray::Ray;
use glam::DVec3;
use radiosity_simd::{Float, LANES, Simd};

/// Up to eight faces, one per lane.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(crate) struct FaceBlock {
    /// By corner and axis. Unused lanes are points, which no ray meets.
    corners: [[[f64; LANES]; 3]; 4],
    normal: [[f64; LANES]; 3],
    offset: [f64; LANES],
    /// Faces of which neither side is a front, one bit per lane.
    bare: u8,
    /// Whether all fourth corners repeat the third.
    triangles: bool,
}

/// Which faces of a block a ray meets.
pub(crate) struct BlockHits {
    /// One bit per lane.
    pub(crate) mask: u8,
    /// Where the ray meets fronts.
    pub(crate) front: u8,
    /// The ray's parameters.
    pub(crate) t: [f64; LANES],
}

impl FaceBlock {
    /// At most eight faces, and whether each is bare.
    pub(crate) fn new<'a>(faces: impl IntoIterator<Item = (&'a Occluder, bool)>) -> FaceBlock {
        let mut block = FaceBlock {
            corners: [[[0.0; LANES]; 3]; 4],
            normal: [[0.0; LANES]; 3],
            offset: [0.0; LANES],
            bare: 0,
            triangles: true,
        };
        for (lane, (face, bare)) in faces.into_iter().enumerate() {
            for axis in 0..3 {
                for (corner, position) in face.corners.iter().enumerate() {
                    block.corners[corner][axis][lane] = position[axis];
                }
                block.normal[axis][lane] = face.normal[axis];
            }
            block.offset[lane] = face.offset;
            block.bare |= u8::from(bare) << lane;
            block.triangles &= face.corners[2] == face.corners[3];
        }
        block
    }

    /// Where the ray meets the faces at parameters in `from..=to`.
    ///
    /// A ray parallel to a face's plane gives an infinite or NaN parameter, which no range
    /// holds.
    #[inline(always)]
    pub(crate) fn hits<S: Simd>(&self, simd: S, ray: &Ray, from: f64, to: f64) -> BlockHits {
        let mut mask = self.pierced(simd, ray);
        if mask == 0 {
            return BlockHits {
                mask,
                front: 0,
                t: [0.0; LANES],
            };
        }
        let approach = self.along_normals(simd, ray.direction);
        let t = -self.heights(simd, ray.origin) / approach;
        mask &= simd.splat_f64(from).less_or_equal(t);
        mask &= t.less_or_equal(simd.splat_f64(to));
        BlockHits {
            mask,
            front: approach.less(simd.splat_f64(0.0)) & !self.bare,
            t: t.lanes(),
        }
    }

    /// Which faces the segment of a ray from `p` to `q` crosses, with both ends more than
    /// `tolerance` from the face's plane.
    #[inline(always)]
    pub(crate) fn cut<S: Simd>(
        &self,
        simd: S,
        ray: &Ray,
        [p, q]: [DVec3; 2],
        tolerance: f64,
    ) -> u8 {
        let mask = self.pierced(simd, ray);
        if mask == 0 {
            return 0;
        }
        let (at_p, at_q) = (self.heights(simd, p), self.heights(simd, q));
        let above = simd.splat_f64(tolerance).less(at_p.max(at_q));
        let below = at_p.min(at_q).less(simd.splat_f64(-tolerance));
        mask & above & below
    }

    /// [`Ray::pierces`] for all lanes, with the same operations in the same order.
    #[inline(always)]
    fn pierced<S: Simd>(&self, simd: S, ray: &Ray) -> u8 {
        let [corner_a, corner_b, corner_c, corner_d] = &self.corners;
        let a = project(simd, ray, corner_a);
        let b = project(simd, ray, corner_b);
        let c = project(simd, ray, corner_c);
        if self.triangles {
            return around_origin(simd, [a, b, c], None);
        }
        around_origin(simd, [a, b, c], Some(project(simd, ray, corner_d)))
    }

    #[inline(always)]
    fn heights<S: Simd>(&self, simd: S, point: DVec3) -> S::F64 {
        self.along_normals(simd, point) - simd.f64(&self.offset)
    }

    /// The scalar products of a vector with the normals.
    #[inline(always)]
    fn along_normals<S: Simd>(&self, simd: S, vector: DVec3) -> S::F64 {
        let [x, y, z] = &self.normal;
        simd.f64(x) * simd.splat_f64(vector.x)
            + simd.f64(y) * simd.splat_f64(vector.y)
            + simd.f64(z) * simd.splat_f64(vector.z)
    }
}

#[inline(always)]
fn project<S: Simd>(simd: S, ray: &Ray, corner: &[[f64; LANES]; 3]) -> [S::F64; 2] {
    let [i, j, k] = ray.axes;
    let x = simd.f64(&corner[i]) - simd.splat_f64(ray.origin[i]);
    let y = simd.f64(&corner[j]) - simd.splat_f64(ray.origin[j]);
    let z = simd.f64(&corner[k]) - simd.splat_f64(ray.origin[k]);
    [
        x - simd.splat_f64(ray.shear[0]) * z,
        y - simd.splat_f64(ray.shear[1]) * z,
    ]
}

/// Which polygons, projected along rays, have these inside or on their boundary: those whose edge
/// functions do not differ in sign. Triangles have no fourth corner.
#[inline(always)]
pub(crate) fn around_origin<S: Simd>(
    simd: S,
    [a, b, c]: [[S::F64; 2]; 3],
    d: Option<[S::F64; 2]>,
) -> u8 {
    let (ab, bc) = (edge::<S>(a, b), edge::<S>(b, c));
    let (mut least, mut most) = (ab.min(bc), ab.max(bc));
    if let Some(d) = d {
        let cd = edge::<S>(c, d);
        (least, most) = (least.min(cd), most.max(cd));
    }
    let back = edge::<S>(d.unwrap_or(c), a);
    let zero = simd.splat_f64(0.0);
    zero.less(most.max(back)) ^ least.min(back).less(zero)
}

#[inline(always)]
fn edge<S: Simd>(a: [S::F64; 2], b: [S::F64; 2]) -> S::F64 {
    a[0] * b[1] - a[1] * b[0]
}
