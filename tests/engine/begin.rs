//! A cell as its integration begins: made of tables as by itself, on the device as on the host.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::Rng;
use topple::backend::cpu;
use topple::backend::gpu::opened::Gpu;
use topple::backend::gpu::run::Sweeper;
use topple::backend::gpu::shader::{self, Switches};
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::cells::ready::Cells;
use topple::cells::shortcuts::Shortcuts;
use topple::model::excitation::Cell;
use topple::model::precision::Precision;
use topple::model::real::Real;
use topple::scene::{Grid, Overturn, Parameter, Range, Scene};
use topple::stepping::outcome::{Class, Outcome};
use topple::stepping::state::{PROVED, RUNNING, State};
use topple::work::observer::Unwatched;

use crate::common::{all, gpu, object, say, scene, synthetic_pair, under};

/// A number between two, from a generator.
fn between(rng: &mut Pcg64Mcg, least: f64, most: f64) -> f64 {
    least + (most - least) * (rng.next_u32() as f64 / f64::from(u32::MAX))
}

/// An axis between two numbers: a range, sometimes a falling one, or a single value.
fn axis(rng: &mut Pcg64Mcg, least: f64, most: f64) -> Range {
    let (start, stop) = (between(rng, least, most), between(rng, least, most));
    match rng.next_u32() % 4 {
        0 => Range::single(start),
        _ => Range::even(start, stop, 2 + rng.next_u32() % 11),
    }
}

fn pick<const N: usize>(rng: &mut Pcg64Mcg, values: [f64; N]) -> f64 {
    values[rng.next_u32() as usize % N]
}

/// A scene of random numbers, of every kind of base and excitation.
fn random_scene(rng: &mut Pcg64Mcg) -> Scene {
    let recorded = rng.next_u32().is_multiple_of(2);
    let isolation = ["dual", "horizontal", "vertical", "none"][rng.next_u32() as usize % 4];
    let mut base = format!("isolation = \"{isolation}\"\n");
    let (dual, h, v) = (isolation == "dual", isolation == "horizontal", isolation == "vertical");
    if dual || h {
        base +=
            &format!("t_h = {}\npsi = {}\n", between(rng, 0.2, 4.0), pick(rng, [1.0, 0.5, 0.1]));
    }
    if dual || v {
        base += &format!("t_v = {}\nxi_v = {}\n", between(rng, 0.02, 1.5), between(rng, 0.0, 0.3));
    }
    let tilt = pick(rng, [0.0, 0.0, 0.0, 0.05, -0.05]);
    let (omega, a_h) = (axis(rng, 0.3, 15.0), axis(rng, -12.0, 15.0));
    let a_v = pick(rng, [0.0, 0.5, -3.0]);
    let pulse = format!("omega = \"{omega}\"\na_h = \"{a_h}\"\na_v = {a_v}\n");
    let mut scene = scene(&format!(
        "[block]\nobject = {}\neccentricity = {}\n[base]\n{base}[pulse]\n{pulse}",
        1 + rng.next_u32() % 3,
        between(rng, -0.4, 0.4),
    ));
    scene.set(Parameter::Tilt, tilt);
    scene.overturn = [Overturn::CriticalAngle, Overturn::QuarterTurn][rng.next_u32() as usize % 2];
    if recorded {
        if dual || h {
            scene.set(Parameter::TH, axis(rng, 0.2, 4.0));
        }
        if dual || v {
            scene.set(Parameter::TV, axis(rng, 0.02, 1.5));
        }
        under(&mut scene, synthetic_pair());
        let longer = scene.case().t_max + pick(rng, [0.0, 7.0]);
        scene.set(Parameter::TMax, longer);
    }
    scene
}

fn words<T: bytemuck::Pod>(item: &T) -> Vec<u32> {
    bytemuck::pod_collect_to_vec(bytemuck::bytes_of(item))
}

