//! The picture and the hands on it: [`crate::navigation`] says what they do.

mod empty;
mod hands;
mod lost;

use std::sync::Arc;

use eframe::egui::{
    self, Align2, Color32, CornerRadius, FontId, Margin, Pos2, Rect, Role, Sense, TextStyle, Ui, WidgetInfo, pos2, vec2,
};
use eframe::egui_wgpu::RenderState;
use vv::diagnostic::Severity;

use super::overlay::Overlay;
use super::picture::{Picture, Wardrobe};
use super::widgets::{grouped, seconds};
use super::{clicks, context, gizmo, labels, legend, marks, messages, theme};
use crate::camera::Camera;
use crate::command::{Command, ViewAction};
use crate::render::{RenderError, Size};
use crate::scene::{Style, Theme};
use crate::session::{Origin, Session, Stale};
use crate::trace;
use crate::worker::Frame;

use hands::Hands;

/// Height of the sign that says why a picture is not what is wanted, with what is around it.
const BADGE: f32 = 58.0;
/// Seconds after which it is said that something is computed: what is done at once needs no announcement.
const SLOW: f64 = 0.15;
/// A message that has less width than this is put elsewhere.
const LEAST_PILL: f32 = 220.0;

/// The panel's own state.
pub struct Viewport {
    picture: Picture,
    hands: Hands,
    labels: labels::Labels,
    context: context::Context,
    /// What just fitted into a picture of this size, beside a strip that says what colours mean or without.
    fitted: Option<(Camera, (Size, bool))>,
    wake: Arc<dyn Fn() + Send + Sync>,
}

impl Viewport {
    /// On the window's device. `wake` is called, from another thread, when there is more to show.
    ///
    /// # Errors
    /// If the driver refuses a pipeline.
    pub fn new(state: RenderState, wake: Arc<dyn Fn() + Send + Sync>) -> Result<Self, RenderError> {
        let picture = Picture::new(state, Arc::clone(&wake))?;
        Ok(Self {
            picture,
            hands: Hands::default(),
            labels: labels::Labels::default(),
            context: context::Context::default(),
            fitted: None,
            wake,
        })
    }

