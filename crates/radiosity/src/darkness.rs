//! Why pictures are black.

use crate::energy::Energy;
use crate::face_rays::{cosine_rays, spread};
use crate::stages::{Dimming, Patches};
use crate::words::named;
use radiosity_form_factors::Mode;
use radiosity_geometry::{Backs, Camera, DVec2, Face, FaceId, Mesh, Occluders, Patch, Ray};
use radiosity_renderer::ImageParams;
use radiosity_scene::{Light, Scene};
use std::collections::BTreeSet;

/// Of the light, where more meets backs it is said.
const MUCH: f64 = 0.5;
/// Of the light, where more leaves the scene it is said.
const NEARLY_ALL: f64 = 0.99;
/// So many faces that emit are looked at, evenly spread.
const MOST_LIGHTS: usize = 64;
/// Rays along each edge of a picture.
const RAYS: u32 = 24;

/// What a power balance says of pictures that will be black, or nearly so.
pub fn light_lines(patches: &Patches<'_>, dimming: &Dimming, energy: &Energy) -> Vec<String> {
    let sum = |of: [f64; 3]| of.iter().sum::<f64>();
    let emitted = sum(energy.emitted);
    if emitted == 0.0 {
        return vec![no_light(patches.scene(), &patches.mesh, dimming)];
    }
    let share = |of: [f64; 3]| sum(of) / emitted;
    let (on_backs, out) = (share(energy.to_backs), share(energy.to_background));
    if on_backs > MUCH {
        let lit = lit_backs(patches);
        let mend = if lit.is_empty() {
            String::new()
        } else {
            format!(
                "; lamps shine on those of {}: flip these faces, or the lamps (reverse the order \
                 of their corners)",
                named(lit)
            )
        };
        return vec![format!(
            "warning: {:.0} % of the light meets backs of surfaces, which reflect nothing{mend}",
            100.0 * on_backs
        )];
    }
    let is_lost = out > NEARLY_ALL;
    let warning = format!(
        "warning: {:.0} % of the light leaves the scene: lamps may face outwards",
        100.0 * out
    );
    is_lost.then_some(warning).into_iter().collect()
}

/// Why there is no light at all, if there is none: known without radiosities.
pub fn of_scene(scene: &Scene, mesh: &Mesh, mode: Mode) -> Option<String> {
    let dimming = Dimming::of(scene);
    // Only the accurate mode heeds what covers lamps.
    let is_covered = |face: &Face| mode == Mode::Accurate && is_covered(mesh, face);
    let shines = |face: &Face| is_lit(scene, &dimming, face) && !is_covered(face);
    let is_dark = !mesh.faces.iter().any(shines);
    is_dark.then(|| no_light(scene, mesh, &dimming))
}

/// Why there is no light at all.
fn no_light(scene: &Scene, mesh: &Mesh, dimming: &Dimming) -> String {
    let is_out = |light: &Light| light.dimming() == [0.0; 3];
    let mut faces = mesh.faces.iter();
    let why = if !faces.clone().any(|face| emits(scene, face)) {
        "nothing emits light"
    } else if dimming.lights().iter().all(is_out) {
        "all lights are dimmed to nothing"
    } else if faces.any(|face| is_lit(scene, dimming, face)) {
        "other surfaces cover all that emits light"
    } else {
        "nothing is left of the lights as they are dimmed and tinted"
    };
    format!("warning: {why}; pictures will be black")
}

/// Whether a face emits with its light undimmed.
fn emits(scene: &Scene, face: &Face) -> bool {
    let material = scene.material(face.surface, face.input_index);
    material.emission != [0.0; 3] && !face.is_bare()
}

/// Whether it emits with its light dimmed.
fn is_lit(scene: &Scene, dimming: &Dimming, face: &Face) -> bool {
    let material = scene.material(face.surface, face.input_index);
    material.dimmed_emission(dimming.lights()) != [0.0; 3] && !face.is_bare()
}

/// Whether other faces lie on all of a face, and so take its light.
fn is_covered(mesh: &Mesh, face: &Face) -> bool {
    let is_free = |patch: &Patch| match mesh.covers.free_part(&mesh.faces, patch) {
        Some(pieces) => !pieces.is_empty(),
        None => true,
    };
    !mesh.patches[face.patches()].iter().any(is_free)
}

/// The surfaces whose backs light from lamps meets first.
fn lit_backs<'a>(patches: &Patches<'a>) -> BTreeSet<&'a str> {
    let (scene, mesh) = (patches.scene(), &patches.mesh);
    let occluders = Occluders::new(mesh);
    let ids = (0..mesh.faces.len() as u32).map(FaceId);
    let lamps: Vec<FaceId> = ids
        .filter(|id| emits(scene, &mesh.faces[id.index()]))
        .collect();
    let mut names = BTreeSet::new();
    for lamp in spread(&lamps, MOST_LIGHTS) {
        for ray in cosine_rays(&mesh.faces[lamp.index()]) {
            if let Some(hit) = occluders
                .closest_hit_from(lamp, &ray)
                .filter(|hit| !hit.front)
            {
                let surface = mesh.faces[hit.face.index()].surface;
                names.insert(scene.surfaces[surface.index()].name.as_str());
            }
        }
    }
    names
}

/// Why a picture that a camera takes is black.
pub fn of_picture(patches: &Patches<'_>, camera: &Camera, params: &ImageParams) -> String {
    let (mesh, size) = (&patches.mesh, (params.width, params.height));
    let occluders = Occluders::new(mesh);
    let [origin, across, down] = camera.film(size.0, size.1);
    let (mut fronts, mut backs) = (0, BTreeSet::new());
    for (i, j) in (0..RAYS).flat_map(|i| (0..RAYS).map(move |j| (i, j))) {
        let share = |k: u32| (f64::from(k) + 0.5) / f64::from(RAYS);
        let place = DVec2::new(share(i) * f64::from(size.0), share(j) * f64::from(size.1));
        let direction = origin + place.x * across + place.y * down;
        let ray = Ray::new(camera.position(), direction);
        match occluders.closest_hit(&ray, camera.near(), f64::INFINITY, None) {
            Some(hit) if hit.front => fronts += 1,
            Some(hit) => {
                let surface = mesh.faces[hit.face.index()].surface;
                backs.insert(patches.scene().surfaces[surface.index()].name.as_str());
            }
            None => {}
        }
    }
    let is_transparent = params.backs == Backs::Transparent;
    // Behind backs that are looked through there may be fronts.
    if fronts > 0 || is_transparent && !backs.is_empty() {
        "no light reaches what the camera sees".to_owned()
    } else if backs.is_empty() {
        "the camera sees nothing: move it, or turn it to the scene".to_owned()
    } else {
        format!(
            "the camera sees only backs, of {}: move the camera to the other side, flip these \
             faces (reverse the order of their corners), or let backs be transparent",
            named(backs)
        )
    }
}
