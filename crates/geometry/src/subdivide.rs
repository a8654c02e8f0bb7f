//! Stage 1: surfaces into patches.
//!
//! Long because: the stage's input, its errors and the cells of each shape.

use crate::check::ShapeError;
use crate::covers::Covers;
use crate::grids::with_grids;
use crate::mesh::{Face, FaceId, Grid, Mesh, Patch, SurfaceId};
use crate::morton;
use crate::polygon::Polygon;
use crate::shape::Shape;

/// How finely a surface is cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Divisions {
    /// `a x b` cells on parallelograms and quads; `a^2` on triangles, where `a` equals `b`.
    Count {
        /// Cells along edge a.
        a: u32,
        /// Cells along edge b.
        b: u32,
    },
    /// As few cells as keep every patch edge at most this long, in scene units. Faces of meshes
    /// take the next power of two, so that neighbours of different size fit together. Triangles
    /// that are narrow are cut along each edge as its length asks for, the others alike along all
    /// edges.
    MaxEdge(f64),
    /// No cells at all: the surface stands in the way, and neither emits nor receives.
    Uncut,
}

impl Divisions {
    /// The same count along both edges.
    pub const fn uniform(n: u32) -> Divisions {
        Divisions::Count { a: n, b: n }
    }
}

/// A shape to be cut, and how finely if not as the scene's default says.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Its geometry.
    pub shape: Shape,
    /// Overrides the default of [`subdivide`].
    pub divisions: Option<Divisions>,
}

impl Surface {
    /// The same shape, cut as the default says, unless it is not to be cut at all.
    pub fn without_divisions(&self) -> Surface {
        let is_uncut = |divisions: &Divisions| *divisions == Divisions::Uncut;
        Surface {
            shape: self.shape.clone(),
            divisions: self.divisions.filter(is_uncut),
        }
    }
}

/// Why a scene cannot be cut into patches.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// A shape is unusable.
    #[error("surface {} {error}", surface.0)]
    Shape {
        /// The surface.
        surface: SurfaceId,
        /// What is wrong with it.
        error: ShapeError,
    },
    /// A triangle was asked for different counts along its edges.
    #[error("surface {} is made of triangles, which take one count, not {a} x {b}", surface.0)]
    TwoCountsOnTriangle {
        /// The surface.
        surface: SurfaceId,
        /// Count along edge a.
        a: u32,
        /// Count along edge b.
        b: u32,
    },
    /// A count is zero or an edge length is not a positive number.
    #[error("surface {} has no usable subdivision: counts and lengths must be positive", surface.0)]
    NoDivisions {
        /// The surface.
        surface: SurfaceId,
    },
    /// A patch is so small beside the coordinates that these have no digits left for it.
    #[error(
        "surface {} has a patch of size {size:.1e} where coordinates are up to {largest:.1e}: \
         at least {allowed:.1e} is needed; move the scene to the origin, or leave out what is \
         far away",
        surface.0, allowed = LEAST_SIZE * largest
    )]
    NoDigits {
        /// The surface.
        surface: SurfaceId,
        /// The longest edge of a patch of it.
        size: f64,
        /// The largest coordinate of the scene.
        largest: f64,
    },
    /// More patches than indices can name.
    #[error("the subdivision gives more than 1,048,576 patches; choose a coarser one")]
    TooManyPatches,
    /// There is nothing to cut.
    #[error("the scene has no surfaces, or none that emit and receive")]
    Empty,
}

/// The largest number of patches a mesh may have; their matrix would already fill 2 TB.
pub const MAX_PATCHES: usize = 1 << 20;

/// The least size of a patch, relative to the largest coordinate of the scene: a hundred times what
/// counts as rounding.
pub const LEAST_SIZE: f64 = 1e-10;

/// Cuts all surfaces into patches.
///
/// A count as `default` applies to parallelograms, triangles and quads; the faces of meshes
/// are patches as they are unless the default is an edge length or the surface has its own
/// divisions.
pub fn subdivide(surfaces: &[Surface], default: Divisions) -> Result<Mesh, MeshError> {
    let faces = uncut_faces(surfaces, default)?;
    let mut mesh = Mesh {
        patches: Vec::new(),
        covers: Covers::of(&faces),
        faces,
    };
    let mut first_patch = 0;
    for face in &mut mesh.faces {
        face.first_patch = first_patch;
        first_patch += face.grid.cells();
    }
    mesh.patches.reserve_exact(first_patch);
    for (index, face) in mesh.faces.iter().enumerate() {
        let patch = |(cell, polygon)| new_patch(face, FaceId(index as u32), cell, polygon);
        mesh.patches.extend(cells(face).into_iter().map(patch));
    }
    Ok(mesh)
}

