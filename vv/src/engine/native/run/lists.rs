//! Lists of vertices: variables of type ring, copies of rings that loops walk, faces.

use super::super::context::{CORNERS_AHEAD, Context, PADDING};
use super::{Run, guard, light, quiet, status, value_words, vertex};
use crate::engine::text;
use crate::mesh::faces::faces_of;
use crate::mesh::{Ring, Value, Vertex};

pub(super) type List = Vec<Option<Vertex>>;

const NO_LIST: u32 = u32::MAX;

/// Room that a new list has.
const FRESH: usize = 24 + PADDING;

impl Run<'_> {
    fn push_list(&mut self, vertices: &[Option<Vertex>]) -> Option<u32> {
        let mut list = self.spare_lists.pop().unwrap_or_default();
        list.clear();
        list.reserve(FRESH.max(vertices.len() + PADDING));
        list.extend_from_slice(vertices);
        self.lists.push(list);
        self.allows(0).then_some(self.lists.len() as u32 - 1)
    }

    /// Edits a list, which becomes longer by one at most.
    fn edit_list(&mut self, index: u32, edit: impl FnOnce(&mut List)) -> Option<u32> {
        let list = self.lists.get_mut(index as usize)?;
        if list.len() + 1 + PADDING > list.capacity() {
            list.reserve(list.len() + 1 + PADDING);
            self.allows(0).then_some(())?;
        }
        let list = self.lists.get_mut(index as usize)?;
        edit(list);
        i32::try_from(list.len()).ok()?;
        Some(status::DONE)
    }
}

/// Vertices that compiled code names, null for gaps.
fn vertices<'a>(start: *const Option<Vertex>, len: u32) -> &'a [Option<Vertex>] {
    // SAFETY: compiled code passes what it took from a list, a ring or a face, which stays where it is while the runtime
    // function that was called does not change that one.
    unsafe { std::slice::from_raw_parts(start, len as usize) }
}

/// A new variable of type ring.
pub(super) extern "C" fn list_new(context: *mut Context) -> u32 {
    guard(context, NO_LIST, |run| run.push_list(&[]))
}

/// A new list with these vertices.
pub(super) extern "C" fn list_copy(context: *mut Context, start: *const Option<Vertex>, len: u32) -> u32 {
    guard(context, NO_LIST, |run| run.push_list(vertices(start, len)))
}

/// Drops the lists from `count` on.
pub(super) extern "C" fn list_drop(context: *mut Context, count: u64) {
    guard(context, (), |run| {
        let dropped = run.lists.drain(count as usize..);
        // A few that are small are kept, for a function that has some is called again and again.
        run.spare_lists.extend(dropped.filter(|list| list.capacity() <= 4 * FRESH));
        run.spare_lists.truncate(16);
        Some(())
    });
}

/// `r = s`
pub(super) extern "C" fn list_assign(context: *mut Context, list: u32, start: *const Option<Vertex>, len: u32) -> u32 {
    guard(context, status::REPEAT, |run| {
        let old = run.lists.get(list as usize)?;
        if old.as_ptr() == start {
            return Some(status::DONE);
        }
        run.allows(4 * len as usize).then_some(())?;
        let list = run.lists.get_mut(list as usize)?;
        list.clear();
        list.reserve(len as usize + PADDING);
        list.extend_from_slice(vertices(start, len));
        Some(status::DONE)
    })
}

/// `add v to r`
pub(super) extern "C" fn list_push(context: *mut Context, list: u32, v: u32) -> u32 {
    guard(context, status::REPEAT, |run| run.edit_list(list, |list| list.push(vertex(v))))
}

/// `erase x from r`
pub(super) extern "C" fn list_erase(context: *mut Context, list: u32, x: u32) -> u32 {
    guard(context, status::REPEAT, |run| {
        run.edit_list(list, |list| {
            if let Some(at) = Ring::new(list).find(vertex(x)) {
                list.remove(at);
            }
        })
    })
}

/// `replace a with x in r`
pub(super) extern "C" fn list_replace(context: *mut Context, list: u32, a: u32, x: u32) -> u32 {
    guard(context, status::REPEAT, |run| {
        run.edit_list(list, |list| {
            if let Some(at) = Ring::new(list).find(vertex(a)) {
                list[at] = vertex(x);
            }
        })
    })
}

