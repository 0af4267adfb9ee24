//! Which files a run makes of which generation.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use vv::diagnostic::{Diagnostic, Severity};

use super::cases::{Case, Cases};
use super::names::{FRAME, GENERATION, INPUT, Name};
use crate::commands::output::Target;
use crate::commands::{closest, error, list};
use app::files;

/// Most files of one command.
const MOST_FILES: u64 = 100_000;

/// Generations that were asked for, in order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Generations(Vec<u64>);

impl Generations {
    /// The last one.
    pub fn last(&self) -> u64 {
        self.0.last().copied().unwrap_or_default()
    }
}

/// Reads `0,2,4` and `0-3`.
///
/// # Errors
/// As one sentence.
pub fn generations(text: &str) -> Result<Generations, String> {
    let wrong = || "generations are counted: 0,2,4 or 0-3".to_owned();
    let mut all = BTreeSet::new();
    for part in text.split(',') {
        let (from, to) = part.split_once('-').unwrap_or((part, part));
        let number = |text: &str| text.trim().parse::<u64>().map_err(|_| wrong());
        let (from, to) = (number(from)?, number(to)?);
        if from > to || to - from >= MOST_FILES {
            return Err(wrong());
        }
        all.extend(from..=to);
    }
    Ok(Generations(all.into_iter().collect()))
}

/// What was given on the command line.
#[derive(Debug, Clone, Copy)]
pub struct Given<'a> {
    /// The program.
    pub program: &'a Path,
    /// The meshes.
    pub inputs: &'a [PathBuf],
    /// The generations.
    pub generations: Option<&'a Generations>,
    /// In how many pictures to go around a mesh.
    pub frames: Option<u32>,
}

/// What is made of each run and generation.
#[derive(Debug)]
pub struct Plan {
    program: PathBuf,
    inputs: Vec<PathBuf>,
    cases: Cases,
    outputs: Vec<(Name, Target)>,
    /// How often the rule is applied.
    steps: u64,
    /// The generations that `{n}` stands for; `None` for all of them.
    generations: Option<Vec<u64>>,
    /// Whether anything asks for more than the last generation.
    by_generation: bool,
    /// In how many pictures to go around a mesh.
    frames: Option<u32>,
    /// Pictures of several runs or generations.
    sheets: Vec<Sheet>,
    /// The numbers of the runs and the generations that are on one of them.
    on_sheets: BTreeSet<(usize, u64)>,
}

/// A picture of several runs or generations.
#[derive(Debug, Clone)]
pub struct Sheet {
    /// What is written.
    pub target: Target,
    /// What it shows, row by row.
    pub tiles: Vec<Tile>,
    /// In how many columns, if there is reason for a number.
    pub columns: Option<usize>,
}

/// One of them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Tile {
    /// The number of the run.
    pub case: usize,
    /// And of its input: what comes of one mesh is seen from one place.
    pub input: usize,
    /// The generation.
    pub generation: u64,
    /// What distinguishes it from the others.
    pub label: String,
}

impl Plan {
    /// Checked: no file is written twice.
    ///
    /// # Errors
    /// What cannot be meant so.
    pub fn new(given: Given<'_>, outputs: Vec<Target>, cases: Cases, steps: u64) -> Result<Self, Box<Diagnostic>> {
        let mut named = Vec::new();
        for target in outputs {
            let name = match files::is_standard_stream(target.path()) {
                true => Name::literal(target.path()),
                false => Name::parse(target.path()).map_err(|wrong| Box::new(error(wrong)))?,
            };
            named.push((name, target));
        }
        if let Some(last) = given.generations.map(Generations::last).filter(|last| *last > steps) {
            let message = format!("there is no generation {last} after {steps} steps");
            return Err(Box::new(error(message).hint(format!("apply the rule more often: `-n {last}`"))));
        }
        let by_generation = given.generations.is_some() || named.iter().any(|(name, _)| name.has(GENERATION));
        let mut plan = Self {
            program: given.program.to_owned(),
            inputs: given.inputs.to_owned(),
            cases,
            outputs: named,
            steps,
            generations: given.generations.map(|generations| generations.0.clone()),
            by_generation,
            frames: given.frames,
            sheets: Vec::new(),
            on_sheets: BTreeSet::new(),
        };
        plan.check_size()?;
        plan.check_places()?;
        plan.sheets = plan.outputs.iter().flat_map(|(name, target)| plan.sheets_of(name, target)).collect();
        let tiles = plan.sheets.iter().flat_map(|sheet| &sheet.tiles);
        plan.on_sheets = tiles.map(|tile| (tile.case, tile.generation)).collect();
        plan.check_names()?;
        Ok(plan)
    }

