//! `print`.

use super::{Context, guard, light, status, value_of, value_words};
use crate::engine::text;
use crate::mesh::{Type, Value};

/// Begins a line; an item may call a function that prints lines of its own.
pub(super) extern "C" fn print_begin(context: *mut Context) {
    light(context, (), |run| {
        run.lines.push(String::new());
        Some(())
    });
}

/// Writes a string literal.
pub(super) extern "C" fn print_text(context: *mut Context, index: u32) {
    light(context, (), |run| {
        let text = run.fixed.texts.get(index as usize)?;
        run.lines.last_mut()?.push_str(text);
        Some(())
    });
}

/// The types in the order in which compiled code numbers them.
const TYPES: [Type; 5] = [Type::Bool, Type::Int, Type::Double, Type::Vec, Type::Vertex];

pub(in super::super) fn type_number(ty: Type) -> u32 {
    TYPES.iter().position(|&t| t == ty).unwrap_or(0) as u32
}

/// Writes the value in the words.
pub(super) extern "C" fn print_value(context: *mut Context, ty: u32) {
    light(context, (), |run| {
        let value = value_of(*TYPES.get(ty as usize)?, &value_words(run)[..3]);
        text::push_value(run.lines.last_mut()?, value);
        Some(())
    });
}

/// Writes the members of a set.
pub(super) extern "C" fn print_set(context: *mut Context, set: u32) -> u32 {
    guard(context, status::REPEAT, |run| {
        let line = run.lines.last_mut()?;
        line.push('{');
        for (i, v) in run.sets.get(set as usize)?.members.iter().enumerate() {
            if i % 4096 == 0 && run.fixed.settings.stop.check().is_err() {
                return None;
            }
            line.push_str(if i > 0 { ", " } else { "" });
            text::push_value(line, Value::Vertex(Some(v)));
        }
        line.push('}');
        Some(status::DONE)
    })
}

/// Ends the line.
pub(super) extern "C" fn print_end(context: *mut Context) -> u32 {
    light(context, status::REPEAT, |run| {
        let line = run.lines.pop()?;
        run.printed += line.len() + size_of::<String>();
        if run.printed > run.fixed.settings.limits.max_bytes {
            return None;
        }
        Some(if run.output.print(&line).is_ok() { status::DONE } else { status::CLOSED })
    })
}
