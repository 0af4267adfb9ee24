//! What a file says it holds.

use super::super::lines::{Lines, integer, show, words};
use super::super::{Place, ReadError, invalid};
use super::{Encoding, Scalar};

/// More kinds of elements, and more properties of one, has no file; each is compared with all before it.
const MOST_ELEMENTS: usize = 1000;
const MOST_PROPERTIES: usize = 1000;

pub(super) struct Header<'a> {
    pub encoding: Encoding,
    pub elements: Vec<Element<'a>>,
    /// The lines after the header.
    pub lines: Lines<'a>,
    /// The bytes after the header, and how many stand before them.
    pub data: &'a [u8],
    pub offset: usize,
}

/// Rows of the same kind.
pub(super) struct Element<'a> {
    pub name: &'a [u8],
    pub count: u64,
    pub properties: Vec<Property<'a>>,
    pub line: u32,
}

pub(super) struct Property<'a> {
    pub name: &'a [u8],
    /// Of lists the type of the length.
    pub length: Option<Scalar>,
    pub scalar: Scalar,
}

impl Element<'_> {
    /// The column of a single number.
    pub(super) fn scalar(&self, name: &[u8]) -> Option<usize> {
        self.properties.iter().position(|p| p.name == name && p.length.is_none())
    }
}

pub(super) fn header(bytes: &[u8]) -> Result<Header<'_>, ReadError> {
    let mut lines = Lines::new(bytes, None);
    let first = lines.next().map(|(_, line)| line).unwrap_or_default();
    if first.trim_ascii() != b"ply" {
        let message = format!("this is no PLY file: it begins with {}, not with ply", show(first));
        return Err(invalid(Place::line(1), message));
    }
    // Programs that end lines by a single CR may begin the data with LF.
    let single_cr = bytes.get(first.len()) == Some(&b'\r') && bytes.get(first.len() + 1) != Some(&b'\n');
    let mut encoding = None;
    let mut elements: Vec<Element<'_>> = Vec::new();
    loop {
        let before = lines.rest();
        let Some((number, line)) = lines.next() else {
            return Err(invalid(None, "the file ends within its header: `end_header` is missing"));
        };
        let place = Place::line(number);
        let wrong = |message: String| Err(invalid(place, message));
        let mut rest = words(line);
        match rest.next().unwrap_or_default() {
            b"" | b"comment" | b"obj_info" => {}
            b"format" => {
                let name = rest.next().unwrap_or_default();
                encoding = Some(match name {
                    b"ascii" => Encoding::Text,
                    b"binary_little_endian" => Encoding::LittleEndian,
                    b"binary_big_endian" => Encoding::BigEndian,
                    _ => return wrong(format!("{} is no format of PLY", show(name))),
                });
            }
            b"element" => {
                let (name, number_of) = (rest.next().unwrap_or_default(), rest.next().unwrap_or_default());
                let Some(count) = integer(number_of) else {
                    return wrong(format!("expected how many there are of {}, found {}", show(name), show(number_of)));
                };
                if elements.len() == MOST_ELEMENTS {
                    return wrong(format!("the file has more than {MOST_ELEMENTS} kinds of elements"));
                }
                if elements.iter().any(|e| e.name == name) {
                    return wrong(format!("the element {} is named twice", show(name)));
                }
                elements.push(Element { name, count, properties: Vec::new(), line: number });
            }
            b"property" => {
                let Some(element) = elements.last_mut() else {
                    return wrong("a property stands before the first element".to_owned());
                };
                let scalar = |name: Option<&[u8]>| {
                    let name = name.unwrap_or_default();
                    Scalar::of_name(name).ok_or_else(|| invalid(place, format!("{} is no type of PLY", show(name))))
                };
                let first = rest.next();
                let (length, scalar) = match first {
                    Some(b"list") => (Some(scalar(rest.next())?), scalar(rest.next())?),
                    _ => (None, scalar(first)?),
                };
                let Some(name) = rest.next() else { return wrong("the property has no name".to_owned()) };
                if element.properties.len() == MOST_PROPERTIES {
                    return wrong(format!("{} has more than {MOST_PROPERTIES} properties", show(element.name)));
                }
                if element.properties.iter().any(|p| p.name == name) {
                    return wrong(format!("the property {} is named twice", show(name)));
                }
                element.properties.push(Property { name, length, scalar });
            }
            b"end_header" => {
                let Some(encoding) = encoding else {
                    return Err(invalid(None, "the header does not say in which format the file is"));
                };
                let data = if single_cr { before.get(line.len() + 1..).unwrap_or_default() } else { lines.rest() };
                let offset = bytes.len() - data.len();
                return Ok(Header { encoding, elements, lines, data, offset });
            }
            word => return wrong(format!("{} is no statement of a PLY header", show(word))),
        }
    }
}
