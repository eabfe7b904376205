//! Any numbers of a scene as axes: each cell is the cell that it is by itself.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::Rng;
use topple::backend::cell_run::CellRun;
use topple::backend::gpu::opened::Gpu;
use topple::backend::gpu::run::Sweeper;
use topple::backend::gpu::shader::{self, Switches};
use topple::backend::ready::Backend;
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::model::real::Real;
use topple::scene::{Grid, Parameter, Range, Scene, Values};
use topple::stepping::outcome::Outcome;
use topple::work::observer::Unwatched;

use crate::common::{gpu, say, scene, synthetic_pair, under};

/// Numbers that any scene may sweep, and from where to where.
const ANY: [(Parameter, f64, f64); 15] = [
    (Parameter::HalfWidth, 0.12, 0.3),
    (Parameter::Height, 0.6, 1.2),
    (Parameter::Mass, 300.0, 1500.0),
    (Parameter::Inertia, 150.0, 500.0),
    (Parameter::Eccentricity, -0.4, 0.4),
    (Parameter::PlateH, 10.0, 300.0),
    (Parameter::PlateV, 10.0, 300.0),
    (Parameter::TH, 0.6, 3.5),
    (Parameter::TV, 0.15, 1.5),
    (Parameter::Psi, 0.1, 1.0),
    (Parameter::XiH, 0.01, 0.3),
    (Parameter::XiV, 0.02, 0.4),
    (Parameter::AlphaY, 0.02, 0.4),
    (Parameter::BoucWenN, 1.0, 3.0),
    (Parameter::TMax, 6.0, 12.0),
];
/// Those of a pulse, of a record, and of a block that stands or is let go.
const OF_PULSE: [(Parameter, f64, f64); 3] =
    [(Parameter::Omega, 1.0, 9.0), (Parameter::AH, -9.0, 12.0), (Parameter::AV, -2.0, 2.0)];
/// A number, and from where to where.
type BackendOutcomes = (Parameter, f64, f64);
/// Shapes of a pulse, and their numbers.
const SHAPES: [(&str, &[BackendOutcomes]); 6] = [
    ("one-sine", &[]),
    ("one-sine", &[(Parameter::Cycles, 0.5, 3.0)]),
    ("one-cosine", &[(Parameter::Cycles, 0.5, 3.0)]),
    ("rectangle", &[]),
    ("ricker", &[]),
    ("mavroeidis-papageorgiou", &[(Parameter::Gamma, 1.0, 4.0), (Parameter::Phase, -3.0, 3.0)]),
];
const OF_RECORD: [(Parameter, f64, f64); 2] =
    [(Parameter::Scale, 0.4, 2.0), (Parameter::Pga, 2.0, 9.0)];
const REST: [(Parameter, f64, f64); 2] =
    [(Parameter::Tilt, -0.05, 0.05), (Parameter::Offset, -0.05, 0.05)];

/// Random numbers.
struct Dice(Pcg64Mcg);

impl Dice {
    fn below(&mut self, count: usize) -> usize {
        self.0.next_u32() as usize % count
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * f64::from(self.0.next_u32()) / f64::from(u32::MAX)
    }

    /// Values from one number to another: even, of constant factors, or a list.
    fn values(&mut self, parameter: Parameter, (low, high): (f64, f64), count: u32) -> Values {
        if parameter == Parameter::BoucWenN {
            return "1,2,3".parse().unwrap();
        }
        // The first two cells of a base that may be linear.
        if parameter == Parameter::Psi {
            return Values::list(vec![1.0, self.between(low, 0.9), self.between(0.0, low)])
                .unwrap();
        }
        match self.below(3) {
            0 if low > 0.0 => Range { log: true, ..Range::even(low, high, count) }.into(),
            1 => {
                let list = (0..count).map(|_| self.between(low, high)).collect();
                Values::list(list).unwrap()
            }
            // The other way.
            _ => Range::even(high, low, count).into(),
        }
    }
}

