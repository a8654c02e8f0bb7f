//! `[[surfaces]]`.
//!
//! Long because: one table of the file, and the checks of all its keys.

use crate::input::MeshFiles;
use crate::material::Material;
use crate::mesh::MeshTable;
use crate::obj;
use crate::source::{Complaint, SceneError, Source};
use crate::values::{Vector, check_name, vector};
use radiosity_geometry::{DVec3, Shape};
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::rc::Rc;
use std::sync::Arc;
use toml::Spanned;

/// A surface.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Its name, unique in the scene.
    pub name: String,
    /// Its geometry.
    pub shape: Shape,
    /// Whether it only stands in the way, and neither emits nor receives.
    pub is_obstruction: bool,
    /// The group of surfaces that it belongs to, by default one of its own: its name.
    pub group: String,
    /// For meshes whose file names several groups, unless the scene file says which group the
    /// surface belongs to: `SURFACE/GROUP`, for each face in input order.
    pub groups_of_faces: Vec<Arc<str>>,
    /// Index into the scene's materials, for each face in input order; just one for a surface
    /// of one face.
    pub materials: Vec<usize>,
    /// For meshes: the polygon of the file that each face is, or is a part of.
    pub polygons: Vec<u32>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SurfaceTable {
    name: Spanned<String>,
    material: Spanned<String>,
    group: Option<Spanned<String>>,
    /// For meshes: from the names of groups and materials in the mesh file.
    #[serde(default)]
    materials: BTreeMap<Spanned<String>, Spanned<String>>,
    parallelogram: Option<Spanned<ParallelogramTable>>,
    triangle: Option<Spanned<Vec<Vector>>>,
    quad: Option<Spanned<Vec<Vector>>>,
    mesh: Option<Spanned<MeshTable>>,
}

/// Its keys; others are for whoever works with the scene.
pub(crate) const KEYS: [&str; 8] = [
    "name",
    "material",
    "group",
    "materials",
    "parallelogram",
    "triangle",
    "quad",
    "mesh",
];

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ParallelogramTable {
    corner: Vector,
    edge_a: Vector,
    edge_b: Vector,
}

/// What surfaces are checked against.
pub(crate) struct SurfaceReader<'a> {
    pub(crate) source: Source<'a>,
    /// Where the scene file is: mesh paths are relative to it.
    pub(crate) folder: &'a Path,
    pub(crate) mesh_files: MeshFiles,
    pub(crate) materials: &'a [Material],
}

/// A shape, and for meshes the group and material names of each face.
pub(crate) struct Geometry {
    pub(crate) shape: Shape,
    pub(crate) span: std::ops::Range<usize>,
    pub(crate) labels: Vec<obj::Label>,
    /// What was left out of it.
    pub(crate) notes: Vec<String>,
}

/// All surfaces.
#[derive(Default)]
pub(crate) struct Surfaces {
    pub(crate) surfaces: Vec<Surface>,
    pub(crate) notes: Vec<String>,
}

