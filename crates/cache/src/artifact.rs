//! Artifacts that were read from files.

use crate::digests::{Digest, Digests};
use crate::format::{self, Header, Miss};
use crate::key::Key;
use crate::mapping::{self, MappedValues};
use serde::de::DeserializeOwned;
use std::fs::File;
use std::path::Path;

/// An artifact read from a file.
#[derive(Debug)]
pub struct Artifact<F> {
    /// The small typed part.
    pub facts: F,
    values: MappedValues,
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
    values: MappedValues,
}

/// Opens a file of the cache that nobody asked for by its inputs. Everything is checked but the
/// digests of its values.
pub fn open(path: &Path) -> Result<Opened, Miss> {
    Opened::of(&File::open(path)?)
}

impl Opened {
    pub(crate) fn of(file: &File) -> Result<Opened, Miss> {
        let map = mapping::map(file)?;
        let (header, values) = format::parse(&map)?;
        Ok(Opened {
            stage: header.stage.clone(),
            key: Key(header.key),
            header,
            values: MappedValues::new(map, values),
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

impl<F> Artifact<F> {
    /// The big array, its digests checked.
    pub fn into_values(self) -> Result<(F, MappedValues), Miss> {
        let digests = Digests::of(self.values.as_ref()).all();
        let is_good = |(found, expected)| found == expected;
        let good = digests
            .iter()
            .zip(&self.block_digests)
            .take_while(|&pair| is_good(pair));
        match good.count() {
            all if all == digests.len() && all == self.block_digests.len() => {
                Ok((self.facts, self.values))
            }
            block => Err(Miss::Block { block }),
        }
    }
}
