//! `vv mesh info` and `vv mesh convert`

use super::*;

#[test]
fn info_is_a_table_or_an_object() {
    let folder = Folder::with(&[]);
    let table = folder.check("mesh info square.off", 0, "").stdout;
    for row in ["vertices              4\n", "faces                 2\n", "closed                no\n"] {
        assert!(table.contains(row), "{table}");
    }
    let info = json(&folder.check("mesh info square.off --json", 0, "").stdout);
    assert_eq!(info["edges"], 5);
    assert_eq!(info["bounds"], json("[[0.0, 0.0, 0.0], [1.0, 1.0, 0.0]]"));
    assert_eq!(info["warnings"], json("[]"));
}

#[test]
fn info_of_wires_says_that_there_are_no_faces() {
    let folder = Folder::with(&[("wire.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\n")]);
    let table = folder.check("mesh info wire.obj", 0, "").stdout;
    assert!(table.contains("\nface degrees          none\n"), "{table}");
}

#[test]
fn info_says_which_values_a_program_can_declare() {
    let text = "v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nt crease 2/1/0 0 1 2\nt corner 1/1/0 2 3\n";
    let folder = Folder::with(&[("m.obj", text)]);
    let table = folder.check("mesh info m.obj", 0, "").stdout;
    for row in
        ["vertex                { vec color; double sharpness; };\n", "edge                  { double sharpness; };\n"]
    {
        assert!(table.contains(row), "{table}");
    }
    let info = json(&folder.check("mesh info m.obj --json", 0, "").stdout);
    assert_eq!(info["properties"]["vertex"], json(r#"{"color": "vec", "sharpness": "double"}"#));
}

#[test]
fn conversion_keeps_vertices_and_faces() {
    let folder = Folder::with(&[]);
    folder.check("mesh convert octahedron.obj -o a.off", 0, "");
    folder.check("mesh convert a.off -o b.obj", 0, "");
    assert_eq!(vertices(&folder.read("b.obj")), vertices(OCTAHEDRON));
    folder.check("mesh convert b.obj -o c.off", 0, "");
    assert_eq!(folder.read("a.off"), folder.read("c.off"));
}

#[test]
fn meshes_are_compared_whatever_their_order() {
    let turned = "v 0 0 -1\nv 0 0 1\nv 0 -1 0\nv 0 1 0\nv -1 0 0\nv 1 0 0.5\n\
                  f 4 2 6\nf 5 2 4\nf 3 2 5\nf 6 2 3\nf 4 6 1\nf 5 4 1\nf 3 5 1\nf 6 3 1\n";
    let moved = OCTAHEDRON.replace("v 1 0 0", "v 1 0 0.5");
    let inside_out: String = OCTAHEDRON
        .lines()
        .map(|line| match line.split(' ').collect::<Vec<_>>()[..] {
            ["f", a, b, c] => format!("f {c} {b} {a}\n"),
            _ => format!("{line}\n"),
        })
        .collect();
    let chiral = |faces: &str| format!("v 0 0 0\nv 4 0 0\nv 2 4 0\nv -1 -1 0\nv 5 -1 0\nv 6 -2 0\n{faces}");
    let files = [
        ("turned.obj", turned),
        ("moved.obj", moved.as_str()),
        ("inside-out.obj", inside_out.as_str()),
        ("left.obj", &chiral("f 1 2 3\nf 1 4 2\nf 2 5 6 3\n")),
        ("right.obj", &chiral("f 3 2 1\nf 2 4 1\nf 3 6 5 2\n")),
    ];
    let folder = Folder::with(&files);
    #[track_caller]
    fn said(folder: &Folder, arguments: &str, code: i32, expected: &str) {
        let ended = folder.check(arguments, code, "");
        assert_eq!(ended.stdout, expected, "{arguments}");
    }
    said(&folder, "mesh diff octahedron.obj octahedron.obj", 0, "the same\n");
    said(&folder, "mesh diff moved.obj turned.obj", 0, "the same\n");
    said(
        &folder,
        "mesh diff octahedron.obj turned.obj --tolerance 0.6",
        0,
        "the same: v1 of the one and v6 of the other are farthest apart, by 5e-1\n",
    );
    said(
        &folder,
        "mesh diff octahedron.obj turned.obj",
        5,
        "the same connectivity, but v1 of the one and v6 of the other are 5e-1 apart\n",
    );
    // An octahedron that is turned inside out is one that lies elsewhere.
    assert!(folder.check("mesh diff octahedron.obj inside-out.obj", 5, "").stdout.starts_with("the same connectivity"));
    said(&folder, "mesh diff left.obj right.obj", 5, "the same connectivity, but one is the other turned inside out\n");
    let counts = folder.check("mesh diff octahedron.obj square.off", 5, "").stdout;
    assert!(counts.starts_with("vertices        6  ≠  4\n"), "{counts}");
    let object = json(&folder.check("mesh diff octahedron.obj turned.obj --json", 5, "").stdout);
    assert_eq!((&object["same_connectivity"], &object["vertices"]), (&json("true"), &json("[1, 6]")));
    folder.check("mesh diff octahedron.obj none.obj", 3, "none.obj");
    folder.check("mesh diff octahedron.obj turned.obj --tolerance -1", 2, "a tolerance is a number from 0 on");
}
