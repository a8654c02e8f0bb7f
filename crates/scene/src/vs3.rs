//! View3D's scenes (`.vs3`, format `F 3`), of which engineers have years.
//!
//! `!` and `/` begin comments. `V` names a vertex, `S` a surface of three or four of them,
//! counter-clockwise seen from the front, `O` one that only stands in the way. A surface may
//! lie on an earlier one (`base`), which then lacks its area, and may be combined with an earlier
//! one (`cmb`): here, both are of one group. (G. Walton, "Calculation of Obstructed View Factors by
//! Adaptive Integration", NISTIR 6925, 2002.)

mod read;
#[cfg(test)]
mod tests;

use crate::material::Material;
use crate::scene::{FileKind, Scene};
use crate::source::{Complaint, SceneError, Source};
use crate::surface::Surface;
use radiosity_geometry::{DVec3, Polygon, PolygonMesh, Shape, area_around, remainder};
use read::{Entry, Kind};
use std::collections::HashSet;

/// The height of a corner over the plane of another surface, relative to that one's size, up to
/// which it lies on it: files have six digits or more.
const ON_PLANE: f64 = 1e-5;

/// Checks the text of a file.
pub(crate) fn parse(source: &Source<'_>) -> Result<(Scene, Vec<String>), SceneError> {
    let file = read::read(source)?;
    let names = unique_names(&file.entries);
    let groups = groups(&file.entries, &names);
    let mut materials: Vec<Material> = Vec::new();
    let mut on_each = vec![Vec::new(); file.entries.len()];
    for entry in &file.entries {
        if let Some(base) = entry.base {
            on_each[base].push(entry);
        }
    }
    let (mut surfaces, mut notes) = (Vec::new(), file.notes);
    for (index, entry) in file.entries.iter().enumerate() {
        let Some(shape) = shape(source, entry, &on_each[index])? else {
            let number = entry.number;
            notes.push(format!(
                "surface {number} is covered by those on it, and has no row"
            ));
            continue;
        };
        let faces = match &shape {
            Shape::Mesh(mesh) => mesh.faces.len(),
            _ => 1,
        };
        surfaces.push(Surface {
            name: names[index].clone(),
            group: groups[index].clone(),
            groups_of_faces: Vec::new(),
            materials: vec![material(&mut materials, entry.emittance); faces],
            polygons: match &shape {
                Shape::Mesh(_) => vec![0; faces],
                _ => Vec::new(),
            },
            is_obstruction: entry.kind == Kind::Obstruction,
            shape,
        });
    }
    let name = source.path.file_stem().unwrap_or_default();
    let scene = Scene {
        kind: FileKind::View3D,
        surfaces,
        materials,
        closed: file.closed,
        ..Scene::new(&name.to_string_lossy())
    };
    Ok((scene, notes))
}

/// The shape of a surface without those that lie on it, unless they cover it. What only stands in
/// the way does so whatever lies on it.
fn shape(
    source: &Source<'_>,
    entry: &Entry,
    on_it: &[&Entry],
) -> Result<Option<Shape>, SceneError> {
    let whole = match *entry.corners {
        [a, b, c] => Shape::Triangle([a, b, c]),
        [a, b, c, d] => Shape::Quad([a, b, c, d]),
        _ => unreachable!("surfaces are read with three or four corners"),
    };
    let normal = match whole.polygons() {
        Ok(polygons) => polygons[0].1.normal(),
        Err(error) => {
            let title = format!("surface {} {error}", entry.number);
            let complaint = Complaint::new(title, "its vertices are in this order");
            return Err(source.error_in_line(entry.line, &complaint));
        }
    };
    if on_it.is_empty() || entry.kind == Kind::Obstruction {
        return Ok(Some(whole));
    }
    for other in on_it {
        check_lies_on(source, other, entry, normal)?;
    }
    let holes: Vec<&[DVec3]> = on_it.iter().map(|other| &other.corners[..]).collect();
    let size = size(&entry.corners);
    let rest = remainder(&entry.corners, normal, &holes, ON_PLANE * size);
    let covered: f64 = holes.iter().map(|hole| area_around(hole, normal)).sum();
    let left: f64 = rest.iter().map(Polygon::area).sum();
    // Each hole may be off by the tolerance along its edges.
    let tolerance = 8.0 * ON_PLANE * size * size * holes.len() as f64;
    if covered + left > area_around(&entry.corners, normal) + tolerance {
        let title = format!(
            "the surfaces on surface {} overlap each other",
            entry.number
        );
        let complaint = Complaint::new(title, "their base")
            .help("cut them so that they lie side by side, or make one the base of the other");
        return Err(source.error_in_line(entry.line, &complaint));
    }
    Ok((!rest.is_empty()).then(|| Shape::Mesh(PolygonMesh::of(&rest))))
}

