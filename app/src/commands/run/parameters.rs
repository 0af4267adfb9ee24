//! `-D name=value`

use app::worker::fits;
use glam::DVec3;
use vv::diagnostic::Diagnostic;
use vv::ir::{GlobalId, Program};
use vv::mesh::{Type, Value};

use crate::commands::{closest, error, list};

/// Name and value of a definition.
pub fn definition(text: &str) -> Result<(String, String), String> {
    let pair = text.split_once('=').filter(|(name, _)| !name.trim().is_empty());
    let (name, value) = pair.ok_or("a definition is a name and a value such as w=0.05")?;
    Ok((name.trim().to_owned(), value.trim().to_owned()))
}

/// The values of a program's parameters; of several for one parameter the last counts.
///
/// # Errors
/// A name that the program does not have, a value of another type or out of range.
pub fn values(program: &Program, definitions: &[(String, String)]) -> Result<Vec<(GlobalId, Value)>, Box<Diagnostic>> {
    let mut values: Vec<(GlobalId, Value)> = Vec::new();
    for (name, text) in definitions {
        let (id, global, param) = program
            .params()
            .find(|(_, global, _)| global.name == *name)
            .ok_or_else(|| Box::new(unknown(program, name)))?;
        let value = parse(text, global.ty).map_err(|wanted| {
            let message = format!("`-D {name}={text}`: the parameter `{name}` is {wanted}");
            Box::new(error(message).evidence(format!("its default is {}", shown(param.default))))
        })?;
        if let Some((low, high)) = param.range
            && !fits(global, param, value)
        {
            let (low, high) = (shown(low), shown(high));
            let message = format!("`-D {name}={text}`: the parameter `{name}` must lie in [{low}, {high}]");
            return Err(Box::new(error(message)));
        }
        values.retain(|&(other, _)| other != id);
        values.push((id, value));
    }
    Ok(values)
}

fn unknown(program: &Program, name: &str) -> Diagnostic {
    let names: Vec<_> = program.params().map(|(_, global, _)| global.name.as_str()).collect();
    let diagnostic = error(format!("`-D {name}=…`: the program has no parameter `{name}`"));
    let diagnostic = match names.as_slice() {
        [] => diagnostic.evidence("it has no parameters").hint(format!("declare one: `param double {name} = 1.0;`")),
        [only] => diagnostic.evidence(format!("its only parameter is `{only}`")),
        _ => diagnostic.evidence(format!("its parameters are {}", list(names.iter().copied()))),
    };
    match closest(name, names.iter().copied()) {
        Some(name) => diagnostic.hint(format!("did you mean `-D {name}=…`?")),
        None => diagnostic,
    }
}

/// A value of the type, or what values of the type are.
fn parse(text: &str, ty: Type) -> Result<Value, &'static str> {
    let double = |text: &str| text.trim().parse().ok().filter(|x: &f64| x.is_finite());
    match ty {
        Type::Bool => match text {
            "true" | "1" => Ok(Value::Bool(true)),
            "false" | "0" => Ok(Value::Bool(false)),
            _ => Err("true or false"),
        },
        Type::Int => text.parse().map(Value::Int).map_err(|_| "a whole number"),
        Type::Double => double(text).map(Value::Double).ok_or("a number"),
        Type::Vec => {
            let inner = text.strip_prefix('(').and_then(|t| t.strip_suffix(')')).unwrap_or(text);
            let numbers: Option<Vec<f64>> = inner.split(',').map(double).collect();
            match numbers.as_deref() {
                Some(&[x, y, z]) => Ok(Value::Vec(DVec3::new(x, y, z))),
                _ => Err("a vector, written x,y,z"),
            }
        }
        Type::Vertex => Err("a vertex, which cannot be given from outside"),
    }
}

fn shown(value: Value) -> String {
    match value {
        Value::Bool(b) => b.to_string(),
        Value::Int(i) => i.to_string(),
        Value::Double(x) => x.to_string(),
        Value::Vec(v) => format!("{},{},{}", v.x, v.y, v.z),
        Value::Vertex(v) => v.map_or_else(|| "null".to_owned(), |v| v.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_read_as_their_type() {
        for (text, ty, expected) in [
            ("true", Type::Bool, Ok(Value::Bool(true))),
            ("0", Type::Bool, Ok(Value::Bool(false))),
            ("yes", Type::Bool, Err("true or false")),
            ("-7", Type::Int, Ok(Value::Int(-7))),
            ("1.5", Type::Int, Err("a whole number")),
            ("1e-3", Type::Double, Ok(Value::Double(0.001))),
            ("nan", Type::Double, Err("a number")),
            ("1, -2,3e0", Type::Vec, Ok(Value::Vec(DVec3::new(1.0, -2.0, 3.0)))),
            ("(1,2,3)", Type::Vec, Ok(Value::Vec(DVec3::new(1.0, 2.0, 3.0)))),
            ("1,2", Type::Vec, Err("a vector, written x,y,z")),
        ] {
            assert_eq!(parse(text, ty), expected, "{text}");
        }
    }

    #[test]
    fn a_range_holds_to_the_last_unit() {
        let text = "param int n = 0 in [0, 9007199254740992];\nvoid step(mesh& S) { }\n";
        let program = vv::compile("n.vv", text, &mut |_, _| Err(String::new())).program.unwrap();
        let check =
            |value: &str| values(&program, &[("n".to_owned(), value.to_owned())]).map(drop).map_err(|d| d.message);
        assert_eq!(check("9007199254740992"), Ok(()));
        let refused = "`-D n=9007199254740993`: the parameter `n` must lie in [0, 9007199254740992]";
        assert_eq!(check("9007199254740993"), Err(refused.to_owned()));
    }

    #[test]
    fn a_definition_has_a_name_and_a_value() {
        assert_eq!(definition("a = b=c"), Ok(("a".to_owned(), "b=c".to_owned())));
        assert!(definition("a").is_err());
    }
}
