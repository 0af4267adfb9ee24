//! What is wrong with a mesh, or at least noteworthy, each finding at its place.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;
use vv::mesh::faces::Faces;
use vv::mesh::validate::{Finding, validate};
use vv::mesh::{Mesh, Vertex};
use vv::stop::{Stop, Stopped};

use super::measure::FaceMeasure;
use super::selection::Item;
use super::walk::{End, Walk};

/// Findings of a kind that are listed; all are counted.
pub const LISTED: usize = 100;

/// A face counts as plane if no corner lies farther from its plane than this part of its width.
///
/// A square is folded by about 5° along its diagonal then, and its diagonals pass each other at 2 % of their length: what
/// panels of buildings are built with (H. Pottmann, A. Asperl, M. Hofer, A. Kilian, Architectural Geometry, 2007, on
/// planar quadrilateral meshes), and where checks of finite elements begin to warn of warped ones.
const PLANE: f64 = 0.01;

/// What rounding leaves.
const ROUNDING: f64 = 1e-6;

/// A face is degenerate if its area is less than this part of the square of its longest side.
const THIN: f64 = 1e-9;

/// A kind of finding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A vertex names one that does not name it.
    Incomplete,
    /// A walk that neither closes nor ends at gaps.
    Broken,
    /// A vertex that stands in rings but not in the set.
    Outside,
    /// A vertex that is nowhere, or whose ring breaks an invariant.
    Damaged,
    /// A walk along the boundary that passes corners without gap.
    Unclosed,
    /// A vertex without neighbours.
    Isolated,
    /// A face without area, or with two corners.
    Degenerate,
    /// A face whose corners lie in no plane.
    NotPlane,
}

impl Kind {
    /// What so many of it are called.
    #[must_use]
    pub fn title(self, count: usize) -> &'static str {
        if count == 1 {
            return match self {
                Self::Incomplete => "incomplete neighbour",
                Self::Broken => "broken orbit",
                Self::Outside => "neighbour outside the set",
                Self::Damaged => "damaged vertex",
                Self::Unclosed => "corner of the boundary without gap",
                Self::Isolated => "isolated vertex",
                Self::Degenerate => "degenerate face",
                Self::NotPlane => "face that is not plane",
            };
        }
        match self {
            Self::Incomplete => "incomplete neighbours",
            Self::Broken => "broken orbits",
            Self::Outside => "neighbours outside the set",
            Self::Damaged => "damaged vertices",
            Self::Unclosed => "corners of the boundary without gap",
            Self::Isolated => "isolated vertices",
            Self::Degenerate => "degenerate faces",
            Self::NotPlane => "faces that are not plane",
        }
    }

    /// What it means, in a sentence.
    #[must_use]
    pub fn explanation(self) -> &'static str {
        match self {
            Self::Incomplete => "a vertex names a neighbour that does not name it: u in v* without v in u*",
            Self::Broken => "Edmonds' walk comes to a vertex that does not name the one it comes from",
            Self::Outside => "a ring names a vertex that is not in the mesh's set",
            Self::Damaged => "the position is no number, or the ring breaks an invariant",
            Self::Unclosed => "a walk along the boundary passes a corner where no gap is written",
            Self::Isolated => "nobody names them, and they name nobody",
            Self::Degenerate => "the corners lie on a line or at a point, or there are only two",
            Self::NotPlane => {
                "by how far a corner lies off the plane that fits best, as a part of the face's width: more than 1 %, which \
                 for a quad is about 5° between its halves"
            }
        }
    }

    /// Whether it makes the mesh invalid.
    #[must_use]
    pub fn is_wrong(self) -> bool {
        !matches!(self, Self::Isolated | Self::Degenerate | Self::NotPlane)
    }
}

/// The findings of a kind.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// The kind.
    pub kind: Kind,
    /// How many there are.
    pub count: usize,
    /// The first of them; of the faces that are not plane, the worst.
    pub rows: Vec<Row>,
}

/// A finding.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// What it is, in a line.
    pub text: String,
    /// Where: what is selected to show it.
    pub item: Item,
    /// The first edge of the walk that shows it.
    pub walk: Option<[Vertex; 2]>,
    /// The entry that is not answered, from whom to whom.
    pub one_way: Option<[Vertex; 2]>,
}

