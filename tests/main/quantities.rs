//! Quantities that pictures show, against each other: what leaves is what is emitted and what is
//! reflected of what arrives.

use radiosity::Project;
use radiosity::form_factors::Mode;
use radiosity::image::Image;
use radiosity::renderer::Shading;
use radiosity::stages::{PatchLight, Quantity, render_by, show};
use radiosity_tests::{Chain, shipped};

const ALL: [Shading; 4] = [
    Shading::Constant,
    Shading::Smooth,
    Shading::Exact,
    Shading::Gathered,
];

fn small(name: &str, mode: Mode) -> Project {
    let mut project = shipped(name);
    (project.params.image.width, project.params.image.height) = (40, 30);
    project.params.form_factors.mode = mode;
    project
}

/// The pictures of a quantity by each shading.
fn pictures(chain: Chain, light: &PatchLight, quantity: Quantity) -> Vec<Image> {
    let shown = show(chain.factors, light, quantity).unwrap();
    let (camera, params) = (
        chain.project.scene.camera.unwrap(),
        &chain.project.params.image,
    );
    let renderer = shown.renderer(&chain.patches.mesh, params, &ALL);
    render_by(&renderer, &camera, params, chain.patches.context()).unwrap()
}

/// The largest difference between pixels of an image and what it should be, relative to the mean of
/// that.
fn worst(found: &Image, expected: &Image, of: impl Fn(f32, f32) -> f32) -> f32 {
    let pairs = found
        .pixels
        .as_flattened()
        .iter()
        .zip(expected.pixels.as_flattened());
    let channels = expected.pixels.as_flattened();
    let mean = channels.iter().sum::<f32>() / channels.len() as f32;
    pairs.map(|(a, b)| of(*a, *b).abs()).fold(0.0, f32::max) / mean
}

/// Direct and indirect light are all light, but for rounding. Smooth pictures are kept from
/// swinging beside shadows, each in its own way, and add up within some percent there.
#[test]
fn direct_and_indirect_light_are_all_light() {
    let project = small("cornell", Mode::Accurate);
    let chain = Chain::of(&project);
    let light = chain.light();
    let [all, direct, indirect] = [Quantity::Radiosity, Quantity::Direct, Quantity::Indirect]
        .map(|quantity| pictures(chain, &light, quantity));
    for (k, shading) in ALL.into_iter().enumerate() {
        let mut sum = direct[k].clone();
        let channels = sum.pixels.as_flattened_mut().iter_mut();
        channels
            .zip(indirect[k].pixels.as_flattened())
            .for_each(|(a, b)| *a += b);
        let off = worst(&sum, &all[k], |a, b| a - b);
        println!("{shading:?} {off:.1e}");
        let most = if shading == Shading::Smooth {
            0.2
        } else {
            1e-5
        };
        assert!(off < most, "{shading:?} {off}");
    }
}

/// In a furnace of reflectance rho and emission E as much arrives as leaves: (B - E) / rho = B.
#[test]
fn as_much_arrives_in_a_furnace_as_leaves() {
    let project = small("furnace", Mode::Accurate);
    let chain = Chain::of(&project);
    let light = chain.light();
    let [leaving, arriving] = [Quantity::Radiosity, Quantity::Irradiance]
        .map(|quantity| pictures(chain, &light, quantity));
    for (k, shading) in ALL.into_iter().enumerate() {
        let off = worst(&arriving[k], &leaving[k], |a, b| a - b);
        println!("{shading:?} {off:.1e}");
        // Rows sum to 1 within their errors, which the tolerance bounds on average.
        assert!(off < 5e-4, "{shading:?} {off}");
    }
}

/// Radiosities are those of the elements: of whole patches in the simpler modes, of what can be
/// seen of them in the accurate one, which shines more than the mean of the patch.
#[test]
fn elements_are_whole_patches_or_what_is_visible() {
    for mode in [Mode::Regular, Mode::Accurate] {
        let project = small("cornell", mode);
        let chain = Chain::of(&project);
        let (solved, light) = (chain.solve(), chain.light());
        // The scene's one light is as bright as its material says.
        assert_eq!(light.radiosity, solved.solution.lights[0], "{mode:?}");
        let means = light.mean_radiosity();
        let patches = light.elements.iter().zip(&means).zip(&light.radiosity);
        for ((&share, mean), of_element) in patches {
            let ratio = mean[0] / of_element[0];
            assert!((ratio - share).abs() < 1e-5 || of_element[0] == 0.0);
        }
        let parts = light.elements.iter().filter(|&&share| share < 1.0).count();
        match mode {
            // Six patches over the lamp, and those at the cuboid's foot.
            Mode::Accurate => assert!(parts >= 6, "{parts}"),
            _ => assert_eq!(parts, 0),
        }
    }
}

/// `B = rho H` where nothing is emitted: on the white floor of the room, in all modes, patch by
/// patch.
#[test]
fn patches_reflect_what_arrives() {
    for mode in [Mode::Regular, Mode::Accurate] {
        let project = small("cornell-closed", mode);
        let chain = Chain::of(&project);
        let light = chain.light();
        let [leaving, arriving] = [Quantity::Radiosity, Quantity::Irradiance]
            .map(|quantity| pictures(chain, &light, quantity).swap_remove(0));
        // The middle of the lowest row of pixels shows the floor, which reflects the same of every
        // channel.
        let floor = |image: &Image| Image {
            width: image.width,
            height: 1,
            pixels: image.pixels[image.pixels.len() - 30..][..20].to_vec(),
        };
        let reflectance = project
            .scene
            .materials
            .iter()
            .find(|m| m.name == "white")
            .unwrap();
        let reflectance = reflectance.reflectance[0] as f32;
        let off = worst(&floor(&arriving), &floor(&leaving), |h, b| {
            reflectance * h - b
        });
        println!("{mode:?} {off:.1e}");
        // The solver's residual is 1e-6 of what is emitted, which is not much more than this.
        assert!(off < 1e-4, "{mode:?} {off}");
    }
}
