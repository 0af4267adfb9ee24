//! The directions of the axes, in a corner of the picture.

use eframe::egui::{Align2, Color32, FontId, Rect, Stroke, Ui, vec2};
use glam::DVec3;

use crate::camera::Camera;

/// Draws them.
pub fn show(ui: &Ui, rect: Rect, camera: &Camera) {
    const LENGTH: f32 = 26.0;
    let center = rect.left_bottom() + vec2(46.0, -74.0);
    let dark = ui.visuals().dark_mode;
    let view = camera.world_from_view.conjugate();
    let colors = if dark {
        [Color32::from_rgb(0xff, 0x7a, 0x6b), Color32::from_rgb(0x7f, 0xd6, 0x8a), Color32::from_rgb(0x7f, 0xb2, 0xff)]
    } else {
        [Color32::from_rgb(0xc4, 0x2a, 0x1e), Color32::from_rgb(0x1d, 0x7a, 0x2f), Color32::from_rgb(0x1a, 0x52, 0xcc)]
    };
    let mut axes: Vec<_> =
        [DVec3::X, DVec3::Y, DVec3::Z].map(|a| view * a).into_iter().zip(["x", "y", "z"]).zip(colors).collect();
    axes.sort_by(|a, b| a.0.0.z.total_cmp(&b.0.0.z)); // what points to the eye is drawn last
    let painter = ui.painter();
    painter.circle_filled(center, LENGTH + 18.0, ui.visuals().window_fill.gamma_multiply(0.55));
    for ((direction, name), color) in axes {
        let along = vec2(direction.x as f32, -direction.y as f32);
        let color = if direction.z < -0.05 { color.gamma_multiply(0.6) } else { color };
        let tip = center + along * LENGTH;
        painter.line_segment([center, tip], Stroke::new(2.0, color));
        painter.circle_filled(tip, 2.5, color);
        let aside = if along.length() > 0.15 { along.normalized() } else { vec2(0.7, -0.7) };
        painter.text(tip + aside * 8.0, Align2::CENTER_CENTER, name, FontId::proportional(12.0), color);
    }
}
