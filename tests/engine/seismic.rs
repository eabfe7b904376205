//! Maps of real records: agreement with the reference, and what the paper says of them.

use std::path::Path;

use rayon::prelude::*;
use topple::backend::cell_run::CellRun;
use topple::backend::cpu;
use topple::backend::gpu::run::Sweeper;
use topple::backend::ready::Backend;
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::scene::{GRAVITY, Grid, Parameter, Scene};
use topple::stepping::outcome::{Class, Outcome, Status};
use topple::stepping::reference::{self, Settings};
use topple::work::observer::Unwatched;

use crate::common::{all, gpu, record, say, scene};

/// Both components of Rinaldi, Northridge 1994: 0.87 g horizontally, 0.96 g vertically.
fn rinaldi(test: &str) -> Option<(String, String)> {
    let file = |name| record(test, name).map(|path| path.display().to_string());
    Some((
        file("alt-northridge-1994-rinaldi-228.at2")?,
        file("alt-northridge-1994-rinaldi-up.at2")?,
    ))
}

fn rinaldi_scene(files: &(String, String), object: u32, e: f64, base: &str) -> Scene {
    scene(&format!(
        "[block]\nobject = {object}\neccentricity = {e}\n[base]\n{base}\n\
         [record]\nhorizontal = '{}'\nvertical = '{}'\n",
        files.0, files.1
    ))
}

fn sweep(scene: &Scene, precision: Precision) -> Vec<Outcome> {
    let plan = Plan::new(scene, DEFAULT_STEP).unwrap();
    Backend::Cpu
        .run(&CellRun::all(&plan, &Grid::of(scene), precision), &Unwatched)
        .unwrap()
        .block
        .to_outcomes()
}

/// Counts of a comparison over several maps.
#[derive(Default)]
struct Tally {
    cells: usize,
    /// Differing cells whose vertical period is below 0.3 s, where rocking is chaotic.
    stiff: usize,
    /// Differing cells beside a cell of another outcome.
    beside: usize,
    /// The others.
    elsewhere: usize,
    zeta: Vec<f64>,
}

impl Tally {
    fn add(&mut self, grid: &Grid, cells: &[Outcome], judged: &[Outcome]) {
        let (columns, rows) = grid.shape();
        for (index, (cell, judge)) in cells.iter().zip(judged).enumerate() {
            self.cells += 1;
            if cell.class == judge.class {
                self.zeta.push((cell.zeta - judge.zeta).abs());
                continue;
            }
            let (i, j) = (index % columns, index / columns);
            let near = [(1, 0), (-1, 0), (0, 1), (0, -1)].into_iter().any(|(di, dj)| {
                let (i, j) = (i as i64 + di, j as i64 + dj);
                (0..columns as i64).contains(&i)
                    && (0..rows as i64).contains(&j)
                    && judged[j as usize * columns + i as usize].class != judge.class
            });
            match (grid.value(Parameter::TV, index).unwrap() < 0.3, near) {
                (true, _) => self.stiff += 1,
                (false, true) => self.beside += 1,
                (false, false) => self.elsewhere += 1,
            }
        }
    }

    /// Share of equal outcomes, and the 99th percentile of zeta's error in agreeing cells.
    fn report(&mut self, name: &str) -> (f64, f64) {
        let differ = self.stiff + self.beside + self.elsewhere;
        self.zeta.sort_by(f64::total_cmp);
        let zeta = self.zeta[self.zeta.len() * 99 / 100];
        let equal = 1.0 - differ as f64 / self.cells as f64;
        say(&format!(
            "{name}: {differ} of {} outcomes differ ({:.3} % equal): {} in chaotic rocking at \
             T_v < 0.3 s, {} beside a boundary, {} elsewhere; zeta within {zeta:.0e} at the 99th \
             percentile",
            self.cells,
            100.0 * equal,
            self.stiff,
            self.beside,
            self.elsewhere
        ));
        (equal, zeta)
    }
}

