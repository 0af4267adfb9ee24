//! The manual of the language, beside the work.
//!
//! Shows the part of Markdown that the manual uses: headings, paragraphs, lists, tables and blocks of code, with `code`,
//! **strong** and *emphasised* words.

mod finding;

use std::sync::LazyLock;

use eframe::egui::text::LayoutJob;
use eframe::egui::{
    Align, Color32, Context, Event, EventFilter, FontFamily, FontId, Frame, Id, Key, Layout, Margin, Modifiers,
    RichText, ScrollArea, Stroke, TextEdit, TextFormat, TextStyle, Ui, Window, vec2,
};

use super::editor::color;
use super::widgets::hint;
use crate::command::Command;
use finding::Finding;

const MANUAL: &str = include_str!("../../../vv/README.md");

/// What a page is made of.
#[derive(Debug, PartialEq, Eq)]
enum Block {
    Paragraph(String),
    Item(String),
    Table(Vec<Vec<String>>),
    Code(String),
    Output(String),
}

/// What stands under a heading.
#[derive(Debug, PartialEq, Eq)]
struct Section {
    title: String,
    blocks: Vec<Block>,
}

static SECTIONS: LazyLock<Vec<Section>> = LazyLock::new(|| read(MANUAL));

/// The window's own state.
#[derive(Default)]
pub struct Reference {
    query: String,
    /// When it was shown last.
    shown: u64,
    /// The section to bring in sight.
    wanted: Option<usize>,
    /// Whether Escape has left its field, and nothing was done since.
    left: bool,
    finding: Finding,
}

impl Reference {
    /// Whether Escape closes it: pressed twice, first for its field.
    pub fn takes_escape(&mut self, ctx: &Context) -> bool {
        let other = |event: &Event| match event {
            Event::Key { key, pressed, .. } => *pressed && *key != Key::Escape,
            Event::PointerButton { pressed, .. } => *pressed,
            _ => false,
        };
        self.left &= !ctx.input(|i| i.events.iter().any(other));
        self.left
    }

    /// Shows it.
    pub fn show(&mut self, ctx: &Context, commands: &mut Vec<Command>) {
        let room = ctx.content_rect();
        let size = vec2(640.0_f32.min(room.width() - 40.0), (room.height() - 120.0).max(200.0));
        let mut open = true;
        Window::new("Language reference")
            .id(Id::unique("reference"))
            .open(&mut open)
            .default_size(size)
            .default_pos(room.right_top() + vec2(-size.x - 40.0, 70.0))
            .min_width(360.0_f32.min(size.x))
            .max_width(760.0_f32.min(room.width() - 40.0))
            .collapsible(true)
            .resizable(true)
            .constrain(true)
            .show(ctx, |ui| self.content(ui));
        let escaped = self.left && ctx.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape));
        if !open || escaped {
            commands.push(Command::Reference);
        }
    }

    fn content(&mut self, ui: &mut Ui) {
        ui.set_max_width(ui.available_width().min(760.0));
        let query = self.query.trim().to_lowercase();
        let fits = |section: &Section| query.is_empty() || section.text().to_lowercase().contains(&query);
        let count = self.finding.count();
        let field = ui
            .horizontal(|ui| {
                let room = if count.is_some() { 70.0 } else { 0.0 };
                let wide = ui.available_width() - room;
                let keys = EventFilter { horizontal_arrows: true, escape: true, ..EventFilter::default() };
                let field = TextEdit::singleline(&mut self.query).hint_text(hint("find")).desired_width(wide);
                let field = ui.add(field.event_filter(keys));
                if let Some(count) = count {
                    let tip = "Enter goes to the next place, Shift+Enter to the one before";
                    ui.label(RichText::new(count).small().weak()).on_hover_text(tip);
                }
                field
            })
            .inner;
        if field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter)) {
            self.finding.step(ui.input(|i| i.modifiers.shift));
            field.request_focus();
        }
        if field.has_focus() && ui.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape)) {
            field.surrender_focus();
            self.left = true;
        }
        // Who has opened it looks for something; what is typed is not meant for the program any more.
        let pass = ui.ctx().cumulative_pass_nr();
        if pass > self.shown + 1 {
            field.request_focus();
        }
        self.shown = pass;
        field.accessible_name("Find in the reference");
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = vec2(14.0, 3.0);
            // The first line as high as the others.
            ui.spacing_mut().interact_size.y = 0.0;
            for (i, section) in SECTIONS.iter().enumerate().filter(|(_, s)| fits(s)) {
                // A name of two words is not broken.
                if ui.link(section.title.replace(' ', "\u{a0}")).accessible_name(&section.title).clicked() {
                    self.wanted = Some(i);
                }
            }
        });
        ui.separator();
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 7.0;
            let mut found = false;
            self.finding.begin(&query);
            for (i, section) in SECTIONS.iter().enumerate().filter(|(_, s)| fits(s)) {
                found = true;
                ui.add_space(6.0);
                let color = ui.visuals().strong_text_color();
                let title = TextFormat::simple(TextStyle::Heading.resolve(ui.style()), color);
                let heading = self.finding.label(ui, LayoutJob::single_section(section.title.clone(), title));
                if self.wanted == Some(i) {
                    self.wanted = None;
                    heading.scroll_to_me(Some(Align::Min));
                }
                for (j, block) in section.blocks.iter().enumerate() {
                    show_block(ui, (i, j), block, &mut self.finding);
                }
            }
            if !found {
                ui.weak("the manual does not speak of that");
            }
            self.finding.end(ui);
        });
    }
}

