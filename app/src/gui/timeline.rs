//! The generations in a row: where we are, where we have been, what is kept.

use eframe::egui::{
    self, Align2, ComboBox, CursorIcon, Key, Rect, Role, Sense, Stroke, TextStyle, Ui, WidgetInfo, pos2, vec2,
};

use super::widgets::{Icon, grouped, icon_button, menu_entry, seconds, sides, tooltip};
use crate::annotate::Quantity;
use crate::command::Command;
use crate::session::{Purpose, Session};

/// Points between two generations, where there is room.
const APART: f32 = 46.0;
/// Dots closer than that are a line.
const CLOSEST: f32 = 7.0;
const SPEEDS: [f64; 6] = [0.5, 1.0, 2.0, 5.0, 10.0, 30.0];

/// Shows it.
pub fn show(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 6.0;
        let icon = if session.is_playing() { Icon::Pause } else { Icon::Play };
        let response = icon_button(ui, icon, "Play the generations", Command::Play.is_enabled(session), None);
        if response.on_hover_ui(|ui| tooltip(ui, &Command::Play)).clicked() {
            commands.push(Command::Play);
        }
        let mut its = Vec::new();
        let roomy = ui.available_width() > 220.0;
        let right = |ui: &mut Ui| {
            if roomy {
                speed(ui, session, &mut its);
            }
        };
        sides(ui, "speed", 28.0, |ui| track(ui, session, commands), right);
        commands.append(&mut its);
    });
}

/// The keys mean the time line while it has them.
fn by_keys(ui: &Ui, session: &Session, id: egui::Id, commands: &mut Vec<Command>) {
    let keys = egui::EventFilter { horizontal_arrows: true, ..Default::default() };
    ui.memory_mut(|m| m.set_focus_lock_filter(id, keys));
    let all = [
        (Key::ArrowLeft, Command::Back),
        (Key::ArrowRight, Command::Step),
        (Key::Home, Command::Rewind),
        (Key::End, Command::End),
        (Key::Space, Command::Play),
    ];
    for (key, command) in all {
        if command.is_enabled(session) && ui.input_mut(|i| i.consume_key(egui::Modifiers::NONE, key)) {
            commands.push(command);
        }
    }
}

/// What a right click on a generation offers.
fn menu(ui: &mut Ui, session: &Session, generation: u64, commands: &mut Vec<Command>) {
    ui.set_min_width(210.0);
    let with = |command: Command| Command::With(generation, Box::new(command));
    let entries = [
        (format!("Go to generation {generation}"), "show it", Command::GoTo(generation)),
        (
            format!("Compare with generation {generation}"),
            "colour what was born and what moved since then, in whatever generation is shown",
            Command::ColorBy(Quantity::Since(generation)),
        ),
        (
            "Colour what its step changed".to_owned(),
            "show it, and what was born and what moved since the generation before",
            with(Command::ColorBy(Quantity::Change)),
        ),
        ("Save picture of it…".to_owned(), "show it, and write what is seen into a file", with(Command::SavePicture)),
        (
            "Save mesh of it…".to_owned(),
            "show it, and write its mesh into a file",
            with(Command::Choose(Purpose::ExportMesh)),
        ),
    ];
    for (i, (label, tooltip, command)) in entries.into_iter().enumerate() {
        if i == 3 {
            ui.separator();
        }
        let kept = generation == 0 || session.reached(generation).is_some_and(|r| r.kept);
        let enabled = session.frame().is_some() && (i != 1 || kept) && (i != 2 || generation > 0);
        if menu_entry(ui, enabled, &label, tooltip) {
            commands.push(command);
        }
    }
}

fn speed(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let text = |speed: f64| format!("{speed} / s");
    let list = ComboBox::from_id_salt("speed").selected_text(text(session.speed)).width(64.0);
    let response = list.show_ui(ui, |ui| {
        for speed in SPEEDS {
            if ui.selectable_label(session.speed == speed, text(speed)).clicked() {
                commands.push(Command::SetSpeed(speed));
            }
        }
    });
    let response = response.response.on_hover_text("how many generations a second are played, at most");
    response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, "Speed"));
}

