//! Why pictures are black, and why a scene that is called closed is not.

use crate::pipeline::Pipeline;
use radiosity_geometry::{Camera, DVec2, DVec3, Face, Mesh, Occluders};
use radiosity_scene::Scene;
use radiosity_solver::Energy;
use std::collections::{BTreeSet, HashMap};

/// So many surfaces are named.
const MOST_NAMED: usize = 6;
/// Of the light, where more meets backs it is said.
const MUCH: f64 = 0.5;
/// So many faces that emit are looked at, evenly spread.
const MOST_LIGHTS: usize = 64;
/// Rays along each edge of a picture.
const RAYS: u32 = 24;

/// What a power balance says of pictures that will be black, or nearly so.
pub(crate) fn light_lines(pipeline: &Pipeline<'_>, energy: &Energy) -> Vec<String> {
    let sum = |of: [f64; 3]| of.iter().sum::<f64>();
    let emitted = sum(energy.emitted);
    if emitted == 0.0 {
        return vec![no_light(pipeline.scene())];
    }
    let on_backs = sum(energy.to_backs) / emitted;
    if on_backs <= MUCH {
        return Vec::new();
    }
    let away = turned_away(pipeline);
    let mend = if away.is_empty() {
        String::new()
    } else {
        format!(
            "; {} turn their backs to all that emits: reverse the order of their corners",
            named(away)
        )
    };
    vec![format!(
        "warning: {:.0} % of the light meets backs of surfaces, which reflect nothing{mend}",
        100.0 * on_backs
    )]
}

/// Why there is no light at all.
pub(crate) fn no_light(scene: &Scene) -> String {
    let is_out = |factor: [f64; 3]| factor == [0.0; 3];
    let why = if scene.lights.is_empty() {
        "nothing emits light"
    } else if scene.lights.iter().all(|light| is_out(light.dimming())) {
        "all lights are dimmed to nothing"
    } else {
        "other surfaces cover all that emits light"
    };
    format!("warning: {why}; pictures will be black")
}

/// The surfaces of which no face has its front to anything that emits.
fn turned_away<'a>(pipeline: &'a Pipeline<'_>) -> BTreeSet<&'a str> {
    let (scene, mesh) = (pipeline.scene(), pipeline.mesh());
    let emits = |face: &&Face| {
        let material = scene.material(face.surface, face.input_index);
        material.emission != [0.0; 3]
    };
    let lamps: Vec<&Face> = mesh.faces.iter().filter(emits).collect();
    let step = lamps.len().div_ceil(MOST_LIGHTS).max(1);
    let places: Vec<DVec3> = lamps
        .iter()
        .step_by(step)
        .map(|face| face.polygon.centroid())
        .collect();
    let name = |face: &Face| scene.surfaces[face.surface.index()].name.as_str();
    let sees = |face: &&Face| {
        let from = face.polygon.centroid();
        emits(face)
            || places
                .iter()
                .any(|&place| face.normal.dot(place - from) > 0.0)
    };
    let seeing: BTreeSet<&str> = mesh.faces.iter().filter(sees).map(name).collect();
    let all = mesh.faces.iter().filter(|face| !face.is_bare()).map(name);
    all.filter(|name| !seeing.contains(name)).collect()
}

/// Why a picture that a camera takes is black.
pub(crate) fn of_picture(pipeline: &Pipeline<'_>, camera: &Camera, size: (u32, u32)) -> String {
    let mesh = pipeline.mesh();
    let occluders = Occluders::new(mesh);
    let [origin, across, down] = camera.film(size.0, size.1);
    let (mut fronts, mut backs) = (0, BTreeSet::new());
    let mut rays = (0..RAYS).flat_map(|i| (0..RAYS).map(move |j| (i, j)));
    rays.by_ref().for_each(|(i, j)| {
        let share = |k: u32| (f64::from(k) + 0.5) / f64::from(RAYS);
        let place = DVec2::new(share(i) * f64::from(size.0), share(j) * f64::from(size.1));
        let direction = origin + place.x * across + place.y * down;
        let ray = radiosity_geometry::Ray::new(camera.position(), direction);
        match occluders.closest_hit(&ray, camera.near(), f64::INFINITY, None) {
            Some(hit) if hit.front => fronts += 1,
            Some(hit) => {
                let surface = mesh.faces[hit.face.index()].surface;
                backs.insert(pipeline.scene().surfaces[surface.index()].name.as_str());
            }
            None => {}
        }
    });
    if fronts > 0 {
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

/// What is wrong with a scene that is called closed, and whose patches see backs or nothing.
pub(crate) fn openings(scene: &Scene, mesh: &Mesh) -> Option<String> {
    let mut sides: HashMap<[[u64; 3]; 2], Vec<(usize, bool)>> = HashMap::new();
    for (index, face) in mesh.faces.iter().enumerate() {
        let corners = face.polygon.corners();
        for (k, &from) in corners.iter().enumerate() {
            let ends = [from, corners[(k + 1) % corners.len()]].map(bits);
            let is_forward = ends[0] < ends[1];
            let edge = if is_forward { ends } else { [ends[1], ends[0]] };
            sides.entry(edge).or_default().push((index, is_forward));
        }
    }
    let name = |face: usize| {
        scene.surfaces[mesh.faces[face].surface.index()]
            .name
            .as_str()
    };
    let (mut open, mut against) = (BTreeSet::new(), HashMap::<&str, usize>::new());
    for faces in sides.values() {
        match faces[..] {
            [(face, _)] => {
                open.insert(name(face));
            }
            [(a, of_a), (b, of_b)] if of_a == of_b => {
                for face in [a, b] {
                    *against.entry(name(face)).or_default() += 1;
                }
            }
            _ => {}
        }
    }
    if let Some(most) = against.values().copied().max() {
        let worst = against.iter().filter(|(_, count)| **count == most);
        let worst = worst.map(|(name, _)| *name).collect();
        return Some(format!(
            "{} face the other way than their neighbours: reverse the order of their corners",
            named(worst)
        ));
    }
    (!open.is_empty()).then(|| {
        format!(
            "edges of {} have no neighbour: a surface is missing there, or corners do not meet",
            named(open)
        )
    })
}

fn bits(point: DVec3) -> [u64; 3] {
    // Adding zero makes one zero of both.
    (point + 0.0).to_array().map(f64::to_bits)
}

fn named(names: BTreeSet<&str>) -> String {
    let count = names.len();
    let some: Vec<&str> = names.into_iter().take(MOST_NAMED).collect();
    let more = match count.saturating_sub(MOST_NAMED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    format!("`{}`{more}", some.join("`, `"))
}
