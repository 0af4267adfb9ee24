//! Small parts that several panels use.

use std::sync::Arc;

use eframe::egui::text::{LayoutJob, TextWrapping};
use eframe::egui::{
    Align, Button, Color32, KeyboardShortcut, Layout, Painter, Pos2, Rect, Response, RichText, Role, Sense, Shape,
    Stroke, TextFormat, TextStyle, Ui, UiBuilder, Vec2, WidgetInfo, vec2,
};

use crate::command::Command;
use crate::session::Session;

/// Line drawings, crisp at any scale.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Icon {
    Rewind,
    Back,
    Step,
    Play,
    Pause,
    Stop,
    /// Once around.
    Walk,
}

impl Icon {
    fn paint(self, painter: &Painter, rect: Rect, color: Color32) {
        let at = |x: f32, y: f32| rect.min + vec2(x * rect.width(), y * rect.height());
        let triangle = |points: [Pos2; 3]| {
            painter.add(Shape::convex_polygon(points.to_vec(), color, Stroke::NONE));
        };
        let bar = |x: f32, width: f32| {
            painter.rect_filled(Rect::from_min_max(at(x, 0.1), at(x + width, 0.9)), 1.0, color);
        };
        match self {
            Self::Rewind => {
                bar(0.05, 0.14);
                triangle([at(0.92, 0.1), at(0.92, 0.9), at(0.26, 0.5)]);
            }
            Self::Back => triangle([at(0.78, 0.1), at(0.78, 0.9), at(0.12, 0.5)]),
            Self::Step => {
                triangle([at(0.08, 0.1), at(0.74, 0.5), at(0.08, 0.9)]);
                bar(0.81, 0.14);
            }
            Self::Play => triangle([at(0.2, 0.06), at(0.92, 0.5), at(0.2, 0.94)]),
            Self::Pause => {
                bar(0.18, 0.22);
                bar(0.6, 0.22);
            }
            Self::Stop => {
                painter.rect_filled(Rect::from_min_max(at(0.14, 0.14), at(0.86, 0.86)), 1.5, color);
            }
            Self::Walk => {
                let on_circle = |turn: f32| at(0.5 + 0.4 * turn.cos(), 0.5 + 0.4 * turn.sin());
                let around: Vec<Pos2> = (0..=12).map(|i| on_circle(-2.2 + 0.4 * i as f32)).collect();
                painter.add(Shape::line(around, Stroke::new(1.4, color)));
                triangle([at(0.02, 0.38), at(0.36, 0.3), at(0.12, 0.02)]);
            }
        }
    }
}

/// A square button with a drawing, named for those who cannot see it.
pub fn icon_button(ui: &mut Ui, icon: Icon, name: &str, enabled: bool, accent: Option<Color32>) -> Response {
    ui.add_enabled_ui(enabled, |ui| {
        let (rect, response) = ui.allocate_exact_size(vec2(30.0, 26.0), Sense::click());
        response.widget_info(|| WidgetInfo::labeled(Role::Button, ui.is_enabled(), name));
        let visuals = ui.style().interact(&response);
        ui.painter().rect(
            rect,
            visuals.corner_radius,
            visuals.weak_bg_fill,
            visuals.bg_stroke,
            eframe::egui::StrokeKind::Inside,
        );
        let inner = Rect::from_center_size(rect.center(), Vec2::splat(11.0));
        let color = accent.filter(|_| enabled).unwrap_or(visuals.text_color());
        icon.paint(ui.painter(), inner, color);
        response
    })
    .inner
}

/// A small drawing to click, named for those who cannot see it.
pub fn icon(ui: &mut Ui, icon: Icon, name: &str) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(20.0, 18.0), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, ui.is_enabled(), name));
    let color = ui.style().interact(&response).text_color();
    icon.paint(ui.painter(), Rect::from_center_size(rect.center(), Vec2::splat(11.0)), color);
    response
}

/// The same with its name beside it, for what is wanted first.
pub fn named_icon_button(ui: &mut Ui, icon: Icon, name: &str, enabled: bool) -> Response {
    ui.add_enabled_ui(enabled, |ui| {
        let font = TextStyle::Button.resolve(ui.style());
        let galley = ui.painter().layout_no_wrap(name.to_owned(), font, Color32::PLACEHOLDER);
        let (rect, response) = ui.allocate_exact_size(vec2(galley.size().x + 38.0, 26.0), Sense::click());
        response.widget_info(|| WidgetInfo::labeled(Role::Button, ui.is_enabled(), name));
        let visuals = ui.style().interact(&response);
        ui.painter().rect(
            rect,
            visuals.corner_radius,
            visuals.weak_bg_fill,
            visuals.bg_stroke,
            eframe::egui::StrokeKind::Inside,
        );
        let inner = Rect::from_center_size(rect.left_center() + vec2(15.0, 0.0), Vec2::splat(11.0));
        icon.paint(ui.painter(), inner, visuals.text_color());
        let at = rect.left_center() + vec2(28.0, -galley.size().y / 2.0);
        ui.painter().galley(at, galley, visuals.text_color());
        response
    })
    .inner
}

