//! Progressive refinement: a picture from a few rows of form factors.
//!
//! The light that a patch has not passed on yet is shot into the scene, where it is most first
//! (Cohen, Chen, Wallace & Greenberg, "A progressive refinement approach to fast radiosity image
//! generation", SIGGRAPH 1988); what is still to be shot is shown as if it arrived everywhere
//! alike, the ambient term. Here clusters of a few patches shoot from one of them, so that a row of
//! form factors, which is what costs, serves them all.

use crate::Rgb;
use crate::problem::ratio;

/// Light on its way.
pub struct Progressive<'a> {
    areas: &'a [f64],
    reflectance: &'a [Rgb],
    /// Patches that shoot together.
    clusters: Vec<Vec<usize>>,
    /// Radiosities per light and patch, and what of them is still to be shot.
    radiosity: Vec<Vec<Rgb>>,
    unshot: Vec<Vec<Rgb>>,
    /// Of each light and channel, the power that it emits, or 1.
    emitted: Vec<Rgb>,
    /// How many channels of lights emit.
    lit: usize,
    /// Power that was shot, over all lights as shares of what they emit, and what of it arrived.
    shot: f64,
    arrived: f64,
}

impl<'a> Progressive<'a> {
    /// All light is still where it is emitted.
    pub fn new(
        areas: &'a [f64],
        reflectance: &'a [Rgb],
        lights: &[Vec<Rgb>],
        clusters: Vec<Vec<usize>>,
    ) -> Progressive<'a> {
        let power = |light: &Vec<Rgb>| {
            let of_channel = |c: usize| light.iter().zip(areas).map(|(e, area)| area * e[c]).sum();
            [of_channel(0), of_channel(1), of_channel(2)]
                .map(|power: f64| if power > 0.0 { power } else { 1.0 })
        };
        Progressive {
            areas,
            reflectance,
            clusters,
            radiosity: lights.to_vec(),
            unshot: lights.to_vec(),
            lit: lit(lights),
            emitted: lights.iter().map(power).collect(),
            shot: 0.0,
            arrived: 0.0,
        }
    }

    /// The clusters with most light to shoot, the first most; none that have nothing.
    pub fn brightest(&self, count: usize) -> Vec<usize> {
        let powers: Vec<f64> = (0..self.clusters.len())
            .map(|k| self.unshot_of(k))
            .collect();
        let mut order: Vec<usize> = (0..powers.len()).filter(|&k| powers[k] > 0.0).collect();
        order.sort_by(|&a, &b| powers[b].total_cmp(&powers[a]).then(a.cmp(&b)));
        order.truncate(count);
        order
    }

    /// The place in a cluster of the patch that shoots for all: the one in the middle of those that are
    /// not covered.
    pub fn shooter(&self, cluster: usize) -> usize {
        let patches = &self.clusters[cluster];
        let free = || (0..patches.len()).filter(|&place| self.areas[patches[place]] > 0.0);
        free().nth(free().count() / 2).unwrap_or(0)
    }

    /// Shoots all light of a cluster along the row `S_ij` of its shooter, in units of the total area.
    pub fn shoot(&mut self, cluster: usize, row: &[f32]) {
        let shooter = self.clusters[cluster][self.shooter(cluster)];
        let total: f64 = self.areas.iter().sum();
        let factor = |j: usize| ratio(f64::from(row[j]) * total, self.areas[shooter]);
        let row_sum: f64 = (0..row.len()).map(factor).sum();
        let power = self.unshot_of(cluster);
        self.shot += power;
        self.arrived += power * row_sum;
        for light in 0..self.unshot.len() {
            let mut power = [0.0; 3];
            for &i in &self.clusters[cluster] {
                let unshot = std::mem::take(&mut self.unshot[light][i]);
                (0..3).for_each(|c| power[c] += self.areas[i] * unshot[c]);
            }
            for j in (0..row.len()).filter(|&j| row[j] != 0.0) {
                // F_ij of what leaves i arrives at j.
                let share = f64::from(row[j]) * total / self.areas[shooter] / self.areas[j];
                let reflected: Rgb =
                    std::array::from_fn(|c| self.reflectance[j][c] * share * power[c]);
                for sums in [&mut self.radiosity, &mut self.unshot] {
                    (0..3).for_each(|c| sums[light][j][c] += reflected[c]);
                }
            }
        }
    }

    /// The share of the lights' power that waits to be shot: what the ambient term stands for.
    pub fn unshot(&self) -> f64 {
        let all = (0..self.clusters.len()).map(|k| self.unshot_of(k));
        let lit = self.lit.max(1) as f64;
        all.fold(0.0, |sum, unshot| sum + unshot) / lit
    }

    /// The radiosities of each light, with the ambient term.
    pub fn lights(&self) -> Vec<Vec<[f32; 3]>> {
        (0..self.radiosity.len())
            .map(|light| self.with_ambient(light))
            .collect()
    }

    fn with_ambient(&self, light: usize) -> Vec<[f32; 3]> {
        let total: f64 = self.areas.iter().sum();
        let mean = |values: &[Rgb], c: usize| {
            values
                .iter()
                .zip(self.areas)
                .map(|(v, area)| area * v[c])
                .sum::<f64>()
                / total
        };
        // What was shot tells how much of the light arrives: all of it in a closed room.
        let seen = if self.shot > 0.0 {
            (self.arrived / self.shot).min(1.0)
        } else {
            1.0
        };
        let ambient = |c: usize| {
            let reflected = (seen * mean(self.reflectance, c)).min(0.99);
            seen * mean(&self.unshot[light], c) / (1.0 - reflected)
        };
        let ambient = [ambient(0), ambient(1), ambient(2)];
        let shown = |(b, rho): (&Rgb, &Rgb)| -> [f32; 3] {
            std::array::from_fn(|c| (b[c] + rho[c] * ambient[c]) as f32)
        };
        self.radiosity[light]
            .iter()
            .zip(self.reflectance)
            .map(shown)
            .collect()
    }

    /// The power that a cluster has to shoot, in shares of what each light emits in each channel.
    fn unshot_of(&self, cluster: usize) -> f64 {
        let lights = self.unshot.iter().zip(&self.emitted);
        let of_light = |(unshot, emitted): (&Vec<Rgb>, &Rgb)| -> f64 {
            let patches = self.clusters[cluster].iter();
            let of_patch = |&i: &usize| -> f64 {
                let shares = unshot[i].iter().zip(emitted);
                self.areas[i]
                    * shares
                        .map(|(unshot, emitted)| unshot / emitted)
                        .sum::<f64>()
            };
            patches.map(of_patch).sum()
        };
        lights.map(of_light).sum()
    }
}

/// How many channels of lights emit.
fn lit(lights: &[Vec<Rgb>]) -> usize {
    let shines = |light: &Vec<Rgb>, c: usize| light.iter().any(|emission| emission[c] > 0.0);
    let channels = lights
        .iter()
        .map(|light| (0..3).filter(|&c| shines(light, c)).count());
    channels.sum()
}