impl Section {
    fn text(&self) -> String {
        let mut text = self.title.clone();
        for block in &self.blocks {
            text.push('\n');
            match block {
                Block::Paragraph(t) | Block::Item(t) | Block::Code(t) | Block::Output(t) => text.push_str(t),
                Block::Table(rows) => text.extend(rows.iter().flatten().map(|cell| format!("{cell} "))),
            }
        }
        text
    }
}

fn show_block(ui: &mut Ui, id: (usize, usize), block: &Block, finding: &mut Finding) {
    match block {
        Block::Paragraph(text) => drop(finding.label(ui, inline(ui, text))),
        Block::Item(text) => {
            ui.horizontal_top(|ui| {
                ui.add_space(4.0);
                ui.label("•");
                ui.vertical(|ui| finding.label(ui, inline(ui, text)));
            });
        }
        Block::Table(rows) => {
            let columns = rows.iter().map(Vec::len).max().unwrap_or(1).max(1);
            // The first column holds code that does not break well.
            let width = ui.available_width() - 8.0;
            let room = |column: usize| if column == 0 { 0.42 * width } else { 0.54 * width / (columns - 1) as f32 };
            for (i, row) in rows.iter().filter(|row| row.iter().any(|cell| !cell.is_empty())).enumerate() {
                let fill = if i % 2 == 1 { ui.visuals().faint_bg_color } else { Color32::TRANSPARENT };
                Frame::NONE.fill(fill).inner_margin(Margin::symmetric(4, 2)).show(ui, |ui| {
                    ui.horizontal_top(|ui| {
                        ui.spacing_mut().item_spacing.x = 0.0;
                        for (column, cell) in row.iter().enumerate() {
                            // In a row text does not break; in a column it does.
                            let size = vec2(room(column), 0.0);
                            ui.allocate_ui_with_layout(size, Layout::top_down(Align::Min), |ui| {
                                ui.set_width(room(column) - 8.0);
                                finding.label(ui, inline(ui, cell));
                            });
                            ui.add_space(8.0);
                        }
                    });
                });
            }
        }
        Block::Code(text) | Block::Output(text) => {
            let is_code = matches!(block, Block::Code(_));
            let fill = if is_code { ui.visuals().extreme_bg_color } else { ui.visuals().faint_bg_color };
            let edge = Stroke::new(1.0, ui.visuals().widgets.noninteractive.bg_stroke.color);
            Frame::NONE.fill(fill).stroke(edge).corner_radius(5).inner_margin(Margin::symmetric(10, 7)).show(
                ui,
                |ui| {
                    ui.set_width(ui.available_width());
                    ScrollArea::horizontal().id_salt(("code", id)).show(ui, |ui| {
                        let font = TextStyle::Monospace.resolve(ui.style());
                        let job = if is_code {
                            color(text, ui.visuals().dark_mode, &font)
                        } else {
                            LayoutJob::simple(text.clone(), font, ui.visuals().weak_text_color(), f32::INFINITY)
                        };
                        finding.label(ui, job);
                    });
                },
            );
        }
    }
}

