//! Random scenes: every column of every backend against the reference.
//!
//! TOPPLE_RANDOM_SCENES scenes from TOPPLE_RANDOM_SEED, or the one numbered TOPPLE_RANDOM_SCENE.

mod compare;
mod records;
mod report;
mod scenes;
mod truth;

use std::time::Instant;

use compare::{Comparison, compare};
use rayon::prelude::*;
use report::Report;
use scenes::{Case, case};
use topple::backend::cpu;
use topple::backend::gpu::opened::Gpu;
use topple::backend::gpu::run::Sweeper;
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::model::asked::Asked;
use topple::model::precision::Precision;
use topple::model::real::Real;
use topple::scene::{Grid, Parameter};
use topple::stepping::outcome::Outcome;
use topple::work::observer::Unwatched;
use truth::Truth;

use crate::common::{all, gpu, say};

/// Scenes and seed where the environment does not say.
const SCENES: u64 = 80;
const SEED: u64 = 1;

fn number(variable: &str) -> Option<u64> {
    std::env::var(variable).ok().map(|text| text.parse().unwrap())
}

/// A scene on all backends.
struct Run<'a> {
    case: &'a Case,
    seed: u64,
    truths: Vec<Truth>,
    report: &'a mut Report,
    /// Prints all columns of the cells that are off.
    in_full: bool,
}

impl Run<'_> {
    fn judge(
        &mut self,
        backend: &'static str,
        plan: &Plan,
        precision: Precision,
        cells: &[Outcome],
    ) {
        let shortcuts = plan.shortcuts.certificate;
        assert_eq!(cells.len(), self.truths.len());
        let pairs: Vec<_> = cells.iter().zip(&self.truths).collect();
        let compared: Vec<Comparison> = pairs
            .par_iter()
            .map(|(cell, truth)| compare(cell, truth, precision, shortcuts))
            .collect();
        for (index, of) in compared.into_iter().enumerate() {
            if self.in_full && !(of.faults.is_empty() && of.undecided.is_none()) {
                say(&format!("{backend}, cell {index}: {:?}", cells[index]));
                say(&format!("    reference: {:?}", self.truths[index].cell));
            }
            self.report.add(backend, (self.case, self.seed), index, of);
        }
    }

    /// The plan of the scene. Of one with a device that the paper has not, everything is requested; of the others what
    /// a map has by default, which leaves them their shortcuts.
    fn plan(&self, precision: Precision) -> Plan {
        let plan = Plan::new(&self.case.scene, DEFAULT_STEP).unwrap().at(precision);
        let devices = [Parameter::Radius, Parameter::StopGap, Parameter::VHardening];
        match devices.iter().any(|own| self.case.scene.numbers.has(*own))
            && self.case.number.is_multiple_of(2)
        {
            true => plan.asking(Asked { accelerations: true, stops: true, ..Asked::ALL }),
            false => plan,
        }
    }

    fn on_cpu<R: Real>(&mut self, names: [&'static str; 2], precision: Precision) {
        let plan = self.plan(precision);
        let grid = Grid::of(&self.case.scene);
        for (name, plan) in [(names[0], plan.clone()), (names[1], plan.full_model())] {
            let cells = cpu::sweep(R::PRECISION, &plan, &grid, &all(&grid), &Unwatched);
            self.judge(name, &plan, precision, &cells);
        }
    }

    fn on_gpu<R: Real>(&mut self, name: &'static str, precision: Precision, gpu: &Gpu) {
        let plan = self.plan(precision);
        let grid = Grid::of(&self.case.scene);
        let sweeper = Sweeper::new(gpu, precision, plan.variant()).unwrap();
        let cells =
            sweeper.sweep::<R>(&plan, &grid, &all(&grid), &Unwatched).unwrap().block.to_outcomes();
        self.judge(name, &plan, precision, &cells);
    }
}

#[test]
fn random_scenes() {
    let seed = number("TOPPLE_RANDOM_SEED").unwrap_or(SEED);
    let one = number("TOPPLE_RANDOM_SCENE");
    let numbers = match one {
        Some(one) => one..one + 1,
        None => 0..number("TOPPLE_RANDOM_SCENES").unwrap_or(SCENES),
    };
    let single = gpu("random scenes", Precision::F32);
    let double = gpu("random scenes", Precision::F64);
    let mut report = Report::default();
    for number in numbers {
        let case = case(seed, number);
        if one.is_some() {
            say(&case.text);
        }
        let began = Instant::now();
        let grid = Grid::of(&case.scene);
        let truths = all(&grid).par_iter().map(|&i| Truth::of(&case.scene, i)).collect();
        let in_full = one.is_some();
        let mut run = Run { case: &case, seed, truths, report: &mut report, in_full };
        run.on_cpu::<f32>(["cpu f32", "cpu f32, full model"], Precision::F32);
        run.on_cpu::<f64>(["cpu f64", "cpu f64, full model"], Precision::F64);
        if let Some(gpu) = &single {
            run.on_gpu::<f32>("shader f32", Precision::F32, gpu);
        }
        if let Some(gpu) = &double {
            run.on_gpu::<f64>("shader f64", Precision::F64, gpu);
        }
        if began.elapsed().as_secs() >= 10 {
            say(&format!("scene {number} took {:.0} s", began.elapsed().as_secs_f64()));
        }
    }
    assert!(report.tell(), "the backends and the reference differ, see above");
}
