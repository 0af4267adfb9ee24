//! Pictures and figures out of the window: what the command line makes of the same view and style.

use std::path::PathBuf;
use std::process::Command as Process;

use app::command::ViewAction;
use app::session::Purpose;
use tempfile::TempDir;

use super::*;

const VIEW: &str = "vv view: eye 4 5 7 target 0.25 0.5 0 up 0 1 0 perspective 28.6479";

/// What the window says next that is not that it is at work.
#[track_caller]
fn said(window: &mut Harness<'static, App>) -> String {
    let text = |s: &Session| s.notice().map(|(_, text)| text.to_owned()).filter(|text| !text.starts_with("drawing "));
    until(window, "something is said", |s| text(s).is_some());
    text(window.state().session()).unwrap()
}

fn assets(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets").join(name)
}

/// The pixels of a picture; of a figure its bytes.
fn content(path: &Path) -> Vec<u8> {
    match path.extension().unwrap().to_str() {
        Some("png") => image::open(path).unwrap().into_rgba8().into_raw(),
        _ => std::fs::read(path).unwrap(),
    }
}

#[track_caller]
fn same_as_the_command_line(more: &[Command]) {
    let folder = TempDir::new().unwrap();
    let at = |name: &str| folder.path().join(name);
    let mut window = open(Some(&assets("meshes/tetrapod.obj")), Some(&assets("programs/loop.vv")));
    window.state_mut().apply(Command::GoTo(2));
    settle(&mut window);
    window.state_mut().apply(Command::View(ViewAction::Show(VIEW.to_owned())));
    until(&mut window, "the view is there", |s| !s.glides());
    more.iter().for_each(|command| window.state_mut().apply(command.clone()));
    settle(&mut window);
    window.state_mut().session_mut().chosen(Purpose::SaveStyle, at("style.json"));
    let size = window.get_by_label("Viewport").rect().size();
    for extension in ["png", "svg", "eps", "pdf"] {
        let (ours, theirs) = (at(&format!("window.{extension}")), at(&format!("line.{extension}")));
        window.state_mut().apply(Command::PictureTo(ours.clone()));
        until(&mut window, "it is saved", |_| ours.exists());
        let run = Process::new(env!("CARGO_BIN_EXE_vv"))
            .arg("run")
            .arg(assets("programs/loop.vv"))
            .arg("-i")
            .arg(assets("meshes/tetrapod.obj"))
            .args(["-n", "2", "--view", VIEW, "--style"])
            .arg(at("style.json"))
            .arg(format!("--size={}x{}", size.x.round(), size.y.round()))
            .arg("-o")
            .arg(&theirs)
            .output()
            .unwrap();
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
        assert!(content(&ours) == content(&theirs), "the {extension} files differ");
    }
}

#[test]
fn what_is_saved_is_what_the_command_line_makes_of_view_and_style() {
    same_as_the_command_line(&[]);
}

#[test]
fn so_it_is_without_the_control_mesh_and_with_colours_and_a_cut() {
    let colors = Command::ColorBy(app::annotate::Quantity::Valence);
    same_as_the_command_line(&[Command::Control, colors, Command::Cut, Command::Vertices]);
}

#[test]
fn a_name_that_is_of_no_picture_is_refused() {
    let folder = TempDir::new().unwrap();
    let mut window = octahedron();
    let path = folder.path().join("picture.bmp");
    window.state_mut().apply(Command::PictureTo(path.clone()));
    assert!(said(&mut window).ends_with("picture.bmp: the name of a picture ends in .png, .svg, .eps or .pdf"));
    assert!(!path.exists());
    // A folder that is not there.
    window.state_mut().apply(Command::PictureTo(folder.path().join("nowhere/picture.svg")));
    until(&mut window, "it fails", |s| s.notice().is_some_and(|(_, text)| text.contains("nowhere")));
}

#[test]
fn window_and_pictures_have_the_colour_behind_them_that_the_style_says_unless_another_one_is_asked_for() {
    use app::preferences::{Background, PictureOptions, Preferences};
    let folder = TempDir::new().unwrap();
    let at = |name: &str| folder.path().join(name);
    let mut window = octahedron();
    std::fs::write(at("style.json"), "{\"background\": \"#102030\"}").unwrap();
    let seen = |window: &mut Harness<'static, App>| {
        settle(window);
        let corner = window.get_by_label("Viewport").rect().right_top() + egui::vec2(-3.0, 3.0);
        window.render().unwrap().get_pixel(corner.x as u32, corner.y as u32).0
    };
    let before = seen(&mut window);
    window.state_mut().session_mut().chosen(Purpose::OpenStyle, at("style.json"));
    assert_eq!(seen(&mut window), [0x10, 0x20, 0x30, 255], "the window is as pictures are");
    window.state_mut().apply(Command::Undo);
    assert_eq!(seen(&mut window), before);
    window.state_mut().apply(Command::Redo);
    for (background, corner) in [
        (Background::AsSeen, [0x10, 0x20, 0x30, 255]),
        (Background::White, [255; 4]),
        (Background::Transparent, [0; 4]),
    ] {
        let picture = PictureOptions { background, ..PictureOptions::default() };
        let preferences = Preferences { picture, ..window.state().session().preferences };
        window.state_mut().apply(Command::SetPreferences(preferences));
        let path = at(&format!("{background:?}.png"));
        window.state_mut().apply(Command::PictureTo(path.clone()));
        until(&mut window, "it is saved", |_| path.exists());
        assert_eq!(image::open(&path).unwrap().into_rgba8().get_pixel(2, 2).0, corner, "{background:?}");
    }
    window.state_mut().apply(Command::SavePicture);
    window.run_steps(4);
    window.get_by_label("of the style, #102030");
    window.state_mut().apply(Command::CloseDialog);
    std::fs::write(at("wrong.json"), "{\n\"background\": \"sky\"}").unwrap();
    window.state_mut().session_mut().chosen(Purpose::OpenStyle, at("wrong.json"));
    let said = said(&mut window);
    assert!(said.contains("line 2") && said.contains("`sky` is no colour"), "{said}");
}
