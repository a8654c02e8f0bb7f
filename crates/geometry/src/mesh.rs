//! The mesh of patches: what every later stage indexes.

use crate::bounds::Aabb;
use crate::coplanar::covers::Covers;
use crate::polygon::Polygon;
use crate::subdivide::narrow::NarrowGrid;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// Index of a surface, in scene order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct SurfaceId(pub u32);

/// Index of a face in [`Mesh::faces`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct FaceId(pub u32);

impl SurfaceId {
    /// The position in a list of all surfaces.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

impl FaceId {
    /// The position in [`Mesh::faces`].
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// How a face is cut into patches. Where counts are 0 it has none: it only stands in the way.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Grid {
    /// `a x b` cells of the bilinear map, `a` along the edge from corner 0 to corner 1.
    Quad {
        /// Cells along edge a.
        a: u32,
        /// Cells along edge b.
        b: u32,
    },
    /// `n^2` congruent triangles.
    Triangle {
        /// Cells along each edge.
        n: u32,
    },
    /// Rows of quads and triangles along the longest edge of a narrow triangle.
    Narrow(NarrowGrid),
}

impl Grid {
    /// How many patches the face has.
    pub fn cells(self) -> usize {
        match self {
            Grid::Quad { a, b } => a as usize * b as usize,
            Grid::Triangle { n } => n as usize * n as usize,
            Grid::Narrow(grid) => grid.cells(),
        }
    }
}

/// One undivided planar polygon of a surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Face {
    /// The polygon.
    pub polygon: Polygon,
    /// Unit normal of the front.
    pub normal: DVec3,
    /// The surface it belongs to.
    pub surface: SurfaceId,
    /// Its index among the surface's faces as they were given.
    pub input_index: u32,
    /// How it is cut.
    pub grid: Grid,
    /// Its first patch; the others follow in row order.
    pub first_patch: usize,
}

impl Face {
    /// Whether it only stands in the way.
    pub fn is_bare(&self) -> bool {
        self.grid.cells() == 0
    }

    /// The indices of its patches.
    pub fn patches(&self) -> std::ops::Range<usize> {
        self.first_patch..self.first_patch + self.grid.cells()
    }
}

/// One cell of a face: the finite element on which radiosity is constant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Patch {
    /// Its outline.
    pub polygon: Polygon,
    /// Centre of mass.
    pub centroid: DVec3,
    /// Unit normal of the front.
    pub normal: DVec3,
    /// Area in square scene units.
    pub area: f64,
    /// The face it is a cell of.
    pub face: FaceId,
    /// The surface it is part of.
    pub surface: SurfaceId,
    /// On quads, the cell along edge a and edge b. On triangles, the row parallel to the edge
    /// from corner 0 to corner 2 and the position in it (even: same orientation as the face). On
    /// narrow triangles, the row, counted from the longest edge, and the position in it, along that
    /// edge.
    pub cell: [u32; 2],
}

/// All patches and the faces they subdivide.
///
/// Order: surfaces as they were given; the faces of each as they were given or along a
/// space-filling curve ([`FaceOrder`](crate::FaceOrder)); cells in row order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mesh {
    /// The patches; their index is their identity everywhere later.
    pub patches: Vec<Patch>,
    /// The faces.
    pub faces: Vec<Face>,
    /// Which of them lie on which others.
    pub covers: Covers,
}

impl Mesh {
    /// The face that a patch is a cell of.
    pub fn face_of(&self, patch: usize) -> &Face {
        &self.faces[self.patches[patch].face.index()]
    }

    /// The patches of each input face of a surface, in the order of the input. The halves of a quad
    /// follow each other.
    ///
    /// # Panics
    ///
    /// If the faces are not in the order in which they were given
    /// ([`FaceOrder`](crate::FaceOrder)).
    pub fn patches_of_surface(&self, surface: SurfaceId) -> Vec<std::ops::Range<usize>> {
        let own = self.faces.iter().filter(|face| face.surface == surface);
        let mut ranges: Vec<std::ops::Range<usize>> = Vec::new();
        for face in own {
            match face.input_index as usize + 1 {
                known if known == ranges.len() => ranges[known - 1].end = face.patches().end,
                next if next == ranges.len() + 1 => ranges.push(face.patches()),
                _ => panic!("faces are not in the order in which they were given"),
            }
        }
        ranges
    }

    /// The smallest box around all faces.
    pub fn bounds(&self) -> Aabb {
        let corners = self.faces.iter().flat_map(|face| face.polygon.corners());
        Aabb::around(corners.copied())
    }

    /// The sum of all patch areas.
    pub fn total_area(&self) -> f64 {
        self.patches.iter().map(|patch| patch.area).sum()
    }
}
