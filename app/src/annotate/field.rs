//! Numbers at the vertices or faces of a mesh.

use vv::mesh::{Values, Vertex};
use vv::stop::{Stop, Stopped};

use super::curvature::{Curvature, curvature};
use super::scale::CLASS_COLORS;
use super::{Quantity, Subject};

/// Numbers at the vertices or faces of a mesh, one for each.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// What is measured.
    pub quantity: Quantity,
    /// Whether there is one for each face; else for each vertex.
    pub at_faces: bool,
    /// The numbers: of a class its place in the list. Not a number where there is none. Empty for colours.
    pub numbers: Vec<f64>,
    /// Colours as [`crate::scene::pack_color`] packs them, for what is a colour itself.
    pub colors: Vec<u32>,
    /// What the numbers mean.
    pub kind: Kind,
    /// What there is to say beside them.
    pub note: Option<String>,
}

/// What numbers mean, and so which colours they get.
#[derive(Debug, Clone, PartialEq)]
pub enum Kind {
    /// From small to large.
    Sequential {
        /// Whether all of them are whole.
        whole: bool,
    },
    /// Around zero.
    Diverging,
    /// One of a few.
    Classes(Vec<Class>),
    /// They are colours.
    Colors,
}

/// One of a few that a number can be.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Class {
    /// What it is called.
    pub name: String,
    /// sRGB.
    pub color: [u8; 3],
    /// How many vertices or faces.
    pub count: usize,
}

/// Why there are no numbers: a sentence, or because nobody waits for them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NoField {
    /// The mesh lacks something.
    Missing(String),
    /// Nobody waits for it.
    Stopped(Stopped),
}

impl From<Stopped> for NoField {
    fn from(stopped: Stopped) -> Self {
        Self::Stopped(stopped)
    }
}

impl Field {
    /// Finds the numbers. Linear in the mesh.
    ///
    /// # Errors
    /// When the mesh lacks what is asked for, or when stopped.
    pub fn new(subject: &Subject<'_>, quantity: &Quantity, stop: &Stop) -> Result<Self, NoField> {
        let mesh = subject.mesh;
        stop.check()?;
        let plain = Self {
            quantity: quantity.clone(),
            at_faces: false,
            numbers: Vec::new(),
            colors: Vec::new(),
            kind: Kind::Sequential { whole: false },
            note: None,
        };
        Ok(match quantity {
            Quantity::Plain => plain,
            Quantity::Valence => {
                let valences = mesh.vertices().map(|v| mesh.ring(v).valence()).collect();
                plain.around(valences, regular_valence(subject))
            }
            Quantity::Degree => {
                let degrees = subject.faces.iter().map(<[Vertex]>::len).collect();
                Self { at_faces: true, ..plain }.around(degrees, usual_degree(subject))
            }
            Quantity::Gauss => {
                Self { numbers: curvature(subject, Curvature::Gauss, stop)?, kind: Kind::Diverging, ..plain }
            }
            Quantity::Mean => {
                Self { numbers: curvature(subject, Curvature::Mean, stop)?, kind: Kind::Diverging, ..plain }
            }
            Quantity::Birth => plain.births(subject),
            Quantity::Change => plain.changes(subject, None)?,
            Quantity::Since(generation) => plain.changes(subject, Some(*generation))?,
            Quantity::Coordinate(axis) => {
                let axis = usize::from(*axis).min(2);
                Self { numbers: mesh.positions().iter().map(|p| p[axis]).collect(), ..plain }
            }
            Quantity::Property(name) => plain.property(subject, name)?,
            Quantity::Color(name) => match &column(subject, name)? {
                Values::Vec(colors) => {
                    let colors = colors.iter().map(|&c| crate::scene::pack_color(c)).collect();
                    Self { colors, kind: Kind::Colors, ..plain }
                }
                _ => return Err(NoField::Missing(format!("property `{name}` is no vec, which could be a colour"))),
            },
        })
    }

    /// The number of an element, for people; `None` where there is none.
    #[must_use]
    pub fn text(&self, index: usize) -> Option<String> {
        let number = self.numbers.get(index).copied().filter(|x| x.is_finite())?;
        Some(match &self.kind {
            Kind::Classes(classes) => classes.get(number as usize)?.name.clone(),
            Kind::Sequential { whole: true } => format!("{number:.0}"),
            _ => super::scale::short(number),
        })
    }

    /// Counts around the one that is regular.
    fn around(mut self, counts: Vec<usize>, regular: usize) -> Self {
        const REACH: usize = CLASS_COLORS.len() / 2;
        let lowest = regular.saturating_sub(REACH);
        let class = |n: usize| (n + REACH).saturating_sub(regular).min(2 * REACH);
        let mut classes: Vec<Class> = (0..CLASS_COLORS.len())
            .map(|i| {
                let n = (regular + i).saturating_sub(REACH);
                let name = match i {
                    0 if lowest > 0 => format!("≤ {n}"),
                    i if i == 2 * REACH => format!("≥ {n}"),
                    _ => n.to_string(),
                };
                Class { name, color: CLASS_COLORS[i], count: 0 }
            })
            .collect();
        self.numbers = counts.iter().map(|&n| class(n) as f64).collect();
        for &n in &counts {
            classes[class(n)].count += 1;
        }
        // Ends that hold one number only are called by it.
        let (least, most) = (counts.iter().min().copied(), counts.iter().max().copied());
        if least == Some(lowest) {
            classes[0].name = lowest.to_string();
        }
        if most == Some(regular + REACH) {
            classes[2 * REACH].name = (regular + REACH).to_string();
        }
        self.kind = Kind::Classes(classes);
        self
    }

