//! Several inputs, generations and values of parameters in one command.

use super::*;

/// The first coordinate of the first vertex: 1 for the octahedron, moved by `along` in each step.
#[track_caller]
fn first_x(folder: &Folder, name: &str) -> f64 {
    let text = folder.read(name);
    vertices(&text)[0].split(' ').next().unwrap().parse().unwrap()
}

fn lines(text: &str) -> Vec<Value> {
    text.lines().map(json).collect()
}

#[test]
fn each_generation_has_a_file_of_its_own_beside_the_last_one() {
    let folder = Folder::with(&[]);
    folder.check("run move.vv -i octahedron.obj -n 2 -o g_{n}.obj -o p_{n:3}.off -o last.obj", 0, "");
    let made: Vec<_> = folder.names().into_iter().filter(|n| n.starts_with(['g', 'p']) || n == "last.obj").collect();
    assert_eq!(made, ["g_0.obj", "g_1.obj", "g_2.obj", "last.obj", "p_000.off", "p_001.off", "p_002.off"]);
    for (name, x) in [("g_0.obj", 1.0), ("g_1.obj", 2.0), ("g_2.obj", 3.0), ("last.obj", 3.0)] {
        assert_eq!(first_x(&folder, name), x, "{name}");
    }
}

#[test]
fn only_the_generations_asked_for_are_written() {
    let folder = Folder::with(&[]);
    folder.check("run move.vv -i octahedron.obj --generations 0,2-3 -o g_{n}.obj", 0, "");
    let made: Vec<_> = folder.names().into_iter().filter(|name| name.starts_with('g')).collect();
    assert_eq!(made, ["g_0.obj", "g_2.obj", "g_3.obj"]);
    let said = "there is no generation 3 after 2 steps\n-n 3";
    folder.check("run move.vv -i octahedron.obj -n 2 --generations 3 -o {n}.obj", 2, said);
    folder.check("run move.vv -i octahedron.obj --generations 3-1 -o {n}.obj", 2, "generations are counted");
}

#[test]
fn a_step_that_fails_leaves_no_generation_behind() {
    check("run failing.vv -i octahedron.obj -n 2 -o g_{n}.obj", 1, "failing.vv:5:");
}

#[test]
fn each_input_is_run_on_its_own() {
    let folder = Folder::with(&[]);
    let ended = folder.run("run move.vv -i octahedron.obj -i none.obj -i square.off -o new_{name}.obj");
    assert_eq!(ended.code, Some(3), "{}", ended.stderr);
    assert!(ended.stderr.contains("none.obj: there is no such file"), "{}", ended.stderr);
    assert_eq!(vertices(&folder.read("new_octahedron.obj")).len(), 6);
    assert_eq!(vertices(&folder.read("new_square.obj")).len(), 4);
}

#[test]
fn a_sweep_runs_with_each_value() {
    let folder = Folder::with(&[]);
    folder.check("run move.vv -i octahedron.obj -D far=0:1:3 -D times=1,4 -o {far}x{times:2}.obj", 0, "");
    for (name, x) in [("0x01.obj", 1.0), ("0.5x01.obj", 1.5), ("1x04.obj", 5.0), ("0.5x04.obj", 3.0)] {
        assert_eq!(first_x(&folder, name), x, "{name}");
    }
    assert_eq!(folder.names().iter().filter(|name| name.contains('x') && name.starts_with(['0', '1'])).count(), 6);
}

