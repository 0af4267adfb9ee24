//! How things are drawn, in a window over the picture: for those who have put the inspector away.

use eframe::egui::{Align2, Context, Key, Modifiers, Rect, ScrollArea, Window, vec2};

use super::display;
use super::widgets::switch;
use crate::command::{Command, ViewAction};
use crate::session::Session;

/// Points across.
const WIDTH: f32 = 250.0;

/// Shows it, if it is open; where it opens it lies over the `picture`, not over the inspector, which tells the same, and
/// beside it if it would cover most of it.
pub fn show(ctx: &Context, picture: Rect, session: &Session, commands: &mut Vec<Command>) {
    if !session.render_options {
        return;
    }
    let mut open = true;
    let room = picture.height() - 70.0;
    let beside = picture.width() < 1.6 * WIDTH && picture.left() > WIDTH;
    let corner = if beside { picture.left_top() } else { picture.right_top() };
    Window::new("Render options")
        .open(&mut open)
        .pivot(Align2::RIGHT_TOP)
        .default_pos(corner + vec2(-12.0, 12.0))
        .default_width(WIDTH)
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
