//! What is selected: properties, measures, the ring, the walk.

use eframe::egui::{
    Align, Color32, Context, Frame as UiFrame, Grid, Id, Key, Layout, Margin, Modal, RichText, TextEdit, TextStyle, Ui,
    vec2,
};
use vv::mesh::{Mesh, Value, Vertex};

use super::ring::{self, vertex_link};
use super::widgets::{Icon, button, first_choice, heading, heading_with, icon_button, menu_entry};
use crate::annotate::{Label, Quantity};
use crate::command::{Command, Inspect};
use crate::inspect::measure::{FaceMeasure, angle, dihedral, short};
use crate::inspect::selection::Item;
use crate::inspect::walk::{Walk, face_left_of};
use crate::preferences::Unit;
use crate::session::{Dialog, Session, Walking};
use crate::worker::Frame;

/// Corners of a face that are named.
const CORNERS: usize = 40;
/// Steps of a walk that are listed.
const STEPS: usize = 8;

/// Shows it.
pub fn show(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let Some(frame) = session.frame() else { return };
    let (selected, gone) = session.selection();
    let nothing = selected.is_empty() && gone.is_empty() && session.inspection.walk.is_none();
    let ask = |ui: &mut Ui| button(ui, session, commands, Command::Inspect(Inspect::AskForVertex));
    if nothing {
        heading_with(ui, "Selection", ask);
    } else {
        heading(ui, "Selection");
    }
    if nothing {
        ui.add(
            eframe::egui::Label::new(RichText::new("click a vertex, an edge or a face; Shift selects more").weak())
                .wrap(),
        );
        super::mask::show(ui, session, commands);
        ui.separator();
        return;
    }
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for (wish, text) in [(Inspect::Fly, "Fly there"), (Inspect::Clear, "Clear"), (Inspect::Mask, "Mask")] {
            let command = Command::Inspect(wish);
            let button = eframe::egui::Button::new(text).selected(command.is_on(session) == Some(true));
            let response =
                ui.add_enabled(command.is_enabled(session), button).accessible_name(command.describe().label);
            if response.on_hover_ui(|ui| super::widgets::tooltip(ui, &command)).clicked() {
                commands.push(command);
            }
        }
    });
    if let Some(walking) = &session.inspection.walk {
        walk(ui, session, walking, commands);
    }
    match selected[..] {
        [Item::Vertex(v)] => vertex(ui, session, frame, v, commands),
        [Item::Edge(ends)] => edge(ui, session, frame, ends, commands),
        [Item::Face(side)] => face(ui, session, frame, side, commands),
        _ => several(ui, session, frame, &selected, commands),
    }
    if !matches!(selected[..], [Item::Vertex(_)]) {
        super::mask::show(ui, session, commands);
    }
    for (generation, item) in gone {
        ui.weak(format!("{item} of generation {generation} is not in this one"));
    }
    ui.separator();
}

fn row(ui: &mut Ui, name: &str, value: impl Into<String>) {
    row_with(ui, name, value, |_| {});
}

/// The same with more in its menu than to copy it.
fn row_with(ui: &mut Ui, name: &str, value: impl Into<String>, more: impl FnOnce(&mut Ui)) {
    let value = value.into();
    let line = ui.text_style_height(&TextStyle::Body);
    let above = ((ui.spacing().interact_size.y - line) / 2.0).max(0.0);
    // A name stands beside the first line of its value.
    let label = ui.with_layout(Layout::top_down(Align::Min), |ui| {
        ui.add_space(above);
        ui.add(eframe::egui::Label::new(RichText::new(name).weak()).extend())
    });
    let label = label.inner;
    let room = ui.available_width();
    let font = TextStyle::Body.resolve(ui.style());
    let wide = |text: &str| ui.painter().layout_no_wrap(text.to_owned(), font.clone(), Color32::PLACEHOLDER).size().x;
    // A vector that has no room has a line for each number: no exponent is cut.
    let is_long = !ui.is_sizing_pass() && wide(&value) > room; // before the table knows its columns nothing has room
    let lines = if is_long { value.split(", ").count() } else { 1 };
    let (label_of, layout) = match lines > 1 {
        true => (
            eframe::egui::Label::new(value.replace(", ", ",\n")).extend().halign(Align::Max),
            Layout::top_down(Align::Max),
        ),
        false => (eframe::egui::Label::new(&value).truncate(), Layout::right_to_left(Align::Center)),
    };
    // As high as its lines, whatever stood there before.
    let size = vec2(room, 2.0 * above + lines as f32 * line);
    let response = ui.allocate_ui_with_layout(size, layout, |ui| {
        if lines > 1 {
            ui.add_space(above);
        }
        ui.add(label_of).labelled_by(label.id)
    });
    response.inner.context_menu(|ui| {
        ui.set_min_width(170.0);
        if menu_entry(ui, true, "Copy value", &value) {
            ui.ctx().copy_text(value.clone());
        }
        if menu_entry(ui, true, "Copy name and value", &format!("{name} {value}")) {
            ui.ctx().copy_text(format!("{name} {value}"));
        }
        more(ui);
    });
    ui.end_row();
}

