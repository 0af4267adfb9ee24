//! Colours of the themes.
//!
//! Cool front, warm back; edges in ink; the boundary stands out from surface and background; the control mesh has a
//! hue of its own.

use crate::scene::Theme;

/// Colours as sRGB bytes with opacity.
pub(crate) struct Palette {
    pub background_top: [u8; 4],
    pub background_bottom: [u8; 4],
    pub front: [u8; 4],
    pub back: [u8; 4],
    /// Edges on faces.
    pub line: [u8; 4],
    /// Edges where no faces are drawn.
    pub bare_line: [u8; 4],
    /// Edges of the boundary and without any face.
    pub strong_line: [u8; 4],
    pub point: [u8; 4],
    pub ring: [u8; 4],
    pub control: [u8; 4],
    /// The line along a cut.
    pub cut: [u8; 4],
    pub grid: [u8; 4],
    pub arrow: [u8; 4],
}

const LIGHT: Palette = Palette {
    background_top: [0xfd, 0xfd, 0xfe, 0xff],
    background_bottom: [0xe4, 0xe8, 0xee, 0xff],
    front: [0xa3, 0xbf, 0xdb, 0xff],
    back: [0xe0, 0xb0, 0x8c, 0xff],
    line: [0x1c, 0x29, 0x3b, 0xe0],
    bare_line: [0x33, 0x44, 0x5a, 0xe0],
    strong_line: [0x0c, 0x2d, 0x57, 0xff],
    point: [0x12, 0x2a, 0x4a, 0xff],
    ring: [0xff, 0xff, 0xff, 0xff],
    control: [0xc8, 0x1e, 0x5a, 0xff],
    cut: [0x0c, 0x2d, 0x57, 0xff],
    grid: [0x5a, 0x6b, 0x80, 0xa0],
    arrow: [0x6a, 0x1b, 0x9a, 0xff],
};

const DARK: Palette = Palette {
    background_top: [0x2a, 0x2e, 0x35, 0xff],
    background_bottom: [0x17, 0x19, 0x1d, 0xff],
    front: [0x8f, 0xad, 0xca, 0xff],
    back: [0xc9, 0x93, 0x6a, 0xff],
    line: [0x0b, 0x10, 0x18, 0xe0],
    bare_line: [0x9d, 0xb0, 0xc6, 0xe0],
    strong_line: [0xcd, 0xe4, 0xff, 0xff],
    point: [0xf4, 0xf8, 0xff, 0xff],
    ring: [0x0b, 0x10, 0x18, 0xff],
    control: [0xe8, 0x62, 0x8f, 0xff],
    cut: [0xcd, 0xe4, 0xff, 0xff],
    grid: [0x8c, 0x9a, 0xad, 0x90],
    arrow: [0xe6, 0xb4, 0xff, 0xff],
};

pub(crate) fn palette(theme: Theme) -> &'static Palette {
    match theme {
        Theme::Light => &LIGHT,
        Theme::Dark => &DARK,
    }
}

/// An sRGB colour in linear light; opacity is linear already.
pub(super) fn linear(color: [u8; 4]) -> [f32; 4] {
    let [r, g, b, a] = color.map(|c| f32::from(c) / 255.0);
    [to_linear(r), to_linear(g), to_linear(b), a]
}

/// The same of a colour without opacity.
pub(super) fn opaque([r, g, b]: [u8; 3]) -> [f32; 4] {
    linear([r, g, b, 0xff])
}

/// The sRGB transfer function (IEC 61966-2-1), from the encoded value to light.
pub(crate) fn to_linear(c: f32) -> f32 {
    if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}

/// Its inverse.
pub(crate) fn to_srgb(c: f32) -> f32 {
    if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 }
}