fn tables_hold<R: Real>(scene: &Scene) {
    let plan = Plan::new(scene, DEFAULT_STEP).unwrap().full_model();
    let grid = Grid::of(scene);
    let numbers = all(&grid);
    let record = plan.record();
    let cells = Cells::<R>::of(&plan, &grid, &numbers, &record, &Unwatched);
    for index in 0..grid.len() {
        let (cell, state) = plan.cell::<R>(&grid.case(index));
        let (mut made, begun) = cells.begin(index);
        let body = cells.bodies()[made.body as usize];
        assert_eq!(words(&body), words(&plan.model::<R>(&grid.case(index))), "body of {index}");
        // Alone it has a body of its own, and shares no motion.
        (made.body, made.drive.scale) = (0, cell.drive.scale);
        assert_eq!(words(&made), words(&cell), "cell {index} of {scene:?}");
        assert_eq!(words(&begun), words(&state), "cell {index} of {scene:?}");
        assert_eq!(cells.tables.clock(&cells.tables.cell(index)), plan.clock(&grid.case(index)));
    }
}

/// The tables' numbers are those that a cell has by itself, to the last bit.
#[test]
fn cells_of_tables_are_those_of_their_points() {
    let mut rng = Pcg64Mcg::new(0x1501);
    for _ in 0..200 {
        let scene = random_scene(&mut rng);
        tables_hold::<f32>(&scene);
        tables_hold::<f64>(&scene);
    }
}

/// Holds the cells that a device makes against the host's, word by word: all but the friction, for which
/// a cell takes steps: a device may round these otherwise. How many share their full
/// contact and how many have clocks of their own.
fn device_makes<R: Real>(
    gpu: &Gpu,
    precision: Precision,
    scene: &Scene,
    chosen: impl Fn(&Grid) -> Vec<usize>,
) -> usize {
    let plan = Plan::new(scene, DEFAULT_STEP).unwrap().at(precision);
    let grid = Grid::of(scene);
    let chosen = chosen(&grid);
    let numbers = all(&grid);
    let record = plan.record();
    let host = Cells::<R>::of(&plan, &grid, &numbers, &record, &Unwatched);
    let sweeper = Sweeper::new(gpu, precision, plan.variant()).unwrap();
    for side in [0, 1] {
        let made = sweeper.make::<R>(&plan, &grid, &chosen, side).unwrap();
        for (at, &index) in chosen.iter().enumerate() {
            let (cell, mut state): (Cell<R>, State<R>) = host.begin(index);
            let found = made.states[at];
            let error = (found.extremes.friction.to_f64() - state.extremes.friction.to_f64()).abs();
            let unit = if precision == Precision::F32 { 1.2e-7 } else { 2.3e-16 };
            assert!(
                error <= 16.0 * unit * state.extremes.friction.to_f64(),
                "friction of {index}: {error}"
            );
            state.extremes.friction = found.extremes.friction;
            assert_eq!(words(&made.cells[at]), words(&cell), "cell {index} of {scene:?}");
            assert_eq!(words(&found), words(&state), "cell {index} of {scene:?}");
        }
        let first = (side * chosen.len()) as u32;
        let mut running: Vec<u32> = made.running.iter().map(|lane| lane - first).collect();
        running.sort_unstable();
        let expected: Vec<u32> = (0_u32..)
            .zip(&made.states)
            .filter_map(|(at, state)| (state.status == RUNNING).then_some(at))
            .collect();
        assert_eq!(running, expected, "the list of running cells");
    }
    usize::from(host.motions.is_some())
}

fn hold<R: Real>(precision: Precision) {
    let Some(gpu) = gpu("cells made on the device", precision) else { return };
    let mut rng = Pcg64Mcg::new(0x1502);
    let mut shared = 0;
    for number in 0..80 {
        let scene = random_scene(&mut rng);
        let chosen = |grid: &Grid| {
            let all = all(grid);
            match number % 4 {
                // From the middle of a row on.
                0 => all[grid.len() / 3..].to_vec(),
                // One by one.
                1 => all.iter().copied().step_by(2).chain([0]).collect(),
                _ => all,
            }
        };
        shared += device_makes::<R>(&gpu, precision, &scene, chosen);
    }
    say(&format!("{shared} of 80 scenes share their full contact"));
    assert!((10..=60).contains(&shared), "{shared} of 80 scenes share their full contact");
}

