//! Contact sheets: several pictures of one size in one, each with a line of text below it.

use eframe::egui::text::{LayoutJob, TextFormat, TextWrapping};
use eframe::egui::{Color32, FontDefinitions, FontId, epaint};
use epaint::FontColorTransferFunction;
use epaint::text::{Fonts, TextOptions};
use image::{Rgba, RgbaImage};

use crate::scene::Theme;

/// The least side of a picture on a sheet, in pixels.
const LEAST: u32 = 48;

/// Where everything is on a sheet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Layout {
    /// Pixels of the whole.
    size: (u32, u32),
    columns: u32,
    rows: u32,
    /// Pixels of a picture.
    tile: (u32, u32),
    /// Between pictures, and around them.
    gap: u32,
    /// Height of letters.
    letters: u32,
}

/// A picture with its text.
#[derive(Debug, Clone)]
pub struct Tile {
    /// What stands below it.
    pub label: String,
    /// `None` if there is none: its place says so.
    pub picture: Option<RgbaImage>,
}

impl Layout {
    /// Of `count` pictures on a sheet of `size` pixels: in so many columns, or in as many as leave the pictures largest.
    /// `None` if they would be too small to show anything.
    #[must_use]
    pub fn new(size: (u32, u32), count: usize, columns: Option<usize>) -> Option<Self> {
        let count = u32::try_from(count).ok().filter(|count| *count > 0)?;
        let columns = columns.and_then(|columns| u32::try_from(columns).ok());
        let candidates = match columns {
            Some(columns) => columns..=columns,
            None => 1..=count,
        };
        let layouts = candidates.filter_map(|columns| Self::in_columns(size, count, columns));
        // The first of equals has the fewest columns; an empty place costs as much as a tenth of the side.
        let worth = |layout: &Self| {
            let side = u64::from(layout.tile.0.min(layout.tile.1));
            side * (10 * u64::from(count)) / u64::from(9 * count + layout.columns * layout.rows)
        };
        layouts.rev().max_by_key(worth)
    }

    fn in_columns(size: (u32, u32), count: u32, columns: u32) -> Option<Self> {
        let rows = count.div_ceil(columns);
        let cell = (size.0 / columns, size.1 / rows);
        let letters = (cell.0.min(cell.1) / 18).clamp(11, 40);
        let gap = letters / 2;
        let width = (size.0.checked_sub(gap)? / columns).checked_sub(gap)?;
        let height = (size.1.checked_sub(gap)? / rows).checked_sub(gap + 2 * letters)?;
        let tile = (width, height);
        (width.min(height) >= LEAST).then_some(Self { size, columns, rows, tile, gap, letters })
    }

    /// Pixels of each picture.
    #[must_use]
    pub fn tile(&self) -> (u32, u32) {
        self.tile
    }

    /// Where picture number `index` begins.
    fn place(&self, index: u32) -> (u32, u32) {
        let (width, height) = (self.tile.0 + self.gap, self.tile.1 + self.gap + 2 * self.letters);
        let left = self.size.0.saturating_sub(self.columns * width - self.gap) / 2;
        let top = self.size.1.saturating_sub(self.rows * height - self.gap / 2) / 2;
        (left + index % self.columns * width, top + index / self.columns * height)
    }
}

/// Puts pictures on a sheet, row by row. Paper and ink are those of the theme; `transparent` leaves the paper out.
#[must_use]
pub fn compose(layout: &Layout, tiles: &[Tile], theme: Theme, transparent: bool) -> RgbaImage {
    let (paper, ink) = match theme {
        Theme::Light => ([0xff, 0xff, 0xff, 0xff], [0x2a, 0x33, 0x40]),
        Theme::Dark => ([0x10, 0x12, 0x15, 0xff], [0xd5, 0xdd, 0xe8]),
    };
    let paper = if transparent { [0; 4] } else { paper };
    let mut sheet = RgbaImage::from_pixel(layout.size.0, layout.size.1, Rgba(paper));
    let mut letters = Letters::new(theme);
    for (index, tile) in (0..).zip(tiles) {
        let (left, top) = layout.place(index);
        let below = top + layout.tile.1 + layout.letters / 3;
        letters.center(&mut sheet, (left, below), layout.tile.0, layout.letters, &tile.label, ink);
        match &tile.picture {
            Some(picture) => image::imageops::replace(&mut sheet, picture, left.into(), top.into()),
            None => {
                let middle = top + layout.tile.1 / 2;
                letters.center(&mut sheet, (left, middle), layout.tile.0, layout.letters, "failed", ink);
            }
        }
    }
    sheet
}

/// Sets text in the letters of the window.
struct Letters(Fonts);

