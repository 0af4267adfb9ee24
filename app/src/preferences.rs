//! What is as the user likes it, from one time to the next.

use serde::{Deserialize, Serialize};

use crate::inspect::measure::short;

/// What the window opens with where no file is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Start {
    /// The gallery, before a surface.
    #[default]
    Gallery,
    /// A surface.
    Surface,
    /// What was open when vv was closed.
    LastSession,
}

/// What a length of 1 is in the meshes that are looked at. Files do not say; nothing is converted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Unit {
    /// Nobody asks.
    #[default]
    None,
    /// A thousandth of a millimetre, as cells are measured.
    Micrometre,
    /// A thousandth of a metre.
    Millimetre,
    /// A hundredth of a metre.
    Centimetre,
    /// The metre.
    Metre,
    /// 25.4 mm.
    Inch,
}

impl Unit {
    /// All there are.
    pub const ALL: [Self; 6] =
        [Self::None, Self::Micrometre, Self::Millimetre, Self::Centimetre, Self::Metre, Self::Inch];

    /// Behind a number: nothing, or a space and the sign.
    #[must_use]
    pub fn suffix(self) -> &'static str {
        match self {
            Self::None => "",
            Self::Micrometre => " µm",
            Self::Millimetre => " mm",
            Self::Centimetre => " cm",
            Self::Metre => " m",
            Self::Inch => " in",
        }
    }

    /// A length as people read it.
    #[must_use]
    pub fn length(self, x: f64) -> String {
        short(x) + self.suffix()
    }

    /// An area.
    #[must_use]
    pub fn area(self, x: f64) -> String {
        let square = if self == Self::None { "" } else { "²" };
        short(x) + self.suffix() + square
    }
}

/// What can be set in the dialog of this name.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Preferences {
    /// What the window opens with.
    pub start: Start,
    /// Size of everything in the window, over that of the system.
    pub scale: f32,
    /// Height of the program's letters, in points.
    pub font_size: f32,
    /// Spaces that Tab makes in the program.
    pub tab_width: usize,
    /// MiB that generations are kept in.
    pub memory: usize,
    /// Of lengths and areas.
    pub unit: Unit,
    /// How pictures are saved.
    pub picture: PictureOptions,
}

impl Default for Preferences {
    fn default() -> Self {
        Self {
            start: Start::Gallery,
            scale: 1.0,
            font_size: 13.0,
            tab_width: 2,
            memory: 2048,
            unit: Unit::None,
            picture: PictureOptions::default(),
        }
    }
}

impl Preferences {
    /// Sensible values of [`Preferences::scale`].
    pub const SCALES: std::ops::RangeInclusive<f32> = 0.6..=3.0;
    /// Of [`Preferences::font_size`].
    pub const FONT_SIZES: std::ops::RangeInclusive<f32> = 8.0..=32.0;
    /// Of [`Preferences::tab_width`].
    pub const TAB_WIDTHS: std::ops::RangeInclusive<usize> = 1..=8;
    /// Of [`Preferences::memory`].
    pub const MEMORIES: std::ops::RangeInclusive<usize> = 64..=65_536;

    /// The same with every value where it makes sense.
    #[must_use]
    pub fn sensible(mut self) -> Self {
        let within = |x: f32, range: std::ops::RangeInclusive<f32>, default: f32| {
            if x.is_finite() { x.clamp(*range.start(), *range.end()) } else { default }
        };
        let default = Self::default();
        self.scale = within(self.scale, Self::SCALES, default.scale);
        self.font_size = within(self.font_size, Self::FONT_SIZES, default.font_size);
        self.tab_width = self.tab_width.clamp(*Self::TAB_WIDTHS.start(), *Self::TAB_WIDTHS.end());
        self.memory = self.memory.clamp(*Self::MEMORIES.start(), *Self::MEMORIES.end());
        self.picture.width = self.picture.width.clamp(1, PictureOptions::LONGEST);
        self.picture.height = self.picture.height.clamp(1, PictureOptions::LONGEST);
        self
    }
}

/// What is behind a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Background {
    /// As in the window.
    #[default]
    AsSeen,
    /// White.
    White,
    /// Nothing.
    Transparent,
}

/// How a picture is saved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct PictureOptions {
    /// Whether it is as large as in the window; else `width` and `height` count.
    pub as_seen: bool,
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// What is behind.
    pub background: Background,
}

impl PictureOptions {
    /// Most pixels along a side.
    pub const LONGEST: u32 = 16_384;
}

impl Default for PictureOptions {
    fn default() -> Self {
        Self { as_seen: true, width: 1920, height: 1080, background: Background::AsSeen }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measures_have_their_unit() {
        let check = |unit: Unit, length: &str, area: &str| {
            assert_eq!((unit.length(1.5), unit.area(0.25)), (length.to_owned(), area.to_owned()));
        };
        check(Unit::None, "1.5", "0.25");
        check(Unit::Micrometre, "1.5 µm", "0.25 µm²");
        check(Unit::Inch, "1.5 in", "0.25 in²");
    }

    #[test]
    fn values_without_sense_are_mended() {
        let odd = Preferences { scale: f32::NAN, font_size: 1e9, tab_width: 0, memory: 0, ..Preferences::default() };
        let mended = Preferences { font_size: 32.0, tab_width: 1, memory: 64, ..Preferences::default() };
        assert_eq!(odd.sensible(), mended);
        assert_eq!(Preferences::default().sensible(), Preferences::default());
    }
}
