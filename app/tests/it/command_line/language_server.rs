//! `vv lsp`, spoken with as editors speak with it.

use std::io::{BufReader, Write as _};
use std::process::{Child, ChildStdin, Stdio};
use std::sync::mpsc::{self, Receiver};
use std::time::Duration;

use lsp_server::{Message, Notification, Request};
use serde_json::{Value, json};

use super::Folder;

/// An editor with a folder and a server.
struct Editor {
    folder: Folder,
    server: Child,
    to: Option<ChildStdin>,
    from: Receiver<Message>,
    requests: i32,
}

impl Editor {
    /// With these files on disk, counting in bytes.
    fn with(files: &[(&str, &str)]) -> Self {
        Self::counting("utf-8", files)
    }

    fn counting(encoding: &str, files: &[(&str, &str)]) -> Self {
        let folder = Folder::with(files);
        let mut command = folder.command("lsp --stdio");
        let mut server = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let (to, mut stdout) = (server.stdin.take(), BufReader::new(server.stdout.take().unwrap()));
        let (sender, from) = mpsc::channel();
        std::thread::spawn(move || {
            while let Ok(Some(message)) = Message::read(&mut stdout) {
                let _ = sender.send(message);
            }
        });
        let mut editor = Self { folder, server, to, from, requests: 0 };
        let capabilities = json!({ "general": { "positionEncodings": [encoding, "utf-16"] } });
        let answer =
            editor.ask("initialize", json!({ "processId": null, "rootUri": null, "capabilities": capabilities }));
        assert_eq!(answer["capabilities"]["positionEncoding"], encoding);
        editor.tell("initialized", json!({}));
        editor
    }

    fn uri(&self, name: &str) -> String {
        format!("file://{}", self.folder.0.path().canonicalize().unwrap().join(name).display())
    }

    fn tell(&mut self, method: &str, params: Value) {
        let message = Message::Notification(Notification::new(method.to_owned(), params));
        message.write(self.to.as_mut().unwrap()).unwrap();
    }

    /// What the server says next.
    #[track_caller]
    fn hear(&self) -> Message {
        self.from.recv_timeout(Duration::from_secs(60)).expect("the server says something")
    }

    /// The answer; what the server tells meanwhile is passed over.
    fn try_to_ask(&mut self, method: &str, params: Value) -> Result<Value, String> {
        self.requests += 1;
        let id = self.requests.into();
        let request = Request::new(self.requests.into(), method.to_owned(), params);
        Message::Request(request).write(self.to.as_mut().unwrap()).unwrap();
        loop {
            match self.hear() {
                Message::Response(response) if response.id == id => {
                    let response = serde_json::to_value(response).unwrap();
                    return match response.get("error") {
                        Some(error) => Err(error["message"].as_str().unwrap().to_owned()),
                        None => Ok(response["result"].clone()),
                    };
                }
                _ => {}
            }
        }
    }

    #[track_caller]
    fn ask(&mut self, method: &str, params: Value) -> Value {
        self.try_to_ask(method, params).unwrap()
    }

    /// Opens a file that is on disk.
    fn open(&mut self, name: &str) {
        let (uri, text) = (self.uri(name), self.folder.read(name));
        self.tell(
            "textDocument/didOpen",
            json!({ "textDocument": { "uri": uri, "languageId": "vv", "version": 1, "text": text } }),
        );
    }

    fn change(&mut self, name: &str, changes: Value) {
        let uri = self.uri(name);
        let document = json!({ "uri": uri, "version": 2 });
        self.tell("textDocument/didChange", json!({ "textDocument": document, "contentChanges": changes }));
    }

    /// What the server tells next about a file: line from 1, severity, message.
    fn problems(&mut self, name: &str) -> Vec<String> {
        let uri = self.uri(name);
        loop {
            let Message::Notification(Notification { method, params, .. }) = self.hear() else { continue };
            if method == "textDocument/publishDiagnostics" && params["uri"] == uri {
                let all = params["diagnostics"].as_array().unwrap().iter();
                let line = |d: &Value| d["range"]["start"]["line"].as_u64().unwrap() + 1;
                return all.map(|d| format!("{}: {}", line(d), d["message"].as_str().unwrap())).collect();
            }
        }
    }

