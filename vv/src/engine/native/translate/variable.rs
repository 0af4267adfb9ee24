//! Variables, and values in memory.

use cranelift_codegen::ir::{InstBuilder, MemFlagsData, StackSlotData, StackSlotKind, Type as ClifType, Value, types};
use cranelift_frontend::Variable;

use super::lanes::unaligned;
use super::{Frame, Refused, Storage, Translated, Translator, Val, clif_types, wrong_type};
use crate::engine::native::context;
use crate::engine::native::effects::Keeping;
use crate::ir::{LocalId, Type};
use crate::mesh;

/// Where the parts of a value lie in memory.
const PART_OFFSETS: [i32; 2] = [0, 16];

impl<'p> Translator<'_, 'p> {
    pub(super) fn frame(&self) -> Translated<&Frame<'p>> {
        self.frames.last().ok_or_else(wrong_type)
    }

    pub(super) fn frame_mut(&mut self) -> Translated<&mut Frame<'p>> {
        self.frames.last_mut().ok_or_else(wrong_type)
    }

    pub(super) fn storage(&self, local: LocalId) -> Translated<Storage> {
        self.frame()?.storage.get(local.0 as usize).copied().ok_or_else(wrong_type)
    }

    pub(super) fn type_of(&self, local: LocalId) -> Translated<mesh::Type> {
        match self.frame()?.function.locals.get(local.0 as usize).map(|l| l.ty) {
            Some(Type::Value(ty)) => Ok(ty),
            _ => Err(wrong_type()),
        }
    }

    /// Index of the set behind a variable of type mesh.
    pub(super) fn set_of(&self, local: LocalId) -> Translated<Value> {
        match self.storage(local)? {
            Storage::Set(index) => Ok(index),
            _ => Err(wrong_type()),
        }
    }

    pub(super) fn allocate(&mut self, ty: mesh::Type, keeping: Keeping) -> Storage {
        match keeping {
            Keeping::Fixed | Keeping::Face => Storage::None,
            Keeping::Variable => {
                let types = clif_types(ty);
                let mut variables = [Variable::from_u32(0); 2];
                for (variable, &t) in variables.iter_mut().zip(types) {
                    *variable = self.b.declare_var(t);
                }
                Storage::Variables(variables, types.len())
            }
            Keeping::Memory => {
                let data = StackSlotData::new(StackSlotKind::ExplicitSlot, context::value_size(ty) as u32, 3);
                let slot = self.b.create_sized_stack_slot(data);
                Storage::Memory(self.b.ins().stack_addr(types::I64, slot, 0))
            }
        }
    }

    /// Stores a value, and says where it lives from now on.
    pub(super) fn define(&mut self, storage: Storage, value: Val) -> Storage {
        match storage {
            Storage::None | Storage::Fixed(_) => Storage::Fixed(value),
            Storage::Variables(variables, n) => {
                for (&variable, &part) in variables.iter().take(n).zip(value.parts()) {
                    self.b.def_var(variable, part);
                }
                storage
            }
            Storage::Memory(address) => {
                self.store_value(value, self.regions.locals, address, 0);
                storage
            }
            Storage::Set(_) | Storage::List(_) | Storage::Face(..) => storage,
        }
    }

    pub(super) fn define_local(&mut self, local: LocalId, value: Val) -> Translated<()> {
        let storage = self.storage(local)?;
        let storage = self.define(storage, value);
        if let Some(place) = self.frame_mut()?.storage.get_mut(local.0 as usize) {
            *place = storage;
        }
        Ok(())
    }

    pub(super) fn read_local(&mut self, local: LocalId) -> Translated<Val> {
        let ty = self.type_of(local)?;
        Ok(match self.storage(local)? {
            Storage::Fixed(value) => value,
            Storage::Variables(variables, n) => {
                let mut parts = [self.context; 2];
                for (part, &variable) in parts.iter_mut().zip(variables.iter().take(n)) {
                    *part = self.b.use_var(variable);
                }
                Val::from_parts(&parts[..n])
            }
            Storage::Memory(address) => {
                let flags = self.regions.locals;
                self.load_value(ty, flags, address, 0)
            }
            Storage::None | Storage::Set(_) | Storage::List(_) | Storage::Face(..) => {
                return Err(Refused("a variable is used before it is declared".into()));
            }
        })
    }

    /// Loads a value of a type; its parts lie one after the other.
    pub(super) fn load_value(&mut self, ty: mesh::Type, flags: MemFlagsData, address: Value, offset: i32) -> Val {
        let mut parts = [address; 2];
        let types = clif_types(ty);
        for ((part, &t), at) in parts.iter_mut().zip(types).zip(PART_OFFSETS) {
            let flags = if t == types::F64X2 { unaligned(flags) } else { flags };
            *part = self.b.ins().load(t, flags, address, offset + at);
        }
        Val::from_parts(&parts[..types.len()])
    }

    /// Stores a value as [`Translator::load_value`] loads it.
    pub(super) fn store_value(&mut self, value: Val, flags: MemFlagsData, address: Value, offset: i32) {
        for (&part, at) in value.parts().iter().zip(PART_OFFSETS) {
            let wide = self.b.func.dfg.value_type(part) == types::F64X2;
            let flags = if wide { unaligned(flags) } else { flags };
            self.b.ins().store(flags, part, address, offset + at);
        }
    }

    /// A coordinate of a vec.
    pub(super) fn coordinate(&mut self, [xy, z]: [Value; 2], axis: u8) -> Value {
        match axis {
            0 | 1 => self.b.ins().extractlane(xy, axis),
            _ => z,
        }
    }

    pub(super) fn coordinates(&mut self, v: [Value; 2]) -> [Value; 3] {
        [0, 1, 2].map(|axis| self.coordinate(v, axis))
    }

    /// The vec with another coordinate.
    pub(super) fn with(&mut self, [xy, z]: [Value; 2], axis: u8, x: Value) -> Val {
        Val::Vec(match axis {
            0 | 1 => [self.b.ins().insertlane(xy, x, axis), z],
            _ => [xy, x],
        })
    }

    /// The vec of three coordinates.
    pub(super) fn vec_of(&mut self, [x, y, z]: [Value; 3]) -> Val {
        let xy = self.b.ins().scalar_to_vector(types::F64X2, x);
        Val::Vec([self.b.ins().insertlane(xy, y, 1), z])
    }

    pub(super) fn load_context(&mut self, ty: ClifType, offset: i32) -> Value {
        let (flags, context) = (self.regions.context, self.context);
        self.b.ins().load(ty, flags, context, offset)
    }

    pub(super) fn store_context(&mut self, value: Value, offset: i32) {
        let (flags, context) = (self.regions.context, self.context);
        self.b.ins().store(flags, value, context, offset);
    }

    /// The value in the words through which runtime functions answer.
    pub(super) fn load_words(&mut self, ty: mesh::Type) -> Val {
        let (flags, context) = (self.regions.context, self.context);
        self.load_value(ty, flags, context, context::VALUE)
    }

    pub(super) fn store_words(&mut self, value: Val) {
        self.store_words_at(value, 0);
    }

    pub(super) fn store_words_at(&mut self, value: Val, first: usize) {
        let value = self.widened(value);
        self.store_value(value, self.regions.context, self.context, context::VALUE + 8 * first as i32);
    }

    /// A value in whole words.
    pub(super) fn widened(&mut self, value: Val) -> Val {
        match value {
            Val::One(x) if matches!(self.b.func.dfg.value_type(x), types::I8 | types::I32) => {
                Val::One(self.b.ins().uextend(types::I64, x))
            }
            value => value,
        }
    }

    pub(super) fn int32(&mut self, n: u32) -> Value {
        self.b.ins().iconst(types::I32, i64::from(n))
    }
}
