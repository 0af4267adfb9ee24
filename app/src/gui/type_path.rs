//! Asks for a path where the system offers no file dialog, with what is in the folder that is typed.

use std::path::PathBuf;
use std::sync::Arc;

use eframe::egui::text::{CCursor, CCursorRange};
use eframe::egui::{Button, EventFilter, Id, Key, Label, RichText, ScrollArea, TextEdit, Ui};

use super::{messages, widgets};
use crate::command::Command;
use crate::session::{PathTrouble, Purpose};
use crate::typed_path::{self, Entry};

/// Rows of the list that are seen at once.
const ROWS: f32 = 6.0;

/// What is known of the folder that is typed.
#[derive(Clone)]
struct Listing {
    folder: PathBuf,
    entries: Arc<[Entry]>,
    /// The pass it was last used in: one that was shown a while ago is read anew.
    used: u64,
    /// Whether the keys have gone to the field, which a dialog does not give them in its first pass.
    has_begun: bool,
    /// The path for which Tab had nothing to complete.
    vain: Option<String>,
}

/// Shows it in a dialog. Returns, when a path was chosen, whether what is there may be replaced.
pub fn show(
    ui: &mut Ui,
    purpose: Purpose,
    path: &mut String,
    trouble: Option<&(String, PathTrouble)>,
    commands: &mut Vec<Command>,
) -> Option<bool> {
    let (title, verb) = match purpose {
        Purpose::OpenProgram => ("Open program", "Open"),
        Purpose::OpenMesh => ("Open mesh", "Open"),
        Purpose::SaveProgram => ("Save program as", "Save"),
        Purpose::ExportMesh => ("Save mesh as", "Save"),
        Purpose::OpenProject => ("Open project", "Open"),
        Purpose::SaveProject => ("Save project as", "Save"),
        Purpose::SavePicture => ("Save picture as", "Save"),
        Purpose::SaveMask => ("Save mask as", "Save"),
        Purpose::OpenStyle => ("Load style", "Load"),
        Purpose::SaveStyle => ("Save style as", "Save"),
    };
    let id = Id::unique("path");
    ui.heading(title);
    ui.add_space(4.0);
    let label = ui.label("This system offers no file dialog; type the path of the file.");
    let listing = listing(ui, path, purpose, id);
    if !listing.has_begun {
        ui.memory_mut(|m| m.request_focus(id));
        // Typing names another file in the same folder.
        select(ui, id, path, path.rfind('/').map_or(0, |slash| slash + 1), path.len());
    }
    let fitting: Vec<&Entry> = typed_path::fitting(&listing.entries, path).collect();
    let completion = typed_path::completion(&fitting, path);
    let tab = ui.memory(|m| m.has_focus(id)) && ui.input(|i| i.modifiers.is_none() && i.key_pressed(Key::Tab));
    // Tab completes; where there is nothing to complete, it says so, and goes on when it is pressed again.
    let vain = listing.vain.as_ref() == Some(path);
    let stays = (completion.is_some() || !vain) && !ui.input(|i| i.modifiers.shift);
    let keys = EventFilter { tab: stays, horizontal_arrows: true, ..EventFilter::default() };
    let field = TextEdit::singleline(path)
        .id(id)
        .hint_text(widgets::hint("path"))
        .desired_width(f32::INFINITY)
        .event_filter(keys);
    let response = ui.add(field).labelled_by(label.id);
    let typed = purpose.with_extension(typed_path::expand(path));
    let named = !path.trim().is_empty() && !path.ends_with('/');
    let replaces = purpose.saves() && typed.exists();
    let name = crate::document::file_name(&typed);
    let (possible, said) = match (named, purpose.saves()) {
        (false, _) => (false, None),
        (true, true) if typed.is_dir() => (false, Some("This is a folder.".to_owned())),
        (true, true) if replaces => (true, Some(format!("{name} exists already."))),
        (true, true) => (true, None),
        (true, false) if typed.is_file() => (true, None),
        (true, false) if !fitting.is_empty() => (false, None),
        (true, false) => (false, Some("There is no such file.".to_owned())),
    };
    let trouble = trouble.filter(|(of, _)| of == path).map(|(_, trouble)| trouble);
    let asked = possible && trouble == Some(&PathTrouble::Exists);
    let (warning, error) = (ui.visuals().warn_fg_color, ui.visuals().error_fg_color);
    let said = match (trouble, said) {
        (Some(PathTrouble::Failed(why)), _) => RichText::new(messages::in_short(why)).color(error),
        (Some(PathTrouble::Exists), Some(said)) if possible => {
            RichText::new(format!("{said} Press Enter again to replace it.")).color(warning).strong()
        }
        (_, Some(said)) if possible => RichText::new(said).color(warning),
        (_, Some(said)) => RichText::new(said).weak(),
        (_, None) => RichText::new(" "),
    };
    let said = match vain && trouble.is_none() && !replaces {
        true => RichText::new(nothing_to_complete(&fitting)).weak(),
        false => said,
    };
    ui.add(Label::new(said).wrap());
    if tab && completion.is_none() && !vain {
        let vain = Some(path.clone());
        ui.data_mut(|data| data.insert_temp(key(purpose), Listing { vain, ..listing.clone() }));
        ui.ctx().request_repaint();
    }
    let mut changed = completion.filter(|_| tab);
    list(ui, &fitting, path, &mut changed);
    ui.add_space(8.0);
    let entered = response.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
    let mut go = false;
    ui.horizontal(|ui| {
        let verb = if replaces && possible { "Replace" } else { verb };
        go = ui.add_enabled_ui(possible, |ui| ui.add(widgets::first_choice(ui, verb))).inner.clicked();
        if ui.button("Cancel").clicked() {
            commands.push(Command::CloseDialog);
        }
    });
    if let Some(changed) = changed {
        *path = changed;
        select(ui, id, path, path.len(), path.len());
        if !response.has_focus() {
            // The keys go to the field again, as at the beginning.
            ui.data_mut(|data| data.insert_temp(key(purpose), Listing { has_begun: false, ..listing.clone() }));
        }
    } else if entered {
        response.request_focus(); // also for what fails: the dialog stays then
    }
    (possible && (go || entered)).then_some(go || asked)
}