/// `splice x after a in r`
pub(super) extern "C" fn list_splice(context: *mut Context, list: u32, x: u32, a: u32, before: u32) -> u32 {
    guard(context, status::REPEAT, |run| {
        run.edit_list(list, |list| {
            if let Some(at) = Ring::new(list).find(vertex(a)) {
                let at = match (before, at) {
                    (0, at) => at + 1,
                    (_, 0) => list.len(),
                    (_, at) => at,
                };
                list.insert(at, vertex(x));
            }
        })
    })
}

/// Where a vertex stands first, -1 if it does not.
pub(super) extern "C" fn list_find(_: *mut Context, start: *const Option<Vertex>, len: u32, x: u32) -> i32 {
    quiet(-1, || i32::try_from(Ring::new(vertices(start, len)).find(vertex(x))?).ok())
}

/// Where `p` stands first, if `q` is not null where `q` follows; -1 if nowhere.
pub(super) extern "C" fn list_begin(_: *mut Context, start: *const Option<Vertex>, len: u32, p: u32, q: u32) -> i32 {
    quiet(-1, || {
        let slots = vertices(start, len);
        let follows = |i: usize| q == 0 || slots[if i + 1 == slots.len() { 0 } else { i + 1 }] == vertex(q);
        let i = (0..slots.len()).find(|&i| slots[i] == vertex(p) && follows(i))?;
        i32::try_from(i).ok()
    })
}

/// Keeps a list for the caller.
pub(super) extern "C" fn list_return(context: *mut Context, start: *const Option<Vertex>, len: u32) -> u32 {
    light(context, status::REPEAT, |run| {
        run.returned_list = vertices(start, len).to_vec();
        run.allows(0).then_some(status::DONE)
    })
}

/// The list that a call returned, as one of its own.
pub(super) extern "C" fn list_take(context: *mut Context) -> u32 {
    guard(context, NO_LIST, |run| {
        let list = std::mem::take(&mut run.returned_list);
        run.push_list(&list)
    })
}

/// Writes a list.
pub(super) extern "C" fn print_list(context: *mut Context, start: *const Option<Vertex>, len: u32) -> u32 {
    light(context, status::REPEAT, |run| {
        let line = run.lines.last_mut()?;
        line.push('{');
        for (i, &v) in vertices(start, len).iter().enumerate() {
            if i % 4096 == 0 && run.fixed.settings.stop.check().is_err() {
                return None;
            }
            line.push_str(if i > 0 { ", " } else { "" });
            text::push_value(line, Value::Vertex(v));
        }
        line.push('}');
        Some(status::DONE)
    })
}

/// Copies a ring that a loop walks while it is edited; where the copy begins is in the words.
pub(super) extern "C" fn walk(context: *mut Context, start: *const Option<Vertex>, len: u32) -> u32 {
    light(context, status::REPEAT, |run| {
        // SAFETY: the context is valid and compiled code waits.
        let count = unsafe { &mut (*run.context).walk_count };
        let depth = *count as usize;
        *count += 1;
        if run.walks.len() <= depth {
            run.walks.push(Vec::new());
        }
        let copy = run.walks.get_mut(depth)?;
        copy.clear();
        copy.extend_from_slice(vertices(start, len));
        let address = copy.as_ptr().addr();
        value_words(run)[0] = address as u64;
        run.allows(0).then_some(status::DONE)
    })
}

/// Begins to walk the faces of a set: addresses of their corners, of where they end, and of the end of that into the
/// words. The result is how many were walked before.
pub(super) extern "C" fn faces(context: *mut Context, set: u32) -> u64 {
    guard(context, u64::MAX, |run| {
        let members = &run.sets.get(set as usize)?.members;
        let faces = faces_of(&run.mesh, members, &run.fixed.settings.stop).ok()?;
        let (mut corners, ends) = faces.into_parts();
        let last = corners.last().copied();
        corners.extend(last.into_iter().flat_map(|v| std::iter::repeat_n(v, CORNERS_AHEAD)));
        corners.reserve(PADDING);
        let bounds = ends.as_ptr_range();
        let words = [corners.as_ptr().addr(), bounds.start.addr(), bounds.end.addr()];
        value_words(run)[..3].copy_from_slice(&words.map(|address| address as u64));
        run.walked_faces.push((corners, ends));
        run.allows(0).then_some(run.walked_faces.len() as u64 - 1)
    })
}

/// Ends walks: so many are left.
pub(super) extern "C" fn faces_end(context: *mut Context, count: u64) {
    light(context, (), |run| {
        run.walked_faces.truncate(count as usize);
        Some(())
    });
}
