//! Thousands of random commands: whatever comes, the session stays in order.

use std::sync::Arc;
use std::time::{Duration, Instant};

use app::camera::Camera;
use app::command::{Answer, Command, Inspect, MENUS, Panel, Reload, TextAction, ThemeChoice};
use app::document::MeshSource;
use app::inspect::selection::Item;
use app::preferences::Preferences;
use app::session::Session;
use vv::builtins::Random;
use vv::mesh::{Value, Vertex};

const TEXTS: [&str; 5] = [
    "void f(mesh& S) { forall v in S v$pos *= 0.5; }",
    "param double w = 0.5 in [0, 1];\nvoid f(mesh& S) { forall v in S v$pos *= w; print w; }\nvoid g(mesh& S) { }",
    "void f(mesh& S) { forall v in S v$pos *= ; }",
    "void f(mesh& S) { vertex v = null; v$pos = v$pos; }",
    "void start(mesh& S) { vertex v; add v to S; }",
];

/// Whether a command stays inside: neither opens dialogs of the system, nor writes files, nor ends it all.
fn stays_inside(command: &Command) -> bool {
    !matches!(command, Command::Choose(_) | Command::Save | Command::CopyImage | Command::Quit)
}

/// Any command: one of the menus, whatever stands there, or one that carries a value.
fn command(random: &mut Random) -> Command {
    let mut below = |n: u64| random.bits() % n;
    if below(3) == 0 {
        let all: Vec<_> = MENUS.iter().flat_map(|m| m.groups).copied().flatten().filter(|c| stays_inside(c)).collect();
        return all[below(all.len() as u64) as usize].clone();
    }
    let text = |i: u64| -> Arc<str> { TEXTS[i as usize % TEXTS.len()].into() };
    match below(34) {
        0 | 1 => Command::Step,
        2 => Command::Back,
        3 => Command::Rewind,
        4 => Command::End,
        5 => Command::GoTo(below(4)),
        6 => Command::Scrub(below(4)),
        7 => Command::Play,
        8 => Command::Stop,
        9 | 10 => Command::Undo,
        11 | 12 => Command::Redo,
        13 => Command::UndoText,
        14 => Command::RedoText,
        15 | 16 => Command::Edit(text(below(5))),
        17 => Command::Tune(text(below(5))),
        18 => Command::SetParam("w".to_owned(), Value::Double(below(5) as f64 / 4.0)),
        19 => Command::ResetParams,
        20 => Command::ChooseRule(["f", "g", "none"][below(3) as usize].to_owned()),
        21 => Command::UseMesh(MeshSource::BuiltIn(["cube.obj", "octahedron.obj"][below(2) as usize].to_owned())),
        22 => Command::UseMesh(MeshSource::Empty),
        23 if below(2) == 0 => Command::Exhibit { program: "koch.vv", keep_mesh: below(2) == 0 },
        23 => Command::OpenExample("loop.vv"),
        24 => Command::NewProgram,
        25 => Command::AnswerUnsaved(Answer::Discard),
        26 => Command::CloseDialog,
        27 => Command::Run,
        29..=32 => Command::Inspect(inspect(random)),
        28 => Command::SetReload([Reload::Typed, Reload::Saved, Reload::ByHand][below(3) as usize]),
        _ => match below(8) {
            0 => Command::Toggle(Panel::Timeline),
            1 => Command::SetTheme(ThemeChoice::Dark),
            2 => Command::Text(TextAction::Format),
            3 => Command::Palette,
            4 => Command::Smooth,
            5 if below(2) == 0 => {
                let preferences =
                    Preferences { memory: below(9) as usize, scale: below(9) as f32, ..Default::default() };
                Command::SetPreferences(preferences)
            }
            5 => Command::SetSpeed(60.0),
            6 => Command::Fit,
            _ => Command::Faces,
        },
    }
}

/// Looks at vertices that may be there or not.
fn inspect(random: &mut Random) -> Inspect {
    let mut below = |n: u64| random.bits() % n;
    let mut vertex = || Vertex::from_index((below(9) * below(9)) as usize).unwrap();
    let (p, q) = (vertex(), vertex());
    match below(14) {
        0 | 1 => Inspect::Select(Item::Vertex(p)),
        2 => Inspect::Select(Item::Edge([p, q])),
        3 => Inspect::Select(Item::Face([p, q])),
        4 => Inspect::Toggle(Item::Vertex(p)),
        5 => Inspect::Toggle(Item::Face([p, q])),
        6 => Inspect::SelectNumbers(vec![below(40), below(40)]),
        7 => Inspect::Fly,
        8 => Inspect::Walk([p, q]),
        9 => Inspect::WalkOn,
        10 => Inspect::WalkBack,
        11 => Inspect::PlayWalk,
        12 => Inspect::Point(Some(p)),
        _ => Inspect::ListProblems,
    }
}

