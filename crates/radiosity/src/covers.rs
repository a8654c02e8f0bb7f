//! What is said of surfaces that lie on others.

use radiosity_form_factors::Mode;
use radiosity_geometry::Mesh;
use radiosity_scene::Scene;
use std::collections::BTreeSet;

/// So many pairs of surfaces are told one by one.
const MOST_TOLD: usize = 8;

/// A line for each pair of surfaces of which one lies on the other: in its plane, facing the same
/// way.
pub fn notes(scene: &Scene, mesh: &Mesh, mode: Mode) -> Vec<String> {
    let surface = |face: usize| mesh.faces[face].surface.index();
    let covered = mesh.covers.covered().iter();
    let pairs = covered.flat_map(|covered| {
        let below = surface(covered.face.index());
        let above = covered.by.iter();
        above.map(move |face| [below, surface(face.index())])
    });
    let pairs: BTreeSet<[usize; 2]> = pairs.collect();
    let line = |&pair: &[usize; 2]| {
        let [below, above] = pair.map(|surface| scene.surfaces[surface].name.as_str());
        let place = if below == above {
            format!("faces of `{above}` lie on others of it, in one plane and facing the same way")
        } else {
            format!("`{above}` lies on `{below}`, in one plane and facing the same way")
        };
        match mode {
            Mode::Accurate => format!("note: {place}; what is below exchanges no light"),
            Mode::Regular | Mode::MonteCarlo => format!(
                "warning: {place}; both exchange light there, and rows sum to more than 1 (the \
                 accurate mode leaves out what is below)"
            ),
        }
    };
    let mut lines: Vec<String> = pairs.iter().take(MOST_TOLD).map(line).collect();
    if pairs.len() > MOST_TOLD {
        lines.push(format!(
            "note: so do surfaces of {} more pairs",
            pairs.len() - MOST_TOLD
        ));
    }
    lines
}
