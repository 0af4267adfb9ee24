//! `vv mask -o`: masks as figures.

use std::path::PathBuf;

use app::figure::{self, Format, Page, Settings, Sketch, Tile, paper};
use app::files;
use clap::Args;
use glam::DVec2;
use vv::diagnostic::{Diagnostic, Severity};
use vv::masks::{Around, Class, Star};
use vv::mesh::{Mesh, Vertex};
use vv::source::Sources;

use super::super::report::Reporter;
use super::super::{Exit, error, fail, input, output, picture};

/// Most masks on a page.
const MOST: usize = 64;

/// Millimetres that a mask takes, so that its weights can be read.
const WIDTH: f64 = 54.0;

/// How often a page may grow by a quarter for weights that have no room.
const GROWTHS: usize = 4;

/// Pixels of a PNG picture for each point: 300 per inch.
const PIXELS_PER_POINT: f64 = 300.0 / 72.0;

/// Most pixels along a side: a gigabyte for a square.
const MOST_PIXELS: f64 = 16_384.0;

/// What to draw, and how large.
#[derive(Debug, Args)]
pub struct DrawingArguments {
    /// Draw the masks, in place of the table, each kind once: the weights on the old mesh around the new vertex, a circle.
    /// A figure (.svg, .eps, .pdf) or a picture of 300 pixels per inch (.png). May be repeated.
    #[arg(short, long = "output", value_name = "FILE")]
    output: Vec<PathBuf>,
    /// Size of the figure: a width such as 85mm, or a width and a height that it fits into, such as 85x60mm. Default:
    /// three side by side, 54mm for each or as much as the weights need.
    #[arg(long, value_name = "W[xH]mm", requires = "output", value_parser = paper::page)]
    page: Option<Page>,
    /// Height of the weights in points. Default: 7.
    #[arg(long, value_name = "POINTS", requires = "output", value_parser = paper::letters)]
    font_size: Option<f64>,
}

/// A file to write.
pub struct Target {
    path: PathBuf,
    /// `None` is a picture in pixels.
    format: Option<Format>,
}

/// A mask to draw.
pub struct Drawn {
    /// Where it is, of what kind, and around a vertex of how many sectors.
    place: Option<(Side, Kind, usize)>,
    /// All weights in order; what has the same in the same kind of place is drawn once.
    weights: Vec<f64>,
    caption: String,
    sketch: Sketch,
}

/// Where a new vertex lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Side {
    /// Far from the boundary.
    Inside,
    /// On it.
    Boundary,
    /// On an edge that ends at the boundary, or in a face that has a corner there.
    Near,
}

/// What a new vertex is for: an old vertex, an edge, or a face with one corner of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Vertex,
    Edge,
    Face,
}

impl DrawingArguments {
    /// Whether anything is drawn.
    pub fn is_asked_for(&self) -> bool {
        !self.output.is_empty()
    }

    fn settings(&self) -> Settings {
        let default = Settings::default();
        Settings { letters: self.font_size.unwrap_or(default.letters), ..default }
    }

    /// The page for so many masks, and how many of them stand side by side.
    fn page(&self, count: usize) -> (Page, Option<usize>) {
        let fitting = |width: f64| ((width / (WIDTH - 2.0)).floor() as usize).clamp(1, count.max(1));
        match self.page {
            None => {
                let columns = count.clamp(1, 3);
                (Page { width: WIDTH * columns as f64, height: None }, Some(columns))
            }
            Some(page) => (page, page.height.is_none().then(|| fitting(page.width))),
        }
    }

    /// The files, checked.
    ///
    /// # Errors
    /// [`Exit::Usage`] or [`Exit::File`], reported.
    pub fn targets(&self, reporter: &Reporter) -> Result<Vec<Target>, Exit> {
        let mut targets: Vec<Target> = Vec::new();
        for path in &self.output {
            let extension = path.extension().unwrap_or_default().to_string_lossy();
            let format = Format::from_extension(&extension);
            if format.is_none() && !extension.eq_ignore_ascii_case("png") {
                let diagnostic = error(format!("`-o {}` is no figure of masks", path.display()));
                return fail(reporter, Exit::Usage, diagnostic.hint("write an .svg, .eps, .pdf or .png"));
            }
            if let Some(Target { path: other, .. }) =
                targets.iter().find(|t| files::place(&t.path) == files::place(path))
            {
                return fail(reporter, Exit::Usage, output::given_twice(other, path));
            }
            files::prepare(path, &[]).map_err(|error| input::file_failed(&error, reporter))?;
            targets.push(Target { path: path.clone(), format });
        }
        Ok(targets)
    }

