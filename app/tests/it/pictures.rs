//! What the renderer draws, compared with pictures that were looked at and found right.
//!
//! `UPDATE_SNAPSHOTS=1` writes the pictures anew; look at them before you commit them. They are drawn by Mesa's software
//! driver, without multisampling, and come out alike in every build.

mod annotated;

use std::path::PathBuf;
use std::sync::OnceLock;

use glam::{DQuat, DVec2, DVec3, Vec3};
use image::{Rgba, RgbaImage};

use crate::fixtures::{
    ball, box_without_lid, cube, dangling, hills, letter, lonely, mesh, octahedron, scene, scene_with_control, torus,
};
use app::camera::{self, Camera, Side, Up};
use app::compare::pictures::{PictureDifference, compare_pictures};
use app::render::{Headless, RenderError, Size};
use app::scene::{Scene, Style, Theme, pack_color};
use vv::mesh::{Mesh, Value};

/// Versions of the driver round differently; what a person would see is more.
const TOLERANCE: f64 = 2.0 / 255.0;

const SIZE: Size = Size { width: 240, height: 180, scale: 1.0 };

fn headless() -> &'static Headless {
    static HEADLESS: OnceLock<Headless> = OnceLock::new();
    HEADLESS.get_or_init(|| {
        Headless::on_adapter(Some("llvmpipe"), 1).unwrap_or_else(|error| {
            panic!("picture tests need Mesa's software driver (Debian: mesa-vulkan-drivers libvulkan1): {error}")
        })
    })
}

fn standard(scene: &Scene, style: &Style) -> Camera {
    scene.standard_view(style, SIZE.aspect())
}

fn draw(scene: &Scene, style: &Style) -> RgbaImage {
    headless().image(scene, &standard(scene, style), style, SIZE).unwrap()
}

/// Compares a picture with the committed one of that name.
fn compare(name: &str, picture: &RgbaImage) -> Result<(), String> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/snapshots").join(format!("{name}.png"));
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some_and(|value| value == "1") {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        picture.save(&path).unwrap();
    }
    let reference = image::open(&path)
        .map_err(|error| format!("no reference: {}: {error}; UPDATE_SNAPSHOTS=1 makes one", path.display()))?;
    compare_pictures(picture, &reference.to_rgba8(), TOLERANCE).map_err(|difference| {
        let seen = std::env::temp_dir().join(format!("vv-{name}.png"));
        let _ = picture.save(&seen);
        format!("{difference}; what was drawn is in {}", seen.display())
    })
}

#[track_caller]
fn check(name: &str, scene: &Scene, style: &Style) {
    if let Err(difference) = compare(name, &draw(scene, style)) {
        panic!("{name}: {difference}");
    }
}

/// What the tests of the test below compare with.
const BOX: &str = "box-without-lid";

#[test]
fn boundary_edges_and_backs_of_faces_stand_out() {
    check(BOX, &scene(&box_without_lid()), &Style::default());
}

#[test]
fn a_camera_turned_by_two_degrees_is_noticed() {
    let (scene, style) = (scene(&box_without_lid()), Style::default());
    for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
        let mut camera = standard(&scene, &style);
        camera.world_from_view *= DQuat::from_axis_angle(axis, 2f64.to_radians());
        let turned = headless().image(&scene, &camera, &style, SIZE).unwrap();
        let reference = draw(&scene, &style);
        assert!(matches!(compare_pictures(&turned, &reference, TOLERANCE), Err(PictureDifference::Pixels { .. })));
    }
}

#[test]
fn every_missing_edge_that_is_seen_is_noticed() {
    let style = Style::default();
    let whole = scene(&box_without_lid());
    let reference = draw(&whole, &style);
    let mut noticed = 0;
    for i in 0..whole.mesh.edges.len() {
        let mut lacking = whole.clone();
        lacking.mesh.edges.remove(i);
        lacking.mesh.inner_edge_count -= u32::from(i < whole.mesh.inner_edge_count as usize);
        noticed += u32::from(compare_pictures(&draw(&lacking, &style), &reference, TOLERANCE).is_err());
    }
    assert_eq!(noticed, 10, "of the twelve edges two lie hidden behind faces");
}

