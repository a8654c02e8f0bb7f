//! How bright lights are: nothing is solved anew for that.

use super::factors::Factors;
use super::light::PatchLight;
use super::solution::Solved;
use crate::energy::Energy;
use crate::error::Error;
use radiosity_params::OutOfRange;
use radiosity_scene::{Light, MOST_DIMMING, Scene};
use radiosity_solver as solver;

/// The factors on each light of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Dimming {
    lights: Vec<Light>,
}

impl Dimming {
    /// As bright as the scene has them.
    pub fn of(scene: &Scene) -> Dimming {
        Dimming {
            lights: scene.lights.clone(),
        }
    }

    /// The lights with their factors, in the order of the scene.
    pub fn lights(&self) -> &[Light] {
        &self.lights
    }

    /// The light of this name, to be dimmed or tinted.
    ///
    /// # Errors
    ///
    /// If there is none.
    pub fn light(&mut self, name: &str) -> Result<&mut Light, Error> {
        let names = || self.lights.iter().map(|light| light.name.as_str());
        match names().position(|known| known == name) {
            Some(index) => Ok(&mut self.lights[index]),
            None => Err(Error::not_in_scene("light", name, names())),
        }
    }

    /// Switches all lights off but these.
    pub fn only(&mut self, names: &[impl AsRef<str>]) -> Result<(), Error> {
        for name in names {
            self.light(name.as_ref())?;
        }
        let is_kept = |light: &Light| names.iter().any(|name| name.as_ref() == light.name);
        let others = self.lights.iter_mut().filter(|light| !is_kept(light));
        others.for_each(|light| light.dim = 0.0);
        Ok(())
    }

    /// Refuses factors that flags and files could not have.
    fn check(&self) -> Result<(), OutOfRange> {
        let is_good = |factor: f64| (0.0..=MOST_DIMMING).contains(&factor);
        let dims = self.lights.iter().all(|light| is_good(light.dim));
        OutOfRange::unless(dims, "dim", "between 0 and 1000")?;
        let mut tints = self.lights.iter().flat_map(|light| light.tint);
        OutOfRange::unless(tints.all(is_good), "tint", "between 0 and 1000")
    }

    /// The factor of each light, per channel.
    pub fn factors(&self) -> Vec<[f64; 3]> {
        self.lights.iter().map(Light::dimming).collect()
    }
}

impl Solved<'_> {
    /// What patches shine with, with the lights as bright as the scene has them.
    pub fn light(&self) -> Result<PatchLight, Error> {
        self.relight(&Dimming::of(self.factors.patches.scene))
    }

    /// What patches shine with, with the lights dimmed and tinted: nothing is solved for that.
    ///
    /// # Errors
    ///
    /// If a factor is out of its range, or if single precision does not hold the light.
    ///
    /// # Panics
    ///
    /// If the lights are those of another scene.
    pub fn relight(&self, dimming: &Dimming) -> Result<PatchLight, Error> {
        dimming.check()?;
        let factors = self.factors;
        let dimming = dimming.factors();
        let sum = |lights: &[Vec<[f32; 3]>]| {
            let mut sum = solver::superpose(lights, &dimming);
            // It is dark where there are no lights.
            sum.resize(factors.patches.mesh.patches.len(), [0.0; 3]);
            sum
        };
        let light = PatchLight {
            emission: factors.emission(&dimming),
            radiosity: sum(&self.solution.lights),
            direct: sum(&self.solution.direct),
            elements: self.elements.clone(),
            visible: self.visible.clone(),
            energy: Energy::sum(&self.energies, &dimming),
        };
        let checked = solver::check_radiosities([&light.radiosity[..]]);
        checked.map_err(|error| factors.of_solver(&error))?;
        Ok(light)
    }
}

impl Factors<'_> {
    /// What each patch emits itself, with each light times a factor.
    fn emission(&self, dimming: &[[f64; 3]]) -> Vec<[f32; 3]> {
        let mut sum = vec![[0.0; 3]; self.patches.mesh.patches.len()];
        for (light, factor) in self.patches.lights.iter().zip(dimming) {
            for (sum, emission) in sum.iter_mut().zip(light) {
                (0..3).for_each(|c| sum[c] += (factor[c] * emission[c]) as f32);
            }
        }
        sum
    }
}
