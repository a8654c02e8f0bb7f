//! The faces of a mesh as a camera sees them, and which of them a pixel's samples show.
//!
//! Seen from a pinhole, everything about a planar face is linear in the place on the film, but for
//! one division (Olano & Greer, "Triangle scan conversion using 2D homogeneous coordinates", 1997):
//! on which side of an edge one looks, the inverse of the view depth, and the coordinates on the
//! face times that inverse. Faces need no clipping, wherever the camera stands. Faces that share an
//! edge have the same numbers for it but for the sign, so no ray passes between them.

use crate::camera::Camera;
use crate::mesh::{Face, FaceId, Grid, Mesh};
use glam::{DVec2, DVec3};
use radiosity_simd::{Float, LANES, Simd};

/// A linear function of a place on the film, which is in pixels from the top left corner.
#[derive(Clone, Copy, Debug)]
pub struct Linear {
    origin: f64,
    across: f64,
    down: f64,
}

/// A face as the camera sees it.
#[derive(Clone, Debug)]
pub struct SeenFace {
    /// The face.
    pub id: FaceId,
    /// Whether it shows its front.
    pub front: bool,
    /// The inverse of the view depth.
    pub inverse_depth: Linear,
    /// The coordinates on the face, as [`Location::on_face`](crate::Location) has them, times the
    /// inverse depth; none for quads that are no parallelograms.
    pub coordinates: Option<[Linear; 2]>,
    /// Not negative within.
    edges: [Linear; 4],
}

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

/// All faces that a camera may see.
#[derive(Clone, Debug)]
pub struct Screen {
    /// The faces in the order of the mesh, without those that are seen edge-on.
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

impl Linear {
    /// The product of a vector with the directions of the film.
    fn of(vector: DVec3, film: &[DVec3; 3]) -> Linear {
        let [origin, across, down] = film.map(|direction| vector.dot(direction));
        Linear {
            origin,
            across,
            down,
        }
    }

    /// The value at a place.
    pub fn at(&self, place: DVec2) -> f64 {
        self.origin + self.across * place.x + self.down * place.y
    }

    /// How much it may differ from its value at the centre of a square of a half-width.
    fn spread(&self, half: f64) -> f64 {
        half * (self.across.abs() + self.down.abs())
    }

    /// The values at places relative to one where the value is known.
    #[inline(always)]
    pub fn around<S: Simd>(&self, simd: S, known: f64, [x, y]: [S::F64; 2]) -> S::F64 {
        simd.splat_f64(known) + x * simd.splat_f64(self.across) + y * simd.splat_f64(self.down)
    }
}

impl SeenFace {
    fn new(id: FaceId, face: &Face, camera: &Camera, film: &[DVec3; 3]) -> Option<SeenFace> {
        let corners = face.polygon.padded_corners();
        let [a, b, c, d] = corners.map(|corner| corner - camera.position());
        let height = face.normal.dot(a);
        let depth = face.normal / height;
        let side = height.signum();
        let edge = |from: DVec3, to: DVec3| Linear::of(side * from.cross(to), film);
        let (along_u, along_v) = match face.grid {
            Grid::Quad { .. } => (b - a, d - a),
            Grid::Triangle { .. } => (b - a, c - a),
        };
        let area = along_u.cross(along_v).dot(face.normal);
        let coordinate = |dual: DVec3| Linear::of(dual / area - dual.dot(a) / area * depth, film);
        let is_affine = face.polygon.is_triangle() || face.polygon.is_parallelogram();
        let seen = SeenFace {
            id,
            front: height < 0.0,
            inverse_depth: Linear::of(depth, film),
            coordinates: is_affine.then(|| {
                [
                    coordinate(along_v.cross(face.normal)),
                    coordinate(face.normal.cross(along_u)),
                ]
            }),
            edges: [edge(a, b), edge(b, c), edge(c, d), edge(d, a)],
        };
        let is_finite = depth.is_finite() && height != 0.0;
        is_finite.then_some(seen)
    }

    /// Whether no place of a square around a centre shows the face.
    fn misses(&self, center: DVec2, half: f64) -> bool {
        let is_below = |linear: &Linear| linear.at(center) + linear.spread(half) < 0.0;
        is_below(&self.inverse_depth) || self.edges.iter().any(is_below)
    }

    /// Whether all places of a square lie within its edges.
    fn covers(&self, center: DVec2, half: f64) -> bool {
        let is_above = |linear: &Linear| linear.at(center) - linear.spread(half) >= 0.0;
        self.edges.iter().all(is_above)
    }
}

impl Screen {
    /// Looks at the faces of a mesh through a camera, for a picture of so many pixels whose samples
    /// lie up to `reach` pixels from their pixel's centre, along either axis.
    pub fn new(mesh: &Mesh, camera: &Camera, (width, height): (u32, u32), reach: f64) -> Screen {
        let film = camera.film(width, height);
        let ids = (0..mesh.faces.len() as u32).map(FaceId);
        let faces = ids.filter_map(|id| SeenFace::new(id, &mesh.faces[id.index()], camera, &film));
        let faces: Vec<SeenFace> = faces.collect();
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
    /// nearest of those that are not too near, and of two at the same depth the first. Returns whether
    /// other places in the pixel may show other faces.
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
