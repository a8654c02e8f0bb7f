//! The whole chain against path-traced truth.

use radiosity::compare::Table;
use radiosity::geometry::{Divisions, PixelFilter};
use radiosity::renderer::Shading;
use radiosity::{Context, Project, estimate, radiosity_table, render, solve, subdivide};
use radiosity_tests::{BOTH, Chain, picture_errors, radiosity_errors, shipped, table_errors};

/// What the course program is known to reach on its scene, to a tenth of a point: RMSE 4.50 %
/// and bias +1.63 % of the radiosities, constant picture 9.0 % away from edges. The smooth picture
/// must be better than the course's, which has 5.9 %.
#[test]
fn the_course_is_reproduced() {
    let project = shipped("cornell-course");
    let chain = Chain::of(&project);
    let light = chain.light();
    let errors = radiosity_errors(chain.patches, &light);
    let (rmse, bias) = (errors.rmse_percent, errors.bias_percent);
    println!("radiosities: RMSE {rmse:.3} %, bias {bias:+.3} %");
    assert!((rmse - 4.50).abs() < 0.1, "RMSE {rmse}");
    assert!((bias - 1.63).abs() < 0.1, "bias {bias}");

    let pictures = chain.pictures(&light, &BOTH);
    let away_from_edges = |image| picture_errors(image, PixelFilter::Tents, "0-2");
    let constant = away_from_edges(&pictures[0]);
    let smooth = away_from_edges(&pictures[1]);
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
    assert!(smooth.rmse_percent < 5.9, "smooth picture {smooth:?}");
}

/// What patches of constant radiosity cost is all that is left: 1.28 % and 0.52 % with factors that
/// are nearly exact where whole patches are the elements, and 0.39 % over the larger cells; less
/// where what is visible of them is.
#[test]
fn accurate_factors_leave_the_error_of_the_patches() {
    let project = accurate_cornell(12);
    check_table(&project, &table(&project), (12, 1.25, 0.35));
}

#[test]
#[ignore = "slow: five seconds"]
fn smaller_patches_leave_less() {
    let project = accurate_cornell(24);
    let fine = table(&project);
    let coarse = fine.coarsened(6).unwrap();
    check_table(&project, &fine, (24, 0.5, 0.15));
    check_table(&project, &coarse, (4, 0.4, 0.15));
}

/// With so many patches along each edge.
fn accurate_cornell(n: u32) -> Project {
    let mut project = shipped("cornell");
    project.params.form_factors.tolerance = 2e-3;
    project.params.discretization.default = Divisions::uniform(n);
    project
}

fn table(project: &Project) -> Table {
    let chain = Chain::of(project);
    let means = chain.light().mean_radiosity();
    radiosity_table(&project.scene, &chain.patches.mesh, &means)
}

/// Cells along each edge, and the most errors in percent: the root mean square, and the bias.
fn check_table(project: &Project, found: &Table, (n, most, bias): (u32, f64, f64)) {
    let errors = table_errors(&project.scene, found, n);
    let rmse = errors.rmse_percent_without_noise();
    println!(
        "{n} x {n}: RMSE {rmse:.3} %, bias {:+.3} %",
        errors.bias_percent
    );
    assert!(rmse <= most, "{n}: {errors:?}");
    assert!(errors.bias_percent.abs() <= bias, "{n}: {errors:?}");
}

/// Pictures from nearly exact factors, away from edges: what Catmull and Rom's spline leaves of
/// exact means is 4.3 % of 12 x 12 patches, 2.0 % of 24 x 24 and 1.15 % of 48 x 48, and smooth
/// pictures must be as good, but for a tenth at 12 x 12. With exact direct light there must be less
/// than half of that; what patches of constant radiosity do to the bias of light that is reflected
/// more often remains.
#[test]
fn pictures_are_near_the_truth() {
    near_the_truth(&[(12, 4.6, 2.1, 0.35)]);
}

#[test]
#[ignore = "slow: half a minute"]
fn pictures_of_many_patches_are_nearer_the_truth() {
    near_the_truth(&[(24, 2.0, 1.0, 0.15), (48, 1.15, 0.58, 0.12)]);
}

/// Patches along each edge, and the most errors in percent: of the smooth picture, of that with
/// exact direct light, and the bias of that.
fn near_the_truth(most: &[(u32, f64, f64, f64)]) {
    let mut project = shipped("cornell");
    project.params.form_factors.tolerance = 2e-3;
    project.params.image.filter = PixelFilter::Box;
    for &(n, most_smooth, most_exact, bias) in most {
        project.params.discretization.default = Divisions::uniform(n);
        // The largest matrix is not to stay.
        let (scene, params) = (&project.scene, &project.params);
        let patches = subdivide(scene, &params.discretization, Context::default()).unwrap();
        let factors = estimate(&patches, &params.form_factors).unwrap();
        let light = solve(&factors, &params.solver).unwrap().light().unwrap();
        let (camera, shadings) = (scene.camera.unwrap(), [Shading::Smooth, Shading::Exact]);
        let pictures = render(&patches, &light, &camera, &params.image, &shadings).unwrap();
        let errors = [0, 1].map(|k| picture_errors(&pictures[k], PixelFilter::Box, "0-2"));
        let [smooth, exact] = errors.map(|errors| errors.rmse_percent);
        let found = errors[1].bias_percent;
        println!("{n} x {n}: smooth {smooth:.3} %, exact {exact:.3} %, bias {found:+.3} %");
        assert!(
            smooth <= most_smooth && exact <= most_exact,
            "{n}: {errors:?}"
        );
        assert!(found.abs() <= bias, "{n}: {errors:?}");
    }
}

/// Gathering at samples of 12 x 12 patches leaves a part of what patches do to the bias, and some
/// noise.
#[test]
#[ignore = "slow: ten seconds"]
fn gathered_light_is_nearer() {
    let mut project = shipped("cornell");
    project.params.form_factors.tolerance = 5e-4;
    project.params.image.filter = PixelFilter::Box;
    let chain = Chain::of(&project);
    let light = chain.light();
    let pictures = chain.pictures(&light, &[Shading::Gathered]);
    let errors = picture_errors(&pictures[0], PixelFilter::Box, "0-2");
    let (rmse, bias) = (errors.rmse_percent, errors.bias_percent);
    println!("gathered: {rmse:.3} %, bias {bias:+.3} %");
    assert!(rmse <= 0.6 && bias.abs() <= 0.35, "{errors:?}");
}

/// The same surfaces as triangles give the same picture. Shading triangles must not cost
/// accuracy: the smooth picture is as close to the truth as the course's on rectangles is (5.9 %),
/// and much closer than the constant one.
#[test]
fn triangles_are_as_good_as_rectangles() {
    let project = shipped("cornell-course-triangles");
    let chain = Chain::of(&project);
    let pictures = chain.pictures(&chain.light(), &BOTH);
    let away_from_edges = |image| picture_errors(image, PixelFilter::Tents, "0-2");
    let smooth = away_from_edges(&pictures[1]);
    println!(
        "smooth picture of triangles: RMSE {:.3} %, bias {:+.3} %",
        smooth.rmse_percent, smooth.bias_percent
    );
    assert!(smooth.rmse_percent < 5.9, "{smooth:?}");
    assert!(away_from_edges(&pictures[0]).rmse_percent > 8.0);
}
