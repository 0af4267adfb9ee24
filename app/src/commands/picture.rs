//! Pictures of meshes without window.

use std::borrow::Cow;
use std::io::Cursor;

use app::annotate::field::NoField;
use app::annotate::{ArrowSet, Label, Subject, Tint};
use app::camera::Camera;
use app::figure::{self, Drawing, Missing};
use app::render::{self, Dressing, Headless, RenderError};
use app::scene::{Scene, Sphere, Style};
use app::viewpoint::Viewpoint;
use glam::{DQuat, DVec3};
use image::codecs::gif::{GifEncoder, Repeat};
use image::{Delay, Frame, ImageFormat, RgbaImage};
use vv::diagnostic::{Diagnostic, Severity};
use vv::mesh::Mesh;
use vv::mesh::faces::{Faces, faces as find_faces};
use vv::source::Sources;
use vv::stop::Stop;

use super::look::{self, Look};
use super::output::Size;
use super::report::Reporter;
use super::{Exit, error, fail};

/// Keeps the graphics driver from writing to stderr, among our diagnostics, by running vv anew where it would. To be
/// called before anything is read, by who will draw.
///
/// Mesa's Vulkan layer that chooses among GPUs asks the Wayland display for its own; where there is no session the
/// Wayland library complains. Only a variable keeps the layer away, and only from the start of a process.
pub fn keep_driver_quiet() {
    #[cfg(target_os = "linux")]
    {
        use std::os::unix::process::CommandExt;

        const WITHOUT_LAYER: &str = "NODEVICE_SELECT";
        let set = |name| std::env::var_os(name).is_some();
        if set("XDG_RUNTIME_DIR") || set(WITHOUT_LAYER) {
            return;
        }
        if let Ok(program) = std::env::current_exe() {
            // Comes back only if it fails; then the complaints are to be endured.
            let mut arguments = std::env::args_os();
            let name = arguments.next().unwrap_or_else(|| program.clone().into());
            let _ = std::process::Command::new(program).arg0(name).args(arguments).env(WITHOUT_LAYER, "1").exec();
        }
    }
}

/// What pictures need; everything else does without.
const WITHOUT_DRIVER: &str = "pictures (.png, .gif) need a Vulkan driver, and there is none: on Debian and Ubuntu \
                              `apt install mesa-vulkan-drivers libvulkan1` brings one that draws without a graphics card";

/// Samples for each pixel, when nobody says.
const SAMPLES: u32 = 4;

/// What a picture shall be like.
#[derive(Debug, Clone, Copy)]
pub struct Shot<'a> {
    /// Its size.
    pub size: Size,
    /// From where it looks; else as the window does at first.
    pub viewpoint: Option<Viewpoint>,
    /// What it shows.
    pub look: &'a Look,
}

impl Shot<'_> {
    /// With the axis up that the viewpoint says.
    fn style(&self) -> Style {
        let up = match self.viewpoint {
            Some(Viewpoint::From { up, .. }) => up,
            _ => self.look.style.up,
        };
        let transparent = self.look.style.transparent || self.look.background.is_some();
        Style { up, transparent, ..self.look.style }
    }
}

/// A mesh ready to be drawn.
#[derive(Debug)]
pub struct Exhibit<'a> {
    mesh: Cow<'a, Mesh>,
    faces: Cow<'a, Faces>,
    scene: Scene,
    tint: Option<Tint>,
    arrows: ArrowSet,
}

