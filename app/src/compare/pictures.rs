//! Pictures compared pixel by pixel.

use std::fmt;

use image::RgbaImage;

/// A pixel by itself may be off by this many times the tolerance.
const ALONE: f64 = 4.0;

/// One pixel of so many may be off altogether: where an outline passes through the middle of a pixel, drivers differ on
/// which side it lies.
const ONE_STRAY_OF: usize = 10_000;

/// How a picture differs from its reference.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum PictureDifference {
    /// Another size.
    Size {
        /// Width and height of the picture.
        found: (u32, u32),
        /// Those of the reference.
        expected: (u32, u32),
    },
    /// Pixels of other colours, off by more than four times the tolerance.
    Pixels {
        /// Column and row, from 0 at the upper left, of the pixel that is furthest off.
        at: (u32, u32),
        /// Its colour, red green blue alpha.
        found: [u8; 4],
        /// The colour it should have.
        expected: [u8; 4],
        /// How many pixels are.
        count: usize,
    },
    /// A patch of 3×3 pixels in which a channel is off by more than the tolerance, everywhere to the same side: no
    /// rounding does that.
    Patch {
        /// Column and row of its middle.
        at: (u32, u32),
        /// By how much it is off at least, of 255; negative where the picture is darker.
        by: i16,
    },
}

impl fmt::Display for PictureDifference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Size { found: (w, h), expected: (x, y) } => write!(f, "it has {w}x{h} pixels in place of {x}x{y}"),
            Self::Pixels { at: (x, y), found, expected, count } => {
                let off = difference(*found, *expected).into_iter().map(i16::unsigned_abs).max().unwrap_or_default();
                let off = f64::from(off) / 255.0;
                let color = |[r, g, b, a]: [u8; 4]| format!("#{r:02x}{g:02x}{b:02x}{a:02x}");
                let (found, expected) = (color(*found), color(*expected));
                let others = if *count == 1 { "pixel is" } else { "pixels are" };
                write!(f, "the pixel at ({x}, {y}) is {off:.3} off, {found} in place of {expected}; ")?;
                write!(f, "{count} {others} further off than four times the tolerance")
            }
            Self::Patch { at: (x, y), by } => {
                let how = if *by > 0 { "brighter" } else { "darker" };
                let by = f64::from(by.unsigned_abs()) / 255.0;
                write!(f, "the pixels around ({x}, {y}) are all {how}, by {by:.3} or more")
            }
        }
    }
}

/// Compares a picture with a reference of the same size. In no patch of 3×3 pixels may a colour channel, from 0 to 1, be
/// off everywhere by more than `tolerance` to the same side. A pixel by itself may be off by four times as much; one of
/// 10,000 by even more, unless the tolerance is 0. Linear in the number of pixels.
///
/// # Errors
/// The first kind of difference in the order of [`PictureDifference`].
pub fn compare_pictures(picture: &RgbaImage, reference: &RgbaImage, tolerance: f64) -> Result<(), PictureDifference> {
    let (found, expected) = (picture.dimensions(), reference.dimensions());
    if found != expected {
        return Err(PictureDifference::Size { found, expected });
    }
    let (width, height) = found;
    let off = |x: u32, y: u32| difference(picture.get_pixel(x, y).0, reference.get_pixel(x, y).0);
    let (mut count, mut at, mut most) = (0, (0, 0), 0);
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let by = off(x, y).into_iter().map(i16::unsigned_abs).max().unwrap_or_default();
        count += usize::from(f64::from(by) / 255.0 > ALONE * tolerance);
        if by > most {
            (at, most) = ((x, y), by);
        }
    }
    let strays = if tolerance > 0.0 { picture.pixels().len() / ONE_STRAY_OF } else { 0 };
    if count > strays {
        let (found, expected) = (picture.get_pixel(at.0, at.1).0, reference.get_pixel(at.0, at.1).0);
        return Err(PictureDifference::Pixels { at, found, expected, count });
    }
    let slight = |by: i16| f64::from(by.abs()) / 255.0 <= tolerance;
    for (x, y) in (1..height.max(1) - 1).flat_map(|y| (1..width.max(1) - 1).map(move |x| (x, y))) {
        if off(x, y).into_iter().all(slight) {
            continue;
        }
        let (mut low, mut high) = ([i16::MAX; 4], [i16::MIN; 4]);
        for (u, v) in (y - 1..=y + 1).flat_map(|v| (x - 1..=x + 1).map(move |u| (u, v))) {
            for (i, by) in off(u, v).into_iter().enumerate() {
                low[i] = low[i].min(by);
                high[i] = high[i].max(by);
            }
        }
        let brighter = low.into_iter().find(|&by| by > 0 && !slight(by));
        if let Some(by) = brighter.or_else(|| high.into_iter().find(|&by| by < 0 && !slight(by))) {
            return Err(PictureDifference::Patch { at: (x, y), by });
        }
    }
    Ok(())
}

