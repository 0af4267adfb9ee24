//! Finds the masks of a rule by running it: with which weights it makes new vertices of old ones.

use std::error::Error;
use std::io::{self, Write};

use vv::engine::{Engine, Machine, Settings};
use vv::masks::{Around, Star, classes, fraction, measure};

/// Each vertex goes half way to the middle of its neighbours.
const PROGRAM: &str = "
void step(mesh& S) {
  synchronize S;
  forall v in S {
    vec sum = vec(0, 0, 0);
    forall q in v sum += `q$pos;
    v$pos = (`v$pos + sum / valence v) / 2.0;
  }
}";

fn main() -> Result<(), Box<dyn Error>> {
    masks(&mut io::stdout().lock())
}

/// Prints them for four valences.
pub fn masks(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let compilation = vv::compile("smooth.vv", PROGRAM, &mut |_, _| Err("nothing to include".to_owned()));
    let machine = Machine::new(compilation.program.ok_or("the program cannot run")?, Engine::Native);
    let rule = machine.program().default_rule().ok_or("the program has no rule")?;
    for valence in 3..=6 {
        // One vertex of this valence, among regular ones.
        let star = Star::new(valence, Around::Triangles, false).ok_or("no such star")?;
        let masks = measure(&machine, rule, &star.mesh, &Settings::default())?;
        for fault in &masks.faults {
            writeln!(out, "valence {valence}: {fault}")?;
        }
        for class in classes(&star, &masks) {
            let weight = |w: f64| fraction(w).unwrap_or_else(|| format!("{w:.6}"));
            let weights: Vec<String> =
                class.mask.iter().map(|&(v, w)| format!("{} {}", weight(w), star.name(v))).collect();
            writeln!(out, "valence {valence}: {}", weights.join(" + "))?;
        }
    }
    Ok(())
}
