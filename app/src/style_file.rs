//! How pictures look, as a file: what the window saves and `--style` of the command line draws.
//!
//! JSON, with the words of [`crate::project`]. What a file does not say is as by default; what it says and vv does not
//! know is a mistake, told at its place.

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::Value;
use serde_json::value::RawValue;
use vv::io::Place;

use crate::annotate::Annotations;
use crate::figure::{self, paper};
use crate::files::{self, FileError};
use crate::scene::Style;

/// What the names of these files end in, where nobody says.
pub const EXTENSION: &str = "json";

/// How pictures look.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct StyleFile {
    /// How a mesh is drawn.
    pub style: Style,
    /// What is shown on it.
    pub annotations: Annotations,
    /// The colour behind pictures, as `--background` takes it.
    pub background: Option<String>,
    /// The size of figures, as `--page` takes it.
    pub page: Option<String>,
    /// Height of letters in figures, in points.
    pub font_size: Option<f64>,
    /// How much lighter lines of figures are that lie farthest away, as `--fade` takes it.
    pub fade: Option<f64>,
    /// How lines of figures look, as `--line` takes it, by their classes.
    pub lines: BTreeMap<String, String>,
}

/// What is wrong with a text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mistake {
    /// In one sentence.
    pub message: String,
    /// What there is instead.
    pub evidence: Option<String>,
    /// Where.
    pub place: Option<Place>,
}

/// A text of a style file that is none of its kind.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Misfit {
    /// The names that lead to it, for [`place_of`].
    pub names: Vec<String>,
    /// What is wrong, in one sentence.
    pub message: String,
}

impl StyleFile {
    /// Reads a file, and returns its text too, for [`place_of`].
    ///
    /// # Errors
    /// What the file system says, or a [`Mistake`] in the file.
    pub fn read(path: &Path) -> Result<(Self, String), FileError> {
        let text = files::read_program(path)?;
        match Self::parse(&text) {
            Ok(style) => Ok((style, text)),
            Err(Mistake { message, evidence, place }) => Err(FileError::at(path, place, message, evidence)),
        }
    }

    /// Reads a text.
    ///
    /// # Errors
    /// If it is no JSON, names something that there is not, or gives it a value that it cannot have.
    pub fn parse(text: &str) -> Result<Self, Mistake> {
        let style: Self = serde_json::from_str(text).map_err(|error| {
            let column = u32::try_from(error.column()).ok().filter(|column| *column > 0);
            let place = Place::Text { line: error.line() as u32, column };
            let problem = error.to_string();
            let is_json = serde_json::from_str::<&RawValue>(text).is_ok();
            let (message, evidence) = worded(problem.split(" at line ").next().unwrap_or_default(), is_json);
            Mistake { message, evidence, place: Some(place).filter(|_| error.line() > 0) }
        })?;
        let all = serde_json::to_value(Self::default()).unwrap_or_default();
        only_known(text, text, &all)?;
        style.in_bounds().map_err(|(names, wanted)| Mistake {
            message: format!("{wanted} is wanted here"),
            evidence: None,
            place: place_of(text, names),
        })?;
        Ok(style)
    }

    /// Whether numbers are what pictures can be drawn with; else the names that lead to the first that is not, and what it
    /// should be.
    fn in_bounds(&self) -> Result<(), (&'static [&'static str], &'static str)> {
        let Self { style, annotations, .. } = self;
        let points = |x: f32| (0.0..=100.0).contains(&x);
        let checks: [(bool, &[&str], &str); 5] = [
            (points(style.edge_width), &["style", "edge_width"], "a width from 0 to 100 points"),
            (points(style.vertex_size), &["style", "vertex_size"], "a diameter from 0 to 100 points"),
            ((-1.0..=1.0).contains(&style.cut.position), &["style", "cut", "position"], "a place from -1 to 1"),
            (
                annotations.range.is_none_or(|[low, high]| low < high),
                &["annotations", "range"],
                "a list of two numbers, the smaller one first,",
            ),
            (
                (0.0..=1000.0).contains(&annotations.arrow_length),
                &["annotations", "arrow_length"],
                "a length from 0 to 1000 edges",
            ),
        ];
        checks.into_iter().find(|(is_right, ..)| !is_right).map_or(Ok(()), |(_, names, wanted)| Err((names, wanted)))
    }

    /// What it says of figures.
    ///
    /// # Errors
    /// The first text that is none of its kind.
    pub fn figures(&self) -> Result<figure::Settings, Misfit> {
        let mut figures = figure::Settings::default();
        let at = |names: &[&str]| {
            let names = names.iter().map(|&name| name.to_owned()).collect();
            |message| Misfit { names, message }
        };
        if let Some(page) = &self.page {
            figures.page = paper::page(page).map_err(at(&["page"]))?;
        }
        if let Some(points) = self.font_size {
            figures.letters = paper::letters(&points.to_string()).map_err(at(&["font_size"]))?;
        }
        if let Some(amount) = self.fade {
            figures.fade = paper::fade(&amount.to_string()).map_err(at(&["fade"]))?;
        }
        for (class, line) in &self.lines {
            let (class, line) = paper::line(&format!("{class}={line}")).map_err(at(&["lines", class]))?;
            figures.lines[class as usize] = line;
        }
        Ok(figures)
    }

    /// The colour that it says lies behind pictures.
    ///
    /// # Errors
    /// If it is none.
    pub fn backdrop(&self) -> Result<Option<[u8; 3]>, Misfit> {
        let misfit = |message| Misfit { names: vec!["background".to_owned()], message };
        self.background.as_deref().map(paper::background).transpose().map_err(misfit)
    }

    /// Writes it.
    ///
    /// # Errors
    /// What the file system says.
    pub fn write(&self, path: &Path) -> Result<(), FileError> {
        let mut text =
            serde_json::to_vec_pretty(self).map_err(|error| FileError::at(path, None, error.to_string(), None))?;
        text.push(b'\n');
        files::write(path, &text)
    }
}

