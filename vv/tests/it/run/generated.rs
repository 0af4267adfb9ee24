//! Programs nobody wrote: whatever they do, they end in a sound mesh or in a located error, twice the same.

use std::fmt::Write as _;

use vv::builtins::Random;
use vv::engine::{Failure, FailureKind, Limits, Settings, run};
use vv::ir::Program;
use vv::mesh::{Mesh, Vertex};

use super::{OCTAHEDRON, compile};

const PROGRAMS: u64 = 400;

#[test]
fn generated_programs_end_in_a_sound_mesh_or_a_located_error() {
    // Without and with rings.
    let (mut finished, mut failed) = ([0; 2], [0; 2]);
    for seed in 0..PROGRAMS {
        let rings = seed % 2;
        let text = Writer::new(seed, rings == 1).program();
        let program = compile(&text);
        let mut outputs = [Vec::new(), Vec::new()];
        let [first, second] = outputs.each_mut().map(|output| run_once(&program, output));
        match (&first, &second) {
            (Ok(a), Ok(b)) => {
                finished[rings as usize] += 1;
                assert_eq!(state(a), state(b), "{text}");
                check_rings(a, &text);
            }
            (Err(a), Err(b)) => {
                failed[rings as usize] += 1;
                assert_eq!((a.kind, &a.diagnostic), (b.kind, &b.diagnostic), "{text}");
                assert!(a.diagnostic.span.is_some(), "{text}");
                assert!(matches!(a.kind, FailureKind::Program | FailureKind::Budget), "{text}");
            }
            _ => panic!("ended differently the second time:\n{text}"),
        }
        assert_eq!(outputs[0], outputs[1], "{text}");
    }
    // Both ends are worth testing.
    let most = finished.into_iter().chain(failed).all(|n| n > PROGRAMS / 20);
    assert!(most, "{finished:?} finished, {failed:?} failed");
}

fn run_once(program: &Program, output: &mut Vec<String>) -> Result<Mesh, Failure> {
    let limits = Limits { max_vertices: 500, max_bytes: 1 << 20, max_call_depth: 30 };
    let settings = Settings { limits, ..Settings::default() };
    let mesh = run(program, program.start.unwrap(), &Mesh::new(), 0, &settings, output)?;
    run(program, program.default_rule().unwrap(), &mesh, 1, &settings, output)
}

fn state(mesh: &Mesh) -> String {
    let rings: Vec<_> = mesh.vertices().map(|v| mesh.ring(v).slots()).collect();
    let set: Vec<_> = mesh.set.iter().collect();
    format!("{rings:?} {:?} {set:?} {:?}", mesh.positions(), mesh.vertex_properties())
}

#[track_caller]
fn check_rings(mesh: &Mesh, text: &str) {
    for v in mesh.vertices() {
        let slots = mesh.ring(v).slots();
        let mut vertices: Vec<Vertex> = mesh.ring(v).vertices().collect();
        assert!(!vertices.contains(&v), "{v} is its own neighbour\n{text}");
        let n = vertices.len();
        vertices.sort_unstable();
        vertices.dedup();
        assert_eq!(vertices.len(), n, "a neighbour of {v} stands there twice\n{text}");
        let next = |i: usize| slots[(i + 1) % slots.len()];
        assert!((0..slots.len()).all(|i| slots[i].is_some() || next(i).is_some()), "gaps side by side at {v}\n{text}");
        assert!(!slots.contains(&None) || slots.last() == Some(&None), "a gap not at the end at {v}\n{text}");
    }
}

/// Writes random programs.
pub struct Writer {
    random: Random,
    text: String,
    /// Whether there are variables of type ring, faces and pairs.
    rings: bool,
}

impl Writer {
    pub fn new(seed: u64, rings: bool) -> Self {
        Self { random: Random::new(seed, 0), text: String::new(), rings }
    }

