//! Pictures, and `--reference` with them.

use super::*;

fn size(path: &Path) -> (u32, u32) {
    image::image_dimensions(path).unwrap()
}

#[test]
fn a_picture_has_the_size_asked_for() {
    let folder = Folder::with(&[]);
    folder.check("run move.vv -i octahedron.obj -o a.png", 0, "");
    assert_eq!(size(&folder.path("a.png")), (1280, 960));
    folder.check("mesh convert square.off -o b.png --size 90x60", 0, "");
    assert_eq!(size(&folder.path("b.png")), (90, 60));
    let colors: std::collections::HashSet<_> =
        image::open(folder.path("b.png")).unwrap().into_rgba8().pixels().copied().collect();
    assert!(colors.len() > 2, "the picture is empty");
}

/// How much of a picture the mesh covers, from 0 to 1.
fn covered(path: &Path) -> f64 {
    let picture = image::open(path).unwrap().into_rgba8();
    let background = |p: &&image::Rgba<u8>| p.0[0].abs_diff(p.0[2]) < 20;
    1.0 - picture.pixels().filter(background).count() as f64 / f64::from(picture.width() * picture.height())
}

#[test]
fn a_picture_is_taken_from_the_viewpoint_asked_for() {
    let near = "vv view: eye 0 0 3 target 0 0 0 up 0 1 0 orthographic 1\n";
    let folder = Folder::with(&[("near.txt", near), ("far.txt", "eye 0 0 30, target 0 0 0")]);
    let shoot = |view: &str| {
        folder.check(&format!("run move.vv -i octahedron.obj -n 0 -o a.png --size 60x60 --view {view}"), 0, "");
        covered(&folder.path("a.png"))
    };
    assert!(shoot("near.txt") > 0.99);
    assert!(shoot("far.txt") < 0.05);
    let front = shoot("front");
    assert!(front > 0.3 && (front - shoot("top")).abs() < 0.02, "an octahedron looks alike from all its corners");
    assert!(shoot("isometric") > front + 0.05, "and larger from a face");
    let mut command = folder.command("mesh convert octahedron.obj -o b.png --size 60x60 --view");
    assert!(command.arg("front orthographic z-up").status().unwrap().success());
    assert!(covered(&folder.path("b.png")) > 0.3);
}

#[test]
fn what_is_no_viewpoint_is_refused_before_anything_is_run() {
    let folder = Folder::with(&[("bad.txt", "vv view: eye 0 0 3\n target 0 0 x\n")]);
    let said = "`frnot` does not belong here\none of front, back, left, right, top, bottom and isometric";
    folder.check("run endless.vv -i octahedron.obj -o a.png --view frnot", 2, said);
    let said = "bad.txt:2:13\n`target` is followed by three numbers";
    folder.check("run endless.vv -i octahedron.obj -o a.png --view bad.txt", 2, said);
    folder.check("--view sideways", 2, "`sideways` does not belong here");
}

#[test]
fn a_picture_goes_to_stdout_as_it_is() {
    let folder = Folder::with(&[]);
    let mut command = folder.command("run triangle.vv -o - --format png --size 8x8");
    let output = command.output().unwrap();
    assert_eq!((output.status.code(), &output.stdout[..4]), (Some(0), &b"\x89PNG"[..]));
    assert_eq!(output.stderr, b"started\n");
}

#[test]
fn a_picture_is_compared_with_an_earlier_one() {
    let folder = Folder::with(&[]);
    folder.check("run move.vv -i octahedron.obj -n 0 -o old.png --size 120x90", 0, "");
    folder.check("run move.vv -i octahedron.obj -n 0 --reference old.png", 0, "");
    let said = "the picture is not old.png: the pixel at (";
    folder.check("run triangle.vv --reference old.png", 5, said);
    folder.check("run triangle.vv --reference old.png --tolerance 1", 0, "");
    let said = "it has 60x45 pixels in place of 120x90";
    folder.check("run triangle.vv --reference old.png --size 60x45", 5, said);
}

#[test]
fn a_reference_that_is_no_picture_is_refused() {
    check_file("old.png", "no picture", "run triangle.vv --reference old.png", 3, "old.png: is no PNG picture");
    check("run triangle.vv --reference none.png", 3, "none.png: there is no such file or directory");
}

