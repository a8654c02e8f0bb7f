//! The regular points of eight patches side by side.

use crate::culling::blockers::AllBlockers;
use crate::regular::reduced_points::{REDUCED_POINTS, reduced_points};
use crate::sampling::points::{Sample, regular};
use crate::traversal::tiles::Tile;
use radiosity_geometry::{Aabb, DVec3, FaceId, Mesh, Patch};
use radiosity_simd::{Float, Kernel, LANES, Simd, dispatch};
use std::f64::consts::PI;

/// Numbers of eight patches.
pub(crate) type Lanes<T> = [T; LANES];

/// Few points stand for all beyond so many radii: factors by either differ by less than 1e-6 there
/// (`tests/few_points.rs` says why).
const NEAR: f32 = 10.8;
/// Scenes larger than this, in patches, have units of their own between both.
const LARGEST: f64 = 1e6;

/// The points of a tile, in [`Units`].
#[derive(Clone, Debug)]
pub(crate) struct TilePoints {
    pub(crate) points: Vec<Point<f64>>,
    /// Those that stand for them far away; of patches without, points without area.
    reduced_points: Vec<Point<f64>>,
    /// From the centroid to the farthest point.
    radius: Lanes<f32>,
    /// Up to this distance between centroids, none stand for them.
    near: Lanes<f32>,
    centroid: [Lanes<f64>; 3],
    normal: [Lanes<f64>; 3],
    /// Of the patches' planes.
    offset: Lanes<f64>,
    center: DVec3,
    pub(crate) faces: Lanes<FaceId>,
}

/// The points of a tile in single precision, relative to a point near by: so they are as exact as
/// the distances between patches that touch ask for.
#[derive(Clone, Debug, Default)]
pub(crate) struct LocalPoints {
    pub(crate) points: Vec<Point<f32>>,
    pub(crate) reduced_points: Vec<Point<f32>>,
    pub(crate) radius: Lanes<f32>,
    pub(crate) near: Lanes<f32>,
    pub(crate) centroid: [Lanes<f32>; 3],
    pub(crate) normal: [Lanes<f32>; 3],
    pub(crate) offset: Lanes<f32>,
}

/// A point on each of eight patches.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point<T> {
    /// The coordinates.
    pub(crate) position: [Lanes<T>; 3],
    /// What the point stands for, so scaled that the products of two areas and the kernel add up to
    /// the exchange in units of the total area.
    pub(crate) area: Lanes<f32>,
}

/// What lengths are divided by, and areas.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Units {
    pub(crate) length: f64,
    area: f64,
}

impl Units {
    pub(crate) fn of(mesh: &Mesh) -> Units {
        let corners = mesh.faces.iter().flat_map(|face| face.polygon.corners());
        let extent = Aabb::around(corners.copied()).extent().max_element();
        let lengths = mesh.patches.iter().map(|patch| patch.area.sqrt());
        let smallest = lengths.fold(extent, f64::min);
        // Single precision has room for fourth powers of either.
        let length = if extent > LARGEST * smallest {
            (extent * smallest).sqrt()
        } else {
            extent
        };
        Units {
            length,
            area: length * (PI * mesh.total_area()).sqrt(),
        }
    }
}

