//! From the checked program to Cranelift's representation: one native function per function, typed, in SSA form.
//!
//! `int` is i64, `double` f64, `bool` i8 (0 or 1), `vertex` i32 (0 is null), `vec` three f64, a mesh the index of a set
//! of the run. A function takes the context, then its operands, `&` parameters as addresses; it returns a status and
//! leaves its result in the context. Whatever is an error in the language jumps to one cold block that returns
//! [`status::REPEAT`]: the interpreter then says what it was.

mod ahead;
mod builtin;
mod call;
mod edit;
mod emit;
mod expression;
mod known;
mod lanes;
mod list;
mod make;
mod parallel;
mod place;
mod rare;
mod ring;
mod set;
mod statement;
mod variable;
mod walk;

use std::collections::VecDeque;

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{
    AbiParam, AliasRegionData, Block, FuncRef, InstBuilder, MemFlagsData, Signature, Type as ClifType, Value, types,
};
use cranelift_frontend::{FunctionBuilder, Variable};
use cranelift_jit::JITModule;
use cranelift_module::{FuncId, Module};
use rustc_hash::FxHashMap;

use super::Mutation;
use super::ahead::Touched;
use super::context::{self, Layout, Memo, status};
use super::effects::{Facts, Keeping};
use super::parallel::Seen;
use super::run::Symbol;
use crate::ir::{Function, FunctionId, Passing, Program, Type};
use crate::mesh;
use crate::source::Span;

pub(super) use ahead::PREFETCH;
use known::{Bounds, Known};
pub(super) use parallel::{Apart, next as next_rounds, signature as signature_of_rounds};
pub(super) use rare::between;

/// Why a program is left to the interpreter.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub(crate) struct Refused(pub(crate) String);

pub(super) type Translated<T> = Result<T, Refused>;

/// A place where compiled code may be stopped.
#[derive(Debug, Clone)]
pub(super) struct Site {
    pub(super) span: Span,
    /// The function that was compiled.
    pub(super) function: String,
    /// Calls within it that its code stands in for, innermost first.
    pub(super) calls: Vec<(String, Span)>,
}

/// What is gathered while a program is compiled.
pub(super) struct Unit<'p> {
    pub(super) program: &'p Program,
    pub(super) facts: Facts,
    pub(super) layout: Layout,
    pub(super) sites: Vec<Site>,
    pub(super) texts: Vec<String>,
    pub(super) memos: Vec<Memo>,
    pub(super) functions: FxHashMap<FunctionId, FuncId>,
    pub(super) symbols: FxHashMap<Symbol, FuncId>,
    /// What stands before runtime functions where they are called rarely, see [`rare`].
    pub(super) rare: FxHashMap<Symbol, FuncId>,
    /// How many parallel loops have rounds that are a function, and those that are still to be translated, in order.
    pub(super) rounds: u32,
    pub(super) apart: Vec<Apart<'p>>,
    /// An instruction that is translated wrongly, for the test of the tests.
    pub(super) mutation: Mutation,
}

/// The signature of a function of the program.
pub(super) fn signature(function: &Function, keeping: &[Keeping], mut signature: Signature) -> Translated<Signature> {
    signature.params.push(AbiParam::new(types::I64));
    for ((local, passing), &keeping) in function.locals.iter().zip(&function.parameters).zip(keeping) {
        match (local.ty, passing) {
            (Type::Ring, _) if keeping == Keeping::Face => {
                signature.params.extend([types::I64, types::I32].map(AbiParam::new));
            }
            (Type::Mesh, _) => signature.params.push(AbiParam::new(types::I32)),
            (Type::Value(_), Passing::Reference) => signature.params.push(AbiParam::new(types::I64)),
            (Type::Value(ty), Passing::Value) => {
                for &t in clif_types(ty) {
                    signature.params.push(AbiParam::new(t));
                }
            }
            (Type::Ring, _) => signature.params.push(AbiParam::new(types::I32)),
            (Type::Void, _) => return Err(Refused("a parameter has no type".to_owned())),
        }
    }
    signature.returns.push(AbiParam::new(types::I32));
    Ok(signature)
}

fn clif_types(ty: mesh::Type) -> &'static [ClifType] {
    match ty {
        mesh::Type::Bool => &[types::I8],
        mesh::Type::Int => &[types::I64],
        mesh::Type::Double => &[types::F64],
        mesh::Type::Vec => &[types::F64X2, types::F64],
        mesh::Type::Vertex => &[types::I32],
    }
}

