//! `--reference` with meshes.

use super::*;

#[test]
fn a_mesh_is_compared_with_an_earlier_one() {
    let folder = Folder::with(&[]);
    folder.check("run move.vv -i octahedron.obj -o old.off", 0, "");
    folder.check("run move.vv -i octahedron.obj --reference old.off", 0, "");
    folder.check("run move.vv -i octahedron.obj -D far=1.25 --reference old.off --tolerance 0.25", 0, "");
    let said = "the mesh is not that of old.off: v1 is 2.5e-1 off its place; 6 vertices";
    folder.check("run move.vv -i octahedron.obj -D far=1.25 --reference old.off", 5, said);
    folder.check("run triangle.vv --reference old.off", 5, "it has 3 vertices in place of 6");
}

#[test]
fn the_outputs_are_written_for_a_look_at_the_difference() {
    let folder = Folder::with(&[]);
    let ended = folder.run("run move.vv -i octahedron.obj -o new.obj --reference octahedron.obj --summary json");
    assert_eq!(ended.code, Some(5));
    assert_eq!(vertices(&folder.read("new.obj"))[0], "2 0 0");
    assert_eq!(json(&ended.stdout)["vertices"], 6);
    let ended = folder.run("run move.vv -i octahedron.obj -o new.obj --reference new.obj");
    assert_eq!(ended.code, Some(0), "the reference is read before it is overwritten: {}", ended.stderr);
}
