//! *Classify*: what may stand between two parts of the scene, from the coarse to the fine.

use crate::culling::blocker::{Blocker, Occlusion, Plane};
use crate::culling::convex_bound::ConvexBound;
use crate::culling::pair_hull::PairHull;
use crate::culling::two_sided::have_reverse;
use crate::hemisphere::front_walls::planes_of_few;
use radiosity_geometry::{DVec3, FaceId, MergedFaces, Mesh, Occluders, Patch};
use radiosity_simd::{Kernel, Simd, dispatch};

/// The walls of a scene as what stands in the way. Faces here are walls.
pub(crate) struct AllBlockers {
    pub(crate) walls: MergedFaces,
    pub(crate) occluders: Occluders,
    /// Of each wall, whether it is made of two faces in one place, each the reverse of the other.
    pub(crate) two_sided: Vec<bool>,
    /// Of each wall, unless there are many.
    pub(crate) planes: Option<Vec<Plane>>,
    blockers: Vec<Blocker>,
}

/// What may stand between two parts.
#[derive(Clone, Debug)]
pub(crate) enum Blockers {
    /// These faces; none if the view is clear.
    List(Vec<FaceId>),
    /// Too many to list.
    Tree,
}

impl AllBlockers {
    pub(crate) fn new(mesh: &Mesh) -> AllBlockers {
        let walls = MergedFaces::new(mesh);
        let occluders = Occluders::of_walls(&walls);
        let blockers: Vec<Blocker> = walls.polygons.iter().map(Blocker::new).collect();
        let tolerance = occluders.plane_tolerance();
        AllBlockers {
            two_sided: have_reverse(mesh, &walls, tolerance),
            planes: planes_of_few(&blockers, tolerance),
            occluders,
            blockers,
            walls,
        }
    }

    /// The wall that a patch is part of.
    pub(crate) fn wall(&self, patch: &Patch) -> FaceId {
        self.walls.of_face[patch.face.index()]
    }

    pub(crate) fn blocker(&self, face: FaceId) -> &Blocker {
        &self.blockers[face.index()]
    }

    /// What may stand between two parts, given what may between larger ones around them; `None`
    /// if something hides one from the other. Of all faces up to `most` are listed.
    pub(crate) fn narrow(
        &self,
        between: &Blockers,
        [from, to]: [&ConvexBound; 2],
        most: usize,
    ) -> Option<Blockers> {
        let listed;
        let faces = match between {
            Blockers::List(faces) => faces,
            Blockers::Tree => match self.occluders.between([from.bounds(), to.bounds()], most) {
                None => return Some(Blockers::Tree),
                Some(faces) => {
                    listed = faces;
                    &listed
                }
            },
        };
        if faces.is_empty() {
            return Some(Blockers::List(Vec::new()));
        }
        let narrow = Narrow {
            obstacles: self,
            faces,
            ends: [from, to],
        };
        dispatch(narrow).map(Blockers::List)
    }
}

/// For single segments the tree of all faces is faster than a longer list.
const FASTER_THAN_TREE: usize = 12;

impl Blockers {
    /// Whether nothing is.
    pub(crate) fn is_clear(&self) -> bool {
        matches!(self, Blockers::List(faces) if faces.is_empty())
    }

    /// Whether one of these, or of all faces, cuts the segment from `p` on face `i` to `q` on `j`.
    pub(crate) fn cuts(
        &self,
        occluders: &Occluders,
        (i, p): (FaceId, DVec3),
        (j, q): (FaceId, DVec3),
    ) -> bool {
        match self {
            Blockers::List(faces) if faces.len() <= FASTER_THAN_TREE => {
                let mut others = faces.iter().filter(|&&face| face != i && face != j);
                others.any(|&face| occluders.cuts(face, p, q))
            }
            _ => occluders.blocked(i, p, j, q),
        }
    }
}

/// Leaves of faces those that hide some of one end from the other.
struct Narrow<'a> {
    obstacles: &'a AllBlockers,
    faces: &'a [FaceId],
    ends: [&'a ConvexBound; 2],
}

impl Kernel for Narrow<'_> {
    type Output = Option<Vec<FaceId>>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Option<Vec<FaceId>> {
        let [from, to] = self.ends;
        let tolerance = self.obstacles.occluders.plane_tolerance();
        // A face may be part of what spans several, and then it hides none of itself.
        let spans_faces = from.face.is_none() || to.face.is_none();
        let mut partly = Vec::new();
        for &face in self.faces {
            if from.is_on(face) || to.is_on(face) {
                continue;
            }
            let blocker = self.obstacles.blocker(face);
            match blocker.effect(simd, from, to, tolerance) {
                Occlusion::Full if !spans_faces => return None,
                Occlusion::Full | Occlusion::Partial => partly.push(face),
                Occlusion::None => {}
            }
        }
        if !partly.is_empty()
            && let Some(hull) = PairHull::of(simd, self.ends, tolerance)
        {
            let mut kept = 0;
            for k in 0..partly.len() {
                if !hull.is_clear_of(simd, self.obstacles.blocker(partly[k])) {
                    partly[kept] = partly[k];
                    kept += 1;
                }
            }
            partly.truncate(kept);
        }
        Some(partly)
    }
}
