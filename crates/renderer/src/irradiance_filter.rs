//! Gathered light at fragments, the parts of faces that pixels show, each smoothed over its
//! neighbours.
//!
//! What few directions tell of a fragment is noisy, but light that is reflected more often changes
//! slowly: over a distance as far as other surfaces are (Ward & Heckbert, "Irradiance Gradients",
//! 1992). So a plane is fitted to the irradiances of fragments that are nearer than a part of that,
//! by weighted least squares, and its value at the fragment is taken: no slope is lost, and no edge
//! crossed.

mod plane_fit;

use crate::{Rgb, add_scaled};
use plane_fit::PlaneFit;
use radiosity_geometry::{DVec2, DVec3, FaceId, Mesh, SurfaceId};
use radiosity_simd::LANES;

/// The part of a face that a pixel shows: its samples there.
#[derive(Clone, Debug)]
pub(crate) struct Fragment {
    /// The column of the pixel.
    pub(crate) x: u32,
    pub(crate) face: FaceId,
    /// How much of its irradiance the pixel shows.
    pub(crate) gain: Rgb,
    /// Sums over samples.
    count: f32,
    irradiance: Rgb,
    /// Of mean inverse distances to what is seen.
    inverse: f32,
    position: DVec3,
}

/// What has been gathered at eight samples on a face.
pub(crate) struct Gathered {
    pub(crate) irradiance: [[f32; LANES]; 3],
    /// The means of inverse distances to what was met.
    pub(crate) inverse: [f32; LANES],
}

/// Pixels to either side whose fragments count.
const REACH: u32 = 4;
/// And how far away they may be, in harmonic mean distances to what is seen.
const NEAR: f64 = 0.3;
/// Fragments nearer than so many pixels always count: in a corner of the room nothing else is near
/// enough, and few directions alone are noise.
const NEXT: f64 = 3.0;
/// The cosine between normals below which faces of a mesh do not share their light.
const ALIKE: f64 = 0.95;

impl Fragment {
    pub(crate) fn new(face: FaceId) -> Fragment {
        Fragment {
            x: 0,
            face,
            gain: [0.0; 3],
            count: 0.0,
            irradiance: [0.0; 3],
            inverse: 0.0,
            position: DVec3::ZERO,
        }
    }

    /// Adds the sample in a lane; `gain` is how much the pixel shows of it.
    pub(crate) fn add(&mut self, lane: usize, at: DVec3, gathered: &Gathered, gain: Rgb) {
        self.count += 1.0;
        add_scaled(
            &mut self.irradiance,
            1.0,
            gathered.irradiance.map(|channel| channel[lane]),
        );
        add_scaled(&mut self.gain, 1.0, gain);
        self.inverse += gathered.inverse[lane];
        self.position += at;
    }

    fn center(&self) -> DVec3 {
        self.position / f64::from(self.count)
    }
}

/// Smooths what was gathered at the fragments of rows of pixels, each from left to right.
pub(crate) struct IrradianceFilter<'a> {
    mesh: &'a Mesh,
    rows: &'a [Vec<Fragment>],
}

