//! The colour of a face: in the light of the window's pictures (`shaders/faces.wgsl`), one colour for each face.

use glam::Vec3;

use crate::annotate::scale::{NO_NUMBER, SAMPLES};
use crate::annotate::{Reading, Tint};
use crate::render::palette::{palette, to_linear, to_srgb};
use crate::scene::{Part, Theme};

const UP: Vec3 = Vec3::new(0.0, 0.98, 0.2);
const SKY: Vec3 = Vec3::new(0.40, 0.43, 0.48);
const GROUND: Vec3 = Vec3::new(0.19, 0.18, 0.18);
const KEY_DIRECTION: Vec3 = Vec3::new(-0.58, 0.52, 0.627);
const KEY: Vec3 = Vec3::new(0.88, 0.85, 0.80);
const FILL_DIRECTION: Vec3 = Vec3::new(0.78, -0.05, 0.62);
const FILL: Vec3 = Vec3::new(0.10, 0.12, 0.15);
const GLOSS: f32 = 0.11;
const GLOSS_POWER: f32 = 28.0;
const RIM: f32 = 0.10;
const RIM_POWER: f32 = 4.0;

/// Brightness of the backs of coloured faces.
const BACK: f32 = 0.55;

/// What a face is painted with before there is light; `None` without colours of its own.
pub(super) fn own_color(part: &Part, tint: Option<&Tint>, colored: bool, corners: &[u32], first: u32) -> Option<Vec3> {
    let mean = |color: &dyn Fn(u32) -> Vec3| {
        let colors = corners.iter().map(|&corner| color(corner));
        (!corners.is_empty()).then(|| colors.sum::<Vec3>() / corners.len() as f32)
    };
    let Some(tint) = tint else {
        return if colored && !part.colors.is_empty() { mean(&|c| unpacked(word(&part.colors, c))) } else { None };
    };
    let samples = tint.samples();
    let number = |corner: u32| f32::from_bits(word(&tint.words, corner));
    let class = |corner: u32| {
        let x = number(corner);
        let color = if x < -1e30 { NO_NUMBER } else { samples[(x.round().max(0.0) as usize).min(SAMPLES - 1)] };
        linear(color)
    };
    match tint.reading {
        Reading::Colors => mean(&|corner| unpacked(word(&tint.words, corner))),
        Reading::VertexClasses => mean(&class),
        Reading::FaceClasses => Some(class(first)),
        Reading::Numbers => {
            let numbers: Vec<f32> = corners.iter().map(|&c| number(c)).collect();
            if numbers.is_empty() || numbers.iter().any(|x| *x < -1e30) {
                return Some(linear(NO_NUMBER));
            }
            let [shift, factor] = tint.window();
            let mean = numbers.iter().sum::<f32>() / numbers.len() as f32;
            let at = ((mean - shift) * factor).clamp(0.0, 1.0) * (SAMPLES - 1) as f32;
            let i = (at as usize).min(SAMPLES - 2);
            Some(linear(samples[i]).lerp(linear(samples[i + 1]), at - i as f32))
        }
    }
}

/// In the light; `normal` on the side that is seen and `eye` towards the eye are unit vectors in view coordinates.
pub(super) fn lit(own: Option<Vec3>, front: bool, normal: Vec3, eye: Vec3) -> [u8; 3] {
    let palette = palette(Theme::Light);
    let plain = if front { palette.front } else { palette.back };
    let albedo = match own {
        Some(color) => color * if front { 1.0 } else { BACK },
        None => linear([plain[0], plain[1], plain[2]]),
    };
    let light = GROUND.lerp(SKY, normal.dot(UP) * 0.5 + 0.5)
        + KEY * normal.dot(KEY_DIRECTION).max(0.0)
        + FILL * normal.dot(FILL_DIRECTION).max(0.0);
    let half = (KEY_DIRECTION + eye).normalize_or_zero();
    let gloss = GLOSS * normal.dot(half).max(0.0).powf(GLOSS_POWER);
    let rim = RIM * (1.0 - normal.dot(eye).clamp(0.0, 1.0)).powf(RIM_POWER);
    let color = albedo * light + Vec3::splat(gloss) + rim * SKY;
    color.to_array().map(|c| (to_srgb(c.clamp(0.0, 1.0)) * 255.0).round() as u8)
}

fn word(words: &[u32], corner: u32) -> u32 {
    words.get(corner as usize).copied().unwrap_or(0)
}

fn unpacked(word: u32) -> Vec3 {
    let [r, g, b, _] = word.to_le_bytes();
    linear([r, g, b])
}

fn linear(color: [u8; 3]) -> Vec3 {
    Vec3::from(color.map(|c| to_linear(f32::from(c) / 255.0)))
}
