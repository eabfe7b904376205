//! A cell by the reference, and how far its answer moves when what it is asked moves a little.

use std::sync::OnceLock;

use rayon::prelude::*;
use topple::cells::clock::DEFAULT_STEP;
use topple::model::precision::Precision;
use topple::scene::{Case, Excitation, GRAVITY, Grid, Scene, Shaking};
use topple::stepping::outcome::{Class, Outcome};
use topple::stepping::reference::system::System;
use topple::stepping::reference::{self, Settings, Switch};

use super::scenes::Dice;

/// Columns that are numbers: names, and values.
pub const NUMBERS: [&str; 16] = [
    "t_end",
    "t_uplift",
    "zeta",
    "max_phi_left",
    "max_phi_right",
    "max_u",
    "max_v",
    "stroke_v",
    "min_contact",
    "friction",
    "acc_plate",
    "acc_block",
    "acc_plate_total",
    "acc_block_total",
    "base_load",
    "stop_force",
];

/// The columns that are numbers, in the order of [`NUMBERS`].
pub fn numbers(cell: &Outcome) -> [f64; NUMBERS.len()] {
    [
        cell.t_end,
        cell.t_uplift.unwrap_or(f64::NAN),
        cell.zeta,
        cell.max_phi_left,
        cell.max_phi_right,
        cell.max_u,
        cell.max_v,
        cell.stroke_v,
        cell.min_contact,
        cell.friction,
        cell.acc_plate,
        cell.acc_block,
        cell.acc_plate_total,
        cell.acc_block_total,
        cell.base_load,
        cell.stop_force,
    ]
}

/// How far a sweep moves a cell, relative to its push and to its block: where the reference's outcome
/// moves with as little as that, it is nobody's to decide.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Disturbance {
    /// The rounding of f64 over a run.
    RoundingF64,
    /// Ten roundings of f32, those of a step; or what a fixed step errs by, at 80 steps a period:
    /// (2 pi/80)^4/120 = 3e-7 of the motion in every radian of its phase.
    OneStep,
    /// A thousand steps' rounding in f32, which adds up as its root.
    RoundingF32,
}

impl Disturbance {
    /// From the least on.
    pub const ALL: [Disturbance; 3] =
        [Disturbance::RoundingF64, Disturbance::OneStep, Disturbance::RoundingF32];

    /// The most that a precision is excused by.
    pub fn most(precision: Precision) -> Disturbance {
        match precision {
            Precision::F32 => Disturbance::RoundingF32,
            Precision::F64 => Disturbance::OneStep,
        }
    }

    /// Relative size.
    pub fn size(self) -> f64 {
        match self {
            Disturbance::RoundingF64 => 1.0e-9,
            Disturbance::OneStep => 1.0e-6,
            Disturbance::RoundingF32 => 3.0e-5,
        }
    }
}

/// What a small disturbance makes of a cell.
#[derive(Debug, Clone)]
pub struct Spread {
    /// The outcome is not the same: nothing can be asked of a sweep.
    pub undecided: bool,
    /// The most that each column moves.
    pub numbers: [f64; NUMBERS.len()],
    /// Impacts or uplifts are not the same.
    pub counts: bool,
}

/// The reference's settings: a cell of a hundred thousand impacts and more (a block without loss that
/// trembles) is given up.
fn settings() -> Settings {
    Settings { most_steps: 300_000, ..Settings::default() }
}

/// Neighbours of a cell that are asked where a sweep has another outcome. One of a hundred with the sweep's outcome is
/// found with a probability of 0.92.
const NEIGHBOURS: usize = 256;

/// A cell by the reference.
pub struct Truth {
    /// The reference's outcome.
    pub cell: Outcome,
    scene: Scene,
    case: Case,
    spreads: [OnceLock<Spread>; 3],
    /// The impacts and uplifts up to a millisecond before the end of the excitation: no proof ends a cell earlier.
    pub counts_before_proofs: [u32; 2],
    /// The shortest flight between two impacts, s; zero where an impact brings the block to rest.
    pub shortest_flight: f64,
}

/// The cell with its push and its width moved by these shares of themselves.
fn moved(case: &Case, push: f64, width: f64) -> Case {
    let mut case = *case;
    case.block.half_width *= 1.0 + width;
    match &mut case.shaking {
        Shaking::Pulse(pulse) => {
            pulse.a_h *= 1.0 + push;
            pulse.a_v *= 1.0 + push;
        }
        Shaking::Record { factor, pga_h, pga_v } => {
            for number in [factor, pga_h, pga_v] {
                *number *= 1.0 + push;
            }
        }
    }
    // (21).
    if let Some(law) = &mut case.isolation.horizontal {
        law.u_y *= 1.0 + push;
    }
    case
}

impl Truth {
    /// The masses of the block and of both plates, kg.
    pub fn masses(&self) -> [f64; 2] {
        let base = &self.case.isolation;
        [self.case.block.mass, base.plate_h + base.plate_v]
    }

