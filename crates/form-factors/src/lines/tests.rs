//! What a parabola leaves of the kernel along a line.

use super::*;
use crate::element::Element;
use crate::exchange;
use radiosity_geometry::{DVec3, Divisions, Mesh, Shape, Surface, subdivide};
use radiosity_simd::{InstructionSet, Kernel};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Pieces into which a line is cut.
const PIECES: usize = 200;

/// The share of the light on a line up to the end of each piece, by parabola; the line is the
/// middle one, seen from the middle.
struct Parabola<'a>([&'a Target; 2]);

impl Kernel for Parabola<'_> {
    type Output = [f64; PIECES];

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> [f64; PIECES] {
        let [from, across] = self.0;
        let half = simd.splat_f64(0.5);
        let p = points(simd, from, half, half);
        let line = line(simd, across, half);
        let light = light(simd, (from, &p), (across, &line));
        let upto = |k: usize| light.at(simd.splat_f64(k as f64 / PIECES as f64)).lanes()[0];
        std::array::from_fn(|k| upto(k + 1) / upto(PIECES))
    }
}

/// The same by the midpoint rule on the kernel.
fn exact(mesh: &Mesh) -> [f64; PIECES] {
    let [i, j] = [0, 1].map(|k: usize| &mesh.patches[k]);
    let p = i.polygon.bilinear(0.5, 0.5);
    let piece = |k: usize| {
        let q = j.polygon.bilinear(0.5, (k as f64 + 0.5) / PIECES as f64);
        exchange::kernel(p, i.normal, q, j.normal)
    };
    let total: f64 = (0..PIECES).map(piece).sum();
    let mut sum = 0.0;
    std::array::from_fn(|k| {
        sum += piece(k);
        sum / total
    })
}

fn vector(rng: &mut Pcg64Mcg, size: f64) -> DVec3 {
    let mut coordinate = || size * (rng.random::<f64>() - 0.5);
    DVec3::new(coordinate(), coordinate(), coordinate())
}

/// Any shadow is a difference of two of these shares, of parallelograms wholly in front of each
/// other, at any angle. The midpoint rule errs by 1e-5.
#[test]
fn parabolas_keep_their_bias() {
    let mut rng = Pcg64Mcg::seed_from_u64(3);
    let (mut count, mut worst) = (0, 0.0_f64);
    while count < 3000 {
        let surfaces = [vector(&mut rng, 0.1), vector(&mut rng, 8.0)].map(|corner| Surface {
            shape: Shape::Parallelogram {
                corner,
                edge_a: vector(&mut rng, 2.0),
                edge_b: vector(&mut rng, 2.0),
            },
            divisions: None,
        });
        let Ok(mesh) = subdivide(&surfaces, Divisions::uniform(1)) else {
            continue;
        };
        let [a, b] = [0, 1].map(|k: usize| Element::new(&mesh.patches[k]));
        let ratio = b.radius / a.centroid.distance(b.centroid);
        if !a.faces_whole(&b, 0.0) || !b.faces_whole(&a, 0.0) || ratio > 1.0 {
            continue;
        }
        let [i, j] = [0, 1].map(|k: usize| Target::new(&mesh.patches[k]));
        let found = InstructionSet::current().run(Parabola([&i, &j]));
        let errors = std::iter::zip(found, exact(&mesh)).map(|(found, exact)| found - exact);
        let (low, high) = errors.fold((0.0_f64, 0.0_f64), |(l, h), e| (l.min(e), h.max(e)));
        worst = worst.max((high - low) / (bias(ratio) + 1e-5));
        count += 1;
    }
    println!("worst error: {worst:.2} of the bound");
    assert!(worst < 1.0, "{worst}");
}
