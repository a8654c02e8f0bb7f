//! Lines over pictures: where patches end, and where numbers are equal.
//!
//! A line is as bright in a pixel as a tent around it says that is one pixel wide to either side,
//! so lines are smooth, and equally wide everywhere.

use radiosity_geometry::{Backs, Camera, DVec2, DVec3, Mesh, Offsets, Screen, Seen};
use radiosity_image::{Rgb8Image, Values};
use radiosity_simd::{Kernel, LANES, Simd, dispatch};
use rayon::prelude::*;

/// Where a camera sees patches end.
#[derive(Clone, Debug, PartialEq)]
pub struct Outlines {
    width: u32,
    /// For each pixel, how much of the border of a patch lies in it, from 0 to 1.
    patches: Vec<f32>,
    /// Whether its neighbourhood shows several surfaces, or a crease of one.
    edges: Vec<bool>,
}

/// Places along each edge of the square, two pixels wide, that is looked at for each pixel.
const PLACES: usize = 4;
const GROUPS: usize = PLACES * PLACES / LANES;

impl Outlines {
    /// For a picture of so many pixels.
    pub fn new(
        mesh: &Mesh,
        (camera, backs): (&Camera, Backs),
        (width, height): (u32, u32),
    ) -> Outlines {
        let sampler = BorderSampler {
            mesh,
            camera,
            film: camera.film(width, height),
            screen: Screen::new(mesh, (camera, backs), (width, height), 1.0),
            places: places(),
        };
        let rows: Vec<Vec<(f32, bool)>> = (0..height)
            .into_par_iter()
            .map(|y| {
                dispatch(BorderRow {
                    sampler: &sampler,
                    y,
                    width,
                })
            })
            .collect();
        let (patches, edges) = rows.into_iter().flatten().unzip();
        Outlines {
            width,
            patches,
            edges,
        }
    }

    /// Draws the borders of patches.
    pub fn draw(&self, picture: &mut Rgb8Image, color: [u8; 3], strength: f32) {
        for (index, share) in self.patches.iter().enumerate() {
            picture.blend(index, color, strength * share);
        }
    }

    /// Draws the lines along which numbers have some values, light or dark as the picture is not.
    /// There are none across edges of surfaces.
    pub fn draw_isolines(&self, picture: &mut Rgb8Image, values: &Values, levels: &[f64]) {
        let last = [values.width - 1, values.height - 1];
        let is_inner = |x: u32, y: u32| !self.edges[(y * self.width + x) as usize];
        for y in 0..values.height {
            for x in 0..values.width {
                let [left, right] = [x.saturating_sub(1), (x + 1).min(last[0])];
                let [up, down] = [y.saturating_sub(1), (y + 1).min(last[1])];
                let around = [(left, y), (right, y), (x, up), (x, down), (x, y)];
                if !around.iter().all(|&(x, y)| is_inner(x, y)) {
                    continue;
                }
                let slope = |a: f32, b: f32, steps: u32| (b - a) / steps.max(1) as f32;
                let across = slope(values.at(left, y), values.at(right, y), right - left);
                let along = slope(values.at(x, up), values.at(x, down), down - up);
                let slope = across.hypot(along);
                if slope > 0.0 {
                    let here = values.at(x, y);
                    let distances = levels
                        .iter()
                        .map(|level| (here - *level as f32).abs() / slope);
                    let nearest = distances.fold(f32::INFINITY, f32::min);
                    let share = (1.0 - nearest).max(0.0);
                    let index = (y * self.width + x) as usize;
                    picture.blend(index, picture.contrast(index), share);
                }
            }
        }
    }
}

/// Places around a pixel, relative to its corner.
fn places() -> [Offsets; GROUPS] {
    let mut places = [[[0.0; LANES]; 2]; GROUPS];
    let along = |k: usize| 2.0 * (k as f32 + 0.5) / PLACES as f32 - 0.5;
    for k in 0..PLACES * PLACES {
        let [x, y] = &mut places[k / LANES];
        (x[k % LANES], y[k % LANES]) = (along(k % PLACES), along(k / PLACES));
    }
    places
}

/// Looks for borders in pixels.
struct BorderSampler<'a> {
    mesh: &'a Mesh,
    camera: &'a Camera,
    film: [DVec3; 3],
    screen: Screen,
    places: [Offsets; GROUPS],
}

/// A row of pixels.
struct BorderRow<'a> {
    sampler: &'a BorderSampler<'a>,
    y: u32,
    width: u32,
}

impl Kernel for BorderRow<'_> {
    type Output = Vec<(f32, bool)>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Vec<(f32, bool)> {
        let mut seen = Vec::new();
        let mut row = Vec::with_capacity(self.width as usize);
        for x in 0..self.width {
            let sampler = self.sampler;
            let screen = &sampler.screen;
            screen.look(simd, (x, self.y), &sampler.places, &mut seen);
            row.push(sampler.borders((x, self.y), &seen));
        }
        row
    }
}

/// The cosine between normals below which an edge between faces of a mesh is a crease: that of 30
/// degrees.
const ALIKE: f64 = 0.866;
/// No patch: a back, or nothing.
const NO_PATCH: usize = usize::MAX;

impl BorderSampler<'_> {
    /// How much of a border lies in a pixel, and whether it is one of a face.
    fn borders(&self, pixel: (u32, u32), seen: &[Seen]) -> (f32, bool) {
        let mut patches = [NO_PATCH; PLACES * PLACES];
        let mut faces = [u32::MAX; PLACES * PLACES];
        for seen in seen {
            for lane in (0..LANES).filter(|lane| seen.lanes >> lane & 1 != 0) {
                let place = seen.group as usize * LANES + lane;
                faces[place] = seen.face;
                patches[place] = self.patch(pixel, *seen, lane);
            }
        }
        let most = patches
            .iter()
            .map(|patch| patches.iter().filter(|other| *other == patch).count())
            .max()
            .unwrap_or(0);
        let others = 1.0 - most as f32 / patches.len() as f32;
        let is_mixed = faces.iter().any(|&face| !self.are_alike(face, faces[0]));
        // Halved by a border in its middle, all of the pixel's share of it lies inside.
        ((2.0 * others).min(1.0), is_mixed)
    }

    /// Whether faces that are seen are of one smooth surface.
    fn are_alike(&self, a: u32, b: u32) -> bool {
        if a == b {
            return true;
        }
        let face = |seen: u32| {
            let seen = self.screen.faces.get(seen as usize)?;
            Some(&self.mesh.faces[seen.id.index()])
        };
        let both = face(a).zip(face(b));
        both.is_some_and(|(a, b)| a.surface == b.surface && a.normal.dot(b.normal) >= ALIKE)
    }

    /// The patch that is seen at a place.
    fn patch(&self, (x, y): (u32, u32), seen: Seen, lane: usize) -> usize {
        let on_screen = &self.screen.faces[seen.face as usize];
        let face = &self.mesh.faces[on_screen.id.index()];
        if !on_screen.front || face.is_bare() {
            return NO_PATCH;
        }
        let [across, down] = self.places[seen.group as usize];
        let place = DVec2::new(
            f64::from(x) + f64::from(across[lane]),
            f64::from(y) + f64::from(down[lane]),
        );
        let [origin, right, down] = self.film;
        let depth = 1.0 / on_screen.inverse_depth.at(place);
        let direction = origin + place.x * right + place.y * down;
        let point = self.camera.position() + depth * direction;
        let (cell, _) = face.grid.cell_at(face.coordinates(point));
        face.first_patch + cell
    }
}
