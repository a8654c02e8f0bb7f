//! The regular points of eight patches side by side.

use crate::obstacles::Obstacles;
use crate::points::regular;
use crate::tiles::Tile;
use radiosity_geometry::{Aabb, DVec3, FaceId, Mesh};
use radiosity_simd::{Float, LANES, Simd};
use std::f64::consts::PI;

/// Numbers of eight patches.
pub(crate) type Lanes<T> = [T; LANES];

/// The points of a tile, in units of the scene's extent.
#[derive(Clone, Debug)]
pub(crate) struct Samples {
    /// By point: the coordinates.
    pub(crate) points: Vec<[Lanes<f64>; 3]>,
    /// By point: the area it stands for, so scaled that the products of two areas and the kernel
    /// add up to the exchange in units of the total area.
    areas: Vec<Lanes<f32>>,
    normal: [Lanes<f64>; 3],
    /// Of the patches' planes.
    offset: Lanes<f64>,
    center: DVec3,
    pub(crate) faces: Lanes<FaceId>,
}

/// The points of a tile in single precision, relative to a point near by: so they are as exact as
/// the distances between patches that touch ask for.
#[derive(Clone, Debug, Default)]
pub(crate) struct Local {
    pub(crate) points: Vec<LocalPoint>,
    pub(crate) normal: [Lanes<f32>; 3],
    pub(crate) offset: Lanes<f32>,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct LocalPoint {
    pub(crate) position: [Lanes<f32>; 3],
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
        let length = Aabb::around(corners.copied()).extent().max_element();
        Units {
            length,
            area: length * (PI * mesh.total_area()).sqrt(),
        }
    }
}

impl Samples {
    /// Lanes without a patch have points without area.
    pub(crate) fn new(
        mesh: &Mesh,
        obstacles: &Obstacles,
        tile: &Tile,
        points: u32,
        units: Units,
    ) -> Samples {
        let count = (points * points) as usize;
        let mut samples = Samples {
            points: vec![[[0.0; LANES]; 3]; count],
            areas: vec![[0.0; LANES]; count],
            normal: [[0.0; LANES]; 3],
            offset: [0.0; LANES],
            center: mesh.patches[tile.patches[0]].centroid / units.length,
            faces: [FaceId(u32::MAX); LANES],
        };
        for lane in 0..LANES {
            let patch = tile.patches.get(lane);
            let patch_or_first = &mesh.patches[*patch.unwrap_or(&tile.patches[0])];
            for (k, sample) in regular(&patch_or_first.polygon, points).iter().enumerate() {
                for axis in 0..3 {
                    samples.points[k][axis][lane] = sample.point[axis] / units.length;
                }
                if patch.is_some() {
                    samples.areas[k][lane] = (sample.area / units.area) as f32;
                }
            }
            let normal = patch_or_first.normal;
            for axis in 0..3 {
                samples.normal[axis][lane] = normal[axis];
            }
            samples.faces[lane] = obstacles.wall(patch_or_first);
            samples.offset[lane] = normal.dot(patch_or_first.centroid) / units.length;
        }
        samples
    }

    pub(crate) fn point(&self, point: usize, lane: usize) -> DVec3 {
        DVec3::from_array(self.points[point].map(|axis| axis[lane]))
    }

    pub(crate) fn normal(&self, lane: usize) -> DVec3 {
        DVec3::from_array(self.normal.map(|axis| axis[lane]))
    }

    /// Rounds the points relative to those of a tile.
    #[inline(always)]
    pub(crate) fn localize<S: Simd>(&self, simd: S, near: &Samples, local: &mut Local) {
        let center = near.center;
        let [x, y, z] = &self.normal;
        let [nx, ny, nz] = [simd.f64(x), simd.f64(y), simd.f64(z)];
        let offset = simd.f64(&self.offset)
            - (nx * simd.splat_f64(center.x)
                + ny * simd.splat_f64(center.y)
                + nz * simd.splat_f64(center.z));
        local.offset = simd.narrow(offset).lanes();
        for (axis, normal) in local.normal.iter_mut().zip([nx, ny, nz]) {
            *axis = simd.narrow(normal).lanes();
        }
        local.points.clear();
        for (point, &area) in self.points.iter().zip(&self.areas) {
            let mut position = [[0.0; LANES]; 3];
            for (axis, position) in position.iter_mut().enumerate() {
                *position = simd
                    .narrow(simd.f64(&point[axis]) - simd.splat_f64(center[axis]))
                    .lanes();
            }
            local.points.push(LocalPoint { position, area });
        }
    }
}
