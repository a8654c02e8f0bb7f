//! What a run needs, and whether the machine has it.

use crate::error::Error;
use radiosity_cache::Store;
use radiosity_form_factors::Estimator;
use radiosity_matrix::packed_len;
use std::path::Path;

/// Predicted needs of a run with its form factors computed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Needs {
    pub(crate) patches: usize,
    pub(crate) pairs: u64,
    /// Bytes of memory at the peak.
    pub(crate) memory: u64,
    /// Bytes of the cached form factors.
    pub(crate) disk: u64,
}

/// Patch with its face, materials and radiosities, twice over for what is passed on.
const BYTES_PER_PATCH: u64 = 2048;
/// A point with the area it stands for.
const BYTES_PER_POINT: u64 = 32;
/// What the accurate estimator stores of a patch, in points.
const ACCURATE_POINTS: u64 = 48;
/// Two linear images, as they are made and apart, and one of them shown and encoded.
const BYTES_PER_PIXEL: u64 = 2 * 2 * 12 + 6 + 12;
/// The share of the free memory that a run may take.
const USABLE_SHARE: f64 = 0.9;

impl Needs {
    pub(crate) fn of(patches: usize, estimator: Estimator) -> Needs {
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
            pairs,
            memory: matrix + per_patch * patches as u64,
            disk: matrix + 48 * patches as u64,
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
                remedy: "use --no-cache, or a folder on another disk with --cache".to_owned(),
            }),
            _ => Ok(()),
        }
    }

    /// Refuses what does not fit into memory, with a remedy.
    pub(crate) fn check_memory(&self) -> Result<(), Error> {
        match usable_memory() {
            Some(usable) if self.memory > usable => Err(Error::Resources {
                problem: format!(
                    "{} patches need {} of memory, but only {} can be used",
                    grouped(self.patches as u64),
                    bytes(self.memory),
                    bytes(usable),
                ),
                remedy: format!(
                    "use fewer patches (--patches, --max-patch-edge): about {} fit",
                    grouped(two_digits((usable as f64 / 2.0).sqrt() as u64)),
                ),
            }),
            _ => Ok(()),
        }
    }
}

/// Refuses pictures that do not fit into memory.
pub(crate) fn check_image(width: u32, height: u32) -> Result<(), Error> {
    let needed = u64::from(width) * u64::from(height) * BYTES_PER_PIXEL;
    match usable_memory() {
        Some(usable) if needed > usable => Err(Error::Resources {
            problem: format!(
                "pictures of {width} x {height} pixels need {} of memory, but only {} can be used",
                bytes(needed),
                bytes(usable),
            ),
            remedy: "make them smaller (--size)".to_owned(),
        }),
        _ => Ok(()),
    }
}

/// Refuses files that do not fit into memory.
pub(crate) fn check_file(path: &Path, size: u64) -> Result<(), Error> {
    match usable_memory() {
        Some(usable) if size > usable => Err(Error::Resources {
            problem: format!(
                "{} has {}, but only {} of memory can be used",
                path.display(),
                bytes(size),
                bytes(usable),
            ),
            remedy: "give a smaller file".to_owned(),
        }),
        _ => Ok(()),
    }
}

/// Refuses a matrix between so many parts that does not fit into memory.
pub(crate) fn check_parts(parts: usize) -> Result<(), Error> {
    let needed = 8 * (parts as u64).pow(2);
    match usable_memory() {
        Some(usable) if needed > usable => Err(Error::Resources {
            problem: format!(
                "the factors between {} parts need {} of memory, but only {} can be used",
                grouped(parts as u64),
                bytes(needed),
                bytes(usable),
            ),
            remedy: "export them --by patch, or put surfaces into fewer groups".to_owned(),
        }),
        _ => Ok(()),
    }
}

fn usable_memory() -> Option<u64> {
    free_memory().map(|free| (free as f64 * USABLE_SHARE) as u64)
}

