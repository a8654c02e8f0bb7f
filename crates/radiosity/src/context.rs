//! What the stages share beside their parameters.

use crate::observer::{Observer, Silent};
use radiosity_cache::Store;
use std::fmt;

/// Where results are kept, and who is told what happens. By default nothing is kept, and nobody is
/// told.
#[derive(Clone, Copy)]
pub struct Context<'a> {
    /// The folder of form factors and solutions.
    pub cache: Option<&'a Store>,
    /// Is told of progress, and of what a user should know.
    pub observer: &'a dyn Observer,
}

impl Default for Context<'_> {
    fn default() -> Self {
        Context {
            cache: None,
            observer: &Silent,
        }
    }
}

impl fmt::Debug for Context<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Context").finish_non_exhaustive()
    }
}