/// What the menu of a property's row offers for the whole mesh; and to go to the vertex that it names.
fn of_property(ui: &mut Ui, session: &Session, name: &str, value: Option<Value>, commands: &mut Vec<Command>) {
    ui.separator();
    if let Some(Value::Vertex(Some(v))) = value {
        let here = session.frame().is_some_and(|frame| frame.mesh.set.contains(v));
        if menu_entry(ui, here, &format!("Fly to {v}"), "select this vertex and bring it close") {
            commands.push(Command::Inspect(Inspect::Select(Item::Vertex(v))));
            commands.push(Command::Inspect(Inspect::Fly));
        }
    } else if menu_entry(ui, true, "Colour by it", "colour the surface by this property") {
        commands.push(Command::ColorBy(Quantity::Property(name.to_owned())));
    }
    if menu_entry(ui, true, "Label with it", "write at all vertices what this property is there") {
        commands.push(Command::LabelBy(Label::Property(name.to_owned())));
    }
}

fn table(ui: &mut Ui, name: &str, rows: impl FnOnce(&mut Ui)) {
    Grid::new(name).num_columns(2).spacing([12.0, 3.0]).show(ui, rows);
}

/// A value as it is read at a glance.
#[must_use]
pub fn value(value: Value) -> String {
    match value {
        Value::Bool(b) => b.to_string(),
        Value::Int(i) => i.to_string(),
        Value::Double(x) => short(x),
        Value::Vec(v) => format!("({}, {}, {})", short(v.x), short(v.y), short(v.z)),
        Value::Vertex(Some(v)) => v.to_string(),
        Value::Vertex(None) => "null".to_owned(),
    }
}

fn vertex(ui: &mut Ui, session: &Session, frame: &Frame, v: Vertex, commands: &mut Vec<Command>) {
    let (mesh, generation) = (&frame.mesh, frame.request.generation);
    table(ui, "of the vertex", |ui| {
        row(ui, "Vertex", v.to_string());
        row(ui, "Born in", format!("generation {}", frame.lineage.birth(v, generation)));
        let ring = mesh.ring(v);
        let gaps = match ring.gaps() {
            0 => String::new(),
            1 => ", 1 gap".to_owned(),
            n => format!(", {n} gaps"),
        };
        row(ui, "Valence", format!("{}{gaps}", ring.valence()));
        row(ui, "pos", value(Value::Vec(mesh.position(v))));
        for (i, property) in mesh.vertex_properties().iter().enumerate() {
            let found = mesh.vertex_value(i, v);
            row_with(ui, &property.name, found.map_or_else(String::new, value), |ui| {
                of_property(ui, session, &property.name, found, commands);
            });
        }
    });
    super::mask::show(ui, session, commands);
    ring::show(ui, session, frame, v, commands);
}

fn edge(ui: &mut Ui, session: &Session, frame: &Frame, ends: [Vertex; 2], commands: &mut Vec<Command>) {
    let (mesh, [p, q]) = (&frame.mesh, ends);
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.weak("Edge");
        vertex_link(ui, session, commands, p, &p.to_string(), None);
        ui.label("–");
        vertex_link(ui, session, commands, q, &q.to_string(), None);
    });
    table(ui, "of the edge", |ui| {
        row(ui, "Length", session.preferences.unit.length(mesh.position(p).distance(mesh.position(q))));
        let dihedral = dihedral(mesh, ends).map_or("–".to_owned(), |a| format!("{}°", short(a)));
        row(ui, "Dihedral angle", dihedral);
        for (side, edge) in [("Face to the left", [p, q]), ("Face to the right", [q, p])] {
            let face =
                face_left_of(mesh, edge).map_or("none".to_owned(), |corners| format!("{} corners", corners.len()));
            row(ui, side, face);
        }
        for (i, property) in mesh.edge_properties().iter().enumerate() {
            let text = mesh.edge_value(i, p, q).map_or_else(String::new, value);
            row(ui, &property.name, text);
        }
        if !mesh.ring(p).contains(Some(q)) || !mesh.ring(q).contains(Some(p)) {
            row(
                ui,
                "One way",
                if mesh.ring(p).contains(Some(q)) { format!("{p} → {q}") } else { format!("{q} → {p}") },
            );
        }
    });
    walk_buttons(ui, session, commands);
}

