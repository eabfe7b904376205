//! Switches where they are hard to see, to tell apart, or to count.

use topple::backend::cpu;
use topple::cells::clock::{DEFAULT_STEP, Resolution};
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::scene::{GRAVITY, Grid, Scene};
use topple::stepping::guards::IMPACT;
use topple::stepping::log::Log;
use topple::stepping::outcome::{Class, Status};
use topple::stepping::reference::Settings;
use topple::stepping::state::State;
use topple::work::observer::Unwatched;
use topple_lab::chart::SWITCHES;
use topple_lab::chart::truth::{Kind, TimedSwitch, by_reference, of_events};

use crate::common::{object, say, scene, shaken};

use super::{altered, limit, on_the_ground, swept, tight, truth};

/// The first switches of a scene's first cell.
fn switches(scene: &Scene, resolution: Resolution) -> Vec<TimedSwitch> {
    let plan = Plan::resolved(scene, resolution).unwrap();
    let grid = Grid::of(scene);
    let (_, events) = cpu::sweep_keeping::<f64>(&plan, &grid, &[0], SWITCHES);
    let case = grid.case(0);
    of_events(&events, &plan.clock(&case), case.deflection())
}

fn true_switches(scene: &Scene) -> Vec<TimedSwitch> {
    by_reference(scene, &Grid::of(scene).case(0), &tight()).switches
}

/// Kinds agree; the largest error of a time.
fn worst_time(found: &[TimedSwitch], right: &[TimedSwitch]) -> f64 {
    let kinds = |list: &[TimedSwitch]| list.iter().map(|s| s.kind).collect::<Vec<_>>();
    assert_eq!(kinds(found), kinds(right));
    found.iter().zip(right).fold(0.0, |worst, (a, b)| worst.max((a.t - b.t).abs()))
}

/// An impact that falls on the end of a step, on its start, and a hair to either side.
#[test]
fn an_impact_on_a_step_boundary() {
    let rocking = |h: f64| {
        on_the_ground(&format!(
            "[pulse]\nomega = {}\na_h = 0.0\n[run]\nt_max = 2.0\ntilt = 0.1\n",
            std::f64::consts::TAU / (16.0 * h)
        ))
    };
    let right = true_switches(&rocking(0.01));
    let first = right[0].t;
    let on_it = switches(&rocking(first / 64.0), Resolution::exactly(first / 64.0 * (1.0 + 1e-12)));
    let mut worst: f64 = 0.0;
    for aside in [0.0, 1e-15, -1e-15, 1e-12, -1e-12, 1e-9, -1e-9] {
        // The first impact at the end of the 64th step, but for `aside`.
        let h = first / 64.0 * (1.0 + aside);
        let found = switches(&rocking(h), Resolution::exactly(h * (1.0 + 1e-12)));
        worst = worst.max(worst_time(&found, &on_it));
    }
    let off = worst_time(&on_it, &right);
    say(&format!(
        "an_impact_on_a_step_boundary: times within {off:.0e} s of the reference, {worst:.0e} s of one another"
    ));
    // RK4's own error of these steps, and what is left of it when they change by 1e-9.
    assert!(off < 1e-8 && worst < 1e-9 * 2.0 + off * 1e-6, "{off} {worst}");
}

/// An uplift condition that is met exactly at a sample of the record, where equality is no uplift
/// and the next instant is; and one that is met in equality and then left again.
#[test]
fn an_uplift_on_a_sample() {
    let threshold = 0.2 * GRAVITY; // b/H g
    let block = on_the_ground("[pulse]\nomega = 5.0\na_h = 0.0\n");
    let mut through = vec![0.0; 200];
    let mut touching = through.clone();
    for (k, factor) in [(99, 0.5), (100, 1.0), (101, 1.5), (102, 1.0)] {
        through[k] = threshold * factor;
        touching[k] = threshold * factor.min(1.0);
    }
    let scene = shaken(block.clone(), 0.01, through);
    let cell = swept::<f64>(&scene);
    let late = cell.t_uplift.unwrap() - 1.0;
    say(&format!("an_uplift_on_a_sample: {late:.0e} s late"));
    // Located to 1e-10 of a step, where the threshold itself is rounded.
    assert!(late.abs() < 1e-10 && cell.uplifts >= 1, "{cell:?}");
    assert_eq!(swept::<f64>(&shaken(block, 0.01, touching)).class, Class::FullContact);
}

