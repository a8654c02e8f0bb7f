//! How bright pictures are shown.

use super::light::PatchLight;
use super::patches::Patches;
use super::pictures::DisplayField;
use radiosity_geometry::Camera;
use radiosity_image::{Exposure, Image};
use radiosity_params::NumberOrWord;
use radiosity_renderer::{ImageParams, Shading};

/// Pixels across the pictures by which the light is measured.
const WIDTH: u32 = 128;
/// So many cameras measure it, evenly spread over a film.
const MOST_CAMERAS: usize = 64;

/// The parameters of pictures that screens show from some cameras, by some shadings: they have one
/// exposure. If that is automatic, 98 % of what is seen and not black is less bright than 0.8, by
/// luminance: patch by patch, or with exact direct light where a shading has it.
/// Patches that emit do not count, unless nothing else is lit.
///
/// Without this function an automatic exposure suits each image by itself, emitters included, and
/// samples are not clamped.
pub fn expose(
    patches: &Patches<'_>,
    light: &PatchLight,
    cameras: &[Camera],
    params: &ImageParams,
    shadings: &[Shading],
) -> ImageParams {
    let has_exact = shadings.iter().any(|&shading| shading >= Shading::Exact);
    let shading = if has_exact {
        Shading::Exact
    } else {
        Shading::Constant
    };
    let measured = || {
        let step = cameras.len().div_ceil(MOST_CAMERAS).max(1);
        let cameras: Vec<&Camera> = cameras.iter().step_by(step).collect();
        let of =
            |shown: &DisplayField| Exposure::of(&seen(shown, patches, &cameras, params, shading));
        let reflected = of(&DisplayField::reflected(patches, light));
        reflected.or_else(|| of(&DisplayField::light(patches, light)))
    };
    // Where all is black, any factor will do.
    let exposure = params.exposure.number().or_else(measured).unwrap_or(1.0);
    params.for_screens(exposure)
}

/// Small images of what cameras see.
fn seen(
    shown: &DisplayField,
    patches: &Patches<'_>,
    cameras: &[&Camera],
    params: &ImageParams,
    shading: Shading,
) -> Vec<Image> {
    let height = u64::from(WIDTH) * u64::from(params.height) / u64::from(params.width);
    let small = ImageParams {
        width: WIDTH,
        height: (height as u32).clamp(1, WIDTH),
        subpixels: 1,
        adaptive: 1,
        ..params.linear()
    };
    let renderer = shown.renderer(&patches.mesh, &small, &[shading]);
    let images = cameras.iter().map(|camera| renderer.render(camera, &small));
    images.flatten().collect()
}
