//! The ten maps by the reference, 36,000 cells of 30 s, as `tests/data/ten-maps.csv.gz` has them.

use std::sync::LazyLock;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use topple::scene::{Grid, Scene};
use topple::stepping::outcome::{Class, Outcome};
use topple::stepping::reference::{self, Settings};
use topple::sweep::sample::sample;
use topple_lab::chart::bench::MAPS;

use crate::common::{all, object};
use crate::stored::{Table, class};

/// Points of an axis.
pub const SIDE: usize = 60;

/// A scene, and its cells' outcomes by the reference.
type Judged = (Scene, Vec<Outcome>);

/// The ten maps as they are stored: of an outcome what `compare` looks at where outcomes agree.
pub static JUDGED: LazyLock<Vec<Judged>> = LazyLock::new(|| {
    let rows = table().rows::<Row>();
    assert_eq!(rows.len(), MAPS.len() * SIDE * SIDE);
    let of_map = |(map, rows): ((f64, f64), &[Row])| {
        assert!(rows.iter().all(|row| (row.a_v, row.eccentricity) == map));
        (map_scene(map), rows.iter().map(Row::outcome).collect())
    };
    MAPS.into_iter().zip(rows.chunks(SIDE * SIDE)).map(of_map).collect()
});

fn table() -> Table {
    Table {
        name: "ten-maps.csv.gz",
        packed: include_bytes!("../../data/ten-maps.csv.gz"),
        head: format!(
            "The outcomes of the reference on the maps of Figs. 11 and 13: Object 1, T_h = 1.75 s, T_v = 0.75 s,\n\
             {SIDE} values of omega from 0.2 to 15 rad/s (fastest) by {SIDE} of A_h from 0.1 to 15 m/s^2, 30 s.\n\
             {:?}",
            Settings::default()
        ),
    }
}

fn map_scene((a_v, e): (f64, f64)) -> Scene {
    object(1, e, (1.75, 0.75), a_v, &format!("0.2:15:{SIDE}"), &format!("0.1:15:{SIDE}"))
}

/// Some cells of a scene by the reference.
fn run(scene: &Scene, cells: &[usize]) -> Vec<Outcome> {
    let grid = Grid::of(scene);
    let run = |&cell: &usize| reference::run(scene, &grid.case(cell), &Settings::default());
    cells.par_iter().map(run).collect()
}

/// Every cell of a scene by the reference.
pub fn judged(scene: &Scene) -> Vec<Outcome> {
    run(scene, &all(&Grid::of(scene)))
}

/// A cell in the file.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Row {
    a_v: f64,
    eccentricity: f64,
    #[serde(deserialize_with = "class")]
    outcome: Class,
    impacts: u32,
    t_end: f64,
    t_uplift: Option<f64>,
    zeta: f64,
}

impl Row {
    fn of((a_v, eccentricity): (f64, f64), cell: &Outcome) -> Row {
        let &Outcome { class: outcome, impacts, t_end, t_uplift, zeta, .. } = cell;
        Row { a_v, eccentricity, outcome, impacts, t_end, t_uplift, zeta }
    }

    fn outcome(&self) -> Outcome {
        let &Row { outcome: class, impacts, t_end, t_uplift, zeta, .. } = self;
        Outcome { class, impacts, t_end, t_uplift, zeta, ..Outcome::PENDING }
    }
}

/// Cells of a map that each run computes again.
const SAMPLE: usize = 13;

/// How far numbers may be off, s and without a unit: the reference's tolerance. On another machine sines and the like differ
/// in the last digit, and so may the steps. That is less than a block wider by 1e-14, which changes times in the sample by
/// 7e-13 s and zeta by 2e-13, or than another tolerance: from 1e-9 to 1e-12 they change by 2e-12 s and 6e-13. Neither
/// changes an outcome or a number of impacts.
const OFF: f64 = 1.0e-10;

/// Holds a stored row to what the reference finds now.
fn hold(stored: &Row, found: &Row) {
    let said = |row: &Row| (row.outcome, row.impacts, row.t_uplift.is_some());
    assert_eq!(said(stored), said(found), "{stored:?} {found:?}");
    let uplift = stored.t_uplift.zip(found.t_uplift).map_or(0.0, |(a, b)| a - b);
    let off = [stored.t_end - found.t_end, stored.zeta - found.zeta, uplift];
    assert!(off.iter().all(|off| off.abs() <= OFF), "{stored:?} {found:?}");
}

#[test]
fn stored_outcomes_are_the_references() {
    let mut chosen = Vec::new();
    for (map, (scene, stored)) in MAPS.into_iter().zip(JUDGED.iter()) {
        let of_map = sample(&Grid::of(scene), stored, SAMPLE).unwrap();
        let cells: Vec<usize> = of_map.iter().map(|one| one.cell).collect();
        for (one, found) in of_map.iter().zip(run(scene, &cells)) {
            hold(&Row::of(map, &one.outcome), &Row::of(map, &found));
        }
        chosen.extend(of_map);
    }
    for class in Class::ALL.into_iter().filter(|class| *class != Class::Unresolved) {
        let count = chosen.iter().filter(|one| one.outcome.class == class).count();
        assert!(count >= 16, "{count} of {class:?}");
    }
    assert!(chosen.iter().filter(|one| one.beside_boundary).count() >= 50);
}

#[test]
#[ignore = "integrates 36,000 cells: cargo test --test lab every_stored -- --ignored"]
fn every_stored_outcome_is_the_references() {
    let of_map = |map| judged(&map_scene(map)).into_iter().map(move |cell| Row::of(map, &cell));
    let rows: Vec<Row> = MAPS.into_iter().flat_map(of_map).collect();
    table().renew(&rows, hold);
}
