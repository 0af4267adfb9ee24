//! Fractals and the tiling: counts, lengths, areas and volumes in closed form.

use std::collections::BTreeMap;

use vv::mesh::Value;

use super::{Show, assert_near};

#[test]
fn solids_lie_on_the_unit_sphere() {
    assert_near(Show::new("sierpinski-tetrahedron.vv", &[]).volume(), 8.0 / 243f64.sqrt());
    assert_near(Show::new("sierpinski.vv", &[]).volume(), 4.0 / 3.0);
    assert_near(Show::new("koch.vv", &[]).volume(), 2.536_150_710_12);
}

#[test]
fn sierpinski_triangle_has_three_of_four_parts_and_a_hole_in_each() {
    for (n, power) in [(1, 3), (2, 9), (4, 81)] {
        let show = Show::new("sierpinski.vv", &[]).steps(n);
        let counts = show.statistics();
        assert!(counts.valid);
        assert_eq!((counts.faces, counts.boundary_loops), (8 * power, 8 * (power - 1) / 2));
        assert_eq!((counts.components, counts.genus), (1, Some(0)));
        assert_near(show.area(), 48f64.sqrt() * 0.75f64.powi(n as i32));
    }
}

#[test]
fn sierpinski_triangle_keeps_the_boundary_of_an_open_mesh() {
    let counts = Show::on_mesh("square-open.obj", "sierpinski.vv", &[]).steps(3).statistics();
    assert!(counts.valid);
    assert_eq!(counts.faces % 27, 0);
    assert_eq!(counts.components, 1);
}

#[test]
fn sierpinski_triangle_gets_round() {
    let show = Show::new("sierpinski.vv", &[("round", Value::Double(1.0))]).steps(4);
    show.mesh.set.iter().for_each(|v| assert_near(show.mesh.position(v).length(), 1.0));
}

#[test]
fn sierpinski_tetrahedron_has_four_parts_of_half_the_volume() {
    let first = Show::new("sierpinski-tetrahedron.vv", &[]).volume();
    for (n, power) in [(1, 4), (3, 64)] {
        let show = Show::new("sierpinski-tetrahedron.vv", &[]).steps(n);
        let counts = show.statistics();
        assert!(counts.valid && counts.closed);
        assert_eq!((counts.components, counts.faces, counts.genus), (power, 4 * power, Some(0)));
        assert_near(show.volume(), first * 0.5f64.powi(n as i32));
    }
}

#[test]
fn koch_surface_has_six_faces_for_one_and_half_as_much_area_more() {
    let regular = [("height", Value::Double(1.0))];
    let first = Show::new("koch.vv", &regular).area();
    for (n, power) in [(1, 6), (3, 216)] {
        let show = Show::new("koch.vv", &regular).steps(n);
        let counts = show.statistics();
        assert!(counts.valid && counts.closed);
        assert_eq!((counts.faces, counts.euler_characteristic), (20 * power, 2));
        assert_near(show.area(), first * 1.5f64.powi(n as i32));
    }
}

/// Its edges are diagonals of a cube, and that is what it fills.
#[test]
fn koch_surface_of_a_tetrahedron_fills_a_cube() {
    let mut show = Show::on_mesh("tetrahedron.obj", "koch.vv", &[("height", Value::Double(1.0))]);
    let mut missing = 8.0 - show.volume();
    assert_near(missing, 16.0 / 3.0);
    for _ in 0..4 {
        show.step();
        missing *= 0.75;
        assert_near(8.0 - show.volume(), missing);
        assert!(show.mesh.positions().iter().all(|p| p.abs().max_element() < 1.0 + 1e-9));
    }
}

/// The sides of all triangles, longest last, in units of the first two, which are alike; how many there are of each.
fn shapes(show: &Show) -> BTreeMap<String, usize> {
    let mut found = BTreeMap::new();
    for f in show.faces() {
        let mut sides = [f[0].distance(f[1]), f[1].distance(f[2]), f[2].distance(f[0])];
        sides.sort_by(f64::total_cmp);
        let [a, b, c] = sides;
        let (leg, base) = if (b - a).abs() < 1e-9 { (a, c) } else { (b, a) };
        assert!((b - leg).abs() < 1e-9);
        *found.entry(format!("{:.9}", base / leg)).or_default() += 1;
    }
    found
}

#[test]
fn penrose_tiles_come_in_fibonacci_numbers_and_two_shapes() {
    let phi = (1.0 + 5f64.sqrt()) / 2.0;
    let mut show = Show::new("penrose.vv", &[("height", Value::Double(0.0))]);
    let (mut narrow, mut wide) = (10, 0);
    for _ in 0..6 {
        show.step();
        (narrow, wide) = (narrow + wide, narrow + 2 * wide);
        let expected = [(format!("{:.9}", 1.0 / phi), narrow), (format!("{phi:.9}"), wide)];
        assert_eq!(shapes(&show), expected.into());
        let counts = show.statistics();
        assert!(counts.valid);
        assert_eq!((counts.euler_characteristic, counts.boundary_loops), (1, 1));
        assert_near(show.area(), 5.0 * (36f64.to_radians()).sin());
    }
    assert!((wide as f64 / narrow as f64 - phi).abs() < 1e-4, "{wide} : {narrow}");
}

/// The halves of one rhomb whose diagonals are in the golden ratio, cut along the one or the other.
#[test]
fn penrose_tiles_are_one_rhomb_in_the_roof() {
    let phi = (1.0 + 5f64.sqrt()) / 2.0;
    let show = Show::new("penrose.vv", &[("height", Value::Double(0.5))]).steps(5);
    let short = 2.0 / (1.0 + phi * phi).sqrt();
    let expected = [(format!("{short:.9}"), 340), (format!("{:.9}", phi * short), 550)];
    assert_eq!(shapes(&show), expected.into());
    for v in show.mesh.set.iter() {
        assert!(matches!(show.value("level", v), Value::Int(1..=4)), "{v}");
    }
}
