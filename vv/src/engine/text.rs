//! How values read: what `print` writes and messages show, the same in every engine.

use std::fmt::Write as _;

use crate::mesh::{Ring, Value, Vertex};

/// Entries of a ring that a message shows before it leaves out the rest.
const SHOWN: usize = 24;

/// Appends a value as `print` writes it.
///
/// A double is the shortest decimal that reads back as the same double: `1`, `0.1`, `-0`, with an exponent below 1e-5
/// and from 1e16 on (`1e-7`, `2.5e300`), `inf`, `-inf`, `nan`.
pub(super) fn push_value(line: &mut String, value: Value) {
    // Writing to a String cannot fail.
    let _ = match value {
        Value::Bool(b) => write!(line, "{b}"),
        Value::Int(i) => write!(line, "{i}"),
        Value::Double(x) => push_double(line, x),
        Value::Vec(v) => {
            line.push('(');
            for (i, x) in v.to_array().into_iter().enumerate() {
                line.push_str(if i > 0 { ", " } else { "" });
                let _ = push_double(line, x);
            }
            line.push(')');
            Ok(())
        }
        Value::Vertex(Some(v)) => write!(line, "{v}"),
        Value::Vertex(None) => write!(line, "null"),
    };
}

fn push_double(line: &mut String, x: f64) -> std::fmt::Result {
    let size = x.abs();
    if x.is_nan() {
        line.push_str("nan");
        Ok(())
    } else if size == 0.0 || size.is_infinite() || (1e-5..1e16).contains(&size) {
        write!(line, "{x}")
    } else {
        write!(line, "{x:e}")
    }
}

/// A value as `print` writes it.
pub(super) fn value(value: Value) -> String {
    let mut text = String::new();
    push_value(&mut text, value);
    text
}

/// `v5 v7 ∅`, `empty`. Of a long ring what stands near `x` is shown.
pub(super) fn ring(ring: Ring<'_>, x: Option<Vertex>) -> String {
    let slots = ring.slots();
    if slots.is_empty() {
        return "empty".to_owned();
    }
    let centre = ring.find(x).unwrap_or(0);
    let start = if slots.len() <= SHOWN { 0 } else { centre.saturating_sub(SHOWN / 2).min(slots.len() - SHOWN) };
    let end = (start + SHOWN).min(slots.len());
    let mut text = String::new();
    if start > 0 {
        let _ = write!(text, "… ({start} more) ");
    }
    for (i, slot) in slots[start..end].iter().enumerate() {
        text.push_str(if i > 0 { " " } else { "" });
        match slot {
            Some(v) => {
                let _ = write!(text, "{v}");
            }
            None => text.push('∅'),
        }
    }
    if end < slots.len() {
        let _ = write!(text, " … ({} more)", slots.len() - end);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn doubles_read_back_and_are_short() {
        let check = |x: f64, expected: &str| {
            let got = value(Value::Double(x));
            assert_eq!(got, expected);
            assert!(x.is_nan() || got.parse::<f64>().unwrap().to_bits() == x.to_bits());
        };
        check(1.0, "1");
        check(-0.0, "-0");
        check(0.1, "0.1");
        check(0.1 + 0.2, "0.30000000000000004");
        check(1.0 / 3.0, "0.3333333333333333");
        check(1e15, "1000000000000000");
        check(1e16, "1e16");
        check(1e-5, "0.00001");
        check(1e-6, "1e-6");
        check(f64::MAX, "1.7976931348623157e308");
        check(5e-324, "5e-324");
        check(f64::NEG_INFINITY, "-inf");
        check(f64::NAN, "nan");
    }
}
