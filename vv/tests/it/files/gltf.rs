//! glTF and GLB.

use serde_json::{Value as Json, json};

use super::values::values;
use super::*;

/// A document of one triangle: positions at 0, indices at 36, colours at 48.
fn document() -> Json {
    let positions = [0f32, 0., 0., 1., 0., 0., 0., 1., 0.].map(f32::to_le_bytes).concat();
    let indices = [0u32, 1, 2].map(u32::to_le_bytes).concat();
    let colors = [255u8, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255].to_vec();
    let data = [positions, indices, colors].concat();
    json!({
        "asset": { "version": "2.0" },
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0, "COLOR_0": 2 }, "indices": 1 }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3 },
            { "bufferView": 0, "byteOffset": 36, "componentType": 5125, "type": "SCALAR", "count": 3 },
            { "bufferView": 0, "byteOffset": 48, "componentType": 5121, "type": "VEC4", "count": 3, "normalized": true },
        ],
        "bufferViews": [{ "buffer": 0, "byteLength": 60 }],
        "buffers": [{ "byteLength": 60, "uri": format!("data:application/octet-stream;base64,{}", base64(&data)) }],
    })
}

fn base64(data: &[u8]) -> String {
    const DIGITS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for three in data.chunks(3) {
        let word = (0..3).fold(0u32, |word, i| word << 8 | u32::from(three.get(i).copied().unwrap_or(0)));
        (0..4).for_each(|i| {
            text.push(if i <= three.len() { char::from(DIGITS[(word >> (18 - 6 * i) & 63) as usize]) } else { '=' });
        });
    }
    text
}

/// The document after a change.
fn changed(change: impl FnOnce(&mut Json)) -> Vec<u8> {
    let mut document = document();
    change(&mut document);
    document.to_string().into_bytes()
}

#[track_caller]
fn check(change: impl FnOnce(&mut Json), expected: &str) {
    assert_eq!(outcome(&changed(change), Format::Gltf, false), expected);
}

#[track_caller]
fn positions(change: impl FnOnce(&mut Json)) -> Vec<[f64; 3]> {
    let (mesh, _) = read(&changed(change), Format::Gltf, &ReadOptions::default()).unwrap();
    mesh.positions().iter().map(|p| p.to_array()).collect()
}

#[test]
fn a_triangle_with_colours_is_read() {
    check(|_| {}, "1 2 3");
    check_values(&changed(|_| {}), Format::Gltf, "color: (1 0 0) (0 1 0) (0 0 1)");
    check(|d| drop(d["nodes"].take()), "error line 1: this is no glTF: invalid type: null, expected a sequence");
    check(|d| drop(d.as_object_mut().unwrap().remove("nodes")), "1 2 3");
    check(|d| drop(d.as_object_mut().unwrap().remove("scenes")), "1 2 3");
    check(|d| d["meshes"][0]["primitives"][0]["indices"] = Json::Null, "1 2 3");
}

#[test]
fn colours_stand_for_the_property_of_their_name() {
    let with_other = |d: &mut Json| d["meshes"][0]["primitives"][0]["attributes"]["_color"] = json!(0);
    check(with_other, "1 2 3\nWarning: the scene has two properties `color`; only the first is read");
    check_values(&changed(with_other), Format::Gltf, "color: (1 0 0) (0 1 0) (0 0 1)");
}

#[test]
fn nodes_place_and_mirror() {
    let moved = positions(|d| d["nodes"][0]["translation"] = json!([1, 2, 3]));
    assert_eq!(moved, [[1.0, 2.0, 3.0], [2.0, 2.0, 3.0], [1.0, 3.0, 3.0]]);
    let nested = positions(|d| {
        d["nodes"] = json!([{ "children": [1], "scale": [2, 2, 2] }, { "mesh": 0, "rotation": [0, 0, 1, 0] }]);
    });
    assert_eq!(nested[1], [-2.0, 0.0, 0.0]);
    let columns = json!([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1]);
    assert_eq!(positions(|d| d["nodes"][0]["matrix"] = columns)[0], [5.0, 0.0, 0.0]);
    check(|d| d["nodes"][0]["scale"] = json!([-1, 1, 1]), "1 3 2");
    // Two instances side by side share two vertices.
    check(
        |d| {
            d["nodes"] = json!([{ "mesh": 0 }, { "mesh": 0, "rotation": [0, 0, 1, 0], "translation": [1, 1, 0] }]);
            d["scenes"][0]["nodes"] = json!([0, 1]);
        },
        "1 2 3 / 2 4 3\nNote: 6 vertices were welded to 4 vertices, one for each position",
    );
}

