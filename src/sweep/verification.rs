//! The verification of a sweep: the reference runs a sample of its cells again.

use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::sample::Chosen;
use crate::backend::by_reference::by_reference;
use crate::cells::plan::Plan;
use crate::results::column_set::ColumnSet;
use crate::results::columns::Column;
use crate::scene::{Case, Grid};
use crate::stepping::outcome::{Class, Outcome};
use crate::stepping::reference::Settings;
use crate::work::observer::Observer;
use crate::work::parallel;

/// The surroundings of a cell whose outcome differs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Region {
    /// The contact force became tensile: the model is not valid there. Pictures hatch such cells.
    Tensile,
    /// A neighbour has another outcome.
    BesideBoundary,
    /// The reference has other outcomes, too, where the block is a millionth wider or narrower: its rocking is
    /// chaotic, and no number of the scene is known that well.
    Sensitive,
    /// The cell lies among cells of one outcome.
    Inside,
}

/// A cell that sweep and reference have run.
#[derive(Debug, Clone, Copy)]
pub struct Judged {
    /// The cell, with the outcome of the sweep.
    pub chosen: Chosen,
    /// The reference's outcome.
    pub reference: Outcome,
    /// True where the outcome depends on a millionth of the block's width. Looked for only where both outcomes differ for no other
    /// reason.
    pub sensitive: bool,
}

/// The relative change of the block's width by which the dependence of an outcome on it is tested. In f32 a number of the scene
/// is rounded by a tenth of that.
const CHANGE: f64 = 1.0e-6;

impl Judged {
    fn region(&self) -> Region {
        // A sweep with wrong contact forces would excuse itself.
        if self.reference.loses_contact() {
            Region::Tensile
        } else if self.chosen.beside_boundary {
            Region::BesideBoundary
        } else if self.sensitive {
            Region::Sensitive
        } else {
            Region::Inside
        }
    }
}

/// A cell on which sweep and reference disagree.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Difference {
    /// Values of the axes.
    pub at: Vec<f64>,
    /// The sweep's outcome.
    pub sweep: Class,
    /// The reference's outcome.
    pub reference: Class,
    /// Where the cell lies.
    pub region: Region,
}

/// The conclusion from the sample about the map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// No outcome differs. Impacts, times and zeta of single cells may differ.
    Right,
    /// Outcomes differ no more than is expected: only where the model is not valid, or in a few of the cells beside a boundary.
    AsExpected,
    /// Outcomes differ where they should not, or zeta differs too much.
    Wrong,
    /// No cell that has an outcome was run again.
    Nothing,
}

/// The results of the sample.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Verification {
    /// The conclusion about the map.
    pub verdict: Verdict,
    /// Cells that were chosen.
    pub chosen: usize,
    /// Cells that were run again: fewer than were chosen where the time was up, or where the reference gave a cell up.
    pub sampled: usize,
    /// Those of them beside a boundary between outcomes.
    pub beside_boundary: usize,
    /// Cells without a result of the sweep.
    pub unresolved: usize,
    /// Cells whose outcome differs.
    pub differ: usize,
    /// Those of them in which the contact force turned tensile.
    pub differ_tensile: usize,
    /// Those of the others beside a boundary.
    pub differ_beside_boundary: usize,
    /// Those of the rest whose rocking is chaotic.
    pub differ_sensitive: usize,
    /// The first cells that differ.
    pub differences: Vec<Difference>,
    /// Overturned cells, agreeing about it, whose impact count differs.
    pub impacts_differ: usize,
    /// Largest error of the time of overturning where outcome and impacts agree, s; none if it was not requested.
    pub worst_t_end: Option<f64>,
    /// Largest error of the first uplift where the outcome agrees, s; none if it was not requested.
    pub worst_t_uplift: Option<f64>,
    /// Largest error of zeta where the outcome agrees; none if zeta was not requested.
    pub worst_zeta: Option<f64>,
    /// Median error of zeta over the cells that rock; the same.
    pub median_zeta: Option<f64>,
}

