//! What cameras show.

use super::*;

const BOUNDS: Sphere = Sphere { center: DVec3::new(3.0, -2.0, 7.0), radius: 2.5 };

/// Where a world point is seen in a picture twice as wide as high.
fn seen(camera: &Camera, p: DVec3) -> DVec2 {
    let clip = camera.clip_from_view(2.0) * camera.view_from_world() * p.extend(1.0);
    assert!(clip.w > 0.0, "behind the eye");
    DVec2::new(clip.x * 2.0, clip.y) / clip.w
}

#[track_caller]
fn check_near<T: Into<DVec3>>(a: T, b: T) {
    let (a, b) = (a.into(), b.into());
    assert!(a.distance(b) < 1e-9, "{a} is not {b}");
}

fn camera() -> Camera {
    Camera::standard(BOUNDS, 2.0)
}

fn orthographic() -> Camera {
    Camera { orthographic: true, ..camera() }
}

#[test]
fn pixels_become_places_in_the_picture() {
    let size = DVec2::new(400.0, 200.0);
    assert_eq!(picture_point(DVec2::new(200.0, 100.0), size), DVec2::ZERO);
    assert_eq!(picture_point(DVec2::ZERO, size), DVec2::new(-2.0, 1.0));
}

#[test]
fn the_pivot_is_seen_in_the_centre_and_up_is_up() {
    let camera = camera();
    check_near(seen(&camera, BOUNDS.center).extend(0.0), DVec3::ZERO);
    assert!(seen(&camera, BOUNDS.center + DVec3::Y).y > 0.1);
    assert!(camera.eye().y > BOUNDS.center.y, "from above");
    check_near(camera.view_from_world().transform_point3(camera.eye()), DVec3::ZERO);
}

#[test]
fn a_fitted_ball_fills_the_narrower_side_but_for_the_margin() {
    for aspect in [0.4, 1.0, 2.0] {
        let camera = Camera::standard(BOUNDS, aspect);
        // The rim of the ball as seen from the eye.
        let sine = BOUNDS.radius / camera.distance;
        let rim = sine / (1.0 - sine * sine).sqrt() / (camera.field_of_view / 2.0).tan();
        assert!((0.9..1.0).contains(&(rim / aspect.min(1.0))), "{rim} of {aspect}");
    }
}

#[test]
fn fitted_points_touch_the_margin_on_two_opposite_sides() {
    let points = [DVec3::ZERO, DVec3::X, DVec3::new(3.0, 1.0, -2.0), DVec3::new(0.5, 4.0, 1.0), DVec3::NEG_Z];
    for aspect in [0.3, 1.0, 2.0, 5.0] {
        let camera = camera().fit_points(points, BOUNDS, aspect);
        let places = points.map(|p| {
            let clip = camera.clip_from_view(aspect) * camera.view_from_world() * p.extend(1.0);
            DVec2::new(clip.x, clip.y) / clip.w * MARGIN
        });
        let high = places.into_iter().fold(DVec2::NEG_INFINITY, DVec2::max);
        let low = places.into_iter().fold(DVec2::INFINITY, DVec2::min);
        let touches = |low: f64, high: f64| (low + 1.0).abs() < 1e-9 && (high - 1.0).abs() < 1e-9;
        assert!(high.max_element() < 1.0 + 1e-9 && low.min_element() > -1.0 - 1e-9, "{low} {high}");
        assert!(touches(low.x, high.x) || touches(low.y, high.y), "{low} {high}");
    }
}

#[test]
fn without_points_to_fit_the_ball_is() {
    assert_eq!(camera().fit_points([], BOUNDS, 2.0), camera());
    let one = Sphere { center: DVec3::X, radius: 0.0 };
    assert_eq!(camera().fit_points([DVec3::X], one, 2.0), camera().fit(one, 2.0));
}

#[test]
fn a_point_is_fitted_too() {
    let camera = Camera::standard(Sphere { center: DVec3::X, radius: 0.0 }, 1.0);
    assert!(camera.distance > 0.0 && camera.distance.is_finite());
}

#[test]
fn orbiting_keeps_pivot_and_distance_and_brings_the_front_along() {
    let front = camera().pivot + camera().world_from_view * DVec3::new(0.0, 0.0, 1.0);
    let turned = camera().orbit(DVec2::ZERO, DVec2::new(0.3, 0.1));
    assert_eq!(turned.pivot, camera().pivot);
    assert_eq!(turned.distance, camera().distance);
    let at = seen(&turned, front);
    assert!(at.x > 0.0 && at.y > 0.0, "the front followed the pointer: {at}");
    assert!((at.x / at.y - 3.0).abs() < 0.01, "in its direction");
}

