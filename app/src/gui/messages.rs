//! What is wrong, and what the program prints.

use eframe::egui::{self, Align, Label, Layout, RichText, ScrollArea, Sense, TextStyle, Ui, Vec2b};
use vv::diagnostic::Severity;

use super::ring::text_with_vertices;
use super::widgets::{grouped, menu_entry, tab};
use super::{findings, printed, theme};
use crate::command::{Command, Inspect};
use crate::inspect::findings::Findings;
use crate::session::{Problem, Session};

/// Width of the button that copies, and of what looks for lines.
const COPY: f32 = 48.0;
const FILTER: f32 = 48.0;
/// Room beside the text of a tab and between tabs, where there is little.
const NARROW: (f32, f32) = (4.0, 2.0);

/// The panel's own state: which part is shown.
#[derive(Default)]
pub struct Messages {
    console: bool,
    printed: printed::Printed,
    findings: findings::List,
    /// Errors at the last look, to bring them to the front when there are new ones.
    errors: usize,
}

impl Messages {
    /// Shows them.
    pub fn show(&mut self, ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
        let problems = session.problems();
        let (errors, warnings) = (problems.count(Severity::Error), problems.count(Severity::Warning));
        if errors > 0 && self.errors == 0 {
            self.console = false;
            if session.inspection.listing {
                commands.push(Command::Inspect(Inspect::ListProblems));
            }
        }
        self.errors = errors;
        let generation = session.console_generation();
        let lines = session.console().len(generation);
        egui::Frame::NONE.inner_margin(theme::beside_bar()).show(ui, |ui| {
            ui.horizontal(|ui| {
                let all = problems.iter().count();
                let (wrong, found) = found_in_mesh(session);
                let counts = [("Problems", all), ("Mesh", found), ("Console", lines)];
                let beside = if self.console && !session.inspection.listing && lines > 0 { COPY + FILTER } else { 0.0 };
                let ([of_problems, of_mesh, of_console], room) = titles(ui, counts, beside);
                let mut title = RichText::new(of_problems);
                if errors + warnings > 0 {
                    let worst = if errors > 0 { Severity::Error } else { Severity::Warning };
                    title = title.color(theme::severity(ui.visuals(), worst));
                }
                let listing = session.inspection.listing;
                let list = Command::Inspect(Inspect::ListProblems);
                if tab(ui, !self.console && !listing, title, "Problems").clicked() {
                    self.console = false;
                    commands.extend(listing.then(|| list.clone()));
                }
                let mut title = RichText::new(of_mesh);
                if wrong > 0 {
                    title = title.color(theme::severity(ui.visuals(), Severity::Warning));
                }
                if tab(ui, listing, title, "Mesh").clicked() && !listing {
                    commands.push(list.clone());
                }
                if tab(ui, self.console && !listing, of_console, "Console").clicked() {
                    self.console = true;
                    commands.extend(listing.then_some(list));
                }
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    let (count, what) =
                        if self.console { (lines, "copy all lines") } else { (all, "copy all messages") };
                    let copies = !listing && count > 0 && room > COPY;
                    if copies && ui.small_button("Copy").on_hover_text(what).clicked() {
                        ui.ctx().copy_text(match self.console {
                            true => printed::all(session, generation),
                            false => all_texts(session),
                        });
                    }
                    let filters = room >= COPY + FILTER || self.printed.is_filtered();
                    if self.console && !listing && count > 0 && filters {
                        self.printed.field(ui);
                    }
                });
            })
        });
        ui.add_space(2.0);
        if session.inspection.listing {
            self.findings.show(ui, session, commands);
        } else if self.console {
            self.printed.show(ui, session, generation, commands);
        } else {
            list(ui, session, commands);
        }
    }
}

/// What is wrong with the mesh, and all that is said of it.
fn found_in_mesh(session: &Session) -> (usize, usize) {
    let findings = session.frame().and_then(|frame| frame.findings.get());
    findings.map_or((0, 0), Findings::counts)
}

/// What is written on the tabs, with as many counts as there is room for beside something of this width, or else for the tabs
/// alone; and how much room is left. Makes `ui` narrow where there is little.
fn titles(ui: &mut Ui, counts: [(&str, usize); 3], beside: f32) -> ([String; 3], f32) {
    let font = TextStyle::Button.resolve(ui.style());
    let wide = |ui: &Ui, text: &str| {
        ui.painter().layout_no_wrap(text.to_owned(), font.clone(), egui::Color32::PLACEHOLDER).size().x
    };
    let usual = (ui.spacing().button_padding.x, ui.spacing().item_spacing.x);
    let ways = [(3, usual), (3, NARROW), (1, NARROW), (0, NARROW)].map(|(counted, (padding, spacing))| {
        let mut place = 0;
        let texts = counts.map(|(name, count)| {
            place += 1;
            if count > 0 && place <= counted { format!("{name} ({})", grouped(count)) } else { name.to_owned() }
        });
        let used: f32 = texts.iter().map(|text| wide(ui, text) + 2.0 * padding + spacing).sum();
        (texts, ui.available_width() - used, (padding, spacing))
    });
    let fits = |least: f32| ways.iter().find(|(_, room, _)| *room >= least);
    let [.., last] = &ways;
    let (texts, room, (padding, spacing)) = fits(beside).or_else(|| fits(0.0)).unwrap_or(last).clone();
    ui.spacing_mut().button_padding.x = padding;
    ui.spacing_mut().item_spacing.x = spacing;
    (texts, room)
}

