//! Paths as people type and read them: `~` is the home folder, and what begins a name finds the rest of it.

use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Entries of a folder that are looked at, at most.
const MOST: usize = 10_000;

/// What is in a folder.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Entry {
    /// Its name.
    pub name: String,
    /// Whether it has more in it.
    pub is_folder: bool,
}

impl Entry {
    /// A folder has a stroke behind it.
    #[must_use]
    pub fn shown(&self) -> String {
        if self.is_folder { format!("{}/", self.name) } else { self.name.clone() }
    }
}

/// The path that is meant by a text. A whole path that is typed or pasted behind a folder counts by itself, as in Emacs:
/// `/here//there` is `/there`, and `/here/~/there` is at home.
#[must_use]
pub fn expand(text: &str) -> PathBuf {
    expand_at(text, home().as_deref())
}

fn expand_at(text: &str, home: Option<&Path>) -> PathBuf {
    let text = text.trim();
    let whole = ["//", "/~/"].iter().filter_map(|mark| text.rfind(mark)).filter(|&at| at > 0).max();
    let text = whole.map_or(text, |slash| &text[slash + 1..]);
    match (text.strip_prefix('~'), home) {
        (Some(""), Some(home)) => home.to_owned(),
        (Some(rest), Some(home)) if rest.starts_with('/') => home.join(rest.trim_start_matches('/')),
        _ => PathBuf::from(text),
    }
}

/// The whole path as people write it, so that they find it again.
#[must_use]
pub fn shown(path: &Path) -> String {
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    shown_at(&path, home().as_deref())
}

fn shown_at(path: &Path, home: Option<&Path>) -> String {
    let below = home.and_then(|home| path.strip_prefix(home).ok());
    match below {
        Some(below) if below.as_os_str().is_empty() => "~".to_owned(),
        Some(below) => format!("~/{}", below.display()),
        None => path.display().to_string(),
    }
}

fn home() -> Option<PathBuf> {
    std::env::home_dir().filter(|home| home.is_absolute())
}

/// The folder of what is typed.
#[must_use]
pub fn folder(text: &str) -> PathBuf {
    let typed = text.rfind('/').map_or("", |slash| &text[..=slash]);
    if typed.is_empty() { PathBuf::from(".") } else { expand(typed) }
}

/// Folders, and files with one of the `extensions`, sorted; nothing if the folder cannot be read.
#[must_use]
pub fn entries(folder: &Path, extensions: &[&str]) -> Arc<[Entry]> {
    let Ok(read) = std::fs::read_dir(folder) else { return Arc::default() };
    let fits = |name: &str| {
        let extension = Path::new(name).extension().unwrap_or_default();
        extensions.iter().any(|known| extension.eq_ignore_ascii_case(known))
    };
    let named = read.take(MOST).filter_map(Result::ok).filter_map(|found| {
        let name = found.file_name().into_string().ok()?;
        let is_folder = found.path().is_dir();
        (is_folder || fits(&name)).then_some(Entry { name, is_folder })
    });
    let mut entries: Vec<Entry> = named.collect();
    entries.sort();
    entries.into()
}

/// Those that begin as is typed. Hidden ones are asked for by their dot.
pub fn fitting<'a>(entries: &'a [Entry], text: &str) -> impl Iterator<Item = &'a Entry> {
    let typed = name_in(text).to_lowercase();
    entries.iter().filter(move |entry| {
        let hidden = entry.name.starts_with('.') && !typed.starts_with('.');
        !hidden && entry.name.to_lowercase().starts_with(&typed)
    })
}

/// What is typed with all that those that fit begin with; nothing if that is no more than is typed.
#[must_use]
pub fn completion(fitting: &[&Entry], text: &str) -> Option<String> {
    let (first, others) = fitting.split_first()?;
    if others.is_empty() {
        return Some(join(text, first)).filter(|completed| completed != text);
    }
    let common = others.iter().fold(first.name.as_str(), |common, entry| {
        let same = common.chars().zip(entry.name.chars()).take_while(|(a, b)| a == b);
        &common[..same.map(|(a, _)| a.len_utf8()).sum()]
    });
    let typed = name_in(text);
    (common.len() > typed.len()).then(|| format!("{}{common}", &text[..text.len() - typed.len()]))
}

/// What is typed with the entry in the place of its beginning.
#[must_use]
pub fn join(text: &str, entry: &Entry) -> String {
    format!("{}{}", &text[..text.len() - name_in(text).len()], entry.shown())
}

/// What is typed behind the folder.
fn name_in(text: &str) -> &str {
    text.rfind('/').map_or(text, |slash| &text[slash + 1..])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder_with(names: &[&str]) -> Vec<Entry> {
        let entry = |name: &&str| Entry { name: name.trim_end_matches('/').into(), is_folder: name.ends_with('/') };
        names.iter().map(entry).collect()
    }

    #[track_caller]
    fn check(names: &[&str], typed: &str, fit: &str, completed: Option<&str>) {
        let entries = folder_with(names);
        let found: Vec<_> = fitting(&entries, typed).collect();
        assert_eq!(found.iter().map(|e| e.shown()).collect::<Vec<_>>().join(" "), fit);
        assert_eq!(completion(&found, typed).as_deref(), completed);
    }

    #[test]
    fn a_tilde_is_the_home_folder() {
        let home = Some(Path::new("/home/ann"));
        assert_eq!(expand_at("~", home), Path::new("/home/ann"));
        assert_eq!(expand_at(" ~/a.obj ", home), Path::new("/home/ann/a.obj"));
        assert_eq!(expand_at("~ben/a.obj", home), Path::new("~ben/a.obj"));
        assert_eq!(expand_at("~/a.obj", None), Path::new("~/a.obj"));
        assert_eq!(shown_at(Path::new("/home/ann/b/a.obj"), home), "~/b/a.obj");
        assert_eq!(shown_at(Path::new("/home/anna/a.obj"), home), "/home/anna/a.obj");
    }

    #[test]
    fn a_whole_path_behind_a_folder_counts_by_itself() {
        let check = |typed: &str, meant: &str| {
            assert_eq!(expand_at(typed, Some(Path::new("/home/ann"))), Path::new(meant), "{typed}");
        };
        check("/here//there/a.obj", "/there/a.obj");
        check("~/here//there//b", "/b");
        check("/here/~/a.obj", "/home/ann/a.obj");
        check("/here//~/there//a.obj", "/a.obj");
        check("//host/a.obj", "//host/a.obj");
        assert_eq!(folder("/here//there/a"), Path::new("/there/"));
        assert_eq!(folder("/here//"), Path::new("/"));
    }

    #[test]
    fn what_is_typed_finds_what_begins_so() {
        let names = [".git/", "cube.obj", "meshes/", "torus-quads.obj", "torus.obj"];
        check(&names, "", "cube.obj meshes/ torus-quads.obj torus.obj", None);
        check(&names, "~/x/T", "torus-quads.obj torus.obj", Some("~/x/torus"));
        check(&names, "torus", "torus-quads.obj torus.obj", None);
        check(&names, "m", "meshes/", Some("meshes/"));
        check(&names, "/a/cube.obj", "cube.obj", None);
        check(&names, ".", ".git/", Some(".git/"));
        check(&names, "x", "", None);
        check(&["über/", "übel.obj"], "ü", "über/ übel.obj", Some("übe"));
    }
}
