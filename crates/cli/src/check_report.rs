//! What `check` has found, for people and for scripts.

use crate::lines::{indented, labelled, scene_line};
use radiosity::resources::Needs;
use radiosity::scene::{Light, Scene};
use radiosity::words::{PAIRS, bytes, counted, duration};
use radiosity::{Project, light_export_bytes, matrix_bytes};
use serde::Serialize;

/// What is found; also the object that `--json` prints: fields may be added, but not changed or
/// removed.
#[derive(Serialize)]
pub(super) struct Check {
    /// The scene's name.
    scene: String,
    surfaces: usize,
    patches: usize,
    pairs: u64,
    /// Whether pictures can be made.
    camera: bool,
    /// Names of the other cameras.
    views: Vec<String>,
    /// Names of the lights.
    lights: Vec<String>,
    /// Whether the form factors are cached.
    pub(super) cached: bool,
    /// Of estimating the form factors here, cached or not; absent if the scene does not fit into
    /// memory.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) seconds: Option<f64>,
    memory_bytes: u64,
    /// Of cached form factors.
    disk_bytes: u64,
    export_bytes: Exports,
    /// What is wrong with the scene, or would make better pictures.
    pub(super) notes: Vec<String>,
    #[serde(skip)]
    pub(super) needs: Needs,
}

/// Bytes of files that runs write on request; those of text are at most about as large.
#[derive(Serialize)]
struct Exports {
    form_factors_npy: u64,
    form_factors_csv: u64,
    radiosities_csv: u64,
    /// Of each picture.
    picture_ppm: u64,
}

impl Check {
    /// Without what is known of its patches.
    pub(super) fn counted(project: &Project, needs: &Needs) -> Check {
        let scene = &project.scene;
        let rows = needs.patches as u64;
        let [form_factors_npy, form_factors_csv] = matrix_bytes(rows);
        let image = &project.params.image;
        Check {
            scene: scene.name.clone(),
            surfaces: scene.surfaces.len(),
            patches: needs.patches,
            pairs: needs.pairs,
            camera: scene.first_camera().is_some(),
            views: scene.views.iter().map(|view| view.name.clone()).collect(),
            lights: scene
                .lights
                .iter()
                .map(|light| light.name.clone())
                .collect(),
            cached: false,
            seconds: None,
            memory_bytes: needs.memory,
            disk_bytes: needs.disk,
            export_bytes: Exports {
                form_factors_npy,
                form_factors_csv,
                radiosities_csv: light_export_bytes(rows),
                picture_ppm: 3 * u64::from(image.width) * u64::from(image.height),
            },
            notes: Vec::new(),
            needs: *needs,
        }
    }

    /// The same for people.
    pub(super) fn lines(&self, scene: &Scene) -> Vec<String> {
        let camera = match self.camera {
            true => "",
            false => " (no camera: it cannot be rendered)",
        };
        let time = match (self.cached, self.seconds) {
            (true, _) => "cached, ".to_owned(),
            (false, Some(seconds)) => format!("{}, ", duration(seconds)),
            (false, None) => String::new(),
        };
        let exports = &self.export_bytes;
        let mut lines = vec![
            format!("{}{camera}", scene_line(scene, self.patches)),
            labelled(
                "form factors",
                &format!(
                    "{}: {time}{} of memory, {} of disk",
                    counted(self.pairs as usize, PAIRS),
                    bytes(self.memory_bytes),
                    bytes(self.disk_bytes),
                ),
            ),
            labelled(
                "exports",
                &format!(
                    "form factors {} as .npy, up to {} as .csv; radiosities about {}; pictures \
                     {} each as .ppm",
                    bytes(exports.form_factors_npy),
                    bytes(exports.form_factors_csv),
                    bytes(exports.radiosities_csv),
                    bytes(exports.picture_ppm),
                ),
            ),
        ];
        lines.extend(views_line(scene));
        lines.extend(lights_line(scene));
        lines.extend(self.notes.iter().map(|note| indented(note)));
        lines
    }
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
