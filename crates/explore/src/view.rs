//! A view of a map: coarse at first, then fine, then refined along boundaries.

use std::sync::atomic::AtomicBool;
use std::time::Instant;

use serde_json::json;

use super::asked::AskedPrecision;
use super::frame::{PRECISION, frame};
use super::refused::Refused;
use super::session::{Ready, Session};
use super::stage::{StageSummary, ViewRequest, header};
use super::stages::Stages;
use super::suites::UNUSED;
use super::watched::Watched;
use topple::model::precision::Precision;
use topple::refine::run::refine_on;
use topple::refine::settings::RefineSettings;
use topple::results::chunk::in_array;
use topple::results::columns::{Column, TABLE};
use topple::results::outcomes::Outcomes;
use topple::results::store_error::StoreError;
use topple::results::values::ColumnValues;
use topple::stepping::outcome::{Class, Outcome};
use topple::sweep::error::SweepError;
use topple::sweep::job::{Job, SweepResult};
use topple::sweep::map::MapSweep;
use topple::work::observer::Observer;
use topple_pictures::colours::palette::{Kind, is_dotted};
use topple_pictures::map::Map;

/// What a view shows where it shows no column as a shade.
const OUTCOMES: &str = "outcome";
/// Share of a column's range by which numbers that are taken over may be off, where they are shown.
const SMOOTH: f64 = 0.02;
/// Cells drawn at random a level, to find regions that the fine picture has missed.
const PROBES: usize = 500;

/// Marks of a cell.
pub const HATCHED: u8 = 1;
/// The outcome of it is not known.
pub const CROSSED: u8 = 2;
/// It overturns about the right corner after impacts.
pub const DOTTED: u8 = 4;

/// It was not run: its outcome is that of the cells around it, its other numbers are those of a cell beside it, or
/// between those of cells around it.
pub const TAKEN_OVER: u8 = 8;

/// Computes a view; `send` is handed its pictures as frames, and says whether there is still somebody to take them; `tell` is
/// handed frames that say how far a picture is.
pub fn run(
    session: &Session,
    request: &ViewRequest,
    stop: &AtomicBool,
    send: impl Fn(Vec<u8>) -> bool,
    tell: &(dyn Fn(Vec<u8>) + Sync),
) -> Result<(), Refused> {
    let ViewRequest { scene, count, precision, columns, .. } = request;
    session.suites.rest(UNUSED);
    let grids = Stages::of(scene, *count)?;
    let levels = grids.levels;
    // All stages are of one number type: it does not depend on the count.
    let finest = session.ready(scene, grids.count(0), *precision)?;
    let note = match (*precision, AskedPrecision::Auto.of(&finest.grid)) {
        (AskedPrecision::F32, Precision::F64) => {
            "f32 hardly tells neighbouring cells apart here; f64 does"
        }
        _ => "",
    };
    let mut stages = vec![("coarse", levels)];
    if levels > 1 {
        stages.push(("fine", 1));
    }
    let mut last: Option<MapSweep> = None;
    for (stage, doubled) in stages {
        let ready = session.ready(scene, grids.count(doubled), *precision)?;
        let began = Instant::now();
        let map = sweep(&ready, &Watched::new(stage, stop, tell))?;
        let seconds = Some(began.elapsed().as_secs_f64());
        let told = StageSummary { stage, cells: map.grid.len(), seconds, note };
        if !send(framed(&whole(&map)?, &ready, &told, columns)) {
            return Ok(());
        }
        last = Some(map);
    }
    if let Some(map) = last.filter(|_| levels > 0) {
        let mut settings = RefineSettings::levels(1);
        settings.probes = PROBES;
        // Of a shade numbers are seen, too.
        settings.smooth = request.show.as_ref().filter(|show| *show != OUTCOMES).map(|_| SMOOTH);
        let (stage, began) = ("refined", Instant::now());
        let watched = Watched::new(stage, stop, tell);
        let refined = refine_on(&map, &finest.opened.backends, &settings, &watched)?;
        let told = StageSummary {
            stage,
            cells: refined.report.cells - map.grid.len(),
            seconds: Some(began.elapsed().as_secs_f64()),
            note,
        };
        let outcomes = refined.read(0..refined.grid.len(), &Column::ALL)?;
        let map_of = Map {
            scene: &refined.scene,
            grid: refined.grid.clone(),
            outcomes,
            columns: refined.source().columns,
        };
        let mut arrays = arrays(&map_of, columns);
        if let Some((_, ColumnValues::Codes(marks))) =
            arrays.iter_mut().find(|own| own.0 == "marks")
        {
            let mut ran = refined.cells().iter().peekable();
            for (cell, mark) in marks.iter_mut().enumerate() {
                let is_run = ran.next_if(|own| **own == cell).is_some();
                *mark |= if is_run { 0 } else { TAKEN_OVER };
            }
        }
        let mut header = header(&refined.grid, &finest, &told);
        header["probes"] = json!(refined.report.last_round());
        send(frame(header, &arrays));
    }
    Ok(())
}

