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

impl<'a> Context<'a> {
    /// With a cache, if there is one, and an observer.
    pub fn new(cache: Option<&'a Store>, observer: &'a dyn Observer) -> Context<'a> {
        Context { cache, observer }
    }
}

impl Default for Context<'_> {
    fn default() -> Self {
        Context::new(None, &Silent)
    }
}

impl fmt::Debug for Context<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Context").finish_non_exhaustive()
    }
}
