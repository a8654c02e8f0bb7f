//! How bright lights are, on the command line.

use super::parse::{parse_dim, parse_tint};
use crate::error::Error;
use clap::Args;
use radiosity::scene::Scene;
use radiosity::stages::Dimming;
use std::collections::BTreeSet;

/// How bright lights are; no solution is made anew for that.
#[derive(Debug, Args)]
#[command(next_help_heading = "Lights")]
pub struct LightArgs {
    /// Factor on the brightness of a light; once for each light
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
    /// The lights of a scene as these flags have them.
    pub(super) fn dimming(&self, scene: &Scene) -> Result<Dimming, Error> {
        once(&self.dim, "--dim")?;
        once(&self.tint, "--tint")?;
        let mut dimming = Dimming::of(scene);
        for (name, dim) in &self.dim {
            dimming.light(name)?.dim = *dim;
        }
        for (name, tint) in &self.tint {
            dimming.light(name)?.tint = *tint;
        }
        if !self.only.is_empty() {
            dimming.only(&self.only)?;
        }
        Ok(dimming)
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
