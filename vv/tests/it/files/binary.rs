//! Binary files, byte by byte: what others write, and where it breaks off.

use super::*;

/// A triangle in binary PLY of this byte order, as other programs write it.
fn ply(big: bool) -> Vec<u8> {
    let order = if big { "big" } else { "little" };
    let mut bytes = format!(
        "ply\nformat binary_{order}_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
         property short k\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    for (p, k) in [([0f32, 0., 0.], 1i16), ([1.5, 0., 0.], -2), ([0., 1., 0.], 300)] {
        p.into_iter().for_each(|x| bytes.extend(if big { x.to_be_bytes() } else { x.to_le_bytes() }));
        bytes.extend(if big { k.to_be_bytes() } else { k.to_le_bytes() });
    }
    bytes.push(3);
    (0..3i32).for_each(|i| bytes.extend(if big { i.to_be_bytes() } else { i.to_le_bytes() }));
    bytes
}

/// A tetrahedron in binary STL.
fn stl() -> Vec<u8> {
    let mut bytes = b"solid in name only".to_vec();
    bytes.resize(80, b' ');
    let points = [[0f32, 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]];
    bytes.extend(4u32.to_le_bytes());
    for face in [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]] {
        bytes.extend([0; 12]);
        face.iter().flat_map(|&v: &usize| points[v]).for_each(|x| bytes.extend(x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

#[track_caller]
fn check(bytes: &[u8], format: Format, expected: &str) {
    assert_eq!(outcome(bytes, format, false), expected);
}

#[test]
fn binary_ply_is_read_in_both_orders() {
    for big in [false, true] {
        check(&ply(big), Format::Ply, "1 2 3");
        check_values(&ply(big), Format::Ply, "k: 1 -2 300");
        let (mesh, _) = read(&ply(big), Format::Ply, &ReadOptions::default()).unwrap();
        assert_eq!(mesh.positions()[1].to_array(), [1.5, 0.0, 0.0]);
    }
}

#[test]
fn binary_data_begins_after_the_line_end_that_the_header_has() {
    let text = |bytes: &[u8]| bytes.windows(11).position(|w| w == b"end_header\n").unwrap() + 11;
    let header = text(&ply(false));
    for (end, first) in [("\r\n", 0x0A), ("\r", 0x0A), ("\n", 0x0D)] {
        let bytes = ply(false);
        let mut changed = String::from_utf8(bytes[..header].to_vec()).unwrap().replace('\n', end).into_bytes();
        changed.extend(&bytes[header..]);
        let at = changed.len() - (bytes.len() - header);
        changed[at] = first; // the lowest byte of the first coordinate looks like a line end
        check(&changed, Format::Ply, "1 2 3");
    }
}

#[test]
fn binary_files_that_break_off_say_where() {
    let bytes = ply(false);
    let n = bytes.len();
    check(&bytes[..n - 1], Format::Ply, &format!("error at byte {}: the file ends after 0 of 1 rows of `face`", n - 4));
    check(
        &bytes[..n - 14],
        Format::Ply,
        &format!("error at byte {}: the file ends after 2 of 3 rows of `vertex`", n - 15),
    );
    check(&[&bytes[..], b"xyz"].concat(), Format::Ply, "1 2 3\nWarning: 3 bytes after the last element are ignored");
    let mut wrong = bytes;
    wrong[n - 4] = 9;
    check(&wrong, Format::Ply, &format!("error at byte {n}: face 1 has a corner at vertex 9, but they go from 0 to 2"));

    let bytes = stl();
    check(&bytes[..250], Format::Stl, "error at byte 250: the file announces 4 triangles and ends after 3");
}

#[test]
fn stl_is_known_by_its_length_whatever_it_begins_with() {
    let tetrahedron = "1 2 3 / 1 3 4 / 1 4 2 / 2 4 3";
    let note = "Note: 12 corners of triangles were welded to 4 vertices, one for each position";
    check(&stl(), Format::Stl, &format!("{tetrahedron}\n{note}"));
    let mut named = stl();
    named[..5].copy_from_slice(b"plain");
    check(&named, Format::Stl, &format!("{tetrahedron}\n{note}"));
    check(&named[..250], Format::Stl, "error at byte 250: the file announces 4 triangles and ends after 3");
    check(
        &named[..50],
        Format::Stl,
        "error: this is no STL file: it neither begins with `solid` nor has 84 bytes of header",
    );
    let warning = "Warning: 2 bytes after the last triangle are ignored";
    check(&[&named[..], b"xy"].concat(), Format::Stl, &format!("{tetrahedron}\n{note}\n{warning}"));
    let mut wrong = named.clone();
    wrong[84 + 50 + 12..][..4].copy_from_slice(&f32::NAN.to_le_bytes());
    check(&wrong, Format::Stl, "error at byte 146: triangle 2: a coordinate is not finite");
}

#[test]
fn formats_are_known_by_their_bytes() {
    for (name, mesh) in assets().take(4) {
        for format in Format::ALL.into_iter().filter(|&format| format != Format::Obj) {
            let found = Format::of_bytes(&written(&mesh, format)).map(Format::extension);
            assert_eq!(found, Some(format.extension()), "{name}");
        }
        assert_eq!(Format::of_bytes(&written(&mesh, Format::Obj)), None);
    }
    assert_eq!(Format::of_bytes(b"# made by hand\n\n  COFF # colours\n"), Some(Format::Off));
    assert_eq!(Format::of_bytes(b"off 3 1 0"), Some(Format::Off));
    assert_eq!(Format::of_bytes(b"# OFF\nv 0 0 0"), None);
    assert_eq!(Format::of_bytes(b""), None);
    assert_eq!(Format::of_bytes(&stl()), Some(Format::Stl));
    for format in Format::ALL {
        assert_eq!(Format::from_name(format.name()), Some(format));
        assert_eq!(Format::from_extension(format.extension()).map(Format::extension), Some(format.extension()));
        assert!(Format::EXTENSIONS.contains(&format.extension()));
    }
}