#[test]
fn orbiting_back_undoes_and_standing_still_does_nothing() {
    let (a, b) = (DVec2::new(0.2, -0.5), DVec2::new(-1.7, 0.9));
    let turned = camera().orbit(a, b).orbit(b, a);
    assert!(turned.world_from_view.angle_between(camera().world_from_view) < 1e-7);
    assert!(camera().orbit(b, b).world_from_view.angle_between(camera().world_from_view) < 1e-7);
}

#[test]
fn the_arcball_is_smooth_where_the_ball_ends() {
    let angle = |d: f64| {
        let turned = camera().orbit(DVec2::ZERO, DVec2::new(d, 0.0));
        turned.world_from_view.angle_between(camera().world_from_view)
    };
    let (end, step) = (std::f64::consts::FRAC_1_SQRT_2, 1e-4);
    let (before, after) = (angle(end) - angle(end - step), angle(end + step) - angle(end));
    assert!((before / after - 1.0).abs() < 1e-2, "{before} {after}");
    assert!(angle(30.0) > angle(3.0) && angle(30.0) < FRAC_PI_2);
}

#[test]
fn panning_moves_what_is_under_the_pointer_with_it() {
    let (from, to) = (DVec2::new(0.5, 0.25), DVec2::new(-0.75, 0.5));
    let ray = camera().ray(from);
    let under =
        ray.origin + ray.direction * (camera().distance / ray.direction.dot(camera().ray(DVec2::ZERO).direction));
    check_near(seen(&camera().pan(from, to), under).extend(0.0), to.extend(0.0));
}

#[test]
fn zooming_keeps_what_is_under_the_pointer_there() {
    let cursor = DVec2::new(1.2, -0.6);
    let ray = camera().ray(cursor);
    let under =
        ray.origin + ray.direction * (camera().distance / ray.direction.dot(camera().ray(DVec2::ZERO).direction));
    for factor in [0.01, 0.5, 1.0, 3.0] {
        let zoomed = camera().zoom(cursor, factor, BOUNDS);
        assert!((zoomed.distance / camera().distance / factor - 1.0).abs() < 1e-12);
        check_near(seen(&zoomed, under).extend(0.0), cursor.extend(0.0));
    }
}

#[test]
fn zooming_ends_near_and_far() {
    let far = (0..1000).fold(camera(), |c, _| c.zoom(DVec2::ONE, 2.0, BOUNDS));
    let near = (0..1000).fold(camera(), |c, _| c.zoom(DVec2::ONE, 0.5, BOUNDS));
    assert!((far.distance - FARTHEST * 2.5).abs() < 1e-6 && far.pivot.is_finite());
    assert!((near.distance - NEAREST * 2.5).abs() < 1e-12 && near.pivot.is_finite());
    assert_eq!(camera().zoom(DVec2::ONE, f64::NAN, BOUNDS), camera());
}

#[test]
fn depth_is_one_at_the_near_plane_and_falls_to_zero() {
    let depth = |d: f64| {
        let clip = camera().clip_from_view(1.0) * DVec4::new(0.0, 0.0, -d, 1.0);
        clip.z / clip.w
    };
    assert!((depth(camera().near()) - 1.0).abs() < 1e-12);
    assert!(depth(1.0) > depth(2.0) && depth(1e9) > 0.0);
}

#[test]
fn a_ray_goes_through_what_is_seen_there() {
    let at = DVec2::new(-1.1, 0.4);
    let ray = camera().ray(at);
    check_near(seen(&camera(), ray.origin + 5.0 * ray.direction).extend(0.0), at.extend(0.0));
    assert!((ray.direction.length() - 1.0).abs() < 1e-12);
}

#[test]
fn a_camera_survives_being_copied_as_text() {
    let text = serde_json::to_string(&camera()).unwrap();
    let copy: Camera = serde_json::from_str(&text).unwrap();
    check_near(copy.eye(), camera().eye());
    check_near(copy.ray(DVec2::ONE).direction, camera().ray(DVec2::ONE).direction);
}

#[test]
fn an_orthographic_camera_shows_the_pivots_plane_in_the_same_size() {
    let up = camera().world_from_view * DVec3::Y;
    for p in [BOUNDS.center, BOUNDS.center + up] {
        check_near(seen(&orthographic(), p).extend(0.0), seen(&camera(), p).extend(0.0));
    }
}

