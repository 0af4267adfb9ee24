//! Mesh files: text in, faces and warnings out; round trips; what is refused and where.

use vv::io::{Format, ReadError, ReadOptions, read, write};
use vv::mesh::faces::faces;
use vv::stop::Stop;

use crate::mesh::{face_list, ring_list};

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
        Err(ReadError::Invalid { line, diagnostic }) => {
            let line = line.map_or(String::new(), |line| format!(" line {line}"));
            let mut text = format!("error{line}: {}", diagnostic.message);
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

const TETRAHEDRON: &str = "1 2 3 / 1 3 4 / 1 4 2 / 2 4 3";

#[test]
fn faces_of_a_tetrahedron() {
    check_faces(TETRAHEDRON, TETRAHEDRON);
}

#[test]
fn obj_and_off_say_the_same() {
    check_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n", "1 2 3 4");
    check_off("OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n", "1 2 3 4");
}

#[test]
fn what_was_written_reads_back_and_is_written_the_same() {
    for name in std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../assets/meshes")).unwrap() {
        let path = name.unwrap().path();
        if !path.is_file() {
            continue;
        }
        for format in Format::ALL {
            let bytes = std::fs::read(&path).unwrap();
            let (first, _) = read(&bytes, Format::Obj, &ReadOptions::default()).unwrap();
            let written = write(&first, &faces(&first, &Stop::new()).unwrap(), format);
            let (second, diagnostics) = read(&written, format, &ReadOptions::default()).unwrap();
            assert_eq!(diagnostics, []);
            assert_eq!(ring_list(&first), ring_list(&second));
            assert_eq!(written, write(&second, &faces(&second, &Stop::new()).unwrap(), format));
        }
    }
}
