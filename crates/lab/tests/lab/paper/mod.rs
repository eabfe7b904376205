//! The statements of the paper's sections 4 to 6, one test each or a few together, on the scenes of
//! `topple figures`. docs/paper.md lists them with their verdicts; a statement that is not reproduced
//! has a test of what is found instead.

mod beyond;
mod ground;
mod negative;
mod positive;
mod seismic;
mod strip;

use std::collections::BTreeSet;
use std::path::Path;

use topple::backend::cell_run::CellRun;
use topple::backend::ready::Backend;
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::scene::{Grid, Scene};
use topple::stepping::outcome::{Class, Outcome};
use topple::work::observer::Unwatched;
use topple_lab::figures::motions::{self, Motion};
use topple_lab::figures::shares::Shares;
use topple_lab::figures::text::FigureInputs;
use topple_lab::figures::{Figure, Panel};

use crate::common::xy;

/// A figure of `scenes/`, with `cells` points an axis.
fn figure(name: &str, cells: Option<u32>, records: Option<&Path>) -> (Figure, Vec<Motion>) {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let read = |name: &str| std::fs::read_to_string(scenes.join(format!("{name}.toml"))).unwrap();
    let motions = motions::from_toml("motions", &read("motions")).unwrap();
    let inputs = FigureInputs { motions: &motions, records, cells };
    Figure::from_toml(name, &read(name), &inputs).unwrap()
}

/// A scene's cells as a sweep runs them.
fn swept(scene: &Scene) -> Vec<Outcome> {
    let plan = Plan::new(scene, DEFAULT_STEP).unwrap();
    Backend::Cpu
        .run(&CellRun::all(&plan, &Grid::of(scene), Precision::F32), &Unwatched)
        .unwrap()
        .block
        .to_outcomes()
}

/// A panel that has run.
struct Ran {
    panel: Panel,
    grid: Grid,
    outcomes: Vec<Outcome>,
    shares: Shares,
}

impl Ran {
    fn new(panel: Panel) -> Ran {
        let (grid, outcomes) = (Grid::of(&panel.scene), swept(&panel.scene));
        let shares = Shares::of(&outcomes);
        Ran { panel, grid, outcomes, shares }
    }

    /// Share of the cells for which a test holds.
    fn share(&self, test: impl Fn(&Outcome) -> bool) -> f64 {
        let count = self.outcomes.iter().filter(|cell| test(cell)).count();
        count as f64 / self.outcomes.len() as f64
    }

    /// Share that overturns after two impacts or more, without a rest between.
    fn multi(&self) -> f64 {
        self.share(|cell| cell.impacts > 1 && counted(cell))
    }

    /// Different numbers of impacts before overturning, beyond one.
    fn counts(&self) -> BTreeSet<u32> {
        let cells = self.outcomes.iter().filter(|cell| cell.impacts > 1 && counted(cell));
        cells.map(|cell| cell.impacts).collect()
    }
}

/// True where a block overturned, and how many impacts there were does not hang on when it counts
/// as resting.
fn counted(cell: &Outcome) -> bool {
    cell.class.overturned() && cell.uplifts < 2
}

/// The panels of a figure of pulses, run.
fn ran(name: &str, cells: u32) -> Vec<Ran> {
    figure(name, Some(cells), None).0.panels.into_iter().map(Ran::new).collect()
}

/// The panel of an eccentricity and a vertical amplitude.
fn at(panels: &[Ran], e: f64, a_v: f64) -> &Ran {
    let found = panels.iter().find(|ran| {
        let case = ran.panel.scene.case();
        let a_v_there = case.shaking.pulse().map(|pulse| pulse.a_v);
        case.block.eccentricity == e && a_v_there == Some(a_v)
    });
    found.unwrap_or_else(|| panic!("no panel at {e}, {a_v}"))
}

/// The outcomes along a path of a panel, upwards.
fn along_path(name: &str, panel: usize) -> Vec<(f64, Outcome)> {
    let (figure, _) = figure(name, None, None);
    let panel = &figure.panels[panel];
    let scene = panel.paths[0].scene(&panel.scene).unwrap();
    let grid = Grid::of(&scene);
    swept(&scene).into_iter().enumerate().map(|(k, cell)| (xy(&grid, k).1, cell)).collect()
}

/// The impact counts along a path, each once in order, while its cells overturn about `class`, had
/// no rest, and had impacts.
fn sequence(path: &[(f64, Outcome)], class: Class) -> Vec<u32> {
    let cells = path.iter().filter(|(_, cell)| cell.class == class && counted(cell));
    let mut counts: Vec<u32> = cells.map(|(_, cell)| cell.impacts).filter(|n| *n > 0).collect();
    counts.dedup();
    counts
}
