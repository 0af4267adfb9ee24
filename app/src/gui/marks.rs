//! What is marked over the picture: the selection and its ring, measures, the walk, what is wrong.

use eframe::egui::{Ui, vec2};
use glam::DVec3;
use vv::mesh::triangulate::{Triangulator, newell};
use vv::mesh::{Mesh, Vertex};

use super::overlay::Overlay;
use crate::inspect::findings::{Findings, Row};
use crate::inspect::measure::{angle, short};
use crate::inspect::ring::{Entry, Ring};
use crate::inspect::selection::Item;
use crate::inspect::walk::End;
use crate::preferences::Unit;
use crate::session::{Fault, Session, Walking};
use crate::worker::Frame;

/// Neighbours whose order is drawn around a vertex.
const ORDERED: usize = 48;
/// Corners of a face or a walk that are drawn.
const CORNERS: usize = 2_000;
/// Longer walks are drawn from the beginning, with a veil over all else.
const LONG: usize = 12;
/// Findings of a kind that are marked.
const MARKED: usize = 60;
/// Vertices of an error that are marked.
const NAMED: usize = 12;

/// Draws them. What is linear in the mesh was computed before; this costs what is drawn.
pub fn show(ui: &Ui, overlay: &Overlay<'_>, session: &Session, frame: &Frame) {
    let (mesh, inks) = (&frame.mesh, overlay.inks);
    let inspection = &session.inspection;
    if inspection.listing
        && let Some(findings) = frame.findings.get()
    {
        problems(overlay, mesh, findings);
    }
    if let Some(fault) = &inspection.fault {
        failed(overlay, fault);
    }
    let selected = session.selected();
    // One drawing at a vertex is enough.
    let masked = super::mask::mark(ui, overlay, session, frame);
    match (&selected[..], &inspection.walk) {
        (&[Item::Vertex(v)], None) if !masked => {
            if inspection.old_ring {
                old_ring(overlay, session, frame, v);
            }
            ring(overlay, mesh, v);
        }
        _ => measures(overlay, mesh, &selected, session.preferences.unit),
    }
    for &item in &selected {
        chosen(overlay, mesh, item);
    }
    for item in session.named() {
        for &v in item.corners(mesh).iter().take(ORDERED) {
            overlay.disc(mesh.position(v), 2.5, inks.pointed);
            overlay.label(mesh.position(v), vec2(0.0, -17.0), &v.to_string(), ui.visuals().text_color());
        }
    }
    if let (true, &[Item::Vertex(from)]) = (inspection.measuring, &selected[..]) {
        if let Some(to) = inspection.pointed.filter(|&to| to != from && mesh.set.contains(to)) {
            measures(overlay, mesh, &[Item::Vertex(from), Item::Vertex(to)], session.preferences.unit);
        }
        overlay.caption(&format!("click a vertex: its distance from {from}; Esc ends"), inks.measure);
    }
    if let Some(walking) = &inspection.walk {
        walk(overlay, mesh, walking, &selected);
    }
    if let Some(v) = inspection.pointed.filter(|&v| mesh.set.contains(v)) {
        overlay.glow(mesh.position(v), inks.pointed);
        let named = |item: &Item| match *item {
            Item::Vertex(u) => u == v || selected.len() == 1 && mesh.ring(u).contains(Some(v)),
            _ => false,
        };
        let alone = !selected.iter().any(named);
        if alone && ui.ctx().input(|i| !i.pointer.any_down()) {
            overlay.label(mesh.position(v), vec2(0.0, -22.0), &v.to_string(), ui.visuals().text_color());
        }
    }
}

fn chosen(overlay: &Overlay<'_>, mesh: &Mesh, item: Item) {
    let color = overlay.inks.selected;
    match item {
        Item::Vertex(v) => {
            overlay.disc(mesh.position(v), 5.5, color);
            overlay.label(mesh.position(v), vec2(0.0, -17.0), &v.to_string(), color);
        }
        Item::Edge([p, q]) => {
            overlay.line(mesh.position(p), mesh.position(q), 4.0, color);
            overlay.disc(mesh.position(p), 3.5, color);
            overlay.disc(mesh.position(q), 3.5, color);
        }
        Item::Face(_) => polygon(overlay, mesh, &item.corners(mesh), color),
    }
}

fn polygon(overlay: &Overlay<'_>, mesh: &Mesh, corners: &[Vertex], color: eframe::egui::Color32) {
    if corners.len() > CORNERS {
        return;
    }
    let points: Vec<DVec3> = corners.iter().map(|&v| mesh.position(v)).collect();
    let mut triangles = Vec::new();
    if points.iter().all(|p| p.is_finite()) {
        Triangulator::default().triangles(&points, newell(&points), &mut triangles);
    }
    overlay.polygon(&points, &triangles, color);
}

