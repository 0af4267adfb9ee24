//! Contact sheets, pictures of several runs or generations side by side; and pictures that go around a mesh.

use std::collections::BTreeMap;

use app::camera::Camera;
use app::figure::{self, Drawing, Page};
use app::files::{self, Prepared};
use app::render;
use app::sheet::{self, Layout};

use super::super::output::Target;
use super::super::picture::{self, Exhibit, Shot};
use super::super::{Exit, error, fail, input};
use super::Run;
use super::plan::Sheet;

/// What came out, by number of the run and generation.
pub type Exhibits = BTreeMap<(usize, u64), Exhibit<'static>>;

/// Size of a page of several figures, if none was asked for: across both columns of a paper.
const SPREAD: Page = Page { width: 160.0, height: None };

/// Milliseconds of once around a mesh.
const TURN: u32 = 6000;

/// Milliseconds for which a film shows a generation, or a value.
const STILL: u32 = 800;

impl Run<'_> {
    /// Draws all sheets and writes them beside their places. Runs that failed leave a gap; where all did there is no sheet.
    ///
    /// # Errors
    /// [`Exit::Usage`] where there is too little room, [`Exit::NoRenderer`] or [`Exit::File`]; reported.
    pub fn sheets(&self, exhibits: &Exhibits) -> Result<Vec<Prepared>, Exit> {
        let mut prepared = Vec::new();
        let mut drawing = None;
        for sheet in self.plan.sheets() {
            if sheet.tiles.iter().all(|tile| !exhibits.contains_key(&(tile.case, tile.generation))) {
                continue;
            }
            self.reporter.progress(format!("drawing {}", sheet.target.path().display()));
            let bytes = if let Some(format) = sheet.target.figure() {
                let drawing = match &drawing {
                    Some((tiles, drawing)) if *tiles == sheet.tiles => drawing,
                    _ => &drawing.insert((sheet.tiles.clone(), self.figure(sheet, exhibits)?)).1,
                };
                figure::write(drawing, format)
            } else if sheet.target.is_film() {
                picture::film(&self.seen(sheet, exhibits, self.shot), self.shot, STILL, self.reporter)?
            } else {
                picture::png(&self.sheet(sheet, exhibits)?, self.reporter)?
            };
            let file = files::prepare(sheet.target.path(), &bytes);
            prepared.push(file.map_err(|error| input::file_failed(&error, self.reporter))?);
        }
        Ok(prepared)
    }

    /// Draws the pictures that go around a mesh and writes them beside their places.
    ///
    /// # Errors
    /// [`Exit::NoRenderer`] or [`Exit::File`]; reported.
    pub fn frames(&self, exhibit: &Exhibit<'_>, turn: &[Target]) -> Result<Vec<Prepared>, Exit> {
        let count = self.plan.frames();
        let seen: Vec<_> =
            picture::around(exhibit, self.shot, count).into_iter().map(|camera| (exhibit, camera)).collect();
        if let [film] = turn
            && film.is_film()
        {
            let bytes = picture::film(&seen, self.shot, (TURN / count).max(20), self.reporter)?;
            let file = files::prepare(film.path(), &bytes);
            return Ok(vec![file.map_err(|error| input::file_failed(&error, self.reporter))?]);
        }
        let mut prepared = Vec::new();
        let mut targets = turn.iter();
        picture::draw(&seen, self.shot, self.reporter, |picture| {
            self.go_on()?;
            let Some(target) = targets.next() else { return Ok(()) };
            let bytes = picture::png(&picture, self.reporter)?;
            let file = files::prepare(target.path(), &bytes);
            prepared.push(file.map_err(|error| input::file_failed(&error, self.reporter))?);
            Ok(())
        })?;
        Ok(prepared)
    }

    /// Where the pictures of a sheet are.
    ///
    /// # Errors
    /// [`Exit::Usage`] where there is too little room, reported.
    pub fn layout(&self, sheet: &Sheet) -> Result<Layout, Exit> {
        let (count, (width, height)) = (sheet.tiles.len(), self.shot.size);
        match Layout::new(self.shot.size, count, sheet.columns) {
            Some(layout) => Ok(layout),
            None => {
                let diagnostic = error(format!("{count} pictures have no room on {width}x{height} pixels"));
                fail(self.reporter, Exit::Usage, diagnostic.hint("give them more with `--size WxH`"))
            }
        }
    }

    fn sheet(&self, sheet: &Sheet, exhibits: &Exhibits) -> Result<image::RgbaImage, Exit> {
        let layout = self.layout(sheet)?;
        let shot = Shot { size: layout.tile(), ..self.shot };
        let seen = self.seen(sheet, exhibits, shot);
        let mut pictures = Vec::new();
        picture::draw(&seen, shot, self.reporter, |picture| {
            pictures.push(picture);
            self.go_on()
        })?;
        let mut pictures = pictures.into_iter();
        let tiles: Vec<_> = sheet
            .tiles
            .iter()
            .map(|tile| sheet::Tile {
                label: tile.label.clone(),
                picture: exhibits.get(&(tile.case, tile.generation)).and_then(|_| pictures.next()),
            })
            .collect();
        let (style, background) = (&self.shot.look.style, self.shot.look.background);
        let mut sheet = sheet::compose(&layout, &tiles, style.theme, style.transparent || background.is_some());
        if let Some(color) = background {
            render::put_on(&mut sheet, color);
        }
        Ok(sheet)
    }

    /// A page of figures, in one measure.
    fn figure(&self, sheet: &Sheet, exhibits: &Exhibits) -> Result<Drawing, Exit> {
        let mut seen = self.seen(sheet, exhibits, self.shot).into_iter();
        let mut tiles = Vec::new();
        for tile in &sheet.tiles {
            let found = exhibits.get(&(tile.case, tile.generation)).and_then(|_| seen.next());
            let sketch = found.map(|(exhibit, camera)| picture::sketch(exhibit, &camera, self.shot)).transpose()?;
            tiles.push(figure::Tile { sketch, caption: tile.label.clone() });
        }
        let look = self.shot.look;
        let mut settings = look.figure;
        if !look.has_page {
            settings.page = SPREAD;
        }
        picture::sheet(tiles, sheet.columns, &settings, self.reporter)
    }

    /// What there is of a sheet, and from where it is seen: all that comes of one mesh from one place.
    fn seen<'e>(&self, sheet: &Sheet, exhibits: &'e Exhibits, shot: Shot<'_>) -> Vec<(&'e Exhibit<'static>, Camera)> {
        let found: Vec<_> = sheet.tiles.iter().map(|tile| exhibits.get(&(tile.case, tile.generation))).collect();
        let mut cameras = BTreeMap::new();
        for tile in &sheet.tiles {
            cameras.entry(tile.input).or_insert_with(|| {
                let same = sheet.tiles.iter().zip(&found).filter(|(other, _)| other.input == tile.input);
                picture::camera(&same.filter_map(|(_, exhibit)| *exhibit).collect::<Vec<_>>(), shot)
            });
        }
        sheet
            .tiles
            .iter()
            .zip(&found)
            .filter_map(|(tile, exhibit)| Some(((*exhibit)?, *cameras.get(&tile.input)?)))
            .collect()
    }
}
