//! `vv lsp`: a language server, for the editor beside the window.
//!
//! ```text
//!   editor ── requests ──▶ Server ── asks ──▶ Documents ── compile, assist ──▶ vv
//!      ▲                      │
//!      └── answers, problems ─┘        problems once the editor has been silent for a moment
//! ```
//!
//! Speaks the Language Server Protocol 3.17 over stdin and stdout.

mod answers;
mod documents;
mod places;
mod rename;
mod wire;

use std::collections::BTreeMap;
use std::io::{self, IsTerminal as _};
use std::time::Duration;

use app::files;
use clap::Args;
use lsp_server::{Connection, ErrorCode, Message, Notification, Request, Response};
use lsp_types::notification as told;
use lsp_types::request as asked;
use lsp_types::{
    CodeActionProviderCapability, CompletionOptions, HoverProviderCapability, InitializeParams, InitializeResult,
    OneOf, PositionEncodingKind, PublishDiagnosticsParams, RenameOptions, SemanticTokensFullOptions,
    SemanticTokensLegend, SemanticTokensOptions, ServerCapabilities, ServerInfo, TextDocumentPositionParams,
    TextDocumentSyncCapability, TextDocumentSyncKind,
};
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::report::Reporter;
use super::{DiagnosticFormat, EXIT_CODES, Exit, error, fail};
use documents::Documents;
use places::Encoding;
use wire::Wire;

/// How long an editor is silent before problems are looked for.
const SILENCE: Duration = Duration::from_millis(60);

/// What `vv lsp` takes.
#[derive(Debug, Args)]
#[command(after_help = EXIT_CODES)]
pub struct Arguments {
    /// Speak over stdin and stdout. It always does; some editors say so.
    #[arg(long)]
    stdio: bool,
}

/// Serves until the editor says that it ends, or is gone.
pub fn lsp(_: &Arguments) -> Result<(), Exit> {
    let reporter = Reporter::new(DiagnosticFormat::Human);
    if io::stdin().is_terminal() {
        let diagnostic = error("a language server is started by an editor and speaks with it over stdin and stdout");
        return fail(&reporter, Exit::Usage, diagnostic.hint("`vv check PROGRAM` finds the same problems"));
    }
    let (connection, wire) = Wire::open().or_else(|problem| {
        fail(&reporter, Exit::File, error(format!("the editor cannot be served: {}", files::sentence(&problem))))
    })?;
    let served = serve(&connection);
    drop(connection);
    let unread = wire.close();
    served.err().or(unread).map_or(Ok(()), |trouble| {
        fail(&reporter, Exit::File, error(format!("the editor is not understood: {trouble}")))
    })
}

fn serve(connection: &Connection) -> Result<(), String> {
    let (id, params) = match connection.initialize_start() {
        Ok(first) => first,
        Err(problem) if problem.channel_is_disconnected() => return Ok(()), // nobody there
        Err(problem) => return Err(problem.to_string()),
    };
    let params: InitializeParams = serde_json::from_value(params).map_err(|problem| {
        let why = format!("the parameters of `initialize` cannot be read: {problem}");
        let refusal = Response::new_err(id.clone(), ErrorCode::InvalidParams as i32, why.clone());
        let _ = connection.sender.send(refusal.into());
        why
    })?;
    let encoding = encoding(&params);
    let result = InitializeResult {
        capabilities: capabilities(encoding),
        server_info: Some(ServerInfo { name: "vv".to_owned(), version: Some(env!("CARGO_PKG_VERSION").to_owned()) }),
    };
    let result = serde_json::to_value(result).map_err(|error| error.to_string())?;
    match connection.initialize_finish(id, result) {
        Err(problem) if !problem.channel_is_disconnected() => return Err(problem.to_string()),
        Err(_) => return Ok(()),
        Ok(()) => {}
    }
    let mut server =
        Server { connection, documents: Documents::new(encoding), published: BTreeMap::new(), stale: false };
    loop {
        let message = if server.stale {
            match connection.receiver.recv_timeout(SILENCE) {
                Ok(message) => message,
                Err(error) if error.is_timeout() => {
                    server.publish();
                    continue;
                }
                Err(_) => return Ok(()),
            }
        } else {
            match connection.receiver.recv() {
                Ok(message) => message,
                Err(_) => return Ok(()),
            }
        };
        match message {
            Message::Request(request) => {
                if connection.handle_shutdown(&request).map_err(|error| error.to_string())? {
                    return Ok(());
                }
                server.answer(request);
            }
            Message::Notification(notification) if notification.method == "exit" => return Ok(()),
            Message::Notification(notification) => server.told(notification),
            Message::Response(_) => {}
        }
    }
}