/// A text with its marks turned into colours and slants.
fn inline(ui: &Ui, text: &str) -> LayoutJob {
    let body = TextStyle::Body.resolve(ui.style());
    let visuals = ui.visuals();
    let mono = FontId::new(body.size - 0.5, FontFamily::Monospace);
    let format = |font: &FontId, color: Color32| TextFormat::simple(font.clone(), color);
    let mut job = LayoutJob::default();
    for (kind, part) in spans(text) {
        let format = match kind {
            Kind::Plain => format(&body, visuals.text_color()),
            Kind::Strong => format(&body, visuals.strong_text_color()),
            Kind::Emphasis => TextFormat { italics: true, ..format(&body, visuals.text_color()) },
            Kind::Code => TextFormat { background: visuals.faint_bg_color, ..format(&mono, visuals.hyperlink_color) },
        };
        job.append(part, 0.0, format);
    }
    job
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Plain,
    Strong,
    Emphasis,
    Code,
}

/// A line cut at its marks. A mark that is never closed is itself.
fn spans(text: &str) -> Vec<(Kind, &str)> {
    let mut spans = Vec::new();
    let (mut start, mut at) = (0, 0);
    while at < text.len() {
        let rest = &text[at..];
        // Code may hold the mark itself, between double ones.
        let marks = [
            ("`` ", " ``", Kind::Code),
            ("`", "`", Kind::Code),
            ("**", "**", Kind::Strong),
            ("*", "*", Kind::Emphasis),
        ];
        let opened = marks.into_iter().find_map(|(open, close, kind)| {
            let inside = rest.strip_prefix(open)?;
            let end = inside.find(close).filter(|&end| end > 0)?;
            // A star with spaces around it multiplies.
            let is_mark = kind == Kind::Code || !inside.starts_with(' ');
            is_mark.then(|| (kind, at + open.len(), at + open.len() + end, close.len()))
        });
        match opened {
            Some((kind, from, to, close)) => {
                if start < at {
                    spans.push((Kind::Plain, &text[start..at]));
                }
                spans.push((kind, &text[from..to]));
                at = to + close;
                start = at;
            }
            None => at += rest.chars().next().map_or(1, char::len_utf8),
        }
    }
    if start < text.len() {
        spans.push((Kind::Plain, &text[start..]));
    }
    spans
}

fn read(text: &str) -> Vec<Section> {
    let mut sections = vec![Section { title: "Overview".to_owned(), blocks: Vec::new() }];
    let mut lines = text.lines().peekable();
    while let Some(line) = lines.next() {
        if let Some(title) = line.strip_prefix("## ") {
            sections.push(Section { title: title.to_owned(), blocks: Vec::new() });
            continue;
        }
        let Some(section) = sections.last_mut() else { break };
        let blocks = &mut section.blocks;
        if let Some(language) = line.strip_prefix("```") {
            let code: Vec<&str> = lines.by_ref().take_while(|line| !line.starts_with("```")).collect();
            let code = code.join("\n");
            blocks.push(if language == "out" { Block::Output(code) } else { Block::Code(code) });
        } else if line.starts_with('|') {
            let mut rows = vec![cells(line)];
            while let Some(line) = lines.next_if(|line| line.starts_with('|')) {
                if !line.chars().all(|c| matches!(c, '|' | '-' | ' ' | ':')) {
                    rows.push(cells(line));
                }
            }
            // Pictures are for pages: a column of them is left out.
            while rows
                .iter()
                .all(|row| row.len() > 1 && row.last().is_some_and(|c| c.is_empty() || c.starts_with("<img")))
            {
                rows.iter_mut().for_each(|row| _ = row.pop());
            }
            blocks.push(Block::Table(rows));
        } else if line.is_empty() || line.starts_with("# ") {
            // a title, or the space between two paragraphs
        } else {
            let item = line.strip_prefix("- ");
            let mut paragraph = item.unwrap_or(line).trim().to_owned();
            let goes_on =
                |line: &&str| !line.is_empty() && !line.starts_with(['#', '|', '`']) && !line.starts_with("- ");
            let code = |line: &&str| line.starts_with('`') && !line.starts_with("```");
            while let Some(line) = lines.next_if(|line| goes_on(line) || code(line)) {
                paragraph.push(' ');
                paragraph.push_str(line.trim());
            }
            blocks.push(if item.is_some() { Block::Item(paragraph) } else { Block::Paragraph(paragraph) });
        }
    }
    sections
}

