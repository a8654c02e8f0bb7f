//! Cameras that move: around a thing, or along a path.

use super::{Camera, CameraError};
use glam::{DQuat, DVec3};
use std::f64::consts::TAU;

impl Camera {
    /// So many cameras on a full turn, of which this one is the first: counter-clockwise as seen
    /// from above, around an axis that points up and goes through what this camera looks at, as far
    /// away as `center` is.
    pub fn turntable(&self, center: DVec3, frames: u32) -> Vec<Camera> {
        let depth = (center - self.position).dot(self.forward).max(0.0);
        let pivot = self.position + depth * self.forward;
        let turned = |frame: u32| {
            let angle = TAU * f64::from(frame) / f64::from(frames);
            let turn = DQuat::from_axis_angle(self.upright, angle);
            Camera {
                position: pivot + turn * (self.position - pivot),
                forward: turn * self.forward,
                right: turn * self.right,
                up: turn * self.up,
                ..*self
            }
        };
        (0..frames).map(turned).collect()
    }

    /// So many cameras on the way from the first of some cameras, past the others, to the last: by
    /// Catmull and Rom's spline ("A Class of Local Interpolating Splines", 1974), in equal times
    /// from one to the next. Fails where on the way a camera would look nowhere, or straight up.
    ///
    /// # Panics
    ///
    /// If there are no cameras to pass.
    pub fn path(stations: &[Camera], frames: u32) -> Result<Vec<Camera>, CameraError> {
        let last = stations.len() - 1;
        let on_the_way = |frame: u32| {
            let time = f64::from(frame) / f64::from((frames - 1).max(1)) * last as f64;
            let from = (time as usize).min(last.saturating_sub(1));
            let t = time - from as f64;
            let around = [from.saturating_sub(1), from, from + 1, from + 2];
            let around = around.map(|k| &stations[k.min(last)]);
            let smooth = |of: fn(&Camera) -> DVec3| spline(around.map(of), t);
            let [_, before, after, _] = around;
            let between = |of: fn(&Camera) -> f64| of(before) + t * (of(after) - of(before));
            let height = between(|camera| camera.film_height);
            Camera::new(
                smooth(|camera| camera.position),
                smooth(|camera| camera.forward),
                smooth(|camera| camera.upright),
                2.0 * (0.5 * height).atan().to_degrees(),
                between(|camera| camera.near),
            )
        };
        (0..frames).map(on_the_way).collect()
    }
}

/// From the second point to the third, as `t` goes from 0 to 1.
fn spline([a, b, c, d]: [DVec3; 4], t: f64) -> DVec3 {
    let (slope_b, slope_c) = (0.5 * (c - a), 0.5 * (d - b));
    let (t2, t3) = (t * t, t * t * t);
    (2.0 * t3 - 3.0 * t2 + 1.0) * b
        + (t3 - 2.0 * t2 + t) * slope_b
        + (3.0 * t2 - 2.0 * t3) * c
        + (t3 - t2) * slope_c
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera(position: [f64; 3], target: [f64; 3], fov: f64) -> Camera {
        let [position, target] = [position, target].map(DVec3::from);
        Camera::new(position, target - position, DVec3::Y, fov, 0.0).unwrap()
    }

    fn is_near(a: DVec3, b: DVec3) -> bool {
        a.distance(b) < 1e-9
    }

    #[test]
    fn a_turntable_keeps_its_distance_and_what_it_looks_at() {
        let first = camera([3.0, 2.0, 0.0], [1.0, 1.0, 0.0], 40.0);
        let turn = first.turntable(DVec3::new(1.0, 1.0, 0.0), 4);
        assert_eq!(turn[0], first);
        let expected = [
            [3.0, 2.0, 0.0],
            [1.0, 2.0, -2.0],
            [-1.0, 2.0, 0.0],
            [1.0, 2.0, 2.0],
        ];
        for (camera, position) in turn.iter().zip(expected) {
            assert!(is_near(camera.position, position.into()));
            let target = camera.position + 5f64.sqrt() * camera.forward;
            assert!(is_near(target, DVec3::new(1.0, 1.0, 0.0)));
            assert!(camera.right.y.abs() < 1e-12, "the horizon is level");
        }
    }

    #[test]
    fn a_path_passes_its_stations() {
        let stations = [
            camera([0.0, 0.0, 5.0], [0.0; 3], 40.0),
            camera([5.0, 1.0, 0.0], [0.0; 3], 60.0),
            camera([0.0, 0.0, -5.0], [0.0; 3], 50.0),
        ];
        let path = Camera::path(&stations, 9).unwrap();
        assert_eq!(path.len(), 9);
        for (station, frame) in stations.iter().zip([0, 4, 8]) {
            assert!(is_near(path[frame].position, station.position));
            assert!(is_near(path[frame].forward, station.forward));
            assert!((path[frame].film_height - station.film_height).abs() < 1e-12);
        }
        // Steps are about equal, without a jump.
        let steps = path
            .windows(2)
            .map(|pair| pair[0].position.distance(pair[1].position));
        assert!(steps.clone().fold(0.0, f64::max) < 2.0 * steps.fold(9.0, f64::min));
        assert_eq!(Camera::path(&stations[..1], 2).unwrap()[1], stations[0]);
        // Halfway between opposite directions it looks nowhere.
        let opposite = [stations[0], camera([0.0, 0.0, 5.0], [0.0, 0.0, 9.0], 40.0)];
        assert!(Camera::path(&opposite, 3).is_err());
    }
}