#[test]
fn sweeps_that_cannot_be_meant_are_refused_before_anything_is_run() {
    let refused = |arguments: &str, said: &str| {
        check(&format!("run move.vv -i octahedron.obj {arguments}"), 2, said);
    };
    refused("-D far=0:1:1 -o {far}.obj", "a sweep is `from:to:count`");
    refused("-D times=0:1:3 -o {times}.obj", "`-D times=0.5`: the parameter `times` is a whole number");
    refused("-D far=0:1:1000 -D times=1,2 -o {far}{times}.obj", "these are more than 1000 runs");
    refused("-D far=0:1:3 -o a.obj", "`-o a.obj` would be written more than once\nput `{far}` into its name");
    refused("-D far=1,,2 -o {far}.obj", "`-D far=1,,2`: a value is missing beside a comma");
    refused("-D far=1,2,1 -o {far}.obj", "`-D far=1,2,1`: the value 1 stands there twice");
    refused("--generations 0,1 --turntable 4 -o a.gif", "put `{n}` into its name");
    refused("--generations 0,1 -D far=1,2 --turntable 4 -o {far}.gif", "put `{n}` into its name");
    refused("--turntable 4 -o {frame}.svg", "only pictures of a turntable have frames\nhelp: write a `.png`");
    refused("--turntable 4 -o {frame}.gif", "a `.gif` holds all of them: leave `{frame}` out");
    refused("-i octahedron.obj -o {name}.obj", "would be written more than once");
    refused("-o {fra}.obj", "nothing is called `fra`\nthere are `n` and `name`");
    refused("-D far=1 -o {fa}.obj", "did you mean `{far}`?");
    refused("-o {n.obj", "a `{` has no partner");
    refused("-D far=0:1:3 --reference octahedron.obj", "`--reference` compares one result");
    refused("-n 99999999 -o {n}.obj", "these would be more than 100000 files");
}

#[test]
fn the_summary_has_a_line_for_each_run_and_generation() {
    let folder = Folder::with(&[]);
    let arguments = "run move.vv -i octahedron.obj -i square.off -D far=1,2 -n 1 -o {name}{far}_{n}.obj --summary json";
    let told = lines(&folder.check(arguments, 0, "").stdout);
    let tell = |line: &Value| {
        format!("{} {} {} {}", line["input"], line["parameters"]["far"], line["generation"], line["vertices"])
    };
    let first: Vec<String> = told.iter().map(tell).collect();
    assert_eq!(first.len(), 8);
    assert_eq!(first[..3], ["\"octahedron.obj\" 1.0 0 6", "\"octahedron.obj\" 1.0 1 6", "\"octahedron.obj\" 2.0 0 6"]);
    assert_eq!(first[7], "\"square.off\" 2.0 1 4");
}

#[test]
fn braces_in_names_are_doubled() {
    let folder = Folder::with(&[]);
    folder.check("run triangle.vv -o a{{n}}.obj", 0, "");
    assert!(folder.names().contains(&"a{n}.obj".to_owned()));
}

#[cfg(unix)]
#[test]
fn a_closed_pipe_ends_all_runs() {
    let folder = Folder::with(&[]);
    let before = folder.names();
    let mut command = folder.command("run move.vv -i octahedron.obj -D far=0:1:9 --summary json -o {far}.obj");
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), String::from_utf8_lossy(&output.stderr).as_ref()), (Some(3), ""));
    assert_eq!(folder.names(), before);
}

/// Where the pictures begin in a row of pixels of a sheet: what is not the colour of the paper.
fn begins(sheet: &image::RgbaImage, paper: [u8; 4], y: u32) -> Vec<u32> {
    let on_paper = |x: u32| sheet.get_pixel(x, y).0 == paper;
    (1..sheet.width()).filter(|&x| on_paper(x - 1) && !on_paper(x)).collect()
}

/// How many there are.
fn across(path: &Path, paper: [u8; 4], y: u32) -> usize {
    begins(&image::open(path).unwrap().into_rgba8(), paper, y).len()
}

const WHITE: [u8; 4] = [255; 4];

