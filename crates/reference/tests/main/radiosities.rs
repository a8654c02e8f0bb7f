//! Radiosities of patches by random walks: against closed forms, and their standard errors.

use radiosity_geometry::Mesh;
use radiosity_reference::{CellMean, cell_means};
use radiosity_scene::Scene;
use radiosity_test_kit::closed_forms::parallel_rectangles;
use radiosity_test_kit::{cut_scene, in_checkout, scene_of, shipped_scene};
use std::path::Path;

pub(crate) fn cut(scene: &Scene, n: u32) -> Mesh {
    cut_scene(scene, n)
}

pub(crate) fn means(scene: &Scene, mesh: &Mesh, samples: u32, seed: u64) -> Vec<CellMean> {
    cell_means(scene, mesh, samples, seed, &|_| ())
}

/// Deviations from known values in units of the standard error, channel by channel.
fn deviations(found: &CellMean, expected: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|c| (found.radiosity[c] - expected[c]) / found.standard_error[c])
}

/// B = E / (1 - rho) in every cell; corners included, where emitters touch.
#[test]
fn the_furnace_is_exact() {
    let scene = shipped_scene("furnace");
    let mesh = cut(&scene, 2);
    let mut worst: f64 = 0.0;
    for cell in means(&scene, &mesh, 20_000, 1) {
        for deviation in deviations(&cell, [1.25, 2.0, 5.0]) {
            worst = worst.max(deviation.abs());
        }
        assert!(cell.standard_error[1] < 0.01);
    }
    // The largest of 72 normal deviates exceeds 4.5 once in 2,000 times.
    assert!(worst < 4.5, "{worst}");
}

/// The same room with walls made of two faces each, as thin as can be.
#[test]
fn walls_of_two_faces_let_nothing_through() {
    let text = std::fs::read_to_string(in_checkout("scenes/furnace.toml")).unwrap();
    let (_, walls) = text.split_once("[[surfaces]]").unwrap();
    let reversed = walls
        .replace("name = \"", "name = \"outside ")
        .replace("edge_a", "edge")
        .replace("edge_b", "edge_a")
        .replace("edge =", "edge_b =");
    let both = format!("{text}\n[[surfaces]]{reversed}");
    let scene = scene_of(Path::new("both.toml"), &both);
    let mesh = cut(&scene, 1);
    let cells = means(&scene, &mesh, 20_000, 2);
    let (inside, outside) = cells.split_at(6);
    for cell in inside {
        let worst = deviations(cell, [1.25, 2.0, 5.0]).map(f64::abs);
        // As above, of 18.
        assert!(worst.iter().all(|&deviation| deviation < 4.5), "{worst:?}");
    }
    assert!(outside.iter().all(|cell| cell.radiosity == [1.0; 3]));
}

/// A black receiver would show nothing; with reflectance rho it shows rho F E to first order,
/// and the emitter is black, so to all orders. F of opposed unit squares at distance 1.
#[test]
fn one_emitter_and_one_receiver_give_the_form_factor() {
    let text = r#"
        materials.lamp = { reflectance = 0, emission = 1 }
        materials.white = { reflectance = 0.5 }
        [[surfaces]]
        name = "below"
        material = "white"
        quad = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
        [[surfaces]]
        name = "above"
        material = "lamp"
        quad = [[0, 0, 1], [0, 1, 1], [1, 1, 1], [1, 0, 1]]
    "#;
    let scene = scene_of(Path::new("pair.toml"), text);
    let mesh = cut(&scene, 1);
    let cells = means(&scene, &mesh, 400_000, 3);
    let expected = 0.5 * parallel_rectangles([[0.0, 1.0]; 2], [[0.0, 1.0]; 2], 1.0);
    assert!(deviations(&cells[0], [expected; 3])[0].abs() < 4.0);
    assert!(cells[0].standard_error[0] < 1e-3 * expected);
    assert_eq!(cells[1].radiosity, [1.0; 3]);
}

/// At least 95 % of means within two standard errors of the truth, over repeats.
#[test]
fn standard_errors_hold() {
    let scene = shipped_scene("furnace");
    let mesh = cut(&scene, 1);
    let (mut within, mut count) = (0, 0);
    for seed in 0..60 {
        for cell in means(&scene, &mesh, 500, 100 + seed) {
            within += usize::from(deviations(&cell, [1.25, 2.0, 5.0])[1].abs() < 2.0);
            count += 1;
        }
    }
    let share = f64::from(within as u32) / f64::from(count as u32);
    println!("{:.1} % within two standard errors", 100.0 * share);
    // 360 means: one standard deviation of the share is 1.1 %.
    assert!(share > 0.92, "{share}");
}

#[test]
fn dark_scenes_are_dark() {
    let mut scene = shipped_scene("cornell");
    for material in &mut scene.materials {
        material.emission = [0.0; 3];
    }
    let mesh = cut(&scene, 1);
    let dark = |cell: &CellMean| cell.radiosity == [0.0; 3];
    assert!(means(&scene, &mesh, 10, 1).iter().all(dark));
}
