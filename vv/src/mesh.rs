//! The rotation system: a universe of vertices in order of creation, the ring of each, a set of them, and properties.
//!
//! ```text
//!   universe   v1  v2  v3  …            handles, ordered by creation
//!   heads      ●   ●   ●                where each ring lies in the arena
//!   slots      [v2 v5 v3 ∅ | v1 v4 … ]  rings counter-clockwise seen from outside, ∅ marks a gap
//!   columns    positions, properties    one value per vertex, or per slot for edges
//! ```
//!
//! All arrays are flat and copied only when written while shared: [`Mesh::clone`] costs a few pointers, and two meshes
//! share every array that neither has written since. Undo states, snapshots and what a worker hands to the window are
//! clones.
//!
//! A **gap** is the place in a ring where the surface is missing. Rings keep these invariants, whatever is done to them:
//! no vertex twice, never the vertex itself, no two gaps side by side (the list is cyclic), `{∅}` is `{}`, and a ring
//! with gaps ends in one — so its start, the slot at index 0, follows its *first* gap.

pub mod build;
pub mod close;
mod column;
pub mod faces;
mod finder;
pub mod inherit;
pub mod isomorphism;
mod members;
mod property;
mod ring;
mod set;
pub mod statistics;
mod survey;
pub mod triangulate;
pub mod validate;

use std::fmt;
use std::num::NonZeroU32;

use glam::DVec3;

pub use column::Column;
pub(crate) use column::spare;
pub use property::{Property, Type, Value, Values};
pub use ring::{EditError, Ring};
pub use set::VertexSet;

use members::Members;
use ring::Rings;
pub(crate) use ring::{FRESH_CAPACITY, Head, PADDING};

/// A vertex of the universe. Vertices compare in order of creation, and `None < Some(v)`: null comes first.
#[repr(transparent)]
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Vertex(NonZeroU32);

impl Vertex {
    /// The vertex at `index` (from 0) in order of creation; `None` past the largest handle.
    #[must_use]
    pub fn from_index(index: usize) -> Option<Self> {
        u32::try_from(index).ok()?.checked_add(1).and_then(NonZeroU32::new).map(Self)
    }

    /// Place in the order of creation, from 0: the index into every per-vertex array.
    #[must_use]
    pub fn index(self) -> usize {
        self.0.get() as usize - 1
    }
}

/// `v1` is the first vertex, as in the lines of an OBJ file.
impl fmt::Display for Vertex {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "v{}", self.0)
    }
}

impl fmt::Debug for Vertex {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// More vertices or ring entries than a `u32` can number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the mesh has no room for more than 4 billion vertices or neighbours")]
pub struct Full;

/// The arrays of a universe: one head, position and value of each vertex property per vertex, one value of each edge
/// property per slot.
pub(crate) struct Arrays<'a> {
    pub(crate) heads: &'a mut Column<Head>,
    pub(crate) slots: &'a mut Column<Option<Vertex>>,
    pub(crate) positions: &'a mut Column<DVec3>,
    pub(crate) vertex_properties: &'a mut [Property],
    pub(crate) edge_properties: &'a mut [Property],
}

/// A vertex–vertex rotation system with positions and properties, and the vertex set `S` that rules receive.
#[derive(Debug, Clone, Default)]
pub struct Mesh {
    rings: Rings,
    positions: Column<DVec3>,
    vertex_properties: Vec<Property>,
    mesh_properties: Vec<(String, Value)>,
    /// The vertex set a rule receives as `S`, in the order in which its vertices were added.
    pub set: VertexSet,
}