    /// All runs.
    pub fn cases(&self) -> &[Case] {
        &self.cases.all
    }

    /// Whether there is more than one result.
    pub fn has_many(&self) -> bool {
        self.cases.all.len() > 1 || self.by_generation
    }

    /// Whether this is the generation that a run ends with.
    pub fn is_last(&self, generation: u64) -> bool {
        generation == self.steps
    }

    /// Whether it is one of those that are asked for.
    pub fn is_shown(&self, generation: u64) -> bool {
        match &self.generations {
            _ if !self.by_generation => self.is_last(generation),
            Some(listed) => listed.binary_search(&generation).is_ok(),
            None => true,
        }
    }

    /// A warning if generations are asked for, and all outputs hold the last one alone.
    pub fn unshown(&self) -> Option<Diagnostic> {
        let several = self.generations.as_ref().is_some_and(|all| all.len() > 1);
        let holds_last = |(name, target): &(Name, Target)| !target.is_shown() && !name.has(GENERATION);
        let (first, _) = self.outputs.first().filter(|_| several && self.outputs.iter().all(holds_last))?;
        let message = format!("`-o {}` holds generation {} alone", first.path().display(), self.steps);
        let warning = Diagnostic::new(Severity::Warning, None, message);
        Some(warning.hint("put `{n}` into its name to write each of them"))
    }

    /// What distinguishes this run from the others; `None` if it is the only one.
    pub fn label(&self, case: &Case) -> Option<String> {
        let value = |(name, _): &(String, Vec<String>)| Some(format!("{name} = {}", case.value(name)?));
        let input = self.inputs.get(case.input).filter(|_| self.inputs.len() > 1);
        let parts: Vec<_> = input
            .map(|path| files::shown(path))
            .into_iter()
            .chain(self.cases.sweeps.iter().filter_map(value))
            .collect();
        (!parts.is_empty()).then(|| parts.join(", "))
    }

    /// What is written of a generation of a run alone.
    pub fn targets(&self, case: &Case, generation: u64) -> Vec<Target> {
        let at = |(name, target): &(Name, Target)| target.at(self.path(name, case, generation, 0));
        let still =
            |(name, target): &&(Name, Target)| !self.is_turn(name, target) && self.is_due(name, target, generation);
        let alone = |target: &Target| !self.sheets.iter().any(|sheet| sheet.target == *target);
        self.outputs.iter().filter(still).map(at).filter(alone).collect()
    }

    /// The pictures that go around a generation of a run: for each such output, its files.
    pub fn turns(&self, case: &Case, generation: u64) -> Vec<Vec<Target>> {
        let moving =
            |(name, target): &&(Name, Target)| self.is_turn(name, target) && self.is_due(name, target, generation);
        let turn = |(name, target): &(Name, Target)| {
            let files = if target.is_film() { 1 } else { self.frames() };
            (0..files).map(|frame| target.at(self.path(name, case, generation, frame))).collect()
        };
        self.outputs.iter().filter(moving).map(turn).collect()
    }

    /// In how many pictures to go around a mesh.
    pub fn frames(&self) -> u32 {
        self.frames.unwrap_or_default()
    }

    /// Whether an output goes around a mesh.
    fn is_turn(&self, name: &Name, target: &Target) -> bool {
        name.has(FRAME) || target.is_film() && self.frames.is_some()
    }

    /// Pictures of several runs or generations.
    pub fn sheets(&self) -> &[Sheet] {
        &self.sheets
    }

    /// Whether one of them is a figure.
    pub fn has_figures_on_sheets(&self) -> bool {
        self.sheets.iter().any(|sheet| sheet.target.figure().is_some())
    }

    /// Whether a generation of a run is on one of them.
    pub fn is_on_sheet(&self, case: &Case, generation: u64) -> bool {
        self.on_sheets.contains(&(case.index, generation))
    }

