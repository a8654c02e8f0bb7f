//! A few points that stand for all regular ones of a patch as others see it from afar.
//!
//! Their moments agree with those of all points up to the third order. Where the kernel is smooth,
//! the sums over all pairs of points then differ by its fourth and higher derivatives alone.

use crate::sampling::points::{Sample, regular};
use radiosity_geometry::{DVec3, Polygon};

/// How many points stand for all others.
pub(crate) const REDUCED_POINTS: usize = 4;

/// The points that stand for the `n x n` regular ones; their areas add up to the patch's. `None` if
/// these are not more, or do not have the same area each.
pub(crate) fn reduced_points(polygon: &Polygon, n: u32) -> Option<[Sample; REDUCED_POINTS]> {
    if n * n <= REDUCED_POINTS as u32 {
        None
    } else if polygon.is_triangle() {
        Some(on_triangle(polygon, n))
    } else if polygon.is_parallelogram() {
        Some(on_parallelogram(polygon, n))
    } else {
        None
    }
}

/// Along each edge, one standard deviation of all points to either side of the middle.
fn on_parallelogram(polygon: &Polygon, n: u32) -> [Sample; REDUCED_POINTS] {
    let deviation = ((1.0 - f64::from(n).powi(-2)) / 12.0).sqrt();
    let [low, high] = [0.5 - deviation, 0.5 + deviation];
    [(low, low), (low, high), (high, low), (high, high)].map(|(u, v)| Sample {
        point: polygon.bilinear(u, v),
        area: polygon.area() / REDUCED_POINTS as f64,
    })
}

/// The centroid, whose area is negative (seen from afar, the others make up for it), and a point on
/// the way from it to each corner. By symmetry there is but one moment of the second order, and one
/// of the third.
fn on_triangle(polygon: &Polygon, n: u32) -> [Sample; REDUCED_POINTS] {
    let standard = Polygon::triangle([DVec3::ZERO, DVec3::X, DVec3::Y]);
    let weights = regular(&standard, n).into_iter();
    let deviations: Vec<f64> = weights.map(|sample| sample.point.x - 1.0 / 3.0).collect();
    let moment = |order| {
        let powers = deviations.iter().map(|deviation| deviation.powi(order));
        powers.sum::<f64>() / deviations.len() as f64
    };
    // Of the corners themselves, each with weight one, they are 2/3 and 2/9.
    let (second, third) = (1.5 * moment(2), 4.5 * moment(3));
    let way = third / second;
    let weight = second / (way * way);
    let centroid = Sample {
        point: polygon.centroid(),
        area: (1.0 - 3.0 * weight) * polygon.area(),
    };
    let toward = |k: usize| Sample {
        point: centroid.point.lerp(polygon.corners()[k], way),
        area: weight * polygon.area(),
    };
    [centroid, toward(0), toward(1), toward(2)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The moments of the points about the centroid, by the powers of two coordinates.
    fn moments(samples: &[Sample], centroid: DVec3) -> Vec<f64> {
        let powers = (0..4).flat_map(|i| (0..4 - i).map(move |j| (i, j)));
        let moment = |(i, j)| {
            let term = |sample: &Sample| {
                let d = sample.point - centroid;
                sample.area * d.x.powi(i) * d.y.powi(j)
            };
            samples.iter().map(term).sum()
        };
        powers.map(moment).collect()
    }

    #[test]
    fn moments_agree() {
        let (b, c) = (DVec3::new(2.0, 0.5, 0.0), DVec3::new(0.3, 1.0, 0.0));
        let triangle = Polygon::triangle([DVec3::ZERO, b, c]);
        let parallelogram = Polygon::quad([DVec3::ZERO, b, b + c, c]);
        for polygon in [triangle, parallelogram] {
            for n in 3..8 {
                let centroid = polygon.centroid();
                let few = moments(&reduced_points(&polygon, n).unwrap(), centroid);
                let all = moments(&regular(&polygon, n), centroid);
                let errors = few.iter().zip(&all).map(|(few, all)| (few - all).abs());
                assert!(errors.fold(0.0, f64::max) < 1e-14, "{n}: {few:?}, {all:?}");
            }
        }
    }

    #[test]
    fn none_stand_for_as_few_or_for_uneven_ones() {
        let corners = [
            DVec3::ZERO,
            DVec3::X,
            DVec3::new(0.7, 1.0, 0.0),
            DVec3::new(0.3, 1.0, 0.0),
        ];
        assert!(reduced_points(&Polygon::quad(corners), 3).is_none());
        let square = Polygon::quad([DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y]);
        assert!(reduced_points(&square, 2).is_none());
    }
}
