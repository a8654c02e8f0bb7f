//! Partly hidden pairs that touch or nearly touch: every tolerance is kept, and rows know their
//! errors.

use crate::estimated::accurate;
use radiosity_form_factors::FormFactors;
use radiosity_geometry::{DVec3, Mesh, Polygon};
use radiosity_test_kit::rooms::{KINDS, Kind, room};
use radiosity_test_kit::{mesh_of, quad};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::f64::consts::TAU;

/// The sum of the absolute errors of a row, and what it tells.
struct Row {
    error: f64,
    estimate: f64,
}

/// Of the rows of a mesh that see anything past something else.
fn rows(found: &FormFactors, fine: &FormFactors) -> Vec<Row> {
    let row = |i: usize| Row {
        error: std::iter::zip(found.row(i), fine.row(i))
            .map(|(found, fine)| (found - fine).abs())
            .sum(),
        estimate: found.rows[i].error.unwrap(),
    };
    let rows = (0..found.areas.len()).map(row);
    rows.filter(|row| row.estimate > 0.0).collect()
}

/// Of rooms of a kind and a tolerance.
struct Campaign {
    kind: Kind,
    tolerance: f64,
    rows: Vec<Row>,
}

impl Campaign {
    /// In so many rooms, by each tolerance.
    fn run(kind: Kind, rooms: u64, tolerances: &[f64]) -> Vec<Campaign> {
        let finest = tolerances.iter().copied().fold(1.0, f64::min);
        let meshes: Vec<Mesh> = (0..rooms).map(|seed| room(kind, seed)).collect();
        // Lines have no bias: what is off is what their samples miss, and these are others.
        let fine: Vec<FormFactors> = meshes.iter().map(|m| accurate(m, 0.3 * finest)).collect();
        let campaign = |&tolerance: &f64| {
            let rows_of = |(mesh, fine): (&Mesh, &FormFactors)| {
                let found = accurate(mesh, tolerance);
                assert!(found.rows.iter().all(|row| row.missed == 0.0));
                rows(&found, fine)
            };
            Campaign {
                kind,
                tolerance,
                rows: meshes.iter().zip(&fine).flat_map(rows_of).collect(),
            }
        };
        tolerances.iter().map(campaign).collect()
    }

    fn mean(&self, of: fn(&Row) -> f64) -> f64 {
        self.rows.iter().map(of).sum::<f64>() / self.rows.len() as f64
    }

    /// The tolerance is kept; 95 % of the rows are off by less than twice what they tell, and on
    /// average they tell no more than four times what they are off by.
    fn check(&self) {
        let Campaign {
            kind,
            tolerance,
            rows,
        } = self;
        let (error, estimate) = (self.mean(|row| row.error), self.mean(|row| row.estimate));
        let within = self.mean(|row| f64::from(u8::from(row.error <= 2.0 * row.estimate)));
        let largest = rows.iter().map(|row| row.estimate).fold(0.0, f64::max);
        println!(
            "{kind:?} {tolerance:.0e}: {} rows, {:.1} % within twice their estimate; \
             off by {error:.1e}, told {estimate:.1e} on average and {largest:.1e} at most",
            rows.len(),
            100.0 * within
        );
        // Weights of rows are estimated from some of their pairs.
        assert!(largest <= *tolerance, "{kind:?} {tolerance}: {largest}");
        assert!(within >= 0.95, "{kind:?} {tolerance}: {within}");
        assert!(estimate <= 4.0 * error, "{kind:?} {tolerance}");
    }
}

#[test]
fn tolerances_are_kept_in_rooms_of_every_kind() {
    for kind in KINDS {
        for campaign in Campaign::run(kind, 2, &[1e-2, 1e-3]) {
            campaign.check();
        }
    }
}

#[test]
#[ignore = "slow: two minutes"]
fn fine_tolerances_are_kept_in_many_rooms_of_every_kind() {
    for kind in KINDS {
        for campaign in Campaign::run(kind, 6, &[1e-2, 1e-3, 1e-4]) {
            campaign.check();
        }
    }
}

