//! What a picture shows: a quantity, and what its numbers mean.

use super::choices::ShowArg;
use super::display_image::Palette;
use super::parse::PatchName;
use super::show_args::ShowArgs;
use crate::error::Error;
use radiosity::Params;
use radiosity::form_factors::Mode;
use radiosity::geometry::Mesh;
use radiosity::image::{ColorScale, Image, LUMINANCE, Values};
use radiosity::patch_at;
use radiosity::renderer::{ImageParams, Shading};
use radiosity::scene::Scene;
use radiosity::stages::Quantity;
use std::f64::consts::PI;

/// A quantity to show.
pub(super) struct DisplayQuantity {
    pub(super) quantity: Quantity,
    /// Part of the names of its pictures; all light has none.
    pub(super) name: Option<&'static str>,
    /// What is shown in false colours; the others are shown as an eye sees them.
    number: Option<Number>,
}

/// A number made of the three channels.
#[derive(Clone)]
pub(super) struct Number {
    pub(super) title: &'static str,
    pub(super) unit: String,
    weights: [f64; 3],
    /// Whether the channels mean something by themselves.
    has_colors: bool,
}

const GREY: [f64; 3] = [1.0 / 3.0; 3];

impl ShowArgs {
    /// All that is asked for, each once.
    pub(super) fn looks(
        &self,
        scene: &Scene,
        params: &Params,
        mesh: &Mesh,
    ) -> Result<Vec<DisplayQuantity>, Error> {
        let mut shows = self.show.clone();
        if shows.is_empty() && self.factors_of.is_none() {
            shows.push(ShowArg::Light);
        }
        if shows.contains(&ShowArg::Error) && params.form_factors.mode != Mode::Accurate {
            return Err(Error::with_help(
                "this scene's estimator does not know the errors of form factors",
                "use --mode accurate",
            ));
        }
        let is_new = |k: &usize| !shows[..*k].contains(&shows[*k]);
        let new = (0..shows.len()).filter(is_new);
        let mut looks: Vec<DisplayQuantity> = new
            .map(|k| DisplayQuantity::of(shows[k], &params.image))
            .collect();
        if let Some(name) = &self.factors_of {
            looks.push(DisplayQuantity::of_factors(name, scene, mesh)?);
        }
        Ok(looks)
    }
}

impl DisplayQuantity {
    fn of(show: ShowArg, params: &ImageParams) -> DisplayQuantity {
        let light = |quantity, name| DisplayQuantity {
            quantity,
            name,
            number: None,
        };
        let watts = |weights, has_colors| ("W/m²".to_owned(), weights, has_colors);
        let lux = LUMINANCE.map(|weight| params.lumens_per_watt * weight);
        let ratio = "sum of a row";
        match show {
            ShowArg::Light => light(Quantity::Radiosity, None),
            ShowArg::Direct => light(Quantity::Direct, Some("direct")),
            ShowArg::Indirect => light(Quantity::Indirect, Some("indirect")),
            ShowArg::Radiosity => {
                DisplayQuantity::of_number(Quantity::Radiosity, "radiosity", watts(GREY, true))
            }
            ShowArg::Irradiance => {
                DisplayQuantity::of_number(Quantity::Irradiance, "irradiance", watts(GREY, true))
            }
            ShowArg::Illuminance => {
                let unit = ("lx".to_owned(), lux, false);
                DisplayQuantity::of_number(Quantity::Irradiance, "illuminance", unit)
            }
            ShowArg::Error => DisplayQuantity::of_number(
                Quantity::Error,
                "error",
                (ratio.to_owned(), GREY, false),
            ),
        }
    }

    fn of_factors(name: &PatchName, scene: &Scene, mesh: &Mesh) -> Result<DisplayQuantity, Error> {
        let PatchName { surface, cell } = name;
        let [a, b] = cell;
        let patch = patch_at(scene, mesh, surface, *cell).ok_or_else(|| {
            Error::with_help(
                format!("there is no patch {a},{b} on a surface `{surface}`"),
                "`solve --export FILE.csv` lists all patches as surface,ia,ib",
            )
        })?;
        let unit = (format!("of {surface} {a},{b}"), GREY, false);
        let quantity = Quantity::FactorsFrom(patch);
        Ok(DisplayQuantity::of_number(quantity, "form-factors", unit))
    }

    fn of_number(
        quantity: Quantity,
        title: &'static str,
        (unit, weights, has_colors): (String, [f64; 3], bool),
    ) -> DisplayQuantity {
        DisplayQuantity {
            quantity,
            name: Some(title),
            number: Some(Number {
                title,
                unit,
                weights,
                has_colors,
            }),
        }
    }

    /// Whether it is shown in false colours.
    pub(super) fn is_number(&self) -> bool {
        self.number.is_some()
    }

    /// The shadings that make sense of it, of those that are asked for.
    pub(super) fn shadings(&self, wanted: &[Shading]) -> Vec<Shading> {
        match self.quantity {
            Quantity::Error | Quantity::FactorsFrom(_) => vec![Shading::Constant],
            _ => wanted.to_vec(),
        }
    }

    /// The palette for an image.
    pub(super) fn palette(&self, image: &Image, args: &ShowArgs, params: &ImageParams) -> Palette {
        let Some(number) = &self.number else {
            return Palette::Tones(params.tone_map());
        };
        let top = args
            .top
            .unwrap_or_else(|| ColorScale::top_for(&number.of(image)));
        let scale = if args.log {
            ColorScale::logarithmic(top)
        } else {
            ColorScale::linear(top)
        };
        Palette::Colors(scale, number.clone())
    }
}

impl Number {
    /// The numbers of an image of the quantity over pi.
    pub(super) fn of(&self, image: &Image) -> Values {
        image.weighted(self.weights.map(|weight| PI * weight))
    }

    /// The same for files of numbers, by channel if channels mean something.
    pub(super) fn linear(&self, image: &Image) -> Image {
        if self.has_colors {
            image.scaled(PI)
        } else {
            self.of(image).into_image()
        }
    }
}
