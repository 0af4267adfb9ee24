//! Schemes that ship with vv, applied to the mesh that is shown, whatever it came from.

use std::sync::Arc;

use vv::diagnostic::Severity;

use super::Session;
use crate::command::Command;
use crate::document::{MeshSource, ProgramText};
use crate::library;

/// Results that a mesh may come from, one after the other: each is computed anew when a project is opened.
const MOST: usize = 30;

impl Session {
    /// Makes a scheme the program and steps it once on the mesh that is shown; only steps if it is the program already.
    pub(super) fn subdivide(&mut self, scheme: &'static str) {
        let Some(program) = library::program(scheme) else { return };
        let own = &self.document.program;
        if own.path.is_none() && own.name == program.name && *own.text == *program.text {
            return self.carry_out(Command::Step);
        }
        self.unless_unsaved(Command::Subdivide(scheme), |s| {
            let Some(source) = s.shown_mesh() else { return };
            if source.depth() > MOST {
                return s.say(Severity::Note, "so many programs follow each other: save the mesh and open it again");
            }
            s.set_program(ProgramText::new(program.name, program.text));
            s.playing = None;
            s.mesh_chosen = true;
            s.document.mesh = source;
            s.document.generation = 1;
            s.fit = false;
            s.watch_files();
        });
    }

    /// Where the mesh that is shown comes from.
    fn shown_mesh(&self) -> Option<MeshSource> {
        let request = &self.frame.as_ref()?.request;
        let starts = self.program.as_ref().is_some_and(|program| program.start.is_some());
        let is_input = request.generation == 0 && !starts;
        Some(if is_input { request.recipe.mesh.clone() } else { MeshSource::Result(Arc::new(request.clone())) })
    }
}
