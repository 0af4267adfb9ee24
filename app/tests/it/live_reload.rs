//! Files that other programs change while the modeler shows them.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use app::command::Command;
use app::session::{Session, Stale};

/// A folder with a program that includes another one and a mesh, open in the modeler at generation 1.
struct Bench {
    folder: tempfile::TempDir,
    session: Session,
}

const MESH: &str = "v 1 1 1\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

fn program(factor: f64) -> String {
    format!("#include \"more.vv\"\nvoid f(mesh& S) {{ forall v in S v$pos *= {factor:?} * more(); }}\n")
}

impl Bench {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = |name| folder.path().join(name);
        fs::write(path("a.vv"), program(2.0)).unwrap();
        fs::write(path("more.vv"), "double more() { return 1.0; }\n").unwrap();
        fs::write(path("a.obj"), MESH).unwrap();
        let mut session = Session::new(Some(path("a.obj")), Some(path("a.vv")), None, Arc::new(|| {})).unwrap();
        session.apply(Command::Step);
        let mut bench = Self { folder, session };
        bench.until("the first picture", |b| b.scale() == Some(2.0));
        bench
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// By how much the mesh shown is larger than the unit mesh.
    fn scale(&self) -> Option<f64> {
        let frame = self.session.frame().filter(|f| f.request.generation == 1)?;
        Some(frame.mesh.positions().first()?.x)
    }

    #[track_caller]
    fn until(&mut self, what: &str, reached: impl Fn(&Self) -> bool) {
        let began = Instant::now();
        while !reached(self) {
            assert!(began.elapsed() < Duration::from_secs(30), "waited in vain for {what}");
            self.session.poll();
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    #[track_caller]
    fn shows(&mut self, scale: f64) {
        self.until(&format!("scale {scale}"), |b| b.scale() == Some(scale) && !b.session.is_busy());
        assert_eq!(self.session.stale(), None);
        assert_eq!(self.session.document.generation, 1, "the generation stays");
    }

    /// Lets a while pass in which nothing should happen.
    fn wait(&mut self) {
        let began = Instant::now();
        while began.elapsed() < Duration::from_millis(1500) {
            self.session.poll();
            std::thread::sleep(Duration::from_millis(5));
        }
    }
}

fn rename_over(path: &Path, text: &str) {
    let beside = path.with_extension("tmp");
    fs::write(&beside, text).unwrap();
    fs::rename(&beside, path).unwrap();
}

#[test]
fn a_program_written_in_place_runs_anew() {
    let mut bench = Bench::new();
    fs::write(bench.path("a.vv"), program(3.0)).unwrap();
    bench.shows(3.0);
    fs::write(bench.path("a.vv"), program(4.0)).unwrap();
    bench.shows(4.0);
}

#[test]
fn a_program_written_beside_and_renamed_runs_anew() {
    let mut bench = Bench::new();
    for factor in [3.0, 4.0, 5.0] {
        rename_over(&bench.path("a.vv"), &program(factor));
        bench.shows(factor);
    }
}

#[test]
fn a_program_deleted_and_created_again_runs_anew() {
    let mut bench = Bench::new();
    fs::remove_file(bench.path("a.vv")).unwrap();
    bench.wait();
    assert_eq!((bench.scale(), bench.session.stale()), (Some(2.0), None), "what is gone leaves the text as it was");
    fs::write(bench.path("a.vv"), program(3.0)).unwrap();
    bench.shows(3.0);
}

#[test]
fn an_included_program_is_watched_too() {
    let mut bench = Bench::new();
    fs::write(bench.path("more.vv"), "double more() { return 10.0; }\n").unwrap();
    bench.shows(20.0);
    fs::remove_file(bench.path("more.vv")).unwrap();
    bench.wait();
    rename_over(&bench.path("more.vv"), "double more() { return 5.0; }\n");
    bench.shows(10.0);
}

#[test]
fn a_mesh_is_watched_too() {
    let mut bench = Bench::new();
    rename_over(&bench.path("a.obj"), &MESH.replacen("v 1 1 1", "v 7 1 1", 1));
    bench.shows(14.0);
}

#[test]
fn a_replaced_folder_is_found_again() {
    let mut bench = Bench::new();
    let (folder, aside) = (bench.path("sub"), bench.path("aside"));
    fs::create_dir(&folder).unwrap();
    fs::write(folder.join("b.vv"), "void f(mesh& S) { forall v in S v$pos *= 6.0; }").unwrap();
    bench.session.apply(Command::Open(folder.join("b.vv")));
    bench.shows(6.0);
    fs::rename(&folder, &aside).unwrap();
    bench.wait();
    fs::create_dir(&folder).unwrap();
    fs::write(folder.join("b.vv"), "void f(mesh& S) { forall v in S v$pos *= 8.0; }").unwrap();
    bench.shows(8.0);
}

#[test]
fn an_error_keeps_the_last_good_result_as_stale_until_it_is_repaired() {
    let mut bench = Bench::new();
    let camera = bench.session.document.camera;
    fs::write(bench.path("a.vv"), "void f(mesh& S) {\n  nonsense\n}\n").unwrap();
    bench.until("the error", |b| b.session.stale().is_some());
    assert!(matches!(bench.session.stale(), Some(Stale::Failed(_))));
    assert_eq!(bench.scale(), Some(2.0));
    assert_eq!(bench.session.problems().first_error().unwrap().place.as_ref().unwrap().start.line, 2);
    assert_eq!(bench.session.document.camera, camera);
    rename_over(&bench.path("a.vv"), &program(3.0));
    bench.shows(3.0);
    assert_eq!(bench.session.document.camera, camera);
}

#[test]
fn a_time_stamp_alone_changes_nothing() {
    let mut bench = Bench::new();
    let before = Arc::clone(bench.session.frame().unwrap());
    fs::write(bench.path("a.vv"), program(2.0)).unwrap();
    fs::write(bench.path("a.obj"), MESH).unwrap();
    bench.wait();
    assert!(Arc::ptr_eq(&before, bench.session.frame().unwrap()));
}

#[test]
fn changes_on_disk_do_not_overwrite_unsaved_ones_unasked() {
    let mut bench = Bench::new();
    let mine = program(3.0);
    bench.session.apply(Command::Edit(mine.as_str().into()));
    bench.shows(3.0);
    fs::write(bench.path("a.vv"), program(4.0)).unwrap();
    bench.until("the question", |b| b.session.text_on_disk().is_some());
    assert_eq!(&*bench.session.document.program.text, mine);
    bench.session.apply(Command::TakeFromDisk);
    bench.shows(4.0);
    assert!(!bench.session.document.program.is_modified());

    bench.session.apply(Command::Edit(mine.as_str().into()));
    fs::write(bench.path("a.vv"), program(5.0)).unwrap();
    bench.until("the question", |b| b.session.text_on_disk().is_some());
    bench.session.apply(Command::Save);
    assert_eq!(fs::read_to_string(bench.path("a.vv")).unwrap(), program(5.0));
    assert!(bench.session.text_on_disk().is_some() && bench.session.document.program.is_modified());
    bench.session.apply(Command::KeepMine);
    bench.shows(3.0);
    assert!(bench.session.document.program.is_modified());
    bench.session.apply(Command::Save);
    bench.wait();
    assert_eq!(fs::read_to_string(bench.path("a.vv")).unwrap(), mine);
    assert!(bench.session.text_on_disk().is_none() && !bench.session.document.program.is_modified());
}
