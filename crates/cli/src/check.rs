//! `check`.

use super::args::CheckArgs;
use super::estimate_args::OutputArgs;
use super::run::with_threads;
use super::site::Site;
use super::terminal::{Terminal, say_json};
use crate::error::Error;
use crate::lines::{indented, labelled, scene_line};
use radiosity::advice;
use radiosity::covers;
use radiosity::geometry::{Discretization, Mesh, count_patches};
use radiosity::resources::Needs;
use radiosity::scene::{Light, Scene};
use radiosity::words::{bytes, duration, grouped};
use radiosity::{
    Context, Project, darkness, estimate, light_table_bytes, matrix_bytes, openings, subdivide,
};
use serde::Serialize;

pub(super) fn run(args: &CheckArgs, site: &Site) -> Result<(), Error> {
    let mut project = args.scene.load(site)?;
    args.factors.apply(&mut project.params.form_factors);
    project.params.check().map_err(radiosity::Error::from)?;
    with_threads(args.threads, || {
        let counted = counted_needs(&project)?;
        let fits = counted.check_memory();
        let check = match fits {
            Ok(()) => Check::of(&project, counted.patches)?,
            Err(_) => Check::too_large(&project, &counted),
        };
        let terminal = Terminal::new(OutputArgs {
            json: args.json,
            verbose: false,
        });
        check
            .lines(&project.scene)
            .iter()
            .for_each(|line| terminal.line(line));
        if args.json {
            say_json(&check)?;
        }
        terminal.finish()?;
        Ok(fits.and(check.needs.check_memory())?)
    })
}

/// What is found; also the object that `--json` prints: fields may be added, but not changed or
/// removed.
#[derive(Serialize)]
struct Check {
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
    /// Of estimating the form factors here; absent if the scene does not fit into memory.
    #[serde(skip_serializing_if = "Option::is_none")]
    seconds: Option<f64>,
    memory_bytes: u64,
    /// Of cached form factors.
    disk_bytes: u64,
    export_bytes: Exports,
    /// What is wrong with the scene, or would make better pictures.
    notes: Vec<String>,
    #[serde(skip)]
    needs: Needs,
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
    /// Of a scene that fits into memory.
    fn of(project: &Project, patches: usize) -> Result<Check, Error> {
        let faces = faces_of(project)?;
        let needs = needs_of(project, patches, faces.faces.len());
        let params = &project.params;
        let patches = subdivide(&project.scene, &params.discretization, Context::default())?;
        let factors = estimate(&patches, &params.form_factors)?;
        let advice = advice::notes(&project.scene, &patches.mesh);
        Ok(Check {
            seconds: Some(factors.forecast()),
            notes: notes(project, &faces).into_iter().chain(advice).collect(),
            ..Check::too_large(project, &needs)
        })
    }

    fn too_large(project: &Project, needs: &Needs) -> Check {
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
            seconds: None,
            memory_bytes: needs.memory,
            disk_bytes: needs.disk,
            export_bytes: Exports {
                form_factors_npy,
                form_factors_csv,
                radiosities_csv: light_table_bytes(rows),
                picture_ppm: 3 * u64::from(image.width) * u64::from(image.height),
            },
            notes: Vec::new(),
            needs: *needs,
        }
    }

    /// The same for people.
    fn lines(&self, scene: &Scene) -> Vec<String> {
        let camera = match self.camera {
            true => "",
            false => " (no camera: it cannot be rendered)",
        };
        let time = self
            .seconds
            .map(|seconds| format!("{}, ", duration(seconds)));
        let exports = &self.export_bytes;
        let mut lines = vec![
            format!("{}{camera}", scene_line(scene, self.patches)),
            labelled(
                "form factors",
                &format!(
                    "{} pairs of patches: {}{} of memory, {} of disk",
                    grouped(self.pairs),
                    time.unwrap_or_default(),
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

/// What other commands say of surfaces that lie on others, of scenes without light, and of closed
/// ones that are not: known from the faces alone, however they are cut.
fn notes(project: &Project, faces: &Mesh) -> Vec<String> {
    let (scene, mode) = (&project.scene, project.params.form_factors.mode);
    let mut notes = covers::notes(scene, faces, mode);
    // Scenes for form factors alone have neither.
    if scene.first_camera().is_some() || !scene.lights.is_empty() {
        notes.extend(darkness::of_scene(scene, faces, mode));
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

/// What computing the scene would take, by its numbers of patches: without faces that only stand in
/// the way, but nothing is made for it.
fn counted_needs(project: &Project) -> Result<Needs, Error> {
    let params = &project.params.discretization;
    let count = |params: &Discretization| {
        let counted = count_patches(&params.of_shapes(project.scene.shapes()), params.default);
        counted.map_err(|error| radiosity::Error::of_mesh(&project.scene, params, &error))
    };
    let (patches, faces) = (count(params)?, count(&params.by_faces())?);
    Ok(needs_of(project, patches, faces))
}

fn needs_of(project: &Project, patches: usize, faces: usize) -> Needs {
    let params = &project.params.form_factors;
    Needs::of(patches, faces, params.estimator()).with_closure(params.closure)
}

/// The faces of a scene, uncut.
fn faces_of(project: &Project) -> Result<Mesh, Error> {
    let by_faces = project.params.discretization.by_faces();
    Ok(subdivide(&project.scene, &by_faces, Context::default())?.mesh)
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
        let project = Project::parse("plates.vs3".as_ref(), &text).unwrap();
        let counted = counted_needs(&project).unwrap();
        let faces = faces_of(&project).unwrap().faces.len();
        assert_eq!((counted.patches, faces), (1, 101));
        let told = needs_of(&project, counted.patches, faces);
        let params = &project.params;
        let context = Context::default();
        let patches = subdivide(&project.scene, &params.discretization, context).unwrap();
        let mesh = &patches.mesh;
        let estimator = params.form_factors.estimator();
        let run = Needs::of(mesh.patches.len(), mesh.faces.len(), estimator);
        assert_eq!(told.memory, run.memory);
    }
}
