//! Mesh files: text in, faces and warnings out; round trips; what is refused and where.

use vv::io::{Format, Place, ReadError, ReadOptions, read, write};
use vv::mesh::Mesh;
use vv::mesh::faces::faces;
use vv::stop::{Stop, Stopped};

use crate::mesh::{face_list, ring_list};

mod binary;
mod gltf;
mod losses;
mod obj;
mod off;
mod ply;
mod robust;
mod stl;
mod values;
mod wires;

use values::check_values;

/// Reads and shows the faces, then the messages.
fn outcome(bytes: &[u8], format: Format, strict: bool) -> String {
    match read(bytes, format, &ReadOptions { strict, stop: Stop::new() }) {
        Ok((mesh, diagnostics)) => {
            let mut text = face_list(&mesh);
            for d in diagnostics {
                text += &format!("\n{:?}: {}", d.severity, d.message);
                d.evidence.iter().for_each(|fact| text += &format!("\n  {fact}"));
            }
            text
        }
        Err(ReadError::Invalid { place, diagnostic }) => {
            let place = match place {
                None => String::new(),
                Some(Place::Text { line, .. }) => format!(" line {line}"),
                Some(Place::Byte(offset)) => format!(" at byte {offset}"),
            };
            let mut text = format!("error{place}: {}", diagnostic.message);
            diagnostic.evidence.iter().for_each(|fact| text += &format!("\n  {fact}"));
            text
        }
        Err(ReadError::Stopped(stopped)) => stopped.to_string(),
    }
}

#[track_caller]
fn check_obj(text: &str, expected: &str) {
    assert_eq!(outcome(text.as_bytes(), Format::Obj, false), expected);
}

#[track_caller]
fn check_off(text: &str, expected: &str) {
    assert_eq!(outcome(text.as_bytes(), Format::Off, false), expected);
}

/// Faces of three or more corners over as many vertices as they name, as OFF.
fn off(faces: &str) -> String {
    let n = faces.split(['/', ' ']).filter_map(|w| w.parse::<usize>().ok()).max().unwrap_or(0);
    let rows: Vec<_> = faces.split(" / ").map(|face| face.split(' ').collect::<Vec<_>>()).collect();
    let mut text = format!("OFF {n} {} 0\n", rows.len());
    (0..n).for_each(|i| text += &format!("{i} {} {}\n", i * i, i % 3));
    for row in rows {
        text += &row.len().to_string();
        row.iter().for_each(|v| text += &format!(" {}", v.parse::<usize>().unwrap() - 1));
        text.push('\n');
    }
    text
}

/// Polygons `1 2 3 / 1 3 4` in, faces and messages out.
#[track_caller]
fn check_faces(faces: &str, expected: &str) {
    assert_eq!(outcome(off(faces).as_bytes(), Format::Off, false), expected);
}

/// Polygons in, rings out.
#[track_caller]
fn check_rings(faces: &str, expected: &str) {
    let (mesh, _) = read(off(faces).as_bytes(), Format::Off, &ReadOptions::default()).unwrap();
    assert_eq!(ring_list(&mesh), expected);
}

const TETRAHEDRON: &str = "1 2 3 / 1 3 4 / 1 4 2 / 2 4 3";

#[test]
fn polygons_make_rings_that_start_with_the_first_face_that_names_the_vertex() {
    check_rings(TETRAHEDRON, "1: 2 3 4, 2: 3 1 4, 3: 1 2 4, 4: 1 3 2");
    check_rings("2 3 1 / 1 3 4", "1: 2 3 4 -, 2: 3 1 -, 3: 4 1 2 -, 4: 1 3 -");
    check_rings("1 2 3 4 5 6 7", "1: 2 7 -, 2: 3 1 -, 3: 4 2 -, 4: 5 3 -, 5: 6 4 -, 6: 7 5 -, 7: 1 6 -");
}

#[test]
fn what_is_read_takes_no_more_room_than_it_needs() {
    let bytes_of = |faces: &str| read(off(faces).as_bytes(), Format::Off, &ReadOptions::default()).unwrap().0.bytes();
    // Head, position and place in the set of each vertex; slots, and the room behind them.
    let expected = |vertices: usize, slots: usize| vertices * (12 + 24 + 4) + 4 * (slots + 24);
    assert_eq!(bytes_of(TETRAHEDRON), expected(4, 4 * 3));
    assert_eq!(bytes_of("1 2 3 4 5 6 7"), expected(7, 7 * 3));
}