#[test]
fn rinaldi_maps_agree_with_the_reference() {
    let test = "Rinaldi 228 + UP against the reference";
    let Some(files) = rinaldi(test) else { return };
    let gpu = gpu(test, Precision::F32);
    let (mut f32s, mut f64s, mut shader) = (Tally::default(), Tally::default(), Tally::default());
    // Chaotic cells ask for all the reference has.
    let settings = Settings { tolerance: 1e-12, rest_speed: 1e-6, ..Settings::default() };
    for object in [1, 2, 3] {
        for e in [-0.4, 0.0, 0.4] {
            let base = "t_h = '0.5:4:48'\nt_v = '0.05:2:48'";
            let scene = rinaldi_scene(&files, object, e, base);
            let grid = Grid::of(&scene);
            let run = |index| reference::run(&scene, &grid.case(index), &settings);
            let judged: Vec<Outcome> = (0..grid.len()).into_par_iter().map(run).collect();
            f32s.add(&grid, &sweep(&scene, Precision::F32), &judged);
            f64s.add(&grid, &sweep(&scene, Precision::F64), &judged);
            if let Some(gpu) = &gpu {
                let plan = Plan::new(&scene, DEFAULT_STEP).unwrap();
                let sweeper = Sweeper::new(gpu, Precision::F32, plan.variant()).unwrap();
                let cells = sweeper
                    .sweep::<f32>(&plan, &grid, &all(&grid), &Unwatched)
                    .unwrap()
                    .block
                    .to_outcomes();
                shader.add(&grid, &cells, &judged);
            }
        }
    }
    let hold = |name: &str, tally: &mut Tally, least: f64| {
        let (equal, zeta) = tally.report(name);
        assert!(equal >= least, "{name}: {equal}");
        assert!(zeta <= 1e-2, "{name}: {zeta}");
        assert_eq!(tally.elsewhere, 0, "{name}: cells differ without a cause");
    };
    hold("cpu f32", &mut f32s, 0.995);
    hold("cpu f64", &mut f64s, 0.999);
    if gpu.is_some() {
        hold("shader f32", &mut shader, 0.995);
    }
}

/// Where the vertical isolation is rigid for the record, the locked model has its outcomes, and
/// there is no strip of overturning at very small T_v.
#[test]
fn a_stiff_vertical_isolation_is_a_locked_one() {
    let Some(files) = rinaldi("very small T_v") else { return };
    let outcomes = |base: &str| sweep(&rinaldi_scene(&files, 1, 0.0, base), Precision::F32);
    let locked = outcomes("t_h = '0.5:4:24'\nisolation = 'horizontal'");
    assert!(locked.iter().any(|cell| cell.class == Class::FullContact));
    for (t_v, status) in [
        ("0.0002", Status::VerticalLocked),
        ("0.001", Status::VerticalLocked),
        ("0.004", Status::Ok),
        ("0.01", Status::Ok),
    ] {
        let cells = outcomes(&format!("t_h = '0.5:4:24'\nt_v = {t_v}"));
        for (cell, locked) in cells.iter().zip(&locked) {
            assert_eq!((cell.class, cell.status), (locked.class, status), "T_v = {t_v} s");
        }
    }
}

/// Largest T_h of a map at which some cell overturns.
fn critical_period(scene: &Scene) -> f64 {
    let grid = Grid::of(scene);
    let cells = sweep(scene, Precision::F32);
    let overturned = cells.iter().enumerate().filter(|(_, cell)| cell.class.overturned());
    overturned.map(|(index, _)| grid.value(Parameter::TH, index).unwrap()).fold(0.0, f64::max)
}

fn share(cells: &[Outcome], test: impl Fn(&Outcome) -> bool) -> f64 {
    cells.iter().filter(|cell| test(cell)).count() as f64 / cells.len() as f64
}

#[test]
fn the_critical_period_grows_with_eccentricity() {
    let Some(files) = rinaldi("critical T_h") else { return };
    for object in [1, 2, 3] {
        let base = "t_h = '0.5:4:36'\nt_v = '0.4:2:9'";
        let critical = [-0.4, -0.2, 0.0, 0.2, 0.4]
            .map(|e| critical_period(&rinaldi_scene(&files, object, e, base)));
        say(&format!("object {object}: critical T_h {critical:.1?} s at e = -0.4 .. 0.4"));
        let [a, b, c, d, e] = critical;
        assert!(a > b && b >= c && e > d && d >= c && a.min(e) > c, "{critical:?}");
    }
}

#[test]
fn opposite_eccentricities_differ_markedly_at_forty_percent() {
    let Some(files) = rinaldi("e against -e") else { return };
    let base = "t_h = '0.5:4:36'\nt_v = '0.3:2:18'";
    let map = |e| sweep(&rinaldi_scene(&files, 1, e, base), Precision::F32);
    let differ = |e: f64| {
        let (one, other) = (map(e), map(-e));
        let pairs = one.iter().zip(&other);
        let apart = pairs.filter(|(a, b)| {
            // About which corner it falls is another matter.
            a.class.overturned() != b.class.overturned()
                || (a.class == Class::FullContact) != (b.class == Class::FullContact)
        });
        apart.count() as f64 / one.len() as f64
    };
    let (small, large) = (differ(0.1), differ(0.4));
    say(&format!("cells that differ between e and -e: {small:.3} at 0.1, {large:.3} at 0.4"));
    assert!(large > 0.05 && large > small, "{small} {large}");
}

