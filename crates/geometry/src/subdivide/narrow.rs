//! The cut of narrow triangles: rows along the longest edge, of quads between two parts near the
//! other edges.
//!
//! The longest edge, `AB`, lies below, the opposite corner `C` above. All rows are equally high,
//! and the lines between them are cut into pieces as long as those of `AB`. So rows differ only in
//! how many parallelograms are in their middle. On their left is a triangle between the row's base
//! and edge `CA`, on their right one between the base and `BC` ([`Needle`]): the same two in each
//! row.
//!
//! Where counts are powers of two, an edge is cut as its own length asks for, so that neighbours
//! have the same vertices. In few triangles (one in some hundreds of random ones) a rung would be
//! too long. They are cut finer: vertices of neighbours are among theirs.
//!
//! Long because: the cut, and the way back from a point to its cell, are one scheme.

mod needle;

use crate::locate::{inverse_barycentric, inverse_bilinear};
use crate::polygon::Polygon;
use glam::{DVec2, DVec3};
use needle::Needle;
use serde::{Deserialize, Serialize};

/// The height of an equilateral triangle of side 1: that of rows, if pieces of edges are as long as
/// 1, unless another edge has too few. So, where a row rises along more than one piece of an edge,
/// it goes along the base by half a piece or more.
const ROW_HEIGHT: f64 = 0.866_025_403_784_438_6;

/// If pieces of edges are as long as this, `2 / sqrt(5)`, no rung is longer than 1: it rises by one
/// piece at most, and leans by half of one.
const SHORT_PIECE: f64 = 0.894_427_190_999_915_9;

/// How a narrow triangle is cut.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct NarrowGrid {
    /// The corner at which the longest edge begins.
    longest: u32,
    rows: u32,
    /// Pieces by which each row is shorter than the one below.
    step: u32,
    /// Pieces of the edges to the left and to the right, in each row.
    sides: [u32; 2],
    /// Where on the longest edge the foot of the opposite corner is, from 0 to 1.
    foot: f64,
}

impl NarrowGrid {
    /// The cut of a triangle. `count` says how many pieces of at most the second length the first
    /// one takes.
    pub(crate) fn new(
        polygon: &Polygon,
        max_edge: f64,
        count: impl Fn(f64, f64) -> u32,
    ) -> NarrowGrid {
        let grid = NarrowGrid::of_pieces(polygon, |length| count(length, max_edge));
        if grid.longest_rung(polygon) <= (1.0 + 1e-12) * max_edge {
            return grid;
        }
        NarrowGrid::of_pieces(polygon, |length| count(length, SHORT_PIECE * max_edge))
    }

    fn of_pieces(polygon: &Polygon, count: impl Fn(f64) -> u32) -> NarrowGrid {
        let corners = polygon.corners();
        let edge = |k: usize| corners[(k + 1) % 3] - corners[k % 3];
        let longer = |&a: &usize, &b: &usize| edge(a).length().total_cmp(&edge(b).length());
        let longest = (0..3).max_by(longer).expect("there are three");
        let [base, after, before] = [0, 1, 2].map(|k| edge(longest + k));
        let height = 2.0 * polygon.area() / base.length();
        let [along, right, left] = [base, after, before].map(|edge| count(edge.length()));
        let rows = count(height / ROW_HEIGHT).min(left).min(right);
        NarrowGrid {
            longest: longest as u32,
            rows,
            step: along.div_ceil(rows),
            sides: [left.div_ceil(rows), right.div_ceil(rows)],
            foot: (-before.dot(base) / base.length_squared()).clamp(0.0, 1.0),
        }
    }

    /// Those of the middle are as long as the last ones beside it.
    fn longest_rung(self, polygon: &Polygon) -> f64 {
        let base = polygon.longest_edge();
        let height = 2.0 * polygon.area() / base / f64::from(self.rows);
        let piece = base / f64::from(self.line(0));
        let rungs = self
            .needles()
            .map(|needle| needle.longest_rung(piece, height));
        rungs[0].max(rungs[1])
    }

    /// How many patches the face has.
    pub(crate) fn cells(self) -> usize {
        self.first_of_row(self.rows as usize)
    }

    fn first_of_row(self, row: usize) -> usize {
        let [left, right] = self.needles().map(|needle| needle.cells() as usize);
        let parallelograms = self.step as usize * row * (2 * self.rows as usize - 1 - row) / 2;
        row * (left + right) + parallelograms
    }

    /// Parallelograms of a row.
    fn middle(self, row: u32) -> u32 {
        (self.rows - 1 - row) * self.step
    }

    /// The left and the right part of every row.
    fn needles(self) -> [Needle; 2] {
        let [left, right] = self.sides;
        let extent = self.foot * f64::from(self.step);
        // A part without base has no area: it cannot hold vertices.
        let most = self.step - u32::from(right > 1);
        let base = (extent.round() as u32).max(u32::from(left > 1)).min(most);
        [
            Needle {
                base,
                side: left,
                extent,
            },
            Needle {
                base: self.step - base,
                side: right,
                extent: f64::from(self.step) - extent,
            },
        ]
    }

    /// All cells, with their rows and the positions in them, in the plane of `polygon`.
    pub(crate) fn polygons(self, polygon: &Polygon) -> Vec<([u32; 2], Polygon)> {
        let [a, b, c] = [0, 1, 2].map(|k| polygon.corners()[(self.longest as usize + k) % 3]);
        let in_space = |weights: DVec3| weights.x * a + weights.y * b + weights.z * c;
        let placed = |(cell, weights): ([u32; 2], Polygon)| (cell, weights.map(in_space));
        self.all().map(placed).collect()
    }

