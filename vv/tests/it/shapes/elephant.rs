//! An elephant, built of boxes: it looks ahead along z, one ear on either side of the plane x = 0.

use glam::{DVec3, dvec3};

use super::{Shape, boxes, round};

/// Lines of the grid: ears, flanks and legs, trunk.
const X: [f64; 6] = [-2.0, -0.95, -0.3, 0.3, 0.95, 2.0];
/// Feet, knees, belly, flanks, back, crown.
const Y: [f64; 6] = [0.0, 0.5, 1.15, 1.95, 2.75, 3.4];
/// Tail, hind legs, belly, forelegs, ears, head, trunk.
const Z: [f64; 10] = [-2.6, -2.0, -1.25, 0.15, 0.95, 1.25, 2.0, 2.6, 3.15, 3.7];

pub fn elephant() -> Shape {
    boxes([6, 6, 10], is_full, |p| round(place([p.x as usize, p.y as usize, p.z as usize])))
}

fn is_full([x, y, z]: [i32; 3]) -> bool {
    let in_flanks = (1..=3).contains(&x);
    match (y, z) {
        (0 | 1, 1 | 3) => x == 1 || x == 3, // legs
        (2 | 3, 1..=3) => in_flanks,        // body
        (3 | 4, 4) => true,                 // ears, and the head between them
        (3 | 4, 5) => in_flanks,            // head
        (0..=3, 6) => x == 2,               // trunk, and its tip, which is turned up
        (0, 7) | (0 | 1, 8) => x == 2,
        (3, 0) => x == 2, // tail
        _ => false,
    }
}

/// Where a point of the grid lies: rounder than the boxes are, with a bent trunk and spread ears.
fn place([i, j, k]: [usize; 3]) -> DVec3 {
    let p = dvec3(X[i], Y[j], Z[k]);
    let side = p.x.signum();
    if i == 0 || i == 5 {
        ear(side, j, k)
    } else if k >= 7 || (k == 6 && j <= 2) {
        trunk(side, j, k)
    } else if k == 0 {
        // The tail, thin and hanging.
        dvec3(p.x * 0.3, if j == 4 { 1.5 } else { 1.2 }, p.z + 0.15)
    } else if k >= 5 || (k == 4 && j >= 4) {
        head(p, i, j, k)
    } else {
        body(p, j, k)
    }
}

/// Larger than the head, hanging down, thin at the rim, swung back.
fn ear(side: f64, j: usize, k: usize) -> DVec3 {
    let z = if k == 4 { 0.35 } else { 0.6 };
    match j {
        3 => dvec3(side * 1.6, 1.1, z),
        4 => dvec3(side * 2.25, 2.35, z - 0.1),
        _ => dvec3(side * 1.9, 3.35, z),
    }
}

/// Thinner and thinner towards the tip.
fn trunk(side: f64, j: usize, k: usize) -> DVec3 {
    let (half, y, z) = match (j, k) {
        (4, _) => (0.34, 2.6, 2.5),
        (3, _) => (0.3, 1.9, 2.75),
        (2, 6) => (0.26, 1.25, 2.3),
        (2, 7) => (0.26, 1.25, 2.85),
        (1, 6) => (0.23, 0.6, 2.3),
        (1, 7) => (0.22, 0.65, 2.85),
        (0, 6) => (0.22, 0.1, 2.45),
        (0, 7) => (0.22, 0.0, 2.95),
        (1, 8) => (0.21, 0.62, 3.15),
        (0, 8) => (0.22, 0.05, 3.45),
        (0, _) => (0.2, 0.3, 3.75),
        (1, _) => (0.2, 0.75, 3.65),
        (_, 8) => (0.18, 1.15, 3.2),
        _ => (0.18, 1.2, 3.6),
    };
    dvec3(side * half, y, z)
}

/// Domed, with temples behind which the ears begin.
fn head(mut p: DVec3, i: usize, j: usize, k: usize) -> DVec3 {
    let inner = i == 2 || i == 3;
    match (j, inner) {
        (5, true) => p.y += if k == 5 { 0.4 } else { 0.2 },
        (5, false) => p = dvec3(p.x * 0.72, p.y - 0.05, p.z),
        (4, false) => p.x *= 0.92,
        (3, false) => p = dvec3(p.x * 0.72, p.y - 0.1, p.z),
        _ => {}
    }
    if k == 6 {
        p.z -= [0.0, 0.0, 0.0, 0.0, 0.0, 0.45][j];
        p.x *= if inner { 1.0 } else { 0.85 };
    }
    p
}

/// A belly that hangs, an arched back, full flanks; straight legs with feet.
fn body(mut p: DVec3, j: usize, k: usize) -> DVec3 {
    let middle = 1.0 - ((p.z + 0.55) / 1.6).powi(2).min(1.0);
    match j {
        0 => p.x *= 1.06,
        2 => p.y -= 0.2 * middle,
        3 => p.x *= 1.0 + 0.3 * middle,
        4 => {
            p.y += 0.4 * middle;
            p.x *= 0.9;
        }
        _ => {}
    }
    if k == 1 && j == 4 {
        p += dvec3(0.0, -0.2, 0.25);
    }
    p
}
