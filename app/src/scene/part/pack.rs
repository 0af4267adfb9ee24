//! Directions and colours in one word.

use glam::{DVec3, Vec2, Vec3};

/// Packs a unit vector into two signed 16-bit numbers: the octahedron around the unit ball, unfolded onto a square.
/// Never gives the zero word.
#[must_use]
pub fn pack(n: Vec3) -> u32 {
    let n = n / n.abs().element_sum().max(f32::MIN_POSITIVE);
    let square = if n.z >= 0.0 { Vec2::new(n.x, n.y) } else { (1.0 - Vec2::new(n.y, n.x).abs()) * sign(n.truncate()) };
    let [x, y] = square.to_array().map(|c| round(c.clamp(-1.0, 1.0) * 32767.0));
    match (u32::from(y.cast_unsigned()) << 16) | u32::from(x.cast_unsigned()) {
        0 => 1,
        word => word,
    }
}

/// The unit vector that was packed, nearly.
#[must_use]
pub fn unpack(word: u32) -> Vec3 {
    let [x, y] = [word as u16, (word >> 16) as u16].map(|c| f32::from(c.cast_signed()) / 32767.0);
    let square = Vec2::new(x, y);
    let z = 1.0 - x.abs() - y.abs();
    (square - (-z).max(0.0) * sign(square)).extend(z).normalize_or_zero()
}

/// To the nearest, halves away from zero.
fn round(x: f32) -> i16 {
    // `f32::round` is a call on processors that vv runs on.
    (x + 0.5f32.copysign(x)) as i16
}

/// Packs red, green and blue from 0 to 1 (sRGB) into bytes, red lowest. What is no number is 0.
#[must_use]
pub fn pack_color(color: DVec3) -> u32 {
    let [r, g, b] = color.to_array().map(|c| (c * 255.0).round() as u8);
    u32::from_le_bytes([r, g, b, u8::MAX])
}

fn sign(v: Vec2) -> Vec2 {
    Vec2::select(v.cmpge(Vec2::ZERO), Vec2::ONE, Vec2::NEG_ONE)
}
