//! The oracle against the reference data: two path tracers that share no line of code.

use radiosity::geometry::{Discretization, PixelFilter};
use radiosity::params::NumberOrWord;
use radiosity::reference::{TracedPicture, Tracer, cell_means};
use radiosity::{Context, cells, subdivide};
use radiosity_tests::{radiance, reference_table, shipped};
use std::collections::HashMap;

/// Sides of the square blocks of pixels whose means are compared.
const BLOCK: usize = 32;
/// The reference pictures as a whole may be so far off, in percent of their mean.
const OFFSET: f64 = 0.14;

/// The squared differences between two estimates, in units of their common variance.
#[derive(Default)]
struct ChiSquare {
    sum: f64,
    count: f64,
}

impl ChiSquare {
    fn add(&mut self, difference: f64, standard_error: f64) {
        self.sum += (difference / standard_error).powi(2);
        self.count += 1.0;
    }

    /// 1, give or take `sqrt(2 / count)`, where the errors are what they claim to be.
    fn per_value(&self) -> f64 {
        self.sum / self.count
    }
}

/// Mean radiosities of cells of all sizes agree within both errors, and so does the total power.
#[test]
#[ignore = "slow: a quarter of a minute"]
fn radiosities_agree() {
    for (n, samples) in [(4, 18_000), (12, 2000), (24, 1000)] {
        let (chi_square, power, power_error) = compare_with_table(n, samples);
        let per_value = chi_square.per_value();
        println!(
            "{n} x {n}: chi-square {per_value:.3} per value over {} values, \
             total power {power:+.3} % +- {power_error:.3} %",
            chi_square.count
        );
        // Cells that hardly any walk brings light to are not normal, and their few hits make
        // the quotient heavy-tailed; all others bring it to 1 within 0.02 (4 x 4: 0.07).
        assert!((0.85..1.15).contains(&per_value), "{per_value}");
        assert!(power.abs() < 3.0 * power_error, "{power} {power_error}");
        assert!(power_error < 0.2);
    }
}

/// Over the cells of lit surfaces that do not emit: chi-square; the difference of their power and
/// its standard error, in percent.
fn compare_with_table(n: u32, samples: u32) -> (ChiSquare, f64, f64) {
    let project = shipped("cornell-course");
    let scene = &project.scene;
    let patches = subdivide(scene, &Discretization::uniform(n), Context::default());
    let mesh = patches.unwrap().mesh;
    let found = cell_means(scene, &mesh, samples, 7, &|_| ());
    let table = reference_table(n);
    let rows = table.rows.iter();
    let rows: HashMap<_, _> = rows.map(|row| ((&row.surface, row.cell), row)).collect();
    let mut chi_square = ChiSquare::default();
    let (mut power, mut expected_power, mut variance) = (0.0, 0.0, 0.0);
    for (cell, mean) in cells(scene, &mesh).iter().zip(&found) {
        if cell.emits {
            continue;
        }
        let row = rows[&(&cell.surface, cell.cell)];
        let row_errors = row.standard_error.unwrap();
        for (c, row_error) in row_errors.into_iter().enumerate() {
            let error = mean.standard_error[c].hypot(row_error);
            let difference = mean.radiosity[c] - row.radiosity[c];
            if error > 0.0 {
                chi_square.add(difference, error);
            }
            power += cell.area * mean.radiosity[c];
            expected_power += cell.area * row.radiosity[c];
            variance += (cell.area * error).powi(2);
        }
    }
    // The channels of a walk go together: three times as much variance as if they did not.
    let error = (3.0 * variance).sqrt();
    let percent = 100.0 / expected_power;
    (
        chi_square,
        percent * (power - expected_power),
        percent * error,
    )
}

/// Pictures with either pixel filter agree, as a whole and block by block, within both errors.
#[test]
#[ignore = "slow: half a minute"]
fn pictures_agree() {
    for (filter, passes) in [(PixelFilter::Box, 12), (PixelFilter::Tents, 6)] {
        let mut project = shipped("cornell-course");
        project.params.image.filter = filter;
        let (scene, image) = (&project.scene, &project.params.image);
        let camera = scene.camera.as_ref().unwrap();
        let mut tracer = Tracer::new(scene, camera, image.film(), 1).unwrap();
        (0..passes).for_each(|_| tracer.pass(&|_| ()));
        compare_with_picture(
            filter,
            &tracer.picture(),
            project.params.image.exposure.number().unwrap(),
        );
    }
}

fn compare_with_picture(filter: PixelFilter, found: &TracedPicture, exposure: f64) {
    let reference = radiance(filter).image;
    let width = found.width as usize;
    // By block: difference, variance, reference. Green alone: channels are not independent.
    let mut blocks: HashMap<(usize, usize), [f64; 3]> = HashMap::new();
    for (index, expected) in reference.pixels.iter().enumerate() {
        // Clamped pixels are left out, as the measure for pictures does.
        if expected.iter().any(|&c| exposure * f64::from(c) > 1.0) {
            continue;
        }
        let block = (index % width / BLOCK, index / width / BLOCK);
        let sums = blocks.entry(block).or_default();
        sums[0] += found.radiance[index][1] - f64::from(expected[1]);
        sums[1] += found.standard_error[index][1].powi(2);
        sums[2] += f64::from(expected[1]);
    }
    let mut chi_square = ChiSquare::default();
    let mut total = [0.0; 3];
    for block in blocks.values() {
        chi_square.add(block[0], block[1].sqrt());
        total = std::array::from_fn(|k| total[k] + block[k]);
    }
    let (bias, noise) = (
        100.0 * total[0] / total[2],
        100.0 * total[1].sqrt() / total[2],
    );
    let per_block = chi_square.per_value();
    println!(
        "{filter:?}: bias {bias:+.3} % +- {noise:.3} %, chi-square {per_block:.3} per block over \
         {} blocks",
        chi_square.count
    );
    assert!(bias.abs() < 3.0 * noise + OFFSET);
    assert!(noise < 0.1, "{noise}");
    // Samples are spread over the pixel, which the standard error does not credit; the offset of
    // the reference adds (0.14 % / error of a block)^2.
    assert!((0.7..1.3).contains(&per_block), "{per_block}");
}
