//! The viewpoint: an arcball around a pivot. Pure functions that give a new camera.
//!
//! Places in the picture are given as `DVec2`: zero in its centre, x right, y up, ±1 at its upper and lower edge (so
//! x reaches ±aspect); [`picture_point`] makes them from pixels.

use glam::{DMat3, DMat4, DQuat, DVec2, DVec3, DVec4};

use crate::scene::Sphere;

/// Where the eye is and how it looks. World units throughout.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Camera {
    /// Point the camera turns around and looks at.
    pub pivot: DVec3,
    /// Turns view directions (x right, y up, z towards the eye) into world directions.
    pub world_from_view: DQuat,
    /// From the eye to the pivot.
    pub distance: f64,
    /// Vertical opening angle in radians.
    pub field_of_view: f64,
}

/// A half-line from the eye.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// The eye.
    pub origin: DVec3,
    /// Of length one.
    pub direction: DVec3,
}

/// Opening angle of new cameras: natural proportions, little distortion.
const FIELD_OF_VIEW: f64 = 0.5;

/// How much room a fitted ball leaves around itself.
const MARGIN: f64 = 1.1;

/// Zooming stops when this many times as near, or as far, as the radius of what is looked at.
const NEAREST: f64 = 1e-4;
const FARTHEST: f64 = 1e4;

/// The place of a pixel position (from the upper left corner, y down) in a picture of `size` pixels.
#[must_use]
pub fn picture_point(pixel: DVec2, size: DVec2) -> DVec2 {
    let from_center = pixel - size / 2.0;
    DVec2::new(from_center.x, -from_center.y) * 2.0 / size.y.max(1.0)
}

impl Camera {
    /// The standard view: from the front, a little from the right and from above (y is up), fitted.
    #[must_use]
    pub fn standard(bounds: Sphere, aspect: f64) -> Self {
        let world_from_view = DQuat::from_rotation_y(0.6) * DQuat::from_rotation_x(-0.45);
        Self { pivot: bounds.center, world_from_view, distance: 1.0, field_of_view: FIELD_OF_VIEW }.fit(bounds, aspect)
    }