    /// Asks about the place of `¦` in a file that is open, which stands in `at` of its text.
    #[track_caller]
    fn at(&mut self, method: &str, name: &str, at: &str, more: Value) -> Result<Value, String> {
        let text = self.folder.read(name);
        let offset = text.find(&at.replace('¦', "")).expect("in the text") + at.find('¦').expect("a place");
        let before = &text[..offset];
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        let mut params = json!({
            "textDocument": { "uri": self.uri(name) },
            "position": { "line": before.matches('\n').count(), "character": offset - line_start },
        });
        params.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        self.try_to_ask(method, params)
    }

    /// `file:line:column` of the places in an answer.
    fn places(&self, answer: &Value) -> Vec<String> {
        let place = |location: &Value| {
            let file = location["uri"].as_str().unwrap_or_default().rsplit('/').next().unwrap().to_owned();
            format!("{file}:{}", start(&location["range"]))
        };
        answer.as_array().unwrap().iter().map(place).collect()
    }

    /// Ends it as editors do.
    fn end(mut self) {
        self.ask("shutdown", Value::Null);
        self.tell("exit", Value::Null);
        self.to = None;
        let ended = self.server.wait_with_output().unwrap();
        assert_eq!((ended.status.code(), String::from_utf8_lossy(&ended.stderr).as_ref()), (Some(0), ""));
    }
}

fn start(range: &Value) -> String {
    format!("{}:{}", range["start"]["line"].as_u64().unwrap() + 1, range["start"]["character"].as_u64().unwrap() + 1)
}

const LIFT: &str = "\
// How far.
param double lift = 0.5;
vertex { double heat = 0; };
// Raises a vertex.
void raise(vertex v) {
  v$pos.z += lift;
}
";
const STEP: &str = "\
#include \"lift.vv\"
void step(mesh& S) {
  forall v in S {
    raise(v);
    v$heat = lift;
  }
}
";

fn editor() -> Editor {
    let mut editor = Editor::with(&[("lift.vv", LIFT), ("step.vv", STEP)]);
    editor.open("lift.vv");
    editor.open("step.vv");
    editor
}

#[test]
fn problems_are_told_as_one_types() {
    let mut editor = editor();
    assert_eq!(editor.problems("step.vv"), [""; 0]);
    // `raise(v)` becomes `raize(v)`.
    let range = json!({ "start": { "line": 3, "character": 7 }, "end": { "line": 3, "character": 8 } });
    editor.change("step.vv", json!([{ "range": range, "text": "z" }]));
    let problems = editor.problems("step.vv");
    assert_eq!(problems.len(), 1, "{problems:?}");
    assert!(problems[0].starts_with("4: there is no function `raize`"), "{problems:?}");
    assert!(problems[0].contains("hint: "), "{problems:?}");

    // What is proposed can be done.
    let range = json!({ "start": { "line": 3, "character": 5 }, "end": { "line": 3, "character": 5 } });
    let document = json!({ "uri": editor.uri("step.vv") });
    let params = json!({ "textDocument": document, "range": range, "context": { "diagnostics": [] } });
    let actions = editor.ask("textDocument/codeAction", params);
    let edit = &actions[0]["edit"]["changes"][editor.uri("step.vv")][0];
    assert_eq!((actions[0]["kind"].as_str(), edit["newText"].as_str()), (Some("quickfix"), Some("raise")));
    editor.change("step.vv", json!([{ "range": edit["range"], "text": edit["newText"] }]));
    assert_eq!(editor.problems("step.vv"), [""; 0]);
    editor.end();
}

