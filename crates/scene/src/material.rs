//! `[materials.NAME]`.

use crate::source::{SceneError, Source};
use crate::values::{Color, require};
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;

/// A diffuse material.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Its name in the scene file.
    pub name: String,
    /// Diffuse reflectance per channel, in [0, 1].
    pub reflectance: [f64; 3],
    /// Radiant exitance that the surface emits itself, per channel, W/m^2: 0, or
    /// between 1e-30 and 1e30.
    pub emission: [f64; 3],
}

/// What radiosities in single precision can follow.
const EMISSION: std::ops::RangeInclusive<f64> = 1e-30..=1e30;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MaterialTable {
    reflectance: Spanned<Color>,
    emission: Option<Spanned<Color>>,
}

pub(crate) fn materials(
    source: &Source<'_>,
    tables: BTreeMap<String, MaterialTable>,
) -> Result<Vec<Material>, SceneError> {
    let check = |(name, table): (String, MaterialTable)| {
        let share = |c: &Color| c.0.iter().all(|x| (0.0..=1.0).contains(x));
        let what = format!("the reflectance of `{name}`");
        require(source, &table.reflectance, share, &what, "in [0, 1]")?;
        if let Some(emission) = &table.emission {
            let power = |c: &Color| c.0.iter().all(|x| *x == 0.0 || EMISSION.contains(x));
            let what = format!("the emission of `{name}`");
            require(
                source,
                emission,
                power,
                &what,
                "0, or between 1e-30 and 1e30",
            )?;
        }
        Ok(Material {
            reflectance: table.reflectance.get_ref().0,
            emission: table.emission.map_or([0.0; 3], |e| e.get_ref().0),
            name,
        })
    };
    tables.into_iter().map(check).collect()
}