/// The cells of a row; a bar in code is part of it.
fn cells(line: &str) -> Vec<String> {
    let line = line.trim().trim_start_matches('|');
    let line = line.strip_suffix('|').unwrap_or(line);
    let mut cells = vec![String::new()];
    let mut code = false;
    for c in line.chars() {
        code ^= c == '`';
        match (c, cells.last_mut()) {
            ('|', _) if !code => cells.push(String::new()),
            (c, Some(cell)) => cell.push(c),
            (_, None) => {}
        }
    }
    cells.into_iter().map(|cell| cell.trim().to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_become_kinds() {
        let expected = [
            (Kind::Plain, "a "),
            (Kind::Strong, "ring"),
            (Kind::Plain, " of "),
            (Kind::Code, "`v$pos"),
            (Kind::Plain, ", "),
            (Kind::Emphasis, "one"),
            (Kind::Plain, " * 2 `"),
        ];
        assert_eq!(spans("a **ring** of `` `v$pos ``, *one* * 2 `"), expected);
    }

    #[test]
    fn blocks_are_told_apart() {
        let text = "# T\n\nOne\ntwo.\n\n## Next\n- a\n  b\n- c\n\n| x | `a|b` |\n|---|---|\n| 1 | 2 |\n```vv\nmesh S;\n```\n```out\n1\n```\n";
        let sections = read(text);
        assert_eq!(sections[0].blocks, [Block::Paragraph("One two.".to_owned())]);
        assert_eq!(sections[1].title, "Next");
        let row = |a: &str, b: &str| vec![a.to_owned(), b.to_owned()];
        assert_eq!(
            sections[1].blocks,
            [
                Block::Item("a b".to_owned()),
                Block::Item("c".to_owned()),
                Block::Table(vec![row("x", "`a|b`"), row("1", "2")]),
                Block::Code("mesh S;".to_owned()),
                Block::Output("1".to_owned()),
            ]
        );
    }

    #[test]
    fn a_column_of_pictures_is_left_out() {
        let row = |cells: &[&str]| cells.iter().map(|&cell| cell.to_owned()).collect::<Vec<_>>();
        let read = |text: &str| read(text).remove(0).blocks.remove(0);
        let with = "| a | b | |\n|---|---|---|\n| 1 | 2 | <img src=\"x.png\"> |\n";
        assert_eq!(read(with), Block::Table(vec![row(&["a", "b"]), row(&["1", "2"])]));
        let without = "| a | |\n|---|---|\n| 1 | 2 |\n";
        assert_eq!(read(without), Block::Table(vec![row(&["a", ""]), row(&["1", "2"])]));
        let shown = SECTIONS.iter().all(|section| !section.text().contains("<img"));
        assert!(shown, "nothing of the manual is the source of a picture");
    }

    #[test]
    fn the_manual_is_read_whole() {
        assert!(SECTIONS.len() > 6);
        let blocks = || SECTIONS.iter().flat_map(|s| &s.blocks);
        assert!(blocks().filter(|b| matches!(b, Block::Code(_))).count() > 4);
        assert!(blocks().any(|b| matches!(b, Block::Table(rows) if rows.len() > 10)));
    }
}