/// |dphi| below which a landing block comes to rest, rad/s: ten times the reference's own. Where an impact loses
/// next to no speed (plates without mass), a block chatters for seconds, and each tenth of this speed has ten
/// times as many impacts. Outcomes do not depend on it (`tests/engine/reference.rs`).
const REST_SPEED: f64 = 1.0e-4;
/// Longest step during the excitation, s: two and a half times the reference's own. The error of a step allows it, a sixteenth of
/// the shortest period of base and pulse bounds it, too, and under a record a step ends at each sample. Outcomes do not depend on
/// it (`tests/engine/reference.rs`).
const LONGEST: f64 = 0.025;
/// Longest step after the excitation, s: five times the reference's own. Half of the cells that a sample runs again never
/// overturn, and swing for most of their time, where what the step errs by would allow such steps. A sixteenth of the
/// base's shortest period bounds it, too, and outcomes do not depend on it (`tests/engine/reference.rs`).
const LONGEST_FREE: f64 = 0.05;
/// Most differing cells that are listed.
const LISTED: usize = 16;
/// Largest share of the cells beside a boundary that may differ: a boundary that lies off by a tenth of a cell
/// moves so many of them to the other side.
const OFF: f64 = 0.1;
/// Largest median error of zeta: a hundredth of its scale from full contact to overturning.
pub const ZETA_OFF: f64 = 0.01;

impl Verification {
    /// Cells that differ neither where the model is not valid, nor beside a boundary, nor in chaotic rocking.
    pub fn differ_inside(&self) -> usize {
        self.differ - self.differ_tensile - self.differ_beside_boundary - self.differ_sensitive
    }

    fn judge(&self) -> Verdict {
        // One may always lie that close to a boundary.
        let few = (OFF * self.beside_boundary as f64).max(1.0);
        let wrong = self.differ_inside() > 0
            || self.differ_beside_boundary as f64 > few
            || self.median_zeta.is_some_and(|error| error > ZETA_OFF);
        match (self.sampled - self.unresolved, self.differ) {
            (0, _) => Verdict::Nothing,
            _ if wrong => Verdict::Wrong,
            (_, 0) => Verdict::Right,
            _ => Verdict::AsExpected,
        }
    }
}

/// Runs chosen cells of a sweep again by the reference and compares; those that are not done `within` a time, or that the
/// reference gives up, are left out. `observer` hears of cells; none where it is cancelled.
pub fn verify(
    (plan, columns): (&Plan, ColumnSet),
    grid: &Grid,
    (chosen, within): (&[Chosen], Duration),
    observer: &dyn Observer,
) -> Option<Verification> {
    let began = Instant::now();
    let go_on = || !observer.cancelled() && began.elapsed() < within;
    let judge = |&chosen: &Chosen| {
        let judged = judge(plan, &grid.case(chosen.cell), chosen, &go_on)?;
        observer.advance(1);
        Some(judged)
    };
    let judged: Vec<Option<Judged>> =
        parallel::each(chosen.len(), 1, |number| judge(&chosen[number]));
    if observer.cancelled() {
        return None;
    }
    let report = compare(grid, columns, judged.into_iter().flatten());
    Some(Verification { chosen: chosen.len(), ..report })
}

/// Runs a chosen cell again by the reference, and where its outcome differs two cells that are a little wider and narrower. None
/// where one of them is not to `go_on` to its end, or the reference gives the cell up: then nothing is known of the cell.
fn judge(plan: &Plan, case: &Case, chosen: Chosen, go_on: &dyn Fn() -> bool) -> Option<Judged> {
    let settings = Settings {
        rest_speed: REST_SPEED,
        longest: LONGEST,
        longest_free: LONGEST_FREE,
        ends_decided: true,
        ..Settings::default()
    };
    let run = |case: &Case| {
        let outcome = go_on().then(|| by_reference(plan, case, &settings, go_on))??;
        (outcome.class != Class::Unresolved).then_some(outcome)
    };
    let reference = run(case)?;
    let mut judged = Judged { chosen, reference, sensitive: false };
    if chosen.outcome.class != reference.class && judged.region() == Region::Inside {
        for width in [1.0 - CHANGE, 1.0 + CHANGE] {
            let mut changed = *case;
            changed.block.half_width *= width;
            if run(&changed)?.class != reference.class {
                judged.sensitive = true;
                break;
            }
        }
    }
    Some(judged)
}

