//! How bright lights are, on the command line.

use super::parse::{parse_dim, parse_tint};
use crate::error::Error;
use clap::Args;
use radiosity::scene::{Light, Scene, suggestion};
use std::collections::BTreeSet;

/// How bright lights are; no solution is made anew for that.
#[derive(Debug, Args)]
#[command(next_help_heading = "Lights")]
pub struct LightArgs {
    /// Make a light darker or brighter than its materials say, by a factor; once for each light
    #[arg(long, value_name = "LIGHT=X", value_parser = parse_dim)]
    pub dim: Vec<(String, f64)>,
    /// Factors on the red, green and blue of a light; once for each light
    #[arg(long, value_name = "LIGHT=R,G,B", value_parser = parse_tint)]
    pub tint: Vec<(String, [f64; 3])>,
    /// Switch all other lights off
    #[arg(long, value_name = "LIGHT,..", value_delimiter = ',')]
    pub only: Vec<String>,
}

impl LightArgs {
    pub(crate) fn apply(&self, scene: &mut Scene) -> Result<(), Error> {
        once(&self.dim, "--dim")?;
        once(&self.tint, "--tint")?;
        for (name, dim) in &self.dim {
            light(scene, name)?.dim = *dim;
        }
        for (name, tint) in &self.tint {
            light(scene, name)?.tint = *tint;
        }
        for name in &self.only {
            light(scene, name)?;
        }
        let is_off = |light: &&mut Light| !self.only.is_empty() && !self.only.contains(&light.name);
        scene
            .lights
            .iter_mut()
            .filter(is_off)
            .for_each(|light| light.dim = 0.0);
        Ok(())
    }
}

/// Refuses to be told twice of one light.
fn once<T>(of_lights: &[(String, T)], flag: &str) -> Result<(), Error> {
    let mut names = BTreeSet::new();
    match of_lights.iter().find(|(name, _)| !names.insert(name)) {
        Some((name, _)) => Err(Error::with_help(
            format!("{flag} is given twice for the light `{name}`"),
            "give it once for each light",
        )),
        None => Ok(()),
    }
}

fn light<'a>(scene: &'a mut Scene, name: &str) -> Result<&'a mut Light, Error> {
    let names: Vec<&str> = scene
        .lights
        .iter()
        .map(|light| light.name.as_str())
        .collect();
    let Some(index) = names.iter().position(|known| *known == name) else {
        let help = suggestion(name, names.iter().copied());
        let help = help.unwrap_or_else(|| "nothing in this scene emits".to_owned());
        return Err(Error::with_help(
            format!("there is no light `{name}`"),
            help,
        ));
    };
    Ok(&mut scene.lights[index])
}
