//! All pictures of a run: every look, from everywhere, by every shading.

use super::display_image::{DisplayImage, Palette};
use super::display_quantity::DisplayQuantity;
use super::image_args::DisplayArgs;
use super::save::Folder;
use super::thumbnail::Thumbnail;
use super::view_args::ViewFrame;
use crate::error::Error;
use radiosity::darkness;
use radiosity::image::{Image, Rgb8Image, Transfer, contact_sheet, thumbnail_width};
use radiosity::renderer::{ImageParams, Outlines, Renderer, Shading};
use radiosity::stages::{Factors, PatchLight, Quantity, render_by, show};
use std::cell::OnceCell;
use std::collections::BTreeSet;

/// What is to be made, and what has been.
pub(super) struct Series<'a> {
    pub(super) args: &'a DisplayArgs,
    /// Of pictures for screens.
    pub(super) params: &'a ImageParams,
    pub(super) factors: &'a Factors<'a>,
    pub(super) looks: &'a [DisplayQuantity],
    pub(super) shots: &'a [ViewFrame],
    pub(super) live: Thumbnail,
    pub(super) folder: Folder<'a>,
    pub(super) sheet: Sheet,
}

/// What goes on the sheet.
#[derive(Default)]
pub(super) struct Sheet {
    pictures: Vec<(String, Rgb8Image)>,
    /// Of the first picture; the others are shown by it.
    transfer: Option<Transfer>,
}

impl Series<'_> {
    /// Takes and saves all pictures.
    pub(super) fn take(&mut self, light: &PatchLight) -> Result<(), Error> {
        for look in self.looks {
            let shadings = look.shadings(&self.args.shadings());
            let patches = self.factors.patches();
            let shown = show(self.factors, light, look.quantity)?;
            let renderer = shown.renderer(&patches.mesh, self.params, &shadings);
            let params = self.params_of(look);
            let mut fixed = None;
            for shot in self.shots {
                self.glance(look, &renderer, shot, fixed.as_ref());
                let render = |params: &ImageParams| {
                    render_by(&renderer, &shot.camera, params, patches.context())
                };
                let images = render(&params)?;
                let is_clamped = params.brightest.is_finite();
                let linear = (is_clamped && self.folder.wants_linear())
                    .then(|| render(&params.linear()))
                    .transpose()?;
                let linear = linear.as_ref().unwrap_or(&images);
                // That there is no light has been said.
                let is_black =
                    light.energy.emitted != [0.0; 3] && !images.iter().any(Image::shows_something);
                if is_black && look.quantity == Quantity::Radiosity {
                    self.say_why_black(shot);
                }
                let outlines = self.outlines(look, shot);
                for ((image, linear), &shading) in images.iter().zip(linear).zip(&shadings) {
                    let palette = self.palette(look, image, fixed.as_ref());
                    let print = DisplayImage {
                        palette: &palette,
                        image,
                        linear,
                        outlines: outlines.as_ref(),
                        // Between patches of one number there is nothing to tell.
                        isolines: self.args.show.isolines && shading != Shading::Constant,
                        patch_lines: self.args.show.patch_lines,
                        shown: OnceCell::new(),
                    };
                    self.keep(name_of(look, shot, shading), &print)?;
                    // Numbers have the same colours in all pictures; but what shows nothing tells
                    // nothing of the others.
                    if fixed.is_none() && image.shows_something() {
                        fixed = Some(palette);
                    }
                }
            }
        }
        if let Some(transfer) = self.sheet.transfer {
            let sheet = contact_sheet(&self.sheet.pictures);
            self.folder.save_sheet(&sheet, transfer)?;
        }
        Ok(())
    }

    fn say_why_black(&self, shot: &ViewFrame) {
        let of_view = shot.name.as_ref();
        let of_view = of_view.map_or(String::new(), |name| format!(" of view `{name}`"));
        let patches = self.factors.patches();
        let why = darkness::of_picture(patches, &shot.camera, self.params);
        let warning = format!("warning: the picture{of_view} is black: {why}");
        patches.context().observer.note(&warning);
    }

    /// Shows a small picture in the terminal.
    fn glance(
        &mut self,
        look: &DisplayQuantity,
        renderer: &Renderer<'_>,
        shot: &ViewFrame,
        fixed: Option<&Palette>,
    ) {
        if let Some(small) = self.live.size(self.size()) {
            let (width, height) = small;
            let few_samples = ImageParams {
                width,
                height,
                subpixels: 1,
                samples: 4,
                adaptive: 1,
                ..self.params_of(look)
            };
            let images = renderer.render(&shot.camera, &few_samples);
            let image = images.last().expect("there is a shading");
            let palette = self.palette(look, image, fixed);
            self.live.show(&palette.paint(image));
        }
    }

    fn keep(&mut self, name: String, print: &DisplayImage<'_>) -> Result<(), Error> {
        self.folder.save(&name, print)?;
        if self.args.views.sheet {
            let thumbnail = print.screen().thumbnail(self.thumbnail_width());
            self.sheet.transfer.get_or_insert(print.palette.transfer());
            self.sheet.pictures.push((name, thumbnail));
        }
        Ok(())
    }

    /// So that the pictures of the whole run fit on a sheet.
    fn thumbnail_width(&self) -> u32 {
        let wanted = self.args.shadings();
        let looks = self.looks.iter();
        let of_shot: usize = looks.map(|look| look.shadings(&wanted).len()).sum();
        thumbnail_width(of_shot * self.shots.len())
    }

    fn outlines(&self, look: &DisplayQuantity, shot: &ViewFrame) -> Option<Outlines> {
        let show = &self.args.show;
        let has_lines = show.patch_lines || show.isolines && look.is_number();
        let seen = (&shot.camera, self.params.backs);
        has_lines.then(|| Outlines::new(&self.factors.patches().mesh, seen, self.size()))
    }

    /// Numbers are never clamped, nor are pictures of which no screen shows any.
    fn params_of(&self, look: &DisplayQuantity) -> ImageParams {
        let is_for_screens = self.folder.wants_levels() || self.args.views.sheet;
        match is_for_screens && !look.is_number() {
            true => *self.params,
            false => self.params.linear(),
        }
    }

    fn palette(&self, look: &DisplayQuantity, image: &Image, fixed: Option<&Palette>) -> Palette {
        fixed
            .cloned()
            .unwrap_or_else(|| look.palette(image, &self.args.show, self.params))
    }

    fn size(&self) -> (u32, u32) {
        (self.params.width, self.params.height)
    }
}

/// Refuses pictures that would have one name.
pub(super) fn check_names(
    args: &DisplayArgs,
    looks: &[DisplayQuantity],
    shots: &[ViewFrame],
) -> Result<(), Error> {
    let mut names = BTreeSet::new();
    for look in looks {
        for shading in look.shadings(&args.shadings()) {
            for shot in shots {
                let name = name_of(look, shot, shading);
                if !names.insert(name.clone()) {
                    return Err(Error::with_help(
                        format!("two pictures would be called `{name}`"),
                        "rename the view that is called as something that is shown",
                    ));
                }
            }
        }
    }
    Ok(())
}

/// View, what is shown, and shading, as far as they are not the usual ones.
fn name_of(look: &DisplayQuantity, shot: &ViewFrame, shading: Shading) -> String {
    let shading = match shading {
        Shading::Constant => "constant",
        Shading::Smooth => "smooth",
        Shading::Exact => "exact",
        Shading::Gathered => "gathered",
    };
    let parts = [shot.name.as_deref(), look.name, Some(shading)];
    parts.into_iter().flatten().collect::<Vec<_>>().join("-")
}