/// The order of a ring: an arrow from each neighbour's edge to that of the next one, and numbers.
fn ring(overlay: &Overlay<'_>, mesh: &Mesh, v: Vertex) {
    let ring = Ring::of(mesh, v);
    let (center, ink) = (mesh.position(v), overlay.inks.ring);
    if ring.len > ORDERED {
        return;
    }
    let Some(middle) = overlay.see(center) else { return };
    let arm = |u: Vertex| mesh.position(u) - center;
    let nearest = ring.vertices().map(|u| arm(u).length()).filter(|l| *l > 0.0).fold(f64::INFINITY, f64::min);
    let mut number = 0;
    for (i, entry) in ring.entries.iter().enumerate() {
        let &Entry::Vertex { vertex: q, answers, .. } = entry else { continue };
        number += 1;
        let at = mesh.position(q);
        if answers {
            overlay.line(center, at, 2.0, ink);
        } else {
            overlay.arrow(center, at, 8.0, 2.5, overlay.inks.wrong);
        }
        let next = ring.entries[(i + 1) % ring.entries.len()];
        if let Some(r) = next.vertex().filter(|_| ring.entries.len() > 1) {
            overlay.curved_arrow(&arc(center, arm(q), arm(r), 0.45 * nearest), 1.8, ink);
        }
        let Some(spot) = overlay.see(at) else { continue };
        let aside = spot.at - middle.at;
        // Where neighbours are seen too close, numbers would hide them.
        if aside.length() > 22.0 {
            let color = if answers { ink } else { overlay.inks.wrong };
            overlay.disc(at, 3.5, color);
            let (text, away) = match aside.length() {
                ..60.0 => (number.to_string(), vec2(15.0, 15.0)),
                _ => (format!("{number}  {q}"), vec2(26.0, 16.0)),
            };
            overlay.label(at, aside.normalized() * away, &text, color);
        }
    }
}

/// The ring of the generation before, thin and dashed, where its vertices were; and where the vertex went from there.
fn old_ring(overlay: &Overlay<'_>, session: &Session, frame: &Frame, v: Vertex) {
    let (Some((ring, _)), Some(old)) = (session.old_ring(v), &frame.before) else { return };
    if ring.len > ORDERED {
        return;
    }
    let (center, ink) = (old.position(ring.of), overlay.inks.old);
    let Some(middle) = overlay.see(center) else { return };
    // Where the ring of now has its names.
    let taken: Vec<_> = frame.mesh.ring(v).vertices().filter_map(|q| overlay.see(frame.mesh.position(q))).collect();
    let arm = |q: Vertex| old.position(q) - center;
    let nearest = ring.vertices().map(|q| arm(q).length()).filter(|l| *l > 0.0).fold(f64::INFINITY, f64::min);
    let mut number = 0;
    for (i, entry) in ring.entries.iter().enumerate() {
        let Some(q) = entry.vertex() else { continue };
        number += 1;
        let at = old.position(q);
        overlay.past(center, at, ink);
        let next = ring.entries[(i + 1) % ring.entries.len()];
        if let Some(r) = next.vertex().filter(|_| ring.entries.len() > 1) {
            overlay.curved_arrow(&arc(center, arm(q), arm(r), 0.7 * nearest), 1.0, ink);
        }
        let Some(spot) = overlay.see(at) else { continue };
        overlay.circle(at, 3.0, 1.3, ink);
        let aside = spot.at - middle.at;
        if aside.length() > 40.0 && !taken.iter().any(|t| t.at.distance(spot.at) < 34.0) {
            overlay.label(at, aside.normalized() * vec2(26.0, 16.0), &format!("{number}  {q}"), ink);
        }
    }
    overlay.circle(center, 4.0, 1.3, ink);
    overlay.arrow(center, frame.mesh.position(v), 6.0, 1.3, ink);
}

/// An arc around a point, in the plane of two arms, from close to one to close to the other.
fn arc(center: DVec3, a: DVec3, b: DVec3, radius: f64) -> Vec<DVec3> {
    const PIECES: usize = 8;
    let (a, b) = (a.normalize_or_zero(), b.normalize_or_zero());
    (0..=PIECES)
        .map(|i| {
            let t = 0.1 + 0.8 * i as f64 / PIECES as f64;
            a.lerp(b, t).normalize_or_zero()
        })
        .filter(|d| *d != DVec3::ZERO)
        .map(|d| center + radius * d)
        .collect()
}

/// The distance of two vertices, the angle of three.
fn measures(overlay: &Overlay<'_>, mesh: &Mesh, selected: &[Item], unit: Unit) {
    let vertices: Vec<Vertex> = selected
        .iter()
        .filter_map(|item| match item {
            Item::Vertex(v) => Some(*v),
            _ => None,
        })
        .collect();
    let ink = overlay.inks.measure;
    let at = |v: Vertex| mesh.position(v);
    match vertices[..] {
        [a, b] => {
            overlay.dashed(at(a), at(b), 2.0, ink);
            overlay.label_between(at(a), at(b), &unit.length(at(a).distance(at(b))), ink);
        }
        [a, b, c] => {
            overlay.dashed(at(a), at(b), 2.0, ink);
            overlay.dashed(at(b), at(c), 2.0, ink);
            let (u, w) = (at(a) - at(b), at(c) - at(b));
            let radius = 0.3 * u.length().min(w.length());
            overlay.curved_arrow(&arc(at(b), u, w, radius), 1.5, ink);
            if let Some(degrees) = angle(at(a), at(b), at(c)) {
                let middle = at(b) + (u.normalize_or_zero() + w.normalize_or_zero()).normalize_or_zero() * radius * 1.5;
                overlay.label_between(middle, middle, &format!("{}°", short(degrees)), ink);
            }
        }
        _ => {}
    }
}

