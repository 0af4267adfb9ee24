//! PDF 1.4: one page, its content packed.

use std::fmt::Write as _;
use std::io::Write as _;

use flate2::Compression;
use flate2::write::ZlibEncoder;

use super::letters::{Step, cubic, outline};
use super::page::{At, Drawing, Layer};
use super::{Dash, hundredths, thousandths};

/// The drawing as bytes.
pub(super) fn write(drawing: &Drawing) -> Vec<u8> {
    let (width, height) = (hundredths(drawing.size.x), hundredths(drawing.size.y));
    let packed = packed(content(drawing).as_bytes());
    let objects: [&[u8]; 3] = [
        b"<</Type/Catalog/Pages 2 0 R>>",
        b"<</Type/Pages/Kids[3 0 R]/Count 1>>",
        &format!("<</Type/Page/Parent 2 0 R/MediaBox[0 0 {width} {height}]/Resources<<>>/Contents 4 0 R>>")
            .into_bytes(),
    ];
    // The second line says that the file is binary.
    let mut bytes = b"%PDF-1.4\n%\xE2\xE3\xCF\xD3\n".to_vec();
    let mut offsets = Vec::new();
    let stream = [
        format!("<</Length {}/Filter/FlateDecode>>\nstream\n", packed.len()).into_bytes(),
        packed,
        b"\nendstream".to_vec(),
    ]
    .concat();
    for (number, object) in (1..).zip(objects.into_iter().chain([&stream[..]])) {
        offsets.push(bytes.len());
        bytes.extend(format!("{number} 0 obj\n").bytes());
        bytes.extend(object);
        bytes.extend(b"\nendobj\n");
    }
    let start = bytes.len();
    bytes.extend(format!("xref\n0 {}\n0000000000 65535 f \n", offsets.len() + 1).bytes());
    for offset in &offsets {
        bytes.extend(format!("{offset:010} 00000 n \n").bytes());
    }
    bytes.extend(format!("trailer\n<</Size {}/Root 1 0 R>>\nstartxref\n{start}\n%%EOF\n", offsets.len() + 1).bytes());
    bytes
}

/// By zlib; writing into memory does not fail.
fn packed(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
    let _ = encoder.write_all(bytes);
    encoder.finish().unwrap_or_default()
}

fn content(drawing: &Drawing) -> String {
    let mut text = format!("1 0 0 -1 0 {} cm 1 j\n", hundredths(drawing.size.y));
    for layer in &drawing.layers {
        // What is written into a string is written.
        let _ = write_layer(&mut text, layer);
    }
    text
}

fn write_layer(text: &mut String, layer: &Layer) -> std::fmt::Result {
    match layer {
        Layer::Faces(areas) => {
            writeln!(text, ".3 w")?;
            let mut before = None;
            for (corners, color) in areas {
                if before.replace(color) != Some(color) {
                    let color = thousandths(*color);
                    writeln!(text, "{color} rg {color} RG")?;
                }
                writeln!(text, "{}b", path(corners))?;
            }
        }
        Layer::Lines { line, paths, .. } => {
            let width = hundredths((line.width * 100.0).round() as i32);
            write!(text, "{width} w {} RG ", thousandths(line.color))?;
            match line.dash {
                Dash::Solid => writeln!(text, "1 J [] 0 d")?,
                dash => writeln!(text, "0 J [{}] 0 d", dash.lengths(line.width).map(hundredths).join(" "))?,
            }
            for line in paths {
                writeln!(text, "{}{}", path(&line.points), if line.closed { "s" } else { "S" })?;
            }
        }
        Layer::Dots { diameter, color, places, .. } => {
            // A line without length and with round ends is a dot.
            writeln!(text, "{} w {} RG 1 J [] 0 d", hundredths(*diameter), thousandths(*color))?;
            for At { x, y } in places {
                let (x, y) = (hundredths(*x), hundredths(*y));
                writeln!(text, "{x} {y} m {x} {y} l S")?;
            }
        }
        Layer::Text { size, color, halo: (paper, width), words, .. } => {
            let (width, paper, color) = (hundredths(*width), thousandths(*paper), thousandths(*color));
            writeln!(text, "{width} w {paper} RG {color} rg 1 J [] 0 d")?;
            for draw in ["S", "f"] {
                for (glyph, at) in words.iter().flat_map(|line| &line.glyphs) {
                    // The same letters in the same words, which pack well.
                    writeln!(text, "q 1 0 0 1 {} {} cm", hundredths(at.x), hundredths(at.y))?;
                    write_outline(text, &outline(*glyph, *size))?;
                    writeln!(text, "{draw} Q")?;
                }
            }
        }
    }
    Ok(())
}

fn write_outline(text: &mut String, steps: &[Step]) -> std::fmt::Result {
    let pair = |p: At| format!("{} {}", hundredths(p.x), hundredths(p.y));
    let mut pen = At { x: 0, y: 0 };
    for step in steps {
        match *step {
            Step::Move(p) => write!(text, "{} m ", pair(p))?,
            Step::Line(p) => write!(text, "{} l ", pair(p))?,
            Step::Quad(c, p) => {
                let [a, b] = cubic(pen, c, p);
                write!(text, "{} {} {} c ", pair(a), pair(b), pair(p))?;
            }
            Step::Close => write!(text, "h ")?,
        }
        if let Step::Move(p) | Step::Line(p) | Step::Quad(_, p) = *step {
            pen = p;
        }
    }
    Ok(())
}

fn path(points: &[At]) -> String {
    let mut text = String::new();
    for (i, p) in points.iter().enumerate() {
        let _ = write!(text, "{} {} {} ", hundredths(p.x), hundredths(p.y), if i == 0 { 'm' } else { 'l' });
    }
    text
}