/// Bytes if the editor can count them, else what all can.
fn encoding(params: &InitializeParams) -> Encoding {
    let general = params.capabilities.general.as_ref();
    let offered = general.and_then(|general| general.position_encodings.as_deref()).unwrap_or_default();
    if offered.contains(&PositionEncodingKind::UTF8) { Encoding::Utf8 } else { Encoding::Utf16 }
}

fn capabilities(encoding: Encoding) -> ServerCapabilities {
    let texts = |list: &[&str]| Some(list.iter().map(|&s| s.to_owned()).collect());
    ServerCapabilities {
        position_encoding: Some(match encoding {
            Encoding::Utf8 => PositionEncodingKind::UTF8,
            Encoding::Utf16 => PositionEncodingKind::UTF16,
        }),
        text_document_sync: Some(TextDocumentSyncCapability::Kind(TextDocumentSyncKind::INCREMENTAL)),
        hover_provider: Some(HoverProviderCapability::Simple(true)),
        completion_provider: Some(CompletionOptions {
            trigger_characters: texts(&["$", "."]),
            ..CompletionOptions::default()
        }),
        definition_provider: Some(OneOf::Left(true)),
        references_provider: Some(OneOf::Left(true)),
        document_highlight_provider: Some(OneOf::Left(true)),
        document_symbol_provider: Some(OneOf::Left(true)),
        document_formatting_provider: Some(OneOf::Left(true)),
        code_action_provider: Some(CodeActionProviderCapability::Simple(true)),
        rename_provider: Some(OneOf::Right(RenameOptions {
            prepare_provider: Some(true),
            work_done_progress_options: Default::default(),
        })),
        semantic_tokens_provider: Some(
            SemanticTokensOptions {
                legend: SemanticTokensLegend { token_types: answers::token_types(), token_modifiers: Vec::new() },
                full: Some(SemanticTokensFullOptions::Bool(true)),
                ..SemanticTokensOptions::default()
            }
            .into(),
        ),
        ..ServerCapabilities::default()
    }
}

struct Server<'c> {
    connection: &'c Connection,
    documents: Documents,
    /// What the editor was told of each file last.
    published: BTreeMap<String, PublishDiagnosticsParams>,
    /// Whether something has changed since.
    stale: bool,
}

/// An answer: what was asked for, or why not.
type Answer<T> = Result<T, String>;

