//! The mask of the selected vertex, measured beside the window's thread and the worker's.

use std::path::Path;
use std::sync::mpsc::{self, Receiver, TryRecvError};
use std::sync::{Arc, Weak};
use std::time::{Duration, Instant};

use vv::diagnostic::Severity;
use vv::engine::{Failure, FailureKind};
use vv::mesh::Vertex;
use vv::stop::{Stop, Stopped};

use super::Session;
use crate::figure::{self, Page, Settings, Tile};
use crate::inspect::mask::Mask;
use crate::inspect::selection::Item;
use crate::worker::{Frame, release};
use crate::{files, trace, typed_path};

/// Then it is given up.
const LIMIT: Duration = Duration::from_secs(60);

/// Millimetres that the figure of a mask is wide.
const PAGE: f64 = 85.0;

/// The mask of what is selected, or why there is none.
#[derive(Debug, Clone)]
pub enum MaskState {
    /// Nobody wants it.
    Off,
    /// Not one vertex is selected.
    NoVertex,
    /// No step made the generation that is shown.
    NoStep,
    /// The generation before is not kept.
    NotKept,
    /// It is being measured, for so long.
    Measuring(Duration),
    /// There it is.
    Found(Arc<Mask>),
    /// It could not be measured, or was stopped.
    Failed(String),
}

/// What is being measured, and what was measured last.
#[derive(Default)]
pub(super) struct Weighing {
    current: Option<Current>,
    last: Option<(Of, Result<Arc<Mask>, String>)>,
}

/// A vertex of a frame.
#[derive(Clone)]
struct Of {
    frame: Weak<Frame>,
    vertex: Vertex,
}

struct Current {
    of: Of,
    stop: Stop,
    since: Instant,
    result: Receiver<Result<Mask, String>>,
}

impl Of {
    fn is(&self, frame: &Arc<Frame>, vertex: Vertex) -> bool {
        std::ptr::eq(self.frame.as_ptr(), Arc::as_ptr(frame)) && self.vertex == vertex
    }
}

impl Session {
    /// Draws the mask of the selected vertex into a file, alone on a page.
    pub(super) fn mask_to(&mut self, path: &Path) -> Result<(), String> {
        let (MaskState::Found(mask), Some(frame)) = (self.mask(), self.frame.clone()) else {
            return Err("no mask is shown".to_owned());
        };
        let extension = path.extension().unwrap_or_default().to_string_lossy();
        let (Some(format), Some(old)) = (figure::Format::from_extension(&extension), &frame.before) else {
            return Err("the name of a figure ends in .svg, .eps or .pdf".to_owned());
        };
        let weights: Vec<(Vertex, f64)> = mask.weights().map(|(v, group)| (v, group.weight)).collect();
        let asked = self.figure_settings();
        // A mask is a small thing, unless a style says how large.
        let page = if self.style_file.page.is_some() { asked.page } else { Page { width: PAGE, height: None } };
        let settings = Settings { page, ..asked };
        let sketch = Some(figure::mask_on(old, &weights, settings.letters));
        let Some(drawing) = figure::sheet(vec![Tile { sketch, caption: String::new() }], Some(1), &settings) else {
            return Err("nothing of the mask is seen".to_owned());
        };
        files::write(path, &figure::write(&drawing, format)).map_err(|error| error.diagnostic.message.clone())?;
        self.say(Severity::Note, format!("saved {}", typed_path::shown(path)));
        Ok(())
    }

    /// The mask of the vertex that is selected.
    #[must_use]
    pub fn mask(&self) -> MaskState {
        let (frame, v) = match self.to_weigh() {
            Ok(wanted) => wanted,
            Err(why) => return why,
        };
        match (&self.weighing.last, &self.weighing.current) {
            (Some((of, Ok(mask))), _) if of.is(frame, v) => MaskState::Found(Arc::clone(mask)),
            (Some((of, Err(why))), _) if of.is(frame, v) => MaskState::Failed(why.clone()),
            (_, Some(current)) if current.of.is(frame, v) => MaskState::Measuring(current.since.elapsed()),
            _ => MaskState::Measuring(Duration::ZERO),
        }
    }

    /// The one vertex whose mask is wanted and can be measured.
    fn to_weigh(&self) -> Result<(&Arc<Frame>, Vertex), MaskState> {
        let (true, Some(frame)) = (self.inspection.mask, &self.frame) else { return Err(MaskState::Off) };
        let [Item::Vertex(v)] = self.selected()[..] else { return Err(MaskState::NoVertex) };
        if frame.made.is_none() {
            return Err(MaskState::NoStep);
        }
        if frame.before.is_none() {
            return Err(MaskState::NotKept);
        }
        Ok((frame, v))
    }

    /// Begins to measure what is wanted and not known; stops what is not wanted any more. Returns when to call again.
    pub(super) fn weigh(&mut self) -> Option<Instant> {
        let wanted = self.to_weigh().ok().map(|(frame, v)| (Arc::clone(frame), v));
        if let Some(current) = &self.weighing.current {
            let result = match current.result.try_recv() {
                Ok(result) => result,
                Err(TryRecvError::Empty) => {
                    if !wanted.as_ref().is_some_and(|(frame, v)| current.of.is(frame, *v)) {
                        current.stop.request(Stopped::ByUser);
                    } else if current.since.elapsed() > LIMIT {
                        current.stop.request(Stopped::ByTime);
                    }
                    // It wakes us at its end; until then the time is shown.
                    return Some(Instant::now() + Duration::from_millis(100));
                }
                Err(TryRecvError::Disconnected) => {
                    Err("vv itself failed here, which is a mistake in vv; the window goes on".to_owned())
                }
            };
            // What was stopped because something else was wanted may be wanted again.
            if current.stop.check() != Err(Stopped::ByUser) {
                let last = self.weighing.last.replace((current.of.clone(), result.map(Arc::new)));
                release(last); // a mask may have as many weights as the mesh has vertices
            }
            self.weighing.current = None;
        }
        let (frame, vertex) = wanted?;
        let known = self.weighing.last.as_ref().is_some_and(|(of, _)| of.is(&frame, vertex));
        // What comes next has the machine to itself.
        if known || self.is_busy() || self.is_playing() {
            return None;
        }
        let of = Of { frame: Arc::downgrade(&frame), vertex };
        let (sender, result) = mpsc::channel();
        let (stop, wake) = (Stop::new(), Arc::clone(&self.wake));
        let flag = stop.clone();
        // Programs may call themselves as deep as on the worker's thread.
        let thread = std::thread::Builder::new().name("mask".to_owned()).stack_size(8 << 20).spawn(move || {
            let span = trace::span("mask");
            let measured = Mask::measure(&frame, vertex, &flag);
            drop((span, frame));
            let result = match measured {
                Some(Ok(mask)) => Ok(mask),
                Some(Err(Failure { kind: FailureKind::Stopped(Stopped::ByTime), .. })) => Err(format!(
                    "given up after {} s: the step takes too long to be run again and again",
                    LIMIT.as_secs()
                )),
                Some(Err(failure)) => Err(failure.diagnostic.message),
                None => Err("there is no step to measure".to_owned()),
            };
            let _ = sender.send(result);
            wake();
        });
        if let Err(error) = thread {
            self.weighing.last = Some((of, Err(error.to_string())));
            return None;
        }
        self.weighing.current = Some(Current { of, stop, since: Instant::now(), result });
        Some(Instant::now() + Duration::from_millis(100))
    }
}

impl Drop for Current {
    fn drop(&mut self) {
        self.stop.request(Stopped::ByUser);
    }
}
