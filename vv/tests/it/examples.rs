//! The examples of the library: what they print.

use std::error::Error;
use std::io::Write;

// Their `main` is not called here.
#[expect(dead_code, reason = "an example has its own main")]
#[path = "../../examples/masks.rs"]
mod masks;
#[expect(dead_code, reason = "an example has its own main")]
#[path = "../../examples/orbits.rs"]
mod orbits;
#[expect(dead_code, reason = "an example has its own main")]
#[path = "../../examples/rings.rs"]
mod rings;
#[expect(dead_code, reason = "an example has its own main")]
#[path = "../../examples/subdivide.rs"]
mod subdivide;

#[track_caller]
fn check(example: impl Fn(&mut dyn Write) -> Result<(), Box<dyn Error>>, expected: &str) {
    let mut out = Vec::new();
    example(&mut out).unwrap();
    assert_eq!(String::from_utf8(out).unwrap(), expected);
}

#[test]
fn a_rule_is_run_on_a_mesh_that_is_written_as_obj() {
    let assets = concat!(env!("CARGO_MANIFEST_DIR"), "/../assets");
    let (program, mesh) = (format!("{assets}/programs/loop.vv"), format!("{assets}/meshes/cube-open.obj"));
    let mut out = Vec::new();
    subdivide::subdivide(&program, &mesh, 2, &mut out).unwrap();
    let text = String::from_utf8(out).unwrap();
    let lines = |kind: &str| text.lines().filter(|line| line.starts_with(kind)).count();
    assert_eq!((lines("v "), lines("f ")), (89, 160));
    let error = subdivide::subdivide("nowhere.vv", &mesh, 2, &mut Vec::new()).unwrap_err();
    assert!(error.to_string().contains("No such file"), "{error}");
}

#[test]
fn orbits_are_walked() {
    let expected = "tetrahedron: Euler characteristic 2, genus 0\n  [v2, v4, v1]\n  [v3, v2, v1]\n  [v4, v3, v1]\n  \
                    [v3, v4, v2]\n\
                    the first ring turned over: Euler characteristic 0, genus 1\n  \
                    [v4, v3, v1, v2, v4, v1, v3, v2, v1]\n  [v3, v4, v2]\n";
    check(orbits::orbits, expected);
}

#[test]
fn rings_are_edited_by_hand() {
    let expected = "\
two triangles: 2 faces, 0 findings []
  v1: {v2, v3, v4, _}
  v2: {v3, v1, _}
  v3: {v4, v1, v2, _}
  v4: {v1, v3, _}
x between a and c: 2 faces, 0 findings []
  v1: {v2, v5, v4, _}
  v2: {v3, v1, _}
  v3: {v4, v5, v2, _}
  v4: {v1, v3, _}
  v5: {v1, v3}
x names b: 1 faces, 1 findings [OneSided { from: v5, to: v2 }]
  v1: {v2, v5, v4, _}
  v2: {v3, v1, _}
  v3: {v4, v5, v2, _}
  v4: {v1, v3, _}
  v5: {v1, v2, v3}
four triangles: 4 faces, 0 findings []
  v1: {v2, v5, v4, _}
  v2: {v3, v5, v1, _}
  v3: {v4, v5, v2, _}
  v4: {v1, v5, v3, _}
  v5: {v1, v2, v3, v4}
";
    check(rings::rings, expected);
}

#[test]
fn masks_are_found() {
    let around = |n: usize| {
        let weights: String = (1..=n).map(|i| format!(" + 1/{} q{i}", 2 * n)).collect();
        format!("valence {n}: 1/2 p{weights}\n")
    };
    check(masks::masks, &(3..=6).map(around).collect::<String>());
}
