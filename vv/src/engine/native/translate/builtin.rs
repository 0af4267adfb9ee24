//! Functions of the language.

use cranelift_codegen::ir::condcodes::{FloatCC, IntCC};
use cranelift_codegen::ir::{InstBuilder, MemFlagsData, Value, types};

use super::{Symbol, Translated, Translator, Val, wrong_type};
use crate::builtins::{Builtin, Code};
use crate::engine::native::Mutation;
use crate::engine::native::context::{self, MEMO_ENTRIES, MEMO_WORDS, Memo};

impl Translator<'_, '_> {
    pub(super) fn builtin(&mut self, builtin: Builtin, arguments: &[Val]) -> Translated<Val> {
        if let Some(result) = self.builtin_in_line(builtin, arguments)? {
            return Ok(result);
        }
        match (builtin.code(), arguments) {
            (Code::D1(f), &[x]) => return Ok(Val::One(self.remembered(builtin, f as usize, &[x.one()?])?)),
            (Code::D2(f), &[x, y]) => {
                return Ok(Val::One(self.remembered(builtin, f as usize, &[x.one()?, y.one()?])?));
            }
            _ => {}
        }
        let mut at = 0;
        for value in arguments {
            self.store_words_at(*value, at);
            at += if matches!(value, Val::Vec(_)) { 3 } else { 1 };
        }
        let index = Builtin::all().position(|b| b == builtin).ok_or_else(wrong_type)?;
        let index = self.int32(index as u32);
        self.call_or_fail(Symbol::CallBuiltin, &[index]);
        Ok(self.load_words(builtin.returns()))
    }

