//! Light that comes straight from emitters, at any point: in closed form, and where something
//! stands in the way, of what of the emitter is left beside it.
//!
//! An emitter is a convex polygon of even exitance `M`. A point with the form factor `F` to it has
//! the irradiance `M F` (Cohen & Wallace 1993, section 4.4). What blocks is convex too, so its
//! shadow on the emitter is what lies in a cone; cut out of the emitter, it leaves convex pieces.
//! No sample is taken, and nothing is noisy: penumbrae are exact. Behind dozens of faces, as of a
//! mesh, samples are cheaper, and are taken.
//!
//! Long because: the closed form and the samples that stand in for it share one emitter's state.

mod clear;
mod pieces;
mod receivers;

use crate::Rgb;
use crate::shading_normals::{ShadingNormals, Smooth};
use clear::clear_factors;
pub(crate) use pieces::Cutting;
use pieces::form_factor;
use radiosity_geometry::{DVec2, DVec3, FaceId, Mesh, Occluders, Polygon};
use radiosity_simd::{Float, LANES, Simd};
pub(crate) use receivers::{EmitterSamples, Receivers};
use std::sync::OnceLock;

/// All emitters, and what stands before them.
pub(crate) struct DirectLight<'a> {
    mesh: &'a Mesh,
    occluders: Occluders,
    emitters: Vec<Emitter>,
    normals: ShadingNormals<'a>,
    /// For each patch, once it is asked for, what it sees of each emitter.
    of_patches: Vec<OnceLock<Vec<EmitterVisibility>>>,
}

struct Emitter {
    face: FaceId,
    polygon: Polygon,
    normal: DVec3,
    exitance: Rgb,
}

/// What a patch sees of an emitter.
enum EmitterVisibility {
    /// It shines elsewhere, or hides behind the horizon.
    Away,
    /// Seen whole from every point of the patch.
    Clear,
    /// Partly below the horizon, or with faces in the way.
    Cut(Vec<FaceId>),
    /// With so many faces in the way that samples are cheaper.
    Crowded,
}

