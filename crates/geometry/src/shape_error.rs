//! What makes shapes unusable.

use glam::DVec3;

/// Why a shape cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ShapeError {
    /// A coordinate is NaN, or so large that boxes in single precision cannot hold it.
    #[error("has a coordinate that is no number between -1e30 and 1e30")]
    OutOfRange,
    /// Three corners lie on a line, or all of them do.
    #[error("has no area: corners coincide or lie on a line, or edges are parallel")]
    NoArea,
    /// The four corners of a quadrilateral do not lie in one plane.
    #[error(
        "is not planar: its corners lie {deviation:.1e} of its diagonal off their mean plane \
         (at most {PLANARITY:.0e} is allowed); give coordinates more digits, or use two triangles"
    )]
    NotPlanar {
        /// Distance of the corners from the mean plane, relative to the longer diagonal.
        deviation: f64,
    },
    /// A quadrilateral has a reflex corner or crosses itself.
    #[error("is not convex: order its corners around it, or use two triangles")]
    NotConvex,
    /// A mesh has no faces.
    #[error("has no faces")]
    Empty,
    /// A face of a mesh names a corner that does not exist.
    #[error("face {face} names corner {index}, but there are only {count} (counted from 0)")]
    IndexOutOfRange {
        /// The face, counted from 0.
        face: usize,
        /// The index it names.
        index: u32,
        /// How many positions the mesh has.
        count: usize,
    },
    /// A face of a mesh has neither three nor four corners.
    #[error("face {face} has {corners} corners; three or four are allowed")]
    CornerCount {
        /// The face, counted from 0.
        face: usize,
        /// How many corners it has.
        corners: usize,
    },
    /// A face of a mesh is degenerate.
    #[error("face {face} (counted from 0) has no area; remove it from the mesh")]
    FaceWithoutArea {
        /// The face, counted from 0.
        face: usize,
    },
    /// A quad of a mesh crosses itself: either way of cutting it gives two triangles of which one
    /// faces back.
    #[error(
        "face {face} (counted from 0) crosses itself; order its corners around it, or use two \
         triangles"
    )]
    FaceCrossesItself {
        /// The face, counted from 0.
        face: usize,
    },
}

/// How far the corners of a planar quadrilateral may lie off their mean plane, relative to the
/// longer diagonal: what the six digits of a typical mesh file leave.
pub(crate) const PLANARITY: f64 = 1e-5;

/// Height over longest edge below which a triangle counts as a line.
const SLIVER: f64 = 1e-9;

/// Products of coordinates stay finite, and so do coordinates in single precision.
const LARGEST: f64 = 1e30;

fn in_range(point: &DVec3) -> bool {
    point.abs().cmple(DVec3::splat(LARGEST)).all()
}

pub(crate) fn check_triangle(corners: [DVec3; 3]) -> Result<(), ShapeError> {
    if !corners.iter().all(in_range) {
        Err(ShapeError::OutOfRange)
    } else if has_area(corners) {
        Ok(())
    } else {
        Err(ShapeError::NoArea)
    }
}

/// Whether a triangle is more than a line: its height is more than 1e-9 of its longest edge.
pub fn has_area([a, b, c]: [DVec3; 3]) -> bool {
    let (ab, ac) = (b - a, c - a);
    let longest = ab.length().max(ac.length()).max((c - b).length());
    let height = ab.cross(ac).length() / longest;
    // The height is NaN where all corners are equal; no comparison holds for it.
    height > SLIVER * longest
}

pub(crate) fn check_quad(corners: &[DVec3; 4]) -> Result<(), ShapeError> {
    if !corners.iter().all(in_range) {
        return Err(ShapeError::OutOfRange);
    }
    let [a, b, c, d] = *corners;
    let diagonal = (c - a).length().max((d - b).length());
    let area_vector = 0.5 * (c - a).cross(d - b);
    // Twisted and reflex quads are told from flat slivers by their triangles' areas.
    let triangles = [[a, b, c], [b, c, d], [c, d, a], [d, a, b]];
    let has_area =
        |[p, q, r]: [DVec3; 3]| (q - p).cross(r - p).length() > SLIVER * diagonal * diagonal;
    if !triangles.into_iter().all(has_area) {
        return Err(ShapeError::NoArea);
    }
    let turns = triangles.map(|[p, q, r]| (q - p).cross(r - q).dot(area_vector) > 0.0);
    if turns != [true; 4] {
        return Err(ShapeError::NotConvex);
    }
    let deviation = 0.5 * ((b - a).dot(area_vector.normalize())).abs() / diagonal;
    if deviation > PLANARITY {
        return Err(ShapeError::NotPlanar { deviation });
    }
    Ok(())
}
