//! Stage 4 of the chain: what is shown, and pictures of it.

use super::visible::exchanging;
use super::{PatchLight, Pipeline};
use crate::error::Error;
use crate::observer::Stage;
use crate::resources::check_image;
use crate::settings;
use radiosity_form_factors::FormFactors;
use radiosity_geometry::Camera;
use radiosity_image::Image;
use radiosity_renderer::{Fields, ImageParams, Renderer, Shading, ShadingParams};

/// What of the light is shown, or of what it was made from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// All that leaves patches, W/m^2.
    Radiosity,
    /// The part of it that is emitted, or reflected once.
    Direct,
    /// The part that is reflected more often.
    Indirect,
    /// All that arrives at patches, W/m^2.
    Irradiance,
    /// The estimated sum of the absolute errors of a patch's form factors.
    Error,
    /// The form factors from one patch, by its index, to all others.
    FactorsFrom(usize),
}

impl Quantity {
    /// Whether form factors must be known to show it.
    pub fn needs_factors(self) -> bool {
        match self {
            Quantity::Radiosity | Quantity::Direct | Quantity::Indirect => false,
            Quantity::Irradiance | Quantity::Error | Quantity::FactorsFrom(_) => true,
        }
    }
}

/// A quantity on all patches, and the light that makes it; see [`Fields`].
#[derive(Clone, Debug)]
pub struct Shown {
    sources: Vec<[f32; 3]>,
    reflectance: Vec<[f32; 3]>,
    indirect: Vec<[f32; 3]>,
    visible: Vec<f32>,
    value: Vec<[f32; 3]>,
    emission: Vec<[f32; 3]>,
    direct: Vec<[f32; 3]>,
    direct_gain: Vec<[f32; 3]>,
    gathered_gain: Vec<[f32; 3]>,
}

impl Pipeline<'_> {
    /// Pictures of what patches shine with as the scene's first camera sees it, by each of some
    /// shadings, in that order.
    pub fn pictures(&self, light: &PatchLight, shadings: &[Shading]) -> Result<Vec<Image>, Error> {
        let camera = self
            .scene
            .first_camera()
            .ok_or_else(|| Error::no_camera(self.scene))?;
        let shown = self.shown(light, Quantity::Radiosity)?;
        self.look(&self.renderer(&shown, shadings), &camera)
    }

    /// A quantity on all patches. What goes back to form factors takes those that were kept, or
    /// from the cache where possible.
    pub fn shown(&self, light: &PatchLight, quantity: Quantity) -> Result<Shown, Error> {
        let all = self.all_light(light);
        let patches = all.value.len();
        let nothing = || vec![[0.0; 3]; patches];
        Ok(match quantity {
            Quantity::Radiosity => all,
            Quantity::Direct => Shown {
                value: difference(&all.value, &all.indirect),
                gathered_gain: nothing(),
                ..all
            },
            Quantity::Indirect => Shown {
                value: all.indirect.clone(),
                emission: nothing(),
                direct: nothing(),
                direct_gain: nothing(),
                ..all
            },
            Quantity::Irradiance => {
                let factors = self.known_form_factors()?;
                Shown {
                    value: irradiance(&factors, &self.of_elements(light), &all.visible),
                    direct: irradiance(&factors, &all.sources, &all.visible),
                    emission: nothing(),
                    direct_gain: vec![[1.0; 3]; patches],
                    gathered_gain: vec![[1.0; 3]; patches],
                    ..all
                }
            }
            Quantity::Error => {
                let factors = self.known_form_factors()?;
                let errors = factors.rows.iter().map(|row| row.error);
                let errors: Option<Vec<f64>> = errors.collect();
                table(errors.ok_or(Error::NoErrors)?)
            }
            Quantity::FactorsFrom(patch) => table(self.known_form_factors()?.row(patch)),
        })
    }

    /// What leaves patches.
    fn all_light(&self, light: &PatchLight) -> Shown {
        let emission = self.dimmed_emission();
        let to_f32 = |rgb: &[f64; 3]| rgb.map(|channel| channel as f32);
        let reflectance: Vec<[f32; 3]> = self.reflectance.iter().map(to_f32).collect();
        let reflected = difference(&light.radiosity, &emission);
        Shown {
            sources: emission.clone(),
            indirect: difference(&reflected, &light.direct),
            visible: light.visible.clone(),
            value: light.radiosity.clone(),
            emission,
            direct: light.direct.clone(),
            direct_gain: reflectance.clone(),
            gathered_gain: reflectance.clone(),
            reflectance,
        }
    }

    /// Makes a quantity ready to be looked at from anywhere, by each of some shadings.
    pub fn renderer<'s>(&'s self, shown: &'s Shown, shadings: &[Shading]) -> Renderer<'s> {
        let params = ShadingParams {
            crease_angle: self.scene.image.crease_angle,
            directions: self.scene.image.directions,
        };
        Renderer::new(&self.mesh, &shown.fields(), &params, shadings)
    }

    /// What a camera sees, in few pixels and by few samples.
    pub fn glance(
        &self,
        renderer: &Renderer<'_>,
        camera: &Camera,
        (width, height): (u32, u32),
    ) -> Vec<Image> {
        let params = ImageParams {
            width,
            height,
            subpixels: 1,
            samples: 4,
            adaptive: 1,
            ..settings::image_params(self.scene)
        };
        renderer.render(camera, &params, &|_| ())
    }

    /// What a camera sees: the quantity over pi, by each of the renderer's shadings.
    pub fn look(&self, renderer: &Renderer<'_>, camera: &Camera) -> Result<Vec<Image>, Error> {
        let params = settings::image_params(self.scene);
        // Wide filters take the mean of sub-pixels, which are pixels first.
        let parts = if params.filter.is_wide() {
            params.subpixels
        } else {
            1
        };
        let rows = params.height * parts;
        check_image(params.width * parts, rows)?;
        self.observer.begin(Stage::Display, u64::from(rows));
        let advance = |rows| self.observer.advance(rows);
        let pictures = renderer.render(camera, &params, &advance);
        self.observer.end();
        Ok(pictures)
    }
}