/// Flights far shorter than a step: every impact of each step is found, in order. Moved to the
/// step's end, the same impacts come late by up to a step each.
#[test]
fn many_crossings_in_one_step() {
    let scene =
        on_the_ground("[pulse]\nomega = 5.0\na_h = 0.0\n[run]\nt_max = 1.0\ntilt = 1.0e-4\n");
    let right = true_switches(&scene);
    let h = 1.0 / 16.0;
    let in_step = worst_time(&switches(&scene, Resolution::exactly(h)), &right);
    let plan = Plan::resolved(&scene, Resolution::exactly(h).across_kinks()).unwrap();
    let grid = Grid::of(&scene);
    let (_, events) = topple_lab::chart::naive::sweep(&plan, &grid, &[0], SWITCHES);
    let case = grid.case(0);
    let naive = of_events(&events, &plan.clock(&case), case.deflection());
    let late = naive[1].t - right[1].t;
    say(&format!(
        "many_crossings_in_one_step: {} in {:.2} s with steps of 1/16 s: within {in_step:.0e} s; naive {late:.2} s late",
        right.len(),
        right.last().unwrap().t
    ));
    assert!(right[1].t - right[0].t < h, "the flights should be shorter than a step");
    assert!(in_step < 1e-6, "{in_step}");
    assert!(late > 0.5 * h, "{late}");
}

/// The block lifts and lands again in one step.
#[test]
fn uplift_and_impact_in_one_step() {
    let peak = 0.2 * GRAVITY * 1.0005;
    let scene =
        on_the_ground(&format!("[pulse]\nomega = 20.0\na_h = {peak}\n[run]\nt_max = 0.32\n"));
    let right = true_switches(&scene);
    let h = 1.0 / 16.0;
    let found = switches(&scene, Resolution::exactly(h));
    assert!(matches!(right[0].kind, Kind::Uplift(_)) && matches!(right[1].kind, Kind::Impact(_)));
    let flight = right[1].t - right[0].t;
    let step = |t: f64| (t / (std::f64::consts::TAU / 20.0 / 6.0)).floor();
    assert_eq!(step(right[0].t), step(right[1].t), "both in one of the pulse's six steps");
    let worst = (found[0].t - right[0].t).abs().max((found[1].t - right[1].t).abs());
    let default =
        worst_time(&switches(&scene, Resolution::bounded(DEFAULT_STEP))[..2], &right[..2]);
    say(&format!(
        "uplift_and_impact_in_one_step: a flight of {flight:.4} s in a step of 0.052 s: within {worst:.0e} s; \
         at the default step {default:.0e} s"
    ));
    assert_eq!((found[0].kind, found[1].kind), (right[0].kind, right[1].kind));
    assert!(worst < 0.1 * flight && default < 1e-3 * flight);
}

/// An uplift condition that is met for an instant only, at a crest between two steps: the smallest
/// excess that is seen, and no uplift where there is none. A block that lifts by less falls back at
/// once.
#[test]
fn a_grazing_uplift_is_found_and_none_below_the_threshold() {
    let lifts = |excess: f64| {
        let peak = 0.2 * GRAVITY * (1.0 + excess);
        let scene =
            on_the_ground(&format!("[pulse]\nomega = 5.3\na_h = {peak}\n[run]\nt_max = 1.0\n"));
        swept::<f64>(&scene).uplifts > 0
    };
    let seen = (3..=15).take_while(|k| lifts(0.1_f64.powi(*k))).last().unwrap();
    say(&format!(
        "a_grazing_uplift_is_found_and_none_below_the_threshold: an excess of 1e-{seen} is seen"
    ));
    // The crest is looked for on a parabola through the step's ends and middle, which errs by
    // (omega h/2)^4/24 of its height: 7e-9.
    assert!(seen >= 8, "{seen}");
    for k in 3..=15 {
        assert!(!lifts(-0.1_f64.powi(k)), "an uplift below the threshold, 1e-{k}");
    }
}

