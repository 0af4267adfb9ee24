//! Pictures out of the window, and programs that are shown as in the gallery.

use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::sync::{Arc, PoisonError};

use super::Session;
use super::coloring::drawn;
use crate::annotate::Annotations;
use crate::command::Command;
use crate::document::ProgramText;
use crate::figure::Notes;
use crate::inspect::selection::Item;
use crate::preferences::{Background, PictureOptions};
use crate::render::{self, Size};
use crate::scene::{Style, Theme};
use crate::style_file::StyleFile;
use crate::{figure, files, gallery, library, style_file, typed_path};
use vv::diagnostic::Severity;
use vv::stop::Stop;

/// Of a picture that is asked for before there is one.
const NO_PICTURE: &str = "there is no picture yet";

/// How things are seen, as a style file says all of it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Look {
    style: Style,
    annotations: Annotations,
    /// What the file says of figures.
    file: StyleFile,
}

impl Session {
    /// A program that ships with vv as the gallery shows it.
    pub(super) fn show_exhibit(&mut self, name: &str, keep_mesh: bool) {
        let (Some(exhibit), Some(program)) = (gallery::exhibit(name), library::program(name)) else { return };
        self.set_program(ProgramText::new(program.name, program.text));
        self.document.rule = exhibit.rule.map(str::to_owned);
        let own = matches!(self.document.mesh, crate::document::MeshSource::File(_));
        self.playing = None;
        if keep_mesh && own {
            self.document.generation = 0; // who knows how large it is
            return;
        }
        // What grows from a mesh of its own is not shaped by it: it would only stand in the way.
        self.document.style.control = exhibit.is_of_a_mesh();
        self.document.mesh = exhibit.mesh();
        self.document.generation = exhibit.generation;
        self.mesh_chosen = false;
        self.mesh_revision += 1;
        self.watch_files();
    }

    /// Size of a picture with these options; that of the viewport, if it tells one.
    #[must_use]
    pub fn picture_size(&self, options: &PictureOptions) -> Size {
        match self.view {
            Some((size, _)) if options.as_seen => size,
            // Lines as wide in proportion as in the window.
            Some((size, _)) => {
                let scale = size.scale * options.height as f32 / size.height.max(1) as f32;
                Size { width: options.width, height: options.height, scale: scale.max(0.5) }
            }
            None => Size::new(options.width, options.height),
        }
    }

    /// What is written on the surface: the labels, and the ring of the vertex that is selected.
    fn notes(&self) -> Notes {
        let rings = match self.selected()[..] {
            [Item::Vertex(v)] if self.inspection.walk.is_none() => vec![v],
            _ => Vec::new(),
        };
        Notes { labels: self.document.annotations.labels.clone(), rings }
    }

    /// Writes a figure of lines and areas.
    fn figure_to(&mut self, path: PathBuf, format: figure::Format) -> Result<(), String> {
        let frame = self.frame.clone().ok_or(NO_PICTURE)?;
        let (size, camera) = (self.picture_size(&self.preferences.picture), self.document.camera);
        let style = self.view.map_or(self.document.style, |(_, style)| style);
        let (annotations, notes) = (self.document.annotations.clone(), self.notes());
        let (name, settings) = (crate::document::file_name(&path), self.figure_settings());
        self.say(Severity::Note, format!("drawing {name} …"));
        self.in_background(move || {
            let failed = |problem: String| format!("{}: {problem}", path.display());
            frame.colors.find(&frame.subject(), &annotations, &Stop::new());
            let tint = frame.colors.colors(&annotations.color_by).and_then(Result::ok);
            let (mesh, faces) = (&frame.mesh, &frame.faces);
            let subject = figure::Subject { scene: &frame.scene, mesh, faces, tint: tint.as_deref(), notes: &notes };
            let drawing = figure::draw(subject, &camera, size.aspect(), &style, &settings, &Stop::new());
            let drawing = drawing.map_err(|stopped| failed(stopped.to_string()))?;
            let drawing = drawing.ok_or_else(|| failed("nothing of the mesh is seen".to_owned()))?;
            let bytes = figure::write(&drawing, format);
            files::write(&path, &bytes).map_err(|e| failed(e.diagnostic.message.clone()))?;
            let saved = format!("saved {}", typed_path::shown(&path));
            Ok(if drawing.is_exact { saved } else { format!("{saved}: {}", figure::ROUGH) })
        });
        Ok(())
    }

    /// How figures are drawn: as the style file says that was loaded last.
    pub(super) fn figure_settings(&self) -> figure::Settings {
        self.style_file.figures().unwrap_or_default() // it was read before
    }

    /// What a loaded style says lies behind pictures, in the window, too.
    #[must_use]
    pub fn backdrop(&self) -> Option<[u8; 3]> {
        self.style_file.backdrop().unwrap_or_default() // it was read before
    }

