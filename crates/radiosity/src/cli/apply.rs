//! Flags override what the scene says.

use super::args::{DisplayArgs, EstimateArgs, ImageArgs, SceneArgs};
use super::choices::{DirectArg, FilterArg, ModeArg, ToneArg};
use super::terminal::tell;
use radiosity_geometry::{Divisions, PixelFilter};
use radiosity_renderer::Shading;
use radiosity_scene::{Mode, Scene, Tone};

impl SceneArgs {
    pub(crate) fn apply(&self, scene: &mut Scene) {
        if let Some((a, b)) = self.patches {
            scene.divisions = Divisions::Count { a, b };
        }
        if let Some(length) = self.max_patch_edge {
            scene.divisions = Divisions::MaxEdge(length);
        }
    }
}

impl EstimateArgs {
    pub(crate) fn apply(&self, scene: &mut Scene) {
        let settings = &mut scene.form_factors;
        let mode = self.mode.map(|mode| match mode {
            ModeArg::Regular => Mode::Regular,
            ModeArg::MonteCarlo => Mode::MonteCarlo,
            ModeArg::Accurate => Mode::Accurate,
        });
        set(&mut settings.mode, mode);
        set(&mut settings.points, self.points);
        set(&mut settings.seed, self.seed);
        set(&mut settings.tolerance, self.tolerance);
        settings.pairs = self.pairs.or(settings.pairs);
        settings.closure |= self.closure;
        if self.tolerance.is_some() && settings.mode != Mode::Accurate {
            tell("warning: --tolerance is for --mode accurate, and changes nothing");
        }
        if self.points.is_some() && settings.mode == Mode::Accurate {
            tell("warning: --points is not for --mode accurate, and changes nothing");
        }
        if settings.mode != Mode::MonteCarlo && (self.pairs.is_some() || self.seed.is_some()) {
            tell("warning: --pairs and --seed are for --mode monte-carlo, and change nothing");
        }
    }
}

impl ImageArgs {
    pub(crate) fn apply(&self, scene: &mut Scene) {
        let image = &mut scene.image;
        set(&mut image.width, self.size.map(|(width, _)| width));
        set(&mut image.height, self.size.map(|(_, height)| height));
        set(&mut image.subpixels, self.subpixels);
        let filter = self.filter.map(|filter| match filter {
            FilterArg::Tents => PixelFilter::Tents,
            FilterArg::Box => PixelFilter::Box,
            FilterArg::Tent => PixelFilter::Tent,
            FilterArg::Mitchell => PixelFilter::Mitchell,
        });
        set(&mut image.filter, filter);
        set(&mut image.exposure, self.exposure);
        let tone = self.tone.map(|tone| match tone {
            ToneArg::Clamp => Tone::Clamp,
            ToneArg::Reinhard => Tone::Reinhard,
            ToneArg::Filmic => Tone::Filmic,
        });
        set(&mut image.tone, tone);
        set(&mut image.gamma, self.gamma);
        image.dither |= self.dither;
    }
}

impl DisplayArgs {
    pub(crate) fn apply(&self, scene: &mut Scene) {
        self.image.apply(scene);
        set(&mut scene.image.samples, self.samples);
        set(&mut scene.image.adaptive, self.adaptive);
        set(&mut scene.image.crease_angle, self.crease_angle);
    }

    /// The pictures that are asked for.
    pub(crate) fn shadings(&self) -> &'static [Shading] {
        match self.direct {
            DirectArg::Patches => &[Shading::Constant, Shading::Smooth],
            DirectArg::Exact => &[Shading::Exact],
        }
    }
}

fn set<T>(setting: &mut T, flag: Option<T>) {
    if let Some(value) = flag {
        *setting = value;
    }
}
