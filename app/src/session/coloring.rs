//! Finds what is to be shown on the surface, beside the window's thread and the worker's.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use image::RgbaImage;
use vv::stop::{Stop, Stopped};

use super::Session;
use crate::annotate::cell::Colors;
use crate::annotate::{Annotations, ArrowSet, Arrows, Label, Quantity};
use crate::camera::Camera;
use crate::command::Command;
use crate::figure::{self, Notes};
use crate::render::{Dressing, RenderError, Size, render_image};
use crate::scene::Style;
use crate::trace;
use crate::worker::Frame;

/// What is being found, and for whom.
#[derive(Default)]
pub(super) struct Finding {
    current: Option<Current>,
    /// What the worker was told last.
    told: Annotations,
}

struct Current {
    frame: Arc<Frame>,
    quantity: Quantity,
    stop: Stop,
    done: Arc<AtomicBool>,
}

/// The picture of a frame with all that is asked for on it; for another thread than the window's.
pub(super) fn drawn(
    frame: &Frame,
    (asked, notes): (&Annotations, &Notes),
    camera: &Camera,
    style: &Style,
    size: Size,
) -> Result<RgbaImage, RenderError> {
    frame.colors.find(&frame.subject(), asked, &Stop::new());
    let tint = frame.colors.colors(&asked.color_by).and_then(Result::ok);
    let arrows = frame.colors.arrows(&asked.arrows);
    let dressing =
        Dressing { tint: tint.as_deref(), arrows: arrows.as_deref().map(|arrows| (arrows, asked.arrow_length)) };
    let mut image = render_image(&frame.scene, dressing, camera, style, size)?;
    let (mesh, faces) = (&frame.mesh, &frame.faces);
    let subject = figure::Subject { scene: &frame.scene, mesh, faces, tint: tint.as_deref(), notes };
    figure::write_on(&mut image, subject, camera, style, size.scale);
    Ok(image)
}

impl Session {
    /// The colours that are asked for of the frame shown; `None` while they are not found, and where none are. Of those
    /// in another range than asked for the ones that were found last.
    #[must_use]
    pub fn colors(&self) -> Option<Colors> {
        let quantity = &self.document.annotations.color_by;
        self.frame.as_ref().filter(|_| *quantity != Quantity::Plain)?.colors.colors(quantity)
    }

    /// The arrows that are asked for of the frame shown; `None` while they are not found.
    #[must_use]
    pub fn arrows(&self) -> Option<Arc<ArrowSet>> {
        self.frame.as_ref()?.colors.arrows(&self.document.annotations.arrows)
    }

    /// Carries out what concerns them; what is asked for again is gone.
    pub(super) fn annotate(&mut self, command: Command) {
        let annotations = &mut self.document.annotations;
        match command {
            Command::SetAnnotations(all) => *annotations = all,
            Command::ColorBy(quantity) if annotations.color_by != quantity => {
                (annotations.color_by, annotations.range) = (quantity, None);
            }
            Command::LabelBy(label) if annotations.labels == label => annotations.labels = Label::Nothing,
            Command::LabelBy(label) => annotations.labels = label,
            Command::ArrowsOf(arrows) if annotations.arrows == arrows => annotations.arrows = Arrows::Nothing,
            Command::ArrowsOf(arrows) => annotations.arrows = arrows,
            _ => {}
        }
    }

    /// Begins to find what is asked for and not known. What was asked for before is stopped.
    pub(super) fn color(&mut self) {
        let asked = &self.document.annotations;
        if self.finding.told != *asked {
            self.finding.told.clone_from(asked);
            self.worker.annotate(asked);
        }
        if let Some(current) = &self.finding.current {
            if !current.done.load(Ordering::Acquire) {
                let wanted = self.frame.as_ref().is_some_and(|f| Arc::ptr_eq(f, &current.frame));
                if !wanted || current.quantity != asked.color_by {
                    current.stop.request(Stopped::ByUser);
                }
                return; // it wakes us
            }
            self.finding.current = None;
        }
        let Some(frame) = self.frame.as_ref().filter(|frame| !frame.colors.answers(asked)) else { return };
        let (done, stop) = (Arc::new(AtomicBool::new(false)), Stop::new());
        self.finding.current = Some(Current {
            frame: Arc::clone(frame),
            quantity: asked.color_by.clone(),
            stop: stop.clone(),
            done: Arc::clone(&done),
        });
        let (frame, asked, wake) = (Arc::clone(frame), asked.clone(), Arc::clone(&self.wake));
        rayon::spawn(move || {
            let span = trace::span("colours");
            frame.colors.find(&frame.subject(), &asked, &stop);
            drop((span, frame));
            done.store(true, Ordering::Release);
            wake();
        });
    }
}
