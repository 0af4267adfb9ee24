//! The window: panels around a viewport.
//!
//! ```text
//!   ┌ menu ─────────────────────────────────────────────┐
//!   │ tools: generations, rule, progress                 │
//!   ├ program ──────┬ viewport ───────────────┬ inspector┤
//!   │ text          │                         │ mesh     │
//!   │               │                         │ params   │
//!   ├ messages ─────┤                         │ display  │
//!   │ problems …    ├ time line ──────────────┤ counts   │
//!   └───────────────┴─────────────────────────┴──────────┘
//! ```
//!
//! Panels read the [`Session`] and push [`Command`]s; only the session changes anything. A panel's own state (a cursor, a
//! texture) stays in the panel.

mod cheat_sheet;
mod clicks;
mod context;
mod dialogs;
mod display;
mod drop;
mod editor;
mod editors;
mod findings;
mod gallery;
mod gizmo;
mod inspector;
mod keys;
mod labels;
mod legend;
mod marks;
mod mask;
mod menu;
mod menu_keys;
mod messages;
mod overlay;
mod pair;
mod palette;
mod parameters;
mod picture;
mod preferences;
mod printed;
mod reference;
mod render_options;
mod ring;
mod saving;
mod selection;
mod spread;
mod theme;
mod timeline;
mod toolbar;
mod type_path;
mod viewport;
mod views;
mod widgets;

use std::fmt;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use eframe::{egui, egui_wgpu};

use crate::command::{Command, ThemeChoice};
use crate::preferences::Preferences;
use crate::render;
use crate::session::Session;
use crate::store::Store;
use crate::trace;
use crate::viewpoint::Viewpoint;

/// Points of width that the viewport keeps, whatever stands beside it.
const VIEWPORT: f32 = 170.0;
/// And at least this part of the window.
const VIEWPORT_PART: f32 = 0.33;
/// Least width of the inspector.
const INSPECTOR: f32 = 200.0;

/// Opens the window, which looks from `viewpoint` or the standard one, and returns when it is closed.
///
/// # Errors
/// When no window can be opened.
pub fn run(mesh: Option<PathBuf>, program: Option<PathBuf>, viewpoint: Option<Viewpoint>) -> Result<(), WindowError> {
    let options = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_title("vv")
            .with_app_id("vv")
            .with_inner_size([1280.0, 720.0])
            .with_min_inner_size([640.0, 420.0])
            .with_drag_and_drop(true),
        renderer: eframe::Renderer::Wgpu,
        wgpu_options: wgpu_options(),
        ..Default::default()
    };
    // A window that cannot remember is better than none.
    let mut trouble = None;
    let store = Store::user_folder().and_then(|folder| match Store::open(&folder) {
        Ok(store) => Some(store),
        Err(error) => {
            let what = "nothing is remembered, and nothing kept for the case of a crash";
            let text = format!("{what}: {}: {}", folder.display(), crate::files::sentence(&error));
            eprintln!("warning: {text}");
            trouble = Some(text);
            None
        }
    });
    let was_open = Arc::new(AtomicBool::new(false));
    let opens = Arc::clone(&was_open);
    let create: eframe::AppCreator<'_> = Box::new(move |cc| {
        let mut app = App::with_store(cc, mesh, program, store)?;
        opens.store(true, Ordering::Relaxed);
        if let Some(trouble) = trouble {
            app.session.warn(trouble);
        }
        if let Some(viewpoint) = viewpoint {
            app.session.look_from(viewpoint);
        }
        Ok(Box::new(app))
    });
    eframe::run_native("vv", options, create)
        .map_err(|error| WindowError { cause: error.to_string(), was_open: was_open.load(Ordering::Relaxed) })
}

fn wgpu_options() -> egui_wgpu::WgpuConfiguration {
    let mut setup = egui_wgpu::WgpuSetupCreateNew::without_display_handle();
    setup.device_descriptor = Arc::new(render::device_descriptor);
    egui_wgpu::WgpuConfiguration { wgpu_setup: setup.into(), ..Default::default() }
}

/// Why there is no window, in the words of the window system or the graphics driver.
#[derive(Debug)]
pub struct WindowError {
    cause: String,
    /// Whether it had opened before.
    pub was_open: bool,
}

impl fmt::Display for WindowError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.cause)
    }
}

impl std::error::Error for WindowError {}