/// Points without indices, with a second accessor in which the point at 1 lies elsewhere.
fn points(mode: u32, accessor: u32) -> Vec<u8> {
    points_but_one(mode, accessor, (5123, 1u32.to_le_bytes()))
}

/// The same with another index, of a component type, of the point that lies elsewhere.
fn points_but_one(mode: u32, accessor: u32, (component, index): (u32, [u8; 4])) -> Vec<u8> {
    let points =
        [[0f32, 0.], [1., 0.], [0., 1.], [1., 1.], [0., 2.]].map(|[x, y]| [x, y, 0.].map(f32::to_le_bytes).concat());
    let elsewhere = [&index[..], &[5f32, 6., 7.].map(f32::to_le_bytes).concat()].concat();
    let data = [points.concat(), elsewhere].concat();
    let document = json!({
        "asset": { "version": "2.0" },
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": accessor }, "mode": mode }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 5 },
            { "bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 5, "sparse": {
                "count": 1,
                "indices": { "bufferView": 1, "componentType": component },
                "values": { "bufferView": 1, "byteOffset": 4 },
            } },
        ],
        "bufferViews": [{ "buffer": 0, "byteLength": 60 }, { "buffer": 0, "byteOffset": 60, "byteLength": 16 }],
        "buffers": [{ "byteLength": data.len(), "uri": format!("data:;base64,{}", base64(&data)) }],
    });
    document.to_string().into_bytes()
}

#[test]
fn strips_and_fans_are_triangles() {
    assert_eq!(outcome(&points(5, 0), Format::Gltf, false), "1 2 3 / 2 4 3 / 3 4 5");
    assert_eq!(outcome(&points(6, 0), Format::Gltf, false), "1 2 3 / 1 3 4 / 1 4 5");
}

#[test]
fn sparse_values_replace_others() {
    let (mesh, _) = read(&points(5, 1), Format::Gltf, &ReadOptions::default()).unwrap();
    assert_eq!(mesh.positions()[1].to_array(), [5.0, 6.0, 7.0]);
    assert_eq!(mesh.positions()[2].to_array(), [0.0, 1.0, 0.0]);
}

#[test]
fn sparse_indices_that_are_none_are_refused() {
    let check = |component: u32, index: [u8; 4], shown: &str| {
        let expected = format!("error: accessor 1: {shown} is no sparse index of 5 values");
        assert_eq!(outcome(&points_but_one(5, 1, (component, index)), Format::Gltf, false), expected);
    };
    check(5125, 5u32.to_le_bytes(), "5");
    check(5125, u32::MAX.to_le_bytes(), "4294967295");
    check(5120, [-1i8 as u8, 0, 0, 0], "-1");
    check(5126, 1.5f32.to_le_bytes(), "1.5");
    check(5126, f32::NAN.to_le_bytes(), "NaN");
}

#[test]
fn what_is_no_surface_is_named() {
    check(
        |d| {
            d["meshes"][0]["primitives"]
                .as_array_mut()
                .unwrap()
                .push(json!({ "attributes": { "POSITION": 0 }, "mode": 1 }));
        },
        "1 2 3\nWarning: 1 set of points or lines is not read",
    );
    check(|d| d["materials"] = json!([{ "doubleSided": true }]), "1 2 3");
    check(
        |d| d["textures"] = json!([{}]),
        "1 2 3\nNote: normals, texture coordinates, materials, skins and animations are not read",
    );
}

