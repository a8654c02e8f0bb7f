//! What makes a better picture of a scene, where that is sure to be wanted.

use crate::words::grouped;
use radiosity_geometry::Mesh;
use radiosity_scene::Scene;

/// Of all area, where a patch has more, it is told.
const LARGE: f64 = 0.1;
/// About so many patches make a picture of a room.
const ENOUGH: f64 = 2000.0;
/// Scenes of more units across may not be in metres.
const FAR: f64 = 1000.0;

/// Notes on scenes with a camera and a light, each a sentence: of patches that are too large to
/// show how light changes, and of a unit that is none of metres.
pub fn notes(scene: &Scene, mesh: &Mesh) -> Vec<String> {
    if scene.first_camera().is_none() || scene.lights.is_empty() {
        return Vec::new();
    }
    let size = mesh.bounds().extent().max_element();
    let far = (size >= FAR).then(|| {
        format!(
            "note: the scene is {} units across; powers in W need metres: if these are \
             millimetres, divide all lengths by 1,000 (`scale = 0.001` does so for a mesh)",
            grouped(size.round() as u64)
        )
    });
    large_patch(scene, mesh).into_iter().chain(far).collect()
}

fn large_patch(scene: &Scene, mesh: &Mesh) -> Option<String> {
    let total: f64 = mesh.patches.iter().map(|patch| patch.area).sum();
    let patches = mesh.patches.iter();
    let largest = patches.max_by(|a, b| a.area.total_cmp(&b.area))?;
    let share = largest.area / total;
    (share > LARGE).then(|| {
        format!(
            "note: a patch of `{}` is {:.0} % of all area, and each patch has one mean of what \
             it reflects: cut surfaces into smaller ones, as `max_patch_edge = {}` in \
             [discretization] does",
            scene.surfaces[largest.surface.index()].name,
            100.0 * share,
            one_digit((total / ENOUGH).sqrt())
        )
    })
}

/// As people would write it.
fn one_digit(length: f64) -> String {
    let rounded: f64 = format!("{length:.0e}").parse().unwrap_or(length);
    rounded.to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Context, Project, subdivide};

    /// A cube of an edge, whose ceiling shines, cut into n x n patches a wall.
    fn cube(edge: f64, n: u32) -> Vec<String> {
        let wall = |name: &str, material: &str, corners: [[u8; 3]; 4]| {
            let corners = corners.map(|corner| corner.map(|x| edge * f64::from(x)));
            format!(
                "[[surfaces]]\nname = \"{name}\"\nmaterial = \"{material}\"\nquad = {corners:?}\n"
            )
        };
        let text = format!(
            "[camera]\nposition = [0.5, 0.5, 0.5]\nlook_at = [0, 0, 0]\nvertical_fov = 60\n\
             [discretization]\ndivisions = {n}\n[materials.white]\nreflectance = 0.5\n\
             [materials.lamp]\nreflectance = 0\nemission = 1\n{}{}",
            wall(
                "floor",
                "white",
                [[0, 0, 0], [0, 0, 1], [1, 0, 1], [1, 0, 0]]
            ),
            wall(
                "ceiling",
                "lamp",
                [[0, 1, 0], [1, 1, 0], [1, 1, 1], [0, 1, 1]]
            ),
        );
        let Project { scene, params, .. } = Project::parse("cube.toml".as_ref(), &text).unwrap();
        let context = Context::default();
        let patches = subdivide(&scene, &params.discretization, context).unwrap();
        notes(&scene, &patches.mesh)
    }

    #[test]
    fn walls_of_one_patch_are_told_and_how_to_cut_them() {
        let told = cube(2.0, 1);
        assert_eq!(told.len(), 1);
        assert!(told[0].contains("is 50 % of all area"), "{told:?}");
        // The square root of 8 / 2000 is 0.063.
        assert!(
            told[0].contains("`max_patch_edge = 0.06` in [discretization]"),
            "{told:?}"
        );
        assert!(cube(2.0, 4).is_empty());
    }

    #[test]
    fn large_scenes_may_be_in_millimetres() {
        let told = cube(4000.0, 4);
        assert_eq!(told.len(), 1);
        assert!(told[0].contains("4,000 units across"), "{told:?}");
    }
}