    /// The mask of a class around the middle of a star, turned so that its sector is the first one.
    pub fn of_star(&self, star: &Star, around: Around, class: &Class) -> Drawn {
        use std::f64::consts::{FRAC_PI_2, PI, TAU};
        let flat = |v: Vertex| laid_out(star, around, v);
        let new: DVec2 = class.mask.iter().filter_map(|&(v, w)| Some(flat(v)? * w)).sum();
        let sector = if star.boundary { PI } else { TAU } / star.sectors as f64;
        let at_p = new.length() < 1e-9;
        let turn = match (star.boundary, at_p) {
            (true, _) => 0.0,
            (false, true) => FRAC_PI_2,
            (false, false) => (new.to_angle().rem_euclid(TAU) / sector + 1e-9).floor() * -sector,
        };
        let place = |v: Vertex| Some(DVec2::from_angle(turn).rotate(flat(v)?));
        let sketch = figure::mask(&star.mesh, &class.mask, place, self.settings().letters);
        let on_ray = {
            let turns = new.to_angle() / sector;
            (turns - turns.round()).abs() < 1e-6
        };
        let kind = match (at_p || class.is_old, on_ray) {
            (true, _) => Kind::Vertex,
            (false, true) => Kind::Edge,
            (false, false) => Kind::Face,
        };
        let side = match (star.boundary, kind) {
            (false, _) => Side::Inside,
            (true, Kind::Edge) if new.y.abs() > 1e-9 => Side::Near,
            (true, Kind::Face) => Side::Near,
            (true, _) => Side::Boundary,
        };
        let place = Some((side, kind, star.sectors));
        Drawn { place, weights: sorted(&class.mask), caption: String::new(), sketch }
    }

    /// The mask of a vertex on a mesh, as it is seen from outside.
    pub fn of_mesh(&self, mesh: &Mesh, mask: &[(Vertex, f64)]) -> Drawn {
        let sketch = figure::mask_on(mesh, mask, self.settings().letters);
        Drawn { place: None, weights: sorted(mask), caption: String::new(), sketch }
    }

    /// Says of which vertex of a mesh a mask is, and how many others it has.
    pub fn name(drawn: &mut Drawn, vertex: &str, count: usize) {
        drawn.caption = match count {
            1 => vertex.to_owned(),
            _ => format!("{vertex} and {} more", count - 1),
        };
    }

    /// Draws a page of masks into all files.
    ///
    /// # Errors
    /// [`Exit::Usage`] if there are none, or [`Exit::File`]; reported.
    pub fn write(
        &self,
        masks: Vec<Drawn>,
        around: Around,
        targets: &[Target],
        reporter: &Reporter,
    ) -> Result<(), Exit> {
        let mut tiles = each_once(masks, around);
        if tiles.len() > MOST {
            let message = format!("of {} masks the first {MOST} are drawn", tiles.len());
            let warning = Diagnostic::new(Severity::Warning, None, message);
            reporter
                .report(&[warning.hint("one is drawn with `--vertex NUMBER` or `--valence N`")], &Sources::default());
            tiles.truncate(MOST);
        }
        let (mut page, columns) = self.page(tiles.len());
        let draw = |page| figure::sheet(tiles.clone(), columns, &Settings { page, ..self.settings() });
        let mut drawing = draw(page);
        // All weights are to be read; where nobody asks for a size the page grows until they are.
        for _ in 0..GROWTHS {
            if self.page.is_some() || drawing.as_ref().is_none_or(|drawing| drawing.crowded_out == 0) {
                break;
            }
            page.width *= 1.25;
            drawing = draw(page);
        }
        let Some(drawing) = drawing else {
            return fail(reporter, Exit::Usage, error("there is no mask, so there is no figure"));
        };
        if drawing.crowded_out > 0 {
            let message = format!("{} weights have no room beside the others", drawing.crowded_out);
            let warning = Diagnostic::new(Severity::Warning, None, message);
            reporter.report(&[warning.hint("give them more with `--page` or `--font-size`")], &Sources::default());
        }
        let mut prepared = Vec::new();
        for Target { path, format } in targets {
            let bytes = match format {
                Some(format) => figure::write(&drawing, *format),
                None => {
                    let longest = f64::from(drawing.size.x.max(drawing.size.y)) / 100.0;
                    picture::png(&figure::image(&drawing, PIXELS_PER_POINT.min(MOST_PIXELS / longest)), reporter)?
                }
            };
            prepared.push(files::prepare(path, &bytes).map_err(|error| input::file_failed(&error, reporter))?);
        }
        output::commit(prepared, reporter)
    }
}

/// Where a vertex of a star lies on the page: where it would around a regular vertex, all sectors made as wide as they
/// are; the more of them the less far out, so that faces keep their form. None below.
fn laid_out(star: &Star, around: Around, v: Vertex) -> Option<DVec2> {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, PI, TAU};
    let place = star.places.get(v.index()).filter(|place| !place.below)?;
    let regular = match around {
        Around::Triangles => FRAC_PI_3,
        Around::Quads => FRAC_PI_2,
    };
    let sector = if star.boundary { PI } else { TAU } / star.sectors as f64;
    let (i, j) = place.steps;
    let point = DVec2::X * i as f64 + DVec2::from_angle(regular) * j as f64;
    if point == DVec2::ZERO {
        return Some(point);
    }
    let widened = sector / regular;
    let angle = place.sector as f64 * sector + point.to_angle() * widened;
    Some(DVec2::from_angle(angle) * point.length().powf(widened.min(1.0)))
}

