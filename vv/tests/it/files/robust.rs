//! Files of any bytes: nothing panics, nothing grows without bound, and what is read is a valid mesh. `PROPTEST_CASES`
//! sets how many.

use proptest::prelude::*;
use vv::mesh::validate::validate;

use super::*;

/// Small meshes in all formats, with values of all kinds.
fn files() -> Vec<(Format, Vec<u8>)> {
    let obj = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 1\nf 1 2 3\nf 1/1 3//2 4/5/6\nt crease 2/1/0 0 2 1.5\n\
        t corner 1/1/0 1 2\n";
    let (mut mesh, _) = read(obj.as_bytes(), Format::Obj, &ReadOptions::default()).unwrap();
    mesh.declare_vertex_property("age", vv::mesh::Value::Int(3));
    mesh.declare_vertex_property("v", vv::mesh::Value::Vec(glam::DVec3::X));
    mesh.declare_mesh_property("step", vv::mesh::Value::Int(7));
    let mut files: Vec<_> = Format::ALL.map(|format| (format, written(&mesh, format))).to_vec();
    files.push((Format::Obj, obj.as_bytes().to_vec()));
    files
}

fn check(format: Format, bytes: &[u8]) {
    match read(bytes, format, &ReadOptions::default()) {
        Ok((mesh, _)) => {
            assert_eq!(validate(&mesh, &Stop::new()).unwrap(), []);
            for format in Format::ALL {
                drop(written(&mesh, format));
            }
        }
        Err(ReadError::Invalid { place, diagnostic }) => {
            let message = diagnostic.message;
            assert!(!message.is_empty() && !message.contains('\n') && message.len() < 400, "{message}");
            if let Some(Place::Byte(offset)) = place {
                assert!(offset <= bytes.len() as u64);
            }
        }
        Err(ReadError::Stopped(_)) => unreachable!(),
    }
    let _ = Format::of_bytes(bytes);
}

#[derive(Debug, Clone)]
enum Change {
    Set(usize, u8),
    Insert(usize, Vec<u8>),
    Remove(usize, usize),
    Double(usize, usize),
    Cut(usize),
}

fn change() -> impl Strategy<Value = Change> {
    let place = 0..4096usize;
    let word = prop::sample::select(vec![
        "0",
        "-1",
        "4294967295",
        "18446744073709551616",
        "nan",
        "inf",
        "1e999",
        "",
        "\n",
        "#",
        "\"",
        "{",
        "[",
        "list",
        "\0\0\0\0",
        "\u{ff}\u{ff}",
        "element x 1000000000000\n",
        "property float\n",
    ]);
    prop_oneof![
        (place.clone(), any::<u8>()).prop_map(|(i, byte)| Change::Set(i, byte)),
        (place.clone(), word).prop_map(|(i, word)| Change::Insert(i, word.as_bytes().to_vec())),
        (place.clone(), 1..40usize).prop_map(|(i, n)| Change::Remove(i, n)),
        (place.clone(), 1..200usize).prop_map(|(i, n)| Change::Double(i, n)),
        place.prop_map(Change::Cut),
    ]
}

fn apply(bytes: &mut Vec<u8>, change: &Change) {
    let n = bytes.len().max(1);
    let at = |i: usize| (i % n).min(bytes.len());
    match change {
        Change::Set(i, byte) => {
            if let Some(b) = bytes.get_mut(i % n) {
                *b = *byte;
            }
        }
        Change::Insert(i, word) => {
            let i = at(*i);
            bytes.splice(i..i, word.iter().copied());
        }
        Change::Remove(i, len) => {
            let (from, to) = (at(*i), at(*i).saturating_add(*len).min(bytes.len()));
            bytes.drain(from..to);
        }
        Change::Double(i, len) => {
            let (from, to) = (at(*i), at(*i).saturating_add(*len).min(bytes.len()));
            let part = bytes[from..to].to_vec();
            bytes.splice(to..to, part);
        }
        Change::Cut(i) => bytes.truncate(at(*i)),
    }
}

proptest! {
    #[test]
    fn changed_files_are_read_or_refused(file in 0..10usize, changes in prop::collection::vec(change(), 1..6)) {
        let (format, mut bytes) = files().swap_remove(file);
        changes.iter().for_each(|change| apply(&mut bytes, change));
        check(format, &bytes);
    }

    #[test]
    fn random_bytes_are_read_or_refused(format in prop::sample::select(Format::ALL.to_vec()), bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        check(format, &bytes);
        let beginning: &[u8] = match format {
            Format::Ply => b"ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                element face 4\nproperty list uchar uchar vertex_indices\nend_header\n",
            Format::Glb => b"glTF\x02\0\0\0\xff\0\0\0",
            Format::Stl => b"solid ",
            Format::Gltf => b"{\"asset\":{\"version\":\"2.0\"},",
            _ => b"",
        };
        check(format, &[beginning, &bytes].concat());
    }
}

#[test]
fn files_that_are_cut_anywhere_are_read_or_refused() {
    for (format, bytes) in files() {
        for end in 0..bytes.len() {
            check(format, &bytes[..end]);
        }
    }
}

#[test]
fn a_byte_that_is_changed_anywhere_is_read_or_refused() {
    for (format, bytes) in files().into_iter().filter(|(format, _)| !format.is_text()) {
        for i in 0..bytes.len() {
            for byte in [0, 0x7F, 0xFF] {
                let mut changed = bytes.clone();
                changed[i] = byte;
                check(format, &changed);
            }
        }
    }
}
