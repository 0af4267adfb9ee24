//! The fast engine: machine code made from the checked program with Cranelift.
//!
//! It gives what the interpreter gives, bit for bit. Whatever goes wrong in compiled code, the step is done again by
//! the interpreter, with what was printed already left out, and what the interpreter says counts: so compiled code
//! carries no messages, and errors are the same by construction. Only a stop and a closed output are reported from
//! here, for they depend on the moment.
//!
//! Memory is counted when arrays grow, so a step that comes near [`Limits::max_bytes`](super::Limits::max_bytes) may
//! end under one engine and not under the other. A program is refused if it cannot be compiled here, or memory cannot
//! be made executable; then the interpreter runs it.
//!
//! A stop is asked for at every round of a loop and at every call: a load and a branch that is never taken, one to two per
//! cent of a step of the paper's Loop listing. Loops round one ring without loops and calls in them are over too soon to
//! ask, but for what they leave to the runtime, which takes longer where rings are long: that asks.
//!
//! The rounds of a parallel loop are a function of their own, to which the values of variables from outside are handed. All
//! cores do some of them each where there are many, each with a copy of the context: what the runtime does then only
//! reads, so that nothing has to wait. A loop whose rounds declare rings, or walk sets or faces, is run in turn.

mod ahead;
mod context;
mod effects;
mod parallel;
mod prefetch;
mod pristine;
mod run;
mod translate;

use std::panic::{AssertUnwindSafe, catch_unwind};

use cranelift_codegen::Context as Compiler;
use cranelift_codegen::control::ControlPlane;
use cranelift_codegen::ir::{AbiParam, UserFuncName, types};
use cranelift_codegen::settings::{self, Configurable};
use cranelift_frontend::{FunctionBuilder, FunctionBuilderContext};
use cranelift_jit::{JITBuilder, JITModule};
use cranelift_module::{FuncId, Linkage, Module, ModuleReloc, default_libcall_names};

use super::{Failure, FailureKind, Output, OutputClosed, Settings, interpret};
use crate::diagnostic::Diagnostic;
use crate::ir::{FunctionId, Program};
use crate::mesh::Mesh;
use context::{Layout, Memo};
use effects::{Facts, OldReads};
use run::{End, Executable, Fixed, Owned, Symbol};
use translate::{Site, Translator, Unit};

pub use run::keep_freed_memory;
pub(crate) use translate::Refused;

/// Native stack that one statement or expression may need while it is compiled.
const RED_ZONE: usize = 256 << 10;

/// What the native stack grows by.
const STACK_SEGMENT: usize = 4 << 20;

/// A compiled function with a larger frame is refused, so that asking for room as it begins is enough.
const MAX_FRAME: u32 = 64 << 10;

/// Declares the mutations and their list.
macro_rules! mutations {
    ($($name:ident)*) => {
        /// Something that is compiled wrongly on purpose, so that a test can see the tests find it.
        #[doc(hidden)]
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum Mutation {
            None,
            $($name,)*
        }

        impl Mutation {
            /// All that change something.
            pub const ALL: &[Self] = &[$(Self::$name,)*];
        }
    };
}

mutations! {
    AddStepByTwo AddsNoMember AndIsOr AnyIsLast AppendsNothing AssignsNoRing AssignsNoSet BeginsAtTheStart BoolIsMinusOne BreakIsContinue CallsWithZeros CapturesZeros
    ComparesBoolsInverted ComparesDoublesInverted ComparesIntsInverted ComparesVecsByX ComparesVerticesInverted
    ConditionalIsSwapped CreatesWithoutDefaults CrossIsNegated DifferenceIsSwapped DividesIntsByOne DotForgetsZ
    DoubleToIntRounds EditsMoveNothing EditsNoRing ErasesNothing FollowsItself ForgetsWhatCallsPut ForgetsWhatLoopsPut ForgetsWhatWasPut ForgetsGapsOfValence ForgetsTheSecondFace IntSumIsDifference IntToDoubleUnsigned IgnoresGaps IgnoresRoom IsInRingInverted
    IsInSetInverted LoopsSkipTheSecond MakesNoRing MakesReversed MemoIsStale MergesNothing MinIsMax NegatesNothing NextIsPrevious
    NotDoesNothing OldIsAsItCame OldPositionIsNew OldRingIsNew PrintsNoText ProductIsSum QuotientIsProduct RemovesNothing
    ReplacesNothing ReturnsEarlier RoundsLeaveOutTheLast RoundsSkipTheFirst SmallerIsLarger SplicesOnTheOtherSide StandsBesideItself StandsWhereItStood StoresNoEdgeValue StoresNoMeshValue StoresNoY
}

/// A compiled program.
pub(crate) struct Native {
    code: Executable,
    layout: Layout,
    old_reads: OldReads,
    sites: Vec<Site>,
    texts: Vec<String>,
    memos: Vec<Memo>,
    creates: bool,
    grows: bool,
    replaces: bool,
    edits: bool,
}

