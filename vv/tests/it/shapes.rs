//! Where the meshes under `assets/meshes` come from: each is made here, and compared with the file. `UPDATE=1` writes
//! the files anew.

use std::f64::consts::TAU;
use std::path::PathBuf;

use glam::{DVec3, dvec3};
use vv::io::{Format, SHARPNESS, write};
use vv::mesh::build::{EdgeValues, Polygons, build};
use vv::mesh::faces::{Faces, faces};
use vv::mesh::statistics::statistics;
use vv::mesh::{Mesh, Values, Vertex};
use vv::stop::Stop;

mod elephant;

/// Points and faces.
type Shape = (Vec<DVec3>, Vec<Vec<u32>>);

#[test]
fn assets_are_what_is_made_here() {
    let phi = (1.0 + 5f64.sqrt()) / 2.0;
    let icosahedron = signs(0.0, 1.0, phi, true);
    let dodecahedron = [signs(1.0, 1.0, 1.0, false), signs(0.0, 1.0 / phi, phi, true)].concat();
    let cube = signs(1.0, 1.0, 1.0, false);
    let octahedron = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
    let tetrahedron = [dvec3(1., 1., 1.), dvec3(1., -1., -1.), dvec3(-1., 1., -1.), dvec3(-1., -1., 1.)];
    check("tetrahedron", hull(&tetrahedron));
    check("cube", hull(&cube));
    check("octahedron", hull(&octahedron));
    check("icosahedron", hull(&icosahedron));
    check("dodecahedron", hull(&dodecahedron));
    check("rhombicuboctahedron", hull(&signs(1.0, 1.0, 1.0 + 2f64.sqrt(), true)));
    check("cube-open", triangulated(without_lid(hull(&cube))));
    check("cube-open-quads", without_lid(hull(&cube)));
    check("square-open", triangulated(square()));
    check("torus", triangulated(torus()));
    check("torus-quads", torus());
    check("genus-2", triangulated(two_holes()));
    check("genus-2-quads", two_holes());
    check("tetrapod", tetrapod());
    check("cube-frame", boxes([4, 4, 4], |cell| cell.iter().filter(|&&c| c == 1).count() < 2, |p| p - 1.5));
    check("elephant", elephant::elephant());
    check("star", star());
    check("grid-open-quads", grid());
    check("grid-open", triangulated(grid()));
    check_sharp("cube-creased", hull(&cube), can);
    check_sharp("pawn", pawn(), turned_edges);
    check_wire("knot", &knot());
}

/// Compares a shape with its file.
#[track_caller]
fn check(name: &str, shape: Shape) {
    check_sharp(name, shape, |_, _| 0.0);
}

/// Compares a shape with its file; `sharpness` is that of the edge between two points.
#[track_caller]
fn check_sharp(name: &str, (positions, polygons): Shape, sharpness: impl Fn(DVec3, DVec3) -> f64) {
    let mut made = Polygons::new(positions.clone());
    let sides = polygons.iter().flat_map(|face| face.iter().zip(face.iter().cycle().skip(1)));
    let edges = sides.map(|(&a, &b)| ([a, b], sharpness(positions[a as usize], positions[b as usize])));
    let (ends, values): (Vec<_>, Vec<_>) = edges.filter(|&(_, sharpness)| sharpness > 0.0).unzip();
    if !ends.is_empty() {
        made.values.edges.push(EdgeValues { name: SHARPNESS.to_owned(), ends, values: Values::Double(values.into()) });
    }
    polygons.into_iter().for_each(|face| made.push(face, None).unwrap());
    compare(name, made);
}

/// Compares a closed wire with its file.
#[track_caller]
fn check_wire(name: &str, points: &[DVec3]) {
    let mut made = Polygons::new(points.to_vec());
    let once_round: Vec<u32> = (0..points.len() as u32).chain([0]).collect();
    made.push_wire(&once_round).unwrap();
    compare(name, made);
}

