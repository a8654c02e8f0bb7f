//! Results as tables.

use radiosity_geometry::{Face, Mesh};
use radiosity_scene::Scene;
use radiosity_solver::Solution;

/// The radiosities of all patches as CSV: `surface,ia,ib,B_r,B_g,B_b`, W/m^2.
///
/// Rows are in input order. On surfaces of one face, `ia` and `ib` are the patch's cell
/// ([`radiosity_geometry::Patch::cell`]); on meshes `ia` is the polygon of the mesh file, counted
/// from 0, and `ib` the patch's position in it.
pub fn radiosity_csv(scene: &Scene, mesh: &Mesh, solution: &Solution) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let in_memory = "memory takes all bytes";
    writer
        .write_record(["surface", "ia", "ib", "B_r", "B_g", "B_b"])
        .expect(in_memory);
    for (patch, [ia, ib]) in input_order(scene, mesh) {
        let surface = mesh.patches[patch].surface.index();
        let [r, g, b] = solution.radiosity[patch].map(|channel| channel.to_string());
        let (ia, ib) = (ia.to_string(), ib.to_string());
        writer
            .write_record([scene.surfaces[surface].name.as_str(), &ia, &ib, &r, &g, &b])
            .expect(in_memory);
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