#[test]
fn problems_of_an_included_file_follow_its_unsaved_text() {
    let mut editor = editor();
    assert_eq!(editor.problems("step.vv"), [""; 0]);
    editor.change("lift.vv", json!([{ "text": "param double lift = 0.5;\n" }]));
    assert_eq!(editor.problems("step.vv").len(), 2, "neither `raise` nor `heat`");
    let uri = editor.uri("lift.vv");
    editor.tell("textDocument/didClose", json!({ "textDocument": { "uri": uri } }));
    assert_eq!(editor.problems("step.vv"), [""; 0], "on disk all is well");
    editor.end();
}

#[test]
fn problems_in_a_file_that_is_not_open_are_told_there() {
    let mut editor = Editor::with(&[("lift.vv", "param double lift = nothing;\n"), ("step.vv", STEP)]);
    editor.open("step.vv");
    assert_eq!(editor.problems("lift.vv").len(), 1);
    let uri = editor.uri("step.vv");
    editor.tell("textDocument/didClose", json!({ "textDocument": { "uri": uri } }));
    assert_eq!(editor.problems("lift.vv"), [""; 0], "nobody asks any more");
    editor.end();
}

#[test]
fn words_are_explained_under_the_pointer() {
    let mut editor = editor();
    let hover = editor.at("textDocument/hover", "step.vv", "ra¦ise", json!({})).unwrap();
    assert_eq!(hover["contents"]["value"], "```vv\nvoid raise(vertex v)\n```\n\nRaises a vertex.");
    assert_eq!(start(&hover["range"]), "4:5");
    let hover = editor.at("textDocument/hover", "step.vv", "for¦all", json!({})).unwrap();
    assert!(hover["contents"]["value"].as_str().unwrap().contains("forall"), "{hover}");
    assert_eq!(editor.at("textDocument/hover", "step.vv", "{¦\n", json!({})).unwrap(), Value::Null);
    editor.end();
}

#[test]
fn what_can_stand_somewhere_is_offered() {
    let mut editor = editor();
    let mut labels = |at| {
        let list = editor.at("textDocument/completion", "step.vv", at, json!({})).unwrap();
        let items = list.as_array().unwrap().clone();
        items.iter().map(|i| i["label"].as_str().unwrap().to_owned()).collect::<Vec<_>>()
    };
    assert_eq!(labels("v$¦heat"), ["pos", "heat"]);
    assert_eq!(labels("ra¦ise"), ["raise", "random"]);
    let list = editor.at("textDocument/completion", "step.vv", "ra¦ise", json!({})).unwrap();
    assert_eq!(list[0]["textEdit"]["newText"], "raise(");
    assert_eq!(start(&list[0]["textEdit"]["range"]), "4:5");
    let list = editor.at("textDocument/completion", "step.vv", "raise¦(", json!({})).unwrap();
    assert_eq!(list, json!([]), "it is written out");
    editor.end();
    let mut editor = Editor::with(&[("called.vv", "void step(mesh& S) { forall v in S v$pos *= co(1.0); }\n")]);
    editor.open("called.vv");
    let list = editor.at("textDocument/completion", "called.vv", "co¦(", json!({})).unwrap();
    assert_eq!(list[0]["textEdit"]["newText"], "cos", "it is called already");
    editor.end();
}

#[test]
fn names_lead_to_their_declarations() {
    let mut editor = editor();
    let mut leads = |at, to: &str| {
        let answer = editor.at("textDocument/definition", "step.vv", at, json!({})).unwrap();
        assert_eq!(editor.places(&answer), [to], "{at}");
    };
    leads("ra¦ise", "lift.vv:5:6");
    leads("v$he¦at", "lift.vv:3:17");
    leads("v¦$heat", "step.vv:3:10");
    let file = editor.at("textDocument/definition", "step.vv", "\"li¦ft", json!({})).unwrap();
    assert_eq!(file["uri"], editor.uri("lift.vv"));
    assert_eq!(editor.at("textDocument/definition", "step.vv", "for¦all", json!({})).unwrap(), Value::Null);
    editor.end();
}

