//! What the reference says beside boundaries, as `tests/data` has it: on which side of them single cells lie, and the
//! cells of the scenes that are hardest to decide, at two tolerances.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use topple::scene::{Grid, Scene};
use topple::stepping::outcome::{Class, Outcome};
use topple::stepping::reference::{self, Settings};
use topple::sweep::sample::sample;

use super::super::{tight, truth};
use super::{CHAOTIC, FINE, fine_structure, short_periods};
use crate::common::{all, object};
use crate::stored::{Table, class};

/// The distances from a boundary: 10 to the power of minus this, of the amplitude.
pub const DISTANCES: [i32; 7] = [3, 4, 5, 6, 7, 8, 10];

/// Two cells to both sides of the boundary between standing and overturning.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Beside {
    omega: f64,
    /// The lowest amplitude at which the block overturns.
    boundary: f64,
    /// One of [`DISTANCES`].
    pub distance: i32,
    #[serde(deserialize_with = "class")]
    below: Class,
    #[serde(deserialize_with = "class")]
    above: Class,
}

impl Beside {
    /// A row by the reference.
    fn found(omega: f64, boundary: f64, distance: i32) -> Beside {
        let (below, above) = (Class::Unresolved, Class::Unresolved);
        let pending = Beside { omega, boundary, distance, below, above };
        let [below, above] = pending.cells().map(|(scene, _)| truth(&scene).class);
        Beside { below, above, ..pending }
    }

    /// The two cells and their outcomes.
    pub fn cells(&self) -> [(Scene, Class); 2] {
        let away = 0.1_f64.powi(self.distance);
        [(1.0 - away, self.below), (1.0 + away, self.above)]
            .map(|(share, right)| (cell(self.omega, self.boundary * share), right))
    }
}

fn cell(omega: f64, a_h: f64) -> Scene {
    object(1, 0.2, (1.75, 0.75), 0.5, &omega.to_string(), &a_h.to_string())
}

fn beside_table() -> Table {
    Table {
        name: "beside-boundaries.csv.gz",
        packed: include_bytes!("../../../data/beside-boundaries.csv.gz"),
        head: format!(
            "Lowest amplitudes A_h at which the reference overturns Object 1, e/B = 0.2, T_h = 1.75 s, T_v = 0.75 s,\n\
             A_v = 0.5 m/s^2, to 1e-12 of themselves, and its outcomes 10^-distance of A_h below and above.\n{:?}",
            tight()
        ),
    }
}

/// The rows of all pulses.
pub fn beside() -> Vec<Beside> {
    beside_table().rows()
}

