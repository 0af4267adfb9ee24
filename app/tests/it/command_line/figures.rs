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
