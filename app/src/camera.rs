//! The viewpoint: an eye that turns around a pivot. Pure functions that give a new camera.
//!
//! An orthographic camera has its lines of sight parallel. It shows the plane of the pivot as large as a perspective one
//! at the same distance and opening angle does, and hides nothing for being behind the eye.
//!
//! Places in the picture are given as `DVec2`: zero in its centre, x right, y up, ±1 at its upper and lower edge (so
//! x reaches ±aspect); [`picture_point`] makes them from pixels.

#[cfg(test)]
mod tests;

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use glam::{DMat3, DMat4, DQuat, DVec2, DVec3, DVec4};

use crate::scene::{Plane, Sphere};

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
    /// Whether lines of sight are parallel.
    #[serde(default)]
    pub orthographic: bool,
}

/// Which axis of the world points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub enum Up {
    /// y, as in most files of meshes: the front is seen from +z.
    #[default]
    Y,
    /// z, as in drawings of engineers: the front is seen from −y.
    Z,
}

/// From where one looks at things.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// With x to the right.
    Front,
    /// With x to the left.
    Back,
    /// From −x.
    Left,
    /// From +x.
    Right,
    /// From above, the front below.
    Top,
    /// From below, the front above.
    Bottom,
    /// From the front, right and above, so that all axes are seen equally short.
    Isometric,
}

impl Side {
    /// All of them.
    pub const ALL: [Self; 7] =
        [Self::Front, Self::Back, Self::Left, Self::Right, Self::Top, Self::Bottom, Self::Isometric];

    /// Around the up axis and above the horizon, in radians.
    fn angles(self) -> (f64, f64) {
        match self {
            Self::Front => (0.0, 0.0),
            Self::Back => (2.0 * FRAC_PI_2, 0.0),
            Self::Left => (-FRAC_PI_2, 0.0),
            Self::Right => (FRAC_PI_2, 0.0),
            Self::Top => (0.0, FRAC_PI_2),
            Self::Bottom => (0.0, -FRAC_PI_2),
            Self::Isometric => (FRAC_PI_4, std::f64::consts::FRAC_1_SQRT_2.atan()),
        }
    }
}

impl Up {
    /// As a direction.
    #[must_use]
    pub fn axis(self) -> DVec3 {
        match self {
            Self::Y => DVec3::Y,
            Self::Z => DVec3::Z,
        }
    }

    /// How the front is seen.
    fn front(self) -> DQuat {
        match self {
            Self::Y => DQuat::IDENTITY,
            Self::Z => DQuat::from_rotation_x(FRAC_PI_2),
        }
    }

    /// How things are seen from the angle `around` the axis, counted from the front to the right, and `above` the horizon.
    fn seen_from(self, around: f64, above: f64) -> DQuat {
        (self.front() * DQuat::from_rotation_y(around) * DQuat::from_rotation_x(-above)).normalize()
    }
}

/// A half-line from the eye.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// The eye; that of an orthographic camera is far away.
    pub origin: DVec3,
    /// Of length one.
    pub direction: DVec3,
}

/// Opening angle of new cameras: natural proportions, little distortion.
pub const FIELD_OF_VIEW: f64 = 0.5;

/// How much room a fitted ball leaves around itself.
const MARGIN: f64 = 1.1;

/// Zooming stops when this many times as near, or as far, as the radius of what is looked at.
const NEAREST: f64 = 1e-4;
const FARTHEST: f64 = 1e4;

