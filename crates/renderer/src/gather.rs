//! Final gathering: the light that a point gets from what others reflect, by looking around from it
//! (Reichert, "A Two-Pass Radiosity Method Driven by Lights and Viewer Position", 1992).
//!
//! What patches are too coarse for at the point itself, as the shadow in a corner, is there, and
//! what they err by where one looks to is evened out. Directions have the density `cos / pi`, so
//! irradiance is the mean of the radiosities that they meet.

use crate::Rgb;
use crate::fields::Fields;
use crate::interpolate::{Interpolant, Places};
use crate::render::SampleNumbers;
use crate::samples::sobol;
use radiosity_geometry::{DVec2, DVec3, FaceId, Mesh, Occluders, Ray};
use radiosity_simd::LANES;
use std::f64::consts::TAU;

/// Looks around.
pub(crate) struct Gather<'a> {
    mesh: &'a Mesh,
    occluders: Occluders,
    reflected: Interpolant<'a>,
    directions: u32,
}

impl<'a> Gather<'a> {
    /// In so many directions from each point.
    pub(crate) fn new(
        mesh: &'a Mesh,
        fields: &Fields<'_>,
        crease_angle: f64,
        directions: u32,
    ) -> Gather<'a> {
        Gather {
            mesh,
            occluders: Occluders::new(mesh),
            reflected: Interpolant::new(mesh, (fields, crease_angle), fields.reflected),
            directions,
        }
    }

    /// The irradiance at samples of a pixel, by channel.
    pub(crate) fn irradiance(&self, places: &Places, numbers: &SampleNumbers) -> [[f32; LANES]; 3] {
        let mut result = [[0.0; LANES]; 3];
        for lane in (0..LANES).filter(|lane| places.lanes >> lane & 1 != 0) {
            let at = DVec3::from_array(places.points.map(|axis| axis[lane]));
            let irradiance = self.around((places.face, at), numbers, lane as u32);
            for c in 0..3 {
                result[c][lane] = irradiance[c];
            }
        }
        result
    }

    fn around(&self, (face, at): (FaceId, DVec3), numbers: &SampleNumbers, lane: u32) -> Rgb {
        let normal = self.mesh.faces[face.index()].normal;
        let (tangent, bitangent) = normal.any_orthonormal_pair();
        // All samples of a pixel share one sequence.
        let first = (numbers.first + lane) * self.directions;
        let mut sum = [0.0; 3];
        for number in first..first + self.directions {
            let [x, y, z] = raised(sobol(number, numbers.scramble));
            let ray = Ray::new(at, x * tangent + y * bitangent + z * normal);
            let hit = self
                .occluders
                .closest_hit(&ray, 0.0, f64::INFINITY, Some(face));
            if let Some(hit) = hit.filter(|hit| hit.front) {
                let met = self.reflected.at_point(hit.face, ray.at(hit.t));
                (0..3).for_each(|c| sum[c] += met[c]);
            }
        }
        sum.map(|sum| sum / self.directions as f32)
    }
}

/// A point of the unit square as a point of the hemisphere, of density `cos / pi` (Malley's method).
fn raised(at: DVec2) -> [f64; 3] {
    let (sin, cos) = (TAU * at.y).sin_cos();
    let radius = at.x.sqrt();
    [radius * cos, radius * sin, (1.0 - at.x).sqrt()]
}
