//! What the parameters of all stages share.
//!
//! Each stage has one struct of parameters, in its own crate: with serde, defaults, units and
//! ranges. Tables of scene files hold its fields by their names, and flags change them
//! ([`Parameters`]).

pub mod number_or_word;

pub use number_or_word::NumberOrWord;

use serde::{Serialize, de::DeserializeOwned};

/// The parameters of a stage.
pub trait Parameters: Serialize + DeserializeOwned + Default {
    /// Refuses a value that the stage cannot use.
    fn check(&self) -> Result<(), OutOfRange>;
}

/// A parameter has a value that its stage cannot use.
///
/// ```
/// use radiosity_params::OutOfRange;
///
/// let error = OutOfRange::unless((1..=64).contains(&99), "points", "between 1 and 64");
/// assert_eq!(error.unwrap_err().to_string(), "`points` must be between 1 and 64");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{key}` must be {range}")]
pub struct OutOfRange {
    /// The name of the field.
    pub key: &'static str,
    /// The values that it may have, in words that follow "must be".
    pub range: &'static str,
}

impl OutOfRange {
    /// An error unless the value is in its range.
    pub fn unless(
        in_range: bool,
        key: &'static str,
        range: &'static str,
    ) -> Result<(), OutOfRange> {
        if in_range {
            Ok(())
        } else {
            Err(OutOfRange { key, range })
        }
    }
}

/// Whether a number is finite and more than 0.
pub fn is_positive(number: f64) -> bool {
    number > 0.0 && number.is_finite()
}
