//! Why a scene that is called closed is not: faces that are turned the wrong way, and edges that
//! bound a hole.

mod edges;
mod gaps;
mod turned;

use crate::face_rays::{cosine_rays, spread};
use crate::row_statistics::RowSummary;
use crate::words::named;
use edges::Edges;
use radiosity_geometry::{FaceId, Mesh, Occluders};
use radiosity_scene::Scene;
use std::collections::BTreeSet;
use turned::Turned;

/// In a closed scene patches see fronts alone, and what is hidden of them sees backs, as far as
/// that is known. A few rays may meet an edge.
const OPEN: f64 = 0.001;
const TURNED: f64 = 0.02;
/// From so many faces rays look around, evenly spread.
const MOST_FACES: usize = 1024;

/// Whether the patches of a closed scene see what they should not.
pub fn show_in_rows(rows: &RowSummary) -> bool {
    rows.background > OPEN || rows.exposed_backs > TURNED
}

/// The same by rays from some of the faces, before there are rows.
pub fn show_in_rays(mesh: &Mesh) -> bool {
    let occluders = Occluders::new(mesh);
    let covered = mesh.covers.covered().iter().map(|covered| covered.face);
    let covered: BTreeSet<FaceId> = covered.collect();
    let ids = (0..mesh.faces.len() as u32).map(FaceId);
    let is_clear = |id: &FaceId| !mesh.faces[id.index()].is_bare() && !covered.contains(id);
    let faces: Vec<FaceId> = ids.filter(is_clear).collect();
    let mut sum = Seen::default();
    for face in spread(&faces, MOST_FACES) {
        let seen = Seen::from(mesh, &occluders, face);
        if !seen.is_hidden() {
            sum.add(&seen);
        }
    }
    let all = f64::from(sum.fronts + sum.backs + sum.nothing);
    f64::from(sum.nothing) > OPEN * all || f64::from(sum.backs) > TURNED * all
}

/// How many rays have met what.
#[derive(Default)]
struct Seen {
    fronts: u32,
    backs: u32,
    nothing: u32,
}

impl Seen {
    fn from(mesh: &Mesh, occluders: &Occluders, face: FaceId) -> Seen {
        let mut seen = Seen::default();
        for ray in cosine_rays(&mesh.faces[face.index()]) {
            let count = match occluders.closest_hit_from(face, &ray) {
                Some(hit) if hit.front => &mut seen.fronts,
                Some(_) => &mut seen.backs,
                None => &mut seen.nothing,
            };
            *count += 1;
        }
        seen
    }

    /// Whether they started inside of something, or right under it: all is backs there.
    fn is_hidden(&self) -> bool {
        self.fronts == 0 && self.nothing == 0
    }

    fn add(&mut self, other: &Seen) {
        self.fronts += other.fronts;
        self.backs += other.backs;
        self.nothing += other.nothing;
    }
}

/// A line for each kind of fault of a scene that is called closed.
pub fn warnings(scene: &Scene, mesh: &Mesh) -> Vec<String> {
    let edges = Edges::of(mesh);
    let Turned { fewer, either } = Turned::of(mesh, &edges);
    let open = gaps::open(mesh, &edges);
    // The names, and the verbs of one surface or of several.
    let told = |faces: &[usize]| {
        let names = names(scene, mesh, faces);
        let is_one = names.len() == 1;
        let verb = if is_one { "faces" } else { "face" };
        let neighbours = if is_one {
            "its neighbours"
        } else {
            "their neighbours"
        };
        (!faces.is_empty()).then(|| (named(names), verb, neighbours))
    };
    let faults = [
        told(&fewer).map(|(names, verb, neighbours)| {
            format!(
                "{names} {verb} the other way than {neighbours}: reverse the order of the corners"
            )
        }),
        told(&either).map(|(names, verb, neighbours)| {
            format!(
                "{names} {verb} the other way than {neighbours}: reverse the order of the corners \
                 of those that face outwards"
            )
        }),
        told(&open).map(|(names, ..)| {
            format!(
                "edges of {names} have no neighbour: a surface is missing there, or corners do \
                 not meet"
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
