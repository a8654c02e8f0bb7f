//! Flags override what the scene says.

use super::args::{EstimateArgs, SceneArgs};
use super::choices::ModeArg;
use super::terminal::tell;
use radiosity::geometry::Divisions;
use radiosity::scene::{Mode, Scene};

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

/// A flag's value, if it is given.
pub(super) fn set<T>(setting: &mut T, flag: Option<T>) {
    if let Some(value) = flag {
        *setting = value;
    }
}
