//! What is written and marked on a surface: labels, and the order of rings.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use glam::{DVec2, DVec3, Vec3Swizzles};
use rayon::prelude::*;

use vv::mesh::Vertex;

use super::hidden::Hider;
use super::page::{Dots, Note, Strokes};
use super::space::{NONE, Space};
use super::surface::Surface;
use super::{Dash, Line, Subject};
use crate::annotate::Label;
use crate::annotate::labels::Texts;
use crate::inspect::ring::{Entry, Ring};
use crate::scene::Theme;

/// What is written and marked beside what the style says.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Notes {
    /// What is written at vertices or in faces.
    pub labels: Label,
    /// Vertices whose neighbours are numbered in their order.
    pub rings: Vec<Vertex>,
}

impl Notes {
    /// Whether there is nothing to write.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.labels == Label::Nothing && self.rings.is_empty()
    }
}

/// Something of the notes that is not drawn, and why.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Missing {
    /// The vertex whose ring it is; `None` for the labels, all of them.
    pub ring: Option<Vertex>,
    pub(super) why: &'static str,
}

impl fmt::Display for Missing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.ring {
            Some(v) => write!(f, "the ring of {v} is not drawn: {}", self.why),
            None => write!(f, "no label is drawn: {}", self.why),
        }
    }
}

impl Missing {
    /// What is missing in all of these pictures, as the first one has it.
    pub fn in_all(pictures: impl IntoIterator<Item = Vec<Self>>) -> Vec<Self> {
        let both = |mut one: Vec<Self>, other: Vec<Self>| {
            one.retain(|missing| other.iter().any(|o| o.ring == missing.ring));
            one
        };
        pictures.into_iter().reduce(both).unwrap_or_default()
    }
}

/// In which colours it is written.
#[derive(Debug, Clone, Copy)]
pub(super) struct Inks {
    pub text: [u8; 3],
    pub ring: [u8; 3],
    /// Around letters.
    pub paper: [u8; 3],
    /// The directions x, y and z.
    pub axes: [[u8; 3]; 3],
}

impl Inks {
    /// As the window has them.
    pub fn of(theme: Theme) -> Self {
        match theme {
            Theme::Light => Self { text: [0x1c, 0x23, 0x2d], ..Self::PAPER },
            Theme::Dark => Self {
                text: [0xd5, 0xdd, 0xe8],
                ring: [0x6c, 0xc4, 0xff],
                paper: [0x10, 0x12, 0x15],
                axes: [[0xff, 0x7a, 0x6b], [0x7f, 0xd6, 0x8a], [0x7f, 0xb2, 0xff]],
            },
        }
    }

    /// On white paper.
    pub const PAPER: Self = Self {
        text: [0; 3],
        ring: [0x0b, 0x5c, 0xc4],
        paper: [0xff; 3],
        axes: [[0xc4, 0x2a, 0x1e], [0x1d, 0x7a, 0x2f], [0x1a, 0x52, 0xcc]],
    };
}

/// What is drawn of [`Notes`], in picture coordinates, what matters most first.
#[derive(Debug, Default)]
pub(super) struct Found {
    pub notes: Vec<Note>,
    pub strokes: Vec<Strokes>,
    pub dots: Vec<Dots>,
    pub missing: Vec<Missing>,
}

/// Labels beyond so many could not be told apart on any page.
const MOST: usize = 20_000;

/// A label keeps clear of lines as long as it is no farther off than this, over the height of letters.
const FAR: f64 = 1.3;

/// Not kept clear of lines.
const NARROW: (f64, f64) = (0.0, 0.0);

/// Neighbours that are numbered.
const ORDERED: usize = 48;

