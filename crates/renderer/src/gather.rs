//! Final gathering: the light that a point gets from what others reflect, by looking around from it
//! (Reichert, "A Two-Pass Radiosity Method Driven by Lights and Viewer Position", 1992).
//!
//! What patches are too coarse for at the point itself, as the shadow in a corner, is there, and
//! what they err by where one looks to is evened out. There, too, light straight from emitters is
//! exact, which matters where shadows end nearby. Directions have the density `cos / pi`, so
//! irradiance is the mean of the radiosities that they meet.

use crate::Rgb;
use crate::direct::{Cutting, DirectLight, EmitterSamples, Receivers};
use crate::fields::Fields;
use crate::interpolate::{Interpolant, SurfacePoints};
use crate::irradiance_filter::Gathered;
use crate::pixel_sampler::SampleNumbers;
use crate::samples::sobol;
use radiosity_geometry::{DVec2, DVec3, FaceId, Mesh, Occluders, Ray};
use radiosity_simd::{Float, LANES, Simd};
use std::f64::consts::TAU;

/// Looks around.
pub(crate) struct Gather<'a> {
    mesh: &'a Mesh,
    reflectance: &'a [Rgb],
    occluders: Occluders,
    indirect: Interpolant<'a>,
    directions: u32,
}

/// What eight rays have met.
#[derive(Default)]
struct FirstHits {
    lanes: u8,
    /// The sum of the inverse distances, backs included.
    inverse: f32,
    patches: [u32; LANES],
    at: [[f64; LANES]; 3],
    normals: [[f64; LANES]; 3],
    /// What is reflected there of indirect light.
    indirect: [[f32; LANES]; 3],
    reflectance: [[f32; LANES]; 3],
}

impl<'a> Gather<'a> {
    /// In so many directions from each point.
    pub(crate) fn new(
        mesh: &'a Mesh,
        fields: &Fields<'a>,
        crease_angle: f64,
        directions: u32,
    ) -> Gather<'a> {
        Gather {
            mesh,
            reflectance: fields.reflectance,
            occluders: Occluders::new(mesh),
            indirect: Interpolant::new(mesh, (fields, crease_angle), fields.indirect),
            directions,
        }
    }

    /// The irradiance at samples of a pixel from what others reflect; `direct` lights what is met.
    #[inline(always)]
    pub(crate) fn look_around<S: Simd>(
        &self,
        simd: S,
        points: &SurfacePoints,
        numbers: &SampleNumbers,
        (direct, workspace): (&DirectLight<'_>, &mut Cutting),
    ) -> Gathered {
        let mut result = Gathered {
            irradiance: [[0.0; LANES]; 3],
            inverse: [0.0; LANES],
        };
        let share = 1.0 / self.directions as f32;
        for lane in (0..LANES).filter(|lane| points.lanes >> lane & 1 != 0) {
            let at = DVec3::from_array(points.in_space.map(|axis| axis[lane]));
            let (at, normal) = match direct.smooth(points.face) {
                Some(smooth) => {
                    let on_face = DVec2::from_array(points.on_face.map(|axis| axis[lane]));
                    smooth.at(on_face, at)
                }
                None => (at, self.mesh.faces[points.face.index()].normal),
            };
            // All samples of a pixel share one sequence.
            let first = (numbers.first + lane as u32).wrapping_mul(self.directions);
            let mut sums = [simd.splat_f32(0.0); 3];
            for from in (0..self.directions).step_by(LANES) {
                let count = (self.directions - from).min(LANES as u32);
                let taken = (first.wrapping_add(from), count);
                let met = self.look((points.face, at, normal), taken, numbers.scramble);
                result.inverse[lane] += share * met.inverse;
                if met.lanes != 0 {
                    self.add(simd, &met, (direct, &mut *workspace), &mut sums);
                }
            }
            for (result, sum) in result.irradiance.iter_mut().zip(sums) {
                result[lane] = share * sum.lanes().iter().sum::<f32>();
            }
        }
        result
    }

    /// Looks in some directions, eight at most.
    fn look(
        &self,
        (face, at, normal): (FaceId, DVec3, DVec3),
        (first, count): (u32, u32),
        scramble: [u32; 2],
    ) -> FirstHits {
        let (tangent, bitangent) = normal.any_orthonormal_pair();
        let mut met = FirstHits::default();
        for lane in 0..count as usize {
            let number = first.wrapping_add(lane as u32);
            let [x, y, z] = raised(sobol(number, scramble));
            let ray = Ray::new(at, x * tangent + y * bitangent + z * normal);
            let hit = self.occluders.closest_hit_from(face, &ray);
            met.inverse += hit.map_or(0.0, |hit| 1.0 / hit.t) as f32;
            let Some(hit) = hit.filter(|hit| hit.front) else {
                continue;
            };
            let there = self.mesh.locate(hit.face, ray.at(hit.t));
            met.lanes |= 1 << lane;
            met.patches[lane] = there.patch as u32;
            let point = ray.at(hit.t).to_array();
            let normal = self.mesh.faces[hit.face.index()].normal.to_array();
            let indirect = self.indirect.at_location(&there);
            for axis in 0..3 {
                met.at[axis][lane] = point[axis];
                met.normals[axis][lane] = normal[axis];
                met.indirect[axis][lane] = indirect[axis];
                met.reflectance[axis][lane] = self.reflectance[there.patch][axis];
            }
        }
        met
    }

    /// Adds what is reflected where rays have met something.
    #[inline(always)]
    fn add<S: Simd>(
        &self,
        simd: S,
        met: &FirstHits,
        (direct, workspace): (&DirectLight<'_>, &mut Cutting),
        sums: &mut [S::F32; 3],
    ) {
        let [x, y, z] = &met.at;
        let [u, v, w] = &met.normals;
        let receivers = Receivers {
            patches: met.patches,
            at: [simd.f64(x), simd.f64(y), simd.f64(z)],
            normals: [simd.f64(u), simd.f64(v), simd.f64(w)],
            lanes: met.lanes,
            samples: EmitterSamples::Single,
        };
        let irradiance = direct.irradiance(simd, &receivers, workspace);
        for c in 0..3 {
            let reflected = irradiance[c] * simd.f32(&met.reflectance[c]);
            // Lanes that have met nothing are 0.
            sums[c] = sums[c] + reflected + simd.f32(&met.indirect[c]);
        }
    }
}

/// A point of the unit square as a point of the hemisphere, of density `cos / pi` (Malley's
/// method).
fn raised(at: DVec2) -> [f64; 3] {
    let (sin, cos) = (TAU * at.y).sin_cos();
    let radius = at.x.sqrt();
    [radius * cos, radius * sin, (1.0 - at.x).sqrt()]
}
