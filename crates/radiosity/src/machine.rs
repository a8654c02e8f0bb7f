//! What the machine has left.

use std::path::Path;

/// The share of the free memory that a run may take.
const USABLE_SHARE: f64 = 0.9;

/// Addresses of a thread's stack: threads start after what is left has been counted.
#[cfg(unix)]
const STACK: u64 = (2 << 20) + (4 << 10);

/// What a run may take, if that is known.
pub(crate) fn usable_memory() -> Option<u64> {
    free_memory().map(|free| (free as f64 * USABLE_SHARE) as u64)
}

/// What the machine, or the container it runs in, or the limit of the process (`ulimit -v`) has
/// left; unknown on rare systems.
fn free_memory() -> Option<u64> {
    let mut system = sysinfo::System::new().ok()?;
    system.refresh_memory();
    let limit = system.cgroup_limits().map_or(u64::MAX, |c| c.free_memory);
    let of_process = free_addresses().unwrap_or(u64::MAX);
    Some(system.available_memory().min(limit).min(of_process))
}

/// How many more bytes the process may have addresses for, if that is limited.
#[cfg(unix)]
fn free_addresses() -> Option<u64> {
    let limit = rustix::process::getrlimit(rustix::process::Resource::As).current?;
    // Where the system does not tell what is taken, it is little beside what is asked for.
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let taken = status.lines().find_map(|line| line.strip_prefix("VmSize:"));
    let kilobytes = taken.and_then(|text| text.trim().trim_end_matches(" kB").parse::<u64>().ok());
    let threads = std::thread::available_parallelism().map_or(1, |count| count.get() as u64);
    Some(limit.saturating_sub(1024 * kilobytes.unwrap_or(0) + threads * STACK))
}

#[cfg(not(unix))]
fn free_addresses() -> Option<u64> {
    None
}

/// Free bytes on the disk of a folder that need not exist yet.
pub(crate) fn free_disk(folder: &Path) -> Option<u64> {
    let existing = folder.ancestors().find(|f| f.exists());
    let here = existing.unwrap_or(Path::new("."));
    fs4::available_space(here).ok()
}
