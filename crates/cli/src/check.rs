//! `check`.

use super::args::CheckArgs;
use super::folders::Folders;
use super::run::with_threads;
use super::terminal::{Terminal, say_json};
use crate::check_report::Check;
use crate::error::Error;
use radiosity::advice;
use radiosity::cache::Store;
use radiosity::covers;
use radiosity::geometry::{Discretization, Mesh, count_patches};
use radiosity::resources::Needs;
use radiosity::{Context, Project, darkness, estimate, openings, subdivide};

pub(super) fn run(args: &CheckArgs, folders: &Folders) -> Result<(), Error> {
    let mut project = args.scene.load(folders)?;
    args.factors.apply(&mut project.params.form_factors);
    project.params.check().map_err(radiosity::Error::from)?;
    with_threads(args.threads, || {
        let counted = counted_needs(&project)?;
        let fits = counted.check_memory();
        let check = match fits {
            Ok(()) => found(
                &project,
                counted.patches,
                args.cache.store(folders).as_ref(),
            )?,
            Err(_) => Check::counted(&project, &counted),
        };
        let terminal = Terminal::brief(args.json);
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

/// What is found of a scene that fits into memory.
fn found(project: &Project, patches: usize, cache: Option<&Store>) -> Result<Check, Error> {
    let faces = faces_of(project)?;
    let needs = needs_of(project, patches, faces.faces.len());
    let params = &project.params;
    let context = Context {
        cache,
        ..Context::default()
    };
    let patches = subdivide(&project.scene, &params.discretization, context)?;
    let factors = estimate(&patches, &params.form_factors)?;
    let advice = advice::notes(&project.scene, &patches.mesh);
    let mut check = Check::counted(project, &needs);
    check.cached = factors.are_cached();
    check.seconds = Some(factors.forecast());
    check.notes = notes(project, &faces).into_iter().chain(advice).collect();
    Ok(check)
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
