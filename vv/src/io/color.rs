//! Colours of vertices: the property [`COLOR`], and the conventions of the formats.

use glam::DVec3;

use crate::mesh::{Mesh, Property, Type, Value, Values, Vertex};

/// Name of the vertex property that files keep as colour, and pictures show: a `vec` of red, green and blue from 0 to
/// 1, as on a screen (sRGB).
pub const COLOR: &str = "color";

/// What has no colour where others have one.
const WHITE: DVec3 = DVec3::ONE;

/// Colours as they are read, one vertex after the other.
#[derive(Default)]
pub(super) struct Colors(Vec<Option<DVec3>>);

impl Colors {
    /// The colour of the next vertex, if it has one.
    pub(super) fn push(&mut self, color: Option<DVec3>) {
        self.0.push(color);
    }

    /// The property, if any vertex has a colour. Programs do not agree whether light goes up to 1 or to 255; a file
    /// where something, be it an opacity (`greatest`), is larger than 1 means the latter.
    pub(super) fn property(self, greatest: f64) -> Option<Property> {
        let greatest = self.0.iter().flatten().map(|c| c.max_element()).fold(greatest, f64::max);
        let scale = if greatest > 1.0 { 255.0 } else { 1.0 };
        let any = self.0.iter().any(Option::is_some);
        any.then(|| property(self.0.into_iter().map(|color| color.map_or(WHITE, |c| c / scale)).collect()))
    }
}

pub(super) fn property(colors: Vec<DVec3>) -> Property {
    Property { name: COLOR.to_owned(), default: Value::Vec(WHITE), values: Values::Vec(colors.into()) }
}

/// Which vertex property holds colours, if there is one.
pub(super) fn column(mesh: &Mesh) -> Option<usize> {
    mesh.vertex_properties().iter().position(|p| is_color(&p.name, p.values.ty()))
}

/// Whether a vertex property of this name and type holds colours.
pub(super) fn is_color(name: &str, ty: Type) -> bool {
    name == COLOR && ty == Type::Vec
}

/// The colour of a vertex, each channel from 0 to 1.
pub(super) fn of(mesh: &Mesh, column: usize, v: Vertex) -> DVec3 {
    match mesh.vertex_value(column, v) {
        // What is not a number is dark.
        Some(Value::Vec(color)) => DVec3::from_array(color.to_array().map(|c| c.clamp(0.0, 1.0).max(0.0))),
        _ => WHITE,
    }
}

/// The colour of a vertex in bytes.
pub(super) fn bytes(mesh: &Mesh, column: usize, v: Vertex) -> [u8; 3] {
    of(mesh, column, v).to_array().map(|c| (c * 255.0).round() as u8)
}
