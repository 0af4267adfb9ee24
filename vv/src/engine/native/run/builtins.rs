//! Parameters and functions of the language.

use super::super::context::{Context, MEMO_ENTRIES, MEMO_WORDS};
use super::{Run, is_part, light, quiet, status, value_of, words_in, words_of};
use crate::builtins::{Builtin, Random};
use crate::mesh::Value;

use std::panic::catch_unwind;

impl Run<'_> {
    /// Stores the values given for parameters; `false` if one does not fit, or is a vertex of who knows where.
    pub(super) fn give_parameters(&mut self) -> bool {
        for (id, value) in &self.fixed.settings.params {
            let index = id.0 as usize;
            let Some(global) = self.fixed.program.globals.get(index).filter(|g| g.param.is_some()) else { continue };
            let Some(value) = crate::engine::interpret::convert_to(*value, global.ty) else { return false };
            let Some(words) = words_of(value).filter(|_| !matches!(value, Value::Vertex(Some(_)))) else {
                return false;
            };
            for (i, word) in words.into_iter().enumerate() {
                self.set_word(self.fixed.layout.global(index) + i, word);
            }
            self.set_word(self.fixed.layout.given(index), 1);
        }
        true
    }

    /// Lets every memo begin with the function's value at 0.
    pub(super) fn fill_memos(&mut self) {
        for memo in self.fixed.memos {
            let zeros = [Value::Double(0.0); 2];
            let operands = zeros.get(..memo.builtin.parameters().len()).unwrap_or(&zeros);
            let at_zero = memo.builtin.apply(operands, &mut Random::new(0, 0));
            if let Some(Value::Double(y)) = at_zero {
                for entry in 0..MEMO_ENTRIES {
                    self.set_word(memo.word + MEMO_WORDS * (entry + 1) - 1, y.to_bits());
                }
            }
        }
    }
}

/// Calls a builtin with operands in the words, one or three each.
pub(super) extern "C" fn call_builtin(context: *mut Context, index: u32) -> u32 {
    let apply = |random: &mut Random| {
        let builtin = Builtin::all().nth(index as usize)?;
        let words = words_in(context);
        let mut arguments = [Value::Bool(false); 4];
        let mut at = 0;
        for (argument, &ty) in arguments.iter_mut().zip(builtin.parameters()) {
            *argument = value_of(ty, words.get(at..)?);
            at += if ty == crate::mesh::Type::Vec { 3 } else { 1 };
        }
        let result = builtin.apply(arguments.get(..builtin.parameters().len())?, random)?;
        words[..3].copy_from_slice(&words_of(result)?);
        Some(status::DONE)
    };
    if is_part(context) {
        // Rounds of parallel loops draw no random numbers.
        quiet(status::REPEAT, || apply(&mut Random::new(0, 0)))
    } else {
        light(context, status::REPEAT, |run| apply(&mut run.random))
    }
}

/// Calls a function of one double by its address.
pub(super) extern "C" fn call_d1(_: *mut Context, function: usize, x: f64) -> f64 {
    // SAFETY: the address was taken from a function of this type when the program was compiled.
    let function = unsafe { std::mem::transmute::<usize, fn(f64) -> f64>(function) };
    catch_unwind(|| function(x)).unwrap_or(f64::NAN)
}

/// Calls a function of two doubles by its address.
pub(super) extern "C" fn call_d2(_: *mut Context, function: usize, x: f64, y: f64) -> f64 {
    // SAFETY: as in `call_d1`.
    let function = unsafe { std::mem::transmute::<usize, fn(f64, f64) -> f64>(function) };
    catch_unwind(|| function(x, y)).unwrap_or(f64::NAN)
}
