//! What is open in the editor, and what is known of it.

use std::cell::OnceCell;
use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use app::files::{self, Compiled};
use lsp_types::{DidChangeTextDocumentParams, DidCloseTextDocumentParams, DidOpenTextDocumentParams, Uri};
use vv::assist::Assist;
use vv::diagnostic::Diagnostic;
use vv::source::{FileId, SourceFile, Sources};

use super::places::{Encoding, path_of, uri_of};

/// All that is open.
pub struct Documents {
    /// How places are counted.
    pub encoding: Encoding,
    open: BTreeMap<String, Document>,
}

/// A text as it stands in the editor.
pub struct Document {
    /// What the editor calls it.
    pub uri: Uri,
    /// Its text.
    pub text: Arc<str>,
    /// Counts its changes.
    pub version: i32,
    /// Where it is saved, in the one way to write that.
    path: PathBuf,
    analysis: OnceCell<Analysis>,
}

/// What is known of a text and of those that it includes.
pub struct Analysis {
    /// What its names mean.
    pub assist: Assist,
    /// What is wrong with it.
    pub diagnostics: Vec<Diagnostic>,
    /// It is the first; those it includes follow.
    pub sources: Arc<Sources>,
    paths: HashMap<String, PathBuf>,
}

impl Documents {
    /// Nothing is open.
    pub fn new(encoding: Encoding) -> Self {
        Self { encoding, open: BTreeMap::new() }
    }

    /// One that is open.
    pub fn get(&self, uri: &Uri) -> Option<&Document> {
        self.open.get(uri.as_str())
    }

    /// All of them.
    pub fn all(&self) -> impl Iterator<Item = &Document> {
        self.open.values()
    }

    /// What the editor says when a file is opened.
    pub fn open(&mut self, params: DidOpenTextDocumentParams) {
        let opened = params.text_document;
        let document = Document {
            path: canonical(&path_of(&opened.uri)),
            text: opened.text.into(),
            version: opened.version,
            analysis: OnceCell::new(),
            uri: opened.uri,
        };
        self.open.insert(document.uri.as_str().to_owned(), document);
        self.forget();
    }

    /// What the editor says when something is typed.
    pub fn change(&mut self, params: DidChangeTextDocumentParams) {
        let encoding = self.encoding;
        if let Some(document) = self.open.get_mut(params.text_document.uri.as_str()) {
            let mut text = document.text.to_string();
            for change in params.content_changes {
                match change.range {
                    Some(range) => {
                        let (start, end) = (encoding.offset(&text, range.start), encoding.offset(&text, range.end));
                        text.replace_range(start..end.max(start), &change.text);
                    }
                    None => text = change.text,
                }
            }
            document.text = text.into();
            document.version = params.text_document.version;
        }
        self.forget();
    }

    /// What the editor says when a file is closed.
    pub fn close(&mut self, params: DidCloseTextDocumentParams) {
        self.open.remove(params.text_document.uri.as_str());
        self.forget();
    }

    /// Finds everything out anew when it is asked for: texts that are included may be others.
    pub fn forget(&mut self) {
        for document in self.open.values_mut() {
            document.analysis.take();
        }
    }

    /// What is known of a document.
    pub fn analysis<'d>(&self, document: &'d Document) -> &'d Analysis {
        document.analysis.get_or_init(|| {
            let unsaved = |path: &Path| self.at_path(&canonical(path)).map(|other| Arc::clone(&other.text));
            let Compiled { compilation, paths, .. } = files::compile_with(&document.path, &document.text, &unsaved);
            let included = compilation.sources.files().iter().skip(1).map(|file| &*file.text);
            Analysis {
                assist: Assist::new(Arc::clone(&document.text), included),
                diagnostics: compilation.diagnostics,
                sources: compilation.sources,
                paths,
            }
        })
    }

    /// What the editor calls a file of a document's program; `None` for one that ships with vv.
    pub fn uri(&self, document: &Document, file: FileId) -> Option<Uri> {
        if file == FileId::MAIN {
            return Some(document.uri.clone());
        }
        let analysis = self.analysis(document);
        let path = canonical(analysis.paths.get(&analysis.sources.file(file)?.name)?);
        self.at_path(&path).map(|other| other.uri.clone()).or_else(|| uri_of(&path))
    }

    /// The files of a document's program, itself first.
    pub fn files<'d>(&self, document: &'d Document) -> impl Iterator<Item = (FileId, &'d SourceFile)> + use<'d> {
        let files = self.analysis(document).sources.files();
        files.iter().enumerate().map(|(i, file)| (FileId(i as u32), file))
    }

    fn at_path(&self, path: &Path) -> Option<&Document> {
        self.open.values().find(|document| document.path == path)
    }
}

fn canonical(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_owned())
}
