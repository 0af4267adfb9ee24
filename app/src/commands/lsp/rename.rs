//! Names across files: where they are declared, where they are used, other ones for them.

use std::ops::Range;
use std::sync::Arc;

use lsp_types::{GotoDefinitionResponse, Location, PrepareRenameResponse, TextEdit, Uri, WorkspaceEdit};
use vv::assist::{Assist, Symbol};
use vv::source::FileId;
use vv::syntax::tree::Item;
use vv::syntax::{is_name, parse};

use super::answers::edits;
use super::documents::{Document, Documents};
use super::places::{path_of, uri_of};

/// A file in which something is named.
struct Named {
    /// `None` for a file that ships with vv.
    uri: Option<Uri>,
    /// What diagnostics call it.
    name: String,
    text: Arc<str>,
    /// The texts that are included with it.
    others: Vec<Arc<str>>,
    uses: Vec<Range<usize>>,
    /// Those of them that declare it.
    declarations: Vec<Range<usize>>,
}

/// Where something is named: in the document, and if it is known in all of the program, in the files that the document
/// includes, and in other open documents that include one that declares it.
fn named(documents: &Documents, document: &Document, symbol: &Symbol) -> Vec<Named> {
    let mut found = files(documents, document, symbol);
    if symbol.scope.is_none() {
        let declaring = |named: &[Named]| -> Vec<String> {
            named.iter().filter(|f| !f.declarations.is_empty()).map(Named::identity).collect()
        };
        let wanted = declaring(&found);
        for other in documents.all().filter(|other| other.uri != document.uri) {
            let also = files(documents, other, symbol);
            if declaring(&also).iter().any(|uri| wanted.contains(uri)) {
                for file in also {
                    if found.iter().all(|f| f.identity() != file.identity()) {
                        found.push(file);
                    }
                }
            }
        }
    }
    found.retain(|file| !file.uses.is_empty());
    found
}

impl Named {
    fn identity(&self) -> String {
        self.uri.as_ref().map_or_else(|| self.name.clone(), |uri| uri.as_str().to_owned())
    }
}

/// Where the files of one program name it.
fn files(documents: &Documents, document: &Document, symbol: &Symbol) -> Vec<Named> {
    let all: Vec<_> = documents.files(document).collect();
    let local = symbol.scope.is_some();
    let one = |&(id, file): &(FileId, &vv::source::SourceFile)| {
        let others: Vec<_> = all.iter().filter(|(o, _)| *o != id).map(|(_, o)| Arc::clone(&o.text)).collect();
        let assist = Assist::new(Arc::clone(&file.text), others.iter().map(|text| &**text));
        let is_it = |s: &&Symbol| s.name == symbol.name && s.kind == symbol.kind && s.scope == symbol.scope;
        Named {
            uri: documents.uri(document, id),
            name: file.name.clone(),
            uses: assist.uses(symbol),
            declarations: assist.declared().filter(is_it).filter_map(|s| s.place.clone()).collect(),
            text: Arc::clone(&file.text),
            others,
        }
    };
    all.iter().take(if local { 1 } else { all.len() }).map(one).collect()
}

/// Where the name at a place is declared; of an included file, its beginning.
pub fn definition(documents: &Documents, document: &Document, offset: usize) -> Option<GotoDefinitionResponse> {
    if let Some(uri) = included(document, offset) {
        return Some(GotoDefinitionResponse::Scalar(Location { uri, range: lsp_types::Range::default() }));
    }
    let (_, symbol) = documents.analysis(document).assist.symbol_at(offset)?;
    let symbol = symbol.clone();
    let mut places = Vec::new();
    for file in files(documents, document, &symbol) {
        let Some(uri) = file.uri else { continue };
        let own = if symbol.scope.is_some() { symbol.place.clone().into_iter().collect() } else { file.declarations };
        places.extend(
            own.into_iter()
                .map(|range| Location { uri: uri.clone(), range: documents.encoding.range(&file.text, range) }),
        );
    }
    (!places.is_empty()).then_some(GotoDefinitionResponse::Array(places))
}

/// The file that an `#include` at a place names.
fn included(document: &Document, offset: usize) -> Option<Uri> {
    let (ast, _) = parse(FileId::MAIN, &document.text);
    let wanted = ast.items.iter().find_map(|item| match item {
        Item::Include { path, span } if (span.start as usize..=span.end as usize).contains(&offset) => Some(path),
        _ => None,
    })?;
    let path = path_of(&document.uri).parent()?.join(wanted);
    path.is_file().then(|| uri_of(&path)).flatten()
}

