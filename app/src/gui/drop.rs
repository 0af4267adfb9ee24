//! What would become of the files that hang over the window.

use std::path::Path;

use eframe::egui::{
    Align2, Color32, Context, CornerRadius, FontId, Id, LayerId, Order, Stroke, StrokeKind, TextStyle, pos2,
};
use vv::io::Format;

use crate::document::file_name;
use crate::{project, style_file};

/// Most files that are told of one by one.
const MOST: usize = 6;

/// Shows it, if there are some.
pub fn show(ctx: &Context) {
    let files = ctx.input(|i| i.raw.hovered_files.iter().map(|f| f.path.clone()).collect::<Vec<_>>());
    if files.is_empty() {
        return;
    }
    let visuals = ctx.global_style().visuals.clone();
    let painter = ctx.layer_painter(LayerId::new(Order::Tooltip, Id::unique("drop")));
    let room = ctx.content_rect();
    painter.rect_filled(room, CornerRadius::ZERO, visuals.panel_fill.gamma_multiply(0.8));
    let frame = room.shrink(14.0);
    painter.rect_stroke(frame, CornerRadius::same(10), Stroke::new(2.0, visuals.hyperlink_color), StrokeKind::Inside);
    let mut lines: Vec<String> =
        files.iter().take(MOST).map(|path| path.as_deref().map_or_else(unknown, meaning)).collect();
    if files.len() > MOST {
        lines.push(format!("and {} more", files.len() - MOST));
    }
    let body = TextStyle::Body.resolve(&ctx.global_style());
    let mut y = room.center().y - 16.0 * lines.len() as f32 - 20.0;
    let mut line = |text: &str, font: FontId, color: Color32| {
        let rect = painter.text(pos2(room.center().x, y), Align2::CENTER_TOP, text, font, color);
        y = rect.bottom() + 8.0;
    };
    line("Drop to open", FontId::proportional(20.0), visuals.strong_text_color());
    for text in &lines {
        line(text, body.clone(), visuals.text_color());
    }
}

fn unknown() -> String {
    "a file".to_owned()
}

/// What a file would be opened as.
fn meaning(path: &Path) -> String {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let name = file_name(path);
    if extension == "vv" {
        format!("{name}, in place of the program")
    } else if extension == project::EXTENSION {
        format!("{name}, a project: program, mesh, parameters and view")
    } else if Format::from_extension(&extension).is_some() {
        format!("{name}, in place of the mesh")
    } else if extension == style_file::EXTENSION {
        format!("{name}, a style: how things are shown")
    } else {
        format!("{name} is neither mesh nor program, project or style")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_dropped_is_told_of() {
        assert_eq!(meaning(Path::new("/a/b.VV")), "b.VV, in place of the program");
        assert_eq!(meaning(Path::new("b.vvp")), "b.vvp, a project: program, mesh, parameters and view");
        assert_eq!(meaning(Path::new("b.stl")), "b.stl, in place of the mesh");
        assert_eq!(meaning(Path::new("b.txt")), "b.txt is neither mesh nor program, project or style");
        assert_eq!(meaning(Path::new("b.json")), "b.json, a style: how things are shown");
    }
}