/// The arrows of a walk so far, drawn beside the edges on the side of the face.
fn walk(overlay: &Overlay<'_>, mesh: &Mesh, walking: &Walking, selected: &[Item]) {
    let (walk, ink) = (&walking.walk, overlay.inks.walk);
    let path = &walk.path[..walk.path.len().min(CORNERS)];
    let middle = path.iter().map(|&v| mesh.position(v)).sum::<DVec3>() / path.len().max(1) as f64;
    let inside = |v: Vertex| {
        let at = mesh.position(v);
        if walk.end == End::Closed && walk.arrows() > 2 { at.lerp(middle, 0.1) } else { at }
    };
    let last = walking.at.min(path.len() - 1);
    if path.len() > LONG {
        // All of the way, and less of all else.
        overlay.veil();
        overlay.trail(path.iter().map(|&v| mesh.position(v)), 1.6, ink.gamma_multiply(0.55));
    }
    if walk.end == End::Closed && last == walk.arrows() {
        polygon(overlay, mesh, &path[..last], ink);
    }
    for i in 0..last {
        let width = if i + 1 == last { 4.0 } else { 2.2 };
        overlay.arrow(inside(path[i]), inside(path[i + 1]), 7.0, width, ink);
    }
    for &v in &path[..=last] {
        overlay.disc(mesh.position(v), 3.5, ink);
    }
    // The three vertices of the rule have their names, outside of the face; those seen close together only the newest.
    let center = overlay.see(middle).map(|spot| spot.at);
    let mut named: Vec<eframe::egui::Pos2> = Vec::new();
    for &v in path[last.saturating_sub(2)..=last].iter().rev().filter(|&&v| !selected.contains(&Item::Vertex(v))) {
        let Some(spot) = overlay.see(mesh.position(v)) else { continue };
        if named.iter().any(|at| at.distance(spot.at) < 24.0) {
            continue;
        }
        named.push(spot.at);
        let out = center.map(|center| spot.at - center);
        let out = out.filter(|out| out.length() > 1.0).map_or(vec2(0.0, -1.0), |out| out.normalized());
        overlay.label(mesh.position(v), out * vec2(20.0, 17.0), &v.to_string(), ink);
    }
    let ended = walking.at == walk.arrows();
    if ended
        && walk.is_broken()
        && let (Some(&at), End::Broken { from, .. }) = (path.last(), walk.end)
    {
        overlay.circle(mesh.position(at), 11.0, 2.5, overlay.inks.wrong);
        overlay.circle(mesh.position(from), 8.0, 1.5, overlay.inks.wrong);
    }
    let rule = format!("{}.  {}", walking.at, walk.rule(walking.at - 1));
    let color = if ended && walk.is_broken() { overlay.inks.wrong } else { ink };
    let text = if ended { format!("{rule}\n{}", walk.conclusion()) } else { rule };
    overlay.caption(&text, color);
}

/// What is wrong with the mesh.
fn problems(overlay: &Overlay<'_>, mesh: &Mesh, findings: &Findings) {
    for group in &findings.groups {
        let color = if group.kind.is_wrong() { overlay.inks.wrong } else { overlay.inks.pointed };
        for Row { item, one_way, .. } in group.rows.iter().take(MARKED) {
            match (one_way, item) {
                (&Some([from, to]), _) => {
                    overlay.arrow(mesh.position(from), mesh.position(to), 11.0, 2.5, color);
                    overlay.disc(mesh.position(from), 3.0, color);
                }
                (None, &Item::Vertex(v)) => overlay.circle(mesh.position(v), 7.0, 2.0, color),
                (None, item) => polygon(overlay, mesh, &item.corners(mesh), color),
            }
        }
    }
}

/// The vertices that a run-time error names, where they were before the step.
fn failed(overlay: &Overlay<'_>, fault: &Fault) {
    let ink = overlay.inks.wrong;
    let old = fault.vertices.iter().filter(|v| v.index() < fault.mesh.vertex_count());
    for &v in old.take(NAMED) {
        let at = fault.mesh.position(v);
        for u in fault.mesh.ring(v).vertices().take(ORDERED) {
            overlay.line(at, fault.mesh.position(u), 1.2, ink);
        }
        overlay.circle(at, 9.0, 2.5, ink);
        overlay.label(at, vec2(0.0, -20.0), &v.to_string(), ink);
    }
}
