//! The tables of a scene, as they are written.

use crate::camera::{CameraTable, ViewTable};
use crate::light::LightTable;
use crate::material::MaterialTable;
use crate::surface::SurfaceTable;
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;

/// All that a scene file says of the scene.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SceneFile {
    pub(crate) camera: Option<Spanned<CameraTable>>,
    #[serde(default)]
    pub(crate) views: Vec<ViewTable>,
    #[serde(default)]
    pub(crate) materials: BTreeMap<Spanned<String>, MaterialTable>,
    #[serde(default)]
    pub(crate) lights: BTreeMap<Spanned<String>, LightTable>,
    #[serde(default)]
    pub(crate) surfaces: Vec<Spanned<SurfaceTable>>,
}

/// Their names; other tables are for whoever works with the scene.
pub(crate) const TABLES: [&str; 5] = ["camera", "views", "materials", "lights", "surfaces"];
