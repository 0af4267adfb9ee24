//! What one document answers: what is wrong with it, what its words mean, what can stand in it.

use std::collections::BTreeMap;
use std::ops::Range;

use lsp_types::{
    CodeAction, CodeActionKind, CodeActionOrCommand, CompletionItem, CompletionItemKind, CompletionResponse,
    CompletionTextEdit, Diagnostic, DiagnosticRelatedInformation, DiagnosticSeverity, DocumentHighlight,
    DocumentHighlightKind, DocumentSymbol, DocumentSymbolResponse, Documentation, Hover, HoverContents, Location,
    MarkupContent, MarkupKind, PublishDiagnosticsParams, SemanticToken, SemanticTokenType, SemanticTokens,
    SemanticTokensResult, SymbolKind, TextEdit, Uri, WorkspaceEdit,
};
use vv::diagnostic::{self, Severity};
use vv::source::{FileId, Span};
use vv::syntax::tree::{Element, Item};
use vv::syntax::{TokenClass, format, highlight, parse};

use super::documents::{Document, Documents};

/// The name by which editors show where a problem comes from.
const SOURCE: &str = "vv";

/// All problems of all open documents, by the file that they are in; a document without any has an empty list.
pub fn problems(documents: &Documents) -> BTreeMap<String, PublishDiagnosticsParams> {
    let mut all: BTreeMap<String, PublishDiagnosticsParams> = BTreeMap::new();
    for document in documents.all() {
        let of = |uri: Uri, version| PublishDiagnosticsParams { uri, diagnostics: Vec::new(), version };
        let own = of(document.uri.clone(), Some(document.version));
        all.entry(document.uri.as_str().to_owned()).or_insert(own).version = Some(document.version);
        for problem in &documents.analysis(document).diagnostics {
            let file = problem.span.map_or(FileId::MAIN, |span| span.file);
            // What ships with vv is nobody's to mend: shown where it is included, which is to say, at the top.
            let uri = documents.uri(document, file).unwrap_or_else(|| document.uri.clone());
            let problem = shown(documents, document, problem);
            let there = all.entry(uri.as_str().to_owned()).or_insert_with(|| of(uri, None));
            if !there.diagnostics.contains(&problem) {
                there.diagnostics.push(problem);
            }
        }
    }
    all
}

fn shown(documents: &Documents, document: &Document, problem: &diagnostic::Diagnostic) -> Diagnostic {
    let mut message = problem.message.clone();
    for evidence in &problem.evidence {
        message.push('\n');
        message.push_str(evidence);
    }
    for hint in &problem.hints {
        message.push_str("\nhint: ");
        message.push_str(&hint.message);
    }
    let related: Vec<_> = problem
        .labels
        .iter()
        .filter_map(|(span, message)| {
            Some(DiagnosticRelatedInformation {
                location: location(documents, document, *span)?,
                message: message.clone(),
            })
        })
        .collect();
    let place = problem.span.filter(|span| documents.uri(document, span.file).is_some());
    Diagnostic {
        range: place.map(|span| range_of(documents, document, span)).unwrap_or_default(),
        severity: Some(match problem.severity {
            Severity::Error => DiagnosticSeverity::ERROR,
            Severity::Warning => DiagnosticSeverity::WARNING,
            Severity::Note => DiagnosticSeverity::INFORMATION,
        }),
        source: Some(SOURCE.to_owned()),
        message,
        related_information: (!related.is_empty()).then_some(related),
        ..Diagnostic::default()
    }
}

/// Where a span lies; `None` in a file that ships with vv.
fn location(documents: &Documents, document: &Document, span: Span) -> Option<Location> {
    Some(Location { uri: documents.uri(document, span.file)?, range: range_of(documents, document, span) })
}

fn range_of(documents: &Documents, document: &Document, span: Span) -> lsp_types::Range {
    let file = documents.analysis(document).sources.file(span.file);
    file.map(|file| documents.encoding.range(&file.text, bytes(span))).unwrap_or_default()
}

fn bytes(span: Span) -> Range<usize> {
    span.start as usize..span.end as usize
}

/// What the hints of the problems in a range propose.
pub fn actions(documents: &Documents, document: &Document, range: lsp_types::Range) -> Vec<CodeActionOrCommand> {
    let mut actions = Vec::new();
    for problem in &documents.analysis(document).diagnostics {
        let Some(span) = problem.span.filter(|span| span.file == FileId::MAIN) else { continue };
        let place = range_of(documents, document, span);
        if place.end < range.start || range.end < place.start {
            continue;
        }
        for hint in &problem.hints {
            let Some((span, replacement)) = &hint.edit else { continue };
            let Some(uri) = documents.uri(document, span.file) else { continue };
            let edit = TextEdit { range: range_of(documents, document, *span), new_text: replacement.clone() };
            actions.push(CodeActionOrCommand::CodeAction(CodeAction {
                title: hint.message.clone(),
                kind: Some(CodeActionKind::QUICKFIX),
                diagnostics: Some(vec![shown(documents, document, problem)]),
                edit: Some(edits([(uri, vec![edit])])),
                ..CodeAction::default()
            }));
        }
    }
    actions
}