/// The window's content.
pub struct App {
    session: Session,
    editors: editors::Editors,
    pictures: pair::Pictures,
    messages: messages::Messages,
    reference: reference::Reference,
    gallery: gallery::Gallery,
    title: String,
    quitting: bool,
    /// What was asked of the window manager last, and what it said last.
    full_screen: bool,
    was_full_screen: bool,
    scale: Scale,
    font_size: f32,
    /// Which windows were open over the panels: dialog, reference, render options.
    over: [bool; 3],
    /// Whether the pointer has done nothing since one of them was opened.
    rests: bool,
    /// What had the keys before a dialog opened.
    focus: Option<egui::Id>,
    /// Frames until they get them back, from the dialog's last one on.
    asked: u8,
    /// Keys that were pressed in the meantime.
    held: Vec<egui::Event>,
}

impl App {
    /// Opens the files given; for what is not given, something that ships with vv.
    ///
    /// # Errors
    /// When the system gives no threads, or eframe no renderer.
    pub fn new(
        cc: &eframe::CreationContext<'_>,
        mesh: Option<PathBuf>,
        program: Option<PathBuf>,
    ) -> Result<Self, Box<dyn std::error::Error + Send + Sync>> {
        Self::with_store(cc, mesh, program, None)
    }

    /// As [`App::new`], with what was remembered, and remembers.
    ///
    /// # Errors
    /// As [`App::new`].
    pub fn with_store(
        cc: &eframe::CreationContext<'_>,
        mesh: Option<PathBuf>,
        program: Option<PathBuf>,
        store: Option<Store>,
    ) -> Result<Self, Box<dyn std::error::Error + Send + Sync>> {
        theme::install(&cc.egui_ctx);
        let render_state = cc.wgpu_render_state.clone().ok_or("the window has no graphics device")?;
        let ctx = cc.egui_ctx.clone();
        let wake: Arc<dyn Fn() + Send + Sync> = Arc::new(move || ctx.request_repaint());
        let session = Session::new(mesh, program, store, Arc::clone(&wake))?;
        Ok(Self {
            session,
            editors: editors::Editors::default(),
            pictures: pair::Pictures::new(&render_state, &wake)?,
            messages: messages::Messages::default(),
            reference: reference::Reference::default(),
            gallery: gallery::Gallery::default(),
            title: String::new(),
            quitting: false,
            full_screen: false,
            was_full_screen: false,
            scale: Scale::default(),
            font_size: 0.0,
            over: [false; 3],
            rests: false,
            focus: None,
            asked: 0,
            held: Vec::new(),
        })
    }

    /// What the window shows.
    #[must_use]
    pub fn session(&self) -> &Session {
        &self.session
    }

    /// What the window shows, to do what the system's dialogs do.
    pub fn session_mut(&mut self) -> &mut Session {
        &mut self.session
    }

    /// Carries a command out as if it came from a menu.
    pub fn apply(&mut self, command: Command) {
        self.session.apply(command);
    }

