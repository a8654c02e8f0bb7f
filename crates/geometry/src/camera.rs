//! The pinhole camera.

mod camera_path;
pub(crate) mod film;

use crate::rays::ray::Ray;
use glam::DVec3;

/// A pinhole camera. The film is a rectangle at distance 1 in front of the pinhole.
///
/// ```
/// use radiosity_geometry::{Camera, DVec3};
///
/// let (position, direction) = (DVec3::new(0.0, 0.0, 5.0), DVec3::NEG_Z);
/// let camera = Camera::new(position, direction, DVec3::Y, 90.0, 0.0)?;
/// // The middle of the upper edge of a picture that is twice as wide as high.
/// let ray = camera.ray(0.5, 0.0, 2.0);
/// assert!(ray.direction.abs_diff_eq(DVec3::new(0.0, 1.0, -1.0), 1e-15));
/// # Ok::<(), radiosity_geometry::CameraError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    position: DVec3,
    forward: DVec3,
    right: DVec3,
    up: DVec3,
    /// What was said to be up.
    upright: DVec3,
    film_height: f64,
    near: f64,
}

/// Why a camera cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CameraError {
    /// The view direction has no length.
    #[error("the view direction has length zero")]
    NoDirection,
    /// Up and the view direction are parallel.
    #[error("the up vector is parallel to the view direction")]
    UpParallel,
    /// The field of view is not an angle between 0 and 180 degrees.
    #[error("the vertical field of view must lie between 0 and 180 degrees")]
    FieldOfView,
    /// The near distance is negative or not finite.
    #[error("the near distance must not be negative")]
    Near,
}

/// Sine of the angle below which rounding would decide where up is.
const PARALLEL: f64 = 1e-9;

impl Camera {
    /// A camera at `position` that looks along `direction`.
    ///
    /// `vertical_fov` is in degrees; whatever lies nearer than `near` along the view direction
    /// is not seen (it still casts shadows).
    pub fn new(
        position: DVec3,
        direction: DVec3,
        up: DVec3,
        vertical_fov: f64,
        near: f64,
    ) -> Result<Camera, CameraError> {
        let forward = direction.try_normalize().ok_or(CameraError::NoDirection)?;
        let upright = up.normalize_or_zero();
        let right = forward.cross(upright);
        if right.length() < PARALLEL {
            return Err(CameraError::UpParallel);
        }
        let right = right.normalize();
        if !(vertical_fov > 0.0 && vertical_fov < 180.0) {
            return Err(CameraError::FieldOfView);
        }
        if !(near >= 0.0 && near.is_finite()) {
            return Err(CameraError::Near);
        }
        Ok(Camera {
            position,
            forward,
            right,
            up: right.cross(forward),
            upright,
            film_height: 2.0 * (0.5 * vertical_fov.to_radians()).tan(),
            near,
        })
    }

    /// The ray through a point of the film: `x` from 0 (left) to 1 (right), `y` from 0 (top) to
    /// 1 (bottom), `aspect` = width / height. The view depth of its points is their parameter;
    /// what it may hit starts at [`Camera::near`].
    pub fn ray(&self, x: f64, y: f64, aspect: f64) -> Ray {
        let across = (x - 0.5) * aspect * self.film_height;
        let upward = (0.5 - y) * self.film_height;
        let direction = self.forward + across * self.right + upward * self.up;
        Ray::new(self.position, direction)
    }

    /// Where the pinhole is.
    pub fn position(&self) -> DVec3 {
        self.position
    }

    /// The direction of the ray through a place of the film of a picture with so many pixels, as
    /// `film[0] + x film[1] + y film[2]`; `x` and `y` are in pixels from the top left corner.
    /// Directions are as long as in [`Camera::ray`].
    pub fn film(&self, width: u32, height: u32) -> [DVec3; 3] {
        let pixel = self.film_height / f64::from(height);
        let (across, down) = (pixel * self.right, -pixel * self.up);
        let middle = 0.5 * (f64::from(width) * across + f64::from(height) * down);
        [self.forward - middle, across, down]
    }

    /// The view depth at which visible things begin, in scene units.
    pub fn near(&self) -> f64 {
        self.near
    }
}