    fn all(self) -> impl Iterator<Item = ([u32; 2], Polygon)> {
        let [left, right] = self.needles().map(Needle::cells);
        let row = move |row| (0..left + self.middle(row) + right).map(move |k| [row, k]);
        let cells = (0..self.rows).flat_map(row);
        cells.map(move |cell| (cell, self.cell(cell)))
    }

    /// A cell, by the weights of the corners: the two of the longest edge, then the opposite one.
    fn cell(self, [row, position]: [u32; 2]) -> Polygon {
        let [left, right] = self.needles();
        let middle = self.middle(row);
        let base = |k: u32| self.on_line(row, k);
        if position < left.cells() {
            let [[b, s], [next_b, next_s]] = [position, position + 1].map(|k| left.rung(k));
            let side = |k| self.on_side(0, row, k);
            return without_repetition([base(b), base(next_b), side(next_s), side(s)]);
        }
        let k = position - left.cells();
        if k < middle {
            let above = |k: u32| self.on_line(row + 1, k);
            let first = left.base + k;
            return Polygon::quad([base(first), base(first + 1), above(k + 1), above(k)]);
        }
        let k = right.cells() - 1 - (k - middle);
        let [[b, s], [next_b, next_s]] = [k, k + 1].map(|k| right.rung(k));
        let end = self.line(row);
        let side = |k| self.on_side(1, row, k);
        without_repetition([base(end - next_b), base(end - b), side(s), side(next_s)])
    }

    /// Pieces of the line below a row.
    pub(crate) fn line(self, row: u32) -> u32 {
        (self.rows - row) * self.step
    }

    /// The vertex at the left end of so many pieces of the line below a row, and so on to the
    /// right.
    fn on_line(self, row: u32, k: u32) -> DVec3 {
        let all = f64::from(self.line(0));
        let weights = [self.line(row) - k, k, row * self.step];
        DVec3::from(weights.map(f64::from)) / all
    }

    /// The vertex on the left or right edge, so many pieces above the line below a row.
    fn on_side(self, which: usize, row: u32, k: u32) -> DVec3 {
        let pieces = self.sides[which];
        let height = f64::from(row * pieces + k) / f64::from(self.rows * pieces);
        match which {
            0 => DVec3::new(1.0 - height, 0.0, height),
            _ => DVec3::new(0.0, 1.0 - height, height),
        }
    }

    /// The cell at a place on the face, by weights of corners 1 and 2, and the place in it.
    pub(crate) fn cell_at(self, on_face: DVec2) -> (usize, DVec2) {
        let by_corner = [1.0 - on_face.x - on_face.y, on_face.x, on_face.y];
        let weights = [0, 1, 2].map(|k| by_corner[(self.longest as usize + k) % 3]);
        let [row, position] = self.position_of(weights);
        let cell = self.cell([row, position]);
        let (normal, point) = (DVec3::ONE.normalize(), DVec3::from(weights));
        let on_patch = if cell.is_triangle() {
            inverse_barycentric(&cell, normal, point)
        } else {
            inverse_bilinear(&cell, normal, point)
        };
        (
            self.first_of_row(row as usize) + position as usize,
            on_patch,
        )
    }

    fn position_of(self, weights: [f64; 3]) -> [u32; 2] {
        let [from_right, from_left, height] = weights.map(|weight| weight.max(0.0));
        let height = height * f64::from(self.rows);
        let row = (height as u32).min(self.rows - 1);
        let height = height - f64::from(row);
        let pieces = |weight: f64| weight * f64::from(self.line(0));
        let ([left, right], middle) = (self.needles(), self.middle(row));
        // The rungs of the middle lean: from the end of the left part's base to the left edge.
        let in_middle = pieces(from_left) - f64::from(left.base) * (1.0 - height);
        let position = if in_middle >= f64::from(middle) && right.cells() > 0 {
            let from_apex = right.cell_at(pieces(from_right), height);
            left.cells() + middle + right.cells() - 1 - from_apex
        } else if in_middle >= 0.0 && middle > 0 {
            left.cells() + (in_middle as u32).min(middle - 1)
        } else {
            left.cell_at(pieces(from_left), height)
        };
        [row, position]
    }

    /// The edges of cells along an edge of the face, from its beginning to its end: the cell, and
    /// the numbers of the edge's ends among its corners.
    pub fn along_edge(self, edge: usize) -> Vec<(usize, [usize; 2])> {
        let from = (edge + 3 - self.longest as usize) % 3;
        let opposite = (from + 2) % 3;
        let mut found = Vec::new();
        for (index, (_, cell)) in self.all().enumerate() {
            let corners = cell.corners();
            for k in 0..corners.len() {
                let ends = [k, (k + 1) % corners.len()];
                if ends.iter().all(|&end| corners[end][opposite] == 0.0) {
                    found.push((corners[k][from], (index, ends)));
                }
            }
        }
        found.sort_by(|(a, _), (b, _)| b.total_cmp(a));
        found.into_iter().map(|(_, edge)| edge).collect()
    }
}

/// A triangle where two neighbouring corners are one, else a quad.
fn without_repetition(corners: [DVec3; 4]) -> Polygon {
    // Two vertices of a cell are never close without being the same.
    let is_same = |k: usize| corners[k].distance(corners[(k + 1) % 4]) < 1e-12;
    match (0..4).find(|&k| is_same(k)) {
        Some(k) => Polygon::triangle([1, 2, 3].map(|next| corners[(k + next) % 4])),
        None => Polygon::quad(corners),
    }
}
