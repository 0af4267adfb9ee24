//! What the program prints: the lines up to the generation shown, or those of them that a filter lets pass.

use eframe::egui::{Label, RichText, ScrollArea, TextEdit, TextStyle, Ui, Vec2b};
use vv::mesh::Vertex;

use super::ring::parts;
use super::widgets::menu_entry;
use crate::command::{Command, Inspect};
use crate::inspect::selection::Item;
use crate::session::Session;

/// Vertices of a line that its menu offers.
const OFFERED: usize = 6;

/// The panel's own state: what is to be seen.
#[derive(Default)]
pub struct Printed {
    /// What a line must contain, large or small; empty lets all pass.
    filter: String,
    passed: Option<Passed>,
}

/// The lines that passed the filter.
struct Passed {
    /// Of what: the filter, the generation, how many lines it had and how many were forgotten.
    of: (String, u64, usize, u64),
    /// Their numbers.
    rows: Vec<usize>,
}

/// All lines as text.
pub fn all(session: &Session, generation: u64) -> String {
    let console = session.console();
    console.lines(generation, 0..console.len(generation)).join("\n")
}

impl Printed {
    /// The filter's field.
    pub fn field(&mut self, ui: &mut Ui) {
        let width = (ui.available_width() - 8.0).clamp(40.0, 110.0);
        let field =
            TextEdit::singleline(&mut self.filter).hint_text(super::widgets::hint("filter")).desired_width(width);
        let field = ui.add(field).on_hover_text("only lines that contain this");
        field.accessible_name("Filter lines");
    }

    /// Whether some lines are left out.
    pub fn is_filtered(&self) -> bool {
        !self.filter.is_empty()
    }

    /// Shows the lines of the generations up to this one.
    pub fn show(&mut self, ui: &mut Ui, session: &Session, generation: u64, commands: &mut Vec<Command>) {
        let height = ui.text_style_height(&TextStyle::Monospace);
        ui.spacing_mut().item_spacing.y = 1.0;
        let (lines, dropped) = {
            let console = session.console();
            (console.len(generation), console.dropped())
        };
        if lines == 0 {
            ui.weak("what the program prints appears here");
            ui.take_available_space(); // the panel keeps its height
            return;
        }
        self.sift(session, (generation, lines, dropped));
        let rows = self.passed.as_ref().map(|passed| passed.rows.clone());
        let count = rows.as_ref().map_or(lines, Vec::len);
        if count == 0 {
            ui.weak(format!("no line contains “{}”", self.filter));
            ui.take_available_space();
            return;
        }
        let area = ScrollArea::both().id_salt("console").auto_shrink(Vec2b::FALSE).stick_to_bottom(true);
        area.show_rows(ui, height, count, |ui, range| {
            if range.start == 0 && dropped > 0 {
                ui.weak(format!("{dropped} earlier lines are forgotten"));
            }
            // Taken out at once, so that the worker waits for no painting.
            let shown: Vec<(usize, String)> = match &rows {
                None => range.clone().zip(session.console().lines(generation, range)).collect(),
                Some(rows) => {
                    let console = session.console();
                    let line = |&row: &usize| Some((row, console.lines(generation, row..row + 1).pop()?));
                    rows[range].iter().filter_map(line).collect()
                }
            };
            for (row, line) in shown {
                let response = ui.add(Label::new(RichText::new(&line).monospace()).extend());
                response.context_menu(|ui| self.menu(ui, session, generation, (row, &line), commands));
            }
        });
    }

    /// Finds the lines that pass, if anything has changed. Cost: linear in what is kept, which is bounded.
    fn sift(&mut self, session: &Session, (generation, lines, dropped): (u64, usize, u64)) {
        if self.filter.is_empty() {
            self.passed = None;
            return;
        }
        let of = (self.filter.to_lowercase(), generation, lines, dropped);
        if self.passed.as_ref().is_some_and(|passed| passed.of == of) {
            return;
        }
        let all = session.console().lines(generation, 0..lines);
        let rows = all.iter().enumerate().filter(|(_, line)| line.to_lowercase().contains(&of.0)).map(|(i, _)| i);
        self.passed = Some(Passed { rows: rows.collect(), of });
    }

    /// What a right click on a line offers.
    fn menu(
        &mut self,
        ui: &mut Ui,
        session: &Session,
        generation: u64,
        (row, line): (usize, &str),
        commands: &mut Vec<Command>,
    ) {
        ui.set_min_width(190.0);
        if menu_entry(ui, true, "Copy line", "this line as text") {
            ui.ctx().copy_text(line.to_owned());
        }
        if menu_entry(ui, true, "Copy all lines", "of all generations up to this one") {
            ui.ctx().copy_text(all(session, generation));
        }
        ui.separator();
        // A line names vertices as they were called when it was printed.
        let printed_in = session.console().generation_of(generation, row).unwrap_or(generation);
        let mut offered: Vec<Vertex> = Vec::new();
        for (name, vertex) in parts(line).into_iter().filter_map(|(name, vertex)| Some((name, vertex?))) {
            let Some(here) = session.shown_vertex(vertex, printed_in) else { continue };
            if offered.len() < OFFERED && !offered.contains(&here) {
                offered.push(here);
                if menu_entry(ui, true, &format!("Fly to {name}"), "select this vertex and bring it close") {
                    commands.push(Command::Inspect(Inspect::Select(Item::Vertex(here))));
                    commands.push(Command::Inspect(Inspect::Fly));
                }
            }
        }
        if !offered.is_empty() {
            ui.separator();
        }
        let kind = kind(line);
        if !kind.is_empty() && menu_entry(ui, true, "Only lines like this", "hide those that do not begin alike") {
            self.filter = kind.to_owned();
        }
        if !self.filter.is_empty() && menu_entry(ui, true, "Show all lines", "without a filter") {
            self.filter.clear();
        }
    }
}

/// What lines of one kind have in common: what stands before the first number or name of a vertex; without that, the
/// whole line.
fn kind(line: &str) -> &str {
    let number = |word: &str| word.trim_start_matches(['v', '-', '(']).starts_with(|c: char| c.is_ascii_digit());
    let mut at = 0;
    for word in line.split_inclusive(char::is_whitespace) {
        if number(word) {
            let before = line[..at].trim();
            return if before.is_empty() { line.trim() } else { before };
        }
        at += word.len();
    }
    line.trim()
}

#[cfg(test)]
mod tests {
    use super::kind;

    #[test]
    fn lines_are_alike_that_differ_in_numbers_and_vertices() {
        for (line, expected) in [
            ("moved v12 by 0.3", "moved"),
            ("  area: -0.25", "area:"),
            ("done", "done"),
            ("12 vertices", "12 vertices"),
            ("at (1, 2, 3)", "at"),
            ("", ""),
        ] {
            assert_eq!(kind(line), expected, "{line:?}");
        }
    }
}