#[test]
fn a_picture_is_coloured_by_what_is_asked_for() {
    let folder = Folder::with(&[]);
    let mut seen = std::collections::HashSet::new();
    for look in ["", " --color-by valence", " --color-by x", " --color-by x --color-range 0,9", " --color-by birth"] {
        folder.check(&format!("run move.vv -i octahedron.obj -n 2 -o a.png --size 60x45{look}"), 0, "");
        seen.insert(fs::read(folder.path("a.png")).unwrap());
    }
    assert_eq!(seen.len(), 5, "all are different");
    let said = "the picture cannot be coloured by `heat`\n = no vertex property `heat` here";
    folder.check("run move.vv -i octahedron.obj -o a.png --color-by heat", 2, said);
    folder.check("run move.vv -i octahedron.obj -o a.png --color-range 0,1", 2, "--color-by");
}

#[test]
fn a_picture_is_drawn_in_the_style_asked_for() {
    let folder = Folder::with(&[]);
    let mut seen = std::collections::HashSet::new();
    for look in ["", "--style no-edges", "--style dark,grid", "--style isophotes,smooth", "--cut x", "--cut -y:0.2"] {
        folder.check(&format!("mesh convert octahedron.obj -o a.png --size 60x45 {look}"), 0, "");
        seen.insert(fs::read(folder.path("a.png")).unwrap());
    }
    assert_eq!(seen.len(), 6, "all are different");
    folder.check("mesh convert octahedron.obj -o a.png --style smoth", 2, "did you mean `smooth`?");
}

/// The colour of the pixel in the upper left corner, and of the one in the middle.
fn corner_and_middle(path: &Path) -> [[u8; 4]; 2] {
    let picture = image::open(path).unwrap().into_rgba8();
    [picture.get_pixel(0, 0).0, picture.get_pixel(picture.width() / 2, picture.height() / 2).0]
}

#[test]
fn a_style_file_says_what_pictures_look_like_and_the_command_line_goes_before_it() {
    let look = "{\"style\": {\"edges\": false, \"smooth\": true}, \"annotations\": {\"color_by\": \"x\"},\n\
                \"background\": \"#ff0000\"}";
    let folder = Folder::with(&[("look.json", look)]);
    let shoot = |options: &str| {
        folder.check(&format!("mesh convert octahedron.obj -o a.png --size 60x45 {options}"), 0, "");
        fs::read(folder.path("a.png")).unwrap()
    };
    let by_file = shoot("--style look.json");
    assert_eq!(by_file, shoot("--style no-edges,smooth --color-by x --background #f00"));
    assert_eq!(shoot("--style edges,look.json"), shoot("--style edges,smooth --color-by x --background #f00"));
    assert_ne!(by_file, shoot("--style look.json --color-by y"));
    shoot("--style look.json --background #00ff00");
    assert_eq!(corner_and_middle(&folder.path("a.png"))[0], [0, 255, 0, 255]);
    folder.check("run move.vv -i octahedron.obj -o b.png --style look.json --size 60x45", 0, "");
}

#[test]
fn what_a_style_file_says_wrongly_is_told_at_its_place() {
    let refused = |text: &str, said: &str| {
        let arguments = "run endless.vv -i octahedron.obj -o a.png --style look.json --diagnostic-format short";
        check_file("look.json", text, arguments, 3, said);
    };
    refused("{\n \"style\": {\"egdes\": true}}", "look.json:2:12: error: nothing is called `egdes` here");
    refused("{\"style\": {\"edges\": 1}}", "look.json:1:21: error: true or false is wanted here, and there is `1`");
    refused("{\"page\": \"wide\"}", "look.json:1:10: error: a page is a width in millimetres");
    refused("{\"lines\": {\"inner\": \"thin\"}}", "look.json:1:21: error: `thin` is no width in points");
    refused("{\"lines\": {\"outer\": \"1\"}}", "look.json:1:21: error: lines are");
    check("run endless.vv -i octahedron.obj -o a.png --style none.json", 3, "none.json: there is no such file");
    check("run endless.vv -i octahedron.obj -o a.png --style smoth", 2, "did you mean `smooth`?");
}