    /// Shows it, called `name` for those who cannot see it. Takes [`Session::fit`].
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session, name: &str, commands: &mut Vec<Command>) {
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, name));
        let frame = session.frame().cloned();
        let Some(frame) = frame.filter(|frame| frame.mesh.vertex_count() > 0) else {
            empty::show(ui, rect, session, commands);
            news(ui, rect, session, None);
            return;
        };
        let (theme, up, backdrop) = (theme_of(ui), session.navigation.up, session.backdrop());
        let style = Style { theme, up, backdrop, ..session.document.style };
        let size = pixels(rect, ui.pixels_per_point());
        let mut camera = session.document.camera;
        let _span = trace::span("window: viewport");
        let colors = session.colors();
        let strip = legend::strip_height(ui, rect, colors.as_ref());
        let room = (size, strip > 0.0);
        let covered = Counts::of(ui, rect, &frame).height() + strip;
        let below = f64::from(covered / rect.height().max(1.0));
        // Nobody has turned or moved it since: it fits into a picture of another size, too.
        session.fit |= self.fitted.is_some_and(|(fitted, into)| fitted == camera && into != room);
        if session.fit && !session.is_busy() && frame.scene.fits_at_once() {
            session.fit = false;
            let fit = |camera, aspect| frame.scene.fit(camera, &style, aspect);
            let fitted = session.aim().fit_above(below, size.aspect(), fit);
            self.fitted = Some((fitted, room));
            // What was there before is left by gliding; what is new is seen at once.
            if std::mem::take(&mut session.asked_to_fit) {
                commands.push(Command::View(ViewAction::Glide(fitted)));
            } else {
                camera = fitted;
                commands.push(Command::SetCamera(camera));
            }
        } else if !ui.input(|i| i.pointer.any_down())
            && let Some(led) = session.lead(size, &style, below)
        {
            self.fitted = Some((led, room));
            commands.push(Command::View(ViewAction::Glide(led)));
        }
        if let Some(moved) = self.hands.moved(ui, &response, &session.navigation, camera, &frame.scene, &style) {
            camera = moved;
            commands.push(Command::SetCamera(camera));
        }
        session.view = Some((size, style));
        let dress = Wardrobe {
            tint: colors.as_ref().and_then(|colors| colors.as_ref().ok()).cloned(),
            arrows: session.arrows(),
            arrow_length: session.document.annotations.arrow_length,
        };
        match self.picture.texture(size, &frame.scene, &dress, &camera, &style) {
            Ok(texture) => {
                let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
                ui.painter().image(texture, rect, whole, Color32::WHITE);
            }
            Err(error) => {
                ui.painter().rect_filled(rect, 0.0, ui.visuals().extreme_bg_color);
                centered(ui, rect, &["there is no picture", &error.to_string()]);
            }
        }
        if session.stale().is_some() {
            let veil = ui.visuals().panel_fill.gamma_multiply(0.45);
            ui.painter().rect_filled(rect, 0.0, veil);
        }
        let _span = trace::span("window: marks");
        let inks = Overlay::new(ui, rect, camera, &frame.scene, &style);
        let spread = camera.spread(f64::from(2.0 * clicks::NEAR / rect.height()));
        let labels = &session.document.annotations.labels;
        let sight = clicks::Sight { overlay: &inks, session, frame: &frame, spread };
        clicks::take(ui, &response, sight, commands);
        self.context.show(&response, sight, commands);
        marks::show(ui, &inks, session, &frame);
        inks.write();
        self.labels.show(ui, &inks, &frame, (labels, labels::outlook(camera, style, rect)), &self.wake);
        let pointer = response.hover_pos().map(|at| hands::pointer(rect, at, &camera, inks.cut()));
        let plate = if backdrop.is_some() { 0.95 } else { 0.75 };
        let counts = Counts::of(ui, rect, &frame);
        let room = counts.show(ui, rect, plate, legend::width(rect, colors.as_ref()));
        let legend = legend::show(ui, room, session, &frame, colors.as_ref(), pointer);
        if style.axes {
            gizmo::show(ui, rect, &camera);
        }
        if frame.scene.mesh.vertex_count == 0 {
            lost::show(ui, rect, "no position is a number that can be drawn", None, commands);
        } else if !session.fit && !session.glides() && frame.scene.is_out_of_sight(&camera, &style, size.aspect()) {
            lost::show(ui, rect, "the mesh is out of sight", Some(Command::Fit), commands);
        }
        overlay(ui, rect, session, legend);
    }
}

/// Whole pixels, at least one.
fn pixels(rect: Rect, scale: f32) -> Size {
    let count = |length: f32| (length * scale).round().max(1.0) as u32;
    Size { width: count(rect.width()), height: count(rect.height()), scale }
}

fn theme_of(ui: &Ui) -> Theme {
    if ui.visuals().dark_mode { Theme::Dark } else { Theme::Light }
}

/// What stands over the picture.
fn overlay(ui: &mut Ui, rect: Rect, session: &Session, legend: Option<Rect>) {
    let visuals = ui.visuals().clone();
    match (session.stale(), session.halted()) {
        (Some(Stale::Failed(message)), halted) => {
            let title = match (session.origin(), halted) {
                (Origin::Mesh, _) => "nothing computed: the mesh as read".to_owned(),
                (Origin::Former, _) => format!("stale: {}", session.shown_as()),
                (Origin::This, Some(halted)) => {
                    format!("stale: last good result; generation {} failed", halted.generation)
                }
                (Origin::This, None) => "stale: last good result".to_owned(),
            };
            // That was the fault of what was wanted before.
            match is_slow(session) {
                Some(_) => badge(ui, rect, visuals.warn_fg_color, &title, "what is wanted now is being computed"),
                None => badge(ui, rect, visuals.error_fg_color, &title, message),
            }
        }
        (Some(Stale::Stopped), _) => {
            badge(ui, rect, visuals.warn_fg_color, "stale: stopped", "what is wanted was not computed");
        }
        (None, Some(halted)) => {
            let title = format!("generation {} failed", halted.generation);
            badge(ui, rect, visuals.error_fg_color, &title, &halted.message);
        }
        (None, None) => {}
    }
    news(ui, rect, session, legend);
}

