//! A viewpoint as text, on one line: to be copied into another window, a paper's sources or a command line.
//!
//! ```text
//! vv view: eye 3 2 6 target 0 0 0 up 0 1 0 perspective 28.6
//! vv view: eye 0 0 8 target 0 0 0 up 0 1 0 orthographic 4.5
//! front            back, left, right, top, bottom, isometric; `front orthographic z-up`
//! ```
//!
//! `perspective` is the vertical opening angle in degrees, `orthographic` the height of what is seen at the target, in
//! units of the world. `vv view:`, `up` (0 1 0) and the last part (perspective 28.6479) may be left out, the parts may
//! stand in any order, and commas may stand between numbers.

use std::fmt::Write as _;
use std::ops::Range;

use glam::{DMat3, DQuat, DVec3};

use crate::camera::{Camera, FIELD_OF_VIEW, Side, Up};

/// From where to look.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Viewpoint {
    /// From exactly there.
    At(Camera),
    /// From a side, near enough to see all.
    From {
        /// From where it is seen.
        side: Side,
        /// Whether lines of sight are parallel.
        orthographic: bool,
        /// Which axis points up.
        up: Up,
    },
}

/// Why a text is no viewpoint.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mistake {
    /// Bytes of the text.
    pub range: Range<usize>,
    /// What is wrong.
    pub message: String,
    /// What to do about it.
    pub hint: Option<String>,
}

const FORM: &str = "a view is `eye 3 2 6 target 0 0 0 up 0 1 0 perspective 28.6`, or one of front, back, left, right, \
                    top, bottom and isometric";

const BEGIN: &str = "vv view:";

/// The viewpoint of a camera. Numbers have six digits, which no one can tell from the exact ones in a picture. The text of
/// what is read from a text is that text again.
#[must_use]
pub fn to_text(camera: &Camera) -> String {
    let [right, up] = [DVec3::X, DVec3::Y].map(|axis| camera.world_from_view * axis);
    // An axis of the world that is upright in the picture, else what is; its last digits would change on the way.
    let upright = |axis: &DVec3| right.dot(*axis).abs() < 1e-6 && up.dot(*axis) > 1e-3;
    let up = [DVec3::Y, DVec3::Z].into_iter().find(upright).unwrap_or((up * 1e4).round() / 1e4);
    let mut text = BEGIN.to_owned();
    // What lies much nearer to zero than the eye to the target is zero.
    let least = camera.distance * 1e-6;
    for (name, v, least) in [("eye", camera.eye(), least), ("target", camera.pivot, least), ("up", up, 1e-6)] {
        let [x, y, z] = v.to_array().map(|x| number(if x.abs() < least { 0.0 } else { x }));
        let _ = write!(text, " {name} {x} {y} {z}");
    }
    let half = camera.field_of_view / 2.0;
    let _ = match camera.orthographic {
        true => write!(text, " orthographic {}", number(2.0 * half.tan() * camera.distance)),
        false => write!(text, " perspective {}", number(camera.field_of_view.to_degrees())),
    };
    text
}

/// Six digits, without those that say nothing.
fn number(x: f64) -> String {
    let rounded: f64 = format!("{x:.5e}").parse().unwrap_or(x);
    if rounded != 0.0 && !(1e-5..1e9).contains(&rounded.abs()) { format!("{rounded:e}") } else { format!("{rounded}") }
}

/// Reads a text.
///
/// # Errors
/// The first thing that is wrong with it.
pub fn parse(text: &str) -> Result<Viewpoint, Mistake> {
    let begin = text.len() - text.trim_start().len();
    let from = if text[begin..].starts_with(BEGIN) { begin + BEGIN.len() } else { begin };
    let words = words(text, from);
    match words.first() {
        None => Err(Mistake { range: begin..text.len(), message: "there is no view".to_owned(), hint: form() }),
        Some(word) if side(word.text).is_some() => parse_side(&words),
        Some(_) => Parts::read(&words)?.camera(from..text.trim_end().len().max(from)),
    }
}

