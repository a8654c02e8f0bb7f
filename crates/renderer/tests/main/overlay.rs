//! Lines over pictures lie where patches end and where numbers are equal.

use crate::meshes::{cut, quad};
use radiosity_geometry::{Backs, Camera, DVec3, Shape};
use radiosity_image::{Rgb8Image, Values};
use radiosity_renderer::Outlines;

const SIZE: u32 = 40;

/// A square, seen from its front, that fills a picture of 40 x 40 pixels but for a margin of 4
/// pixels, and whatever stands before it.
fn outlines(divisions: u32, before: Option<Shape>, backs: Backs) -> Outlines {
    let shapes = [plate(0.8, 0.0)].into_iter().chain(before);
    let mesh = cut(shapes.collect(), divisions);
    let fov = 2.0 * 0.1f64.atan().to_degrees();
    let camera = Camera::new(10.0 * DVec3::Z, DVec3::NEG_Z, DVec3::Y, fov, 0.0).unwrap();
    Outlines::new(&mesh, (&camera, backs), (SIZE, SIZE))
}

/// A square of this half of an edge at this height, with its front up; a negative one turns it
/// down.
fn plate(half: f64, z: f64) -> Shape {
    let h = half.abs();
    quad([[-half, -h, z], [half, -h, z], [half, h, z], [-half, h, z]])
}

/// The brightness of a row of pixels under white lines.
fn row(draw: impl FnOnce(&mut Rgb8Image)) -> Vec<u8> {
    let mut picture = Rgb8Image::plain(SIZE, SIZE, [0; 3]);
    draw(&mut picture);
    let start = (3 * SIZE * 22) as usize;
    picture.bytes[start..]
        .iter()
        .step_by(3)
        .take(SIZE as usize)
        .copied()
        .collect()
}

const WHITE: [u8; 3] = [255; 3];

/// Four patches of 8 pixels: lines lie at 4, 12, 20, 28 and 36, on the border of two pixels, and
/// are one pixel wide together.
fn borders(strength: f32) -> Vec<u8> {
    let level = (255.0 * 0.5 * strength + 0.5) as u8;
    let is_beside = |x: usize| (x + 1) % 8 == 4 || x % 8 == 4;
    (0..SIZE as usize)
        .map(|x| if is_beside(x) { level } else { 0 })
        .collect()
}

#[test]
fn borders_of_patches_are_drawn() {
    let lines = outlines(4, None, Backs::Black);
    for strength in [1.0, 0.5] {
        let found = row(|picture| lines.draw(picture, WHITE, strength));
        assert_eq!(found, borders(strength));
    }
}

/// A larger plate shows its back: it has no patches, and hides those behind it unless one looks
/// through.
#[test]
fn backs_have_no_patches_and_may_be_looked_through() {
    for (backs, expected) in [
        (Backs::Black, borders(0.0)),
        (Backs::Transparent, borders(1.0)),
    ] {
        let lines = outlines(4, Some(plate(-2.0, 1.0)), backs);
        assert_eq!(row(|picture| lines.draw(picture, WHITE, 1.0)), expected);
    }
}

/// Numbers that rise by 1 from pixel to pixel: lines lie at whole pixels and between them, but not
/// within two pixels of the square's border.
#[test]
fn isolines_lie_where_numbers_are_equal() {
    let values = Values {
        width: SIZE,
        height: SIZE,
        values: (0..SIZE * SIZE).map(|k| (k % SIZE) as f32).collect(),
    };
    let levels = [2.0, 10.0, 20.5, 30.25, 35.0];
    let outlines = outlines(1, None, Backs::Black);
    let found = row(|picture| outlines.draw_isolines(picture, &values, &levels));
    let mut expected = vec![0; SIZE as usize];
    // Nothing at 2 and 35, beside the border.
    for (x, level) in [(10, 255), (20, 128), (21, 128), (30, 191), (31, 64)] {
        expected[x] = level;
    }
    assert_eq!(found, expected);
}