    /// Whether it is anywhere and looks at something: what was computed always is, what was read may not.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        let angle = self.field_of_view;
        self.pivot.is_finite()
            && self.world_from_view.is_normalized()
            && self.distance.is_finite()
            && self.distance > 0.0
            && (1e-3..3.1).contains(&angle)
    }

    /// Looks from the same side so that the ball just fits, with a margin, into a picture of this width over height.
    #[must_use]
    pub fn fit(self, bounds: Sphere, aspect: f64) -> Self {
        let half = (self.field_of_view / 2.0).tan();
        let narrower = (half * aspect.clamp(1e-3, 1.0)).atan();
        Self { pivot: bounds.center, distance: MARGIN * radius(bounds) / narrower.sin(), ..self }
    }

    /// The four world directions that decide what [`Camera::fit_points`] gives: it needs no more points than the one that
    /// lies farthest in each.
    #[must_use]
    pub fn decisive_directions(&self, aspect: f64) -> [DVec3; 4] {
        let slope = self.slope(aspect);
        [(1.0, 0.0, slope.x), (-1.0, 0.0, slope.x), (0.0, 1.0, slope.y), (0.0, -1.0, slope.y)]
            .map(|direction| self.world_from_view * DVec3::from(direction))
    }

    /// How far something lies from a ray, for each unit of length from the eye, that is seen so far beside it; one is half
    /// the height of the picture.
    #[must_use]
    pub fn spread(&self, beside: f64) -> f64 {
        (self.field_of_view / 2.0).tan() * beside
    }

    /// Looks from the same side so that these points just fit, with a margin: closer than [`Camera::fit`] where they fill
    /// their ball badly. Turns around the depth of `bounds`' centre from then on. Without points it is [`Camera::fit`].
    ///
    /// A point (x, y, z) in view directions is seen from an eye (a, b, c) if `|x − a| ≤ s (c − z)`, s the slope of the
    /// sides, and so with y. The nearest such eye has `a = (r − l)/2` and `c = (r + l)/2s`, where `r = max(x + s z)` and
    /// `l = max(−x + s z)`; of the two c that x and y ask for, the greater one holds.
    #[must_use]
    pub fn fit_points(self, points: impl IntoIterator<Item = DVec3>, bounds: Sphere, aspect: f64) -> Self {
        let slope = self.slope(aspect);
        let view_from_world = self.world_from_view.conjugate();
        let (mut positive, mut negative) = (DVec2::NEG_INFINITY, DVec2::NEG_INFINITY);
        for point in points {
            let p = view_from_world * (point - bounds.center);
            positive = positive.max(p.truncate() + slope * p.z);
            negative = negative.max(slope * p.z - p.truncate());
        }
        let distance = ((positive + negative) / (2.0 * slope)).max_element();
        if !(distance > radius(bounds) * NEAREST && distance.is_finite()) {
            return self.fit(bounds, aspect);
        }
        let shift = (positive - negative) / 2.0;
        Self { pivot: bounds.center + self.world_from_view * shift.extend(0.0), distance, ..self }
    }

    /// How steeply the sides of what is seen lead away from its middle, but for the margin.
    fn slope(&self, aspect: f64) -> DVec2 {
        let upright = (self.field_of_view / 2.0).tan() / MARGIN;
        DVec2::new(upright * aspect.max(1e-3), upright)
    }

    /// The arcball: turns the view so that what is under `from` follows the pointer to `to`.
    ///
    /// The ball is continued by a hyperbolic sheet, `z = r²/2d` from the distance `d = r/√2` on, so that the motion
    /// stays smooth outside (Gavin Bell's trackball; K. Henriksen et al., "Virtual Trackballs Revisited", 2004).
    #[must_use]
    pub fn orbit(self, from: DVec2, to: DVec2) -> Self {
        let on_ball = |p: DVec2| {
            const RADIUS: f64 = 1.0;
            let d = p.length();
            let z = if d < RADIUS / std::f64::consts::SQRT_2 {
                (RADIUS * RADIUS - d * d).sqrt()
            } else {
                RADIUS * RADIUS / (2.0 * d)
            };
            p.extend(z).normalize()
        };
        if !from.is_finite() || !to.is_finite() {
            return self;
        }
        let turn = DQuat::from_rotation_arc(on_ball(from), on_ball(to));
        Self { world_from_view: (self.world_from_view * turn.conjugate()).normalize(), ..self }
    }

    /// Shifts the view so that the point of the pivot's plane under `from` comes to lie under `to`.
    #[must_use]
    pub fn pan(self, from: DVec2, to: DVec2) -> Self {
        let shift = self.half_height() * (from - to);
        let pivot = self.pivot + self.world_from_view * shift.extend(0.0);
        if pivot.is_finite() { Self { pivot, ..self } } else { self }
    }

    /// Comes nearer (`factor` < 1) or goes farther so that the point of the pivot's plane under `cursor` stays there.
    /// Stops far outside and very near, measured by `bounds`.
    #[must_use]
    pub fn zoom(self, cursor: DVec2, factor: f64, bounds: Sphere) -> Self {
        if !(factor > 0.0 && factor.is_finite() && cursor.is_finite()) {
            return self;
        }
        let (nearest, farthest) = (NEAREST * radius(bounds), FARTHEST * radius(bounds));
        let distance = (self.distance * factor).clamp(nearest.min(self.distance), farthest.max(self.distance));
        let under_cursor = self.pivot + self.world_from_view * (self.half_height() * cursor).extend(0.0);
        let pivot = under_cursor + (self.pivot - under_cursor) * (distance / self.distance);
        Self { pivot, distance, ..self }
    }

    /// Where the eye is.
    #[must_use]
    pub fn eye(&self) -> DVec3 {
        self.pivot + self.world_from_view * DVec3::new(0.0, 0.0, self.distance)
    }

    /// World to view coordinates: the eye at zero, x right, y up, looking along −z.
    #[must_use]
    pub fn view_from_world(&self) -> DMat4 {
        let turn = DMat3::from_quat(self.world_from_view.conjugate());
        let shift = turn * -self.pivot - DVec3::new(0.0, 0.0, self.distance);
        DMat4::from_cols(turn.x_axis.extend(0.0), turn.y_axis.extend(0.0), turn.z_axis.extend(0.0), shift.extend(1.0))
    }

    /// View to clip coordinates of a picture of this width over height: perspective with the far plane at infinity and
    /// depth reversed (1 at the near plane, 0 at infinity), which spreads the precision of floating point evenly.
    #[must_use]
    pub fn clip_from_view(&self, aspect: f64) -> DMat4 {
        let focal = 1.0 / (self.field_of_view / 2.0).tan();
        DMat4::from_cols(
            DVec4::new(focal / aspect, 0.0, 0.0, 0.0),
            DVec4::new(0.0, focal, 0.0, 0.0),
            DVec4::new(0.0, 0.0, 0.0, -1.0),
            DVec4::new(0.0, 0.0, self.near(), 0.0),
        )
    }

    /// Nothing nearer to the eye is seen.
    #[must_use]
    pub fn near(&self) -> f64 {
        self.distance * 1e-3
    }

    /// What lies under a place in the picture.
    #[must_use]
    pub fn ray(&self, at: DVec2) -> Ray {
        let direction = DVec3::new(0.0, 0.0, -self.distance) + (self.half_height() * at).extend(0.0);
        Ray { origin: self.eye(), direction: (self.world_from_view * direction).normalize() }
    }

    /// Half the height of the picture, at the pivot, in world units.
    fn half_height(&self) -> f64 {
        self.distance * (self.field_of_view / 2.0).tan()
    }
}

/// Of what is looked at; something for a single point, which has no size of its own.
fn radius(bounds: Sphere) -> f64 {
    if bounds.radius > 0.0 { bounds.radius } else { bounds.center.length().max(1.0) * 1e-3 }
}

#[cfg(test)]
mod tests {
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
        assert!(angle(30.0) > angle(3.0) && angle(30.0) < std::f64::consts::FRAC_PI_2);
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
}
