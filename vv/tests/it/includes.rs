//! The files that programs include for edits, measures, building and handing values on, against closed forms.
//!
//! Each text runs on both engines, which must print the same; what it prints is compared with what should stand there.

use std::path::{Path, PathBuf};

use vv::engine::{Engine, Machine, Settings, run};
use vv::io::{Format, ReadOptions, read};
use vv::mesh::close::close;
use vv::mesh::faces::faces;
use vv::mesh::{Mesh, Vertex};
use vv::stop::Stop;

fn assets(folder: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets").join(folder)
}

fn shipped(name: &str) -> Mesh {
    read(&std::fs::read(assets("meshes").join(name)).unwrap(), Format::Obj, &ReadOptions::default()).unwrap().0
}

/// Runs a program that includes the files that are named, by its default rule, on a mesh.
#[track_caller]
fn outcome(includes: &[&str], text: &str, mesh: &Mesh) -> (Mesh, Vec<String>) {
    let text = includes.iter().fold(text.to_owned(), |text, file| format!("#include \"{file}.vv\"\n{text}"));
    let mut include = |_: &str, name: &str| {
        let text = std::fs::read_to_string(assets("programs").join(name)).map_err(|e| e.to_string())?;
        Ok(vv::Included { name: name.to_owned(), text })
    };
    let compiled = vv::compile("test.vv", &text, &mut include);
    assert!(compiled.diagnostics.is_empty(), "{:#?}", compiled.diagnostics);
    let machine = Machine::new(compiled.program.unwrap(), Engine::Native);
    assert_eq!(machine.refusal(), None);
    let rule = machine.program().default_rule().unwrap();
    let (mut first, mut second) = (Vec::new(), Vec::new());
    let interpreted = run(machine.program(), rule, mesh, 1, &Settings::default(), &mut first).unwrap();
    let mut made = machine.run(rule, mesh, 1, &Settings::default(), &mut second).unwrap();
    assert_eq!(first, second);
    assert_eq!(interpreted.positions(), made.positions());
    assert_eq!(close(&mut made, &Stop::new()).unwrap(), []);
    (made, first)
}

/// What statements print, each a number, on a mesh; `expected` within 1e-12.
#[track_caller]
fn measured(mesh: &str, statements: &str, expected: &[f64]) {
    let text = format!("step {{ {statements} }}");
    let (_, printed) = outcome(&["geometry"], &text, &shipped(mesh));
    assert_eq!(printed.len(), expected.len(), "{printed:?}");
    for (got, expected) in printed.iter().zip(expected) {
        let got: f64 = got.parse().unwrap();
        assert!((got - expected).abs() < 1e-12, "{got}, expected {expected}: {statements}");
    }
}

/// The corners of faces, each from its oldest, and which vertices lie on a boundary.
fn surface(mesh: &Mesh) -> (Vec<Vec<Vertex>>, Vec<usize>) {
    let mut all: Vec<Vec<Vertex>> = faces(mesh, &Stop::new()).unwrap().iter().map(<[_]>::to_vec).collect();
    all.sort();
    (all, mesh.set.iter().map(|v| mesh.ring(v).gaps()).collect())
}

#[test]
fn edges_are_halved_contracted_and_flipped_back() {
    let undone = [
        "forall p in S forall q in p if (p > q) { vertex x = halve(p, q); contract(x, p); }",
        "forall p in S forall q in p { \
           if (p < q || !is q in p || !can_flip(p, q)) continue; \
           vertex a = nextto q in p, b = prevto q in p; flip(p, q); flip(a, b); }",
    ];
    for mesh in ["icosahedron.obj", "torus.obj", "grid-open.obj", "cube-open.obj"] {
        let before = shipped(mesh);
        for text in undone {
            let (after, _) = outcome(&["edits"], &format!("step {{ {text} }}"), &before);
            assert_eq!(surface(&before), surface(&after), "{mesh}: {text}");
        }
    }
}