/// A value of the language.
#[derive(Debug, Clone, Copy)]
pub(super) enum Val {
    Void,
    One(Value),
    /// x and y side by side, and z: arithmetic on two lanes costs what it costs on one.
    Vec([Value; 2]),
}

impl Val {
    fn one(self) -> Translated<Value> {
        match self {
            Self::One(v) => Ok(v),
            _ => Err(wrong_type()),
        }
    }

    fn vec(self) -> Translated<[Value; 2]> {
        match self {
            Self::Vec(v) => Ok(v),
            _ => Err(wrong_type()),
        }
    }

    fn parts(&self) -> &[Value] {
        match self {
            Self::Void => &[],
            Self::One(v) => std::slice::from_ref(v),
            Self::Vec(v) => v,
        }
    }

    fn from_parts(parts: &[Value]) -> Self {
        match *parts {
            [x] => Self::One(x),
            [xy, z] => Self::Vec([xy, z]),
            _ => Self::Void,
        }
    }
}

fn wrong_type() -> Refused {
    Refused("the program is not well-typed".to_owned())
}

/// Where a variable lives.
#[derive(Debug, Clone, Copy)]
enum Storage {
    /// Not declared yet.
    None,
    Fixed(Val),
    Variables([Variable; 2], usize),
    /// An address.
    Memory(Value),
    /// Index of a set.
    Set(Value),
    /// Index of a list: a variable of type ring.
    List(Value),
    /// Vertices that lie somewhere and stay as they are.
    Face(Bounds, Orbit),
}

/// Whether vertices are known to be those of a face, which has no side twice.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Orbit {
    Yes,
    No,
}

/// A function whose statements are being translated: the compiled one, or one that stands in for its call.
struct Frame<'p> {
    function: &'p Function,

    storage: Vec<Storage>,
    /// Where it was called, for one that stands in.
    call: Option<Span>,
    /// Where `return` goes in one that stands in and returns in several places.
    exit: Option<Block>,
    result: Vec<Variable>,
    loops: Vec<Loop>,
}

/// An open loop.
#[derive(Debug, Clone, Copy)]
struct Loop {
    next: Block,
    exit: Block,
    walk: Walk,
}

/// What a loop has to give back when it is left.
#[derive(Debug, Clone, Copy)]
enum Walk {
    Nothing,
    /// How many sets were walked before.
    Set(Value),
    /// How many copies of rings were walked before.
    Ring(Value),
    /// How many sets of faces were walked before.
    Faces(Value),
}

/// Kinds of memory that do not overlap.
struct Regions {
    context: MemFlagsData,
    heads: MemFlagsData,
    slots: MemFlagsData,
    positions: MemFlagsData,
    /// What compiled code never stores to while it reads it.
    old: MemFlagsData,
    locals: MemFlagsData,
    sets: MemFlagsData,
    members: MemFlagsData,
    /// Lists, and the vertices of lists and faces.
    lists: MemFlagsData,
    listed: MemFlagsData,
    columns: Vec<MemFlagsData>,
}

/// Translates one function.
pub(super) struct Translator<'t, 'p> {
    b: FunctionBuilder<'t>,
    module: &'t mut JITModule,
    unit: &'t mut Unit<'p>,
    program: &'p Program,
    context: Value,
    frames: Vec<Frame<'p>>,
    known: Known,
    /// Places whose operands are computed, in the order in which they will be read.
    prepared: VecDeque<place::Spot>,
    fail: Block,
    regions: Regions,
    symbol_refs: FxHashMap<FuncId, FuncRef>,
    function_refs: FxHashMap<FunctionId, FuncRef>,
    /// How many sets there were before the function's own.
    set_mark: Option<Value>,
    /// How many lists.
    list_mark: Option<Value>,
    name: String,
    /// What the loop over faces in hand touches of their vertices, until a loop over vertices asks for them.
    corners: Touched,
    /// The vertex of the loop over a set that is being translated: rings of such lie one behind the other.
    in_turn: Option<Value>,
    /// In a loop that does not ask in each round whether to stop: its place, for calls of the runtime in it ask.
    ask_rarely: Option<Span>,
    /// Nothing has been written to the mesh: the first statement of the run is being translated.
    pristine: bool,
    /// In rounds of a parallel loop, and in functions that these call: other rounds may make it give up.
    watches: bool,
    /// In rounds of a parallel loop: their vertex, and what is seen of the values of vertices.
    seen: Option<(Option<Value>, Seen)>,
}