    pub fn program(mut self) -> String {
        self.text = format!("vertex {{ vertex mate; int n; }}; edge {{ double s; }};\n{OCTAHEDRON}");
        let passed = if self.rings { ", ring& r, ring s" } else { "" };
        let _ =
            writeln!(self.text, "static void other(mesh& S, mesh T, vertex a, vertex b, int i, double x{passed}) {{");
        self.text.push_str("  vertex c = a, d;\n");
        self.block(2);
        self.text.push_str(
            "}\nvoid step(mesh& S) {\n  mesh T;\n  vertex a, b, c, d = null;\n  int i = 1; double x = 0.5;\n",
        );
        self.text.push_str("  forall v in S { a = v; b = any in v; c = nextto b in v; if (v$pos.y > 0.5) break; }\n");
        if self.rings {
            self.text.push_str("  ring r, s;\n  forall f in faces S { s = f; if (is a in s) break; }\n");
            self.text.push_str("  forall y in a add y to r;\n");
        }
        self.block(8);
        self.text.push_str("}\n");
        self.text
    }

    fn below(&mut self, n: u64) -> u64 {
        self.random.bits() % n
    }

    fn pick<'a>(&mut self, from: &[&'a str]) -> &'a str {
        from[self.below(from.len() as u64) as usize]
    }

    fn block(&mut self, statements: u64) {
        for _ in 0..=self.below(statements) {
            let text = self.statement(3);
            let _ = writeln!(self.text, "  {text}");
        }
    }

    fn statement(&mut self, depth: u64) -> String {
        if depth > 0 && self.below(3) == 0 {
            let (v, set, condition) = (self.vertex(1), self.set(), self.condition(1));
            let body: Vec<_> = (0..=self.below(3)).map(|_| self.statement(depth - 1)).collect();
            let body = body.join(" ");
            if self.rings && self.below(2) == 0 {
                return self.round(&v, &body);
            }
            return match self.below(5) {
                0 => format!("if ({condition}) {{ {body} }} else {{ i = -i; }}"),
                1 => format!("forall w in {set} {{ a = w; {body} }}"),
                2 => format!("forall w in {v} {{ b = w; {body} }}"),
                3 => format!("for (int k = 0; k < 3; k++) {{ i += k; {body} }}"),
                _ => format!("while ({condition}) {{ {body} if (i > 5) break; i++; }}"),
            };
        }
        let (v, w, set) = (self.vertex(2), self.vertex(1), self.set());
        let (item, anchor) = (self.item(), self.item());
        let side = self.pick(&["after", "before"]);
        let name = self.pick(&["a", "b", "c", "d"]);
        let (number, condition) = (self.number(2), self.condition(1));
        if self.rings && self.below(3) == 0 {
            return self.ring_statement(&v, name);
        }
        match self.below(18) {
            0 => format!("{name} = {v};"),
            1 => format!("make {{{v}, {w}, {item}}} nb_of {name};"),
            2 => format!("erase {item} from {name};"),
            3 => format!("replace {item} with {v} in {name};"),
            4 => format!("splice {v} {side} {anchor} in {name};"),
            5 => format!("synchronize {set};"),
            6 => format!("add {v} to {set};"),
            7 => format!("remove {v} from {set};"),
            8 => "merge S with T;".to_owned(),
            9 => "T = S;".to_owned(),
            10 => format!("{name}$pos = vec({number}, x, 1) + {v}$pos;"),
            11 => format!("{name}$mate = {v};"),
            12 => format!("(a|{name})$s += {number};"),
            13 => format!("x = {number};"),
            14 => format!("i = {condition} ? i * 3 : valence {name} - i;"),
            15 => format!("print {v}, i, x, {set}, {condition};"),
            16 if self.rings => format!("other(S, {set}, {v}, {w}, i, {number}, r, {});", self.pick(&["r", "s"])),
            16 => format!("other(S, {set}, {v}, {w}, i, {number});"),
            _ => format!("{{ vertex y; make {{{v}}} nb_of y; add y to {set}; {name} = y; }}"),
        }
    }

    /// A loop over faces or round a ring.
    fn round(&mut self, v: &str, body: &str) -> String {
        let (set, ring) = (self.set(), self.pick(&["r", "s", "a", "`b", "c"]));
        match self.below(7) {
            0 => format!("forall f in faces {set} {{ s = f; {body} }}"),
            1 => format!("forall f in faces {set} {{ forall p, q in f {{ a = p; b = q; {body} }} break; }}"),
            2 => format!("forall f in faces {set} forall p, q in f forall w in f from p, q {{ c = w; {body} break; }}"),
            3 => format!("forall p, q in {ring} {{ a = q; {body} }}"),
            4 => format!("if (is {v} in r) forall w in r from {v} {{ b = w; {body} }}"),
            5 => format!("forall p, w in s from any in s {{ c = w; {body} }}"),
            _ => format!("forall w in {ring} from {v} {{ a = w; {body} }}"),
        }
    }

    fn ring_statement(&mut self, v: &str, name: &str) -> String {
        let (ring, item) = (self.pick(&["r", "r", "s"]), self.pick(&["a", "b", "c", "(any in r)"]));
        let side = self.pick(&["after", "before"]);
        match self.below(10) {
            0 => format!("add {v} to {ring};"),
            1 => format!("erase {item} from {ring};"),
            2 => format!("replace {item} with {v} in {ring};"),
            3 => format!("splice {v} {side} {item} in {ring};"),
            4 => format!("make {ring} nb_of {name};"),
            5 => self.pick(&["r = s;", "s = r;", "s = i > 3 ? r : s;", "{ ring t = r; r = s; s = t; }"]).to_owned(),
            6 => format!("{name} = nextto {item} in {ring};"),
            7 => format!("{name} = prevto {item} in {ring};"),
            8 => format!("i = valence {ring} + (is {v} in {ring} ? 1 : 2);"),
            _ => format!("print r, s, any in {ring};"),
        }
    }

    fn set(&mut self) -> &'static str {
        self.pick(&["S", "S", "T"])
    }

    fn item(&mut self) -> &'static str {
        self.pick(&["a", "b", "c", "d", "null", "(any in a)", "(nextto b in a)"])
    }

    fn vertex(&mut self, depth: u64) -> String {
        if depth == 0 || self.below(2) == 0 {
            return self.pick(&["a", "b", "c"]).to_owned();
        }
        let (v, item) = (self.vertex(depth - 1), self.item());
        let ring = self.pick(&["a", "b", "c", "`a", "d"]);
        match self.below(4) {
            0 => format!("(any in {ring})"),
            1 => format!("(nextto {item} in {v})"),
            2 => format!("(prevto {v} in {ring})"),
            _ => format!("{v}$mate"),
        }
    }

    fn number(&mut self, depth: u64) -> String {
        if depth == 0 {
            return self.pick(&["x", "1.5", "-2.0", "random()", "i"]).to_owned();
        }
        let (a, b, v) = (self.number(depth - 1), self.number(depth - 1), self.vertex(1));
        match self.below(6) {
            0 => format!("({a} + {b})"),
            1 => format!("({a} * {b})"),
            2 => format!("({a} / {b})"),
            3 => format!("{v}$pos.x"),
            4 => "`a$pos.y".to_owned(),
            _ => format!("length({v}$pos)"),
        }
    }

    fn condition(&mut self, depth: u64) -> String {
        let (v, item, set) = (self.vertex(depth), self.item(), self.set());
        match self.below(5) {
            0 => format!("{v} < b"),
            1 => format!("is {item} in c"),
            2 => format!("is {v} in {set}"),
            3 => format!("nextto {item} in a == null"),
            _ => "(i % 2 == 0 && !(x > 1.0))".to_owned(),
        }
    }
}
