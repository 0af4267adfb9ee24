//! A mesh to a scene of one primitive.

use base64::Engine;
use serde_json::{Value as Json, json};

use super::super::losses::Of;
use super::super::stl::single;
use super::super::{color, for_each_triangle, is_name, numbering};
use super::{BIN, COLOR, JSON, MAGIC, POSITION, VERSION, to_linear};
use crate::mesh::faces::Faces;
use crate::mesh::{Mesh, Type, Value};

const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
/// What a view is for.
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;

/// In one binary file; `None` beyond 4 GiB.
pub(in super::super) fn write_glb(mesh: &Mesh, faces: &Faces) -> Option<Vec<u8>> {
    let Scene { document, mut data } = Scene::new(mesh, faces, None);
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    data.resize(data.len().next_multiple_of(4), 0);
    let mut out = [MAGIC, &VERSION.to_le_bytes(), &[0; 4]].concat();
    for (kind, chunk) in [(JSON, text), (BIN, data)] {
        if !chunk.is_empty() {
            out.extend(u32::try_from(chunk.len()).ok()?.to_le_bytes());
            out.extend_from_slice(kind);
            out.extend(chunk);
        }
    }
    let length = u32::try_from(out.len()).ok()?;
    out[8..12].copy_from_slice(&length.to_le_bytes());
    Some(out)
}

/// As text.
pub(in super::super) fn write_text(mesh: &Mesh, faces: &Faces) -> Vec<u8> {
    let embed = |data: &[u8]| {
        let encoded = base64::engine::general_purpose::STANDARD.encode(data);
        format!("data:application/octet-stream;base64,{encoded}")
    };
    let Scene { document, .. } = Scene::new(mesh, faces, Some(embed));
    // What consists of strings, numbers and lists can be written.
    let mut text = serde_json::to_vec_pretty(&document).unwrap_or_default();
    text.push(b'\n');
    text
}

struct Scene {
    document: Json,
    data: Vec<u8>,
}

impl Scene {
    fn new(mesh: &Mesh, faces: &Faces, embed: Option<fn(&[u8]) -> String>) -> Self {
        let mut parts = Parts::default();
        let (numbers, members) = numbering(mesh);
        let mut attributes = serde_json::Map::new();
        let mut indices = Vec::new();
        for_each_triangle(mesh, faces, |t| indices.extend(t.map(|v| numbers[v.index()] as u32)));
        if !members.is_empty() {
            let positions: Vec<[f32; 3]> = members.iter().map(|&v| mesh.position(v).to_array().map(single)).collect();
            let least = positions.iter().fold([f32::MAX; 3], |a, b| [0, 1, 2].map(|k| a[k].min(b[k])));
            let greatest = positions.iter().fold([f32::MIN; 3], |a, b| [0, 1, 2].map(|k| a[k].max(b[k])));
            let bounds = json!({ "min": least, "max": greatest });
            attributes.insert(POSITION.to_owned(), parts.add_floats("VEC3", positions.as_flattened(), 3, bounds));
            if let Some(column) = color::column(mesh) {
                let light = |&v| color::of(mesh, column, v).to_array().map(|c| to_linear(c) as f32);
                let colors: Vec<[f32; 3]> = members.iter().map(light).collect();
                attributes.insert(COLOR.to_owned(), parts.add_floats("VEC3", colors.as_flattened(), 3, json!({})));
            }
            for (i, property) in mesh.vertex_properties().iter().enumerate() {
                let Some((kind, width)) = kind(&property.name, property.values.ty()) else { continue };
                let mut values = Vec::new();
                for &v in &members {
                    match mesh.vertex_value(i, v) {
                        Some(Value::Bool(x)) => values.push(f32::from(u8::from(x))),
                        Some(Value::Int(x)) => values.push(x as f32),
                        Some(Value::Double(x)) => values.push(single(x)),
                        Some(Value::Vec(x)) => values.extend(x.to_array().map(single)),
                        Some(Value::Vertex(_)) | None => {}
                    }
                }
                let name = format!("_{}", property.name);
                attributes.insert(name, parts.add_floats(kind, &values, width, json!({})));
            }
        }
        let mut document = json!({ "asset": { "version": "2.0", "generator": "vv" }, "scene": 0, "scenes": [{}] });
        if !indices.is_empty() {
            let count = indices.len();
            let bytes = indices.into_iter().flat_map(u32::to_le_bytes);
            let accessor = json!({ "componentType": UNSIGNED_INT, "type": "SCALAR", "count": count });
            let indices = parts.add(bytes, INDICES, accessor);
            document["scenes"] = json!([{ "nodes": [0] }]);
            document["nodes"] = json!([{ "mesh": 0 }]);
            let primitive = json!({ "attributes": attributes, "indices": indices, "material": 0 });
            document["meshes"] = json!([{ "primitives": [primitive] }]);
            document["materials"] = json!([{ "doubleSided": true, "pbrMetallicRoughness": { "metallicFactor": 0 } }]);
            document["accessors"] = Json::Array(parts.accessors);
            document["bufferViews"] = Json::Array(parts.views);
            let mut buffer = json!({ "byteLength": parts.data.len() });
            if let Some(embed) = embed {
                buffer["uri"] = Json::String(embed(&parts.data));
            }
            document["buffers"] = json!([buffer]);
        } else {
            parts.data.clear(); // a scene without surface has no use for vertices
        }
        Self { document, data: parts.data }
    }
}

/// Whether a property of this name and type is written.
pub(in super::super) fn holds(of: Of, name: &str, ty: Type) -> bool {
    of == Of::Vertices && (color::is_color(name, ty) || kind(name, ty).is_some())
}

/// How a vertex property is kept, and how many numbers that are; `None` for what is kept otherwise or not at all.
fn kind(name: &str, ty: Type) -> Option<(&'static str, usize)> {
    match ty {
        _ if !is_name(name.as_bytes()) || color::is_color(name, ty) => None,
        Type::Bool | Type::Int | Type::Double => Some(("SCALAR", 1)),
        Type::Vec => Some(("VEC3", 3)),
        Type::Vertex => None,
    }
}

/// Data, and how it is divided.
#[derive(Default)]
struct Parts {
    data: Vec<u8>,
    views: Vec<Json>,
    accessors: Vec<Json>,
}

impl Parts {
    fn add_floats(&mut self, kind: &str, numbers: &[f32], width: usize, bounds: Json) -> Json {
        let mut accessor = json!({ "componentType": FLOAT, "type": kind, "count": numbers.len() / width });
        if let (Json::Object(accessor), Json::Object(bounds)) = (&mut accessor, bounds) {
            accessor.extend(bounds);
        }
        self.add(numbers.iter().flat_map(|x| x.to_le_bytes()), VERTICES, accessor)
    }

    /// Returns the number of the accessor.
    fn add(&mut self, bytes: impl Iterator<Item = u8>, target: u32, mut accessor: Json) -> Json {
        let start = self.data.len();
        self.data.extend(bytes);
        let view = json!({
            "buffer": 0, "byteOffset": start, "byteLength": self.data.len() - start, "target": target,
        });
        accessor["bufferView"] = json!(self.views.len());
        self.views.push(view);
        self.accessors.push(accessor);
        json!(self.accessors.len() - 1)
    }
}