impl<'t, 'p> Translator<'t, 'p> {
    pub(super) fn new(
        mut b: FunctionBuilder<'t>,
        module: &'t mut JITModule,
        unit: &'t mut Unit<'p>,
        name: &str,
    ) -> Self {
        let entry = b.create_block();
        b.append_block_params_for_function_params(entry);
        b.switch_to_block(entry);
        b.seal_block(entry);
        let context = b.block_params(entry)[0];
        let fail = b.create_block();
        b.set_cold_block(fail);
        let mut next_region = 0;
        let mut region = |description: &'static str| {
            let data = AliasRegionData { user_id: next_region, description: description.into() };
            next_region += 1;
            MemFlagsData::trusted().with_alias_region(Some(b.func.dfg.alias_regions.insert(data)))
        };
        let regions = Regions {
            context: region("context"),
            heads: region("heads"),
            slots: region("slots"),
            positions: region("positions"),
            old: region("old"),
            locals: region("locals"),
            sets: region("sets"),
            members: region("members"),
            lists: region("lists"),
            listed: region("listed"),
            columns: unit.program.vertex_properties.iter().map(|_| region("column")).collect(),
        };
        Self {
            b,
            module,
            program: unit.program,
            unit,
            context,
            frames: Vec::new(),
            known: Known::default(),
            prepared: VecDeque::new(),
            fail,
            regions,
            symbol_refs: FxHashMap::default(),
            function_refs: FxHashMap::default(),
            set_mark: None,
            list_mark: None,
            name: name.to_owned(),
            corners: Touched::default(),
            in_turn: None,
            ask_rarely: None,
            pristine: false,
            watches: false,
            seen: None,
        }
    }

    /// Translates a function of the program.
    pub(super) fn function(mut self, id: FunctionId) -> Translated<()> {
        let function = self.program.function(id).ok_or_else(wrong_type)?;
        let facts = self.unit.facts.function(id).ok_or_else(wrong_type)?;
        let (inline_depth, keeping) = (facts.inline_depth, facts.keeping.clone());
        self.pristine = facts.pristine;
        self.watches = facts.in_parallel;
        self.prologue(inline_depth);
        let own_sets =
            function.locals.iter().enumerate().any(|(i, l)| l.ty == Type::Mesh && i >= function.parameters.len());
        if own_sets {
            self.set_mark = Some(self.load_context(types::I64, context::SET_COUNT));
        }
        let own_list = |i: usize| i >= function.parameters.len() && keeping[i] != Keeping::Face;
        if function.locals.iter().enumerate().any(|(i, l)| l.ty == Type::Ring && own_list(i)) {
            self.list_mark = Some(self.load_context(types::I64, context::LIST_COUNT));
        }
        let mut operands = 1;
        let entry = self.b.current_block().ok_or_else(wrong_type)?;
        let mut storage = Vec::with_capacity(function.locals.len());
        // The prologue has split the entry block; its parameters are the operands all the same.
        let parameters: Vec<Value> = {
            let first = self.b.func.layout.entry_block().unwrap_or(entry);
            self.b.block_params(first).to_vec()
        };
        for (i, local) in function.locals.iter().enumerate() {
            let passing = function.parameters.get(i);
            let place = match (local.ty, passing) {
                (Type::Mesh, Some(_)) => {
                    operands += 1;
                    Storage::Set(*parameters.get(operands - 1).ok_or_else(wrong_type)?)
                }
                (Type::Value(_), Some(Passing::Reference)) => {
                    operands += 1;
                    Storage::Memory(*parameters.get(operands - 1).ok_or_else(wrong_type)?)
                }
                (Type::Value(ty), Some(Passing::Value)) => {
                    let n = clif_types(ty).len();
                    let value = Val::from_parts(parameters.get(operands..operands + n).ok_or_else(wrong_type)?);
                    operands += n;
                    let place = self.allocate(ty, keeping[i]);
                    self.define(place, value)
                }
                (Type::Mesh, None) => Storage::Set(self.new_set()),
                (Type::Value(ty), None) => self.allocate(ty, keeping[i]),
                (Type::Ring, Some(_)) if keeping[i] == Keeping::Face => {
                    let &[start, len] = parameters.get(operands..operands + 2).ok_or_else(wrong_type)? else {
                        return Err(wrong_type());
                    };
                    operands += 2;
                    Storage::Face(Bounds { start, len, flags: self.regions.listed }, Orbit::No)
                }
                (Type::Ring, Some(_)) => {
                    operands += 1;
                    Storage::List(*parameters.get(operands - 1).ok_or_else(wrong_type)?)
                }
                (Type::Ring, None) if keeping[i] == Keeping::Face => Storage::None,
                (Type::Ring, None) => Storage::List(self.new_list()),
                (Type::Void, _) => Storage::None,
            };
            storage.push(place);
        }
        self.frames.push(Frame { function, storage, call: None, exit: None, result: Vec::new(), loops: Vec::new() });
        if self.block(&function.body)? {
            self.leave_function();
        }
        self.finish();
        Ok(())
    }

    /// Translates the function that computes the globals.
    pub(super) fn globals(mut self) -> Translated<()> {
        let depth = self.unit.facts.functions.iter().map(|f| f.inline_depth + 1).max().unwrap_or(0);
        self.prologue(depth);
        for (i, global) in self.program.globals.iter().enumerate() {
            let word = self.unit.layout.global(i);
            let given = self.load_context(types::I64, context::byte_offset(self.unit.layout.given(i)));
            let compute = self.b.create_block();
            let done = self.b.create_block();
            self.b.ins().brif(given, done, &[], compute, &[]);
            self.b.switch_to_block(compute);
            self.b.seal_block(compute);
            self.known.enter();
            let value = self.expression(&global.init)?;
            self.known.leave();
            let context = self.context;
            let value = self.widened(value);
            self.store_value(value, self.regions.context, context, context::byte_offset(word));
            self.b.ins().jump(done, &[]);
            self.b.switch_to_block(done);
            self.b.seal_block(done);
        }
        self.leave_function();
        self.finish();
        Ok(())
    }

    /// Asks for room on the native stack and among the open calls.
    fn prologue(&mut self, inline_depth: u32) {
        let low = self.is_stack_low();
        let depth = self.load_context(types::I64, context::DEPTH);
        let depth = self.b.ins().iadd_imm_s(depth, 1);
        let deepest = self.b.ins().iadd_imm_s(depth, i64::from(inline_depth));
        let max = self.load_context(types::I64, context::MAX_DEPTH);
        let deep = self.b.ins().icmp(IntCC::UnsignedGreaterThan, deepest, max);
        let bad = self.b.ins().bor(low, deep);
        self.fail_if(bad);
        self.store_context(depth, context::DEPTH);
    }

    /// Asks for room on the native stack.
    fn ask_for_stack(&mut self) {
        let low = self.is_stack_low();
        self.fail_if(low);
    }

    fn is_stack_low(&mut self) -> Value {
        let pointer = self.b.ins().get_stack_pointer(types::I64);
        let limit = self.load_context(types::I64, context::STACK_LIMIT);
        self.b.ins().icmp(IntCC::UnsignedLessThan, pointer, limit)
    }

    /// Ends the function well.
    fn leave_function(&mut self) {
        if let Some(mark) = self.set_mark {
            self.call(Symbol::SetDrop, &[mark]);
        }
        self.drop_lists(self.list_mark);
        let depth = self.load_context(types::I64, context::DEPTH);
        let depth = self.b.ins().iadd_imm_s(depth, -1);
        self.store_context(depth, context::DEPTH);
        let done = self.b.ins().iconst(types::I32, i64::from(status::DONE));
        self.b.ins().return_(&[done]);
    }

    fn finish(mut self) {
        self.b.switch_to_block(self.fail);
        let repeat = self.b.ins().iconst(types::I32, i64::from(status::REPEAT));
        self.b.ins().return_(&[repeat]);
        self.b.seal_all_blocks();
        let config = self.module.target_config();
        self.b.finalize(config);
    }

    /// Whether this is to be translated wrongly.
    fn mutated(&self, mutation: Mutation) -> bool {
        self.unit.mutation == mutation
    }
}