/// Refuses patches for which coordinates leave no digits.
fn check_sizes(faces: &[Face]) -> Result<(), MeshError> {
    let corners = faces.iter().flat_map(|face| face.polygon.corners());
    let largest = corners.fold(0.0, |largest, corner| {
        corner.abs().max_element().max(largest)
    });
    let size = |face: &Face| {
        let cells = match face.grid {
            Grid::Quad { a, b } => a.max(b),
            Grid::Triangle { n } => n,
            Grid::Narrow(grid) => grid.line(0),
        };
        face.polygon.longest_edge() / f64::from(cells.max(1))
    };
    match faces.iter().find(|face| size(face) < LEAST_SIZE * largest) {
        Some(face) => Err(MeshError::NoDigits {
            surface: face.surface,
            size: size(face),
            largest,
        }),
        None => Ok(()),
    }
}

/// How many patches [`subdivide`] would give, without making them.
pub fn count_patches(surfaces: &[Surface], default: Divisions) -> Result<usize, MeshError> {
    let faces = uncut_faces(surfaces, default)?;
    Ok(faces.iter().map(|face| face.grid.cells()).sum())
}

fn uncut_faces(surfaces: &[Surface], default: Divisions) -> Result<Vec<Face>, MeshError> {
    let mut faces = Vec::new();
    for (index, surface) in surfaces.iter().enumerate() {
        let id = SurfaceId(index as u32);
        let divisions = divisions_of(surface, default);
        for (input_index, polygon) in ordered_polygons(id, &surface.shape)? {
            for (polygon, grid) in with_grids(id, surface, polygon, divisions)? {
                faces.push(Face {
                    normal: polygon.normal(),
                    grid,
                    polygon,
                    surface: id,
                    input_index,
                    first_patch: 0,
                });
            }
        }
    }
    check_sizes(&faces)?;
    let patches = faces
        .iter()
        .try_fold(0usize, |sum, face| sum.checked_add(face.grid.cells()));
    match patches {
        Some(0) => Err(MeshError::Empty),
        Some(1..=MAX_PATCHES) => Ok(faces),
        _ => Err(MeshError::TooManyPatches),
    }
}

fn divisions_of(surface: &Surface, default: Divisions) -> Divisions {
    match (surface.divisions, &surface.shape, default) {
        (Some(own), _, _) => own,
        (None, Shape::Mesh(_), Divisions::Count { .. }) => Divisions::uniform(1),
        (None, _, default) => default,
    }
}

/// The faces of a surface along a space-filling curve, with their input positions.
fn ordered_polygons(surface: SurfaceId, shape: &Shape) -> Result<Vec<(u32, Polygon)>, MeshError> {
    let polygons = shape
        .polygons()
        .map_err(|error| MeshError::Shape { surface, error })?;
    let centroids: Vec<_> = polygons.iter().map(|(_, p)| p.centroid()).collect();
    let order = morton::order(&centroids);
    Ok(order.into_iter().map(|k| polygons[k]).collect())
}

fn new_patch(face: &Face, id: FaceId, cell: [u32; 2], polygon: Polygon) -> Patch {
    Patch {
        polygon,
        centroid: polygon.centroid(),
        normal: face.normal,
        area: polygon.area(),
        face: id,
        surface: face.surface,
        cell,
    }
}

fn cells(face: &Face) -> Vec<([u32; 2], Polygon)> {
    match face.grid {
        Grid::Quad { a, b } => quad_cells(&face.polygon, a, b),
        Grid::Triangle { n } => triangle_cells(&face.polygon, n),
        Grid::Narrow(grid) => grid.polygons(&face.polygon),
    }
}

fn quad_cells(polygon: &Polygon, a: u32, b: u32) -> Vec<([u32; 2], Polygon)> {
    let at =
        |i: u32, j: u32| polygon.bilinear(f64::from(i) / f64::from(a), f64::from(j) / f64::from(b));
    let cell = |i, j| {
        let corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        ([i, j], Polygon::quad(corners))
    };
    (0..a)
        .flat_map(|i| (0..b).map(move |j| (i, j)))
        .map(|(i, j)| cell(i, j))
        .collect()
}

fn triangle_cells(polygon: &Polygon, n: u32) -> Vec<([u32; 2], Polygon)> {
    let at = |i: u32, j: u32| {
        polygon.barycentric(f64::from(i) / f64::from(n), f64::from(j) / f64::from(n))
    };
    let mut cells = Vec::with_capacity(n as usize * n as usize);
    for i in 0..n {
        for j in 0..n - i {
            let upright = [at(i, j), at(i + 1, j), at(i, j + 1)];
            cells.push(([i, 2 * j], Polygon::triangle(upright)));
            if i + j + 1 < n {
                let inverted = [at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                cells.push(([i, 2 * j + 1], Polygon::triangle(inverted)));
            }
        }
    }
    cells
}