/// What is seen of the notes, in letters of `size` points beside dots of a radius of `dot`. `lines` are the lines that are
/// drawn from vertices, named as in the surface, which labels keep clear of; nothing hides anything where there is no
/// `hider`.
pub(super) fn find(
    subject: &Subject<'_>,
    surface: &Surface,
    space: &Space,
    hider: Option<&Hider>,
    lines: &BTreeMap<u32, Vec<DVec2>>,
    (dot, size, inks): (f64, f64, Inks),
) -> Found {
    let mut found = Found::default();
    let writer = Writer { subject, surface, space, hider, inks, size };
    let mut taken = BTreeSet::new();
    for &v in &subject.notes.rings {
        match writer.ring(v, &mut found) {
            Ok(named) => taken.extend(named),
            Err(why) => found.missing.push(Missing { ring: Some(v), why }),
        }
    }
    let Some(texts) = Texts::of(subject.mesh, subject.faces, subject.tint, &subject.notes.labels) else { return found };
    let nothing = Missing { ring: None, why: "nothing that has one is seen" };
    let clearance = dot + 0.26 * size;
    let note = |at: DVec2, (toward, gap): (DVec2, f64), element: usize| Note {
        name: "labels",
        at,
        toward,
        clearance,
        gap: (gap, FAR * size),
        text: texts.text(element),
        size,
        color: inks.text,
    };
    if texts.at_faces() {
        let places = writer.faces();
        found.missing.extend(places.is_empty().then_some(nothing));
        found.notes.extend(places.into_iter().map(|(face, at)| note(at, (DVec2::ZERO, 0.0), face)));
        return found;
    }
    let owner = |corner: u32| subject.scene.mesh.vertex(corner);
    let mut seen: Vec<(Vertex, u32, DVec3)> =
        surface.vertices.iter().filter_map(|&(corner, at)| Some((owner(corner)?, corner, at))).collect();
    // Old vertices, which the coarse mesh had already, come first.
    seen.sort_unstable_by_key(|(v, ..)| *v);
    let mut places: Vec<(Vertex, u32, DVec3)> = Vec::new();
    for some in seen.chunks(MOST) {
        let visible = |(_, corner, at): &&(Vertex, u32, DVec3)| hider.is_none_or(|h| !h.hides_vertex(*corner, *at));
        places.par_extend(some.par_iter().filter(visible));
        if places.len() >= MOST {
            break;
        }
    }
    found.missing.extend(places.is_empty().then_some(nothing));
    let names = subject.notes.labels == Label::Vertices;
    places.retain(|(v, ..)| !(names && taken.contains(v)));
    places.truncate(MOST);
    found.notes.extend(
        places
            .into_iter()
            .map(|(v, corner, at)| note(at.xy(), widest_gap(lines.get(&corner).map_or(&[], |lines| lines)), v.index())),
    );
    found
}

/// Where most room is between lines that leave a point in these directions, rather upwards and to the right; and half the
/// angle of it.
pub(super) fn widest_gap(lines: &[DVec2]) -> (DVec2, f64) {
    const LIKED: f64 = 0.9;
    const WEIGHT: f64 = 0.25;
    use std::f64::consts::{PI, TAU};
    let mut angles: Vec<f64> = lines.iter().map(|d| d.y.atan2(d.x)).collect();
    angles.sort_by(f64::total_cmp);
    let gaps = angles.iter().enumerate().map(|(i, &a)| {
        let b = angles.get(i + 1).copied().unwrap_or(angles[0] + TAU);
        ((a + b) / 2.0, b - a)
    });
    let worth = |(middle, width): &(f64, f64)| width + WEIGHT * (middle - LIKED).cos();
    let (middle, width) = gaps.max_by(|a, b| worth(a).total_cmp(&worth(b))).unwrap_or((LIKED, TAU));
    (DVec2::from_angle(middle), (width / 2.0).min(PI))
}

struct Writer<'a> {
    subject: &'a Subject<'a>,
    surface: &'a Surface,
    space: &'a Space,
    hider: Option<&'a Hider>,
    inks: Inks,
    size: f64,
}

