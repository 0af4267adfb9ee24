//! What a surface can be coloured by.

use std::convert::Infallible;
use std::fmt;
use std::str::FromStr;

/// Something that has a number, or a colour, at each vertex or face. As text: one of the names of [`Quantity::NAMED`],
/// `change:3` for the change since generation 3, the name of a vertex property, or that with `:color` behind it for a `vec` that is a colour itself; `property:` in front
/// of a property that is called like something else.
#[derive(Debug, Clone, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(from = "String", into = "String")]
pub enum Quantity {
    /// Nothing: one colour, or that of the vertices.
    #[default]
    Plain,
    /// Neighbours of each vertex.
    Valence,
    /// Corners of each face.
    Degree,
    /// Gaussian curvature.
    Gauss,
    /// Mean curvature.
    Mean,
    /// The generation that made the vertex.
    Birth,
    /// What has become of the vertex in the last step.
    Change,
    /// The same since a generation.
    Since(u64),
    /// The coordinate along an axis, 0 to 2.
    Coordinate(u8),
    /// A vertex property; the length of a `vec`.
    Property(String),
    /// A vertex property of type `vec` as red, green and blue from 0 to 1.
    Color(String),
}

const SINCE: &str = "change:";
const COLOR: &str = ":color";
const PROPERTY: &str = "property:";

impl Quantity {
    /// Those that every mesh has, by what they are called in commands and files.
    pub const NAMED: [(&'static str, Self); 10] = [
        ("none", Self::Plain),
        ("valence", Self::Valence),
        ("degree", Self::Degree),
        ("gauss", Self::Gauss),
        ("mean", Self::Mean),
        ("birth", Self::Birth),
        ("change", Self::Change),
        ("x", Self::Coordinate(0)),
        ("y", Self::Coordinate(1)),
        ("z", Self::Coordinate(2)),
    ];

    /// What it is called in the window.
    #[must_use]
    pub fn title(&self) -> String {
        match self {
            Self::Plain => "nothing".to_owned(),
            Self::Valence => "valence".to_owned(),
            Self::Degree => "corners of faces".to_owned(),
            Self::Gauss => "Gaussian curvature".to_owned(),
            Self::Mean => "mean curvature".to_owned(),
            Self::Birth => "generation of birth".to_owned(),
            Self::Change => "change in the last step".to_owned(),
            Self::Since(generation) => format!("change since gen. {generation}"),
            Self::Coordinate(axis) => format!("coordinate {}", ["x", "y", "z"][usize::from(*axis).min(2)]),
            Self::Property(name) => name.clone(),
            Self::Color(name) => format!("{name} as colour"),
        }
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Since(generation) => write!(f, "{SINCE}{generation}"),
            Self::Color(name) => write!(f, "{name}{COLOR}"),
            Self::Property(name) => {
                // Else it would be read as something else.
                let front = if matches!(name.parse(), Ok(Self::Property(_))) { "" } else { PROPERTY };
                write!(f, "{front}{name}")
            }
            other => f.write_str(Self::NAMED.iter().find(|(_, q)| q == other).map_or("none", |(name, _)| name)),
        }
    }
}

impl FromStr for Quantity {
    type Err = Infallible;

    fn from_str(text: &str) -> Result<Self, Infallible> {
        if let Some((_, quantity)) = Self::NAMED.iter().find(|(name, _)| *name == text) {
            return Ok(quantity.clone());
        }
        if let Some(generation) = text.strip_prefix(SINCE).and_then(|number| number.parse().ok()) {
            return Ok(Self::Since(generation));
        }
        if let Some(name) = text.strip_prefix(PROPERTY) {
            return Ok(Self::Property(name.to_owned()));
        }
        Ok(match text.strip_suffix(COLOR) {
            Some(name) => Self::Color(name.to_owned()),
            None => Self::Property(text.to_owned()),
        })
    }
}

impl From<String> for Quantity {
    fn from(text: String) -> Self {
        match text.parse() {
            Ok(quantity) => quantity,
            Err(never) => match never {},
        }
    }
}

impl From<Quantity> for String {
    fn from(quantity: Quantity) -> Self {
        quantity.to_string()
    }
}