#[test]
fn neighbouring_faces_that_disagree_are_turned_the_fewer() {
    check_faces(
        "1 2 3 / 1 4 3 / 1 4 2 / 2 4 3",
        "1 2 3 / 1 3 4 / 1 4 2 / 2 4 3\n\
         Warning: 1 face ran round the other way than its neighbours and was turned over\n  \
           face 2 (line 7): v1 v4 v3",
    );
    // Also where the walk began with the one that disagrees.
    check_faces(
        "1 3 2 / 1 3 4 / 1 4 5",
        "1 2 3 / 1 3 4 / 1 4 5\n\
         Warning: 1 face ran round the other way than its neighbours and was turned over\n  \
           face 1 (line 7): v1 v3 v2",
    );
    check_faces(
        "1 3 2 / 1 4 3 / 1 2 4 / 2 4 3",
        "1 3 2 / 1 2 4 / 1 4 3 / 2 3 4\n\
         Warning: 1 face ran round the other way than its neighbours and was turned over\n  \
           face 4 (line 9): v2 v4 v3",
    );
}

#[test]
fn a_surface_that_is_not_orientable_is_refused_with_the_band_that_proves_it() {
    check_faces(
        "1 2 3 / 2 4 3 / 3 4 5 / 4 1 5 / 5 1 2",
        "error line 10: the surface is not orientable: a band of 5 faces comes back the other way round\n  \
           each of these meets the next, the last the first; however they are turned, two run along an edge in the same \
           direction\n  \
           face 4 (line 10): v4 v1 v5\n  \
           face 5 (line 11): v5 v1 v2\n  \
           face 1 (line 7): v1 v2 v3\n  \
           face 2 (line 8): v2 v4 v3\n  \
           face 3 (line 9): v3 v4 v5",
    );
    check_faces(
        "1 2 3 1 2 4",
        "error line 6: the surface is not orientable: face 1 (line 6) meets itself the wrong way round\n  \
           it runs along one of its edges twice in the same direction\n  \
           face 1 (line 6): v1 v2 v3 v1 v2 v4",
    );
}

#[test]
fn more_than_two_faces_along_an_edge_get_vertices_of_their_own() {
    check_faces(
        "1 2 3 / 2 1 4 / 1 2 5",
        "1 4 2 / 1 2 3 / 5 6 7\n\
         Warning: 1 edge has more than two faces; 2 vertices were duplicated so that every face is kept\n  \
           edge v1–v2: face 1 (line 7), face 2 (line 8), face 3 (line 9)",
    );
    // Two tetrahedra that share an edge stay closed.
    check_faces(
        "1 2 3 / 1 3 4 / 1 4 2 / 2 4 3 / 1 2 5 / 1 5 6 / 1 6 2 / 2 6 5",
        "1 2 3 / 1 3 4 / 1 4 2 / 2 4 3 / 5 7 8 / 5 8 6 / 5 6 7 / 6 8 7\n\
         Warning: 1 edge has more than two faces; 2 vertices were duplicated so that every face is kept\n  \
           edge v1–v2: face 1 (line 8), face 3 (line 10), face 5 (line 12), face 7 (line 14)",
    );
    // A face laid into a tetrahedron does not open it, wherever it stands in the file.
    check_faces(
        "2 3 4 / 2 3 1 / 2 1 3 / 4 1 2 / 3 1 4",
        "1 5 6 / 2 3 4 / 2 4 7 / 2 7 3 / 3 7 4\n\
         Warning: 3 edges have more than two faces; 3 vertices were duplicated so that every face is kept\n  \
           edge v1–v2: face 2 (line 7), face 3 (line 8), face 4 (line 9)\n  \
           edge v1–v3: face 2 (line 7), face 3 (line 8), face 5 (line 10)\n  \
           edge v2–v3: face 1 (line 6), face 2 (line 7), face 3 (line 8)",
    );
    check_faces(
        "1 2 3 / 2 3 4 / 4 1 2 / 3 1 4 / 2 1 3",
        "1 2 3 / 4 5 6 / 4 6 7 / 4 7 5 / 5 7 6\n\
         Warning: 3 edges have more than two faces; 3 vertices were duplicated so that every face is kept\n  \
           edge v1–v2: face 1 (line 6), face 3 (line 8), face 5 (line 10)\n  \
           edge v1–v3: face 1 (line 6), face 4 (line 9), face 5 (line 10)\n  \
           edge v2–v3: face 1 (line 6), face 2 (line 7), face 5 (line 10)",
    );
    // A fan that goes round twice: however its faces are paired a ring would name a vertex twice, so they come apart.
    check_faces(
        "1 2 3 / 4 5 2 4 5 / 4 3 2 / 5 4 2 / 5 2 6",
        "1 2 3 / 4 5 7 8 9 / 6 16 17 / 10 11 12 / 13 14 15\n\
         Warning: 3 edges have more than two faces; 11 vertices were duplicated so that every face is kept\n  \
           edge v2–v4: face 2 (line 9), face 3 (line 10), face 4 (line 11)\n  \
           edge v2–v5: face 2 (line 9), face 4 (line 11), face 5 (line 12)\n  \
           edge v4–v5: face 2 (line 9), face 2 (line 9), face 2 (line 9), face 4 (line 11)",
    );
}