/// All findings of a mesh.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Findings {
    /// By kind, the kinds that occur.
    pub groups: Vec<Group>,
    /// How many faces are bent, but so little that they count as plane, and how much at most.
    pub nearly_plane: (usize, f64),
    /// All entries that are not answered: who is named, by whom; sorted.
    one_way: Vec<[Vertex; 2]>,
}

impl Findings {
    /// Looks for them; `valid` if the mesh is known to be valid. Cost: linear, on all threads.
    ///
    /// # Errors
    /// When stopped.
    pub fn of(mesh: &Mesh, faces: &Faces, valid: bool, stop: &Stop) -> Result<Self, Stopped> {
        let mut all = Self::default();
        if !valid {
            all.add_faults(mesh, &validate(mesh, stop)?);
        }
        let isolated = mesh.vertices().filter(|&v| mesh.set.contains(v) && mesh.ring(v).slots().is_empty());
        all.add(Kind::Isolated, isolated.map(|v| (v, ())), |v, ()| row(format!("{v} has no neighbours"), vertex(v)));
        stop.check()?;
        let shapes = in_pieces(faces, |range| shapes(mesh, faces, range), stop)?;
        let (mut thin, mut bent) = (Vec::new(), Vec::new());
        for mut piece in shapes {
            thin.append(&mut piece.thin);
            bent.append(&mut piece.bent);
            let (count, most) = all.nearly_plane;
            all.nearly_plane = (count + piece.nearly_plane.0, piece.nearly_plane.1.max(most));
        }
        let face = |i: usize| match faces.get(i) {
            &[p, q, ..] => Some(Item::Face([p, q])),
            _ => None,
        };
        let named = |i: usize| -> String {
            let corners = faces.get(i);
            let names: Vec<String> = corners.iter().take(6).map(ToString::to_string).collect();
            format!("{}{}", names.join(" "), if corners.len() > 6 { " …" } else { "" })
        };
        let thin = thin.into_iter().filter_map(|i| Some((face(i)?, i)));
        all.add(Kind::Degenerate, thin, |item, i| row(format!("face {}", named(i)), item));
        // The worst first; of equals, the first.
        let worst = |a: &(f64, usize), b: &(f64, usize)| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1));
        if bent.len() > LISTED {
            bent.select_nth_unstable_by(LISTED, worst);
        }
        let listed = bent.len().min(LISTED);
        bent[..listed].sort_unstable_by(worst);
        let bent = bent.into_iter().filter_map(|(warp, i)| Some((face(i)?, (warp, i))));
        all.add(Kind::NotPlane, bent, |item, (warp, i)| row(format!("{}  face {}", percent(warp), named(i)), item));
        Ok(all)
    }

    /// How many there are of the kinds that make a mesh invalid, and of all.
    #[must_use]
    pub fn counts(&self) -> (usize, usize) {
        let count = |counts: fn(Kind) -> bool| self.groups.iter().filter(|g| counts(g.kind)).map(|g| g.count).sum();
        (count(Kind::is_wrong), count(|_| true))
    }

    /// Those that name a vertex which does not name them.
    pub fn unanswered(&self, v: Vertex) -> impl Iterator<Item = Vertex> + '_ {
        let start = self.one_way.partition_point(|&[to, _]| to < v);
        self.one_way[start..].iter().take_while(move |[to, _]| *to == v).map(|&[_, from]| from)
    }

    fn add_faults(&mut self, mesh: &Mesh, findings: &[Finding]) {
        let one_way = |f: &Finding| match *f {
            Finding::OneSided { from, to } => Some((from, to)),
            _ => None,
        };
        self.add(Kind::Incomplete, findings.iter().filter_map(one_way), |from, to| Row {
            one_way: Some([from, to]),
            ..row(format!("{from} → {to}: {to} does not name {from}"), vertex(from))
        });
        self.one_way = findings.iter().filter_map(one_way).map(|(from, to)| [to, from]).collect();
        self.one_way.sort_unstable();
        // Each entry that is not answered ends one walk.
        let ends = findings.iter().filter_map(|f| match *f {
            Finding::OneSided { from, to } | Finding::Outside { from, to } => Some((from, to)),
            _ => None,
        });
        self.add(Kind::Broken, ends, |from, to| {
            let walk = Walk::through(mesh, from, to);
            let names: Vec<String> = walk.path.iter().rev().take(6).rev().map(ToString::to_string).collect();
            let before = if walk.path.len() > 6 { "… " } else { "" };
            let first = [walk.path[0], walk.path[1]];
            let why = match walk.end {
                End::Outside { .. } => format!("{to} is not in the set"),
                _ => format!("{to} does not name {from}"),
            };
            let text = format!("orbit {before}{}: {why}", names.join(" → "));
            Row { walk: Some(first), ..row(text, vertex(to)) }
        });
        let outside = findings.iter().filter_map(|f| match *f {
            Finding::Outside { from, to } => Some((from, to)),
            _ => None,
        });
        self.add(Kind::Outside, outside, |from, to| Row {
            one_way: Some([from, to]),
            ..row(format!("{from} names {to}, which is not in the set"), vertex(from))
        });
        let damaged = findings.iter().filter_map(|f| match *f {
            Finding::NotFinite { vertex } => Some((vertex, "is at no finite place")),
            Finding::Ring { vertex } => Some((vertex, "has a damaged ring")),
            Finding::Foreign { vertex } => Some((vertex, "is in the set but does not exist")),
            _ => None,
        });
        self.add(Kind::Damaged, damaged, |v, what| row(format!("{v} {what}"), vertex(v)));
        let unclosed = findings.iter().filter_map(|f| match *f {
            Finding::Unclosed { at, after } => Some((at, after)),
            _ => None,
        });
        self.add(Kind::Unclosed, unclosed, |at, after| row(format!("{at} has no gap after {after}"), vertex(at)));
    }

    /// Counts all, lists the first.
    fn add<T, U>(&mut self, kind: Kind, found: impl Iterator<Item = (T, U)>, show: impl Fn(T, U) -> Row) {
        let mut group = Group { kind, count: 0, rows: Vec::new() };
        for (a, b) in found {
            group.count += 1;
            if group.rows.len() < LISTED {
                group.rows.push(show(a, b));
            }
        }
        if group.count > 0 {
            self.groups.push(group);
        }
    }
}