/// The counts at the lower edge, in as many lines as they need; no number is broken.
struct Counts {
    lines: Vec<String>,
    galley: Arc<egui::Galley>,
}

impl Counts {
    fn of(ui: &Ui, rect: Rect, frame: &Frame) -> Self {
        let s = &frame.statistics;
        let parts = [
            format!("generation {}", frame.request.generation),
            format!("{} vertices", grouped(s.vertices)),
            format!("{} edges", grouped(s.edges)),
            format!("{} faces", grouped(s.faces)),
        ];
        let (font, color) = (TextStyle::Small.resolve(ui.style()), ui.visuals().weak_text_color());
        let lay = |text: String| ui.painter().layout_no_wrap(text, font.clone(), color);
        let mut lines: Vec<String> = Vec::new();
        for part in parts {
            match lines.last_mut() {
                Some(line) if lay(format!("{line}   {part}")).size().x <= rect.width() - 20.0 => {
                    line.push_str("   ");
                    line.push_str(&part);
                }
                _ => lines.push(part),
            }
        }
        let galley = lay(lines.join("\n"));
        Self { lines, galley }
    }

    /// Of what they cover at the lower edge.
    fn height(&self) -> f32 {
        self.galley.size().y + 10.0
    }

    /// Shows them. Returns the room above them, where something as wide as `beside` may stand at the right.
    fn show(self, ui: &Ui, rect: Rect, opacity: f32, beside: f32) -> Rect {
        let size = self.galley.size();
        let at = rect.left_bottom() + vec2(10.0, -8.0 - size.y);
        // Grid and mesh may lie behind it, and any colour.
        let plate = Rect::from_min_size(at, size).expand2(vec2(5.0, 2.0));
        ui.painter().rect_filled(plate, 4.0, ui.visuals().panel_fill.gamma_multiply(opacity));
        let spoken = self.lines.join(", ").replace("   ", ", ");
        let said = ui.interact(plate, ui.scope_id().with("counts"), Sense::empty());
        said.widget_info(|| WidgetInfo::labeled(Role::Label, true, &spoken));
        let color = ui.visuals().weak_text_color();
        ui.painter().galley(at, self.galley, color);
        let apart = size.x + 30.0 + beside <= rect.width();
        if apart { rect } else { rect.with_max_y(rect.bottom() - size.y - 6.0) }
    }
}

/// For how long something has been computed, and which generation, if somebody waits for it.
fn is_slow(session: &Session) -> Option<(f64, Option<u64>)> {
    session.progress().filter(|(elapsed, _)| *elapsed > SLOW)
}

/// What is going on, and what has just happened.
fn news(ui: &Ui, rect: Rect, session: &Session, legend: Option<Rect>) {
    let visuals = ui.visuals().clone();
    if let Some((elapsed, generation)) = is_slow(session) {
        let what = generation.map_or("reading".to_owned(), |g| format!("computing generation {g}"));
        let text = format!("{what}, {} …", seconds(elapsed));
        // Below what is said at the upper edge, if that leaves no room beside it.
        let below = if session.stale().is_some() || session.halted().is_some() { BADGE } else { 0.0 };
        let at = rect.right_top() + vec2(-10.0, 10.0 + below);
        pill(ui, at, Align2::RIGHT_TOP, rect.width() - 20.0, &text, visuals.hyperlink_color);
    }
    if let Some((severity, text)) = session.notice() {
        let color = match severity {
            Severity::Note => visuals.text_color(),
            other => theme::severity(&visuals, other),
        };
        // Beside what the colours mean, or above it where there is no room.
        let right = legend.map_or(rect.right(), |legend| legend.left());
        let width = right - rect.left() - 20.0;
        if legend.is_none() || width >= LEAST_PILL {
            let at = pos2((rect.left() + right) / 2.0, rect.bottom() - 32.0);
            pill(ui, at, Align2::CENTER_BOTTOM, width, text, color);
        } else {
            let at = rect.center_top() + vec2(0.0, 10.0 + BADGE);
            pill(ui, at, Align2::CENTER_TOP, rect.width() - 20.0, text, color);
        }
    }
}