#[test]
fn a_vertex_is_split_where_a_closed_fan_meets_others() {
    check_faces(
        "1 2 3 / 1 3 4 / 1 4 2 / 2 4 3 / 1 5 6",
        "1 2 3 / 1 3 4 / 1 4 2 / 2 4 3 / 5 6 7\n\
         Warning: several fans of faces met in one vertex; 1 vertex was split off so that each has its own\n  \
           v7 splits off v1",
    );
}

#[test]
fn open_fans_share_their_vertex() {
    check_faces("1 2 3 / 1 4 5", "1 2 3 / 1 4 5");
    check_rings("1 2 3 / 1 4 5", "1: 2 3 - 4 5 -, 2: 3 1 -, 3: 1 2 -, 4: 5 1 -, 5: 1 4 -");
    check_faces(
        "1 2 3 / 1 4 5 / 1 6 7",
        "1 2 3 / 1 4 5 / 1 6 7\n\
         Warning: three or more open fans of faces meet in 1 vertex; their cyclic order is not known, they stand in the \
           order of their first faces\n  \
           v1: 3 fans",
    );
}

#[test]
fn what_has_no_area_is_dropped() {
    check_faces(
        "1 2 2 3 / 1 3 4 1",
        "1 2 3 / 1 3 4\n\
         Warning: 2 faces named a corner twice in succession; the second was dropped\n  \
           face 1 (line 6): v1 v2 v2 v3\n  \
           face 2 (line 7): v1 v3 v4 v1",
    );
    check_faces(
        "1 2 3 / 1 1 2 / 3 1 / 2",
        "1 2 3\n\
         Warning: 3 faces of fewer than three corners were dropped\n  \
           face 2 (line 6): v1 v1 v2\n  \
           face 3 (line 7): v3 v1\n  \
           face 4 (line 8): v2",
    );
    check_faces(
        "1 2 3 / 2 3 1 / 1 3 4 / 4 1 3",
        "1 2 3 / 1 3 4\n\
         Warning: 2 duplicate faces were dropped\n  \
           face 2 (line 7): v2 v3 v1, as face 1 (line 6)\n  \
           face 4 (line 9): v4 v1 v3, as face 3 (line 8)",
    );
    check_faces(
        "1 2 4",
        "1 2 3\n\
         Warning: 1 vertex is in no face; dropped\n  \
           v3\n  \
           the vertices after them were renumbered",
    );
}

#[test]
fn what_is_odd_but_representable_is_kept() {
    check_faces(
        "1 2 3 / 1 3 2",
        "1 2 3 / 1 3 2\n\
         Warning: two faces lie back to back and make a closed pillow without thickness\n  \
           face 1 (line 5): v1 v2 v3 and face 2 (line 6)",
    );
    check_faces("1 2 3 2", "1 2 3 2"); // a spike
    check_faces("1 2 3 1 4 5", "1 2 3 1 4 5"); // a face that visits a vertex twice
}