#[track_caller]
fn compare(name: &str, made: Polygons) {
    let (mesh, warnings) = build(made, true, &Stop::new()).unwrap();
    assert_eq!(warnings, [], "{name}");
    let faces = faces(&mesh, &Stop::new()).unwrap();
    if statistics(&mesh, &faces, &Stop::new()).unwrap().closed {
        assert!(volume(&mesh, &faces) > 0.0, "{name} is inside out");
    }
    let text = write(&mesh, &faces, Format::Obj).unwrap().0;
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("../assets/meshes/{name}.obj"));
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(&path, &text).unwrap();
    }
    let file = std::fs::read(&path).unwrap();
    assert_eq!(String::from_utf8(file).unwrap(), String::from_utf8(text).unwrap(), "{}", path.display());
}

/// The trefoil.
fn knot() -> Vec<DVec3> {
    let points = (0..18).map(|i| TAU * f64::from(i) / 18.0);
    let at = |t: f64| dvec3(t.sin() + 2.0 * (2.0 * t).sin(), t.cos() - 2.0 * (2.0 * t).cos(), -(3.0 * t).sin());
    points.map(|t| (at(t) * 1e3).round() / 1e3 + DVec3::ZERO).collect()
}

/// Of what faces enclose: the sum of the cones from the origin.
fn volume(mesh: &Mesh, faces: &Faces) -> f64 {
    let p = |v: Vertex| mesh.position(v);
    let cones = faces.iter().flat_map(|f| (2..f.len()).map(|i| p(f[0]).dot(p(f[i - 1]).cross(p(f[i])))));
    cones.sum::<f64>() / 6.0
}

/// (±x, ±y, ±z), negative signs last, with `cyclic` also (±y, ±z, ±x) and (±z, ±x, ±y); a zero has one sign.
fn signs(x: f64, y: f64, z: f64, cyclic: bool) -> Vec<DVec3> {
    let mut points: Vec<DVec3> = Vec::new();
    for p in [dvec3(x, y, z), dvec3(y, z, x), dvec3(z, x, y)].into_iter().take(if cyclic { 3 } else { 1 }) {
        for bits in 0..8 {
            let sign = |bit: u32, x: f64| if bits >> bit & 1 == 1 && x != 0.0 { -x } else { x };
            let q = dvec3(sign(0, p.x), sign(1, p.y), sign(2, p.z));
            if !points.contains(&q) {
                points.push(q);
            }
        }
    }
    points
}

/// The faces of the convex hull: for each three points whose plane has all others behind it, all points in that plane.
fn hull(points: &[DVec3]) -> Shape {
    let mut faces: Vec<Vec<u32>> = Vec::new();
    let n = points.len();
    for (i, j, k) in (0..n).flat_map(|i| (0..n).flat_map(move |j| (0..n).map(move |k| (i, j, k)))) {
        let normal = (points[j] - points[i]).cross(points[k] - points[i]);
        let height = |p: DVec3| normal.dot(p - points[i]);
        if normal.length() < 1e-9 || points.iter().any(|&p| height(p) > 1e-9) {
            continue;
        }
        let mut face: Vec<u32> = (0..n as u32).filter(|&v| height(points[v as usize]).abs() < 1e-9).collect();
        if face[0] != i as u32 || faces.iter().any(|f| face.iter().all(|v| f.contains(v))) {
            continue;
        }
        let center = face.iter().map(|&v| points[v as usize]).sum::<DVec3>() / face.len() as f64;
        let x = points[i] - center;
        let y = normal.normalize().cross(x);
        let angle = |v: u32| {
            let p = points[v as usize] - center;
            (p.dot(y).atan2(p.dot(x)) + TAU + 1e-6) % TAU
        };
        face.sort_by(|&a, &b| angle(a).total_cmp(&angle(b)));
        faces.push(face);
    }
    (points.to_vec(), faces)
}

/// Splits quads along a diagonal from their first corner.
fn triangulated((points, faces): Shape) -> Shape {
    let fan = |face: Vec<u32>| (2..face.len()).map(move |i| vec![face[0], face[i - 1], face[i]]);
    (points, faces.into_iter().flat_map(fan).collect())
}

