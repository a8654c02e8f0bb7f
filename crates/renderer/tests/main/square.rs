//! A square to look at from above.

use crate::light::one_sample;
use radiosity_geometry::{Camera, DVec3, Mesh, Shape};
use radiosity_image::Image;
use radiosity_renderer::{Fields, ImageParams, Renderer, Shading};

/// The corners of a unit square around the origin in the plane z = 0, front towards +z.
pub(crate) fn square() -> [DVec3; 4] {
    [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]].map(|[x, y]| DVec3::new(x, y, 0.0))
}

pub(crate) fn two_triangles() -> Vec<Shape> {
    let [a, b, c, d] = square();
    vec![Shape::Triangle([a, b, c]), Shape::Triangle([c, d, a])]
}

/// The view of a square region of the plane z = 0 from above it, one sample a pixel: by patches,
/// and smooth.
pub(crate) fn view(
    mesh: &Mesh,
    fields: &Fields<'_>,
    center: DVec3,
    height: f64,
    pixels: u32,
) -> [Image; 2] {
    let distance = 10.0;
    let fov = 2.0 * (0.5 * height / distance).atan().to_degrees();
    let from = center + distance * DVec3::Z;
    let camera = Camera::new(from, DVec3::NEG_Z, DVec3::Y, fov, 0.0).unwrap();
    let shadings = [Shading::Constant, Shading::Smooth];
    let renderer = Renderer::new(mesh, fields, &ImageParams::default(), &shadings);
    let pictures = renderer.render(&camera, &one_sample(pixels));
    pictures.try_into().expect("a picture for each shading")
}