fn list(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let area = ScrollArea::vertical().id_salt("problems").auto_shrink(Vec2b::FALSE);
    area.content_margin(theme::beside_bar()).show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 3.0;
        if session.problems().iter().next().is_none() {
            ui.weak("no problems");
        }
        for problem in session.problems().iter() {
            entry(ui, session, problem, commands);
        }
    });
}

/// All messages as text.
fn all_texts(session: &Session) -> String {
    let texts: Vec<String> = session.problems().iter().map(Problem::to_text).collect();
    texts.join("\n")
}

fn entry(ui: &mut Ui, session: &Session, problem: &Problem, commands: &mut Vec<Command>) {
    let diagnostic = &problem.diagnostic;
    let color = theme::severity(ui.visuals(), diagnostic.severity);
    let place = match &problem.place {
        Some(place) if place.own => format!("line {}: ", place.start.line),
        Some(place) => format!("{}:{}: ", place.file, place.start.line),
        None => String::new(),
    };
    let mut text = egui::text::LayoutJob::default();
    let font = TextStyle::Body.resolve(ui.style());
    let format = |color| egui::TextFormat { font_id: font.clone(), color, ..Default::default() };
    text.append("●", 0.0, format(color));
    text.append(&place, 6.0, format(ui.visuals().weak_text_color()));
    let space = if place.is_empty() { 6.0 } else { 0.0 };
    text.append(&in_short(&diagnostic.message), space, format(ui.visuals().text_color()));
    let response = ui.add(Label::new(text).sense(Sense::click()).selectable(false));
    let response = response.on_hover_cursor(egui::CursorIcon::PointingHand);
    response.context_menu(|ui| {
        ui.set_min_width(180.0);
        let own = problem.place.as_ref().filter(|place| place.own);
        if menu_entry(ui, own.is_some(), "Go to place", "show it in the program")
            && let Some(place) = own
        {
            commands.push(Command::Reveal(place.range.clone()));
        }
        ui.separator();
        if menu_entry(ui, true, "Copy message", "with its place, evidence and hints") {
            ui.ctx().copy_text(problem.to_text());
        }
        if menu_entry(ui, true, "Copy all messages", "of the program, the mesh and the run") {
            ui.ctx().copy_text(all_texts(session));
        }
    });
    if response.clicked()
        && let Some(place) = problem.place.as_ref().filter(|p| p.own)
    {
        commands.push(Command::Reveal(place.range.clone()));
    }
    ui.indent(("details", diagnostic.span, &diagnostic.message), |ui| details(ui, session, problem, commands));
}

/// A message as it is shown: names that nobody reads to the end, and files that are one line, are cut. Copied, it is whole.
pub fn in_short(message: &str) -> String {
    const WORD: usize = 60;
    const MOST: usize = 600;
    let cut = |text: &str, most: usize, rest: usize| match text.char_indices().nth(most + rest) {
        Some(_) => {
            let at = |n: usize| text.char_indices().nth(n).map_or(text.len(), |(at, _)| at);
            let end = text.char_indices().rev().nth(rest.saturating_sub(1)).map_or(text.len(), |(at, _)| at);
            format!("{}…{}", &text[..at(most)], if rest == 0 { "" } else { &text[end..] })
        }
        None => text.to_owned(),
    };
    // With the sign behind it, which may be a back quote.
    let words: Vec<String> = message.split(' ').map(|word| cut(word, WORD, 2)).collect();
    cut(&words.join(" "), MOST, 0)
}

/// Evidence, hints and fixes; also in the editor's tooltip.
pub fn details(ui: &mut Ui, session: &Session, problem: &Problem, commands: &mut Vec<Command>) {
    for (place, text) in &problem.labels {
        let file = if place.own { String::new() } else { format!("{}:", place.file) };
        let text = format!("{file}line {}: {text}", place.start.line);
        text_with_vertices(ui, session, commands, &text, problem.generation);
    }
    for fact in &problem.diagnostic.evidence {
        text_with_vertices(ui, session, commands, fact, problem.generation);
    }
    vertices(ui, session, problem, commands);
    for hint in &problem.diagnostic.hints {
        ui.horizontal_wrapped(|ui| {
            ui.add(Label::new(RichText::new(format!("hint: {}", hint.message)).weak()).wrap());
            let here = problem.place.as_ref().is_some_and(|p| p.own);
            if here && hint.edit.is_some() && ui.small_button("Fix").on_hover_text("change the text so").clicked() {
                commands.push(Command::Fix(hint.clone()));
            }
        });
    }
    for (function, _) in &problem.diagnostic.calls {
        ui.weak(format!("in {function}"));
    }
}

/// The vertices that it is about.
fn vertices(ui: &mut Ui, session: &Session, problem: &Problem, commands: &mut Vec<Command>) {
    const SHOWN: usize = 24;
    let all = &problem.diagnostic.vertices;
    if problem.generation.is_none() || all.is_empty() {
        return;
    }
    let mut text = "about ".to_owned();
    text += &all.iter().take(SHOWN).map(ToString::to_string).collect::<Vec<_>>().join(", ");
    if all.len() > SHOWN {
        text += &format!(" and {} more", all.len() - SHOWN);
    }
    text_with_vertices(ui, session, commands, &text, problem.generation);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_names_and_long_messages_are_cut() {
        assert_eq!(in_short("unknown name `w`, did you mean `v`?"), "unknown name `w`, did you mean `v`?");
        assert_eq!(
            in_short(&format!("unknown name `{}`", "ä".repeat(5000))),
            format!("unknown name `{}…ä`", "ä".repeat(59))
        );
        assert_eq!(in_short(&"many words ".repeat(500)).chars().count(), 601);
    }
}