/// A sign that cannot be overlooked, in the corner, where it covers least of the surface.
fn badge(ui: &mut Ui, rect: Rect, color: Color32, title: &str, text: &str) {
    let padding = Margin::symmetric(10, 5);
    let most = (rect.width() - 20.0 - padding.sum().x).clamp(60.0, 380.0);
    let small = TextStyle::Small.resolve(ui.style());
    let text = messages::in_short(text);
    // As wide as the text, if there is room.
    let wanted = [title, &text].map(|t| ui.painter().layout_no_wrap(t.to_owned(), small.clone(), color).size().x);
    let width = (wanted[0].max(wanted[1]) + 2.0).min(most);
    let place = Rect::from_min_size(rect.left_top() + vec2(10.0, 10.0), vec2(width + padding.sum().x + 3.0, BADGE));
    let shown = ui.scope_builder(egui::UiBuilder::new().max_rect(place), |ui| {
        egui::Frame::NONE
            .fill(ui.visuals().window_fill.gamma_multiply(0.94))
            .stroke(egui::Stroke::new(1.0, color))
            .corner_radius(CornerRadius::same(7))
            .inner_margin(padding)
            .show(ui, |ui| {
                ui.set_width(width);
                ui.spacing_mut().item_spacing.y = 1.0;
                ui.label(egui::RichText::new(title).small().color(color).strong());
                let mut job = egui::text::LayoutJob::simple(text.clone(), small, ui.visuals().text_color(), width);
                job.wrap.max_rows = 2;
                ui.label(job);
            });
    });
    shown.response.on_hover_text(text);
}

/// A short message, in a few lines of at most `width`.
fn pill(ui: &Ui, at: Pos2, align: Align2, width: f32, text: &str, color: Color32) {
    let padding = vec2(12.0, 5.0);
    let most = (width - 2.0 * padding.x).max(80.0);
    let font = TextStyle::Body.resolve(ui.style());
    let mut job = egui::text::LayoutJob::simple(messages::in_short(text), font, color, most);
    job.wrap.max_rows = 4;
    let galley = ui.painter().layout_job(job);
    let rect = align.anchor_size(at, galley.size() + 2.0 * padding);
    ui.painter().rect(
        rect,
        CornerRadius::same(12),
        ui.visuals().window_fill.gamma_multiply(0.94),
        ui.visuals().window_stroke,
        egui::StrokeKind::Inside,
    );
    ui.painter().galley(rect.min + padding, galley, color);
}

/// Lines of text in the middle, the first one large.
fn centered(ui: &Ui, rect: Rect, lines: &[&str]) {
    let mut y = rect.center().y - 20.0;
    for (i, line) in lines.iter().enumerate() {
        let font = if i == 0 { FontId::proportional(18.0) } else { TextStyle::Body.resolve(ui.style()) };
        let color = if i == 0 { ui.visuals().text_color() } else { ui.visuals().weak_text_color() };
        let galley = ui.painter().layout((*line).to_owned(), font, color, (rect.width() - 40.0).max(40.0));
        let at = pos2(rect.center().x - galley.size().x / 2.0, y);
        y += galley.size().y + 8.0;
        ui.painter().galley(at, galley, color);
    }
}
