//! Samples the pixels of an image, row by row.

use crate::Rgb;
use crate::interpolate::{PatchCoords, SurfacePoints};
use crate::irradiance_filter::Fragment;
use crate::params::ImageParams;
use crate::render::Shading;
use crate::samples::{SampleSet, SampleSets};
use crate::shade::{Shader, Workspace};
use radiosity_geometry::{Camera, DVec2, DVec3, Mesh, Offsets, Screen, Seen};
use radiosity_simd::{Float, Kernel, LANES, Simd, dispatch};
use std::f32::consts::PI;

/// Samples the pixels of what a camera sees.
pub(crate) struct PixelSampler<'a> {
    mesh: &'a Mesh,
    camera: &'a Camera,
    /// The directions of rays: [`Camera::film`].
    film: [DVec3; 3],
    screen: Screen,
    shader: &'a Shader<'a>,
    samples: SampleSets,
    most_rounds: u32,
    /// The radiosity to which samples are clamped.
    brightest: f32,
}

/// A row of pixels, each as often as there are shadings.
struct PixelRow<'a> {
    sampler: &'a PixelSampler<'a>,
    y: u32,
    row: &'a mut [Rgb],
}

/// Which samples of a pixel are shaded: they share one sequence of further random numbers.
#[derive(Default)]
pub(crate) struct SampleNumbers {
    /// Of the pixel.
    pub(crate) scramble: [u32; 2],
    /// The number of the sample in the first lane.
    pub(crate) first: u32,
    /// How much each counts.
    pub(crate) weights: [f32; LANES],
}

/// What the samples of a pixel have come to.
struct Sums<F> {
    /// By shading and channel, in each lane.
    radiosity: [[F; 3]; Shading::COUNT],
    /// The least and the greatest sample by the last shading, in each lane: the sum of its
    /// channels.
    range: [F; 2],
}

/// Samples that differ by less than this share of the brightest need no more.
const DIFFERENCE: f32 = 0.05;

impl Kernel for PixelRow<'_> {
    type Output = Vec<Fragment>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Vec<Fragment> {
        let sampler = self.sampler;
        let (mut seen, mut workspace) = (Vec::new(), Workspace::default());
        let count = sampler.shader.shadings().len();
        for (x, pixels) in self.row.chunks_exact_mut(count).enumerate() {
            let pixel = (x as u32, self.y);
            let mut sums = Sums {
                radiosity: [[simd.splat_f32(0.0); 3]; Shading::COUNT],
                range: [simd.splat_f32(f32::INFINITY), simd.splat_f32(0.0)],
            };
            workspace.numbers.scramble = sampler.samples.scramble_of(pixel);
            workspace.first_fragment = workspace.fragments.len();
            let mut rounds = 0;
            let mut wants_more = true;
            while wants_more && rounds < sampler.most_rounds {
                let samples = sampler.samples.of_pixel(pixel.0, pixel.1, rounds);
                let is_mixed = sampler
                    .screen
                    .look(simd, pixel, &samples.offsets, &mut seen);
                let count = (LANES * samples.offsets.len()) as u32;
                workspace.numbers.first = rounds * count;
                sampler.add(simd, (pixel, samples), &seen, &mut workspace, &mut sums);
                rounds += 1;
                // What shows two faces may have missed one of them once.
                wants_more = is_mixed && (rounds == 1 || sums.differ());
            }
            let scale = 1.0 / (PI * rounds as f32);
            for (pixel, sums) in pixels.iter_mut().zip(&sums.radiosity) {
                *pixel = [0, 1, 2].map(|c| scale * total(sums[c]));
            }
            for fragment in &mut workspace.fragments[workspace.first_fragment..] {
                fragment.x = pixel.0;
                fragment.gain = fragment.gain.map(|gain| scale * gain);
            }
        }
        workspace.fragments
    }
}

impl<F: Float<f32>> Sums<F> {
    #[inline(always)]
    fn differ(&self) -> bool {
        let (mut low, mut high) = (f32::INFINITY, 0.0f32);
        for (least, greatest) in self.range[0].lanes().into_iter().zip(self.range[1].lanes()) {
            (low, high) = (low.min(least), high.max(greatest));
        }
        high - low > DIFFERENCE * high
    }
}