/// A change of several files.
pub fn edits(files: impl IntoIterator<Item = (Uri, Vec<TextEdit>)>) -> WorkspaceEdit {
    WorkspaceEdit { changes: Some(files.into_iter().collect()), ..WorkspaceEdit::default() }
}

/// What the word at a place means.
pub fn hover(documents: &Documents, document: &Document, offset: usize) -> Option<Hover> {
    let meaning = documents.analysis(document).assist.meaning(offset)?;
    Some(Hover {
        range: Some(documents.encoding.range(&document.text, meaning.range)),
        contents: HoverContents::Markup(explained(&meaning.usage, &meaning.doc)),
    })
}

fn explained(usage: &str, doc: &str) -> MarkupContent {
    let value = format!("```vv\n{usage}\n```\n\n{doc}").trim_end().to_owned();
    MarkupContent { kind: MarkupKind::Markdown, value }
}

/// What can stand at a place.
pub fn completion(documents: &Documents, document: &Document, offset: usize) -> Option<CompletionResponse> {
    let completions = documents.analysis(document).assist.complete(offset);
    let range = documents.encoding.range(&document.text, completions.replaces);
    let called_already = document.text.get(offset..).is_some_and(|behind| behind.starts_with('('));
    let items = completions.entries.into_iter().enumerate().map(|(i, entry)| CompletionItem {
        kind: Some(match entry.class {
            TokenClass::Function => CompletionItemKind::FUNCTION,
            TokenClass::Property => CompletionItemKind::FIELD,
            TokenClass::Literal => CompletionItemKind::CONSTANT,
            TokenClass::Name => CompletionItemKind::VARIABLE,
            TokenClass::Type => CompletionItemKind::STRUCT,
            _ => CompletionItemKind::KEYWORD,
        }),
        detail: entry.usage.lines().next().map(str::to_owned),
        documentation: Some(Documentation::MarkupContent(explained(&entry.usage, &entry.doc))),
        // In our order, not that of the alphabet.
        sort_text: Some(format!("{i:05}")),
        filter_text: Some(entry.label.clone()),
        text_edit: Some(CompletionTextEdit::Edit(TextEdit {
            range,
            new_text: if called_already { entry.label.clone() } else { entry.insert },
        })),
        label: entry.label,
        ..CompletionItem::default()
    });
    Some(CompletionResponse::Array(items.collect()))
}

/// Wherever the name at a place is used in the document.
pub fn highlights(documents: &Documents, document: &Document, offset: usize) -> Option<Vec<DocumentHighlight>> {
    let assist = &documents.analysis(document).assist;
    let (_, symbol) = assist.symbol_at(offset)?;
    let all = assist.uses(symbol).into_iter().map(|range| DocumentHighlight {
        range: documents.encoding.range(&document.text, range),
        kind: Some(DocumentHighlightKind::TEXT),
    });
    Some(all.collect())
}

/// What the document declares.
pub fn symbols(documents: &Documents, document: &Document) -> DocumentSymbolResponse {
    let (ast, _) = parse(FileId::MAIN, &document.text);
    let assist = &documents.analysis(document).assist;
    // The declaration in one line, as everywhere.
    let usage = |span: Span| assist.declared().find(|s| s.place == Some(bytes(span))).map(|s| s.usage.clone());
    let symbol = |name: &str, named: Span, whole: Span, kind: SymbolKind, children: Vec<DocumentSymbol>| {
        let whole = Span::new(whole.file, whole.start.min(named.start), whole.end.max(named.end));
        #[expect(deprecated, reason = "the field has to be filled in all the same")]
        DocumentSymbol {
            name: name.to_owned(),
            detail: usage(named),
            kind,
            tags: None,
            deprecated: None,
            range: documents.encoding.range(&document.text, bytes(whole)),
            selection_range: documents.encoding.range(&document.text, bytes(named)),
            children: (!children.is_empty()).then_some(children),
        }
    };
    let mut all = Vec::new();
    for item in &ast.items {
        match item {
            Item::Include { .. } => {}
            Item::Function(f) => {
                all.push(symbol(&f.name.text, f.name.span, f.span, SymbolKind::FUNCTION, Vec::new()));
            }
            Item::Phase { name, body } => {
                let whole = body.span.unwrap_or(name.span);
                all.push(symbol(&name.text, name.span, whole, SymbolKind::FUNCTION, Vec::new()));
            }
            Item::Constant(declaration) => all.extend(
                declaration
                    .declarators
                    .iter()
                    .map(|d| symbol(&d.name.text, d.name.span, declaration.span, SymbolKind::CONSTANT, Vec::new())),
            ),
            Item::Param(p) => all.push(symbol(&p.name.text, p.name.span, p.span, SymbolKind::VARIABLE, Vec::new())),
            Item::Properties { element, fields, span } => {
                let name = match element {
                    Element::Vertex => "vertex",
                    Element::Edge => "edge",
                    Element::Mesh => "mesh",
                };
                let fields = fields.iter().flat_map(|field| field.declarators.iter().map(move |d| (field, d)));
                let children = fields
                    .map(|(field, d)| symbol(&d.name.text, d.name.span, field.span, SymbolKind::FIELD, Vec::new()))
                    .collect();
                let word = Span::new(span.file, span.start, span.start + name.len() as u32);
                all.push(symbol(name, word, *span, SymbolKind::STRUCT, children));
            }
        }
    }
    DocumentSymbolResponse::Nested(all)
}

