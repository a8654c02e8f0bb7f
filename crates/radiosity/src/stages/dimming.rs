//! How bright lights are: nothing is solved anew for that.

use super::factors::Factors;
use super::light::PatchLight;
use super::solution::Solved;
use crate::error::Error;
use radiosity_scene::{Light, Scene, suggestion};
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
            None => Err(Error::NoSuchLight {
                help: suggestion(name, names())
                    .unwrap_or_else(|| "nothing in this scene emits".to_owned()),
                name: name.to_owned(),
            }),
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
    /// If single precision does not hold the light.
    pub fn relight(&self, dimming: &Dimming) -> Result<PatchLight, Error> {
        let factors = self.factors;
        let dimming = dimming.factors();
        let sum = |lights: &[Vec<[f32; 3]>]| {
            let mut sum = solver::relit(lights, &dimming);
            // It is dark where there are no lights.
            sum.resize(factors.patches.mesh.patches.len(), [0.0; 3]);
            sum
        };
        let light = PatchLight {
            emission: factors.emission(&dimming),
            radiosity: sum(&self.solution.lights),
            direct: sum(&self.solution.direct),
            visible: self.visible.clone(),
            energy: self.solution.energy(&dimming),
        };
        let light = PatchLight::of_elements(factors.params.mode, light);
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