#[test]
fn a_flip_or_a_contraction_that_would_join_neighbours_is_not_offered() {
    let count = "step { int flips = 0, ways = 0; \
        forall p in S forall q in p { flips += can_flip(p, q) ? 1 : 0; ways += can_contract(p, q) ? 1 : 0; } \
        print flips, \" \", ways; }";
    // Of a tetrahedron all corners are neighbours. Of a sheet of eight triangles the eight inner edges can be flipped, and
    // the one vertex within can go into any of its six neighbours.
    for (mesh, expected) in [("tetrahedron.obj", "0 0"), ("octahedron.obj", "24 24"), ("square-open.obj", "16 6")] {
        assert_eq!(outcome(&["edits"], count, &shipped(mesh)).1, [expected], "{mesh}");
    }
    // Neither can be what is no edge, nor what lies along a hole, from whichever end.
    let others = "step { int flips = 0; forall p in S forall q in S \
        if (p != q && (nextto q in p == null || prevto q in p == null)) flips += can_flip(p, q) ? 1 : 0; print flips; }";
    assert_eq!(outcome(&["edits"], others, &shipped("square-open.obj")).1, ["0"]);
}

#[test]
fn a_vertex_is_split_and_contracted_back() {
    // Each vertex inside, at each neighbour, so many neighbours further.
    for (mesh, further) in [("octahedron.obj", 1), ("icosahedron.obj", 2), ("grid-open.obj", 3), ("cube.obj", 1)] {
        let split = format!(
            "mesh old = S; forall p in old {{ if (gaps p > 0) continue; forall a in p {{ \
             vertex b = a; for (int i = 0; i < {further}; ++i) b = nextto b in p; \
             int n = valence p, of_a = valence a; vertex x = split_vertex(p, a, b); \
             if (valence x != {further} + 2 || valence p != n - {further} + 2 || valence a != of_a + 1) print p; \
             if (nextto p in x != a || prevto p in x != b || nextto x in p != b || prevto x in p != a) print p; \
             if (x$pos != p$pos) print p;"
        );
        let before = shipped(mesh);
        let (after, printed) = outcome(&["edits"], &format!("step {{ {split} contract(x, p); }} }} }}"), &before);
        assert_eq!((surface(&after), printed), (surface(&before), vec![]), "{mesh}");
        // A triangle on either side of x–p, and else the faces that there were.
        let (after, _) = outcome(&["edits"], &format!("step {{ {split} add x to S; return; }} }} }}"), &before);
        let [new, old] = [&after, &before].map(|mesh| surface(mesh).0);
        assert_eq!((new.len(), after.set.len()), (old.len() + 2, before.set.len() + 1), "{mesh}");
        assert_eq!(new.iter().filter(|f| f.len() == 3).count(), old.iter().filter(|f| f.len() == 3).count() + 2);
    }
}

#[test]
fn a_pyramid_makes_a_triangle_of_each_side() {
    let text = "step { mesh N; forall f in faces S add pyramid(f) to N; merge S with N; \
                forall c in N print valence c, \" \", length(c$pos); }";
    let (after, printed) = outcome(&["edits"], text, &shipped("cube.obj"));
    assert_eq!(printed, ["4 1"; 6]);
    let (faces, _) = surface(&after);
    assert_eq!((faces.len(), faces.iter().all(|f| f.len() == 3)), (24, true));
}

#[test]
fn areas_middles_and_normals_of_solids() {
    // Corners of the cube at ±1, of the icosahedron at (0, ±1, ±φ): edges are 2 long.
    measured("cube.obj", "double a; forall f in faces S a += length(area(f)); print a;", &[24.0]);
    measured("icosahedron.obj", "double a; forall f in faces S a += length(area(f)); print a;", &[20.0 * 3f64.sqrt()]);
    let off = "double off; forall p in S off = max(off, distance(normal(p), normalize(p$pos))); print off;";
    measured("icosahedron.obj", off, &[0.0]);
    measured("cube.obj", off, &[0.0]);
    let middle = "double off, out; forall f in faces S { \
                  off = max(off, distance(normalize(middle(f)), normalize(area(f)))); \
                  out = max(out, abs(dot(middle(f) - (any in f)$pos, area(f)))); } print off; print out;";
    measured("dodecahedron.obj", middle, &[0.0, 0.0]);
}

