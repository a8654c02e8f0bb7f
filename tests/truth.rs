//! The whole chain against path-traced truth.

use radiosity::renderer::Image;
use radiosity_reference::Tracer;
use radiosity_tests::{picture_errors, pipeline, radiosity_errors, shipped, solve};

/// What the course program is known to reach on its scene, to a tenth of a point: RMSE 4.50 %
/// and bias +1.63 % of the radiosities, smooth picture 5.9 % and constant 9.0 % away from edges.
#[test]
fn the_course_is_reproduced() {
    let scene = shipped("cornell");
    let pipeline = pipeline(&scene);
    let solution = solve(&pipeline);
    let errors = radiosity_errors(&scene, &pipeline, &solution);
    let (rmse, bias) = (errors.rmse_percent, errors.bias_percent);
    println!("radiosities: RMSE {rmse:.3} %, bias {bias:+.3} %");
    assert!((rmse - 4.50).abs() < 0.1, "RMSE {rmse}");
    assert!((bias - 1.63).abs() < 0.1, "bias {bias}");

    let pictures = pipeline.pictures(&solution).unwrap();
    let away_from_edges = |image| picture_errors(image, "0-2");
    let constant = away_from_edges(&pictures.constant);
    let smooth = away_from_edges(&pictures.smooth);
    println!(
        "constant picture: RMSE {:.3} %, bias {:+.3} %",
        constant.rmse_percent, constant.bias_percent
    );
    println!(
        "smooth picture: RMSE {:.3} %, bias {:+.3} %",
        smooth.rmse_percent, smooth.bias_percent
    );
    assert!(
        (constant.rmse_percent - 9.0).abs() < 0.1,
        "constant picture {constant:?}"
    );
    assert!(
        (smooth.rmse_percent - 5.9).abs() < 0.1,
        "smooth picture {smooth:?}"
    );
}

/// The same surfaces as triangles give the same picture. Shading triangles must not cost
/// accuracy: the smooth picture is as close to the truth as bicubic interpolation on the
/// rectangles is (5.9 %, see above), and much closer than the constant one.
#[test]
fn triangles_are_as_good_as_rectangles() {
    let scene = shipped("cornell-triangles");
    let pipeline = pipeline(&scene);
    let pictures = pipeline.pictures(&solve(&pipeline)).unwrap();
    let away_from_edges = |image| picture_errors(image, "0-2");
    let smooth = away_from_edges(&pictures.smooth);
    println!(
        "smooth picture of triangles: RMSE {:.3} %, bias {:+.3} %",
        smooth.rmse_percent, smooth.bias_percent
    );
    assert!(smooth.rmse_percent < 5.9, "{smooth:?}");
    assert!(away_from_edges(&pictures.constant).rmse_percent > 8.0);
}

/// Two path tracers that share no line of code, ours and the one that made the reference data.
/// Ours takes few samples, so single pixels are noisy, but noise averages out over a region: the
/// mean over n pixels is known to RMSE / sqrt(n), channels being correlated. The reference itself
/// may be 0.14 % off.
#[test]
fn the_oracle_agrees_with_the_reference_picture() {
    let scene = shipped("cornell");
    let camera = scene.camera.as_ref().unwrap();
    let mut tracer = Tracer::new(&scene, camera, 1).unwrap();
    tracer.pass(&|_| ());
    let traced = tracer.picture();
    let to_f32 = |pixel: &[f64; 3]| pixel.map(|channel| channel as f32);
    let found = Image {
        width: traced.width,
        height: traced.height,
        pixels: traced.radiance.iter().map(to_f32).collect(),
    };
    for region in ["0", "1", "2", "0-2"] {
        let errors = picture_errors(&found, region);
        let noise = errors.rmse_percent / (errors.values as f64 / 3.0).sqrt();
        println!(
            "oracle, region {region}: bias {:+.2} % +- {noise:.2} %",
            errors.bias_percent
        );
        assert!(
            errors.bias_percent.abs() < 4.0 * noise + 0.14,
            "{region}: {errors:?}"
        );
    }
}
