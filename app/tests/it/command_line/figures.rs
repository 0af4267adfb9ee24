//! Figures: files of lines and areas.

use super::*;

#[test]
fn a_figure_is_drawn_without_graphics_driver() {
    let folder = Folder::with(&[]);
    let mut command = folder.command("run move.vv -i octahedron.obj -n 1 -o a.svg --page 85mm");
    // Neither Vulkan nor OpenGL.
    command.env("VK_DRIVER_FILES", "/none").env("VK_ICD_FILENAMES", "/none").env("LIBGL_DRIVERS_PATH", "/none");
    assert!(command.status().unwrap().success());
    let text = folder.read("a.svg");
    assert!(text.starts_with("<svg ") && text.contains(" width=\"85mm\"") && text.ends_with("</svg>\n"), "{text}");
    assert!(!text.contains("id=\"hidden\""));
}

#[test]
fn a_figure_goes_to_stdout_and_is_the_same_each_time() {
    let folder = Folder::with(&[]);
    let draw = || folder.check("mesh convert octahedron.obj -o - --format svg --view front", 0, "").stdout;
    let first = draw();
    assert!(first.starts_with("<svg "), "{first}");
    assert_eq!(draw(), first);
}

#[test]
fn what_figures_leave_out_is_said() {
    let folder = Folder::with(&[]);
    let said = "figures leave out arrows, the grid, lines of reflection";
    let look = "--arrows vertex-normals --style grid,reflection-lines,smooth";
    folder.check(&format!("render octahedron.obj -o a.svg {look}"), 0, said);
    folder.check(&format!("mesh convert octahedron.obj -o a.svg {look}"), 0, said);
    folder.check("render octahedron.obj -o a.svg --style smooth", 0, "");
}

#[test]
fn short_inner_lines_are_thin_unless_their_width_is_chosen() {
    let folder = Folder::with(&[("split.vv", include_str!("../../../../assets/programs/paper-polyhedral.vv"))]);
    let width = |more: &str| {
        folder.check(&format!("run split.vv -i octahedron.obj -o a.svg --page 40mm {more}"), 0, "");
        let text = folder.read("a.svg");
        let inner = text.split("id=\"inner\"").nth(1).unwrap().to_owned();
        inner.split("stroke-width=\"").nth(1).unwrap().split('"').next().unwrap().to_owned()
    };
    assert_eq!(width("-n 0"), ".35");
    assert_eq!(width("-n 5"), ".2");
    assert_eq!(width("-n 5 --line inner=0.3"), ".3");
    folder.check("run split.vv -i octahedron.obj --generations 0,5 -n 5 -o a.svg --page 80mm", 0, "");
    let text = folder.read("a.svg");
    assert!(text.contains("id=\"inner\"") && text.contains("id=\"inner.2\""), "each name once");
}

#[test]
fn lines_are_drawn_as_asked_for() {
    let folder = Folder::with(&[]);
    folder.check(
        "mesh convert octahedron.obj -o a.svg --line hidden=0.2,#080,dotted --line inner=none --style vertices",
        0,
        "",
    );
    let text = folder.read("a.svg");
    assert!(text.contains("<g id=\"hidden\" fill=\"none\" stroke=\"#080\" stroke-width=\".2\""), "{text}");
    assert!(!text.contains("id=\"inner\"") && text.contains("id=\"vertices\""), "{text}");
    check("mesh convert octahedron.obj -o a.svg --line innner", 2, "did you mean `inner`?");
    check("mesh convert octahedron.obj -o a.svg --page A4", 2, "a page is a width in millimetres");
}

#[test]
fn a_figure_that_cannot_be_made_leaves_nothing() {
    check("mesh convert octahedron.obj -o no/a.svg", 3, "there is no directory `no`");
    check("mesh convert octahedron.obj -o /dev/full --format svg", 3, "no space is left on the device");
    let folder = Folder::with(&[("away.txt", "eye 0 0 5 target 0 0 9")]);
    let said = "nothing of the mesh is seen from there, so there is no figure";
    folder.check("mesh convert octahedron.obj -o a.svg --view away.txt", 2, said);
}

