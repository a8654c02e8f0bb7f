//! Cameras: where things appear, and which cameras there cannot be.

use radiosity_geometry::{Camera, CameraError, DVec3};

/// The course's camera: where the corners of its lamp appear is known.
#[test]
fn the_camera_projects_as_the_course_does() {
    let direction = DVec3::new(0.0, -0.042612, -1.0);
    let position = DVec3::new(50.0, 52.0, 295.6);
    let camera = Camera::new(position, direction, DVec3::Y, 28.79932, 130.0).unwrap();
    let meets_lamp = |x: f64, y: f64| {
        let ray = camera.ray(x / 640.0, y / 480.0, 640.0 / 480.0);
        ray.at((79.99 - ray.origin.y) / ray.direction.y)
    };
    // A tenth of a pixel, the precision of the reference, is 0.03 units across and, at this
    // grazing view, 0.5 units along.
    let (near_left, far_right) = (meets_lamp(275.3, 75.0), meets_lamp(357.6, 85.9));
    assert!((near_left.x - 40.0).abs() < 0.05 && (near_left.z - 85.0).abs() < 0.5);
    assert!((far_right.z - 65.0).abs() < 0.5);
    assert!((meets_lamp(364.7, 75.0).x - 60.0).abs() < 0.05);
}

#[test]
fn impossible_cameras_are_refused() {
    let camera = |direction, up, fov, near| {
        Camera::new(DVec3::ZERO, direction, up, fov, near)
            .map(|_| ())
            .unwrap_err()
    };
    assert_eq!(
        camera(DVec3::ZERO, DVec3::Y, 30.0, 0.0),
        CameraError::NoDirection
    );
    assert_eq!(
        camera(DVec3::Y, DVec3::Y, 30.0, 0.0),
        CameraError::UpParallel
    );
    let oblique = DVec3::new(0.1, -0.3, 0.2);
    assert_eq!(
        camera(oblique, 3.0 * oblique, 30.0, 0.0),
        CameraError::UpParallel
    );
    assert_eq!(
        camera(DVec3::Z, DVec3::Y, 180.0, 0.0),
        CameraError::FieldOfView
    );
    assert_eq!(
        camera(DVec3::Z, DVec3::Y, f64::NAN, 0.0),
        CameraError::FieldOfView
    );
    assert_eq!(camera(DVec3::Z, DVec3::Y, 30.0, -1.0), CameraError::Near);
}