/// Keys as they stand on the keyboard: `Ctrl+,`.
pub fn keys(ui: &Ui, shortcut: &KeyboardShortcut) -> String {
    let text = ui.ctx().format_shortcut(shortcut);
    let (name, sign) = (shortcut.logical_key.name(), shortcut.logical_key.symbol_or_name());
    // Arrows have signs, too, which nobody knows by heart.
    match text.strip_suffix(name) {
        Some(before) if sign.len() == 1 => format!("{before}{sign}"),
        _ => text,
    }
}

/// Tooltip of a command: what it does, and its keys.
pub fn tooltip(ui: &mut Ui, command: &Command) {
    let description = command.describe();
    ui.horizontal(|ui| {
        ui.label(description.tooltip);
        let keys: Vec<String> = description.shortcuts.iter().map(|s| keys(ui, s)).collect();
        if !keys.is_empty() {
            ui.weak(keys.join(", "));
        }
    });
}

/// Points before an entry of a menu that has ticks.
pub const TICK: f32 = 22.0;

/// A command as an entry of a menu; a switch that is on has a tick before it, for which a menu with `ticks` has room.
pub fn menu_item(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>, command: Command, ticks: bool) {
    let description = command.describe();
    let keys = description.shortcuts.first().map(|s| keys(ui, s)).unwrap_or_default();
    let on = command.is_on(session);
    let mut text = LayoutJob::default();
    let font = TextStyle::Button.resolve(ui.style());
    let space = if ticks { TICK } else { 0.0 };
    text.append(description.label, space, TextFormat::simple(font, Color32::PLACEHOLDER));
    let button = Button::new(text).shortcut_text(keys);
    let response = ui.add_enabled(command.is_enabled(session), button).accessible_name(description.label);
    super::menu_keys::entry(ui, &response);
    if on == Some(true) {
        let center = response.rect.left_center() + vec2(ui.spacing().button_padding.x + 6.0, 0.0);
        let points = [vec2(-4.5, 0.0), vec2(-1.5, 3.5), vec2(5.0, -4.0)].map(|d| center + d);
        let stroke = Stroke::new(1.6, ui.style().interact(&response).text_color());
        ui.painter().add(Shape::line(points.to_vec(), stroke));
    }
    if response.on_hover_text(description.tooltip).clicked() {
        commands.push(command);
        ui.close();
    }
}

/// An entry of a menu that is no command of the tables; whether it was chosen.
pub fn menu_entry(ui: &mut Ui, enabled: bool, label: &str, tooltip: &str) -> bool {
    let response = ui.add_enabled(enabled, Button::new(label));
    super::menu_keys::entry(ui, &response);
    let clicked = response.on_hover_text(tooltip).clicked();
    if clicked {
        ui.close();
    }
    clicked
}

/// A command as a plain button.
pub fn button(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>, command: Command) {
    let response = ui.add_enabled(command.is_enabled(session), Button::new(command.describe().label));
    if response.on_hover_ui(|ui| tooltip(ui, &command)).clicked() {
        commands.push(command);
    }
}

/// What an empty field says, beside the cursor, which would stand in its first letter.
pub fn hint(text: &str) -> RichText {
    RichText::new(format!("\u{2009}{text}"))
}

/// The button of a dialog that is meant for most.
pub fn first_choice(ui: &Ui, text: &str) -> Button<'static> {
    let visuals = ui.visuals();
    Button::new(RichText::new(text).color(visuals.selection.stroke.color)).fill(visuals.selection.bg_fill)
}

/// A check box whose box is seen also while it is not checked, on any ground.
pub fn check_box(ui: &mut Ui, on: &mut bool, text: &str) -> Response {
    outlined(ui, |ui| ui.checkbox(on, text))
}

/// One of several, of which one is on, likewise.
pub fn radio(ui: &mut Ui, on: bool, text: &str) -> Response {
    outlined(ui, |ui| ui.radio(on, text))
}

/// What is made has a line around it, which buttons have not.
fn outlined(ui: &mut Ui, make: impl FnOnce(&mut Ui) -> Response) -> Response {
    let before = ui.visuals().widgets.clone();
    let line = Stroke::new(1.0, ui.visuals().weak_text_color().gamma_multiply(0.8));
    let fill = ui.visuals().extreme_bg_color;
    let widgets = &mut ui.visuals_mut().widgets;
    for widget in [&mut widgets.inactive, &mut widgets.hovered] {
        (widget.bg_stroke, widget.bg_fill) = (line, fill);
    }
    let response = make(ui);
    ui.visuals_mut().widgets = before;
    response
}