#[test]
fn errors_say_what_is_wrong() {
    let accessor = |key: &'static str, value: Json| move |d: &mut Json| d["accessors"][0][key] = value;
    check(|d| d["asset"]["version"] = json!("1.0"), "error: this is glTF of version `1.0`, and vv reads 2.0");
    check(
        |d| d["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]),
        "error: the scene takes the extension `KHR_draco_mesh_compression`, which vv does not know",
    );
    check(|d| d["buffers"][0]["uri"] = json!("a.bin"), "error: buffer 0 lies in another file, `a.bin`");
    check(
        |d| d["buffers"][0]["uri"] = json!("data:;base64,#"),
        "error: the data of buffer 0: invalid symbol 35, offset 0",
    );
    check(|d| d["buffers"][0] = json!({ "byteLength": 60 }), "error: buffer 0 has no data");
    check(
        |d| d["bufferViews"][0]["byteLength"] = json!(61),
        "error: accessor 0: buffer view 0 reaches beyond buffer 0",
    );
    check(
        |d| d["bufferViews"][0]["byteOffset"] = json!(u64::MAX),
        "error: accessor 0: buffer view 0 reaches beyond buffer 0",
    );
    check(accessor("count", json!(6)), "error: accessor 0: it reaches beyond buffer view 0");
    check(
        accessor("count", json!(u64::MAX)),
        "error: the scene is far larger than its file, by instances or shared data",
    );
    check(
        |d| d["accessors"][0] = json!({ "componentType": 5126, "type": "VEC3", "count": 1_000_000 }),
        "error: accessor 0: it has no data, but more values than the file bytes",
    );
    check(accessor("byteOffset", json!(u64::MAX)), "error: accessor 0: it reaches beyond buffer view 0");
    check(accessor("bufferView", json!(7)), "error: accessor 0: there is no buffer view 7");
    check(accessor("componentType", json!(1)), "error: accessor 0: its component type is unknown");
    check(accessor("type", json!("MAT4")), "error: accessor 0: its type is no scalar and no vector");
    check(accessor("type", json!("VEC2")), "error: accessor 0: positions have three coordinates");
    check(
        |d| d["bufferViews"][0]["byteStride"] = json!(0),
        "error: accessor 0: the stride of buffer view 0 is shorter than a value",
    );
    check(|d| d["accessors"][1]["byteOffset"] = json!(48), "error: accessor 1: 4278190335 is no index of 3 vertices");
    check(|d| d["nodes"][0]["mesh"] = json!(1), "error: there is no mesh 1");
    check(|d| d["nodes"][0]["children"] = json!([0]), "error: node 0 stands in the scene twice");
    check(
        |d| d["nodes"] = json!([{ "children": [1], "scale": [1e300, 1, 1] }, { "mesh": 0, "scale": [1e300, 1, 1] }]),
        "error: accessor 0: a position is not finite",
    );
    assert_eq!(outcome(b"{", Format::Gltf, false), "error line 1: this is no glTF: EOF while parsing an object");
}

#[test]
fn glb_chunks_are_checked() {
    let (mesh, _) = read(&changed(|_| {}), Format::Gltf, &ReadOptions::default()).unwrap();
    let glb = written(&mesh, Format::Glb);
    assert_eq!(outcome(&glb, Format::Glb, false), "1 2 3");
    assert_eq!(glb.len() % 4, 0);
    assert_eq!(u32::from_le_bytes(glb[8..12].try_into().unwrap()) as usize, glb.len());
    let message = outcome(&glb[..glb.len() - 1], Format::Glb, false);
    assert!(message.ends_with("a chunk reaches beyond the end of the file"), "{message}");
    assert_eq!(outcome(&glb[..6], Format::Glb, false), "error at byte 6: the file ends within its header");
    assert_eq!(outcome(&glb[..12], Format::Glb, false), "error at byte 12: the file has no chunk of JSON");
    // Its text has no lines that anybody sees.
    let text = [b"glTF\x02\0\0\0\x18\0\0\0\x04\0\0\0JSON".as_slice(), b"{ x "].concat();
    assert_eq!(outcome(&text, Format::Glb, false), "error: this is no glTF: key must be a string");
    let mut old = glb;
    old[4] = 1;
    assert_eq!(outcome(&old, Format::Glb, false), "error at byte 4: this is GLB of version 1, and vv reads 2");
}

#[test]
fn values_and_colours_come_back() {
    let text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n\
        property uchar age\nproperty double v_x\nproperty double v_y\nproperty double v_z\nproperty uchar red\n\
        property uchar green\nproperty uchar blue\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
        0 0 0 1 1 2 3 255 128 0\n1 0 0 2 0 0 0 1 2 3\n0 1 0 3 -1 0 0.25 0 255 51\n3 0 1 2\n";
    let (mesh, _) = read(text.as_bytes(), Format::Ply, &ReadOptions::default()).unwrap();
    for format in [Format::Glb, Format::Gltf] {
        let (mut again, diagnostics) = read(&written(&mesh, format), format, &ReadOptions::default()).unwrap();
        assert_eq!(diagnostics, []);
        // In the order of the names in the file, colours first, in 32 bits, which bytes survive.
        again.declare_vertex_property("age", vv::mesh::Value::Int(0));
        let (again, _) = read(&written(&again, Format::PlyText), Format::Ply, &ReadOptions::default()).unwrap();
        let sorted = |text: String| {
            let mut lines: Vec<_> = text.lines().map(str::to_owned).collect();
            lines.sort();
            lines
        };
        assert_eq!(sorted(values(&again)), sorted(values(&mesh)));
    }
}