fn vertex(v: Vertex) -> Item {
    Item::Vertex(v)
}

fn row(text: String, item: Item) -> Row {
    Row { text, item, walk: None, one_way: None }
}

/// A part of a whole, for people.
pub fn percent(part: f64) -> String {
    match 100.0 * part {
        p if p < 0.01 => format!("{p:.1e} %"),
        p => format!("{p:.2} %"),
    }
}

/// What is found of the faces of a range.
#[derive(Default)]
struct Shapes {
    /// Those that are degenerate.
    thin: Vec<usize>,
    /// Those that are not plane, with how much.
    bent: Vec<(f64, usize)>,
    nearly_plane: (usize, f64),
}

fn shapes(mesh: &Mesh, faces: &Faces, range: Range<usize>) -> Shapes {
    let Shapes { mut thin, mut bent, mut nearly_plane } = Shapes::default();
    let mut points: Vec<DVec3> = Vec::new();
    for i in range {
        let corners = faces.get(i);
        // As most are, and they are always plane.
        if let &[a, b, c] = corners {
            let [a, b, c] = [a, b, c].map(|v| mesh.position(v));
            let (ab, ac) = (b - a, c - a);
            let longest = ab.length_squared().max(ac.length_squared()).max(b.distance_squared(c));
            if longest.is_finite() && ab.cross(ac).length() <= 2.0 * THIN * longest {
                thin.push(i);
            }
            continue;
        }
        points.clear();
        points.extend(corners.iter().map(|&v| mesh.position(v)));
        let m = FaceMeasure::of(&points);
        // What is nowhere is told of elsewhere.
        if !m.radius.is_finite() {
            continue;
        }
        if corners.len() < 3 || m.area <= THIN * m.longest * m.longest {
            thin.push(i);
        } else if corners.len() > 3 && m.warp() > PLANE {
            bent.push((m.warp(), i));
        } else if corners.len() > 3 && m.warp() > ROUNDING {
            nearly_plane = (nearly_plane.0 + 1, m.warp().max(nearly_plane.1));
        }
    }
    Shapes { thin, bent, nearly_plane }
}