impl TilePoints {
    /// Lanes without a patch have points without area.
    pub(crate) fn new(
        mesh: &Mesh,
        obstacles: &AllBlockers,
        tile: &Tile,
        points: u32,
        units: Units,
    ) -> TilePoints {
        let patches: Lanes<&Patch> = std::array::from_fn(|lane| {
            let index = tile.patches.get(lane).unwrap_or(&tile.patches[0]);
            &mesh.patches[*index]
        });
        let all = patches.map(|patch| regular(&patch.polygon, points));
        let few = patches.map(|patch| reduced_points(&patch.polygon, points));
        let point = |sample_of: &dyn Fn(usize) -> Sample| {
            let area = |lane: usize| match tile.patches.get(lane) {
                Some(_) => (sample_of(lane).area / units.area) as f32,
                None => 0.0,
            };
            Point {
                position: vectors(|lane| sample_of(lane).point / units.length),
                area: std::array::from_fn(area),
            }
        };
        let reduced_point = |lane: usize, k: usize| match few[lane] {
            Some(few) => few[k],
            None => Sample {
                point: patches[lane].centroid,
                area: 0.0,
            },
        };
        let radius: Lanes<f32> = std::array::from_fn(|lane| {
            let centroid = patches[lane].centroid;
            let distances = all[lane].iter().map(|s| s.point.distance(centroid));
            (distances.fold(0.0, f64::max) / units.length) as f32
        });
        let near = |lane: usize| match few[lane] {
            Some(_) => NEAR * radius[lane],
            None => f32::INFINITY,
        };
        TilePoints {
            points: (0..all[0].len())
                .map(|k| point(&|lane| all[lane][k]))
                .collect(),
            reduced_points: (0..REDUCED_POINTS)
                .map(|k| point(&|lane| reduced_point(lane, k)))
                .collect(),
            radius,
            near: std::array::from_fn(near),
            centroid: vectors(|lane| patches[lane].centroid / units.length),
            normal: vectors(|lane| patches[lane].normal),
            offset: patches.map(|patch| patch.normal.dot(patch.centroid) / units.length),
            center: patches[0].centroid / units.length,
            faces: patches.map(|patch| obstacles.wall(patch)),
        }
    }

    pub(crate) fn point(&self, point: usize, lane: usize) -> DVec3 {
        DVec3::from_array(self.points[point].position.map(|axis| axis[lane]))
    }

    pub(crate) fn normal(&self, lane: usize) -> DVec3 {
        DVec3::from_array(self.normal.map(|axis| axis[lane]))
    }

    /// Rounds all but the points relative to a tile.
    pub(crate) fn localize_in(&self, near: &TilePoints, local: &mut LocalPoints) {
        dispatch(Localize(self, near, local));
    }

    /// Rounds the points relative to a tile.
    pub(crate) fn localize_points_in(&self, near: &TilePoints, local: &mut LocalPoints) {
        dispatch(LocalizePoints(self, near, local));
    }
}

struct Localize<'a>(&'a TilePoints, &'a TilePoints, &'a mut LocalPoints);

impl Kernel for Localize<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Localize(points, near, local) = self;
        let center = near.center;
        let [x, y, z] = &points.normal;
        let [nx, ny, nz] = [simd.f64(x), simd.f64(y), simd.f64(z)];
        let offset = simd.f64(&points.offset)
            - (nx * simd.splat_f64(center.x)
                + ny * simd.splat_f64(center.y)
                + nz * simd.splat_f64(center.z));
        local.offset = simd.narrow(offset).lanes();
        for (axis, normal) in local.normal.iter_mut().zip([nx, ny, nz]) {
            *axis = simd.narrow(normal).lanes();
        }
        (local.radius, local.near) = (points.radius, points.near);
        local.centroid = relative(simd, &points.centroid, center);
        local.points.clear();
        rounded(
            simd,
            &points.reduced_points,
            center,
            &mut local.reduced_points,
        );
    }
}

struct LocalizePoints<'a>(&'a TilePoints, &'a TilePoints, &'a mut LocalPoints);

impl Kernel for LocalizePoints<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let LocalizePoints(points, near, local) = self;
        rounded(simd, &points.points, near.center, &mut local.points);
    }
}

/// Rounds points relative to a position.
#[inline(always)]
fn rounded<S: Simd>(simd: S, points: &[Point<f64>], center: DVec3, local: &mut Vec<Point<f32>>) {
    local.clear();
    for &Point { ref position, area } in points {
        let position = relative(simd, position, center);
        local.push(Point { position, area });
    }
}

/// Vectors, one per lane, by axis.
fn vectors(of_lane: impl Fn(usize) -> DVec3) -> [Lanes<f64>; 3] {
    std::array::from_fn(|axis| std::array::from_fn(|lane| of_lane(lane)[axis]))
}

/// Rounds positions relative to one.
#[inline(always)]
fn relative<S: Simd>(simd: S, position: &[Lanes<f64>; 3], center: DVec3) -> [Lanes<f32>; 3] {
    let mut rounded = [[0.0; LANES]; 3];
    for (axis, rounded) in rounded.iter_mut().enumerate() {
        let from_center = simd.f64(&position[axis]) - simd.splat_f64(center[axis]);
        *rounded = simd.narrow(from_center).lanes();
    }
    rounded
}
