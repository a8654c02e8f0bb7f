//! A mesh made in code, a tent seen from inside, and the form factors between its faces:
//! `cargo run --release --example own_mesh`.

use radiosity::form_factors::{Params, estimate};
use radiosity::geometry::{DVec3, Divisions, MeshError, PolygonMesh, Shape, subdivide};

/// Corners are counter-clockwise as seen from inside.
const FACES: [(&str, &[u32]); 5] = [
    ("floor", &[0, 3, 4, 1]),
    ("left", &[0, 2, 5, 3]),
    ("right", &[1, 4, 5, 2]),
    ("front", &[3, 5, 4]),
    ("back", &[0, 1, 2]),
];

fn main() -> Result<(), MeshError> {
    let triangle = |z| [[0.0, 0.0, z], [2.0, 0.0, z], [1.0, 1.5, z]].map(DVec3::from);
    let tent = Shape::Mesh(PolygonMesh {
        positions: [triangle(0.0), triangle(3.0)].concat(),
        faces: FACES.map(|(_, corners)| corners.to_vec()).to_vec(),
    });
    let mesh = subdivide(&[tent.into()], Divisions::default())?;
    let factors = estimate(&mesh, &Params::default());

    let names = FACES.map(|(name, _)| format!("{name:>8}")).concat();
    println!("from \\ to{names}     sum");
    for (i, (name, _)) in FACES.iter().enumerate() {
        let row: String = (0..FACES.len())
            .map(|j| format!("{:>8.4}", factors.factor(i, j)))
            .collect();
        println!("{name:<9}{row}{:>8.4}", factors.rows[i].fronts);
    }
    Ok(())
}