#[test]
fn uses_are_found_in_all_files() {
    let mut editor = editor();
    let found = |editor: &mut Editor, declaration: bool| {
        let context = json!({ "context": { "includeDeclaration": declaration } });
        let answer = editor.at("textDocument/references", "lift.vv", "li¦ft =", context).unwrap();
        editor.places(&answer)
    };
    assert_eq!(found(&mut editor, true), ["lift.vv:2:14", "lift.vv:6:14", "step.vv:5:14"]);
    assert_eq!(found(&mut editor, false), ["lift.vv:6:14", "step.vv:5:14"]);
    let marked = editor.at("textDocument/documentHighlight", "step.vv", "forall ¦v", json!({})).unwrap();
    let marked: Vec<_> = marked.as_array().unwrap().iter().map(|m| start(&m["range"])).collect();
    assert_eq!(marked, ["3:10", "4:11", "5:5"]);
    editor.end();
}

#[test]
fn a_name_is_changed_wherever_it_means_the_same() {
    let mut editor = editor();
    let name = editor.at("textDocument/prepareRename", "step.vv", "= li¦ft", json!({})).unwrap();
    assert_eq!((name["placeholder"].as_str(), start(&name["range"]).as_str()), (Some("lift"), "5:14"));
    let edit = editor.at("textDocument/rename", "step.vv", "= li¦ft", json!({ "newName": "height" })).unwrap();
    let (lift, step) = (editor.uri("lift.vv"), editor.uri("step.vv"));
    let starts = |uri: &str| {
        let edits = edit["changes"][uri].as_array().unwrap().clone();
        assert!(edits.iter().all(|e| e["newText"] == "height"));
        edits.iter().map(|e| start(&e["range"])).collect::<Vec<_>>()
    };
    assert_eq!((starts(&lift), starts(&step)), (vec!["2:14".into(), "6:14".into()], vec!["5:14".into()]));

    let mut refused =
        |at, to: &str| editor.at("textDocument/rename", "step.vv", at, json!({ "newName": to })).unwrap_err();
    assert_eq!(refused("= li¦ft", "v"), "`v` would mean something else: it is in use already");
    assert_eq!(refused("= li¦ft", "for"), "`for` cannot be a name");
    assert_eq!(refused("= li¦ft", "2x"), "`2x` cannot be a name");
    assert_eq!(refused("for¦all", "x"), "there is no name here that could be changed");
    editor.end();
}

#[test]
fn what_ships_with_vv_keeps_its_names() {
    let program = "#include \"insert.vv\"\nvoid step(mesh& S) { forall p in S forall q in p insert(p, q); }\n";
    let mut editor = Editor::with(&[("mine.vv", program)]);
    editor.open("mine.vv");
    let refused = editor.at("textDocument/rename", "mine.vv", "q in p ins¦ert", json!({ "newName": "x" })).unwrap_err();
    assert_eq!(refused, "`insert` stands in `<vv>/insert.vv`, which ships with vv");
    assert_eq!(editor.at("textDocument/prepareRename", "mine.vv", "q in p ins¦ert", json!({})).unwrap(), Value::Null);
    editor.end();
}

#[test]
fn a_document_is_laid_out_listed_and_coloured() {
    let mut editor =
        Editor::with(&[("a.vv", "const int n=1; /* two\nlines */\nvertex { int a,b; };\nvoid f(){\nint τ=n;}\n")]);
    editor.open("a.vv");
    let document = json!({ "uri": editor.uri("a.vv") });
    let options = json!({ "tabSize": 2, "insertSpaces": true });
    let edit = editor.ask("textDocument/formatting", json!({ "textDocument": document, "options": options }));
    assert!(edit[0]["newText"].as_str().unwrap().contains("const int n = 1;"), "{edit}");

    let symbols = editor.ask("textDocument/documentSymbol", json!({ "textDocument": document }));
    let name = |s: &Value| s["name"].as_str().unwrap().to_owned();
    assert_eq!(symbols.as_array().unwrap().iter().map(name).collect::<Vec<_>>(), ["n", "vertex", "f"]);
    assert_eq!(symbols[1]["children"].as_array().unwrap().iter().map(name).collect::<Vec<_>>(), ["a", "b"]);
    assert_eq!(symbols[2]["detail"], "void f()");

    let tokens = editor.ask("textDocument/semanticTokens/full", json!({ "textDocument": document }));
    let data: Vec<u64> = tokens["data"].as_array().unwrap().iter().map(|n| n.as_u64().unwrap()).collect();
    let (mut line, mut column, mut seen) = (0, 0, Vec::new());
    for token in data.chunks(5) {
        column = if token[0] > 0 { token[1] } else { column + token[1] };
        line += token[0];
        seen.push((line, column, token[2]));
    }
    // const int n 1 comment comment vertex int a b void f int τ n
    let expected = [
        (0, 0, 5),
        (0, 6, 3),
        (0, 10, 1),
        (0, 12, 1),
        (0, 15, 6),
        (1, 0, 8),
        (2, 0, 6),
        (2, 9, 3),
        (2, 13, 1),
        (2, 15, 1),
        (3, 0, 4),
        (3, 5, 1),
        (4, 0, 3),
        (4, 4, 2),
        (4, 7, 1),
    ];
    assert_eq!(seen, expected);
    editor.end();
}

