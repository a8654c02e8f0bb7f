//! `check`.

use super::args::CheckArgs;
use super::site::Site;
use super::terminal::say;
use crate::error::Error;
use crate::lines::{indented, labelled, scene_line};
use radiosity::covers;
use radiosity::geometry::{Divisions, Mesh, count_patches, subdivide};
use radiosity::resources::Needs;
use radiosity::scene::{Light, Scene};
use radiosity::settings::estimator;
use radiosity::words::{bytes, grouped};
use radiosity::{darkness, openings};

/// Each face is a patch.
const UNDIVIDED: Divisions = Divisions::uniform(1);

pub(super) fn run(args: &CheckArgs, site: &Site) -> Result<(), Error> {
    let mut scene = site.load(&args.scene.scene, args.scene.outside)?;
    args.scene.apply(&mut scene);
    let counted = counted_needs(&scene)?;
    let fits = counted.check_memory();
    let faces = match fits {
        Ok(()) => Some(faces_of(&scene)?),
        Err(_) => None,
    };
    let needs = match &faces {
        Some(mesh) => needs_of(&scene, counted.patches, mesh.faces.len()),
        None => counted,
    };
    for line in check_lines(&scene, &needs, faces.as_ref()) {
        say(&line)?;
    }
    Ok(fits.and(needs.check_memory())?)
}

/// What `check` says; of the faces of a scene that fits into memory.
fn check_lines(scene: &Scene, needs: &Needs, faces: Option<&Mesh>) -> Vec<String> {
    let camera = if scene.first_camera().is_some() {
        ""
    } else {
        " (no camera: it cannot be rendered)"
    };
    let mut lines = vec![
        format!("{}{camera}", scene_line(scene, needs.patches)),
        format!(
            "{:<14}{} pairs: {} of memory, {} of disk",
            "form factors",
            grouped(needs.pairs),
            bytes(needs.memory),
            bytes(needs.disk),
        ),
    ];
    lines.extend(views_line(scene));
    lines.extend(lights_line(scene));
    if let Some(faces) = faces {
        lines.extend(notes(scene, faces).iter().map(|note| indented(note)));
    }
    lines
}

/// What other commands say of surfaces that lie on others, of scenes without light, and of closed ones that
/// are not: known from the faces alone, however they are cut.
fn notes(scene: &Scene, faces: &Mesh) -> Vec<String> {
    let mut notes = covers::notes(scene, faces);
    // Scenes for form factors alone have neither.
    if scene.first_camera().is_some() || !scene.lights.is_empty() {
        notes.extend(darkness::of_scene(scene, faces));
    }
    if scene.closed && openings::show_in_rays(faces) {
        notes.extend(openings::warnings(scene, faces));
    }
    notes
}

/// The cameras beside the first one.
fn views_line(scene: &Scene) -> Option<String> {
    let names: Vec<&str> = scene.views.iter().map(|view| view.name.as_str()).collect();
    (!names.is_empty()).then(|| labelled("views", &names.join(", ")))
}

/// The lights that can be dimmed, each with its factors if they are not 1.
fn lights_line(scene: &Scene) -> Option<String> {
    let light = |light: &Light| match light.dimming() {
        [1.0, 1.0, 1.0] => light.name.clone(),
        [r, g, b] => format!("{} (times {r} {g} {b})", light.name),
    };
    let lights: Vec<String> = scene.lights.iter().map(light).collect();
    (!lights.is_empty()).then(|| labelled("lights", &lights.join(", ")))
}

/// What computing the scene would take, by its numbers of patches: without faces that only stand in the way,
/// but nothing is made for it.
fn counted_needs(scene: &Scene) -> Result<Needs, Error> {
    let of_mesh = |error| radiosity::Error::of_mesh(scene, &error);
    let patches = count_patches(&scene.geometry, scene.divisions).map_err(of_mesh)?;
    let faces = count_patches(&scene.undivided(), UNDIVIDED).map_err(of_mesh)?;
    Ok(needs_of(scene, patches, faces))
}

fn needs_of(scene: &Scene, patches: usize, faces: usize) -> Needs {
    Needs::of(patches, faces, estimator(scene)).with_closure(scene.form_factors.closure)
}

/// The faces of a scene, uncut.
fn faces_of(scene: &Scene) -> Result<Mesh, Error> {
    let of_mesh = |error| radiosity::Error::of_mesh(scene, &error);
    Ok(subdivide(&scene.undivided(), UNDIVIDED).map_err(of_mesh)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square under a hundred obstructions.
    #[test]
    fn what_only_stands_in_the_way_takes_memory_too() {
        let square = "V 1 0 0 0\nV 2 1 0 0\nV 3 1 1 0\nV 4 0 1 0\nS 1 1 2 3 4 0 0 0.9 floor\n";
        let mut text = format!("F 3\n{square}");
        for k in 1..=100 {
            let first = 4 * k;
            for (n, (x, y)) in [(0, 0), (1, 0), (1, 1), (0, 1)].into_iter().enumerate() {
                text += &format!("V {} {x} {y} {k}\n", first + n + 1);
            }
            let [a, b, c, d] = [1, 2, 3, 4].map(|n| first + n);
            text += &format!("O {} {a} {b} {c} {d} 0 0 0.9 plate\n", k + 1);
        }
        let scene = radiosity::scene::parse("plates.vs3".as_ref(), &text).unwrap();
        let counted = counted_needs(&scene).unwrap();
        let faces = faces_of(&scene).unwrap().faces.len();
        assert_eq!((counted.patches, faces), (1, 101));
        let told = needs_of(&scene, counted.patches, faces);
        let mesh = subdivide(&scene.geometry, scene.divisions).unwrap();
        let run = Needs::of(mesh.patches.len(), mesh.faces.len(), estimator(&scene));
        assert_eq!(told.memory, run.memory);
    }
}
