//! What `reference` has made, for scripts.

use serde::Serialize;
use std::collections::BTreeMap;

/// The object that `--json` prints. Fields may be added, but not changed or removed.
#[derive(Debug, Serialize)]
pub(super) struct Json {
    /// The scene's name.
    pub(super) scene: String,
    /// Random walks per pixel or patch.
    pub(super) walks: u32,
    pub(super) seconds: f64,
    /// By whose instructions rays were traced.
    pub(super) instruction_set: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) picture: Option<PictureReport>,
    /// How many rows the table has.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) patches: Option<usize>,
    /// Written files: `radiance`, `standard_error` and `png`, or `table`.
    pub(super) outputs: BTreeMap<&'static str, String>,
}

#[derive(Debug, Serialize)]
pub(super) struct PictureReport {
    /// The estimated root mean square error, in percent of the mean.
    pub(super) error_percent: f64,
    /// The factor from radiance to brightness, of the PNG.
    pub(super) exposure: f64,
    /// Points of surfaces where walks gathered light.
    pub(super) vertices: u64,
    pub(super) vertices_per_second_and_thread: f64,
}