fn face(ui: &mut Ui, session: &Session, frame: &Frame, side: [Vertex; 2], commands: &mut Vec<Command>) {
    let mesh = &frame.mesh;
    let corners = Item::Face(side).corners(mesh);
    let points: Vec<_> = corners.iter().map(|&v| mesh.position(v)).collect();
    let (m, unit) = (FaceMeasure::of(&points), session.preferences.unit);
    table(ui, "of the face", |ui| {
        row(ui, "Face", format!("{} corners", corners.len()));
        row(ui, "Area", unit.area(m.area));
        row(ui, "Perimeter", unit.length(m.perimeter));
        // What rounding leaves is none.
        row(ui, "Off its plane", unit.length(if m.off_plane <= 1e-12 * m.radius { 0.0 } else { m.off_plane }));
    });
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 5.0;
        for &v in corners.iter().take(CORNERS) {
            vertex_link(ui, session, commands, v, &v.to_string(), None);
        }
        if corners.len() > CORNERS {
            ui.weak(format!("… {} more", corners.len() - CORNERS));
        }
    });
    walk_buttons(ui, session, commands);
}

fn walk_buttons(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    if session.inspection.walk.is_none()
        && let Some(corner) = session.corner()
        && ui.button("Walk around").on_hover_text("Edmonds' walk, arrow by arrow").clicked()
    {
        commands.push(Command::Inspect(Inspect::Walk(corner)));
    }
}

fn several(ui: &mut Ui, session: &Session, frame: &Frame, selected: &[Item], commands: &mut Vec<Command>) {
    let mesh = &frame.mesh;
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 5.0;
        for item in selected {
            match *item {
                Item::Vertex(v) => {
                    vertex_link(ui, session, commands, v, &v.to_string(), None);
                }
                item => {
                    if ui.link(item.to_string()).clicked() {
                        commands.push(Command::Inspect(Inspect::Select(item)));
                    }
                }
            }
        }
    });
    let vertices: Option<Vec<Vertex>> = selected
        .iter()
        .map(|item| match item {
            Item::Vertex(v) => Some(*v),
            _ => None,
        })
        .collect();
    match vertices.as_deref() {
        Some(&[a, b]) => distance(ui, mesh, session.preferences.unit, [a, b]),
        Some(&[a, b, c]) => triangle(ui, mesh, session.preferences.unit, [a, b, c]),
        _ => {}
    }
}

fn distance(ui: &mut Ui, mesh: &Mesh, unit: Unit, [a, b]: [Vertex; 2]) {
    let between = mesh.position(b) - mesh.position(a);
    let named = |p: Vertex, q: Vertex| mesh.ring(p).contains(Some(q));
    table(ui, "of two vertices", |ui| {
        row(ui, "Distance", unit.length(between.length()));
        // In rows of their own they have room also in a narrow panel.
        for (axis, along) in [("x", between.x), ("y", between.y), ("z", between.z)] {
            row(ui, &format!("Along {axis}"), short(along));
        }
        let neighbours = match (named(a, b), named(b, a)) {
            (true, true) => "yes".to_owned(),
            (true, false) => format!("{a} → {b} only"),
            (false, true) => format!("{b} → {a} only"),
            (false, false) => "no".to_owned(),
        };
        row(ui, "Neighbours", neighbours);
    });
}

fn triangle(ui: &mut Ui, mesh: &Mesh, unit: Unit, [a, b, c]: [Vertex; 3]) {
    let [p, q, r] = [a, b, c].map(|v| mesh.position(v));
    let degrees = |angle: Option<f64>| angle.map_or("–".to_owned(), |x| format!("{}°", short(x)));
    table(ui, "of three vertices", |ui| {
        row(ui, &format!("Angle at {b}"), degrees(angle(p, q, r)));
        row(ui, &format!("Angle at {a}"), degrees(angle(r, p, q)));
        row(ui, &format!("Angle at {c}"), degrees(angle(q, r, p)));
        row(ui, "Area", unit.area(FaceMeasure::of(&[p, q, r]).area));
    });
}