impl std::fmt::Debug for Native {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Native").finish_non_exhaustive()
    }
}

/// Compiles a program.
pub(crate) fn compile(program: &Program, mutation: Mutation) -> Result<Native, Refused> {
    catch_unwind(AssertUnwindSafe(|| compile_here(program, mutation)))
        .unwrap_or_else(|_| Err(Refused("the compiler failed".to_owned())))
}

fn refused(why: impl std::fmt::Display) -> Refused {
    Refused(why.to_string())
}

fn compile_here(program: &Program, mutation: Mutation) -> Result<Native, Refused> {
    if cfg!(target_endian = "big") || size_of::<usize>() != 8 {
        return Err(refused("machines of this kind are not supported"));
    }
    let mut owned = Owned::new(new_module()?);
    let module = owned.module();
    let mut unit = Unit {
        program,
        facts: Facts::of(program),
        layout: Layout::new(program),
        sites: Vec::new(),
        texts: Vec::new(),
        memos: Vec::new(),
        functions: rustc_hash::FxHashMap::default(),
        symbols: rustc_hash::FxHashMap::default(),
        rare: rustc_hash::FxHashMap::default(),
        rounds: 0,
        apart: Vec::new(),
        mutation,
    };
    for &symbol in Symbol::ALL {
        let mut signature = module.make_signature();
        signature.params.extend(symbol.operands().iter().map(|&t| AbiParam::new(t)));
        signature.returns.extend(symbol.result().map(AbiParam::new));
        let id = module.declare_function(symbol.name(), Linkage::Import, &signature).map_err(refused)?;
        unit.symbols.insert(symbol, id);
    }
    let roots: Vec<FunctionId> = program.rules.iter().chain(&program.start).copied().collect();
    let mut compiled = Vec::new();
    for (i, function) in program.functions.iter().enumerate() {
        let id = FunctionId(i as u32);
        let Some(facts) = unit.facts.function(id) else { continue };
        if facts.reached && (!facts.inline || roots.contains(&id)) {
            let signature = translate::signature(function, &facts.keeping, module.make_signature())?;
            let declared = module.declare_function(&format!("f{i}"), Linkage::Local, &signature).map_err(refused)?;
            unit.functions.insert(id, declared);
            compiled.push((id, declared, signature));
        }
    }
    let mut compiler = module.make_context();
    let mut builder = FunctionBuilderContext::new();
    for (id, declared, signature) in &compiled {
        compiler.func.signature = signature.clone();
        compiler.func.name = UserFuncName::user(0, declared.as_u32());
        let name = program.function(*id).map_or("", |f| &f.name);
        let b = FunctionBuilder::new(&mut compiler.func, &mut builder);
        Translator::new(b, module, &mut unit, name).function(*id)?;
        define(module, *declared, &mut compiler)?;
    }
    let mut signature = module.make_signature();
    signature.params.extend([AbiParam::new(types::I64), AbiParam::new(types::I32)]);
    signature.returns.push(AbiParam::new(types::I32));
    let globals = module.declare_function("globals", Linkage::Local, &signature).map_err(refused)?;
    compiler.func.signature = signature;
    compiler.func.name = UserFuncName::user(0, globals.as_u32());
    let b = FunctionBuilder::new(&mut compiler.func, &mut builder);
    Translator::new(b, module, &mut unit, "globals").globals()?;
    define(module, globals, &mut compiler)?;
    let mut rounds = Vec::new();
    while let Some(apart) = translate::next_rounds(&mut unit) {
        let (id, name) = (apart.id, apart.name().to_owned());
        compiler.func.signature = translate::signature_of_rounds(module.make_signature());
        compiler.func.name = UserFuncName::user(0, id.as_u32());
        let b = FunctionBuilder::new(&mut compiler.func, &mut builder);
        let is_apart = Translator::new(b, module, &mut unit, &name).rounds(apart)?;
        define(module, id, &mut compiler)?;
        rounds.push((id, is_apart));
    }
    for symbol in Symbol::ALL {
        let Some((&id, &callee)) = unit.rare.get(symbol).zip(unit.symbols.get(symbol)) else { continue };
        compiler.func.name = UserFuncName::user(0, id.as_u32());
        translate::between(*symbol, callee, module, &mut compiler.func, &mut builder);
        define(module, id, &mut compiler)?;
    }
    module.finalize_definitions().map_err(|_| refused("the system lets no memory be executable that was written"))?;
    let entries = roots.iter().filter_map(|id| Some((*id, *unit.functions.get(id)?))).collect::<Vec<_>>();
    let Unit { facts, layout, sites, texts, memos, .. } = unit;
    Ok(Native {
        code: Executable::new(owned, globals, &entries, &rounds),
        layout,
        creates: facts.creates(),
        grows: facts.grows,
        replaces: facts.replaces,
        edits: facts.edits(),
        old_reads: facts.old_reads,
        sites,
        texts,
        memos,
    })
}

