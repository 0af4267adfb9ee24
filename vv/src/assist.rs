//! Help for whoever writes a program: what can stand here, what a word means, where brackets and numbers are.
//!
//! Knows the text only, and that of the files it includes; half-written text is understood as far as it goes. Editors and
//! language servers ask it; places are byte offsets.

mod number;
mod symbols;
mod words;

use std::ops::Range;
use std::sync::Arc;

use crate::builtins::{Builtin, NUMBERS};
use crate::source::FileId;
use crate::syntax::tree::Element;
use crate::syntax::{TokenClass, highlight, parse};

pub use number::{Number, number_at};
pub use symbols::{Symbol, SymbolKind, block_comment, comment_before};
pub use words::{WORDS, Word};

/// What is known of a text.
#[derive(Debug, Clone)]
pub struct Assist {
    text: Arc<str>,
    tokens: Vec<(Range<usize>, TokenClass)>,
    symbols: Vec<Symbol>,
}

/// Something that can stand at a place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Completion {
    /// What is shown.
    pub label: String,
    /// What is written: the label, for functions with their parenthesis.
    pub insert: String,
    /// What it is.
    pub class: TokenClass,
    /// Its declaration, or how it is used.
    pub usage: String,
    /// What it means.
    pub doc: String,
}

/// What can stand at a place.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Completions {
    /// What has been written of it.
    pub replaces: Range<usize>,
    /// The most likely ones first.
    pub entries: Vec<Completion>,
}

/// What a word means.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Meaning {
    /// The word.
    pub range: Range<usize>,
    /// Its declaration, or how it is used; a function of several signatures has a line for each.
    pub usage: String,
    /// What it means; may be empty.
    pub doc: String,
}

