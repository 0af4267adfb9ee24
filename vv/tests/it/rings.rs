//! Edits of rings and sets, against naive models.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;
use proptest::prelude::*;
use vv::mesh::validate::{Finding, validate};
use vv::mesh::{Mesh, Value, Vertex, VertexSet};
use vv::stop::Stop;

use crate::mesh::vertex;

#[test]
fn make_keeps_the_edge_values_of_neighbours_that_stay() {
    for n in [3, 100] {
        let mut mesh = Mesh::new();
        let all: Vec<_> = (0..=n).map(|_| mesh.create().unwrap()).collect();
        let (hub, rim) = (all[0], &all[1..]);
        let weight = mesh.declare_edge_property("weight", Value::Int(7));
        mesh.make(hub, &rim.iter().copied().map(Some).collect::<Vec<_>>()).unwrap();
        for (i, &x) in rim.iter().enumerate() {
            assert!(mesh.set_edge_value(weight, hub, x, Value::Int(i as i64)));
        }
        let reversed: Vec<_> = rim[1..].iter().rev().copied().map(Some).collect();
        mesh.make(hub, &reversed).unwrap();
        for (i, &x) in rim.iter().enumerate().skip(1) {
            assert_eq!(mesh.edge_value(weight, hub, x), Some(Value::Int(i as i64)));
        }
        mesh.splice_after(Some(rim[0]), Some(rim[1]), hub).unwrap();
        assert_eq!(mesh.edge_value(weight, hub, rim[0]), Some(Value::Int(7))); // it went and came back
    }
}

/// An entry with its value of an edge property.
type Slot = (Option<Vertex>, i64);

#[derive(Debug, Clone)]
enum Edit {
    Make(Vec<Option<Vertex>>),
    Erase(Option<Vertex>),
    Replace(Option<Vertex>, Option<Vertex>),
    After(Option<Vertex>, Option<Vertex>),
    Before(Option<Vertex>, Option<Vertex>),
    Value(Vertex, i64),
    Snapshot,
    CopyBack,
}

fn edit(n: usize) -> impl Strategy<Value = (Vertex, Edit)> {
    let item = move || prop_oneof![1 => Just(None), 4 => (1..=n).prop_map(|i| Some(vertex(i)))];
    let edit = prop_oneof![
        1 => prop::collection::vec(item(), 0..9).prop_map(Edit::Make),
        1 => Just((1..=n).map(vertex).map(Some).chain([None, None]).collect::<Vec<_>>())
            .prop_shuffle()
            .prop_flat_map(|all| (0..all.len()).prop_map(move |k| all[..k].to_vec()))
            .prop_map(Edit::Make),
        2 => item().prop_map(Edit::Erase),
        3 => (item(), item()).prop_map(|(a, x)| Edit::Replace(a, x)),
        4 => (item(), item()).prop_map(|(x, a)| Edit::After(x, a)),
        4 => (item(), item()).prop_map(|(x, a)| Edit::Before(x, a)),
        2 => ((1..=n).prop_map(vertex), any::<i64>()).prop_map(|(x, value)| Edit::Value(x, value)),
        1 => Just(Edit::Snapshot),
        1 => Just(Edit::CopyBack),
    ];
    ((1..=n).prop_map(vertex), edit)
}

