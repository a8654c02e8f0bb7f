//! Polygons of any number of corners as faces of three or four.

use super::outline::Outline;
use super::statements::{Problem, position, statements};
use super::triangles::triangles;
use super::{Label, ObjFile, Polygon};
use crate::source::{SceneError, Source};
use radiosity_geometry::{DVec3, PolygonMesh, Shape, ShapeError};
use std::collections::HashSet;

/// A mesh and where its faces belong.
pub(crate) struct ObjMesh {
    pub(crate) shape: Shape,
    /// One per face of the shape.
    pub(crate) labels: Vec<Label>,
    /// The lines of polygons that have no area, counted from 1.
    without_area: Vec<usize>,
}

/// Largest coordinate that shapes may have.
const LARGEST: f64 = 1e30;

impl ObjFile {
    /// Cuts all polygons, and leaves those out that have no area.
    pub(crate) fn cut(self, source: &Source<'_>) -> Result<ObjMesh, SceneError> {
        self.check_positions(source)?;
        let outlines = self.outlines();
        let mut mesh = PolygonMesh::default();
        let mut labels: Vec<Label> = Vec::new();
        let mut without_area = Vec::new();
        for (polygon, outline) in self.polygons.iter().zip(outlines) {
            let faces = faces(outline, &self.positions);
            let faces = faces.ok_or_else(|| polygon.crosses_itself(source))?;
            if faces.is_empty() {
                without_area.push(polygon.line);
            }
            labels.extend(std::iter::repeat_n(&polygon.label, faces.len()).cloned());
            mesh.faces.extend(faces);
        }
        mesh.positions = self.positions;
        let shape = Shape::Mesh(mesh);
        if let Err(ShapeError::FaceCrossesItself { face }) = shape.polygons() {
            let polygon = &self.polygons[labels[face].polygon];
            return Err(polygon.crosses_itself(source));
        }
        Ok(ObjMesh {
            shape,
            labels,
            without_area,
        })
    }

    /// Refuses corners that are no points.
    fn check_positions(&self, source: &Source<'_>) -> Result<(), SceneError> {
        let mut corners = self.polygons.iter().flat_map(|polygon| &polygon.corners);
        let is_bad = |&&corner: &&u32| {
            let position = self.positions[corner as usize];
            !position.abs().cmple(DVec3::splat(LARGEST)).all()
        };
        match corners.find(is_bad) {
            Some(&corner) => Err(bad_vertex(source, corner as usize)),
            None => Ok(()),
        }
    }

    /// The outlines of all polygons. Of the corners on their edges, those stay that another polygon
    /// turns at: faces that meet share corners, so that no light gets through between them.
    fn outlines(&self) -> Vec<Outline> {
        let outline = |polygon: &Polygon| Outline::of(&polygon.corners, &self.positions);
        let mut outlines: Vec<Outline> = self.polygons.iter().map(outline).collect();
        let key = |corner: u32| {
            // 0 is equal to -0.
            (self.positions[corner as usize] + 0.0)
                .to_array()
                .map(f64::to_bits)
        };
        let on_edges = outlines
            .iter()
            .flat_map(|outline| outline.on_edges.iter().flatten());
        let on_edges: HashSet<_> = on_edges.map(|&corner| key(corner)).collect();
        if on_edges.is_empty() {
            return outlines;
        }
        let with_area = outlines.iter().filter(|outline| outline.has_area());
        let turns = with_area.flat_map(|outline| &outline.corners);
        let turns = turns.map(|&corner| key(corner));
        let shared: HashSet<_> = turns.filter(|key| on_edges.contains(key)).collect();
        for outline in &mut outlines {
            outline.retain_on_edges(|corner| shared.contains(&key(corner)));
        }
        outlines
    }
}

impl ObjMesh {
    /// Says how many polygons were left out.
    pub(crate) fn note(&self) -> Option<String> {
        let first = self.without_area.first()?;
        Some(match self.without_area.len() {
            1 => format!("1 face without area left out, at line {first}"),
            n => format!("{n} faces without area left out, first at line {first}"),
        })
    }
}

impl Polygon {
    fn crosses_itself(&self, source: &Source<'_>) -> SceneError {
        let problem = Problem {
            title: "this face crosses itself".to_owned(),
            help: "order its corners around it, or cut it into faces that do not".to_owned(),
        };
        source.problem(self.line, &problem)
    }
}

/// The faces that a polygon is made of, none if it has no area; `None` if it crosses itself.
fn faces(outline: Outline, positions: &[DVec3]) -> Option<Vec<Vec<u32>>> {
    if !outline.has_area() {
        return Some(Vec::new());
    }
    let is_plain = outline.on_edges.iter().all(Vec::is_empty);
    match outline.corners.len() {
        3 | 4 if is_plain => Some(vec![outline.corners]),
        _ => triangles(&outline, positions),
    }
}

/// Points to the statement of a vertex.
fn bad_vertex(source: &Source<'_>, index: usize) -> SceneError {
    let mut vertices = statements(source.text).filter(|statement| statement.parts().0 == "v");
    let vertex = vertices.nth(index).expect("each position has a statement");
    let problem = position(vertex.parts().1).err().unwrap_or_else(|| Problem {
        title: format!("vertex {} is out of range", index + 1),
        help: "scaled and moved, coordinates are numbers between -1e30 and 1e30".to_owned(),
    });
    source.problem(vertex.line, &problem)
}
