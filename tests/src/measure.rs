//! The measures of error that the reference data defines, on results that were never written.

use crate::reference::{radiance, reference_table, regions};
use radiosity::compare::{Errors, Table, compare_pictures, compare_tables};
use radiosity::geometry::{Discretization, PixelFilter};
use radiosity::image::Image;
use radiosity::scene::Scene;
use radiosity::stages::{PatchLight, Patches};
use radiosity::{Context, cells, radiosity_table, subdivide};

/// The exposure at which the course shows its picture.
const EXPOSURE: f64 = 4.0;

/// The errors of radiosities of 12 x 12 patches against the table.
pub fn radiosity_errors(patches: &Patches<'_>, light: &PatchLight) -> Errors {
    let scene = patches.scene();
    let found = radiosity_table(scene, &patches.mesh, &light.mean_radiosity());
    table_errors(scene, &found, 12)
}

/// The errors of radiosities of `n x n` patches against the table of so many.
pub fn table_errors(scene: &Scene, found: &Table, n: u32) -> Errors {
    let patches = subdivide(scene, &Discretization::uniform(n), Context::default());
    let patches = patches.unwrap_or_else(|error| panic!("{error}"));
    let errors = compare_tables(&cells(scene, &patches.mesh), found, &reference_table(n));
    let errors = errors.unwrap_or_else(|error| panic!("{error}"));
    errors[errors.len() - 1].1
}

/// The errors of a picture by a filter against the reference, over one region or a run of them:
/// `"0-2"` is away from edges.
pub fn picture_errors(found: &Image, filter: PixelFilter, region: &str) -> Errors {
    let errors = compare_pictures(found, &radiance(filter), Some(&regions()), EXPOSURE);
    let errors = errors.unwrap_or_else(|error| panic!("{error}"));
    let of_region = errors.iter().find(|(name, _)| name == region);
    of_region.expect("the map has this region").1
}
