//! Colours, fonts and distances.

use eframe::egui::{
    Color32, Context, CornerRadius, FontDefinitions, FontFamily, FontId, Frame, Margin, Stroke, Style, TextStyle,
    Theme, Ui, Visuals, vec2,
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
    v.widgets.noninteractive.fg_stroke = Stroke::new(1.0, Color32::from_rgb(0xc4, 0xca, 0xd4));
    v.widgets.inactive.weak_bg_fill = Color32::from_rgb(0x33, 0x38, 0x41);
    v.widgets.inactive.bg_fill = Color32::from_rgb(0x3a, 0x40, 0x4a);
    v.widgets.inactive.fg_stroke = Stroke::new(1.0, Color32::from_rgb(0xd6, 0xdb, 0xe3));
    v.widgets.hovered.weak_bg_fill = Color32::from_rgb(0x40, 0x47, 0x52);
    v.widgets.hovered.bg_stroke = Stroke::new(1.0, Color32::from_rgb(0x5b, 0x64, 0x73));
    v.widgets.open.weak_bg_fill = Color32::from_rgb(0x2f, 0x34, 0x3c);
    v.selection.bg_fill = Color32::from_rgb(0x2b, 0x5a, 0x9e);
    v.selection.stroke = Stroke::new(1.0, Color32::from_rgb(0xe6, 0xf0, 0xff));
    v.hyperlink_color = Color32::from_rgb(0x6c, 0xa8, 0xff);
    v.error_fg_color = Color32::from_rgb(0xff, 0x6b, 0x6b);
    v.warn_fg_color = Color32::from_rgb(0xf0, 0xb4, 0x4c);
    v.weak_text_color = Some(Color32::from_rgb(0x8e, 0x97, 0xa5));
    v
}

fn light() -> Visuals {
    let mut v = Visuals::light();
    rounded(&mut v);
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
    v.widgets.hovered.weak_bg_fill = Color32::from_rgb(0xd8, 0xdd, 0xe4);
    v.widgets.hovered.bg_stroke = Stroke::new(1.0, Color32::from_rgb(0x9a, 0xa4, 0xb2));
    v.widgets.open.weak_bg_fill = Color32::from_rgb(0xe4, 0xe7, 0xec);
    // White on white would hide where one may type.
    v.text_edit_bg_color = Some(Color32::from_rgb(0xec, 0xee, 0xf2));
    v.selection.bg_fill = Color32::from_rgb(0xb8, 0xd6, 0xff);
    v.selection.stroke = Stroke::new(1.0, Color32::from_rgb(0x0b, 0x3d, 0x91));
    v.hyperlink_color = Color32::from_rgb(0x1f, 0x62, 0xc4);
    v.error_fg_color = Color32::from_rgb(0xc6, 0x28, 0x28);
    v.warn_fg_color = Color32::from_rgb(0x96, 0x5a, 0x00);
    v.weak_text_color = Some(Color32::from_rgb(0x6a, 0x73, 0x80));
    v
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
        TokenClass::Comment => (0x7d_87_95, 0x6f_78_85),
        TokenClass::Punctuation => (0xa2_ab_b8, 0x56_5e_6a),
        TokenClass::Error => (0xff_6b_6b, 0xc6_28_28),
    };
    let rgb: u32 = if dark { on_dark } else { on_light };
    let [_, r, g, b] = rgb.to_be_bytes();
    Color32::from_rgb(r, g, b)
}
