//! Points on patches, one for each of `n x n` strata: equal cells of the bilinear parameters on
//! quads, congruent sub-triangles on triangles.

use radiosity_geometry::{DVec2, DVec3, Polygon};

/// A point and the area it stands for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    pub(crate) point: DVec3,
    /// Square scene units.
    pub(crate) area: f64,
}

/// The regular points of a patch; their areas add up to the patch's.
pub(crate) fn regular(polygon: &Polygon, n: u32) -> Vec<Sample> {
    let center = if polygon.is_triangle() {
        DVec2::splat(1.0 / 3.0)
    } else {
        DVec2::splat(0.5)
    };
    let strata = n * n;
    (0..strata)
        .map(|stratum| {
            let Sample { point, area } = in_stratum(polygon, n, stratum, center);
            let area = area / f64::from(strata);
            Sample { point, area }
        })
        .collect()
}

/// The point of a stratum that `uniform`, in the unit square, picks with uniform density in the
/// stratum's parameters. Its area is that of the whole patch, as the Jacobian sees it there.
pub(crate) fn jittered(polygon: &Polygon, n: u32, stratum: u32, uniform: DVec2) -> Sample {
    let folds = polygon.is_triangle() && uniform.x + uniform.y > 1.0;
    let offset = if folds { 1.0 - uniform } else { uniform };
    in_stratum(polygon, n, stratum, offset)
}

/// The point at `offset` in a stratum: of the unit square on quads, in barycentric weights on
/// the sub-triangles of a triangle.
fn in_stratum(polygon: &Polygon, n: u32, stratum: u32, offset: DVec2) -> Sample {
    let (i, j) = (stratum / n, stratum % n);
    let scale = 1.0 / f64::from(n);
    let at =
        |i: u32, j: u32, offset: DVec2| scale * (DVec2::new(f64::from(i), f64::from(j)) + offset);
    if !polygon.is_triangle() {
        let uv = at(i, j, offset);
        return Sample {
            point: polygon.bilinear(uv.x, uv.y),
            area: polygon.bilinear_jacobian(uv.x, uv.y),
        };
    }
    // Half of the n x n cells are the upright sub-triangles, the other half, turned by 180
    // degrees, the inverted ones.
    let st = if i + j < n {
        at(i, j, offset)
    } else {
        at(n - 1 - i, n - 1 - j, 1.0 - offset)
    };
    Sample {
        point: polygon.barycentric(st.x, st.y),
        area: polygon.area(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle() -> Polygon {
        Polygon::triangle([DVec3::ZERO, 2.0 * DVec3::X, 3.0 * DVec3::Y])
    }

    fn trapezoid() -> Polygon {
        let corners = [
            DVec3::ZERO,
            4.0 * DVec3::X,
            DVec3::new(2.0, 2.0, 0.0),
            2.0 * DVec3::Y,
        ];
        Polygon::quad(corners)
    }

    #[test]
    fn areas_of_regular_points_add_up() {
        // The Jacobian of a planar quad is linear, so the midpoint rule integrates it exactly.
        for polygon in [triangle(), trapezoid()] {
            for n in 1..6 {
                let sum: f64 = regular(&polygon, n).iter().map(|s| s.area).sum();
                assert!((sum - polygon.area()).abs() < 1e-14 * polygon.area());
            }
        }
    }

    #[test]
    fn regular_points_of_a_triangle_are_centroids_of_its_parts() {
        let points = regular(&triangle(), 2);
        let mean = points.iter().map(|s| s.point).sum::<DVec3>() / 4.0;
        assert!(mean.distance(triangle().centroid()) < 1e-15);
        // The centroid of the inverted sub-triangle is the triangle's own.
        assert!(points[3].point.distance(triangle().centroid()) < 1e-15);
    }

    #[test]
    fn jittered_points_of_a_triangle_stay_in_it() {
        for stratum in 0..9 {
            for (x, y) in [(0.01, 0.02), (0.99, 0.98), (0.3, 0.9)] {
                let p = jittered(&triangle(), 3, stratum, DVec2::new(x, y)).point;
                assert!(p.x > 0.0 && p.y > 0.0 && p.x / 2.0 + p.y / 3.0 < 1.0);
            }
        }
    }
}
