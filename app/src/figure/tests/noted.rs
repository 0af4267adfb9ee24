//! What is written on figures.

use super::super::notes::Missing;
use super::*;
use crate::annotate::Label;
use vv::mesh::Vertex;

/// All that is written, kind by kind.
fn written_on(drawing: &Drawing) -> Vec<(&'static str, String)> {
    let of = |layer: &Layer| match layer {
        Layer::Text { name, words, .. } => words.iter().map(|line| (*name, line.text.clone())).collect(),
        _ => Vec::new(),
    };
    drawing.layers.iter().flat_map(of).collect()
}

fn drawn(obj: &str, notes: &Notes, settings: &Settings) -> Drawing {
    let case = Case::new(obj);
    draw(case.subject(notes), &case.camera(false), 1.0, &Style::default(), settings, &Stop::new()).unwrap().unwrap()
}

#[track_caller]
fn check(obj: &str, notes: Notes, expected: &[&str]) {
    let written = written_on(&drawn(obj, &notes, &Settings::default()));
    let texts: Vec<String> = written.iter().map(|(name, text)| format!("{name}: {text}")).collect();
    assert_eq!(texts, expected);
}

fn labelled(labels: Label) -> Notes {
    Notes { labels, ..Notes::default() }
}

fn ring(vertex: usize, labels: Label) -> Notes {
    Notes { labels, rings: vec![Vertex::from_index(vertex - 1).unwrap()] }
}

#[test]
fn vertices_are_named_but_for_the_hidden_one() {
    // Seen from the right, above and before it: v1 is at the left, below and behind.
    let names = ["v2", "v3", "v4", "v5", "v6", "v7", "v8"].map(|name| format!("labels: {name}"));
    check(CUBE, labelled(Label::Vertices), &names.each_ref().map(String::as_str));
    check(CUBE, labelled(Label::Degrees), &["labels: 4"; 3]);
    check(CUBE, labelled(Label::Property("heat".to_owned())), &[]);
}

#[test]
fn a_number_in_a_concave_face_stands_inside() {
    let drawing = drawn(L, &labelled(Label::Degrees), &Settings::default());
    assert_eq!(written_on(&drawing).iter().filter(|(_, text)| text == "6").count(), 1);
    assert_eq!(written_on(&drawing).iter().filter(|(_, text)| text == "4").count(), 4);
}

#[test]
fn a_ring_is_numbered_in_its_order_as_far_as_it_is_seen() {
    check(CUBE, ring(7, Label::Nothing), &["order: 1", "order: 2", "order: 3"]);
    check(CUBE, ring(1, Label::Nothing), &[]);
    let case = Case::new(CUBE);
    let of = |v: Vertex| case.mesh.ring(v).vertices().map(|u| u.to_string()).collect::<Vec<_>>();
    let order = of(Vertex::from_index(6).unwrap());
    let drawing = drawn(CUBE, &ring(7, Label::Vertices), &Settings::default());
    let written = written_on(&drawing);
    let numbered: Vec<&str> = written.iter().filter_map(|(_, text)| text.split(" – ").nth(1)).collect();
    assert_eq!(numbered, order);
    // Each vertex has one name.
    let mut names: Vec<&str> = written.iter().map(|(_, text)| text.rsplit(' ').next().unwrap()).collect();
    names.sort_unstable();
    assert_eq!(names, ["v2", "v3", "v4", "v5", "v6", "v7", "v8"]);
    let arrows = |layer: &&Layer| matches!(layer, Layer::Lines { name: "rings", paths, .. } if paths.len() == 6);
    assert_eq!(drawing.layers.iter().filter(arrows).count(), 1, "three arrows and their heads");
}

#[test]
fn text_lies_on_the_page_and_does_not_overlap() {
    for letters in [4.0, 7.0, 20.0, 60.0] {
        let settings = Settings { letters, ..Settings::default() };
        let drawing = drawn(&tori(0.55), &labelled(Label::Vertices), &settings);
        let rows: Vec<[At; 2]> = drawing
            .layers
            .iter()
            .filter_map(|layer| match layer {
                Layer::Text { words, .. } => Some(words),
                _ => None,
            })
            .flatten()
            .map(|line| [line.glyphs[0].1, line.glyphs[line.glyphs.len() - 1].1])
            .collect();
        assert!(rows.len() > 1, "{letters}");
        let height = (letters * 69.0) as i32;
        for [begin, end] in &rows {
            assert!(begin.x >= 0 && end.x < drawing.size.x, "{begin:?} {end:?} {:?}", drawing.size);
            assert!(begin.y - height >= -2 && begin.y <= drawing.size.y, "{begin:?} {:?}", drawing.size);
        }
        for (i, a) in rows.iter().enumerate() {
            let meets = |b: &&[At; 2]| (a[0].y - b[0].y).abs() < height && a[0].x < b[1].x && b[0].x < a[1].x;
            assert_eq!(rows[i + 1..].iter().find(meets), None, "{a:?}");
        }
        let millimetres = f64::from(drawing.size.x) / 7200.0 * 25.4;
        assert!(millimetres <= 120.0 && millimetres > 90.0, "{letters}: {millimetres}");
    }
}