/// A scene with two or three axes.
fn random(dice: &mut Dice, recorded: bool, axes: usize) -> Scene {
    let own = if recorded { &OF_RECORD[..] } else { &OF_PULSE[..] };
    let kind = ["dual", "dual", "horizontal", "vertical"][dice.below(4)];
    let mut base = format!("isolation = \"{kind}\"\n");
    if kind != "vertical" {
        base += "t_h = 1.6\n";
    }
    if kind != "horizontal" {
        base += "t_v = 0.6\n";
    }
    let strength = ["", "u_y = 0.01\n", "yield_force = 400.0\n"][dice.below(3)];
    if kind != "vertical" {
        base += strength;
    }
    let (shape, periods) = SHAPES[dice.below(SHAPES.len())];
    let mut scene = scene(&format!(
        "[block]\nhalf_width = 0.19\nheight = 0.95\nmass = 895.0\nplate_h = 43.3\nplate_v = 43.3\n\
         [base]\n{base}[pulse]\nomega = 4.0\na_h = 5.0\na_v = 0.5\nshape = \"{shape}\"\n[run]\nt_max = 10.0\n"
    ));
    if recorded {
        under(&mut scene, synthetic_pair());
    }
    let mut chosen = 0;
    while chosen < axes {
        // The first one of the excitation's own, so that outcomes are of every kind.
        let from: Vec<_> = if chosen == 0 {
            own.to_vec()
        } else if chosen == 1 && !recorded && !periods.is_empty() {
            periods.to_vec()
        } else {
            ANY.iter().chain(&REST).chain(own).copied().collect()
        };
        let (parameter, low, high) = from[dice.below(from.len())];
        let h = [Parameter::TH, Parameter::Psi, Parameter::XiH, Parameter::BoucWenN];
        let locked = (kind == "vertical"
            && (h.contains(&parameter) || parameter == Parameter::AlphaY))
            || (kind == "horizontal" && [Parameter::TV, Parameter::XiV].contains(&parameter))
            || (parameter == Parameter::AlphaY && !strength.is_empty())
            || (parameter == Parameter::TMax && recorded)
            || (parameter == Parameter::Pga && scene.swept().contains(&Parameter::Scale))
            || (parameter == Parameter::Scale && scene.swept().contains(&Parameter::Pga))
            || (parameter == Parameter::Offset && scene.swept().contains(&Parameter::Eccentricity))
            || (parameter == Parameter::Eccentricity && scene.swept().contains(&Parameter::Offset));
        if locked || scene.swept().contains(&parameter) {
            continue;
        }
        if parameter == Parameter::Offset {
            scene.numbers.remove(Parameter::Eccentricity);
        }
        let count = if axes == 2 { 6 } else { 4 };
        let values = dice.values(parameter, (low, high), count);
        scene.set(parameter, values);
        chosen += 1;
    }
    scene
}

/// The scene of one cell of a grid by itself.
fn alone(scene: &Scene, grid: &Grid, cell: usize) -> Scene {
    let mut single = scene.clone();
    for (axis, value) in grid.axes().iter().zip(grid.coordinates(cell)) {
        single.set(axis.parameter, value);
    }
    single
}

fn sweep(backend: &Backend, scene: &Scene, precision: Precision) -> Vec<Outcome> {
    let plan = Plan::new(scene, DEFAULT_STEP).unwrap();
    backend
        .run(&CellRun::all(&plan, &Grid::of(scene), precision), &Unwatched)
        .unwrap()
        .block
        .to_outcomes()
}

/// Two numbers within a share of each other, and of one.
fn near(a: f64, b: f64, share: f64) -> bool {
    (a - b).abs() <= share * (a.abs().max(b.abs()) + 1.0e-3)
}

/// True for two outcomes of one cell that tell the same: what a sweep shares or leaves out may move a
/// column by a thousandth, see docs/shortcuts.md.
fn alike(a: &Outcome, b: &Outcome, share: f64) -> bool {
    let columns = |cell: &Outcome| {
        [cell.zeta, cell.max_u, cell.max_v, cell.t_uplift.unwrap_or(-1.0), cell.friction]
    };
    a.class == b.class && columns(a).into_iter().zip(columns(b)).all(|(a, b)| near(a, b, share))
}

/// What the rounding of f32 comes to over a thousand steps, as a share of the block's width.
const ROUNDING: [f64; 3] = [0.0, 3.0e-5, -3.0e-5];

/// Holds every cell of a grid against itself alone: cells, those apart, and those that rounding decides: a
/// block as little wider or narrower as that, in f64, tells something else.
fn hold(backend: &Backend, scene: &Scene, precision: Precision) -> [usize; 3] {
    let grid = Grid::of(scene);
    let together = sweep(backend, scene, precision);
    let (mut apart, mut undecided) = (0, 0);
    let share = if precision == Precision::F64 { 1.0e-3 } else { 1.0e-2 };
    for (cell, outcome) in together.iter().enumerate() {
        let single = alone(scene, &grid, cell);
        let itself = sweep(&Backend::Cpu, &single, precision)[0];
        if alike(outcome, &itself, share) {
            continue;
        }
        let decided = ROUNDING.iter().all(|by| {
            let width = single.case().block.half_width * (1.0 + by);
            let other = single.clone().with(Parameter::HalfWidth, width);
            alike(&itself, &sweep(&Backend::Cpu, &other, Precision::F64)[0], share)
        });
        if !decided {
            undecided += 1;
            continue;
        }
        let at: Vec<f64> = grid.coordinates(cell).collect();
        say(&format!("{at:?}: {outcome:?} for {itself:?}, of {:?}", scene.numbers));
        apart += 1;
    }
    [together.len(), apart, undecided]
}

