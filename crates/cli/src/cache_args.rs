//! The arguments of `cache`.

use super::parse::{parse_age, parse_bytes};
use clap::{Args, Subcommand};
use std::path::PathBuf;
use std::time::Duration;

/// `cache`.
#[derive(Debug, Args)]
pub struct CacheCommand {
    /// What to do
    #[command(subcommand)]
    pub action: CacheAction,
    /// Folder of cached form factors and solutions
    #[arg(long = "cache", value_name = "DIR", global = true)]
    pub folder: Option<PathBuf>,
}

/// What to do with the cache.
#[derive(Clone, Copy, Debug, Subcommand)]
pub enum CacheAction {
    /// List the cached files: stage, size, last use, name, and the scene that used it last
    List,
    /// Remove the cached files: all, or those that --older and --keep do not spare. What another
    /// process is making stays
    Clean(CleanArgs),
}

/// `cache clean`.
#[derive(Clone, Copy, Debug, Args)]
pub struct CleanArgs {
    /// Remove what was last written or read longer ago, like 7d (units: s, min, h, d, w)
    #[arg(long, value_name = "AGE", value_parser = parse_age, allow_hyphen_values = true)]
    pub older: Option<Duration>,
    /// Remove the least recently used until no more than this is left, like 2GB (units: B, kB, MB,
    /// GB, TB)
    #[arg(long, value_name = "SIZE", value_parser = parse_bytes, allow_hyphen_values = true)]
    pub keep: Option<u64>,
}
