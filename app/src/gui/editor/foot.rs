//! The line below the program: what is wrong in the line of the cursor, where the cursor is, and whom the keys are for.

use std::ops::Range;

use eframe::egui::text::LayoutJob;
use eframe::egui::{Align, Button, Frame, Layout, Margin, Rect, RichText, TextStyle, Ui, UiBuilder, pos2};

use super::super::{messages, theme};
use crate::command::Command;
use crate::session::{Place, Problem, Session};

/// Rows of a message that are seen; pointing at it shows the rest.
const ROWS: usize = 3;

/// Whom the keys are for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Keys {
    /// What is typed goes into the program.
    Text,
    /// It goes into another field.
    Field,
    /// Letters are commands.
    Picture,
}

impl Keys {
    fn say(self) -> &'static str {
        match self {
            Self::Text => "F6: keys to the picture",
            Self::Field => "F6: type here",
            Self::Picture => "letters are commands · F6: type here",
        }
    }
}

/// Shows it at the lower end of `all`, `keys` so that it is not overlooked if `aloud`. Returns its height.
pub fn show(
    ui: &mut Ui,
    all: Rect,
    session: &Session,
    (text, selection): (&str, &Range<usize>),
    own: &[(&Problem, &Place)],
    (keys, aloud): (Keys, bool),
    commands: &mut Vec<Command>,
) -> f32 {
    let before = text.get(..selection.end).unwrap_or_default();
    let line = before.matches('\n').count() as u32 + 1;
    let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
    let here = own.iter().filter(|(_, place)| place.start.line == line);
    let problem = here.rev().max_by_key(|(problem, _)| problem.diagnostic.severity).map(|(problem, _)| *problem);
    let known = ui.ctx().data(|data| data.get_temp::<f32>(ui.scope_id())).unwrap_or(0.0);
    let place = Rect::from_min_max(pos2(all.left(), all.bottom() - known), all.max);
    let builder = UiBuilder::new().id_salt("foot").max_rect(place);
    let inner = ui.scope_builder(builder, |ui| {
        let frame = Frame::NONE.fill(ui.visuals().panel_fill).inner_margin(Margin::symmetric(12, 3));
        frame.show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 2.0;
            if let Some(problem) = problem {
                message(ui, session, problem, commands);
            }
            let width = ui.available_width();
            let row = ui.text_style_height(&TextStyle::Small) + 4.0;
            ui.allocate_ui_with_layout([width, row].into(), Layout::right_to_left(Align::Center), |ui| {
                let said = RichText::new(keys.say()).small();
                let said = if aloud { said.strong().color(ui.visuals().warn_fg_color) } else { said.weak() };
                ui.add(eframe::egui::Label::new(said).selectable(false));
                ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                    let at = RichText::new(format!("line {line}, column {column}")).small().weak();
                    ui.add(eframe::egui::Label::new(at).selectable(false).truncate());
                });
            });
        })
    });
    let rect = inner.response.rect;
    ui.painter().hline(all.x_range(), rect.top(), ui.visuals().widgets.noninteractive.bg_stroke);
    let height = rect.height();
    if (known - height).abs() > 0.5 {
        ui.ctx().data_mut(|data| data.insert_temp(ui.scope_id(), height));
        ui.ctx().request_discard("now it is known how high the foot of the program is");
    }
    height
}

/// What is wrong, as far as there is room, and what mends it.
fn message(ui: &mut Ui, session: &Session, problem: &Problem, commands: &mut Vec<Command>) {
    let diagnostic = &problem.diagnostic;
    let color = theme::severity(ui.visuals(), diagnostic.severity);
    let font = TextStyle::Body.resolve(ui.style());
    let mut job = LayoutJob::simple(messages::in_short(&diagnostic.message), font, color, ui.available_width());
    job.wrap.max_rows = ROWS;
    let said = ui.add(eframe::egui::Label::new(job).selectable(true));
    said.on_hover_ui(|ui| {
        ui.label(RichText::new(messages::in_short(&diagnostic.message)).color(color));
        messages::details(ui, session, problem, &mut Vec::new());
    });
    for hint in &diagnostic.hints {
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new(&hint.message).small().weak());
            let fix = hint.edit.is_some() && ui.add(Button::new("Fix").small()).on_hover_text(&hint.message).clicked();
            if fix {
                commands.push(Command::Fix(hint.clone()));
            }
        });
    }
}
