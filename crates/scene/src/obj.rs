//! Wavefront OBJ meshes, read by tobj; faces with more than four corners are triangulated by
//! earcut.

use crate::source::{Complaint, SceneError, Source};
use radiosity_geometry::{DVec3, PolygonMesh};
use std::cell::Cell;
use std::collections::HashMap;
use std::io::{BufRead, Read};
use std::rc::Rc;
use tobj::LoadError;

/// A mesh and where its faces belong.
pub(crate) struct ObjMesh {
    pub(crate) mesh: PolygonMesh,
    /// One per face of `mesh`.
    pub(crate) labels: Vec<Label>,
}

/// Where a face comes from in its file.
#[derive(Clone)]
pub(crate) struct Label {
    pub(crate) group: Rc<str>,
    material: Option<Rc<str>>,
    /// Position among the polygons of the file.
    pub(crate) polygon: usize,
}

impl Label {
    /// The names, the more specific one first.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.material.as_deref().into_iter().chain([&*self.group])
    }

    /// The line of the file where the face begins, counted from 1.
    pub(crate) fn line(&self, text: &str) -> usize {
        let is_polygon = |line: &str| {
            let mut words = line.split_whitespace();
            words.next() == Some("f") && words.count() >= 3
        };
        let mut polygons = text
            .lines()
            .enumerate()
            .filter(|(_, line)| is_polygon(line));
        polygons.nth(self.polygon).map_or(1, |(index, _)| index + 1)
    }
}

/// Reads an OBJ file. Material libraries are not opened: what a material is, the scene file
/// says; its name in the mesh is all that counts here.
pub(crate) fn parse(source: &Source<'_>) -> Result<ObjMesh, SceneError> {
    let text = plain_lines(source.text);
    let source = &Source {
        path: source.path,
        text: &text,
    };
    if let Some(line) = first_face_without_corners(&text) {
        let complaint = Complaint::new("this face has fewer than three corners", "in this line")
            .help("remove it from the mesh");
        return Err(source.error_in_line(line, &complaint));
    }
    let materials = material_names(source.text);
    let options = tobj::LoadOptions {
        ignore_points: true,
        ignore_lines: true,
        ..Default::default()
    };
    // tobj forgets material names that no library defines: one is put in front of the file. The
    // first library asked for is that one, whatever others are called.
    let names = Cell::new(Some(materials_named(&materials)));
    let line = Cell::new(0);
    let mut reader = CountedLines {
        lines: source.text.split_inclusive('\n'),
        current: b"mtllib names\n",
        line: &line,
    };
    let loaded = tobj::load_obj_buf(&mut reader, &options, |_| {
        Ok(names.take().unwrap_or_default())
    });
    let (models, _) = loaded.map_err(|error| explain(source, &error, line.get()))?;
    Ok(assemble(&models, &materials))
}

/// The same lines without tabs, indentation and continuations (`\` at the end), which tobj takes
/// for parts of names or does not know; empty lines take the place of joined ones.
fn plain_lines(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut joined = 0;
    for line in text.lines().map(str::trim_start) {
        match line.trim_end().strip_suffix('\\') {
            Some(start) if !line.starts_with('#') => {
                plain.push_str(start);
                plain.push(' ');
                joined += 1;
            }
            _ => {
                plain.push_str(line);
                plain.extend(std::iter::repeat_n('\n', 1 + joined));
                joined = 0;
            }
        }
    }
    plain.replace('\t', " ")
}

/// The line, counted from 1, of the first face that is no polygon.
fn first_face_without_corners(text: &str) -> Option<usize> {
    let is_bad = |line: &str| {
        let mut words = line.split_whitespace();
        words.next() == Some("f") && words.count() < 3
    };
    text.lines().position(is_bad).map(|index| index + 1)
}

/// The materials that a file uses, in order of appearance.
fn material_names(text: &str) -> Vec<Rc<str>> {
    let mut names: Vec<Rc<str>> = Vec::new();
    for line in text.lines() {
        if let Some(name) = line.strip_prefix("usemtl ")
            && !names.iter().any(|known| **known == *name.trim())
        {
            names.push(name.trim().into());
        }
    }
    names
}

fn materials_named(names: &[Rc<str>]) -> (Vec<tobj::Material>, MaterialMap) {
    let material = |name: &Rc<str>| tobj::Material {
        name: name.to_string(),
        ..Default::default()
    };
    let map = names
        .iter()
        .enumerate()
        .map(|(k, name)| (name.to_string(), k));
    (names.iter().map(material).collect(), map.collect())
}