    /// Whether a generation is written: each one that is asked for if the name has a place for it, or if pictures of
    /// them stand side by side; else the last one.
    fn is_due(&self, name: &Name, target: &Target, generation: u64) -> bool {
        let side_by_side = target.is_shown() && self.generations.is_some();
        if name.has(GENERATION) || side_by_side { self.is_shown(generation) } else { self.is_last(generation) }
    }

    /// The pictures of an output that are of several; where each has a name of its own there are none.
    fn sheets_of(&self, name: &Name, target: &Target) -> Vec<Sheet> {
        if !target.is_shown() || self.is_turn(name, target) {
            return Vec::new();
        }
        let mut by_path: BTreeMap<PathBuf, Vec<Tile>> = BTreeMap::new();
        for case in &self.cases.all {
            for generation in self.in_order().filter(|g| self.is_due(name, target, *g)) {
                let label = self.tile_label(name, case, generation);
                let tile = Tile { case: case.index, input: case.input, generation, label };
                by_path.entry(self.path(name, case, generation, 0)).or_default().push(tile);
            }
        }
        let columns = self.columns(name);
        let several = by_path.into_iter().filter(|(_, tiles)| tiles.len() > 1);
        several.map(|(path, tiles)| Sheet { target: target.at(path), tiles, columns }).collect()
    }

    /// Of two things that differ on a sheet the second one goes across.
    fn columns(&self, name: &Name) -> Option<usize> {
        let swept = self.cases.sweeps.iter().filter(|(parameter, _)| !name.has(parameter)).map(|(_, all)| all.len());
        let inputs = Some(self.inputs.len()).filter(|count| *count > 1 && !name.has(INPUT));
        let generations = self.generations.as_ref().map(Vec::len).filter(|count| *count > 1 && !name.has(GENERATION));
        let different: Vec<usize> = inputs.into_iter().chain(swept).chain(generations).collect();
        different.last().copied().filter(|_| different.len() > 1)
    }

    fn tile_label(&self, name: &Name, case: &Case, generation: u64) -> String {
        let input = (self.inputs.len() > 1 && !name.has(INPUT)).then(|| case.name(&self.inputs, &self.program));
        let swept = self.cases.sweeps.iter().filter(|(parameter, _)| !name.has(parameter));
        let values = swept.filter_map(|(parameter, _)| Some(format!("{parameter} = {}", case.value(parameter)?)));
        let many = self.generations.as_ref().is_some_and(|all| all.len() > 1) && !name.has(GENERATION);
        let generation = many.then(|| format!("generation {generation}"));
        input.into_iter().chain(values).chain(generation).collect::<Vec<_>>().join(", ")
    }

    /// Everything that is written.
    pub fn all_targets(&self) -> Vec<Target> {
        let of_generation = |case, generation| {
            let turns = self.turns(case, generation).into_iter().flatten();
            self.targets(case, generation).into_iter().chain(turns)
        };
        let of_case = |case| self.shown().flat_map(move |generation| of_generation(case, generation));
        let sheets = self.sheets.iter().map(|sheet| sheet.target.clone());
        self.cases.all.iter().flat_map(of_case).chain(sheets).collect()
    }

    fn path(&self, name: &Name, case: &Case, generation: u64, frame: u32) -> PathBuf {
        name.fill(|what| match what {
            GENERATION => Some(generation.to_string()),
            FRAME => Some(frame.to_string()),
            INPUT => Some(case.name(&self.inputs, &self.program)),
            parameter => case.value(parameter).map(str::to_owned),
        })
    }

    /// The generations of which something is written or told; the last one always.
    fn shown(&self) -> impl Iterator<Item = u64> {
        let (listed, all) = match (&self.generations, self.by_generation) {
            (Some(listed), _) => (listed.as_slice(), 0..0),
            (None, true) => (&[][..], 0..self.steps),
            (None, false) => (&[][..], 0..0),
        };
        listed.iter().copied().filter(|generation| *generation != self.steps).chain(all).chain([self.steps])
    }

    /// The same in their order.
    fn in_order(&self) -> impl Iterator<Item = u64> {
        self.shown().collect::<BTreeSet<_>>().into_iter()
    }

