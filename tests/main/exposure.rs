//! Pictures for people: how bright they are, and that the edges of lamps are smooth.

use radiosity::geometry::{Camera, Divisions};
use radiosity::image::{Image, LUMINANCE};
use radiosity::params::NumberOrWord;
use radiosity::renderer::{ImageParams, Shading};
use radiosity::stages::PatchLight;
use radiosity::{Project, expose, render};
use radiosity_tests::{Chain, shipped};

/// What the scene's camera sees of a small picture, and how it is shown.
struct Shot {
    chain: Chain,
    camera: Camera,
    light: PatchLight,
    image: ImageParams,
}

impl Shot {
    fn of(project: &Project) -> Shot {
        Shot::exposed_for(project, Shading::Smooth)
    }

    fn exposed_for(project: &Project, shading: Shading) -> Shot {
        let chain = Chain::of(project);
        let (camera, light) = (project.scene.camera.unwrap(), chain.light());
        let params = &project.params.image;
        let image = expose(chain.patches, &light, &[camera], params, &[shading]);
        Shot {
            chain,
            camera,
            light,
            image,
        }
    }

    fn exposure(&self) -> f64 {
        self.image.exposure.number().unwrap()
    }

    fn picture(&self, params: &ImageParams) -> Image {
        let shadings = [Shading::Exact];
        let pictures = render(
            self.chain.patches,
            &self.light,
            &self.camera,
            params,
            &shadings,
        );
        pictures.unwrap().swap_remove(0)
    }
}

fn small(name: &str) -> Project {
    let mut project = shipped(name);
    project.params.discretization.default = Divisions::uniform(4);
    (project.params.image.width, project.params.image.height) = (160, 120);
    project
}

/// The exposure is that of what the lamp lights, not of the lamp.
#[test]
fn lamps_do_not_count() {
    let mut project = small("cornell");
    let ordinary = Shot::of(&project).exposure();
    let mut materials = project.scene.materials.iter_mut();
    let lamp = materials.find(|material| material.name == "lamp");
    lamp.unwrap().emission = [24.0; 3];
    let shot = Shot::of(&project);
    // Twice the light, half the exposure, but for the rounding to three digits.
    assert!((2.0 * shot.exposure() / ordinary - 1.0).abs() < 0.01);
    let picture = shot.picture(&shot.image.linear()).weighted(LUMINANCE);
    let lit = picture.values.iter().filter(|value| **value > 0.0);
    let bright = lit
        .clone()
        .filter(|&&value| shot.exposure() * f64::from(value) > 0.8);
    let (lit, bright) = (lit.count() as f64, bright.count() as f64);
    // The lamp, and about two percent of the rest.
    assert!((0.005..0.05).contains(&(bright / lit)), "{bright} of {lit}");
}

/// Where everything emits, there is nothing else to go by.
#[test]
fn rooms_of_lamps_are_shown_too() {
    let shot = Shot::of(&small("furnace"));
    // The radiance is B / pi with B = E / (1 - rho) = [1.25, 2, 5] W/m^2.
    let luminance: f64 = LUMINANCE
        .iter()
        .zip([1.25, 2.0, 5.0])
        .map(|(w, b)| w * b)
        .sum();
    let expected = 0.8 * std::f64::consts::PI / luminance;
    assert!(
        (shot.exposure() / expected - 1.0).abs() < 0.01,
        "{}",
        shot.exposure()
    );
}

/// No mean of clamped samples is brighter than white, and what shows nothing brighter is as it is.
#[test]
fn samples_are_clamped_before_they_are_averaged() {
    let mut project = small("cornell");
    let shot = Shot::of(&project);
    let white = (1.0 / shot.exposure()) as f32;
    let [clamped, linear] = [shot.image, shot.image.linear()].map(|params| shot.picture(&params));
    let brightest = |image: &Image| {
        image
            .pixels
            .as_flattened()
            .iter()
            .copied()
            .fold(0.0, f32::max)
    };
    assert!(brightest(&clamped) <= white * (1.0 + 1e-6));
    assert!(brightest(&linear) > 10.0 * white);
    let mut at_edges = 0;
    for (clamped, linear) in clamped.pixels.iter().zip(&linear.pixels) {
        for c in 0..3 {
            assert!(clamped[c] <= linear[c] * (1.0 + 1e-6));
            at_edges += usize::from(linear[c] > white && clamped[c] < 0.95 * white);
        }
    }
    // The lamp's edges, which were white all over.
    assert!(at_edges > 30, "{at_edges}");
    project.params.image.clamp_samples = false;
    let course = Shot::of(&project);
    assert_eq!(course.picture(&course.image), linear);
}

/// A wall of one patch hides where it is bright, and an exact picture shows it.
#[test]
fn exact_pictures_of_large_patches_are_not_burnt() {
    let mut project = small("cornell");
    project.params.discretization.default = Divisions::uniform(1);
    let share_below = |shading: Shading| {
        let shot = Shot::exposed_for(&project, shading);
        let picture = shot.picture(&shot.image.linear());
        let luminance = |pixel: &[f32; 3]| -> f64 {
            let channels = pixel.iter().zip(LUMINANCE);
            channels.map(|(c, weight)| f64::from(*c) * weight).sum()
        };
        let lit = picture.pixels.iter().map(luminance).filter(|y| *y > 0.0);
        let lit: Vec<f64> = lit.collect();
        let below = lit.iter().filter(|y| *y * shot.exposure() < 0.8);
        below.count() as f64 / lit.len() as f64
    };
    let (exact, by_patches) = (share_below(Shading::Exact), share_below(Shading::Constant));
    println!("below 0.8: {exact:.3}, measured by patches {by_patches:.3}");
    // 98 %, of which the lamp takes 1 %, and the exposure is measured on fewer pixels.
    assert!(exact > 0.96 && by_patches < 0.95);
}
