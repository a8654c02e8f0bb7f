//! Why pictures are black.

use crate::lines::named;
use crate::pipeline::Pipeline;
use radiosity_geometry::{Backs, Camera, DVec2, Face, FaceId, Mesh, Occluders, Ray};
use radiosity_scene::Scene;
use radiosity_solver::Energy;
use std::collections::BTreeSet;

/// Of the light, where more meets backs it is said.
const MUCH: f64 = 0.5;
/// Of the light, where more leaves the scene it is said.
const NEARLY_ALL: f64 = 0.99;
/// So many faces that emit are looked at, evenly spread.
const MOST_LIGHTS: usize = 64;
/// Rays from each of them.
const RAYS_OF_A_LAMP: u32 = 64;
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;
/// Rays along each edge of a picture.
const RAYS: u32 = 24;

/// What a power balance says of pictures that will be black, or nearly so.
pub(crate) fn light_lines(pipeline: &Pipeline<'_>, energy: &Energy) -> Vec<String> {
    let sum = |of: [f64; 3]| of.iter().sum::<f64>();
    let emitted = sum(energy.emitted);
    if emitted == 0.0 {
        return vec![no_light(pipeline.scene(), pipeline.mesh())];
    }
    let share = |of: [f64; 3]| sum(of) / emitted;
    let (on_backs, out) = (share(energy.to_backs), share(energy.to_background));
    if on_backs > MUCH {
        let lit = lit_backs(pipeline);
        let mend = if lit.is_empty() {
            String::new()
        } else {
            format!(
                "; lamps shine on those of {}: reverse the order of their corners, or that of the lamps'",
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

/// Why there is no light at all.
pub(crate) fn no_light(scene: &Scene, mesh: &Mesh) -> String {
    let is_out = |factor: [f64; 3]| factor == [0.0; 3];
    let is_covered = |face: &Face| {
        let mut covered = mesh.covers.covered().iter();
        covered.any(|of| std::ptr::eq(&mesh.faces[of.face.index()], face))
    };
    let lamps: Vec<&Face> = mesh
        .faces
        .iter()
        .filter(|face| emits(scene, face))
        .collect();
    let why = if lamps.is_empty() {
        "nothing emits light"
    } else if scene.lights.iter().all(|light| is_out(light.dimming())) {
        "all lights are dimmed to nothing"
    } else if lamps.iter().all(|face| is_covered(face)) {
        "other surfaces cover all that emits light"
    } else {
        "nothing is left of the lights as they are dimmed and tinted"
    };
    format!("warning: {why}; pictures will be black")
}

fn emits(scene: &Scene, face: &Face) -> bool {
    let material = scene.material(face.surface, face.input_index);
    material.emission != [0.0; 3] && !face.is_bare()
}

/// The surfaces whose backs light from lamps meets first.
fn lit_backs<'a>(pipeline: &'a Pipeline<'_>) -> BTreeSet<&'a str> {
    let (scene, mesh) = (pipeline.scene(), pipeline.mesh());
    let occluders = Occluders::new(mesh);
    let ids = (0..mesh.faces.len() as u32).map(FaceId);
    let lamps: Vec<FaceId> = ids
        .filter(|id| emits(scene, &mesh.faces[id.index()]))
        .collect();
    let step = lamps.len().div_ceil(MOST_LIGHTS).max(1);
    let mut names = BTreeSet::new();
    for &lamp in lamps.iter().step_by(step) {
        let face = &mesh.faces[lamp.index()];
        let (tangent, bitangent) = face.normal.any_orthonormal_pair();
        for k in 0..RAYS_OF_A_LAMP {
            // A spiral (Vogel 1979) over the disk, and up to the half-sphere: by the cosine.
            let radius = ((f64::from(k) + 0.5) / f64::from(RAYS_OF_A_LAMP)).sqrt();
            let (sin, cos) = (GOLDEN_ANGLE * f64::from(k)).sin_cos();
            let up = (1.0 - radius * radius).sqrt();
            let direction = radius * (cos * tangent + sin * bitangent) + up * face.normal;
            let ray = Ray::new(face.polygon.centroid(), direction);
            if let Some(hit) = occluders.first_from(lamp, &ray).filter(|hit| !hit.front) {
                let surface = mesh.faces[hit.face.index()].surface;
                names.insert(scene.surfaces[surface.index()].name.as_str());
            }
        }
    }
    names
}

/// Why a picture that a camera takes is black.
pub(crate) fn of_picture(pipeline: &Pipeline<'_>, camera: &Camera, size: (u32, u32)) -> String {
    let mesh = pipeline.mesh();
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
                backs.insert(pipeline.scene().surfaces[surface.index()].name.as_str());
            }
            None => {}
        }
    }
    let is_transparent = pipeline.scene().image.backs == Backs::Transparent;
    // Behind backs that are looked through there may be fronts.
    if fronts > 0 || is_transparent && !backs.is_empty() {
        "no light reaches what the camera sees".to_owned()
    } else if backs.is_empty() {
        "the camera sees nothing: move it, or turn it to the scene".to_owned()
    } else {
        format!(
            "the camera sees nothing but backs, of {}: move it to their other side, reverse the order of \
             their corners, or look through them with --backs transparent",
            named(backs)
        )
    }
}
