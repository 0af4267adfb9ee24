//! What can go wrong outside: whatever it is, it is told, and nothing is lost.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use app::command::Command;
use app::preferences::{PictureOptions, Preferences};
use app::session::{Purpose, Session, Stale};
use app::store::Store;
use vv::diagnostic::Severity;

const PROGRAM: &str = "void f(mesh& S) { forall v in S v$pos *= 2.0; }\n";
const CHANGED: &str = "void f(mesh& S) { forall v in S v$pos *= 3.0; }\n";
const MESH: &str = "v 1 1 1\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

/// A program and a mesh in a folder, open, with changes that are not saved.
struct Bench {
    folder: tempfile::TempDir,
    session: Session,
}

impl Bench {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = |name| folder.path().join(name);
        fs::write(path("a.vv"), PROGRAM).unwrap();
        fs::write(path("a.obj"), MESH).unwrap();
        let session = Session::new(Some(path("a.obj")), Some(path("a.vv")), None, Arc::new(|| {})).unwrap();
        let mut bench = Self { folder, session };
        bench.session.apply(Command::Edit(CHANGED.into()));
        bench.until("it is computed", |s| !s.is_busy() && s.frame().is_some());
        bench
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    #[track_caller]
    fn until(&mut self, what: &str, reached: impl Fn(&Session) -> bool) {
        let began = Instant::now();
        while !reached(&self.session) {
            assert!(began.elapsed() < Duration::from_secs(30), "waited in vain until {what}");
            self.session.poll();
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    /// The user is told so, and the text is still there and counts as unsaved.
    #[track_caller]
    fn says(&mut self, severity: Severity, told: &str) {
        self.until(told, |s| s.notice().is_some_and(|(how, text)| how == severity && text.contains(told)));
        assert_eq!(&*self.session.document.program.text, CHANGED);
        assert!(self.session.is_unsaved());
    }
}

/// A place that takes nothing: a link to a device that is full.
#[cfg(target_os = "linux")]
fn full(bench: &Bench, name: &str) -> PathBuf {
    let path = bench.path(name);
    std::os::unix::fs::symlink("/dev/full", &path).unwrap();
    path
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_takes_no_program_no_project_no_mesh_and_no_picture_and_says_so() {
    const FULL: &str = "no space is left on the device";
    for (purpose, name) in [
        (Purpose::SaveProgram, "b.vv"),
        (Purpose::SaveProject, "b.vvp"),
        (Purpose::ExportMesh, "b.obj"),
        (Purpose::SavePicture, "b.png"),
    ] {
        let mut bench = Bench::new();
        let picture = PictureOptions { as_seen: false, width: 8, height: 8, ..PictureOptions::default() };
        bench.session.apply(Command::SetPreferences(Preferences { picture, ..Preferences::default() }));
        let path = full(&bench, name);
        bench.session.chosen(purpose, path);
        bench.says(Severity::Error, FULL);
        assert_eq!(fs::read_to_string(bench.path("a.vv")).unwrap(), PROGRAM);
        assert_eq!(bench.session.document.program.path, Some(bench.path("a.vv")));
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_may_not_be_written_to_is_named() {
    let mut bench = Bench::new();
    // Where nobody makes files, whoever he is.
    bench.session.chosen(Purpose::SaveProgram, "/sys/a.vv".into());
    bench.says(Severity::Error, "may not write to `/sys`");
    bench.session.chosen(Purpose::ExportMesh, bench.path("no/a.obj"));
    bench.says(Severity::Error, "there is no directory");
}

#[test]
fn a_program_whose_file_is_deleted_stays_and_is_asked_about() {
    let mut bench = Bench::new();
    bench.session.apply(Command::Edit(PROGRAM.into()));
    assert!(!bench.session.is_unsaved());
    fs::remove_file(bench.path("a.vv")).unwrap();
    bench.until("it is told", |s| s.notice().is_some_and(|(_, text)| text.starts_with("a.vv is gone from the disk")));
    assert!(bench.session.is_unsaved());
    bench.session.apply(Command::Quit);
    assert!(!bench.session.wants_quit(), "asks first");
    bench.session.apply(Command::CloseDialog);
    // Once it is back, all is well.
    fs::write(bench.path("a.vv"), PROGRAM).unwrap();
    bench.until("it is back", |s| !s.is_unsaved());
    assert_eq!(bench.session.notice(), None, "it is not gone any more");
}

#[test]
fn a_mesh_whose_file_is_deleted_is_still_shown() {
    let mut bench = Bench::new();
    fs::remove_file(bench.path("a.obj")).unwrap();
    bench.says(Severity::Warning, "a.obj is gone from the disk");
    bench.session.apply(Command::Step);
    bench.until("a step is made", |s| !s.is_busy() && s.shown_generation() == 1);
    assert_eq!(bench.session.stale(), None);
    // To read it anew is another thing.
    bench.session.apply(Command::Run);
    bench.until("it cannot be read", |s| matches!(s.stale(), Some(Stale::Failed(why)) if why.contains("no such file")));
    assert!(bench.session.frame().is_some());
}

#[test]
fn a_folder_that_is_replaced_brings_its_files() {
    let mut bench = Bench::new();
    bench.session.apply(Command::Edit(PROGRAM.into()));
    let (old, new) = (bench.path(""), bench.folder.path().with_extension("new"));
    fs::create_dir(&new).unwrap();
    fs::write(new.join("a.vv"), CHANGED).unwrap();
    fs::write(new.join("a.obj"), MESH).unwrap();
    let aside = bench.folder.path().with_extension("old");
    fs::rename(&old, &aside).unwrap();
    fs::rename(&new, &old).unwrap();
    bench.until("the new program is there", |s| &*s.document.program.text == CHANGED);
    fs::remove_dir_all(aside).unwrap();
}

#[test]
fn a_crash_loses_less_than_a_second_of_typing_while_it_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::open(folder.path()).unwrap();
    let mut session = Session::new(None, None, Some(store), Arc::new(|| {})).unwrap();
    let began = Instant::now();
    let (mut typed, mut text) = (Vec::new(), String::from("// "));
    while began.elapsed() < Duration::from_secs(4) {
        text.push('x');
        session.apply(Command::Edit(text.as_str().into()));
        typed.push((Instant::now(), text.len()));
        session.poll();
        std::thread::sleep(Duration::from_millis(10));
        let Some(kept) = kept(folder.path()) else { continue };
        let now = Instant::now();
        let due = typed.iter().take_while(|(then, _)| now - *then > Duration::from_secs(1)).last();
        assert!(due.is_none_or(|(_, length)| kept >= *length), "{kept} characters are kept");
    }
    assert!(kept(folder.path()).is_some());
}

/// Length of the text that would be brought back now.
fn kept(folder: &Path) -> Option<usize> {
    let files = fs::read_dir(folder.join("recovery")).unwrap().map(|f| f.unwrap().path());
    let path = files.into_iter().find(|p| p.extension().is_some_and(|e| e == "json"))?;
    let project = app::project::Project::from_json(&fs::read(path).ok()?, None).ok()?;
    Some(project.into_document().program.text.len())
}
