//! The pixels of a picture, row by row.

use crate::Rgb;
use crate::interpolate::{Local, Places};
use crate::params::ImageParams;
use crate::render::Shading;
use crate::samples::{SampleSet, SampleSets};
use crate::shade::{Room, Shader};
use crate::spots::Spot;
use radiosity_geometry::{Camera, DVec2, DVec3, Mesh, Offsets, Screen, Seen};
use radiosity_simd::{Float, Kernel, LANES, Simd, dispatch};
use std::f32::consts::PI;

/// What a camera sees, ready for its pixels.
pub(crate) struct View<'a> {
    mesh: &'a Mesh,
    camera: &'a Camera,
    /// The directions of rays: [`Camera::film`].
    film: [DVec3; 3],
    screen: Screen,
    shader: &'a Shader<'a>,
    samples: SampleSets,
    most_rounds: u32,
}

/// A row of pixels, each as often as there are shadings.
struct Row<'a> {
    view: &'a View<'a>,
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
    /// The least and the greatest sample by the last shading, in each lane: the sum of its channels.
    range: [F; 2],
}

/// Samples that differ by less than this share of the brightest need no more.
const DIFFERENCE: f32 = 0.05;

impl Kernel for Row<'_> {
    type Output = Vec<Spot>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Vec<Spot> {
        let (view, mut seen, mut room) = (self.view, Vec::new(), Room::default());
        let count = view.shader.shadings().len();
        for (x, pixels) in self.row.chunks_exact_mut(count).enumerate() {
            let pixel = (x as u32, self.y);
            let mut sums = Sums {
                radiosity: [[simd.splat_f32(0.0); 3]; Shading::COUNT],
                range: [simd.splat_f32(f32::INFINITY), simd.splat_f32(0.0)],
            };
            room.numbers.scramble = view.samples.scramble_of(pixel);
            room.first_spot = room.spots.len();
            let mut rounds = 0;
            let mut wants_more = true;
            while wants_more && rounds < view.most_rounds {
                let samples = view.samples.of_pixel(pixel.0, pixel.1, rounds);
                let is_mixed = view.screen.look(simd, pixel, &samples.offsets, &mut seen);
                let count = (LANES * samples.offsets.len()) as u32;
                room.numbers.first = rounds * count;
                view.add(simd, (pixel, samples), &seen, &mut room, &mut sums);
                rounds += 1;
                // What shows two faces may have missed one of them once.
                wants_more = is_mixed && (rounds == 1 || sums.differ());
            }
            let scale = 1.0 / (PI * rounds as f32);
            for (pixel, sums) in pixels.iter_mut().zip(&sums.radiosity) {
                *pixel = [0, 1, 2].map(|c| scale * total(sums[c]));
            }
            for spot in &mut room.spots[room.first_spot..] {
                spot.x = pixel.0;
                spot.gain = spot.gain.map(|gain| scale * gain);
            }
        }
        room.spots
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

impl<'a> View<'a> {
    pub(crate) fn new(
        mesh: &'a Mesh,
        shader: &'a Shader<'a>,
        camera: &'a Camera,
        params: &ImageParams,
    ) -> View<'a> {
        let film = params.film();
        let size = (film.width, film.height);
        View {
            film: camera.film(film.width, film.height),
            screen: Screen::new(mesh, (camera, params.backs), size, film.reach()),
            samples: SampleSets::new(&film, params.samples, params.seed),
            most_rounds: params.adaptive,
            mesh,
            shader,
            camera,
        }
    }

    /// Takes a row of pixels, each as often as there are shadings, but for what is gathered at spots.
    pub(crate) fn take_row(&self, y: u32, row: &mut [Rgb]) -> Vec<Spot> {
        dispatch(Row { view: self, y, row })
    }

    /// Adds the samples of a pixel that show faces, by each shading.
    #[inline(always)]
    fn add<S: Simd>(
        &self,
        simd: S,
        (pixel, samples): ((u32, u32), &SampleSet),
        seen: &[Seen],
        room: &mut Room,
        sums: &mut Sums<S::F32>,
    ) {
        let zero = simd.splat_f32(0.0);
        let mut dark = !0;
        let first = room.numbers.first;
        for seen in seen {
            let group = seen.group as usize;
            room.numbers.first = first + (LANES * group) as u32;
            room.numbers.weights = samples.weights[group];
            let Some(places) = self.places(simd, pixel, *seen, &samples.offsets[group]) else {
                continue;
            };
            dark &= !seen.lanes;
            let place = (&places, &Local::in_patches(self.mesh, &places));
            let weights = simd.f32(&samples.weights[group]).select(seen.lanes, zero);
            let mut brightness = zero;
            let shadings = self.shader.shadings().iter();
            for (sums, shading) in sums.radiosity.iter_mut().zip(shadings) {
                let radiosity = self.shader.shade(simd, *shading, place, room);
                for c in 0..3 {
                    sums[c] = sums[c] + radiosity[c] * weights;
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

    /// Where on a face the samples of a pixel lie that show it; nowhere if it shows its back, or has
    /// no patches.
    #[inline(always)]
    fn places<S: Simd>(
        &self,
        simd: S,
        (x, y): (u32, u32),
        seen: Seen,
        offsets: &Offsets,
    ) -> Option<Places> {
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
        let mut points = [[0.0; LANES]; 3];
        let are_needed = face.coordinates.is_none() || self.shader.needs_points();
        for (axis, points) in points.iter_mut().enumerate().filter(|_| are_needed) {
            let [origin, across, down] = self.film.map(|direction| direction[axis]);
            let known = origin + across * corner.x + down * corner.y;
            let along = simd.splat_f64(known)
                + offset[0] * simd.splat_f64(across)
                + offset[1] * simd.splat_f64(down);
            *points = (simd.splat_f64(self.camera.position()[axis]) + along * depth).lanes();
        }
        let mut at = [[0.0; LANES]; 2];
        if let Some(coordinates) = &face.coordinates {
            for (at, linear) in at.iter_mut().zip(coordinates) {
                let coordinate = linear.around(simd, linear.at(corner), offset) * depth;
                *at = coordinate.max(zero).min(one).lanes();
            }
        } else {
            for lane in 0..LANES {
                let point = DVec3::from_array(points.map(|axis| axis[lane]));
                let on_face = of_mesh.coordinates(point);
                (at[0][lane], at[1][lane]) = (on_face.x, on_face.y);
            }
        }
        Some(Places {
            face: face.id,
            at,
            points,
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
