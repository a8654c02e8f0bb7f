//! Where the power goes, against rays that know nothing of form factors.

use radiosity::form_factors::Mode;
use radiosity::geometry::{DVec3, Divisions, Mesh, Occluders, Patch, Polygon, Ray};
use radiosity::stages::PatchLight;
use radiosity::{Energy, Project};
use radiosity_test_kit::cuboid;
use radiosity_tests::{Chain, shipped};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::f64::consts::TAU;

const RAYS: u32 = 400_000;
/// The channel that is traced.
const GREEN: usize = 1;

/// Shares of the power that leaves all patches.
#[derive(Clone, Copy, Debug, Default)]
struct Shares {
    fronts: f64,
    backs: f64,
    background: f64,
}

/// From patches in proportion to the power that would leave them if nothing of them were hidden, in
/// the direction of diffuse light. What hidden parts would send to backs does not count.
fn traced(mesh: &Mesh, light: &PatchLight) -> Shares {
    let radiosity = &light.radiosity;
    let occluders = Occluders::new(mesh);
    let mut ends = Vec::new();
    let mut power = 0.0;
    for (patch, b) in mesh.patches.iter().zip(radiosity) {
        power += patch.area * f64::from(b[GREEN]);
        ends.push(power);
    }
    let mut rng = Pcg64Mcg::seed_from_u64(7);
    let mut counts = [0u32; 3];
    for _ in 0..RAYS {
        let wanted = power * rng.random::<f64>();
        let index = ends.partition_point(|&end| end <= wanted);
        let patch = &mesh.patches[index];
        let ray = Ray::new(point_on(patch, &mut rng), direction(patch.normal, &mut rng));
        let hit = occluders.closest_hit_from(patch.face, &ray);
        let what = hit.map_or(2, |hit| usize::from(!hit.front));
        counts[what] += 1;
    }
    let leaving = leaving(mesh, light);
    let of_leaving = |count| power / leaving * f64::from(count) / f64::from(RAYS);
    let [fronts, backs, background] = counts.map(of_leaving);
    Shares {
        fronts,
        backs: backs - (power - leaving) / leaving,
        background,
    }
}

/// The power that leaves all patches; those that are hidden in part emit nothing in these scenes.
fn leaving(mesh: &Mesh, light: &PatchLight) -> f64 {
    let means = light.mean_radiosity();
    let patches = mesh.patches.iter().zip(&means);
    patches
        .map(|(patch, b)| patch.area * f64::from(b[GREEN]))
        .sum()
}

fn point_on(patch: &Patch, rng: &mut Pcg64Mcg) -> DVec3 {
    let polygon: &Polygon = &patch.polygon;
    let (mut u, mut v): (f64, f64) = (rng.random(), rng.random());
    if !polygon.is_triangle() {
        // The shipped scenes have parallelograms alone, where this is uniform.
        return polygon.bilinear(u, v);
    }
    if u + v > 1.0 {
        (u, v) = (1.0 - u, 1.0 - v);
    }
    polygon.barycentric(u, v)
}

/// By Malley's method: a uniform point of the disk, raised to the hemisphere.
fn direction(normal: DVec3, rng: &mut Pcg64Mcg) -> DVec3 {
    let (across, along) = normal.any_orthonormal_pair();
    let (radius, angle) = (rng.random::<f64>().sqrt(), TAU * rng.random::<f64>());
    let (x, y) = (radius * angle.cos(), radius * angle.sin());
    x * across + y * along + (1.0 - x * x - y * y).max(0.0).sqrt() * normal
}

/// What the report says, as shares of the power that leaves all patches.
fn reported(mesh: &Mesh, light: &PatchLight) -> Shares {
    let power = leaving(mesh, light);
    let Energy {
        emitted,
        absorbed,
        to_backs,
        to_background,
    } = light.energy;
    Shares {
        // What arrives at fronts is absorbed there, or leaves them again: it is all that leaves but
        // what was emitted.
        fronts: (absorbed[GREEN] + power - emitted[GREEN]) / power,
        backs: to_backs[GREEN] / power,
        background: to_background[GREEN] / power,
    }
}

