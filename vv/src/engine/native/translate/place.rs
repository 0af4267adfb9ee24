//! Places: what can be read and stored to.

use cranelift_codegen::ir::{InstBuilder, MemFlagsData, Value, types};

use super::known::{Fact, Key};
use super::{Storage, Symbol, Translated, Translator, Val, wrong_type};
use crate::engine::native::Mutation;
use crate::engine::native::context;
use crate::engine::native::parallel::Column;
use crate::ir::{Compound, Expr, ExprKind, Item, LocalId, Place, Ring, Step, StepPosition};
use crate::mesh::Type;

/// A place whose operands are computed.
#[derive(Debug, Clone, Copy)]
pub(super) enum Target {
    Local(LocalId),
    Position { v: Value, old: bool },
    Vertex { property: u32, v: Value, old: bool },
    Edge { property: u32, ends: [Value; 2], old: bool },
    Mesh { property: u32, set: Value },
}

/// A place, and the coordinate of it that is meant.
pub(super) type Spot = (Target, Option<u8>);

impl<'p> Translator<'_, 'p> {
    pub(super) fn load(&mut self, place: &'p Place) -> Translated<Val> {
        let spot = match self.prepared.pop_front() {
            Some(spot) => spot,
            None => self.target(place)?,
        };
        self.read(spot)
    }

    /// Computes the operands of a place.
    pub(super) fn target(&mut self, place: &'p Place) -> Translated<Spot> {
        Ok(match place {
            Place::Local(local) => (Target::Local(*local), None),
            Place::Position { vertex, old } => (Target::Position { v: self.owner(vertex, *old)?, old: *old }, None),
            Place::VertexProperty { property, vertex, old } => {
                let v = self.owner(vertex, *old)?;
                (Target::Vertex { property: *property, v, old: *old }, None)
            }
            Place::EdgeProperty { property, ends: [p, q], old } => {
                let ends = [self.owner(p, *old)?, self.owner(q, *old)?];
                (Target::Edge { property: *property, ends, old: *old }, None)
            }
            Place::MeshProperty { property, set } => {
                (Target::Mesh { property: *property, set: self.set_of(*set)? }, None)
            }
            Place::Coordinate(base, axis) => (self.target(base)?.0, Some(*axis)),
        })
    }

    /// The vertex whose value is meant: not null, and with an old value if that is meant.
    fn owner(&mut self, e: &'p Expr, old: bool) -> Translated<Value> {
        let v = self.vertex(e)?;
        if old {
            self.held(v)?;
        } else {
            self.not_null(v);
        }
        Ok(v)
    }

    /// Computes the operands of all places that a value reads, if nothing but reading and arithmetic is in it: so that
    /// what is read is read when all is there, and need not be kept meanwhile.
    pub(super) fn prepare(&mut self, e: &'p Expr) -> Translated<()> {
        let mut places = Vec::new();
        if gather_places(e, &mut places) && places.len() > 1 {
            let spots: Translated<Vec<Spot>> = places.into_iter().map(|place| self.target(place)).collect();
            self.prepared = spots?.into();
        }
        Ok(())
    }

    pub(super) fn read(&mut self, (target, axis): Spot) -> Translated<Val> {
        let whole = match target {
            Target::Local(local) => self.read_local(local)?,
            Target::Position { .. } | Target::Vertex { .. } => {
                self.see_target(target, false);
                let (ty, flags, address) = self.address(target)?;
                if let (Type::Vec, Some(axis)) = (ty, axis) {
                    let x = self.b.ins().load(types::F64, flags, address, 8 * i32::from(axis.min(2)));
                    return Ok(Val::One(x));
                }
                self.load_value(ty, flags, address, 0)
            }
            Target::Edge { property, ends: [p, q], old } => {
                let ty = self.program.edge_properties.get(property as usize).ok_or_else(wrong_type)?.default.ty();
                let (number, of_old) = (self.int32(property), self.int32(u32::from(old)));
                self.call_or_fail(Symbol::EdgeLoad, &[number, p, q, of_old]);
                self.load_words(ty)
            }
            Target::Mesh { property, set } => {
                let ty = self.program.mesh_properties.get(property as usize).ok_or_else(wrong_type)?.default.ty();
                let number = self.int32(property);
                self.call_or_fail(Symbol::MeshLoad, &[set, number]);
                self.load_words(ty)
            }
        };
        Ok(match (whole, axis) {
            (Val::Vec(v), Some(axis)) => Val::One(self.coordinate(v, axis)),
            (whole, _) => whole,
        })
    }

    pub(super) fn store(&mut self, (target, axis): Spot, value: Val) -> Translated<()> {
        match target {
            Target::Local(local) => match (self.storage(local)?, axis) {
                (Storage::Variables(..), Some(_)) => {
                    let value = self.with_coordinate(target, axis, value)?;
                    self.define_local(local, value)?;
                }
                (Storage::Memory(address), Some(axis)) => {
                    let flags = self.regions.locals;
                    self.b.ins().store(flags, value.one()?, address, 8 * i32::from(axis.min(2)));
                }
                _ => self.define_local(local, value)?,
            },
            Target::Position { .. } | Target::Vertex { .. } => {
                self.see_target(target, true);
                let (_, flags, address) = self.address(target)?;
                let first = axis.map_or(0, |axis| 8 * i32::from(axis.min(2)));
                match value {
                    Val::Vec(v) if self.mutated(Mutation::StoresNoY) => {
                        for axis in [0, 2] {
                            let x = self.coordinate(v, axis);
                            self.b.ins().store(flags, x, address, 8 * i32::from(axis));
                        }
                    }
                    value => self.store_value(value, flags, address, first),
                }
            }
            Target::Edge { property, ends: [p, q], .. } => {
                let value = self.with_coordinate(target, axis, value)?;
                self.store_words(value);
                let number = self.int32(property);
                if !self.mutated(Mutation::StoresNoEdgeValue) {
                    self.call_or_fail(Symbol::EdgeStore, &[number, p, q]);
                }
            }
            Target::Mesh { property, set } => {
                let value = self.with_coordinate(target, axis, value)?;
                self.store_words(value);
                let number = self.int32(property);
                if !self.mutated(Mutation::StoresNoMeshValue) {
                    self.call_or_fail(Symbol::MeshStore, &[set, number]);
                }
            }
        }
        Ok(())
    }

    fn see_target(&mut self, target: Target, stores: bool) {
        match target {
            Target::Position { v, old: false } => self.see(Column::Position, v, stores),
            Target::Vertex { property, v, old: false } => self.see(Column::Property(property), v, stores),
            _ => {}
        }
    }

    /// The whole value of a place where one coordinate is to be stored.
    fn with_coordinate(&mut self, target: Target, axis: Option<u8>, value: Val) -> Translated<Val> {
        let Some(axis) = axis else { return Ok(value) };
        let whole = self.read((target, None))?.vec()?;
        Ok(self.with(whole, axis, value.one()?))
    }

    /// Type, kind of memory and address of a position or vertex property.
    fn address(&mut self, target: Target) -> Translated<(Type, MemFlagsData, Value)> {
        Ok(match target {
            Target::Position { v, old } => {
                let old = old && !self.mutated(Mutation::OldPositionIsNew);
                let flags = if old { self.regions.old } else { self.regions.positions };
                let base = if old { context::OLD_POSITIONS } else { context::POSITIONS };
                let base = self.load_context(types::I64, base);
                (Type::Vec, flags, self.element(base, v, context::value_size(Type::Vec)))
            }
            Target::Vertex { property, v, old } => {
                let index = property as usize;
                let ty = self.program.vertex_properties.get(index).ok_or_else(wrong_type)?.default.ty();
                let flags =
                    if old { self.regions.old } else { *self.regions.columns.get(index).ok_or_else(wrong_type)? };
                let base = context::byte_offset(self.unit.layout.vertex_column(index, old));
                let base = self.load_context(types::I64, base);
                (ty, flags, self.element(base, v, context::value_size(ty)))
            }
            _ => return Err(wrong_type()),
        })
    }

    pub(super) fn assign(&mut self, place: &'p Place, op: Option<&'p Compound>, value: &'p Expr) -> Translated<Val> {
        let spot = self.target(place)?;
        self.prepare(value)?;
        let mut value = self.expression(value)?;
        if let Some(compound) = op {
            let mut was = self.read(spot)?;
            if let Some(widen) = compound.widen {
                was = self.convert(widen, was)?;
            }
            value = self.binary(compound.op, was, value)?;
            if let Some(narrow) = compound.narrow {
                value = self.convert(narrow, value)?;
            }
        }
        self.store(spot, value)?;
        Ok(value)
    }

    pub(super) fn step(&mut self, place: &'p Place, step: Step, position: StepPosition) -> Translated<Val> {
        let spot = self.target(place)?;
        let before = self.read(spot)?;
        let x = before.one()?;
        let after = match (self.b.func.dfg.value_type(x), step) {
            (types::I64, _) => {
                let stride = if self.mutated(Mutation::AddStepByTwo) { 2 } else { 1 };
                let one = self.b.ins().iconst(types::I64, stride);
                let (sum, overflow) = match step {
                    Step::Up => self.b.ins().sadd_overflow(x, one),
                    Step::Down => self.b.ins().ssub_overflow(x, one),
                };
                self.fail_if(overflow);
                sum
            }
            (types::F64, step) => {
                let one = self.b.ins().f64const(1.0);
                match step {
                    Step::Up => self.b.ins().fadd(x, one),
                    Step::Down => self.b.ins().fsub(x, one),
                }
            }
            _ => x,
        };
        self.store(spot, Val::One(after))?;
        Ok(if position == StepPosition::Before { Val::One(after) } else { before })
    }

    /// A new vertex.
    pub(super) fn create(&mut self) -> Translated<Value> {
        let count = self.load_context(types::I64, context::VERTEX_COUNT);
        let capacity = self.load_context(types::I64, context::VERTEX_CAPACITY);
        let room = self.b.ins().icmp(cranelift_codegen::ir::condcodes::IntCC::UnsignedLessThan, count, capacity);
        let grow = self.b.create_block();
        self.b.set_cold_block(grow);
        let write = self.b.create_block();
        self.b.ins().brif(room, write, &[], grow, &[]);
        self.continue_in(grow);
        self.call_rarely_or_fail(Symbol::GrowVertices, &[])?;
        self.b.ins().jump(write, &[]);
        self.continue_in(write);
        let next = self.b.ins().iadd_imm_s(count, 1);
        let v = self.b.ins().ireduce(types::I32, next);
        self.known.created(v);
        self.known.learn(Key::Wide(v), Fact::Is(next));
        let base = self.load_context(types::I64, context::HEADS);
        let head = self.element(base, v, context::HEAD_SIZE);
        let zero = self.int32(0);
        let heads = self.regions.heads;
        for field in [context::HEAD_OFFSET, context::HEAD_LEN, context::HEAD_CAPACITY] {
            self.b.ins().store(heads, zero, head, field);
        }
        let (_, flags, position) = self.address(Target::Position { v, old: false })?;
        let origin = self.constant(crate::mesh::Value::zero(Type::Vec))?;
        self.store_value(origin, flags, position, 0);
        self.ask_to_write(head);
        self.ask_to_write(position);
        for (property, declaration) in self.program.vertex_properties.iter().enumerate() {
            let mut default = self.constant(declaration.default)?;
            if self.mutated(Mutation::CreatesWithoutDefaults) {
                default = self.constant(crate::mesh::Value::zero(declaration.default.ty()))?;
            }
            let (_, flags, address) = self.address(Target::Vertex { property: property as u32, v, old: false })?;
            self.store_value(default, flags, address, 0);
        }
        self.store_context(next, context::VERTEX_COUNT);
        Ok(v)
    }
}