/// A closed surface faces all sides alike; five triangles at a corner of the icosahedron face along it.
#[test]
fn areas_as_vectors_sum_to_nothing() {
    for mesh in ["elephant.obj", "genus-2.obj", "pawn.obj"] {
        measured(mesh, "vec a; forall f in faces S a += area(f); print length(a);", &[0.0]);
    }
    let phi = (1.0 + 5f64.sqrt()) / 2.0;
    // Each triangle is √3, at the dihedral's inner radius φ²/√3 from the centre; the corner at √(1 + φ²).
    let cosine = phi * phi / 3f64.sqrt() / (1.0 + phi * phi).sqrt();
    let inclined = (3f64.sqrt() * 5.0) * cosine;
    measured("icosahedron.obj", "forall p in S { print length(area_round(p)); break; }", &[inclined]);
}

#[test]
fn angles_and_what_follows_from_them() {
    let of_first = |what: &str| format!("forall p in S {{ forall q, r in p {{ print {what}; break; }} break; }}");
    measured("icosahedron.obj", &of_first("angle(q, p, r)"), &[std::f64::consts::FRAC_PI_3]);
    measured("cube.obj", &of_first("angle(q, p, r)"), &[std::f64::consts::FRAC_PI_2]);
    measured("icosahedron.obj", &of_first("cotangent(q, p, r)"), &[1.0 / 3f64.sqrt()]);
    measured("icosahedron.obj", &of_first("edge_weight(p, q)"), &[1.0 / 3f64.sqrt()]);
    measured("icosahedron.obj", &of_first("bend(p, q)"), &[(5f64.sqrt() / 3.0).acos()]);
    measured("octahedron.obj", &of_first("bend(p, q)"), &[(1f64 / 3.0).acos()]);
    let rim =
        "double sum; forall p in S forall q in p if (nextto q in p == null) sum += bend(p, q) + bend(q, p); print sum;";
    measured("cube-open.obj", rim, &[0.0]);
    // The angles of a triangle are half a turn.
    let sum = "double off; forall f in faces S { double a; forall q, r in f a += angle(q, r, nextto r in f); \
               off = max(off, abs(a - pi)); } print off;";
    measured("tetrapod.obj", sum, &[0.0]);
}

/// Cotangents weigh so that a flat sheet is in balance, however it is cut into triangles; a hole counts nothing.
#[test]
fn edge_weights_are_in_balance_on_a_flat_sheet() {
    let bent = "forall p in S p$pos += vec(0.3 * sin(5.0 * p$pos.z), 0, 0.2 * cos(3.0 * p$pos.x));";
    let flat = "double off; forall p in S { vec sum; forall q in p sum += edge_weight(p, q) * (q$pos - p$pos); \
                if (gaps p == 0) off = max(off, length(sum)); } print off;";
    measured("grid-open.obj", &format!("{bent} {flat}"), &[0.0]);
    let half = "forall p in S forall q in p if (p > q && nextto q in p == null) \
                { vertex b = prevto q in p; print edge_weight(p, q) - cotangent(q, b, p) / 2.0; break; }";
    let (_, printed) = outcome(&["geometry"], &format!("step {{ {half} }}"), &shipped("cube-open.obj"));
    assert!(!printed.is_empty() && printed.iter().all(|x| x == "0"), "{printed:?}");
}

/// Faces come in an order in which a vertex has several fans on the way.
#[test]
fn a_mesh_is_built_again_from_its_faces_in_any_order() {
    let text = "vertex { vertex twin; };
        step {
          mesh T;
          forall v in S { vertex t; t$pos = v$pos; v$twin = t; add t to T; }
          for (int k = 0; k < 7; ++k) {
            int i = 0;
            forall f in faces S {
              i += 1;
              if (i % 7 != k) continue;
              ring g;
              forall p in f add p$twin to g;
              polygon(g);
            }
          }
          S = T;
        }";
    for path in std::fs::read_dir(assets("meshes")).unwrap().map(|e| e.unwrap().path()).filter(|p| p.is_file()) {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let before = shipped(&name);
        let (after, _) = outcome(&["build"], text, &before);
        let first = before.vertex_count();
        let (mut made, gaps) = surface(&after);
        let old = |v: &mut Vertex| *v = Vertex::from_index(v.index() - first).unwrap();
        if after.set.iter().all(|v| v.index() >= first) {
            made.iter_mut().flatten().for_each(old);
        }
        if surface(&before).0.is_empty() {
            continue; // a wire has no faces
        }
        assert_eq!((made, gaps), surface(&before), "{name}");
    }
}