/// Table 2 on a list, word for word; `None` if it is an error.
fn model(ring: &[Slot], v: Vertex, edit: &Edit) -> Option<Vec<Slot>> {
    let mut ring = ring.to_vec();
    let first_gap = |ring: &[Slot]| ring.iter().rposition(|s| s.0.is_none()); // the ring begins behind it
    let find = |ring: &[Slot], x: Option<Vertex>| match x {
        None => first_gap(ring),
        Some(_) => ring.iter().position(|s| s.0 == x),
    };
    let may_enter = |ring: &[Slot], x: Option<Vertex>| x.is_none() || x != Some(v) && find(ring, x).is_none();
    match edit {
        Edit::Make(items) => {
            let names: BTreeSet<_> = items.iter().flatten().collect();
            if names.len() < items.iter().flatten().count() || names.contains(&v) {
                return None;
            }
            let old = ring;
            let value = |x: Option<Vertex>| old.iter().find(|s| x.is_some() && s.0 == x).map_or(7, |s| s.1);
            ring = items.iter().map(|&x| (x, value(x))).collect();
        }
        Edit::Erase(x) => {
            if let Some(i) = find(&ring, *x) {
                ring.remove(i);
            }
        }
        Edit::Replace(a, x) => {
            if let Some(i) = find(&ring, *a).filter(|_| a != x) {
                may_enter(&ring, *x).then_some(())?;
                ring[i] = (*x, if a.is_some() { ring[i].1 } else { 7 });
            }
        }
        Edit::After(x, a) | Edit::Before(x, a) => {
            if let Some(i) = find(&ring, *a) {
                may_enter(&ring, *x).then_some(())?;
                let i = match edit {
                    Edit::After(..) => i + 1,
                    _ if i == 0 => ring.len(),
                    _ => i,
                };
                ring.insert(i, (*x, 7));
            }
        }
        Edit::Value(..) | Edit::Snapshot | Edit::CopyBack => {}
    }
    // Gaps side by side merge, one alone is none, and the ring begins behind one.
    while let Some(i) = (0..ring.len()).find(|&i| ring[i].0.is_none() && ring[(i + 1) % ring.len()].0.is_none()) {
        ring.remove(i);
    }
    if let Some(i) = ring.iter().position(|s| s.0.is_none())
        && ring[ring.len() - 1].0.is_some()
    {
        ring.rotate_left(i + 1);
    }
    Some(ring)
}

/// The rings with the values of the edge property, read at either end.
fn slots(mesh: &Mesh, v: Vertex) -> Vec<Option<Vertex>> {
    mesh.ring(v).slots().to_vec()
}