/// A block that all but lands, held up by the ground's motion: the amplitude at which its angle
/// just touches zero, by the reference, and how near to it the sweep tells impact from none.
#[test]
fn a_grazing_impact_is_told_from_a_near_miss() {
    let scene = |a_h: f64| {
        on_the_ground(&format!(
            "[pulse]\nomega = 6.0\na_h = {a_h}\n[run]\nt_max = 0.75\ntilt = 0.08\n"
        ))
    };
    let lands = |cell: topple::stepping::outcome::Outcome| cell.impacts > 0;
    // The pulse pushes the falling block back up where it is strong enough.
    let touch = limit(0.0, 6.0, 1e-13, |a_h| lands(truth(&scene(a_h))));
    let agree = |relative: f64| {
        [1.0 - relative, 1.0 + relative].iter().all(|factor| {
            let scene = scene(touch * factor);
            lands(swept::<f64>(&scene)) == lands(truth(&scene))
        })
    };
    let to = (2..=12).take_while(|k| agree(0.1_f64.powi(*k))).last().unwrap();
    say(&format!(
        "a_grazing_impact_is_told_from_a_near_miss: told apart from none to 1e-{to} of the amplitude {touch:.4}"
    ));
    assert!(to >= 7, "{to}");
}

/// Counts impacts, and keeps the last one's time.
struct Impacts {
    step: f64,
    times: Vec<f64>,
}

impl Log<f64> for Impacts {
    fn switched(&mut self, kind: u32, fraction: f64, state: &State<f64>) {
        if kind == IMPACT {
            self.times.push((f64::from(state.step) + fraction) * self.step);
        }
    }
}

/// Impacts of a block let go at `tilt` on the ground, all steps alike.
fn impacts(
    scene: &Scene,
    rest_speed: Option<f64>,
) -> (Vec<f64>, topple::stepping::outcome::Outcome) {
    // All impacts, also those after the last that matters.
    let plan = Plan::new(scene, DEFAULT_STEP).unwrap().full_model();
    let step = plan.clock(&Grid::of(scene).case(0)).step_free;
    let mut log = Impacts { step, times: Vec::new() };
    let outcome = altered::<f64>(&plan, &mut log, |cell, _| {
        // Free steps from the start to the end of the run.
        cell.steps.steps_forced = 0;
        cell.steps.steps = (scene.case().t_max / step).round() as u32;
        if let Some(speed) = rest_speed {
            cell.steps.rest_speed = speed;
        }
    });
    (log.times, outcome)
}

/// A block dropped at a tiny angle: impacts accumulate at t_1 (1 + eta)/(1 - eta), with t_1 =
/// sqrt(2 phi_0/a) and a = g b/(rho^2 + b^2 + H^2) the constant deceleration near phi = 0.
#[test]
fn chatter_to_rest() {
    let (b, h, phi0) = (0.2, 1.0, 1.0e-6);
    let tilted = |rest: &str| {
        on_the_ground(&format!(
            "[pulse]\nomega = 5.0\na_h = 0.0\n[run]\nt_max = 2.0\ntilt = {phi0}\n{rest}"
        ))
    };
    let a = GRAVITY * b / (4.0 / 3.0 * (b * b + h * h));
    let eta = 1.0 - 1.5 * b * b / (b * b + h * h);
    let first = f64::sqrt(2.0 * phi0 / a);
    let end = first * (1.0 + eta) / (1.0 - eta);
    let (times, cell) = impacts(&tilted(""), None);
    let rest = *times.last().unwrap();
    // What is left when the next flight would last under 1/32 of a step: eta/(1 - eta) of it.
    let cut_off = DEFAULT_STEP / 32.0 / (1.0 - eta);
    say(&format!(
        "chatter_to_rest: {} impacts, at rest at {rest:.6} s of {end:.6} s (closed form)",
        times.len()
    ));
    assert_eq!((cell.class, cell.status), (Class::Rocking, Status::Ok));
    // The closed form neglects H phi against b: phi0 H/b.
    assert!((times[0] - first).abs() < 1e-4 * first, "{} {first}", times[0]);
    assert!(rest <= end * (1.0 + 1e-4) && rest >= end - cut_off, "{rest} {end} {cut_off}");
    // Far smaller rest speeds come nearer, and change nothing else.
    let (longer, same) = impacts(&tilted(""), Some(1.0e-6));
    let nearer = *longer.last().unwrap();
    // Left then: flights of 2 eta w/a and less, w up to the rest speed.
    let left = 2.0 * 1.0e-6 / (a * (1.0 - eta));
    assert!(
        nearer <= end * (1.0 + 1e-4) && nearer >= end * (1.0 - 1e-4) - left,
        "{nearer} {end} {left}"
    );
    assert_eq!((same.class, same.zeta), (cell.class, cell.zeta));
}