    /// Functions that are an instruction or two, each with the operations of the table in their order.
    fn builtin_in_line(&mut self, builtin: Builtin, arguments: &[Val]) -> Translated<Option<Val>> {
        Ok(Some(match (builtin.name(), builtin.code(), arguments) {
            ("sqrt", Code::D1(_), &[x]) => Val::One(self.b.ins().sqrt(x.one()?)),
            ("fabs" | "abs", Code::D1(_), &[x]) => Val::One(self.b.ins().fabs(x.one()?)),
            ("floor", Code::D1(_), &[x]) => Val::One(self.b.ins().floor(x.one()?)),
            ("ceil", Code::D1(_), &[x]) => Val::One(self.b.ins().ceil(x.one()?)),
            ("trunc", Code::D1(_), &[x]) => Val::One(self.b.ins().trunc(x.one()?)),
            ("min" | "max", Code::D2(_), &[a, b]) => {
                let (a, b) = (a.one()?, b.one()?);
                let min = (builtin.name() == "min") != self.mutated(Mutation::MinIsMax);
                let takes_b = if min {
                    self.b.ins().fcmp(FloatCC::LessThan, b, a)
                } else {
                    self.b.ins().fcmp(FloatCC::LessThan, a, b)
                };
                Val::One(self.b.ins().select(takes_b, b, a))
            }
            ("min" | "max", Code::I2(_), &[a, b]) => {
                let (a, b) = (a.one()?, b.one()?);
                let min = (builtin.name() == "min") != self.mutated(Mutation::MinIsMax);
                Val::One(if min { self.b.ins().smin(a, b) } else { self.b.ins().smax(a, b) })
            }
            ("vec", Code::VecFromD3(_), &[x, y, z]) => self.vec_of([x.one()?, y.one()?, z.one()?]),
            ("dot", Code::DFromVec2(_), &[a, b]) => Val::One(self.dot(a.vec()?, b.vec()?)),
            ("cross", Code::Vec2(_), &[a, b]) => {
                let (a, b) = (self.coordinates(a.vec()?), self.coordinates(b.vec()?));
                let coordinates = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| {
                    let (i, j) = if self.mutated(Mutation::CrossIsNegated) { (j, i) } else { (i, j) };
                    let first = self.b.ins().fmul(a[i], b[j]);
                    let second = self.b.ins().fmul(a[j], b[i]);
                    self.b.ins().fsub(first, second)
                });
                self.vec_of(coordinates)
            }
            ("length", Code::DFromVec1(_), &[v]) => Val::One(self.length(v.vec()?)),
            ("distance", Code::DFromVec2(_), &[a, b]) => {
                let (a, b) = (a.vec()?, b.vec()?);
                let d = [0, 1].map(|k| self.b.ins().fsub(a[k], b[k]));
                Val::One(self.length(d))
            }
            ("normalize", Code::Vec1(_), &[v]) => {
                let v = v.vec()?;
                let length = self.length(v);
                let zero = self.b.ins().f64const(0.0);
                let none = self.b.ins().fcmp(FloatCC::Equal, length, zero);
                let coordinates = self.coordinates(v).map(|x| {
                    let scaled = self.b.ins().fdiv(x, length);
                    self.b.ins().select(none, zero, scaled)
                });
                self.vec_of(coordinates)
            }
            _ => return Ok(None),
        }))
    }

    fn dot(&mut self, a: [Value; 2], b: [Value; 2]) -> Value {
        let products = [0, 1].map(|k| self.b.ins().fmul(a[k], b[k]));
        let [x, y, z] = self.coordinates(products);
        let xy = self.b.ins().fadd(x, y);
        if self.mutated(Mutation::DotForgetsZ) {
            return xy;
        }
        self.b.ins().fadd(xy, z)
    }

    fn length(&mut self, v: [Value; 2]) -> Value {
        let square = self.dot(v, v);
        self.b.ins().sqrt(square)
    }

    /// Calls a function of one or two doubles, unless it was called with these operands lately.
    ///
    /// In refinement the same few valences ask for the same cosines again and again.
    fn remembered(&mut self, builtin: Builtin, function: usize, operands: &[Value]) -> Translated<Value> {
        let memo = self.unit.layout.add_memo();
        let word = self.unit.layout.memo(memo);
        self.unit.memos.push(Memo { builtin, word });
        let mut all = vec![self.b.ins().iconst(types::I64, function as i64)];
        all.extend_from_slice(operands);
        let bits: Vec<Value> =
            operands.iter().map(|&x| self.b.ins().bitcast(types::I64, MemFlagsData::new(), x)).collect();
        let entry = self.memo_entry(word, &bits);
        let flags = self.regions.context;
        let mut same = self.b.ins().iconst(types::I8, 1);
        for (k, &x_bits) in bits.iter().enumerate() {
            let last = self.b.ins().load(types::I64, flags, entry, 8 * k as i32);
            let equal = self.b.ins().icmp(IntCC::Equal, x_bits, last);
            same = if k == 0 { equal } else { self.b.ins().band(same, equal) };
        }
        if self.mutated(Mutation::MemoIsStale) {
            same = self.b.ins().iconst(types::I8, 1);
        }
        let [again, compute] = [(); 2].map(|()| self.b.create_block());
        let (done, result) = self.block_with(&[types::F64]);
        self.b.ins().brif(same, again, &[], compute, &[]);
        self.continue_in(again);
        let kept = self.b.ins().load(types::F64, flags, entry, 16);
        self.jump_with(done, &[kept]);
        self.b.set_cold_block(compute);
        self.continue_in(compute);
        let symbol = if operands.len() == 1 { Symbol::CallD1 } else { Symbol::CallD2 };
        let computed = self.call_rarely(symbol, &all)?.ok_or_else(wrong_type)?;
        for (k, &x_bits) in bits.iter().enumerate() {
            self.b.ins().store(flags, x_bits, entry, 8 * k as i32);
        }
        self.b.ins().store(flags, computed, entry, 16);
        self.jump_with(done, &[computed]);
        self.continue_in(done);
        Ok(result[0])
    }

    /// Address of the entry of a memo that operands choose: the high bits of a product mix all of theirs.
    fn memo_entry(&mut self, word: usize, operands: &[Value]) -> Value {
        const MIX: i64 = 0x9e37_79b9_7f4a_7c15_u64.cast_signed();
        let mut hash = operands[0];
        for &x in &operands[1..] {
            let turned = self.b.ins().rotl_imm_u(hash, 27);
            hash = self.b.ins().bxor(turned, x);
        }
        let mix = self.b.ins().iconst(types::I64, MIX);
        let mixed = self.b.ins().imul(hash, mix);
        let index = self.b.ins().ushr_imm_u(mixed, i64::from(64 - MEMO_ENTRIES.ilog2()));
        let offset = self.b.ins().imul_imm_s(index, 8 * MEMO_WORDS as i64);
        let entries = self.b.ins().iadd_imm_s(self.context, i64::from(context::byte_offset(word)));
        self.b.ins().iadd(entries, offset)
    }
}
