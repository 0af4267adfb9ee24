//! Loops whose rounds do not depend on one another, on all threads.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU8, Ordering};

use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, ParallelIterator};

use super::{Context, RUNTIME_STACK, Run, STACK, status};

/// Loops of fewer rounds are over before other threads have begun. Tests, whose meshes are small, wake them for any.
const FEWEST: usize = if cfg!(debug_assertions) { 2 } else { 1 << 12 };

/// What a thread takes at once has so many rounds at least.
const PART: usize = if cfg!(debug_assertions) { 1 } else { 1 << 10 };

/// So many parts for each thread: one that is late, as the machine has other work, does fewer.
const PARTS: usize = 4;

/// Less stack than this is left by other work that a thread is in the middle of.
const LITTLE_STACK: usize = 1 << 20;

/// What the rounds of a loop are called as: with the addresses of the first member and behind the last, and of the values of
/// variables that are declared outside.
type Code = extern "C" fn(*mut Context, *const u32, *const u32, *const u64) -> u32;

/// The rounds of a loop.
#[derive(Clone, Copy)]
pub(super) struct Rounds {
    code: Code,
    /// Whether many threads may do them at once.
    pub(super) apart: bool,
}

impl Rounds {
    /// # Safety
    /// The code was compiled with the signature of [`Code`], and lasts as long as this is called. It is said to be `apart`
    /// only if it was found to be, see [`crate::engine::native::parallel`].
    pub(super) unsafe fn new(code: *const u8, apart: bool) -> Self {
        // SAFETY: as promised by the caller.
        Self { code: unsafe { std::mem::transmute::<*const u8, Code>(code) }, apart }
    }
}

/// What all threads are told.
struct Loop {
    code: Code,
    first: *const u32,
    count: usize,
    environment: *const u64,
    /// The run's own context, from which each part has a copy.
    context: *const u64,
    words: usize,
    over: AtomicU8,
}

// SAFETY: nothing that the pointers lead to is written while threads work but what the module documentation of `run` says.
unsafe impl Sync for Loop {}

/// Runs the rounds for so many members.
pub(super) extern "C" fn parallel(
    context: *mut Context,
    index: u32,
    first: *const u32,
    count: u64,
    environment: *const u64,
) -> u32 {
    // SAFETY: the context is that of a run that is alive and not borrowed while compiled code runs. Both references lead out of
    // the run, to which nothing here refers while compiled code works.
    let (run, rounds, layout) = unsafe {
        let run = (*context).run.cast::<Run<'_>>();
        (run, (*run).rounds, (*run).fixed.layout)
    };
    let Some(&Rounds { code, apart }) = rounds.get(index as usize) else { return status::REPEAT };
    let count = count as usize;
    let work = || {
        let threads = if apart && count >= FEWEST { rayon::current_num_threads() } else { 1 };
        if threads < 2 {
            // SAFETY: it is the address behind the last member.
            return code(context, first, unsafe { first.add(count) }, environment);
        }
        let parts = (count / PART).clamp(1, PARTS * threads);
        let over = AtomicU8::new(0);
        let each = Loop {
            code,
            first,
            count,
            environment,
            context: context.cast::<u64>().cast_const(),
            words: layout.words(),
            over,
        };
        let parts = (0..parts).into_par_iter().with_max_len(1).map(|part| each.part(part, parts));
        parts.max().unwrap_or(status::DONE)
    };
    let status = catch_unwind(AssertUnwindSafe(work)).unwrap_or(status::REPEAT);
    if status != status::DONE {
        // A stop is reported where the loop stands.
        // SAFETY: as above; threads have come to their end.
        let calls = unsafe { &mut (*run).calls };
        calls.clear();
    }
    status
}

impl Loop {
    /// Does one of so many parts, on the thread that calls it.
    fn part(&self, part: usize, parts: usize) -> u32 {
        let at = |part: usize| part * (self.count / parts) + part.min(self.count % parts);
        stacker::maybe_grow(LITTLE_STACK, STACK, || {
            let here = 0_u8;
            let left = stacker::remaining_stack().unwrap_or(0);
            let Some(usable) = left.checked_sub(RUNTIME_STACK) else { return status::REPEAT };
            // SAFETY: the run's context is that many words, which nobody writes meanwhile.
            let mut words = unsafe { std::slice::from_raw_parts(self.context, self.words) }.to_vec();
            let context = words.as_mut_ptr().cast::<Context>();
            // SAFETY: a context is a header at least, and nothing else refers to this one. All parts lie among the members.
            let status = unsafe {
                (*context).this = context;
                (*context).over = self.over.as_ptr();
                (*context).stack_limit = std::ptr::from_ref(&here).addr() - usable;
                (self.code)(context, self.first.add(at(part)), self.first.add(at(part + 1)), self.environment)
            };
            if status != status::DONE {
                self.over.store(1, Ordering::Relaxed);
            }
            status
        })
    }
}

/// Whether this is the context of a part of a loop that threads do at once.
pub(super) fn is_part(context: *const Context) -> bool {
    // SAFETY: the context is valid; which is the run's own does not change while compiled code runs.
    unsafe { !std::ptr::eq((*(*context).run.cast::<Run<'_>>()).context, context) }
}