#[test]
fn a_colour_off_by_sixteen_is_noticed_in_each_channel() {
    let reference = draw(&scene(&box_without_lid()), &Style::default());
    let front = *reference.get_pixel(100, 100);
    for channel in 0..3 {
        for by in [-16i16, 16] {
            let mut off = reference.clone();
            off.pixels_mut().filter(|p| **p == front).for_each(|p| {
                p.0[channel] = (i16::from(p.0[channel]) + by).clamp(0, 255) as u8;
            });
            assert_ne!(off, reference);
            assert!(compare_pictures(&off, &reference, TOLERANCE).is_err(), "channel {channel} off by {by}");
        }
    }
}

#[test]
fn a_missing_reference_fails() {
    if std::env::var_os("UPDATE_SNAPSHOTS").is_none() {
        let error = compare("no-such-picture", &RgbaImage::new(1, 1)).unwrap_err();
        assert!(error.starts_with("no reference"), "{error}");
    }
}

#[test]
fn a_reference_of_another_size_fails() {
    if std::env::var_os("UPDATE_SNAPSHOTS").is_none() {
        let error = compare(BOX, &RgbaImage::new(240, 181)).unwrap_err();
        assert!(error.contains("240x181 pixels in place of 240x180"), "{error}");
    }
}

#[test]
fn flat_and_smooth_shading_need_no_other_scene() {
    let ball = scene(&ball(10));
    check("ball-flat", &ball, &Style { edges: false, ..Style::default() });
    check("ball-smooth", &ball, &Style { edges: false, smooth: true, ..Style::default() });
}

/// Gives vertices the colours of their places: red to the right, green upwards, blue to the front.
fn colored(mut mesh: Mesh) -> Mesh {
    let color = mesh.declare_vertex_property(vv::io::COLOR, Value::Vec(DVec3::ONE));
    for v in mesh.vertices() {
        mesh.set_vertex_value(color, v, Value::Vec(mesh.position(v).max(DVec3::ZERO)));
    }
    mesh
}

#[test]
fn colours_of_vertices_are_blended_over_the_faces() {
    let colored = scene(&colored(box_without_lid()));
    check("colored", &colored, &Style::default());
    let without = Style { colors: false, ..Style::default() };
    assert_eq!(draw(&colored, &without), draw(&scene(&box_without_lid()), &without));
}

#[test]
fn a_corner_that_stands_for_a_vertex_once_more_has_its_colour() {
    let scene = scene(&colored(octahedron()));
    assert!(scene.mesh.corners.len() > 6 && scene.mesh.colors.len() == scene.mesh.corners.len());
    for (corner, &color) in scene.mesh.corners.iter().zip(&scene.mesh.colors) {
        let expected = Vec3::from(corner.position).max(Vec3::ZERO).as_dvec3();
        assert_eq!(color, pack_color(expected));
    }
    assert_eq!(pack_color(DVec3::new(0.2, f64::NAN, 7.0)).to_le_bytes(), [51, 0, 255, 255]);
}

#[test]
fn concave_faces_are_filled_where_they_are() {
    check("letter", &scene(&letter()), &Style { vertices: true, ..Style::default() });
}

#[test]
fn the_dark_theme_is_dark() {
    check("hills-dark", &scene(&hills(12)), &Style { theme: Theme::Dark, vertices: true, ..Style::default() });
}

#[test]
fn edges_and_vertices_of_a_dense_mesh_fade_instead_of_turning_it_black() {
    check("dense", &scene(&torus(90, 45)), &Style { vertices: true, ..Style::default() });
}

#[test]
fn without_faces_all_edges_are_seen() {
    check("wires", &scene(&torus(24, 12)), &Style { faces: false, theme: Theme::Dark, ..Style::default() });
}