#[test]
fn a_face_for_which_there_is_no_place_is_left_out_and_said() {
    let text = "step { vertex a, b, c, d, e; triangle(a, b, c); triangle(a, b, d); triangle(b, a, d); \
                quad(e, b, a, c); add a to S; add b to S; add c to S; add d to S; print a; }";
    let (mesh, printed) = outcome(&["build"], text, &Mesh::new());
    let said = |face: &str, at: &str| format!("{face} is left out: an edge at {at} has a face on this side already");
    assert_eq!(printed, [said("{v1, v2, v4}", "v2"), said("{v5, v2, v1, v3}", "v2"), "v1".to_owned()]);
    let (faces, gaps) = surface(&mesh);
    assert_eq!((faces.len(), gaps), (2, vec![1, 1, 1, 1]));
}

#[test]
fn a_grid_has_the_squares_that_it_is_asked_for() {
    for (m, n) in [(1, 1), (3, 2), (1, 5), (6, 4)] {
        let text = format!(
            "step {{ S = grid({m}, {n}); vec a; forall f in faces S a += area(f); \
             int inner = 0; forall p in S inner += gaps p == 0 ? 1 : 0; print a, \" \", inner; }}"
        );
        let (mesh, printed) = outcome(&["build", "geometry"], &text, &Mesh::new());
        assert_eq!(printed, [format!("(0, 0, {}) {}", m * n, (m - 1) * (n - 1))]);
        let (faces, _) = surface(&mesh);
        assert_eq!((mesh.set.len(), faces.len()), ((m + 1) * (n + 1), m * n));
        assert!(faces.iter().all(|f| f.len() == 4));
    }
}

#[test]
fn a_grid_of_no_squares_is_nothing() {
    for (m, n) in [(0, 0), (0, 3), (3, 0), (-1, 2), (2, -1), (-3, -3)] {
        let text = format!("step {{ S = grid({m}, {n}); }}");
        assert_eq!(outcome(&["build"], &text, &shipped("cube.obj")).0.set.len(), 0, "{m} {n}");
    }
}

/// With linear rules positions are what they would inherit; so a colour that begins as the position stays it.
#[test]
fn values_are_inherited_as_positions_are_refined_linearly() {
    let mixed = "vertex { vec color = vec(7, 7, 7); };
        void mix(vertex x, vertex q, double t) { x$color += t * (q$color - x$color); }
        void step(mesh& S) {
          forall p in S p$color = p$pos;
          mesh old = S;
          REFINED;
          inherit(S, old);
          double off = 0;
          forall p in S off = max(off, distance(p$color, p$pos));
          print off < 1e-12;
        }";
    let ptq = "vec vertex_point(vertex p) { return `p$pos; }
        vec edge_point(vertex p, vertex q) { return (`p$pos + `q$pos) / 2; }";
    let pqq = "vec vertex_point(vertex p) { return p$pos; }
        vec edge_point(vertex p, vertex q, vertex l, vertex r) { return (p$pos + q$pos) / 2; }";
    let kis = "static void refined(mesh& S) { mesh N; forall f in faces S add pyramid(f) to N; merge S with N; }";
    for (file, rule, call, mesh) in [
        ("ptq", ptq, "ptq(S)", "tetrapod.obj"),
        ("ptq", ptq, "ptq(S)", "grid-open.obj"),
        ("pqq", pqq, "pqq(S)", "dodecahedron.obj"),
        ("pqq", pqq, "pqq(S)", "cube-open-quads.obj"),
        ("split", "", "mesh E = split(S); merge S with E", "pawn.obj"),
        ("edits", kis, "refined(S)", "elephant.obj"),
    ] {
        let text = format!("{rule}\n{}", mixed.replace("REFINED", call));
        assert_eq!(outcome(&[file, "inherit"], &text, &shipped(mesh)).1, ["true"], "{file} on {mesh}");
    }
}

/// Of a cube coloured by its corners at ±1 these keep theirs, edges have the mean of two, faces that of four.
#[test]
fn colors_are_refined_with_the_mesh() {
    let text = "step {
          forall p in S p$color = p$pos;
          colors(S);
          forall p in S print round(1e9 * dot(p$color, p$color)) / 1e9;
        }";
    let (_, mut printed) = outcome(&["colors"], text, &shipped("cube.obj"));
    printed.sort();
    assert_eq!(printed, [vec!["1"; 6], vec!["2"; 12], vec!["3"; 8]].concat());
}