#[test]
fn parallel_lines_stay_parallel_in_an_orthographic_picture() {
    let camera = orthographic();
    let shift = DVec3::new(0.3, 1.0, -2.0);
    let moved = |p| seen(&camera, p + shift) - seen(&camera, p);
    check_near(moved(BOUNDS.center).extend(0.0), moved(DVec3::ZERO).extend(0.0));
}

#[test]
fn an_orthographic_camera_sees_what_is_behind_its_eye_too() {
    let near = orthographic().zoom(DVec2::ZERO, 0.01, BOUNDS);
    let toward = near.world_from_view * DVec3::Z;
    let clip = near.clip_from_view_within(2.0, BOUNDS) * near.view_from_world();
    for (z, nearer) in [(-2.5, 0.01), (0.0, 0.5), (2.5, 0.99)] {
        let p = clip * (BOUNDS.center + z * toward).extend(1.0);
        assert!((p.z / p.w - nearer).abs() < 1e-9, "{z}: {}", p.z / p.w);
    }
}

#[test]
fn an_orthographic_ray_goes_through_what_is_seen_there_and_begins_before_everything() {
    let at = DVec2::new(-1.1, 0.4);
    let ray = orthographic().ray(at);
    for along in [1e5, 4e5] {
        assert!(seen(&orthographic(), ray.origin + along * ray.direction).distance(at) < 1e-6);
    }
    assert!((ray.origin - BOUNDS.center).dot(ray.direction) < -1e4);
    let aside = orthographic().spread(0.5) * ray.origin.distance(BOUNDS.center);
    let there = orthographic().world_from_view * DVec3::new(0.0, aside, 0.0);
    assert!((seen(&orthographic(), BOUNDS.center + there).y - 0.5).abs() < 1e-3);
}

#[test]
fn an_orthographic_camera_fits_too() {
    let points = [DVec3::ZERO, DVec3::X, DVec3::new(3.0, 1.0, -2.0), DVec3::new(0.5, 4.0, 1.0), DVec3::NEG_Z];
    for aspect in [0.3, 1.0, 2.0] {
        let camera = orthographic().fit_points(points, BOUNDS, aspect);
        let places = points.map(|p| {
            let clip = camera.clip_from_view(aspect) * camera.view_from_world() * p.extend(1.0);
            DVec2::new(clip.x, clip.y) / clip.w * MARGIN
        });
        let high = places.into_iter().fold(DVec2::NEG_INFINITY, DVec2::max);
        assert!((high.max_element() - 1.0).abs() < 1e-9, "{high}");
        let fitted = orthographic().fit(BOUNDS, aspect);
        let height = (fitted.field_of_view / 2.0).tan() * fitted.distance * aspect.min(1.0);
        assert!((height / MARGIN - BOUNDS.radius).abs() < 1e-9);
    }
}

/// Where the world axes point as seen from a side: right, up, or towards the eye.
#[track_caller]
fn check_side(side: Side, up: Up, right: DVec3, upwards: DVec3) {
    let camera = camera().from_side(side, up);
    check_near(camera.world_from_view * DVec3::X, right);
    check_near(camera.world_from_view * DVec3::Y, upwards);
    assert_eq!(camera.pivot, BOUNDS.center);
    assert_eq!(camera.side(up), Some(side));
}

#[test]
fn sides_are_seen_as_drawings_show_them() {
    let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
    check_side(Side::Front, Up::Y, x, y);
    check_side(Side::Back, Up::Y, -x, y);
    check_side(Side::Right, Up::Y, -z, y);
    check_side(Side::Left, Up::Y, z, y);
    check_side(Side::Top, Up::Y, x, -z);
    check_side(Side::Bottom, Up::Y, x, z);
    check_side(Side::Front, Up::Z, x, z);
    check_side(Side::Back, Up::Z, -x, z);
    check_side(Side::Right, Up::Z, y, z);
    check_side(Side::Left, Up::Z, -y, z);
    check_side(Side::Top, Up::Z, x, y);
    check_side(Side::Bottom, Up::Z, x, -y);
}

