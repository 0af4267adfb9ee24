//! A field in colours.

use std::sync::Arc;

use vv::stop::Stop;

use super::field::{Field, Kind, NoField};
use super::scale::{self, SAMPLES};
use super::{Annotations, Quantity, Subject};
use crate::scene::{Part, Scene};

/// How the words of a [`Tint`] are read. As in `shaders/tint.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reading {
    /// Colours of vertices.
    Colors = 1,
    /// Numbers at vertices.
    Numbers = 2,
    /// Classes of vertices.
    VertexClasses = 3,
    /// Classes of faces.
    FaceClasses = 4,
}

/// What stands for a corner without number.
const NOTHING: f32 = -1e38;

/// A surface in colours: what the GPU needs beside the scene.
#[derive(Debug, Clone)]
pub struct Tint {
    /// The numbers.
    pub field: Arc<Field>,
    /// How `words` are to be read.
    pub reading: Reading,
    /// One for each corner of the scene's mesh.
    pub words: Arc<Vec<u32>>,
    /// What explains the colours.
    pub legend: Legend,
    /// What [`NOTHING`] else in `words` is: the number minus the first, over the second.
    base: [f64; 2],
}

/// What explains the colours.
#[derive(Debug, Clone, PartialEq)]
pub struct Legend {
    /// The numbers at the ends of the scale.
    pub range: [f64; 2],
    /// The least and the greatest number; `None` if there is none.
    pub extremes: Option<[f64; 2]>,
    /// How many numbers lie in equal parts of the range, from its lower end; those beyond it are in no part.
    pub histogram: Vec<u32>,
    /// How many elements have no number.
    pub without: usize,
}

impl Legend {
    /// Parts of the histogram.
    pub const BINS: usize = 48;

    fn new(field: &Field, range: Option<[f64; 2]>) -> Self {
        let range = range.filter(|[low, high]| low < high).unwrap_or_else(|| scale::automatic_range(field));
        let mut histogram = vec![0; Self::BINS];
        let mut without = 0;
        let [low, high] = range;
        for x in &field.numbers {
            let t = (x - low) / (high - low);
            if !x.is_finite() {
                without += 1;
            } else if (0.0..=1.0).contains(&t) {
                histogram[((t * Self::BINS as f64) as usize).min(Self::BINS - 1)] += 1;
            }
        }
        Self { range, extremes: scale::extremes(&field.numbers), histogram, without }
    }
}

impl Tint {
    /// The colours of a mesh; `None` for those it has itself. Linear in the mesh.
    ///
    /// # Errors
    /// As [`Field::new`].
    pub fn new(subject: &Subject<'_>, annotations: &Annotations, stop: &Stop) -> Result<Option<Self>, NoField> {
        if annotations.color_by == Quantity::Plain {
            return Ok(None);
        }
        let field = Field::new(subject, &annotations.color_by, stop)?;
        Ok(Some(Self::of(Arc::new(field), subject.scene, annotations.range)))
    }

    /// The colours of a scene whose numbers are known.
    #[must_use]
    pub fn of(field: Arc<Field>, scene: &Scene, range: Option<[f64; 2]>) -> Self {
        let part = &scene.mesh;
        let legend = Legend::new(&field, range);
        let [low, high] = legend.extremes.unwrap_or([0.0, 1.0]);
        let width = high - low;
        let base = [low, if width > 0.0 && width.is_finite() { width } else { 1.0 }];
        let (reading, words) = words(&field, part, base);
        Self { field, reading, words: Arc::new(words), legend, base }
    }

    /// Whether its colours have ends that can be chosen.
    #[must_use]
    pub fn has_range(&self) -> bool {
        matches!(self.field.kind, Kind::Sequential { .. } | Kind::Diverging)
    }

    /// The same numbers in another range.
    #[must_use]
    pub fn with_range(&self, range: Option<[f64; 2]>) -> Self {
        Self { legend: Legend::new(&self.field, range), ..self.clone() }
    }

    /// Where on the scale a word `x` lies that is a number: `(x − shift) · factor`, from 0 to 1.
    #[must_use]
    pub fn window(&self) -> [f32; 2] {
        let [low, high] = self.legend.range.map(|x| (x - self.base[0]) / self.base[1]);
        let width = if high > low { high - low } else { 1.0 };
        [low as f32, (1.0 / width) as f32]
    }

    /// The colours of the scale, sRGB.
    #[must_use]
    pub fn samples(&self) -> [[u8; 3]; SAMPLES] {
        scale::samples(&self.field.kind)
    }
}

fn words(field: &Field, part: &Part, [low, width]: [f64; 2]) -> (Reading, Vec<u32>) {
    let of_owner = |word: &dyn Fn(usize) -> u32| part.owners.iter().map(|v| word(v.index())).collect();
    if field.kind == Kind::Colors {
        return (Reading::Colors, of_owner(&|i| field.colors.get(i).copied().unwrap_or(0)));
    }
    let is_class = matches!(field.kind, Kind::Classes(_));
    let word = |i: usize| {
        let number = field.numbers.get(i).copied().filter(|x| x.is_finite());
        let number = number.map_or(NOTHING, |x| if is_class { x as f32 } else { ((x - low) / width) as f32 });
        number.to_bits()
    };
    if field.at_faces {
        let mut words = vec![NOTHING.to_bits(); part.corners.len()];
        for (&[first, ..], &face) in part.triangles.iter().zip(&part.triangle_faces) {
            if let Some(w) = words.get_mut(first as usize) {
                *w = word(face as usize);
            }
        }
        return (Reading::FaceClasses, words);
    }
    (if is_class { Reading::VertexClasses } else { Reading::Numbers }, of_owner(&word))
}