#[test]
fn polygons_become_fine_triangles() {
    for (mesh, points) in [("pawn.obj", 500), ("grid-open-quads.obj", 300), ("octahedron.obj", 6)] {
        let text = format!(
            "step {{ make_fine(S, {points}); int others = 0; \
             forall f in faces S others += valence f == 3 ? 0 : 1; print count(S) >= {points}, \" \", others; }}"
        );
        assert_eq!(outcome(&["fine"], &text, &shipped(mesh)).1, ["true 0"], "{mesh}");
    }
    assert_eq!(outcome(&["fine"], "step { make_fine(S, 12); print count(S); }", &Mesh::new()).1, ["12"]);
}

/// Two components, of which one has nothing to inherit.
#[test]
fn what_has_no_known_neighbour_keeps_what_it_has() {
    let text = "vertex { double heat = 5; };
        void mix(vertex x, vertex q, double t) { x$heat += t * (q$heat - x$heat); }
        void step(mesh& S) {
          mesh known;
          vertex a, b, c, d;
          make {b, null} nb_of a; make {a, null, c, null} nb_of b; make {b, null} nb_of c;
          add a to S; add b to S; add c to S; add d to S; add a to known;
          a$heat = 1;
          inherit(S, known);
          print a$heat, b$heat, c$heat, d$heat;
        }";
    assert_eq!(outcome(&["inherit"], text, &Mesh::new()).1, ["1115"]);
}

/// Old values outlive the refinement: a colour that begins as the position and is refined by the same masks stays it.
#[test]
fn colours_can_be_refined_by_the_masks_of_the_scheme() {
    let text = "vertex { vec color; };
        static vec vertex_color(vertex p) {
          double n = valence `p;
          double w = (5.0/8.0 - pow(3.0/8.0 + cos(tau/n)/4.0, 2.0)) / n;
          vec sum = (1.0 - n * w) * `p$color;
          forall q in `p sum += w * `q$color;
          return sum;
        }
        static vec edge_color(vertex p, vertex q) {
          return 3.0/8.0 * (`p$color + `q$color) + 1.0/8.0 * (`(nextto q in `p)$color + `(prevto q in `p)$color);
        }
        void step(mesh& S) {
          forall p in S p$color = p$pos;
          mesh old = S;
          loop(S);
          double off = 0;
          forall x in S {
            ring ends;
            forall q in x if (is q in old) add q to ends;
            x$color = is x in old ? vertex_color(x) : edge_color(any in ends, nextto any in ends in ends);
            off = max(off, distance(x$color, x$pos));
          }
          print off < 1e-12;
        }";
    assert_eq!(outcome(&["loop"], text, &shipped("tetrapod.obj")).1, ["true"]);
}

/// After a dual refinement the old vertices, in no set any more, still have their corners as rings.
#[test]
fn corners_are_found_from_the_old_vertices_of_a_dual_refinement() {
    let text = "vertex { int from = -1; };
        void step(mesh& S) {
          int n = 0, none = 0;
          forall p in S { p$from = n; n += 1; }
          mesh old = S;
          doo_sabin(S);
          forall p in old forall c in p c$from = p$from;
          forall c in S none += c$from < 0 ? 1 : 0;
          print n, \" \", none;
        }";
    assert_eq!(outcome(&["doo-sabin"], text, &shipped("dodecahedron.obj")).1, ["20 0"]);
    assert_eq!(outcome(&["doo-sabin"], text, &shipped("grid-open-quads.obj")).1, ["49 0"]);
}

#[test]
fn sharpness_fades_by_one_in_a_step_and_ten_is_for_ever() {
    for (before, after) in [("10", "10 10"), ("2.5", "1.5 1.5"), ("0.5", "0 0")] {
        let text = format!(
            "step {{ mesh old = S;
               forall p in S {{ p$sharpness = {before}; forall q in p (p|q)$sharpness = {before}; }}
               catmull_clark_creases(S);
               forall p in old {{ print p$sharpness, \" \", (p|any in p)$sharpness; break; }} }}"
        );
        assert_eq!(outcome(&["catmull-clark-creases"], &text, &shipped("cube.obj")).1, [after]);
    }
}
