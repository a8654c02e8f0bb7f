//! `[lights.NAME]`: emitters that are dimmed together.

use crate::material::Material;
use crate::source::{Complaint, SceneError, Source};
use crate::surface::Surface;
use crate::values::{Color, require};
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use toml::Spanned;

/// Materials whose emission is dimmed and tinted together, without solving anew.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// The name that its materials give it, or that of its one material.
    pub name: String,
    /// Factor on its emission, >= 0: 1 is as stated.
    pub dim: f64,
    /// Factor on each channel, >= 0.
    pub tint: [f64; 3],
}

impl Light {
    /// As bright as its materials say.
    pub(crate) fn named(name: &str) -> Light {
        Light {
            name: name.to_owned(),
            dim: 1.0,
            tint: [1.0; 3],
        }
    }

    /// The factor on the emission, per channel.
    pub fn dimming(&self) -> [f64; 3] {
        self.tint.map(|tint| self.dim * tint)
    }
}

/// Largest factor: with the largest emission and tint, still what numbers can be.
pub const MOST_DIMMING: f64 = 1e3;

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct LightTable {
    dim: Option<Spanned<f64>>,
    tint: Option<Spanned<Color>>,
}

/// The lights that the materials name, in the order of their first materials, with what the tables
/// say of them.
pub(crate) fn lights(
    source: &Source<'_>,
    names: &[String],
    tables: &BTreeMap<Spanned<String>, LightTable>,
) -> Result<Vec<Light>, SceneError> {
    let mut lights: Vec<Light> = names.iter().map(|name| Light::named(name)).collect();
    for (name, table) in tables {
        let Some(light) = lights
            .iter_mut()
            .find(|light| light.name == *name.get_ref())
        else {
            return Err(source.error(name.span(), &no_such_light(name.get_ref(), &lights)));
        };
        let range = "between 0 and 1000";
        if let Some(dim) = &table.dim {
            let what = format!("the `dim` of light `{}`", light.name);
            let holds = |dim: &f64| (0.0..=MOST_DIMMING).contains(dim);
            require(source, dim, holds, &what, range)?;
            light.dim = *dim.get_ref();
        }
        if let Some(tint) = &table.tint {
            let what = format!("the `tint` of light `{}`", light.name);
            let holds = |tint: &Color| tint.0.iter().all(|x| (0.0..=MOST_DIMMING).contains(x));
            require(source, tint, holds, &what, range)?;
            light.tint = tint.get_ref().0;
        }
    }
    Ok(lights)
}

/// Leaves out lights whose materials are on no surface: they cost a solution each, and show
/// nothing.
pub(crate) fn keep_used(
    lights: Vec<Light>,
    materials: &mut [Material],
    surfaces: &[Surface],
) -> Vec<Light> {
    let used: BTreeSet<usize> = surfaces
        .iter()
        .flat_map(|surface| &surface.materials)
        .filter_map(|&material| materials[material].light)
        .collect();
    for material in materials {
        let place = |light: usize| used.iter().position(|&used| used == light);
        material.light = material.light.and_then(place);
    }
    let lights = lights.into_iter().enumerate();
    let kept = lights.filter(|(number, _)| used.contains(number));
    kept.map(|(_, light)| light).collect()
}

fn no_such_light(name: &str, lights: &[Light]) -> Complaint {
    let label = format!("no material that emits has this name or `light = \"{name}\"`");
    Complaint::new(format!("there is no light `{name}`"), label)
        .suggest(name, lights.iter().map(|light| light.name.as_str()))
}
