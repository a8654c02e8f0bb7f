//! What a run tells while it goes.

/// The stages that take time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Counted in pairs of patches.
    FormFactors,
    /// Counted in hundredths of the way from the first residual to the residual that is asked for.
    Solve,
    /// Counted in rows of pixels.
    Display,
    /// Counted in rows of pixels of all passes, or in patches.
    Reference,
}

/// Is told what happens, from any thread.
pub trait Observer: Sync {
    /// A stage begins; `work` is how much there is to do at most.
    fn begin(&self, stage: Stage, work: u64);
    /// Some more of it is done.
    fn advance(&self, done: u64);
    /// The stage has ended.
    fn end(&self);
    /// Something that the user should know, and that does not stop the run.
    fn note(&self, message: &str);
}

/// Tells nobody.
#[derive(Clone, Copy, Debug)]
pub struct Silent;

impl Observer for Silent {
    fn begin(&self, _: Stage, _: u64) {}
    fn advance(&self, _: u64) {}
    fn end(&self) {}
    fn note(&self, _: &str) {}
}