impl Mesh {
    /// An empty universe.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// How many vertices the universe has, members of [`Mesh::set`] or not.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.rings.len()
    }

    /// All vertices of the universe in order of creation.
    pub fn vertices(&self) -> impl Iterator<Item = Vertex> + use<> {
        (0..self.rings.len()).filter_map(Vertex::from_index)
    }

    /// Bytes held by the arrays, shared ones counted in full.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.rings.bytes()
            + self.positions.bytes()
            + self.vertex_properties.iter().map(|p| p.values.bytes()).sum::<usize>()
            + self.set.bytes()
    }

    /// Vertices at these positions, all in the set, whose rings are empty and have room for so many neighbours and gaps,
    /// one after the other.
    pub(crate) fn with_room(positions: Vec<DVec3>, lens: &[u32]) -> Result<Self, Full> {
        let rings = Rings::with_room(lens)?;
        let set = VertexSet::first(positions.len());
        Ok(Self { rings, positions: positions.into(), set, ..Self::default() })
    }

    /// Creates a vertex with an empty ring at the origin, its properties at their defaults. It joins no set.
    ///
    /// # Errors
    /// [`Full`] when handles run out.
    pub fn create(&mut self) -> Result<Vertex, Full> {
        let v = self.rings.create()?;
        self.positions.edit().push(DVec3::ZERO);
        for property in &mut self.vertex_properties {
            property.values.push(property.default);
        }
        Ok(v)
    }

    /// The ring of `v`: its neighbours counter-clockwise seen from outside.
    #[must_use]
    pub fn ring(&self, v: Vertex) -> Ring<'_> {
        self.rings.ring(v)
    }

    /// `make {items} nb_of v` (Table 2): the whole ring at once, `None` for gaps. Edge values of neighbours that stay
    /// are kept. Cost: O(|items|²) below some thirty items, O(|items|) expected above.
    ///
    /// # Errors
    /// Where `v` is among the items or a vertex is there twice; the ring is then as before.
    pub fn make(&mut self, v: Vertex, items: &[Option<Vertex>]) -> Result<(), EditError> {
        self.rings.make(v, items)
    }

    /// `erase x from v` (Table 2); `None` erases the first gap. No effect if it is not there. O(valence).
    pub fn erase(&mut self, x: Option<Vertex>, v: Vertex) {
        self.rings.erase(x, v);
    }

    /// `replace a with x in v` (Table 2), in place, an edge value stays with its slot; `None` is a gap on either side.
    /// No effect if `a` is not there or `x = a`. O(valence).
    ///
    /// # Errors
    /// If `x` is `v` or stands in the ring already; the ring is then as before.
    pub fn replace(&mut self, a: Option<Vertex>, x: Option<Vertex>, v: Vertex) -> Result<(), EditError> {
        self.rings.replace(a, x, v)
    }

    /// `splice x after a in v` (Table 2); `None` is a gap on either side. No effect if `a` is not there, or for a
    /// second gap beside a gap. O(valence).
    ///
    /// # Errors
    /// If `x` is `v` or stands in the ring already; the ring is then as before.
    pub fn splice_after(&mut self, x: Option<Vertex>, a: Option<Vertex>, v: Vertex) -> Result<(), EditError> {
        self.rings.splice(x, a, v, ring::Side::After)
    }

    /// `splice x before a in v` (Table 2), as [`Mesh::splice_after`]; before the start of the ring appends at its end.
    ///
    /// # Errors
    /// If `x` is `v` or stands in the ring already; the ring is then as before.
    pub fn splice_before(&mut self, x: Option<Vertex>, a: Option<Vertex>, v: Vertex) -> Result<(), EditError> {
        self.rings.splice(x, a, v, ring::Side::Before)
    }

    /// Position of `v`.
    #[must_use]
    pub fn position(&self, v: Vertex) -> DVec3 {
        self.positions.get(v.index()).copied().unwrap_or(DVec3::ZERO)
    }

    /// Positions of all vertices of the universe.
    #[must_use]
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// Moves `v`.
    pub fn set_position(&mut self, v: Vertex, position: DVec3) {
        if let Some(p) = self.positions.edit().get_mut(v.index()) {
            *p = position;
        }
    }

    /// The vertex properties: one column each.
    #[must_use]
    pub fn vertex_properties(&self) -> &[Property] {
        &self.vertex_properties
    }

    /// The edge properties: one column each, parallel to the ring slots. Read them with [`Mesh::edge_value`].
    #[must_use]
    pub fn edge_properties(&self) -> &[Property] {
        &self.rings.properties
    }

    /// Declares a vertex property and returns its index. One of the same name, as of an earlier step or a file, keeps its
    /// values and takes the new default for vertices to come; one of another type is converted
    /// ([`Values::converted`]) or else replaced.
    pub fn declare_vertex_property(&mut self, name: &str, default: Value) -> usize {
        let n = self.vertex_count();
        property::declare(&mut self.vertex_properties, name, default, n)
    }

    /// Declares an edge property and returns its index, as [`Mesh::declare_vertex_property`].
    pub fn declare_edge_property(&mut self, name: &str, default: Value) -> usize {
        let n = self.rings.slot_count();
        property::declare(&mut self.rings.properties, name, default, n)
    }

    /// Declares a property of the mesh as a whole (of the set `S`) and returns its index; one of the same name keeps its
    /// value, converted as in [`Mesh::declare_vertex_property`].
    pub fn declare_mesh_property(&mut self, name: &str, default: Value) -> usize {
        if let Some(i) = self.mesh_properties.iter().position(|(n, _)| n == name) {
            let value = &mut self.mesh_properties[i].1;
            if value.ty() != default.ty() {
                let converted = Values::filled(*value, 1).converted(default.ty());
                *value = converted.and_then(|values| values.get(0)).unwrap_or(default);
            }
            return i;
        }
        self.mesh_properties.push((name.to_owned(), default));
        self.mesh_properties.len() - 1
    }

    /// Names and values of the properties of the mesh as a whole.
    #[must_use]
    pub fn mesh_properties(&self) -> &[(String, Value)] {
        &self.mesh_properties
    }

    /// Sets the mesh property at `index`; no effect for a value of another type.
    pub fn set_mesh_value(&mut self, index: usize, value: Value) {
        if let Some((_, v)) = self.mesh_properties.get_mut(index)
            && v.ty() == value.ty()
        {
            *v = value;
        }
    }

    /// Value of vertex property `property` at `v`; its default for a vertex of another universe, `None` for a property
    /// that is not declared.
    #[must_use]
    pub fn vertex_value(&self, property: usize, v: Vertex) -> Option<Value> {
        let property = self.vertex_properties.get(property)?;
        Some(property.values.get(v.index()).unwrap_or(property.default))
    }

    /// Sets vertex property `property` at `v`; no effect for a value of another type.
    pub fn set_vertex_value(&mut self, property: usize, v: Vertex, value: Value) {
        if let Some(property) = self.vertex_properties.get_mut(property) {
            property.values.set(v.index(), value);
        }
    }

    /// Value of edge property `property` between `p` and `q`: what stands at the older end, at the other if the older
    /// does not name its neighbour, `None` if neither does.
    #[must_use]
    pub fn edge_value(&self, property: usize, p: Vertex, q: Vertex) -> Option<Value> {
        self.rings.edge_value(property, p, q)
    }

    /// The neighbours of `v` from the start of its ring with the values of edge property `property` that stand at `v`:
    /// those of the edge where `v` is the older end. Nothing for a property that is not declared. O(valence) for all.
    pub fn edge_values(&self, property: usize, v: Vertex) -> impl Iterator<Item = (Vertex, Value)> + '_ {
        let values = self.rings.properties.get(property).map(|property| &property.values);
        let offset = self.heads().get(v.index()).map_or(0, |head| head.offset as usize);
        let slots = self.ring(v).slots().iter().zip(offset..);
        slots.filter_map(move |(&x, slot)| Some((x?, values?.get(slot)?)))
    }

    /// Sets edge property `property` at both ends; whether there was an end to set it at.
    pub fn set_edge_value(&mut self, property: usize, p: Vertex, q: Vertex, value: Value) -> bool {
        self.rings.set_edge_value(property, p, q, value)
    }

    /// Gives `copy[v]` the ring, position and properties that `v` has here. `copy` must be a clone of an earlier state
    /// of this mesh; it grows as far as needed. This is the general half of `synchronize`; the fast half is `clone`.
    ///
    /// # Errors
    /// [`Full`] when the copy's arena runs out.
    pub fn copy_vertex_into(&self, v: Vertex, copy: &mut Self) -> Result<(), Full> {
        while copy.vertex_count() <= v.index() {
            copy.create()?;
        }
        copy.rings.copy_from(&self.rings, v)?;
        copy.set_position(v, self.position(v));
        for (to, from) in copy.vertex_properties.iter_mut().zip(&self.vertex_properties) {
            if let Some(value) = from.values.get(v.index()) {
                to.values.set(v.index(), value);
            }
        }
        Ok(())
    }

    pub(crate) fn heads(&self) -> &[Head] {
        self.rings.heads()
    }

    /// The arena of the rings; what no head names means nothing.
    pub(crate) fn slots(&self) -> &[Option<Vertex>] {
        self.rings.slots()
    }

    /// The arrays themselves, unshared, for code that keeps their invariants itself.
    pub(crate) fn arrays(&mut self) -> Arrays<'_> {
        let (heads, slots, edge_properties) = self.rings.arrays();
        Arrays {
            heads,
            slots,
            positions: &mut self.positions,
            vertex_properties: &mut self.vertex_properties,
            edge_properties,
        }
    }

    /// Keeps the vertices of [`Mesh::set`], renumbered densely in order of creation; entries of rings that name others
    /// become gaps, properties that name them null. Returns how many were forgotten.
    ///
    /// Cost: nothing where the set is the whole universe. Where it is all vertices from one on, these move to the beginning
    /// of the arrays; else rings are laid out anew in order.
    pub fn keep_only_set(&mut self) -> usize {
        let n = self.vertex_count();
        let from = self.set.is_all_from(n);
        let members = from.map_or_else(|| self.set.iter().filter(|v| v.index() < n).count(), |first| n - first);
        let forgotten = n - members;
        if forgotten == 0 && self.set.len() == members {
            return 0;
        }
        if let Some(first) = from {
            self.keep_from(first);
            return forgotten;
        }
        let is_member = Members::new(&self.set, n);
        let mut kept = vec![None; n];
        let mut count = 0;
        for v in self.vertices() {
            if is_member.contains(v) {
                kept[v.index()] = Vertex::from_index(count);
                count += 1;
            }
        }
        let rename = |v: Vertex| kept.get(v.index()).copied().flatten();
        self.rings = self.rings.keep(rename);
        let flags: Vec<bool> = kept.iter().map(Option::is_some).collect();
        self.positions = Column::from(
            self.positions.iter().zip(&flags).filter(|&(_, &keep)| keep).map(|(&p, _)| p).collect::<Vec<_>>(),
        );
        for property in &mut self.vertex_properties {
            property.values = property.values.keep(&flags);
        }
        self.rename(rename);
        forgotten
    }

    /// Forgets the vertices before one.
    fn keep_from(&mut self, first: usize) {
        self.rings.keep_from(first);
        self.positions.drop_first(first);
        for property in &mut self.vertex_properties {
            property.values.drop_first(first);
        }
        self.rename(|v| Vertex::from_index(v.index().checked_sub(first)?));
    }

    /// Renames the vertices that properties and the set name.
    fn rename(&mut self, name: impl Fn(Vertex) -> Option<Vertex>) {
        for property in self.vertex_properties.iter_mut().chain(&mut self.rings.properties) {
            property.values.rename(&name);
        }
        for (_, value) in &mut self.mesh_properties {
            if let Value::Vertex(v) = value {
                *v = v.and_then(&name);
            }
        }
        self.set = self.set.renamed(name);
    }
}
