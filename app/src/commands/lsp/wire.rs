//! Messages on the wire: a header that says how long a message is, then the message.
//!
//! ```text
//!   Content-Length: 52\r\n
//!   \r\n
//!   {"jsonrpc": "2.0", …
//! ```
//!
//! What is announced is not believed before it is there: memory grows with what is sent, up to [`LONGEST`].

use std::io::{self, BufRead, Read as _};
use std::sync::mpsc;
use std::thread::{self, JoinHandle};

use app::files;
use crossbeam_channel::bounded;
use lsp_server::{Connection, Message};

/// Longest message, in bytes: the longest program, of letters that JSON writes in six.
const LONGEST: u64 = 6 * files::MAX_PROGRAM_BYTES + (1 << 20);

/// Longest header, in bytes.
const LONGEST_HEADER: u64 = 4096;

/// The threads that read stdin and write stdout.
pub struct Wire {
    trouble: mpsc::Receiver<String>,
    writer: JoinHandle<()>,
}

impl Wire {
    /// Begins to read stdin and to write stdout.
    ///
    /// # Errors
    /// If there can be no threads.
    pub fn open() -> io::Result<(Connection, Self)> {
        // Neither side runs ahead of the other.
        let (sender, outbox) = bounded::<Message>(0);
        let (inbox, receiver) = bounded::<Message>(0);
        let (tell, trouble) = mpsc::channel();
        let writer = thread::Builder::new().name("lsp writer".to_owned()).spawn(move || {
            let mut stdout = io::stdout().lock();
            let mut is_open = true;
            for message in outbox {
                // Nobody may listen any more: that ends when nobody speaks either.
                is_open = is_open && message.write(&mut stdout).is_ok();
            }
        })?;
        thread::Builder::new().name("lsp reader".to_owned()).spawn(move || {
            let mut stdin = io::stdin().lock();
            loop {
                match read(&mut stdin) {
                    Ok(Some(message)) => {
                        let is_exit = matches!(&message, Message::Notification(n) if n.method == "exit");
                        if inbox.send(message).is_err() || is_exit {
                            return;
                        }
                    }
                    Ok(None) => return,
                    Err(why) => {
                        // Before the inbox closes: who finds it closed looks here.
                        let _ = tell.send(why);
                        return;
                    }
                }
            }
        })?;
        Ok((Connection { sender, receiver }, Self { trouble, writer }))
    }

    /// Waits, when the connection is dropped, until all is written; says what could not be read, if that was the end.
    pub fn close(self) -> Option<String> {
        let _ = self.writer.join();
        self.trouble.try_recv().ok()
    }
}

/// The next message; `None` where nothing follows.
fn read(input: &mut impl BufRead) -> Result<Option<Message>, String> {
    let Some(length) = read_header(input)? else { return Ok(None) };
    let mut body = Vec::new();
    input.take(length).read_to_end(&mut body).map_err(|problem| files::sentence(&problem))?;
    if body.len() as u64 != length {
        return Err(format!("of a message of {length} bytes only {} came", body.len()));
    }
    let text = str::from_utf8(&body).map_err(|_| "a message is not in UTF-8".to_owned())?;
    serde_json::from_str(text).map(Some).map_err(|problem| format!("a message is no JSON of the protocol: {problem}"))
}

/// How long the message is that follows.
fn read_header(input: &mut impl BufRead) -> Result<Option<u64>, String> {
    let mut input = input.take(LONGEST_HEADER);
    let (mut length, mut is_first) = (None, true);
    loop {
        let mut line = Vec::new();
        input.read_until(b'\n', &mut line).map_err(|problem| files::sentence(&problem))?;
        if !line.ends_with(b"\n") {
            return match input.limit() {
                0 => Err(format!("a header has no end within {LONGEST_HEADER} bytes")),
                _ if is_first && line.is_empty() => Ok(None),
                _ => Err("the conversation ends within a header".to_owned()),
            };
        }
        is_first = false;
        let line = String::from_utf8_lossy(line.trim_ascii_end()).into_owned();
        if line.is_empty() {
            return length.map(Some).ok_or_else(|| "a header has no Content-Length".to_owned());
        }
        let Some((name, value)) = line.split_once(':') else {
            return Err(format!("`{line}` is no line of a header, such as `Content-Length: 52`"));
        };
        if name.eq_ignore_ascii_case("Content-Length") {
            let number = value.trim().parse().map_err(|_| format!("`{line}` announces no number of bytes"))?;
            if number > LONGEST {
                return Err(format!("`{line}` announces more than the {LONGEST} bytes that a message may have"));
            }
            length = Some(number);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lsp_server::Notification;

    #[track_caller]
    fn check(wire: &[u8], expected: Result<Option<&str>, &str>) {
        let got = read(&mut &*wire);
        let method = |message| match message {
            Message::Notification(Notification { method, .. }) => method,
            other => format!("{other:?}"),
        };
        let got = got.map(|message| message.map(method));
        match (&got, expected) {
            (Err(why), Err(start)) => assert!(why.starts_with(start), "{why}"),
            _ => assert_eq!(got, expected.map(|some| some.map(str::to_owned)).map_err(str::to_owned)),
        }
    }

    fn framed(body: &[u8]) -> Vec<u8> {
        [format!("Content-Length: {}\r\n\r\n", body.len()).as_bytes(), body].concat()
    }

    #[test]
    fn a_message_is_as_long_as_its_header_says() {
        check(b"", Ok(None));
        check(&framed(br#"{"method": "exit"}"#), Ok(Some("exit")));
        check(b"Content-Type: any\r\ncontent-length:18\r\n\r\n{\"method\": \"exit\"}more", Ok(Some("exit")));
    }

    #[test]
    fn what_is_no_message_is_said_in_a_sentence() {
        check(b"hello\r\n\r\n", Err("`hello` is no line of a header"));
        check(b"A: b\r\n\r\n{}", Err("a header has no Content-Length"));
        check(b"Content-Length: 5", Err("the conversation ends within a header"));
        check(b"Content-Length: -5\r\n\r\n", Err("`Content-Length: -5` announces no number of bytes"));
        check(b"Content-Length: 9\r\n\r\n{}", Err("of a message of 9 bytes only 2 came"));
        check(b"Content-Length: 99000000000\r\n\r\n", Err("`Content-Length: 99000000000` announces more than"));
        check(&b"A: b\r\n".repeat(1 << 20), Err("a header has no end within 4096 bytes"));
        check(&b"a".repeat(1 << 20), Err("a header has no end within 4096 bytes"));
        check(&framed(b"\"\xff\""), Err("a message is not in UTF-8"));
        check(&framed(b"{"), Err("a message is no JSON of the protocol: EOF"));
        check(&framed(b"{}"), Err("a message is no JSON of the protocol"));
        let bomb = [b"{\"method\": \"x\", \"params\": ".to_vec(), b"[".repeat(1 << 20)].concat();
        check(&framed(&bomb), Err("a message is no JSON of the protocol: recursion limit exceeded"));
    }
}
