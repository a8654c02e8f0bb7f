//! Results as tables.

use radiosity_compare::Cell;
use radiosity_geometry::{Face, Mesh};
use radiosity_reference::CellMean;
use radiosity_scene::Scene;
use radiosity_solver::Solution;

/// The radiosities of all patches as CSV: `surface,ia,ib,B_r,B_g,B_b`, W/m^2.
///
/// Rows are in input order. On surfaces of one face, `ia` and `ib` are the patch's cell
/// ([`radiosity_geometry::Patch::cell`]); on meshes `ia` is the polygon of the mesh file, counted
/// from 0, and `ib` the patch's position in it.
pub fn radiosity_csv(scene: &Scene, mesh: &Mesh, solution: &Solution) -> Vec<u8> {
    let values = |patch: usize| solution.radiosity[patch].map(|b| b.to_string()).to_vec();
    table(scene, mesh, &["B_r", "B_g", "B_b"], values)
}

/// Traced radiosities as CSV: the columns of [`radiosity_csv`] and the standard errors
/// `se_r,se_g,se_b`.
pub fn reference_csv(scene: &Scene, mesh: &Mesh, cells: &[CellMean]) -> Vec<u8> {
    let columns = ["B_r", "B_g", "B_b", "se_r", "se_g", "se_b"];
    table(scene, mesh, &columns, |patch| {
        let cell = &cells[patch];
        let means = cell.radiosity.map(|b| (b as f32).to_string());
        let errors = cell.standard_error.map(|e| format!("{e:.2e}"));
        [means, errors].concat()
    })
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

fn table(
    scene: &Scene,
    mesh: &Mesh,
    columns: &[&str],
    values: impl Fn(usize) -> Vec<String>,
) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let in_memory = "memory takes all bytes";
    let header = ["surface", "ia", "ib"].iter().chain(columns);
    writer.write_record(header).expect(in_memory);
    for (patch, [ia, ib]) in input_order(scene, mesh) {
        let surface = mesh.patches[patch].surface.index();
        let mut record = vec![scene.surfaces[surface].name.clone()];
        record.extend([ia.to_string(), ib.to_string()]);
        record.extend(values(patch));
        writer.write_record(record).expect(in_memory);
    }
    writer.into_inner().expect(in_memory)
}

/// All patches with their two coordinates on the surface, in the order of the input.
fn input_order(scene: &Scene, mesh: &Mesh) -> Vec<(usize, [u32; 2])> {
    let mut faces: Vec<&Face> = mesh.faces.iter().collect();
    // Stable: the two halves of a folded quad keep their order.
    faces.sort_by_key(|face| (face.surface, face.input_index));
    let mut rows: Vec<(usize, [u32; 2])> = Vec::with_capacity(mesh.patches.len());
    let mut previous = None;
    let mut position = 0;
    for face in faces {
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