/// Does something with all faces, piece by piece; the results are in order.
fn in_pieces<T: Send>(faces: &Faces, work: impl Fn(Range<usize>) -> T + Sync, stop: &Stop) -> Result<Vec<T>, Stopped> {
    const PIECE: usize = 1 << 13;
    (0..faces.len().div_ceil(PIECE))
        .into_par_iter()
        .map(|i| {
            stop.check()?;
            Ok(work(i * PIECE..faces.len().min((i + 1) * PIECE)))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn v(number: usize) -> Vertex {
        Vertex::from_index(number - 1).unwrap()
    }

    /// Rings as numbers, a gap as 0.
    fn mesh(rings: &[&[usize]], positions: &[[f64; 3]]) -> Mesh {
        let mut mesh = Mesh::new();
        for &position in positions {
            let v = mesh.create().unwrap();
            mesh.set.add(v);
            mesh.set_position(v, position.into());
        }
        for (i, ring) in rings.iter().enumerate() {
            let items: Vec<_> = ring.iter().map(|&n| (n > 0).then(|| v(n))).collect();
            mesh.make(v(i + 1), &items).unwrap();
        }
        mesh
    }

    #[track_caller]
    fn check(mesh: &Mesh, expected: &[&str]) {
        let stop = Stop::new();
        let faces = vv::mesh::faces::faces(mesh, &stop).unwrap();
        let found = Findings::of(mesh, &faces, false, &stop).unwrap();
        let show = |g: &Group| {
            let title = format!("{} {}", g.count, g.kind.title(g.count));
            std::iter::once(title).chain(g.rows.iter().map(|row| row.text.clone())).collect::<Vec<_>>()
        };
        assert_eq!(found.groups.iter().flat_map(show).collect::<Vec<_>>(), expected);
    }

    const SQUARE: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    const AROUND: [&[usize]; 4] = [&[2, 4, 0], &[3, 1, 0], &[4, 2, 0], &[1, 3, 0]];

    #[test]
    fn a_plane_square_has_no_findings() {
        check(&mesh(&AROUND, &SQUARE), &[]);
    }

    #[test]
    fn a_bent_square_is_not_plane_and_one_on_a_line_is_degenerate() {
        let mut bent = SQUARE;
        bent[2][2] = 0.5;
        check(&mesh(&AROUND, &bent), &["1 face that is not plane", "7.36 %  face v1 v2 v3 v4"]);
        let flat = SQUARE.map(|[x, _, _]| [x, 0.0, 0.0]);
        check(&mesh(&AROUND, &flat), &["1 degenerate face", "face v1 v2 v3 v4"]);
    }

    #[test]
    fn a_square_that_is_bent_less_than_anybody_sees_counts_as_plane() {
        for (lift, expected) in [(0.05, (1, true)), (0.06, (0, false)), (1e-9, (0, false))] {
            let mut bent = SQUARE;
            bent[2][2] = lift;
            let (mesh, stop) = (mesh(&AROUND, &bent), Stop::new());
            let faces = vv::mesh::faces::faces(&mesh, &stop).unwrap();
            let found = Findings::of(&mesh, &faces, true, &stop).unwrap();
            let (count, most) = found.nearly_plane;
            assert_eq!((count, most > 0.0), expected, "{lift}");
            assert_eq!(found.counts().1, usize::from(lift == 0.06), "{lift}");
        }
    }

    #[test]
    fn a_thin_triangle_is_degenerate() {
        let rings: [&[usize]; 3] = [&[2, 3, 0], &[3, 1, 0], &[1, 2, 0]];
        let line = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 1e-12, 0.0]];
        check(&mesh(&rings, &line), &["1 degenerate face", "face v1 v2 v3"]);
    }

    #[test]
    fn neighbours_that_do_not_answer_break_orbits() {
        let mut torn = mesh(&AROUND, &SQUARE);
        torn.erase(Some(v(1)), v(2));
        check(
            &torn,
            &[
                "1 incomplete neighbour",
                "v1 → v2: v2 does not name v1",
                "1 broken orbit",
                "orbit v1 → v2: v2 does not name v1",
            ],
        );
    }

    #[test]
    fn neighbours_outside_the_set_and_vertices_alone_are_told_of() {
        let mut alone = mesh(&[&[2], &[1], &[]], &SQUARE[..3]);
        alone.set.remove(v(2));
        check(
            &alone,
            &[
                "1 broken orbit",
                "orbit v1 → v2: v2 is not in the set",
                "1 neighbour outside the set",
                "v1 names v2, which is not in the set",
                "1 isolated vertex",
                "v3 has no neighbours",
            ],
        );
    }
}