    /// Shows them; returns where the picture is.
    fn panels(&mut self, ui: &mut egui::Ui, commands: &mut Vec<Command>) -> egui::Rect {
        let (reveal, actions) = if self.session.panels.program {
            (self.session.reveal.take(), std::mem::take(&mut self.session.text_actions))
        } else {
            (None, Vec::new())
        };
        let session = &self.session;
        let width = ui.available_width();
        let viewport = VIEWPORT.max(width * VIEWPORT_PART);
        let inspector = if session.panels.inspector { INSPECTOR } else { 0.0 };
        let span = trace::span("window: bars");
        egui::Panel::top("menu").frame(theme::bar(ui)).show(ui, |ui| menu::show(ui, session, commands));
        egui::Panel::top("tools").frame(theme::bar(ui)).show(ui, |ui| toolbar::show(ui, session, commands));
        drop(span);
        if session.panels.program || session.panels.messages {
            let _span = trace::span("window: program and messages");
            egui::Panel::left("left")
                .frame(egui::Frame::NONE)
                .default_size((width * 0.36).clamp(240.0, 560.0))
                .size_range(200.0..=(width - inspector - viewport).max(220.0))
                .show(ui, |ui| {
                    let height = ui.available_height();
                    let mut below = None;
                    if session.panels.messages && session.panels.program {
                        egui::Panel::bottom("messages")
                            .frame(theme::panel(ui))
                            .resizable(true)
                            .default_size((height * 0.24).clamp(90.0, 260.0))
                            .size_range(60.0..=(height * 0.7).max(80.0))
                            .show(ui, |ui| {
                                below = Some(ui.available_rect_before_wrap());
                                ui.take_available_space();
                            });
                    } else if session.panels.messages {
                        let frame = theme::panel(ui);
                        egui::CentralPanel::default()
                            .frame(frame)
                            .show(ui, |ui| self.messages.show(ui, session, commands));
                    }
                    if session.panels.program {
                        let frame = theme::editor(ui);
                        egui::CentralPanel::default().frame(frame).show(ui, |ui| {
                            let editor = self.editors.of(ui.ctx(), session);
                            editor.show(ui, session, reveal, actions, commands);
                        });
                    }
                    // Made after what stands above it, as it is read.
                    if let Some(rect) = below {
                        let inside = egui::UiBuilder::new().id_salt("messages").max_rect(rect);
                        ui.scope_builder(inside, |ui| {
                            ui.set_clip_rect(rect.expand2(egui::vec2(2.0, 0.0)).intersect(ui.clip_rect()));
                            self.messages.show(ui, session, commands);
                        });
                    }
                });
        }
        if session.panels.inspector {
            let _span = trace::span("window: inspector");
            egui::Panel::right("inspector")
                .frame(theme::panel(ui))
                .default_size((width * 0.2).clamp(190.0, 290.0))
                .size_range(INSPECTOR..=(ui.available_width() - viewport).clamp(INSPECTOR, width * 0.5))
                .show(ui, |ui| inspector::show(ui, session, commands));
        }
        if session.panels.timeline {
            egui::Panel::bottom("timeline").frame(theme::bar(ui)).show(ui, |ui| timeline::show(ui, session, commands));
        }
        let picture = ui.available_rect_before_wrap();
        self.pictures.show(ui, &mut self.session, commands);
        picture
    }

    /// A frame may take long. What is typed after a key that changes what the next ones mean, waits for the next frame.
    fn hold_keys(&mut self, ctx: &egui::Context) {
        let dialog = self.session.dialog.is_some();
        ctx.input_mut(|i| {
            i.events.splice(0..0, self.held.drain(..));
            // The keys are not yet with those again who had them before the dialog.
            let from = if !dialog && self.asked > 0 { 0 } else { keys::one_after_another(&i.events, dialog) };
            let later = i.events.split_off(from);
            let (later, now): (Vec<_>, Vec<_>) = later.into_iter().partition(keys::is_typed);
            self.held = later;
            i.events.extend(now);
        });
        if !self.held.is_empty() {
            ctx.request_repaint();
        }
    }

    /// After a dialog the keys belong again to whom they belonged before.
    fn keep_focus(&mut self, ctx: &egui::Context) {
        match (self.session.dialog.is_some(), self.asked) {
            (true, _) => self.asked = 2,
            (false, 2) => {
                self.asked = 1; // in the first frame without the dialog egui still keeps the keys for it
                ctx.request_repaint();
            }
            (false, 1) => {
                self.asked = 0;
                if let Some(id) = self.focus {
                    ctx.memory_mut(|m| m.request_focus(id));
                    ctx.request_repaint(); // egui forgets in the next frame whom there is no more
                }
            }
            (false, _) => self.focus = ctx.memory(|m| m.focused()),
        }
    }

    fn close(&mut self, ctx: &egui::Context) {
        if self.session.wants_quit() && !self.quitting {
            self.quitting = true;
            ctx.send_viewport_cmd(egui::ViewportCommand::Close);
        } else if !self.quitting && ctx.input(|i| i.viewport().close_requested()) {
            self.session.apply(Command::Quit);
            if self.session.wants_quit() {
                self.quitting = true;
            } else {
                ctx.send_viewport_cmd(egui::ViewportCommand::CancelClose);
            }
        }
    }

    fn set_title(&mut self, ctx: &egui::Context) {
        let program = &self.session.document.program;
        let mark = if self.session.is_unsaved() { "● " } else { "" };
        let project = self.session.project_path().map(|path| format!("{}: ", crate::document::file_name(path)));
        let project = project.unwrap_or_default();
        let title = format!("{mark}{project}{} – {} – vv", program.name, self.session.document.mesh.name());
        if title != self.title {
            ctx.send_viewport_cmd(egui::ViewportCommand::Title(title.clone()));
            self.title = title;
        }
    }
}

/// Size of everything, which egui's keys change as well as the preferences.
#[derive(Default)]
struct Scale {
    /// What egui had last, and what it was asked for last.
    had: f32,
    asked: f32,
}

