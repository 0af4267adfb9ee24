//! Colours, fonts and distances.

use eframe::egui::{
    Color32, Context, CornerRadius, FontDefinitions, FontFamily, FontId, Frame, Id, Margin, Stroke, StrokeKind, Style,
    TextStyle, Theme, Ui, Visuals, epaint::FontColorTransferFunction, epaint::Shadow, vec2,
};
use vv::diagnostic::Severity;
use vv::syntax::TokenClass;

/// Sets both themes and the fonts up.
pub fn install(ctx: &Context) {
    let mut fonts = FontDefinitions::default();
    // Each knows signs that the other lacks.
    let names: Vec<String> = fonts.families.values().flatten().cloned().collect();
    for family in fonts.families.values_mut() {
        for name in &names {
            if !family.contains(name) {
                family.push(name.clone());
            }
        }
    }
    ctx.set_fonts(fonts);
    for theme in [Theme::Dark, Theme::Light] {
        ctx.style_mut_of(theme, |style| {
            fonts_and_distances(style);
            style.visuals = if theme == Theme::Dark { dark() } else { light() };
        });
    }
}

fn fonts_and_distances(style: &mut Style) {
    let proportional = |size| FontId::new(size, FontFamily::Proportional);
    style.text_styles = [
        (TextStyle::Small, proportional(11.0)),
        (TextStyle::Body, proportional(13.5)),
        (TextStyle::Button, proportional(13.5)),
        (TextStyle::Heading, proportional(16.0)),
        (TextStyle::Monospace, FontId::new(13.0, FontFamily::Monospace)),
    ]
    .into();
    let spacing = &mut style.spacing;
    spacing.item_spacing = vec2(8.0, 5.0);
    spacing.button_padding = vec2(8.0, 3.0);
    spacing.interact_size = vec2(36.0, 22.0);
    spacing.icon_width = 15.0;
    spacing.icon_width_inner = 8.0;
    spacing.icon_spacing = 6.0;
    spacing.menu_margin = Margin::same(6);
    spacing.window_margin = Margin::same(14);
    spacing.slider_rail_height = 4.0;
    spacing.tooltip_width = 420.0;
}

/// Sets the height of the program's letters.
pub fn set_font_size(ctx: &Context, size: f32) {
    ctx.all_styles_mut(|style| {
        style.text_styles.insert(TextStyle::Monospace, FontId::new(size, FontFamily::Monospace));
    });
}

fn rounded(visuals: &mut Visuals) {
    let radius = CornerRadius::same(5);
    let widgets = &mut visuals.widgets;
    for widget in [
        &mut widgets.noninteractive,
        &mut widgets.inactive,
        &mut widgets.hovered,
        &mut widgets.active,
        &mut widgets.open,
    ] {
        widget.corner_radius = radius;
        widget.expansion = 0.0;
    }
    visuals.menu_corner_radius = CornerRadius::same(7);
    visuals.window_corner_radius = CornerRadius::same(9);
    // Straight below, so that all sides of a window stand off alike.
    let shadow = |down, blur, alpha| Shadow {
        offset: [0, down],
        blur,
        spread: 0,
        color: Color32::from_black_alpha(if visuals.dark_mode { 2 * alpha } else { alpha }),
    };
    (visuals.window_shadow, visuals.popup_shadow) = (shadow(10, 36, 46), shadow(5, 18, 36));
}

fn dark() -> Visuals {
    let mut v = Visuals::dark();
    rounded(&mut v);
    v.panel_fill = Color32::from_rgb(0x22, 0x25, 0x2b);
    v.window_fill = Color32::from_rgb(0x28, 0x2c, 0x33);
    v.window_stroke = Stroke::new(1.0, Color32::from_rgb(0x3c, 0x42, 0x4c));
    v.extreme_bg_color = Color32::from_rgb(0x17, 0x19, 0x1d);
    v.faint_bg_color = Color32::from_rgb(0x2a, 0x2e, 0x35);
    v.widgets.noninteractive.bg_stroke = Stroke::new(1.0, Color32::from_rgb(0x36, 0x3b, 0x44));
    v.widgets.noninteractive.fg_stroke = Stroke::new(1.0, Color32::from_rgb(0xd0, 0xd6, 0xdf));
    v.widgets.inactive.weak_bg_fill = Color32::from_rgb(0x33, 0x38, 0x41);
    v.widgets.inactive.bg_fill = Color32::from_rgb(0x3a, 0x40, 0x4a);
    v.widgets.inactive.fg_stroke = Stroke::new(1.0, Color32::from_rgb(0xd6, 0xdb, 0xe3));
    v.widgets.hovered.weak_bg_fill = Color32::from_rgb(0x3a, 0x40, 0x4a);
    v.widgets.hovered.bg_stroke = Stroke::new(1.0, Color32::from_rgb(0x5b, 0x64, 0x73));
    v.widgets.open.weak_bg_fill = Color32::from_rgb(0x2f, 0x34, 0x3c);
    v.selection.bg_fill = Color32::from_rgb(0x2b, 0x5a, 0x9e);
    v.selection.stroke = Stroke::new(1.0, Color32::from_rgb(0xe6, 0xf0, 0xff));
    v.hyperlink_color = Color32::from_rgb(0x74, 0xae, 0xff);
    v.error_fg_color = Color32::from_rgb(0xff, 0x7a, 0x7a);
    v.warn_fg_color = Color32::from_rgb(0xf0, 0xb4, 0x4c);
    v.weak_text_color = Some(Color32::from_rgb(0xa5, 0xae, 0xbb));
    v
}

