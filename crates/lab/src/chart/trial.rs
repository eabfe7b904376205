//! A method at one step or tolerance, timed.

use std::time::{Duration, Instant};

use super::bench::Bench;
use super::truth::{Solution, TimedSwitch, of_bench, of_events};
use super::{SWITCHES, naive};
use topple::backend::backend_error::BackendError;
use topple::backend::cpu;
use topple::backend::gpu::opened::Gpu;
use topple::backend::gpu::run::DeviceOutcomes;
use topple::backend::gpu::run::Sweeper;
use topple::cells::clock::Resolution;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::model::real::Real;
use topple::results::column_set::ColumnSet;
use topple::scene::{Excitation, Grid, Scene, SceneError};
use topple::stepping::log::Event;
use topple::stepping::outcome::Outcome;
use topple::stepping::reference::Settings;
use topple::work::observer::Unwatched;

/// A way to integrate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// The shader, on a device.
    Shader,
    /// Its twin, on all cores.
    Cpu,
    /// The same as a map is swept: shared full contact, and a cell ends when its columns are final.
    Shortcuts,
    /// The same for a map of which the outcome alone is asked: a cell ends when it is final.
    OutcomeOnly,
    /// Switches moved to the end of the step ([`naive`]).
    Naive,
    /// The adaptive reference, on all cores.
    Reference,
}

impl Method {
    /// Name in files.
    pub fn name(self) -> &'static str {
        match self {
            Method::Shader => "shader",
            Method::Cpu => "cpu",
            Method::Shortcuts => "cpu with shortcuts",
            Method::OutcomeOnly => "cpu outcome only",
            Method::Naive => "naive",
            Method::Reference => "reference",
        }
    }

    /// True where it computes ζ.
    pub fn has_zeta(self) -> bool {
        self != Method::OutcomeOnly
    }
}

/// A method with what it was set to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trial {
    /// The method.
    pub method: Method,
    /// Its number type.
    pub precision: Precision,
    /// Step, s; of the reference the tolerance.
    pub setting: f64,
}

/// The time of a trial.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Time {
    /// The whole, from cells to outcomes in memory: the least of the runs, s.
    pub whole: f64,
    /// In the shader alone, by the device's clock, in that run, s.
    pub device: Option<f64>,
    /// Compilation, s, before the first run.
    pub start: f64,
    /// Number of runs.
    pub runs: u32,
}