#[test]
fn the_control_mesh_shows_through_faintly() {
    let scene = scene_with_control(&octahedron(), &cube());
    check("control", &scene, &Style { control: true, smooth: true, ..Style::default() });
}

#[test]
fn wires_and_lonely_vertices_are_seen() {
    check("dangling", &scene(&dangling()), &Style::default());
}

#[test]
fn nothing_is_an_empty_picture() {
    let picture = draw(&scene(&Mesh::new()), &Style { vertices: true, ..Style::default() });
    check("nothing", &Scene::default(), &Style::default());
    compare("nothing", &picture).unwrap();
}

#[test]
fn a_transparent_background_leaves_the_colours_of_the_mesh() {
    let scene = scene(&box_without_lid());
    let (plain, clear) =
        (draw(&scene, &Style::default()), draw(&scene, &Style { transparent: true, ..Style::default() }));
    assert_eq!(clear.get_pixel(0, 0), &Rgba([0; 4]));
    assert_eq!(clear.get_pixel(100, 100), plain.get_pixel(100, 100));
    for (a, b) in clear.pixels().zip(plain.pixels()).filter(|(a, _)| a.0[3] == 255) {
        assert!(a.0.iter().zip(b.0).all(|(&a, b)| a.abs_diff(b) <= 4), "{a:?} {b:?}"); // lines cover some almost
    }
}

/// The world scaled and moved about looks the same.
#[test]
fn meshes_far_away_tiny_and_huge_look_the_same() {
    let reference = draw(&scene(&box_without_lid()), &Style::default());
    for (scale, shift) in
        [(1e-30, DVec3::ZERO), (1e30, DVec3::splat(1e31)), (1.0, DVec3::new(1e9, -1e9, 1e9)), (4096.0, DVec3::X)]
    {
        let mut moved = box_without_lid();
        for v in moved.vertices() {
            moved.set_position(v, moved.position(v) * scale + shift);
        }
        let picture = draw(&scene(&moved), &Style::default());
        if let Err(difference) = compare_pictures(&picture, &reference, TOLERANCE) {
            panic!("scaled by {scale}, moved by {shift}: {difference}");
        }
    }
}

#[test]
fn positions_that_are_no_numbers_take_only_their_faces_along() {
    let mut broken = cube();
    let v = broken.vertices().next().unwrap();
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300] {
        broken.set_position(v, DVec3::new(0.0, bad, 0.0));
        check("broken", &scene(&broken), &Style { vertices: true, ..Style::default() });
    }
    let nothing_left = scene(&mesh(&[[f64::NAN; 3], [f64::INFINITY; 3], [1e300; 3]], &[&[0, 1, 2]]));
    compare("nothing", &draw(&nothing_left, &Style::default())).unwrap();
}

#[test]
fn a_camera_inside_the_mesh_sees_it_cut_by_the_near_plane_only() {
    let (scene, style) = (scene(&torus(24, 12)), Style::default());
    let mut camera = standard(&scene, &style);
    camera.pivot = DVec3::new(0.0, 0.0, 1.0);
    camera.distance = 0.2;
    let picture = headless().image(&scene, &camera, &style, SIZE).unwrap();
    compare("inside", &picture).unwrap();
}

#[test]
fn a_control_mesh_that_crowds_does_not_hide_the_surface() {
    let differing = |mesh: &Mesh| {
        let (scene, plain) = (scene_with_control(mesh, mesh), Style { edges: false, ..Style::default() });
        let with = draw(&scene, &Style { control: true, ..plain });
        with.pixels().zip(draw(&scene, &plain).pixels()).filter(|(a, b)| a != b).count()
    };
    assert!(differing(&torus(12, 6)) > 2000, "a coarse one is seen");
    assert_eq!(differing(&torus(110, 55)), 0);
}