impl Shown {
    fn fields(&self) -> Fields<'_> {
        Fields {
            sources: &self.sources,
            reflectance: &self.reflectance,
            indirect: &self.indirect,
            visible: &self.visible,
            shown: &self.value,
            emission: &self.emission,
            direct: &self.direct,
            direct_gain: &self.direct_gain,
            gathered_gain: &self.gathered_gain,
        }
    }
}

/// Numbers that are no light.
fn table(values: Vec<f64>) -> Shown {
    let nothing = vec![[0.0; 3]; values.len()];
    Shown {
        sources: nothing.clone(),
        reflectance: nothing.clone(),
        indirect: nothing.clone(),
        visible: vec![1.0; values.len()],
        value: values.into_iter().map(|value| [value as f32; 3]).collect(),
        emission: nothing.clone(),
        direct: nothing.clone(),
        direct_gain: nothing.clone(),
        gathered_gain: nothing,
    }
}

fn difference(a: &[[f32; 3]], b: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let pairs = a.iter().zip(b);
    let minus = |(a, b): (&[f32; 3], &[f32; 3])| std::array::from_fn(|c| a[c] - b[c]);
    pairs.map(minus).collect()
}

/// `H_i = sum_j F_ij B_j`, on what is visible of patches.
fn irradiance(factors: &FormFactors, exitance: &[[f32; 3]], visible: &[f32]) -> Vec<[f32; 3]> {
    let total: f64 = factors.areas.iter().sum();
    let area = |(area, &share): (&f64, &f32)| area * f64::from(exchanging(share));
    let areas: Vec<f64> = factors.areas.iter().zip(visible).map(area).collect();
    let mut result = vec![[0.0; 3]; exitance.len()];
    for c in 0..3 {
        let channel: Vec<f64> = exitance.iter().map(|of| f64::from(of[c])).collect();
        let sums = factors.exchange.product(&channel);
        for ((result, sum), area) in result.iter_mut().zip(sums).zip(&areas) {
            // A covered patch has no area.
            result[c] = if *area > 0.0 {
                (sum * total / area) as f32
            } else {
                0.0
            };
        }
    }
    result
}
