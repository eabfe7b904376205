//! What differed, by column and backend, each with the command that runs it again.

use std::collections::BTreeMap;

use topple::scene::{Excitation, Grid};

use crate::common::say;

use super::compare::{Comparison, Fault};
use super::scenes::Case;
use super::truth::Disturbance;

/// Cells of a backend.
#[derive(Default)]
struct Tally {
    cells: usize,
    agree: usize,
    /// Another outcome, that the reference does not decide either.
    undecided: BTreeMap<Disturbance, usize>,
    /// Other differences that are not held against it.
    excused: BTreeMap<&'static str, usize>,
    /// Cells in which a column is off, and by how many times what is allowed at most.
    off: BTreeMap<&'static str, (usize, f64)>,
}

/// All that was compared.
#[derive(Default)]
pub struct Report {
    backends: BTreeMap<&'static str, Tally>,
    lines: Vec<String>,
    faults: usize,
}

/// Command that runs one cell, or the scene of a record, again.
fn again(case: &Case, seed: u64, cell: usize) -> String {
    let grid = Grid::of(&case.scene);
    // A list of one value is no axis.
    let keys = grid.axes().iter().map(|axis| axis.key());
    let place: Vec<(&str, f64)> = keys.zip(grid.coordinates(cell)).collect();
    if let Excitation::Record(_) = &case.scene.excitation {
        let place: Vec<String> =
            place.iter().map(|(key, value)| format!("{key} = {value}")).collect();
        return format!(
            "TOPPLE_RANDOM_SEED={seed} TOPPLE_RANDOM_SCENE={} cargo test --test engine random:: # {}",
            case.number,
            place.join(", ")
        );
    }
    let mut command = String::from("topple pulse");
    for (key, text) in case.text.lines().filter_map(|line| line.split_once(" = ")) {
        let text = match place.iter().find(|(axis, _)| *axis == key) {
            Some((_, value)) => format!("{value:?}"),
            None => text.trim_matches('"').to_string(),
        };
        command += &format!(" --{}={text}", key.replace('_', "-"));
    }
    command
}

impl Report {
    /// Takes in a cell of a backend.
    pub fn add(
        &mut self,
        backend: &'static str,
        (case, seed): (&Case, u64),
        cell: usize,
        of: Comparison,
    ) {
        let tally = self.backends.entry(backend).or_default();
        tally.cells += 1;
        let mut line = |what: String| {
            let place = format!("{backend}, scene {}, cell {cell}", case.number);
            self.lines.push(format!("{place}: {what}\n    {}", again(case, seed, cell)));
        };
        if let Some(excused) = of.excused {
            *tally.excused.entry(excused).or_default() += 1;
        }
        if let Some((disturbance, [a, b])) = of.undecided {
            *tally.undecided.entry(disturbance).or_default() += 1;
            line(format!("undecided when moved by {:e}, {a} for {b}", disturbance.size()));
        } else if of.faults.is_empty() {
            tally.agree += 1;
        }
        if of.faults.is_empty() {
            return;
        }
        for Fault { column, times, .. } in &of.faults {
            let (cells, most) = tally.off.entry(column).or_default();
            *cells += 1;
            *most = most.max(*times);
        }
        let list = of.faults.iter().map(|f| {
            let [a, b] = &f.values;
            format!("{} {a} for {b} ({:.3})", f.column, f.times)
        });
        line(list.collect::<Vec<_>>().join("; "));
        self.faults += 1;
    }

    /// Prints everything; true where nothing is off.
    pub fn tell(&self) -> bool {
        for line in &self.lines {
            say(line);
        }
        for (backend, tally) in &self.backends {
            say(&format!("{backend}: {} cells, {} agree", tally.cells, tally.agree));
            for (disturbance, cells) in &tally.undecided {
                let size = disturbance.size();
                say(&format!(
                    "    another outcome, as the reference when moved by {size:e}: {cells}"
                ));
            }
            for (what, cells) in &tally.excused {
                say(&format!("    not held against it, {what}: {cells}"));
            }
            for (column, (off, most)) in &tally.off {
                say(&format!("    OFF {column}: {off}, by up to {most:.3} times what is allowed"));
            }
        }
        self.faults == 0
    }
}