fn all(name: &str, backend: &Backend, precision: Precision, scenes: usize) {
    let mut dice = Dice(Pcg64Mcg::new(0x1601));
    let (mut cells, mut apart, mut undecided) = (0, 0, 0);
    for number in 0..scenes {
        let scene = random(&mut dice, number % 2 == 1, 2 + number / 2 % 2);
        let keys: Vec<&str> = Grid::of(&scene).axes().iter().map(|axis| axis.key()).collect();
        let [of, differ, free] = hold(backend, &scene, precision);
        say(&format!("{name}: {}: {of} cells, {differ} apart", keys.join(" x ")));
        (cells, apart, undecided) = (cells + of, apart + differ, undecided + free);
    }
    say(&format!("{name}: {cells} cells, {apart} apart, {undecided} are decided by rounding"));
    // A block on a vertical isolation alone may rock chaotically.
    assert_eq!(apart, 0, "{name}: cells that are not what they are alone");
    let most = if precision == Precision::F64 { 0 } else { cells / 30 };
    assert!(undecided <= most, "{name}: rounding decides {undecided} of {cells}");
}

#[test]
fn cells_of_any_axes_are_what_they_are_alone_in_f64() {
    all("CPU f64", &Backend::Cpu, Precision::F64, 20);
}

#[test]
fn cells_of_any_axes_are_what_they_are_alone_in_f32() {
    all("CPU f32", &Backend::Cpu, Precision::F32, 20);
}

fn on(gpu: Option<Gpu>, name: &str, precision: Precision) {
    let Some(gpu) = gpu else { return };
    all(name, &Backend::Gpu(Box::new(gpu)), precision, 20);
}

#[test]
fn cells_of_any_axes_are_what_they_are_alone_on_the_shader() {
    on(gpu("axes, f32", Precision::F32), "shader f32", Precision::F32);
    on(gpu("axes, f64", Precision::F64), "shader f64", Precision::F64);
}

/// A body that varies is held once for all cells that share it.
#[test]
fn cells_share_their_bodies() {
    fn bodies<R: Real>(scene: &Scene) -> usize {
        let (plan, grid) = (Plan::new(scene, DEFAULT_STEP).unwrap(), Grid::of(scene));
        let cells: Vec<usize> = (0..grid.len()).collect();
        topple::cells::ready::Cells::<R>::of(&plan, &grid, &cells, &plan.record(), &Unwatched)
            .bodies()
            .len()
    }
    let map = crate::common::object(1, 0.2, (1.75, 0.75), 0.0, "1:9:10", "1:9:10");
    assert_eq!(bodies::<f32>(&map), 1);
    let map = map.with(Parameter::Eccentricity, Range::even(-0.4, 0.4, 5));
    assert_eq!((Grid::of(&map).len(), bodies::<f32>(&map)), (500, 5));
}

/// Outcomes by a shader given as text.
fn by_text(gpu: &Gpu, source: &str, scene: &Scene) -> Vec<Outcome> {
    let (plan, grid) = (Plan::new(scene, DEFAULT_STEP).unwrap(), Grid::of(scene));
    let cells: Vec<usize> = (0..grid.len()).collect();
    let sweeper = Sweeper::from_source(gpu, source, plan.variant(), 0).unwrap();
    sweeper.sweep::<f32>(&plan, &grid, &cells, &Unwatched).unwrap().block.to_outcomes()
}

/// The negative control: a mistake in where the device looks up a cell's body or its tables shows.
#[test]
fn a_mistake_in_the_axes_shows() {
    let Some(gpu) = gpu("mistakes in axes", Precision::F32) else { return };
    let pulse = crate::common::object(1, 0.2, (1.75, 0.75), 0.5, "4", "1:9:6")
        .with(Parameter::TH, Range::even(1.0, 3.0, 3))
        .with(Parameter::Eccentricity, Range::even(-0.4, 0.4, 4));
    // Blocks that share their full contact under half a record, in which some lift.
    let mut record = crate::common::object(1, 0.0, (1.75, 0.75), 0.5, "4", "1")
        .with(Parameter::TH, Range::even(1.0, 4.0, 7))
        .with(Parameter::HalfWidth, Range::even(0.3, 0.1, 9));
    under(&mut record, synthetic_pair().scaled(0.5));
    let source = shader::source(Precision::F32, Switches::Forgotten);
    for (scene, text, wrong) in [
        (&pulse, "model = models[cell.body];", "model = models[0];"),
        (&pulse, "place.at_2 * table.stride_2", "place.at_2 * table.stride_3"),
        (&pulse, "row % counts.x,", "row,"),
        (&record, "tile.levers + 3u * body", "tile.levers"),
    ] {
        assert_eq!(source.matches(text).count(), 1, "{text}");
        let right = sweep(&Backend::Cpu, scene, Precision::F32);
        let differ = |outcomes: &[Outcome]| {
            outcomes.iter().zip(&right).filter(|(a, b)| a.class != b.class).count()
        };
        assert_eq!(differ(&by_text(&gpu, &source, scene)), 0);
        let altered = by_text(&gpu, &source.replace(text, wrong), scene);
        assert!(differ(&altered) > 0, "'{wrong}' passes for right");
    }
}
