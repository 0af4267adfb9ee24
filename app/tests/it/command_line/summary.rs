//! `--summary json`

use super::*;

const FIELDS: &[&str] = &[
    "vertices",
    "edges",
    "faces",
    "components",
    "boundary_loops",
    "euler_characteristic",
    "genus",
    "closed",
    "valid",
    "warnings",
    "timings",
    "peak_memory_bytes",
];
const TIMINGS: &[&str] = &["load_s", "compile_s", "steps_s", "closing_s", "faces_s", "export_s", "render_s", "total_s"];

#[track_caller]
fn has_fields(object: &Value, expected: &[&str]) {
    let mut expected = expected.to_owned();
    expected.sort_unstable();
    let mut got: Vec<_> = object.as_object().unwrap().keys().map(String::as_str).collect();
    got.sort_unstable();
    assert_eq!(got, expected);
}

#[test]
fn it_is_the_whole_of_stdout() {
    let folder = Folder::with(&[]);
    let ended = folder.check("run move.vv -i octahedron.obj --rule still -n 2 --summary json", 0, "still\nstill");
    let summary = json(&ended.stdout);
    has_fields(&summary, FIELDS);
    has_fields(&summary["timings"], TIMINGS);
    for (name, expected) in [
        ("vertices", Value::from(6)),
        ("edges", 12.into()),
        ("faces", 8.into()),
        ("components", 1.into()),
        ("boundary_loops", 0.into()),
        ("euler_characteristic", 2.into()),
        ("genus", 0.into()),
        ("closed", true.into()),
        ("valid", true.into()),
        ("warnings", Vec::<Value>::new().into()),
    ] {
        assert_eq!(summary[name], expected, "{name}");
    }
    for list in ["steps_s", "closing_s"] {
        assert_eq!(summary["timings"][list].as_array().unwrap().len(), 2, "{list}");
    }
    assert!(summary["timings"]["total_s"].as_f64().unwrap() > 0.0);
    #[cfg(target_os = "linux")]
    assert!(summary["peak_memory_bytes"].as_u64().unwrap() > 1 << 20);
}

#[test]
fn it_repeats_what_was_warned_of() {
    let text = "void step(mesh& S) {\n  forall v in S {\n    vertex x;\n    splice x after any in v in v;\n  }\n}\n";
    let folder = Folder::with(&[("p.vv", text)]);
    let summary = json(
        &folder.check("run p.vv -i square.off --summary json", 0, "warning: after step 1 of 1 of `step`: ").stdout,
    );
    let warnings = summary["warnings"].as_array().unwrap();
    assert!(warnings.iter().any(|w| w.as_str().unwrap().starts_with("after step 1 of 1 of `step`: ")), "{summary}");
}

#[test]
fn a_failed_run_has_none() {
    assert_eq!(check("run failing.vv -i square.off --summary json", 1, "failing.vv:5:\nbefore").stdout, "");
}
