//! Generations, the rule, and which panels are open.

use eframe::egui::{ComboBox, DragValue, RichText, Ui};

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
    let shown = session.shown_generation();
    let differs = session.frame().is_some() && session.stale().is_some() && shown != wanted;
    let field = DragValue::new(&mut wanted).range(0..=1_000_000).speed(0.05).update_while_editing(false);
    let hover = if differs {
        format!("this is wanted; the picture is that of generation {shown}")
    } else {
        "type or drag to go to a generation".to_owned()
    };
    let response = ui.add(field).labelled_by(label.id).on_hover_text(hover);
    if response.changed() {
        commands.push(Command::GoTo(wanted));
    }
    if differs {
        ui.label(RichText::new(format!("shown: {shown}")).small().color(ui.visuals().warn_fg_color));
    }
}

fn rule(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let chosen = session.rule().unwrap_or("none");
    let label = ui.label("Rule");
    let list = ComboBox::from_id_salt("rule").selected_text(chosen).width(110.0);
    let response = ui.add_enabled_ui(session.can_step(), |ui| {
        let response = list.show_ui(ui, |ui| {
            let rules =
                session.program().into_iter().flat_map(|program| program.rules.iter().map(move |&r| (program, r)));
            for function in rules.filter_map(|(program, rule)| program.function(rule)) {
                if ui.selectable_label(chosen == function.name, &function.name).clicked() {
                    commands.push(Command::ChooseRule(function.name.clone()));
                }
            }
        });
        response.response.labelled_by(label.id)
    });
    let response = response.inner.on_hover_text("the function that a step applies");
    response.on_disabled_hover_text(match session.program() {
        Some(_) => "the program has no rule",
        None => "the program has errors: its rules are not known",
    });
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
