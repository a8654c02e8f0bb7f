//! A scene with a cache of its own, and what runs take from it.

use radiosity::cache::Store;
use radiosity::geometry::Divisions;
use radiosity::image::Image;
use radiosity::solver::Solution;
use radiosity::{Context, Origin, Project, Silent, estimate, render, solve, subdivide};
use radiosity_tests::{BOTH, shipped};
use std::fs;
use std::path::PathBuf;
use tempfile::TempDir;

/// A scene with a cache folder of its own.
pub(super) struct Bench {
    pub(super) folder: TempDir,
    pub(super) project: Project,
}

/// What came of a run.
pub(super) struct Outcome {
    pub(super) solution: Solution,
    pub(super) origin: Origin,
    pub(super) form_factors: Origin,
    pub(super) pictures: Vec<Image>,
}

impl Outcome {
    pub(super) fn of(project: &Project, cache: Option<&Store>) -> Outcome {
        Outcome::in_context(project, Context::new(cache, &Silent))
    }

    pub(super) fn in_context(project: &Project, context: Context<'_>) -> Outcome {
        let Project { scene, params, .. } = project;
        let patches = subdivide(scene, &params.discretization, context).unwrap();
        let factors = estimate(&patches, &params.form_factors).unwrap();
        let solved = solve(&factors, &params.solver).unwrap();
        let (light, camera) = (solved.light().unwrap(), scene.camera.unwrap());
        Outcome {
            pictures: render(&patches, &light, &camera, &params.image, &BOTH).unwrap(),
            solution: solved.solution,
            origin: solved.origin,
            form_factors: solved.form_factors,
        }
    }
}

/// Why form factors and solution were computed; `None` where they were not.
pub(super) type Reasons = (Option<String>, Option<String>);

impl Bench {
    /// With everything cached.
    pub(super) fn warm() -> Bench {
        let mut project = shipped("cornell-course");
        project.params.discretization.default = Divisions::uniform(3);
        let bench = Bench {
            folder: TempDir::new().unwrap(),
            project,
        };
        bench.solve();
        bench
    }

    pub(super) fn store(&self) -> Store {
        Store::new(self.folder.path())
    }

    pub(super) fn solve(&self) -> Outcome {
        self.solve_project(&self.project)
    }

    pub(super) fn solve_project(&self, project: &Project) -> Outcome {
        Outcome::of(project, Some(&self.store()))
    }

    pub(super) fn reasons(&self) -> Reasons {
        self.reasons_as(&self.project.scene.name)
    }

    /// With the scene under this name.
    pub(super) fn reasons_as(&self, name: &str) -> Reasons {
        let mut project = self.project.clone();
        project.scene.name = name.to_owned();
        let solved = self.solve_project(&project);
        (
            solved.form_factors.reason().map(str::to_owned),
            solved.origin.reason().map(str::to_owned),
        )
    }

    /// The reasons after a change.
    pub(super) fn after(change: impl FnOnce(&mut Project)) -> Reasons {
        let mut bench = Bench::warm();
        change(&mut bench.project);
        bench.reasons()
    }

    /// The only cached file of a stage.
    pub(super) fn file(&self, stage: &str) -> PathBuf {
        let entries = self.store().list().unwrap().into_iter();
        let name = |path: &PathBuf| path.file_name().unwrap().to_str().unwrap().to_owned();
        let mut files = entries.map(|entry| entry.path);
        let is_it = |path: &PathBuf| name(path).starts_with(&format!("{stage}-"));
        files.find(is_it).unwrap()
    }

    pub(super) fn damage(&self, stage: &str, change: impl FnOnce(&mut Vec<u8>)) {
        let path = self.file(stage);
        let mut bytes = fs::read(&path).unwrap();
        change(&mut bytes);
        fs::write(path, bytes).unwrap();
    }
}

pub(super) fn none() -> Reasons {
    (None, None)
}

pub(super) fn changed_solution() -> Reasons {
    (None, Some("nothing cached for these inputs".to_owned()))
}

pub(super) fn changed_both() -> Reasons {
    let changed = Some("nothing cached for these inputs".to_owned());
    (changed.clone(), changed)
}