type MaterialMap = HashMap<String, usize>;

fn assemble(models: &[tobj::Model], materials: &[Rc<str>]) -> ObjMesh {
    let mut result = ObjMesh {
        mesh: PolygonMesh::default(),
        labels: Vec::new(),
    };
    let mut polygon = 0;
    for model in models {
        let mesh = &model.mesh;
        let names = Label {
            polygon,
            group: model.name.as_str().into(),
            material: mesh.material_id.map(|id| Rc::clone(&materials[id])),
        };
        let first = result.mesh.positions.len() as u32;
        let positions = mesh.positions.chunks_exact(3).map(DVec3::from_slice);
        result.mesh.positions.extend(positions);
        // tobj leaves the arities out where all faces are triangles.
        let triangles = vec![
            3;
            if mesh.face_arities.is_empty() {
                mesh.indices.len() / 3
            } else {
                0
            }
        ];
        let mut rest = mesh.indices.as_slice();
        for &arity in mesh.face_arities.iter().chain(&triangles) {
            let (corners, tail) = rest.split_at(arity as usize);
            rest = tail;
            let corners: Vec<u32> = corners.iter().map(|index| first + index).collect();
            for face in up_to_four_corners(corners, &result.mesh.positions) {
                result.mesh.faces.push(face);
                result.labels.push(Label {
                    polygon,
                    ..names.clone()
                });
            }
            polygon += 1;
        }
    }
    result
}

fn up_to_four_corners(corners: Vec<u32>, positions: &[DVec3]) -> Vec<Vec<u32>> {
    if corners.len() <= 4 {
        return vec![corners];
    }
    let points: Vec<[f64; 3]> = corners
        .iter()
        .map(|&index| positions[index as usize].to_array())
        .collect();
    let mut flat = Vec::new();
    let mut triangles: Vec<usize> = Vec::new();
    if earcut::utils3d::project3d_to_2d(&points, points.len(), &mut flat) {
        earcut::Earcut::new().earcut(flat, &[], &mut triangles);
    }
    if triangles.is_empty() {
        // No area: the checks refuse a piece of it.
        return vec![corners[..3].to_vec()];
    }
    let face = |t: &[usize]| t.iter().map(|&k| corners[k]).collect();
    triangles.chunks_exact(3).map(face).collect()
}

fn explain(source: &Source<'_>, error: &LoadError, line: usize) -> SceneError {
    let complaint = |label: &str| Complaint::new(format!("cannot read this mesh: {error}"), label);
    match error {
        LoadError::FaceVertexOutOfBounds => {
            let line = first_face_out_of_bounds(source.text).unwrap_or(line);
            source.error_in_line(line, &complaint("names a vertex that does not exist"))
        }
        _ => source.error_in_line(line, &complaint("in this line")),
    }
}

/// The line, counted from 1, of the first face that names a vertex beyond the last one.
fn first_face_out_of_bounds(text: &str) -> Option<usize> {
    let keyword = |line: &str| line.split_whitespace().next().map(str::to_owned);
    let vertices = text
        .lines()
        .filter(|l| keyword(l).as_deref() == Some("v"))
        .count();
    let exceeds = |corner: &str| {
        let index = corner
            .split('/')
            .next()
            .and_then(|index| index.parse::<usize>().ok());
        index.is_some_and(|index| index > vertices)
    };
    let is_bad = |line: &str| {
        keyword(line).as_deref() == Some("f") && line.split_whitespace().skip(1).any(exceeds)
    };
    text.lines().position(is_bad).map(|index| index + 1)
}

/// Hands out a text line by line and counts: tobj's errors do not say where they are.
struct CountedLines<'a> {
    lines: std::str::SplitInclusive<'a, char>,
    current: &'a [u8],
    line: &'a Cell<usize>,
}

impl BufRead for CountedLines<'_> {
    fn fill_buf(&mut self) -> std::io::Result<&[u8]> {
        if self.current.is_empty()
            && let Some(next) = self.lines.next()
        {
            self.current = next.as_bytes();
            self.line.set(self.line.get() + 1);
        }
        Ok(self.current)
    }

    fn consume(&mut self, amount: usize) {
        self.current = &self.current[amount..];
    }
}

impl Read for CountedLines<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let mut available = self.fill_buf()?;
        let count = available.read(buffer)?;
        self.consume(count);
        Ok(count)
    }
}
