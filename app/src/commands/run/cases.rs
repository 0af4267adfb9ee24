//! What `vv run` runs: every input with every combination of values.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use app::files;
use vv::diagnostic::Diagnostic;
use vv::ir::{GlobalId, Program};
use vv::mesh::{Type, Value};

use super::parameters;
use crate::commands::error;

/// Most runs of one command.
const MOST: usize = 1000;

/// One run.
#[derive(Debug, Clone)]
pub struct Case {
    /// Its number.
    pub index: usize,
    /// Which of the inputs; 0 if there is none.
    pub input: usize,
    /// The values of parameters as text, in the order of the command line.
    pub values: Vec<(String, String)>,
    /// And as the program wants them.
    pub params: Vec<(GlobalId, Value)>,
}

/// All runs, and in how many directions they differ.
#[derive(Debug)]
pub struct Cases {
    /// The runs; those with the same input, then with the same first values, stand together.
    pub all: Vec<Case>,
    /// The parameters that have several values, and these.
    pub sweeps: Vec<(String, Vec<String>)>,
}

/// The runs that are asked for.
///
/// # Errors
/// A parameter or a value that cannot be, or too many runs.
pub fn cases(program: &Program, inputs: usize, definitions: &[(String, String)]) -> Result<Cases, Box<Diagnostic>> {
    let mut values: Vec<(String, Vec<String>)> = Vec::new();
    for (name, text) in definitions {
        let ty = program.params().find(|(_, global, _)| global.name == *name).map(|(_, global, _)| global.ty);
        values.retain(|(other, _)| other != name); // the last one counts
        values.push((name.clone(), each(name, text, ty)?));
    }
    let inputs = inputs.max(1);
    let count = values.iter().try_fold(inputs, |count, (_, values)| count.checked_mul(values.len()));
    if count.is_none_or(|count| count > MOST) {
        let message = format!("these are more than {MOST} runs: each input with every combination of values");
        return Err(Box::new(error(message)));
    }
    let mut combinations: Vec<Vec<(String, String)>> = vec![vec![]];
    for (name, values) in &values {
        let with = |value: &String| (name.clone(), value.clone());
        combinations = combinations
            .iter()
            .flat_map(|others| values.iter().map(move |value| [others.clone(), vec![with(value)]].concat()))
            .collect();
    }
    let mut all = Vec::new();
    for input in 0..inputs {
        for values in &combinations {
            let params = parameters::values(program, values)?;
            all.push(Case { index: all.len(), input, values: values.clone(), params });
        }
    }
    values.retain(|(_, values)| values.len() > 1);
    Ok(Cases { all, sweeps: values })
}

/// The values that a definition gives to a parameter: `a,b,c` each of them, `from:to:count` that many at equal distances.
/// The commas of vectors are their own.
fn each(name: &str, text: &str, ty: Option<Type>) -> Result<Vec<String>, Box<Diagnostic>> {
    let scalar = matches!(ty, Some(Type::Bool | Type::Int | Type::Double));
    if scalar && text.contains(',') {
        let values: Vec<String> = text.split(',').map(|value| value.trim().to_owned()).collect();
        if values.iter().any(String::is_empty) {
            return Err(Box::new(error(format!("`-D {name}={text}`: a value is missing beside a comma"))));
        }
        let mut known = BTreeSet::new();
        if let Some(twice) = values.iter().find(|value| !known.insert(*value)) {
            return Err(Box::new(error(format!("`-D {name}={text}`: the value {twice} stands there twice"))));
        }
        return Ok(values);
    }
    if !scalar || !text.contains(':') {
        return Ok(vec![text.to_owned()]);
    }
    let wrong = || {
        let message = format!("`-D {name}={text}`: a sweep is `from:to:count`, such as 0:1:5");
        Box::new(error(message).evidence(format!("the count lies between 2 and {MOST}")))
    };
    let parts: Vec<&str> = text.split(':').map(str::trim).collect();
    let &[from, to, count] = parts.as_slice() else { return Err(wrong()) };
    let number = |text: &str| text.parse().ok().filter(|x: &f64| x.is_finite()).ok_or_else(wrong);
    let (from, to) = (number(from)?, number(to)?);
    let count = count.parse().ok().filter(|count| (2..=MOST).contains(count)).ok_or_else(wrong)?;
    let between = |i: usize| {
        let t = i as f64 / (count - 1) as f64;
        plain(from * (1.0 - t) + to * t)
    };
    // What was given is meant, however many digits it has.
    let end = |text: &str, x: f64| Some(plain(x)).filter(|plain| plain.parse() == Ok(x)).unwrap_or(text.to_owned());
    let inner = (1..count - 1).map(between);
    Ok([end(parts[0], from)].into_iter().chain(inner).chain([end(parts[1], to)]).collect())
}

/// Twelve digits, without those that only rounding made.
fn plain(x: f64) -> String {
    let rounded: f64 = format!("{x:.11e}").parse().unwrap_or(x);
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
}

impl Case {
    /// The name of its input, without folder and extension; without an input, that of the program.
    pub fn name(&self, inputs: &[PathBuf], program: &Path) -> String {
        match inputs.get(self.input).map_or(program, PathBuf::as_path) {
            stdin if files::is_standard_stream(stdin) => "stdin".to_owned(),
            path => path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
        }
    }

    /// Its value of a parameter.
    pub fn value(&self, name: &str) -> Option<&str> {
        self.values.iter().find(|(other, _)| other == name).map(|(_, value)| value.as_str())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(text: &str, ty: Type, expected: &[&str]) {
        assert_eq!(each("p", text, Some(ty)).unwrap(), expected);
    }

    #[test]
    fn a_sweep_has_both_ends_and_plain_numbers_between() {
        check("0:1:3", Type::Double, &["0", "0.5", "1"]);
        check("0.1:0.4:4", Type::Double, &["0.1", "0.2", "0.3", "0.4"]);
        check("1:-1:3", Type::Double, &["1", "0", "-1"]);
        check("2:6:3", Type::Int, &["2", "4", "6"]);
        check("2.0:6e0:3", Type::Int, &["2", "4", "6"]);
        check("0.123456789012345:1:2", Type::Double, &["0.123456789012345", "1"]);
        check("9007199254740993:9007199254740995:2", Type::Int, &["9007199254740993", "9007199254740995"]);
        for wrong in ["0:1", "0:1:1", "0:1:x", "a:1:3", "0:inf:3", "0:1:2:3", "0:1:99999"] {
            assert!(each("p", wrong, Some(Type::Double)).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_list_has_its_values_and_a_vector_is_one() {
        check("1,2, 5", Type::Int, &["1", "2", "5"]);
        check("true,false", Type::Bool, &["true", "false"]);
        check("1,2,3", Type::Vec, &["1,2,3"]);
        check("0.5", Type::Double, &["0.5"]);
    }
}