impl Scale {
    /// Brings both together; returns what the preferences shall say, if the keys have changed it.
    fn agree(&mut self, ctx: &egui::Context, wanted: f32) -> Option<f32> {
        let has = ctx.zoom_factor();
        let first = self.had == 0.0;
        if has != self.had && !first {
            let by_keys = has != self.asked;
            (self.had, self.asked) = (has, has);
            return by_keys.then_some(has);
        }
        self.had = has;
        if wanted != self.asked {
            self.asked = wanted;
            ctx.set_zoom_factor(wanted);
        }
        None
    }
}

impl eframe::App for App {
    fn logic(&mut self, ctx: &egui::Context, _frame: &mut eframe::Frame) {
        let _span = trace::span("window: polling");
        if let Some(pause) = self.session.poll() {
            ctx.request_repaint_after(pause);
        }
        ctx.set_theme(match self.session.theme {
            ThemeChoice::System => egui::ThemePreference::System,
            ThemeChoice::Light => egui::ThemePreference::Light,
            ThemeChoice::Dark => egui::ThemePreference::Dark,
        });
        let preferences = self.session.preferences;
        if self.font_size != preferences.font_size {
            self.font_size = preferences.font_size;
            theme::set_font_size(ctx, self.font_size);
        }
        if let Some(scale) = self.scale.agree(ctx, preferences.scale) {
            self.session.apply(Command::SetPreferences(Preferences { scale, ..preferences }));
        }
        self.close(ctx);
        self.set_title(ctx);
        let full_screen = ctx.input(|i| i.viewport().fullscreen).unwrap_or(false);
        if self.full_screen != self.session.full_screen {
            self.full_screen = self.session.full_screen;
            ctx.send_viewport_cmd(egui::ViewportCommand::Fullscreen(self.full_screen));
        } else if full_screen != self.was_full_screen {
            // The window manager, too, may end it.
            self.full_screen = full_screen;
            self.session.full_screen = full_screen;
        }
        self.was_full_screen = full_screen;
    }

    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let _span = trace::span("window: panels and picture");
        let mut commands = Vec::new();
        self.hold_keys(ui.ctx());
        self.keep_focus(ui.ctx());
        menu_keys::walk(ui.ctx());
        self.editors.current_mut().lead_on(ui.ctx());
        if self.session.dialog.is_none() {
            let reference = self.session.reference && self.reference.takes_escape(ui.ctx());
            let escape_is_taken = reference || self.editors.current().takes_escape(ui.ctx());
            keys::take(ui.ctx(), &self.session, escape_is_taken, &mut commands);
        }
        keys::take_dropped_files(ui.ctx(), &mut commands);
        let over = [self.session.dialog.is_some(), self.session.reference, self.session.render_options];
        // What opens by a key comes under a pointer that means nothing by it.
        let opens = std::mem::replace(&mut self.over, over) != over;
        self.rests = (self.rests || opens) && !keys::stirs(ui.ctx());
        let ctx = ui.ctx().clone();
        let covered = opens || self.session.dialog.is_some();
        let picture = keys::unpointed(&ctx, covered, || self.panels(ui, &mut commands));
        render_options::show(ui.ctx(), picture, &self.session, &mut commands);
        if self.session.reference {
            self.reference.show(ui.ctx(), &mut commands);
        }
        drop::show(ui.ctx());
        if self.session.dialog.is_some() {
            let _span = trace::span("window: dialog");
            keys::unpointed(&ctx, self.rests, || {
                dialogs::show(&ctx, &mut self.session, &mut self.gallery, &mut commands);
            });
        }
        // What had the keys in a dialog that has just gone is not there any more.
        let settled = self.session.dialog.is_some() || self.asked == 0;
        if settled && !editor::has_keys(ui.ctx()) {
            theme::focus_ring(ui.ctx());
        }
        clicks::take_pointed(ui.ctx(), &self.session, &mut commands);
        mask::take_pointed(ui.ctx(), &self.session, &mut commands);
        if !commands.is_empty() {
            // What they change is seen in the next frame.
            ui.ctx().request_repaint();
        }
        let changed = !commands.is_empty();
        for command in commands {
            self.session.apply(command);
        }
        if let Some(text) = self.session.copied.take() {
            ui.ctx().copy_text(text);
        }
        if std::mem::take(&mut self.session.asks_clipboard) {
            ui.ctx().send_viewport_cmd(egui::ViewportCommand::RequestPaste);
        }
        if changed {
            self.session.start(); // the worker need not wait for the next frame
        }
    }
}