/// The lowest amplitude at which a pulse overturns the block.
fn boundary(omega: f64) -> Option<f64> {
    let stands = |a_h: f64| truth(&cell(omega, a_h)).class.stands();
    let first = (1..60).map(|i| 0.25 * f64::from(i)).find(|a_h| !stands(*a_h))?;
    let (mut low, mut high) = (first - 0.25, first);
    while high - low > 1e-12 * high {
        let middle = 0.5 * (low + high);
        if stands(middle) { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}

/// The boundaries lie within a millionth of where they are stored, where f32 still decides.
#[test]
fn stored_boundaries_are_the_references() {
    let rows: Vec<Beside> = beside().into_iter().filter(|row| row.distance == 6).collect();
    assert!(rows.len() >= 20);
    rows.into_par_iter().for_each(|row| {
        assert_eq!(row, Beside::found(row.omega, row.boundary, row.distance));
        assert!(row.below.stands() && row.above.overturned(), "{row:?}");
    });
}

#[test]
#[ignore = "bisects 24 boundaries: cargo test --test lab every_stored -- --ignored"]
fn every_stored_boundary_is_the_references() {
    let rows = (0..24).into_par_iter().flat_map_iter(|k| {
        let omega = 1.2 + 0.37 * f64::from(k);
        let found = move |a_h| DISTANCES.map(|distance| Beside::found(omega, a_h, distance));
        boundary(omega).map(found).into_iter().flatten()
    });
    let rows: Vec<Beside> = rows.collect();
    beside_table().renew(&rows, |stored, found: &Beside| {
        // A bisection ends at 1e-12 of the amplitude, and the reference's roundings move it as far.
        let boundary = found.boundary;
        assert!((stored.boundary - boundary).abs() <= 1e-11 * boundary, "{stored:?} {found:?}");
        assert_eq!(&Beside { boundary, ..stored.clone() }, found);
    });
}

/// A cell at two tolerances.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Decided {
    scene: String,
    #[serde(deserialize_with = "class")]
    loose: Class,
    #[serde(deserialize_with = "class")]
    tight: Class,
}

/// The scenes of [`Decided`] cells.
fn scenes() -> [(&'static str, Scene); 2] {
    [(FINE, fine_structure()), (CHAOTIC, short_periods())]
}

fn decided_table() -> Table {
    Table {
        name: "hard-to-decide.csv.gz",
        packed: include_bytes!("../../../data/hard-to-decide.csv.gz"),
        head: format!(
            "Outcomes of the reference on the scenes of two tests of crates/lab/tests/lab/stability/boundaries.rs, cell \
             after cell.\nloose: {:?}\ntight: {:?}",
            Settings::default(),
            tight()
        ),
    }
}

/// The outcomes of a scene's cells at the reference's own tolerance and at a hundredth of it.
pub fn decided(name: &str) -> [Vec<Class>; 2] {
    let rows = decided_table().rows::<Decided>();
    rows.into_iter()
        .filter(|row| row.scene == name)
        .map(|row| (row.loose, row.tight))
        .unzip()
        .into()
}

/// Cells of a scene at a tolerance.
fn run(scene: &Scene, cells: &[usize], settings: &Settings) -> Vec<Class> {
    let grid = Grid::of(scene);
    let run = |&cell: &usize| reference::run(scene, &grid.case(cell), settings).class;
    cells.par_iter().map(run).collect()
}

/// Of each scene 24 cells, half of them beside boundaries. Those that the reference itself decides otherwise at another
/// tolerance say nothing: another machine's rounding may do as much. The others keep their outcome where the block is wider
/// or narrower by 1e-12, too.
#[test]
fn stored_outcomes_of_hard_cells_are_the_references() {
    for (name, scene) in scenes() {
        let grid = Grid::of(&scene);
        let [loose, tight_ones] = decided(name);
        assert_eq!(tight_ones.len(), grid.len());
        let outcome = |&class: &Class| Outcome { class, ..Outcome::PENDING };
        let outcomes: Vec<Outcome> = tight_ones.iter().map(outcome).collect();
        let chosen = sample(&grid, &outcomes, 24).unwrap();
        let sure = |cell: &usize| loose[*cell] == tight_ones[*cell];
        let cells: Vec<usize> = chosen.iter().map(|one| one.cell).filter(sure).collect();
        assert!(cells.len() >= 20);
        let stored: Vec<Class> = cells.iter().map(|&cell| tight_ones[cell]).collect();
        assert_eq!(stored, run(&scene, &cells, &tight()), "{name}");
    }
}

#[test]
#[ignore = "integrates 11,040 cells: cargo test --test lab every_stored -- --ignored"]
fn every_stored_outcome_of_hard_cells_is_the_references() {
    let of_scene = |(name, scene): (&str, Scene)| {
        let cells = all(&Grid::of(&scene));
        let [loose, tight] = [Settings::default(), tight()].map(|s| run(&scene, &cells, &s));
        let scene = name.to_owned();
        let row = move |(loose, tight)| Decided { scene: scene.clone(), loose, tight };
        loose.into_iter().zip(tight).map(row)
    };
    let rows: Vec<Decided> = scenes().into_iter().flat_map(of_scene).collect();
    decided_table().renew(&rows, |stored, found| assert_eq!(stored, found));
}
