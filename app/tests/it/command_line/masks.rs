//! `vv mask`

use super::*;

const THIRDS: &str = "void step(mesh& S) {\n  synchronize S;\n  forall v in S {\n    vec sum = vec(0, 0, 0);\n    \
                      forall q in v sum += `q$pos;\n    v$pos = `v$pos * 2 / 3 + sum / (3.0 * valence v);\n  }\n}\n";

#[test]
fn masks_are_a_table_with_fractions() {
    let folder = Folder::with(&[("thirds.vv", THIRDS)]);
    let table = folder.check("mask thirds.vv --valence 4 --valence 7", 0, "").stdout;
    let expected = "thirds.vv, rule step, around a vertex p with neighbours q1, q2, … among triangles\n\n\
                    valence 4\n  at p   p: 2/3   q1…q4: 1/12\n\n\
                    valence 7\n  at p   p: 2/3   q1…q7: 1/21\n";
    assert_eq!(table, expected);
    let object = json(&folder.check("mask thirds.vv --valence 4 --json", 0, "").stdout);
    assert_eq!(object["rows"][0]["masks"][0]["weights"][1]["fraction"], "1/12");
}

#[test]
fn masks_of_a_mesh_are_those_of_its_vertices() {
    let folder = Folder::with(&[("thirds.vv", THIRDS)]);
    let table = folder.check("mask thirds.vv -i octahedron.obj --vertex 3", 0, "").stdout;
    assert!(table.contains("v3   v3: 2/3   v1 v2 v5 v6: 1/12\n"), "{table}");
    folder.check("mask thirds.vv -i octahedron.obj --vertex 7", 2, "the result has no vertex v7");
    let all = folder.check("mask thirds.vv -i octahedron.obj", 0, "").stdout;
    assert!(all.contains("     6 × v1   v1: 2/3   v3 v4 v5 v6: 1/12\n"), "{all}");
}

#[test]
fn what_is_no_mask_is_warned_of() {
    check_file("up.vv", "void step(mesh& S) { forall v in S v$pos.z += 1; }\n", "mask up.vv", 0, "is not affine");
    check_file("twice.vv", "void step(mesh& S) { forall v in S v$pos *= 2; }\n", "mask twice.vv", 0, "sum to 2");
    let text = "void step(mesh& S) { forall v in S { vertex q = any in v; v$pos = (v$pos + q$pos) / 2; } }\n";
    check_file("greedy.vv", text, "mask greedy.vv", 0, "the masks depend on the order of the vertices");
    check_file("start.vv", "void start(mesh& S) { }\n", "mask start.vv", 1, "has no rule, so there is no mask");
    check("mask move.vv --rule shif", 2, "did you mean `--rule shift`?");
    let table =
        check_file("null.vv", "void step(mesh& S) { vertex n = null; n$pos *= 2; }\n", "mask null.vv", 0, "").stdout;
    assert!(table.contains("none: null has no position"), "{table}");
}