/// The walk: buttons, the rules used so far, how it ends.
fn walk(ui: &mut Ui, session: &Session, walking: &Walking, commands: &mut Vec<Command>) {
    let Walking { walk, at, .. } = walking;
    heading(ui, "Edmonds' walk");
    let sense = "the paper's rule: clockwise, with the face on the right; faces are listed the other way round";
    ui.add(eframe::egui::Label::new(RichText::new(sense).weak()).wrap());
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let playing = walking.playing.is_some();
        let mut press = |icon, wish: Inspect| {
            let command = Command::Inspect(wish);
            let response = icon_button(ui, icon, command.describe().label, command.is_enabled(session), None);
            if response.on_hover_ui(|ui| super::widgets::tooltip(ui, &command)).clicked() {
                commands.push(command);
            }
        };
        press(Icon::Back, Inspect::WalkBack);
        press(Icon::Step, Inspect::WalkOn);
        press(if playing { Icon::Pause } else { Icon::Play }, Inspect::PlayWalk);
        press(Icon::Stop, Inspect::EndWalk);
        ui.weak(format!("{at} of {}", walk.arrows()));
    });
    let first = at.saturating_sub(STEPS);
    if first > 0 {
        ui.weak(format!("… {first} before"));
    }
    for i in first..*at {
        rule(ui, session, walk, i, i + 1 == *at, commands);
    }
    if *at == walk.arrows() {
        let color = if walk.is_broken() { ui.visuals().error_fg_color } else { ui.visuals().text_color() };
        ui.add(eframe::egui::Label::new(RichText::new(walk.conclusion()).color(color).strong()).wrap());
    }
    ui.add_space(4.0);
}

fn rule(ui: &mut Ui, session: &Session, walk: &Walk, i: usize, current: bool, commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 1.0);
        let number = RichText::new(format!("{}.", i + 1));
        ui.label(if current { number.strong() } else { number.weak() });
        ring::text_with_vertices(ui, session, commands, &walk.rule(i), Some(session.shown_generation()));
    });
}

/// Asks for numbers of vertices.
pub fn ask(ctx: &Context, session: &mut Session, commands: &mut Vec<Command>) {
    let most = session.frame().map_or(0, |frame| frame.mesh.vertex_count());
    let Some(Dialog::SelectVertex { text }) = &mut session.dialog else { return };
    let frame = UiFrame::window(&ctx.global_style()).inner_margin(Margin::same(18));
    let mut chosen = None;
    let response = Modal::new(Id::unique("select vertex")).frame(frame).show(ctx, |ui| {
        ui.set_width(320.0_f32.min(ui.ctx().content_rect().width() - 60.0));
        ui.heading("Select vertex");
        ui.add_space(4.0);
        let label = ui.label(format!("Numbers from v1 to v{most}; two measure a distance, three an angle."));
        let field =
            ui.add(TextEdit::singleline(text).hint_text(super::widgets::hint("v12")).desired_width(f32::INFINITY));
        let field = field.labelled_by(label.id);
        let entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
        if !field.has_focus() && !field.lost_focus() {
            field.request_focus();
        }
        field.accessible_name("Numbers of vertices");
        let numbers = numbers(text);
        ui.add_space(8.0);
        ui.horizontal(|ui| {
            let able = numbers.is_some();
            let select = ui.add_enabled_ui(able, |ui| ui.add(first_choice(ui, "Select"))).inner.clicked();
            if (select || entered) && able {
                chosen = numbers;
            }
            if ui.button("Cancel").clicked() {
                commands.push(Command::CloseDialog);
            }
        });
    });
    if response.should_close() {
        commands.push(Command::CloseDialog);
    }
    if let Some(numbers) = chosen {
        commands.push(Command::CloseDialog);
        commands.push(Command::Inspect(Inspect::SelectNumbers(numbers)));
    }
}

/// `v3 v12`, `3, 12`.
fn numbers(text: &str) -> Option<Vec<u64>> {
    let words = text.split(|c: char| c.is_whitespace() || c == ',').filter(|word| !word.is_empty());
    let numbers: Option<Vec<u64>> = words.map(|word| word.trim_start_matches(['v', 'V']).parse().ok()).collect();
    numbers.filter(|numbers| !numbers.is_empty() && numbers.len() <= crate::inspect::selection::MOST)
}