#[test]
fn the_isometric_view_shortens_all_axes_alike() {
    for up in [Up::Y, Up::Z] {
        let view = camera().from_side(Side::Isometric, up).world_from_view.conjugate();
        let lengths = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| (view * axis).truncate().length());
        assert!(lengths.iter().all(|l| (l - (2.0_f64 / 3.0).sqrt()).abs() < 1e-12), "{lengths:?}");
        assert!((view * up.axis()).y > 0.0);
    }
}

#[test]
fn the_turntable_keeps_upright_and_stops_at_the_poles() {
    let tilted = camera().orbit(DVec2::ZERO, DVec2::new(0.4, 0.7)).orbit(DVec2::new(0.9, 0.0), DVec2::new(0.0, 0.9));
    for up in [Up::Y, Up::Z] {
        let turned = tilted.turntable(DVec2::ZERO, DVec2::new(0.2, -0.1), up);
        let seen = turned.world_from_view.conjugate() * up.axis();
        assert!(seen.x.abs() < 1e-12 && seen.y > 0.0, "{seen}");
        let over = turned.turntable(DVec2::ZERO, DVec2::new(0.0, -9.0), up);
        check_near(over.world_from_view * DVec3::Z, up.axis());
        let back = over.turntable(DVec2::ZERO, DVec2::new(0.0, 1.0), up);
        let around = |c: Camera| c.angles(up).0;
        assert!((around(back) - around(turned)).abs() < 1e-9, "the pole does not turn it");
    }
}

#[test]
fn the_turntable_follows_the_pointer_half_a_turn_for_the_height() {
    let front = camera().from_side(Side::Front, Up::Y);
    let turned = front.turntable(DVec2::ZERO, DVec2::new(2.0, 0.0), Up::Y);
    assert_eq!(turned.side(Up::Y), Some(Side::Back));
    // What was in front goes to the right with the pointer.
    let nudged = front.turntable(DVec2::ZERO, DVec2::new(0.1, 0.1), Up::Y);
    let at = seen(&nudged, front.pivot + DVec3::Z);
    assert!(at.x > 0.0 && at.y > 0.0, "{at}");
    assert_eq!(front.turntable(DVec2::NAN, DVec2::ONE, Up::Y), front);
}

#[test]
fn the_way_to_another_view_begins_here_and_ends_there() {
    let there = Camera { pivot: DVec3::X, distance: 40.0, orthographic: true, ..camera().from_side(Side::Back, Up::Z) };
    assert_eq!(camera().on_the_way(there, 1.0), there);
    let began = camera().on_the_way(there, 0.0);
    check_near(began.eye(), camera().eye());
    let half = camera().on_the_way(there, 0.5);
    assert!(half.is_finite() && (half.distance / (40.0 * camera().distance).sqrt() - 1.0).abs() < 1e-12);
}

#[test]
fn who_is_nearer_or_farther_than_zooming_goes_is_not_thrown_back() {
    for distance in [1e-7, 1e7] {
        let camera = Camera { distance, ..camera() };
        assert_eq!(camera.zoom(DVec2::ZERO, 1.0, BOUNDS).distance, distance);
    }
}

#[test]
fn what_is_covered_at_the_lower_edge_stays_free_of_what_is_fitted() {
    let points: Vec<DVec3> = (0..8).map(|i| DVec3::from([i & 1, i >> 1 & 1, i >> 2].map(f64::from)) * 3.0).collect();
    let (center, radius) = (DVec3::splat(1.5), 1.5 * 3f64.sqrt());
    let bounds = Sphere { center, radius };
    for (camera, aspect) in [(camera(), 2.0), (camera(), 0.7), (orthographic(), 2.0)] {
        let fit = |camera: Camera, aspect| camera.fit_points(points.iter().copied(), bounds, aspect);
        let places = |camera: &Camera| -> Vec<DVec2> {
            let clip = camera.clip_from_view(aspect) * camera.view_from_world();
            points.iter().map(|p| clip * p.extend(1.0)).map(|p| DVec2::new(p.x, p.y) / p.w).collect()
        };
        assert_eq!(camera.fit_above(0.04, aspect, fit), fit(camera, aspect), "the margin is enough");
        for below in [0.1, 0.2, 0.3] {
            let fitted = camera.fit_above(below, aspect, fit);
            assert_eq!(fitted.field_of_view, camera.field_of_view);
            let lowest = places(&fitted).iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
            assert!(lowest >= 2.0 * below - 1.0 - 1e-9, "{below} of {aspect}: {lowest}");
            assert!(places(&fitted).iter().all(|p| p.abs().max_element() <= 1.0), "{below} of {aspect}");
        }
    }
}