#[test]
fn a_figure_is_of_the_kind_that_its_name_says() {
    let folder = Folder::with(&[]);
    folder.check("run triangle.vv -o a.eps -o a.pdf -o a.svg", 0, "");
    assert!(folder.read("a.eps").starts_with("%!PS-Adobe-3.0 EPSF-3.0\n"));
    assert!(fs::read(folder.path("a.pdf")).unwrap().starts_with(b"%PDF-1.4\n"));
    assert!(folder.read("a.svg").contains("<g id=\"faces\""));
}

/// What is written on a figure, in its order.
fn written(svg: &str) -> Vec<String> {
    let document = roxmltree::Document::parse(svg).unwrap();
    document.descendants().filter_map(|node| node.attribute("aria-label")).map(str::to_owned).collect()
}

#[test]
fn labels_are_written_at_what_is_seen() {
    let folder = Folder::with(&[]);
    let labels = |options: &str| {
        folder.check(&format!("mesh convert octahedron.obj -o a.svg {options}"), 0, "");
        written(&folder.read("a.svg"))
    };
    assert_eq!(labels("").len(), 0);
    assert_eq!(labels("--labels vertices --view front"), ["v1", "v2", "v3", "v4", "v5"]);
    assert_eq!(labels("--labels degrees --view front"), ["3"; 4]);
    assert_eq!(labels("--labels numbers --color-by valence --view front"), ["4"; 5]);
    assert_eq!(labels("--ring v5 --view front --style axes"), ["1", "2", "3", "4", "x", "y", "z"]);
    let large = |size: &str| labels(&format!("--labels vertices --font-size {size}")).len();
    assert!(large("150") < large("7pt"));
}

#[test]
fn labels_that_a_mesh_cannot_have_are_refused() {
    check("mesh convert octahedron.obj -o a.svg --labels heat", 2, "no vertex property `heat` here");
    check("mesh convert octahedron.obj -o a.svg --labels numbers", 2, "add `--color-by WHAT`");
    check(
        "mesh convert octahedron.obj -o a.svg --color-by change:x",
        2,
        "the number of a generation, as in `change:2`",
    );
    check("mesh convert octahedron.obj -o a.svg --ring 7", 2, "there is no vertex v7 whose ring could be shown");
    check("mesh convert octahedron.obj -o a.svg --ring 0", 2, "vertices are counted from 1");
    check("mesh convert octahedron.obj -o a.svg --font-size 0", 2, "the height of letters is in points");
}

#[test]
fn pictures_have_labels_too() {
    let folder = Folder::with(&[]);
    folder.check("mesh convert octahedron.obj -o a.png --size 200x200", 0, "");
    folder.check("mesh convert octahedron.obj -o b.png --size 200x200 --labels vertices --ring 1 --style axes", 0, "");
    let [a, b] = ["a.png", "b.png"].map(|name| image::open(folder.path(name)).unwrap().into_rgba8());
    let changed = a.pixels().zip(b.pixels()).filter(|(a, b)| a != b).count();
    assert!((200..8000).contains(&changed), "{changed} pixels");
}

#[test]
fn several_generations_stand_side_by_side_in_one_measure() {
    let folder = Folder::with(&[("same.vv", "void step(mesh& S) { }\n")]);
    folder.check("run same.vv -i octahedron.obj --generations 0-2 -o a.svg -o a.pdf --view front", 0, "");
    let text = folder.read("a.svg");
    assert_eq!(written(&text), ["generation 0", "generation 1", "generation 2"]);
    assert!(text.contains(" width=\"160mm\""), "{text}");
    assert_eq!(text.matches("id=\"faces\"").count(), 1, "each name once");
    folder.check("run same.vv -i octahedron.obj --generations 0-3 -o b_{n}.svg --view front", 0, "");
    assert!(written(&folder.read("b_3.svg")).is_empty());
    // In rows, where the page is high.
    let size = |page: &str| {
        folder.check(
            &format!("run same.vv -i octahedron.obj --generations 0-3 -o c.eps --view front --page {page}"),
            0,
            "",
        );
        let text = folder.read("c.eps");
        let mut numbers = text.lines().nth(2).unwrap().split(' ').skip(3).map(|x| x.parse::<f64>().unwrap());
        (numbers.next().unwrap(), numbers.next().unwrap())
    };
    let (across, down) = size("100x120mm");
    assert!(across < 1.2 * down && down < 1.3 * across, "{across} {down}: two rows of two");
    let (across, down) = size("170mm");
    assert!(across > 3.0 * down, "{across} {down}: one row");
}

