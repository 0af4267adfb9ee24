//! Screenshots of every panel, dialog and state of the window, in every size and theme, to be looked at:
//!
//! ```sh
//! cargo run --example screens -- FOLDER [PART OF A NAME]
//! ```
//!
//! `FOLDER/STATE-WIDTHxHEIGHT-THEME.png`; a state and a size are a part of a name, too.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use app::annotate::Quantity;
use app::command::{Command, Inspect, PairAction, Panel, TextAction, ThemeChoice};
use app::document::MeshSource;
use app::gui::App;
use app::scene::Surface;
use app::session::{Dialog, Purpose};
use app::store::Store;
use eframe::egui;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use vv::mesh::Value;

type Window = Harness<'static, App>;
type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Pixels, and pixels in a point.
const SIZES: [(u32, u32, f32); 3] = [(1280, 720, 1.0), (1920, 1080, 1.0), (3840, 2160, 2.0)];

/// What is done to a new window.
struct State {
    name: &'static str,
    prepare: fn(&mut Window),
}

const STATES: &[State] = &[
    State { name: "first-start", prepare: |w| do_(w, Command::Gallery) },
    State { name: "surface", prepare: |_| {} },
    State {
        name: "empty",
        prepare: |w| {
            do_(w, Command::NewProgram);
            do_(w, Command::UseMesh(MeshSource::Empty));
        },
    },
    State {
        name: "gallery-found",
        prepare: |w| {
            do_(w, Command::Gallery);
            w.get_by_label("Find a program").type_text("triangle");
        },
    },
    State {
        name: "gallery-nothing",
        prepare: |w| {
            do_(w, Command::Gallery);
            w.get_by_label("Find a program").type_text("xyzzy");
        },
    },
    State { name: "preferences", prepare: |w| do_(w, Command::Preferences) },
    State { name: "save-picture", prepare: |w| do_(w, Command::SavePicture) },
    State { name: "palette", prepare: |w| do_(w, Command::Palette) },
    State {
        name: "palette-found",
        prepare: |w| {
            do_(w, Command::Palette);
            w.run_steps(2);
            w.get_by_label("Find a command").type_text("mesh");
        },
    },
    State { name: "keys", prepare: |w| do_(w, Command::CheatSheet) },
    State { name: "reference", prepare: |w| do_(w, Command::Reference) },
    State { name: "menu-file", prepare: |w| click(w, "File") },
    State { name: "menu-edit", prepare: |w| click(w, "Edit") },
    State { name: "menu-run", prepare: |w| click(w, "Run") },
    State { name: "menu-view", prepare: |w| click(w, "View") },
    State { name: "menu-subdivide", prepare: |w| click(w, "Subdivide") },
    State { name: "menu-camera", prepare: |w| click(w, "Camera") },
    State { name: "menu-inspect", prepare: |w| click(w, "Inspect") },
    State { name: "menu-show", prepare: |w| click(w, "Show") },
    State { name: "menu-help", prepare: |w| click(w, "Help") },
    State {
        name: "selected",
        prepare: |w| {
            do_(w, Command::GoTo(1));
            settle(w);
            do_(w, Command::Inspect(Inspect::SelectNumbers(vec![12])));
        },
    },
    State {
        name: "selected-and-walked",
        prepare: |w| {
            do_(w, Command::GoTo(1));
            settle(w);
            do_(w, Command::Inspect(Inspect::SelectNumbers(vec![12])));
            for _ in 0..2 {
                do_(w, Command::Inspect(Inspect::WalkOn));
            }
        },
    },
    State { name: "select-vertex", prepare: |w| do_(w, Command::Inspect(Inspect::AskForVertex)) },
    State {
        name: "side-by-side",
        prepare: |w| {
            do_(w, Command::Pair(PairAction::Compare));
            settle(w);
            do_(w, Command::OpenExample("butterfly.vv"));
        },
    },
    State { name: "curvature", prepare: |w| do_(w, Command::ColorBy(Quantity::Gauss)) },
    State { name: "reflection-lines", prepare: |w| do_(w, Command::ShowBy(Surface::ReflectionLines)) },
    State {
        name: "cut",
        prepare: |w| {
            do_(w, Command::Cut);
            do_(w, Command::Grid);
            do_(w, Command::Axes);
        },
    },
    State { name: "exhibit-tissue", prepare: |w| exhibit(w, "tissue.vv", 40) },
    State { name: "exhibit-reaction", prepare: |w| exhibit(w, "reaction-diffusion.vv", 30) },
    State { name: "menu-examples", prepare: |w| click(w, "Examples") },
    State { name: "menu-meshes", prepare: |w| click(w, "Meshes") },
    State {
        name: "context-menu",
        prepare: |w| {
            w.get_by_label("Viewport").click_secondary();
            w.run_steps(2);
        },
    },
    State {
        name: "params",
        prepare: |w| {
            do_(w, Command::OpenExample("mountain.vv"));
            do_(w, Command::GoTo(5));
            do_(w, Command::SetParam("height".to_owned(), Value::Double(0.7)));
        },
    },
    State { name: "error", prepare: |w| edit(w, |text| text.replace("gaps `p > 1", "gapz `p > 1")) },
    State {
        name: "error-running",
        prepare: |w| {
            edit(w, |_| {
                "void f(mesh& S) {\n  forall v in S {\n    vertex q = nextto v in v;\n    v$pos = q$pos;\n  }\n}\n"
                    .into()
            });
            do_(w, Command::Step);
        },
    },
    State {
        name: "console",
        prepare: |w| {
            edit(w, |_| "void f(mesh& S) {\n  forall v in S print(\"at\", v$pos);\n}\n".into());
            settle(w);
            click(w, "Console");
        },
    },
    State {
        name: "find-and-replace",
        prepare: |w| {
            do_(w, Command::Text(TextAction::Replace));
            w.run_steps(2);
            w.get_by_label("Find in program").type_text("vertex");
        },
    },
    State {
        name: "unsaved",
        prepare: |w| {
            edit(w, |text| format!("{text}// mine\n"));
            do_(w, Command::Quit);
        },
    },
    State {
        name: "no-file-dialog",
        prepare: |w| {
            let path = String::new();
            w.state_mut().session_mut().dialog =
                Some(Dialog::TypePath { purpose: Purpose::OpenMesh, path, then: None });
        },
    },
    State {
        name: "recover",
        prepare: |w| w.state_mut().session_mut().dialog = Some(Dialog::Recover { name: "mine.vv".to_owned() }),
    },
    State {
        name: "picture-alone",
        prepare: |w| {
            for panel in [Panel::Program, Panel::Messages, Panel::Inspector, Panel::Timeline] {
                do_(w, Command::Toggle(panel));
            }
        },
    },
    State {
        name: "wires",
        prepare: |w| {
            do_(w, Command::Faces);
            do_(w, Command::Vertices);
        },
    },
    State {
        name: "computing",
        prepare: |w| {
            let text = "void f(mesh& S) { while (true) { } }";
            w.state_mut().apply(Command::Edit(text.into()));
            w.state_mut().apply(Command::Step);
            let began = Instant::now();
            while began.elapsed() < Duration::from_secs(1) {
                w.step();
                std::thread::sleep(Duration::from_millis(20));
            }
        },
    },
];