proptest! {
    #[test]
    fn edits_do_what_table_2_says(edits in prop::collection::vec(edit(9), 1..60)) {
        let mut mesh = Mesh::new();
        for _ in 0..9 {
            mesh.create().unwrap();
        }
        let property = mesh.declare_edge_property("weight", Value::Int(7));
        let mut rings: BTreeMap<Vertex, Vec<Slot>> = mesh.vertices().map(|v| (v, Vec::new())).collect();
        let mut snapshot = (mesh.clone(), rings.clone());
        for (v, edit) in edits {
            let result = match &edit {
                Edit::Make(items) => mesh.make(v, items),
                Edit::Erase(x) => {
                    mesh.erase(*x, v);
                    Ok(())
                }
                Edit::Replace(a, x) => mesh.replace(*a, *x, v),
                Edit::After(x, a) => mesh.splice_after(*x, *a, v),
                Edit::Before(x, a) => mesh.splice_before(*x, *a, v),
                Edit::Value(x, value) => {
                    let there = mesh.set_edge_value(property, v, *x, Value::Int(*value));
                    let mut ends = 0;
                    for (p, q) in [(v, *x), (*x, v)] {
                        for slot in rings.get_mut(&p).unwrap().iter_mut().filter(|s| s.0 == Some(q)) {
                            slot.1 = *value;
                            ends += 1;
                        }
                    }
                    prop_assert_eq!(there, ends > 0);
                    Ok(())
                }
                Edit::Snapshot => {
                    snapshot = (mesh.clone(), rings.clone());
                    Ok(())
                }
                Edit::CopyBack => {
                    snapshot.0.copy_vertex_into(v, &mut mesh).unwrap();
                    rings.insert(v, snapshot.1[&v].clone());
                    Ok(())
                }
            };
            match model(&rings[&v], v, &edit) {
                Some(ring) => {
                    prop_assert_eq!(result, Ok(()));
                    rings.insert(v, ring);
                }
                None => prop_assert!(result.is_err()),
            }
            for (mesh, rings) in [(&mesh, &rings), (&snapshot.0, &snapshot.1)] {
                for (&v, ring) in rings {
                    prop_assert_eq!(slots(mesh, v), ring.iter().map(|s| s.0).collect::<Vec<_>>());
                    let at = |p: Vertex, q| rings[&p].iter().find(|s| s.0 == Some(q)).map(|s| Value::Int(s.1));
                    for x in mesh.ring(v).vertices() {
                        let value = at(v.min(x), v.max(x)).or(at(v.max(x), v.min(x)));
                        prop_assert_eq!(mesh.edge_value(property, v, x), value);
                    }
                }
            }
            let damaged = |f: &Finding| matches!(f, Finding::Ring { .. });
            prop_assert!(!validate(&mesh, &Stop::new()).unwrap().iter().any(damaged));
        }
        // Those that stay keep what they have, whoever is forgotten.
        let oldest = mesh.declare_vertex_property("oldest", Value::Vertex(Some(vertex(1))));
        for v in mesh.vertices() {
            mesh.set_position(v, DVec3::splat(v.index() as f64));
            mesh.set_vertex_value(oldest, v, Value::Vertex(Some(vertex(3).min(v))));
        }
        for forgotten in [9..=9, 1..=2, 4..=4, 1..=9] {
            let mut mesh = mesh.clone();
            let kept: Vec<Vertex> = mesh.vertices().filter(|v| !forgotten.contains(&(v.index() + 1))).collect();
            let new = |v: Vertex| kept.binary_search(&v).ok().and_then(Vertex::from_index);
            mesh.set = kept.iter().copied().collect();
            prop_assert_eq!(mesh.keep_only_set(), 9 - kept.len());
            prop_assert_eq!((mesh.vertex_count(), mesh.set.len()), (kept.len(), kept.len()));
            for &old in &kept {
                let (v, ring) = (new(old).unwrap(), &rings[&old]);
                let named = |x: Option<Vertex>| x.and_then(new);
                let expected = model(&[], v, &Edit::Make(ring.iter().map(|s| named(s.0)).collect())).unwrap();
                prop_assert_eq!(slots(&mesh, v), expected.iter().map(|s| s.0).collect::<Vec<_>>());
                for &(x, value) in ring {
                    if let Some(x) = named(x).filter(|&x| v < x) {
                        prop_assert_eq!(mesh.edge_value(property, v, x), Some(Value::Int(value)));
                    }
                }
                prop_assert_eq!(mesh.position(v), DVec3::splat(old.index() as f64));
                prop_assert_eq!(mesh.vertex_value(oldest, v), Some(Value::Vertex(new(vertex(3).min(old)))));
            }
        }
    }
}

proptest! {
    #[test]
    fn sets_iterate_in_the_order_of_addition(
        edits in prop::collection::vec((prop::bool::weighted(0.6), 1..40usize), 0..300),
        others in prop::collection::vec(1..40usize, 0..40),
    ) {
        let mut set = VertexSet::default();
        let mut list: Vec<Vertex> = Vec::new();
        for (i, (add, v)) in edits.into_iter().enumerate() {
            let v = vertex(v);
            let there = list.contains(&v);
            prop_assert_eq!(set.contains(v), there);
            // In between only removals, so that holes outnumber members.
            if add && i % 128 < 64 {
                prop_assert_eq!(set.add(v), !there);
                list.extend((!there).then_some(v));
            } else {
                prop_assert_eq!(set.remove(v), there);
                list.retain(|&x| x != v);
            }
            prop_assert_eq!(set.iter().collect::<Vec<_>>(), list.clone());
            prop_assert_eq!(set.len(), list.len());
        }
        let before = set.clone();
        let other: VertexSet = others.iter().map(|&v| vertex(v)).collect();
        set.merge(&other);
        prop_assert!(before.iter().eq(list.iter().copied())); // a clone is not touched
        for v in others.into_iter().map(vertex) {
            if !list.contains(&v) {
                list.push(v);
            }
        }
        prop_assert_eq!(set.iter().collect::<Vec<_>>(), list);
    }
}
