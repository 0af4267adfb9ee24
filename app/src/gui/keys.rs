//! Keys and dropped files to commands.

use eframe::egui::text_selection::LabelSelectionState;
use eframe::egui::{Context, Event, InputState, Key, KeyboardShortcut, Modifiers};

use crate::command::{self, Command, Inspect, ViewAction};
use crate::navigation::Preset;
use crate::session::Session;

/// Goes on with a walk.
const WALK: KeyboardShortcut = KeyboardShortcut::new(Modifiers::NONE, Key::Period);

/// Takes the keys that mean a command. Those without Ctrl mean themselves while text is being typed; `escape_is_taken` if
/// Escape closes something.
pub fn take(ctx: &Context, session: &Session, escape_is_taken: bool, commands: &mut Vec<Command>) {
    // A menu that is open is walked by keys, and closed by Escape.
    let in_menu = super::menu_keys::have_keys(ctx);
    let (typing, escape_is_taken) = (ctx.egui_wants_keyboard_input() || in_menu, escape_is_taken || in_menu);
    for (shortcut, command) in command::of_hands(session.navigation.preset) {
        // A walk that is watched has the point.
        let walks = *shortcut == WALK && session.inspection.walk.is_some();
        let may = !typing && !walks && command.is_enabled(session);
        if may && ctx.input_mut(|i| consume(i, shortcut)) {
            commands.push(command.clone());
        }
    }
    for command in command::with_keys() {
        for shortcut in command.describe().shortcuts {
            if typing && !command::acts_while_typing(shortcut) {
                continue;
            }
            if escape_is_taken && *command == Command::Stop {
                continue;
            }
            // A key that means nothing now is left to whom it may concern.
            let editing = super::editor::has_keys(ctx);
            let undoes = matches!(command, Command::Undo | Command::Redo);
            let may = command.is_enabled(session) || editing && undoes;
            if !may {
                continue;
            }
            // Other fields have an undo of their own.
            if typing && !editing && undoes {
                continue;
            }
            if ctx.input_mut(|i| consume(i, shortcut)) {
                commands.push(match command {
                    Command::Undo if editing => Command::UndoText,
                    Command::Redo if editing => Command::RedoText,
                    command => command.clone(),
                });
            }
        }
    }
    if let Some(text) = pasted_viewpoint(ctx, session, typing) {
        commands.push(Command::View(ViewAction::Show(text)));
    }
    if !typing {
        // What Escape would stop, goes first.
        let clear = Command::Inspect(Inspect::Clear);
        if !escape_is_taken
            && clear.is_enabled(session)
            && ctx.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape))
        {
            commands.push(clear);
        }
        let copies = ctx.input(|i| i.events.iter().any(|event| matches!(event, Event::Copy)));
        // Text that is selected in a label is meant first.
        if copies && !text_is_selected(ctx) && Command::CopyImage.is_enabled(session) {
            commands.push(Command::CopyImage);
        }
        let digits = [
            Key::Num0,
            Key::Num1,
            Key::Num2,
            Key::Num3,
            Key::Num4,
            Key::Num5,
            Key::Num6,
            Key::Num7,
            Key::Num8,
            Key::Num9,
        ];
        // With other hands they mean something else.
        let free = session.navigation.preset != Preset::Blender;
        for (generation, key) in digits.into_iter().enumerate().filter(|_| free) {
            if ctx.input_mut(|i| consume(i, &KeyboardShortcut::new(Modifiers::NONE, key))) {
                commands.push(Command::GoTo(generation as u64));
            }
        }
    }
}

/// Takes the presses of a key with just these keys held. What counts is what was held when it was pressed: a picture may
/// take longer than somebody holds Shift.
fn consume(input: &mut InputState, shortcut: &KeyboardShortcut) -> bool {
    // On many keyboards above another sign.
    let sign = matches!(shortcut.logical_key, Key::Questionmark | Key::Plus);
    // Shift makes another key of a letter: `S` is not `s`.
    let exact = |held: &Modifiers| {
        let wanted = shortcut.modifiers;
        held.matches_logically(wanted) && (!held.shift || wanted.shift || sign) && (!held.alt || wanted.alt || sign)
    };
    let before = input.events.len();
    input.events.retain(|event| {
        !matches!(event, Event::Key { key, pressed: true, modifiers, .. }
            if *key == shortcut.logical_key && exact(modifiers))
    });
    input.events.len() < before
}

/// Takes a viewpoint that comes from the clipboard: one that was asked for, or one that nobody else can be meant by.
fn pasted_viewpoint(ctx: &Context, session: &Session, typing: bool) -> Option<String> {
    let asked = session.awaits_viewpoint();
    let is_meant = |text: &str| asked || !typing && text.trim_start().starts_with("vv view:");
    ctx.input_mut(|i| {
        let at = i.events.iter().position(|event| matches!(event, Event::Paste(text) if is_meant(text)))?;
        match i.events.remove(at) {
            Event::Paste(text) => Some(text),
            _ => None,
        }
    })
}

/// How many of the events are taken in one frame: a key with Ctrl, which changes what text there is or what is open, comes
/// alone, and what comes after a key that may close a dialog is not for the dialog. Keys held down go together.
pub fn one_after_another(events: &[Event], dialog: bool) -> usize {
    let mut typed = false;
    for (i, event) in events.iter().enumerate() {
        if let Event::Key { key, pressed: true, repeat: false, modifiers, .. } = event {
            if modifiers.command && !modifiers.alt {
                return if typed { i } else { i + 1 };
            }
            if dialog && matches!(key, Key::Enter | Key::Escape) {
                return i + 1;
            }
        }
        typed |= is_typed(event);
    }
    events.len()
}

/// Whether an event comes from the keyboard.
pub fn is_typed(event: &Event) -> bool {
    matches!(event, Event::Key { .. } | Event::Text(_) | Event::Ime(_) | Event::Paste(_) | Event::Copy | Event::Cut)
}

/// Makes something as if nothing pointed at it, if `hidden`: no tooltip opens, and none that is open stays.
pub fn unpointed<R>(ctx: &Context, hidden: bool, make: impl FnOnce() -> R) -> R {
    if !hidden {
        return make();
    }
    let pointer = ctx.input_mut(|i| std::mem::take(&mut i.pointer));
    let made = make();
    ctx.input_mut(|i| i.pointer = pointer);
    made
}

/// Whether the pointer does anything.
pub fn stirs(ctx: &Context) -> bool {
    let is_of_pointer = |event: &Event| {
        matches!(event, Event::PointerMoved(_) | Event::PointerButton { .. } | Event::MouseWheel { .. })
    };
    ctx.input(|i| i.events.iter().any(is_of_pointer))
}

/// Opens what was dropped on the window.
pub fn take_dropped_files(ctx: &Context, commands: &mut Vec<Command>) {
    let paths = ctx.input(|i| i.raw.dropped_files.iter().map(|f| f.path().to_owned()).collect::<Vec<_>>());
    if !paths.is_empty() {
        commands.push(Command::CloseDialog);
    }
    commands.extend(paths.into_iter().map(Command::Open));
}

fn text_is_selected(ctx: &Context) -> bool {
    ctx.plugin_opt::<LabelSelectionState>().is_some_and(|state| state.lock().has_selection())
}