/// A switch as a check box.
pub fn switch(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>, command: Command) {
    let mut on = command.is_on(session).unwrap_or(false);
    let response = check_box(ui, &mut on, command.describe().label).on_hover_ui(|ui| tooltip(ui, &command));
    if response.changed() {
        commands.push(command);
    }
}

/// Something at the left and something at the right of a row, made in the order in which they are read, as Tab goes. Takes
/// all the width there is and never more.
pub fn sides(ui: &mut Ui, name: &str, height: f32, left: impl FnOnce(&mut Ui), right: impl FnOnce(&mut Ui)) {
    let id = ui.scope_id().with(("sides", name));
    // As wide as the last time.
    let known = ui.data(|data| data.get_temp::<f32>(id));
    let (row, _) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
    let middle = (row.right() - known.unwrap_or(0.0)).max(row.left());
    let (mut first, second) = row.split_left_right_at_x(middle);
    first.max.x = (first.max.x - ui.spacing().item_spacing.x).max(first.min.x);
    let mut part = |rect: Rect, side: &str| {
        let layout = Layout::left_to_right(Align::Center);
        ui.new_child(UiBuilder::new().id_salt((name, side)).max_rect(rect).layout(layout))
    };
    left(&mut part(first, "left"));
    let mut at_right = part(second, "right");
    right(&mut at_right);
    let width = at_right.min_rect().width();
    if known != Some(width) {
        ui.data_mut(|data| data.insert_temp(id, width));
        ui.ctx().request_discard("now it is known how wide the right side is");
    }
}

/// A tab or a switch that is on most of the time: marked without shouting.
pub fn tab(ui: &mut Ui, on: bool, text: impl Into<RichText>, name: &str) -> Response {
    ui.scope(|ui| {
        let visuals = ui.visuals_mut();
        visuals.selection.bg_fill = visuals.widgets.inactive.bg_fill;
        visuals.selection.stroke = visuals.widgets.inactive.fg_stroke;
        let text = text.into();
        let text = if on { text } else { text.weak() };
        ui.selectable_label(on, text).accessible_name(name)
    })
    .inner
}

/// The heading of a part of a panel.
pub fn heading(ui: &mut Ui, text: &str) {
    ui.add_space(4.0);
    bold(ui, text);
}

/// The same with what can be done with that part at the right.
pub fn heading_with(ui: &mut Ui, text: &str, right: impl FnOnce(&mut Ui)) {
    ui.add_space(2.0);
    let height = ui.spacing().interact_size.y;
    sides(ui, text, height, |ui| _ = bold(ui, text), right);
}

/// A text in heavier letters: drawn twice, a pixel apart, since the font has one weight.
pub fn bold(ui: &mut Ui, text: &str) -> Response {
    let apart = ui.pixels_per_point().recip();
    let format = TextFormat {
        font_id: TextStyle::Body.resolve(ui.style()),
        extra_letter_spacing: apart,
        color: ui.visuals().strong_text_color(),
        ..TextFormat::default()
    };
    let job = LayoutJob { wrap: TextWrapping::no_max_width(), ..LayoutJob::single_section(text.to_owned(), format) };
    let galley = ui.painter().layout_job(job);
    let response = ui.label(Arc::clone(&galley));
    let color = ui.visuals().strong_text_color();
    ui.painter().galley(response.rect.min + vec2(apart, 0.0), galley, color);
    response
}

/// `12 345 678`: groups of three.
pub fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut result = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            result.push('\u{202f}'); // a line is not broken in a number
        }
        result.push(digit);
    }
    result
}

/// Seconds, in the unit that reads best.
pub fn seconds(s: f64) -> String {
    match s {
        s if s < 1e-3 => format!("{:.0} µs", s * 1e6),
        s if s < 0.1 => format!("{:.1} ms", s * 1e3),
        s if s < 1.0 => format!("{:.0} ms", s * 1e3),
        s => format!("{s:.1} s"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_grouped_and_times_have_units() {
        assert_eq!(grouped(7), "7");
        assert_eq!(grouped(1234), "1\u{202f}234");
        assert_eq!(grouped(123_456_789), "123\u{202f}456\u{202f}789");
        assert_eq!(seconds(0.000_012), "12 µs");
        assert_eq!(seconds(0.0123), "12.3 ms");
        assert_eq!(seconds(2.04), "2.0 s");
    }
}