/// What the machine, or the container it runs in, has left; unknown on rare systems.
fn free_memory() -> Option<u64> {
    let mut system = sysinfo::System::new().ok()?;
    system.refresh_memory();
    let limit = system.cgroup_limits().map_or(u64::MAX, |c| c.free_memory);
    Some(system.available_memory().min(limit))
}

/// Free bytes on the disk of a folder that need not exist yet.
fn free_disk(folder: &Path) -> Option<u64> {
    let existing = folder.ancestors().find(|f| f.exists());
    let here = existing.unwrap_or(Path::new("."));
    fs4::available_space(here).ok()
}

/// Rounded down to two digits: what an estimate deserves.
fn two_digits(n: u64) -> u64 {
    let unit = 10u64.pow(n.checked_ilog10().unwrap_or(0).saturating_sub(1));
    n / unit * unit
}

/// A number with its thousands apart.
pub(crate) fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3);
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// How many there are of something: one of it, or more.
pub(crate) fn counted(n: usize, [one, more]: [&str; 2]) -> String {
    format!("{} {}", grouped(n as u64), if n == 1 { one } else { more })
}

/// For [`counted`].
pub(crate) const SURFACES: [&str; 2] = ["surface", "surfaces"];
/// For [`counted`].
pub(crate) const PATCHES: [&str; 2] = ["patch", "patches"];

/// A size in decimal units.
pub(crate) fn bytes(n: u64) -> String {
    let units = ["B", "kB", "MB", "GB", "TB"];
    let mut size = n as f64;
    let mut unit = 0;
    while size >= 999.5 && unit + 1 < units.len() {
        size /= 1000.0;
        unit += 1;
    }
    if unit == 0 || size >= 99.5 {
        format!("{size:.0} {}", units[unit])
    } else {
        format!("{size:.1} {}", units[unit])
    }
}

/// A duration in words.
pub(crate) fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 1.0 => "under a second".to_owned(),
        s if s < 100.0 => format!("about {s:.0} s"),
        s if s < 5400.0 => format!("about {:.0} min", s / 60.0),
        s => format!("about {:.1} h", s / 3600.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_are_readable() {
        assert_eq!([0, 7, 99, 105_701].map(two_digits), [0, 7, 99, 100_000]);
        assert_eq!(
            ["0", "999", "1,728", "1,492,128"],
            [0, 999, 1728, 1_492_128].map(grouped)[..]
        );
        assert_eq!(
            ["0 patches", "1 patch", "2,400 patches"],
            [0, 1, 2400].map(|n| counted(n, PATCHES))[..]
        );
        let sizes = [12, 999, 1_000, 5_968_512, 123_456_789, 1_530_000_000].map(bytes);
        assert_eq!(
            sizes,
            ["12 B", "999 B", "1.0 kB", "6.0 MB", "123 MB", "1.5 GB"]
        );
        let times = [0.1, 7.4, 600.0, 9000.0].map(duration);
        assert_eq!(
            times,
            ["under a second", "about 7 s", "about 10 min", "about 2.5 h"]
        );
    }

    #[test]
    fn impossible_runs_are_refused_with_a_remedy() {
        let needs = |patches, points| Needs::of(patches, Estimator::Regular { points });
        let error = needs(1 << 20, 3).check_memory().unwrap_err().to_string();
        assert!(
            error.contains("1,048,576 patches need 2.2 TB of memory"),
            "{error}"
        );
        assert!(error.contains("use fewer patches"), "{error}");
        assert!(needs(100, 3).check_memory().is_ok());
        assert!(needs(4000, 64).memory > 500_000_000, "points count too");
        let error = check_parts(1 << 20).unwrap_err().to_string();
        assert!(
            error.contains("8.8 TB") && error.contains("--by"),
            "{error}"
        );
        let error = check_image(1 << 16, 1 << 16).unwrap_err().to_string();
        assert!(
            error.contains("283 GB") && error.contains("--size"),
            "{error}"
        );
    }
}
