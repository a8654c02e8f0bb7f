//! The visible share of a pair, line by line: seen from a point on one patch, the shadows of
//! convex blockers on a line across the other are intervals, and what light passes between them is
//! known in closed form. What is left to sample is continuous but where a line runs along the edge
//! of a shadow, and needs far fewer samples than points do.
//!
//! Lines are drawn by the angle at which the point sees them (`fan.rs`), and so the integrand is
//! bounded, even where the patches touch: with `rho` the distance of the line, `beta` the angle
//! from its foot and `phi` that around an axis through the point parallel to it, the solid angle is
//! `cos beta d beta d phi`.

mod light;
mod shadows;

use crate::accurate::visible_fraction::Sampler;
use crate::culling::blocker::Blocker;
use crate::sampling::lattice::Lattice;
use crate::sampling::patch_sampler::{PatchSampler, SamplePoints, points};
use arrayvec::ArrayVec;
use light::{Interval, LineLight, light};
use radiosity_geometry::{DVec3, FaceId, Occluders, SegmentPacket, fan};
use radiosity_simd::{Float, LANES, Simd};
use shadows::{BlockerSides, light_in_union, shadow_of};

/// At most so many blockers are listed.
pub(crate) const MOST_BLOCKERS: usize = 64;

/// What may stand in the way.
pub(crate) enum Blocked<'a> {
    /// These faces.
    List(&'a [Blocker]),
    /// Any face of the scene but these, on which the patches lie.
    Tree(&'a Occluders, [FaceId; 2]),
}

/// Lines across a patch, seen from points of another.
pub(crate) struct Lines<'a> {
    /// The points' patch, in quads and triangles.
    from: ArrayVec<PatchSampler, MOST_PIECES>,
    across: PatchSampler,
    screens: Vec<BlockerSides>,
    tree: Option<(&'a Occluders, [FaceId; 2])>,
}

/// A polygon of eight corners, the most that clipping leaves, is cut into so many quads.
const MOST_PIECES: usize = 3;

impl<'a> Lines<'a> {
    /// From the points of a convex polygon with a normal across a patch.
    pub(crate) fn new(
        from: (&[DVec3], DVec3),
        across: PatchSampler,
        blocked: &Blocked<'a>,
    ) -> Lines<'a> {
        let (screens, tree) = match *blocked {
            Blocked::List(blockers) => {
                let blockers = blockers.iter();
                (
                    blockers.map(|b| BlockerSides::new(b, &across)).collect(),
                    None,
                )
            }
            Blocked::Tree(occluders, faces) => (Vec::new(), Some((occluders, faces))),
        };
        Lines {
            from: pieces(from.0, from.1),
            across,
            screens,
            tree,
        }
    }
}

/// A convex polygon cut into quads and a triangle, all of which have its first corner.
fn pieces(corners: &[DVec3], normal: DVec3) -> ArrayVec<PatchSampler, MOST_PIECES> {
    let polygons = fan(corners).into_iter();
    polygons
        .map(|polygon| PatchSampler::new(&polygon, normal))
        .collect()
}

/// Lines are at least so long, in units of the longest.
const SHORTEST: f64 = 1e-50;

impl Sampler for Lines<'_> {
    fn pieces(&self) -> usize {
        self.from.len()
    }

    fn coordinates(&self) -> usize {
        match self.tree {
            None => 3,
            Some(_) => 4,
        }
    }

    #[inline(always)]
    fn sample<S: Simd>(&self, simd: S, k: usize, piece: usize, lattice: &Lattice) -> [S::F64; 2] {
        let zero = simd.splat_f64(0.0);
        let (u, v) = (
            lattice.coordinate(simd, k, 0),
            lattice.coordinate(simd, k, 1),
        );
        let from = &self.from[piece];
        let p = points(simd, from, u, v);
        let turn = lattice.coordinate(simd, k, 2);
        let (mut all, mut visible) = (zero, zero);
        for (number, fan) in self.across.fans.iter().enumerate() {
            let [length, density] = fan.line(simd, &p, turn);
            let length = length.max(simd.splat_f64(SHORTEST));
            let density = density * p.area;
            let light = light(simd, (from, &p), (self.across.normal, fan), length);
            let [total, seen] = match self.tree {
                None => {
                    let hidden = self.hidden(simd, &p, (number, length), &light);
                    let total = light.over(simd, light.bright);
                    [total, total - hidden]
                }
                Some(tree) => {
                    let along = lattice.coordinate(simd, k, 3);
                    let (at, light) = light.at(simd, along);
                    let q = fan.place(simd, length, at);
                    let blocked = blocked(tree, &p, &q, zero.less(light));
                    [light, zero.select(blocked, light)]
                }
            };
            all = all + density * total;
            visible = visible + density * seen;
        }
        [all, visible]
    }

    fn unseen(&self, share: f64) -> f64 {
        match self.tree {
            // The shadow of a corner that no line has met is small among lines, and on each of
            // them.
            None => {
                let share = share / self.across.fans.len() as f64;
                share * libm::cbrt(share)
            }
            // Anything that is smaller than what one sample stands for.
            Some(_) => share,
        }
    }
}

impl Lines<'_> {
    /// The light that blockers take away, of that on the line of a fan that has this length.
    #[inline(always)]
    fn hidden<S: Simd>(
        &self,
        simd: S,
        p: &SamplePoints<S::F64>,
        line: (usize, S::F64),
        light: &LineLight<S::F64>,
    ) -> S::F64 {
        let mut shadows: ArrayVec<Interval<S::F64>, MOST_BLOCKERS> = ArrayVec::new();
        for screen in &self.screens {
            if let Some(shadow) = shadow_of(simd, screen, p, line, light.bright) {
                shadows.push(shadow);
            }
        }
        light_in_union(simd, &mut shadows, light)
    }
}

/// Which segments the tree of all faces says are blocked, of those that matter.
#[inline(always)]
fn blocked<F: Float<f64>>(
    (occluders, faces): (&Occluders, [FaceId; 2]),
    p: &SamplePoints<F>,
    q: &[F; 3],
    which: u8,
) -> u8 {
    let [x, y, z] = *q;
    let bundle = SegmentPacket {
        points: [p.lanes(), [x.lanes(), y.lanes(), z.lanes()]],
        faces: faces.map(|face| [face; LANES]),
    };
    occluders.blocked_of(&bundle, which)
}