#[test]
fn strict_reading_refuses_what_would_be_repaired() {
    let strict = |faces: &str| outcome(off(faces).as_bytes(), Format::Off, true);
    assert_eq!(strict(TETRAHEDRON), TETRAHEDRON);
    assert_eq!(
        strict("1 2 3 / 2 1 4 / 1 2 5"),
        "error: the mesh needs repair, which strict reading refuses: \
           1 edge has more than two faces; 2 vertices were duplicated so that every face is kept\n  \
           edge v1–v2: face 1 (line 7), face 2 (line 8), face 3 (line 9)"
    );
    assert_eq!(
        strict("1 2 3 / 3 1 2 / 4 5"),
        "error: the mesh needs repair, which strict reading refuses: 1 face of fewer than three corners was dropped\n  \
           face 3 (line 9): v4 v5\n  \
           also: 1 duplicate face was dropped\n  \
           also: 2 vertices are in no face; dropped"
    );
    assert!(strict("1 2 3 / 1 3 2").starts_with("1 2 3 / 1 3 2\nWarning: two faces lie back to back"));
}

#[test]
fn a_file_without_faces_is_an_empty_mesh_a_file_without_words_none() {
    let empty = "\nWarning: the file has no faces, so the mesh is empty";
    check_obj("# nothing\n", empty);
    check_off("OFF\n0 0 0\n", empty);
    check_obj(" \n", "error: the file is empty");
    check_off("", "error: the file is empty");
    check_off("# hello\n", "error: the file holds nothing but comments");
}

/// What each file under `assets/meshes/bad` is there for: its faces, or how the message begins.
const BAD: [(&str, &str); 24] = [
    ("big-endian.ply", "1 3 2 / 1 2 4 / 1 4 3 / 2 3 4"),
    ("bow-tie.obj", "1 2 3 / 1 4 5"),
    ("colors-and-normals.off", "Note: normals, texture coordinates and colours of faces are not read"),
    ("comments.off", "1 2 3"),
    ("corner-out-of-range.off", "error line 8: face 2 has a corner at vertex 4, but they go from 0 to 3"),
    ("duplicate-face.obj", "Warning: 1 duplicate face was dropped"),
    ("flat.off", "Note: the vertices have two coordinates; the third is 0"),
    ("flipped-face.obj", "Warning: 1 face ran round the other way than its neighbours and was turned over"),
    ("heptagon.off", "1 2 3 4 5 6 7"),
    ("isolated-vertex.obj", "Warning: 1 vertex is in no face; dropped"),
    ("klein.off", "error line 27: the surface is not orientable: a band of 5 faces comes back the other way round"),
    ("lying-counts.off", "error line 6: the file ends after 4 of 1000000000 vertices"),
    ("mobius.obj", "error line 10: the surface is not orientable: a band of 5 faces comes back the other way round"),
    ("nonmanifold-edge.obj", "Warning: 1 edge has more than two faces; 2 vertices were duplicated"),
    ("not-finite.obj", "error line 3: `nan` is not finite"),
    ("parallel-edges.off", "Warning: 1 edge has more than two faces; 2 vertices were duplicated"),
    ("pillow.off", "Warning: two faces lie back to back"),
    ("repeated-corner.obj", "Warning: 2 faces named a corner twice in succession; the second was dropped"),
    ("single-triangle.stl", "1 2 3"),
    ("slashes.obj", "1 2 3 / 1 3 4"),
    ("three-open-fans.obj", "Warning: three or more open fans of faces meet in 1 vertex"),
    ("truncated.obj", "error line 10: the file ends within a face, after `f 2 6`; it was probably cut off"),
    ("two-closed-fans.obj", "Warning: several fans of faces met in one vertex; 1 vertex was split off"),
    ("two-corners.off", "Warning: 3 faces of fewer than three corners were dropped"),
];

