//! Labels at vertices and faces. Which ones is found on another thread for the camera of a moment before; meanwhile
//! those found last follow their vertices.

use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, TryRecvError};

use eframe::egui::Ui;
use glam::DVec2;
use vv::stop::{Stop, Stopped};

use super::overlay::Overlay;
use crate::annotate::Subject;
use crate::annotate::labels::{Label, Outlook, Placed, place};
use crate::trace;
use crate::worker::Frame;

/// The labels shown.
#[derive(Default)]
pub struct Labels {
    placed: Arc<[Placed]>,
    /// What they were found for.
    key: Option<Key>,
    finding: Option<Finding>,
}

#[derive(Clone)]
struct Key {
    frame: Arc<Frame>,
    label: Label,
    outlook: Outlook,
    /// Of what they are the numbers.
    colors: Option<usize>,
    indexed: bool,
}

impl PartialEq for Key {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.frame, &other.frame)
            && (&self.label, self.outlook, self.colors, self.indexed)
                == (&other.label, other.outlook, other.colors, other.indexed)
    }
}

struct Finding {
    key: Key,
    stop: Stop,
    result: Receiver<Vec<Placed>>,
}

impl Labels {
    /// Draws them and, if something has changed since they were found, begins to find others. `wake` is called, from
    /// another thread, when they are.
    pub fn show(
        &mut self,
        ui: &Ui,
        overlay: &Overlay<'_>,
        frame: &Arc<Frame>,
        (label, outlook): (&Label, Outlook),
        wake: &Arc<dyn Fn() + Send + Sync>,
    ) {
        if *label == Label::Nothing {
            *self = Self::default();
            return;
        }
        let subject = frame.subject();
        let key = Key {
            frame: Arc::clone(frame),
            label: label.clone(),
            outlook,
            colors: subject.tint.as_ref().map(|tint| Arc::as_ptr(tint) as usize),
            indexed: frame.scene.is_indexed(),
        };
        self.take();
        let is_same_mesh = |old: &Key| Arc::ptr_eq(&old.frame, frame) && old.label == *label;
        if !self.key.as_ref().is_some_and(is_same_mesh) {
            self.placed = Arc::default(); // they say nothing of this mesh
            self.key = None;
        }
        if let Some(finding) = self.finding.as_ref().filter(|finding| !is_same_mesh(&finding.key)) {
            finding.stop.request(Stopped::ByUser);
        }
        if self.finding.is_none() && self.key.as_ref() != Some(&key) {
            self.find(key, wake);
        }
        let color = ui.visuals().text_color();
        for placed in self.placed.iter() {
            overlay.tag(placed.at, &placed.text, color);
        }
    }

    fn take(&mut self) {
        let Some(finding) = &self.finding else { return };
        match finding.result.try_recv() {
            Ok(placed) => {
                self.key = self.finding.take().map(|finding| finding.key);
                self.placed = placed.into();
            }
            Err(TryRecvError::Disconnected) => self.finding = None,
            Err(TryRecvError::Empty) => {}
        }
    }

    fn find(&mut self, key: Key, wake: &Arc<dyn Fn() + Send + Sync>) {
        let (sender, result) = mpsc::channel();
        let stop = Stop::new();
        self.finding = Some(Finding { key: key.clone(), stop: stop.clone(), result });
        let (before, wake) = (Arc::clone(&self.placed), Arc::clone(wake));
        rayon::spawn(move || {
            let span = trace::span("labels");
            let Key { frame, label, outlook, .. } = key;
            let subject: Subject<'_> = frame.subject();
            if let Ok(placed) = place(&subject, &label, &outlook, &before, &stop) {
                let _ = sender.send(placed); // nobody waits after the window is closed
            }
            drop((span, sender, frame));
            wake();
        });
    }
}

/// From where a picture of this size, in points, is seen.
pub fn outlook(camera: crate::camera::Camera, style: crate::scene::Style, rect: eframe::egui::Rect) -> Outlook {
    Outlook { camera, style, size: DVec2::new(f64::from(rect.width()), f64::from(rect.height())) }
}