impl Writer<'_> {
    /// Where a vertex is, if it lies in the picture, and which corner it is.
    fn corner(&self, v: Vertex) -> Option<(u32, DVec3)> {
        let corner = self.surface.corner_of.get(v.index()).copied().filter(|c| *c != NONE)?;
        let point = self.surface.points.get(corner as usize).filter(|p| self.space.holds(**p))?;
        Some((corner, self.space.project(*point)))
    }

    fn is_seen(&self, (corner, at): (u32, DVec3)) -> bool {
        self.hider.is_none_or(|hider| !hider.hides_vertex(corner, at))
    }

    /// The neighbours of a vertex in their order: an arrow from one to the next, and numbers. Those that got one; or why
    /// there is nothing to draw.
    fn ring(&self, v: Vertex, found: &mut Found) -> Result<Vec<Vertex>, &'static str> {
        /// Of the way to the nearest neighbour.
        const RADIUS: f64 = 0.42;
        let mesh = self.subject.mesh;
        let middle = self.corner(v).ok_or("the vertex lies outside of the picture, or is cut away")?;
        if !self.is_seen(middle) {
            return Err("the vertex is hidden by faces");
        }
        let ring = Ring::of(mesh, v);
        if ring.len > ORDERED {
            return Err("it is too long to be numbered");
        }
        if ring.vertices().next().is_none() {
            return Err("it is empty");
        }
        let center = mesh.position(v);
        let arm = |u: Vertex| mesh.position(u) - center;
        let nearest = ring.vertices().map(|u| arm(u).length()).filter(|l| *l > 0.0).fold(f64::INFINITY, f64::min);
        let project = |world: DVec3| self.space.project(self.space.view(world)).xy();
        let sector = |i: usize| Some((ring.entries[i].vertex()?, ring.entries[(i + 1) % ring.entries.len()].vertex()?));
        let turn = |q: Vertex, r: Vertex| {
            let at = middle.1.xy();
            (project(mesh.position(q)) - at).perp_dot(project(mesh.position(r)) - at)
        };
        let count = ring.entries.len();
        let sectors: Vec<_> = (0..count).filter_map(sector).filter(|(q, r)| q != r).collect();
        // Those that are turned away lie behind the others, if any face us at all.
        let facing = sectors.iter().any(|&(q, r)| turn(q, r) > 0.0) && self.hider.is_some();
        let (mut pieces, mut heads) = (Vec::new(), Vec::new());
        for &(q, r) in sectors.iter().filter(|(q, r)| !facing || turn(*q, *r) > 0.0) {
            let curve: Vec<DVec2> = arc(arm(q), arm(r), RADIUS * nearest).map(|d| project(center + d)).collect();
            pieces.extend(curve.windows(2).map(|w| [w[0], w[1]]));
            if let [.., before, tip] = curve[..] {
                heads.push([before, tip]);
            }
        }
        let note = |at: DVec2, toward: DVec2, text: String| Note {
            name: "order",
            at,
            toward,
            clearance: 0.4 * self.size,
            gap: NARROW,
            text,
            size: self.size,
            color: self.inks.ring,
        };
        let mut named = vec![v];
        let mut places = vec![middle.1.xy()];
        for (number, (u, answers)) in (1..).zip(ring.entries.iter().filter_map(|entry| match *entry {
            Entry::Vertex { vertex, answers, .. } => Some((vertex, answers)),
            Entry::Gap => None,
        })) {
            let Some(place) = self.corner(u).filter(|at| self.is_seen(*at)) else { continue };
            let at = place.1.xy();
            let mark = if answers { "" } else { "!" };
            let text = match self.subject.notes.labels {
                Label::Vertices => format!("{number}{mark} – {u}"),
                _ => format!("{number}{mark}"),
            };
            let toward = (at - middle.1.xy()).normalize_or(DVec2::Y);
            found.notes.push(note(at, toward, text));
            named.push(u);
            places.push(at);
        }
        if self.subject.notes.labels == Label::Vertices {
            let away: Vec<DVec2> = ring.vertices().map(|u| project(mesh.position(u)) - middle.1.xy()).collect();
            found.notes.push(note(middle.1.xy(), widest_gap(&away).0, v.to_string()));
        }
        let line = Line { width: 0.11 * self.size, color: self.inks.ring, dash: Dash::Solid };
        found.strokes.push(Strokes { name: "rings", line, pieces, heads });
        found.dots.push(Dots { name: "neighbours", diameter: 0.43 * self.size, color: self.inks.ring, places });
        Ok(named)
    }

    /// The faces whose middles are seen, and where.
    fn faces(&self) -> Vec<(usize, DVec2)> {
        let part = &self.subject.scene.mesh;
        let mut of_face: BTreeMap<u32, Vec<[DVec3; 3]>> = BTreeMap::new();
        for triangle in &self.surface.triangles {
            if let Some(&face) = part.triangle_faces.get(triangle.number as usize) {
                of_face.entry(face).or_default().push(triangle.corners);
            }
        }
        let middle = |triangles: &[[DVec3; 3]]| {
            // The middle of the corners, on the surface; or in the largest triangle, if it lies beside the face.
            let sum: DVec2 = triangles.iter().flatten().map(|p| p.xy()).sum();
            let center = sum / (3.0 * triangles.len() as f64);
            triangles.iter().find_map(|t| on(t, center)).or_else(|| {
                let size = |t: &&[DVec3; 3]| (t[1] - t[0]).xy().perp_dot((t[2] - t[0]).xy()).abs();
                let largest = triangles.iter().max_by(|a, b| size(a).total_cmp(&size(b)))?;
                Some((largest[0] + largest[1] + largest[2]) / 3.0)
            })
        };
        let middles: Vec<_> =
            of_face.iter().filter_map(|(f, triangles)| Some((*f as usize, middle(triangles)?))).collect();
        let seen = middles.into_par_iter().filter(|(_, at)| self.is_seen((NONE, *at)));
        let mut all: Vec<_> = seen.map(|(face, at)| (face, at.xy())).collect();
        all.truncate(MOST);
        all
    }
}

