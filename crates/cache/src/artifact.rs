//! Artifacts that were read from files.

use crate::digests::{Digest, Digests};
use crate::format::{self, Header, Miss};
use crate::key::Key;
use crate::values::{InUse, Stamp, Values};
use serde::de::DeserializeOwned;
use std::fs::File;
use std::io::BufReader;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// An artifact read from a file.
#[derive(Debug)]
pub struct Artifact<F> {
    /// The small typed part.
    pub facts: F,
    values: ValuesOf,
    block_digests: Vec<Digest>,
}

/// A file of the cache, whatever artifact it holds.
#[derive(Debug)]
pub struct Opened {
    /// The stage that made it.
    pub stage: String,
    /// Its identity.
    pub key: Key,
    header: Header,
    values: ValuesOf,
}

/// Where values are that nobody has asked for yet.
#[derive(Debug)]
struct ValuesOf {
    path: PathBuf,
    file: File,
    range: Range<u64>,
    stamp: Stamp,
    in_use: Arc<InUse>,
}

/// Opens a file of the cache that nobody asked for by its inputs. Everything is checked but the
/// digests of its values.
pub fn open(path: &Path) -> Result<Opened, Miss> {
    Opened::at(path, Arc::default())
}

impl Opened {
    pub(crate) fn at(path: &Path, in_use: Arc<InUse>) -> Result<Opened, Miss> {
        let file = File::open(path)?;
        let stamp = Stamp::of(&file)?;
        let (header, range) = format::read_head(&mut BufReader::new(&file), stamp.len)?;
        Ok(Opened {
            stage: header.stage.clone(),
            key: Key(header.key),
            header,
            values: ValuesOf {
                path: path.to_owned(),
                file,
                range,
                stamp,
                in_use,
            },
        })
    }

    /// The artifact, if its facts are of this type.
    pub fn into_artifact<F: DeserializeOwned>(self) -> Result<Artifact<F>, Miss> {
        Ok(Artifact {
            facts: self.header.facts()?,
            values: self.values,
            block_digests: self.header.block_digests,
        })
    }
}

impl ValuesOf {
    fn get(self) -> Result<Values, Miss> {
        let values = Values::of(&self.path, &self.file, self.range, self.stamp)?;
        values
            .source()
            .into_iter()
            .for_each(|source| self.in_use.add(source));
        Ok(values)
    }
}

impl<F> Artifact<F> {
    /// The big array, its digests checked.
    pub fn into_values(self) -> Result<(F, Values), Miss> {
        let values = self.values.get()?;
        let digests = Digests::of(values.as_ref()).all();
        let is_good = |(found, expected)| found == expected;
        let good = digests
            .iter()
            .zip(&self.block_digests)
            .take_while(|&pair| is_good(pair));
        match good.count() {
            all if all == digests.len() && all == self.block_digests.len() => {
                Ok((self.facts, values))
            }
            block => Err(Miss::Block { block }),
        }
    }
}