#[test]
fn more_samples_make_a_smoother_picture_of_the_same() {
    let folder = Folder::with(&[]);
    let shoot = |samples: u32, name: &str| {
        let options = format!("--size 120x90 --samples {samples} --style no-edges");
        folder.check(&format!("mesh convert octahedron.obj -o {name} {options}"), 0, "");
        image::open(folder.path(name)).unwrap().into_rgba8()
    };
    let pictures = [1, 4, 16, 64].map(|samples| shoot(samples, "a.png"));
    let colors = |picture: &image::RgbaImage| picture.pixels().collect::<std::collections::HashSet<_>>().len();
    let counts = pictures.each_ref().map(colors);
    assert!(counts.is_sorted() && counts[3] > counts[0] + 20, "{counts:?}");
    let inside = |picture: &image::RgbaImage| picture.get_pixel(40, 40).0;
    assert!(pictures.iter().all(|p| inside(p).into_iter().zip(inside(&pictures[0])).all(|(a, b)| a.abs_diff(b) < 3)));
    check("mesh convert octahedron.obj -o a.png --samples 5", 2, "samples are 1, 4, 16 or 64");
}

#[test]
fn a_picture_larger_than_the_gpu_draws_at_once_is_put_together() {
    let folder = Folder::with(&[]);
    for samples in [4, 16] {
        let options = format!("--size 20000x30 --samples {samples} --view front --style no-edges");
        folder.check(&format!("mesh convert square.off -o a.png {options}"), 0, "");
        assert_eq!(size(&folder.path("a.png")), (20000, 30));
    }
}

#[test]
fn a_background_is_of_the_colour_asked_for_also_between_the_pictures_of_a_sheet() {
    let folder = Folder::with(&[]);
    let arguments = "run move.vv -i octahedron.obj --generations 0,1 -o a.png --size 240x90 --background #204060";
    folder.check(arguments, 0, "");
    let picture = image::open(folder.path("a.png")).unwrap().into_rgba8();
    assert!([(0, 0), (12, 12), (239, 89)].iter().all(|&(x, y)| picture.get_pixel(x, y).0 == [0x20, 0x40, 0x60, 255]));
    folder.check("mesh convert octahedron.obj -o b.png --size 60x45 --style transparent", 0, "");
    assert_eq!(corner_and_middle(&folder.path("b.png"))[0], [0; 4]);
    check("mesh convert octahedron.obj -o a.png --background blue", 2, "`blue` is no colour");
}

#[test]
fn meshes_are_drawn_without_program_side_by_side_or_each_on_its_own() {
    let folder = Folder::with(&[]);
    folder.check("render octahedron.obj -o a.png -o a.svg --size 60x45 --color-by x", 0, "");
    folder.check("mesh convert octahedron.obj -o b.png --size 60x45 --color-by x", 0, "");
    assert_eq!(fs::read(folder.path("a.png")).unwrap(), fs::read(folder.path("b.png")).unwrap());
    folder.check("render octahedron.obj square.off -o {name}.png -o both.png -o both.pdf --size 240x90", 0, "");
    assert_eq!(size(&folder.path("both.png")), size(&folder.path("square.png")));
    assert_ne!(fs::read(folder.path("both.png")).unwrap(), fs::read(folder.path("square.png")).unwrap());
    folder.check("render octahedron.obj --turntable 3 -o t_{frame}.png -o t.gif --size 30x30", 0, "");
    assert!(folder.names().contains(&"t_2.png".to_owned()));
    let ended = folder.run_with_stdin("render - -o stdin.svg", OCTAHEDRON);
    assert_eq!((ended.code, folder.path("stdin.svg").is_file()), (Some(0), true));
    folder.check("render octahedron.obj", 2, "nothing says where to draw");
    folder.check("render octahedron.obj -o c.obj", 2, "`-o c.obj` is a mesh and no picture\n`vv mesh convert`");
    folder.check("render none.obj -o c.png", 3, "none.obj: there is no such file");
    folder.check("render -o c.png", 2, "MESH");
}
