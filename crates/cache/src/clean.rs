//! Removes artifacts that are no longer wanted, the least recently used first.

use crate::cache_file::{CacheFile, lock_of};
use crate::last_use::modified;
use crate::lock::Lock;
use crate::store::{CacheError, Store};
use std::fs;
use std::io::ErrorKind;
use std::path::Path;
use std::time::{Duration, SystemTime};

#[cfg(test)]
mod tests;

/// What stays in the cache; with no limit given, nothing does.
#[derive(Clone, Copy, Debug, Default)]
pub struct Limits {
    /// What was neither written nor read for longer goes.
    pub age: Option<Duration>,
    /// The least recently used go until all that is left is no larger, in bytes.
    pub bytes: Option<u64>,
}

/// Some files of the cache. Locks and notes of use are not counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Amount {
    /// How many.
    pub files: usize,
    /// Their size.
    pub bytes: u64,
}

/// What [`Store::clean`] did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cleaned {
    /// What it removed.
    pub removed: Amount,
    /// What is left, by the limits or because it is in use.
    pub left: Amount,
    /// What would have gone, but another process has its lock.
    pub in_use: Amount,
}

/// The files of one artifact: it goes with all that belongs to it.
struct Group {
    files: Vec<CacheFile>,
    amount: Amount,
    /// `None` where the file system does not tell.
    last_use: Option<SystemTime>,
}

impl Store {
    /// Removes all artifacts that the limits do not spare, with what interrupted processes left of
    /// them. Those that another process is making are left alone, and so is whatever does not have
    /// the name of a cached file.
    pub fn clean(&self, limits: Limits) -> Result<Cleaned, CacheError> {
        let now = SystemTime::now();
        let groups = self.groups_by_last_use()?;
        let mut cleaned = Cleaned::default();
        groups
            .iter()
            .for_each(|group| cleaned.left.add(group.amount));
        for group in groups {
            if limits.spare(&group, now, cleaned.left.bytes) {
                continue;
            }
            if group.remove()? {
                cleaned.removed.add(group.amount);
                cleaned.left.subtract(group.amount);
            } else {
                cleaned.in_use.add(group.amount);
            }
        }
        Ok(cleaned)
    }

    /// All that is in the folder, the least recently used first.
    fn groups_by_last_use(&self) -> Result<Vec<Group>, CacheError> {
        let mut groups: Vec<Group> = Vec::new();
        // Files of one artifact come one after the other: their names begin alike.
        for file in self.files()? {
            match groups.last_mut() {
                Some(group) if group.artifact() == file.artifact => group.files.push(file),
                _ => groups.push(Group::of(file)),
            }
        }
        groups.iter_mut().for_each(Group::measure);
        groups.sort_by_key(|group| group.last_use);
        Ok(groups)
    }
}

impl Limits {
    /// Whether an artifact stays when there are so many bytes in all.
    fn spare(self, group: &Group, now: SystemTime, bytes: u64) -> bool {
        let is_limited = self.age.is_some() || self.bytes.is_some();
        let is_young = self.age.is_none_or(|limit| group.age(now) <= limit);
        let is_room = self.bytes.is_none_or(|limit| bytes <= limit);
        // Whoever removes an artifact by hand leaves the note of its use.
        let is_something = group.amount.files > 0;
        is_limited && is_young && is_room && is_something
    }
}

impl Group {
    fn of(file: CacheFile) -> Group {
        Group {
            files: vec![file],
            amount: Amount::default(),
            last_use: None,
        }
    }

    fn artifact(&self) -> &Path {
        &self.files[0].artifact
    }

    /// Finds out how large it is, and when it was last used.
    fn measure(&mut self) {
        let files = self.files.iter().filter(|file| !file.is_lock());
        self.last_use = files.clone().filter_map(|file| modified(&file.path)).max();
        for file in files.filter(|file| !file.is_last_use()) {
            self.amount.add(Amount {
                files: 1,
                bytes: fs::metadata(&file.path).map_or(0, |metadata| metadata.len()),
            });
        }
    }

    /// Zero if it will be used in the future, by its clock; the longest there is if it is unknown.
    fn age(&self, now: SystemTime) -> Duration {
        self.last_use.map_or(Duration::MAX, |last_use| {
            now.duration_since(last_use).unwrap_or_default()
        })
    }

    /// Removes all of it, unless another process has its lock; whether it is gone.
    fn remove(&self) -> Result<bool, CacheError> {
        let lock = lock_of(self.artifact());
        let taken = Lock::try_take(lock.clone()).map_err(CacheError::new("lock", &lock))?;
        let Some(_lock) = taken else {
            return Ok(false);
        };
        // Dropping the lock removes its file, where the system allows that.
        for file in self.files.iter().filter(|file| !file.is_lock()) {
            match fs::remove_file(&file.path) {
                Err(error) if error.kind() != ErrorKind::NotFound => {
                    return Err(CacheError::new("remove", &file.path)(error));
                }
                _ => {}
            }
        }
        Ok(true)
    }
}

impl Amount {
    fn add(&mut self, other: Amount) {
        self.files += other.files;
        self.bytes += other.bytes;
    }

    fn subtract(&mut self, other: Amount) {
        self.files -= other.files;
        self.bytes -= other.bytes;
    }
}