impl Letters {
    fn new(theme: Theme) -> Self {
        let color_transfer_function = match theme {
            Theme::Light => FontColorTransferFunction::LIGHT_MODE_DEFAULT,
            Theme::Dark => FontColorTransferFunction::DARK_MODE_DEFAULT,
        };
        let options = TextOptions { color_transfer_function, ..TextOptions::default() };
        Self(Fonts::new(options, FontDefinitions::default()))
    }

    /// A line of text in the middle of a stretch; what does not fit is left out.
    fn center(&mut self, on: &mut RgbaImage, at: (u32, u32), width: u32, size: u32, text: &str, ink: [u8; 3]) {
        let format = TextFormat::simple(FontId::proportional(size as f32), Color32::WHITE);
        let mut job = LayoutJob::single_section(text.to_owned(), format);
        job.wrap = TextWrapping::truncate_at_width(width as f32);
        let galley = self.0.layout_uncached(1.0, job.into());
        let atlas = self.0.image();
        let left = at.0 as f32 + ((width as f32 - galley.rect.width()) / 2.0).max(0.0);
        for row in &galley.rows {
            for glyph in row.row.glyphs.iter().filter(|glyph| !glyph.uv_rect.is_nothing()) {
                let corner = row.pos + glyph.pos.to_vec2() + glyph.uv_rect.offset;
                let (x, y) = ((left + corner.x).round() as i64, (at.1 as f32 + corner.y).round() as i64);
                let [[u0, v0], [u1, v1]] = [glyph.uv_rect.min, glyph.uv_rect.max].map(|uv| uv.map(usize::from));
                for (dv, v) in (v0..v1).enumerate() {
                    for (du, u) in (u0..u1).enumerate() {
                        let place = (u32::try_from(x + du as i64), u32::try_from(y + dv as i64));
                        if let (Ok(x), Ok(y)) = place
                            && let Some(pixel) = on.get_pixel_mut_checked(x, y)
                        {
                            pixel.0 = over(ink, atlas[(u, v)].a(), pixel.0);
                        }
                    }
                }
            }
        }
    }
}

/// A colour that covers a part of what is below.
fn over(ink: [u8; 3], coverage: u8, below: [u8; 4]) -> [u8; 4] {
    let (a, b) = (f32::from(coverage) / 255.0, f32::from(below[3]) / 255.0);
    let opacity = a + b * (1.0 - a);
    if opacity == 0.0 {
        return below;
    }
    let mix = |i: usize| ((f32::from(ink[i]) * a + f32::from(below[i]) * b * (1.0 - a)) / opacity).round() as u8;
    [mix(0), mix(1), mix(2), (opacity * 255.0).round() as u8]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(size: (u32, u32), count: usize, columns: u32, rows: u32) {
        let layout = Layout::new(size, count, None).unwrap();
        assert_eq!((layout.columns, layout.rows), (columns, rows));
        let (left, top) = layout.place(count as u32 - 1);
        assert!(left + layout.tile.0 <= size.0 && top + layout.tile.1 + layout.letters <= size.1, "{layout:?}");
    }

    #[test]
    fn a_sheet_has_as_many_columns_as_leave_its_pictures_largest() {
        check((1280, 960), 4, 2, 2);
        check((1600, 400), 4, 4, 1);
        check((1280, 960), 6, 3, 2);
        check((400, 1600), 3, 1, 3);
        check((1280, 960), 1, 1, 1);
        assert_eq!(Layout::new((1280, 960), 6, Some(6)).map(|layout| layout.rows), Some(1));
        assert_eq!(Layout::new((100, 100), 100, None), None);
    }

    #[test]
    fn text_stands_below_each_picture_and_a_missing_one_is_said_to_be() {
        let layout = Layout::new((400, 200), 2, None).unwrap();
        let picture = RgbaImage::from_pixel(layout.tile.0, layout.tile.1, Rgba([200, 0, 0, 255]));
        let tile = |label: &str, picture| Tile { label: label.to_owned(), picture };
        let sheet =
            |label: &str| compose(&layout, &[tile(label, Some(picture.clone())), tile("b", None)], Theme::Light, false);
        let inked = |sheet: &RgbaImage| sheet.pixels().filter(|pixel| pixel.0[0] < 100).count();
        let red = |sheet: &RgbaImage| sheet.pixels().filter(|pixel| pixel.0 == [200, 0, 0, 255]).count();
        let (short, long) = (sheet("w"), sheet("w = 0.125"));
        assert_eq!(red(&long), (layout.tile.0 * layout.tile.1) as usize, "the text covers no picture");
        assert!(inked(&long) > inked(&short) && inked(&short) > 20);
    }
}
