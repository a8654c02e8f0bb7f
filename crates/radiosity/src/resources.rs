//! What a run needs, and whether the machine has it.

use crate::error::Error;
use crate::machine::{free_disk, usable_memory};
use crate::remedy::Remedy;
use crate::words::{bytes, grouped};
use radiosity_cache::Store;
use radiosity_form_factors::Estimator;
use radiosity_matrix::packed_len;
use std::path::Path;

/// Predicted needs of a run with its form factors computed.
#[derive(Clone, Copy, Debug)]
pub struct Needs {
    /// How many patches there are.
    pub patches: usize,
    /// The fewest patches that the scene could have: one a face.
    faces: usize,
    /// Pairs of patches.
    pub pairs: u64,
    /// How many matrices are there at once.
    matrices: u64,
    /// Bytes of memory at the peak.
    pub memory: u64,
    /// Bytes of the cached form factors.
    pub disk: u64,
}

/// The program itself.
const BYTES_OF_PROGRAM: u64 = 7_000_000;
/// Patch with its face, materials and radiosities, twice over for what is passed on.
const BYTES_PER_PATCH: u64 = 2048;
/// An undivided face with its share of what rays and tiles need, as measured on meshes.
const BYTES_PER_FACE: u64 = 2800;
/// A point with the area it stands for.
const BYTES_PER_POINT: u64 = 32;
/// What the accurate estimator stores of a patch, in points.
const ACCURATE_POINTS: u64 = 48;
/// Two linear images, as they are made and apart, and one of them shown and encoded.
const BYTES_PER_PIXEL: u64 = 2 * 2 * 12 + 6 + 12;

impl Needs {
    /// Those of so many patches on so many faces.
    pub fn of(patches: usize, faces: usize, estimator: Estimator) -> Needs {
        let pairs = packed_len(patches) as u64;
        let matrix = 4 * pairs;
        let stored_points = match estimator {
            Estimator::Regular { points } => u64::from(points).pow(2),
            Estimator::MonteCarlo { .. } => 0,
            Estimator::Accurate { .. } => ACCURATE_POINTS,
        };
        let per_patch = BYTES_PER_PATCH + BYTES_PER_POINT * stored_points;
        Needs {
            patches,
            faces,
            pairs,
            matrices: 1,
            memory: BYTES_OF_PROGRAM
                + matrix
                + per_patch * patches as u64
                + BYTES_PER_FACE * faces as u64,
            disk: matrix + 48 * patches as u64,
        }
    }

    /// The same with form factors that are closed once they are estimated, if they are: both are
    /// kept.
    pub fn with_closure(self, is_closed: bool) -> Needs {
        let copies = u64::from(is_closed);
        Needs {
            matrices: self.matrices + copies,
            memory: self.memory + copies * 4 * self.pairs,
            disk: self.disk * (1 + copies),
            ..self
        }
    }

    /// Refuses what does not fit on the disk beside the bytes that are there, with a remedy.
    pub(crate) fn check_disk(&self, cache: &Store, there: u64) -> Result<(), Error> {
        let missing = self.disk.saturating_sub(there);
        match free_disk(cache.folder()) {
            Some(free) if missing > free => Err(Error::Resources {
                problem: format!(
                    "the form factors need {} of disk, but the cache folder has only {} free",
                    bytes(missing),
                    bytes(free)
                ),
                remedy: Remedy::CacheDisk,
            }),
            _ => Ok(()),
        }
    }

    /// Refuses what does not fit into memory, with a remedy.
    pub fn check_memory(&self) -> Result<(), Error> {
        match usable_memory() {
            Some(usable) if self.memory > usable => Err(Error::Resources {
                problem: format!(
                    "{} patches need {} of memory, but only {} can be used",
                    grouped(self.patches as u64),
                    bytes(self.memory),
                    bytes(usable),
                ),
                remedy: self.remedy(usable),
            }),
            _ => Ok(()),
        }
    }

    /// What makes it fit into so much memory.
    fn remedy(&self, usable: u64) -> Remedy {
        // Of n patches, 4 bytes for each of n (n - 1) / 2 pairs, and as many a patch as here.
        let of_square = (2 * self.matrices) as f64;
        let of_patches = self.memory - BYTES_OF_PROGRAM - 4 * self.matrices * self.pairs;
        let half = of_patches as f64 / self.patches as f64 / of_square / 2.0 - 0.5;
        let free = usable.saturating_sub(BYTES_OF_PROGRAM) as f64;
        let fit = ((half * half + free / of_square).sqrt() - half) as u64;
        let about = two_digits(fit);
        if self.faces as u64 > fit {
            Remedy::Words(format!(
                "use coarser meshes, or split the scene: each of its {} faces is a patch at \
                 least, and about {} fit",
                grouped(self.faces as u64),
                grouped(about)
            ))
        } else {
            Remedy::FewerPatches { fit: Some(about) }
        }
    }
}

/// Refuses a file of so many bytes in a folder whose disk has less room.
pub fn check_export(folder: &Path, needed: u64) -> Result<(), Error> {
    match free_disk(folder) {
        Some(free) if needed > free => Err(Error::Resources {
            problem: format!(
                "the export needs {} of disk, but only {} are free there",
                bytes(needed),
                bytes(free)
            ),
            remedy: Remedy::SmallerExport,
        }),
        _ => Ok(()),
    }
}

/// Refuses pictures that do not fit into memory.
pub fn check_image(width: u32, height: u32) -> Result<(), Error> {
    let needed = u64::from(width) * u64::from(height) * BYTES_PER_PIXEL;
    let what = format!("pictures of {width} x {height} pixels need");
    check_needed(&what, needed, Remedy::SmallerPictures)
}

/// Refuses a picture whose comparison does not fit into memory.
pub fn check_comparison(
    path: &Path,
    (width, height): (u32, u32),
    bytes_per_pixel: u64,
) -> Result<(), Error> {
    let needed = u64::from(width) * u64::from(height) * bytes_per_pixel;
    let what = format!(
        "comparing {} with {width} x {height} pixels needs",
        path.display()
    );
    check_needed(
        &what,
        needed,
        Remedy::words("compare smaller pictures, or the same part of both"),
    )
}

/// Refuses files that do not fit into memory.
pub fn check_file(path: &Path, size: u64) -> Result<(), Error> {
    let what = format!("reading {} needs", path.display());
    check_needed(&what, size, Remedy::words("give a smaller file"))
}

/// Refuses a matrix between so many parts that does not fit into memory.
pub(crate) fn check_parts(parts: usize, remedy: Remedy) -> Result<(), Error> {
    let what = format!("the factors between {} parts need", grouped(parts as u64));
    check_needed(&what, 8 * (parts as u64).pow(2), remedy)
}

/// Refuses what needs more memory than there is: a remedy is told.
fn check_needed(what: &str, needed: u64, remedy: Remedy) -> Result<(), Error> {
    match usable_memory() {
        Some(usable) if needed > usable => Err(Error::Resources {
            problem: format!(
                "{what} {} of memory, but only {} can be used",
                bytes(needed),
                bytes(usable),
            ),
            remedy,
        }),
        _ => Ok(()),
    }
}

/// Rounded down to two digits: what an estimate deserves.
fn two_digits(n: u64) -> u64 {
    let unit = 10u64.pow(n.checked_ilog10().unwrap_or(0).saturating_sub(1));
    n / unit * unit
}

#[cfg(test)]
mod tests;