impl Server<'_> {
    fn told(&mut self, notification: Notification) {
        use told::Notification as _;
        let Notification { method, params, .. } = notification;
        // What cannot be read cannot be obeyed either; there is nobody to tell.
        match method.as_str() {
            told::DidOpenTextDocument::METHOD => self.take(params, Documents::open),
            told::DidChangeTextDocument::METHOD => self.take(params, Documents::change),
            told::DidCloseTextDocument::METHOD => self.take(params, Documents::close),
            // Files that are included may have changed on disk.
            told::DidSaveTextDocument::METHOD | told::DidChangeWatchedFiles::METHOD => {
                self.documents.forget();
                self.stale = true;
            }
            _ => {}
        }
    }

    fn take<P: DeserializeOwned>(&mut self, params: serde_json::Value, change: fn(&mut Documents, P)) {
        if let Ok(params) = serde_json::from_value(params) {
            change(&mut self.documents, params);
            self.stale = true;
        }
    }

    fn answer(&self, request: Request) {
        use asked::Request as _;
        let docs = &self.documents;
        let response = match request.method.as_str() {
            asked::HoverRequest::METHOD => reply(request, |p: lsp_types::HoverParams| {
                Ok(at(docs, &p.text_document_position_params, answers::hover))
            }),
            asked::Completion::METHOD => reply(request, |p: lsp_types::CompletionParams| {
                Ok(at(docs, &p.text_document_position, answers::completion))
            }),
            asked::GotoDefinition::METHOD => reply(request, |p: lsp_types::GotoDefinitionParams| {
                Ok(at(docs, &p.text_document_position_params, rename::definition))
            }),
            asked::References::METHOD => reply(request, |p: lsp_types::ReferenceParams| {
                let with_declaration = p.context.include_declaration;
                Ok(at(docs, &p.text_document_position, |docs, doc, offset| {
                    rename::references(docs, doc, offset, with_declaration)
                }))
            }),
            asked::DocumentHighlightRequest::METHOD => reply(request, |p: lsp_types::DocumentHighlightParams| {
                Ok(at(docs, &p.text_document_position_params, answers::highlights))
            }),
            asked::PrepareRenameRequest::METHOD => {
                reply(request, |p: TextDocumentPositionParams| Ok(at(docs, &p, rename::prepare)))
            }
            asked::Rename::METHOD => reply(request, |p: lsp_types::RenameParams| {
                at(docs, &p.text_document_position, |docs, doc, offset| {
                    Some(rename::rename(docs, doc, offset, &p.new_name))
                })
                .transpose()
            }),
            asked::DocumentSymbolRequest::METHOD => reply(request, |p: lsp_types::DocumentSymbolParams| {
                Ok(docs.get(&p.text_document.uri).map(|doc| answers::symbols(docs, doc)))
            }),
            asked::Formatting::METHOD => reply(request, |p: lsp_types::DocumentFormattingParams| {
                Ok(docs.get(&p.text_document.uri).and_then(|doc| answers::formatting(docs, doc)))
            }),
            asked::SemanticTokensFullRequest::METHOD => reply(request, |p: lsp_types::SemanticTokensParams| {
                Ok(docs.get(&p.text_document.uri).map(|doc| answers::tokens(docs, doc)))
            }),
            asked::CodeActionRequest::METHOD => reply(request, |p: lsp_types::CodeActionParams| {
                Ok(docs.get(&p.text_document.uri).map(|doc| answers::actions(docs, doc, p.range)))
            }),
            other => {
                let message = format!("vv does not know the request `{other}`");
                Response::new_err(request.id, ErrorCode::MethodNotFound as i32, message)
            }
        };
        self.send(Message::Response(response));
    }

    /// Tells the editor what is wrong now, in files where that is something else than before.
    fn publish(&mut self) {
        use told::Notification as _;
        self.stale = false;
        let mut now = answers::problems(&self.documents);
        for (uri, before) in &self.published {
            // Nothing is wrong there any more.
            now.entry(uri.clone()).or_insert_with(|| PublishDiagnosticsParams {
                uri: before.uri.clone(),
                diagnostics: Vec::new(),
                version: None,
            });
        }
        for (uri, problems) in &now {
            if self.published.get(uri) != Some(problems) {
                let method = told::PublishDiagnostics::METHOD.to_owned();
                self.send(Message::Notification(Notification::new(method, problems)));
            }
        }
        now.retain(|_, problems| !problems.diagnostics.is_empty() || problems.version.is_some());
        self.published = now;
    }

    /// Nothing can be done when the editor is gone; the next message that does not come ends the server.
    fn send(&self, message: Message) {
        let _ = self.connection.sender.send(message);
    }
}

/// What `ask` says about a place of an open document.
fn at<T>(
    documents: &Documents,
    place: &TextDocumentPositionParams,
    ask: impl FnOnce(&Documents, &documents::Document, usize) -> Option<T>,
) -> Option<T> {
    let document = documents.get(&place.text_document.uri)?;
    ask(documents, document, documents.encoding.offset(&document.text, place.position))
}

fn reply<P: DeserializeOwned, T: Serialize>(request: Request, answer: impl FnOnce(P) -> Answer<T>) -> Response {
    match serde_json::from_value(request.params) {
        Ok(params) => match answer(params) {
            Ok(result) => Response::new_ok(request.id, result),
            Err(message) => Response::new_err(request.id, ErrorCode::RequestFailed as i32, message),
        },
        Err(error) => Response::new_err(request.id, ErrorCode::InvalidParams as i32, error.to_string()),
    }
}
