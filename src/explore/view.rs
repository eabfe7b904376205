//! A view of a map: coarse at first, then fine, then refined along boundaries.

use std::sync::atomic::AtomicBool;
use std::time::Instant;

use super::asked::{AskedPrecision, axes};
use super::frame::{Array, frame};
use super::refused::Refused;
use super::session::{Ready, Session};
use super::stage::{Told, ViewRequest, header};
use crate::drawing::palette::{Kind, is_dotted};
use crate::map::Map;
use crate::model::precision::Precision;
use crate::refine::run::refine_on;
use crate::refine::settings::RefineSettings;
use crate::results::columns::{Column, Holds, TABLE};
use crate::results::outcomes::Outcomes;
use crate::results::store_error::StoreError;
use crate::stepping::outcome::{Class, Outcome};
use crate::sweep::error::SweepError;
use crate::sweep::job::{Job, SweepResult};
use crate::sweep::map::MapSweep;

/// Gaps along an axis of the coarse picture at most.
const COARSE: u32 = 64;
/// Cells along an axis at least and at most.
const COUNTS: (u32, u32) = (2, 2049);
/// Cells drawn at random a level, to find regions that the fine picture has missed.
const PROBES: usize = 500;

/// Marks of a cell.
pub const HATCHED: u8 = 1;
/// Nothing can be said of it.
pub const CROSSED: u8 = 2;
/// It overturns about the right corner after impacts.
pub const DOTTED: u8 = 4;

/// The cells along both axes of a stage that has 2^`halved` times fewer gaps than the finest one. All stages have
/// their cells among those of the finest.
fn counts(count: [u32; 2], levels: u32, halved: u32) -> [u32; 2] {
    count.map(|count| {
        let gaps = (count.clamp(COUNTS.0, COUNTS.1) - 1).next_multiple_of(1 << levels);
        (gaps >> halved) + 1
    })
}

/// How often the gaps of the coarse picture are halved down to the finest.
fn levels(count: [u32; 2]) -> u32 {
    let gaps = count.map(|count| count.clamp(COUNTS.0, COUNTS.1) - 1);
    gaps.into_iter().max().unwrap_or(1).div_ceil(COARSE).next_power_of_two().ilog2()
}