impl<'a> Exhibit<'a> {
    /// Of a mesh.
    ///
    /// # Errors
    /// [`Exit::Usage`] if the mesh lacks what is to be shown; reported.
    pub fn new(result: look::Result<'a>, look: &Look, reporter: &Reporter) -> Result<Self, Exit> {
        let look::Result { mesh, faces, past } = result;
        if let Err(why) = drawable(mesh) {
            return fail(reporter, Exit::Program, error(format!("there is no picture of the mesh: {why}")));
        }
        let annotations = &look.annotations;
        let never = Stop::new();
        let first = past.first.as_ref().filter(|_| look.style.control);
        let control = first.and_then(|first| Some((first, find_faces(first, &never).ok()?)));
        let control = control.as_ref().map(|(first, faces)| (*first, faces));
        let Ok(scene) = Scene::new(mesh, faces, control, &never) else {
            return Err(Exit::Budget); // not reached: nobody stops it
        };
        let subject = Subject {
            mesh,
            faces,
            scene: &scene,
            generation: past.generation,
            before: past.before.as_ref(),
            lineage: &past.lineage,
            tint: None,
        };
        let tint = match Tint::new(&subject, annotations, &never) {
            Ok(tint) => tint,
            Err(NoField::Stopped(_)) => return Err(Exit::Budget), // not reached either
            Err(NoField::Missing(why)) => {
                let diagnostic = error(format!("the picture cannot be coloured by `{}`", annotations.color_by));
                return fail(reporter, Exit::Usage, diagnostic.evidence(why));
            }
        };
        let arrows = match ArrowSet::new(&subject, &annotations.arrows, &never) {
            Ok(arrows) => arrows,
            Err(NoField::Stopped(_)) => return Err(Exit::Budget), // nor this
            Err(NoField::Missing(why)) => {
                return fail(reporter, Exit::Usage, error("the picture cannot have these arrows").evidence(why));
            }
        };
        let lacks = match &look.notes.labels {
            Label::Numbers if tint.is_none() => {
                Some("it is not coloured by anything: add `--color-by WHAT`".to_owned())
            }
            Label::Property(name) if !mesh.vertex_properties().iter().any(|property| property.name == *name) => {
                Some(format!("no vertex property `{name}` here"))
            }
            _ => None,
        };
        if let Some(why) = lacks {
            return fail(reporter, Exit::Usage, error("the picture cannot have these labels").evidence(why));
        }
        if let Some(v) = look.notes.rings.iter().find(|v| !mesh.set.contains(**v)) {
            return fail(reporter, Exit::Usage, error(format!("there is no vertex {v} whose ring could be shown")));
        }
        Ok(Self { mesh: Cow::Borrowed(mesh), faces: Cow::Borrowed(faces), scene, tint, arrows })
    }

    /// The same with a copy of the mesh, if that is needed to draw it.
    pub fn kept(self, look: &Look, for_figure: bool) -> Exhibit<'static> {
        let Self { mesh, faces, scene, tint, arrows } = self;
        let (mesh, faces) = match for_figure || !look.notes.is_empty() {
            true => (mesh.into_owned(), faces.into_owned()),
            false => (Mesh::new(), Faces::default()),
        };
        Exhibit { mesh: Cow::Owned(mesh), faces: Cow::Owned(faces), scene, tint, arrows }
    }

    /// What of it is drawn.
    fn subject<'s>(&'s self, look: &'s Look) -> figure::Subject<'s> {
        let (mesh, faces, tint) = (&*self.mesh, &*self.faces, self.tint.as_ref());
        figure::Subject { scene: &self.scene, mesh, faces, tint, notes: &look.notes }
    }
}

/// Greatest coordinates that are drawn: products of four of them are numbers.
const FAR: f64 = 1e75;

/// Smallest size that is drawn, for the same reason.
const SMALL: f64 = 1e-75;

/// Whether a mesh is somewhere, of a size that can be drawn.
fn drawable(mesh: &Mesh) -> Result<(), String> {
    let places = || mesh.set.iter().map(|v| mesh.position(v)).filter(|p| p.is_finite());
    let low = places().reduce(DVec3::min).ok_or("no vertex has a finite position")?;
    let high = places().reduce(DVec3::max).unwrap_or(low);
    let reach = low.abs().max(high.abs()).max_element();
    let size = (high - low).max_element();
    if reach > FAR {
        return Err(format!("its coordinates reach {reach:e}, and up to {FAR:e} can be drawn"));
    }
    if size > 0.0 && size < SMALL {
        return Err(format!("it is {size:e} in size, and from {SMALL:e} on it could be drawn"));
    }
    Ok(())
}

/// A picture of a mesh.
///
/// # Errors
/// [`Exit::NoRenderer`], or [`Exit::Usage`] if the mesh lacks what it is to be coloured by; reported.
pub fn picture(result: look::Result<'_>, shot: Shot<'_>, reporter: &Reporter) -> Result<RgbaImage, Exit> {
    let exhibit = Exhibit::new(result, shot.look, reporter)?;
    let camera = camera(&[&exhibit], shot);
    let mut drawn = RgbaImage::default();
    draw(&[(&exhibit, camera)], shot, reporter, |picture| {
        drawn = picture;
        Ok(())
    })?;
    Ok(drawn)
}

/// A figure of a mesh.
///
/// # Errors
/// [`Exit::Usage`] if the mesh lacks what it is to be coloured by, or nothing of it is seen; reported.
pub fn figure(result: look::Result<'_>, shot: Shot<'_>, reporter: &Reporter) -> Result<Drawing, Exit> {
    let exhibit = Exhibit::new(result, shot.look, reporter)?;
    let tile =
        figure::Tile { sketch: Some(sketch(&exhibit, &camera(&[&exhibit], shot), shot)?), caption: String::new() };
    sheet(vec![tile], None, &shot.look.figure, reporter)
}

