//! How things are drawn, in a window over the picture: for those who have put the inspector away.

use eframe::egui::{Align2, Context, Key, Modifiers, ScrollArea, Window, vec2};

use super::display;
use super::widgets::switch;
use crate::command::{Command, ViewAction};
use crate::session::Session;

/// Shows it, if it is open.
pub fn show(ctx: &Context, session: &Session, commands: &mut Vec<Command>) {
    if !session.render_options {
        return;
    }
    let mut open = true;
    let room = ctx.content_rect().height() - 190.0;
    Window::new("Render options")
        .open(&mut open)
        .pivot(Align2::RIGHT_TOP)
        .default_pos(ctx.content_rect().right_top() + vec2(-24.0, 100.0))
        .default_width(250.0)
        .resizable(false)
        .show(ctx, |ui| {
            ScrollArea::vertical().max_height(room.max(160.0)).show(ui, |ui| {
                display::show(ui, session, commands);
                switch(ui, session, commands, Command::View(ViewAction::Orthographic));
            });
        });
    let typing = ctx.egui_wants_keyboard_input();
    let escaped = !typing && ctx.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape));
    if !open || escaped {
        commands.push(Command::View(ViewAction::RenderOptions));
    }
}