    /// Runs a cell.
    pub fn of(scene: &Scene, index: usize) -> Truth {
        let case = Grid::of(scene).case(index);
        let end = match &scene.excitation {
            Excitation::Record(pair) => pair.duration(),
            Excitation::Pulse(_) => System::new(scene, &case).pulse_end(),
        };
        let (mut counts, mut shortest, mut last) = ([0; 2], f64::INFINITY, None);
        let cell = reference::observe(scene, &case, &settings(), &mut |instant| {
            let Some(switch) = instant.switch else { return };
            let counted = u32::from(instant.t < end - 1.0e-3);
            match switch {
                Switch::Impact(_) => {
                    counts[0] += counted;
                    shortest = last.map_or(shortest, |last| f64::min(shortest, instant.t - last));
                    if instant.phase.is_none() {
                        shortest = 0.0;
                    }
                }
                Switch::Uplift(_) => counts[1] += counted,
                Switch::Overturn(_) => {}
            }
            last = Some(instant.t);
        });
        let (scene, spreads) = (scene.clone(), Default::default());
        let (counts_before_proofs, shortest_flight) = (counts, shortest);
        Truth { cell, scene, case, spreads, counts_before_proofs, shortest_flight }
    }

    /// What a disturbance makes of the cell.
    pub fn spread(&self, disturbance: Disturbance) -> &Spread {
        self.spreads[disturbance as usize].get_or_init(|| {
            let by = disturbance.size();
            let tight = Settings { tolerance: 1.0e-12, ..settings() };
            let mut others = vec![reference::run(&self.scene, &self.case, &tight)];
            others.extend(self.rest_speeds().map(|rest_speed| {
                let settings = Settings { rest_speed, ..settings() };
                reference::run(&self.scene, &self.case, &settings)
            }));
            others.extend([(by, 0.0), (-by, 0.0), (0.0, by), (0.0, -by)].map(|(push, width)| {
                reference::run(&self.scene, &moved(&self.case, push, width), &settings())
            }));
            let mut spread =
                Spread { undecided: false, numbers: [0.0; NUMBERS.len()], counts: false };
            let here = numbers(&self.cell);
            for other in &others {
                spread.undecided |= other.class != self.cell.class;
                spread.counts |= (other.impacts, other.uplifts, other.stop_hits)
                    != (self.cell.impacts, self.cell.uplifts, self.cell.stop_hits);
                for (most, (a, b)) in spread.numbers.iter_mut().zip(here.iter().zip(numbers(other)))
                {
                    *most = most.max((a - b).abs());
                }
            }
            spread
        })
    }

    /// Other speeds below which a landing block rests, rad/s: that of a sweep, whose block rests when its next
    /// flight would last less than a 32nd of a step, here the longest; and one below the reference's. The base takes
    /// part in a flight: the moment of gravity turns rho^2 + kappa_h H^2 + kappa_v b^2, D of (18).
    fn rest_speeds(&self) -> [f64; 2] {
        let block = &self.case.block;
        let [kappa_h, kappa_v] = self.case.isolation.shares(block).map(|share| 1.0 - share);
        let fall = |side: f64| {
            let (b, h) = (block.arm(side), block.height);
            GRAVITY * b / (block.inertia / block.mass + kappa_h * h * h + kappa_v * b * b)
        };
        let flight = DEFAULT_STEP / 32.0;
        [0.5 * flight * fall(1.0).max(fall(-1.0)), 1.0e-6]
    }

    /// The least disturbance up to the most that a precision is excused by with which the outcome moves.
    pub fn undecided(&self, precision: Precision) -> Option<Disturbance> {
        let most = Disturbance::most(precision);
        let mut sizes = Disturbance::ALL.into_iter().filter(|size| *size <= most);
        sizes.find(|size| self.spread(*size).undecided)
    }

    /// The most disturbance, if a cell moved by no more than it has the outcome of the sweep. A motion of some forty
    /// impacts has pockets of other outcomes of all sizes beside it, which the four of each size can miss: the sizes of
    /// the neighbours are even in their logarithm.
    pub fn beside(&self, precision: Precision, class: Class) -> Option<Disturbance> {
        let most = Disturbance::most(precision);
        let mut dice = Dice::of(0, 0);
        let mut part = |size: f64| size * (2.0 * dice.unit() - 1.0);
        let neighbours = (0..NEIGHBOURS).map(|index| {
            let size = most.size() * 1.0e-3_f64.powf(index as f64 / NEIGHBOURS as f64);
            moved(&self.case, part(size), part(size))
        });
        let cases: Vec<Case> = neighbours.collect();
        let has = |case: &Case| reference::run(&self.scene, case, &settings()).class == class;
        cases.par_iter().any(has).then_some(most)
    }
}
