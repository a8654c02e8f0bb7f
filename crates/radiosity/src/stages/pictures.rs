//! Stage 4: what is shown, and pictures of it.

use super::factors::Factors;
use super::irradiance::irradiance;
use super::light::PatchLight;
use super::patches::Patches;
use crate::context::Context;
use crate::error::Error;
use crate::observer::Stage;
use crate::resources::check_image;
use radiosity_cache::replace_file_by;
use radiosity_geometry::{Camera, Mesh};
use radiosity_image::{Image, PictureFormat, encode};
use radiosity_params::Parameters;
use radiosity_renderer::{Fields, ImageParams, Renderer, Shading};
use std::io;
use std::path::Path;

/// What a picture shows: a part of the light, or something about the form factors.
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
pub struct DisplayField {
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

/// Pictures of what patches shine with as a camera sees it: linear radiance in W/(m^2 sr), by each
/// of some shadings, in that order. With the parameters that [`expose`](super::expose) gives they
/// are clamped for screens.
///
/// # Panics
///
/// If a shading is asked for twice.
pub fn render(
    patches: &Patches<'_>,
    light: &PatchLight,
    camera: &Camera,
    params: &ImageParams,
    shadings: &[Shading],
) -> Result<Vec<Image>, Error> {
    params.check()?;
    let shown = DisplayField::light(patches, light);
    let renderer = shown.renderer(&patches.mesh, params, shadings);
    render_by(&renderer, camera, params, patches.context)
}

/// Writes a picture as PNG, with the exposure, tone and gamma of the parameters.
pub fn save_png(path: &Path, image: &Image, params: &ImageParams) -> io::Result<()> {
    let levels = params.tone_map().apply(image);
    let bytes = encode(&levels, PictureFormat::Png(params.gamma), &[]);
    replace_file_by(path, |file| file.write_all(&bytes))
}

/// A quantity on all patches. Irradiance, errors and factors make the form factors, if nobody holds
/// them ([`Factors::made`]).
pub fn show(
    factors: &Factors<'_>,
    light: &PatchLight,
    quantity: Quantity,
) -> Result<DisplayField, Error> {
    let all = DisplayField::light(factors.patches, light);
    let patches = all.value.len();
    let nothing = || vec![[0.0; 3]; patches];
    let made = match quantity.needs_factors() {
        true => Some(factors.made()?),
        false => None,
    };
    let made = || &made.as_ref().expect("the quantity needs them").form_factors;
    Ok(match quantity {
        Quantity::Radiosity => all,
        Quantity::Direct => DisplayField {
            value: difference(&all.value, &all.indirect),
            gathered_gain: nothing(),
            ..all
        },
        Quantity::Indirect => DisplayField {
            value: all.indirect.clone(),
            emission: nothing(),
            direct: nothing(),
            direct_gain: nothing(),
            ..all
        },
        Quantity::Irradiance => DisplayField {
            value: irradiance(made(), &light.radiosity),
            direct: irradiance(made(), &all.sources),
            emission: nothing(),
            direct_gain: vec![[1.0; 3]; patches],
            gathered_gain: vec![[1.0; 3]; patches],
            ..all
        },
        Quantity::Error => {
            let errors = made().rows.iter().map(|row| row.error);
            let errors: Option<Vec<f64>> = errors.collect();
            table(errors.ok_or(Error::NoErrors)?)
        }
        Quantity::FactorsFrom(patch) => table(made().row(patch)),
    })
}

/// What a camera sees of what a renderer shows.
pub fn render_by(
    renderer: &Renderer<'_>,
    camera: &Camera,
    params: &ImageParams,
    context: Context<'_>,
) -> Result<Vec<Image>, Error> {
    params.check()?;
    // Wide filters take the mean of sub-pixels, which are pixels first.
    let is_wide = params.filter.is_wide();
    let parts = if is_wide { params.subpixels } else { 1 };
    check_image(params.width * parts, params.height * parts)?;
    let mut rendering = renderer.begin(camera, params);
    let observer = context.observer;
    observer.begin(Stage::Display, u64::from(rendering.rows()));
    while let Some(rows) = rendering.advance() {
        observer.advance(u64::from(rows));
    }
    let pictures = rendering.finish();
    observer.end();
    Ok(pictures)
}

impl DisplayField {
    /// What leaves patches.
    pub(super) fn light(patches: &Patches<'_>, light: &PatchLight) -> DisplayField {
        let emission = light.emission.clone();
        let to_f32 = |rgb: &[f64; 3]| rgb.map(|channel| channel as f32);
        let reflectance: Vec<[f32; 3]> = patches.reflectance.iter().map(to_f32).collect();
        let reflected = difference(&light.radiosity, &emission);
        DisplayField {
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

    /// The same without patches that emit.
    pub(super) fn reflected(patches: &Patches<'_>, light: &PatchLight) -> DisplayField {
        let mut shown = DisplayField::light(patches, light);
        for (patch, emission) in light.emission.iter().enumerate() {
            if *emission != [0.0; 3] {
                let DisplayField {
                    value,
                    emission,
                    direct,
                    direct_gain,
                    ..
                } = &mut shown;
                for of_patches in [value, emission, direct, direct_gain] {
                    of_patches[patch] = [0.0; 3];
                }
            }
        }
        shown
    }

    /// Makes the quantity ready to be looked at from anywhere, by each of some shadings.
    pub fn renderer<'s>(
        &'s self,
        mesh: &'s Mesh,
        params: &ImageParams,
        shadings: &[Shading],
    ) -> Renderer<'s> {
        Renderer::new(mesh, &self.fields(), params, shadings)
    }

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
fn table(values: Vec<f64>) -> DisplayField {
    let nothing = vec![[0.0; 3]; values.len()];
    DisplayField {
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
