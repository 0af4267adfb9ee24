//! Pieces of lines to long lines: fewer, so that files are small, corners are joined and dashes run on.

use super::page::{At, Path};

/// More lines than this at one point are left as they are.
const MOST_AT_A_POINT: usize = 64;

/// Of so many points in a row one stays, straight or not: each is looked at again with every one that follows.
const MOST_IN_A_ROW: usize = 256;

/// How far a point may lie from the line that leaves it out, in hundredths of a point: what rounding may move it.
const STRAIGHT: f64 = 0.75;

/// Joins pieces that meet, the straightest ones first, and leaves out points on straight lines. In order of the pieces.
pub(super) fn chain(mut pieces: Vec<[At; 2]>) -> Vec<Path> {
    for piece in &mut pieces {
        piece.sort_unstable();
    }
    pieces.retain(|[a, b]| a != b);
    pieces.sort_unstable();
    pieces.dedup();
    let links = links(&pieces);
    let mut used = vec![false; pieces.len()];
    let mut paths = Vec::new();
    // Lines with ends, then what goes around.
    let ends = (0..2 * pieces.len()).filter(|&end| links[end].is_none());
    for start in ends.chain((0..pieces.len()).map(|piece| 2 * piece)) {
        if used[start / 2] {
            continue;
        }
        let mut points = vec![point(&pieces, start)];
        let mut end = start;
        let closed = loop {
            used[end / 2] = true;
            points.push(point(&pieces, end ^ 1));
            match links[end ^ 1] {
                Some(next) if next == start => break true,
                Some(next) => end = next,
                None => break false,
            }
        };
        if closed {
            points.pop();
        }
        paths.push(straightened(Path { points, closed }));
    }
    paths
}

/// An end is twice the number of its piece, one more for the second.
fn point(pieces: &[[At; 2]], end: usize) -> At {
    pieces[end / 2][end % 2]
}

/// With which end each goes on.
fn links(pieces: &[[At; 2]]) -> Vec<Option<usize>> {
    let mut links = vec![None; 2 * pieces.len()];
    let mut ends: Vec<usize> = (0..2 * pieces.len()).collect();
    ends.sort_unstable_by_key(|&end| (point(pieces, end), end));
    let leads = |end: usize| {
        let (from, to) = (point(pieces, end), point(pieces, end ^ 1));
        to.minus(from).normalize_or_zero()
    };
    for meeting in ends.chunk_by(|&a, &b| point(pieces, a) == point(pieces, b)) {
        if meeting.len() > MOST_AT_A_POINT {
            continue;
        }
        let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
        for (i, &a) in meeting.iter().enumerate() {
            pairs.extend(meeting[i + 1..].iter().map(|&b| (leads(a).dot(leads(b)), a, b)));
        }
        pairs.sort_by(|p, q| p.0.total_cmp(&q.0).then((p.1, p.2).cmp(&(q.1, q.2))));
        for (_, a, b) in pairs {
            if links[a].is_none() && links[b].is_none() {
                (links[a], links[b]) = (Some(b), Some(a));
            }
        }
    }
    links
}

/// Without the points that lie on the line between those that stay.
fn straightened(path: Path) -> Path {
    let mut points = path.points;
    if path.closed {
        points.push(points[0]);
    }
    let mut kept = vec![points[0]];
    let mut anchor = 0;
    for i in 1..points.len() - 1 {
        if i + 1 - anchor > MOST_IN_A_ROW || !is_straight(&points[anchor..i + 2]) {
            kept.push(points[i]);
            anchor = i;
        }
    }
    if !path.closed {
        kept.push(points[points.len() - 1]);
    }
    Path { points: kept, closed: path.closed }
}

/// Whether all points lie on the line from the first to the last, one after the other.
fn is_straight(points: &[At]) -> bool {
    let (first, last) = (points[0], points[points.len() - 1]);
    let line = last.minus(first);
    let length = line.length();
    length > 0.0
        && points[1..points.len() - 1].iter().all(|p| line.perp_dot(p.minus(first)).abs() <= STRAIGHT * length)
        && points.windows(2).all(|w| line.dot(w[1].minus(w[0])) > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(pieces: &[[(i32, i32); 2]], expected: &[(&[(i32, i32)], bool)]) {
        let pieces = pieces.iter().map(|piece| piece.map(|(x, y)| At { x, y })).collect();
        let paths: Vec<_> = chain(pieces).into_iter().map(|p| (p.points, p.closed)).collect();
        let at = |points: &[(i32, i32)]| points.iter().map(|&(x, y)| At { x, y }).collect::<Vec<_>>();
        let expected: Vec<_> = expected.iter().map(|&(points, closed)| (at(points), closed)).collect();
        assert_eq!(paths, expected);
    }

    #[test]
    fn pieces_of_a_straight_line_are_one_piece() {
        check(&[[(100, 0), (200, 0)], [(300, 1), (200, 0)], [(0, 0), (100, 0)]], &[(&[(0, 0), (300, 1)], false)]);
    }

    #[test]
    fn a_line_goes_on_straight_where_lines_cross() {
        let cross = [[(0, 0), (50, 50)], [(50, 50), (100, 0)], [(0, 100), (50, 50)], [(50, 50), (100, 100)]];
        check(&cross, &[(&[(0, 0), (100, 100)], false), (&[(0, 100), (100, 0)], false)]);
    }

    #[test]
    fn what_goes_around_is_closed() {
        let square = [[(0, 0), (9, 0)], [(9, 0), (9, 9)], [(9, 9), (0, 9)], [(0, 9), (0, 0)]];
        check(&square, &[(&[(0, 0), (0, 9), (9, 9), (9, 0)], true)]);
    }

    #[test]
    fn a_curve_of_short_pieces_stays_one() {
        let at = |i: i32| (100 * i, i * i);
        let pieces: Vec<_> = (0..20).map(|i| [at(i), at(i + 1)]).collect();
        let points: Vec<_> = (0..=20).map(at).collect();
        check(&pieces, &[(&points, false)]);
    }

    #[test]
    fn a_long_straight_line_takes_no_longer_than_a_bent_one() {
        let pieces = (0..200_000).map(|i| [At { x: i, y: 0 }, At { x: i + 1, y: 0 }]).collect();
        let paths = chain(pieces);
        assert_eq!((paths.len(), paths[0].points.len()), (1, 200_000 / MOST_IN_A_ROW + 2));
    }

    #[test]
    fn what_is_nothing_or_twice_there_is_left_out() {
        check(&[[(0, 0), (0, 0)], [(5, 0), (1, 1)], [(1, 1), (5, 0)]], &[(&[(1, 1), (5, 0)], false)]);
    }
}