impl<'a> PixelSampler<'a> {
    pub(crate) fn new(
        mesh: &'a Mesh,
        shader: &'a Shader<'a>,
        camera: &'a Camera,
        params: &ImageParams,
    ) -> PixelSampler<'a> {
        let film = params.film();
        let size = (film.width, film.height);
        PixelSampler {
            film: camera.film(film.width, film.height),
            screen: Screen::new(mesh, (camera, params.backs), size, film.reach()),
            samples: SampleSets::new(&film, params.samples, params.seed),
            most_rounds: params.adaptive,
            brightest: PI * params.brightest,
            mesh,
            shader,
            camera,
        }
    }

    /// Samples a row of pixels, each as often as there are shadings. What is gathered at its
    /// fragments is returned, and still to be added.
    pub(crate) fn sample_row(&self, y: u32, row: &mut [Rgb]) -> Vec<Fragment> {
        dispatch(PixelRow {
            sampler: self,
            y,
            row,
        })
    }

    /// Adds the samples of a pixel that show faces, by each shading.
    #[inline(always)]
    fn add<S: Simd>(
        &self,
        simd: S,
        (pixel, samples): ((u32, u32), &SampleSet),
        seen: &[Seen],
        workspace: &mut Workspace,
        sums: &mut Sums<S::F32>,
    ) {
        let (zero, brightest) = (simd.splat_f32(0.0), simd.splat_f32(self.brightest));
        let mut dark = !0;
        let first = workspace.numbers.first;
        for seen in seen {
            let group = seen.group as usize;
            workspace.numbers.first = first + (LANES * group) as u32;
            workspace.numbers.weights = samples.weights[group];
            let Some(points) = self.surface_points(simd, pixel, *seen, &samples.offsets[group])
            else {
                continue;
            };
            dark &= !seen.lanes;
            let points = (&points, &PatchCoords::in_patches(self.mesh, &points));
            let weights = simd.f32(&samples.weights[group]).select(seen.lanes, zero);
            let mut brightness = zero;
            let shadings = self.shader.shadings().iter();
            for (sums, shading) in sums.radiosity.iter_mut().zip(shadings) {
                let radiosity = self.shader.shade(simd, *shading, points, workspace);
                for c in 0..3 {
                    sums[c] = sums[c] + radiosity[c].min(brightest) * weights;
                }
                brightness = radiosity[0] + radiosity[1] + radiosity[2];
            }
            let [least, greatest] = sums.range;
            sums.range = [
                least.min(brightness).select(seen.lanes, least),
                greatest.max(brightness).select(seen.lanes, greatest),
            ];
        }
        // Samples that show nothing are dark.
        sums.range[0] = zero.select(dark, sums.range[0]);
    }

    /// Where on a face the samples of a pixel lie that show it; nowhere if it shows its back, or
    /// has no patches.
    #[inline(always)]
    fn surface_points<S: Simd>(
        &self,
        simd: S,
        (x, y): (u32, u32),
        seen: Seen,
        offsets: &Offsets,
    ) -> Option<SurfacePoints> {
        let face = &self.screen.faces[seen.face as usize];
        let of_mesh = &self.mesh.faces[face.id.index()];
        if !face.front || of_mesh.is_bare() {
            return None;
        }
        let corner = DVec2::new(f64::from(x), f64::from(y));
        let offset = [
            simd.widen(simd.f32(&offsets[0])),
            simd.widen(simd.f32(&offsets[1])),
        ];
        let (zero, one) = (simd.splat_f64(0.0), simd.splat_f64(1.0));
        let w = &face.inverse_depth;
        let depth = one / w.around(simd, w.at(corner), offset);
        let mut in_space = [[0.0; LANES]; 3];
        let are_needed = face.coordinates.is_none() || self.shader.needs_points();
        for (axis, in_space) in in_space.iter_mut().enumerate().filter(|_| are_needed) {
            let [origin, across, down] = self.film.map(|direction| direction[axis]);
            let known = origin + across * corner.x + down * corner.y;
            let along = simd.splat_f64(known)
                + offset[0] * simd.splat_f64(across)
                + offset[1] * simd.splat_f64(down);
            *in_space = (simd.splat_f64(self.camera.position()[axis]) + along * depth).lanes();
        }
        let mut on_face = [[0.0; LANES]; 2];
        if let Some(coordinates) = &face.coordinates {
            for (on_face, linear) in on_face.iter_mut().zip(coordinates) {
                let coordinate = linear.around(simd, linear.at(corner), offset) * depth;
                *on_face = coordinate.max(zero).min(one).lanes();
            }
        } else {
            for lane in 0..LANES {
                let point = DVec3::from_array(in_space.map(|axis| axis[lane]));
                let place = of_mesh.coordinates(point);
                (on_face[0][lane], on_face[1][lane]) = (place.x, place.y);
            }
        }
        Some(SurfacePoints {
            face: face.id,
            on_face,
            in_space,
            lanes: seen.lanes,
        })
    }
}

/// The sum over all lanes.
#[inline(always)]
fn total<F: Float<f32>>(sums: F) -> f32 {
    let [a, b, c, d, e, f, g, h] = sums.lanes();
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}
