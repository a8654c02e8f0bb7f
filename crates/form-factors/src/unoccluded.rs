//! The exchange of two patches with nothing between them: the cheapest rule that is good enough.

use crate::accurate::Exchange;
use crate::contour;
use crate::element::{Element, RULES};
use crate::exchange::all_pairs;
use crate::tally::Sight;
use std::f64::consts::PI;

/// `S_ij` of two patches, if nothing stood between them, to an error of about `error` times what it
/// were if they faced each other squarely.
///
/// `tolerance` is the height up to which a corner counts as in a plane.
pub(crate) fn exchange(i: &Element, j: &Element, error: f64, tolerance: f64) -> Exchange {
    let whole = i.faces_whole(j, tolerance) && j.faces_whole(i, tolerance);
    if let Some(rule) = rule(i, j, error).filter(|_| whole) {
        let [of_i, of_j] = [i, j].map(|element| (&element.rules[rule][..], element.normal));
        let squarely = i.area() * j.area() / (PI * i.centroid.distance_squared(j.centroid));
        return clear(all_pairs(of_i, of_j, |_, _| true), error * squarely);
    }
    let parts = (j.clip(&i.corners, tolerance), i.clip(&j.corners, tolerance));
    let (Some(part_i), Some(part_j)) = parts else {
        return clear(0.0, 0.0);
    };
    let value = contour::exchange(&part_i, &part_j, tolerance);
    debug_assert!(value.is_finite());
    // Parts that barely see each other may come out below zero, by rounding.
    let value = value.max(0.0);
    clear(value, CONTOUR_ERROR * value)
}

fn clear(value: f64, error: f64) -> Exchange {
    let sight = Sight::Clear;
    Exchange {
        value,
        error,
        sight,
    }
}

/// What halving edges leaves, relative to the exchange.
const CONTOUR_ERROR: f64 = 1e-8;

/// The first of Gauss's rules whose error is below a bound, by the ratio of the patches' radii to
/// their distance.
fn rule(i: &Element, j: &Element, error: f64) -> Option<usize> {
    let ratio = (i.radius + j.radius) / i.centroid.distance(j.centroid);
    let mut power = 1.0;
    (0..RULES).find(|&rule| {
        power *= ratio * ratio;
        ERROR[rule] * power < error
    })
}

/// The error of each rule is at most this times `ratio^(2 points)`, relative to the exchange of
/// patches of these areas, at this distance, that face each other squarely.
const ERROR: [f64; RULES] = [1.0, 0.15, 0.02];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::points::Sample;
    use radiosity_geometry::{DVec3, Divisions, Shape, Surface, subdivide};
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    fn random_vector(rng: &mut Pcg64Mcg, size: f64) -> DVec3 {
        let mut coordinate = || size * (rng.random::<f64>() - 0.5);
        DVec3::new(coordinate(), coordinate(), coordinate())
    }

    fn random_element(rng: &mut Pcg64Mcg, spread: f64) -> Option<Element> {
        let corner = random_vector(rng, spread);
        let (edge_a, edge_b) = (random_vector(rng, 2.0), random_vector(rng, 2.0));
        let shape = if rng.random() {
            Shape::Triangle([corner, corner + edge_a, corner + edge_b])
        } else {
            Shape::Parallelogram {
                corner,
                edge_a,
                edge_b,
            }
        };
        let surface = Surface {
            shape,
            divisions: None,
        };
        let mesh = subdivide(&[surface], Divisions::uniform(1)).ok()?;
        Some(Element::new(&mesh.patches[0]))
    }

    /// Random triangles and parallelograms in front of each other: 99 in 100 keep the bound, and
    /// none exceeds three times that.
    #[test]
    fn rules_keep_their_error() {
        let mut rng = Pcg64Mcg::seed_from_u64(1);
        for (rule, constant) in ERROR.into_iter().enumerate() {
            let (mut kept, mut count) = (0, 0);
            while count < 2000 {
                let pair = (
                    random_element(&mut rng, 0.0),
                    random_element(&mut rng, 20.0),
                );
                let (Some(i), Some(j)) = pair else { continue };
                let is_whole = |a: &Element, b: &Element| {
                    a.clip(&b.corners, 0.0)
                        .is_some_and(|part| part == b.corners)
                };
                let ratio = (i.radius + j.radius) / i.centroid.distance(j.centroid);
                if !is_whole(&i, &j) || !is_whole(&j, &i) || ratio > 0.5 {
                    continue;
                }
                let exact = contour::exchange(&i.corners, &j.corners, 1e-12);
                let samples = |element: &Element| element.rules[rule].clone();
                let (of_i, of_j) = (samples(&i), samples(&j));
                let found = all_pairs((&of_i, i.normal), (&of_j, j.normal), |_, _| true);
                let bound = constant * ratio.powi(2 * (rule as i32 + 1));
                let area = |rule: &[Sample]| rule.iter().map(|sample| sample.area).sum::<f64>();
                let squarely =
                    area(&of_i) * area(&of_j) / (PI * i.centroid.distance_squared(j.centroid));
                // The contour integral has its own error, of 1e-9 of the squares of lengths.
                let error = (found - exact).abs() / squarely - 1e-9 / ratio.powi(2);
                assert!(error < 3.0 * bound, "{rule}: {error} {bound}");
                kept += usize::from(error < bound);
                count += 1;
            }
            assert!(100 * kept >= 98 * count, "{rule}: {kept} of {count}");
        }
    }
}
