//! `[camera]`.

use crate::source::{Complaint, SceneError, Source};
use crate::values::{Vector, vector};
use radiosity_geometry::{Camera, CameraError, DVec3};
use serde::Deserialize;
use std::ops::Range;
use toml::Spanned;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct CameraTable {
    position: Vector,
    direction: Option<Vector>,
    look_at: Option<Vector>,
    up: Option<Vector>,
    vertical_fov: Spanned<f64>,
    near: Option<Spanned<f64>>,
}

pub(crate) fn camera(
    source: &Source<'_>,
    table: &Spanned<CameraTable>,
) -> Result<Camera, SceneError> {
    let CameraTable {
        position,
        direction,
        look_at,
        up,
        vertical_fov,
        near,
    } = table.get_ref();
    let at = vector(source, position, "`position`")?;
    let (forward, forward_span) = match (direction, look_at) {
        (Some(direction), None) => {
            let forward = vector(source, direction, "`direction`")?;
            (forward, direction.span())
        }
        (None, Some(target)) => {
            let forward = vector(source, target, "`look_at`")? - at;
            (forward, target.span())
        }
        _ => {
            let complaint = Complaint::new(
                "a camera needs either `direction` or `look_at`",
                "give one of the two",
            );
            return Err(source.error(header_span(table), &complaint));
        }
    };
    let upward = match up {
        Some(up) => vector(source, up, "`up`")?,
        None => DVec3::Y,
    };
    let near_distance = near.as_ref().map_or(0.0, |near| *near.get_ref());
    Camera::new(at, forward, upward, *vertical_fov.get_ref(), near_distance).map_err(|error| {
        let span = match error {
            CameraError::NoDirection => forward_span,
            CameraError::UpParallel => up.as_ref().map_or(forward_span, Spanned::span),
            CameraError::FieldOfView => vertical_fov.span(),
            CameraError::Near => near.as_ref().map_or(forward_span, Spanned::span),
        };
        let complaint = Complaint::new("the camera cannot look", error.to_string());
        source.error(span, &complaint)
    })
}

/// The first bytes of a table: its header, without all of its contents.
fn header_span<T>(table: &Spanned<T>) -> Range<usize> {
    let start = table.span().start;
    start..start + 1
}
