//! Why a scene that is called closed is not: faces that are turned the wrong way, and edges that bound a
//! hole.

mod edges;
mod gaps;
mod turned;

use crate::lines::named;
use crate::rows::RowSummary;
use edges::Edges;
use radiosity_geometry::Mesh;
use radiosity_scene::Scene;
use std::collections::BTreeSet;
use turned::Turned;

/// In a closed scene patches see fronts alone, and what is hidden of them sees backs, as far as that is
/// known. A few rays may meet an edge.
const OPEN: f64 = 0.001;
const TURNED: f64 = 0.02;

/// Whether the patches of a closed scene see what they should not.
pub(crate) fn show_in_rows(rows: &RowSummary) -> bool {
    rows.background > OPEN || rows.exposed_backs > TURNED
}

/// A line for each kind of fault of a scene that is called closed.
pub(crate) fn warnings(scene: &Scene, mesh: &Mesh) -> Vec<String> {
    let edges = Edges::of(mesh);
    let Turned { fewer, either } = Turned::of(mesh, &edges);
    let open = gaps::open(mesh, &edges);
    let told = |faces: &[usize]| (!faces.is_empty()).then(|| named(names(scene, mesh, faces)));
    let faults = [
        told(&fewer).map(|names| {
            format!(
                "{names} face the other way than their neighbours: reverse the order of their corners"
            )
        }),
        told(&either).map(|names| {
            format!(
                "{names} face the other way than their neighbours: reverse the order of the corners of \
                 those that face outwards"
            )
        }),
        told(&open).map(|names| {
            format!(
                "edges of {names} have no neighbour: a surface is missing there, or corners do not meet"
            )
        }),
    ];
    let warning = |why| format!("warning: the scene calls itself closed and is not: {why}");
    faults.into_iter().flatten().map(warning).collect()
}

/// The names of the surfaces that faces belong to.
fn names<'a>(scene: &'a Scene, mesh: &Mesh, faces: &[usize]) -> BTreeSet<&'a str> {
    let surfaces = faces.iter().map(|&face| mesh.faces[face].surface.index());
    surfaces
        .map(|surface| scene.surfaces[surface].name.as_str())
        .collect()
}

#[cfg(test)]
mod tests;