#[test]
fn a_picture_of_a_sweep_shows_its_values_side_by_side() {
    let folder = Folder::with(&[]);
    folder.check("run move.vv -i octahedron.obj -D far=0:1:3 -o a.png --size 480x160", 0, "");
    assert_eq!(image::image_dimensions(folder.path("a.png")).unwrap(), (480, 160));
    assert_eq!(across(&folder.path("a.png"), WHITE, 60), 3);
    let grid = "run move.vv -i octahedron.obj -D far=0,1 -D times=1,2,3 -o b.png --size 480x320 --style dark";
    folder.check(grid, 0, "");
    assert_eq!(across(&folder.path("b.png"), [0x10, 0x12, 0x15, 0xff], 70), 3);
    folder.check("run move.vv -i octahedron.obj -D far=0:1:3 -o c_{far}.png --size 64x48", 0, "");
    assert_eq!(folder.names().iter().filter(|name| name.starts_with("c_")).count(), 3);
    assert_eq!(image::image_dimensions(folder.path("c_0.5.png")).unwrap(), (64, 48));
}

#[test]
fn generations_stand_side_by_side_seen_from_the_same_place() {
    let folder = Folder::with(&[]);
    let sheet = |arguments: &str, name: &str| {
        let arguments = format!("run move.vv -i octahedron.obj {arguments} -o {name} --size 320x160 --style no-edges");
        folder.check(&arguments, 0, "");
        image::open(folder.path(name)).unwrap().into_rgba8()
    };
    let halves = |sheet: &image::RgbaImage| {
        let half = |x| image::imageops::crop_imm(sheet, x, 10, 130, 90).to_image();
        let begins = begins(sheet, WHITE, 60);
        assert_eq!(begins.len(), 2);
        (half(begins[0]), half(begins[1]))
    };
    let (first, second) = halves(&sheet("--generations 0,1 --rule still", "still.png"));
    let differing = first.pixels().zip(second.pixels()).filter(|(a, b)| a != b).count();
    let (first, second) = halves(&sheet("--generations 0,1 -D far=3", "far.png"));
    let moved = first.pixels().zip(second.pixels()).filter(|(a, b)| a != b).count();
    assert!(moved > 200 && differing < 20, "{moved} {differing}");
}

#[test]
fn a_run_that_fails_leaves_its_place_on_the_sheet_empty() {
    let text =
        "param int k = 0;\nvoid step(mesh& S) { forall v in S { vertex x = null; if (k == 1) x$pos = v$pos; } }\n";
    let folder = Folder::with(&[("some.vv", text)]);
    let ended = folder.run("run some.vv -i octahedron.obj -D k=0,1,2 -o a.png --size 480x160");
    assert_eq!(ended.code, Some(1), "{}", ended.stderr);
    assert!(ended.stderr.contains("this was in step 1 of 1 of `step` with k = 1"), "{}", ended.stderr);
    assert_eq!(across(&folder.path("a.png"), WHITE, 40), 2);
    folder.check("run some.vv -i octahedron.obj -D k=1 --generations 0,1 -o b.png", 1, "some.vv:2");
}

#[test]
fn a_sheet_without_room_is_refused_before_anything_is_run() {
    let said = "3 pictures have no room on 90x60 pixels\n--size WxH";
    check("run endless.vv -i octahedron.obj --generations 0-2 -o a.png --size 90x60", 2, said);
    check("run move.vv -i octahedron.obj -D far=0:1:3 -o none/a.png", 3, "there is no directory `none`");
}

#[test]
fn a_turntable_goes_around_the_mesh_once() {
    let folder = Folder::with(&[]);
    let still = "run move.vv -i octahedron.obj --rule still -n 0 --view front --style no-edges --size 60x60";
    folder.check(&format!("{still} --turntable 4 -o f_{{frame:2}}.png -o a.obj"), 0, "");
    let made: Vec<_> = folder.names().into_iter().filter(|name| name.starts_with("f_")).collect();
    assert_eq!(made, ["f_00.png", "f_01.png", "f_02.png", "f_03.png"]);
    folder.check(&format!("{still} --turntable 8 -o g_{{frame}}.png"), 0, "");
    let differing = |a: &str, b: &str| {
        let read = |name: &str| image::open(folder.path(name)).unwrap().into_rgba8();
        read(a).pixels().zip(read(b).pixels()).filter(|(a, b)| a.0[0].abs_diff(b.0[0]) > 30).count()
    };
    assert!(differing("f_01.png", "g_2.png") < 20, "a quarter of a turn is a quarter of a turn");
    assert!(differing("g_0.png", "g_1.png") > 100, "an octahedron looks otherwise from between its corners");
}

