//! How the mesh is drawn, and what is shown on it.

use eframe::egui::{CollapsingHeader, ComboBox, DragValue, Grid, RichText, Slider, Ui};
use vv::io::COLOR;
use vv::mesh::Type;

use super::widgets::{button, heading_with, switch, tooltip};
use crate::annotate::{Annotations, Arrows, Label, Quantity};
use crate::command::Command;
use crate::scene::{Axis, Cut, Style, Surface};
use crate::session::Session;

/// Shows it.
pub fn show(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    heading_with(ui, "Display", |ui| button(ui, session, commands, Command::Fit));
    Grid::new("display").num_columns(2).spacing([16.0, 5.0]).show(ui, |ui| {
        switch(ui, session, commands, Command::Faces);
        switch(ui, session, commands, Command::Smooth);
        ui.end_row();
        switch(ui, session, commands, Command::Edges);
        switch(ui, session, commands, Command::Vertices);
        ui.end_row();
    });
    switch(ui, session, commands, Command::Control);
    ui.add_space(2.0);
    group(ui, "Colours", true, |ui| colors(ui, session, commands));
    let Annotations { labels, arrows, .. } = &session.document.annotations;
    let open = *labels != Label::Nothing || *arrows != Arrows::Nothing;
    group(ui, "Labels and arrows", open, |ui| labels_and_arrows(ui, session, commands));
    group(ui, "Surface", false, |ui| surface(ui, session, commands));
    group(ui, "Cut", session.document.style.cut.on, |ui| cut(ui, session, commands));
    ui.add_space(2.0);
}

/// A part that can be folded away; `open` until somebody does.
fn group(ui: &mut Ui, title: &str, open: bool, show: impl FnOnce(&mut Ui)) {
    CollapsingHeader::new(title).id_salt(("display", title)).default_open(open).show(ui, show);
}

fn colors(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let Annotations { color_by, range, .. } = &session.document.annotations;
    let properties = session.frame().map_or(&[][..], |frame| frame.mesh.vertex_properties());
    // Vertices that have colours of their own show them where nothing else is asked for.
    let colored = properties.iter().any(|p| p.name == COLOR && p.values.ty() == Type::Vec);
    let title = |quantity: &Quantity| match quantity {
        Quantity::Plain if colored => "its own colours".to_owned(),
        quantity => quantity.title(),
    };
    let combo = ComboBox::from_id_salt("colour by")
        .selected_text(title(color_by))
        .truncate()
        .height(420.0)
        .width(ui.available_width());
    let response = combo.show_ui(ui, |ui| {
        for (_, quantity) in &Quantity::NAMED {
            let command = Command::ColorBy(quantity.clone());
            let entry = ui.selectable_label(quantity == color_by, title(quantity));
            if entry.on_hover_ui(|ui| tooltip(ui, &command)).clicked() {
                commands.push(command);
            }
        }
        for property in properties.iter().filter(|p| p.values.ty() != Type::Vertex) {
            let is_vec = property.values.ty() == Type::Vec;
            let mut offer = |quantity: Quantity, tooltip: &str| {
                if ui.selectable_label(quantity == *color_by, quantity.title()).on_hover_text(tooltip).clicked() {
                    commands.push(Command::ColorBy(quantity));
                }
            };
            offer(
                Quantity::Property(property.name.clone()),
                if is_vec { "show the length of this property" } else { "show this property" },
            );
            if is_vec {
                offer(Quantity::Color(property.name.clone()), "show this property as red, green and blue");
            }
        }
    });
    response.response.on_hover_text("what the surface is coloured by").accessible_name("Colour by");
    compared(ui, session, commands);
    let legend = session.colors().and_then(Result::ok).map(|tint| tint.legend.clone());
    let shows_range = session.colors().and_then(Result::ok).is_some_and(|tint| tint.has_range());
    if let Some(legend) = legend.filter(|_| shows_range) {
        let [low, high] = range.unwrap_or(legend.range);
        // Enough digits for the range, no more: they would take the room of the numbers.
        let digits = (3.0 - (high - low).abs().log10().floor()).clamp(0.0, 12.0) as usize;
        let speed = legend.extremes.map_or(0.01, |[a, b]| ((b - a) / 300.0).max(1e-9));
        let set = |range| Command::SetAnnotations(Annotations { range, ..session.document.annotations.clone() });
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            let (mut from, mut to) = (low, high);
            let first = ui.add(DragValue::new(&mut from).speed(speed).max_decimals(digits));
            let first = first.on_hover_text("the number at the lower end of the colours").accessible_name("From");
            ui.label("to");
            let last = ui.add(DragValue::new(&mut to).speed(speed).max_decimals(digits));
            let last = last.on_hover_text("the number at the upper end of the colours").accessible_name("To");
            if (first.changed() || last.changed()) && from < to {
                commands.push(set(Some([from, to])));
            }
            let auto = ui.add_enabled(range.is_some(), eframe::egui::Button::new("Auto").small());
            if auto.on_hover_text("from what most numbers lie between").clicked() {
                commands.push(set(None));
            }
        });
    }
}

