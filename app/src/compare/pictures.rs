//! Pictures compared pixel by pixel.

use std::fmt;

use image::RgbaImage;

/// How a picture differs from its reference.
#[derive(Debug, Clone, PartialEq)]
pub enum PictureDifference {
    /// Another size.
    Size {
        /// Width and height of the picture.
        found: (u32, u32),
        /// Those of the reference.
        expected: (u32, u32),
    },
    /// Pixels of other colours.
    Pixels {
        /// Column and row, from 0 at the upper left, of the pixel that is furthest off.
        at: (u32, u32),
        /// Its colour, red green blue alpha.
        found: [u8; 4],
        /// The colour it should have.
        expected: [u8; 4],
        /// How many pixels are further off than the tolerance.
        count: usize,
    },
}

impl fmt::Display for PictureDifference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Size { found: (w, h), expected: (x, y) } => write!(f, "it has {w}x{h} pixels in place of {x}x{y}"),
            Self::Pixels { at: (x, y), found, expected, count } => {
                let off = f64::from(distance(*found, *expected)) / 255.0;
                let color = |[r, g, b, a]: [u8; 4]| format!("#{r:02x}{g:02x}{b:02x}{a:02x}");
                let (found, expected) = (color(*found), color(*expected));
                let others = if *count == 1 { "pixel is" } else { "pixels are" };
                write!(f, "the pixel at ({x}, {y}) is {off:.3} off, {found} in place of {expected}; ")?;
                write!(f, "{count} {others} further off than the tolerance")
            }
        }
    }
}

/// Compares pictures of the same size. Each colour channel, from 0 to 1, may differ by `tolerance`.
///
/// # Errors
/// If the size differs, or a pixel by more.
pub fn compare_pictures(picture: &RgbaImage, reference: &RgbaImage, tolerance: f64) -> Result<(), PictureDifference> {
    if picture.dimensions() != reference.dimensions() {
        return Err(PictureDifference::Size { found: picture.dimensions(), expected: reference.dimensions() });
    }
    let mut count = 0;
    let mut worst: Option<(u8, _, _, _)> = None;
    for ((x, y, found), expected) in picture.enumerate_pixels().zip(reference.pixels()) {
        let off = distance(found.0, expected.0);
        if f64::from(off) / 255.0 <= tolerance {
            continue;
        }
        count += 1;
        if worst.is_none_or(|(most, ..)| off > most) {
            worst = Some((off, (x, y), found.0, expected.0));
        }
    }
    match worst {
        Some((_, at, found, expected)) => Err(PictureDifference::Pixels { at, found, expected, count }),
        None => Ok(()),
    }
}

/// The greatest difference of a channel.
fn distance(a: [u8; 4], b: [u8; 4]) -> u8 {
    a.into_iter().zip(b).map(|(a, b)| a.abs_diff(b)).max().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgba;

    #[track_caller]
    fn check(changed: &[(u32, u32, u8)], tolerance: f64, expected: &str) {
        let reference = RgbaImage::from_pixel(3, 2, Rgba([100, 100, 100, 255]));
        let mut picture = reference.clone();
        for &(x, y, green) in changed {
            picture.put_pixel(x, y, Rgba([100, green, 100, 255]));
        }
        let got = compare_pictures(&picture, &reference, tolerance);
        assert_eq!(got.map_or_else(|d| d.to_string(), |()| "same".to_owned()), expected);
    }

    #[test]
    fn a_pixel_may_differ_by_the_tolerance() {
        check(&[], 0.0, "same");
        check(&[(1, 1, 102)], 2.0 / 255.0, "same");
        let one = "the pixel at (1, 1) is 0.012 off, #646764ff in place of #646464ff; 1 pixel is further off than the tolerance";
        check(&[(1, 1, 103)], 2.0 / 255.0, one);
        let two = "the pixel at (2, 0) is 0.392 off, #640064ff in place of #646464ff; 2 pixels are further off than the tolerance";
        check(&[(1, 1, 101), (2, 0, 0)], 0.0, two);
    }

    #[test]
    fn another_size_is_a_difference() {
        let difference = compare_pictures(&RgbaImage::new(2, 1), &RgbaImage::new(1, 2), 1.0).unwrap_err();
        assert_eq!(difference.to_string(), "it has 2x1 pixels in place of 1x2");
    }
}
