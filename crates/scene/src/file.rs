//! The tables of a scene file, as they are written.

use crate::camera::{CameraTable, ViewTable};
use crate::image::ImageTable;
use crate::light::LightTable;
use crate::material::MaterialTable;
use crate::settings::{DiscretizationTable, FormFactorTable, SolverTable};
use crate::surface::SurfaceTable;
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;

/// A whole scene file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SceneFile {
    pub(crate) camera: Option<Spanned<CameraTable>>,
    #[serde(default)]
    pub(crate) views: Vec<ViewTable>,
    #[serde(default)]
    pub(crate) image: ImageTable,
    #[serde(default)]
    pub(crate) discretization: DiscretizationTable,
    #[serde(default)]
    pub(crate) form_factors: FormFactorTable,
    #[serde(default)]
    pub(crate) solver: SolverTable,
    pub(crate) materials: BTreeMap<Spanned<String>, MaterialTable>,
    #[serde(default)]
    pub(crate) lights: BTreeMap<Spanned<String>, LightTable>,
    pub(crate) surfaces: Vec<Spanned<SurfaceTable>>,
}