    pub(super) fn picture_to(&mut self, path: &Path) -> Result<(), String> {
        let extension = path.extension().unwrap_or_default().to_string_lossy();
        let format = figure::Format::from_extension(&extension);
        if format.is_none() && !extension.eq_ignore_ascii_case("png") {
            return Err("the name of a picture ends in .png, .svg, .eps or .pdf".to_owned());
        }
        files::check_writable(path).map_err(|error| error.diagnostic.message.clone())?;
        let path = path.to_owned();
        if let Some(format) = format {
            return self.figure_to(path, format);
        }
        let frame = self.frame.clone().ok_or(NO_PICTURE)?;
        let options = self.preferences.picture;
        let (size, camera) = (self.picture_size(&options), self.document.camera);
        let seen = self.view.map_or(self.document.style, |(_, style)| style);
        let behind = match options.background {
            Background::AsSeen => self.backdrop(),
            Background::White => Some([255; 3]),
            Background::Transparent => None,
        };
        let transparent = behind.is_some() || options.background == Background::Transparent;
        let theme = if options.background == Background::White { Theme::Light } else { seen.theme };
        let style = Style { transparent: seen.transparent || transparent, theme, ..seen };
        let (annotations, notes) = (self.document.annotations.clone(), self.notes());
        let name = crate::document::file_name(&path);
        self.say(Severity::Note, format!("drawing {name} …"));
        self.in_background(move || {
            let failed = |problem: String| format!("{}: {problem}", path.display());
            let mut image =
                drawn(&frame, (&annotations, &notes), &camera, &style, size).map_err(|e| failed(e.to_string()))?;
            if let Some(color) = behind {
                render::put_on(&mut image, color);
            }
            let mut bytes = Cursor::new(Vec::new());
            image.write_to(&mut bytes, image::ImageFormat::Png).map_err(|e| failed(e.to_string()))?;
            files::write(&path, &bytes.into_inner()).map_err(|e| failed(e.diagnostic.message.clone()))?;
            Ok(format!("saved {}, {} × {} pixels", typed_path::shown(&path), size.width, size.height))
        });
        Ok(())
    }

    /// Writes how things are seen, for other meshes and for the command line.
    pub(super) fn save_style(&mut self, path: &Path) -> Result<(), String> {
        let style = self.view.map_or(self.document.style, |(_, style)| style);
        let annotations = self.document.annotations.clone();
        let file = StyleFile { style, annotations, ..self.style_file.clone() };
        let name = crate::document::file_name(path);
        file.write(path).map_err(|error| error.diagnostic.message.clone())?;
        self.say(Severity::Note, format!("saved {name}; `vv run --style {name}` draws so"));
        Ok(())
    }

    /// Shows things as a file says, but for what belongs to the window: its colours, and that it is not transparent.
    pub(super) fn open_style(&mut self, path: &Path) -> Result<(), String> {
        let located = |place: Option<vv::io::Place>, message: String| match place {
            Some(vv::io::Place::Text { line, .. }) => format!("line {line}: {message}"),
            _ => message,
        };
        let (file, text) =
            StyleFile::read(path).map_err(|error| located(error.place, error.diagnostic.message.clone()))?;
        file.figures().map(drop).and_then(|()| file.backdrop().map(drop)).map_err(|misfit| {
            let names: Vec<&str> = misfit.names.iter().map(String::as_str).collect();
            located(style_file::place_of(&text, &names), misfit.message)
        })?;
        let before = self.look();
        let Style { theme, transparent, .. } = self.document.style;
        let style = Style { theme, transparent, ..file.style };
        self.set_look(Look { style, annotations: file.annotations.clone(), file });
        self.record_look(before);
        self.say(Severity::Note, format!("shown as {} says", crate::document::file_name(path)));
        Ok(())
    }

    /// How things are seen.
    pub(super) fn look(&self) -> Look {
        let (style, annotations) = (self.document.style, self.document.annotations.clone());
        Look { style, annotations, file: self.style_file.clone() }
    }

    /// From now on things are seen so.
    pub(super) fn set_look(&mut self, look: Look) {
        let Look { style, annotations, file } = look;
        self.carry_out(Command::SetStyle(style));
        self.carry_out(Command::SetAnnotations(annotations));
        self.style_file = file;
    }

    /// The picture as it is in the viewport.
    pub(super) fn copy_image(&mut self) {
        let (Some(frame), Some((size, style))) = (self.frame.clone(), self.view) else { return };
        let (annotations, notes) = (self.document.annotations.clone(), self.notes());
        let (camera, clipboard) = (self.document.camera, Arc::clone(&self.clipboard));
        self.in_background(move || {
            let image =
                drawn(&frame, (&annotations, &notes), &camera, &style, size).map_err(|error| error.to_string())?;
            let (width, height) = (image.width() as usize, image.height() as usize);
            let mut clipboard = clipboard.lock().unwrap_or_else(PoisonError::into_inner);
            let failed = |error: arboard::Error| format!("the image cannot be copied: {error}");
            let open = match clipboard.take() {
                Some(open) => open,
                None => arboard::Clipboard::new().map_err(failed)?,
            };
            clipboard
                .insert(open)
                .set_image(arboard::ImageData { width, height, bytes: image.into_raw().into() })
                .map_err(failed)?;
            Ok("image copied".to_owned())
        });
    }
}
