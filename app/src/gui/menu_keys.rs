//! Open menus by the keys: arrows walk their entries, Alt with a letter or F10 opens those of the bar.

use eframe::egui::os::OperatingSystem;
use eframe::egui::{Context, Event, FocusDirection, Id, Key, Modifiers, Popup, Response, Ui};

/// For the sheet of keys.
pub const KEYS: &[(&str, &str)] =
    &[("F10", "open the menus"), ("Alt + letter", "open the menu with this letter"), ("arrows", "walk an open menu")];

/// The entries of the open menu, in this pass and in the one before, in their order.
#[derive(Clone, Default)]
struct Entries {
    now: Vec<Id>,
    before: Vec<Id>,
    /// The first of them gets the keys as soon as it is there.
    enter: bool,
    /// What had the keys before a menu was opened by keys.
    back_to: Option<Id>,
}

/// The popups of the bar's menus, in their order.
#[derive(Clone, Default)]
struct Bar(Vec<Id>);

/// Tells of an entry of a menu, which arrows come to if it can be chosen, and which is brought in sight then.
pub fn entry(ui: &Ui, response: &Response) {
    if response.gained_focus() {
        response.scroll_to_me(None);
    }
    if response.enabled() {
        with(ui.ctx(), |entries| entries.now.push(response.id));
    }
}

/// Whether keys mean a menu, and not the picture.
pub fn have_keys(ctx: &Context) -> bool {
    Popup::is_any_open(ctx)
}

/// Walks the open menu; for the beginning of a pass.
pub fn walk(ctx: &Context) {
    let open = Popup::is_any_open(ctx);
    let (entries, enter, back_to) = with(ctx, |entries| {
        entries.before = std::mem::take(&mut entries.now);
        entries.enter &= open;
        let back_to = if open { None } else { entries.back_to.take() };
        (entries.before.clone(), entries.enter && open, back_to)
    });
    if let Some(id) = back_to {
        ctx.memory_mut(|m| m.request_focus(id));
    }
    if !open || entries.is_empty() {
        return;
    }
    let pressed = |key| ctx.input_mut(|i| i.count_and_consume_key(Modifiers::NONE, key)) as isize;
    let (by, home, end) = (pressed(Key::ArrowDown) - pressed(Key::ArrowUp), pressed(Key::Home), pressed(Key::End));
    let focused = ctx.memory(|m| m.focused());
    let at = entries.iter().position(|id| Some(*id) == focused);
    let count = entries.len() as isize;
    let to = match at {
        _ if home > 0 => Some(0),
        _ if end > 0 => Some(count - 1),
        None if enter && by == 0 => Some(0),
        _ if by == 0 => None,
        // The first down is the first entry, the first up the last one.
        None => Some((if by > 0 { by - 1 } else { by }).rem_euclid(count)),
        Some(at) => Some((at as isize + by).rem_euclid(count)),
    };
    if let Some(&id) = to.and_then(|to| entries.get(to as usize)) {
        with(ctx, |entries| entries.enter = false);
        ctx.memory_mut(|m| {
            m.request_focus(id);
            m.move_focus(FocusDirection::None); // egui would go on to what is seen below
        });
    }
}

/// Opens the menus of the bar, which have these letters, and goes from one to the next.
pub fn open(ui: &Ui, letters: &[Key]) {
    let ctx = ui.ctx();
    let bar = ctx.data(|data| data.get_temp::<Bar>(bar_id())).unwrap_or_default().0;
    if bar.len() != letters.len() {
        return; // the first pass
    }
    let now = bar.iter().position(|id| Popup::is_id_open(ctx, *id));
    let pressed = |modifiers, key| ctx.input_mut(|i| i.consume_key(modifiers, key));
    if pressed(Modifiers::NONE, Key::F10) {
        match now {
            Some(_) => Popup::close_all(ctx),
            None => show(ctx, bar[0]),
        }
    }
    // There it types other letters.
    if ctx.os() != OperatingSystem::Mac {
        let exactly = |i: &eframe::egui::InputState| !i.modifiers.shift && !i.modifiers.ctrl;
        let chosen = letters.iter().position(|&key| ctx.input(exactly) && pressed(Modifiers::ALT, key));
        if let Some(i) = chosen {
            ctx.input_mut(|i| i.events.retain(|event| !matches!(event, Event::Text(_))));
            show(ctx, bar[i]);
        }
    }
    if let Some(now) = now {
        let count = |key| ctx.input_mut(|i| i.count_and_consume_key(Modifiers::NONE, key)) as isize;
        let by = count(Key::ArrowRight) - count(Key::ArrowLeft);
        if by != 0 {
            show(ctx, bar[(now as isize + by).rem_euclid(bar.len() as isize) as usize]);
        }
    }
}

fn show(ctx: &Context, popup: Id) {
    let focused = ctx.memory(|m| m.focused());
    let fresh = !Popup::is_any_open(ctx);
    with(ctx, |entries| {
        entries.enter = true;
        entries.now.clear();
        if fresh {
            entries.back_to = focused;
        }
    });
    ctx.memory_mut(|m| {
        if let Some(id) = focused {
            m.surrender_focus(id);
        }
        m.move_focus(FocusDirection::None);
    });
    Popup::open_id(ctx, popup);
    ctx.request_repaint();
}

/// Tells of the bar's menus.
pub fn remember(ui: &Ui, buttons: &[Response]) {
    let popups = buttons.iter().map(Popup::default_response_id).collect();
    ui.data_mut(|data| data.insert_temp(bar_id(), Bar(popups)));
    // The entry that gets the keys is known only now.
    if with(ui.ctx(), |entries| entries.enter) {
        ui.ctx().request_repaint();
    }
}

fn with<R>(ctx: &Context, change: impl FnOnce(&mut Entries) -> R) -> R {
    ctx.data_mut(|data| change(data.get_temp_mut_or_default::<Entries>(Id::unique("entries of the open menu"))))
}

fn bar_id() -> Id {
    Id::unique("menus of the bar")
}