/// What is seen of a mesh, for a figure.
///
/// # Errors
/// None that is reached.
pub fn sketch(exhibit: &Exhibit<'_>, camera: &Camera, shot: Shot<'_>) -> Result<figure::Sketch, Exit> {
    let aspect = render::Size::new(shot.size.0, shot.size.1).aspect();
    let (subject, figure) = (exhibit.subject(shot.look), &shot.look.figure);
    figure::sketch(subject, camera, aspect, &shot.style(), figure, &Stop::new()).map_err(|_| Exit::Budget)
}

/// A figure of one or several.
///
/// # Errors
/// [`Exit::Usage`] if nothing is seen, reported.
pub fn sheet(
    tiles: Vec<figure::Tile>,
    columns: Option<usize>,
    settings: &figure::Settings,
    reporter: &Reporter,
) -> Result<Drawing, Exit> {
    match figure::sheet(tiles, columns, settings) {
        Some(drawing) => {
            if !drawing.is_exact {
                let warning = Diagnostic::new(Severity::Warning, None, figure::ROUGH);
                reporter.report_once(warning.hint("leave faces empty with `--style no-faces`"));
            }
            warn_of_missing(&drawing.missing, reporter);
            Ok(drawing)
        }
        None => fail(reporter, Exit::Usage, error("nothing of the mesh is seen from there, so there is no figure")),
    }
}

/// Says once what of the notes no picture shows.
fn warn_of_missing(missing: &[Missing], reporter: &Reporter) {
    for missing in missing {
        let warning = Diagnostic::new(Severity::Warning, None, missing.to_string());
        reporter.report_once(warning.hint("`--view` says from where a mesh is seen"));
    }
}

/// From where all of these are seen, whole.
pub fn camera(exhibits: &[&Exhibit<'_>], shot: Shot<'_>) -> Camera {
    let (style, aspect) = (shot.style(), render::Size::new(shot.size.0, shot.size.1).aspect());
    let scenes: Vec<&Scene> = exhibits.iter().map(|exhibit| &exhibit.scene).collect();
    let fit = |camera| Scene::fit_all(&scenes, camera, &style, aspect);
    let bounds = Sphere::around(scenes.iter().map(|scene| scene.bounds(&style)));
    let standard = match scenes.as_slice() {
        [only] => only.standard_view(&style, aspect),
        _ => fit(Camera::standard(bounds, aspect)),
    };
    match shot.viewpoint {
        None => standard,
        Some(Viewpoint::At(camera)) => camera,
        Some(Viewpoint::From { side, orthographic, up }) => {
            fit(Camera { orthographic, ..standard.from_side(side, up) })
        }
    }
}

/// From where a mesh is seen while one goes around it once, to the right, in so many steps; from everywhere it is whole.
pub fn around(exhibit: &Exhibit<'_>, shot: Shot<'_>, steps: u32) -> Vec<Camera> {
    let (style, aspect) = (shot.style(), render::Size::new(shot.size.0, shot.size.1).aspect());
    let (axis, camera) = (style.up.axis(), camera(&[exhibit], shot));
    let (first, middle) = match shot.viewpoint {
        Some(Viewpoint::At(_)) => (camera, camera.pivot),
        _ => (exhibit.scene.fit_turning(camera, axis, &style, aspect), exhibit.scene.bounds(&style).center),
    };
    let turned = |step: u32| {
        let turn = DQuat::from_axis_angle(axis, std::f64::consts::TAU * f64::from(step) / f64::from(steps));
        let pivot = middle + turn * (first.pivot - middle);
        Camera { world_from_view: (turn * first.world_from_view).normalize(), pivot, ..first }
    };
    (0..steps).map(turned).collect()
}

/// Gives colours of numbers one range for all of them, from the lowest to the highest end of those that each would have:
/// what is seen side by side, or one after the other, can be compared. A range that was asked for stays.
pub fn in_one_range<'e, 'm: 'e>(exhibits: impl Iterator<Item = &'e mut Exhibit<'m>>, look: &Look) {
    if look.annotations.range.is_some() {
        return;
    }
    let mut tints: Vec<_> =
        exhibits.filter_map(|exhibit| exhibit.tint.as_mut().filter(|tint| tint.has_range())).collect();
    let range = |tint: &&mut Tint| match tint.legend.extremes? {
        [low, high] if low < high => Some(tint.legend.range),
        one => Some(one), // all the same: no range of its own
    };
    let ranges = tints.iter().filter_map(range);
    let Some(common) = ranges.reduce(|[a, b], [low, high]| [a.min(low), b.max(high)]) else { return };
    for tint in &mut tints {
        **tint = tint.with_range(Some(common));
    }
}

