//! Steps that do nothing.

use vv::mesh::{Mesh, Property};

use crate::trace;

/// Whether a step that made `after` of `before` has changed nothing: vertices, rings and values are the same; properties
/// that it has declared have the values that they begin with. Cost: linear if it has not, else about as much as both have
/// in common.
pub(super) fn is_idle(before: &Mesh, after: &Mesh) -> bool {
    let _span = trace::span("looking for changes");
    let vertices = || before.vertices();
    let properties =
        |a: &[Property], b: &[Property], same: &dyn Fn(usize, usize) -> bool, fresh: &dyn Fn(usize) -> bool| {
            let kept = |(j, property): (usize, &Property)| match a.iter().position(|p| p.name == property.name) {
                Some(i) => same(i, j),
                None => fresh(j),
            };
            a.iter().all(|p| b.iter().any(|q| q.name == p.name)) && b.iter().enumerate().all(kept)
        };
    let at_vertices = after.vertex_properties();
    let at_edges = after.edge_properties();
    before.vertex_count() == after.vertex_count()
        && before.set.len() == after.set.len()
        && before.positions() == after.positions()
        && before.mesh_properties() == after.mesh_properties()
        && vertices().all(|v| before.ring(v) == after.ring(v))
        && before.set == after.set
        && properties(
            before.vertex_properties(),
            at_vertices,
            &|i, j| vertices().all(|v| before.vertex_value(i, v) == after.vertex_value(j, v)),
            &|j| vertices().all(|v| after.vertex_value(j, v) == Some(at_vertices[j].default)),
        )
        && properties(
            before.edge_properties(),
            at_edges,
            &|i, j| vertices().all(|v| before.edge_values(i, v).eq(after.edge_values(j, v))),
            &|j| vertices().all(|v| after.edge_values(j, v).all(|(_, value)| value == at_edges[j].default)),
        )
}

#[cfg(test)]
mod tests {
    use vv::engine::{Machine, Settings};

    use super::*;
    use crate::evaluation::advance;

    /// Whether what `rule` does to a tetrahedron is nothing.
    #[track_caller]
    fn check_idle(rule: &str, expected: bool) {
        let text = format!("vertex {{ int n = 3; }};\nedge {{ double w = 1; }};\nvoid f(mesh& S) {{ {rule} }}\n");
        let program = vv::compile("f.vv", &text, &mut |_, _| Err(String::new())).program.unwrap();
        let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
        let (before, _) = vv::io::read(obj.as_bytes(), vv::io::Format::Obj, &vv::io::ReadOptions::default()).unwrap();
        let rule = program.default_rule().unwrap();
        let machine = Machine::new(program, vv::engine::Engine::Native);
        let made = advance(&machine, rule, &before, 1, &Settings::default(), &mut Vec::new()).unwrap();
        assert_eq!(is_idle(&before, &made.mesh), expected);
    }

    #[test]
    fn a_step_is_idle_that_changes_no_vertex_ring_or_value() {
        check_idle("", true);
        check_idle("forall v in S { v$n = 3; forall q in v (v|q)$w = 1; }", true);
        check_idle("forall v in S v$pos *= 1.5;", false);
        check_idle("forall v in S v$n = 4;", false);
        check_idle("forall v in S forall q in v (v|q)$w = 2;", false);
        check_idle("vertex v; add v to S;", false);
    }
}