fn track(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let wanted = session.document.generation;
    let failed = session.halted();
    let last = session.last_reached().max(wanted).max(1);
    let last = last.max(failed.map_or(0, |failed| failed.generation));
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), 28.0), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::slider(true, wanted as f64, "Time line"));
    let visuals = ui.visuals().clone();
    let inner = rect.shrink2(vec2(14.0, 0.0));
    let step = (inner.width() / last as f32).min(APART);
    let (y, left) = (rect.center().y - 4.0, inner.left());
    let at = |generation: u64| left + step * generation as f32;
    let under = |x: f32| ((x - left) / step).round().clamp(0.0, last as f32) as u64;
    let response = response.on_hover_cursor(CursorIcon::PointingHand);
    if let Some(pos) = response.interact_pointer_pos().filter(|_| response.dragged() || response.clicked()) {
        let generation = under(pos.x);
        if generation != wanted {
            commands.push(Command::Scrub(generation));
        }
    }
    if let Some(pos) = response.interact_pointer_pos().filter(|_| response.secondary_clicked()) {
        ui.ctx().data_mut(|data| data.insert_temp(response.id, under(pos.x)));
    }
    response.context_menu(|ui| {
        let generation = ui.ctx().data(|data| data.get_temp(response.id)).unwrap_or(wanted);
        menu(ui, session, generation, commands);
    });
    if response.has_focus() {
        by_keys(ui, session, response.id, commands);
        ui.painter().rect_stroke(rect, 4.0, visuals.widgets.active.bg_stroke, egui::StrokeKind::Inside);
    }
    let hovered = response.hover_pos().map(|pos| under(pos.x)).filter(|_| !response.dragged());
    let painter = ui.painter().with_clip_rect(rect);
    let quiet = visuals.widgets.noninteractive.bg_stroke.color;
    let weak = visuals.weak_text_color();
    let accent = visuals.hyperlink_color;
    painter.hline(at(0)..=at(last), y, Stroke::new(2.0, quiet));
    painter.hline(at(0)..=at(wanted), y, Stroke::new(2.0, accent.gamma_multiply(0.7)));
    if step >= CLOSEST {
        for generation in 0..=last {
            let center = pos2(at(generation), y);
            let color = if generation <= wanted { accent } else { weak };
            match session.reached(generation) {
                Some(r) if r.kept => drop(painter.circle_filled(center, 3.5, color)),
                Some(_) => drop(painter.circle(center, 3.5, visuals.panel_fill, Stroke::new(1.5, color))),
                None => drop(painter.circle_filled(center, 2.0, quiet)),
            }
        }
    }
    if let Quantity::Since(generation) = session.document.annotations.color_by
        && generation <= last
    {
        // It hangs above the one that is compared with.
        let tip = pos2(at(generation), y - 5.0);
        let corners = [vec2(-4.0, -5.0), vec2(4.0, -5.0), vec2(0.0, 0.0)].map(|d| tip + d);
        painter.add(egui::Shape::convex_polygon(corners.to_vec(), visuals.warn_fg_color, Stroke::NONE));
    }
    // Where the work is.
    if let Some((_, Some(generation))) = session.progress() {
        painter.circle_stroke(pos2(at(generation.min(last)), y), 6.0, Stroke::new(1.5, visuals.warn_fg_color));
    }
    // Where it failed.
    if let Some(failed) = failed {
        let (center, arm) = (pos2(at(failed.generation), y), 3.5);
        painter.circle_filled(center, 6.0, visuals.panel_fill);
        for across in [vec2(arm, arm), vec2(arm, -arm)] {
            painter.line_segment([center - across, center + across], Stroke::new(2.0, visuals.error_fg_color));
        }
    }
    // Full where we are, hollow where we would like to be.
    let handle = pos2(at(wanted), y);
    match session.stale() {
        None => painter.circle(handle, 6.5, accent, Stroke::new(2.0, visuals.panel_fill)),
        Some(_) => painter.circle(handle, 5.5, visuals.panel_fill, Stroke::new(2.0, accent)),
    };
    let small = TextStyle::Small.resolve(ui.style());
    // As many numbers as there is room for.
    let every = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 10_000, 100_000]
        .into_iter()
        .find(|n| step * *n as f32 >= 26.0)
        .unwrap_or(1_000_000);
    let mut taken: Option<Rect> = None;
    let numbers = std::iter::once(wanted).chain((0..=last).step_by(every));
    for (i, generation) in numbers.enumerate() {
        let color = if i == 0 { visuals.text_color() } else { weak };
        let galley = painter.layout_no_wrap(generation.to_string(), small.clone(), color);
        let place = Align2::CENTER_TOP.anchor_size(pos2(at(generation), y + 7.0), galley.size());
        if i > 0 && taken.is_some_and(|t| t.expand(3.0).intersects(place)) {
            continue;
        }
        if i == 0 {
            taken = Some(place);
        }
        painter.galley(place.min, galley, color);
    }
    if let Some(generation) = hovered {
        painter.circle_stroke(pos2(at(generation), y), 6.5, Stroke::new(1.0, visuals.text_color()));
        let text = match session.reached(generation) {
            Some(r) => {
                let kept = if r.kept { "" } else { ", computed again" };
                let time = if generation == 0 { String::new() } else { format!(", {}", seconds(r.step)) };
                format!("generation {generation}: {} vertices{time}{kept}", grouped(r.vertices))
            }
            None => format!("generation {generation}"),
        };
        let compared = session.document.annotations.color_by == Quantity::Since(generation);
        let text = if compared { format!("{text}; the one that is compared with") } else { text };
        let text = match failed.filter(|failed| failed.generation == generation) {
            Some(failed) => format!("generation {generation} failed: {}", super::messages::in_short(&failed.message)),
            None => text,
        };
        response.on_hover_text_at_pointer(text);
    }
}
