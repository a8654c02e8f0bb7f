//! A square to look at from above, and fields for it.

#![allow(dead_code, reason = "each test file uses some of it")]

use radiosity_geometry::{Camera, DVec3, Divisions, Mesh, Shape, Surface, subdivide};
use radiosity_image::Image;
use radiosity_renderer::{Fields, ImageParams, Renderer, Shading, ShadingParams};

pub(crate) fn cut(shapes: Vec<Shape>, divisions: u32) -> Mesh {
    let surface = |shape| Surface {
        shape,
        divisions: Some(Divisions::uniform(divisions)),
    };
    let surfaces: Vec<Surface> = shapes.into_iter().map(surface).collect();
    subdivide(&surfaces, Divisions::uniform(1)).unwrap()
}

/// The corners of a unit square around the origin in the plane z = 0, front towards +z.
pub(crate) fn square() -> [DVec3; 4] {
    [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]].map(|[x, y]| DVec3::new(x, y, 0.0))
}

pub(crate) fn two_triangles() -> Vec<Shape> {
    let [a, b, c, d] = square();
    vec![Shape::Triangle([a, b, c]), Shape::Triangle([c, d, a])]
}

/// The view of a square region of the plane z = 0 from above it, one sample a pixel.
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
    let params = ImageParams {
        width: pixels,
        height: pixels,
        subpixels: 1,
        samples: 1,
        ..ImageParams::default()
    };
    let shadings = [Shading::Constant, Shading::Smooth];
    let renderer = Renderer::new(mesh, fields, &ShadingParams::default(), &shadings);
    let pictures = renderer.render(&camera, &params, &|_| ());
    pictures.try_into().expect("a picture for each shading")
}

/// Fields with equal materials everywhere.
pub(crate) fn with_fields<T>(radiosity: &[[f32; 3]], f: impl FnOnce(&Fields<'_>) -> T) -> T {
    let same = vec![[0.5; 3]; radiosity.len()];
    f(&Fields {
        sources: &same,
        emission: &same,
        reflectance: &same,
        shown: radiosity,
        indirect: &same,
        direct: &same,
        direct_gain: &same,
        gathered_gain: &same,
        visible: &vec![1.0; radiosity.len()],
    })
}