#[test]
fn editors_that_count_in_utf_16_are_served() {
    let mut editor = Editor::counting("utf-16", &[("a.vv", "/* 𝄞τ */ param double up = 1;\n")]);
    editor.open("a.vv");
    let document = json!({ "uri": editor.uri("a.vv") });
    let symbols = editor.ask("textDocument/documentSymbol", json!({ "textDocument": document }));
    assert_eq!(start(&symbols[0]["selectionRange"]), "1:24");
    editor.end();
}

#[test]
fn what_is_not_understood_is_answered_and_survived() {
    let mut editor = editor();
    let refused = editor.try_to_ask("textDocument/moon", json!({})).unwrap_err();
    assert_eq!(refused, "vv does not know the request `textDocument/moon`");
    assert!(editor.try_to_ask("textDocument/hover", json!({ "position": 1 })).is_err());
    editor.change("nothing.vv", json!([{ "text": "" }]));
    let beyond = json!({ "start": { "line": 99, "character": 9 }, "end": { "line": 0, "character": 0 } });
    editor.change("step.vv", json!([{ "range": beyond, "text": "" }]));
    let hover = editor.at("textDocument/hover", "step.vv", "ra¦ise", json!({})).unwrap();
    assert_eq!(start(&hover["range"]), "4:5");
    editor.end();
}

#[test]
fn an_editor_that_is_gone_ends_the_server() {
    let mut editor = editor();
    editor.to = None;
    assert_eq!(editor.server.wait().unwrap().code(), Some(0));
}

#[test]
fn somebody_who_speaks_something_else_is_told() {
    let folder = Folder::with(&[]);
    for (said, why) in [
        ("hello\r\n\r\n", "`hello` is no line of a header"),
        ("Content-Length: 99000000000\r\n\r\n{", "`Content-Length: 99000000000` announces more than"),
        ("Content-Length: 17\r\n\r\n{\"method\":\"exit\"}", "expected initialize request"),
        (
            "Content-Length: 43\r\n\r\n{\"id\":1,\"method\":\"initialize\",\"params\":3}   ",
            "the parameters of `initialize` cannot be read",
        ),
    ] {
        let ended = folder.run_with_stdin("lsp", said);
        assert_eq!(ended.code, Some(3), "{said}: {}", ended.stderr);
        assert!(ended.stderr.contains(&format!("the editor is not understood: {why}")), "{said}: {}", ended.stderr);
    }
}

/// An editor that waits for an answer keeps stdin open.
#[test]
fn somebody_who_speaks_something_else_is_told_at_once() {
    let folder = Folder::with(&[]);
    let mut command = folder.command("lsp");
    let mut server = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut stdin = server.stdin.take().unwrap();
    let _ = stdin.write_all(b"Content-Length: 40\r\n\r\n{\"id\":1,\"method\":\"initialize\",\"params\":3}");
    assert_eq!(server.wait_with_output().unwrap().status.code(), Some(3));
    drop(stdin);
}
