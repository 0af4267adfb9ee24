//! Rows to polygons and named values.

use glam::DVec3;

use super::super::color::Colors;
use super::super::lines::{Words, any_number, integer, show};
use super::super::{Place, ReadError, first_of_each, invalid, is_name, note, warning};
use super::header::{Element, header};
use super::{Encoding, Scalar};
use crate::diagnostic::Diagnostic;
use crate::mesh::build::{EdgeValues, NamedValues, Polygons};
use crate::mesh::{Full, Property, Value, Values};
use crate::stop::Stop;

pub(in super::super) fn read(bytes: &[u8], stop: &Stop) -> Result<(Polygons, Vec<Diagnostic>), ReadError> {
    let header = header(bytes)?;
    let mut source = match header.encoding {
        Encoding::Text => Source::Text(Words::after(header.lines)),
        encoding => Source::Binary { data: header.data, at: 0, offset: header.offset, encoding },
    };
    let vertices = header.elements.iter().find(|e| e.name == b"vertex");
    let Some(vertices) = vertices else { return Err(invalid(None, "the file has no element `vertex`")) };
    for name in ["x", "y", "z"] {
        if vertices.scalar(name.as_bytes()).is_none() {
            return Err(invalid(Place::line(vertices.line), format!("the vertices have no `{name}`")));
        }
    }
    let mut positions = Vec::new();
    let mut values = NamedValues::default();
    let mut faces = FaceRows::default();
    let (mut ignored, mut diagnostics) = (Vec::new(), Vec::new());
    for element in &header.elements {
        match element.name {
            b"vertex" => {
                let mut table = Table::read(&mut source, element, stop)?;
                diagnostics.extend(table.rounding(element));
                positions = table.positions();
                values.vertices.extend(table.colors(element));
                values.vertices.extend(table.properties(&mut ignored));
                diagnostics.extend(first_of_each(&mut values.vertices, &show(element.name)));
            }
            b"face" => faces.read(&mut source, element, vertices.count, stop)?,
            b"tristrips" => faces.read_strips(&mut source, element, vertices.count, stop)?,
            b"edge" => {
                let mut table = Table::read(&mut source, element, stop)?;
                diagnostics.extend(table.rounding(element));
                let ends = table.ends(element, vertices.count)?;
                let mut named = table.properties(&mut ignored);
                diagnostics.extend(first_of_each(&mut named, &show(element.name)));
                let of_edges = |p: Property| EdgeValues { name: p.name, ends: ends.clone(), values: p.values };
                values.edges.extend(named.into_iter().map(of_edges));
            }
            b"mesh" => {
                let table = Table::read(&mut source, element, stop)?;
                diagnostics.extend(table.rounding(element));
                let mut named = table.properties(&mut ignored);
                diagnostics.extend(first_of_each(&mut named, &show(element.name)));
                values.mesh.extend(named.into_iter().filter_map(|p| Some((p.name, p.values.get(0)?))));
            }
            _ => {
                Table::pass(&mut source, element, stop)?;
                if element.count > 0 {
                    ignored.push(show(element.name));
                }
            }
        }
    }
    let mut polygons = Polygons::new(positions);
    polygons.values = values;
    faces.give(&mut polygons, stop)?;
    ignored
        .extend(vertices.properties.iter().filter(|p| is_normal(p.name) || p.length.is_some()).map(|p| show(p.name)));
    if !ignored.is_empty() {
        let more = ignored.len().saturating_sub(MOST_NAMED);
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        ignored.truncate(MOST_NAMED);
        diagnostics.push(note(format!("{}{more} are not read", ignored.join(", "))));
    }
    diagnostics.extend(source.rest());
    Ok((polygons, diagnostics))
}

/// How many of the names that are not read are said.
const MOST_NAMED: usize = 8;