/// One room of each kind, since that takes its time.
#[test]
#[ignore = "slow: a minute"]
fn small_tolerances_are_kept() {
    for kind in KINDS {
        let mesh = room(kind, 7);
        let found = accurate(&mesh, 1e-5);
        for row in &found.rows {
            assert!(row.error.unwrap() <= 1e-5, "{kind:?} {row:?}");
            assert_eq!(row.missed, 0.0);
        }
    }
}

/// A wall on a floor, a screen close to the wall, a lid on both, and things behind the screen:
/// whatever they hide of the floor from the wall, the screen hides, too.
fn niche(things: u32) -> Mesh {
    let mut shapes = vec![
        quad([[0., 1., 0.], [0., 0., 0.], [8., 0., 0.], [8., 1., 0.]]),
        quad([[0., 0., 0.], [0., 0., 9.], [8., 0., 9.], [8., 0., 0.]]),
        quad([
            [0.2, 0.1, 0.2],
            [0.2, 0.8, 0.2],
            [7.8, 0.8, 0.2],
            [7.8, 0.1, 0.2],
        ]),
        quad([[8., 1., 0.], [0., 1., 0.], [0.2, 0.8, 0.2], [7.8, 0.8, 0.2]]),
    ];
    for k in 0..things {
        let [x, z] = [1.0 + 0.3 * f64::from(k), 0.25];
        let (left, right) = (x, x + 0.2);
        shapes.push(quad([
            [left, 0.4, z],
            [left, 0.6, z],
            [right, 0.6, z],
            [right, 0.4, z],
        ]));
    }
    mesh_of(shapes)
}

/// Factors depend neither on how many faces are listed between two patches nor on what these are.
#[test]
fn harmless_things_change_nothing() {
    let tolerance = 1e-5;
    let alone = accurate(&niche(0), tolerance).factor(0, 1);
    for things in [3, 8, 20] {
        let found = accurate(&niche(things), tolerance).factor(0, 1);
        assert!((found - alone).abs() < 2.0 * tolerance, "{found} {alone}");
    }
    // Rays know nothing of lines, and have an error of their own.
    let rays = 1_000_000;
    let share = floor_seen_by_rays(&niche(0), rays);
    let noise = (share * (1.0 - share) / f64::from(rays)).sqrt();
    assert!((share - alone).abs() < 4.0 * noise, "{share} {alone}");
}

/// The share of rays from the wall of a niche, in directions of density `cos / pi`, that meet its
/// floor first.
fn floor_seen_by_rays(niche: &Mesh, rays: u32) -> f64 {
    let mut rng = Pcg64Mcg::seed_from_u64(1);
    let polygons: Vec<&Polygon> = niche.faces.iter().map(|face| &face.polygon).collect();
    let (x, y) = niche.faces[0].normal.any_orthonormal_pair();
    let mut count = 0;
    for _ in 0..rays {
        let mut uniform = || rng.random::<f64>();
        let p = polygons[0].bilinear(uniform(), uniform());
        let (squared, angle) = (uniform(), TAU * uniform());
        let on_disk = squared.sqrt() * (angle.cos() * x + angle.sin() * y);
        let direction = on_disk + (1.0 - squared).sqrt() * niche.faces[0].normal;
        let hits = polygons[1..]
            .iter()
            .map(|polygon| distance(polygon, p, direction));
        let first = hits.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
        count += u32::from(first.0 == 0 && first.1.is_finite());
    }
    f64::from(count) / f64::from(rays)
}

/// How far away a ray meets a polygon, if it does.
fn distance(polygon: &Polygon, p: DVec3, direction: DVec3) -> f64 {
    let (corners, normal) = (polygon.corners(), polygon.normal());
    let t = normal.dot(corners[0] - p) / normal.dot(direction);
    let q = p + t * direction;
    let is_inside = (0..corners.len()).all(|k| {
        let edge = corners[(k + 1) % corners.len()] - corners[k];
        normal.dot(edge.cross(q - corners[k])) >= 0.0
    });
    if t > 0.0 && is_inside {
        t
    } else {
        f64::INFINITY
    }
}