/// The places that an expression reads, in order; `false` if it does more than read positions and vertex properties and
/// compute with them.
fn gather_places<'p>(e: &'p Expr, places: &mut Vec<&'p Place>) -> bool {
    match &e.kind {
        ExprKind::Constant(_) | ExprKind::Local(_) | ExprKind::Global(_) => true,
        ExprKind::Load(place) => {
            places.push(place);
            reads_only(place)
        }
        ExprKind::Binary(_, a, b) => gather_places(a, places) && gather_places(b, places),
        ExprKind::Unary(_, a) | ExprKind::Convert(_, a) | ExprKind::Coordinate(a, _) => gather_places(a, places),
        _ => false,
    }
}

/// Whether computing the operands of a place only looks at rings.
fn reads_only(place: &Place) -> bool {
    match place {
        Place::Position { vertex, .. } | Place::VertexProperty { vertex, .. } => looks_only(vertex),
        Place::Coordinate(base, _) => reads_only(base),
        _ => false,
    }
}

fn looks_only(vertex: &Expr) -> bool {
    match &vertex.kind {
        ExprKind::Local(_) => true,
        ExprKind::Any(ring) => looks_only_at(ring),
        ExprKind::Next(x, ring) | ExprKind::Previous(x, ring) => {
            matches!(&**x, Item::Vertex(x) if looks_only(x)) && looks_only_at(ring)
        }
        _ => false,
    }
}

fn looks_only_at(ring: &Ring) -> bool {
    matches!(ring, Ring::Of { vertex, .. } if looks_only(vertex))
}
