//! The paper's listings and the shipped programs check without a word.

use super::{INSERT, check, compiled};

#[track_caller]
fn check_shipped(file: &str) {
    let path = format!("{}/../assets/programs/{file}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).expect("the program");
    let c = compiled(&text);
    assert!(c.diagnostics.is_empty(), "{:?}", c.diagnostics);
    assert!(c.program.is_some());
}

#[test]
fn insert() {
    check(INSERT);
}

#[test]
fn polyhedral() {
    check_shipped("paper-polyhedral.vv");
}

#[test]
fn loop_() {
    check_shipped("paper-loop.vv");
}

#[test]
fn butterfly() {
    check_shipped("paper-butterfly.vv");
}

#[test]
fn sqrt3() {
    check_shipped("paper-sqrt3.vv");
}

#[test]
fn loop_with_boundary() {
    check_shipped("loop.vv");
}
