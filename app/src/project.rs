//! A document as a file: program, mesh, rule, parameters, generation and view.
//!
//! JSON, so that it can be read and compared. The text of the program is in it, so that it opens also where the program's
//! own file is gone; paths below the project's folder are relative, so that a folder can be moved as a whole.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec3;
use serde::{Deserialize, Serialize};
use vv::mesh::Value;

use crate::annotate::Annotations;
use crate::camera::Camera;
use crate::document::{Document, MeshSource, NOWHERE, ProgramText};
use crate::files;
use crate::scene::Style;
use crate::worker::{Recipe, Request};

/// What the names of projects end in.
pub const EXTENSION: &str = "vvp";

/// The form in which projects are written.
const VERSION: u32 = 1;

/// A document without what belongs to one sitting.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Project {
    version: u32,
    /// What the program is called.
    pub name: String,
    /// The program's file.
    #[serde(default)]
    path: Option<PathBuf>,
    text: String,
    mesh: MeshSource,
    #[serde(default)]
    rule: Option<String>,
    #[serde(default)]
    params: BTreeMap<String, Setting>,
    #[serde(default)]
    param_sets: BTreeMap<String, BTreeMap<String, Setting>>,
    #[serde(default)]
    views: BTreeMap<String, Camera>,
    #[serde(default)]
    generation: u64,
    #[serde(default)]
    style: Style,
    #[serde(default)]
    annotations: Annotations,
    camera: Camera,
}

/// The value of a parameter.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Setting {
    Bool(bool),
    Int(i64),
    Double(f64),
    Vec([f64; 3]),
}

impl Project {
    /// Of a document.
    #[must_use]
    pub fn of(document: &Document) -> Self {
        Self {
            version: VERSION,
            name: document.program.name.clone(),
            path: document.program.path.clone(),
            text: document.program.text.to_string(),
            mesh: document.mesh.clone(),
            rule: document.rule.clone(),
            params: settings(&document.params),
            param_sets: document.param_sets.iter().map(|(name, set)| (name.clone(), settings(set))).collect(),
            views: document.views.clone(),
            generation: document.generation,
            style: document.style,
            annotations: document.annotations.clone(),
            camera: document.camera,
        }
    }

    /// The document. Its text is unsaved where the program's file says something else, or is gone.
    #[must_use]
    pub fn into_document(self) -> Document {
        let saved = self.path.as_deref().and_then(|path| files::read_program(path).ok());
        let program = match (self.path, saved) {
            (Some(path), Some(saved)) => ProgramText { text: self.text.into(), ..ProgramText::of_file(&path, saved) },
            _ => {
                let shipped = crate::library::program(&self.name).is_some_and(|p| p.text == self.text);
                let program = ProgramText::new(self.name, self.text);
                // What has no file is in no file.
                if shipped { program } else { ProgramText { saved: "".into(), ..program } }
            }
        };
        Document {
            program,
            mesh: self.mesh,
            rule: self.rule,
            params: values(self.params),
            param_sets: self.param_sets.into_iter().map(|(name, set)| (name, values(set))).collect(),
            views: self.views,
            generation: self.generation,
            style: self.style,
            annotations: self.annotations,
            camera: self.camera,
        }
    }

    /// As a file in a folder.
    ///
    /// # Errors
    /// If it holds a number that JSON has no word for.
    pub fn to_json(&self, folder: Option<&Path>) -> Result<Vec<u8>, String> {
        let mut project = self.clone();
        project.each_path(|path| match folder.and_then(|folder| path.strip_prefix(folder).ok()) {
            Some(below) if below != Path::new("") => below.to_owned(),
            _ => path.to_owned(),
        });
        serde_json::to_vec_pretty(&project).map_err(|error| error.to_string())
    }

