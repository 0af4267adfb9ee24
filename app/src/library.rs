//! The programs and meshes that ship with vv, in the binary.

use std::io::ErrorKind;
use std::path::Path;

use vv::Included;

/// A text that ships with vv.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shipped {
    /// File name.
    pub name: &'static str,
    /// What is in it.
    pub text: &'static str,
}

/// The programs by name.
pub const PROGRAMS: &[Shipped] = &[
    Shipped { name: "paper-polyhedral.vv", text: include_str!("../../assets/programs/paper-polyhedral.vv") },
    Shipped { name: "paper-loop.vv", text: include_str!("../../assets/programs/paper-loop.vv") },
    Shipped { name: "paper-butterfly.vv", text: include_str!("../../assets/programs/paper-butterfly.vv") },
    Shipped { name: "paper-sqrt3.vv", text: include_str!("../../assets/programs/paper-sqrt3.vv") },
    Shipped { name: "loop.vv", text: include_str!("../../assets/programs/loop.vv") },
    Shipped { name: "loop-creases.vv", text: include_str!("../../assets/programs/loop-creases.vv") },
    Shipped { name: "butterfly.vv", text: include_str!("../../assets/programs/butterfly.vv") },
    Shipped { name: "sqrt3.vv", text: include_str!("../../assets/programs/sqrt3.vv") },
    Shipped { name: "catmull-clark.vv", text: include_str!("../../assets/programs/catmull-clark.vv") },
    Shipped { name: "catmull-clark-creases.vv", text: include_str!("../../assets/programs/catmull-clark-creases.vv") },
    Shipped { name: "colors.vv", text: include_str!("../../assets/programs/colors.vv") },
    Shipped { name: "doo-sabin.vv", text: include_str!("../../assets/programs/doo-sabin.vv") },
    Shipped { name: "quad-triangle.vv", text: include_str!("../../assets/programs/quad-triangle.vv") },
    Shipped { name: "midedge.vv", text: include_str!("../../assets/programs/midedge.vv") },
    Shipped { name: "four-eight.vv", text: include_str!("../../assets/programs/four-eight.vv") },
    Shipped { name: "conway.vv", text: include_str!("../../assets/programs/conway.vv") },
    Shipped { name: "curves.vv", text: include_str!("../../assets/programs/curves.vv") },
    Shipped { name: "limit.vv", text: include_str!("../../assets/programs/limit.vv") },
    Shipped { name: "smooth.vv", text: include_str!("../../assets/programs/smooth.vv") },
    Shipped { name: "delaunay.vv", text: include_str!("../../assets/programs/delaunay.vv") },
    Shipped { name: "remesh.vv", text: include_str!("../../assets/programs/remesh.vv") },
    Shipped { name: "mountain.vv", text: include_str!("../../assets/programs/mountain.vv") },
    Shipped { name: "koch.vv", text: include_str!("../../assets/programs/koch.vv") },
    Shipped { name: "sierpinski.vv", text: include_str!("../../assets/programs/sierpinski.vv") },
    Shipped {
        name: "sierpinski-tetrahedron.vv",
        text: include_str!("../../assets/programs/sierpinski-tetrahedron.vv"),
    },
    Shipped { name: "penrose.vv", text: include_str!("../../assets/programs/penrose.vv") },
    Shipped { name: "coral.vv", text: include_str!("../../assets/programs/coral.vv") },
    Shipped { name: "tissue.vv", text: include_str!("../../assets/programs/tissue.vv") },
    Shipped { name: "reaction-diffusion.vv", text: include_str!("../../assets/programs/reaction-diffusion.vv") },
    Shipped { name: "distance.vv", text: include_str!("../../assets/programs/distance.vv") },
    Shipped { name: "insert.vv", text: include_str!("../../assets/programs/insert.vv") },
    Shipped { name: "split.vv", text: include_str!("../../assets/programs/split.vv") },
    Shipped { name: "edits.vv", text: include_str!("../../assets/programs/edits.vv") },
    Shipped { name: "geometry.vv", text: include_str!("../../assets/programs/geometry.vv") },
    Shipped { name: "build.vv", text: include_str!("../../assets/programs/build.vv") },
    Shipped { name: "inherit.vv", text: include_str!("../../assets/programs/inherit.vv") },
    Shipped { name: "fine.vv", text: include_str!("../../assets/programs/fine.vv") },
    Shipped { name: "creases.vv", text: include_str!("../../assets/programs/creases.vv") },
    Shipped { name: "solids.vv", text: include_str!("../../assets/programs/solids.vv") },
    Shipped { name: "ptq.vv", text: include_str!("../../assets/programs/ptq.vv") },
    Shipped { name: "ptt.vv", text: include_str!("../../assets/programs/ptt.vv") },
    Shipped { name: "pqq.vv", text: include_str!("../../assets/programs/pqq.vv") },
    Shipped { name: "dqq.vv", text: include_str!("../../assets/programs/dqq.vv") },
];