/// The generation that the one shown is compared with, where change is shown.
fn compared(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let before = session.shown_generation().saturating_sub(1);
    let mut since = match session.document.annotations.color_by {
        Quantity::Change => before,
        Quantity::Since(generation) => generation,
        _ => return,
    };
    ui.horizontal_wrapped(|ui| {
        // Short, and broken in a narrow panel, which would grow else and move the picture.
        let label = ui.label("since gen.");
        let field = DragValue::new(&mut since).range(0..=session.last_reached()).speed(0.05);
        let field = ui.add(field.update_while_editing(false)).labelled_by(label.id);
        if field.on_hover_text("which generation the one shown is compared with").changed() {
            commands.push(Command::ColorBy(Quantity::Since(since)));
        }
        let last = ui.add_enabled(
            session.document.annotations.color_by != Quantity::Change,
            eframe::egui::Button::new("Last step").small(),
        );
        if last.on_hover_text("what changed in the last step, in each generation").clicked() {
            commands.push(Command::ColorBy(Quantity::Change));
        }
    });
}

fn labels_and_arrows(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let annotations = &session.document.annotations;
    let properties = session.frame().map_or(&[][..], |frame| frame.mesh.vertex_properties());
    let mut row = |ui: &mut Ui, title: &str, name: &str, shown: String, offers: Vec<(Command, String)>| {
        ui.horizontal(|ui| {
            ui.add_sized([48.0, 20.0], eframe::egui::Label::new(title));
            let combo = ComboBox::from_id_salt(name).selected_text(shown).truncate().height(420.0);
            let response = combo.width(ui.available_width()).show_ui(ui, |ui| {
                for (command, title) in offers {
                    let entry = ui.selectable_label(command.is_on(session) == Some(true), title);
                    if entry.on_hover_text(command.describe().tooltip).clicked() {
                        commands.push(command);
                    }
                }
            });
            response.response.accessible_name(name);
        });
    };
    let mut labels: Vec<_> = Label::NAMED.map(|label| (Command::LabelBy(label.clone()), label.title())).into();
    let property = |p: &vv::mesh::Property| (Command::LabelBy(Label::Property(p.name.clone())), p.name.clone());
    labels.extend(properties.iter().map(property));
    row(ui, "Labels", "Label by", annotations.labels.title(), labels);
    let mut arrows: Vec<_> = Arrows::NAMED.map(|arrows| (Command::ArrowsOf(arrows.clone()), arrows.title())).into();
    let property = |p: &vv::mesh::Property| (Command::ArrowsOf(Arrows::Property(p.name.clone())), p.name.clone());
    arrows.extend(properties.iter().filter(|p| p.values.ty() == Type::Vec).map(property));
    row(ui, "Arrows", "Arrows of", annotations.arrows.title(), arrows);
    if annotations.arrows != Arrows::Nothing {
        let mut length = annotations.arrow_length;
        ui.spacing_mut().slider_width = (ui.available_width() - 66.0).max(40.0);
        let slider = ui.add(Slider::new(&mut length, 0.1..=10.0).logarithmic(true).max_decimals(2));
        let slider = slider.on_hover_text("how long arrows are, measured by the edges");
        if slider.accessible_name("Length of arrows").changed() {
            commands.push(Command::SetAnnotations(Annotations { arrow_length: length, ..annotations.clone() }));
        }
        if let Some(every) = session.arrows().map(|set| set.every).filter(|every| *every > 1) {
            ui.weak(format!("one of {every} is drawn"));
        }
    }
}

fn surface(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    for surface in [Surface::Lights, Surface::ReflectionLines, Surface::Isophotes] {
        let command = Command::ShowBy(surface);
        let on = session.document.style.surface == surface;
        if super::widgets::radio(ui, on, command.describe().label).on_hover_ui(|ui| tooltip(ui, &command)).clicked() {
            commands.push(command);
        }
    }
    if session.shows_flat_lines() {
        ui.add(eframe::egui::Label::new(RichText::new("flat faces break the lines:").weak()).wrap());
        if ui.link("smooth them").on_hover_ui(|ui| tooltip(ui, &Command::Smooth)).clicked() {
            commands.push(Command::Smooth);
        }
    }
    ui.add_space(2.0);
    switch(ui, session, commands, Command::Occlusion);
    switch(ui, session, commands, Command::Grid);
    switch(ui, session, commands, Command::Axes);
}

fn cut(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let style = session.document.style;
    let mut cut = style.cut;
    switch(ui, session, commands, Command::Cut);
    ui.add_enabled_ui(cut.on, |ui| {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            for (axis, name, tooltip) in [
                (Axis::X, "x", "cut across the x axis"),
                (Axis::Y, "y", "cut across the y axis"),
                (Axis::Z, "z", "cut across the z axis"),
                (Axis::View, "view", "cut across the line of sight"),
            ] {
                let choice = ui.selectable_label(cut.across == axis, name).on_hover_text(tooltip);
                if choice.accessible_name(format!("Cut across {name}")).clicked() {
                    cut.across = axis;
                }
            }
            super::widgets::check_box(ui, &mut cut.flipped, "other side")
                .on_hover_text("cut away what lies on the other side");
        });
        ui.spacing_mut().slider_width = (ui.available_width() - 66.0).max(40.0);
        let slider = ui.add(Slider::new(&mut cut.position, -1.0..=1.0).max_decimals(3));
        slider
            .on_hover_text("where it is cut, from one end of the mesh to the other")
            .accessible_name("Place of the cut");
    });
    if cut != style.cut {
        commands.push(Command::SetStyle(Style { cut: Cut { on: true, ..cut }, ..style }));
    }
}
