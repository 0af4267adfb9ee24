//! From numbers to colours.

use super::field::{Field, Kind};

/// From small to large: viridis of S. van der Walt and N. Smith (2015), even in lightness, and told apart by the colour
/// blind. Ten samples, evenly spaced, sRGB.
const VIRIDIS: [[u8; 3]; 10] = [
    [0x44, 0x01, 0x54],
    [0x48, 0x28, 0x78],
    [0x3e, 0x49, 0x89],
    [0x31, 0x68, 0x8e],
    [0x26, 0x82, 0x8e],
    [0x1f, 0x9e, 0x89],
    [0x35, 0xb7, 0x79],
    [0x6e, 0xce, 0x58],
    [0xb5, 0xde, 0x2b],
    [0xfd, 0xe7, 0x25],
];

/// Around zero: blue below, red above, light between. K. Moreland, "Diverging color maps for scientific visualization",
/// 2009. Eight samples and the middle.
const DIVERGING: [[u8; 3]; 9] = [
    [0x3b, 0x4c, 0xc0],
    [0x62, 0x82, 0xea],
    [0x8d, 0xb0, 0xfe],
    [0xb8, 0xd0, 0xf9],
    [0xdd, 0xdd, 0xdd],
    [0xf5, 0xc4, 0xad],
    [0xf4, 0x98, 0x7a],
    [0xde, 0x60, 0x4d],
    [0xb4, 0x04, 0x26],
];

/// Few kinds, the regular one in the middle without hue: colours that also the colour blind tell apart. M. Okabe and
/// K. Ito, "Color universal design", 2002.
pub const CLASS_COLORS: [[u8; 3]; 7] = [
    [0x00, 0x9e, 0x73],
    [0x00, 0x72, 0xb2],
    [0x56, 0xb4, 0xe9],
    [0xc6, 0xca, 0xd0],
    [0xe6, 0x9f, 0x00],
    [0xd5, 0x5e, 0x00],
    [0xcc, 0x79, 0xa7],
];

/// Where there is no number.
pub const NO_NUMBER: [u8; 3] = [0x8a, 0x8a, 0x8a];

/// How many colours a scale has on the GPU.
pub const SAMPLES: usize = 32;

/// The colour at a place from 0 to 1 of those of a kind; classes are told by their number instead.
#[must_use]
pub fn color(kind: &Kind, t: f64) -> [u8; 3] {
    let samples: &[[u8; 3]] = match kind {
        Kind::Diverging => &DIVERGING,
        _ => &VIRIDIS,
    };
    let at = t.clamp(0.0, 1.0) * (samples.len() - 1) as f64;
    let i = (at as usize).min(samples.len() - 2);
    let part = at - i as f64;
    std::array::from_fn(|c| {
        (f64::from(samples[i][c]) * (1.0 - part) + f64::from(samples[i + 1][c]) * part).round() as u8
    })
}

/// The colours of a field as the GPU looks them up: samples of the map, or those of the classes.
#[must_use]
pub fn samples(kind: &Kind) -> [[u8; 3]; SAMPLES] {
    std::array::from_fn(|i| match kind {
        Kind::Classes(classes) => classes.get(i).map_or(NO_NUMBER, |class| class.color),
        kind => color(kind, i as f64 / (SAMPLES - 1) as f64),
    })
}

/// The least and the greatest of the numbers that are finite; `None` if none is.
#[must_use]
pub fn extremes(numbers: &[f64]) -> Option<[f64; 2]> {
    let finite = numbers.iter().copied().filter(|x| x.is_finite());
    let [low, high] = finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
    (low <= high).then_some([low, high])
}

/// What most of the numbers lie between, so that a few outliers do not take all the colours: from the first percentile
/// to the last; as far on both sides of zero where numbers are around it; all of them where they are whole.
#[must_use]
pub fn automatic_range(field: &Field) -> [f64; 2] {
    const PART: f64 = 0.01;
    let Some(extremes) = extremes(&field.numbers) else { return [0.0, 1.0] };
    let mut finite: Vec<f64> = field.numbers.iter().copied().filter(|x| x.is_finite()).collect();
    let last = finite.len() - 1;
    let mut percentile = |part: f64, of: &dyn Fn(f64) -> f64| {
        let place = (part * last as f64).round() as usize;
        let (_, x, _) = finite.select_nth_unstable_by(place, |a, b| of(*a).total_cmp(&of(*b)));
        of(*x)
    };
    let range = match field.kind {
        Kind::Diverging => {
            let most = percentile(1.0 - PART, &f64::abs);
            [-most, most]
        }
        Kind::Sequential { whole: true } | Kind::Classes(_) | Kind::Colors => extremes,
        Kind::Sequential { whole: false } => [percentile(PART, &|x| x), percentile(1.0 - PART, &|x| x)],
    };
    match range {
        // Nearly all the same: then the few others matter.
        [low, high] if low >= high && matches!(field.kind, Kind::Diverging) => {
            let most = extremes[0].abs().max(extremes[1].abs());
            if most > 0.0 { [-most, most] } else { [-1.0, 1.0] }
        }
        [low, high] if low >= high => extremes,
        range => range,
    }
}

/// A number with four digits.
#[must_use]
pub fn short(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 {
        "0".to_owned()
    } else if (1e-3..1e5).contains(&size) {
        let digits = (3 - size.log10().floor() as i32).clamp(0, 6) as usize;
        let text = format!("{x:.digits$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    } else {
        format!("{x:.2e}")
    }
}
