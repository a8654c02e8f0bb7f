//! A first picture, from a few rows of the form factors.

use super::{PatchLight, Pipeline};
use crate::error::Error;
use crate::observer::Stage;
use crate::settings;
use radiosity_form_factors::Estimation;
use radiosity_matrix::packed_len;
use radiosity_solver::Progressive;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Radiosities that were not waited for.
pub struct Preview {
    /// What patches shine with. Direct light is not known apart, nor what is hidden.
    pub light: PatchLight,
    /// The share of all pairs of patches that were looked at.
    pub share: f64,
    /// The share of the lights' power that was not followed further, and shows as an even glow.
    pub unshot: f64,
}

/// Rows that are estimated at a time, whatever the number of threads.
const AT_A_TIME: usize = 16;
/// Rounds without less light to shoot: it does not die away.
const MOST_IN_VAIN: u32 = 64;
/// Light that is worth no further row.
const NEGLIGIBLE: f64 = 1e-4;

impl Pipeline<'_> {
    /// Stages 2 and 3 in a hurry: estimates so many of the pairs, as a share of all, where most light
    /// leaves from. Nothing is taken from the cache or put there.
    pub fn preview(&self, share: f64) -> Result<Preview, Error> {
        let estimation = Estimation::new(&self.mesh, settings::estimator(self.scene));
        let areas = estimation.areas();
        let clusters = estimation.clusters().map(<[usize]>::to_vec).collect();
        // All lights at once, as bright as they are: what is dimmed is worth fewer rows.
        let emission = self.dimmed_emission().into_iter();
        let lights = [emission.map(|e| e.map(f64::from)).collect()];
        let mut light = Progressive::new(areas, &self.reflectance, &lights, clusters);
        let pairs = packed_len(areas.len()).max(1) as f64;
        let most = (share * pairs / areas.len().max(1) as f64).ceil() as usize;
        let mut rows: BTreeMap<usize, Vec<f32>> = BTreeMap::new();
        self.observer
            .begin(Stage::FormFactors, (most * areas.len()) as u64);
        let mut least = light.unshot();
        let mut in_vain = 0;
        while in_vain < MOST_IN_VAIN {
            let brightest = light.brightest(AT_A_TIME);
            let new = brightest
                .iter()
                .copied()
                .filter(|cluster| !rows.contains_key(cluster));
            let new: Vec<usize> = new.take(most - rows.len()).collect();
            let row = |&cluster: &usize| (cluster, estimation.row(cluster, light.shooter(cluster)));
            let made: Vec<(usize, Vec<f32>)> = new.par_iter().map(row).collect();
            self.observer.advance((made.len() * areas.len()) as u64);
            rows.extend(made);
            let known = brightest.iter().filter_map(|k| Some((*k, rows.get(k)?)));
            let known: Vec<(usize, &Vec<f32>)> = known.collect();
            known
                .iter()
                .for_each(|&(cluster, row)| light.shoot(cluster, row));
            let is_spent = rows.len() == most && known.len() < brightest.len();
            if known.is_empty() || is_spent || light.unshot() < NEGLIGIBLE {
                break;
            }
            // What does not fade, or is no number, never ends.
            let fades = light.unshot() < least;
            in_vain = if fades { 0 } else { in_vain + 1 };
            least = least.min(light.unshot());
        }
        self.observer.end();
        Ok(Preview {
            light: self.finite(PatchLight {
                radiosity: light.lights().concat(),
                direct: vec![[0.0; 3]; areas.len()],
                visible: vec![1.0; areas.len()],
            })?,
            share: ((rows.len() * areas.len()) as f64 / pairs).min(1.0),
            unshot: light.unshot(),
        })
    }
}