#[test]
fn frames_need_a_turntable_and_a_turntable_frames() {
    check("run move.vv -i octahedron.obj -o f_{frame}.png", 2, "add `--turntable 36`");
    check("run move.vv -i octahedron.obj --turntable 9 -o f_{frame}.obj", 2, "only pictures of a turntable");
    check("run move.vv -i octahedron.obj --turntable 9 -o f.png", 2, "write `-o 'turn_{frame:3}.png'`");
    check("run move.vv -i octahedron.obj -o f.gif", 2, "`-o f.gif`: nothing moves here");
    check("mesh convert octahedron.obj -o f.gif", 2, "`-o f.gif`: nothing moves here");
    check("run move.vv -i octahedron.obj --turntable 1 -o f_{frame}.png", 2, "--turntable");
}

#[test]
fn a_film_holds_all_pictures_and_is_the_same_each_time() {
    use image::AnimationDecoder as _;
    let folder = Folder::with(&[]);
    let film = |arguments: &str, name: &str| {
        folder.check(&format!("run move.vv -i octahedron.obj {arguments} -o {name} --size 60x45"), 0, "");
        let bytes = fs::read(folder.path(name)).unwrap();
        let decoder = image::codecs::gif::GifDecoder::new(std::io::Cursor::new(&bytes)).unwrap();
        let frames = decoder.into_frames().collect_frames().unwrap();
        assert!(frames.iter().all(|frame| frame.buffer().dimensions() == (60, 45)));
        (bytes, frames.len())
    };
    assert_eq!(film("--turntable 5", "a.gif").1, 5);
    assert_eq!(film("--generations 0-2", "b.gif").1, 3);
    assert_eq!(film("-D far=0,1", "c.gif").1, 2);
    assert_eq!(film("--turntable 5", "d.gif").0, film("--turntable 5", "a.gif").0);
}

/// The octahedron reaches from -1 to 1, and one step further from 0 to 2.
#[test]
fn colours_mean_the_same_numbers_all_over_a_sheet_and_a_film() {
    let folder = Folder::with(&[]);
    let steps = "--generations 0,1 --color-by x";
    for (arguments, name) in [(steps, "a.png"), (steps, "a.gif"), ("-D far=0,1 --color-by x", "a.png")] {
        let draw = |more: &str| {
            folder.check(&format!("run move.vv -i octahedron.obj {arguments} {more} -o {name} --size 240x90"), 0, "");
            fs::read(folder.path(name)).unwrap()
        };
        let by_itself = draw("");
        assert_ne!(by_itself, draw("--color-range -1,1"), "{arguments}");
        assert_eq!(by_itself, draw("--color-range -1,2"), "{arguments}");
    }
}

/// Of a plate that turns, seen from above, the ball is much higher than what is seen.
#[test]
fn a_turntable_comes_as_near_as_all_its_pictures_allow() {
    let plate = "OFF\n4 1 0\n-1 0 -1\n-1 0 1\n1 0 1\n1 0 -1\n4 0 1 2 3\n";
    let folder = Folder::with(&[("plate.off", plate)]);
    let look = "--style no-edges,transparent --size 160x60";
    folder.check(&format!("run move.vv -i plate.off -n 0 --turntable 8 {look} -o f_{{frame}}.png"), 0, "");
    let (mut left, mut right) = (u32::MAX, 0);
    for frame in 0..8 {
        let picture = image::open(folder.path(&format!("f_{frame}.png"))).unwrap().into_rgba8();
        let seen = picture.enumerate_pixels().filter(|(.., pixel)| pixel.0[3] > 0);
        for (x, y, _) in seen {
            assert!((1..159).contains(&x) && (1..59).contains(&y), "frame {frame} is cut off at {x}, {y}");
            (left, right) = (left.min(x), right.max(x));
        }
    }
    assert!(right - left > 120, "{left} to {right}");
}
