//! Random walks of light, backwards (Kajiya, "The Rendering Equation", 1986).
//!
//! Direct light is sampled twice, by points on emitters and by the walk's own directions, and
//! the two are combined by the balance heuristic (Veach & Guibas, "Optimally Combining Sampling
//! Techniques for Monte Carlo Rendering", 1995): emitters far away favour the one, emitters that
//! touch the surface, where `1 / r^2` is unbounded, the other.

use crate::Rgb;
use crate::world::{FaceLight, World};
use radiosity_geometry::{DVec3, FaceId, Ray};
use rand::{Rng, RngExt};
use std::f64::consts::PI;

/// Walks this long go on by chance only.
const SURE_BOUNCES: u32 = 3;
/// The largest chance: a room of reflectance 1 must not hold a walk for ever.
const LARGEST_SURVIVAL: f64 = 0.95;

/// What a random walk from a point has found.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Walk {
    /// An unbiased estimate of the radiosity `B` at the point, W/m^2.
    pub(crate) radiosity: Rgb,
    /// Points of surfaces where it gathered light, the first included.
    pub(crate) vertices: u32,
}

/// Walks from a point on the front of a face.
pub(crate) fn walk(world: &World, start: (FaceId, DVec3), rng: &mut impl Rng) -> Walk {
    let mut result = world.face(start.0).emission;
    let mut vertices = 1;
    let mut throughput = [1.0; 3];
    let (mut face, mut point) = start;
    for bounce in 0.. {
        let light = world.face(face);
        throughput = multiply(throughput, light.reflectance);
        let survival = survival(&throughput, bounce);
        if survival < 1.0 {
            if rng.random::<f64>() >= survival {
                break;
            }
            throughput = throughput.map(|t| t / survival);
        }
        let direct = direct_irradiance(world, face, point, rng);
        add(&mut result, multiply(throughput, direct));

        let ray = Ray::new(point, cosine_direction(light, rng));
        let Some((next, at)) = world.next_front(face, &ray) else {
            break;
        };
        let emission = world.face(next).emission;
        if emission != [0.0; 3] {
            // With directions drawn in proportion to the cosine, the mean of pi L is the
            // irradiance, and pi L of a diffuse emitter is its exitance.
            let weight = direction_weight(world, light.normal, point, next, at);
            add(
                &mut result,
                multiply(throughput, emission.map(|e| weight * e)),
            );
        }
        (face, point) = (next, at);
        vertices += 1;
    }
    Walk {
        radiosity: result,
        vertices,
    }
}

/// Russian roulette: walks that carry little go on rarely, and then carry more.
fn survival(throughput: &Rgb, bounce: u32) -> f64 {
    let most = throughput.iter().copied().fold(0.0, f64::max);
    if bounce < SURE_BOUNCES && most > 0.0 {
        1.0
    } else {
        most.min(LARGEST_SURVIVAL)
    }
}

/// Irradiance from a random point on an emitter, weighted against finding it by direction.
fn direct_irradiance(world: &World, face: FaceId, point: DVec3, rng: &mut impl Rng) -> Rgb {
    let Some((emitter, at)) = world.emitters.sample(rng) else {
        return [0.0; 3];
    };
    let (here, there) = (world.face(face), world.face(emitter));
    let exchange = exchange(here.normal, point, there.normal, at);
    let Some(exchange) = exchange.filter(|_| world.sees((face, point), (emitter, at))) else {
        return [0.0; 3];
    };
    let (by_point, by_direction) = (world.emitters.density(emitter), exchange);
    let scale = exchange / (by_point + by_direction);
    there.emission.map(|e| scale * e)
}

/// The weight of an emitter found by direction against finding it by point.
fn direction_weight(world: &World, normal: DVec3, point: DVec3, face: FaceId, at: DVec3) -> f64 {
    let by_point = world.emitters.density(face);
    let by_direction = exchange(normal, point, world.face(face).normal, at);
    by_direction.map_or(0.0, |by_direction| by_direction / (by_direction + by_point))
}

/// `cos cos / (pi r^2)` between two points, if they face each other: the irradiance here per
/// exitance and area there. It is also the probability, per area there, that a direction drawn
/// in proportion to the cosine here leads there.
fn exchange(normal: DVec3, point: DVec3, other_normal: DVec3, other: DVec3) -> Option<f64> {
    let d = other - point;
    let (height_there, height_here) = (normal.dot(d), -other_normal.dot(d));
    let squared = d.length_squared();
    (height_there > 0.0 && height_here > 0.0)
        .then(|| height_there * height_here / (PI * squared * squared))
}

/// A direction in front of a face with density `cos / pi`: a uniform point of the unit disk, raised
/// to the hemisphere (Malley's method). Points of a square outside of the disk are rejected.
fn cosine_direction(face: &FaceLight, rng: &mut impl Rng) -> DVec3 {
    loop {
        let x = 2.0 * rng.random::<f64>() - 1.0;
        let y = 2.0 * rng.random::<f64>() - 1.0;
        let squared = x * x + y * y;
        if squared < 1.0 {
            let [tangent, bitangent] = face.tangents;
            return x * tangent + y * bitangent + (1.0 - squared).sqrt() * face.normal;
        }
    }
}

fn multiply(a: Rgb, b: Rgb) -> Rgb {
    std::array::from_fn(|c| a[c] * b[c])
}

fn add(sum: &mut Rgb, other: Rgb) {
    for (sum, other) in sum.iter_mut().zip(other) {
        *sum += other;
    }
}
