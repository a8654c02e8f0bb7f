//! Convex polygons as a point sees them, cut by planes through that point.

use radiosity_geometry::DVec3;
use std::f64::consts::TAU;

/// The square of the sine of an angle that is a rounding.
const SAME: f64 = 1e-28;

/// Convex polygons of any plane, by the directions to their corners.
#[derive(Clone, Debug, Default)]
pub(super) struct Pieces {
    corners: Vec<DVec3>,
    /// Where each one's corners end.
    ends: Vec<usize>,
}

/// Polygons that are being cut, and room for it.
#[derive(Default)]
pub(crate) struct Cutting {
    pub(super) pieces: Pieces,
    next: Pieces,
    inside: Vec<DVec3>,
    rest: Vec<DVec3>,
    cone: Vec<DVec3>,
}

impl Pieces {
    fn clear(&mut self) {
        self.corners.clear();
        self.ends.clear();
    }

    fn push(&mut self, corners: &[DVec3]) {
        if corners.len() >= 3 {
            self.corners.extend_from_slice(corners);
            self.ends.push(self.corners.len());
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &[DVec3]> {
        let starts = [0].into_iter().chain(self.ends.iter().copied());
        starts
            .zip(&self.ends)
            .map(|(start, &end)| &self.corners[start..end])
    }
}

impl Cutting {
    /// Begins with the part of one polygon where `normal` points to.
    pub(super) fn begin(&mut self, polygon: &[DVec3], normal: DVec3) {
        self.pieces.clear();
        self.inside.clear();
        clip(polygon, |corner| corner.dot(normal), &mut self.inside);
        self.pieces.push(&self.inside);
    }

    /// Cuts out the shadow of a polygon, of which the front is seen or the back; the part alone
    /// that lies nearer than a plane, which is where `normal . p = distance`.
    pub(super) fn cut_out(
        &mut self,
        blocker: &[DVec3],
        shows_front: bool,
        (normal, distance): (DVec3, f64),
    ) {
        let Cutting {
            pieces,
            next,
            inside,
            rest,
            cone,
        } = self;
        rest.clear();
        clip(blocker, |corner| normal.dot(corner) - distance, rest);
        let Some(&last) = rest.last() else {
            return;
        };
        // The shadow is where all of these point to.
        cone.clear();
        let mut from = last;
        for &to in rest.iter() {
            let side = if shows_front {
                to.cross(from)
            } else {
                from.cross(to)
            };
            // Clipping may leave a corner twice, and an edge without a direction.
            if side.length_squared() > SAME * from.length_squared() * to.length_squared() {
                cone.push(side);
            }
            from = to;
        }
        next.clear();
        for piece in pieces.iter() {
            let is_apart = |side: &DVec3| piece.iter().all(|corner| corner.dot(*side) <= 0.0);
            if cone.iter().any(is_apart) {
                next.push(piece);
                continue;
            }
            inside.clear();
            inside.extend_from_slice(piece);
            for &side in cone.iter() {
                rest.clear();
                clip(inside, |corner| -corner.dot(side), rest);
                next.push(rest);
                rest.clear();
                clip(inside, |corner| corner.dot(side), rest);
                std::mem::swap(inside, rest);
            }
        }
        std::mem::swap(pieces, next);
    }
}

/// The part of a convex polygon where a linear function is not negative, appended.
fn clip(polygon: &[DVec3], height_of: impl Fn(DVec3) -> f64, kept: &mut Vec<DVec3>) {
    let Some(&last) = polygon.last() else {
        return;
    };
    let (mut from, mut height) = (last, height_of(last));
    for &to in polygon {
        let next = height_of(to);
        if (height < 0.0 && next > 0.0) || (height > 0.0 && next < 0.0) {
            kept.push(from + (height / (height - next)) * (to - from));
        }
        if next >= 0.0 {
            kept.push(to);
        }
        (from, height) = (to, next);
    }
}

/// The form factor from a point of a surface with a normal to a polygon above its horizon, whose
/// corners run counter-clockwise as the point sees them (Lambert, Photometria, 1760; Hottel &
/// Sarofim 1967).
pub(super) fn form_factor(polygon: &[DVec3], normal: DVec3) -> f64 {
    let Some(&last) = polygon.last() else {
        return 0.0;
    };
    let mut sum = 0.0;
    let mut from = last;
    for &to in polygon {
        let cross = from.cross(to);
        let length = cross.length();
        if length > 0.0 {
            sum += length.atan2(from.dot(to)) / length * cross.dot(normal);
        }
        from = to;
    }
    -sum / TAU
}
