//! Axis-aligned bounding boxes.

use glam::DVec3;

/// The closed box `min..=max`; [`Aabb::EMPTY`] contains nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Smallest coordinates.
    pub min: DVec3,
    /// Largest coordinates.
    pub max: DVec3,
}

impl Aabb {
    /// The neutral element of [`Aabb::union`].
    pub const EMPTY: Aabb = Aabb {
        min: DVec3::INFINITY,
        max: DVec3::NEG_INFINITY,
    };

    /// The smallest box around some points.
    pub fn around(points: impl IntoIterator<Item = DVec3>) -> Aabb {
        points.into_iter().fold(Aabb::EMPTY, |bounds, p| Aabb {
            min: bounds.min.min(p),
            max: bounds.max.max(p),
        })
    }

    /// The smallest box around both.
    pub fn union(self, other: Aabb) -> Aabb {
        Aabb {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// The box with every side moved outwards by `distance`.
    pub fn grown(self, distance: f64) -> Aabb {
        Aabb {
            min: self.min - distance,
            max: self.max + distance,
        }
    }

    /// Whether the closed box holds a point.
    pub fn contains(&self, point: DVec3) -> bool {
        self.min.cmple(point).all() && self.max.cmpge(point).all()
    }

    /// Whether both boxes are no farther apart than `distance` along any axis.
    pub fn is_near(&self, other: &Aabb, distance: f64) -> bool {
        let gap = self.min.max(other.min) - self.max.min(other.max);
        gap.max_element() <= distance
    }

    /// The centre.
    pub fn center(&self) -> DVec3 {
        0.5 * (self.min + self.max)
    }

    /// The edge lengths; zero for an empty box.
    pub fn extent(&self) -> DVec3 {
        (self.max - self.min).max(DVec3::ZERO)
    }

    /// Half the surface area: the measure of the surface area heuristic.
    pub fn half_area(&self) -> f64 {
        let e = self.extent();
        e.x * e.y + e.y * e.z + e.z * e.x
    }
}