fn sorted(mask: &[(Vertex, f64)]) -> Vec<f64> {
    let mut weights: Vec<f64> = mask.iter().map(|(_, w)| *w).collect();
    weights.sort_by(f64::total_cmp);
    weights
}

/// Masks that are the same around vertices of several valences become one, around a regular vertex if it is among them;
/// and near the boundary only those are shown that are not as inside.
fn each_once(masks: Vec<Drawn>, around: Around) -> Vec<Tile> {
    let regular = |side: Side| match (around, side) {
        (Around::Triangles, Side::Inside) => 6,
        (Around::Triangles, _) => 3,
        (Around::Quads, Side::Inside) => 4,
        (Around::Quads, _) => 2,
    };
    let mut all: Vec<(Side, Kind, usize)> = masks.iter().filter_map(|mask| mask.place).collect();
    all.sort_unstable();
    all.dedup();
    let mut groups: Vec<(Drawn, Vec<usize>)> = Vec::new();
    for mask in masks {
        let Some((side, kind, sectors)) = mask.place else {
            groups.push((mask, Vec::new()));
            continue;
        };
        let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-10;
        let alike = |other: &Drawn, sides: &[Side]| {
            other.place.is_some_and(|(s, k, _)| sides.contains(&s) && k == kind)
                && other.weights.len() == mask.weights.len()
                && other.weights.iter().zip(&mask.weights).all(near)
        };
        if side == Side::Near && groups.iter().any(|(other, _)| alike(other, &[Side::Inside])) {
            continue;
        }
        match groups.iter_mut().find(|(other, _)| alike(other, &[side])) {
            Some((drawn, members)) => {
                members.push(sectors);
                if sectors == regular(side) {
                    *drawn = mask;
                }
            }
            None => groups.push((mask, vec![sectors])),
        }
    }
    groups.sort_by_key(|(drawn, _)| drawn.place.map(|(side, kind, _)| (side, kind)));
    let tile = |(drawn, mut members): (Drawn, Vec<usize>)| {
        members.dedup();
        let caption = match drawn.place {
            None => drawn.caption,
            Some((side, kind, _)) => {
                let same = all.iter().filter(|(s, k, _)| (*s, *k) == (side, kind));
                caption(side, kind, &members, &same.map(|(.., n)| *n).collect::<Vec<_>>())
            }
        };
        Tile { sketch: Some(drawn.sketch), caption }
    };
    groups.into_iter().map(tile).collect()
}

/// `vertex, valence 5`, `edge`, `boundary vertex, 2 sectors`: nothing is said of valences if it is the same for all.
fn caption(side: Side, kind: Kind, members: &[usize], all: &[usize]) -> String {
    let name = match kind {
        Kind::Vertex => "vertex",
        Kind::Edge => "edge",
        Kind::Face => "face",
    };
    let kind = match (side, kind) {
        (Side::Inside, _) => name.to_owned(),
        (Side::Boundary, _) => format!("boundary {name}"),
        (Side::Near, Kind::Edge) => "edge to the boundary".to_owned(),
        (Side::Near, _) => format!("{name} at the boundary"),
    };
    if members == all && all.len() > 1 {
        return kind;
    }
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for &n in members {
        match runs.last_mut() {
            Some((_, last)) if *last + 1 == n => *last = n,
            _ => runs.push((n, n)),
        }
    }
    let run =
        |&(first, last): &(usize, usize)| if first == last { first.to_string() } else { format!("{first}–{last}") };
    let numbers = runs.iter().map(run).collect::<Vec<_>>().join(", ");
    match (side, members) {
        (Side::Inside, _) => format!("{kind}, valence {numbers}"),
        (_, [1]) => format!("{kind}, 1 sector"),
        _ => format!("{kind}, {numbers} sectors"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_caption_names_the_valences_unless_it_is_for_all() {
        let all = [3, 4, 5, 6, 7];
        assert_eq!(caption(Side::Inside, Kind::Vertex, &[5], &all), "vertex, valence 5");
        assert_eq!(caption(Side::Inside, Kind::Edge, &all, &all), "edge");
        assert_eq!(caption(Side::Inside, Kind::Face, &[3, 5, 6, 7], &all), "face, valence 3, 5–7");
        assert_eq!(caption(Side::Boundary, Kind::Vertex, &[1], &[1, 2]), "boundary vertex, 1 sector");
        assert_eq!(caption(Side::Boundary, Kind::Vertex, &[1, 2], &[1, 2, 3]), "boundary vertex, 1–2 sectors");
        assert_eq!(caption(Side::Inside, Kind::Edge, &[6], &[6]), "edge, valence 6");
        assert_eq!(caption(Side::Near, Kind::Edge, &[2, 3], &[2, 3]), "edge to the boundary");
        assert_eq!(caption(Side::Near, Kind::Face, &[1], &[1, 2]), "face at the boundary, 1 sector");
    }
}
