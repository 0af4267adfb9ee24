//! The tissue and the textures: invariants at every step.

use std::collections::BTreeMap;

use vv::mesh::{Mesh, Value, Vertex};

use super::Show;

/// Whether the tissue is one: a sphere of cells, at least three corners to each, at least two cells at each corner, cells
/// and walls in turn around it. Gives the number of cells.
#[track_caller]
fn check_tissue(show: &Show) -> usize {
    let counts = show.statistics();
    assert!(counts.valid && counts.closed);
    assert_eq!((counts.components, counts.euler_characteristic), (1, 2));
    assert!(counts.face_degrees.iter().all(|&(n, _)| n == 3));
    let cell = |v: Vertex| show.value("cell", v) == Value::Bool(true);
    let mesh = &show.mesh;
    let mut cells = 0;
    for v in mesh.set.iter() {
        assert!(mesh.position(v).is_finite(), "{v}");
        let around: Vec<_> = mesh.ring(v).vertices().map(cell).collect();
        if cell(v) {
            cells += 1;
            assert!(around.len() >= 3 && !around.contains(&true), "{v}");
        } else {
            let next = around.iter().cycle().skip(1);
            assert!(around.len() >= 4 && around.iter().zip(next).all(|(a, b)| a != b), "{v}");
        }
    }
    assert_eq!(mesh.mesh_properties(), [("cells".to_owned(), Value::Int(cells as i64))]);
    cells
}

/// Every step is closed without a warning; looking at every cell takes longer than the steps.
#[test]
fn tissue_stays_closed_and_valid_while_it_grows_to_ten_thousand_cells() {
    let mut show = Show::new("tissue.vv", &[]);
    let mut cells = check_tissue(&show);
    assert_eq!(cells, 20);
    for n in 1..=200 {
        show.step();
        if n <= 50 || n % 25 == 0 {
            let now = check_tissue(&show);
            assert!(now >= cells);
            cells = now;
        }
    }
    assert!(cells >= 10_000, "{cells}");
}

#[test]
fn tissue_grows_from_any_closed_mesh() {
    for mesh in ["cube.obj", "dodecahedron.obj", "tetrahedron.obj"] {
        let show = Show::on_mesh(mesh, "tissue.vv", &[]).steps(20);
        assert!(check_tissue(&show) > 12, "{mesh}");
    }
}

/// The walls that divide a flat square cell the shortest way are as long as its sides.
#[test]
fn cells_divide_by_the_shortest_wall() {
    let still = [("growth", 0.12), ("tip", 30.0)].map(|(name, x)| (name, Value::Double(x)));
    let mut show = Show::on_mesh("cube.obj", "tissue.vv", &[still[0], still[1], ("rounds", Value::Int(1))]);
    while check_tissue(&show) == 6 {
        show.step();
    }
    let sides = [3, 4, 5, 6].map(|n| {
        let cells = show.mesh.set.iter().filter(|&v| show.value("cell", v) == Value::Bool(true));
        cells.filter(|&v| show.mesh.ring(v).valence() == n).count()
    });
    assert_eq!(sides[0], 0, "a square loses no corner: {sides:?}");
}

#[test]
fn the_same_seed_grows_the_same_tissue() {
    let [a, b] = [(); 2].map(|()| Show::new("tissue.vv", &[]).steps(30).mesh);
    assert_eq!(a.positions(), b.positions());
    assert!(a.vertices().all(|v| a.ring(v).slots() == b.ring(v).slots()));
}

/// How much a property differs from vertex to vertex.
fn variance(show: &Show, name: &str) -> f64 {
    let values: Vec<_> = show.mesh.set.iter().map(|v| show.double(name, v)).collect();
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / values.len() as f64
}

#[test]
fn reaction_and_diffusion_form_a_pattern_within_bounds() {
    let mut show = Show::new("reaction-diffusion.vv", &[("points", Value::Int(1000))]);
    let first = variance(&show, "v");
    for _ in 0..50 {
        show.step();
        for v in show.mesh.set.iter() {
            assert!((0.0..=1.0).contains(&show.double("u", v)), "{v}");
            assert!((0.0..=1.0).contains(&show.double("v", v)), "{v}");
        }
    }
    let last = variance(&show, "v");
    assert!(last > 1.4 * first, "{first} {last}");
}

/// Where Pearson's map has no pattern, v dies out.
#[test]
fn what_is_not_fed_dies() {
    let params = [("points", Value::Int(1000)), ("feed", Value::Double(0.01)), ("kill", Value::Double(0.07))];
    let last = variance(&Show::new("reaction-diffusion.vv", &params).steps(50), "v");
    assert!(last < 1e-9, "{last}");
}

/// Steps along edges from the nearest source, and the shortest way there, by Dijkstra's algorithm without a heap.
fn reached(mesh: &Mesh, sources: &[Vertex]) -> BTreeMap<Vertex, (u32, f64)> {
    let mut found: BTreeMap<_, _> = sources.iter().map(|&v| (v, (0, 0.0))).collect();
    loop {
        let before = found.clone();
        for p in mesh.set.iter() {
            for q in mesh.ring(p).vertices() {
                let Some(&(steps, way)) = found.get(&q) else { continue };
                let way = way + mesh.position(p).distance(mesh.position(q));
                let best = found.entry(p).or_insert((u32::MAX, f64::INFINITY));
                *best = (best.0.min(steps + 1), best.1.min(way));
            }
        }
        if found == before {
            return found;
        }
    }
}

#[test]
fn bands_are_as_far_as_the_shortest_way_along_edges() {
    let params = [("points", Value::Int(12)), ("sources", Value::Int(2))];
    let mut show = Show::on_mesh("genus-2.obj", "distance.vv", &params);
    let sources: Vec<_> = show.mesh.set.iter().filter(|&v| show.double("far", v) == 0.0).collect();
    assert_eq!(sources.len(), 2);
    let expected = reached(&show.mesh, &sources);
    for n in 1..40 {
        show.step();
        for (&v, &(steps, way)) in &expected {
            let far = show.double("far", v);
            assert_eq!(far >= 0.0, steps <= n, "{v} after {n} steps");
            assert!(far < 0.0 || far >= way - 1e-12, "{v} after {n} steps");
        }
    }
    expected.iter().for_each(|(&v, &(_, way))| assert!((show.double("far", v) - way).abs() < 1e-12, "{v}"));
}