/// The most faces that are cut out one by one.
const MOST_CUT: usize = 48;
impl<'a> DirectLight<'a> {
    /// From what patches emit, to points of surfaces with some normals.
    pub(crate) fn new(
        mesh: &'a Mesh,
        sources: &[Rgb],
        normals: ShadingNormals<'a>,
    ) -> DirectLight<'a> {
        let ids = (0..mesh.faces.len() as u32).map(FaceId);
        let emitter = |id: FaceId| {
            let face = &mesh.faces[id.index()];
            let exitance = face.patches().next().map(|patch| sources[patch]);
            let exitance = exitance.filter(|exitance| *exitance != [0.0; 3])?;
            Some(Emitter {
                face: id,
                polygon: face.polygon,
                normal: face.normal,
                exitance,
            })
        };
        DirectLight {
            mesh,
            occluders: Occluders::new(mesh),
            emitters: ids.filter_map(emitter).collect(),
            normals,
            of_patches: mesh.patches.iter().map(|_| OnceLock::new()).collect(),
        }
    }

    /// What a face is shaded by, if it is not flat.
    pub(crate) fn smooth(&self, face: FaceId) -> Option<Smooth<'_>> {
        self.normals.of(face)
    }

    /// The irradiance at points of patches.
    #[inline(always)]
    pub(crate) fn irradiance<S: Simd>(
        &self,
        simd: S,
        points: &Receivers<S::F64>,
        workspace: &mut Cutting,
    ) -> [S::F32; 3] {
        let [x, y, z] = &points.at;
        let at = [x.lanes(), y.lanes(), z.lanes()];
        let [x, y, z] = &points.normals;
        let normals = [x.lanes(), y.lanes(), z.lanes()];
        let mut sums = [simd.splat_f32(0.0); 3];
        for (index, emitter) in self.emitters.iter().enumerate() {
            let (mut clear, mut factors) = (0u8, [0.0; LANES]);
            for lane in (0..LANES).filter(|lane| points.lanes >> lane & 1 != 0) {
                let patch = points.patches[lane] as usize;
                let visibilities =
                    self.of_patches[patch].get_or_init(|| self.visibilities_from(patch));
                let vector = |axes: &[[f64; LANES]; 3]| DVec3::from_array(axes.map(|a| a[lane]));
                match &visibilities[index] {
                    EmitterVisibility::Away => {}
                    EmitterVisibility::Clear => clear |= 1 << lane,
                    EmitterVisibility::Cut(blockers) => {
                        let point = (vector(&at), vector(&normals));
                        factors[lane] = self.cut_factor(emitter, blockers, point, workspace) as f32;
                    }
                    EmitterVisibility::Crowded => {
                        let face = self.mesh.patches[patch].face;
                        let point = (vector(&at), vector(&normals));
                        let whole = self.cut_factor(emitter, &[], point, workspace);
                        let seen =
                            self.seen_share(emitter, face, point, points.ends(lane, point.0));
                        factors[lane] = (whole * seen) as f32;
                    }
                }
            }
            let mut factors = simd.f32(&factors);
            if clear != 0 {
                factors = simd
                    .narrow(clear_factors(simd, emitter, points))
                    .select(clear, factors);
            }
            for (sum, exitance) in sums.iter_mut().zip(&emitter.exitance) {
                *sum = *sum + factors * simd.splat_f32(*exitance);
            }
        }
        sums
    }

    /// What a patch sees of each emitter.
    fn visibilities_from(&self, patch: usize) -> Vec<EmitterVisibility> {
        self.emitters
            .iter()
            .map(|emitter| self.visibility_from(emitter, patch))
            .collect()
    }

    fn visibility_from(&self, emitter: &Emitter, patch: usize) -> EmitterVisibility {
        let patch = &self.mesh.patches[patch];
        let tolerance = self.occluders.plane_tolerance();
        let heights = |points: &[DVec3], normal: DVec3, foot: DVec3| -> [f64; 2] {
            let heights = points.iter().map(|point| normal.dot(*point - foot));
            heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], h| {
                [low.min(h), high.max(h)]
            })
        };
        let own = patch.polygon.corners();
        let lamp = emitter.polygon.corners();
        // Of points over the horizons of the patch: the lowest and the highest.
        let over_horizons = |points: &[DVec3]| -> [f64; 2] {
            let flat = heights(points, patch.normal, patch.centroid);
            let Some(smooth) = self.smooth(patch.face) else {
                return flat;
            };
            // Heights are linear in the normal and in the place, so they are between these.
            let lift = smooth.most_lift();
            let normals = smooth.normals().iter();
            let all = normals.flat_map(|n| own.iter().map(|foot| heights(points, *n, *foot)));
            all.fold(flat, |[low, high], [lower, higher]| {
                [low.min(lower - lift), high.max(higher)]
            })
        };
        let over_patch = over_horizons(lamp);
        let over_lamp = heights(own, emitter.normal, lamp[0]);
        let is_away =
            emitter.face == patch.face || over_patch[1] <= tolerance || over_lamp[1] <= tolerance;
        if is_away {
            return EmitterVisibility::Away;
        }
        // Whether both lie on one side of a face's plane, or in it: no segment between them crosses
        // it.
        let is_beside = |face: FaceId| {
            let face = &self.mesh.faces[face.index()];
            let over = |points| heights(points, face.normal, face.polygon.corners()[0]);
            let ([low, high], [lower, higher]) = (over(own), over(lamp));
            low.min(lower) >= -tolerance || high.max(higher) <= tolerance
        };
        let ends = [patch.polygon.bounds(), emitter.polygon.bounds()];
        let all = self.occluders.between(ends, usize::MAX).unwrap_or_default();
        let is_between = |face: &FaceId| {
            let corners = self.mesh.faces[face.index()].polygon;
            let corners = corners.corners();
            *face != patch.face
                && *face != emitter.face
                && over_horizons(corners)[1] > tolerance
                && heights(corners, emitter.normal, lamp[0])[1] > tolerance
                && !is_beside(*face)
        };
        let blockers: Vec<FaceId> = all.into_iter().filter(is_between).collect();
        if blockers.is_empty() && over_patch[0] >= 0.0 && over_lamp[0] > tolerance {
            EmitterVisibility::Clear
        } else if blockers.len() > MOST_CUT {
            EmitterVisibility::Crowded
        } else {
            EmitterVisibility::Cut(blockers)
        }
    }

    /// To what is left of an emitter.
    fn cut_factor(
        &self,
        emitter: &Emitter,
        blockers: &[FaceId],
        (at, normal): (DVec3, DVec3),
        workspace: &mut Cutting,
    ) -> f64 {
        let corners = emitter.polygon.padded_corners().map(|corner| corner - at);
        let distance = emitter.normal.dot(corners[0]);
        if distance >= 0.0 {
            return 0.0;
        }
        let count = emitter.polygon.corners().len();
        workspace.begin(&corners[..count], normal);
        for &blocker in blockers {
            if workspace.pieces.is_empty() {
                return 0.0;
            }
            let face = &self.mesh.faces[blocker.index()];
            let corners = face.polygon.padded_corners().map(|corner| corner - at);
            let height = -face.normal.dot(corners[0]);
            if height.abs() > self.occluders.plane_tolerance() {
                let count = face.polygon.corners().len();
                let plane = (emitter.normal, distance);
                workspace.cut_out(&corners[..count], height > 0.0, plane);
            }
        }
        let factors = workspace
            .pieces
            .iter()
            .map(|piece| form_factor(piece, normal));
        factors.sum()
    }
}

impl DirectLight<'_> {
    /// The share of points of an emitter that are seen, weighted as the light from them would be:
    /// the factor without anything in the way times that is the factor (Heitz, Hill & McGuire,
    /// "Combining Analytic Direct Illumination and Stochastic Shadows", 2018).
    fn seen_share(
        &self,
        emitter: &Emitter,
        face: FaceId,
        (at, normal): (DVec3, DVec3),
        ends: impl Iterator<Item = DVec2>,
    ) -> f64 {
        let (mut all, mut visible) = (0.0, 0.0);
        for end in ends {
            let point = emitter.point(end);
            let to = point - at;
            let cosines = normal.dot(to).max(0.0) * -emitter.normal.dot(to).min(0.0);
            let weight = cosines / to.length_squared().powi(2);
            all += weight;
            if weight > 0.0 && !self.occluders.blocked(face, at, emitter.face, point) {
                visible += weight;
            }
        }
        if all > 0.0 { visible / all } else { 0.0 }
    }
}

impl Emitter {
    /// A point by coordinates of the unit square; uniform on triangles and parallelograms.
    fn point(&self, at: DVec2) -> DVec3 {
        if !self.polygon.is_triangle() {
            return self.polygon.bilinear(at.x, at.y);
        }
        let fold = f64::from(u8::from(at.x + at.y > 1.0));
        self.polygon
            .barycentric((fold - at.x).abs(), (fold - at.y).abs())
    }
}
