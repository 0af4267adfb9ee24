//! Generations, the rule, and which panels are open.

use eframe::egui::{ComboBox, DragValue, Ui};

use super::widgets::{Icon, icon_button, named_icon_button, sides, tab, tooltip};
use crate::command::{Command, Panel};
use crate::session::Session;

/// Shows them.
pub fn show(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let tool = |ui: &mut Ui, commands: &mut Vec<Command>, icon, command: Command, accent| {
            let description = command.describe();
            let enabled = command.is_enabled(session);
            let response = icon_button(ui, icon, description.label, enabled, accent);
            if response.on_hover_ui(|ui| tooltip(ui, &command)).clicked() {
                commands.push(command);
            }
        };
        tool(ui, commands, Icon::Rewind, Command::Rewind, None);
        tool(ui, commands, Icon::Back, Command::Back, None);
        let step = named_icon_button(ui, Icon::Step, "Step", Command::Step.is_enabled(session));
        if step.on_hover_ui(|ui| tooltip(ui, &Command::Step)).clicked() {
            commands.push(Command::Step);
        }
        let play = if session.is_playing() { Icon::Pause } else { Icon::Play };
        tool(ui, commands, play, Command::Play, None);
        let red = ui.visuals().error_fg_color;
        tool(ui, commands, Icon::Stop, Command::Stop, Some(red));
        ui.add_space(8.0);
        generation(ui, session, commands);
        ui.add_space(8.0);
        rule(ui, session, commands);
        if ui.available_width() > 240.0 {
            sides(ui, "panels", ui.spacing().interact_size.y, |_| {}, |ui| panels(ui, session, commands));
        }
    });
}

fn generation(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let label = ui.label("Generation");
    let mut wanted = session.document.generation;
    let field = DragValue::new(&mut wanted).range(0..=1_000_000).speed(0.05).update_while_editing(false);
    let response = ui.add(field).labelled_by(label.id).on_hover_text("type or drag to go to a generation");
    if response.changed() {
        commands.push(Command::GoTo(wanted));
    }
}

fn rule(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let Some(program) = session.program() else { return };
    let chosen = session.rule().unwrap_or("none");
    let label = ui.label("Rule");
    let response = ComboBox::from_id_salt("rule").selected_text(chosen).width(110.0).show_ui(ui, |ui| {
        for function in program.rules.iter().filter_map(|&r| program.function(r)) {
            if ui.selectable_label(chosen == function.name, &function.name).clicked() {
                commands.push(Command::ChooseRule(function.name.clone()));
            }
        }
    });
    response.response.labelled_by(label.id).on_hover_text("the function that a step applies");
}

/// Which panels are open.
fn panels(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    for (panel, text) in [(Panel::Program, "Program"), (Panel::Messages, "Messages"), (Panel::Inspector, "Inspector")] {
        let command = Command::Toggle(panel);
        let response = tab(ui, session.panels.is_open(panel), text, command.describe().label);
        if response.on_hover_ui(|ui| tooltip(ui, &command)).clicked() {
            commands.push(command);
        }
    }
}