/// Where in a text that was read the value stands that these names lead to, one in the other.
#[must_use]
pub fn place_of(text: &str, names: &[&str]) -> Option<Place> {
    let mut part = text;
    for name in names {
        part = members(part)?.get(*name)?.get();
    }
    Some(place(text, part.as_ptr() as usize - text.as_ptr() as usize))
}

/// Whether every name in an object of `text` stands in `all`, and so in the objects in it. Those with names of their own
/// choice are empty in `all`.
fn only_known(text: &str, part: &str, all: &Value) -> Result<(), Mistake> {
    let Some(known) = all.as_object().filter(|known| !known.is_empty()) else { return Ok(()) };
    let Some(found) = members(part) else {
        let at = part.trim_start().as_ptr() as usize - text.as_ptr() as usize;
        let message = format!("{OBJECT} is wanted here, and there is a list");
        return Err(Mistake { message, evidence: None, place: Some(place(text, at)) });
    };
    for (name, value) in found {
        let value = value.get();
        match known.get(&name) {
            Some(all) => only_known(text, value, all)?,
            None => {
                let at = value.as_ptr() as usize - text.as_ptr() as usize;
                let at = text[..at].rfind(&format!("\"{name}\"")).unwrap_or(at);
                let names: Vec<_> = known.keys().map(|name| format!("`{name}`")).collect();
                let (message, evidence) = (format!("nothing is called `{name}` here"), names.join(", "));
                let evidence = Some(format!("there are {evidence}"));
                return Err(Mistake { message, evidence, place: Some(place(text, at)) });
            }
        }
    }
    Ok(())
}

const OBJECT: &str = "an object in braces";

/// What serde finds wrong, in words for people; and what there is instead.
fn worded(problem: &str, is_json: bool) -> (String, Option<String>) {
    let wanted = |found: &str, wanted: &str| format!("{} is wanted here, and there is {}", thing(wanted), thing(found));
    let parts = |start: &str| problem.strip_prefix(start)?.split_once(", expected ");
    if let Some((found, what)) = parts("invalid type: ").or_else(|| parts("invalid value: ")) {
        (wanted(found, what), None)
    } else if let Some((_, what)) = parts("invalid length ") {
        (format!("{} is wanted here", thing(what)), None)
    } else if let Some((name, names)) = parts("unknown variant ") {
        let names = names.strip_prefix("one of ").unwrap_or(names);
        (format!("nothing is called {name} here"), Some(format!("there are {names}")))
    } else if let Some(name) = problem.strip_prefix("duplicate field ") {
        (format!("{name} stands here twice"), None)
    } else if problem == "number out of range" {
        ("this number is too large".to_owned(), None)
    } else if is_json {
        // Of a choice of words serde says no more than that it expects a value.
        (format!("{} is wanted here", thing("a string")), None)
    } else if problem.starts_with("EOF") {
        ("the text ends before its last bracket".to_owned(), None)
    } else {
        ("this is no JSON".to_owned(), Some(problem.to_owned()))
    }
}

/// What serde calls a kind of value, or a value.
fn thing(name: &str) -> String {
    match name {
        "a map" | "map" => OBJECT.to_owned(),
        "sequence" | "a sequence" => "a list".to_owned(),
        "a boolean" => "true or false".to_owned(),
        "f32" | "f64" => "a number".to_owned(),
        "a string" | "string or map" => "a text in quotes".to_owned(),
        "an array of length 2" => "a list of two numbers".to_owned(),
        "null" => "`null`".to_owned(),
        _ if name.starts_with("struct ") => OBJECT.to_owned(),
        _ => match name.split_once(['`', '"']) {
            Some((kind, value)) if kind != "string " => format!("`{}`", value.trim_end_matches('`')),
            Some((_, value)) => format!("the text `{}`", value.trim_end_matches('"')),
            None => name.to_owned(),
        },
    }
}