#[track_caller]
fn in_order(session: &Session, after: &Command) {
    let document = &session.document;
    assert!(session.shown_generation() < 100, "{after:?}");
    if let Some(frame) = session.frame() {
        assert!(frame.statistics.valid, "{after:?}");
        // What is selected is there, and the walk leads through what is there.
        assert!(session.selected().iter().all(|item| item.is_in(&frame.mesh)), "{after:?}");
        if let Some(walking) = &session.inspection.walk {
            assert!((1..=walking.walk.arrows()).contains(&walking.at), "{after:?}");
            assert!(frame.mesh.set.contains(walking.walk.path[0]), "{after:?}");
        }
    }
    let Camera { pivot, distance, .. } = document.camera;
    assert!(pivot.is_finite() && distance > 0.0, "{after:?}");
    let style = document.style;
    assert!(style.faces || style.edges || style.vertices, "{after:?}: nothing is left to see");
    assert_eq!(session.preferences, session.preferences.sensible(), "{after:?}");
    assert!(!session.wants_quit(), "{after:?}");
    if let Some(beside) = session.beside() {
        assert!(!beside.views_linked || beside.session().aim() == session.aim(), "{after:?}: views part");
        assert!(beside.session().beside().is_none() && !beside.session().wants_quit(), "{after:?}");
    }
    // Every command can say what it is, and whether it makes sense.
    for command in MENUS.iter().flat_map(|m| m.groups).copied().flatten() {
        let _ = (command.is_enabled(session), command.is_on(session));
    }
}

/// Lets it come to rest.
fn settle(session: &mut Session) {
    let began = Instant::now();
    while session.is_busy() || session.is_playing() {
        session.poll();
        assert!(began.elapsed() < Duration::from_secs(60), "never comes to rest");
        std::thread::sleep(Duration::from_millis(1));
    }
}

#[test]
fn random_commands_leave_the_session_in_order() {
    for seed in 0..4 {
        let mut random = Random::new(seed, 0);
        let mut session = Session::new(None, None, None, Arc::new(|| {})).unwrap();
        for _ in 0..800 {
            let command = command(&mut random);
            session.apply(command.clone());
            if random.bits().is_multiple_of(3) {
                session.poll();
            }
            in_order(&session, &command);
            // Generations of loop.vv grow fast, and those of schemes one after the other.
            if session.document.generation > 4 {
                session.apply(Command::Rewind);
            }
            if session.frame().is_some_and(|frame| frame.statistics.vertices > 3000) {
                session.apply(Command::UseMesh(MeshSource::BuiltIn("cube.obj".to_owned())));
                session.apply(Command::Rewind);
            }
        }
        session.apply(Command::Stop);
        settle(&mut session);
        // All the way back and forth again: the same document.
        let document = session.document.clone();
        let mut count = 0;
        while session.can_undo() {
            session.apply(Command::Undo);
            count += 1;
        }
        for _ in 0..count {
            session.apply(Command::Redo);
        }
        let (now, then) = (&session.document, &document);
        assert_eq!(now.program.text, then.program.text);
        assert_eq!((&now.mesh, &now.rule, &now.params), (&then.mesh, &then.rule, &then.params));
        assert_eq!(now.generation, then.generation);
    }
}

#[test]
fn what_was_undone_last_is_done_again_first() {
    let mut session = Session::new(None, None, None, Arc::new(|| {})).unwrap();
    session.apply(Command::SetParam("w".to_owned(), Value::Double(0.5)));
    session.apply(Command::Undo);
    session.apply(Command::Edit(TEXTS[0].into()));
    session.apply(Command::Undo);
    session.apply(Command::Redo);
    assert_eq!(&*session.document.program.text, TEXTS[0]);
    assert!(session.document.params.is_empty());
    session.apply(Command::Redo);
    assert!(!session.document.params.is_empty());
}