/// What the rows make of the power that leaves all patches: the standard error of what they say of
/// backs and background, whose errors are independent, and the most that the errors of factors add
/// up to.
fn errors_of_rows(chain: Chain, light: &PatchLight) -> [f64; 2] {
    let made = chain.made;
    let rows = made.form_factors.rows.iter();
    let means = light.mean_radiosity();
    let (mut of_rays, mut of_factors) = (0.0, 0.0);
    for ((patch, b), row) in chain.patches.mesh.patches.iter().zip(&means).zip(rows) {
        let power = patch.area * f64::from(b[GREEN]);
        of_rays += (power * row.rays_error).powi(2);
        of_factors += power * row.error.unwrap();
    }
    [of_rays.sqrt(), of_factors]
}

#[test]
fn power_arrives_where_rays_do() {
    check_power(&["cornell", "furnace"]);
}

#[test]
#[ignore = "slow: five seconds"]
fn power_arrives_in_larger_scenes_where_rays_do() {
    check_power(&["cornell-closed", "cornell-triangles"]);
}

fn check_power(scenes: &[&str]) {
    for name in scenes {
        let mut project = shipped(name);
        project.params.form_factors.mode = Mode::Accurate;
        let chain = Chain::of(&project);
        assert!(chain.solve().solution.report.converged, "{name}");
        let (mesh, light) = (&chain.patches.mesh, chain.light());
        let (found, expected) = (reported(mesh, &light), traced(mesh, &light));
        println!("{name}: {found:?}, by rays {expected:?}");
        let leaving = leaving(mesh, &light);
        let [of_rays, of_factors] = errors_of_rows(chain, &light);
        for (found, expected) in [
            (found.fronts, expected.fronts),
            (found.backs, expected.backs),
            (found.background, expected.background),
        ] {
            // A count of n rays scatters by its root. Four standard errors of both.
            let noise = (expected * (1.0 - expected) / f64::from(RAYS)).sqrt();
            let most = 4.0 * noise.hypot(of_rays / leaving) + of_factors / leaving;
            assert!((found - expected).abs() <= most, "{name}: {most}");
        }
        let emitted = light.energy.emitted[GREEN];
        let most = (4.0 * of_rays + of_factors) / emitted;
        let imbalance = light.energy.missing()[GREEN].abs() / emitted;
        println!("{name}: {imbalance:.1e} of the emission is missing, {most:.1e} may be");
        assert!(imbalance <= most, "{name}");
        assert_eq!(chain.made.rows.excessive, 0, "{name}");
    }
}

/// A lamp of 1 x 2 whose lower half is inside of a box: all of it emits, and what is inside meets
/// backs, whether patches are hidden as a whole or in part.
#[test]
fn hidden_parts_of_lamps_emit_onto_backs() {
    let quad = |name: &str, material: &str, corners: [[f64; 3]; 4]| {
        format!("[[surfaces]]\nname = \"{name}\"\nmaterial = \"{material}\"\nquad = {corners:?}\n")
    };
    let sides = cuboid([-0.5, -0.1, -0.1], [0.5, 1.1, 1.0]).into_iter();
    let sides = sides.enumerate().map(|(k, side)| {
        let corners = side.map(|corner| corner.to_array());
        quad(&format!("side-{k}"), "white", corners)
    });
    let lamp = [
        [0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 1.0, 2.0],
        [0.0, 0.0, 2.0],
    ];
    let scene = format!(
        "[materials.white]\nreflectance = 0.5\n\
         [materials.lamp]\nreflectance = 0\nemission = 3\n{}{}",
        sides.collect::<String>(),
        quad("lamp", "lamp", lamp)
    );
    for divisions in [1, 4] {
        let mut project = Project::parse("lamp.toml".as_ref(), &scene).unwrap();
        project.params.discretization.default = Divisions::uniform(divisions);
        let energy = Chain::of(&project).light().energy;
        assert!((energy.emitted[GREEN] - 6.0).abs() < 1e-6, "{energy:?}");
        // Half of it, and shares are known to a percent.
        let to_backs = energy.to_backs[GREEN] / energy.emitted[GREEN];
        println!("{divisions}: {to_backs:.4} to backs");
        assert!((to_backs - 0.5).abs() < 0.02, "{divisions}: {energy:?}");
        assert!(energy.imbalance() < 0.05, "{energy:?}");
    }
}