/// The meshes by name.
pub const MESHES: &[Shipped] = &[
    Shipped { name: "octahedron.obj", text: include_str!("../../assets/meshes/octahedron.obj") },
    Shipped { name: "tetrahedron.obj", text: include_str!("../../assets/meshes/tetrahedron.obj") },
    Shipped { name: "cube.obj", text: include_str!("../../assets/meshes/cube.obj") },
    Shipped { name: "icosahedron.obj", text: include_str!("../../assets/meshes/icosahedron.obj") },
    Shipped { name: "dodecahedron.obj", text: include_str!("../../assets/meshes/dodecahedron.obj") },
    Shipped { name: "rhombicuboctahedron.obj", text: include_str!("../../assets/meshes/rhombicuboctahedron.obj") },
    Shipped { name: "torus.obj", text: include_str!("../../assets/meshes/torus.obj") },
    Shipped { name: "torus-quads.obj", text: include_str!("../../assets/meshes/torus-quads.obj") },
    Shipped { name: "genus-2.obj", text: include_str!("../../assets/meshes/genus-2.obj") },
    Shipped { name: "genus-2-quads.obj", text: include_str!("../../assets/meshes/genus-2-quads.obj") },
    Shipped { name: "cube-frame.obj", text: include_str!("../../assets/meshes/cube-frame.obj") },
    Shipped { name: "cube-creased.obj", text: include_str!("../../assets/meshes/cube-creased.obj") },
    Shipped { name: "pawn.obj", text: include_str!("../../assets/meshes/pawn.obj") },
    Shipped { name: "elephant.obj", text: include_str!("../../assets/meshes/elephant.obj") },
    Shipped { name: "tetrapod.obj", text: include_str!("../../assets/meshes/tetrapod.obj") },
    Shipped { name: "cube-open.obj", text: include_str!("../../assets/meshes/cube-open.obj") },
    Shipped { name: "cube-open-quads.obj", text: include_str!("../../assets/meshes/cube-open-quads.obj") },
    Shipped { name: "square-open.obj", text: include_str!("../../assets/meshes/square-open.obj") },
    Shipped { name: "grid-open.obj", text: include_str!("../../assets/meshes/grid-open.obj") },
    Shipped { name: "grid-open-quads.obj", text: include_str!("../../assets/meshes/grid-open-quads.obj") },
    Shipped { name: "knot.obj", text: include_str!("../../assets/meshes/knot.obj") },
    Shipped { name: "star.obj", text: include_str!("../../assets/meshes/star.obj") },
];

/// The program of a name.
#[must_use]
pub fn program(name: &str) -> Option<&'static Shipped> {
    PROGRAMS.iter().find(|p| p.name == name)
}

/// The program that is meant by a path that is a name only, and that nothing has.
#[must_use]
pub fn meant(path: &Path) -> Option<&'static Shipped> {
    path.to_str().filter(|_| is_free(path)).and_then(program)
}

/// Whether nothing is there.
#[must_use]
pub fn is_free(path: &Path) -> bool {
    path.symlink_metadata().is_err_and(|error| error.kind() == ErrorKind::NotFound)
}

/// The name of the program that is probably meant by one that none has: folder, case and extension may be others.
#[must_use]
pub fn nearly(path: &Path) -> Option<&'static str> {
    let name = path.file_name()?.to_str()?.to_lowercase();
    let mut names = PROGRAMS.iter().map(|program| program.name);
    names.find(|shipped| shipped.strip_suffix(".vv") == Some(name.strip_suffix(".vv").unwrap_or(&name)))
}

/// The program of a name as an include; diagnostics call it `<vv>/name`.
#[must_use]
pub fn include(name: &str) -> Option<Included> {
    program(name).map(|p| Included { name: format!("<vv>/{}", p.name), text: p.text.to_owned() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn holds_all_of(folder: &str, table: &[Shipped]) {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets").join(folder);
        let files = std::fs::read_dir(folder).into_iter().flatten();
        let files = files.map(|f| f.unwrap().path()).filter(|f| f.is_file()); // bad meshes lie in a folder of their own
        let mut files: Vec<_> = files.map(|f| f.file_name().unwrap().to_string_lossy().into_owned()).collect();
        let mut shipped: Vec<_> = table.iter().map(|s| s.name.to_owned()).collect();
        files.sort();
        shipped.sort();
        assert_eq!(shipped, files);
    }

    #[test]
    fn every_asset_ships() {
        holds_all_of("programs", PROGRAMS);
        holds_all_of("meshes", MESHES);
    }
}
