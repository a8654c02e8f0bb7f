//! `[camera]` and `[[views]]`.

use crate::source::{Complaint, SceneError, Source};
use crate::values::{Vector, check_name, vector};
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

/// A camera beside the first one, by its name.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// What its pictures are named after.
    pub name: String,
    /// The camera.
    pub camera: Camera,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ViewTable {
    name: Spanned<String>,
    camera: Spanned<CameraTable>,
}

/// All views; their names are parts of files' names.
pub(crate) fn views(source: &Source<'_>, tables: &[ViewTable]) -> Result<Vec<View>, SceneError> {
    let mut views: Vec<View> = Vec::new();
    for table in tables {
        check_name(source, &table.name, "the name of a view")?;
        let name = table.name.get_ref();
        let is_plain = |c: char| c.is_alphanumeric() || c == '-' || c == '_';
        let label = if !name.chars().all(is_plain) {
            "use letters, digits, `-` and `_`: files are named after it"
        } else if name == ALL_VIEWS || name == FIRST_VIEW {
            "this stands for all views, or for [camera]: give it another name"
        } else if views.iter().any(|view| view.name == *name) {
            "another view has this name already"
        } else {
            views.push(View {
                name: name.clone(),
                camera: camera(source, &table.camera)?,
            });
            continue;
        };
        let complaint = Complaint::new(format!("a view cannot be called `{name}`"), label);
        return Err(source.error(table.name.span(), &complaint));
    }
    Ok(views)
}

/// What stands for all views on the command line.
pub const ALL_VIEWS: &str = "all";
/// What stands for the first one.
pub const FIRST_VIEW: &str = "camera";

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