/// Why a trial failed.
#[derive(Debug, thiserror::Error)]
pub enum TrialError {
    /// The device failed.
    #[error(transparent)]
    Gpu(#[from] BackendError),
    /// The scene takes too many steps.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// Fewest and most runs of a trial.
const RUNS: (u32, u32) = (2, 5);
/// A trial whose runs took this long together is not run again.
const PATIENCE: Duration = Duration::from_millis(400);

/// Runs `once` a few times; the least time counts.
fn timed(
    mut once: impl FnMut() -> Result<Option<Duration>, TrialError>,
) -> Result<Time, TrialError> {
    let began = Instant::now();
    let mut time = Time { whole: f64::INFINITY, device: None, start: 0.0, runs: 0 };
    while time.runs < RUNS.0 || (time.runs < RUNS.1 && began.elapsed() < PATIENCE) {
        let start = Instant::now();
        let device = once()?;
        let whole = start.elapsed().as_secs_f64();
        if whole < time.whole {
            time.whole = whole;
            time.device = device.map(|device| device.as_secs_f64());
        }
        time.runs += 1;
    }
    Ok(time)
}

impl Trial {
    fn plan(&self, scene: &Scene) -> Result<Plan, SceneError> {
        let resolution = Resolution::exactly(self.setting);
        let naive = self.method == Method::Naive;
        let resolution = if naive { resolution.across_kinks() } else { resolution };
        let plan = Plan::resolved(scene, resolution)?;
        Ok(match self.method {
            Method::Shortcuts => plan,
            Method::OutcomeOnly => plan.asking(ColumnSet::of_names(&["outcome"])?.asked()),
            // Every other method simulates all of the time.
            _ => plan.full_model(),
        })
    }

    /// Runs a bench's cells: their solutions, and the time that it took. The runs that are timed keep
    /// no switches.
    pub fn run(
        &self,
        bench: &Bench,
        gpu: Option<&Gpu>,
    ) -> Result<(Vec<Solution>, Time), TrialError> {
        match self.precision {
            Precision::F32 => self.run_in::<f32>(bench, gpu),
            Precision::F64 => self.run_in::<f64>(bench, gpu),
        }
    }

    fn run_in<R: Real>(
        &self,
        bench: &Bench,
        gpu: Option<&Gpu>,
    ) -> Result<(Vec<Solution>, Time), TrialError> {
        if self.method == Method::Reference {
            let tolerance = self.setting;
            let settings = Settings { tolerance, longest: LONGEST, ..Settings::default() };
            let mut solutions = Vec::new();
            let time = timed(|| {
                solutions = of_bench(bench, &settings, &|_| ());
                Ok(None)
            })?;
            return Ok((solutions, time));
        }
        let mut plans = Vec::with_capacity(bench.scenes.len());
        for scene in &bench.scenes {
            plans.push((self.plan(scene)?, Grid::of(scene)));
        }
        let gpu = if self.method == Method::Shader { gpu } else { None };
        let began = Instant::now();
        let mut sweepers = Vec::new();
        if let Some(gpu) = gpu {
            for (plan, _) in &plans {
                sweepers.push(Sweeper::new(gpu, self.precision, plan.variant())?);
            }
        }
        let start = began.elapsed().as_secs_f64();
        let mut outcomes: Vec<Vec<Outcome>> = Vec::new();
        let mut time = timed(|| {
            outcomes.clear();
            let mut device = None;
            for (index, (plan, grid)) in plans.iter().enumerate() {
                let cells: Vec<usize> = (0..grid.len()).collect();
                if let Some(sweeper) = sweepers.get(index) {
                    let results: DeviceOutcomes<R> =
                        sweeper.sweep(plan, grid, &cells, &Unwatched)?;
                    device = results.device.map(|time| time + device.unwrap_or_default());
                    outcomes.push(results.block.to_outcomes());
                } else if self.method == Method::Naive {
                    outcomes.push(naive::sweep(plan, grid, &cells, 0).0);
                } else {
                    outcomes.push(cpu::sweep(R::PRECISION, plan, grid, &cells, &Unwatched));
                }
            }
            Ok(device)
        })?;
        time.start = start;
        let mut solutions = Vec::with_capacity(bench.len());
        for ((plan, grid), outcomes) in plans.iter().zip(outcomes) {
            let mut switches = if bench.whole {
                self.switches::<R>(plan, grid, gpu)?
            } else {
                vec![Vec::new(); outcomes.len()]
            };
            for (outcome, switches) in outcomes.into_iter().zip(switches.drain(..)) {
                solutions.push(Solution { outcome, switches });
            }
        }
        Ok((solutions, time))
    }

    /// The first switches of each cell, from a run of their own.
    fn switches<R: Real>(
        &self,
        plan: &Plan,
        grid: &Grid,
        gpu: Option<&Gpu>,
    ) -> Result<Vec<Vec<TimedSwitch>>, TrialError> {
        let cells: Vec<usize> = (0..grid.len()).collect();
        if self.method == Method::Naive {
            return Ok(timed_switches(plan, grid, &naive::sweep(plan, grid, &cells, SWITCHES).1));
        }
        if let Some(gpu) = gpu {
            let sweeper = Sweeper::keeping(gpu, self.precision, plan.variant(), SWITCHES)?;
            let events = sweeper.sweep::<R>(plan, grid, &cells, &Unwatched)?.events;
            return Ok(timed_switches(plan, grid, &events));
        }
        Ok(timed_switches(plan, grid, &cpu::sweep_keeping::<R>(plan, grid, &cells, SWITCHES).1))
    }
}

/// The switches kept of a grid's cells, [`SWITCHES`] of each.
fn timed_switches<R: Real>(plan: &Plan, grid: &Grid, events: &[Event<R>]) -> Vec<Vec<TimedSwitch>> {
    let of = |(index, kept): (usize, &[Event<R>])| {
        let case = grid.case(index);
        of_events(kept, &plan.clock(&case), case.deflection())
    };
    events.chunks(SWITCHES).enumerate().map(of).collect()
}

/// Longest step of a charted reference, s: so long that the tolerance decides.
const LONGEST: f64 = 0.25;

/// Coarsest step tried: 2 to the power of minus this, s.
const COARSEST: u32 = 4;

/// The step that is taken where `step` is requested, s: a record's samples are steps, so that it is
/// a whole share of the gap between them.
fn taken(bench: &Bench, step: f64) -> f64 {
    let record = bench.scenes.iter().find_map(|scene| match &scene.excitation {
        Excitation::Record(pair) => Some(pair.dt),
        Excitation::Pulse(_) => None,
    });
    record.map_or(step, |dt| dt / (dt / step).ceil())
}

/// The trials of a bench, from cheap to dear; without a device there are none of the shader.
pub fn of(bench: &Bench, gpu: Option<&Gpu>) -> Vec<Trial> {
    let mut methods = vec![(Method::Cpu, Precision::F32), (Method::Cpu, Precision::F64)];
    if bench.whole {
        methods.push((Method::Naive, Precision::F64));
        for precision in [Precision::F32, Precision::F64] {
            if gpu.is_some_and(|gpu| precision == Precision::F32 || gpu.description.f64) {
                methods.push((Method::Shader, precision));
            }
        }
    }
    // On many cells: of few the vectors are half empty at the end.
    if !bench.whole {
        for method in [Method::Shortcuts, Method::OutcomeOnly] {
            methods.extend([Precision::F32, Precision::F64].map(|precision| (method, precision)));
        }
    }
    let mut trials = Vec::new();
    for (method, precision) in methods {
        let mut settings: Vec<f64> = (COARSEST..=bench.finest)
            .map(|power| taken(bench, 0.5_f64.powi(power as i32)))
            .collect();
        settings.dedup();
        trials.extend(settings.into_iter().map(|setting| Trial { method, precision, setting }));
    }
    if bench.whole {
        let tolerances = (3..=10).map(|power| 0.1_f64.powi(power));
        trials.extend(tolerances.map(|setting| Trial {
            method: Method::Reference,
            precision: Precision::F64,
            setting,
        }));
    }
    trials
}