/// Values that follow each other.
enum Source<'a> {
    Text(Words<'a>),
    Binary { data: &'a [u8], at: usize, offset: usize, encoding: Encoding },
}

#[derive(Clone, Copy)]
enum Number {
    Int(i64),
    Double(f64),
    /// A whole number in the text that is none of the doubles.
    Rounded(f64),
}

impl Number {
    fn double(self) -> f64 {
        match self {
            Self::Int(x) => x as f64,
            Self::Double(x) | Self::Rounded(x) => x,
        }
    }

    /// As an integer, which some programs keep as floating-point number.
    fn int(self) -> Option<i64> {
        match self {
            Self::Int(x) => Some(x),
            Self::Double(x) => (x == x.trunc() && x.abs() < 1e15).then_some(x as i64),
            Self::Rounded(_) => None,
        }
    }
}

impl<'a> Source<'a> {
    /// The next value. `None` at the end of the file.
    fn next(&mut self, scalar: Scalar) -> Result<Option<Number>, ReadError> {
        match self {
            Self::Text(words) => {
                let Some(word) = words.next() else { return Ok(None) };
                let number = if scalar.is_integer() {
                    integer(word).map(Number::Int).ok_or_else(|| format!("{} is no integer", show(word)))
                } else {
                    any_number(word).map(|x| if is_rounded(word, x) { Number::Rounded(x) } else { Number::Double(x) })
                };
                number.map(Some).map_err(|why| invalid(words.place(), why))
            }
            Self::Binary { data, at, encoding, .. } => {
                let big = *encoding == Encoding::BigEndian;
                let mut take = || -> Option<Number> {
                    /// The next bytes, turned to the order of this machine.
                    fn bytes<const N: usize>(data: &[u8], at: &mut usize, big: bool) -> Option<[u8; N]> {
                        let mut bytes: [u8; N] = data.get(*at..)?.first_chunk().copied()?;
                        *at += N;
                        if big != cfg!(target_endian = "big") {
                            bytes.reverse();
                        }
                        Some(bytes)
                    }
                    Some(match scalar {
                        Scalar::Int8 => Number::Int(i8::from_ne_bytes(bytes(data, at, big)?).into()),
                        Scalar::Uint8 => Number::Int(u8::from_ne_bytes(bytes(data, at, big)?).into()),
                        Scalar::Int16 => Number::Int(i16::from_ne_bytes(bytes(data, at, big)?).into()),
                        Scalar::Uint16 => Number::Int(u16::from_ne_bytes(bytes(data, at, big)?).into()),
                        Scalar::Int32 => Number::Int(i32::from_ne_bytes(bytes(data, at, big)?).into()),
                        Scalar::Uint32 => Number::Int(u32::from_ne_bytes(bytes(data, at, big)?).into()),
                        Scalar::Float32 => Number::Double(f32::from_ne_bytes(bytes(data, at, big)?).into()),
                        Scalar::Float64 => Number::Double(f64::from_ne_bytes(bytes(data, at, big)?)),
                    })
                };
                Ok(take())
            }
        }
    }

    /// Where the last value stood, or in binary data ended.
    fn place(&self) -> Place {
        match self {
            Self::Text(words) => words.place(),
            Self::Binary { at, offset, .. } => Place::byte(offset + at),
        }
    }

    fn line(&self) -> Option<u32> {
        match self {
            Self::Text(words) => Some(words.line),
            Self::Binary { .. } => None,
        }
    }

    /// A warning if something is left.
    fn rest(&mut self) -> Option<Diagnostic> {
        match self {
            Self::Text(words) => words.next().map(|_| {
                let line = words.line;
                warning(format!("line {line} and what follows is ignored: all announced elements were read"))
            }),
            Self::Binary { data, at, .. } => {
                let rest = data.get(*at..).unwrap_or_default();
                let blank = rest.iter().all(u8::is_ascii_whitespace);
                (!blank).then(|| warning(format!("{} bytes after the last element are ignored", rest.len())))
            }
        }
    }
}

/// Whether a whole number is another one as a double, and not one that is written so.
fn is_rounded(word: &[u8], x: f64) -> bool {
    const EXACT: f64 = (1u64 << 53) as f64;
    x.abs() >= EXACT && integer::<i128>(word).is_some_and(|whole| integer(x.to_string().as_bytes()) != Some(whole))
}

/// The file ends within an element.
fn ends(source: &Source<'_>, element: &Element<'_>, rows: u64) -> ReadError {
    let message = format!("the file ends after {rows} of {} rows of {}", element.count, show(element.name));
    invalid(source.place(), message)
}

fn is_normal(name: &[u8]) -> bool {
    matches!(name, b"nx" | b"ny" | b"nz")
}

/// The columns of single numbers of an element; lists are passed over, as are normals.
struct Table<'a> {
    columns: Vec<(&'a [u8], Column)>,
    /// Of which whole numbers were rounded.
    rounded: Vec<&'a [u8]>,
}

enum Column {
    Ints(Vec<i64>),
    Doubles(Vec<f64>),
}

impl Column {
    fn doubles(self) -> Vec<f64> {
        match self {
            Self::Ints(column) => column.into_iter().map(|x| x as f64).collect(),
            Self::Doubles(column) => column,
        }
    }
}

impl<'a> Table<'a> {
    fn read(source: &mut Source<'_>, element: &Element<'a>, stop: &Stop) -> Result<Self, ReadError> {
        let (mut columns, mut rounded) = (Vec::new(), Vec::new());
        let places: Vec<Option<usize>> = element
            .properties
            .iter()
            .map(|p| {
                let wanted = p.length.is_none() && !is_normal(p.name);
                wanted.then(|| {
                    let column =
                        if p.scalar.is_integer() { Column::Ints(Vec::new()) } else { Column::Doubles(Vec::new()) };
                    columns.push((p.name, column));
                    columns.len() - 1
                })
            })
            .collect();
        rows(source, element, stop, |source, row, property, number| {
            let Some(place) = places[property] else { return Ok(()) };
            let (name, column) = &mut columns[place];
            if matches!(number, Number::Rounded(_)) && !rounded.contains(name) {
                rounded.push(name);
            }
            match (column, number) {
                (Column::Ints(column), Number::Int(x)) => column.push(x),
                (Column::Doubles(column), number) => column.push(number.double()),
                (Column::Ints(_), _) => {} // integers are read as such
            }
            let is_coordinate = matches!(element.properties[property].name, b"x" | b"y" | b"z");
            if is_coordinate && element.name == b"vertex" && !number.double().is_finite() {
                let message = format!("vertex {row}: a coordinate is not finite");
                return Err(invalid(source.place(), message));
            }
            Ok(())
        })?;
        Ok(Self { columns, rounded })
    }

    /// Reads the rows and keeps nothing.
    fn pass(source: &mut Source<'_>, element: &Element<'_>, stop: &Stop) -> Result<(), ReadError> {
        rows(source, element, stop, |_, _, _, _| Ok(()))
    }

    fn take(&mut self, name: &[u8]) -> Option<Column> {
        let i = self.columns.iter().position(|(n, _)| *n == name)?;
        Some(self.columns.remove(i).1)
    }

    /// A warning if not every number is what the file says.
    fn rounding(&self, element: &Element<'_>) -> Option<Diagnostic> {
        let names: Vec<_> = self.rounded.iter().take(MOST_NAMED).map(|name| show(name)).collect();
        let (names, element) = (names.join(", "), show(element.name));
        let message = format!("whole numbers of {names} of {element} are rounded: a double keeps those up to 2^53");
        (!self.rounded.is_empty()).then(|| warning(message))
    }

    fn positions(&mut self) -> Vec<DVec3> {
        let [x, y, z] = ["x", "y", "z"].map(|name| self.take(name.as_bytes()).map(Column::doubles).unwrap_or_default());
        vectors(&x, &y, &z)
    }

    fn colors(&mut self, element: &Element<'_>) -> Option<Property> {
        let prefix = ["", "diffuse_"].into_iter().find(|prefix| {
            ["red", "green", "blue"].iter().all(|name| element.scalar(format!("{prefix}{name}").as_bytes()).is_some())
        })?;
        let names = ["red", "green", "blue"].map(|name| format!("{prefix}{name}"));
        let scale = match element.scalar(names[0].as_bytes()).map(|i| element.properties[i].scalar) {
            Some(Scalar::Uint8) => Some(255.0),
            Some(Scalar::Uint16) => Some(65535.0),
            _ => None,
        };
        let [r, g, b] = names.map(|name| self.take(name.as_bytes()).map(Column::doubles).unwrap_or_default());
        let mut colors = Colors::default();
        vectors(&r, &g, &b).into_iter().for_each(|color| colors.push(Some(color / scale.unwrap_or(1.0))));
        colors.property(0.0)
    }

    fn ends(&mut self, element: &Element<'_>, vertex_count: u64) -> Result<Vec<[u32; 2]>, ReadError> {
        let mut end = |name: &str| {
            let wrong = |message: String| invalid(Place::line(element.line), message);
            let Some(Column::Ints(column)) = self.take(name.as_bytes()) else {
                return Err(wrong(format!("the edges have no integer `{name}`")));
            };
            let there = |&x: &i64| u32::try_from(x).ok().filter(|&x| u64::from(x) < vertex_count);
            let ends: Result<Vec<u32>, i64> = column.iter().map(|x| there(x).ok_or(*x)).collect();
            ends.map_err(|x| wrong(format!("an edge ends at vertex {x}, but {}", range(vertex_count))))
        };
        let (first, second) = (end("vertex1")?, end("vertex2")?);
        Ok(first.into_iter().zip(second).map(|(a, b)| [a, b]).collect())
    }

    /// What is left, with vectors put together from their coordinates; names that no program can say go to `ignored`.
    fn properties(self, ignored: &mut Vec<String>) -> Vec<Property> {
        let Self { mut columns, .. } = self;
        let mut properties = Vec::new();
        while !columns.is_empty() {
            let (name, column) = columns.remove(0);
            if !is_name(name) {
                ignored.push(show(name));
                continue;
            }
            let name = String::from_utf8_lossy(name).into_owned();
            let part = |axis: &str| {
                let name = format!("{}{axis}", name.strip_suffix("_x")?);
                let is_part = |(n, c): &(&[u8], Column)| *n == name.as_bytes() && matches!(c, Column::Doubles(_));
                columns.iter().position(is_part)
            };
            let values = match (column, part("_y"), part("_z")) {
                (Column::Doubles(x), Some(y), Some(z)) => {
                    let (first, second) = (y.min(z), y.max(z));
                    let (late, early) = (columns.remove(second).1.doubles(), columns.remove(first).1.doubles());
                    let (y, z) = if y < z { (early, late) } else { (late, early) };
                    Values::Vec(vectors(&x, &y, &z).into())
                }
                (Column::Doubles(column), ..) => Values::Double(column.into()),
                (Column::Ints(column), ..) => Values::Int(column.into()),
            };
            let name = match &values {
                Values::Vec(_) => name.strip_suffix("_x").unwrap_or(&name).to_owned(),
                _ => name,
            };
            properties.push(Property { name, default: Value::zero(values.ty()), values });
        }
        properties
    }
}

fn vectors(x: &[f64], y: &[f64], z: &[f64]) -> Vec<DVec3> {
    x.iter().zip(y).zip(z).map(|((&x, &y), &z)| DVec3::new(x, y, z)).collect()
}

/// `they go from 0 to 7`.
fn range(vertex_count: u64) -> String {
    vertex_count.checked_sub(1).map_or("there is none".to_owned(), |last| format!("they go from 0 to {last}"))
}

/// Reads the rows of an element: each number comes with its row, from 1, and its property; those of lists do not come.
fn rows<'a>(
    source: &mut Source<'a>,
    element: &Element<'_>,
    stop: &Stop,
    mut each: impl FnMut(&Source<'a>, u64, usize, Number) -> Result<(), ReadError>,
) -> Result<(), ReadError> {
    if element.properties.is_empty() {
        return Ok(()); // however many there are
    }
    for row in 0..element.count {
        stop.check()?;
        for (i, property) in element.properties.iter().enumerate() {
            let Some(length) = property.length else {
                let number = source.next(property.scalar)?.ok_or_else(|| ends(source, element, row))?;
                each(source, row + 1, i, number)?;
                continue;
            };
            list(source, element, row, (length, property.scalar), stop, |_, _| Ok(()))?;
        }
    }
    Ok(())
}

/// Reads a list.
fn list<'a>(
    source: &mut Source<'a>,
    element: &Element<'_>,
    row: u64,
    (length, scalar): (Scalar, Scalar),
    stop: &Stop,
    mut each: impl FnMut(&Source<'a>, Number) -> Result<(), ReadError>,
) -> Result<(), ReadError> {
    let Some(length) = source.next(length)? else { return Err(ends(source, element, row)) };
    let Some(length) = length.int().and_then(|length| u64::try_from(length).ok()) else {
        let message =
            format!("row {} of {}: the length of a list is negative or no integer", row + 1, show(element.name));
        return Err(invalid(source.place(), message));
    };
    for i in 0..length {
        if i % 4096 == 0 {
            stop.check()?;
        }
        let number = source.next(scalar)?.ok_or_else(|| ends(source, element, row))?;
        each(source, number)?;
    }
    Ok(())
}

/// Faces, which may stand before the vertices they name.
#[derive(Default)]
struct FaceRows {
    corners: Vec<u32>,
    ends: Vec<usize>,
    lines: Vec<u32>,
}

impl FaceRows {
    fn read(
        &mut self,
        source: &mut Source<'_>,
        element: &Element<'_>,
        vertex_count: u64,
        stop: &Stop,
    ) -> Result<(), ReadError> {
        let Self { corners, ends, lines } = self;
        each_list(source, element, stop, |source, row, numbers| {
            for &(number, place) in numbers {
                corners.push(corner(number, &format!("face {row}"), place, vertex_count)?);
            }
            ends.push(corners.len());
            lines.extend(source.line());
            Ok(())
        })
    }

    /// Strips of triangles, each corner but the first two making one, every other the other way round; −1 begins anew.
    fn read_strips(
        &mut self,
        source: &mut Source<'_>,
        element: &Element<'_>,
        vertex_count: u64,
        stop: &Stop,
    ) -> Result<(), ReadError> {
        let Self { corners, ends, lines } = self;
        each_list(source, element, stop, |source, row, numbers| {
            let (mut before, mut turned) = ([None; 2], false);
            for &(number, place) in numbers {
                if number.int() == Some(-1) {
                    (before, turned) = ([None; 2], false);
                    continue;
                }
                let c = corner(number, &format!("strip {row}"), place, vertex_count)?;
                if let [Some(a), Some(b)] = before {
                    corners.extend(if turned { [b, a, c] } else { [a, b, c] });
                    ends.push(corners.len());
                    lines.extend(source.line());
                    turned = !turned;
                }
                before = [before[1], Some(c)];
            }
            Ok(())
        })
    }

    fn give(&self, polygons: &mut Polygons, stop: &Stop) -> Result<(), ReadError> {
        let mut start = 0;
        for (f, &end) in self.ends.iter().enumerate() {
            stop.check()?;
            let line = self.lines.get(f).copied();
            let full = |_| invalid(line.map(Place::line), Full.to_string());
            polygons.push(self.corners[start..end].iter().copied(), line).map_err(full)?;
            start = end;
        }
        Ok(())
    }
}

/// The list of corners in each row, with the places of the numbers.
fn each_list<'a>(
    source: &mut Source<'a>,
    element: &Element<'_>,
    stop: &Stop,
    mut each: impl FnMut(&Source<'a>, u64, &[(Number, Place)]) -> Result<(), ReadError>,
) -> Result<(), ReadError> {
    let is_corners = |name: &[u8]| matches!(name, b"vertex_indices" | b"vertex_index");
    if element.count > 0 && !element.properties.iter().any(|p| p.length.is_some() && is_corners(p.name)) {
        let message = format!("{} has no list `vertex_indices`", show(element.name));
        return Err(invalid(Place::line(element.line), message));
    }
    let mut numbers = Vec::new();
    for row in 0..element.count {
        stop.check()?;
        for property in &element.properties {
            let Some(length) = property.length else {
                source.next(property.scalar)?.ok_or_else(|| ends(source, element, row))?;
                continue;
            };
            let wanted = is_corners(property.name);
            if wanted {
                numbers.clear();
            }
            list(source, element, row, (length, property.scalar), stop, |source, number| {
                if wanted {
                    numbers.push((number, source.place()));
                }
                Ok(())
            })?;
            if wanted {
                each(source, row + 1, &numbers)?;
            }
        }
    }
    Ok(())
}

fn corner(number: Number, what: &str, place: Place, vertex_count: u64) -> Result<u32, ReadError> {
    let v = number.int().and_then(|v| u32::try_from(v).ok()).filter(|&v| u64::from(v) < vertex_count);
    v.ok_or_else(|| {
        let said = match number {
            Number::Int(v) => v.to_string(),
            Number::Double(v) | Number::Rounded(v) => v.to_string(),
        };
        invalid(place, format!("{what} has a corner at vertex {said}, but {}", range(vertex_count)))
    })
}
