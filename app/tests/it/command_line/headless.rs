//! Machines without a graphics driver.

use super::*;

/// Environments in which nothing can draw: no Vulkan driver though the loader is there, and no backend at all. The last
/// one may find an OpenGL, which does not do.
const NOTHING_DRAWS: [&[(&str, &str)]; 3] = [
    &[("VK_DRIVER_FILES", "/dev/null"), ("VK_ICD_FILENAMES", "/dev/null"), ("WGPU_BACKEND", "vulkan")],
    &[("WGPU_BACKEND", "none")],
    &[("VK_DRIVER_FILES", "/dev/null"), ("VK_ICD_FILENAMES", "/dev/null")],
];

fn run(folder: &Folder, arguments: &str, environment: &[(&str, &str)]) -> Ended {
    let mut command = folder.command(arguments);
    let output = command.envs(environment.iter().copied()).output().unwrap();
    let text = |bytes| String::from_utf8_lossy(bytes).into_owned();
    Ended { code: output.status.code(), stdout: text(&output.stdout), stderr: text(&output.stderr) }
}

#[cfg(target_os = "linux")]
#[test]
fn without_a_driver_everything_but_pictures_is_made() {
    let thirds = "void step(mesh& S) { synchronize S; forall v in S { vec sum = vec(0, 0, 0);\n\
                  forall q in v sum += `q$pos; v$pos = `v$pos / 2 + sum / (2.0 * valence v); } }\n";
    for environment in NOTHING_DRAWS {
        let folder = Folder::with(&[("half.vv", thirds)]);
        let step = "run move.vv -i octahedron.obj";
        for arguments in [
            format!("{step} -o a.obj -o a.off -o a.ply -o a.stl -o a.glb -o a.gltf"),
            format!("{step} -o a.svg -o a.eps -o a.pdf --color-by x"),
            format!("{step} -D far=1,2 -o sheet.svg"),
            format!("{step} --summary json"),
            "mesh convert octahedron.obj -o b.off -o b.pdf".to_owned(),
            "mesh info octahedron.obj".to_owned(),
            "mesh diff octahedron.obj a.obj --tolerance 9".to_owned(),
            "mask half.vv".to_owned(),
        ] {
            let ended = run(&folder, &arguments, environment);
            assert_eq!((ended.code, ended.stderr.as_str()), (Some(0), ""), "{arguments} {environment:?}");
        }
    }
}

#[cfg(target_os = "linux")]
#[test]
fn without_a_driver_a_picture_is_refused_in_one_sentence_and_nothing_is_written() {
    let step = "run move.vv -i octahedron.obj -o a.obj";
    for environment in NOTHING_DRAWS {
        let folder = Folder::with(&[]);
        let before = folder.names();
        for arguments in [
            format!("{step} -o a.png"),
            format!("{step} --turntable 3 -o a.gif"),
            format!("{step} --generations 0,1 -o sheet.png"),
            "mesh convert octahedron.obj -o a.svg -o a.png".to_owned(),
        ] {
            let ended = run(&folder, &arguments, environment);
            let lines = ended.stderr.lines().filter(|line| !line.is_empty()).count();
            assert_eq!((ended.code, lines), (Some(6), 1), "{arguments}: {}", ended.stderr);
            assert!(ended.stderr.contains("`apt install mesa-vulkan-drivers"), "{}", ended.stderr);
            assert_eq!(folder.names(), before, "{arguments}");
        }
    }
}
