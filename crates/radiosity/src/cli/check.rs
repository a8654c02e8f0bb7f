//! `check`.

use super::args::CheckArgs;
use super::site::Site;
use super::terminal::say;
use crate::error::Error;
use crate::lines::{indented, labelled, scene_line};
use crate::resources::{Needs, bytes, grouped};
use crate::settings::estimator;
use radiosity_geometry::{Divisions, count_patches};
use radiosity_scene::{Light, Scene};

pub(super) fn run(args: &CheckArgs, site: &Site) -> Result<(), Error> {
    let mut scene = site.load(&args.scene.scene, args.scene.outside)?;
    args.scene.apply(&mut scene);
    let needs = needs_of(&scene)?;
    for line in check_lines(&scene, &needs) {
        say(&line)?;
    }
    needs.check_memory()
}

/// What `check` says.
fn check_lines(scene: &Scene, needs: &Needs) -> Vec<String> {
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
    if scene.first_camera().is_some() && scene.lights.is_empty() {
        lines.push(indented(
            "warning: nothing emits light; pictures will be black",
        ));
    }
    lines
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

/// What computing the scene would take.
fn needs_of(scene: &Scene) -> Result<Needs, Error> {
    let of_mesh = |error| Error::of_mesh(scene, &error);
    let patches = count_patches(&scene.geometry, scene.divisions).map_err(of_mesh)?;
    let faces = count_patches(&scene.undivided(), Divisions::uniform(1)).map_err(of_mesh)?;
    let needs = Needs::of(patches, faces, estimator(scene));
    Ok(needs.with_closure(scene.form_factors.closure))
}
