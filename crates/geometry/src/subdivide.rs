//! Stage 1: surfaces into patches.
//!
//! Long because: the stage's input, its errors and the cells of each shape.

pub(crate) mod grids;
mod morton;
pub(crate) mod narrow;

use crate::coplanar::covers::Covers;
use crate::discretization::Divisions;
use crate::mesh::{Face, FaceId, Grid, Mesh, Patch, SurfaceId};
use crate::polygon::Polygon;
use crate::shape::Shape;
use crate::shape_error::ShapeError;
use crate::subdivide::grids::with_grids;

/// A shape to be cut, and how finely if not as the scene's default says.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Its geometry.
    pub shape: Shape,
    /// Overrides the default of [`subdivide`].
    pub divisions: Option<Divisions>,
}

impl From<Shape> for Surface {
    /// Cut as the default says.
    fn from(shape: Shape) -> Surface {
        Surface {
            shape,
            divisions: None,
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

/// In which order the faces of a mesh are numbered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaceOrder {
    /// As the caller has them.
    Given,
    /// Along a space-filling curve: what is near in space is near in the matrix, and large meshes
    /// take less time. [`Face::input_index`] tells where a face was given.
    Curve,
}

/// Cuts all surfaces into patches, numbered in the order of surfaces, their faces, and the cells of
/// these: the patches of face `k` are `mesh.faces[k].patches()`. A quad of a mesh is two faces if
/// it is not planar, or if it is slanted and cut by edge length; [`Mesh::patches_of_surface`]
/// takes them together.
///
/// A count as `default` applies to parallelograms, triangles and quads; the faces of meshes
/// are patches as they are unless the default is an edge length or the surface has its own
/// divisions.
///
/// ```
/// use radiosity_geometry::{DVec3, Divisions, Shape, subdivide};
///
/// let corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
/// let square = Shape::Quad(corners.map(DVec3::from));
/// let mesh = subdivide(&[square.into()], Divisions::MaxEdge(0.5))?;
/// assert_eq!(mesh.faces[0].patches(), 0..8);
/// assert_eq!(mesh.patches[0].area, 0.25);
/// # Ok::<(), radiosity_geometry::MeshError>(())
/// ```
pub fn subdivide(surfaces: &[Surface], default: Divisions) -> Result<Mesh, MeshError> {
    subdivide_in(FaceOrder::Given, surfaces, default)
}

/// [`subdivide`] with the faces of meshes in an order of choice.
pub fn subdivide_in(
    order: FaceOrder,
    surfaces: &[Surface],
    default: Divisions,
) -> Result<Mesh, MeshError> {
    let faces = uncut_faces(surfaces, default, order)?;
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
    let faces = uncut_faces(surfaces, default, FaceOrder::Given)?;
    Ok(faces.iter().map(|face| face.grid.cells()).sum())
}

fn uncut_faces(
    surfaces: &[Surface],
    default: Divisions,
    order: FaceOrder,
) -> Result<Vec<Face>, MeshError> {
    let mut faces = Vec::new();
    for (index, surface) in surfaces.iter().enumerate() {
        let id = SurfaceId(index as u32);
        let divisions = divisions_of(surface, default);
        for (input_index, polygon) in polygons_in(order, id, &surface.shape)? {
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

/// The faces of a surface with their input positions.
fn polygons_in(
    order: FaceOrder,
    surface: SurfaceId,
    shape: &Shape,
) -> Result<Vec<(u32, Polygon)>, MeshError> {
    let polygons = shape.polygons();
    let polygons = polygons.map_err(|error| MeshError::Shape { surface, error })?;
    Ok(match order {
        FaceOrder::Given => polygons,
        FaceOrder::Curve => {
            let centroids: Vec<_> = polygons.iter().map(|(_, p)| p.centroid()).collect();
            let order = morton::order(&centroids);
            order.into_iter().map(|k| polygons[k]).collect()
        }
    })
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