/// Wherever the name at a place is used.
pub fn references(
    documents: &Documents,
    document: &Document,
    offset: usize,
    with_declaration: bool,
) -> Option<Vec<Location>> {
    let (_, symbol) = documents.analysis(document).assist.symbol_at(offset)?;
    let mut places = Vec::new();
    for file in named(documents, document, symbol) {
        let Some(uri) = file.uri else { continue };
        let is_wanted = |range: &&Range<usize>| {
            with_declaration || !file.declarations.contains(range) && symbol.place.as_ref() != Some(*range)
        };
        places.extend(
            file.uses
                .iter()
                .filter(is_wanted)
                .map(|range| Location { uri: uri.clone(), range: documents.encoding.range(&file.text, range.clone()) }),
        );
    }
    Some(places)
}

/// The name at a place, if it is one that can be changed.
pub fn prepare(documents: &Documents, document: &Document, offset: usize) -> Option<PrepareRenameResponse> {
    let (range, symbol) = documents.analysis(document).assist.symbol_at(offset)?;
    can_change(&named(documents, document, symbol), symbol).ok()?;
    Some(PrepareRenameResponse::RangeWithPlaceholder {
        range: documents.encoding.range(&document.text, range),
        placeholder: symbol.name.clone(),
    })
}

fn can_change(files: &[Named], symbol: &Symbol) -> Result<(), String> {
    let name = &symbol.name;
    if let Some(file) = files.iter().find(|file| file.uri.is_none()) {
        return Err(format!("`{name}` stands in `{}`, which ships with vv", file.name));
    }
    if symbol.place.is_none() && files.iter().all(|file| file.declarations.is_empty()) {
        return Err(format!("the language calls it `{name}`"));
    }
    Ok(())
}

/// The edits that give the name at a place another one.
///
/// # Errors
/// If it is none, or if something would then mean something else.
pub fn rename(documents: &Documents, document: &Document, offset: usize, to: &str) -> Result<WorkspaceEdit, String> {
    if !is_name(to) {
        return Err(format!("`{to}` cannot be a name"));
    }
    let assist = &documents.analysis(document).assist;
    let (_, symbol) = assist.symbol_at(offset).ok_or("there is no name here that could be changed")?;
    let files = named(documents, document, symbol);
    can_change(&files, symbol)?;
    for file in &files {
        if !means_the_same(file, &symbol.name, to) {
            return Err(format!("`{to}` would mean something else: it is in use already"));
        }
    }
    let edit = |file: Named| {
        let edits = file
            .uses
            .into_iter()
            .map(|range| TextEdit { range: documents.encoding.range(&file.text, range), new_text: to.to_owned() });
        Some((file.uri?, edits.collect()))
    };
    Ok(edits(files.into_iter().filter_map(edit)))
}

/// Whether in a file with the new name it is used where the old one was, and nowhere else.
fn means_the_same(file: &Named, from: &str, to: &str) -> bool {
    let Some(first) = file.uses.first() else { return true };
    let before = Assist::new(Arc::clone(&file.text), file.others.iter().map(|text| &**text));
    let is_local = before.symbol_at(first.start).is_some_and(|(_, symbol)| symbol.scope.is_some());
    // Where other files declare it, they do so under the new name as well.
    let others = file.others.iter().map(|text| {
        let of = Assist::new(Arc::clone(text), []);
        let declared = of.declared().filter(|s| !is_local && s.name == from && s.scope.is_none());
        let places: Vec<_> = declared.filter_map(|s| s.place.clone()).collect();
        replaced(text, &places, to).0
    });
    let others: Vec<String> = others.collect();
    let (text, places) = replaced(&file.text, &file.uses, to);
    let after = Assist::new(text, others.iter().map(String::as_str));
    after.symbol_at(places[0].start).is_some_and(|(_, symbol)| after.uses(symbol) == places)
}

/// A text with `to` in some places, in their order, and where it stands then.
fn replaced(text: &str, places: &[Range<usize>], to: &str) -> (String, Vec<Range<usize>>) {
    let (mut new, mut moved, mut end) = (String::new(), Vec::new(), 0);
    for range in places {
        new.push_str(&text[end..range.start]);
        moved.push(new.len()..new.len() + to.len());
        new.push_str(to);
        end = range.end;
    }
    new.push_str(&text[end..]);
    (new, moved)
}
