//! `render` and `display`.

use super::args::DisplayCommand;
use super::live::Live;
use super::look::Look;
use super::print::{Palette, Print};
use super::run::{light, make_folder, store, with_threads};
use super::save::Folder;
use super::site::Site;
use super::terminal::Terminal;
use super::view_args::Shot;
use crate::artifact::Sources;
use crate::error::Error;
use crate::pipeline::{PatchLight, Pipeline, Quantity};
use crate::report::{DisplayReport, Report};
use radiosity_renderer::{Image, Outlines, Picture, Shading, contact_sheet};
use radiosity_scene::Scene;
use std::time::Instant;

pub(super) fn run(args: &DisplayCommand, site: &Site) -> Result<(), Error> {
    let mut scene = site.load(&args.scene.scene)?;
    args.scene.apply(&mut scene);
    args.estimate.apply(&mut scene);
    args.solve.apply(&mut scene);
    args.lights.apply(&mut scene)?;
    args.display.apply(&mut scene);
    let folder = args.display.output.as_ref().unwrap_or(&site.output);
    let terminal = Terminal::new(args.estimate.json);
    with_threads(args.estimate.threads, || {
        let store = store(&args.estimate, site);
        let mut pipeline = Pipeline::new(&scene, store.as_ref(), &terminal)?;
        let shots = args.display.views.shots(&scene, pipeline.mesh())?;
        let looks = args.display.show.looks(&scene, pipeline.mesh())?;
        check_preview(args, &looks)?;
        make_folder(folder)?;
        let mut report = Report::new(&scene, pipeline.mesh(), &terminal);
        let light = light(&mut pipeline, &args.solve, Sources::Cached, &mut report)?;
        let start = Instant::now();
        let is_preview = args.solve.preview.is_some();
        let mut series = Series {
            args,
            scene: &scene,
            pipeline: &pipeline,
            live: Live::new(!args.estimate.json && !args.display.no_live),
            folder: Folder::new(folder, &args.display.format, &pipeline, is_preview),
            sheet: Vec::new(),
        };
        for look in &looks {
            series.add(look, &light, &shots)?;
        }
        if args.display.views.sheet {
            series.folder.save_sheet(&contact_sheet(&series.sheet))?;
        }
        report.display(DisplayReport {
            seconds: start.elapsed().as_secs_f64(),
        });
        report.outputs(series.folder.written);
        report.finish()
    })
}

/// Refuses what a preview does not know.
fn check_preview(args: &DisplayCommand, looks: &[Look]) -> Result<(), Error> {
    let is_simple = |shading: &Shading| matches!(shading, Shading::Constant | Shading::Smooth);
    let is_exact = !args.display.shadings().iter().all(is_simple);
    let is_known = |look: &Look| look.quantity == Quantity::Radiosity;
    if args.solve.preview.is_none() || !is_exact && looks.iter().all(is_known) {
        return Ok(());
    }
    Err(Error::Input(
        "a preview knows nothing but radiosities, and not direct light apart\n   \
         = help: leave out --preview, or --direct exact, --gather and --show"
            .to_owned(),
    ))
}

/// All pictures of a run.
struct Series<'a> {
    args: &'a DisplayCommand,
    scene: &'a Scene,
    pipeline: &'a Pipeline<'a>,
    live: Live,
    folder: Folder<'a>,
    /// What goes on the sheet, if one is wanted.
    sheet: Vec<(String, Picture)>,
}

impl Series<'_> {
    /// Takes and saves the pictures of a look, from everywhere.
    fn add(&mut self, look: &Look, light: &PatchLight, shots: &[Shot]) -> Result<(), Error> {
        let display = &self.args.display;
        let shadings = look.shadings(&display.shadings());
        let shown = self.pipeline.shown(light, look.quantity)?;
        let renderer = self.pipeline.renderer(&shown, &shadings);
        let is_film = display.views.is_film();
        let size = (self.scene.image.width, self.scene.image.height);
        let backs = self.scene.image.backs;
        let mut fixed: Option<Palette> = None;
        for shot in shots {
            if let Some(small) = self.live.size(size) {
                let glance = self.pipeline.glance(&renderer, &shot.camera, small);
                let image = glance.last().expect("there is a shading");
                let palette = self.palette(look, image, fixed.as_ref());
                self.live.show(&palette.paint(image));
            }
            let images = self.pipeline.look(&renderer, &shot.camera)?;
            let has_lines = display.show.isolines || display.show.patch_lines;
            let outlines =
                has_lines.then(|| Outlines::new(self.pipeline.mesh(), (&shot.camera, backs), size));
            for (image, shading) in images.iter().zip(&shadings) {
                let palette = self.palette(look, image, fixed.as_ref());
                let print = Print {
                    palette: &palette,
                    image,
                    outlines: outlines.as_ref(),
                    // Between patches of one number there is nothing to tell.
                    isolines: display.show.isolines && *shading != Shading::Constant,
                    patch_lines: display.show.patch_lines,
                };
                let parts = [shot.name.as_deref(), look.name, Some(name_of(*shading))];
                let name = parts.into_iter().flatten().collect::<Vec<_>>().join("-");
                self.folder.save(&name, &print)?;
                if display.views.sheet {
                    self.sheet.push((name, print.screen().thumbnail()));
                }
                // Numbers have the same colours in all pictures, and films do not flicker.
                if is_film || matches!(palette, Palette::Colors(..)) {
                    fixed = Some(palette);
                }
            }
        }
        Ok(())
    }

    fn palette(&self, look: &Look, image: &Image, fixed: Option<&Palette>) -> Palette {
        let views = &self.args.display.views;
        fixed.cloned().unwrap_or_else(|| {
            look.palette(image, &self.args.display.show, self.scene, views.is_film())
        })
    }
}

/// How the pictures by a shading are called.
fn name_of(shading: Shading) -> &'static str {
    match shading {
        Shading::Constant => "constant",
        Shading::Smooth => "smooth",
        Shading::Exact => "exact",
        Shading::Gathered => "gathered",
    }
}