fn light() -> Visuals {
    let mut v = Visuals::light();
    rounded(&mut v);
    // Thin dark letters on a light ground look paler than they are.
    v.text_options.color_transfer_function = FontColorTransferFunction::Gamma(0.65);
    v.panel_fill = Color32::from_rgb(0xf3, 0xf4, 0xf6);
    v.window_fill = Color32::from_rgb(0xfb, 0xfb, 0xfc);
    v.window_stroke = Stroke::new(1.0, Color32::from_rgb(0xcf, 0xd4, 0xdb));
    v.extreme_bg_color = Color32::WHITE;
    v.faint_bg_color = Color32::from_rgb(0xe9, 0xeb, 0xef);
    v.widgets.noninteractive.bg_stroke = Stroke::new(1.0, Color32::from_rgb(0xd7, 0xdb, 0xe1));
    v.widgets.noninteractive.fg_stroke = Stroke::new(1.0, Color32::from_rgb(0x32, 0x38, 0x42));
    v.widgets.inactive.weak_bg_fill = Color32::from_rgb(0xe4, 0xe7, 0xec);
    v.widgets.inactive.bg_fill = Color32::from_rgb(0xd3, 0xd8, 0xdf);
    v.widgets.inactive.fg_stroke = Stroke::new(1.0, Color32::from_rgb(0x2b, 0x31, 0x3b));
    v.widgets.hovered.weak_bg_fill = Color32::from_rgb(0xdd, 0xe1, 0xe8);
    v.widgets.hovered.bg_stroke = Stroke::new(1.0, Color32::from_rgb(0x9a, 0xa4, 0xb2));
    v.widgets.open.weak_bg_fill = Color32::from_rgb(0xe4, 0xe7, 0xec);
    // White on white would hide where one may type.
    v.text_edit_bg_color = Some(Color32::from_rgb(0xec, 0xee, 0xf2));
    v.selection.bg_fill = Color32::from_rgb(0xb8, 0xd6, 0xff);
    v.selection.stroke = Stroke::new(1.0, Color32::from_rgb(0x0b, 0x3d, 0x91));
    v.hyperlink_color = Color32::from_rgb(0x1a, 0x5a, 0xb8);
    v.error_fg_color = Color32::from_rgb(0xbe, 0x22, 0x22);
    v.warn_fg_color = Color32::from_rgb(0x8a, 0x52, 0x00);
    v.weak_text_color = Some(Color32::from_rgb(0x58, 0x61, 0x6e));
    v
}

/// Shows which part has the keys, around whatever it is; for the end of a pass.
pub fn focus_ring(ctx: &Context) {
    // What was closed has the keys until the end of the pass.
    let shown = |id: &Id| ctx.viewport(|viewport| viewport.this_pass.widgets.contains(*id));
    let focused = ctx.memory(|m| m.focused()).filter(shown);
    let Some(response) = focused.and_then(|id| ctx.read_response(id)) else { return };
    let visible = response.rect.intersect(response.interact_rect.expand(2.0));
    let clip = response.interact_rect.expand(3.0);
    if visible.is_positive() {
        let visuals = &ctx.global_style().visuals;
        let painter = ctx.layer_painter(response.layer_id).with_clip_rect(clip);
        // Over the line that a text field draws by itself, else there would be two.
        let ring = response.rect.expand(1.0);
        painter.rect_stroke(ring, 6.0, Stroke::new(1.0, visuals.panel_fill), StrokeKind::Outside);
        painter.rect_stroke(ring, 6.0, Stroke::new(2.0, visuals.hyperlink_color), StrokeKind::Inside);
    }
}

/// The frame of menu and tool bar.
pub fn bar(ui: &Ui) -> Frame {
    Frame::NONE.fill(ui.visuals().panel_fill).inner_margin(Margin::symmetric(12, 4))
}

/// Points beside what a panel shows.
const BESIDE: i8 = 12;

/// The frame of a side panel. Its right margin is left to what it shows, [`beside_bar`].
pub fn panel(ui: &Ui) -> Frame {
    Frame::NONE.fill(ui.visuals().panel_fill).inner_margin(Margin { left: BESIDE, right: 0, top: 8, bottom: 8 })
}

/// The right margin in a panel, in which a scroll bar has its place beside the text.
pub fn beside_bar() -> Margin {
    Margin { right: BESIDE, ..Margin::ZERO }
}

/// The frame of the program's text.
pub fn editor(ui: &Ui) -> Frame {
    Frame::NONE.fill(ui.visuals().extreme_bg_color)
}

/// The colour of a message.
pub fn severity(visuals: &Visuals, severity: Severity) -> Color32 {
    match severity {
        Severity::Error => visuals.error_fg_color,
        Severity::Warning => visuals.warn_fg_color,
        Severity::Note => visuals.hyperlink_color,
    }
}