/// Takes out the face that lies highest.
fn without_lid((points, mut faces): Shape) -> Shape {
    let height = |face: &Vec<u32>| face.iter().map(|&v| points[v as usize].z).sum::<f64>();
    let lid = (0..faces.len()).max_by(|&a, &b| height(&faces[a]).total_cmp(&height(&faces[b]))).unwrap();
    faces.remove(lid);
    (points, faces)
}

/// Four squares around the origin.
fn square() -> Shape {
    let points = (0..9).map(|i| dvec3(f64::from(i % 3) - 1.0, f64::from(i / 3) - 1.0, 0.0)).collect();
    (points, [0, 1, 3, 4].map(|i| vec![i, i + 1, i + 4, i + 3]).to_vec())
}

/// A tube of 6 sides bent round in 12 steps.
fn torus() -> Shape {
    let (m, n) = (12, 6);
    let point = |i: u32, j: u32| {
        let (a, b) = (TAU * f64::from(i) / f64::from(m), TAU * f64::from(j) / f64::from(n));
        let r = 1.0 + 0.4 * b.cos();
        dvec3(r * a.cos(), r * a.sin(), 0.4 * b.sin())
    };
    let points = (0..m).flat_map(|i| (0..n).map(move |j| round(point(i, j)))).collect();
    let at = |i: u32, j: u32| i % m * n + j % n;
    let quad = |i, j| vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
    (points, (0..m).flat_map(|i| (0..n).map(move |j| quad(i, j))).collect())
}

/// A slab of 5 by 3 cubes without two of them.
fn two_holes() -> Shape {
    boxes([6, 4, 2], |[x, y, _]| !(y == 1 && (x == 1 || x == 3)), |p| p - dvec3(2.5, 1.5, 0.5))
}

/// The surface of those cells of a grid of `n` lines in each direction that are full; `place` says where the point of
/// the grid lies.
fn boxes(n: [i32; 3], full: impl Fn([i32; 3]) -> bool, place: impl Fn(DVec3) -> DVec3) -> Shape {
    let is_full = |cell: [i32; 3]| (0..3).all(|k| (0..n[k] - 1).contains(&cell[k])) && full(cell);
    let mut points: Vec<[i32; 3]> = Vec::new();
    let mut faces = Vec::new();
    let mut number = |p: [i32; 3]| {
        points.iter().position(|&q| q == p).unwrap_or_else(|| {
            points.push(p);
            points.len() - 1
        }) as u32
    };
    let cells = (0..n[2]).flat_map(|z| (0..n[1]).flat_map(move |y| (0..n[0]).map(move |x| [x, y, z])));
    for cell in cells.filter(|&cell| is_full(cell)) {
        // Below and above first, then around.
        for (axis, side) in [(2, 0), (2, 1), (0, 0), (0, 1), (1, 0), (1, 1)] {
            let mut beyond = cell;
            beyond[axis] += 2 * side - 1;
            if is_full(beyond) {
                continue;
            }
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let corner = |du: i32, dv: i32| {
                let mut p = cell;
                p[axis] += side;
                p[u] += du;
                p[v] += dv;
                p
            };
            let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
            let face = if side == 1 { [a, b, c, d] } else { [a, d, c, b] };
            faces.push(face.map(&mut number).to_vec());
        }
    }
    let place = |[x, y, z]: [i32; 3]| place(dvec3(f64::from(x), f64::from(y), f64::from(z)));
    (points.into_iter().map(place).collect(), faces)
}

/// One polygon with five points.
fn star() -> Shape {
    let point = |i: u32| {
        let (angle, r) = (TAU * (f64::from(i) / 10.0 + 0.25), if i.is_multiple_of(2) { 1.0 } else { 0.45 });
        round(dvec3(r * angle.cos(), r * angle.sin(), 0.0))
    };
    ((0..10).map(point).collect(), vec![(0..10).collect()])
}

/// A level field of 6 by 6 squares, seen from above.
fn grid() -> Shape {
    let n = 6;
    let points = (0..=n).flat_map(|j| (0..=n).map(move |i| dvec3(f64::from(i) - 3.0, 0.0, 3.0 - f64::from(j))));
    let at = |i: u32, j: u32| j * (n + 1) + i;
    let square = |i, j| vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
    (points.collect(), (0..n).flat_map(|j| (0..n).map(move |i| square(i, j))).collect())
}

