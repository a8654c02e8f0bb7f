//! Results as tables.

use radiosity_compare::{Cell, Row, Table};
use radiosity_geometry::{Discretization, Divisions, Face, Mesh};
use radiosity_reference::CellMean;
use radiosity_scene::Scene;

/// The radiosities of all patches.
///
/// Rows are in input order. On surfaces of one face, the cell is the patch's
/// ([`radiosity_geometry::Patch::cell`]); on meshes it is the polygon of the mesh file, counted
/// from 0, and the patch's position in it.
pub fn radiosity_table(scene: &Scene, mesh: &Mesh, radiosity: &[[f32; 3]]) -> Table {
    table(scene, mesh, |patch| (radiosity[patch].map(f64::from), None))
}

/// Traced radiosities, with their standard errors, in the rows of [`radiosity_table`].
pub fn reference_table(scene: &Scene, mesh: &Mesh, cells: &[CellMean]) -> Table {
    let mean = |patch: usize| (cells[patch].radiosity, Some(cells[patch].standard_error));
    table(scene, mesh, mean)
}

/// How finely the patches of a table are cut: as the scene says, or into so many cells along the
/// edges of each surface, whatever divisions it has.
pub fn of_cells(params: &Discretization, counts: Option<(u32, u32)>) -> Discretization {
    match counts {
        Some((a, b)) => Discretization {
            default: Divisions::Count { a, b },
            ..params.by_faces()
        },
        None => params.clone(),
    }
}

/// The patches that the tables of a scene have, in their order.
pub fn cells(scene: &Scene, mesh: &Mesh) -> Vec<Cell> {
    let cell = |(index, cell): (usize, [u32; 2])| {
        let (patch, face) = (&mesh.patches[index], mesh.face_of(index));
        let material = scene.material(face.surface, face.input_index);
        Cell {
            surface: scene.surfaces[patch.surface.index()].name.clone(),
            cell,
            area: patch.area,
            emits: material.emission != [0.0; 3],
        }
    };
    input_order(scene, mesh).into_iter().map(cell).collect()
}

/// A row per patch; `values` are its radiosity and standard error.
fn table(
    scene: &Scene,
    mesh: &Mesh,
    values: impl Fn(usize) -> ([f64; 3], Option<[f64; 3]>),
) -> Table {
    let row = |(position, (patch, cell)): (usize, (usize, [u32; 2]))| {
        let surface = mesh.patches[patch].surface.index();
        let (radiosity, standard_error) = values(patch);
        Row {
            line: position as u64 + 2,
            surface: scene.surfaces[surface].name.clone(),
            cell,
            radiosity,
            standard_error,
        }
    };
    let patches = input_order(scene, mesh).into_iter();
    Table {
        rows: patches.enumerate().map(row).collect(),
    }
}

/// The faces as they were given.
pub(crate) fn faces_in_input_order(mesh: &Mesh) -> Vec<&Face> {
    let mut faces: Vec<&Face> = mesh.faces.iter().collect();
    // Stable: the two halves of a folded quad keep their order.
    faces.sort_by_key(|face| (face.surface, face.input_index));
    faces
}

/// The patch of this place on the surface of this name.
pub fn patch_at(scene: &Scene, mesh: &Mesh, surface: &str, cell: [u32; 2]) -> Option<usize> {
    let is_it = |(patch, place): &(usize, [u32; 2])| {
        let index = mesh.patches[*patch].surface.index();
        *place == cell && scene.surfaces[index].name == surface
    };
    let found = input_order(scene, mesh).into_iter().find(is_it);
    found.map(|(patch, _)| patch)
}

/// All patches with their two coordinates on the surface, in the order of the input.
pub(crate) fn input_order(scene: &Scene, mesh: &Mesh) -> Vec<(usize, [u32; 2])> {
    let mut rows: Vec<(usize, [u32; 2])> = Vec::with_capacity(mesh.patches.len());
    let mut previous = None;
    let mut position = 0;
    for face in faces_in_input_order(mesh) {
        let polygons = &scene.surfaces[face.surface.index()].polygons;
        let polygon = polygons.get(face.input_index as usize).copied();
        if previous.replace((face.surface, polygon)) != Some((face.surface, polygon)) {
            position = 0;
        }
        for patch in face.patches() {
            let on_face = mesh.patches[patch].cell;
            let cell = polygon.map_or(on_face, |polygon| [polygon, position]);
            rows.push((patch, cell));
            position += 1;
        }
    }
    rows
}