impl Assist {
    /// Reads a text and those that it includes. Linear in their length.
    #[must_use]
    pub fn new<'t>(text: impl Into<Arc<str>>, included: impl IntoIterator<Item = &'t str>) -> Self {
        let text = text.into();
        let mut symbols = symbols::of(&parse(FileId::MAIN, &text).0, &text);
        for other in included {
            // Of other files only what can be named from here.
            let all = symbols::of(&parse(FileId::MAIN, other).0, other);
            symbols.extend(all.into_iter().filter(|s| s.scope.is_none()).map(|s| Symbol { place: None, ..s }));
        }
        Self { tokens: highlight(&text), text, symbols }
    }

    /// The text it was made of.
    #[must_use]
    pub fn text(&self) -> &Arc<str> {
        &self.text
    }

    /// What it declares itself, in its order.
    pub fn declared(&self) -> impl Iterator<Item = &Symbol> {
        self.symbols.iter().filter(|s| s.place.is_some())
    }

    /// What can stand where `at` is, beginning with what stands before it.
    #[must_use]
    pub fn complete(&self, at: usize) -> Completions {
        let before = self.text.get(..at).unwrap_or_default();
        let start = before
            .rfind(|c: char| c != '_' && !c.is_alphanumeric())
            .map_or(0, |i| i + before[i..].chars().next().map_or(1, char::len_utf8));
        let written = &before[start..];
        let is_text = |class| matches!(class, TokenClass::Comment | TokenClass::Text | TokenClass::Directive);
        let inside = |r: &Range<usize>| {
            r.start < at && (at < r.end || at == r.end && !self.text[r.clone()].ends_with(['"', '/']))
        };
        if self.tokens.iter().any(|(r, class)| is_text(*class) && inside(r))
            || written.starts_with(|c: char| c.is_ascii_digit())
        {
            return Completions::default();
        }
        let leading = before[..start].trim_end();
        let mut entries: Vec<Completion> = match leading.chars().next_back() {
            Some('$') => self.properties(leading),
            Some('.') if !leading[..leading.len() - 1].ends_with(|c: char| c.is_ascii_digit()) => coordinates(),
            _ => self.words(start, leading),
        };
        let low = written.to_lowercase();
        entries.retain(|e| e.label.to_lowercase().starts_with(&low));
        // What is written out already changes nothing.
        entries.sort_by_key(|e| e.label != written);
        if entries.len() == 1 && entries[0].label == written {
            entries.clear();
        }
        Completions { replaces: start..at, entries }
    }

    /// What the word at a place means.
    #[must_use]
    pub fn meaning(&self, at: usize) -> Option<Meaning> {
        let mut i = self.tokens.iter().position(|(range, _)| range.start <= at && at < range.end)?;
        if &self.text[self.tokens[i].0.clone()] == "$" {
            i += 1;
        }
        let (range, class) = self.tokens.get(i)?.clone();
        let word = &self.text[range.clone()];
        if let Some(symbol) = self.symbol(i) {
            return Some(Meaning { range, usage: symbol.usage.clone(), doc: symbol.doc.clone() });
        }
        let meaning = |usage: String, doc: &str| Some(Meaning { range: range.clone(), usage, doc: doc.to_owned() });
        let known = |word: &str| words::find(word).and_then(|w| meaning(w.usage.to_owned(), w.doc));
        let number = |word: &str| {
            let n = NUMBERS.iter().find(|n| n.name == word)?;
            meaning(format!("double {} = {}", n.name, n.value), n.doc)
        };
        match class {
            TokenClass::Keyword | TokenClass::Algebra | TokenClass::Type | TokenClass::Directive => known(word),
            TokenClass::Old => known("`"),
            TokenClass::Literal => known(word).or_else(|| number(word)),
            TokenClass::Property if word == "pos" => known("$pos"),
            TokenClass::Function => {
                let signatures: Vec<String> = Builtin::named(word).map(|b| b.to_string()).collect();
                meaning(signatures.join("\n"), Builtin::named(word).next()?.doc())
            }
            TokenClass::Name => number(word),
            _ => None,
        }
    }

    /// What the name at a place, or right before it, stands for: its own stretch of the text, and its declaration, which
    /// may be in an included file.
    #[must_use]
    pub fn symbol_at(&self, at: usize) -> Option<(Range<usize>, &Symbol)> {
        // The name behind the place is meant first.
        let touching = |i: &usize| self.tokens[*i].0.start <= at && at <= self.tokens[*i].0.end;
        let (i, symbol) = (0..self.tokens.len()).rev().filter(touching).find_map(|i| Some((i, self.symbol(i)?)))?;
        Some((self.tokens[i].0.clone(), symbol))
    }

    /// Where the name at a place is declared, if it is in this text.
    #[must_use]
    pub fn declaration(&self, at: usize) -> Option<Range<usize>> {
        self.symbol_at(at)?.1.place.clone()
    }

    /// Wherever a symbol of this text, or of one that it includes, is named in this text, its declarations among them.
    /// Functions of one name count as one. Linear in the text for each of its names.
    #[must_use]
    pub fn uses(&self, symbol: &Symbol) -> Vec<Range<usize>> {
        let is_it = |i: &usize| self.text[self.tokens[*i].0.clone()] == symbol.name;
        let means_it = |i: &usize| self.symbol(*i).is_some_and(|s| s.is_same(symbol));
        (0..self.tokens.len()).filter(is_it).filter(means_it).map(|i| self.tokens[i].0.clone()).collect()
    }

    /// The bracket at a place, right before or behind it, and the one that belongs to it; both alike if there is none.
    #[must_use]
    pub fn brackets(&self, at: usize) -> Option<[Range<usize>; 2]> {
        let mut open: Vec<(&str, Range<usize>)> = Vec::new();
        let mut found: Option<[Range<usize>; 2]> = None;
        let touches = |range: &Range<usize>| range.start == at || range.end == at;
        let mut take = |pair: [Range<usize>; 2]| {
            // The bracket behind the cursor is meant first.
            let better = found.as_ref().is_none_or(|_| pair.iter().any(|r| r.start == at));
            if pair.iter().any(touches) && better {
                found = Some(pair);
            }
        };
        for (range, class) in &self.tokens {
            if *class != TokenClass::Punctuation {
                continue;
            }
            let sign = &self.text[range.clone()];
            match sign {
                "(" | "[" | "{" => open.push((sign, range.clone())),
                ")" | "]" | "}" => match open.pop() {
                    Some((opening, start)) if matches!((opening, sign), ("(", ")") | ("[", "]") | ("{", "}")) => {
                        take([start, range.clone()]);
                    }
                    other => {
                        open.extend(other);
                        take([range.clone(), range.clone()]);
                    }
                },
                _ => {}
            }
        }
        for (_, range) in open {
            take([range.clone(), range]);
        }
        found
    }

    /// What a token stands for, if it is a name with a declaration.
    fn symbol(&self, token: usize) -> Option<&Symbol> {
        let (range, class) = self.tokens.get(token)?;
        if let Some(declared) = self.symbols.iter().find(|s| s.place.as_ref() == Some(range)) {
            return Some(declared);
        }
        let before = token.checked_sub(1).map(|i| self.tokens[i].0.clone());
        let word = &self.text[range.clone()];
        match class {
            TokenClass::Property => {
                let kind = SymbolKind::Property(self.element(self.text[..before?.start].trim_end()));
                self.symbols.iter().find(|s| s.kind == kind && s.name == word)
            }
            // A coordinate.
            TokenClass::Name if before.is_some_and(|before| &self.text[before] == ".") => None,
            TokenClass::Name | TokenClass::Function => self.named(word, range.start),
            _ => None,
        }
    }

    /// What a name stands for at a place: the innermost declaration.
    fn named(&self, name: &str, at: usize) -> Option<&Symbol> {
        let visible = self.symbols.iter().filter(|s| s.name == name && !s.is_property() && s.is_visible(at));
        visible.min_by_key(|s| s.scope.as_ref().map_or(usize::MAX, Range::len))
    }

    /// The properties of what stands before the `$`.
    fn properties(&self, leading: &str) -> Vec<Completion> {
        let element = self.element(leading.strip_suffix('$').unwrap_or_default().trim_end());
        let mut entries = Vec::new();
        if element == Element::Vertex
            && let Some(position) = words::find("$pos")
        {
            entries.push(Completion::of_word(position, "pos", TokenClass::Property));
        }
        let declared = self.symbols.iter().filter(|s| s.kind == SymbolKind::Property(element));
        entries.extend(declared.map(|s| Completion::of_symbol(s, TokenClass::Property)));
        entries
    }

    /// What kind of thing an expression that ends a text stands for.
    fn element(&self, of: &str) -> Element {
        let word = of.rsplit(|c: char| c != '_' && !c.is_alphanumeric()).next().unwrap_or_default();
        let is_edge = of.ends_with(')') && of.rsplit('(').next().is_some_and(|inside| inside.contains('|'));
        let is_mesh = self.named(word, of.len()).is_some_and(|s| s.is_mesh);
        if is_edge {
            Element::Edge
        } else if is_mesh {
            Element::Mesh
        } else {
            Element::Vertex
        }
    }

    /// Names, functions and words, where one of them begins at `start`.
    fn words(&self, start: usize, leading: &str) -> Vec<Completion> {
        let last =
            self.tokens.iter().rev().find(|(range, class)| range.end <= leading.len() && *class != TokenClass::Comment);
        let begins = match last {
            None => true,
            Some((range, _)) => {
                matches!(
                    &self.text[range.clone()],
                    ";" | "{" | "}" | ")" | "else" | "do" | "static" | "const" | "param"
                )
            }
        };
        let mut entries: Vec<Completion> = Vec::new();
        let mut locals: Vec<&Symbol> =
            self.symbols.iter().filter(|s| !s.is_property() && s.is_visible(start)).collect();
        // The nearest first; of one name only that.
        locals.sort_by_key(|s| (s.scope.is_none(), s.scope.as_ref().map_or(0, Range::len), s.name.clone()));
        for symbol in locals {
            if !entries.iter().any(|e| e.label == symbol.name) {
                let class = if symbol.kind == SymbolKind::Function { TokenClass::Function } else { TokenClass::Name };
                entries.push(Completion::of_symbol(symbol, class));
            }
        }
        for word in WORDS.iter().filter(|w| w.word.starts_with(char::is_alphabetic)) {
            if begins || !word.begins_statement {
                entries.push(Completion::of_word(word, word.word, word.class));
            }
        }
        entries.extend(NUMBERS.iter().map(|n| Completion {
            label: n.name.to_owned(),
            insert: n.name.to_owned(),
            class: TokenClass::Literal,
            usage: format!("double {} = {}", n.name, n.value),
            doc: n.doc.to_owned(),
        }));
        let explained: Vec<&str> = WORDS.iter().map(|w| w.word).collect();
        for builtin in Builtin::all().filter(|b| !explained.contains(&b.name())) {
            // Those of one name stand together.
            match entries.last_mut().filter(|e| e.label == builtin.name()) {
                Some(entry) => {
                    entry.usage.push('\n');
                    entry.usage.push_str(&builtin.to_string());
                }
                None => entries.push(Completion {
                    label: builtin.name().to_owned(),
                    insert: format!("{}(", builtin.name()),
                    class: TokenClass::Function,
                    usage: builtin.to_string(),
                    doc: builtin.doc().to_owned(),
                }),
            }
        }
        entries
    }
}

impl Completion {
    fn of_symbol(symbol: &Symbol, class: TokenClass) -> Self {
        let label = symbol.name.clone();
        let insert = match symbol.kind {
            SymbolKind::Function => format!("{label}("),
            _ => label.clone(),
        };
        Self { label, insert, class, usage: symbol.usage.clone(), doc: symbol.doc.clone() }
    }

    fn of_word(word: &Word, label: &str, class: TokenClass) -> Self {
        let label = label.to_owned();
        Self { insert: label.clone(), label, class, usage: word.usage.to_owned(), doc: word.doc.to_owned() }
    }
}

fn coordinates() -> Vec<Completion> {
    let coordinate = |name: &str| Completion {
        label: name.to_owned(),
        insert: name.to_owned(),
        class: TokenClass::Property,
        usage: format!("double v.{name}"),
        doc: "a coordinate of a vector; can be assigned".to_owned(),
    };
    ["x", "y", "z"].map(coordinate).into()
}

#[cfg(test)]
mod tests;