/// Sweeps a scene that is ready.
pub fn sweep(ready: &Ready, observer: &dyn Observer) -> Result<MapSweep, SweepError> {
    let job = Job::on(&ready.opened, &ready.scene, &[], &ready.settings)?;
    match job.run(None, observer)? {
        SweepResult::Map(map) => Ok(*map),
        // A shard is run where one is asked for, which the page does not.
        SweepResult::Shard(_) => Err(StoreError::Incomplete.into()),
    }
}

/// The frame of a map.
pub fn framed(map: &Map, ready: &Ready, told: &StageSummary, columns: &[String]) -> Vec<u8> {
    frame(header(&map.grid, ready, told), &arrays(map, columns))
}

/// The places of kinds in the page's list.
pub fn kind(outcome: &Outcome, kinds: &[Kind]) -> u8 {
    let own = Kind::of(outcome);
    kinds.iter().position(|kind| *kind == own).unwrap_or(kinds.len()) as u8
}

/// The marks of a cell; `beyond`: the model is not valid somewhere.
pub fn marks(outcome: &Outcome, beyond: bool) -> u8 {
    let mark = |is: bool, mark: u8| if is { mark } else { 0 };
    mark(beyond, HATCHED)
        | mark(outcome.class == Class::Unresolved, CROSSED)
        | mark(is_dotted(outcome), DOTTED)
}

/// The arrays of a map: kinds, marks, and the columns asked for. A name that is no column's is passed over.
fn arrays<'a>(map: &Map, columns: &'a [String]) -> Vec<(&'a str, ColumnValues)> {
    let kinds = Kind::all();
    let each = map.outcomes.iter();
    let all_marks = each.clone().zip(0..).map(|(own, cell)| marks(own, map.beyond_the_model(cell)));
    let mut arrays = vec![
        ("kind", ColumnValues::Codes(each.map(|outcome| kind(outcome, &kinds)).collect())),
        ("marks", ColumnValues::Codes(all_marks.collect())),
    ];
    for name in columns {
        let Some(entry) = TABLE.iter().find(|entry| entry.name == name) else { continue };
        // Outcomes in memory are read without an error.
        let cells = 0..map.outcomes.len();
        let Ok(values) = map.outcomes.column(cells, entry.column, PRECISION) else { continue };
        arrays.push((name, in_array(name, entry.column, values)));
    }
    arrays
}

/// A sweep as a map in memory.
pub fn whole(map: &MapSweep) -> Result<Map<'_>, Refused> {
    let outcomes = map.outcomes.read(0..map.grid.len(), &Column::ALL)?;
    let (grid, columns) = (map.grid.clone(), map.method.columns);
    Ok(Map { scene: &map.plan.scene, grid, outcomes, columns })
}