/// Computes a view; `send` is handed frames, and says whether there is still somebody to take them.
///
/// # Errors
/// The first key at fault; those of a sweep; that it was ended.
pub fn run(
    session: &Session,
    request: &ViewRequest,
    stop: &AtomicBool,
    mut send: impl FnMut(Vec<u8>) -> bool,
) -> Result<(), Refused> {
    let ViewRequest { scene, count, precision, columns, .. } = request;
    axes(scene)?;
    // All stages are of one number type.
    let levels = levels(*count);
    let finest = session.ready(scene, counts(*count, levels, 0), *precision)?;
    let precision = match finest.settings.method.precision {
        Precision::F32 => AskedPrecision::F32,
        Precision::F64 => AskedPrecision::F64,
    };
    let note = match (request.precision, AskedPrecision::Auto.of(&finest.grid)) {
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
    for (stage, halved) in stages {
        let ready = session.ready(scene, counts(*count, levels, halved), precision)?;
        let began = Instant::now();
        let map = sweep(&ready, stop)?;
        let told =
            Told { stage, cells: map.grid.len(), seconds: began.elapsed().as_secs_f64(), note };
        if !send(framed(&whole(&map)?, &ready, &told, columns)) {
            return Ok(());
        }
        last = Some(map);
    }
    if let Some(map) = last.filter(|_| levels > 0) {
        let mut settings = RefineSettings::levels(1);
        settings.probes = PROBES;
        let began = Instant::now();
        let refined = refine_on(&map, &finest.opened.backends, &settings, stop)?;
        let told = Told {
            stage: "refined",
            cells: refined.report.cells - map.grid.len(),
            seconds: began.elapsed().as_secs_f64(),
            note,
        };
        let outcomes = refined.read(0..refined.grid.len(), &Column::ALL)?;
        let map_of = Map { scene: &refined.scene, grid: refined.grid.clone(), outcomes };
        send(framed(&map_of, &finest, &told, columns));
    }
    Ok(())
}

/// Sweeps a scene that is ready.
///
/// # Errors
/// Those of a sweep; that it was ended.
pub fn sweep(ready: &Ready, stop: &AtomicBool) -> Result<MapSweep, SweepError> {
    let job = Job::on(&ready.opened, &ready.scene, &[], &ready.settings)?;
    match job.run(None, stop)? {
        SweepResult::Map(map) => Ok(*map),
        // A part is run where one is asked for, which the page does not.
        SweepResult::Part(_) => Err(StoreError::Incomplete.into()),
    }
}

/// The frame of a map.
pub fn framed(map: &Map, ready: &Ready, told: &Told, columns: &[String]) -> Vec<u8> {
    frame(header(&map.grid, ready, told), &arrays(map, columns))
}

/// The places of kinds in the page's list.
pub fn kind(outcome: &Outcome, kinds: &[Kind]) -> u8 {
    let own = Kind::of(outcome);
    kinds.iter().position(|kind| *kind == own).unwrap_or(kinds.len()) as u8
}

/// The marks of a cell; `beyond`: the model does not hold somewhere.
pub fn marks(outcome: &Outcome, beyond: bool) -> u8 {
    let mark = |is: bool, mark: u8| if is { mark } else { 0 };
    mark(beyond, HATCHED)
        | mark(outcome.class == Class::Unresolved, CROSSED)
        | mark(is_dotted(outcome), DOTTED)
}

/// The arrays of a map: kinds, marks, and the columns asked for. A name that is no column's is passed over.
fn arrays<'a>(map: &Map, columns: &'a [String]) -> Vec<(&'a str, Array)> {
    let kinds = Kind::all();
    let each = map.outcomes.iter();
    let all_marks = each.clone().zip(0..).map(|(own, cell)| marks(own, map.beyond_the_model(cell)));
    let mut arrays = vec![
        ("kind", Array::Bytes(each.map(|outcome| kind(outcome, &kinds)).collect())),
        ("marks", Array::Bytes(all_marks.collect())),
    ];
    for name in columns {
        let Some(entry) = TABLE.iter().find(|entry| entry.name == name) else { continue };
        let holds = entry.holds;
        let numbers = map.outcomes.iter().map(|outcome| holds.number(outcome));
        let array = match holds {
            Holds::Class | Holds::Status => Array::Bytes(numbers.map(|code| code as u8).collect()),
            Holds::Count { .. } => Array::Counts(numbers.map(|count| count as u32).collect()),
            Holds::Number { .. } | Holds::Time { .. } => {
                Array::Singles(numbers.map(|number| number as f32).collect())
            }
        };
        arrays.push((name, array));
    }
    arrays
}

/// A sweep as a map in memory.
///
/// # Errors
/// Those of reading.
pub fn whole(map: &MapSweep) -> Result<Map<'_>, Refused> {
    let outcomes = map.outcomes.read(0..map.grid.len(), &Column::ALL)?;
    Ok(Map { scene: &map.plan.scene, grid: map.grid.clone(), outcomes })
}

#[cfg(test)]
mod tests {
    use super::{counts, levels};

    #[test]
    fn every_stage_has_its_cells_among_those_of_the_finest() {
        for count in [[2, 2], [33, 70], [512, 512], [513, 300], [2000, 5000]] {
            let levels = levels(count);
            let finest = counts(count, levels, 0);
            assert!(finest.iter().zip(count).all(|(have, asked)| *have >= asked.min(2049)));
            let coarse = counts(count, levels, levels);
            assert!(coarse.iter().all(|count| *count <= 66), "{coarse:?}");
            for halved in 0..=levels {
                let stage = counts(count, levels, halved);
                for (fine, coarse) in finest.into_iter().zip(stage) {
                    assert_eq!(fine - 1, (coarse - 1) << halved);
                }
            }
        }
    }
}