    /// From a file in a folder.
    ///
    /// # Errors
    /// Says what is wrong with it.
    pub fn from_json(bytes: &[u8], folder: Option<&Path>) -> Result<Self, String> {
        /// What every version has; a later one may say the rest in ways that have no meaning here.
        #[derive(Deserialize)]
        struct Form {
            version: u32,
        }
        let wrong = |error| format!("is no project of vv: {error}");
        let form: Form = serde_json::from_slice(bytes).map_err(wrong)?;
        if form.version > VERSION {
            return Err("was made by a later version of vv".to_owned());
        }
        let mut project: Self = serde_json::from_slice(bytes).map_err(wrong)?;
        if !project.views.values().chain([&project.camera]).all(Camera::is_finite) {
            return Err("is no project of vv: its view is nowhere".to_owned());
        }
        project.each_path(|path| folder.map_or_else(|| path.to_owned(), |folder| folder.join(path)));
        Ok(project)
    }

    fn each_path(&mut self, change: impl Fn(&Path) -> PathBuf) {
        if let Some(path) = &mut self.path {
            *path = change(path);
        }
        change_paths(&mut self.mesh, &change);
    }
}

/// In the whole row of programs that a mesh came from.
fn change_paths(mesh: &mut MeshSource, change: &impl Fn(&Path) -> PathBuf) {
    match mesh {
        MeshSource::File(path) => *path = change(path),
        MeshSource::Result(request) => {
            let recipe = Arc::make_mut(&mut Arc::make_mut(request).recipe);
            if !recipe.path.starts_with(NOWHERE) {
                recipe.path = change(&recipe.path);
            }
            change_paths(&mut recipe.mesh, change);
        }
        MeshSource::Empty | MeshSource::BuiltIn(_) => {}
    }
}

/// A generation of a program that a mesh came from.
pub(crate) mod result {
    use super::{Arc, BTreeMap, MeshSource, PathBuf, Recipe, Request, Setting, settings, values};
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    #[derive(Serialize, Deserialize)]
    struct Made {
        path: PathBuf,
        text: String,
        mesh: MeshSource,
        #[serde(default)]
        rule: Option<String>,
        #[serde(default)]
        params: BTreeMap<String, Setting>,
        generation: u64,
    }