/// Compares cells that sweep and reference have run, in those columns of the sweep.
pub fn compare(
    grid: &Grid,
    columns: ColumnSet,
    judged: impl IntoIterator<Item = Judged>,
) -> Verification {
    let known = |column| columns.held().has(column).then_some(0.0);
    let zeta = known(Column::Zeta);
    let mut report = Verification {
        verdict: Verdict::Nothing,
        chosen: 0,
        sampled: 0,
        beside_boundary: 0,
        unresolved: 0,
        differ: 0,
        differ_tensile: 0,
        differ_beside_boundary: 0,
        differ_sensitive: 0,
        differences: Vec::new(),
        impacts_differ: 0,
        worst_t_end: known(Column::TEnd),
        worst_t_uplift: known(Column::TUplift),
        worst_zeta: zeta,
        median_zeta: zeta,
    };
    let mut zeta_errors = Vec::new();
    for judged in judged {
        let Judged { chosen, reference, .. } = judged;
        let cell = chosen.outcome;
        report.sampled += 1;
        report.beside_boundary += usize::from(chosen.beside_boundary);
        if cell.class == Class::Unresolved {
            report.unresolved += 1;
            continue;
        }
        if cell.class != reference.class {
            let region = judged.region();
            report.differ += 1;
            report.differ_tensile += usize::from(region == Region::Tensile);
            report.differ_beside_boundary += usize::from(region == Region::BesideBoundary);
            report.differ_sensitive += usize::from(region == Region::Sensitive);
            if report.differences.len() < LISTED {
                let at = grid.coordinates(chosen.cell).collect();
                let (sweep, reference) = (cell.class, reference.class);
                report.differences.push(Difference { at, sweep, reference, region });
            }
            continue;
        }
        if let (Some(a), Some(b)) = (cell.t_uplift, reference.t_uplift) {
            report.worst_t_uplift = report.worst_t_uplift.map(|worst| worst.max((a - b).abs()));
        }
        if cell.class.overturned() {
            if cell.impacts == reference.impacts {
                let error = (cell.t_end - reference.t_end).abs();
                report.worst_t_end = report.worst_t_end.map(|worst| worst.max(error));
            } else {
                report.impacts_differ += 1;
            }
        } else if let Some(worst) = &mut report.worst_zeta {
            let error = (cell.zeta - reference.zeta).abs();
            // No number at all is as wrong as can be.
            let error = if error.is_nan() { f64::INFINITY } else { error };
            *worst = worst.max(error);
            if cell.class == Class::Rocking {
                zeta_errors.push(error);
            }
        }
    }
    zeta_errors.sort_by(f64::total_cmp);
    let median = zeta_errors.get(zeta_errors.len() / 2).copied();
    report.median_zeta = zeta.map(|none| median.unwrap_or(none));
    report.chosen = report.sampled;
    report.verdict = report.judge();
    report
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;
    use crate::cells::clock::DEFAULT_STEP;
    use crate::scene::{Parameter, Range, Scene, SceneBuilder};

    fn scene() -> Scene {
        SceneBuilder::object(1)
            .with(Parameter::TH, 1.75)
            .with(Parameter::TV, 0.75)
            .with(Parameter::Omega, Range::even(1.0, 8.0, 10))
            .with(Parameter::AH, Range::even(1.0, 8.0, 10))
            .check()
            .unwrap()
    }

    fn grid() -> Grid {
        Grid::of(&scene())
    }

    fn outcome(class: Class, min_contact: f64) -> Outcome {
        Outcome { class, min_contact, ..Outcome::PENDING }
    }

    /// A sample of 40 cells, 20 of them beside a boundary, of which some have another outcome.
    fn report(beside: usize, inside: usize, tensile: usize) -> Verification {
        let judged = (0..40).map(|cell| {
            let beside_boundary = cell < 20;
            let differs =
                cell < beside || (20..20 + inside).contains(&cell) || cell >= 40 - tensile;
            let force = if cell >= 40 - tensile { -1.0 } else { 1.0 };
            let outcome_of = |class| outcome(class, force);
            let outcome = outcome_of(Class::Rocking);
            let reference =
                outcome_of(if differs { Class::OverturnedLeft } else { Class::Rocking });
            let sensitive = (30..33).contains(&cell);
            Judged { chosen: Chosen { cell, beside_boundary, outcome }, reference, sensitive }
        });
        compare(&grid(), ColumnSet::ALL, judged)
    }

    #[test]
    fn the_verdict_weighs_where_cells_differ() {
        let verdict = |beside, inside, tensile| report(beside, inside, tensile).verdict;
        assert_eq!(verdict(0, 0, 0), Verdict::Right);
        // A tenth of those beside a boundary, and any where the model does not hold.
        assert_eq!(verdict(2, 0, 0), Verdict::AsExpected);
        assert_eq!(verdict(3, 0, 0), Verdict::Wrong);
        assert_eq!(verdict(0, 0, 5), Verdict::AsExpected);
        assert_eq!(verdict(0, 1, 0), Verdict::Wrong);
        // Of cells 20 to 30 the last is sensitive.
        let several = report(0, 11, 0);
        assert_eq!((several.verdict, several.differ_sensitive), (Verdict::Wrong, 1));
        assert_eq!(several.differ_inside(), 10);
        let one = |sensitive| {
            let chosen =
                Chosen { cell: 5, beside_boundary: false, outcome: outcome(Class::Rocking, 1.0) };
            let reference = outcome(Class::OverturnedLeft, 1.0);
            compare(&grid(), ColumnSet::ALL, [Judged { chosen, reference, sensitive }]).verdict
        };
        assert_eq!((one(true), one(false)), (Verdict::AsExpected, Verdict::Wrong));
        assert_eq!(compare(&grid(), ColumnSet::ALL, []).verdict, Verdict::Nothing);
        let report = report(2, 3, 4);
        assert_eq!((report.sampled, report.beside_boundary, report.differ), (40, 20, 9));
        assert_eq!((report.differ_beside_boundary, report.differ_tensile), (2, 4));
        assert_eq!(report.differ_inside(), 3);
        assert_eq!(report.differences[2].region, Region::Inside);
        assert_eq!(report.differences[8].region, Region::Tensile);
    }

    /// A cell whose outcome differs is run twice more, to see whether a millionth of its width decides it. Where the time is up
    /// before that is known, nothing is known of the cell: it is left out, and not counted as wrong.
    #[test]
    fn a_cell_that_is_not_done_is_left_out() {
        let (plan, grid) = (Plan::new(&scene(), DEFAULT_STEP).unwrap(), grid());
        let cell = 0;
        let calls = AtomicUsize::new(0);
        let judged = |differs: bool, most: usize| {
            calls.store(0, Ordering::Relaxed);
            let go_on = || calls.fetch_add(1, Ordering::Relaxed) < most;
            let class = if differs { Class::OverturnedLeft } else { Class::FullContact };
            let chosen = Chosen { cell, beside_boundary: false, outcome: outcome(class, 1.0) };
            let judged = judge(&plan, &grid.case(cell), chosen, &go_on);
            (judged, calls.load(Ordering::Relaxed))
        };
        let (right, once) = judged(false, usize::MAX);
        assert_eq!(right.map(|judged| judged.reference.class), Some(Class::FullContact));
        let (wrong, thrice) = judged(true, usize::MAX);
        assert_eq!(wrong.map(|judged| judged.sensitive), Some(false));
        assert!(thrice > 2 * once, "{once}, {thrice}");
        // Time for the first run, for the first two, and for nearly all of the three.
        for most in [0, once, once + 1, 2 * once + 1, thrice - 1] {
            assert!(judged(true, most).0.is_none(), "{most} of {thrice}");
        }
        assert!(judged(false, once).0.is_some());
    }

    /// Half of the rocking cells far off in zeta: the outcomes alone would not tell it.
    #[test]
    fn the_verdict_weighs_zeta() {
        let judged = |error: f64| {
            (0..10).map(move |cell| {
                let outcome = Outcome { zeta: 0.5 + error, ..outcome(Class::Rocking, 1.0) };
                let reference = Outcome { zeta: 0.5, ..outcome };
                let chosen = Chosen { cell, beside_boundary: false, outcome };
                Judged { chosen, reference, sensitive: false }
            })
        };
        assert_eq!(compare(&grid(), ColumnSet::ALL, judged(0.009)).verdict, Verdict::Right);
        assert_eq!(compare(&grid(), ColumnSet::ALL, judged(0.011)).verdict, Verdict::Wrong);
    }
}