/// Refuses a surface that is not a part of its base.
fn check_lies_on(
    source: &Source<'_>,
    entry: &Entry,
    base: &Entry,
    normal: DVec3,
) -> Result<(), SceneError> {
    let complain = |problem: &str, help: &str| {
        let title = format!(
            "surface {} {problem} its base {}",
            entry.number, base.number
        );
        let complaint = Complaint::new(title, "this surface").help(help);
        Err(source.error_in_line(entry.line, &complaint))
    };
    let from = base.corners[0];
    let tolerance = ON_PLANE * size(&base.corners);
    let is_on_plane = |corner: &DVec3| normal.dot(corner - from).abs() <= tolerance;
    if !entry.corners.iter().all(is_on_plane) {
        let help = "move it there; base 0 is for surfaces that lie on none";
        return complain("is not in the plane of", help);
    }
    let [a, b, c] = [0, 1, 2].map(|k| entry.corners[k]);
    if (b - a).cross(c - b).dot(normal) < 0.0 {
        let help = "what lies on a surface faces as it does; masks and null surfaces, which face \
                    the other way, are not read";
        return complain("faces the other way than", help);
    }
    let is_inside = |corner: &DVec3| {
        (0..base.corners.len()).all(|k| {
            let edge = base.corners[(k + 1) % base.corners.len()] - base.corners[k];
            let inward = normal.cross(edge).normalize_or_zero();
            inward.dot(corner - base.corners[k]) >= -tolerance
        })
    };
    if !entry.corners.iter().all(is_inside) {
        let help = "cut it along the edges of its base; what is beyond lies on none and has base 0";
        return complain("reaches beyond", help);
    }
    Ok(())
}

/// From the first corner to the farthest.
fn size(corners: &[DVec3]) -> f64 {
    let distances = corners.iter().map(|corner| corner.distance(corners[0]));
    distances.fold(0.0, f64::max)
}

/// A name for each surface that no other has: with its number where names repeat.
fn unique_names(entries: &[Entry]) -> Vec<String> {
    let mut counts = std::collections::HashMap::new();
    for entry in entries {
        *counts.entry(&entry.name).or_insert(0) += 1;
    }
    let mut taken = HashSet::new();
    let name = |entry: &Entry| {
        let mut name = entry.name.clone();
        let mut is_free = counts[&entry.name] == 1;
        while !is_free || taken.contains(&name) {
            name = format!("{name} ({})", entry.number);
            is_free = true;
        }
        taken.insert(name.clone());
        name
    };
    entries.iter().map(name).collect()
}

/// The name of the first surface that each is combined with.
fn groups(entries: &[Entry], names: &[String]) -> Vec<String> {
    let mut groups: Vec<String> = Vec::with_capacity(entries.len());
    for (entry, name) in entries.iter().zip(names) {
        // Only earlier ones are combined with.
        groups.push(entry.combined.map_or(name, |other| &groups[other]).clone());
    }
    groups
}

/// The index of the material of this emittance, which is made if it is new.
fn material(materials: &mut Vec<Material>, emittance: f64) -> usize {
    let name = format!("emittance {emittance}");
    if let Some(index) = materials.iter().position(|material| material.name == name) {
        return index;
    }
    materials.push(Material {
        name,
        reflectance: [1.0 - emittance; 3],
        emission: [0.0; 3],
        light: None,
    });
    materials.len() - 1
}
