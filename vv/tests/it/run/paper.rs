//! The listings of the paper, with its figures.

use vv::engine::Settings;
use vv::mesh::close::close;
use vv::mesh::faces::faces;
use vv::mesh::statistics::statistics;
use vv::mesh::{Mesh, Vertex};
use vv::stop::Stop;

use super::{OCTAHEDRON, SQUARE, run_with};

/// Octahedron, listing, steps, then V, E, F, volume and the sum of squared distances from the origin.
#[track_caller]
fn check_figures(listing: &str, steps: u64, counts: [usize; 3], volume: f64, squares: f64) {
    let (output, mesh) = run_with(&format!("{OCTAHEDRON}{listing}"), steps, &Settings::default());
    assert!(output.is_empty(), "{output:?}");
    let triangles = triangles(&mesh);
    let ends: usize = mesh.set.iter().map(|v| mesh.ring(v).valence()).sum();
    assert_eq!([mesh.set.len(), ends / 2, triangles.len()], counts);
    let at = |v: Vertex| mesh.position(v);
    let got_volume: f64 = triangles.iter().map(|&[a, b, c]| at(a).dot(at(b).cross(at(c))) / 6.0).sum();
    assert!((got_volume - volume).abs() < 1e-9, "volume {got_volume}");
    let got_squares: f64 = mesh.set.iter().map(|v| at(v).length_squared()).sum();
    assert!((got_squares - squares).abs() < 1e-9, "squares {got_squares}");
}

/// The faces, each from its oldest corner; all must be triangles.
fn triangles(mesh: &Mesh) -> Vec<[Vertex; 3]> {
    let mut found = Vec::new();
    for p in mesh.set.iter() {
        for q in mesh.ring(p).vertices() {
            let r = mesh.ring(p).next(Some(q)).unwrap().unwrap();
            assert_eq!(mesh.ring(q).next(Some(r)), Some(Some(p)), "a face at {p} is no triangle");
            if p < q && p < r {
                found.push([p, q, r]);
            }
        }
    }
    found
}

const POLYHEDRAL: &str = include_str!("../../../../assets/programs/paper-polyhedral.vv");
const LOOP: &str = include_str!("../../../../assets/programs/paper-loop.vv");
const BUTTERFLY: &str = include_str!("../../../../assets/programs/paper-butterfly.vv");
const SQRT3: &str = include_str!("../../../../assets/programs/paper-sqrt3.vv");

#[test]
fn polyhedral() {
    check_figures(POLYHEDRAL, 1, [18, 48, 32], 1.333_333_333_333_3, 12.0);
}

#[test]
fn loop_() {
    check_figures(LOOP, 1, [18, 48, 32], 0.430_664_062_5, 4.970_214_843_75);
    check_figures(LOOP, 3, [258, 768, 512], 0.310_606_805_842, 46.600_807_654_759);
}

#[test]
fn butterfly() {
    check_figures(BUTTERFLY, 1, [18, 48, 32], 2.213_541_666_667, 15.375);
    check_figures(BUTTERFLY, 2, [66, 192, 128], 2.740_592_956_543, 54.061_523_437_5);
}

#[test]
fn sqrt3() {
    check_figures(SQRT3, 1, [14, 36, 24], 0.493_827_160_494, 4.518_518_518_519);
    check_figures(SQRT3, 3, [110, 324, 216], 0.324_524_230_312, 20.721_355_710_229);
}

/// A closed scheme on the open square of two triangles.
#[track_caller]
fn check_open(listing: &str, expected: &str) {
    let (output, _) = run_with(&format!("{SQUARE}{listing}"), 1, &Settings::default());
    let expected: Vec<_> = expected.lines().map(str::trim).collect();
    assert!(output == expected, "{}", output.join("\n"));
}

#[test]
fn loop_explains_a_boundary() {
    check_open(
        LOOP,
        "error 35:25 ``(nextto q in `p)$pos`: null has no position
         at 35:26 `(nextto q in `p)`: `nextto q in `p` is null here: a hole follows v1 in the old ring of v2
         = old ring of v2: v3 v1 ∅
         = before the step, ring of v1: v2 v3 v4 ∅
         ? v2 lies on a boundary: test `nextto q in `p == null` first
         about v2 v1",
    );
}

#[test]
fn butterfly_explains_a_boundary() {
    check_open(
        BUTTERFLY,
        "error 31:19 ``(nextto q in `p)$pos`: null has no position
         at 31:20 `(nextto q in `p)`: `nextto q in `p` is null here: a hole follows v1 in the old ring of v2
         = old ring of v2: v3 v1 ∅
         = before the step, ring of v1: v2 v3 v4 ∅
         ? v2 lies on a boundary: test `nextto q in `p == null` first
         about v2 v1",
    );
}

#[test]
fn sqrt3_explains_a_boundary() {
    check_open(
        SQRT3,
        "error 39:50 `y`: null has no neighbours
         at 38:18 `prevto q in p`: `prevto q in p` is null here: a hole precedes v2 in the ring of v1
         = ring of v1: v2 v5 v3 v6 v4 ∅
         = before the step, ring of v1: v2 v3 v4 ∅
         = before the step, ring of v2: v3 v1 ∅
         ? v1 lies on a boundary: test `prevto q in p == null` first
         about v1 v2",
    );
}

#[test]
fn polyhedral_keeps_a_boundary() {
    let (output, mut mesh) = run_with(&format!("{SQUARE}{POLYHEDRAL}"), 1, &Settings::default());
    assert!(output.is_empty(), "{output:?}");
    let stop = Stop::new();
    assert_eq!(close(&mut mesh, &stop).unwrap(), []);
    let faces = faces(&mesh, &stop).unwrap();
    let statistics = statistics(&mesh, &faces, &stop).unwrap();
    assert_eq!((statistics.vertices, statistics.edges, statistics.faces, statistics.boundary_loops), (9, 16, 8, 1));
    assert!(statistics.valid);
}
