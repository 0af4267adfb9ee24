//! What ships for other editors agrees with the language.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use serde_json::Value;

fn read(name: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/editors/vscode").join(name);
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

#[test]
fn the_grammar_knows_the_words_of_the_language() {
    let grammar = read("vv.tmLanguage.json");
    // Patterns that list words: `\b(one|other)\b`.
    let lists = grammar["patterns"].as_array().unwrap().iter().filter_map(|p| p["match"].as_str());
    let lists = lists.filter_map(|m| m.strip_prefix(r"\b(")?.strip_suffix(r")\b"));
    let known: BTreeSet<&str> = lists.flat_map(|list| list.split('|')).collect();
    let missing: Vec<&str> = vv::syntax::all_words().filter(|word| !known.contains(word)).collect();
    assert_eq!(missing, [""; 0]);
    let explained: BTreeSet<&str> = vv::assist::WORDS.iter().map(|word| word.word).collect();
    let more: BTreeSet<&str> = known.into_iter().filter(|w| !vv::syntax::all_words().any(|word| word == *w)).collect();
    let unknown: Vec<&&str> = more.iter().filter(|word| !explained.contains(**word) && **word != "tau").collect();
    assert!(unknown.is_empty(), "{unknown:?} are no words of the language");
}

#[test]
fn the_extension_names_files_that_are_there() {
    let package = read("package.json");
    assert_eq!(package["version"], env!("CARGO_PKG_VERSION"));
    let contributes = &package["contributes"];
    read(contributes["languages"][0]["configuration"].as_str().unwrap());
    assert_eq!(
        read(contributes["grammars"][0]["path"].as_str().unwrap())["scopeName"],
        contributes["grammars"][0]["scopeName"]
    );
}
