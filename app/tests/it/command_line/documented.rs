//! Command lines that are shown to people, in the manual, on the first page and in `--help`: they are run as they stand.

use std::io::{BufRead as _, BufReader};

use super::*;

const MANUAL: &str = include_str!("../../../../vv/README.md");
const FIRST_PAGE: &str = include_str!("../../../../README.md");

/// With every file that is spoken of: what ships, and the meshes and pictures of who reads it.
fn folder() -> Folder {
    let folder = Folder(tempfile::tempdir().unwrap());
    let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets");
    for shipped in ["programs", "meshes"].into_iter().flat_map(|kind| fs::read_dir(assets.join(kind)).unwrap()) {
        let shipped = shipped.unwrap();
        if shipped.file_type().unwrap().is_file() {
            fs::copy(shipped.path(), folder.0.path().join(shipped.file_name())).unwrap();
        }
    }
    fs::copy(folder.path("mountain.vv"), folder.path("terrain.vv")).unwrap();
    for name in ["bunny", "mesh", "a", "b", "in", "mine", "before", "after"] {
        fs::write(folder.path(&format!("{name}.obj")), OCTAHEDRON).unwrap();
    }
    fs::write(folder.path("look.json"), fenced(MANUAL, "json").concat()).unwrap();
    folder.check("mesh convert mesh.obj -o mesh.off -o theirs.off -o scan.stl", 0, "");
    folder.check("run loop.vv -i mesh.obj -o old.png --size 60x45", 0, "");
    folder
}

/// What stands between fences of a kind.
fn fenced(text: &str, kind: &str) -> Vec<String> {
    let fence = format!("```{kind}\n");
    text.split(&fence).skip(1).map(|block| block.split("```").next().unwrap().to_owned()).collect()
}

/// The command lines in a text that need no window, without what is said of them, and with smaller pictures.
fn commands(text: &str) -> Vec<String> {
    let commands = ["run", "render", "watch", "check", "fmt", "mask", "mesh", "completions", "man"];
    let is_command = |line: &&str| commands.iter().any(|command| line.starts_with(&format!("vv {command} ")));
    let alone = |line: &'_ str| line.split("  ").next().unwrap().split(" # ").next().unwrap().to_owned();
    text.lines().map(str::trim).filter(is_command).map(alone).map(small).collect()
}

fn small(line: String) -> String {
    const SMALL: &str = "--size 240x180";
    if let Some(at) = line.find("--size ") {
        let end = line[at + 7..].find(' ').map_or(line.len(), |end| at + 7 + end);
        return format!("{}{SMALL}{}", &line[..at], &line[end..]);
    }
    let draws = [".png", ".gif"].iter().any(|end| line.contains(end)) && !line.contains("--reference");
    if draws { format!("{line} {SMALL}") } else { line }
}

/// Runs `line` as a shell does.
#[track_caller]
fn works(folder: &Folder, line: &str) {
    let vv = folder.command("");
    let mut shell = Command::new("sh");
    let bin = Path::new(env!("CARGO_BIN_EXE_vv")).parent().unwrap();
    let path = std::env::join_paths(
        [bin.to_owned()].into_iter().chain(std::env::split_paths(&std::env::var_os("PATH").unwrap())),
    );
    shell.args(["-c", &format!("exec {line}")]).current_dir(folder.0.path()).env("PATH", path.unwrap());
    for (name, value) in vv.get_envs() {
        match value {
            Some(value) => shell.env(name, value),
            None => shell.env_remove(name),
        };
    }
    shell.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = shell.spawn().unwrap();
    if line.starts_with("vv watch ") {
        let mut said = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut said).unwrap();
        child.kill().unwrap();
        child.wait().unwrap();
        assert!(said.contains(" faces; ") || said.contains(" runs; "), "{line}: {said}");
        return;
    }
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
}

#[cfg(unix)]
#[track_caller]
fn all_work(text: &str, at_least: usize) {
    let (folder, lines) = (folder(), commands(text));
    assert!(lines.len() >= at_least, "{lines:?}");
    lines.iter().for_each(|line| works(&folder, line));
}

#[cfg(unix)]
#[test]
fn the_commands_of_the_manual_work() {
    all_work(&fenced(MANUAL, "sh").concat(), 11);
}

#[cfg(unix)]
#[test]
fn the_commands_of_the_first_page_work() {
    all_work(&fenced(FIRST_PAGE, "sh").concat(), 10);
}

#[cfg(unix)]
#[test]
fn the_examples_in_the_help_work() {
    let help = |command: &str| check(&format!("{command} --help"), 0, "").stdout;
    let examples = ["", "run", "render", "watch", "mask"].map(help);
    let examples = examples.each_ref().map(|text| text.split_once("Examples:").map_or("", |(_, examples)| examples));
    // What a pipe goes on with is not ours.
    let examples = examples.concat().replace(" | jq .euler_characteristic", "");
    all_work(&examples, 15);
}