#[test]
fn along_parallel_lines_the_picture_shows_no_vanishing_point() {
    let scene = scene_with_control(&torus(24, 12), &cube());
    let style = Style { control: true, vertices: true, ..Style::default() };
    let mut camera = standard(&scene, &style);
    camera.orthographic = true;
    let camera = scene.fit(camera.from_side(Side::Isometric, Up::Y), &style, SIZE.aspect());
    let picture = headless().image(&scene, &camera, &style, SIZE).unwrap();
    compare("orthographic", &picture).unwrap();
}

#[test]
fn an_orthographic_camera_cuts_nothing_off_however_near() {
    let style = Style { edges: false, transparent: true, ..Style::default() };
    let scene = scene(&cube());
    let side = Camera { orthographic: true, ..standard(&scene, &style) }.from_side(Side::Front, Up::Y);
    let near = Camera { distance: 0.01, ..side };
    let picture = headless().image(&scene, &near, &style, SIZE).unwrap();
    assert!(picture.pixels().all(|p| p.0[3] == 255), "the front face fills the picture");
}

#[test]
fn lines_are_wider_on_dense_screens() {
    let (scene, style) = (scene(&box_without_lid()), Style { vertices: true, ..Style::default() });
    let twice = Size { width: SIZE.width * 2, height: SIZE.height * 2, scale: 2.0 };
    let large = headless().image(&scene, &standard(&scene, &style), &style, twice).unwrap();
    compare("scaled", &image::imageops::thumbnail(&large, SIZE.width, SIZE.height)).unwrap();
}

#[test]
fn a_large_picture_is_put_together_from_tiles() {
    let (scene, style) = (scene(&hills(4)), Style { vertices: true, ..Style::default() });
    let wide = Size { width: 4160, height: 120, scale: 1.0 };
    let picture = headless().image(&scene, &standard(&scene, &style), &style, wide).unwrap();
    let seam = image::imageops::crop_imm(&picture, 2048 - 60, 0, 160, 120).to_image();
    compare("seam", &seam).unwrap();
}

#[test]
fn a_picture_too_large_or_of_no_size_is_refused() {
    for (width, height) in [(0, 10), (10, 0), (1 << 20, 1 << 20)] {
        let result = headless().image(
            &Scene::default(),
            &standard(&Scene::default(), &Style::default()),
            &Style::default(),
            Size::new(width, height),
        );
        assert!(matches!(result, Err(RenderError::TooLarge(_))), "{result:?}");
    }
}

#[test]
fn without_a_driver_the_error_names_the_packages() {
    let Err(error) = Headless::on_adapter(Some("no such adapter"), 1) else { panic!("there is such an adapter") };
    let text = error.to_string();
    assert!(matches!(error, RenderError::NoRenderer(_)));
    assert!(text.contains("mesa-vulkan-drivers") && text.contains("VK_DRIVER_FILES"), "{text}");
}

/// The pointer's place in the picture, the pixel drawn there and the ray into the world belong together.
#[test]
fn the_point_under_the_cursor_is_drawn_under_the_cursor() {
    let mut single = Mesh::new();
    lonely(&mut single, [0.3, 0.2, 0.1]);
    let scene = scene(&single);
    let mut view = Camera::standard(scene.bounds(&Style::default()), SIZE.aspect());
    view.pivot = DVec3::ZERO;
    view.distance = 2.0;
    let style = Style { transparent: true, ..Style::default() };
    let picture = headless().image(&scene, &view, &style, SIZE).unwrap();
    let drawn: Vec<DVec2> = picture
        .enumerate_pixels()
        .filter(|(_, _, p)| p.0[3] > 0)
        .map(|(x, y, _)| DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5))
        .collect();
    let center = drawn.iter().sum::<DVec2>() / drawn.len() as f64;
    let size = DVec2::new(f64::from(SIZE.width), f64::from(SIZE.height));
    let ray = view.ray(camera::picture_point(center, size));
    let to_point = single.positions()[0] - ray.origin;
    let missed_by = to_point.reject_from(ray.direction).length();
    assert!(missed_by < 2.0 * 2.0 * 0.26 / f64::from(SIZE.height), "by {missed_by}");
}
