//! The subdivision schemes that ship with vv, each a program.

use eframe::egui::{Key, KeyboardShortcut};

use super::{Description, shift};

/// A scheme.
struct Scheme {
    program: &'static str,
    label: &'static str,
    tooltip: &'static str,
    key: KeyboardShortcut,
}

const fn scheme(program: &'static str, label: &'static str, tooltip: &'static str, key: Key) -> Scheme {
    Scheme { program, label, tooltip, key: shift(key) }
}

const SCHEMES: &[Scheme] = &[
    scheme("loop.vv", "Loop", "Loop's scheme for triangles, on the mesh shown", Key::L),
    scheme("butterfly.vv", "Butterfly", "the modified butterfly for triangles, which interpolates", Key::B),
    scheme("sqrt3.vv", "√3", "Kobbelt's scheme for triangles, three from each", Key::R),
    scheme("catmull-clark.vv", "Catmull–Clark", "Catmull and Clark's scheme for any polygons", Key::C),
    scheme("doo-sabin.vv", "Doo–Sabin", "Doo and Sabin's scheme for any polygons", Key::D),
    scheme("quad-triangle.vv", "Quad/triangle", "Stam and Loop's scheme for triangles and quads", Key::Q),
    scheme("midedge.vv", "Midedge", "the simplest scheme, from the middles of edges", Key::M),
    scheme("four-eight.vv", "4–8", "Velho and Zorin's scheme, which halves triangles", Key::H),
];

/// How the command for a scheme presents itself.
pub(super) fn describe(program: &str) -> Description {
    let none = Description { label: "", tooltip: "", shortcuts: &[] };
    SCHEMES.iter().find(|scheme| scheme.program == program).map_or(none, |scheme| Description {
        label: scheme.label,
        tooltip: scheme.tooltip,
        shortcuts: std::slice::from_ref(&scheme.key),
    })
}
