//! `[materials.NAME]`.

use crate::light::Light;
use crate::source::{Complaint, SceneError, Source};
use crate::values::{Color, check_name, require};
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
    /// The light that it belongs to, by its number in the scene, if it emits and is on a surface.
    pub light: Option<usize>,
}

impl Material {
    /// What it emits with its light, of all of them, dimmed and tinted.
    pub fn dimmed_emission(&self, lights: &[Light]) -> [f64; 3] {
        let light = self.light.and_then(|light| lights.get(light));
        let factor = light.map_or([1.0; 3], Light::dimming);
        std::array::from_fn(|c| factor[c] * self.emission[c])
    }
}

/// What radiosities in single precision can follow.
const EMISSION: std::ops::RangeInclusive<f64> = 1e-30..=1e30;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MaterialTable {
    reflectance: Spanned<Color>,
    emission: Option<Spanned<Color>>,
    light: Option<Spanned<String>>,
}

/// The materials, and the names of the lights that they belong to.
pub(crate) fn materials(
    source: &Source<'_>,
    tables: BTreeMap<Spanned<String>, MaterialTable>,
) -> Result<(Vec<Material>, Vec<String>), SceneError> {
    let mut lights = Vec::new();
    let mut check = |(name, table): (Spanned<String>, MaterialTable)| {
        check_name(source, &name, "the name of a material")?;
        let name = name.into_inner();
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
        let emission = table.emission.map_or([0.0; 3], |e| e.get_ref().0);
        let emits = emission != [0.0; 3];
        Ok(Material {
            light: light_name(source, &table.light, &name, emits)?
                .map(|light| number_of(&mut lights, light)),
            reflectance: table.reflectance.get_ref().0,
            emission,
            name,
        })
    };
    let materials: Result<Vec<Material>, SceneError> = tables.into_iter().map(&mut check).collect();
    Ok((materials?, lights))
}

/// The light of a material: the one it names, or one of its own.
fn light_name(
    source: &Source<'_>,
    named: &Option<Spanned<String>>,
    material: &str,
    emits: bool,
) -> Result<Option<String>, SceneError> {
    let Some(named) = named else {
        return Ok(emits.then(|| material.to_owned()));
    };
    let complain =
        |title: String, label: &str| Err(source.error(named.span(), &Complaint::new(title, label)));
    if !emits {
        let title = format!("`{material}` belongs to a light but does not emit");
        return complain(title, "remove this, or add an `emission`");
    }
    check_name(source, named, &format!("the light of `{material}`"))?;
    Ok(Some(named.get_ref().clone()))
}

/// The number of a name, which is added if it is new.
fn number_of(names: &mut Vec<String>, name: String) -> usize {
    names
        .iter()
        .position(|known| *known == name)
        .unwrap_or_else(|| {
            names.push(name);
            names.len() - 1
        })
}
