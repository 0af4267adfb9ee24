//! Who may know whom: read off the sources and held to this table.

use std::fs;
use std::path::Path;

/// Each module with those it may name beside itself.
const MAY_USE: &[(&str, &[&str])] = &[
    ("source", &[]),
    ("stop", &[]),
    ("mesh", &["diagnostic", "stop"]),
    ("diagnostic", &["mesh", "source"]),
    ("syntax", &["diagnostic", "source"]),
    ("builtins", &["mesh"]),
    ("ir", &["builtins", "mesh", "source", "syntax"]),
    ("assist", &["builtins", "source", "syntax"]),
    ("check", &["builtins", "diagnostic", "ir", "mesh", "source", "syntax"]),
    ("engine", &["builtins", "diagnostic", "ir", "mesh", "source", "stop"]),
    ("io", &["diagnostic", "mesh", "stop"]),
    ("masks", &["diagnostic", "engine", "ir", "mesh", "stop"]),
];

/// What a module's files say after `crate::`, tests and comments left out.
fn used_by(module: &str) -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = vec![root.join(format!("{module}.rs"))];
    let mut folders = vec![root.join(module)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).into_iter().flatten() {
            let path = entry.unwrap().path();
            if path.is_dir() { folders.push(path) } else { files.push(path) }
        }
    }
    let mut used = Vec::new();
    for file in
        files.iter().filter(|f| !f.components().any(|c| c.as_os_str() == "tests" || c.as_os_str() == "tests.rs"))
    {
        let text = fs::read_to_string(file).unwrap();
        let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
        for line in text.lines().filter(|l| !l.trim_start().starts_with("//")) {
            for rest in line.split("crate::").skip(1) {
                let name = rest.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap();
                used.push((name.to_owned(), format!("{}: {line}", file.display())));
            }
        }
    }
    used
}

#[test]
fn modules_know_only_what_lies_below_them() {
    for (module, allowed) in MAY_USE {
        let used = used_by(module);
        for (name, place) in &used {
            assert!(name == module || allowed.contains(&name.as_str()), "{module} must not use {name}: {place}");
        }
        for name in *allowed {
            assert!(used.iter().any(|(n, _)| n == name), "{module} may use {name} and does not: tighten the table");
        }
    }
}

#[test]
fn every_module_stands_in_the_table() {
    let library = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("src/lib.rs")).unwrap();
    for module in library.lines().filter_map(|l| l.strip_prefix("pub mod ")?.strip_suffix(';')) {
        assert!(MAY_USE.iter().any(|(m, _)| *m == module), "{module} has no row");
    }
}
