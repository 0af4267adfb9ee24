//! Memory that is freed and kept.

/// Lets the process keep what it frees, up to half a gigabyte at its end and all within, for what it will need next.
///
/// For a program that reads a mesh, runs steps and ends: what reading gave back serves the steps, which else wait for the
/// system to hand out the same memory again, page by page, a third of the time of a fast step. A program that stays would
/// hold what it has no use for. No effect but on Linux with the GNU C library.
pub fn keep_freed_memory() {
    // Large arrays too come from the heap: those that the system would be asked for one by one go back to it one by one.
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    for (parameter, value) in [(libc::M_MMAP_MAX, 0), (libc::M_TRIM_THRESHOLD, 512 << 20)] {
        // SAFETY: it changes how the allocator deals with the system, not what it has given out; any thread may call it.
        unsafe { libc::mallopt(parameter, value) };
    }
}
