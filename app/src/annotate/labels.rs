//! Numbers and names written at vertices and faces: which of them, so that all can be read.
//!
//! The picture is divided into cells of the size of a label. Each cell keeps the few best of the points that are seen in
//! it; then the best of all cells are taken that hide no other and are hidden by no face:
//!
//! ```text
//!   best   shown before  >  facing the eye  >  lower number
//! ```
//!
//! so that labels stay while the camera moves a little, and old vertices, which the coarse mesh had already, come first.

use std::collections::BTreeSet;

use glam::{DVec2, DVec3, Vec3};
use vv::mesh::faces::Faces;
use vv::mesh::{Mesh, Value, Vertex};
use vv::stop::{Stop, Stopped};

use super::scale::short;
use super::{Subject, Tint};
use crate::camera::{Camera, picture_point};
use crate::scene::{Plane, Scene, Style, unpack};

/// What is written.
#[derive(Debug, Clone, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Label {
    /// Nothing.
    #[default]
    Nothing,
    /// At vertices, what they are called.
    Vertices,
    /// In faces, how many corners they have.
    Degrees,
    /// At vertices or in faces, the number they are coloured by.
    Numbers,
    /// At vertices, the value of a property.
    Property(String),
}

impl Label {
    /// Those that every mesh has.
    pub const NAMED: [Self; 4] = [Self::Nothing, Self::Vertices, Self::Degrees, Self::Numbers];

    /// What it is called in the window.
    #[must_use]
    pub fn title(&self) -> String {
        match self {
            Self::Nothing => "nothing".to_owned(),
            Self::Vertices => "vertices".to_owned(),
            Self::Degrees => "corners of faces".to_owned(),
            Self::Numbers => "numbers of the colours".to_owned(),
            Self::Property(name) => name.clone(),
        }
    }
}

/// A label in its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    /// The number of the vertex or face, from 0.
    pub element: usize,
    /// Where it stands in the world.
    pub at: DVec3,
    /// What is written.
    pub text: String,
}

/// From where it is looked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outlook {
    /// The camera.
    pub camera: Camera,
    /// How it is drawn.
    pub style: Style,
    /// The picture's size in points.
    pub size: DVec2,
}

/// Most labels at a time.
pub const MOST: usize = 250;
/// Most looks whether something is hidden.
const MOST_RAYS: usize = 3000;
/// What a label with one character takes, and each further one, in points.
const FIRST: f64 = 20.0;
const FURTHER: f64 = 7.0;
const HEIGHT: f64 = 19.0;
/// How many points a cell keeps.
const KEPT: usize = 3;

/// The labels of a mesh as it is seen. Linear in the mesh: on no window's thread. None for a property that it lacks.
///
/// # Errors
/// When stopped.
pub fn place(
    subject: &Subject<'_>,
    label: &Label,
    outlook: &Outlook,
    before: &[Placed],
    stop: &Stop,
) -> Result<Vec<Placed>, Stopped> {
    let Some(texts) = Texts::of(subject.mesh, subject.faces, subject.tint.as_deref(), label) else {
        return Ok(Vec::new());
    };
    let width = FIRST + FURTHER * (texts.longest() - 1) as f64;
    let mut cells = Cells::new(subject.scene, outlook, DVec2::new(width, HEIGHT), before);
    let part = &subject.scene.mesh;
    if texts.at_faces() {
        for (i, face) in subject.faces.iter().enumerate() {
            if i % 4096 == 0 {
                stop.check()?;
            }
            let sum: DVec3 = face.iter().map(|&v| subject.mesh.position(v)).sum();
            cells.offer(i, sum / face.len().max(1) as f64, None);
        }
    } else {
        for (i, corner) in part.corners[..part.vertex_count as usize].iter().enumerate() {
            if i % 4096 == 0 {
                stop.check()?;
            }
            let Some(v) = part.owners.get(i) else { continue };
            let normal = (corner.normal != 0).then(|| unpack(corner.normal));
            cells.offer(v.index(), subject.scene.to_world(Vec3::from(corner.position)), normal);
        }
    }
    let chosen = cells.choose(stop)?;
    Ok(chosen.into_iter().map(|(element, at)| Placed { element, at, text: texts.text(element) }).collect())
}

