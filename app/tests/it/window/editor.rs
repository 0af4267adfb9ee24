//! Writing programs.

use super::*;
use app::command::{Reload, TextAction};

/// The window with a text in the editor, the cursor at its end and the keys with it.
fn editing(text: &str) -> Harness<'static, App> {
    let mut window = octahedron();
    write(&mut window, text);
    window
}

fn type_text(window: &mut Harness<'static, App>, text: &str) {
    window.get_by_label("Program text").type_text(text);
    window.run_steps(2);
}

fn keys(window: &mut Harness<'static, App>, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    window.run_steps(2);
}

fn text<'w>(window: &'w Harness<'static, App>) -> &'w str {
    &window.state().session().document.program.text
}

fn act(window: &mut Harness<'static, App>, action: TextAction) {
    window.state_mut().apply(Command::Text(action));
    window.run_steps(3);
}

const RULE: &str = "void f(mesh& S) {\n}\n";

#[test]
fn typing_is_undone_and_redone_word_for_word() {
    let mut window = editing(RULE);
    for letter in ["/", "/", "a"] {
        type_text(&mut window, letter);
    }
    keys(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(text(&window), RULE, "letters typed together go together");
    keys(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    assert_eq!(text(&window), format!("{RULE}//a"));
    // The cursor is where the text came back: typing goes on there.
    type_text(&mut window, "b");
    assert_eq!(text(&window), format!("{RULE}//ab"));
}

#[test]
fn in_the_editor_only_the_text_is_undone_elsewhere_what_came_last() {
    let mut window = editing(RULE);
    type_text(&mut window, "//x");
    window.state_mut().apply(Command::Step);
    settle(&mut window);
    keys(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(text(&window), RULE);
    assert_eq!(window.state().session().document.generation, 1, "the step stays");
    keys(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    window.state_mut().apply(Command::Undo);
    settle(&mut window);
    assert_eq!((text(&window), window.state().session().document.generation), (format!("{RULE}//x").as_str(), 0));
    window.state_mut().apply(Command::Undo);
    settle(&mut window);
    assert_eq!(text(&window), RULE);
    window.state_mut().apply(Command::Redo);
    window.state_mut().apply(Command::Redo);
    settle(&mut window);
    assert_eq!((text(&window), window.state().session().document.generation), (format!("{RULE}//x").as_str(), 1));
}

#[test]
fn parameters_mesh_and_steps_are_undone() {
    let mut window = editing("param double w = 0.5 in [0, 1];\nvoid f(mesh& S) { forall v in S v$pos *= w; }\n");
    let cube = MeshSource::BuiltIn("cube.obj".to_owned());
    window.state_mut().apply(Command::UseMesh(cube.clone()));
    window.state_mut().apply(Command::Step);
    for value in [0.6, 0.7, 0.8] {
        window.state_mut().apply(Command::SetParam("w".to_owned(), vv::mesh::Value::Double(value)));
    }
    settle(&mut window);
    window.state_mut().apply(Command::Undo);
    assert!(window.state().session().document.params.is_empty(), "a slider that moves is one change");
    window.state_mut().apply(Command::Undo);
    assert_eq!(window.state().session().document.generation, 0);
    window.state_mut().apply(Command::Undo);
    assert_ne!(window.state().session().document.mesh, cube);
    for _ in 0..3 {
        window.state_mut().apply(Command::Redo);
    }
    settle(&mut window);
    let document = &window.state().session().document;
    assert_eq!((&document.mesh, document.generation, document.params.len()), (&cube, 1, 1));
    window.state_mut().apply(Command::OpenExample("loop.vv"));
    window.run_steps(2);
    assert!(window.state().session().dialog.is_some(), "unsaved text is asked about first");
}

#[test]
fn enter_and_braces_keep_the_indentation() {
    let mut window = editing("void f(mesh& S) {");
    keys(&mut window, Modifiers::NONE, Key::Enter);
    type_text(&mut window, "forall v in S {");
    keys(&mut window, Modifiers::NONE, Key::Enter);
    type_text(&mut window, "v$pos *= 2.0;");
    keys(&mut window, Modifiers::NONE, Key::Enter);
    type_text(&mut window, "}");
    keys(&mut window, Modifiers::NONE, Key::Enter);
    type_text(&mut window, "}");
    assert_eq!(text(&window), "void f(mesh& S) {\n  forall v in S {\n    v$pos *= 2.0;\n  }\n}");
}

#[test]
fn enter_ends_lines_that_begin_at_the_margin() {
    let mut window = editing("// one");
    keys(&mut window, Modifiers::NONE, Key::Enter);
    type_text(&mut window, "// two");
    keys(&mut window, Modifiers::NONE, Key::Enter);
    keys(&mut window, Modifiers::NONE, Key::Enter);
    type_text(&mut window, "// three");
    assert_eq!(text(&window), "// one\n// two\n\n// three");
}

#[test]
fn lines_become_comments_and_code_again() {
    let mut window = editing("a;\nb;");
    keys(&mut window, Modifiers::COMMAND, Key::A);
    keys(&mut window, Modifiers::COMMAND, Key::Slash);
    assert_eq!(text(&window), "// a;\n// b;");
    keys(&mut window, Modifiers::COMMAND, Key::Slash);
    assert_eq!(text(&window), "a;\nb;");
    keys(&mut window, Modifiers::NONE, Key::Tab);
    assert_eq!(text(&window), "  a;\n  b;");
    keys(&mut window, Modifiers::SHIFT, Key::Tab);
    assert_eq!(text(&window), "a;\nb;");
}

#[test]
fn what_can_stand_at_the_cursor_is_offered_and_chosen() {
    let mut window = editing("void f(mesh& S) { ");
    type_text(&mut window, "syn");
    window.get_by_label("synchronize");
    window.get_by_label("synchronise");
    keys(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(text(&window), "void f(mesh& S) { synchronize");
    assert!(window.query_by_label("synchronise").is_none(), "the list is gone");
    type_text(&mut window, " S; forall v in S v$");
    window.get_by_label("pos");
    keys(&mut window, Modifiers::NONE, Key::Escape);
    assert!(window.query_by_label("pos").is_none());
    assert!(window.get_by_label("Program text").is_focused(), "Escape has closed the list only");
    type_text(&mut window, "pos += no");
    keys(&mut window, Modifiers::NONE, Key::Tab);
    assert!(text(&window).ends_with("v$pos += normalize("), "{}", text(&window));
}

#[test]
fn text_is_found_and_replaced() {
    let mut window = editing("// one two One\n");
    keys(&mut window, Modifiers::COMMAND, Key::H);
    window.get_by_label("Find in program").type_text("one");
    window.run_steps(3);
    window.get_by_label("1 of 2");
    keys(&mut window, Modifiers::NONE, Key::Enter);
    window.get_by_label("2 of 2");
    window.get_by_label("Replace by").focus();
    window.step();
    window.get_by_label("Replace by").type_text("three");
    window.run_steps(2);
    window.get_by_label("Replace").click();
    window.run_steps(3);
    assert_eq!(text(&window), "// one two three\n");
    window.get_by_label("All").click();
    window.run_steps(3);
    assert_eq!(text(&window), "// three two three\n");
    window.get_by_label("Close find").click();
    window.run_steps(3);
    assert!(window.query_by_label("Find in program").is_none());
}

#[test]
fn problems_are_walked_by_key() {
    let mut window = editing("void f(mesh& S) {\n  x = 1;\n  y = 2;\n}\n");
    let line = |window: &Harness<'static, App>| {
        let state = egui::text_edit::TextEditState::load(&window.ctx, egui::Id::unique("program text")).unwrap();
        let at = state.cursor.char_range().unwrap().as_sorted_char_range().start.0;
        text(window)[..at].matches('\n').count() + 1
    };
    keys(&mut window, Modifiers::NONE, Key::F8);
    assert_eq!(line(&window), 2);
    keys(&mut window, Modifiers::NONE, Key::F8);
    assert_eq!(line(&window), 3);
    keys(&mut window, Modifiers::NONE, Key::F8);
    assert_eq!(line(&window), 2, "round the end");
    keys(&mut window, Modifiers::SHIFT, Key::F8);
    assert_eq!(line(&window), 3);
}

#[test]
fn a_program_is_laid_out_and_one_with_errors_is_not() {
    let mut window = editing("void  f( mesh &S ){\n}\n");
    act(&mut window, TextAction::Format);
    assert_eq!(text(&window), "void f(mesh& S) {\n}\n");
    write(&mut window, "void  f( {");
    act(&mut window, TextAction::Format);
    assert_eq!(text(&window), "void  f( {");
    assert!(window.state().session().notice().is_some());
}

#[test]
fn what_is_said_under_the_pointer_does_not_cover_what_is_typed() {
    let mut window = editing("void f(mesh& S) {\n  zork(1);\n}\n");
    settle(&mut window);
    let said = |window: &Harness<'static, App>| window.query_all_by_label_contains("zork").count();
    let elsewhere = said(&window);
    let editor = window.get_by_label("Program text").rect();
    let font = egui::FontId::monospace(13.0);
    let (width, height) = window.ctx.fonts_mut(|f| (f.glyph_width(&font, '0'), f.row_height(&font)));
    let word = editor.min + egui::vec2(6.0 + 4.0 * width, 6.0 + 1.5 * height);
    window.hover_at(word);
    window.run_steps(2);
    let pointed_at = said(&window);
    assert!(pointed_at > elsewhere, "the pointer asks what is wrong");
    type_text(&mut window, "//");
    settle(&mut window);
    assert_eq!(said(&window), elsewhere, "the pointer has lain still");
    window.hover_at(word + egui::vec2(width, 0.0));
    window.run_steps(2);
    assert_eq!(said(&window), pointed_at);
}

#[test]
fn numbers_are_raised_by_key_and_dragged_at_their_handle() {
    let mut window = editing("void f(mesh& S) {\n  forall v in S v$pos *= 2.5");
    keys(&mut window, Modifiers::ALT, Key::ArrowUp);
    assert!(text(&window).ends_with("*= 2.6"));
    type_text(&mut window, ";\n}");
    settle(&mut window);
    window.state_mut().apply(Command::Step);
    settle(&mut window);
    assert_eq!(size(&window), 2.6);
    // The pointer rests on the number: its handle comes.
    let editor = window.get_by_label("Program text").rect();
    let font = egui::FontId::monospace(13.0);
    let (width, height) = window.ctx.fonts_mut(|f| (f.glyph_width(&font, '0'), f.row_height(&font)));
    let number = editor.min + egui::vec2(6.0 + 26.2 * width, 6.0 + 1.5 * height);
    window.hover_at(number);
    for _ in 0..8 {
        window.step();
    }
    let handle = window.get_by_label("Change the number").rect().center();
    window.hover_at(handle);
    window.step();
    window.drag_at(handle);
    window.step();
    for i in 1..=4 {
        window.hover_at(handle + egui::vec2(-5.0 * i as f32, 0.0));
        window.step();
    }
    assert!(text(&window).ends_with("*= 2.2;\n}"), "{}", text(&window));
    window.drop_at(handle + egui::vec2(-20.0, 0.0));
    settle(&mut window);
    assert_eq!(size(&window), 2.2, "the surface has followed");
    window.state_mut().apply(Command::UndoText);
    assert!(text(&window).ends_with("*= 2.6;\n}"), "dragging is one change");
}

#[test]
fn with_ctrl_or_alt_a_number_is_dragged_itself_and_without_text_is_selected() {
    for modifiers in [Modifiers::COMMAND, Modifiers::ALT, Modifiers::NONE] {
        let mut window = editing("void f(mesh& S) {\n  forall v in S v$pos *= 2.5;\n}");
        let editor = window.get_by_label("Program text").rect();
        let font = egui::FontId::monospace(13.0);
        let (width, height) = window.ctx.fonts_mut(|f| (f.glyph_width(&font, '0'), f.row_height(&font)));
        let at = editor.min + egui::vec2(6.0 + 26.2 * width, 6.0 + 1.5 * height);
        window.event(egui::Event::ModifiersChanged(modifiers));
        for i in 0..3 {
            window.event(egui::Event::PointerMoved(at + egui::vec2(0.1 * i as f32, 0.0)));
            window.step();
        }
        let to = at + egui::vec2(15.0, 0.0);
        for (pressed, at) in [(true, at), (false, to)] {
            let button = egui::PointerButton::Primary;
            window.event(egui::Event::PointerMoved(at));
            window.step();
            window.event(egui::Event::PointerButton { pos: at, button, pressed, modifiers });
            window.step();
        }
        let expected = if modifiers == Modifiers::NONE { "*= 2.5;\n}" } else { "*= 2.8;\n}" };
        assert!(text(&window).ends_with(expected), "{modifiers:?}: {}", text(&window));
    }
}

#[test]
fn a_changed_text_is_run_as_typed_on_save_or_by_hand() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.vv");
    std::fs::write(&path, "void f(mesh& S) { forall v in S v$pos *= 2.0; }").unwrap();
    let mut window = octahedron();
    window.state_mut().apply(Command::Open(path));
    window.state_mut().apply(Command::Step);
    settle(&mut window);
    assert_eq!(size(&window), 2.0);
    window.state_mut().apply(Command::SetReload(Reload::Saved));
    write(&mut window, "void f(mesh& S) { forall v in S v$pos *= 3.0; }");
    assert_eq!(size(&window), 2.0);
    window.get_by_label("Run the changed text");
    window.state_mut().apply(Command::Save);
    settle(&mut window);
    assert_eq!(size(&window), 3.0);
    window.state_mut().apply(Command::SetReload(Reload::ByHand));
    write(&mut window, "void f(mesh& S) { forall v in S v$pos *= 4.0; }");
    window.state_mut().apply(Command::Save);
    settle(&mut window);
    assert_eq!(size(&window), 3.0);
    click(&mut window, "Run the changed text");
    assert_eq!(size(&window), 4.0);
}

#[test]
fn messages_are_copied_with_their_places() {
    let mut window = octahedron();
    write(&mut window, "void f(mesh& S) {\n  vertex v = nul;\n  int n = w;\n}\n");
    let copied = |window: &mut Harness<'static, App>, what: &str| {
        window.get_by_label(what).click();
        window.step();
        let commands = &window.output().platform_output.commands;
        commands.iter().find_map(|command| match command {
            egui::OutputCommand::CopyText(text) => Some(text.clone()),
            _ => None,
        })
    };
    let problems: Vec<_> = window.state().session().problems().iter().cloned().collect();
    assert!(problems.len() >= 2, "{problems:?}");
    let label = format!("line 3: {}", problems[1].diagnostic.message);
    let entry = |window: &mut Harness<'static, App>| {
        window.get_by_label_contains(&label).click_secondary();
        window.run_steps(3);
    };
    entry(&mut window);
    let one = copied(&mut window, "Copy message").unwrap();
    assert!(one.starts_with(&format!("loop.vv:3:11: error: {}", problems[1].diagnostic.message)), "{one}");
    window.run_steps(3);
    entry(&mut window);
    let all = copied(&mut window, "Copy all messages").unwrap();
    assert!(all.contains(&one) && all.contains(":2:14: error: "), "{all}");
    window.run_steps(3);
    entry(&mut window);
    window.get_by_label("Go to place").click();
    window.run_steps(4);
    assert!(window.get_by_label("Program text").is_focused());
}