#[test]
fn cells_made_on_the_device_are_the_hosts_in_f32() {
    hold::<f32>(Precision::F32);
}

#[test]
fn cells_made_on_the_device_are_the_hosts_in_f64() {
    hold::<f64>(Precision::F64);
}

/// A grid of more rows than a device counts, from which cells come one after another or as a list: each is made of its own
/// numbers. The last cells of a grid of half as many rows follow one another on the device.
#[test]
#[cfg(target_pointer_width = "64")]
fn a_device_makes_the_cells_of_rows_that_it_cannot_count() {
    let Some(gpu) = gpu("cells of far rows", Precision::F32) else { return };
    for (rows, follow) in [(45_001, true), (90_001, false)] {
        let mut scene = object(1, 0.2, (1.75, 0.75), 0.5, "0.2:15:3", "2");
        for (parameter, start, stop) in [(Parameter::AH, 1.0, 9.0), (Parameter::AV, 0.5, 4.0)] {
            scene.set(parameter, Range::even(start, stop, rows));
        }
        let plan = Plan::new(&scene, DEFAULT_STEP).unwrap().full_model();
        let grid = Grid::of(&scene);
        assert_eq!(u32::try_from(grid.shape().1).is_ok(), follow);
        let last: Vec<usize> = (grid.len() - 7..grid.len()).collect();
        let apart: Vec<usize> = (0..9).map(|k| grid.len() - 1 - k * (grid.len() / 9 - 5)).collect();
        for cells in [last, apart] {
            let sweeper = Sweeper::new(&gpu, Precision::F32, plan.variant()).unwrap();
            let made = sweeper.make::<f32>(&plan, &grid, &cells, 0).unwrap();
            for (at, &index) in cells.iter().enumerate() {
                let (cell, state) = plan.cell::<f32>(&grid.case(index));
                let mut found = made.cells[at];
                // Alone it shares no motion.
                found.drive.scale = cell.drive.scale;
                assert_eq!(words(&found), words(&cell), "cell {index} of {rows} rows");
                assert_eq!(words(&made.states[at]), words(&state), "cell {index} of {rows} rows");
            }
        }
    }
}

/// The negative control: a mistake in how the device makes cells shows.
#[test]
fn a_mistake_in_making_cells_shows() {
    let Some(gpu) = gpu("mistakes in making cells", Precision::F32) else { return };
    let scene = object(1, 0.2, (1.75, 0.75), 0.5, "0.2:15:24", "-7:15:24");
    let (plan, grid) = (Plan::new(&scene, DEFAULT_STEP).unwrap(), Grid::of(&scene));
    let numbers = all(&grid);
    let record = plan.record();
    let host = Cells::<f32>::of(&plan, &grid, &numbers, &record, &Unwatched);
    let source = shader::source(Precision::F32, Switches::Forgotten);
    for (right, wrong) in [
        ("numbers[h + 4u],", "numbers[h + 5u],"),
        ("motions[h + VELOCITY * all_h]", "motions[h + VELOCITY * all_h + 1u]"),
        ("tried += STEPS_A_TRY;", "tried += 2u * STEPS_A_TRY;"),
        ("(*state).extremes.min_contact = -most;", "(*state).extremes.min_contact = most;"),
        ("max(-one, -other) > model.right.arm", "max(one, other) > model.right.arm"),
        ("thread, from_row % tile.columns", "thread, thread % tile.columns"),
    ] {
        assert_eq!(source.matches(right).count(), 1, "{right}");
        let source = source.replace(right, wrong);
        let sweeper = Sweeper::from_source(&gpu, &source, plan.variant(), 0).unwrap();
        let made = sweeper.make::<f32>(&plan, &grid, &all(&grid), 0).unwrap();
        let same = (0..grid.len()).all(|index| {
            let (cell, state) = host.begin(index);
            words(&made.cells[index]) == words(&cell) && words(&made.states[index]) == words(&state)
        });
        assert!(!same, "'{wrong}' passes for right");
    }
}

