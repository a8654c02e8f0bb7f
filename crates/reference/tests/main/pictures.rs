//! Path-traced pictures: against furnaces, against radiosities, and their own errors.

use crate::radiosities::{cut, means};
use radiosity_geometry::{Camera, DVec3, Film, PixelFilter};
use radiosity_reference::Tracer;
use radiosity_scene::Scene;
use radiosity_test_kit::{on_threads, shipped_scene};

fn film(width: u32, height: u32, filter: PixelFilter) -> Film {
    Film {
        width,
        height,
        subpixels: 2,
        filter,
    }
}

/// In a furnace the picture is E / (1 - rho) / pi everywhere, its own estimate of its error
/// holds, and threads leave no trace.
#[test]
fn pictures_are_exact_and_know_their_error() {
    let scene = shipped_scene("furnace");
    let film = film(32, 24, PixelFilter::Tents);
    let camera = scene.camera.as_ref().unwrap();
    let trace = |threads| {
        on_threads(threads, || {
            let mut tracer = Tracer::new(&scene, camera, film, 5).unwrap();
            (0..64).for_each(|_| tracer.pass(&|_| ()));
            assert_eq!(tracer.samples(), 256);
            (tracer.picture(), tracer.relative_error(0.0))
        })
    };
    let (picture, relative_error) = trace(1);
    assert_eq!((&picture, relative_error), (&trace(3).0, relative_error));
    let expected = [1.25, 2.0, 5.0].map(|b| b / std::f64::consts::PI);
    let mut squares = 0.0;
    let mut within = 0;
    for (pixel, error) in picture.radiance.iter().zip(&picture.standard_error) {
        for c in 0..3 {
            squares += (pixel[c] - expected[c]).powi(2);
        }
        within += usize::from((pixel[1] - expected[1]).abs() < 2.0 * error[1]);
    }
    let pixels = picture.radiance.len() as f64;
    let rms = (squares / (3.0 * pixels)).sqrt() / (expected.iter().sum::<f64>() / 3.0);
    // 768 pixels know their common error to some 5 %, and the share within to 0.8 %.
    assert!(
        (rms / relative_error - 1.0).abs() < 0.2,
        "{rms} {relative_error}"
    );
    assert!(within as f64 / pixels > 0.92);
}

/// A quarter of the samples of the next test, and so twice its errors.
#[test]
fn pictures_and_tables_agree() {
    agree(10_000, 125, 0.02);
}

#[test]
#[ignore = "slow: half a minute"]
fn pictures_and_tables_agree_within_a_percent() {
    agree(40_000, 500, 0.01);
}

/// A camera that looks straight at a wall, which fills the film exactly, sees every cell of it in
/// a block of pixels: their mean radiance is the cell's radiosity over pi. So many walks a cell and
/// passes of a picture know both to a share of what they are.
fn agree(walks: u32, passes: u32, precision: f64) {
    let scene = shipped_scene("cornell");
    let mesh = cut(&scene, 4);
    let cells = means(&scene, &mesh, walks, 2);
    // The back wall is 100 wide and 80 high, at z = 0; all that stands before it is cut away.
    let position = DVec3::new(50.0, 40.0, 300.0);
    let vertical_fov = 2.0 * (40.0_f64 / 300.0).atan().to_degrees();
    let camera = Camera::new(position, DVec3::NEG_Z, DVec3::Y, vertical_fov, 299.0).unwrap();
    let film = film(20, 16, PixelFilter::Box);
    let mut tracer = Tracer::new(&scene, &camera, film, 3).unwrap();
    (0..passes).for_each(|_| tracer.pass(&|_| ()));
    let picture = tracer.picture();
    let mut chi_square = 0.0;
    for (patch, cell) in mesh.patches.iter().zip(&cells) {
        if scene.surfaces[patch.surface.index()].name != "back" {
            continue;
        }
        let (mut sum, mut variance) = (0.0, 0.0);
        for (row, column) in (0..4).flat_map(|row| (0..5).map(move |column| (row, column))) {
            let (x, y) = (5 * patch.cell[0] + column, 4 * (3 - patch.cell[1]) + row);
            let pixel = (y * picture.width + x) as usize;
            sum += picture.radiance[pixel][1];
            variance += picture.standard_error[pixel][1].powi(2);
        }
        let seen = std::f64::consts::PI * sum / 20.0;
        let error = std::f64::consts::PI * variance.sqrt() / 20.0;
        let error = error.hypot(cell.standard_error[1]);
        assert!(error < precision * seen, "{error} {seen}");
        chi_square += ((seen - cell.radiosity[1]) / error).powi(2);
    }
    // 16 degrees of freedom: more than 39 once in a thousand times.
    println!("chi-square {chi_square:.1} over 16 cells");
    assert!(chi_square < 39.0, "{chi_square}");
}

/// A black picture has no error, and one that is clamped everywhere has that of its pixels.
#[test]
fn errors_are_defined_in_the_dark_and_where_all_is_clamped() {
    let mut scene = shipped_scene("furnace");
    let film = film(8, 6, PixelFilter::Tents);
    let camera = scene.camera.unwrap();
    let error = |scene: &Scene, exposure| {
        let mut tracer = Tracer::new(scene, &camera, film, 5).unwrap();
        (0..8).for_each(|_| tracer.pass(&|_| ()));
        assert!(tracer.vertices() >= 8 * 4 * 48);
        tracer.relative_error(exposure)
    };
    assert_eq!(error(&scene, 1e9), error(&scene, 0.0));
    for material in &mut scene.materials {
        material.emission = [0.0; 3];
    }
    assert_eq!(error(&scene, 1.0), 0.0);
}
