//! A scene file as people write it: a scene, and the parameters of all stages.

use crate::error::Error;
use radiosity_form_factors as form_factors;
use radiosity_geometry::{Discretization, Divisions, Shape};
use radiosity_params::{OutOfRange, Parameters};
use radiosity_renderer::ImageParams;
use radiosity_scene::{FileKind, Loaded, MeshFiles, Scene, Tables};
use radiosity_solver as solver;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

/// A scene, and how its file wants it to be computed.
#[derive(Clone, Debug)]
pub struct Project {
    /// The scene.
    pub scene: Scene,
    /// The parameters of the stages.
    pub params: Params,
    /// Notes for the user: what was assumed, left out, or read by an old name.
    pub notes: Vec<String>,
}

/// The parameters of all stages.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Params {
    /// `[discretization]`, and what surfaces say of their own cells.
    pub discretization: Discretization,
    /// `[form_factors]`.
    pub form_factors: form_factors::Params,
    /// `[solver]`.
    pub solver: solver::Params,
    /// `[image]`.
    pub image: ImageParams,
}

/// Keys of surfaces that are parameters of the discretization.
const OF_SURFACES: [&str; 2] = ["divisions", "max_patch_edge"];
/// Tables with a key that has another name now: the table, the old name, and the new one.
const RENAMED: [(&str, &str, &str); 1] = [("solver", "tolerance", "residual")];

/// The tolerance of View3D's scenes: their form factors are what is wanted, and no picture.
const OF_VIEW_FACTORS: f64 = 5e-4;

impl Project {
    /// Reads a scene file, and the mesh files that it names, which are in its folder.
    pub fn open(path: &Path) -> Result<Project, Error> {
        Project::open_with(path, MeshFiles::InFolder)
    }

    /// [`Project::open`] for meshes elsewhere.
    pub fn open_with(path: &Path, mesh_files: MeshFiles) -> Result<Project, Error> {
        let text = radiosity_scene::read(path)?;
        Project::parse_with(path, &text, mesh_files)
    }

    /// The text of a scene file. `path` tells by its ending what kind it is; errors name it.
    pub fn parse(path: &Path, text: &str) -> Result<Project, Error> {
        Project::parse_with(path, text, MeshFiles::InFolder)
    }

    /// [`Project::parse`] for meshes elsewhere.
    pub fn parse_with(path: &Path, text: &str, mesh_files: MeshFiles) -> Result<Project, Error> {
        let Loaded {
            scene,
            mut tables,
            mut notes,
        } = radiosity_scene::parse(path, text, mesh_files)?;
        notes.extend(rename(&mut tables));
        let mut form_factors: form_factors::Params = tables.take("form_factors")?;
        if scene.kind == FileKind::View3D {
            form_factors.tolerance = OF_VIEW_FACTORS;
        }
        let params = Params {
            discretization: discretization(&scene, &mut tables)?,
            form_factors,
            solver: tables.take("solver")?,
            image: tables.take("image")?,
        };
        tables.finish()?;
        Ok(Project {
            scene,
            params,
            notes,
        })
    }
}

impl Params {
    /// Refuses values that the stages cannot use.
    pub fn check(&self) -> Result<(), OutOfRange> {
        self.discretization.check()?;
        self.form_factors.check()?;
        self.solver.check()?;
        self.image.check()
    }
}

fn discretization(scene: &Scene, tables: &mut Tables<'_>) -> Result<Discretization, Error> {
    let shapes = scene.shapes().map(|named| (named.name, named.shape));
    let shapes: BTreeMap<&str, &Shape> = shapes.collect();
    let own = tables.take_of_surfaces(&OF_SURFACES, |name, divisions: &Divisions| {
        let is_good = shapes.get(name).is_none_or(|shape| divisions.suit(shape));
        OutOfRange::unless(
            is_good,
            "divisions",
            "one number, as the surface is made of triangles",
        )
    })?;
    Ok(Discretization {
        default: match scene.kind {
            FileKind::Toml => tables.take("discretization")?,
            // Its surfaces are what view factors are wanted of.
            FileKind::View3D => Divisions::uniform(1),
        },
        surfaces: own.into_iter().collect(),
    })
}

/// Reads old names for one more version, and says so.
fn rename(tables: &mut Tables<'_>) -> Vec<String> {
    let renamed = RENAMED.iter();
    let renamed = renamed.filter(|(table, old, new)| tables.rename(table, old, new));
    let note = |(table, old, new): &(&str, &str, &str)| {
        format!(
            "`{old}` of [{table}] is called `{new}` now: the old name will not be read for long"
        )
    };
    renamed.map(note).collect()
}

#[cfg(test)]
pub(crate) mod tests;
