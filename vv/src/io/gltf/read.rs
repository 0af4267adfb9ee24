//! A scene to polygons and named values.

use std::collections::BTreeMap;

use glam::{DMat4, DQuat, DVec3};

use super::super::color::Colors;
use super::super::weld::weld;
use super::super::{Place, ReadError, first_of_each, invalid, is_name, note, warning};
use super::accessor::{Data, Rows, lower, whole};
use super::document::{Document, Node, Primitive};
use super::{BIN, COLOR, JSON, MAGIC, POSITION, VERSION, is_glb, to_srgb};
use crate::diagnostic::Diagnostic;
use crate::mesh::build::Polygons;
use crate::mesh::{Full, Property, Value, Values};
use crate::stop::Stop;

/// Extensions that change nothing here.
const HARMLESS: [&str; 2] = ["KHR_mesh_quantization", "KHR_materials_unlit"];

pub(in super::super) fn read(bytes: &[u8], stop: &Stop) -> Result<(Polygons, Vec<Diagnostic>), ReadError> {
    let (json, blob) = if is_glb(bytes) { chunks(bytes)? } else { (bytes, None) };
    let json = json.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(json);
    let document: Document = serde_json::from_slice(json).map_err(|error| {
        let message = error.to_string();
        let message = message.split(" at line ").next().unwrap_or_default();
        let line = u32::try_from(error.line()).ok().filter(|&line| line > 0 && !is_glb(bytes));
        let column = u32::try_from(error.column()).ok().filter(|&column| column > 0);
        invalid(line.map(|line| Place::Text { line, column }), format!("this is no glTF: {}", lower(message)))
    })?;
    if !document.asset.version.starts_with("2.") {
        let version: String = document.asset.version.chars().take(20).collect();
        return Err(invalid(None, format!("this is glTF of version `{version}`, and vv reads 2.0")));
    }
    if let Some(extension) = document.extensions_required.iter().find(|name| !HARMLESS.contains(&name.as_str())) {
        let extension: String = extension.chars().filter(|c| !c.is_control()).take(80).collect();
        return Err(invalid(None, format!("the scene takes the extension `{extension}`, which vv does not know")));
    }
    let mut scene = Scene::new(Data::new(&document, blob, bytes.len(), stop)?);
    for (mesh, placed) in placed(&document)? {
        let Some(mesh) = document.meshes.get(mesh) else {
            return Err(invalid(None, format!("there is no mesh {mesh}")));
        };
        mesh.primitives.iter().try_for_each(|primitive| scene.add(primitive, placed))?;
    }
    scene.ignored |= document.materials.iter().any(|m| m.pbr_metallic_roughness.base_color_factor.is_some())
        || !(document.textures.is_empty() && document.skins.is_empty() && document.animations.is_empty());
    scene.finish(stop)
}

/// The JSON of a container, and the binary data behind it.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), ReadError> {
    const HEADER: usize = 12;
    let word = |at: usize| bytes.get(at..)?.first_chunk().map(|&word| u32::from_le_bytes(word));
    match word(MAGIC.len()) {
        Some(VERSION) => {}
        Some(version) => {
            return Err(invalid(Place::byte(MAGIC.len()), format!("this is GLB of version {version}, and vv reads 2")));
        }
        None => return Err(invalid(Place::byte(bytes.len()), "the file ends within its header")),
    }
    let (mut json, mut blob) = (None, None);
    let mut at = HEADER;
    while let Some(len) = word(at) {
        let kind = bytes.get(at + 4..at + 8).unwrap_or_default();
        let start = at + 8;
        let data = start.checked_add(len as usize).and_then(|end| bytes.get(start..end));
        let data = data.ok_or_else(|| invalid(Place::byte(at), "a chunk reaches beyond the end of the file"))?;
        match kind {
            JSON if json.is_none() => json = Some(data),
            BIN if blob.is_none() => blob = Some(data),
            _ => {} // of an extension
        }
        at = start + data.len();
    }
    json.map(|json| (json, blob))
        .ok_or_else(|| invalid(Place::byte(HEADER.min(bytes.len())), "the file has no chunk of JSON"))
}