    /// Places are known.
    fn check_places(&self) -> Result<(), Box<Diagnostic>> {
        let parameters: Vec<&str> =
            self.cases.all.first().map_or(vec![], |case| case.values.iter().map(|(name, _)| name.as_str()).collect());
        let moving = |(name, target): &(Name, Target)| self.is_turn(name, target);
        if self.frames.is_some() && !self.outputs.iter().any(moving) {
            let message = "`--turntable` makes several pictures, and no output has a place for their numbers";
            return Err(Box::new(error(message).hint("write `-o 'turn_{frame:3}.png'` or `-o turn.gif`")));
        }
        for (name, target) in &self.outputs {
            if name.has(FRAME) && (self.frames.is_none() || !target.is_picture() || target.is_film()) {
                let message = format!("`-o {}`: only pictures of a turntable have frames", name.path().display());
                return Err(Box::new(error(message).hint(match (self.frames, target.is_film()) {
                    (None, _) => "add `--turntable 36`, and write a `.png`",
                    (Some(_), true) => "a `.gif` holds all of them: leave `{frame}` out",
                    (Some(_), false) => "write a `.png`",
                })));
            }
            let known = |what: &str| [GENERATION, INPUT, FRAME].contains(&what) || parameters.contains(&what);
            if let Some(what) = name.places().find(|what| !known(what)) {
                let names = [GENERATION, INPUT].into_iter().chain(parameters.iter().copied());
                let message = format!("`-o {}`: nothing is called `{what}`", name.path().display());
                let diagnostic = error(message).evidence(format!("there are {}", list(names.clone())));
                return Err(Box::new(match closest(what, names) {
                    Some(near) => diagnostic.hint(format!("did you mean `{{{near}}}`?")),
                    None => diagnostic.hint(format!("`-D {what}=…` gives it a value; `{{{{` is a brace")),
                }));
            }
        }
        Ok(())
    }

    /// There are not too many files.
    fn check_size(&self) -> Result<(), Box<Diagnostic>> {
        let generations = if self.by_generation { self.steps.saturating_add(1) } else { 1 };
        let files = generations.saturating_mul((self.cases.all.len() * self.outputs.len().max(1)) as u64);
        let files = files.saturating_mul(self.frames.unwrap_or(1).into());
        if files > MOST_FILES {
            return Err(Box::new(error(format!("these would be more than {MOST_FILES} files"))));
        }
        Ok(())
    }

    /// Every file has a name of its own, and in every film something moves.
    fn check_names(&self) -> Result<(), Box<Diagnostic>> {
        let of_case = |case| self.shown().flat_map(move |generation| self.targets(case, generation));
        if let Some(still) = self.cases.all.iter().flat_map(of_case).find(Target::is_film) {
            let diagnostic = error(format!("`-o {}`: nothing moves here", still.path().display()));
            return Err(Box::new(
                diagnostic.hint("go around the mesh, `--turntable 36`, or let `vv run` show `--generations 0-3`"),
            ));
        }
        let mut taken = BTreeSet::new();
        for target in self.all_targets() {
            if !taken.insert(files::place(target.path())) {
                return Err(Box::new(self.written_twice(target.path())));
            }
        }
        Ok(())
    }

    fn written_twice(&self, path: &Path) -> Diagnostic {
        let diagnostic = error(format!("`-o {}` would be written more than once", path.display()));
        let named = |(name, _): &&(Name, Target)| {
            let of_case =
                |case| self.shown().any(|g| (0..self.frames().max(1)).any(|f| self.path(name, case, g, f) == path));
            self.cases.all.iter().any(of_case)
        };
        let name = self.outputs.iter().find(named).map(|(name, _)| name);
        let input = (self.inputs.len() > 1).then_some(INPUT);
        let generation = self.generations.as_ref().filter(|all| all.len() > 1).map(|_| GENERATION);
        let swept = self.cases.sweeps.iter().map(|(name, _)| name.as_str());
        let missing = |place: &&str| name.is_none_or(|name| !name.has(place));
        let places: Vec<String> = input
            .into_iter()
            .chain(swept)
            .chain(generation)
            .filter(missing)
            .map(|name| format!("{{{name}}}"))
            .collect();
        match places.as_slice() {
            [] => diagnostic,
            places => diagnostic.hint(format!("put {} into its name", list(places.iter().map(String::as_str)))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn generations_are_numbers_and_ranges() {
        assert_eq!(generations("0-2, 7,2"), Ok(Generations(vec![0, 1, 2, 7])));
        for wrong in ["", "a", "3-1", "-1", "0-", "1-99999999"] {
            assert!(generations(wrong).is_err(), "{wrong}");
        }
    }
}
