//! What happens where the system lets no memory be executable that was written, as hardened ones do, and what memory that
//! is kept spares.

use std::process::Command;
use std::sync::Arc;

use crate::engine::{Engine, Machine, Settings};
use crate::mesh::Mesh;

const HARDENED: &str = "VV_TEST_HARDENED";

/// Refuses memory to become executable to this process from now on. `false` where the system knows no such thing (Linux
/// before 6.3).
fn harden() -> bool {
    const PR_SET_MDWE: libc::c_int = 65;
    const PR_MDWE_REFUSE_EXEC_GAIN: libc::c_ulong = 1;
    let zero: libc::c_ulong = 0;
    // SAFETY: it changes what later calls of the system allow, and touches no memory.
    unsafe { libc::prctl(PR_SET_MDWE, PR_MDWE_REFUSE_EXEC_GAIN, zero, zero, zero) == 0 }
}

/// There is no way back, so it is tried in a process of its own: this test, run once more.
#[test]
fn a_program_runs_in_the_interpreter_where_memory_cannot_become_executable() {
    if std::env::var_os(HARDENED).is_none() {
        let this = std::env::current_exe().unwrap();
        let name =
            "engine::native::run::tests::a_program_runs_in_the_interpreter_where_memory_cannot_become_executable";
        let child = Command::new(this).args(["--exact", name, "--nocapture"]).env(HARDENED, "1").output().unwrap();
        let said = String::from_utf8_lossy(&child.stdout);
        assert!(child.status.success() && said.contains("1 passed"), "{said}");
        return;
    }
    let text = "void step(mesh& S) { vertex v; v$pos = vec(1, 2, 3); add v to S; print v$pos; }";
    let program = crate::compile("test.vv", text, &mut |_, _| Err(String::new())).program.unwrap();
    let rule = program.default_rule().unwrap();
    assert_eq!(Machine::new(Arc::clone(&program), Engine::Native).engine(), Engine::Native);
    if !harden() {
        return;
    }
    let machine = Machine::new(program, Engine::Native);
    assert_eq!(machine.engine(), Engine::Interpret);
    assert_eq!(
        machine.refusal().unwrap(),
        "the program runs in the interpreter: the system lets no memory be executable that was written"
    );
    let mut lines = Vec::new();
    machine.run(rule, &Mesh::new(), 1, &Settings::default(), &mut lines).unwrap();
    assert_eq!(lines, ["(1, 2, 3)"]);
}

#[cfg(target_env = "gnu")]
const KEEPING: &str = "VV_TEST_KEEPING";

/// Pages the system has handed out to this process.
#[cfg(target_env = "gnu")]
fn pages() -> i64 {
    // SAFETY: it fills the structure, which may hold zeros.
    unsafe {
        let mut usage: libc::rusage = std::mem::zeroed();
        assert_eq!(libc::getrusage(libc::RUSAGE_SELF, &raw mut usage), 0);
        usage.ru_minflt
    }
}

/// In a process of its own, for it holds for all of it from then on.
#[test]
#[cfg(target_env = "gnu")]
fn memory_that_is_kept_is_not_handed_out_again() {
    if std::env::var_os(KEEPING).is_none() {
        let this = std::env::current_exe().unwrap();
        let name = "engine::native::run::tests::memory_that_is_kept_is_not_handed_out_again";
        let child = Command::new(this).args(["--exact", name, "--nocapture"]).env(KEEPING, "1").output().unwrap();
        let said = String::from_utf8_lossy(&child.stdout);
        assert!(child.status.success() && said.contains("1 passed"), "{said}");
        return;
    }
    super::keep_freed_memory();
    let pages_of = |bytes: usize| {
        let before = pages();
        std::hint::black_box(vec![1_u8; bytes]);
        pages() - before
    };
    let (first, second) = (pages_of(60 << 20), pages_of(50 << 20));
    assert!(first > 1000 && second < 100, "{first}, {second}");
}