fn main() -> Result<()> {
    let mut arguments = std::env::args_os().skip(1).map(PathBuf::from);
    let folder = arguments.next().ok_or("which folder?")?;
    let part = arguments.next().unwrap_or_default().to_string_lossy().into_owned();
    std::fs::create_dir_all(&folder)?;
    for state in STATES {
        for (width, height, scale) in SIZES {
            for theme in [ThemeChoice::Dark, ThemeChoice::Light] {
                let name = format!("{}-{width}x{height}-{theme:?}.png", state.name).to_lowercase();
                if name.contains(&part) {
                    shoot(state, (width, height, scale), theme, &folder.join(&name))?;
                    println!("{name}");
                }
            }
        }
    }
    Ok(())
}

fn shoot(state: &State, (width, height, scale): (u32, u32, f32), theme: ThemeChoice, to: &Path) -> Result<()> {
    let kept = tempfile::tempdir()?;
    let store = Store::open(kept.path())?;
    let mut window = Harness::builder()
        .with_size(egui::vec2(width as f32 / scale, height as f32 / scale))
        .with_pixels_per_point(scale)
        .wgpu()
        .build_eframe(move |cc| {
            App::with_store(cc, None, None, Some(store)).unwrap_or_else(|error| {
                eprintln!("{error}");
                std::process::exit(1)
            })
        });
    do_(&mut window, Command::CloseDialog);
    do_(&mut window, Command::SetTheme(theme));
    settle(&mut window);
    (state.prepare)(&mut window);
    if state.name != "computing" {
        settle(&mut window);
    }
    window.render()?.save(to)?;
    do_(&mut window, Command::Stop);
    Ok(())
}

fn do_(window: &mut Window, command: Command) {
    window.state_mut().apply(command);
    window.run_steps(2);
}

fn exhibit(window: &mut Window, program: &'static str, generation: u64) {
    do_(window, Command::Exhibit { program, keep_mesh: false });
    do_(window, Command::GoTo(generation));
}

fn click(window: &mut Window, label: &str) {
    match window.query_by_label(label) {
        Some(node) => node.click(),
        None => eprintln!("there is no {label} to be clicked"),
    }
    window.run_steps(4);
}

fn edit(window: &mut Window, change: impl FnOnce(&str) -> String) {
    let text = change(&window.state().session().document.program.text);
    do_(window, Command::Edit(text.into()));
}

/// Until all is computed, drawn and faded in.
fn settle(window: &mut Window) {
    let began = Instant::now();
    while began.elapsed() < Duration::from_secs(60) {
        window.run_steps(2);
        if !window.state().session().is_busy() {
            break;
        }
        std::thread::sleep(Duration::from_millis(3));
    }
    // Pictures of the gallery come from another thread.
    for _ in 0..20 {
        window.step();
        std::thread::sleep(Duration::from_millis(5));
    }
}
