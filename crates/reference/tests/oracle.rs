//! The oracle against closed forms, and against itself.

use radiosity_geometry::{Camera, DVec3, Divisions, Mesh, PixelFilter, subdivide};
use radiosity_reference::{CellMean, Tracer, cell_means};
use radiosity_scene::{Scene, load, parse};
use std::path::{Path, PathBuf};

fn in_checkout(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join(path)
}

fn cut(scene: &Scene, n: u32) -> Mesh {
    subdivide(&scene.geometry, Divisions::uniform(n)).unwrap()
}

fn means(scene: &Scene, mesh: &Mesh, samples: u32, seed: u64) -> Vec<CellMean> {
    cell_means(scene, mesh, samples, seed, &|_| ())
}

/// Deviations from known values in units of the standard error, channel by channel.
fn deviations(found: &CellMean, expected: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|c| (found.radiosity[c] - expected[c]) / found.standard_error[c])
}

/// B = E / (1 - rho) in every cell; corners included, where emitters touch.
#[test]
fn the_furnace_is_exact() {
    let scene = load(&in_checkout("scenes/furnace.toml")).unwrap();
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
    let scene = parse(Path::new("both.toml"), &both).unwrap();
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
    let scene = parse(Path::new("pair.toml"), text).unwrap();
    let mesh = cut(&scene, 1);
    let cells = means(&scene, &mesh, 400_000, 3);
    let expected = 0.5 * 0.199_824_896;
    assert!(deviations(&cells[0], [expected; 3])[0].abs() < 4.0);
    assert!(cells[0].standard_error[0] < 1e-3 * expected);
    assert_eq!(cells[1].radiosity, [1.0; 3]);
}

/// At least 95 % of means within two standard errors of the truth, over repeats.
#[test]
fn standard_errors_hold() {
    let scene = load(&in_checkout("scenes/furnace.toml")).unwrap();
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

/// In a furnace the picture is E / (1 - rho) / pi everywhere, its own estimate of its error
/// holds, and threads leave no trace.
#[test]
fn pictures_are_exact_and_know_their_error() {
    let mut scene = load(&in_checkout("scenes/furnace.toml")).unwrap();
    (scene.image.width, scene.image.height) = (32, 24);
    let camera = scene.camera.as_ref().unwrap();
    let trace = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            let mut tracer = Tracer::new(&scene, camera, 5).unwrap();
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

/// A camera that looks straight at a wall, which fills the film exactly, sees every cell of it in
/// a block of pixels: their mean radiance is the cell's radiosity over pi.
#[test]
fn pictures_and_tables_agree() {
    let mut scene = load(&in_checkout("scenes/cornell.toml")).unwrap();
    let mesh = cut(&scene, 4);
    let cells = means(&scene, &mesh, 40_000, 2);
    // The back wall is 100 wide and 80 high, at z = 0; all that stands before it is cut away.
    let position = DVec3::new(50.0, 40.0, 300.0);
    let vertical_fov = 2.0 * (40.0_f64 / 300.0).atan().to_degrees();
    let camera = Camera::new(position, DVec3::NEG_Z, DVec3::Y, vertical_fov, 299.0).unwrap();
    (scene.image.width, scene.image.height) = (20, 16);
    scene.image.filter = PixelFilter::Box;
    let mut tracer = Tracer::new(&scene, &camera, 3).unwrap();
    (0..500).for_each(|_| tracer.pass(&|_| ()));
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
        assert!(error < 0.01 * seen, "{error} {seen}");
        chi_square += ((seen - cell.radiosity[1]) / error).powi(2);
    }
    // 16 degrees of freedom: more than 39 once in a thousand times.
    println!("chi-square {chi_square:.1} over 16 cells");
    assert!(chi_square < 39.0, "{chi_square}");
}

/// A black picture has no error, and one that is clamped everywhere has that of its pixels.
#[test]
fn errors_are_defined_in_the_dark_and_where_all_is_clamped() {
    let mut scene = load(&in_checkout("scenes/furnace.toml")).unwrap();
    (scene.image.width, scene.image.height) = (8, 6);
    let camera = scene.camera.unwrap();
    let error = |scene: &Scene, exposure| {
        let mut tracer = Tracer::new(scene, &camera, 5).unwrap();
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

#[test]
fn dark_scenes_are_dark() {
    let mut scene = load(&in_checkout("scenes/cornell.toml")).unwrap();
    for material in &mut scene.materials {
        material.emission = [0.0; 3];
    }
    let mesh = cut(&scene, 1);
    let dark = |cell: &CellMean| cell.radiosity == [0.0; 3];
    assert!(means(&scene, &mesh, 10, 1).iter().all(dark));
}