#[test]
fn letters_are_outlines_in_every_format() {
    let drawing = drawn(CUBE, &labelled(Label::Vertices), &Settings::default());
    let svg = String::from_utf8(write(&drawing, Format::Svg)).unwrap();
    let document = roxmltree::Document::parse(&svg).unwrap();
    let labels: Vec<_> = document.descendants().filter_map(|node| node.attribute("aria-label")).collect();
    assert_eq!(labels, ["v2", "v3", "v4", "v5", "v6", "v7", "v8"]);
    let shapes =
        document.descendants().filter(|n| n.attribute("id").is_some_and(|id| id.starts_with('l') && id != "labels"));
    assert_eq!(shapes.count(), 8, "v and seven digits, each once");
    assert!(!svg.contains("<text") && !svg.contains("font"));

    let eps = String::from_utf8(write(&drawing, Format::Eps)).unwrap();
    assert!(eps.lines().all(|line| line.len() < 256 && line.is_ascii()) && !eps.contains("findfont"));
    let words: Vec<&str> = eps.split_whitespace().collect();
    assert_eq!(words.iter().filter(|w| **w == "l0").count(), 2, "{eps}");
    assert_eq!(words.iter().filter(|w| **w == "fill").count(), 7 + 1);
    assert!(write(&drawing, Format::Pdf).starts_with(b"%PDF-1.4\n"));
}

#[test]
fn what_the_text_of_an_attribute_says_is_kept() {
    let mut drawing = drawn(CUBE, &labelled(Label::Vertices), &Settings::default());
    for layer in &mut drawing.layers {
        if let Layer::Text { words, .. } = layer {
            "a<\"&\u{1}>".clone_into(&mut words[0].text);
        }
    }
    let svg = String::from_utf8(write(&drawing, Format::Svg)).unwrap();
    let document = roxmltree::Document::parse(&svg).unwrap();
    assert_eq!(document.descendants().find_map(|node| node.attribute("aria-label")), Some("a<\"& >"));
}

#[test]
fn axes_are_drawn_with_their_names() {
    let case = Case::new(CUBE);
    let style = Style { axes: true, ..Style::default() };
    let drawing = case.draw_from(&case.camera(false), &style, &Settings::default()).unwrap();
    let names: Vec<_> = written_on(&drawing).into_iter().map(|(_, text)| text).collect();
    assert_eq!(names, ["x", "y", "z"]);
}

#[test]
fn pictures_have_the_same_labels() {
    let case = Case::new(CUBE);
    let white = RgbaImage::from_pixel(400, 400, image::Rgba([255; 4]));
    let inked = |labels, faces| {
        let (mut picture, style) = (white.clone(), Style { faces, ..Style::default() });
        write_on(&mut picture, case.subject(&labelled(labels)), &case.camera(false), &style, 1.0);
        picture.pixels().filter(|pixel| pixel.0[0] < 128).count()
    };
    assert_eq!(inked(Label::Nothing, true), 0);
    let (opaque, wire) = (inked(Label::Vertices, true), inked(Label::Vertices, false));
    assert!(opaque > 100 && wire > opaque, "{opaque} {wire}: the eighth vertex is seen without faces");
}

#[test]
fn what_is_not_drawn_of_the_notes_is_said() {
    let missing = |notes: &Notes| {
        let said = drawn(CUBE, notes, &Settings::default()).missing;
        said.iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    assert_eq!(missing(&ring(7, Label::Vertices)), [""; 0]);
    assert_eq!(missing(&ring(1, Label::Vertices)), ["the ring of v1 is not drawn: the vertex is hidden by faces"]);
    assert_eq!(missing(&labelled(Label::Degrees)), [""; 0]);
    let of = |vertices: &[usize]| {
        vertices.iter().map(|&v| Missing { ring: Vertex::from_index(v), why: "" }).collect::<Vec<_>>()
    };
    assert_eq!(Missing::in_all([of(&[1, 2, 3]), of(&[2, 3]), of(&[3, 4])]), of(&[3]));
}
