//! What a window waits for beside the driver's drawing, phase by phase: pressing Step on a million faces, and the way from
//! an edit of the program to the new picture of a small mesh.
//!
//! `cargo bench -p app --bench around`; with `million` or `edit` one of the two.
#![allow(clippy::unwrap_used, clippy::panic, clippy::allow_attributes, reason = "a benchmark that panics has failed")]

use std::collections::BTreeMap;
use std::hint::black_box;
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc;
use std::time::{Duration, Instant};

use app::document::MeshSource;
use app::render::Headless;
use app::scene::{Pointer, Scene, Style};
use app::watch::Watch;
use app::worker::{Event, Frame, Recipe, Request, Worker};
use app::{evaluation, files, library, trace};
use glam::DVec2;
use vv::engine::{Engine, Machine, Settings};
use vv::io::{Format, ReadOptions, read, write};
use vv::mesh::Mesh;
use vv::mesh::faces::faces;
use vv::mesh::statistics::statistics;
use vv::stop::Stop;

/// How often each phase is timed; the median counts.
const ROUNDS: usize = 9;

fn main() {
    let chosen: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let wants = |name: &str| chosen.is_empty() || chosen.iter().any(|c| c == name);
    if wants("million") {
        million();
    }
    if wants("edit") {
        edit();
    }
}

/// Prints the median of some rounds; returns the last result.
fn phase<T>(name: &str, mut work: impl FnMut() -> T) -> T {
    let mut times = Vec::new();
    let mut last = None;
    for _ in 0..ROUNDS {
        drop(last.take());
        let began = Instant::now();
        last = Some(black_box(work()));
        times.push(began.elapsed());
    }
    show(name, &mut times);
    last.unwrap()
}

fn show(name: &str, times: &mut [Duration]) {
    times.sort();
    let ms = |t: Duration| t.as_secs_f64() * 1e3;
    println!("{name:>28}  {:>8.2} ms   least {:.2}", ms(times[times.len() / 2]), ms(times[0]));
}

/// The phases of the eighth step of Loop subdivision from an icosahedron.
fn million() {
    println!("one step to 1,310,720 triangles");
    let machine = machine("paper-loop.vv");
    let (settings, stop) = (Settings::default(), Stop::new());
    let mut closing = Vec::new();
    let mesh = refined(&machine, shipped("icosahedron.obj"), 7);
    let control = shipped("icosahedron.obj");
    let control_faces = faces(&control, &stop).unwrap();
    let rule = machine.program().default_rule().unwrap();
    let mesh = phase("step and closing", || {
        let next = evaluation::advance(&machine, rule, &mesh, 8, &settings, &mut Vec::new()).unwrap();
        closing.push(Duration::from_secs_f64(next.closing_s));
        next.mesh
    });
    show("closing", &mut closing);
    let found = phase("faces", || faces(&mesh, &stop).unwrap());
    phase("statistics", || statistics(&mesh, &found, &stop).unwrap());
    phase("snapshot", || mesh.clone());
    let scene = phase("scene", || Scene::new(&mesh, &found, Some((&control, &control_faces)), &stop).unwrap());
    phase("index, after the picture", || {
        let scene = scene.clone();
        scene.build_index();
        scene
    });
    phase("fit before the index", || scene.standard_view(&Style::default(), 1.6));
    scene.build_index();
    phase("fit", || scene.standard_view(&Style::default(), 1.6));
    let camera = scene.standard_view(&Style::default(), 1.6);
    let pointer = |x: f64, y: f64| Pointer {
        ray: camera.ray(DVec2::new(x, y)),
        spread: camera.spread(0.02),
        opaque: true,
        cut: None,
    };
    phase("picking once, inside", || scene.pick(&pointer(0.1, 0.2)).unwrap());
    phase("picking a thousand times", || {
        (0..1000)
            .filter(|&i| scene.pick(&pointer(f64::from(i % 40) / 20.0 - 1.0, f64::from(i / 40) / 12.5 - 1.0)).is_some())
            .count()
    });
    match Headless::new(4) {
        Ok(headless) => drop(phase("upload", || headless.upload(&scene).unwrap())),
        Err(error) => println!("{:>28}  {error}", "upload"),
    }
    phase("export, OBJ", || write(&mesh, &found, Format::Obj).unwrap());
    phase("export, OFF", || write(&mesh, &found, Format::Off).unwrap());
}

