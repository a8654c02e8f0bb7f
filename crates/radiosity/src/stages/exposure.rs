//! How bright pictures are shown.

use super::light::PatchLight;
use super::patches::Patches;
use super::pictures::Shown;
use radiosity_geometry::Camera;
use radiosity_image::{Exposure, Image};
use radiosity_params::NumberOrWord;
use radiosity_renderer::{ImageParams, Shading};

/// Pixels across the pictures by which the light is measured.
const WIDTH: u32 = 128;
/// So many cameras measure it, evenly spread over a film.
const MOST_CAMERAS: usize = 64;

/// The parameters of pictures that screens show from some cameras: they have one exposure. If that
/// is automatic, 98 % of what is seen and not black is less bright than 0.8, by luminance.
/// Patches that emit do not count, unless nothing else is lit.
///
/// Without this function an automatic exposure suits each image by itself, emitters included, and
/// samples are not clamped.
pub fn expose(
    patches: &Patches<'_>,
    light: &PatchLight,
    cameras: &[Camera],
    params: &ImageParams,
) -> ImageParams {
    let measured = || {
        let step = cameras.len().div_ceil(MOST_CAMERAS).max(1);
        let cameras: Vec<&Camera> = cameras.iter().step_by(step).collect();
        let reflected = Shown::reflected(patches, light);
        let all = || {
            Exposure::of(&seen(
                &Shown::light(patches, light),
                patches,
                &cameras,
                params,
            ))
        };
        Exposure::of(&seen(&reflected, patches, &cameras, params)).or_else(all)
    };
    // Where all is black, any factor will do.
    let exposure = params.exposure.number().or_else(measured).unwrap_or(1.0);
    params.for_screens(exposure)
}

/// Small images of what cameras see.
fn seen(
    shown: &Shown,
    patches: &Patches<'_>,
    cameras: &[&Camera],
    params: &ImageParams,
) -> Vec<Image> {
    let height = u64::from(WIDTH) * u64::from(params.height) / u64::from(params.width);
    let small = ImageParams {
        width: WIDTH,
        height: (height as u32).clamp(1, WIDTH),
        subpixels: 1,
        adaptive: 1,
        ..params.linear()
    };
    let renderer = shown.renderer(&patches.mesh, &small, &[Shading::Constant]);
    let images = cameras.iter().map(|camera| renderer.render(camera, &small));
    images.flatten().collect()
}