/// By how much each channel is brighter, of 255.
fn difference(a: [u8; 4], b: [u8; 4]) -> [i16; 4] {
    std::array::from_fn(|i| i16::from(a[i]) - i16::from(b[i]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgba;

    const TOLERANCE: f64 = 2.0 / 255.0;
    const GREY: Rgba<u8> = Rgba([100, 100, 100, 255]);

    /// Compares a grey picture of 100×200 pixels, in which `paint` changed something, with one in which nothing was.
    #[track_caller]
    fn check(paint: impl Fn(&mut RgbaImage), expected: &str) {
        let grey = RgbaImage::from_pixel(100, 200, GREY);
        let mut picture = grey.clone();
        paint(&mut picture);
        let got = compare_pictures(&picture, &grey, TOLERANCE);
        assert_eq!(got.map_or_else(|d| d.to_string(), |()| "same".to_owned()), expected);
    }

    fn fill(picture: &mut RgbaImage, (x, y): (u32, u32), (w, h): (u32, u32), color: [u8; 4]) {
        (y..y + h)
            .flat_map(|y| (x..x + w).map(move |x| (x, y)))
            .for_each(|(x, y)| picture.put_pixel(x, y, Rgba(color)));
    }

    #[test]
    fn a_picture_is_itself() {
        check(|_| {}, "same");
    }

    #[test]
    fn another_size_differs() {
        check(|p| *p = RgbaImage::from_pixel(100, 201, GREY), "it has 100x201 pixels in place of 100x200");
    }

    #[test]
    fn one_pixel_of_ten_thousand_may_stray() {
        check(|p| fill(p, (50, 60), (2, 1), [0, 0, 0, 255]), "same");
        check(
            |p| fill(p, (50, 60), (3, 1), [100, 160, 100, 255]),
            "the pixel at (50, 60) is 0.235 off, #64a064ff in place of #646464ff; \
             3 pixels are further off than four times the tolerance",
        );
    }

    #[test]
    fn without_tolerance_none_may() {
        let grey = RgbaImage::from_pixel(100, 200, GREY);
        let mut picture = grey.clone();
        picture.put_pixel(7, 9, Rgba([100, 100, 99, 255]));
        let difference = compare_pictures(&picture, &grey, 0.0).unwrap_err();
        assert!(matches!(difference, PictureDifference::Pixels { at: (7, 9), count: 1, .. }));
    }

    #[test]
    fn rounding_is_no_difference() {
        check(|p| fill(p, (0, 0), (100, 200), [102, 98, 102, 253]), "same");
        check(|p| fill(p, (10, 10), (60, 2), [108, 92, 108, 255]), "same");
    }

    #[test]
    fn a_patch_a_little_off_is() {
        check(
            |p| fill(p, (10, 10), (3, 3), [100, 103, 100, 255]),
            "the pixels around (11, 11) are all brighter, by 0.012 or more",
        );
        check(
            |p| fill(p, (97, 197), (3, 3), [100, 100, 100, 250]),
            "the pixels around (98, 198) are all darker, by 0.020 or more",
        );
    }

    #[test]
    fn tiny_pictures_are_compared_too() {
        for size in [(0, 0), (1, 1), (2, 2), (1, 9)] {
            let picture = RgbaImage::from_pixel(size.0, size.1, GREY);
            assert_eq!(compare_pictures(&picture, &picture, 0.0), Ok(()));
        }
        let (white, grey) = (RgbaImage::from_pixel(1, 1, Rgba([255; 4])), RgbaImage::from_pixel(1, 1, GREY));
        assert!(compare_pictures(&white, &grey, TOLERANCE).is_err());
    }
}