/// Rays of orthographic cameras begin this many times as far as the eye, where nothing is.
const BEYOND: f64 = 1e5;

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
        Self { pivot: bounds.center, world_from_view, distance: 1.0, field_of_view: FIELD_OF_VIEW, orthographic: false }
            .fit(bounds, aspect)
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
        let narrower = half * aspect.clamp(1e-3, 1.0);
        let beside = if self.orthographic { narrower } else { narrower.atan().sin() };
        Self { pivot: bounds.center, distance: MARGIN * radius(bounds) / beside, ..self }
    }

    /// The four world directions that decide what [`Camera::fit_points`] gives: it needs no more points than the one that
    /// lies farthest in each.
    #[must_use]
    pub fn decisive_directions(&self, aspect: f64) -> [DVec3; 4] {
        let slope = if self.orthographic { DVec2::ZERO } else { self.slope(aspect) };
        [(1.0, 0.0, slope.x), (-1.0, 0.0, slope.x), (0.0, 1.0, slope.y), (0.0, -1.0, slope.y)]
            .map(|direction| self.world_from_view * DVec3::from(direction))
    }

    /// How far something lies from a ray, for each unit of length from the eye, that is seen so far beside it; one is half
    /// the height of the picture.
    #[must_use]
    pub fn spread(&self, beside: f64) -> f64 {
        let narrowing = if self.orthographic { BEYOND } else { 1.0 };
        (self.field_of_view / 2.0).tan() * beside / narrowing
    }

    /// Looks from the same side so that these points just fit, with a margin: closer than [`Camera::fit`] where they fill
    /// their ball badly. Turns around the depth of `bounds`' centre from then on. Without points it is [`Camera::fit`].
    ///
    /// A point (x, y, z) in view directions is seen from an eye (a, b, c) if `|x − a| ≤ s (c − z)`, s the slope of the
    /// sides, and so with y. The nearest such eye has `a = (r − l)/2` and `c = (r + l)/2s`, where `r = max(x + s z)` and
    /// `l = max(−x + s z)`; of the two c that x and y ask for, the greater one holds. Parallel lines of sight do not care
    /// for z.
    #[must_use]
    pub fn fit_points(self, points: impl IntoIterator<Item = DVec3>, bounds: Sphere, aspect: f64) -> Self {
        let slope = self.slope(aspect);
        let view_from_world = self.world_from_view.conjugate();
        let (mut positive, mut negative) = (DVec2::NEG_INFINITY, DVec2::NEG_INFINITY);
        for point in points {
            let p = view_from_world * (point - bounds.center);
            let nearer = if self.orthographic { DVec2::ZERO } else { slope * p.z };
            positive = positive.max(nearer + p.truncate());
            negative = negative.max(nearer - p.truncate());
        }
        let distance = ((positive + negative) / (2.0 * slope)).max_element();
        if !(distance > radius(bounds) * NEAREST && distance.is_finite()) {
            return self.fit(bounds, aspect);
        }
        let shift = (positive - negative) / 2.0;
        Self { pivot: bounds.center + self.world_from_view * shift.extend(0.0), distance, ..self }
    }

    /// What `fit` gives for a picture of this width over height, `below` of whose height is covered at the lower edge: shows
    /// the same in what is free above. Of what the margin leaves there anyway nothing changes.
    #[must_use]
    pub fn fit_above(self, below: f64, aspect: f64, fit: impl FnOnce(Self, f64) -> Self) -> Self {
        let margin = (1.0 - 1.0 / MARGIN) / 2.0;
        let covered = ((below - margin) / (1.0 - margin)).clamp(0.0, 0.5);
        if covered == 0.0 {
            return fit(self, aspect);
        }
        let (half, free) = ((self.field_of_view / 2.0).tan(), 1.0 - covered);
        let above = fit(Self { field_of_view: 2.0 * (half * free).atan(), ..self }, aspect / free);
        // The middle of what is free lies half of what is covered above the middle of the picture.
        let down = self.world_from_view * DVec3::Y * (half * covered * above.distance);
        Self { pivot: above.pivot - down, field_of_view: self.field_of_view, ..above }
    }

    /// The sides of what is seen in a picture of this width over height: right, left, top, bottom. What lies beyond one of
    /// them is not seen.
    #[must_use]
    pub fn sides(&self, aspect: f64) -> [Plane; 4] {
        let slope = MARGIN * self.slope(aspect);
        [(DVec3::X, slope.x), (DVec3::NEG_X, slope.x), (DVec3::Y, slope.y), (DVec3::NEG_Y, slope.y)].map(
            |(out, slope)| {
                if self.orthographic {
                    let normal = self.world_from_view * out;
                    return Plane { normal, place: normal.dot(self.pivot) + slope * self.distance };
                }
                let normal = self.world_from_view * (out + slope * DVec3::Z).normalize();
                Plane { normal, place: normal.dot(self.eye()) }
            },
        )
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

    /// The turntable: turns around the up axis as the pointer goes sideways and tilts as it goes up or down, half a turn
    /// for the height of the picture. The up axis stays upright in the picture, never upside down.
    #[must_use]
    pub fn turntable(self, from: DVec2, to: DVec2, up: Up) -> Self {
        let angles = (to - from) * FRAC_PI_2;
        if angles.is_finite() { self.turned(-angles.x, -angles.y, up) } else { self }
    }

    /// Goes around the up axis, to the right, and up, by angles in radians; stands upright afterwards.
    #[must_use]
    pub fn turned(self, around: f64, above: f64, up: Up) -> Self {
        let (from_around, from_above) = self.angles(up);
        let above = (from_above + above).clamp(-FRAC_PI_2, FRAC_PI_2);
        Self { world_from_view: up.seen_from(from_around + around, above), ..self }
    }

    /// Where the eye is around the up axis and above the horizon, in radians.
    fn angles(self, up: Up) -> (f64, f64) {
        let turn = up.front().conjugate() * self.world_from_view;
        let eye = turn * DVec3::Z;
        let above = eye.y.clamp(-1.0, 1.0).asin();
        // Seen from straight above or below, the upper edge of the picture tells where one stands.
        let level = if eye.x.hypot(eye.z) > 1e-6 { eye } else { turn * DVec3::NEG_Y * eye.y.signum() };
        (level.x.atan2(level.z), above)
    }

    /// Looks at the same point from a side.
    #[must_use]
    pub fn from_side(self, side: Side, up: Up) -> Self {
        let (around, above) = side.angles();
        Self { world_from_view: up.seen_from(around, above), ..self }
    }

    /// The side it looks from, if it is one.
    #[must_use]
    pub fn side(&self, up: Up) -> Option<Side> {
        let same = |side: &Side| self.from_side(*side, up).world_from_view.angle_between(self.world_from_view) < 1e-3;
        Side::ALL.into_iter().find(same)
    }

    /// On the way to another one: 0 is here, 1 there.
    #[must_use]
    pub fn on_the_way(self, to: Self, t: f64) -> Self {
        if t >= 1.0 {
            return to;
        }
        let mix = |a: f64, b: f64| a * (b / a).powf(t); // as sizes are seen
        Self {
            pivot: self.pivot.lerp(to.pivot, t),
            world_from_view: self.world_from_view.slerp(to.world_from_view, t).normalize(),
            distance: mix(self.distance, to.distance),
            field_of_view: mix(self.field_of_view, to.field_of_view),
            orthographic: to.orthographic,
        }
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
    ///
    /// Orthographic cameras give every point the weight of the pivot, and depths between 1 and 0 far before the eye and
    /// far behind the pivot; who knows where things are asks [`Camera::clip_from_view_within`].
    #[must_use]
    pub fn clip_from_view(&self, aspect: f64) -> DMat4 {
        self.clip_from_view_within(aspect, Sphere { center: self.pivot, radius: self.distance * FARTHEST })
    }

    /// The same, with the depths of orthographic cameras spread over a ball that holds everything.
    #[must_use]
    pub fn clip_from_view_within(&self, aspect: f64, bounds: Sphere) -> DMat4 {
        let focal = 1.0 / (self.field_of_view / 2.0).tan();
        if self.orthographic {
            let middle = self.view_from_world().transform_point3(bounds.center).z;
            let depth = self.distance * self.depth_per_length(bounds);
            let shift = self.distance / 2.0 - depth * middle;
            return DMat4::from_cols(
                DVec4::new(focal / aspect, 0.0, 0.0, 0.0),
                DVec4::new(0.0, focal, 0.0, 0.0),
                DVec4::new(0.0, 0.0, depth, 0.0),
                DVec4::new(0.0, 0.0, shift, self.distance),
            );
        }
        DMat4::from_cols(
            DVec4::new(focal / aspect, 0.0, 0.0, 0.0),
            DVec4::new(0.0, focal, 0.0, 0.0),
            DVec4::new(0.0, 0.0, 0.0, -1.0),
            DVec4::new(0.0, 0.0, self.near(), 0.0),
        )
    }

    /// By how much depth grows towards the eye of an orthographic camera; 0 of a perspective one, where that depends.
    #[must_use]
    pub fn depth_per_length(&self, bounds: Sphere) -> f64 {
        if self.orthographic { 0.49 / radius(bounds) } else { 0.0 }
    }

    /// Nothing nearer to the eye of a perspective camera is seen.
    #[must_use]
    pub fn near(&self) -> f64 {
        self.distance * 1e-3
    }

    /// What lies under a place in the picture.
    #[must_use]
    pub fn ray(&self, at: DVec2) -> Ray {
        let beside = (self.half_height() * at).extend(0.0);
        if self.orthographic {
            let origin = self.pivot + self.world_from_view * (beside + DVec3::new(0.0, 0.0, BEYOND * self.distance));
            return Ray { origin, direction: self.world_from_view * DVec3::NEG_Z };
        }
        let direction = DVec3::new(0.0, 0.0, -self.distance) + beside;
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
