//! The dialog that asks how large a picture shall be and what is behind it.

use eframe::egui::{
    Align, Button, Context, DragValue, Frame, Grid, Id, Key, Label, Layout, Margin, Modal, RichText, Ui,
};

use crate::command::Command;
use crate::preferences::{Background, PictureOptions};
use crate::session::{Dialog, Purpose, Session};

/// Sizes that are asked for often: pixels across and down.
const SIZES: [(&str, u32, u32); 4] =
    [("HD", 1920, 1080), ("4K", 3840, 2160), ("square", 2048, 2048), ("A4, 300 dpi", 3508, 2480)];

/// Shows it.
pub fn show(ctx: &Context, session: &Session, commands: &mut Vec<Command>) {
    if session.dialog != Some(Dialog::Picture) {
        return;
    }
    let frame = Frame::window(&ctx.global_style()).inner_margin(Margin::same(18));
    let mut save = false;
    let response = Modal::new(Id::unique("save picture")).frame(frame).show(ctx, |ui| {
        ui.set_width(400.0_f32.min(ui.ctx().content_rect().width() - 60.0));
        ui.heading("Save picture");
        ui.add_space(8.0);
        let mut options = session.preferences.picture;
        fields(ui, session, &mut options);
        ui.add_space(8.0);
        let text =
            "The name says the format: .png, or .svg, .eps and .pdf, which are figures of lines and areas for paper.";
        ui.add(Label::new(RichText::new(text).weak()).wrap());
        ui.add_space(12.0);
        ui.horizontal(|ui| {
            save = ui.add(super::widgets::first_choice(ui, "Save…")).clicked();
            if ui.button("Cancel").clicked() {
                commands.push(Command::CloseDialog);
            }
        });
        if options != session.preferences.picture {
            let preferences = crate::preferences::Preferences { picture: options, ..session.preferences };
            commands.push(Command::SetPreferences(preferences));
        }
    });
    let enter = ctx.input(|i| i.key_pressed(Key::Enter)) && ctx.memory(|m| m.focused().is_none());
    if save || enter {
        commands.push(Command::CloseDialog);
        commands.push(Command::Choose(Purpose::SavePicture));
    } else if response.should_close() {
        commands.push(Command::CloseDialog);
    }
}

fn fields(ui: &mut Ui, session: &Session, options: &mut PictureOptions) {
    Grid::new("picture").num_columns(2).min_col_width(90.0).spacing([16.0, 8.0]).show(ui, |ui| {
        ui.with_layout(Layout::top_down(Align::Min), |ui| {
            ui.add_space(2.0);
            ui.label("Size");
        });
        ui.vertical(|ui| {
            let seen = session.picture_size(&PictureOptions { as_seen: true, ..*options });
            let text = format!("as in the window, {} × {}", seen.width, seen.height);
            choice(ui, &mut options.as_seen, true, &text);
            ui.horizontal(|ui| {
                choice(ui, &mut options.as_seen, false, "in pixels");
                let before = (options.width, options.height);
                let range = 1..=PictureOptions::LONGEST;
                let width = ui.add(DragValue::new(&mut options.width).range(range.clone()).speed(4.0));
                width.on_hover_text("pixels across").accessible_name("Width");
                ui.label("×");
                let height = ui.add(DragValue::new(&mut options.height).range(range).speed(4.0));
                height.on_hover_text("pixels down").accessible_name("Height");
                options.as_seen &= before == (options.width, options.height);
            });
            ui.horizontal_wrapped(|ui| {
                for (name, width, height) in SIZES {
                    let on = !options.as_seen && (options.width, options.height) == (width, height);
                    let tip = format!("{width} × {height}");
                    let size = Button::new(name).small().selected(on);
                    if ui.add(size).on_hover_text(tip).clicked() {
                        *options = PictureOptions { as_seen: false, width, height, ..*options };
                    }
                }
            });
        });
        ui.end_row();
        ui.label("Background");
        ui.horizontal_wrapped(|ui| {
            let of_style = session.backdrop().map(|[r, g, b]| format!("of the style, #{r:02x}{g:02x}{b:02x}"));
            choice(ui, &mut options.background, Background::AsSeen, of_style.as_deref().unwrap_or("as seen"));
            choice(ui, &mut options.background, Background::White, "white");
            choice(ui, &mut options.background, Background::Transparent, "transparent");
        });
        ui.end_row();
    });
}

/// One of several values.
fn choice<T: PartialEq>(ui: &mut Ui, chosen: &mut T, value: T, text: &str) {
    if super::widgets::radio(ui, *chosen == value, text).clicked() {
        *chosen = value;
    }
}