fn members(object: &str) -> Option<BTreeMap<String, &RawValue>> {
    serde_json::from_str(object).ok()
}

fn place(text: &str, at: usize) -> Place {
    let before = &text[..at];
    let line = before.matches('\n').count() as u32 + 1;
    let column = before.rsplit('\n').next().unwrap_or_default().chars().count() as u32 + 1;
    Place::Text { line, column: Some(column) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::annotate::Quantity;
    use crate::scene::Theme;

    #[track_caller]
    fn fails(text: &str, line: u32, column: impl Into<Option<u32>>, message: &str) -> String {
        let mistake = StyleFile::parse(text).unwrap_err();
        assert_eq!(mistake.place, Some(Place::Text { line, column: column.into() }), "{mistake:?}");
        assert!(mistake.message.starts_with(message), "{mistake:?}");
        mistake.evidence.unwrap_or_default()
    }

    #[test]
    fn what_is_written_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("look.json");
        let mut look = StyleFile { background: Some("#fff".to_owned()), ..StyleFile::default() };
        (look.style.smooth, look.style.theme) = (true, Theme::Dark);
        look.annotations.color_by = Quantity::Property("heat".to_owned());
        look.lines.insert("inner".to_owned(), "none".to_owned());
        look.write(&path).unwrap();
        assert_eq!(StyleFile::read(&path).unwrap().0, look);
    }

    #[test]
    fn what_a_file_does_not_say_is_as_by_default() {
        assert_eq!(StyleFile::parse("{}").unwrap(), StyleFile::default());
        let look = StyleFile::parse("{\"style\": {\"edges\": false}}").unwrap();
        assert!(!look.style.edges && look.style.faces);
    }

    #[test]
    fn what_it_says_wrongly_is_told_at_its_place() {
        fails("{\n  \"style\": 1\n}", 2, 12, "an object in braces is wanted here, and there is `1`");
        fails("{\"style\": {\"edges\": 1}}", 1, 21, "true or false is wanted here, and there is `1`");
        fails("{\"style\": {\"edge_width\": \"a\"}}", 1, 28, "a number is wanted here, and there is the text `a`");
        fails("{\"background\": [1]}", 1, 15, "a text in quotes is wanted here, and there is a list");
        fails("{\"annotations\": {\"range\": [1]}}", 1, 29, "a list of two numbers is wanted here");
        let there = fails("{\"style\": {\"theme\": \"red\"}}", 1, 25, "nothing is called `red` here");
        assert_eq!(there, "there are `Light` or `Dark`");
        fails("{\"style\": {}, \"style\": {}}", 1, 21, "`style` stands here twice");
        fails("{\"style\": {", 1, 11, "the text ends before its last bracket");
        assert_eq!(fails("{'style': 1}", 1, 2, "this is no JSON"), "key must be a string");
        fails("{\"style\": {\"vertex_size\": 1e99}}", 1, 30, "this number is too large");
        fails("{\"annotations\": {\"labels\": 3}}", 1, 28, "a text in quotes is wanted here");
        fails("", 1, None, "the text ends before its last bracket");
        fails("[]", 1, 1, "an object in braces is wanted here, and there is a list");
        fails("{\"style\": {\"cut\": [true]}}", 1, 19, "an object in braces is wanted here, and there is a list");
        fails("{\"style\": {\"edge_width\": -1}}", 1, 26, "a width from 0 to 100 points is wanted here");
        fails("{\"style\": {\"vertex_size\": 101}}", 1, 27, "a diameter from 0 to 100 points is wanted here");
        fails("{\"style\": {\"cut\": {\"position\": 2}}}", 1, 32, "a place from -1 to 1 is wanted here");
        fails(
            "{\"annotations\": {\"range\": [2, 1]}}",
            1,
            27,
            "a list of two numbers, the smaller one first, is wanted",
        );
        fails("{\"annotations\": {\"arrow_length\": -1}}", 1, 34, "a length from 0 to 1000 edges is wanted here");
        let there = fails("{\n  \"style\": {\n    \"egdes\": true }}", 3, 5, "nothing is called `egdes` here");
        assert!(there.contains("`edges`") && there.contains("`cut`"), "{there}");
        fails("{\"style\": {\"cut\": {\"off\": 1}}}", 1, 20, "nothing is called `off` here");
        fails("{\"styles\": {}}", 1, 2, "nothing is called `styles` here");
    }

    #[test]
    fn a_value_is_found_by_the_names_that_lead_to_it() {
        let text = "{\n \"page\": \"1mm\", \"lines\": {\"inner\": \"x\"}}";
        let at = |column| Some(Place::Text { line: 2, column: Some(column) });
        assert_eq!(place_of(text, &["page"]), at(10));
        assert_eq!(place_of(text, &["lines", "inner"]), at(36));
        assert_eq!(place_of(text, &["lines", "outer"]), None);
    }
}
