//! Numbers out of buffers, checked at every step: offsets, strides and counts may be anything.

use std::borrow::Cow;

use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use base64::{Engine, alphabet};

use super::super::{ReadError, invalid};
use super::document::{Buffer, Document};
use crate::stop::Stop;

/// How many numbers may be read however small the file: instances take room that the file does not.
const FREE: u64 = 1 << 26;
/// How many more for each byte of the file.
const PER_BYTE: u64 = 8;

/// The buffers of a document, and how much may still be made of them.
pub(super) struct Data<'a> {
    document: &'a Document,
    buffers: Vec<Cow<'a, [u8]>>,
    size: u64,
    left: u64,
    stop: &'a Stop,
}

/// Numbers in rows.
pub(super) struct Rows {
    pub width: usize,
    pub numbers: Vec<f64>,
}

impl Rows {
    pub(super) fn len(&self) -> usize {
        self.numbers.len() / self.width
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &[f64]> {
        self.numbers.chunks_exact(self.width)
    }
}

/// Where numbers stand.
struct Layout {
    component: Component,
    width: usize,
    count: usize,
    normalized: bool,
}

#[derive(Clone, Copy)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn of(number: u32) -> Option<Self> {
        Some(match number {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// `None` if there are too few bytes. Normalized integers stand for −1 … 1 or 0 … 1.
    fn read(self, bytes: &[u8], normalized: bool) -> Option<f64> {
        let (x, greatest) = match self {
            Self::I8 => (f64::from(i8::from_le_bytes(*bytes.first_chunk()?)), 127.0),
            Self::U8 => (f64::from(u8::from_le_bytes(*bytes.first_chunk()?)), 255.0),
            Self::I16 => (f64::from(i16::from_le_bytes(*bytes.first_chunk()?)), 32767.0),
            Self::U16 => (f64::from(u16::from_le_bytes(*bytes.first_chunk()?)), 65535.0),
            Self::U32 => (f64::from(u32::from_le_bytes(*bytes.first_chunk()?)), 4294967295.0),
            Self::F32 => return Some(f64::from(f32::from_le_bytes(*bytes.first_chunk()?))),
        };
        Some(if normalized { (x / greatest).max(-1.0) } else { x })
    }
}

impl<'a> Data<'a> {
    /// The buffers of a file of `size` bytes; `blob` is what stands behind the JSON.
    pub(super) fn new(
        document: &'a Document,
        blob: Option<&'a [u8]>,
        size: usize,
        stop: &'a Stop,
    ) -> Result<Self, ReadError> {
        let buffers = document.buffers.iter().enumerate().map(|(i, b)| buffer(b, i, blob)).collect::<Result<_, _>>()?;
        let size = size as u64;
        Ok(Self { document, buffers, size, left: FREE.saturating_add(PER_BYTE.saturating_mul(size)), stop })
    }

    /// Takes room for so many numbers.
    pub(super) fn take(&mut self, count: u64) -> Result<(), ReadError> {
        self.stop.check()?;
        match self.left.checked_sub(count) {
            Some(left) => self.left = left,
            None => return Err(invalid(None, "the scene is far larger than its file, by instances or shared data")),
        }
        Ok(())
    }

    /// The values of an accessor.
    pub(super) fn read(&mut self, index: usize) -> Result<Rows, ReadError> {
        let wrong = |what: &str| invalid(None, format!("accessor {index}: {what}"));
        let accessor = self.document.accessors.get(index).ok_or_else(|| wrong("there is none"))?;
        let width = match accessor.kind.as_str() {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            _ => return Err(wrong("its type is no scalar and no vector")),
        };
        let component = Component::of(accessor.component_type).ok_or_else(|| wrong("its component type is unknown"))?;
        self.take(accessor.count.saturating_mul(width as u64))?;
        let count = usize::try_from(accessor.count).map_err(|_| wrong("its count is too large"))?;
        let layout = Layout { component, width, count, normalized: accessor.normalized };
        let mut numbers = match accessor.buffer_view {
            Some(view) => self.view(view, accessor.byte_offset, &layout).map_err(|what| wrong(&what))?,
            None if accessor.count > self.size => {
                return Err(wrong("it has no data, but more values than the file bytes"));
            }
            None => vec![0.0; count * width],
        };
        if let Some(sparse) = &accessor.sparse {
            self.take(sparse.count.saturating_mul(width as u64 + 1))?;
            let count = usize::try_from(sparse.count).map_err(|_| wrong("its sparse count is too large"))?;
            let component = Component::of(sparse.indices.component_type);
            let component = component.ok_or_else(|| wrong("the component type of its sparse indices is unknown"))?;
            let indices = Layout { component, width: 1, count, normalized: false };
            let indices = self.view(sparse.indices.buffer_view, sparse.indices.byte_offset, &indices);
            let indices = indices.map_err(|what| wrong(&what))?;
            let values = self.view(sparse.values.buffer_view, sparse.values.byte_offset, &Layout { count, ..layout });
            let values = values.map_err(|what| wrong(&what))?;
            for (&i, value) in indices.iter().zip(values.chunks_exact(width)) {
                let row = whole(i).and_then(|i| numbers.chunks_exact_mut(width).nth(i));
                let row = row.ok_or_else(|| wrong(&format!("{i} is no sparse index of {} values", accessor.count)))?;
                row.copy_from_slice(value);
            }
        }
        Ok(Rows { width, numbers })
    }

    /// The numbers that lie in a view from an offset on.
    fn view(&self, index: usize, offset: u64, layout: &Layout) -> Result<Vec<f64>, String> {
        let &Layout { component, width, count, normalized } = layout;
        let view = self.document.buffer_views.get(index).ok_or_else(|| format!("there is no buffer view {index}"))?;
        let buffer = self.buffers.get(view.buffer).ok_or_else(|| format!("there is no buffer {}", view.buffer))?;
        let outside = || format!("it reaches beyond buffer view {index}");
        let range = |start: u64, len: u64| {
            let end = start.checked_add(len)?;
            Some(usize::try_from(start).ok()?..usize::try_from(end).ok()?)
        };
        let bytes = range(view.byte_offset, view.byte_length).and_then(|range| buffer.get(range));
        let bytes = bytes.ok_or_else(|| format!("buffer view {index} reaches beyond buffer {}", view.buffer))?;
        let bytes = usize::try_from(offset).ok().and_then(|offset| bytes.get(offset..)).ok_or_else(outside)?;
        let size = component.size() * width;
        let stride = view.byte_stride.map_or(Some(size), |stride| usize::try_from(stride).ok()).unwrap_or(0);
        if stride < size {
            return Err(format!("the stride of buffer view {index} is shorter than a value"));
        }
        let mut numbers = Vec::new();
        for row in 0..count {
            let row = row.checked_mul(stride).and_then(|start| bytes.get(start..)).ok_or_else(outside)?;
            for k in 0..width {
                let number = row.get(k * component.size()..).and_then(|bytes| component.read(bytes, normalized));
                numbers.push(number.ok_or_else(outside)?);
            }
        }
        Ok(numbers)
    }
}

/// A number as the index that it is, if it is one.
pub(super) fn whole(x: f64) -> Option<usize> {
    (x >= 0.0 && x == x.trunc() && x < u32::MAX.into()).then_some(x as usize)
}

fn buffer<'a>(buffer: &Buffer, index: usize, blob: Option<&'a [u8]>) -> Result<Cow<'a, [u8]>, ReadError> {
    let Some(uri) = &buffer.uri else {
        return match blob {
            Some(blob) if index == 0 => Ok(Cow::Borrowed(blob)),
            _ => Err(invalid(None, format!("buffer {index} has no data"))),
        };
    };
    let Some(data) = uri.strip_prefix("data:") else {
        let name: String = uri.chars().filter(|c| !c.is_control()).take(80).collect();
        let mut error = invalid(None, format!("buffer {index} lies in another file, `{name}`"));
        if let ReadError::Invalid { diagnostic, .. } = &mut error {
            let hint = "save the scene as .glb, or as .gltf with embedded data";
            **diagnostic = diagnostic.as_ref().clone().hint(hint);
        }
        return Err(error);
    };
    let encoded = data.split_once(";base64,").map(|(_, encoded)| encoded);
    let encoded = encoded.ok_or_else(|| invalid(None, format!("the data of buffer {index} is not in base64")))?;
    let any_padding = GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent);
    let decoded = GeneralPurpose::new(&alphabet::STANDARD, any_padding).decode(encoded);
    decoded
        .map(Cow::Owned)
        .map_err(|why| invalid(None, format!("the data of buffer {index}: {}", lower(&why.to_string()))))
}

/// A foreign sentence as ours begin.
pub(super) fn lower(sentence: &str) -> String {
    let sentence = sentence.trim_end_matches('.');
    let mut letters = sentence.chars();
    match letters.next() {
        Some(first) if !letters.as_str().starts_with(char::is_uppercase) => {
            first.to_lowercase().chain(letters).collect()
        }
        _ => sentence.to_owned(), // an abbreviation
    }
}

#[cfg(test)]
mod tests {
    use super::Component;

    #[test]
    fn normalized_integers_lie_from_minus_one_to_one() {
        let read = |component: Component, bytes: &[u8]| component.read(bytes, true);
        assert_eq!(read(Component::I8, &[0x81]), Some(-1.0));
        assert_eq!(read(Component::I8, &[0x80]), Some(-1.0), "the least of all is no less");
        assert_eq!(read(Component::U16, &[0xff, 0xff]), Some(1.0));
        assert_eq!(read(Component::U16, &[0xff]), None);
    }
}