#[test]
fn the_vertical_displacement_tends_to_the_static_deflection() {
    let Some(files) = rinaldi("max|v|") else { return };
    let scene = rinaldi_scene(&files, 1, 0.0, "t_h = 4\nt_v = '0.5:8:16'");
    let grid = Grid::of(&scene);
    let excess: Vec<f64> = sweep(&scene, Precision::F32)
        .iter()
        .enumerate()
        .map(|(index, cell)| {
            let omega = std::f64::consts::TAU / grid.value(Parameter::TV, index).unwrap();
            cell.max_v / (GRAVITY / (omega * omega)) - 1.0
        })
        .collect();
    say(&format!("max|v| over g/omega_v^2, less 1, for T_v = 0.5 .. 8 s: {excess:.3?}"));
    assert!(excess.iter().all(|x| *x >= -1e-6));
    assert!(
        excess[15] < 0.05 && excess[3] < 0.25 && excess[0] > excess[3] && excess[3] > excess[15]
    );
}

#[test]
fn beyond_two_seconds_the_vertical_period_hardly_matters() {
    let Some(files) = rinaldi("T_v > 2 s") else { return };
    let row = |t_v: f64| {
        let base = format!("t_h = '0.5:4:71'\nt_v = {t_v}");
        sweep(&rinaldi_scene(&files, 1, 0.2, &base), Precision::F32)
    };
    let apart = |a: f64, b: f64| {
        let (a, b) = (row(a), row(b));
        let pairs = a.iter().zip(&b);
        pairs.filter(|(a, b)| a.class != b.class).count() as f64 / a.len() as f64
    };
    let (low, high) = (apart(0.2, 0.4), apart(2.0, 4.0));
    say(&format!(
        "outcomes that change from T_v = 0.2 to 0.4 s: {low:.3}, from 2 to 4 s: {high:.3}"
    ));
    assert!(high <= 0.06 && low > 2.0 * high, "{low} {high}");
}

#[test]
fn dual_isolation_enlarges_full_contact() {
    let Some(files) = rinaldi("dual against horizontal isolation") else { return };
    for (object, e) in [(1, 0.0), (1, 0.2), (2, 0.0), (3, 0.0), (3, 0.4)] {
        let map = |base: &str| sweep(&rinaldi_scene(&files, object, e, base), Precision::F32);
        let contact = |cell: &Outcome| cell.class == Class::FullContact;
        let alone = share(&map("t_h = '0.5:4:36'\nisolation = 'horizontal'"), contact);
        let dual = share(&map("t_h = '0.5:4:36'\nt_v = '1:2:5'"), contact);
        say(&format!("object {object}, e = {e}: full contact {alone:.3} alone, {dual:.3} dual"));
        assert!(dual > alone, "object {object}, e = {e}: {alone} {dual}");
    }
}

/// Steps of a record: whole numbers a sample, and the twin's own interpolation on them.
#[test]
fn the_ground_is_linear_between_samples() {
    use topple::model::CellEquations;
    use topple::stepping::forcing::ground_at;
    let directory = tempfile::tempdir().unwrap();
    let path: &Path = &directory.path().join("record.txt");
    std::fs::write(path, "0\n1\n-1\n0.5\n").unwrap();
    let scene = scene(&format!(
        "[block]\nobject = 1\n[base]\nt_h = 1.0\nt_v = 0.1\n\
         [record]\nhorizontal = '{}'\ndt = 0.02\nunits = 'm/s2'\n",
        path.display()
    ));
    let plan = Plan::new(&scene, DEFAULT_STEP).unwrap();
    let point = Grid::of(&scene).case(0);
    let (model, record) = (plan.model::<f64>(&plan.scene.case()), plan.record::<f64>());
    let (cell, _) = plan.cell::<f64>(&point);
    let clock = plan.clock(&point);
    assert_eq!(cell.steps.steps_forced, 3 * cell.steps.substeps);
    assert_eq!(cell.steps.steps, cell.steps.steps_forced);
    let set = CellEquations::of(plan.variant(), &model, &cell, &record);
    for (t, a) in [(0.0, 0.0), (0.01, 0.5), (0.02, 1.0), (0.03, 0.0), (0.055, 0.125), (0.06, 0.5)] {
        let step = ((t / clock.step_forced) as u32).min(cell.steps.steps_forced - 1);
        let fraction = t / clock.step_forced - f64::from(step);
        assert!((ground_at(&set, step, fraction).h - a).abs() < 1e-9, "t = {t}");
    }
    let outcomes = cpu::sweep(Precision::F64, &plan, &Grid::of(&scene), &[0], &Unwatched);
    assert_eq!(outcomes[0].class, Class::FullContact);
    assert_eq!(outcomes[0].t_end, 0.06);
}