/// The meshes of the scene with the transformations of their nodes.
fn placed(document: &Document) -> Result<Vec<(usize, DMat4)>, ReadError> {
    let nodes = &document.nodes;
    if nodes.is_empty() {
        return Ok((0..document.meshes.len()).map(|mesh| (mesh, DMat4::IDENTITY)).collect());
    }
    let roots: Vec<usize> = match document.scenes.get(document.scene.unwrap_or(0)) {
        Some(scene) => scene.nodes.clone(),
        None => {
            let mut is_child = vec![false; nodes.len()];
            for &child in nodes.iter().flat_map(|node| &node.children) {
                if let Some(is_child) = is_child.get_mut(child) {
                    *is_child = true;
                }
            }
            (0..nodes.len()).filter(|&node| !is_child[node]).collect()
        }
    };
    let mut met = vec![false; nodes.len()];
    let mut meshes = Vec::new();
    let mut open: Vec<(usize, DMat4)> = roots.into_iter().rev().map(|root| (root, DMat4::IDENTITY)).collect();
    while let Some((index, parent)) = open.pop() {
        let Some(node) = nodes.get(index) else { return Err(invalid(None, format!("there is no node {index}"))) };
        if std::mem::replace(&mut met[index], true) {
            return Err(invalid(None, format!("node {index} stands in the scene twice")));
        }
        let here = parent * transformation(node);
        meshes.extend(node.mesh.map(|mesh| (mesh, here)));
        open.extend(node.children.iter().rev().map(|&child| (child, here)));
    }
    Ok(meshes)
}

fn transformation(node: &Node) -> DMat4 {
    if let Some(matrix) = &node.matrix {
        return DMat4::from_cols_array(matrix);
    }
    let scale = node.scale.map_or(DVec3::ONE, DVec3::from_array);
    let rotation = node.rotation.map_or(DQuat::IDENTITY, DQuat::from_array);
    DMat4::from_scale_rotation_translation(scale, rotation, node.translation.map_or(DVec3::ZERO, DVec3::from_array))
}

/// What was read of the scene.
struct Scene<'a> {
    data: Data<'a>,
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    colors: Vec<Option<DVec3>>,
    /// Other values by name, in rows; behind the last there are zeros.
    values: BTreeMap<String, Rows>,
    /// How many primitives are no surface.
    lines: usize,
    ignored: bool,
}

impl<'a> Scene<'a> {
    fn new(data: Data<'a>) -> Self {
        Self {
            data,
            points: Vec::new(),
            triangles: Vec::new(),
            colors: Vec::new(),
            values: BTreeMap::new(),
            lines: 0,
            ignored: false,
        }
    }

    fn add(&mut self, primitive: &Primitive, placed: DMat4) -> Result<(), ReadError> {
        let mode = primitive.mode.unwrap_or(TRIANGLES);
        if !matches!(mode, TRIANGLES | STRIP | FAN) {
            self.lines += 1;
            return Ok(());
        }
        let Some(&position) = primitive.attributes.get(POSITION) else { return Ok(()) };
        let positions = self.data.read(position)?;
        if positions.width != 3 {
            return Err(invalid(None, format!("accessor {position}: positions have three coordinates")));
        }
        let base = self.points.len();
        let count = positions.len();
        for p in positions.iter() {
            let p = placed.transform_point3(DVec3::from_slice(p));
            if !p.is_finite() {
                return Err(invalid(None, format!("accessor {position}: a position is not finite")));
            }
            self.points.push(p);
        }
        self.colors.resize(base, None);
        for (name, &accessor) in &primitive.attributes {
            match name.strip_prefix('_') {
                _ if name == POSITION => {}
                _ if name == COLOR => self.add_colors(accessor, count)?,
                Some(name) if is_name(name.as_bytes()) => self.add_values(name, accessor, base, count)?,
                _ => self.ignored = true,
            }
        }
        self.colors.resize(self.points.len(), None);
        self.add_triangles(primitive, mode, base, count, placed.determinant() < 0.0)
    }

    fn add_colors(&mut self, accessor: usize, count: usize) -> Result<(), ReadError> {
        let colors = self.data.read(accessor)?;
        if colors.width >= 3 {
            let color = |c: &[f64]| Some(DVec3::new(to_srgb(c[0]), to_srgb(c[1]), to_srgb(c[2])));
            self.colors.extend(colors.iter().take(count).map(color));
        }
        Ok(())
    }

