//! Edge properties and mesh properties.

use super::{Context, Run, light, looking, status, value_of, value_words, vertex, words_in, words_of};

impl Run<'_> {
    pub(super) fn edge_words(&self, property: u32, p: u32, q: u32, old: bool) -> Option<[u64; 3]> {
        let column = *self.edge_columns.get(property as usize)?;
        let mesh = if old { &self.old } else { &self.mesh };
        let value = mesh.edge_value(column, vertex(p)?, vertex(q)?)?;
        words_of(value)
    }

    pub(super) fn edge_store(&mut self, property: u32, p: u32, q: u32) -> Option<()> {
        let column = *self.edge_columns.get(property as usize)?;
        let ty = self.mesh.edge_properties().get(column)?.default.ty();
        let value = value_of(ty, &value_words(self)[..3]);
        self.mesh.set_edge_value(column, vertex(p)?, vertex(q)?, value).then_some(())
    }
}

/// A mesh property, into the words.
pub(super) extern "C" fn mesh_load(context: *mut Context, set: u32, property: u32) -> u32 {
    looking(context, status::REPEAT, |run| {
        let value = *run.sets.get(set as usize)?.properties.get(property as usize)?;
        words_in(context)[..3].copy_from_slice(&words_of(value)?);
        Some(status::DONE)
    })
}

/// A mesh property, from the words.
pub(super) extern "C" fn mesh_store(context: *mut Context, set: u32, property: u32) -> u32 {
    light(context, status::REPEAT, |run| {
        let words = value_words(run);
        let slot = run.sets.get_mut(set as usize)?.properties.get_mut(property as usize)?;
        *slot = value_of(slot.ty(), &words[..3]);
        Some(status::DONE)
    })
}
