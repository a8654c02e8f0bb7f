//! The closed box of 313 rectangles, cut finer.

use crate::vs3::{Point, Scene, cells};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::path::Path;

/// How many rectangles it has before it is cut.
pub const PARENTS: u32 = 313;

type Rectangle = [Point; 4];

/// Where plates may be: in the box, and not in the cuboid 10..30 x 0..40 x 80..100.
const ROOM: Point = [100.0, 80.0, 170.0];
const CUBOID: [(f64, f64); 3] = [(10.0, 30.0), (0.0, 40.0), (80.0, 100.0)];
/// Edges of plates.
const PLATE: f64 = 4.0;

/// The text of the scene.
pub fn vs3(root: &Path, elements: u32, obstacles: u32) -> Result<String, String> {
    let cuts = f64::from(elements / PARENTS).sqrt().round() as u32;
    if elements == 0 || PARENTS * cuts * cuts != elements {
        return Err(format!(
            "{elements} is not {PARENTS} times a square number: choose 313, 1252, 5008, 20032, …"
        ));
    }
    let mut scene = Scene::default();
    let mut first_of_parent = 1;
    for (parent, rectangle) in parents(root)?.iter().enumerate() {
        let [a, b, _, d] = *rectangle;
        for cell in cells([a, b, d], cuts, cuts) {
            let combined = if scene.surfaces < first_of_parent {
                0
            } else {
                first_of_parent
            };
            scene.add('S', &cell, &format!("0 {combined} 0.9 {parent}"));
        }
        first_of_parent = scene.surfaces + 1;
    }
    let mut rng = Pcg64Mcg::seed_from_u64(0);
    for plate in 0..obstacles {
        scene.add(
            'O',
            &plate_at_random(&mut rng),
            &format!("0 0 1 plate {plate}"),
        );
    }
    let title = format!(
        "a closed box of {elements} rectangles with a cuboid in it, and {obstacles} plates"
    );
    Ok(scene.text(&title, obstacles == 0))
}

fn parents(root: &Path) -> Result<Vec<Rectangle>, String> {
    let path = root.join("tests/data/box313/polygons.csv");
    let text = std::fs::read_to_string(&path)
        .map_err(|error| format!("cannot read {}: {error}", path.display()))?;
    let rectangle = |line: &str| {
        let numbers: Vec<f64> = line.split(',').filter_map(|n| n.parse().ok()).collect();
        std::array::from_fn(|corner| std::array::from_fn(|axis| numbers[2 + 3 * corner + axis]))
    };
    Ok(text.lines().skip(1).map(rectangle).collect())
}

/// A square plate at right angles to an axis, clear of the walls and of the cuboid.
fn plate_at_random(rng: &mut Pcg64Mcg) -> Rectangle {
    loop {
        let corner: Point =
            std::array::from_fn(|k| 1.0 + (ROOM[k] - PLATE - 2.0) * rng.random::<f64>());
        let across = rng.random_range(0..3usize);
        let apart =
            |k: usize| corner[k] > CUBOID[k].1 + 1.0 || corner[k] + PLATE < CUBOID[k].0 - 1.0;
        if !(0..3).any(apart) {
            continue;
        }
        let (u, v) = ((across + 1) % 3, (across + 2) % 3);
        let moved = |axes: &[usize]| {
            let mut point = corner;
            axes.iter().for_each(|&axis| point[axis] += PLATE);
            point
        };
        return [moved(&[]), moved(&[u]), moved(&[u, v]), moved(&[v])];
    }
}