/// The edit that lays the document out; nothing if it cannot be read without doubt.
pub fn formatting(documents: &Documents, document: &Document) -> Option<Vec<TextEdit>> {
    let formatted = format(&document.text).ok()?;
    if *formatted == *document.text {
        return Some(Vec::new());
    }
    let range = documents.encoding.range(&document.text, 0..document.text.len());
    Some(vec![TextEdit { range, new_text: formatted }])
}

/// How editors name what [`highlight`] finds, with [`class_index`] as the place in this list.
pub fn token_types() -> Vec<SemanticTokenType> {
    vec![
        SemanticTokenType::KEYWORD,
        SemanticTokenType::TYPE,
        SemanticTokenType::FUNCTION,
        SemanticTokenType::PROPERTY,
        SemanticTokenType::DECORATOR,
        SemanticTokenType::VARIABLE,
        SemanticTokenType::NUMBER,
        SemanticTokenType::STRING,
        SemanticTokenType::COMMENT,
        SemanticTokenType::MACRO,
    ]
}

fn class_index(class: TokenClass) -> Option<u32> {
    Some(match class {
        TokenClass::Keyword | TokenClass::Algebra => 0,
        TokenClass::Type => 1,
        TokenClass::Function => 2,
        TokenClass::Property => 3,
        TokenClass::Old => 4,
        TokenClass::Name => 5,
        TokenClass::Literal => 6,
        TokenClass::Text => 7,
        TokenClass::Comment => 8,
        TokenClass::Directive => 9,
        TokenClass::Punctuation | TokenClass::Error => return None,
    })
}

/// What each word of the document is, for colouring.
pub fn tokens(documents: &Documents, document: &Document) -> SemanticTokensResult {
    let text = &*document.text;
    let mut data = Vec::new();
    // Lines since the token before and its column in this one, and how far the text was looked at: byte and column.
    let (mut line, mut column, mut from, mut here) = (0, 0, 0, 0);
    for (range, class) in highlight(text) {
        let Some(token_type) = class_index(class) else { continue };
        // A token stands in one line.
        let mut start = range.start;
        for part in text[range].split_inclusive('\n') {
            let stretch = part.trim_end_matches(['\n', '\r']);
            let skipped = &text[from..start];
            line += skipped.bytes().filter(|&b| b == b'\n').count() as u32;
            match skipped.rfind('\n') {
                Some(end) => (column, here) = (0, documents.encoding.length(&skipped[end + 1..])),
                None => here += documents.encoding.length(skipped),
            }
            let length = documents.encoding.length(stretch);
            if length > 0 {
                data.push(SemanticToken {
                    delta_line: std::mem::take(&mut line),
                    delta_start: here - column,
                    length,
                    token_type,
                    token_modifiers_bitset: 0,
                });
                column = here;
            }
            from = start;
            start += part.len();
        }
    }
    SemanticTokensResult::Tokens(SemanticTokens { result_id: None, data })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::lsp::places::Encoding;
    use lsp_types::{DidOpenTextDocumentParams, TextDocumentItem};
    use std::str::FromStr as _;

    /// Line, column and length of each token.
    #[track_caller]
    fn check(text: &str, expected: &[(u32, u32, u32)]) {
        let uri = Uri::from_str("untitled:a").unwrap();
        let mut documents = Documents::new(Encoding::Utf16);
        let text_document = TextDocumentItem::new(uri.clone(), "vv".to_owned(), 1, text.to_owned());
        documents.open(DidOpenTextDocumentParams { text_document });
        let SemanticTokensResult::Tokens(tokens) = tokens(&documents, documents.get(&uri).unwrap()) else {
            panic!("these are all of them")
        };
        let (mut line, mut column) = (0, 0);
        let place = |token: SemanticToken| {
            column = if token.delta_line > 0 { token.delta_start } else { column + token.delta_start };
            line += token.delta_line;
            (line, column, token.length)
        };
        assert_eq!(tokens.data.into_iter().map(place).collect::<Vec<_>>(), expected);
    }

    #[test]
    fn tokens_stand_where_editors_count_them() {
        check("int a;\n\n  int τ𝄞; b", &[(0, 0, 3), (0, 4, 1), (2, 2, 3), (2, 6, 1), (2, 11, 1)]);
        check("/* τ\n𝄞 */ int\r\n  a", &[(0, 0, 4), (1, 0, 5), (1, 6, 3), (2, 2, 1)]);
    }

    /// Nor does it take longer than many lines.
    #[test]
    fn a_line_may_have_very_many_tokens() {
        let expected: Vec<_> = (0..100_000).map(|i| (0, 2 * i, 1)).collect();
        check(&"1 ".repeat(100_000), &expected);
    }
}
