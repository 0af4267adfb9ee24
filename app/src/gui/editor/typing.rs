//! Keys that mean more in code: what egui would insert is replaced before it sees the keys.

use std::ops::Range;

use eframe::egui::{Event, Key, Modifiers, Ui};

use super::change::{Change, indent};

/// Tab inserts spaces up to a multiple of `width`, or moves the lines that are selected; Enter keeps the indentation, deepens it after `{`, and
/// makes room between braces; `}` on an empty line takes it back. Returns what cannot be said by other keys.
pub fn take(ui: &Ui, text: &str, selection: &Range<usize>, width: usize) -> Option<Change> {
    let width = width.max(1);
    let before = text.get(..selection.start).unwrap_or_default();
    let line = before.rsplit('\n').next().unwrap_or_default();
    let behind = text.get(selection.end..).unwrap_or_default();
    let several = text.get(selection.clone()).is_some_and(|selected| selected.contains('\n'));
    ui.input_mut(|input| {
        if input.consume_key(Modifiers::SHIFT, Key::Tab) {
            return Some(indent(text, selection, width, false));
        }
        if several && input.consume_key(Modifiers::NONE, Key::Tab) {
            return Some(indent(text, selection, width, true));
        }
        let mut events = Vec::with_capacity(input.events.len());
        for event in input.events.drain(..) {
            match event {
                Event::Key { key: Key::Tab, pressed: true, modifiers, .. } if modifiers.is_none() => {
                    let column = line.chars().count();
                    events.push(Event::Text(" ".repeat(width - column % width)));
                }
                Event::Key { key: Key::Enter, pressed: true, modifiers, .. } if modifiers.is_none() => {
                    new_line(line, behind, width, &mut events);
                }
                Event::Text(ref typed) if typed == "}" && line.len() >= width && line.trim().is_empty() => {
                    for _ in 0..width {
                        events.push(pressed(Key::Backspace));
                    }
                    events.push(event);
                }
                event => events.push(event),
            }
        }
        input.events = events;
        None
    })
}

fn new_line(line: &str, behind: &str, width: usize, events: &mut Vec<Event>) {
    let indentation: String = line.chars().take_while(|c| *c == ' ' || *c == '\t').collect();
    let opens = line.trim_end().ends_with('{');
    let deeper = " ".repeat(if opens { width } else { 0 });
    // A text that is only the end of a line egui leaves to the key.
    let mut line = |indentation: String| {
        events.push(pressed(Key::Enter));
        if !indentation.is_empty() {
            events.push(Event::Text(indentation));
        }
    };
    line(format!("{indentation}{deeper}"));
    if opens && behind.trim_start_matches(' ').starts_with('}') {
        line(indentation.clone());
        for _ in 0..=indentation.chars().count() {
            events.push(pressed(Key::ArrowLeft));
        }
    }
}

fn pressed(key: Key) -> Event {
    Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::NONE }
}
