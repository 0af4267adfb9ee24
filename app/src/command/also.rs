//! Other words for commands, as other programs and textbooks call them: the palette and the sheet of keys know them.

use super::{Command, Inspect, PairAction, Panel, TextAction, ThemeChoice, ViewAction};
use crate::annotate::{Arrows, Label, Quantity};
use crate::navigation::Turning;
use crate::scene::Surface;
use crate::session::Purpose;

/// Commands that are known by other words, too.
const ALSO: &[(Command, &str)] = &[
    (Command::NewProgram, "create script"),
    (Command::Choose(Purpose::OpenProgram), "load script"),
    (Command::Choose(Purpose::OpenMesh), "import load model obj ply stl off"),
    (Command::Choose(Purpose::SaveProgram), "write script"),
    (Command::Choose(Purpose::ExportMesh), "export write model obj ply stl off"),
    (Command::Choose(Purpose::SaveProject), "workspace"),
    (Command::Choose(Purpose::SaveMask), "stencil export figure"),
    (Command::SavePicture, "screenshot export image png svg pdf figure render"),
    (Command::CopyImage, "screenshot clipboard"),
    (Command::Gallery, "examples samples tutorial"),
    (Command::Preferences, "settings options configure"),
    (Command::Quit, "exit close"),
    (Command::Undo, "revert"),
    (Command::Text(TextAction::Find), "search"),
    (Command::Text(TextAction::Replace), "substitute"),
    (Command::Text(TextAction::Complete), "autocomplete suggest"),
    (Command::Text(TextAction::Declaration), "definition jump"),
    (Command::Text(TextAction::Format), "indent pretty beautify fmt"),
    (Command::Text(TextAction::NextProblem), "error warning"),
    (Command::Text(TextAction::RaiseNumber), "increase increment tweak"),
    (Command::Text(TextAction::LowerNumber), "decrease decrement tweak"),
    (Command::Step, "subdivide refine iterate next apply"),
    (Command::Back, "previous coarser"),
    (Command::Rewind, "first reset restart"),
    (Command::Play, "animate pause"),
    (Command::Stop, "cancel abort interrupt kill"),
    (Command::Run, "reload refresh recompute execute compile"),
    (Command::ResetParams, "default sliders"),
    (Command::Fit, "zoom extents frame home centre"),
    (Command::View(ViewAction::RenderOptions), "shading display appearance"),
    (Command::Faces, "wireframe fill solid polygons shading"),
    (Command::Smooth, "shading gouraud phong flat normals"),
    (Command::Edges, "wireframe lines"),
    (Command::Vertices, "points dots"),
    (Command::Control, "cage coarse polyhedron"),
    (Command::Toggle(Panel::Program), "editor code source"),
    (Command::Toggle(Panel::Messages), "console errors output log"),
    (Command::Toggle(Panel::Inspector), "sidebar properties parameters"),
    (Command::Toggle(Panel::Timeline), "history generations"),
    (Command::SetTheme(ThemeChoice::Dark), "night mode appearance"),
    (Command::SetTheme(ThemeChoice::Light), "day mode appearance"),
    (Command::Subdivide("loop.vv"), "subdivide refine triangles"),
    (Command::Subdivide("butterfly.vv"), "subdivide refine triangles dyn"),
    (Command::Subdivide("sqrt3.vv"), "subdivide refine sqrt3 root kobbelt"),
    (Command::Subdivide("catmull-clark.vv"), "subdivide refine quads"),
    (Command::Subdivide("doo-sabin.vv"), "subdivide refine"),
    (Command::Subdivide("quad-triangle.vv"), "subdivide refine stam"),
    (Command::Subdivide("midedge.vv"), "subdivide refine peters reif simplest"),
    (Command::Subdivide("four-eight.vv"), "subdivide refine velho bisection"),
    (Command::Pair(PairAction::Compare), "split two windows difference"),
    (Command::Pair(PairAction::LinkViews), "synchronize camera"),
    (Command::View(ViewAction::Orthographic), "parallel perspective projection"),
    (Command::View(ViewAction::Copy), "camera share"),
    (Command::View(ViewAction::SetTurning(Turning::Arcball)), "trackball rotate orbit"),
    (Command::View(ViewAction::SetTurning(Turning::Turntable)), "rotate orbit upright"),
    (Command::Inspect(Inspect::AskForVertex), "go to id number index"),
    (Command::Inspect(Inspect::Fly), "zoom focus frame"),
    (Command::Inspect(Inspect::Clear), "deselect unselect none"),
    (Command::Inspect(Inspect::WalkOn), "edmonds orbit traverse face"),
    (Command::Inspect(Inspect::Mask), "stencil weights coefficients"),
    (Command::Inspect(Inspect::OldRing), "previous neighbours"),
    (Command::Inspect(Inspect::ListProblems), "check validate manifold holes errors planarity degenerate"),
    (Command::ColorBy(Quantity::Valence), "extraordinary irregular neighbours"),
    (Command::ColorBy(Quantity::Gauss), "heat map k"),
    (Command::ColorBy(Quantity::Mean), "heat map h"),
    (Command::ColorBy(Quantity::Birth), "age history level"),
    (Command::ColorBy(Quantity::Change), "difference born died moved"),
    (Command::LabelBy(Label::Vertices), "ids indices names numbers"),
    (Command::LabelBy(Label::Numbers), "values"),
    (Command::ArrowsOf(Arrows::VertexNormals), "vectors"),
    (Command::ArrowsOf(Arrows::FaceNormals), "vectors"),
    (Command::ShowBy(Surface::Lights), "shading shaded plain"),
    (Command::ShowBy(Surface::ReflectionLines), "zebra stripes mirror environment"),
    (Command::ShowBy(Surface::Isophotes), "zebra bands"),
    (Command::Cut, "clip clipping section slice plane"),
    (Command::Occlusion, "ssao ao shadows shading depth"),
    (Command::Grid, "ground floor"),
    (Command::Axes, "gizmo directions"),
    (Command::CheatSheet, "shortcuts hotkeys keyboard mouse help"),
    (Command::Reference, "manual help documentation"),
    (Command::Palette, "search find"),
];

impl Command {
    /// Other words for it, with spaces between; empty if there are none.
    #[must_use]
    pub fn also(&self) -> &'static str {
        ALSO.iter().find(|(command, _)| command == self).map_or("", |(_, words)| words)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::command::MENUS;

    #[test]
    fn what_is_known_by_other_words_stands_in_a_menu_once() {
        for (i, (command, words)) in ALSO.iter().enumerate() {
            assert!(MENUS.iter().any(|menu| menu.groups.iter().any(|group| group.contains(command))), "{command:?}");
            assert!(!ALSO[..i].iter().any(|(other, _)| other == command), "{command:?} twice");
            let label = command.describe().label.to_lowercase();
            for word in words.split(' ') {
                assert!(!word.is_empty() && word == word.to_lowercase(), "{command:?}: {word:?}");
                assert!(!label.split(' ').any(|l| l == word), "{command:?} is called {word} already");
            }
        }
    }
}