fn new_module() -> Result<JITModule, Refused> {
    let mut flags = settings::builder();
    let verify = if cfg!(debug_assertions) { "true" } else { "false" };
    for (name, value) in [
        ("opt_level", "speed"),
        ("use_colocated_libcalls", "false"),
        ("is_pic", "false"),
        ("enable_verifier", verify),
        ("unwind_info", "false"),
    ] {
        flags.set(name, value).map_err(refused)?;
    }
    let isa = cranelift_native::builder().map_err(refused)?;
    let isa = isa.finish(settings::Flags::new(flags)).map_err(refused)?;
    let mut builder = JITBuilder::with_isa(isa, default_libcall_names());
    builder.symbols(run::symbols());
    Ok(JITModule::new(builder))
}

fn define(module: &mut JITModule, id: FuncId, compiler: &mut Compiler) -> Result<(), Refused> {
    let code = compiler.compile(module.isa(), &mut ControlPlane::default()).map_err(|e| refused(format!("{e:?}")))?;
    let alignment = u64::from(code.buffer.alignment);
    let mut bytes = code.code_buffer().to_vec();
    let marked = code.buffer.traps().iter().filter(|trap| trap.code == translate::PREFETCH);
    for at in marked.map(|trap| trap.offset as usize).collect::<Vec<_>>() {
        prefetch::put(&mut bytes, at).ok_or_else(|| refused("a load cannot become a prefetch"))?;
    }
    let relocations = code.buffer.relocs().to_vec();
    let relocations: Vec<_> = relocations.iter().map(|r| ModuleReloc::from_mach_reloc(r, &compiler.func, id)).collect();
    module.define_function_bytes(id, alignment, &bytes, &relocations).map_err(|e| refused(format!("{e:?}")))?;
    let frame = compiler.compiled_code().and_then(|c| c.buffer.frame_layout()).map_or(0, |f| f.frame_to_fp_offset);
    module.clear_context(compiler);
    if frame > MAX_FRAME { Err(refused("a function needs too much of the native stack")) } else { Ok(()) }
}

impl Native {
    /// As [`super::run`].
    pub(crate) fn run(
        &self,
        program: &Program,
        function: FunctionId,
        mesh: &Mesh,
        generation: u64,
        settings: &Settings,
        output: &mut dyn Output,
    ) -> Result<Mesh, Failure> {
        let mut output = Counted { output, printed: 0, skip: 0 };
        let fixed = Fixed {
            program,
            layout: &self.layout,
            old_reads: &self.old_reads,
            texts: &self.texts,
            memos: &self.memos,
            creates: self.creates,
            grows: self.grows,
            replaces: self.replaces,
            edits: self.edits,
            settings,
        };
        match run::run(fixed, &self.code, function, mesh, generation, &mut output) {
            End::Done(mesh) => Ok(mesh),
            End::Stopped(site, calls) => {
                let (kind, message) = match settings.stop.check() {
                    Err(stopped) => (FailureKind::Stopped(stopped), stopped.to_string()),
                    Ok(()) => (FailureKind::Program, String::new()),
                };
                Err(self.failure(kind, message, site, &calls))
            }
            End::Closed(site, calls) => {
                Err(self.failure(FailureKind::OutputClosed, OutputClosed.to_string(), site, &calls))
            }
            End::Repeat => {
                output.skip = std::mem::take(&mut output.printed);
                interpret::run(program, function, mesh, generation, settings, &mut output)
            }
        }
    }

    /// A failure at a site, called from sites, innermost first.
    fn failure(&self, kind: FailureKind, message: String, site: usize, calls: &[usize]) -> Failure {
        let Some(site) = self.sites.get(site) else {
            let diagnostic = Diagnostic::new(crate::diagnostic::Severity::Error, None, message);
            return Failure { kind, diagnostic: Box::new(diagnostic) };
        };
        let mut open = site.calls.clone();
        let mut function = &site.function;
        for call in calls.iter().filter_map(|&c| self.sites.get(c)) {
            open.push((function.clone(), call.span));
            open.extend(call.calls.iter().cloned());
            function = &call.function;
        }
        let diagnostic = interpret::with_calls(Diagnostic::error(site.span, message), open.len(), open.into_iter());
        Failure { kind, diagnostic: Box::new(diagnostic) }
    }
}

/// Counts lines, and leaves out the first ones when a step is done again.
struct Counted<'a> {
    output: &'a mut dyn Output,
    printed: usize,
    skip: usize,
}

impl Output for Counted<'_> {
    fn print(&mut self, line: &str) -> Result<(), OutputClosed> {
        self.printed += 1;
        if self.printed > self.skip { self.output.print(line) } else { Ok(()) }
    }
}