    fn births(self, subject: &Subject<'_>) -> Self {
        let birth = |v| subject.lineage.birth(v, subject.generation) as f64;
        let numbers = subject.mesh.vertices().map(birth).collect();
        Self { numbers, kind: Kind::Sequential { whole: true }, ..self }
    }

    /// What has become of each vertex since a generation; since the one before, if none is given.
    fn changes(self, subject: &Subject<'_>, since: Option<u64>) -> Result<Self, NoField> {
        let missing = |text: String| NoField::Missing(text);
        let generation = subject.generation;
        let kept;
        let (from, before) = match since {
            None if generation == 0 => return Err(missing("generation 0 has none before it".to_owned())),
            None => match subject.before {
                Some(before) => (generation - 1, before),
                None => return Err(missing("the generation before is no longer kept".to_owned())),
            },
            Some(from) if from == generation => {
                return Err(missing("this is the generation that others are compared with".to_owned()));
            }
            Some(from) if from > generation => {
                return Err(missing(format!("generation {from} comes after this one")));
            }
            Some(from) => match subject.lineage.mesh(from) {
                Some(mesh) => {
                    kept = mesh;
                    (from, &kept)
                }
                None => return Err(missing(format!("generation {from} is not kept"))),
            },
        };
        const NAMES: [(&str, [u8; 3]); 3] =
            [("stayed", CLASS_COLORS[3]), ("moved", CLASS_COLORS[4]), ("born", CLASS_COLORS[1])];
        let mut classes = NAMES.map(|(name, color)| Class { name: name.to_owned(), color, count: 0 });
        let class = |v: Vertex| match subject.lineage.carry(v, generation, from) {
            None => 2,
            Some(old) => usize::from(before.position(old) != subject.mesh.position(v)),
        };
        let numbers = subject.mesh.vertices().map(|v| {
            let class = class(v);
            classes[class].count += 1;
            class as f64
        });
        let numbers = numbers.collect();
        let lived = classes[0].count + classes[1].count;
        let note = Some(match before.vertex_count() - lived {
            0 => "none died".to_owned(),
            n => format!("{n} died"),
        });
        Ok(Self { numbers, kind: Kind::Classes(classes.into()), note, ..self })
    }

    fn property(self, subject: &Subject<'_>, name: &str) -> Result<Self, NoField> {
        Ok(match column(subject, name)? {
            Values::Bool(values) => {
                let count = values.iter().filter(|&&b| b).count();
                let class = |name: &str, color, count| Class { name: name.to_owned(), color, count };
                let classes =
                    vec![class("false", CLASS_COLORS[3], values.len() - count), class("true", CLASS_COLORS[5], count)];
                let numbers = values.iter().map(|&b| f64::from(u8::from(b))).collect();
                Self { numbers, kind: Kind::Classes(classes), ..self }
            }
            Values::Int(values) => {
                let numbers = values.iter().map(|&n| n as f64).collect();
                Self { numbers, kind: Kind::Sequential { whole: true }, ..self }
            }
            Values::Double(values) => Self { numbers: values.to_vec(), ..self },
            Values::Vec(values) => {
                Self { numbers: values.iter().map(|v| v.length()).collect(), note: Some("length".to_owned()), ..self }
            }
            Values::Vertex(_) => {
                return Err(NoField::Missing(format!("property `{name}` names vertices, which have no colours")));
            }
        })
    }
}

fn column<'a>(subject: &Subject<'a>, name: &str) -> Result<&'a Values, NoField> {
    let properties = subject.mesh.vertex_properties();
    if let Some(property) = properties.iter().find(|property| property.name == name) {
        return Ok(&property.values);
    }
    if name.starts_with("change:") {
        return Err(NoField::Missing("after the colon stands the number of a generation, as in `change:2`".to_owned()));
    }
    let names: Vec<_> = properties.iter().map(|property| format!("`{}`", property.name)).collect();
    Err(NoField::Missing(match names.len() {
        0 => format!("no vertex property `{name}` here, nor any other"),
        _ => format!("no vertex property `{name}` here, only {}", names.join(", ")),
    }))
}

/// The degree that most faces have; 3 without faces.
fn usual_degree(subject: &Subject<'_>) -> usize {
    let mut counts = [0usize; 32];
    for face in subject.faces.iter() {
        counts[face.len().min(31)] += 1;
    }
    let most = counts.iter().max().copied().unwrap_or(0);
    if most == 0 { 3 } else { counts.iter().position(|&n| n == most).unwrap_or(3).max(3) }
}

/// How many of them meet at a vertex where all are alike in the plane: 1/d + 1/v = 1/2.
fn regular_valence(subject: &Subject<'_>) -> usize {
    let d = usual_degree(subject);
    (2 * d).div_ceil(d - 2).max(3)
}
