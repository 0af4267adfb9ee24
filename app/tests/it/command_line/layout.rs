//! `vv fmt`

use super::*;

const MESSY: &str = "void step(mesh &S){\nforall v in S // all\nv$pos*=2.0;}\n";
const TIDY: &str = "void step(mesh& S) {\n  forall v in S // all\n    v$pos *= 2.0; }\n";

#[test]
fn programs_are_laid_out_in_place() {
    let folder = Folder::with(&[("p.vv", MESSY)]);
    folder.check("fmt p.vv move.vv", 0, "");
    assert_eq!(folder.read("p.vv"), TIDY);
    assert_eq!(folder.read("move.vv"), MOVE);
    assert_eq!(folder.run_with_stdin("fmt -", MESSY).stdout, TIDY);
    assert_eq!(folder.run_with_stdin("fmt -", TIDY).stdout, TIDY);
}

#[test]
fn checking_changes_nothing() {
    let folder = Folder::with(&[("p.vv", MESSY)]);
    folder.check("fmt --check p.vv move.vv", 5, "p.vv is not laid out\n`vv fmt p.vv`");
    assert_eq!(folder.read("p.vv"), MESSY);
    folder.check("fmt --check move.vv", 0, "");
}

#[test]
fn a_program_that_cannot_be_read_without_doubt_is_left_as_it_is() {
    let broken = "void  step(mesh& S) { x = ; }\n";
    let folder = Folder::with(&[("broken.vv", broken), ("p.vv", MESSY)]);
    folder.check("fmt broken.vv p.vv", 1, "broken.vv:1:");
    assert_eq!(folder.read("broken.vv"), broken);
    assert_eq!(folder.read("p.vv"), TIDY, "the others are laid out");
    folder.check("fmt none.vv", 3, "none.vv");
    folder.check("fmt octahedron.obj", 2, "octahedron.obj is a mesh");
}

#[test]
#[cfg(target_os = "linux")]
fn what_is_no_file_is_not_replaced() {
    check("fmt /dev/null", 3, "/dev/null: is no file that could be replaced");
    check("fmt --check /dev/null", 0, "");
}