/// What is written at each element.
pub(crate) enum Texts<'a> {
    Vertices(usize),
    Degrees(&'a Faces),
    Numbers(&'a Tint),
    Property(&'a vv::mesh::Values),
}

impl<'a> Texts<'a> {
    /// `None` if there is nothing to write, or the mesh lacks it.
    pub fn of(mesh: &'a Mesh, faces: &'a Faces, tint: Option<&'a Tint>, label: &Label) -> Option<Self> {
        Some(match label {
            Label::Nothing => return None,
            Label::Vertices => Self::Vertices(mesh.vertex_count()),
            Label::Degrees => Self::Degrees(faces),
            Label::Numbers => Self::Numbers(tint?),
            Label::Property(name) => {
                let properties = mesh.vertex_properties();
                Self::Property(&properties.iter().find(|property| property.name == *name)?.values)
            }
        })
    }

    /// Whether it is written in faces, not at vertices.
    pub fn at_faces(&self) -> bool {
        match self {
            Self::Degrees(_) => true,
            Self::Numbers(tint) => tint.field.at_faces,
            Self::Vertices(_) | Self::Property(_) => false,
        }
    }

    /// How many characters most of them have at most.
    fn longest(&self) -> usize {
        match self {
            Self::Vertices(count) => 1 + count.to_string().len(),
            Self::Degrees(_) => 1,
            Self::Numbers(tint) => match &tint.field.kind {
                super::field::Kind::Classes(classes) => {
                    classes.iter().map(|c| c.name.chars().count()).max().unwrap_or(1)
                }
                _ => 6,
            },
            Self::Property(values) => match values {
                vv::mesh::Values::Bool(_) => 5,
                vv::mesh::Values::Int(_) => 4,
                vv::mesh::Values::Double(_) | vv::mesh::Values::Vertex(_) => 6,
                vv::mesh::Values::Vec(_) => 20,
            },
        }
    }

    /// That of a vertex or face.
    pub fn text(&self, element: usize) -> String {
        match self {
            Self::Vertices(_) => Vertex::from_index(element).map_or(String::new(), |v| v.to_string()),
            Self::Degrees(faces) => faces.get(element).len().to_string(),
            Self::Numbers(tint) => tint.field.text(element).unwrap_or_else(|| "–".to_owned()),
            Self::Property(values) => match values.get(element) {
                Some(Value::Bool(b)) => b.to_string(),
                Some(Value::Int(n)) => n.to_string(),
                Some(Value::Double(x)) => short(x),
                Some(Value::Vec(v)) => format!("{} {} {}", short(v.x), short(v.y), short(v.z)),
                Some(Value::Vertex(v)) => v.map_or_else(|| "null".to_owned(), |v| v.to_string()),
                None => "–".to_owned(),
            },
        }
    }
}

/// The lower, the better.
type Rank = (bool, bool, usize);

/// The picture in cells.
struct Cells<'a> {
    scene: &'a Scene,
    outlook: &'a Outlook,
    clip_from_world: glam::DMat4,
    /// What is cut away.
    cut: Option<Plane>,
    cell: DVec2,
    columns: usize,
    rows: usize,
    best: Vec<Vec<(Rank, DVec2, DVec3)>>,
    shown: BTreeSet<usize>,
}

impl<'a> Cells<'a> {
    fn new(scene: &'a Scene, outlook: &'a Outlook, cell: DVec2, before: &[Placed]) -> Self {
        let Outlook { camera, style, size } = outlook;
        let size = size.max(DVec2::ONE).min(DVec2::splat(20_000.0));
        let (columns, rows) = ((size.x / cell.x).ceil() as usize, (size.y / cell.y).ceil() as usize);
        Self {
            scene,
            outlook,
            clip_from_world: camera.clip_from_view(size.x / size.y) * camera.view_from_world(),
            cut: scene.cut(style, camera),
            cell,
            columns,
            rows,
            best: vec![Vec::new(); columns * rows],
            shown: before.iter().map(|placed| placed.element).collect(),
        }
    }

    /// A point where a label may stand.
    fn offer(&mut self, element: usize, p: DVec3, normal: Option<Vec3>) {
        let clip = self.clip_from_world * p.extend(1.0);
        let size = self.outlook.size;
        let place = DVec2::new(clip.x, -clip.y) / clip.w;
        // False, too, for what is no number.
        let inside = clip.w > 0.0 && place.abs().max_element() < 1.0;
        if !inside || self.cut.is_some_and(|cut| cut.beyond(p) > 0.0) {
            return;
        }
        let at = (place + 1.0) / 2.0 * size;
        let (x, y) = ((at.x / self.cell.x) as usize, (at.y / self.cell.y) as usize);
        let Some(cell) = self.best.get_mut(y.min(self.rows - 1) * self.columns + x.min(self.columns - 1)) else {
            return;
        };
        let to_eye = self.outlook.camera.eye() - p;
        let turned_away = normal.is_some_and(|n| n.as_dvec3().dot(to_eye) < 0.0);
        let rank = (!self.shown.contains(&element), turned_away, element);
        let place = cell.partition_point(|(other, ..)| *other < rank);
        if place < KEPT {
            cell.insert(place, (rank, at, p));
            cell.truncate(KEPT);
        }
    }

    /// Those that are seen and do not overlap, the best first.
    fn choose(self, stop: &Stop) -> Result<Vec<(usize, DVec3)>, Stopped> {
        let mut all: Vec<_> = self.best.iter().flatten().copied().collect();
        all.sort_by_key(|(rank, ..)| *rank);
        // A label overlaps others only from its own cell and those around it.
        let mut taken: Vec<Vec<DVec2>> = vec![Vec::new(); self.columns * self.rows];
        let mut chosen = Vec::new();
        let mut rays = 0;
        for ((.., element), at, p) in all {
            stop.check()?;
            let (x, y) = ((at.x / self.cell.x) as usize, (at.y / self.cell.y) as usize);
            let (x, y) = (x.min(self.columns - 1), y.min(self.rows - 1));
            let around = (y.saturating_sub(1)..=(y + 1).min(self.rows - 1))
                .flat_map(|y| (x.saturating_sub(1)..=(x + 1).min(self.columns - 1)).map(move |x| (x, y)));
            let overlaps = |other: &DVec2| {
                let apart = (*other - at).abs();
                apart.x < self.cell.x && apart.y < self.cell.y
            };
            if around.into_iter().any(|(x, y)| taken[y * self.columns + x].iter().any(overlaps)) {
                continue;
            }
            if rays == MOST_RAYS || chosen.len() == MOST {
                break;
            }
            rays += 1;
            if !self.is_hidden(at, p) {
                taken[y * self.columns + x].push(at);
                chosen.push((element, p));
            }
        }
        Ok(chosen)
    }

    fn is_hidden(&self, at: DVec2, p: DVec3) -> bool {
        let Outlook { camera, style, size } = self.outlook;
        if !style.faces {
            return false;
        }
        let ray = camera.ray(picture_point(at, *size));
        self.scene.hides(ray, self.cut, p, 2e-3 * camera.distance)
    }
}
