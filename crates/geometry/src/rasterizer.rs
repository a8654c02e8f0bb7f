//! The faces of a mesh as a camera sees them, and which of them a pixel's samples show.
//!
//! Seen from a pinhole, everything about a planar face is linear in the place on the film, but for
//! one division (Olano & Greer, "Triangle scan conversion using 2D homogeneous coordinates", 1997):
//! on which side of an edge one looks, the inverse of the view depth, and the coordinates on the
//! face times that inverse. Faces need no clipping, wherever the camera stands. Faces that share an
//! edge have the same numbers for it but for the sign, so no ray passes between them.

mod face;

use crate::bounds::Aabb;
use crate::camera::Camera;
use crate::mesh::{FaceId, Mesh};
use crate::rays::occluders::plane_tolerance;
use face::Viewed;
pub use face::{Linear, SeenFace};
use glam::DVec2;
use radiosity_simd::{Float, LANES, Simd};
use serde::{Deserialize, Serialize};

/// Places of samples relative to a pixel's corner, eight by eight.
pub type Offsets = [[f32; LANES]; 2];

/// Some samples of a pixel that show one face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Seen {
    /// Which eight samples.
    pub group: u32,
    /// Those of them that show it, one bit each.
    pub lanes: u8,
    /// Its index in [`Screen::faces`].
    pub face: u32,
}

/// What a camera sees of the backs of faces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Backs {
    /// They are black.
    #[default]
    Black,
    /// What lies behind them: rooms can be looked into from outside. For light they are as they
    /// are.
    Transparent,
}

/// All faces that a camera may see.
#[derive(Clone, Debug)]
pub struct Screen {
    /// The faces in the order of the mesh, without those that are seen edge-on, or seen through.
    pub faces: Vec<SeenFace>,
    /// For each tile of pixels, the faces that it may show.
    tiles: Vec<Vec<u32>>,
    /// Tiles across.
    across: usize,
    /// How far samples lie from the centre of their pixel at most, along either axis.
    reach: f64,
    /// What is nearer is not seen.
    largest_inverse_depth: f64,
}

/// Pixels along each edge of a tile.
const TILE: u32 = 16;

impl Screen {
    /// Looks at the faces of a mesh through a camera, for a picture of so many pixels whose samples
    /// lie up to `reach` pixels from their pixel's centre, along either axis.
    pub fn new(
        mesh: &Mesh,
        (camera, backs): (&Camera, Backs),
        (width, height): (u32, u32),
        reach: f64,
    ) -> Screen {
        let everything = mesh.bounds().union(Aabb::around([camera.position()]));
        let viewed = Viewed {
            camera,
            film: camera.film(width, height),
            tolerance: plane_tolerance(&everything),
            layers: mesh.covers.layers(),
        };
        let ids = (0..mesh.faces.len() as u32).map(FaceId);
        let seen = |id: FaceId| {
            let face = (id, &mesh.faces[id.index()]);
            SeenFace::new(face, mesh.covers.layer(id), &viewed)
        };
        let faces = ids.filter_map(seen);
        let is_seen = |face: &SeenFace| face.front || backs == Backs::Black;
        let faces: Vec<SeenFace> = faces.filter(is_seen).collect();
        let (across, down) = (width.div_ceil(TILE), height.div_ceil(TILE));
        let mut screen = Screen {
            tiles: vec![Vec::new(); (across * down) as usize],
            across: across as usize,
            reach,
            largest_inverse_depth: 1.0 / camera.near(),
            faces: Vec::new(),
        };
        for (index, face) in faces.iter().enumerate() {
            screen.bin(index as u32, face, (0, 0), (across, down));
        }
        screen.faces = faces;
        screen
    }

    /// Adds a face to the tiles that may show it, halving the range of tiles as long as all of it
    /// may not.
    fn bin(&mut self, index: u32, face: &SeenFace, (x, y): (u32, u32), (to_x, to_y): (u32, u32)) {
        let size = DVec2::new(f64::from(to_x - x), f64::from(to_y - y)) * f64::from(TILE);
        let center = DVec2::new(f64::from(x), f64::from(y)) * f64::from(TILE) + 0.5 * size;
        let half = 0.5 * size.max_element() + self.reach;
        if face.misses(center, half) {
            return;
        }
        if to_x - x == 1 && to_y - y == 1 {
            self.tiles[y as usize * self.across + x as usize].push(index);
        } else if to_x - x >= to_y - y {
            let middle = x.midpoint(to_x);
            self.bin(index, face, (x, y), (middle, to_y));
            self.bin(index, face, (middle, y), (to_x, to_y));
        } else {
            let middle = y.midpoint(to_y);
            self.bin(index, face, (x, y), (to_x, middle));
            self.bin(index, face, (x, middle), (to_x, to_y));
        }
    }

