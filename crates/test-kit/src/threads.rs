//! The same on any number of threads.

/// What a function returns on a pool of so many threads.
pub fn on_threads<T: Send>(count: usize, run: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
    pool.unwrap_or_else(|error| panic!("{error}")).install(run)
}