/// From a file that an editor writes to the frame that the window shows: a mesh of some thousand faces, three steps.
fn edit() {
    trace::collect();
    let text = library::program("loop.vv").unwrap().text;
    let folder = std::env::temp_dir().join(format!("vv-bench-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("control.obj");
    let control = refined(&machine("loop.vv"), shipped("tetrapod.obj"), 2);
    let found = faces(&control, &Stop::new()).unwrap();
    std::fs::write(&path, write(&control, &found, Format::Obj).unwrap().0).unwrap();
    let (waker, awake) = mpsc::channel();
    let mut worker = Worker::start(evaluation::machine_limits(), 2 << 30, move || _ = waker.send(())).unwrap();
    let headless = Headless::new(4).ok();
    let mut rows: BTreeMap<&'static str, Vec<Duration>> = BTreeMap::new();
    let mut last = 0;
    for round in 0..ROUNDS + 2 {
        let recipe = Recipe {
            path: folder.join("loop.vv"),
            text: format!("{text}\n// {round}").into(),
            includes_revision: 0,
            mesh: MeshSource::File(path.clone()),
            mesh_revision: 0,
            rule: None,
            params: BTreeMap::new(),
        };
        trace::take();
        let began = Instant::now();
        let _ticket = worker.submit(Request { recipe: Arc::new(recipe), generation: 3 });
        let frame = wait(&worker, &awake);
        let computed = began.elapsed();
        let uploaded = headless.as_ref().map(|h| h.upload(&frame.scene).unwrap());
        let all = began.elapsed();
        drop(uploaded);
        last = frame.statistics.faces;
        if round < 2 {
            continue; // pages are fetched, the control mesh is read
        }
        let mut sums: BTreeMap<&'static str, Duration> = BTreeMap::new();
        trace::take().into_iter().for_each(|span| *sums.entry(span.name).or_default() += span.time);
        sums.into_iter().for_each(|(name, time)| rows.entry(name).or_default().push(time));
        rows.entry("request to frame").or_default().push(computed);
        rows.entry("request to frame on the GPU").or_default().push(all);
    }
    let file = folder.join("watched.vv");
    std::fs::write(&file, text).unwrap();
    let (waker, woken) = mpsc::channel();
    let mut watch = Watch::start(move || _ = waker.send(())).unwrap();
    watch.set_files([file.clone()]);
    for round in 0..ROUNDS {
        std::thread::sleep(Duration::from_millis(200 + 7 * round as u64)); // at any time between two looks
        let began = Instant::now();
        std::fs::write(&file, format!("{text}\n// {round}")).unwrap();
        while watch.change().is_none() {
            woken.recv_timeout(Duration::from_secs(60)).unwrap();
        }
        rows.entry("written to noticed").or_default().push(began.elapsed());
    }
    println!("an edit of the program: generation 3 of {} faces, {last} faces", found.len());
    for (name, mut times) in rows {
        show(name, &mut times);
    }
    drop(worker);
    let _ = std::fs::remove_dir_all(folder);
}

fn wait(worker: &Worker, awake: &mpsc::Receiver<()>) -> Arc<Frame> {
    loop {
        while let Some(report) = worker.report() {
            match report.event {
                Event::Finished(frame) => return frame,
                Event::Failed(failed) => panic!("{failed:?}"),
                _ => {}
            }
        }
        let _ = awake.recv_timeout(Duration::from_secs(60));
    }
}

fn refined(machine: &Machine, mut mesh: Mesh, steps: u64) -> Mesh {
    let rule = machine.program().default_rule().unwrap();
    for generation in 1..=steps {
        let settings = Settings::default();
        mesh = evaluation::advance(machine, rule, &mesh, generation, &settings, &mut Vec::new()).unwrap().mesh;
    }
    mesh
}

fn machine(name: &str) -> Machine {
    let (compilation, _) = files::compile(Path::new(name), library::program(name).unwrap().text);
    Machine::new(compilation.program.unwrap(), Engine::Native)
}

fn shipped(name: &str) -> Mesh {
    let text = library::MESHES.iter().find(|m| m.name == name).unwrap().text;
    read(text.as_bytes(), Format::Obj, &ReadOptions::default()).unwrap().0
}