/// The point of a triangle over a place, if it covers that.
fn on(t: &[DVec3; 3], p: DVec2) -> Option<DVec3> {
    let side = |a: DVec3, b: DVec3| (b - a).xy().perp_dot(p - a.xy());
    let weights = [side(t[1], t[2]), side(t[2], t[0]), side(t[0], t[1])];
    let area: f64 = weights.iter().sum();
    let inside = area != 0.0 && weights.iter().all(|w| w * area >= 0.0);
    inside.then(|| (t[0] * weights[0] + t[1] * weights[1] + t[2] * weights[2]) / area)
}

/// An arc around nothing, in the plane of two arms, from close to one to close to the other.
fn arc(a: DVec3, b: DVec3, radius: f64) -> impl Iterator<Item = DVec3> {
    const PIECES: u32 = 10;
    let (a, b) = (a.normalize_or_zero(), b.normalize_or_zero());
    let angle = a.dot(b).clamp(-1.0, 1.0).acos();
    (0..=PIECES).map(move |i| {
        let t = 0.12 + 0.76 * f64::from(i) / f64::from(PIECES);
        // Along the circle, but for arms that point to opposite sides and have no plane.
        let along = if angle.sin() > 1e-6 {
            (a * ((1.0 - t) * angle).sin() + b * (t * angle).sin()) / angle.sin()
        } else {
            a.lerp(b, t)
        };
        radius * along
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(lines: &[(f64, f64)], expected: (f64, f64)) {
        let lines: Vec<DVec2> = lines.iter().map(|&p| p.into()).collect();
        let (toward, _) = widest_gap(&lines);
        assert!(toward.distance(DVec2::from(expected).normalize()) < 0.02, "{toward}");
    }

    #[test]
    fn a_label_stands_where_most_room_is() {
        check(&[(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)], (0.0, -1.0));
        check(&[(0.0, -2.0)], (0.0, 1.0));
        // Among equals up and to the right.
        check(&[(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)], (1.0, 1.0));
        check(&[], (0.62, 0.78));
    }
}
