//! What is wrong with a command line before anything is run.

use std::collections::BTreeSet;
use std::path::PathBuf;

use app::files;
use vv::diagnostic::Diagnostic;
use vv::ir::{FunctionId, Program};

use super::super::output::Target;
use super::super::{Exit, closest, error, fail, list};
use super::plan::{self, Plan};
use super::{Arguments, Reporter};

/// Nothing can be read or written twice.
pub fn streams(arguments: &Arguments, reporter: &Reporter) -> Result<(), Exit> {
    if let Some(other) = arguments.others.first() {
        let name = files::shown(other);
        let diagnostic = error(format!("`vv run` takes one program, and {name} is one file more"));
        return fail(reporter, Exit::Usage, diagnostic.hint(format!("a mesh is given with `-i {name}`")));
    }
    let from_stdin = |path: &PathBuf| files::is_standard_stream(path);
    let meshes = arguments.input.iter().filter(|path| from_stdin(path)).count();
    if from_stdin(&arguments.program) && meshes > 0 {
        return fail(reporter, Exit::Usage, error("program and mesh cannot both be read from stdin"));
    }
    if meshes > 1 {
        return fail(reporter, Exit::Usage, error("only one mesh can be read from stdin"));
    }
    if arguments.summary.is_some() && arguments.output.to_stdout() {
        return fail(reporter, Exit::Usage, error("`--summary json` and `-o -` both need stdout for themselves"));
    }
    Ok(())
}

/// What a run goes by must not be written by it: nothing could be said of it after that. A mesh may take the place of the
/// one that it came from, and a result that of its reference, unless the run is `watched`: it would never end.
pub fn not_read(plan: &Plan, arguments: &Arguments, program: &Program, watched: bool) -> Result<(), Box<Diagnostic>> {
    let included = program.sources.files().iter().map(|file| PathBuf::from(&file.name));
    let view = arguments.output.view_file();
    let results = arguments.input.iter().chain(&arguments.reference).filter(|_| watched);
    let given = [&arguments.program].into_iter().chain(view.as_ref()).chain(arguments.look.files()).chain(results);
    let read: BTreeSet<_> = given.cloned().chain(included).map(|path| files::place(&path)).collect();
    // `-` is read at one end and written at the other.
    let is_file = |target: &&Target| !files::is_standard_stream(target.path());
    match plan.all_targets().iter().filter(is_file).find(|target| read.contains(&files::place(target.path()))) {
        Some(both) => {
            let message = format!("{} is read here, so it is not written", both.path().display());
            Err(Box::new(error(message)))
        }
        None => Ok(()),
    }
}

/// Which rule to apply how often; `None` if the program has only `start`.
pub fn what_to_apply(
    arguments: &Arguments,
    program: &Program,
) -> Result<(Option<FunctionId>, u64), (Exit, Box<Diagnostic>)> {
    let name = files::shown(&arguments.program);
    let names: Vec<_> = program.rules.iter().filter_map(|&r| program.function(r)).map(|f| f.name.as_str()).collect();
    if names.is_empty() && program.start.is_none() {
        let diagnostic = error(format!("{name} has nothing to run: neither a rule nor `start`"))
            .hint("a rule is a function `void name(mesh& S) { … }` in the program's own file");
        return Err((Exit::Program, diagnostic.into()));
    }
    let rule = match &arguments.rule {
        Some(wanted) => {
            Some(program.rule(wanted).ok_or_else(|| (Exit::Usage, unknown_rule(&name, wanted, &names).into()))?)
        }
        None => program.default_rule(),
    };
    let last = arguments.generations.as_ref().map(plan::Generations::last);
    let steps = arguments.steps.or(last).unwrap_or(u64::from(rule.is_some()));
    if rule.is_none() && steps > 0 {
        let diagnostic = error(format!("{name} has no rule to apply, only `start`")).hint("leave out `-n`");
        return Err((Exit::Usage, diagnostic.into()));
    }
    if program.start.is_none() && arguments.input.is_empty() {
        let diagnostic = error(format!("{name} has no `start` that would make a mesh, so it needs one"))
            .hint("add `-i MESH`, an .obj, .off, .ply, .stl, .glb or .gltf file");
        return Err((Exit::Usage, diagnostic.into()));
    }
    Ok((rule, steps))
}

/// Says which rules there are.
pub fn unknown_rule(program: &str, wanted: &str, names: &[&str]) -> Diagnostic {
    let diagnostic = error(format!("{program} has no rule `{wanted}`"));
    let diagnostic = match names {
        [] => diagnostic.evidence("it has only `start`"),
        [name] => diagnostic.evidence(format!("its only rule is `{name}`")),
        _ => diagnostic.evidence(format!("its rules are {}", list(names.iter().copied()))),
    };
    match closest(wanted, names.iter().copied()) {
        Some(name) => diagnostic.hint(format!("did you mean `--rule {name}`?")),
        None => diagnostic,
    }
}