    pub fn serialize<S: Serializer>(request: &Arc<Request>, serializer: S) -> Result<S::Ok, S::Error> {
        let recipe = &request.recipe;
        let made = Made {
            path: recipe.path.clone(),
            text: recipe.text.to_string(),
            mesh: recipe.mesh.clone(),
            rule: recipe.rule.clone(),
            params: settings(&recipe.params),
            generation: request.generation,
        };
        made.serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Arc<Request>, D::Error> {
        let made = Made::deserialize(deserializer)?;
        let recipe = Recipe {
            path: made.path,
            text: made.text.into(),
            includes_revision: 0,
            mesh: made.mesh,
            mesh_revision: 0,
            rule: made.rule,
            params: values(made.params),
        };
        Ok(Arc::new(Request { recipe: Arc::new(recipe), generation: made.generation }))
    }
}

fn settings(values: &BTreeMap<String, Value>) -> BTreeMap<String, Setting> {
    let setting = |(name, value): (&String, &Value)| {
        let setting = match value {
            Value::Bool(b) => Setting::Bool(*b),
            Value::Int(i) => Setting::Int(*i),
            Value::Double(x) => Setting::Double(*x),
            Value::Vec(v) => Setting::Vec(v.to_array()),
            Value::Vertex(_) => return None, // no parameter is one
        };
        Some((name.clone(), setting))
    };
    values.iter().filter_map(setting).collect()
}

fn values(settings: BTreeMap<String, Setting>) -> BTreeMap<String, Value> {
    let value = |(name, setting)| {
        let value = match setting {
            Setting::Bool(b) => Value::Bool(b),
            Setting::Int(i) => Value::Int(i),
            Setting::Double(x) => Value::Double(x),
            Setting::Vec(v) => Value::Vec(DVec3::from(v)),
        };
        (name, value)
    };
    settings.into_iter().map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::annotate::{Label, Quantity};
    use crate::scene::Sphere;

    fn document() -> Document {
        let values = [
            ("b", Value::Bool(true)),
            ("i", Value::Int(-3)),
            ("x", Value::Double(2.0)),
            ("v", Value::Vec(DVec3::new(1.0, 2.5, -1e-9))),
        ];
        let params: BTreeMap<String, Value> =
            values.into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
        Document {
            program: ProgramText::new("untitled.vv", "void f(mesh& S) { }"),
            mesh: MeshSource::BuiltIn("cube.obj".to_owned()),
            rule: Some("f".to_owned()),
            param_sets: [("wide".to_owned(), params.clone())].into(),
            params,
            views: [("side".to_owned(), Camera::standard(Sphere { center: DVec3::X, radius: 1.0 }, 1.0))].into(),
            generation: 4,
            style: Style { smooth: true, ..Style::default() },
            annotations: Annotations {
                color_by: Quantity::Color("degree".to_owned()),
                range: Some([-0.5, 2.0]),
                labels: Label::Property("a b".to_owned()),
                ..Annotations::default()
            },
            camera: Camera::standard(Sphere { center: DVec3::ONE, radius: 2.0 }, 1.5),
        }
    }

    #[test]
    fn a_document_comes_back_as_it_was() {
        let mut document = document();
        let bytes = Project::of(&document).to_json(None).unwrap();
        let back = Project::from_json(&bytes, None).unwrap().into_document();
        assert!(back.program.is_modified(), "it is in no file of its own");
        document.program.saved = "".into();
        assert_eq!(back, document);
    }

    #[test]
    fn a_folder_is_moved_as_a_whole() {
        let (old, new) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        std::fs::write(new.path().join("p.vv"), "// other").unwrap();
        let mut document = document();
        document.program = ProgramText::of_file(&old.path().join("p.vv"), "// mine");
        document.mesh = MeshSource::File(old.path().join("m.obj"));
        let bytes = Project::of(&document).to_json(Some(old.path())).unwrap();
        let back = Project::from_json(&bytes, Some(new.path())).unwrap().into_document();
        assert_eq!(back.program.path, Some(new.path().join("p.vv")));
        assert_eq!((&*back.program.text, &*back.program.saved), ("// mine", "// other"));
        assert_eq!(back.mesh, MeshSource::File(new.path().join("m.obj")));
    }

    #[test]
    fn what_is_no_project_says_so() {
        for text in ["", "{}", "[1]", "\u{0}"] {
            assert!(Project::from_json(text.as_bytes(), None).unwrap_err().starts_with("is no project"), "{text:?}");
        }
        let later = String::from_utf8(Project::of(&document()).to_json(None).unwrap()).unwrap();
        let later = later.replace("\"version\": 1", "\"version\": 2");
        for later in [later.as_str(), r#"{"version": 2, "meshes": [{"Cloud": "a.obj"}]}"#] {
            assert_eq!(Project::from_json(later.as_bytes(), None).unwrap_err(), "was made by a later version of vv");
        }
    }

    #[test]
    fn paths_move_in_the_whole_row_of_programs_that_made_the_mesh() {
        let made = |path: PathBuf, mesh| {
            let (text, params) = ("".into(), BTreeMap::new());
            let recipe = Recipe { path, text, includes_revision: 0, mesh, mesh_revision: 0, rule: None, params };
            MeshSource::Result(Arc::new(Request { recipe: Arc::new(recipe), generation: 2 }))
        };
        // That of the program which ships with vv stays where it is.
        let row = |folder: &Path| {
            let file = MeshSource::File(folder.join("m.obj"));
            made(Path::new(NOWHERE).join("loop.vv"), made(folder.join("p.vv"), file))
        };
        let (old, new) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        let document = Document { mesh: row(old.path()), ..document() };
        let bytes = Project::of(&document).to_json(Some(old.path())).unwrap();
        let back = Project::from_json(&bytes, Some(new.path())).unwrap().into_document();
        assert_eq!(back.mesh, row(new.path()));
    }

    #[test]
    fn a_view_from_nowhere_is_refused() {
        let mut project = Project::of(&document());
        project.camera.distance = 0.0;
        let bytes = project.to_json(None).unwrap();
        assert_eq!(Project::from_json(&bytes, None).unwrap_err(), "is no project of vv: its view is nowhere");
    }
}