struct Word<'t> {
    text: &'t str,
    range: Range<usize>,
}

impl Word<'_> {
    fn mistake(&self, message: impl Into<String>, hint: Option<String>) -> Mistake {
        Mistake { range: self.range.clone(), message: message.into(), hint }
    }
}

fn form() -> Option<String> {
    Some(FORM.to_owned())
}

fn words(text: &str, from: usize) -> Vec<Word<'_>> {
    let pieces = text[from..].split(|c: char| c.is_whitespace() || c == ',').filter(|piece| !piece.is_empty());
    let start = |piece: &str| piece.as_ptr() as usize - text.as_ptr() as usize;
    pieces.map(|piece| Word { text: piece, range: start(piece)..start(piece) + piece.len() }).collect()
}

fn side(word: &str) -> Option<Side> {
    Some(match word {
        "front" => Side::Front,
        "back" => Side::Back,
        "left" => Side::Left,
        "right" => Side::Right,
        "top" => Side::Top,
        "bottom" => Side::Bottom,
        "isometric" | "iso" => Side::Isometric,
        _ => return None,
    })
}

fn parse_side(words: &[Word<'_>]) -> Result<Viewpoint, Mistake> {
    let (mut sides, mut orthographic, mut up) = (None, false, Up::Y);
    for word in words {
        match (word.text, side(word.text)) {
            (_, Some(side)) if sides.is_none() => sides = Some(side),
            ("orthographic", _) => orthographic = true,
            ("perspective", _) => orthographic = false,
            ("y-up", _) => up = Up::Y,
            ("z-up", _) => up = Up::Z,
            _ => {
                let hint = "`orthographic`, `perspective`, `y-up` and `z-up` may follow a side".to_owned();
                return Err(word.mistake(format!("`{}` does not belong here", word.text), Some(hint)));
            }
        }
    }
    Ok(Viewpoint::From { side: sides.unwrap_or(Side::Front), orthographic, up })
}

/// What stands in a text.
#[derive(Default)]
struct Parts {
    eye: Option<DVec3>,
    target: Option<DVec3>,
    up: Option<(DVec3, Range<usize>)>,
    /// Whether parallel, the opening angle or height, and where it stands.
    lens: Option<(bool, f64, Range<usize>)>,
}

impl Parts {
    fn read(words: &[Word<'_>]) -> Result<Self, Mistake> {
        let mut parts = Self::default();
        let mut rest = words;
        while let [name, after @ ..] = rest {
            let twice = || name.mistake(format!("`{}` is given twice", name.text), None);
            let count = match name.text {
                "eye" | "target" | "up" => 3,
                "perspective" | "orthographic" => 1,
                _ => return Err(name.mistake(format!("`{}` does not belong here", name.text), form())),
            };
            let numbers = numbers(name, after.get(..count).unwrap_or(after), count)?;
            rest = &after[count..];
            let range = name.range.start..after[count - 1].range.end;
            let known = match (name.text, numbers.as_slice()) {
                ("eye", &[x, y, z]) => parts.eye.replace(DVec3::new(x, y, z)).is_some(),
                ("target", &[x, y, z]) => parts.target.replace(DVec3::new(x, y, z)).is_some(),
                ("up", &[x, y, z]) => parts.up.replace((DVec3::new(x, y, z), range)).is_some(),
                (lens, &[x]) => parts.lens.replace((lens == "orthographic", x, range)).is_some(),
                _ => false,
            };
            if known {
                return Err(twice());
            }
        }
        Ok(parts)
    }

    /// The camera; `all` is where the view stands as a whole.
    fn camera(self, all: Range<usize>) -> Result<Viewpoint, Mistake> {
        let mistake = |range: &Range<usize>, message: &str| {
            Err(Mistake { range: range.clone(), message: message.to_owned(), hint: None })
        };
        let (Some(eye), Some(target)) = (self.eye, self.target) else {
            let missing = if self.eye.is_none() { "eye" } else { "target" };
            return Err(Mistake { range: all, message: format!("the view says no `{missing}`"), hint: form() });
        };
        let distance = eye.distance(target);
        if !(distance > 0.0 && distance.is_finite()) {
            return mistake(&all, "eye and target are the same point");
        }
        let back = (eye - target) / distance;
        let (up, up_range) = self.up.unwrap_or((DVec3::Y, all.clone()));
        let right = up.normalize_or_zero().cross(back);
        if right.length() < 1e-9 {
            return mistake(&up_range, "`up` points along the line of sight");
        }
        let right = right.normalize();
        let turn = DQuat::from_mat3(&DMat3::from_cols(right, back.cross(right), back)).normalize();
        let (orthographic, size, range) = self.lens.unwrap_or((false, FIELD_OF_VIEW.to_degrees(), all));
        let field_of_view = if orthographic { 2.0 * (size / 2.0 / distance).atan() } else { size.to_radians() };
        let camera = Camera { pivot: target, world_from_view: turn, distance, field_of_view, orthographic };
        if camera.is_finite() {
            return Ok(Viewpoint::At(camera));
        }
        let message = match orthographic {
            false => "an opening angle lies between 0.1 and 177 degrees",
            true if size > 0.0 => "the eye is too near or too far for this height",
            true => "the height of what is seen is more than 0",
        };
        mistake(&range, message)
    }
}

fn numbers(name: &Word<'_>, words: &[Word<'_>], count: usize) -> Result<Vec<f64>, Mistake> {
    let wanted = if count == 1 { "a number" } else { "three numbers" };
    let message = format!("`{}` is followed by {wanted}", name.text);
    let mut numbers = Vec::new();
    for word in words {
        match word.text.parse::<f64>() {
            Ok(x) if x.is_finite() => numbers.push(x),
            _ => return Err(word.mistake(message, None)),
        }
    }
    if numbers.len() < count { Err(name.mistake(message, None)) } else { Ok(numbers) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Sphere;

    #[track_caller]
    fn camera(text: &str) -> Camera {
        match parse(text) {
            Ok(Viewpoint::At(camera)) => camera,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn texts_come_back_as_they_were() {
        for text in [
            "vv view: eye 3 2 6 target 0 0 0 up 0 1 0 perspective 28.6",
            "vv view: eye 3 2 6 target 0 0 0 up 0.6428 0.5702 -0.5115 perspective 28.6",
            "vv view: eye 0 0 8 target 0 0 0 up 0 1 0 perspective 28.6479",
            "vv view: eye 0 -8 0 target 0 0 0 up 0 0 1 orthographic 4.5",
            "vv view: eye 0 8.5 0 target 0 0.5 0 up 0 0 -1 perspective 120",
            "vv view: eye 1000000 0 2 target 1000000 0 1 up 0 1 0 perspective 35",
            "vv view: eye 0 0 2e-7 target 0 0 1e-7 up 1 0 0 perspective 35",
            "vv view: eye 0 0 2e20 target 0 0 1e20 up 1 0 0 orthographic 1e20",
        ] {
            assert_eq!(to_text(&camera(text)), text);
        }
    }

    #[test]
    fn what_need_not_be_said_is_what_one_would_think() {
        let whole = camera("vv view: eye 3 2 6 target 0 0 0 up 0 1 0 perspective 28.64788975654116");
        for text in [
            "eye 3 2 6 target 0 0 0",
            "  target 0,0,0   eye 3, 2, 6 \n",
            "vv view: perspective 28.64788975654116 up 0 5 0 target 0 0 0 eye 3 2 6",
        ] {
            assert_eq!(camera(text), whole, "{text}");
        }
    }

    #[test]
    fn a_camera_is_the_same_after_its_text() {
        let bounds = Sphere { center: DVec3::new(3.0, -2.0, 7.0), radius: 2.5 };
        let perspective = Camera::standard(bounds, 2.0);
        let rolled = perspective.orbit(glam::DVec2::new(0.5, 0.8), glam::DVec2::new(-0.7, 0.6));
        for before in [perspective, rolled, Camera { orthographic: true, ..rolled }] {
            let after = camera(&to_text(&before));
            assert!(after.eye().distance(before.eye()) < 1e-3 && after.pivot.distance(before.pivot) < 1e-4);
            assert!(after.world_from_view.angle_between(before.world_from_view) < 2e-4);
            assert!((after.field_of_view - before.field_of_view).abs() < 1e-5);
            assert_eq!(to_text(&after), to_text(&before));
        }
    }

    #[track_caller]
    fn check_side(text: &str, side: Side, orthographic: bool, up: Up) {
        assert_eq!(parse(text), Ok(Viewpoint::From { side, orthographic, up }), "{text}");
    }

    #[test]
    fn sides_have_names() {
        check_side("front", Side::Front, false, Up::Y);
        check_side(" top orthographic ", Side::Top, true, Up::Y);
        check_side("iso", Side::Isometric, false, Up::Y);
        check_side("isometric z-up orthographic", Side::Isometric, true, Up::Z);
        check_side("vv view: back", Side::Back, false, Up::Y);
    }

    /// The stretch between `[` and `]` is what is wrong.
    #[track_caller]
    fn check_mistake(marked: &str, message: &str) {
        let text = marked.replace(['[', ']'], "");
        let range = marked.find('[').unwrap()..marked.find(']').unwrap() - 1;
        let mistake = parse(&text).unwrap_err();
        assert_eq!((mistake.message.as_str(), mistake.range), (message, range), "{text}");
    }

    #[test]
    fn mistakes_are_told_where_they_are() {
        check_mistake("[]", "there is no view");
        check_mistake("[sideways]", "`sideways` does not belong here");
        check_mistake("front [up]", "`up` does not belong here");
        check_mistake("vv view:[ eye 1 2 3]", "the view says no `target`");
        check_mistake("[target 1 2 3]", "the view says no `eye`");
        check_mistake("eye 1 2 [x] target 0 0 0", "`eye` is followed by three numbers");
        check_mistake("eye 1 2 3 [target] 0 0", "`target` is followed by three numbers");
        check_mistake("eye 1 2 3 target 0 0 [inf]", "`target` is followed by three numbers");
        check_mistake("eye 1 2 3 [eye] 1 2 3", "`eye` is given twice");
        check_mistake("eye 1 2 3 target 0 0 0 [7]", "`7` does not belong here");
        check_mistake("[eye 1 2 3 target 1 2 3]", "eye and target are the same point");
        check_mistake("eye 0 0 1 target 0 0 0 [up 0 0 2]", "`up` points along the line of sight");
        check_mistake("eye 0 0 1 target 0 0 0 [up 0 0 0]", "`up` points along the line of sight");
        check_mistake("eye 0 0 1 target 0 0 0 [perspective 180]", "an opening angle lies between 0.1 and 177 degrees");
        check_mistake("eye 0 0 1 target 0 0 0 [orthographic 0]", "the height of what is seen is more than 0");
        check_mistake("eye 0 0 1 target 0 0 0 [orthographic 1e9]", "the eye is too near or too far for this height");
    }

    #[test]
    fn what_is_nearly_zero_is_written_as_zero() {
        let bounds = Sphere { center: DVec3::ZERO, radius: 1.0 };
        let world_from_view = DQuat::from_rotation_y(std::f64::consts::FRAC_PI_2);
        let camera = Camera { world_from_view, distance: 8.0, ..Camera::standard(bounds, 1.0) };
        assert!(to_text(&camera).starts_with("vv view: eye 8 0 0 target 0 0 0 up 0 1 0 "), "{}", to_text(&camera));
    }
}