    fn add_values(&mut self, name: &str, accessor: usize, base: usize, count: usize) -> Result<(), ReadError> {
        let rows = self.data.read(accessor)?;
        let width = self.values.get(name).map_or(rows.width, |known| known.width);
        if rows.width != width || !matches!(width, 1 | 3) {
            self.ignored = true; // no type of the language
            return Ok(());
        }
        let known = self.values.entry(name.to_owned()).or_insert(Rows { width, numbers: Vec::new() });
        self.data.take((base * width).saturating_sub(known.numbers.len()) as u64)?;
        known.numbers.resize(base * width, 0.0);
        known.numbers.extend(rows.numbers.iter().take(count * width));
        Ok(())
    }

    fn add_triangles(
        &mut self,
        primitive: &Primitive,
        mode: u32,
        base: usize,
        count: usize,
        mirrored: bool,
    ) -> Result<(), ReadError> {
        let full = || invalid(None, Full.to_string());
        u32::try_from(self.points.len()).map_err(|_| full())?;
        let corners: Vec<u32> = match primitive.indices {
            Some(accessor) => {
                let indices = self.data.read(accessor)?;
                let corner = |&i: &f64| {
                    let message = || format!("accessor {accessor}: {i} is no index of {count} vertices");
                    let corner = whole(i).filter(|&i| i < count).map(|i| (base + i) as u32);
                    corner.ok_or_else(|| invalid(None, message()))
                };
                indices.numbers.iter().map(corner).collect::<Result<_, _>>()?
            }
            None => (base as u32..(base + count) as u32).collect(),
        };
        let turn = |t: [u32; 3], turned: bool| if turned { [t[1], t[0], t[2]] } else { t };
        match mode {
            STRIP => {
                let strip = corners.windows(3).enumerate();
                self.triangles.extend(strip.map(|(i, t)| turn([t[0], t[1], t[2]], (i % 2 == 1) != mirrored)));
            }
            FAN => {
                let fan = corners.windows(2).skip(1);
                self.triangles.extend(fan.map(|t| turn([corners[0], t[0], t[1]], mirrored)));
            }
            _ => self.triangles.extend(corners.as_chunks::<3>().0.iter().map(|&t| turn(t, mirrored))),
        }
        Ok(())
    }

    fn finish(mut self, stop: &Stop) -> Result<(Polygons, Vec<Diagnostic>), ReadError> {
        let n = self.points.len();
        let welded = weld(&self.points, stop)?;
        let mut diagnostics = Vec::new();
        if welded.first.len() < n {
            diagnostics.push(welded.diagnostic("vertices"));
        }
        if self.lines > 0 {
            let are = if self.lines == 1 { "1 set of points or lines is" } else { "sets of points or lines are" };
            let many = if self.lines == 1 { String::new() } else { format!("{} ", self.lines) };
            diagnostics.push(warning(format!("{many}{are} not read")));
        }
        if self.ignored {
            diagnostics.push(note("normals, texture coordinates, materials, skins and animations are not read"));
        }
        let mut polygons = Polygons::new(welded.first.iter().map(|&i| self.points[i as usize]).collect());
        for &t in &self.triangles {
            stop.check()?;
            let corners = t.map(|corner| welded.of[corner as usize]);
            polygons.push(corners, None).map_err(|_| invalid(None, Full.to_string()))?;
        }
        let mut colors = Colors::default();
        welded.first.iter().for_each(|&i| colors.push(self.colors[i as usize]));
        polygons.values.vertices.extend(colors.property(0.0));
        let names = self.values.len() as u64;
        self.data.take(names.saturating_mul(welded.first.len() as u64))?;
        for (name, rows) in self.values {
            let at = |i: u32, k: usize| rows.numbers.get(i as usize * rows.width + k).copied().unwrap_or(0.0);
            let of = welded.first.iter();
            let values = match rows.width {
                1 => Values::Double(of.map(|&i| at(i, 0)).collect::<Vec<_>>().into()),
                _ => Values::Vec(of.map(|&i| DVec3::new(at(i, 0), at(i, 1), at(i, 2))).collect::<Vec<_>>().into()),
            };
            polygons.values.vertices.push(Property { name, default: Value::zero(values.ty()), values });
        }
        diagnostics.extend(first_of_each(&mut polygons.values.vertices, "the scene"));
        Ok((polygons, diagnostics))
    }
}

/// What the corners of a primitive make.
const TRIANGLES: u32 = 4;
const STRIP: u32 = 5;
const FAN: u32 = 6;
