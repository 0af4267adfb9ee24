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