/// The colour of a token.
pub fn token(dark: bool, class: TokenClass) -> Color32 {
    let (on_dark, on_light) = match class {
        TokenClass::Keyword | TokenClass::Directive => (0xc5_92_f0, 0x7c_3a_bf),
        TokenClass::Algebra => (0x6c_b2_ff, 0x0b_57_b8),
        TokenClass::Type => (0x5f_d0_c0, 0x0c_76_70),
        TokenClass::Function => (0xe8_d4_8a, 0x7a_5b_00),
        TokenClass::Property => (0xf0_9a_76, 0xa8_44_12),
        TokenClass::Old => (0xff_7a_90, 0xc2_1f_4b),
        TokenClass::Name => (0xd5_da_e2, 0x23_28_30),
        TokenClass::Literal => (0xb5_d6_84, 0x3e_6b_08),
        TokenClass::Text => (0xb5_d6_84, 0x3e_6b_08),
        TokenClass::Comment => (0x8e_98_a6, 0x5f_68_75),
        TokenClass::Punctuation => (0xa2_ab_b8, 0x56_5e_6a),
        TokenClass::Error => (0xff_7a_7a, 0xbe_22_22),
    };
    let rgb: u32 = if dark { on_dark } else { on_light };
    let [_, r, g, b] = rgb.to_be_bytes();
    Color32::from_rgb(r, g, b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::{RawInput, Shape};

    /// How light a colour is, from 0 to 1 (WCAG 2.2, relative luminance).
    fn luminance(color: Color32) -> f64 {
        let linear = |c: u8| {
            let c = f64::from(c) / 255.0;
            if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
        };
        0.2126 * linear(color.r()) + 0.7152 * linear(color.g()) + 0.0722 * linear(color.b())
    }

    /// WCAG 2.2, contrast ratio.
    fn contrast(a: Color32, b: Color32) -> f64 {
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    /// What text of 11 points needs to be read without strain.
    #[track_caller]
    fn readable(what: &str, ink: Color32, ground: Color32) {
        let ratio = contrast(ink, ground);
        assert!(ink.is_opaque() && ratio >= 4.5, "{what}: {ink:?} on {ground:?} has {ratio:.2}");
    }

    #[test]
    fn black_on_white_has_the_greatest_contrast() {
        assert!((contrast(Color32::BLACK, Color32::WHITE) - 21.0).abs() < 1e-9);
    }

    #[test]
    fn all_text_can_be_read_on_all_grounds() {
        for (theme, v) in [("dark", dark()), ("light", light())] {
            let grounds = [
                v.panel_fill,
                v.window_fill,
                v.extreme_bg_color,
                v.faint_bg_color,
                v.widgets.inactive.weak_bg_fill,
                v.widgets.hovered.weak_bg_fill,
            ];
            let inks = [("text", v.text_color()), ("weak", v.weak_text_color()), ("link", v.hyperlink_color)];
            for (what, ink) in inks {
                grounds.iter().for_each(|&ground| readable(&format!("{theme} {what}"), ink, ground));
            }
            for (what, ink) in [("error", v.error_fg_color), ("warning", v.warn_fg_color)] {
                grounds[..5].iter().for_each(|&ground| readable(&format!("{theme} {what}"), ink, ground));
            }
            readable(&format!("{theme} selection"), v.selection.stroke.color, v.selection.bg_fill);
            for w in [&v.widgets.inactive, &v.widgets.hovered, &v.widgets.active, &v.widgets.open] {
                readable(&format!("{theme} button"), w.text_color(), w.weak_bg_fill);
            }
            assert!(contrast(v.hyperlink_color, v.panel_fill) >= 3.0, "{theme}: the focus ring is seen");
        }
    }

    #[test]
    fn all_tokens_can_be_read_also_in_the_line_of_the_cursor() {
        use TokenClass as T;
        let classes = [
            T::Keyword,
            T::Directive,
            T::Algebra,
            T::Type,
            T::Function,
            T::Property,
            T::Old,
            T::Name,
            T::Literal,
            T::Text,
            T::Comment,
            T::Punctuation,
            T::Error,
        ];
        for (is_dark, v) in [(true, dark()), (false, light())] {
            for class in classes {
                for ground in [v.extreme_bg_color, v.faint_bg_color] {
                    readable(&format!("{class:?}"), token(is_dark, class), ground);
                }
            }
        }
    }

    #[test]
    fn what_was_closed_has_no_focus_ring_left() {
        let ctx = Context::default();
        let mut is_ringed = |is_open: bool| {
            let mut output = ctx.run_ui(RawInput::default(), |ui| {
                if is_open {
                    ui.button("mine").request_focus();
                }
                focus_ring(ui.ctx());
            });
            output.textures_delta.clear();
            let ink = ctx.global_style().visuals.hyperlink_color;
            output.shapes.iter().any(|s| matches!(&s.shape, Shape::Rect(rect) if rect.stroke.color == ink))
        };
        assert_eq!([true, true, false].map(&mut is_ringed), [true, true, false]);
    }
}
