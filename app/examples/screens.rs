//! Screenshots of every panel, dialog and state of the window, in every size and theme, to be looked at:
//!
//! ```sh
//! cargo run --example screens -- FOLDER [PART OF A NAME]
//! ```
//!
//! `FOLDER/STATE-WIDTHxHEIGHT-THEME.png`; a state and a size are a part of a name, too.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use app::annotate::{Arrows, Label, Quantity};
use app::camera::Side;
use app::command::{Command, Inspect, PairAction, Panel, TextAction, ThemeChoice, ViewAction};
use app::document::MeshSource;
use app::gui::App;
use app::inspect::selection::Item;
use app::scene::Surface;
use app::session::{Dialog, MaskState, Purpose};
use app::store::Store;
use eframe::egui;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use vv::mesh::{Value, Vertex};

type Window = Harness<'static, App>;
type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Pixels, and pixels in a point.
const SIZES: [(u32, u32, f32); 5] =
    [(800, 500, 1.0), (900, 600, 1.0), (1280, 720, 1.0), (1920, 1080, 1.0), (3840, 2160, 2.0)];

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
    State {
        name: "keys-found",
        prepare: |w| {
            do_(w, Command::CheatSheet);
            w.get_by_label("Find a key").type_text("view");
        },
    },
    State { name: "reference", prepare: |w| do_(w, Command::Reference) },
    State {
        name: "reference-found",
        prepare: |w| {
            do_(w, Command::Reference);
            w.run_steps(2);
            w.get_by_label("Find in the reference").type_text("gap");
        },
    },
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
    State {
        name: "mask",
        prepare: |w| {
            select_at(w, 1, &[40]);
            do_(w, Command::Inspect(Inspect::Mask));
            let began = Instant::now();
            let measuring = |w: &Window| matches!(w.state().session().mask(), MaskState::Measuring(_));
            while measuring(w) && began.elapsed() < Duration::from_secs(30) {
                w.step();
                std::thread::sleep(Duration::from_millis(10));
            }
        },
    },
    State {
        name: "edge",
        prepare: |w| {
            if let Some([v, u]) = side_at(w, 11) {
                do_(w, Command::Inspect(Inspect::Select(Item::Edge([v, u]))));
            }
        },
    },
    State {
        name: "face",
        prepare: |w| {
            if let Some(side) = side_at(w, 11) {
                do_(w, Command::Inspect(Inspect::Select(Item::Face(side))));
            }
        },
    },
    State {
        name: "ring-pointed-at",
        prepare: |w| {
            select_at(w, 1, &[12]);
            if let Some([_, neighbour]) = side_at(w, 11) {
                let name = neighbour.to_string();
                let at = w.query_all_by_label(&name).next().map(|node| node.rect().center());
                rest(w, at.unwrap_or_default());
            }
        },
    },
    State { name: "distance", prepare: |w| select_at(w, 1, &[12, 20]) },
    State { name: "angle", prepare: |w| select_at(w, 1, &[20, 12, 40]) },
    State {
        name: "mesh-problems",
        prepare: |w| {
            edit(w, |_| {
                "void tear(mesh& S) {\n  int n = 0;\n  forall v in S {\n    if (n++ > 2) break;\n    \
                 erase (any in v) from v;\n  }\n  vertex x;\n  add x to S;\n}\n"
                    .into()
            });
            do_(w, Command::GoTo(1));
            settle(w);
            do_(w, Command::Inspect(Inspect::ListProblems));
        },
    },
    State {
        name: "context-menu-of-a-finding",
        prepare: |w| {
            edit(w, |_| "void tear(mesh& S) {\n  vertex x;\n  add x to S;\n}\n".into());
            do_(w, Command::GoTo(1));
            settle(w);
            do_(w, Command::Inspect(Inspect::ListProblems));
            settle(w);
            let finding = w.query_all_by(|node| node.label().is_some_and(|text| text.starts_with("v29"))).next();
            match finding {
                Some(node) => node.click_secondary(),
                None => eprintln!("there is no finding to be clicked"),
            }
            w.run_steps(4);
        },
    },
    State {
        name: "labels-and-arrows",
        prepare: |w| {
            do_(w, Command::GoTo(1));
            do_(w, Command::LabelBy(Label::Vertices));
            do_(w, Command::ArrowsOf(Arrows::VertexNormals));
            click(w, "Labels and arrows");
        },
    },
    State {
        name: "born-and-moved",
        prepare: |w| {
            do_(w, Command::GoTo(1));
            do_(w, Command::ColorBy(Quantity::Change));
        },
    },
    State { name: "valence", prepare: |w| do_(w, Command::ColorBy(Quantity::Valence)) },
    State {
        name: "isophotes",
        prepare: |w| {
            do_(w, Command::GoTo(4));
            do_(w, Command::Smooth);
            do_(w, Command::Edges);
            do_(w, Command::Control);
            do_(w, Command::ShowBy(Surface::Isophotes));
        },
    },
    State {
        name: "smooth-and-shaded",
        prepare: |w| {
            do_(w, Command::GoTo(4));
            do_(w, Command::Smooth);
            do_(w, Command::Edges);
            do_(w, Command::Occlusion);
        },
    },
    State { name: "render-options", prepare: |w| do_(w, Command::View(ViewAction::RenderOptions)) },
    State {
        name: "completion",
        prepare: |w| {
            w.get_by_label("Program text").focus();
            w.run_steps(2);
            w.get_by_label("Program text").type_text("// \nprev");
        },
    },
    State { name: "word-explained", prepare: |w| rest(w, egui::pos2(110.0, 246.0)) },
    State { name: "number-to-drag", prepare: |w| rest(w, egui::pos2(122.0, 426.0)) },
    State {
        name: "drop",
        prepare: |w| {
            let path = Some(PathBuf::from("bunny.ply"));
            w.input_mut().hovered_files.push(egui::HoveredFile { path, ..Default::default() });
            w.run_steps(2);
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
    State {
        name: "orthographic",
        prepare: |w| {
            do_(w, Command::View(ViewAction::From(Side::Front)));
            do_(w, Command::View(ViewAction::Orthographic));
            do_(w, Command::Grid);
            do_(w, Command::Axes);
        },
    },
    State {
        name: "property",
        prepare: |w| {
            exhibit(w, "distance.vv", 20);
            do_(w, Command::ColorBy(Quantity::Property("far".to_owned())));
            settle(w);
            click(w, "Labels and arrows");
        },
    },
    State {
        name: "context-menu-of-a-property",
        prepare: |w| {
            exhibit(w, "distance.vv", 20);
            settle(w);
            do_(w, Command::Inspect(Inspect::SelectNumbers(vec![12])));
            // The value, not the name.
            let value = w.query_all_by(|node| {
                node.label().as_deref() == Some("far") && node.value().is_some_and(|value| value != "far")
            });
            match value.last() {
                Some(node) => node.click_secondary(),
                None => eprintln!("there is no property to be clicked"),
            }
            w.run_steps(4);
        },
    },
    State { name: "curvature", prepare: |w| do_(w, Command::ColorBy(Quantity::Gauss)) },
    State {
        name: "reflection-lines",
        prepare: |w| {
            do_(w, Command::GoTo(4));
            do_(w, Command::Smooth);
            do_(w, Command::Edges);
            do_(w, Command::Control);
            do_(w, Command::ShowBy(Surface::ReflectionLines));
        },
    },
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
    State {
        name: "params-sets",
        prepare: |w| {
            exhibit(w, "reaction-diffusion.vv", 1);
            settle(w);
            for (name, value) in [("spots", 0.03), ("stripes", 0.05)] {
                do_(w, Command::SetParam("feed".to_owned(), Value::Double(value)));
                do_(w, Command::SaveParams(name.to_owned()));
            }
            click(w, "Sets");
        },
    },
    State {
        name: "params-of-several-files",
        prepare: |w| {
            edit(w, |_| {
                "#include \"mountain.vv\"\n\nparam double size = 1 in [0.5, 2]; // of all\nparam bool flat = false;\n\n\
                 void scale(mesh& S) {\n  step(S);\n  if (!flat) forall v in S v$pos *= size;\n}\n"
                    .into()
            });
            do_(w, Command::UseMesh(MeshSource::Empty));
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
            edit(w, |_| "void f(mesh& S) {\n  forall v in S print(\"at \", v$pos);\n}\n".into());
            settle(w);
            click(w, "Console");
        },
    },
    State {
        name: "context-menu-of-a-line",
        prepare: |w| {
            edit(w, |_| "void f(mesh& S) {\n  forall v in S print(\"around \", v, \": \", valence v);\n}\n".into());
            settle(w);
            click(w, "Console");
            let line = w.query_all_by(|node| node.value().is_some_and(|text| text.starts_with("around"))).last();
            match line {
                Some(node) => node.click_secondary(),
                None => eprintln!("there is no line to be clicked"),
            }
            w.run_steps(4);
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
            let path = "assets/meshes/t".to_owned();
            w.state_mut().session_mut().dialog = Some(Dialog::path(Purpose::OpenMesh, path, None));
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
    let mut missing = 0;
    for state in STATES {
        for (width, height, scale) in SIZES {
            for theme in [ThemeChoice::Dark, ThemeChoice::Light] {
                let name = format!("{}-{width}x{height}-{theme:?}.png", state.name).to_lowercase();
                if name.contains(&part) {
                    // A driver without GPU may take too long on a busy machine; the others are made all the same.
                    match shoot(state, (width, height, scale), theme, &folder.join(&name)) {
                        Ok(()) => println!("{name}"),
                        Err(error) => {
                            eprintln!("{name}: {error}");
                            missing += 1;
                        }
                    }
                }
            }
        }
    }
    if missing > 0 { Err(format!("{missing} screens are missing").into()) } else { Ok(()) }
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

/// In a generation, with these vertices selected.
fn select_at(window: &mut Window, generation: u64, vertices: &[u64]) {
    do_(window, Command::GoTo(generation));
    settle(window);
    do_(window, Command::Inspect(Inspect::SelectNumbers(vertices.to_vec())));
}

/// A vertex of the first generation, by its place, and the first of its neighbours.
fn side_at(window: &mut Window, index: usize) -> Option<[Vertex; 2]> {
    do_(window, Command::GoTo(1));
    settle(window);
    let frame = window.state().session().frame()?;
    let vertex = frame.mesh.vertices().nth(index)?;
    let neighbour = frame.mesh.ring(vertex).vertices().next()?;
    Some([vertex, neighbour])
}

/// With the pointer at a place, until what is there has been explained.
fn rest(window: &mut Window, at: egui::Pos2) {
    window.hover_at(at);
    for _ in 0..40 {
        window.step();
        std::thread::sleep(Duration::from_millis(5));
    }
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
