//! Wavefront OBJ files: vertices, and polygons with the groups and materials that they belong to.
//!
//! Nothing else of a file counts: texture coordinates, normals, colours, weights and smoothing
//! groups are not looked at, so that none of them is refused. Lines and points are no faces. A
//! vertex matters only where a face has it as a corner. Material libraries are not opened: what a
//! material is, the scene file says. (Wavefront Technologies, "Advanced Visualizer Manual",
//! appendix B1, "Object Files".)

mod cut;
mod outline;
mod statements;
mod triangles;

use crate::source::{Complaint, SceneError, Source, shortened};
use radiosity_geometry::DVec3;
use statements::{Problem, name, position, statements, vertex_number, words};
use std::rc::Rc;

/// What a file says.
#[derive(Default)]
pub(crate) struct ObjFile {
    /// Not finite where a vertex cannot be read.
    pub(crate) positions: Vec<DVec3>,
    polygons: Vec<Polygon>,
    unknown: Option<Unknown>,
}

/// A face of any number of corners.
struct Polygon {
    /// Indices into the positions.
    corners: Vec<u32>,
    label: Label,
    /// Counted from 1.
    line: usize,
}

/// Where a face comes from in its file.
#[derive(Clone)]
pub(crate) struct Label {
    pub(crate) group: Rc<str>,
    material: Option<Rc<str>>,
    /// Position among the polygons of the file.
    pub(crate) polygon: usize,
}

/// Statements that are not known.
struct Unknown {
    count: usize,
    /// The first one, and its line, counted from 1.
    keyword: String,
    line: usize,
}

/// The group of faces before the first one that has a name.
const NO_GROUP: &str = "unnamed_object";

/// What rounding may do to a polygon, in units of its size: files have six digits or more.
const ROUNDING: f64 = 1e-5;

impl Label {
    /// The names, the more specific one first.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.material.as_deref().into_iter().chain([&*self.group])
    }
}

impl ObjFile {
    /// Says what was not read, if it may have been meant to be seen.
    pub(crate) fn note(&self) -> Option<String> {
        let Unknown {
            count,
            keyword,
            line,
        } = self.unknown.as_ref()?;
        Some(match count {
            1 => format!("`{keyword}` in line {line} is not known and left out"),
            _ => format!(
                "{count} statements are not known and left out, first `{keyword}` in line {line}"
            ),
        })
    }
}

/// Reads the text of a file.
pub(crate) fn parse(source: &Source<'_>) -> Result<ObjFile, SceneError> {
    let mut reader = Reader {
        file: ObjFile::default(),
        group: NO_GROUP.into(),
        material: None,
    };
    for statement in statements(source.text) {
        let (keyword, rest) = statement.parts();
        let read = reader.read(statement.line, keyword, rest);
        read.map_err(|problem| source.problem(statement.line, &problem))?;
    }
    reader.file.check_corners(source)?;
    Ok(reader.file)
}

struct Reader {
    file: ObjFile,
    /// Of the next faces.
    group: Rc<str>,
    material: Option<Rc<str>>,
}

impl Reader {
    fn read(&mut self, line: usize, keyword: &str, rest: &str) -> Result<(), Problem> {
        match keyword {
            "v" => {
                let position = position(rest).unwrap_or(DVec3::NAN);
                self.file.positions.push(position);
            }
            // The latter is the older spelling.
            "f" | "fo" => self.face(line, rest)?,
            "g" | "o" => self.group = name(rest)?.unwrap_or(NO_GROUP).into(),
            "usemtl" => self.material = name(rest)?.map(Rc::from),
            // They say nothing of polygons.
            "" | "vt" | "vn" | "vp" | "s" | "l" | "p" | "mtllib" | "usemap" | "maplib" | "mg"
            | "lod" | "bevel" | "c_interp" | "d_interp" | "shadow_obj" | "trace_obj" => {}
            _ if keyword.starts_with('#') => {}
            _ => self.unknown(line, keyword),
        }
        Ok(())
    }

    fn face(&mut self, line: usize, rest: &str) -> Result<(), Problem> {
        let corners: Result<Vec<u32>, Problem> =
            words(rest).map(|word| self.corner(word)).collect();
        self.file.polygons.push(Polygon {
            corners: corners?,
            label: Label {
                group: Rc::clone(&self.group),
                material: self.material.clone(),
                polygon: self.file.polygons.len(),
            },
            line,
        });
        Ok(())
    }

    /// The index of a vertex, which may stand further down in the file.
    fn corner(&self, word: &str) -> Result<u32, Problem> {
        let number = vertex_number(word)?;
        let before = self.file.positions.len();
        let index = match number {
            1.. => Some(number - 1),
            _ => (before as i64).checked_add(number),
        };
        let index = index.and_then(|index| u32::try_from(index).ok());
        index.ok_or_else(|| no_such_vertex(number, before))
    }

    fn unknown(&mut self, line: usize, keyword: &str) {
        let first = || Unknown {
            count: 0,
            keyword: shortened(keyword).into_owned(),
            line,
        };
        self.file.unknown.get_or_insert_with(first).count += 1;
    }
}

impl ObjFile {
    /// Refuses faces that name vertices beyond the last one.
    fn check_corners(&self, source: &Source<'_>) -> Result<(), SceneError> {
        let count = self.positions.len();
        for polygon in &self.polygons {
            let beyond = |&&corner: &&u32| corner as usize >= count;
            if let Some(&corner) = polygon.corners.iter().find(beyond) {
                let problem = no_such_vertex(i64::from(corner) + 1, count);
                return Err(source.problem(polygon.line, &problem));
            }
        }
        Ok(())
    }
}

fn no_such_vertex(number: i64, count: usize) -> Problem {
    Problem {
        title: format!("there is no vertex {number}"),
        help: match number {
            1.. => format!("the file has {count} vertices"),
            _ => format!("{count} vertices come before this line"),
        },
    }
}

impl Source<'_> {
    fn problem(&self, line: usize, problem: &Problem) -> SceneError {
        let complaint = Complaint::new(&problem.title, "in this line").help(&problem.help);
        self.error_in_line(line, &complaint)
    }
}
