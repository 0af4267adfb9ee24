//! Boxes in boxes over triangles in the picture: finds those that a line or a point may lie behind.

use glam::{DVec2, DVec3, Vec3Swizzles};

/// Things in a box at the bottom.
const FEW: usize = 6;

/// What lies inside, in picture coordinates; `near` is the greatest z.
#[derive(Debug, Clone, Copy)]
struct Extent {
    low: DVec2,
    high: DVec2,
    near: f64,
}

/// A box: its things, or its halves, which follow it and stand at `second`.
#[derive(Debug)]
struct Node {
    extent: Extent,
    start: u32,
    end: u32,
    /// 0 for a box of things.
    second: u32,
}

/// Built once, then only asked.
#[derive(Debug, Default)]
pub(super) struct Boxes {
    nodes: Vec<Node>,
    order: Vec<u32>,
}

impl Boxes {
    /// Over triangles. Halves them at the median of the longer side: O(n log n), and no deeper than log n.
    pub fn new(triangles: &[[DVec3; 3]]) -> Self {
        let extents: Vec<_> = triangles.iter().map(|t| Extent::of(t)).collect();
        let mut boxes = Self { nodes: Vec::new(), order: (0..).take(triangles.len()).collect() };
        if !triangles.is_empty() {
            boxes.split(&extents, 0, triangles.len());
        }
        boxes
    }

    fn split(&mut self, extents: &[Extent], start: usize, end: usize) {
        let things = &mut self.order[start..end];
        let of = |i: &u32| extents[*i as usize];
        let extent = things.iter().map(of).fold(Extent::NOTHING, Extent::and);
        let node = self.nodes.len();
        self.nodes.push(Node { extent, start: start as u32, end: end as u32, second: 0 });
        if things.len() <= FEW {
            return;
        }
        let size = extent.high - extent.low;
        let along = |i: &u32| {
            let middle = of(i).low + of(i).high;
            if size.x >= size.y { middle.x } else { middle.y }
        };
        let half = things.len() / 2;
        things.select_nth_unstable_by(half, |a, b| along(a).total_cmp(&along(b)).then(a.cmp(b)));
        self.split(extents, start, start + half);
        self.nodes[node].second = self.nodes.len() as u32;
        self.split(extents, start + half, end);
    }

    /// Calls `found` with those whose boxes meet the line's and reach nearer than it, until that says no.
    pub fn before_line(&self, a: DVec3, b: DVec3, found: impl FnMut(u32) -> bool) {
        let far = a.z.min(b.z);
        let (low, high) = (a.min(b).xy(), a.max(b).xy());
        let across = (b - a).xy().perp();
        let place = across.dot(a.xy());
        let slack = 1e-9 * across.abs().element_sum();
        self.visit(
            |e| {
                let middle = (e.low + e.high) / 2.0;
                let reach = ((e.high - e.low) / 2.0).dot(across.abs()) + slack;
                e.near >= far
                    && e.low.cmple(high).all()
                    && low.cmple(e.high).all()
                    && (across.dot(middle) - place).abs() <= reach
            },
            found,
        );
    }

    /// Calls `found` with those whose boxes meet a rectangle, until that says no.
    pub fn meeting(&self, low: DVec2, high: DVec2, found: impl FnMut(u32) -> bool) {
        self.visit(|e| e.low.cmple(high).all() && low.cmple(e.high).all(), found);
    }

    fn visit(&self, wanted: impl Fn(&Extent) -> bool, mut found: impl FnMut(u32) -> bool) {
        let mut waiting = vec![0];
        while let Some(index) = waiting.pop() {
            let Some(node) = self.nodes.get(index as usize) else { return };
            if !wanted(&node.extent) {
                continue;
            }
            if node.second > 0 {
                waiting.extend([node.second, index + 1]);
            } else if !self.order[node.start as usize..node.end as usize].iter().all(|&thing| found(thing)) {
                return;
            }
        }
    }
}

impl Extent {
    const NOTHING: Self = Self { low: DVec2::INFINITY, high: DVec2::NEG_INFINITY, near: f64::NEG_INFINITY };

    fn of(points: &[DVec3]) -> Self {
        points.iter().fold(Self::NOTHING, |e, p| e.and(Self { low: p.xy(), high: p.xy(), near: p.z }))
    }

    fn and(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high), near: self.near.max(other.near) }
    }
}