impl<'a> IrradianceFilter<'a> {
    pub(crate) fn new(mesh: &'a Mesh, rows: &'a [Vec<Fragment>]) -> IrradianceFilter<'a> {
        IrradianceFilter { mesh, rows }
    }

    /// The irradiance at a fragment of a row, as its neighbours see it.
    pub(crate) fn irradiance(&self, y: usize, fragment: &Fragment) -> Rgb {
        let (center, normal) = (fragment.center(), self.normal(fragment));
        let (tangent, bitangent) = normal.any_orthonormal_pair();
        let radius = NEAR * f64::from(fragment.count / fragment.inverse.max(f32::MIN_POSITIVE));
        let mut fit = PlaneFit::default();
        for (row, other) in self.around(y, fragment) {
            let offset = other.center() - center;
            let pixels = DVec2::new(
                f64::from(other.x) - f64::from(fragment.x),
                row as f64 - y as f64,
            );
            let in_space = 1.0 - offset.length_squared() / (radius * radius);
            let closeness = in_space.max(1.0 - pixels.length_squared() / (NEXT * NEXT));
            let is_itself = std::ptr::eq(other, fragment);
            if is_itself || closeness > 0.0 && self.are_alike(other, fragment, normal) {
                let kernel = if is_itself {
                    1.0
                } else {
                    closeness * closeness
                };
                let plane = [offset.dot(tangent), offset.dot(bitangent)];
                let weight = kernel * f64::from(other.count);
                // Means over samples, times their number.
                let sums = other.irradiance.map(|sum| kernel * f64::from(sum));
                fit.add(plane, weight, sums);
            }
        }
        fit.at_center()
    }

    /// The fragments of pixels nearby, and their rows.
    fn around(&self, y: usize, fragment: &Fragment) -> impl Iterator<Item = (usize, &'a Fragment)> {
        let reach = REACH as usize;
        let rows = y.saturating_sub(reach)..(y + reach + 1).min(self.rows.len());
        let (left, right) = (fragment.x.saturating_sub(REACH), fragment.x + REACH);
        let all = self.rows;
        rows.flat_map(move |y| {
            let first = all[y].partition_point(|other| other.x < left);
            let row = all[y][first..].iter();
            row.take_while(move |other| other.x <= right)
                .map(move |other| (y, other))
        })
    }

    /// Whether two fragments lie on one smooth surface.
    fn are_alike(&self, other: &Fragment, fragment: &Fragment, normal: DVec3) -> bool {
        other.face == fragment.face
            || self.surface(other) == self.surface(fragment)
                && self.normal(other).dot(normal) >= ALIKE
    }

    fn normal(&self, fragment: &Fragment) -> DVec3 {
        self.mesh.faces[fragment.face.index()].normal
    }

    fn surface(&self, fragment: &Fragment) -> SurfaceId {
        self.mesh.faces[fragment.face.index()].surface
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use radiosity_geometry::{Divisions, Shape, Surface, subdivide};

    /// Two squares of a unit edge, beside each other in one plane but not one surface.
    fn squares() -> Mesh {
        let surface = |x: f64| Surface {
            shape: Shape::Quad(
                [[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]]
                    .map(|[x, y]| DVec3::new(x, y, 0.0)),
            ),
            divisions: None,
        };
        subdivide(&[surface(0.0), surface(1.0)], Divisions::uniform(1)).unwrap()
    }

    /// A fragment of one sample in each of 10 x 10 pixels, whose irradiance is told by its place.
    fn rows(inverse: f32, value: impl Fn(DVec3) -> f32) -> Vec<Vec<Fragment>> {
        let fragment = |x: u32, y: u32| {
            let at = DVec3::new(0.2 * f64::from(x) + 0.1, 0.1 * f64::from(y) + 0.05, 0.0);
            let mut fragment = Fragment::new(FaceId(u32::from(x >= 5)));
            let gathered = Gathered {
                irradiance: [[value(at); LANES]; 3],
                inverse: [inverse; LANES],
            };
            fragment.add(3, at, &gathered, [1.0; 3]);
            fragment.x = x;
            fragment
        };
        (0..10)
            .map(|y| (0..10).map(|x| fragment(x, y)).collect())
            .collect()
    }

    /// At borders, too, where all neighbours lie to one side; what the other square has does not
    /// count.
    #[test]
    fn slopes_are_kept() {
        let mesh = squares();
        let plane = |at: DVec3| {
            let jump = if at.x > 1.0 { 100.0 } else { 0.0 };
            (7.0 + 2.0 * at.x - 3.0 * at.y + jump) as f32
        };
        let rows = rows(0.3, plane);
        let filter = IrradianceFilter::new(&mesh, &rows);
        for (y, row) in rows.iter().enumerate() {
            for fragment in row {
                let expected = plane(fragment.center());
                let found = filter.irradiance(y, fragment)[1];
                assert!((found / expected - 1.0).abs() < 1e-5, "{found} {expected}");
            }
        }
    }

    /// Where something is near, only the next pixels are asked; where nothing is, noise becomes a
    /// third of itself at least, in the middle: some 40 neighbours count.
    #[test]
    fn neighbours_count_as_far_as_surfaces_are_away() {
        let mesh = squares();
        let noisy = |at: DVec3| 1.0 + ((1000.0 * at.x).round() * 0.37 + at.y * 91.7).sin() as f32;
        // Three rows below the fifth, and beyond.
        let elsewhere = |at: DVec3| if at.y > 0.7 { 100.0 } else { noisy(at) };
        let found = |value: &dyn Fn(DVec3) -> f32, inverse| {
            let rows = rows(inverse, value);
            IrradianceFilter::new(&mesh, &rows).irradiance(4, &rows[4][2])[0]
        };
        assert_eq!(found(&noisy, 100.0), found(&elsewhere, 100.0));
        assert_ne!(found(&noisy, 0.3), found(&elsewhere, 0.3));
        let rows = rows(0.3, noisy);
        let filter = IrradianceFilter::new(&mesh, &rows);
        let inner = rows.iter().enumerate().skip(3).take(4);
        let (mut left, mut all) = (0.0, 0.0);
        for (y, row) in inner {
            left += (filter.irradiance(y, &row[2])[0] - 1.0).powi(2);
            all += (noisy(row[2].center()) - 1.0).powi(2);
        }
        assert!(left < all / 9.0, "{left} {all}");
    }

    /// One fragment alone has what was gathered there.
    #[test]
    fn a_lonely_fragment_keeps_its_irradiance() {
        let mesh = squares();
        let mut rows = rows(0.0, |_| 2.5);
        rows.truncate(1);
        rows[0].truncate(1);
        assert_eq!(
            IrradianceFilter::new(&mesh, &rows).irradiance(0, &rows[0][0]),
            [2.5; 3]
        );
    }
}