impl SurfaceReader<'_> {
    /// Checks all surfaces.
    pub(crate) fn surfaces(
        &self,
        tables: &[Spanned<SurfaceTable>],
    ) -> Result<Surfaces, SceneError> {
        let mut names = BTreeMap::new();
        let mut result = Surfaces::default();
        for table in tables {
            let name = &table.get_ref().name;
            check_name(&self.source, name, "a name")?;
            if names.insert(name.get_ref().clone(), name.span()).is_some() {
                let title = format!("there are two surfaces named `{}`", name.get_ref());
                let complaint = Complaint::new(title, "choose another name");
                return Err(self.source.error(name.span(), &complaint));
            }
            self.add_surface(table, &mut result)?;
        }
        self.check_groups(tables, &result.surfaces)?;
        Ok(result)
    }

    /// A group may have the name of a surface only if that belongs to it.
    fn check_groups(
        &self,
        tables: &[Spanned<SurfaceTable>],
        surfaces: &[Surface],
    ) -> Result<(), SceneError> {
        let group_of: BTreeMap<&str, &str> = surfaces
            .iter()
            .map(|surface| (surface.name.as_str(), surface.group.as_str()))
            .collect();
        for group in tables.iter().filter_map(|t| t.get_ref().group.as_ref()) {
            let name = group.get_ref().as_str();
            if group_of.get(name).is_some_and(|other| *other != name) {
                let title = format!("`{name}` is a group, and a surface of another group");
                let complaint = Complaint::new(title, "choose another name");
                return Err(self.source.error(group.span(), &complaint));
            }
        }
        Ok(())
    }

    fn add_surface(
        &self,
        spanned: &Spanned<SurfaceTable>,
        result: &mut Surfaces,
    ) -> Result<(), SceneError> {
        let table = spanned.get_ref();
        let name = table.name.get_ref();
        let Geometry {
            shape,
            span,
            labels,
            notes,
        } = self.geometry(table)?;
        shape.polygons().map_err(|error| {
            let complaint = Complaint::new(format!("surface `{name}` {error}"), "this shape");
            self.source.error(span, &complaint)
        })?;
        if let Some(group) = &table.group {
            check_name(&self.source, group, "a group")?;
        }
        let (group, groups_of_faces) = match &table.group {
            Some(group) => (group.get_ref(), Vec::new()),
            None => (name, groups_of_faces(name, &labels)),
        };
        result.surfaces.push(Surface {
            name: name.clone(),
            shape,
            is_obstruction: false,
            group: group.clone(),
            groups_of_faces,
            materials: self.materials_of(table, &labels)?,
            polygons: labels.iter().map(|label| label.polygon as u32).collect(),
        });
        let notes = notes.iter().map(|note| format!("surface `{name}`: {note}"));
        result.notes.extend(notes);
        Ok(())
    }

    fn geometry(&self, table: &SurfaceTable) -> Result<Geometry, SceneError> {
        let of_one_face = |shape, span| Geometry {
            shape,
            span,
            labels: Vec::new(),
            notes: Vec::new(),
        };
        match (
            &table.parallelogram,
            &table.triangle,
            &table.quad,
            &table.mesh,
        ) {
            (Some(p), None, None, None) => {
                let shape = Shape::Parallelogram {
                    corner: vector(&self.source, &p.get_ref().corner, "`corner`")?,
                    edge_a: vector(&self.source, &p.get_ref().edge_a, "`edge_a`")?,
                    edge_b: vector(&self.source, &p.get_ref().edge_b, "`edge_b`")?,
                };
                Ok(of_one_face(shape, p.span()))
            }
            (None, Some(corners), None, None) => {
                let shape = Shape::Triangle(self.corners(corners)?);
                Ok(of_one_face(shape, corners.span()))
            }
            (None, None, Some(corners), None) => {
                let shape = Shape::Quad(self.corners(corners)?);
                Ok(of_one_face(shape, corners.span()))
            }
            (None, None, None, Some(mesh)) => self.mesh(mesh.get_ref()),
            _ => {
                let title = format!("surface `{}` needs exactly one shape", table.name.get_ref());
                let label = "one of `parallelogram`, `triangle`, `quad`, `mesh`";
                let complaint = Complaint::new(title, label);
                Err(self.source.error(table.name.span(), &complaint))
            }
        }
    }

    fn corners<const N: usize>(
        &self,
        corners: &Spanned<Vec<Vector>>,
    ) -> Result<[DVec3; N], SceneError> {
        let points: Vec<DVec3> = corners
            .get_ref()
            .iter()
            .map(|corner| vector(&self.source, corner, "a corner"))
            .collect::<Result<_, _>>()?;
        let found = points.len();
        points.try_into().map_err(|_| {
            let title = format!("a shape with {N} corners has {found}");
            let complaint = Complaint::new(title, format!("give {N} points"));
            self.source.error(corners.span(), &complaint)
        })
    }

    /// The material of each face: by its material name in the mesh file, else by its group,
    /// else the surface's own.
    fn materials_of(
        &self,
        table: &SurfaceTable,
        labels: &[obj::Label],
    ) -> Result<Vec<usize>, SceneError> {
        let default = self.material(&table.material)?;
        if let (None, Some((label, _))) = (&table.mesh, table.materials.first_key_value()) {
            let complaint = Complaint::new("`materials` is for meshes alone", "not a mesh")
                .help("use `material`");
            return Err(self.source.error(label.span(), &complaint));
        }
        let mut by_label = BTreeMap::new();
        let names: BTreeSet<&str> = labels.iter().flat_map(obj::Label::names).collect();
        for (label, material) in &table.materials {
            if !names.contains(label.get_ref().as_str()) {
                let title = format!("the mesh has no group or material `{}`", label.get_ref());
                let complaint = Complaint::new(title, "not in the mesh file")
                    .suggest(label.get_ref(), names.iter().copied());
                return Err(self.source.error(label.span(), &complaint));
            }
            by_label.insert(label.get_ref().as_str(), self.material(material)?);
        }
        if labels.is_empty() {
            return Ok(vec![default]);
        }
        let of_face = |label: &obj::Label| {
            let mut named = label.names().filter_map(|name| by_label.get(name));
            named.next().copied().unwrap_or(default)
        };
        Ok(labels.iter().map(of_face).collect())
    }

    fn material(&self, name: &Spanned<String>) -> Result<usize, SceneError> {
        let wanted = name.get_ref();
        let position = self.materials.iter().position(|m| m.name == *wanted);
        position.ok_or_else(|| {
            let known = self.materials.iter().map(|m| m.name.as_str());
            let complaint = Complaint::new(format!("there is no material `{wanted}`"), "unknown")
                .suggest(wanted, known);
            self.source.error(name.span(), &complaint)
        })
    }
}

/// The group of each face of a mesh, if its file names several.
fn groups_of_faces(surface: &str, labels: &[obj::Label]) -> Vec<Arc<str>> {
    let mut groups = BTreeMap::new();
    let of_face = |label: &obj::Label| {
        let full = || Arc::from(format!("{surface}/{}", label.group));
        Arc::clone(groups.entry(Rc::clone(&label.group)).or_insert_with(full))
    };
    let of_faces: Vec<Arc<str>> = labels.iter().map(of_face).collect();
    if groups.len() > 1 {
        of_faces
    } else {
        Vec::new()
    }
}