/// Shared motions go on after a pulse: nearly every cell that never lifts is done as it begins, at the step at which its own
/// integration would be, with the same results.
#[test]
fn a_cell_that_does_not_lift_is_done_with_its_motions() {
    let pulse = |base: &str, a_v: f64| {
        scene(&format!(
            "[block]\nobject = 1\neccentricity = 0.2\n[base]\n{base}\n\
             [pulse]\nomega = \"0.2:15:40\"\na_h = \"0.1:15:40\"\na_v = {a_v}\n"
        ))
    };
    for (base, a_v, goes_on) in [
        ("t_h = 1.75\nt_v = 0.75", 0.0, true),
        ("t_h = 1.75\nt_v = 0.75", 0.5, true),
        ("t_h = 1.75\nt_v = 0.75\npsi = 1", 2.0, true),
        ("isolation = \"horizontal\"\nt_h = 1.75", 0.0, true),
        // Of these the force may jump where the pulse ends.
        ("isolation = \"horizontal\"\nt_h = 1.75", 0.5, false),
        ("isolation = \"vertical\"\nt_v = 0.75", 0.5, false),
    ] {
        let scene = pulse(base, a_v);
        let (grid, plan) = (Grid::of(&scene), Plan::new(&scene, DEFAULT_STEP).unwrap());
        let mut without = plan.clone();
        without.shortcuts.full_contact = false;
        let cells = all(&grid);
        let alone = cpu::sweep(Precision::F64, &without, &grid, &cells, &Unwatched);
        let record = plan.record();
        let made = Cells::<f64>::of(&plan, &grid, &cells, &record, &Unwatched);
        let (mut never_lift, mut done) = (0, 0);
        // One that begins between two tries goes on with the next.
        let swept = cpu::sweep(Precision::F64, &plan, &grid, &cells, &Unwatched);
        for (cell, (swept, alone)) in swept.iter().zip(&alone).enumerate() {
            assert_eq!(swept.class, alone.class, "{base}, A_v = {a_v}, cell {cell}");
            if alone.class == Class::FullContact {
                assert_eq!(
                    swept.t_simulated, alone.t_simulated,
                    "{base}, A_v = {a_v}, cell {cell}"
                );
            }
        }
        for (cell, alone) in alone.iter().enumerate() {
            let (_, state) = made.begin(cell);
            never_lift += usize::from(alone.class == Class::FullContact);
            if state.status != PROVED {
                continue;
            }
            done += 1;
            let own = made.outcome(cell, &state);
            let counts = |cell: &Outcome| (cell.class, cell.status, cell.t_simulated, cell.t_end);
            assert_eq!(counts(&own), counts(alone), "{base}, A_v = {a_v}, cell {cell}");
            // An integration of its own cuts steps at kinks of the Bouc-Wen law, which moves v by its error.
            for (one, other) in [
                (own.max_u, alone.max_u),
                (own.max_v, alone.max_v),
                (own.stroke_v, alone.stroke_v),
                (own.min_contact, alone.min_contact),
            ] {
                assert!((one - other).abs() <= 1e-6, "{base}, A_v = {a_v}: {own:?} {alone:?}");
            }
            let friction = (own.friction - alone.friction).abs();
            // What a gap may exceed the largest share by without being looked into.
            assert!(friction <= 1e-3 * alone.friction, "{base}, A_v = {a_v}: {own:?} {alone:?}");
        }
        let name = base.replace('\n', ", ");
        say(&format!("{name}, A_v = {a_v}: {done} of {never_lift} that never lift"));
        match goes_on {
            true => {
                assert!(never_lift > 100 && 10 * done >= 9 * never_lift, "{done} of {never_lift}")
            }
            false => assert_eq!(done, 0),
        }
        without.shortcuts = Shortcuts { certificate: false, ..plan.shortcuts };
        let record = plan.record();
        let made = Cells::<f64>::of(&without, &grid, &cells, &record, &Unwatched);
        assert!(cells.iter().all(|cell| made.begin(*cell).1.status != PROVED), "{base}");
    }
}
