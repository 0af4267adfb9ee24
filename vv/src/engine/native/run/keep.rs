//! Memory that is freed and kept.

/// Lets the process keep what it frees, up to some hundred megabytes, for what it will need next.
///
/// For a program that reads a mesh, runs steps and ends: what reading gave back serves the steps, which else wait for the
/// system to hand out the same memory again, page by page, a third of the time of a fast step. A program that stays would
/// hold what it has no use for. No effect but on Linux with the GNU C library.
pub fn keep_freed_memory() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    for (parameter, bytes) in [(libc::M_MMAP_THRESHOLD, 32 << 20), (libc::M_TRIM_THRESHOLD, 256 << 20)] {
        // SAFETY: it changes how the allocator deals with the system, not what it has given out; any thread may call it.
        unsafe { libc::mallopt(parameter, bytes) };
    }
}
