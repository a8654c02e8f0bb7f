//! View3D scenes, line by line.

use std::collections::HashMap;
use std::fmt::Write;

pub(crate) type Point = [f64; 3];

/// The lines of a scene.
#[derive(Default)]
pub(crate) struct Scene {
    vertex_lines: String,
    surface_lines: String,
    /// By their text: points that are written alike are one.
    vertices: HashMap<String, usize>,
    /// How many surfaces and obstructions there are.
    pub(crate) surfaces: u32,
}

impl Scene {
    /// Adds a surface (`S`) or an obstruction (`O`) of three or four corners; `rest` is what
    /// stands behind them.
    pub(crate) fn add(&mut self, kind: char, corners: &[Point], rest: &str) {
        self.surfaces += 1;
        let number = self.surfaces;
        let mut line = format!("{kind} {number}");
        for corner in corners {
            let vertex = self.vertex(corner);
            write!(line, " {vertex}").expect("strings take all text");
        }
        if corners.len() == 3 {
            line += " 0";
        }
        writeln!(self.surface_lines, "{line} {rest}").expect("strings take all text");
    }

    fn vertex(&mut self, [x, y, z]: &Point) -> usize {
        let text = format!("{x:.7} {y:.7} {z:.7}");
        let next = self.vertices.len() + 1;
        *self.vertices.entry(text).or_insert_with_key(|text| {
            writeln!(self.vertex_lines, "V {next} {text}").expect("strings take all text");
            next
        })
    }

    /// The file.
    pub(crate) fn text(&self, title: &str, closed: bool) -> String {
        let closed = if closed { "C encl=1\n" } else { "" };
        let (vertices, surfaces) = (&self.vertex_lines, &self.surface_lines);
        format!("T {title}\n{closed}F 3\n{vertices}{surfaces}*\n")
    }
}

/// The cells of a parallelogram, from three of its corners.
pub(crate) fn cells([a, b, d]: [Point; 3], along: u32, across: u32) -> Vec<[Point; 4]> {
    let at = |i: u32, j: u32| -> Point {
        let (u, v) = (
            f64::from(i) / f64::from(along),
            f64::from(j) / f64::from(across),
        );
        std::array::from_fn(|k| a[k] + u * (b[k] - a[k]) + v * (d[k] - a[k]))
    };
    let cell = |i, j| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
    (0..along)
        .flat_map(|i| (0..across).map(move |j| (i, j)))
        .map(|(i, j)| cell(i, j))
        .collect()
}
