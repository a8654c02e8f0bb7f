//! Small pictures of the shipped scenes, against committed ones.
//!
//! `UPDATE_GOLDEN=1 cargo test -p radiosity-tests --test main golden` rewrites the committed ones.
//! A failure leaves `NAME-got.png`, `NAME-expected.png` and `NAME-difference.png` (sixteen times
//! enlarged differences around grey) in `target/golden/`.

use radiosity::geometry::Divisions;
use radiosity::image::{PictureFormat, Rgb8Image, Transfer, encode};
use radiosity::{expose, render};
use radiosity_tests::{BOTH, Chain, in_checkout, shipped};
use std::path::Path;

/// Levels out of 255. Pictures are the same to the bit on one machine; elsewhere the sines and
/// powers of the mathematics library may differ in their last digit and flip a rounding.
const TOLERANCE: i32 = 1;

fn check(scene: &str, divisions: u32, points: u32) {
    let mut project = shipped(scene);
    project.params.discretization.default = Divisions::uniform(divisions);
    project.params.form_factors.points = points;
    (project.params.image.width, project.params.image.height) = (96, 72);
    let chain = Chain::of(&project);
    let camera = project.scene.first_camera().unwrap();
    let light = chain.light();
    let image = expose(
        chain.patches,
        &light,
        &[camera],
        &project.params.image,
        &BOTH,
    );
    let pictures = render(chain.patches, &light, &camera, &image, &BOTH).unwrap();
    for (picture, shading) in pictures.iter().zip(["constant", "smooth"]) {
        let name = format!("{}-{shading}", project.scene.name);
        compare(&name, &image.tone_map().apply(picture), image.gamma);
    }
}

fn compare(name: &str, got: &Rgb8Image, transfer: Transfer) {
    let path = in_checkout("tests/golden").join(format!("{name}.png"));
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        save(&path, got, transfer);
        return;
    }
    let expected = load(&path);
    let differences = || {
        let pairs = got.bytes.iter().zip(&expected.bytes);
        pairs.map(|(&got, &expected)| i32::from(got) - i32::from(expected))
    };
    let same_size = (got.width, got.height) == (expected.width, expected.height);
    let worst = differences().map(i32::abs).max().unwrap_or(0);
    if same_size && worst <= TOLERANCE {
        return;
    }
    let folder = in_checkout("target/golden");
    std::fs::create_dir_all(&folder).unwrap();
    let enlarged = |difference: i32| (128 + 16 * difference).clamp(0, 255) as u8;
    let difference = Rgb8Image {
        bytes: differences().map(enlarged).collect(),
        ..expected.clone()
    };
    for (kind, picture) in [
        ("got", got),
        ("expected", &expected),
        ("difference", &difference),
    ] {
        save(
            &folder.join(format!("{name}-{kind}.png")),
            picture,
            transfer,
        );
    }
    panic!("{name} differs by {worst} levels: see {}", folder.display());
}

fn save(path: &Path, picture: &Rgb8Image, transfer: Transfer) {
    std::fs::write(path, encode(picture, PictureFormat::Png(transfer), &[])).unwrap();
}

fn load(path: &Path) -> Rgb8Image {
    let file = std::fs::File::open(path)
        .unwrap_or_else(|error| panic!("{}: {error}; see the head of this file", path.display()));
    let mut reader = png::Decoder::new(std::io::BufReader::new(file))
        .read_info()
        .unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    Rgb8Image {
        width: info.width,
        height: info.height,
        bytes,
    }
}

#[test]
fn cornell() {
    check("cornell", 6, 2);
}

#[test]
fn cornell_triangles() {
    check("cornell-triangles", 4, 2);
}

#[test]
fn the_courses_cornell_box() {
    check("cornell-course", 6, 2);
}

#[test]
fn the_courses_triangles() {
    check("cornell-course-triangles", 4, 2);
}

#[test]
fn cornell_closed() {
    check("cornell-closed", 6, 2);
}

#[test]
fn furnace() {
    check("furnace", 4, 2);
}

#[test]
#[ignore = "slow: a minute"]
fn knot() {
    check("knot", 4, 1);
}
