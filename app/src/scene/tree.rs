//! Boxes in boxes: finds what lies near a ray, or farthest in a direction, among a million things without looking at all.
//!
//! Things are sorted along a space-filling curve (Morton's), so that eight in a row lie close together; each row of eight
//! has a box, each row of eight boxes has a box, up to one box around everything:
//!
//! ```text
//!   levels[1]   [ box of 8 boxes  |  …                 ]
//!   levels[0]   [ box of 8 things | … | box of 8 things ]
//!   order       [ t3 t17 t4 …     | …                   ]
//! ```

use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// How many boxes, or things, a box holds.
const WIDTH: usize = 8;

/// A box along the axes; `low > high` while it is empty.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    pub low: Vec3,
    pub high: Vec3,
}

impl Bounds {
    pub const NOTHING: Self = Self { low: Vec3::INFINITY, high: Vec3::NEG_INFINITY };

    pub fn with(self, p: Vec3) -> Self {
        Self { low: self.low.min(p), high: self.high.max(p) }
    }

    fn and(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Where a ray enters the box, made larger by `margin` on all sides: 0 if it starts inside.
    pub fn entry(self, origin: DVec3, inverse: DVec3, margin: f64) -> Option<f64> {
        let a = (self.low.as_dvec3() - margin - origin) * inverse;
        let b = (self.high.as_dvec3() + margin - origin) * inverse;
        // A ray along a face of the box makes 0 · ∞, which `min` and `max` of numbers pass over.
        let lower = |i: usize| a[i].min(b[i]);
        let upper = |i: usize| a[i].max(b[i]);
        let enter = lower(0).max(lower(1)).max(lower(2)).max(0.0);
        let leave = upper(0).min(upper(1)).min(upper(2));
        (enter <= leave).then_some(enter)
    }

    /// The most that a point of the box can lie in a direction.
    fn reach(self, direction: DVec3) -> f64 {
        let (a, b) = (self.low.as_dvec3() * direction, self.high.as_dvec3() * direction);
        a.max(b).element_sum()
    }
}

/// The boxes around some things, which are known by number.
#[derive(Debug, Default)]
pub(super) struct Tree {
    order: Vec<u32>,
    levels: Vec<Vec<Bounds>>,
}

/// A box of the tree: its level, from 0 for those that hold things, and its place there.
type Node = (usize, usize);

impl Tree {
    /// Of `count` things, whose boxes `bounds` gives. The same for any number of threads.
    pub fn new(count: usize, bounds: impl Fn(usize) -> Bounds + Sync) -> Self {
        let all = (0..count).into_par_iter().map(&bounds).reduce(|| Bounds::NOTHING, Bounds::and);
        let scale = 1023.0 / (all.high - all.low).max_element().max(f32::MIN_POSITIVE);
        let mut keys: Vec<u64> = (0..count)
            .into_par_iter()
            .map(|i| {
                let b = bounds(i);
                let [x, y, z] = (((b.low + b.high) / 2.0 - all.low) * scale).to_array().map(|c| spread(c as u32));
                u64::from(x | y << 1 | z << 2) << 32 | i as u64
            })
            .collect();
        keys.par_sort_unstable();
        let order: Vec<u32> = keys.into_iter().map(|key| key as u32).collect();
        let join = |boxes: &[Bounds]| boxes.iter().copied().fold(Bounds::NOTHING, Bounds::and);
        let mut levels: Vec<Vec<Bounds>> = Vec::new();
        let leaf = |things: &[u32]| things.iter().map(|&i| bounds(i as usize)).fold(Bounds::NOTHING, Bounds::and);
        levels.push(order.par_chunks(WIDTH).map(leaf).collect());
        while levels.last().is_some_and(|level| level.len() > 1) {
            let above = levels.last().map(|level| level.par_chunks(WIDTH).map(join).collect());
            levels.extend(above);
        }
        Self { order, levels }
    }

    /// Calls `visit` for things in boxes for which `entry` gives a distance, nearest boxes first, as long as their
    /// distance is less than what `visit` returned least.
    pub fn along(&self, entry: impl Fn(Bounds) -> Option<f64>, mut visit: impl FnMut(usize) -> f64) {
        let mut limit = f64::INFINITY;
        let mut open: Vec<(f64, Node)> = Vec::new();
        let mut inner = Vec::with_capacity(WIDTH);
        let top = self.levels.len() - usize::from(!self.levels.is_empty());
        open.extend(self.levels.last().and_then(|level| Some((entry(*level.first()?)?, (top, 0)))));
        while let Some((distance, (level, place))) = open.pop() {
            if distance > limit {
                continue;
            }
            let range = place * WIDTH..(place + 1) * WIDTH;
            if level == 0 {
                for &thing in &self.order[range.start..range.end.min(self.order.len())] {
                    limit = limit.min(visit(thing as usize));
                }
                continue;
            }
            let below = &self.levels[level - 1];
            inner.clear();
            inner.extend(
                (range.start..range.end.min(below.len())).filter_map(|i| Some((entry(below[i])?, (level - 1, i)))),
            );
            inner.sort_by(|a: &(f64, Node), b| b.0.total_cmp(&a.0)); // the nearest is taken first
            open.append(&mut inner);
        }
    }

    /// The greatest of what `visit` returns, given that it is never more than what lies farthest in `direction` in the
    /// box of a thing.
    pub fn farthest(&self, direction: DVec3, mut visit: impl FnMut(usize) -> f64) {
        self.along(|b| Some(-b.reach(direction)), |thing| -visit(thing));
    }
}

/// The lowest ten bits, two zeros between them.
fn spread(x: u32) -> u32 {
    let x = x & 0x3ff;
    let x = (x | x << 16) & 0x0300_00ff;
    let x = (x | x << 8) & 0x0300_f00f;
    let x = (x | x << 4) & 0x030c_30c3;
    (x | x << 2) & 0x0924_9249
}
