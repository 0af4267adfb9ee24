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

/// A coral grows on triangles and leaves quads as they are; gyro makes pentagons of both; limits move what they say.
#[test]
fn masks_are_shown_among_the_faces_that_a_rule_is_for() {
    let programs = concat!(env!("CARGO_MANIFEST_DIR"), "/../assets/programs");
    for (rule, around, said) in [
        ("coral.vv --rule grow", "triangles", "the connectivity depends on the positions"),
        ("coral.vv --rule smooth", "quads", ""),
        ("conway.vv --rule gyro", "triangles", ""),
        ("conway.vv --rule dual", "quads", ""),
        ("doo-sabin.vv", "quads", ""),
        ("sqrt3.vv", "triangles", ""),
        ("limit.vv --rule loop_limit", "triangles", ""),
        ("limit.vv --rule catmull_clark_limit", "quads", ""),
    ] {
        let table = check(&format!("mask {programs}/{rule} --valence 5"), 0, said).stdout;
        assert!(table.contains(&format!("… among {around}\n")), "{rule}: {table}");
    }
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
    check_file("none.vv", "void step(mesh& S) { forall v in S v$pos *= -0.0; }\n", "mask none.vv", 0, "sum to 0, not");
    let text = "void step(mesh& S) { forall v in S { vertex q = any in v; v$pos = (v$pos + q$pos) / 2; } }\n";
    check_file("greedy.vv", text, "mask greedy.vv", 0, "the masks depend on the order of the vertices");
    check_file("start.vv", "void start(mesh& S) { }\n", "mask start.vv", 1, "has no rule, so there is no mask");
    check("mask move.vv --rule shif", 2, "did you mean `--rule shift`?");
    let table =
        check_file("null.vv", "void step(mesh& S) { vertex n = null; n$pos *= 2; }\n", "mask null.vv", 0, "").stdout;
    assert!(table.contains("none: null has no position"), "{table}");
}

/// What is written on a figure, in its order.
fn written(svg: &str) -> Vec<String> {
    let document = roxmltree::Document::parse(svg).unwrap();
    document.descendants().filter_map(|node| node.attribute("aria-label")).map(str::to_owned).collect()
}

#[test]
fn masks_are_drawn_with_their_weights_and_each_kind_once() {
    let folder = Folder::with(&[("thirds.vv", THIRDS)]);
    let said = folder.check("mask thirds.vv --valence 4 -o a.svg -o a.eps -o a.pdf -o a.png --page 50mm", 0, "").stdout;
    assert_eq!(said, "", "no table");
    let text = folder.read("a.svg");
    let mut labels = written(&text);
    labels.sort();
    assert_eq!(labels, ["1/12", "1/12", "1/12", "1/12", "2/3", "vertex, valence 4"]);
    let document = roxmltree::Document::parse(&text).unwrap();
    let dots = |id: &str| {
        let group = document.descendants().find(|node| node.attribute("id") == Some(id)).unwrap();
        group.children().filter(roxmltree::Node::is_element).count()
    };
    assert_eq!((dots("old-vertices"), dots("new-vertex")), (5, 1));
    assert_eq!(image::image_dimensions(folder.path("a.png")).unwrap().0, 591, "300 pixels per inch");
    // A rule that does the same to all vertices has one picture for all valences, and one at the boundary.
    let text = "void step(mesh& S) { synchronize S; forall v in S v$pos = `v$pos * 1; }\n";
    check_file("stay.vv", text, "mask stay.vv -o a.svg --json", 0, "");
    let folder = Folder::with(&[("stay.vv", text)]);
    folder.check("mask stay.vv -o a.svg", 0, "");
    assert_eq!(written(&folder.read("a.svg")), ["vertex", "boundary vertex", "1", "1"]);
}

/// An edge that ends at the boundary is none of it.
#[test]
fn near_the_boundary_only_what_is_not_as_inside_is_drawn() {
    let folder = Folder::with(&[("loop.vv", include_str!("../../../../assets/programs/loop.vv"))]);
    folder.check("mask loop.vv -o a.svg --page 160mm", 0, "");
    let labels = written(&folder.read("a.svg"));
    let captions: Vec<&str> = labels.iter().map(String::as_str).filter(|label| label.contains("edge")).collect();
    assert_eq!(captions, ["edge", "boundary edge"]);
    // A corner of a face inside a face is none of the vertices that were there.
    let folder = Folder::with(&[("doo-sabin.vv", include_str!("../../../../assets/programs/doo-sabin.vv"))]);
    folder.check("mask doo-sabin.vv -o a.svg", 0, "");
    assert!(written(&folder.read("a.svg")).contains(&"face".to_owned()));
}

#[test]
fn masks_of_a_mesh_are_drawn_on_it() {
    let folder = Folder::with(&[("thirds.vv", THIRDS)]);
    folder.check("mask thirds.vv -i octahedron.obj --vertex 3 -o a.svg", 0, "");
    let mut labels = written(&folder.read("a.svg"));
    labels.sort();
    assert_eq!(labels, ["1/12", "1/12", "1/12", "1/12", "2/3", "v3"]);
}

#[test]
fn a_figure_of_masks_that_cannot_be_made_leaves_nothing() {
    let folder = Folder::with(&[("thirds.vv", THIRDS)]);
    folder.check("mask thirds.vv -o a.obj", 2, "`-o a.obj` is no figure of masks");
    folder.check("mask thirds.vv -o a.svg -o a.svg", 2, "is given twice");
    folder.check("mask thirds.vv -o no/a.svg", 3, "there is no directory `no`");
    folder.check("mask thirds.vv --page 80mm", 2, "--output");
    folder.check("mask move.vv -i octahedron.obj --vertex 9 -o a.svg", 2, "the result has no vertex v9");
    assert!(!folder.path("a.svg").exists());
}

#[test]
fn a_rule_that_does_not_end_ends_the_search() {
    let folder = Folder::with(&[]);
    let ended = folder.check("mask endless.vv --timeout 0.2", 4, "the time allowed for a step is over");
    assert!(ended.stdout.is_empty(), "{}", ended.stdout);
}

#[test]
fn masks_are_those_of_a_run_that_began_with_start() {
    let text = "mesh { double part = 0; };\n\
                void start(mesh& S) { S$part = 0.25; vertex alone; alone$pos = vec(9, 9, 9); add alone to S; }\n\
                void step(mesh& S) {\n  synchronize S;\n  forall v in S {\n    if (valence v == 0) continue;\n    \
                vec sum = vec(0, 0, 0);\n    forall q in v sum += `q$pos;\n    \
                v$pos = `v$pos * (1 - S$part) + sum * S$part / (1.0 * valence v);\n  }\n}\n";
    let folder = Folder::with(&[("part.vv", text)]);
    let table = folder.check("mask part.vv --valence 5", 0, "").stdout;
    assert!(table.contains("at p   p: 3/4   q1…q5: 1/20\n"), "{table}");
    let table = folder.check("mask part.vv -i octahedron.obj --vertex 3", 0, "").stdout;
    assert!(table.contains("v3   v3: 3/4   v1 v2 v5 v6: 1/16\n"), "{table}");
    let torn = "void start(mesh& S) { forall v in S v$pos *= 1; mesh none; S = none; }\n";
    let folder = Folder::with(&[("torn.vv", &format!("{torn}{THIRDS}"))]);
    let said = "`start` changes what is around the vertex, so these are the masks of the rule without it";
    let table = folder.check("mask torn.vv --valence 4", 0, said).stdout;
    assert!(table.contains("at p   p: 2/3   q1…q4: 1/12\n"), "{table}");
}