/// Pictures of one size, one after the other; `take` gets each.
///
/// # Errors
/// [`Exit::NoRenderer`], reported, and those of `take`.
pub fn draw(
    exhibits: &[(&Exhibit<'_>, Camera)],
    shot: Shot<'_>,
    reporter: &Reporter,
    mut take: impl FnMut(RgbaImage) -> Result<(), Exit>,
) -> Result<(), Exit> {
    let size = render::Size::new(shot.size.0, shot.size.1);
    let style = shot.style();
    let failed = |problem: RenderError| {
        let diagnostic = match problem {
            RenderError::NoRenderer(none) if std::env::var_os("WGPU_ADAPTER_NAME").is_some() => {
                error(WITHOUT_DRIVER).evidence(none.cause)
            }
            RenderError::NoRenderer(_) => error(WITHOUT_DRIVER),
            RenderError::TooLarge(why) | RenderError::Failed(why) => {
                error(format!("the picture cannot be drawn: {why}"))
            }
        };
        reporter.report(&[diagnostic], &Sources::default());
        Exit::NoRenderer
    };
    let headless = Headless::new(shot.look.samples.unwrap_or(SAMPLES)).map_err(failed)?;
    let mut missing = Vec::new();
    for (number, (exhibit, camera)) in (1..).zip(exhibits) {
        if let count @ 2.. = exhibits.len() {
            reporter.progress(format!("drawing picture {number} of {count}"));
        }
        let arrows = Some((&exhibit.arrows, shot.look.annotations.arrow_length));
        let dressing = Dressing { tint: exhibit.tint.as_ref(), arrows };
        let mut drawn = headless.dressed_image(&exhibit.scene, dressing, camera, &style, size).map_err(failed)?;
        missing.push(figure::write_on(&mut drawn, exhibit.subject(shot.look), camera, &style, lettering(size)));
        if let Some(color) = shot.look.background {
            render::put_on(&mut drawn, color);
        }
        take(drawn)?;
    }
    warn_of_missing(&Missing::in_all(missing), reporter);
    Ok(())
}

/// Pixels per point of what is written on a picture of this size: larger on a large one.
fn lettering(size: render::Size) -> f32 {
    const USUAL: f32 = 960.0;
    size.scale.max(size.width.min(size.height) as f32 / USUAL)
}

/// The picture in PNG format.
///
/// # Errors
/// [`Exit::File`], reported.
pub fn png(picture: &RgbaImage, reporter: &Reporter) -> Result<Vec<u8>, Exit> {
    let mut bytes = Cursor::new(Vec::new());
    match picture.write_to(&mut bytes, ImageFormat::Png) {
        Ok(()) => Ok(bytes.into_inner()),
        Err(problem) => fail(reporter, Exit::File, error(format!("the picture cannot be written: {problem}"))),
    }
}

/// How carefully the 256 colours of a picture of a film are chosen, from 1 to 30: more is faster.
const HASTE: i32 = 10;

/// A film in GIF format, for ever from the beginning again, of pictures that are shown for so many milliseconds.
///
/// # Errors
/// As [`draw`]; [`Exit::File`] if a side has more than 65535 pixels, reported.
pub fn film(
    exhibits: &[(&Exhibit<'_>, Camera)],
    shot: Shot<'_>,
    milliseconds: u32,
    reporter: &Reporter,
) -> Result<Vec<u8>, Exit> {
    let failed = |problem: image::ImageError| {
        reporter.report(&[error(format!("the film cannot be written: {problem}"))], &Sources::default());
        Exit::File
    };
    let delay = Delay::from_numer_denom_ms(milliseconds, 1);
    let mut bytes = Vec::new();
    let mut encoder = GifEncoder::new_with_speed(&mut bytes, HASTE);
    encoder.set_repeat(Repeat::Infinite).map_err(failed)?;
    draw(exhibits, shot, reporter, |picture| {
        encoder.encode_frame(Frame::from_parts(picture, 0, 0, delay)).map_err(failed)
    })?;
    drop(encoder); // writes the end
    Ok(bytes)
}