#[test]
fn bad_fixtures_are_what_they_are_there_for() {
    let folder = std::path::PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../assets/meshes/bad");
    let mut names: Vec<_> =
        std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert_eq!(names, BAD.map(|(name, _)| name));
    for (name, expected) in BAD {
        let format = Format::from_extension(name.rsplit('.').next().unwrap()).unwrap();
        let outcome = outcome(&std::fs::read(folder.join(name)).unwrap(), format, false);
        let mut found = outcome.lines().filter(|line| line.starts_with(expected));
        assert!(found.next().is_some(), "{name}: {outcome}");
    }
}

#[test]
fn numbers_are_written_as_short_as_they_read_back() {
    let obj = "v 0.1 -0 1e300\nv 1e-7 123456789012 5e-324\nv 0.30000000000000004 -1.5 100\nf 1 2 3\n";
    let (mesh, _) = read(obj.as_bytes(), Format::Obj, &ReadOptions::default()).unwrap();
    let written = write(&mesh, &faces(&mesh, &Stop::new()).unwrap(), Format::Obj).unwrap().0;
    assert_eq!(String::from_utf8(written).unwrap(), format!("# 3 vertices, 1 faces\n{obj}"));
}

#[test]
fn edges_without_faces_are_not_written() {
    let mut mesh = Mesh::new();
    let (p, q) = (mesh.create().unwrap(), mesh.create().unwrap());
    mesh.make(p, &[Some(q)]).unwrap();
    mesh.make(q, &[Some(p)]).unwrap();
    mesh.set = [p, q].into_iter().collect();
    let found = faces(&mesh, &Stop::new()).unwrap();
    assert_eq!(found.len(), 1);
    assert_eq!(write(&mesh, &found, Format::Off).unwrap().0, b"OFF\n2 0 0\n0 0 0\n0 0 0\n");
}

#[test]
fn reading_stops() {
    let stop = Stop::new();
    stop.request(Stopped::ByUser);
    for (format, text) in
        [(Format::Off, off(TETRAHEDRON)), (Format::Obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".to_owned())]
    {
        let result = read(text.as_bytes(), format, &ReadOptions { strict: false, stop: stop.clone() });
        assert_eq!(result.err(), Some(ReadError::Stopped(Stopped::ByUser)));
    }
}

/// The meshes under `assets/meshes`.
fn assets() -> impl Iterator<Item = (String, Mesh)> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../assets/meshes");
    let paths = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_file());
    paths.map(|path| {
        let format = Format::from_extension(path.extension().unwrap().to_str().unwrap()).unwrap();
        let (mesh, diagnostics) = read(&std::fs::read(&path).unwrap(), format, &ReadOptions::default()).unwrap();
        assert_eq!(diagnostics, [], "{}", path.display());
        (path.display().to_string(), mesh)
    })
}

fn written(mesh: &Mesh, format: Format) -> Vec<u8> {
    write(mesh, &faces(mesh, &Stop::new()).unwrap(), format).unwrap().0
}

#[test]
fn what_was_written_reads_back_and_is_written_the_same() {
    for (name, first) in assets() {
        let is_wire = faces(&first, &Stop::new()).unwrap().is_empty();
        for format in Format::ALL.into_iter().filter(|&format| !is_wire || format == Format::Obj) {
            let bytes = written(&first, format);
            let (second, diagnostics) =
                read(&bytes, format, &ReadOptions { strict: true, ..Default::default() }).unwrap();
            let triangles = faces(&first, &Stop::new()).unwrap().iter().all(|face| face.len() == 3);
            let (keeps_order, keeps_faces) = match format {
                Format::Stl | Format::StlText => (false, triangles),
                Format::Glb | Format::Gltf => (triangles, triangles),
                _ => (true, true),
            };
            if keeps_order {
                assert_eq!(diagnostics, [], "{name} {format:?}");
                assert_eq!(ring_list(&first), ring_list(&second), "{name} {format:?}");
                assert_eq!(bytes, written(&second, format), "{name} {format:?}");
            }
            let count = |mesh: &Mesh| faces(mesh, &Stop::new()).unwrap().len();
            assert_eq!(first.vertex_count(), second.vertex_count(), "{name} {format:?}");
            assert!(!keeps_faces || count(&first) == count(&second), "{name} {format:?}");
        }
    }
}