    /// Which faces the samples of the pixel in column `x` and row `y` show, into `seen`: the
    /// nearest of those that are not too near. Of a front and a back in one plane they show the
    /// front, of two fronts the one that lies on the other, else of two at the same depth the
    /// first. Returns whether other places in the pixel may show other faces.
    #[inline(always)]
    pub fn look<S: Simd>(
        &self,
        simd: S,
        (x, y): (u32, u32),
        samples: &[Offsets],
        seen: &mut Vec<Seen>,
    ) -> bool {
        seen.clear();
        let corner = DVec2::new(f64::from(x), f64::from(y));
        let tile = (y / TILE) as usize * self.across + (x / TILE) as usize;
        match self.only(corner + 0.5, &self.tiles[tile]) {
            Sight::Nothing => false,
            Sight::Only(face) => {
                seen.extend((0..samples.len() as u32).map(|group| Seen {
                    group,
                    lanes: !0,
                    face,
                }));
                false
            }
            Sight::Many(nearest) => {
                for (group, offsets) in samples.iter().enumerate() {
                    let first = seen.len();
                    let mut depth = simd.splat_f64(0.0);
                    for &face in &self.tiles[tile] {
                        let of_face = &self.faces[face as usize];
                        let w = &of_face.inverse_depth;
                        if w.at(corner + 0.5) + w.spread(self.reach) < nearest
                            || of_face.misses(corner + 0.5, self.reach)
                        {
                            continue;
                        }
                        let lanes = self.nearer(simd, of_face, corner, offsets, &mut depth);
                        if lanes != 0 {
                            seen[first..]
                                .iter_mut()
                                .for_each(|other| other.lanes &= !lanes);
                            seen.push(Seen {
                                group: group as u32,
                                lanes,
                                face,
                            });
                        }
                    }
                }
                seen.retain(|seen| seen.lanes != 0);
                true
            }
        }
    }

    /// The samples that show the face nearer than what they have shown so far.
    #[inline(always)]
    fn nearer<S: Simd>(
        &self,
        simd: S,
        face: &SeenFace,
        corner: DVec2,
        offsets: &Offsets,
        nearest: &mut S::F64,
    ) -> u8 {
        let offsets = [
            simd.widen(simd.f32(&offsets[0])),
            simd.widen(simd.f32(&offsets[1])),
        ];
        let w = &face.inverse_depth;
        let w = w.around(simd, w.at(corner), offsets);
        let mut lanes = nearest.less(w);
        lanes &= w.less_or_equal(simd.splat_f64(self.largest_inverse_depth));
        for edge in &face.edges {
            let side = edge.around(simd, edge.at(corner), offsets);
            lanes &= simd.splat_f64(0.0).less_or_equal(side);
        }
        *nearest = w.select(lanes, *nearest);
        lanes
    }

    /// What a pixel around a centre shows, as far as it can be told at once.
    #[inline(always)]
    fn only(&self, center: DVec2, candidates: &[u32]) -> Sight {
        let mut nearest = 0.0;
        let mut only = None;
        for &index in candidates {
            let face = &self.faces[index as usize];
            let (w, spread) = self.depths(face, center);
            let is_whole = w - spread > nearest && w + spread <= self.largest_inverse_depth;
            if is_whole && face.covers(center, self.reach) {
                (nearest, only) = (w - spread, Some(index));
            }
        }
        let hides = |&&index: &&u32| {
            let face = &self.faces[index as usize];
            let (w, spread) = self.depths(face, center);
            Some(index) != only && w + spread >= nearest && !face.misses(center, self.reach)
        };
        match (candidates.iter().find(hides), only) {
            (None, None) => Sight::Nothing,
            (None, Some(face)) => Sight::Only(face),
            (Some(_), _) => Sight::Many(nearest),
        }
    }

    /// The inverse depth at a centre, and how far it spreads over a pixel.
    #[inline(always)]
    fn depths(&self, face: &SeenFace, center: DVec2) -> (f64, f64) {
        let w = &face.inverse_depth;
        (w.at(center), w.spread(self.reach))
    }
}

/// What a pixel shows.
enum Sight {
    Nothing,
    /// One face everywhere.
    Only(u32),
    /// Several, none of which is farther than this inverse depth.
    Many(f64),
}