fn key(purpose: Purpose) -> Id {
    Id::unique("folder").with(purpose as u8)
}

/// What is in the folder that is typed. Reads a folder once.
fn listing(ui: &Ui, path: &str, purpose: Purpose, field: Id) -> Listing {
    let key = key(purpose);
    let folder = typed_path::folder(path);
    let pass = ui.ctx().cumulative_pass_nr();
    let known = ui.data(|data| data.get_temp::<Listing>(key)).filter(|known| known.used + 2 >= pass);
    let has_begun = known.as_ref().is_some_and(|known| known.has_begun) || ui.memory(|m| m.has_focus(field));
    let vain = known.as_ref().and_then(|known| known.vain.clone()).filter(|vain| vain == path);
    let entries = match known {
        Some(known) if known.folder == folder => known.entries,
        _ => typed_path::entries(&folder, purpose.extensions()),
    };
    let listing = Listing { folder, entries, used: pass, has_begun, vain };
    ui.data_mut(|data| data.insert_temp(key, listing.clone()));
    listing
}

/// What Tab says where it stays.
fn nothing_to_complete(fitting: &[&Entry]) -> &'static str {
    match fitting {
        [] => "Nothing here begins so; Tab again goes on.",
        [_] => "That is all of the name; Tab again goes on.",
        _ => "Several names begin so: type on, or choose one with Tab.",
    }
}

/// What is there that begins as is typed, to be clicked.
fn list(ui: &mut Ui, fitting: &[&Entry], path: &str, changed: &mut Option<String>) {
    ui.add_space(2.0);
    let row = ui.spacing().interact_size.y;
    let height = ROWS * row;
    let area = ScrollArea::vertical().max_height(height).min_scrolled_height(height).auto_shrink(false);
    ui.spacing_mut().item_spacing.y = 0.0;
    area.show_rows(ui, row, fitting.len(), |ui, rows| {
        for entry in fitting.get(rows).unwrap_or_default() {
            let name = RichText::new(entry.shown());
            let name = if entry.is_folder { name } else { name.strong() };
            if ui.add(Button::selectable(false, name).min_size(eframe::egui::vec2(ui.available_width(), row))).clicked()
            {
                *changed = Some(typed_path::join(path, entry));
            }
        }
    });
    ui.spacing_mut().item_spacing.y = 5.0;
    ui.add_space(5.0);
}

/// Bytes of the path.
fn select(ui: &Ui, id: Id, path: &str, start: usize, end: usize) {
    let char_of = |byte: usize| CCursor::new(path.get(..byte).map_or(0, |before| before.chars().count()));
    let mut state = TextEdit::load_state(ui.ctx(), id).unwrap_or_default();
    state.cursor.set_char_range(Some(CCursorRange::two(char_of(start), char_of(end))));
    state.store(ui.ctx(), id);
}
