//! Pictures into files.

use super::choices::FormatArg;
use super::display_image::DisplayImage;
use super::run::write;
use crate::error::Error;
use radiosity::Params;
use radiosity::cache::Store;
#[cfg(feature = "openexr")]
use radiosity::image::encode_exr;
use radiosity::image::{
    PictureFormat, Rgb8Image, Transfer, encode, encode_hdr, encode_pfm, encode_png16,
};
use radiosity::inspect::EstimatorReport;
use radiosity::scene::Light;
use radiosity::stages::{Dimming, Solved};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Where pictures go, and what they say of themselves.
pub(super) struct Folder<'a> {
    path: &'a Path,
    cache: Option<&'a Store>,
    formats: Vec<FormatArg>,
    scene: String,
    metadata: Vec<(&'static str, String)>,
    /// The files that are written, by their names in reports.
    pub(super) written: BTreeMap<String, Written>,
}

/// A file that is written.
pub(crate) struct Written {
    pub(crate) path: PathBuf,
    /// Whether it has taken the place of another.
    pub(crate) replaced: bool,
}

impl<'a> Folder<'a> {
    pub(super) fn new(
        path: &'a Path,
        formats: &'a [FormatArg],
        solved: &Solved<'a>,
        params: &Params,
        dimming: &Dimming,
    ) -> Folder<'a> {
        let patches = solved.factors().patches();
        let scene = patches.scene();
        let estimator = params.form_factors.estimator();
        let version = concat!("radiosity ", env!("CARGO_PKG_VERSION"));
        let is_new = |k: &usize| !formats[..*k].contains(&formats[*k]);
        Folder {
            path,
            cache: patches.context().cache,
            formats: (0..formats.len())
                .filter(is_new)
                .map(|k| formats[k])
                .collect(),
            scene: scene.name.clone(),
            metadata: vec![
                ("Software", version.to_owned()),
                ("Scene", scene.name.clone()),
                ("Solution", solved.key.to_string()),
                ("Lights", dimmed_lights(dimming)),
                (
                    "Settings",
                    format!(
                        "{} patches; {}",
                        patches.mesh.patches.len(),
                        EstimatorReport::of(estimator).text()
                    ),
                ),
            ],
            written: BTreeMap::new(),
        }
    }

    /// Whether any format holds what screens show.
    pub(super) fn wants_levels(&self) -> bool {
        !self.formats.iter().all(|format| format.is_linear())
    }

    /// Whether any format holds numbers.
    pub(super) fn wants_linear(&self) -> bool {
        self.formats.iter().any(|format| format.is_linear())
    }

    /// Writes a picture in all formats. The first format's file is called as the picture, others
    /// have the format appended.
    pub(super) fn save(&mut self, name: &str, print: &DisplayImage<'_>) -> Result<(), Error> {
        for (index, &format) in self.formats.iter().enumerate() {
            let (label, ending) = format.label_and_ending();
            let path = self.path.join(format!("{}-{name}.{ending}", self.scene));
            let replaced = path.exists();
            write(&path, self.cache, &self.encoded(name, print, format))?;
            let name = if index == 0 {
                name.to_owned()
            } else {
                format!("{name}_{label}")
            };
            self.written.insert(name, Written { path, replaced });
        }
        Ok(())
    }

    /// Writes a picture of pictures, as PNG.
    pub(super) fn save_sheet(
        &mut self,
        sheet: &Rgb8Image,
        transfer: Transfer,
    ) -> Result<(), Error> {
        let path = self.path.join(format!("{}-sheet.png", self.scene));
        let bytes = encode(sheet, PictureFormat::Png(transfer), &self.metadata);
        let replaced = path.exists();
        write(&path, self.cache, &bytes)?;
        let written = Written { path, replaced };
        self.written.insert("sheet".to_owned(), written);
        Ok(())
    }

    fn encoded(&self, name: &str, print: &DisplayImage<'_>, format: FormatArg) -> Vec<u8> {
        let own = [("Picture", name.to_owned())];
        let metadata = [&self.metadata[..], &own, &print.palette.facts()].concat();
        let levels = |format| encode(print.screen(), format, &metadata);
        let transfer = print.palette.transfer();
        match format {
            FormatArg::Ppm => levels(PictureFormat::Ppm),
            FormatArg::PlainPpm => levels(PictureFormat::PlainPpm),
            FormatArg::Png => levels(PictureFormat::Png(transfer)),
            FormatArg::Png16 => encode_png16(&print.deep_screen(), transfer, &metadata),
            FormatArg::Pfm => encode_pfm(&print.linear()),
            FormatArg::Hdr => encode_hdr(&print.linear(), &metadata),
            #[cfg(feature = "openexr")]
            FormatArg::Exr => encode_exr(&print.linear(), &metadata),
        }
    }
}

/// The lights that are not as their materials say, each with its factors.
fn dimmed_lights(dimming: &Dimming) -> String {
    let of_light = |light: &Light| {
        let [r, g, b] = light.dimming();
        (light.dimming() != [1.0; 3]).then(|| format!("{} times {r} {g} {b}", light.name))
    };
    let dimmed: Vec<String> = dimming.lights().iter().filter_map(of_light).collect();
    if dimmed.is_empty() {
        "as their materials say".to_owned()
    } else {
        dimmed.join(", ")
    }
}

impl FormatArg {
    /// Whether it holds numbers, and not what screens show.
    fn is_linear(self) -> bool {
        match self {
            FormatArg::Ppm | FormatArg::PlainPpm | FormatArg::Png | FormatArg::Png16 => false,
            FormatArg::Pfm | FormatArg::Hdr => true,
            #[cfg(feature = "openexr")]
            FormatArg::Exr => true,
        }
    }

    /// What it is called in reports, and how its files end.
    fn label_and_ending(self) -> (&'static str, &'static str) {
        match self {
            FormatArg::Ppm => ("ppm", "ppm"),
            FormatArg::PlainPpm => ("plain_ppm", "plain.ppm"),
            FormatArg::Png => ("png", "png"),
            FormatArg::Png16 => ("png16", "16.png"),
            FormatArg::Pfm => ("pfm", "pfm"),
            FormatArg::Hdr => ("hdr", "hdr"),
            #[cfg(feature = "openexr")]
            FormatArg::Exr => ("exr", "exr"),
        }
    }
}
