//! `compare` of pictures.

use super::{Compared, at};
use crate::compare_args::CompareCommand;
use crate::error::Error;
use crate::input::read;
use crate::run::write;
use crate::signals::remove_unfinished_on_signals;
use crate::terminal::tell;
use radiosity::Project;
use radiosity::compare::{compare_pictures, difference_picture};
use radiosity::image::{
    Curve, DecodeParams, Decoded, Image, PictureFormat, Transfer, decode_picture, decode_regions,
    encode, encode_pfm, picture_size,
};
use radiosity::params::{NumberOrWord, Parameters};
use radiosity::renderer::ImageParams;
use radiosity::resources::check_comparison;
use radiosity::words::grouped;
use std::path::Path;

/// The curve of pictures that say nothing of theirs.
const USUAL: Transfer = Transfer::Srgb;

/// A linear picture.
const BYTES_OF_IMAGE: u64 = 12;
/// Two of them and the differences of three channels with their weights. A picture of differences
/// is made after these.
const BYTES_PER_PIXEL: u64 = 2 * BYTES_OF_IMAGE + 3 * 8;
/// The number of its region, and the differences once more while those of regions are joined.
const BYTES_OF_REGIONS: u64 = 1 + 3 * 8;

/// The errors by region.
pub(super) fn pictures(
    args: &CompareCommand,
    project: Option<&Project>,
) -> Result<Compared, Error> {
    if args.divisions.is_some() || args.coarsen.is_some() {
        let problem = "--divisions and --coarsen are for tables, not for pictures";
        return Err(Error::input(problem));
    }
    let image = project.map(|project| &project.params.image);
    if let Some(gamma) = args.gamma {
        let flags = ImageParams {
            gamma,
            ..ImageParams::default()
        };
        flags.check().map_err(radiosity::Error::from)?;
    }
    let exposure = args
        .exposure
        .or(image.and_then(|image| image.exposure.number()));
    let params = DecodeParams {
        exposure: exposure.unwrap_or(1.0),
        transfer: args.gamma,
        default_transfer: image.map_or(USUAL, |image| image.gamma),
    };
    let all = match args.regions {
        Some(_) => BYTES_PER_PIXEL + BYTES_OF_REGIONS,
        None => BYTES_PER_PIXEL,
    };
    let found = picture(&args.found, &params, all)?;
    let reference = picture(&args.reference, &params, all - BYTES_OF_IMAGE)?;
    let is_lost =
        |image: &ImageParams| image.tone != Curve::Clamp || image.exposure.number().is_none();
    if (found.levels || reference.levels) && args.exposure.is_none() && image.is_some_and(is_lost) {
        let problem = "the scene's exposure is automatic, or its tone is a curve: levels do not \
            tell radiance";
        return Err(Error::with_help(
            problem,
            "state the --exposure that the run has printed, or compare .pfm files",
        ));
    }
    let map = args.regions.as_deref();
    let map = map.map(|path| decode_regions(&read(path)?).map_err(at(path)));
    let map = map.transpose()?;
    let errors = compare_pictures(&found.image, &reference, map.as_ref(), params.exposure);
    let named = errors.map_err(|error| Error::input(error.to_string()))?;
    if let Some(path) = &args.difference {
        let bytes = difference(path, &found, &reference);
        // Not earlier: the allocator gives each thread addresses of its own, which under
        // `ulimit -v` may be those that the pictures were promised.
        remove_unfinished_on_signals();
        write(path, None, &bytes)?;
    }
    let counted = named.last().map_or(0, |(_, all)| all.values / 3);
    let clamped = reference.image.pixels.len() - counted;
    let left_out = match clamped {
        0 => String::new(),
        _ => format!(
            "{} pixels that the reference shows clamped at exposure {}",
            grouped(clamped as u64),
            params.exposure
        ),
    };
    Ok(Compared { named, left_out })
}

/// A picture of a size whose comparison fits into memory.
fn picture(path: &Path, params: &DecodeParams, bytes_per_pixel: u64) -> Result<Decoded, Error> {
    let bytes = read(path)?;
    check_comparison(
        path,
        picture_size(&bytes).map_err(at(path))?,
        bytes_per_pixel,
    )?;
    decode_picture(&bytes, params).map_err(at(path))
}

/// The bytes of the picture of differences: linear and signed where the file is a float map.
fn difference(path: &Path, found: &Decoded, reference: &Decoded) -> Vec<u8> {
    let (found, reference) = (&found.image, &reference.image);
    if path.extension().is_some_and(|ending| ending == "pfm") {
        let pairs = found.pixels.iter().zip(&reference.pixels);
        let minus = |(f, r): (&[f32; 3], &[f32; 3])| std::array::from_fn(|c| f[c] - r[c]);
        return encode_pfm(&Image {
            width: found.width,
            height: found.height,
            pixels: pairs.map(minus).collect(),
        });
    }
    let shown = difference_picture(found, reference);
    if found.pixels == reference.pixels {
        tell("the pictures are equal");
    } else {
        tell(&format!(
            "red: brighter than the reference, blue: darker; full colour at a difference of \
             {:.3e} W/(m^2 sr)",
            shown.full_scale
        ));
    }
    encode(
        &shown.picture,
        PictureFormat::Png(Transfer::Gamma(2.2)),
        &[],
    )
}