/// Makes a cube a can: a bottom that stays sharp, a lid that is rounded off after two steps.
fn can(a: DVec3, b: DVec3) -> f64 {
    match (a.y, b.y) {
        (-1.0, -1.0) => 10.0,
        (1.0, 1.0) => 2.0,
        _ => 0.0,
    }
}

/// Radius and height of the rings of a chessman, from below, and how sharp each is.
const PROFILE: [(f64, f64, f64); 9] = [
    (1.0, 0.0, 10.0),
    (1.0, 0.3, 2.0),
    (0.7, 0.6, 0.0),
    (0.4, 1.1, 0.0),
    (0.38, 1.75, 0.0),
    (0.72, 1.85, 3.0),
    (0.72, 2.0, 3.0),
    (0.4, 2.05, 0.0),
    (0.62, 2.65, 0.0),
];

/// Turned from a profile, eight-sided; the head is closed by a small ring and a cap.
fn pawn() -> Shape {
    let sides = 8;
    let ring = |(r, y, _): (f64, f64, f64)| {
        (0..sides).map(move |i| {
            let angle = TAU * (f64::from(i) + 0.5) / f64::from(sides);
            round(dvec3(r * angle.sin(), y, r * angle.cos()))
        })
    };
    let rings = PROFILE.into_iter().chain([(0.3, 3.1, 0.0)]);
    let points: Vec<DVec3> = rings.flat_map(ring).collect();
    let count = points.len() as u32 / sides;
    let at = |ring: u32, i: u32| ring * sides + i % sides;
    let side = |ring, i| vec![at(ring, i), at(ring, i + 1), at(ring + 1, i + 1), at(ring + 1, i)];
    let mut faces = vec![(0..sides).rev().collect()];
    faces.extend((0..count - 1).flat_map(|ring| (0..sides).map(move |i| side(ring, i))));
    faces.push((0..sides).map(|i| at(count - 1, i)).collect());
    (points, faces)
}

/// The sharpness of the ring on which an edge lies.
fn turned_edges(a: DVec3, b: DVec3) -> f64 {
    let radius = |p: DVec3| p.x.hypot(p.z);
    let of = |p: DVec3| PROFILE.iter().find(|&&(r, y, _)| y == p.y && (radius(p) - r).abs() < 1e-3);
    match (of(a), of(b)) {
        (Some(&(_, y, sharpness)), Some(&(_, z, _))) if y == z => sharpness,
        _ => 0.0,
    }
}

/// A tetrahedron with an arm of two segments on each face.
fn tetrapod() -> Shape {
    let core = [
        dvec3(0., 0., 1.),
        dvec3(8f64.sqrt() / 3., 0., -1. / 3.),
        dvec3(-(2f64.sqrt()) / 3., (2f64 / 3.).sqrt(), -1. / 3.),
        dvec3(-(2f64.sqrt()) / 3., -(2f64 / 3.).sqrt(), -1. / 3.),
    ];
    let mut points: Vec<DVec3> = core.into_iter().map(|p| round(-p)).collect();
    let mut faces = Vec::new();
    for (arm, mut ring) in [[1u32, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]].into_iter().enumerate() {
        let axis = core[arm]; // the face lies opposite its vertex, and the core was turned inside out
        for (along, thick) in [(1.0, 0.5), (2.0, 0.55)] {
            let next = [0, 1, 2].map(|k| points.len() as u32 + k);
            for v in ring {
                let p = points[v as usize];
                let across = (p - axis * p.dot(axis)).normalize();
                points.push(round(axis * along + across * thick));
            }
            for k in 0..3 {
                let (a, b, c, d) = (ring[k], ring[(k + 1) % 3], next[(k + 1) % 3], next[k]);
                faces.extend([vec![a, b, c], vec![a, c, d]]);
            }
            ring = next;
        }
        faces.push(ring.to_vec());
    }
    (points, faces)
}

/// To six decimals, which reads better in a file and does not hang on the last bit of a sine.
fn round(p: DVec3) -> DVec3 {
    (p * 1e6).round() / 1e6 + DVec3::ZERO
}
