//! The runtime functions by name, with the types compiled code calls them by.

use cranelift_codegen::ir::{Type, types};

use super::{builtins, edges, lists, memory, parallel, print, rings, sets};

macro_rules! runtime {
    ($($name:ident = $function:path, ($($operand:ident),*) $(-> $result:ident)?;)*) => {
        /// A runtime function; the first operand of most is the context.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub(in super::super) enum Symbol {
            $($name,)*
        }

        impl Symbol {
            /// All of them.
            pub(in super::super) const ALL: &[Self] = &[$(Self::$name,)*];

            /// What the linker calls it.
            pub(in super::super) fn name(self) -> &'static str {
                match self {
                    $(Self::$name => stringify!($name),)*
                }
            }

            /// Types of its operands.
            pub(in super::super) fn operands(self) -> &'static [Type] {
                match self {
                    $(Self::$name => &[$(types::$operand,)*],)*
                }
            }

            /// Type of its result.
            pub(in super::super) fn result(self) -> Option<Type> {
                match self {
                    $(Self::$name => [$(types::$result)?].first().copied(),)*
                }
            }
        }

        /// Where each lies.
        pub(in super::super) fn symbols() -> Vec<(&'static str, *const u8)> {
            vec![$((stringify!($name), $function as *const u8),)*]
        }
    };
}

runtime! {
    GrowVertices = memory::grow_vertices, (I64) -> I32;
    GrowSlots = memory::grow_slots, (I64, I64) -> I32;
    Parallel = parallel::parallel, (I64, I32, I64, I64, I64) -> I32;
    Unwind = super::unwind, (I64, I32);
    CallBuiltin = builtins::call_builtin, (I64, I32) -> I32;
    CallD1 = builtins::call_d1, (I64, I64, F64) -> F64;
    CallD2 = builtins::call_d2, (I64, I64, F64, F64) -> F64;
    Synchronize = rings::synchronize, (I64, I32, I32) -> I32;
    Holds = rings::holds, (I64, I32) -> I32;
    Make = rings::make, (I64, I32, I64, I32) -> I32;
    Erase = rings::erase, (I64, I32, I32) -> I32;
    Replace = rings::replace, (I64, I32, I32, I32) -> I32;
    Splice = rings::splice, (I64, I32, I32, I32, I32) -> I32;
    Find = rings::find, (I64, I32, I32, I32) -> I32;
    Gaps = rings::gaps, (I64, I32, I32) -> I32;
    Walk = lists::walk, (I64, I64, I32) -> I32;
    ListNew = lists::list_new, (I64) -> I32;
    ListCopy = lists::list_copy, (I64, I64, I32) -> I32;
    ListDrop = lists::list_drop, (I64, I64);
    ListAssign = lists::list_assign, (I64, I32, I64, I32) -> I32;
    ListPush = lists::list_push, (I64, I32, I32) -> I32;
    ListErase = lists::list_erase, (I64, I32, I32) -> I32;
    ListReplace = lists::list_replace, (I64, I32, I32, I32) -> I32;
    ListSplice = lists::list_splice, (I64, I32, I32, I32, I32) -> I32;
    ListFind = lists::list_find, (I64, I64, I32, I32) -> I32;
    ListBegin = lists::list_begin, (I64, I64, I32, I32, I32) -> I32;
    ListReturn = lists::list_return, (I64, I64, I32) -> I32;
    ListTake = lists::list_take, (I64) -> I32;
    PrintList = lists::print_list, (I64, I64, I32) -> I32;
    Faces = lists::faces, (I64, I32) -> I64;
    FacesEnd = lists::faces_end, (I64, I64);
    EdgeLoad = rings::edge_load, (I64, I32, I32, I32, I32) -> I32;
    EdgeStore = rings::edge_store, (I64, I32, I32, I32) -> I32;
    MeshLoad = edges::mesh_load, (I64, I32, I32) -> I32;
    MeshStore = edges::mesh_store, (I64, I32, I32) -> I32;
    SetNew = sets::set_new, (I64) -> I32;
    SetCopy = sets::set_copy, (I64, I32) -> I32;
    SetDrop = sets::set_drop, (I64, I64);
    SetDeclare = sets::set_declare, (I64, I32, I32) -> I32;
    SetAssign = sets::set_assign, (I64, I32, I32) -> I32;
    SetMerge = sets::set_merge, (I64, I32, I32) -> I32;
    SetAdd = sets::set_add, (I64, I32, I32) -> I32;
    SetRemove = sets::set_remove, (I64, I32, I32) -> I32;
    SetContains = sets::set_contains, (I64, I32, I32) -> I32;
    SetReturn = sets::set_return, (I64, I32) -> I32;
    SetTake = sets::set_take, (I64) -> I32;
    SetWalk = sets::set_walk, (I64, I32) -> I64;
    SetWalkEnd = sets::set_walk_end, (I64, I64);
    PrintBegin = print::print_begin, (I64);
    PrintText = print::print_text, (I64, I32);
    PrintValue = print::print_value, (I64, I32);
    PrintSet = print::print_set, (I64, I32) -> I32;
    PrintEnd = print::print_end, (I64) -> I32;
}