/// Hundreds of impacts a second, each found: a nearly elastic block at a tiny angle, against the
/// sum of its flights.
#[test]
fn hundreds_of_impacts_a_second() {
    let (b, h, phi0, eta) = (0.2, 1.0, 4.0e-6, 0.9995);
    let scene = on_the_ground(&format!(
        "[pulse]\nomega = 20.0\na_h = 0.0\n[run]\nt_max = 1.0\ntilt = {phi0}\nrestitution = {eta}\n"
    ));
    let a = GRAVITY * b / (4.0 / 3.0 * (b * b + h * h));
    let mut t = f64::sqrt(2.0 * phi0 / a);
    let mut flight = 2.0 * t;
    let mut expected = Vec::new();
    while t < 1.0 {
        expected.push(t);
        flight *= eta;
        t += flight;
    }
    let (times, cell) = impacts(&scene, None);
    let worst = times.iter().zip(&expected).fold(0.0, |w: f64, (a, b)| w.max((a - b).abs()));
    say(&format!(
        "hundreds_of_impacts_a_second: {} of {}, within {worst:.0e} s",
        times.len(),
        expected.len()
    ));
    assert!(expected.len() > 200 && cell.status == Status::Ok);
    // The last may fall on either side of the end.
    assert!(times.len().abs_diff(expected.len()) <= 1);
    // H phi0/b of the closed form, over the whole second.
    assert!(worst < 1e-4, "{worst}");
}

/// Without a rest speed a chattering block makes no end of impacts: the bound on switches ends the
/// cell, unresolved and with its reason. The sweep's own rest speed never comes near the bound.
#[test]
fn the_bound_on_switches() {
    let scene =
        on_the_ground("[pulse]\nomega = 5.0\na_h = 0.0\n[run]\nt_max = 2.0\ntilt = 1.0e-6\n");
    let (times, cell) = impacts(&scene, Some(0.0));
    say(&format!("the_bound_on_switches: reached after {} impacts", times.len()));
    assert_eq!((cell.class, cell.status), (Class::Unresolved, Status::EventLimit));
    let (_, cell) = impacts(&scene, None);
    assert_eq!((cell.class, cell.status), (Class::Rocking, Status::Ok));
}

/// Where the ground falls faster than g, both uplift inequalities hold at once: the corner of the
/// larger moment is taken, as by the reference, and the cell is marked, for the force is tensile.
#[test]
fn both_uplift_inequalities_at_once() {
    let (mut tensile, mut cells_in_all) = (0, 0);
    for eccentricity in [-0.3, 0.3] {
        let map = scene(&format!(
            "[block]\nhalf_width = 0.2\nheight = 1.0\neccentricity = {eccentricity}\n[base]\nisolation = \"none\"\n\
         [pulse]\nomega = \"4:12:5\"\na_h = \"0.5:3:6\"\na_v = 14.0\n[run]\nt_max = 3.0\n"
        ));
        let grid = Grid::of(&map);
        let plan = Plan::new(&map, DEFAULT_STEP).unwrap().full_model();
        let cells =
            cpu::sweep(Precision::F64, &plan, &grid, &crate::common::all(&grid), &Unwatched);
        cells_in_all += grid.len();
        for (index, cell) in cells.iter().enumerate() {
            let right =
                topple::stepping::reference::run(&map, &grid.case(index), &Settings::default());
            assert_eq!(
                (cell.class, cell.impacts),
                (right.class, right.impacts),
                "{:?}",
                grid.case(index)
            );
            tensile += usize::from(cell.loses_contact());
        }
    }
    say(&format!(
        "both_uplift_inequalities_at_once: {tensile} of {} cells marked tensile",
        cells_in_all
    ));
    assert!(2 * tensile > cells_in_all);
    // Both begin to hold within one step: the ground falls away under a block that it hardly pushes
    // sideways, to either side in turn.
    for a_h in ["0.02", "-0.02"] {
        let scene = scene(&format!(
            "[block]\nhalf_width = 0.2\nheight = 1.0\n[base]\nisolation = \"none\"\n\
             [pulse]\nomega = 6.0\na_h = {a_h}\na_v = 14.0\n[run]\nt_max = 0.9\n"
        ));
        let (found, right) =
            (switches(&scene, Resolution::bounded(DEFAULT_STEP)), true_switches(&scene));
        assert_eq!(found[0].kind, right[0].kind, "a_h = {a_h}");
        assert!(
            (found[0].t - right[0].t).abs() < 1e-6,
            "a_h = {a_h}: {} {}",
            found[0].t,
            right[0].t
        );
    }
    // The other side: no cell is marked where the ground never falls.
    let calm = object(1, 0.2, (1.75, 0.75), 0.0, "5", "2");
    assert!(swept::<f64>(&calm).min_contact > 0.0);
}