#[test]
fn values_that_are_swept_stand_side_by_side_and_a_run_that_fails_leaves_its_place() {
    let text = "param double w = 1;\nvoid step(mesh& S) { forall v in S v$pos *= 1 / (1 - floor(w)); }\n";
    let folder = Folder::with(&[("grow.vv", text)]);
    folder.check("run grow.vv -i octahedron.obj -D w=0.5,0.75 -o a.svg", 0, "");
    assert_eq!(written(&folder.read("a.svg")), ["w = 0.5", "w = 0.75"]);
}

#[test]
fn lines_far_away_are_lighter_where_that_is_asked_for() {
    let folder = Folder::with(&[("look.json", "{\"fade\": 1}")]);
    let lightest = |options: &str| {
        folder.check(&format!("mesh convert octahedron.obj -o a.svg {options}"), 0, "");
        let text = folder.read("a.svg");
        text.split("stroke=\"#").skip(1).filter(|t| t.contains("linecap")).map(|t| t[..3].to_owned()).max().unwrap()
    };
    assert_eq!(lightest(""), "000");
    let [some, more] = ["--fade=0.3", "--fade"].map(lightest);
    assert!("000" < some.as_str() && some < more, "{some} {more}");
    assert!(more < lightest("--style look.json"));
    check("mesh convert octahedron.obj -o a.svg --fade=2", 2, "lines fade by a number from 0 to 1");
}

#[test]
fn a_ring_that_is_not_seen_is_told_once() {
    const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
                        f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    let folder = Folder::with(&[("cube.obj", CUBE)]);
    let hidden = "the ring of v1 is not drawn: the vertex is hidden by faces";
    for more in ["", "-o b.png", "-o b.png -o c.pdf"] {
        let said = folder.check(&format!("render cube.obj -o a.svg --ring 1 {more}"), 0, hidden).stderr;
        assert_eq!(said.matches(hidden).count(), 1, "{said}");
    }
    folder.check("render cube.obj -o a.svg --ring 7", 0, "");
    // Who goes around it sees all of it.
    folder.check("render cube.obj -o a.gif --ring 1 --turntable 4 --view front --size 64x64", 0, "");
    folder.check("render cube.obj -o a.png --labels vertices --cut x:1 --size 64x64", 0, "");
}

#[test]
fn a_mesh_that_cannot_be_drawn_is_refused_with_a_reason() {
    let grow = "param double by = 1; void step(mesh& S) { forall v in S v$pos *= by; }\n";
    let folder = Folder::with(&[("grow.vv", grow)]);
    for output in ["a.svg", "a.png", "a.pdf"] {
        let refused = |by: &str, said: &str| {
            folder.check(&format!("run grow.vv -i octahedron.obj -D by={by} -o {output}"), 1, said);
        };
        refused("1e300", "its coordinates reach 1e300, and up to 1e75 can be drawn");
        refused("1e-300", "it is 2e-300 in size, and from 1e-75 on it could be drawn");
        folder.check(&format!("run grow.vv -i octahedron.obj -D by=1e60 -o {output}"), 0, "");
    }
    let nowhere = "void step(mesh& S) { forall v in S v$pos *= sqrt(-1.0); }\n";
    check_file("no.vv", nowhere, "run no.vv -i octahedron.obj -o a.svg", 1, "no vertex has a finite position");
    folder.check("run grow.vv -i octahedron.obj -D by=0 -o a.svg", 2, "nothing of the mesh is seen from there");
    folder.check("run grow.vv -i octahedron.obj -D by=0 -o a.off", 0, "");
}
