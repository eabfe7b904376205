//! What a sweep leaves out has no say in the result: each shortcut against the full model, over
//! whole maps, on the CPU and, where there is one, on an adapter.

use std::f64::consts::TAU;
use std::time::Instant;

use proptest::prelude::*;
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::Rng;
use topple::backend::cpu;
use topple::backend::gpu::run::Sweeper;
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::cells::shortcuts::Shortcuts;
use topple::model::CellEquations;
use topple::model::asked::Asked;
use topple::model::block::{self, ROCKING_LEFT, ROCKING_RIGHT, pivot};
use topple::model::precision::Precision;
use topple::scene::{Excitation, GRAVITY, Grid, Parameter, Range, Scene, SceneBuilder};
use topple::stepping::certificate::is_final;
use topple::stepping::outcome::{Class, Outcome, Status};
use topple::stepping::reference::system::{DPHI, DU, DV, Pole, System, U, V, Z};
use topple::stepping::reference::{self, Settings};
use topple::stepping::single;
use topple::stepping::state::{FINISHED, PROVED, State};
use topple::work::observer::Unwatched;

use crate::common::{all, gpu, object, say, scene, synthetic_pair, under};

/// A pulse map of Object 1 whose base moves in some directions.
fn map(isolation: &str, psi: Option<f64>, a_v: f64, side: u32) -> Scene {
    let periods = match isolation {
        "dual" => "t_h = 1.75\nt_v = 0.75\n",
        "horizontal" => "t_h = 1.75\n",
        "vertical" => "t_v = 0.75\n",
        _ => "",
    };
    let psi = psi.map_or(String::new(), |psi| format!("psi = {psi}\n"));
    scene(&format!(
        "[block]\nobject = 1\neccentricity = 0.2\n[base]\nisolation = \"{isolation}\"\n{periods}{psi}\
         [pulse]\nomega = \"0.2:15:{side}\"\na_h = \"0.1:15:{side}\"\na_v = {a_v}\n"
    ))
}

/// A map under the synthetic record, from T_v = 0.3 s on: below, rocking is chaotic, and a change
/// of rounding decides cells.
fn record_map(object_number: u32, e: f64, side: u32, t_max: Option<f64>) -> Scene {
    let mut scene = object(object_number, e, (1.0, 1.0), 0.0, "5", "1");
    under(&mut scene, synthetic_pair());
    scene.set(Parameter::TMax, t_max.unwrap_or(scene.case().t_max));
    scene.set(Parameter::TH, Range::even(0.5, 4.0, side));
    scene.set(Parameter::TV, Range::even(0.3, 2.0, side));
    scene
}

struct Compared {
    seconds: [f64; 2],
    differ: usize,
    zeta: f64,
    max_u: f64,
    max_v: f64,
}

/// The 99th percentile of a difference over the cells.
fn percentile(full: &[Outcome], less: &[Outcome], value: fn(&Outcome) -> f64) -> f64 {
    let mut all: Vec<f64> =
        full.iter().zip(less).map(|(a, b)| (value(a) - value(b)).abs()).collect();
    all.sort_by(f64::total_cmp);
    all[(all.len() - 1) * 99 / 100]
}

fn compare(full: &[Outcome], less: &[Outcome], seconds: [f64; 2]) -> Compared {
    let other = |(a, b): &(&Outcome, &Outcome)| a.class != b.class;
    Compared {
        seconds,
        differ: full.iter().zip(less).filter(other).count(),
        zeta: percentile(full, less, |cell| cell.zeta),
        max_u: percentile(full, less, |cell| cell.max_u),
        max_v: percentile(full, less, |cell| cell.max_v),
    }
}

/// A scene with all of the model and with `shortcuts`, in f64; the accuracy of the step on zeta
/// and the displacements is a median of 1e-6, some hundred times that at the 99th percentile.
fn hold(name: &str, scene: &Scene, shortcuts: Shortcuts) -> Vec<Outcome> {
    let grid = Grid::of(scene);
    let plan = Plan::new(scene, DEFAULT_STEP).unwrap();
    let mut less = plan.clone();
    less.shortcuts = shortcuts;
    let run = |plan: &Plan| {
        let began = Instant::now();
        let cells = cpu::sweep(Precision::F64, plan, &grid, &all(&grid), &Unwatched);
        (cells, began.elapsed().as_secs_f64())
    };
    let (full, slow) = run(&plan.full_model());
    let (cells, fast) = run(&less);
    let c = compare(&full, &cells, [slow, fast]);
    say(&format!(
        "{name}: {} cells, {:.2} s, {:.2} s without: {:.1} times; {} differ; zeta {:.0e}, max|u| {:.0e} m, \
         max|v| {:.0e} m",
        grid.len(),
        c.seconds[0],
        c.seconds[1],
        c.seconds[0] / c.seconds[1],
        c.differ,
        c.zeta,
        c.max_u,
        c.max_v
    ));
    assert_eq!(c.differ, 0, "{name}");
    assert!(
        c.zeta <= 1e-4 && c.max_u <= 1e-5 && c.max_v <= 1e-5,
        "{name}: {} {} {}",
        c.zeta,
        c.max_u,
        c.max_v
    );
    cells
}

const CERTIFICATE: Shortcuts = Shortcuts { certificate: true, ..Shortcuts::NONE };
const FULL_CONTACT: Shortcuts = Shortcuts { full_contact: true, ..Shortcuts::NONE };
const LINEAR: Shortcuts = Shortcuts { linear: true, ..Shortcuts::NONE };

#[test]
fn the_certificate_changes_no_outcome() {
    for isolation in ["dual", "horizontal", "vertical", "none"] {
        for a_v in [0.0, 0.5] {
            let scene = map(isolation, None, a_v, 40);
            let cells =
                hold(&format!("certificate, {isolation}, A_v = {a_v}"), &scene, CERTIFICATE);
            // Of the slowest pulses there is no end in the 30 s, and nothing to prove.
            let grid = Grid::of(&scene);
            let ends = |index: usize| TAU / grid.case(index).shaking.pulse().unwrap().omega < 20.0;
            let stand = cells
                .iter()
                .enumerate()
                .filter(|(index, cell)| ends(*index) && !cell.class.overturned())
                .map(|(_, cell)| cell);
            let (proved, rest): (Vec<&Outcome>, Vec<&Outcome>) =
                stand.partition(|cell| cell.status == Status::Proved);
            let mean = proved.iter().map(|cell| cell.t_simulated).sum::<f64>()
                / proved.len().max(1) as f64;
            say(&format!("  {} cells proved, after {mean:.1} s; {} not", proved.len(), rest.len()));
            // A block on a vertical isolation alone rocks for long, and all of its energy might still
            // go into v: more than half is proved in the 30 s.
            let most = if isolation == "vertical" { proved.len() } else { proved.len() / 50 };
            assert!(rest.len() <= most, "{isolation}: {} not proved", rest.len());
            assert!(mean < 10.0);
            // For all that a map tells, it stands to the end.
            assert!(proved.iter().all(|cell| cell.t_end == 30.0));
        }
    }
}

/// Under a record followed by free vibration.
#[test]
fn the_certificate_changes_no_outcome_after_a_record() {
    let scene = record_map(1, -0.4, 16, Some(60.0));
    let cells = hold("certificate, record and 40 s free", &scene, CERTIFICATE);
    assert!(cells.iter().filter(|cell| cell.status == Status::Proved).count() > 50);
}

/// As in suites: contact forces are not asked for.
const WITHOUT_FORCES: Asked = Asked { forces: false, ..Asked::ALL };
/// Nothing but what became of the block.
const OUTCOME: Asked = Asked { angles: false, displacements: false, forces: false, ..Asked::ALL };

/// A cell that the certificate ends, or whose block it brings to rest, would indeed have made nothing more of itself: its
/// run with the certificate, and without. How many cells are proved, and how many of them have come to rest.
fn nothing_grows(name: &str, scene: &Scene, asked: Asked) -> [usize; 2] {
    let grid = Grid::of(scene);
    let plan = Plan::new(scene, DEFAULT_STEP).unwrap().asking(asked);
    let model = plan.model::<f64>(&plan.scene.case());
    let (mut proved, mut rested) = (0, 0);
    for index in all(&grid) {
        let (cell, state) = plan.cell::<f64>(&grid.case(index));
        let mut set = CellEquations::of(plan.variant(), &model, &cell, &[]);
        let then = single::run(&set, &state, &mut ());
        if then.status != PROVED {
            continue;
        }
        proved += 1;
        set.variant.certificate = false;
        set.variant.asked = Asked::ALL;
        let state = single::run(&set, &state, &mut ());
        assert_eq!(state.status, FINISHED, "{name}, {:?}", grid.case(index));
        if state.uplifts > 0 && then.mode == block::FULL_CONTACT {
            rested += 1;
            assert!(then.impacts <= state.impacts, "{name}, {:?}", grid.case(index));
        }
        let lifted = [&then, &state].map(|state| state.uplifts > 0);
        assert_eq!(lifted[0], lifted[1], "{name}, {:?}", grid.case(index));
        // A block that is brought to rest earlier may lift once more later on.
        if asked.angles {
            assert_eq!(then.uplifts, state.uplifts, "{name}, {:?}", grid.case(index));
        }
        let angles = [
            state.extremes.max_phi_left - then.extremes.max_phi_left,
            state.extremes.max_phi_right - then.extremes.max_phi_right,
        ];
        // What a table has of v: the largest way from the static position, and that from the unloaded spring.
        let largest = |end: &State<f64>, from: f64| {
            (end.extremes.least_v - from).abs().max((end.extremes.most_v - from).abs())
        };
        let grown = |from: f64| largest(&state, from) - largest(&then, from);
        let ways = [
            state.extremes.max_u - then.extremes.max_u,
            grown(0.0),
            grown(cell.vertical.deflection),
        ];
        for (asked, grown) in [(asked.angles, &angles[..]), (asked.displacements, &ways[..])] {
            let other = asked && grown.iter().any(|more| more.abs() > 1e-9);
            assert!(!other, "{name}, {:?}: {grown:?}", grid.case(index));
        }
        if !asked.forces {
            continue;
        }
        // The contact forces by a thousandth at most.
        let lower = then.extremes.min_contact - state.extremes.min_contact;
        assert!(lower <= 1e-3 * then.extremes.min_contact.abs(), "{:?}: {lower}", grid.case(index));
        let higher = state.extremes.friction - then.extremes.friction;
        assert!(higher <= 1.001e-3 * then.extremes.friction, "{:?}: {higher}", grid.case(index));
    }
    say(&format!("{name}: {proved} proved, {rested} of them rocked and rest"));
    [proved, rested]
}

#[test]
fn what_is_proved_stays_so() {
    let mut all_rested = 0;
    // What is not asked for holds up no proof.
    for (isolation, a_v, asked) in [
        ("dual", 0.5, Asked::ALL),
        ("dual", 0.0, Asked::ALL),
        ("dual", 0.5, WITHOUT_FORCES),
        ("dual", 0.0, WITHOUT_FORCES),
        ("dual", 0.5, OUTCOME),
        ("dual", 0.0, OUTCOME),
        ("dual", 0.5, Asked { angles: true, ..OUTCOME }),
        ("dual", 0.5, Asked { displacements: true, ..OUTCOME }),
        ("dual", 0.5, Asked { forces: true, ..OUTCOME }),
        ("vertical", 0.5, WITHOUT_FORCES),
        ("vertical", 0.5, OUTCOME),
        ("horizontal", 0.0, Asked::ALL),
        ("horizontal", 0.0, OUTCOME),
        ("none", 0.5, Asked::ALL),
        ("none", 0.5, OUTCOME),
    ] {
        let name = format!("{isolation}, A_v = {a_v}, {asked:?}");
        let [proved, rested] = nothing_grows(&name, &map(isolation, None, a_v, 24), asked);
        assert!(proved > 50, "{name}: {proved}");
        all_rested += rested;
    }
    assert!(all_rested > 60, "{all_rested}");
}

/// A block of slenderness 100 that lands almost without loss, on a base 10,000 times as heavy: the kicks of its impacts,
/// in resonance with the base, move this further than any single one of them, by micrometres.
#[test]
fn kicks_in_resonance_with_a_heavy_base_are_seen() {
    let slender = scene(
        "[block]\nslenderness = 100\nsize = 1\nmass = 1\nplate_h = 3.44e4\n\
         [base]\nisolation = \"horizontal\"\nt_h = 5.347826\nxi_h = 0.0005\npsi = 1\n\
         [pulse]\nshape = \"one-cosine\"\nomega = 2.294\na_h = \"5.197e-6\"\n\
         [run]\ntilt = 0.00980907\nt_max = 150\n",
    );
    nothing_grows("kicks in resonance", &slender, Asked::ALL);
}

/// A block that falls back from a small tilt on a vertical base that nothing else moves: the heights of its flights set its
/// least and largest v.
#[test]
fn flights_that_move_a_base_at_rest_are_seen() {
    for plate in [0.05, 0.5, 5.0] {
        let tilted = scene(&format!(
            "[block]\nslenderness = 2\nsize = 1\nmass = 1\nplate_v = {plate}\n\
             [base]\nisolation = \"vertical\"\nt_v = \"0.05:3:60\"\nxi_v = 0.0005\n\
             [pulse]\nomega = 200\na_h = 1e-6\n[run]\ntilt = \"0.0003,0.001,0.01,0.05\"\nt_max = 60\n"
        ));
        let name = format!("flights on a base at rest, m_v = {plate} M");
        let [proved, _] = nothing_grows(&name, &tilted, Asked::ALL);
        assert!(proved > 60, "{name}: {proved}");
    }
}

/// Most impacts of a block that stays up are left out: those of flights that can reach nothing new.
#[test]
fn a_block_that_chatters_rests_early() {
    for a_v in [0.0, 0.5] {
        let scene = map("dual", None, a_v, 40);
        let (grid, plan) = (Grid::of(&scene), Plan::new(&scene, DEFAULT_STEP).unwrap());
        let impacts = |plan: &Plan, stays: bool| -> u32 {
            let cells = cpu::sweep(Precision::F64, plan, &grid, &all(&grid), &Unwatched);
            cells
                .iter()
                .filter(|cell| cell.class.overturned() != stays)
                .map(|cell| cell.impacts)
                .sum()
        };
        let full = plan.full_model();
        assert_eq!(impacts(&plan, false), impacts(&full, false), "of blocks that overturn");
        let [fewer, all] = [&plan, &full].map(|plan| impacts(plan, true));
        say(&format!("A_v = {a_v}: {fewer} impacts of {all}"));
        assert!(2 * fewer < all, "A_v = {a_v}: {fewer} of {all}");
    }
}

/// A ball that bounces under a force of two frequencies, 1 on average, the faster of 1 rad/s.
struct Bouncing {
    /// Amplitude, frequency and phase of each part of the force.
    terms: [(f64, f64, f64); 2],
    least: f64,
    most: f64,
    /// The speed of its first flight, which lasts one radian at most under the least force.
    first: f64,
    /// Speed after an impact over that before it.
    eta: f64,
}

impl Bouncing {
    fn random(uniform: &mut impl FnMut(f64, f64) -> f64, eta: f64) -> Bouncing {
        let (a, slower) = (uniform(0.02, 0.95), uniform(0.0, 1.0));
        let terms = [
            (a * (1.0 - slower), 1.0, uniform(0.0, TAU)),
            (a * slower, uniform(0.1, 1.0), uniform(0.0, TAU)),
        ];
        let (least, most) = (1.0 - a, 1.0 + a);
        Bouncing { terms, least, most, first: 0.5 * uniform(0.02, 1.0) * least, eta }
    }

    fn force(&self, t: f64) -> f64 {
        1.0 + self.terms.iter().map(|(a, omega, phase)| a * (omega * t + phase).sin()).sum::<f64>()
    }

    /// The first integral of the force.
    fn integral(&self, t: f64) -> f64 {
        t - self
            .terms
            .iter()
            .map(|(a, omega, phase)| a / omega * (omega * t + phase).cos())
            .sum::<f64>()
    }

    /// The second one.
    fn second(&self, t: f64) -> f64 {
        let swing = self
            .terms
            .iter()
            .map(|(a, omega, phase)| a / (omega * omega) * (omega * t + phase).sin());
        0.5 * t * t - swing.sum::<f64>()
    }

    /// Height and speed at a time of a flight that began at `from`.
    fn at(&self, from: f64, speed: f64, time: f64) -> [f64; 2] {
        let fallen = self.second(from + time) - self.second(from) - self.integral(from) * time;
        [speed * time - fallen, speed - (self.integral(from + time) - self.integral(from))]
    }

    /// Calls `flight` with the begin, the speed and the length of each of the first flights.
    fn flights(&self, count: usize, mut flight: impl FnMut(f64, f64, f64)) {
        let (mut speed, mut t) = (self.first, 0.0);
        for _ in 0..count {
            let (mut low, mut high) = (0.0, 2.001 * speed / self.least);
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                let above = self.at(t, speed, middle)[0] >= 0.0;
                (low, high) = if above { (middle, high) } else { (low, middle) };
            }
            flight(t, speed, high);
            speed = -self.eta * self.at(t, speed, high)[1];
            t += high;
        }
    }
}

/// Numbers between two others.
fn uniform_numbers(seed: u128) -> impl FnMut(f64, f64) -> f64 {
    let mut random = Pcg64Mcg::new(seed);
    move |least, most| least + (most - least) * f64::from(random.next_u32()) / f64::from(u32::MAX)
}

/// The bounds of the energy and of the height of later flights, where impacts take no energy.
#[test]
fn a_ball_that_bounces_gains_no_more_than_the_force_does() {
    let mut uniform = uniform_numbers(43);
    let mut worst = [0.0_f64; 2];
    for _ in 0..500 {
        let ball = Bouncing::random(&mut uniform, 1.0);
        let now = ball.force(0.0);
        let height = ball.first.powi(2) / (now * ball.least).sqrt();
        ball.flights(300, |from, speed, length| {
            let energy = (speed / ball.first).powi(2) * now / ball.most;
            let top = (1..8)
                .map(|eighth| ball.at(from, speed, 0.125 * f64::from(eighth) * length)[0] / height);
            worst = [worst[0].max(energy), top.fold(worst[1], f64::max)];
        });
    }
    say(&format!("the largest energy and height are {worst:.3?} of their bounds"));
    assert!(worst.iter().all(|share| *share <= 1.0 && *share > 0.5), "{worst:?}");
}

/// The bounds of the way of an oscillator, and of the force on it, that is as fast as one of the parts of the force, and
/// on which a ball bounces.
#[test]
fn an_oscillator_moves_no_further_than_by_the_height_of_flights() {
    let mut uniform = uniform_numbers(44);
    let mut worst = [0.0_f64; 2];
    for _ in 0..400 {
        let eta = 1.0 - 10.0_f64.powf(uniform(-3.5, -0.7));
        let ball = Bouncing::random(&mut uniform, eta);
        let omega = if uniform(0.0, 1.0) < 0.6 { 1.0 } else { ball.terms[1].1 };
        let xi = 10.0_f64.powf(uniform(-2.5, -0.5));
        let now = ball.force(0.0);
        let radians = 2.5 * ball.first / ball.least;
        let way = ball.first.powi(2) / (now * ball.least).sqrt()
            * (1.25 + 0.02 * radians / (1.0 - eta.powi(3)));
        let kick = ball.first * (ball.most / now).sqrt();
        let reach = omega * (1.0 + 4.0 * xi * xi).sqrt();
        let force = 2.0 * reach * reach * way + 2.0 * xi * omega * kick;
        // Displacement and velocity of the spring, of which the other end moves with the ball.
        let mut y = [0.0; 2];
        let rate = |[e, de]: [f64; 2], [r, dr]: [f64; 2]| {
            [de, omega * omega * (r - e) + 2.0 * xi * omega * (dr - de)]
        };
        ball.flights(500, |from, speed, length| {
            let h = length / 8.0;
            for part in 0..8 {
                let moves = |share: f64| ball.at(from, speed, (f64::from(part) + share) * h);
                let step = |y: [f64; 2], k: [f64; 2], h: f64| [y[0] + h * k[0], y[1] + h * k[1]];
                let k1 = rate(y, moves(0.0));
                let k2 = rate(step(y, k1, 0.5 * h), moves(0.5));
                let k3 = rate(step(y, k2, 0.5 * h), moves(0.5));
                let k4 = rate(step(y, k3, h), moves(1.0));
                y = step(step(step(step(y, k1, h / 6.0), k2, h / 3.0), k3, h / 3.0), k4, h / 6.0);
                let ball = moves(1.0);
                worst[0] = worst[0].max((y[0] - ball[0]).abs() / way);
                worst[1] = worst[1].max(rate(y, ball)[1].abs() / force);
            }
        });
    }
    say(&format!("the largest way and force are {worst:.3?} of their bounds"));
    assert!(worst.iter().all(|share| *share <= 1.0 && *share > 0.3), "{worst:?}");
}

#[test]
fn a_shared_full_contact_changes_no_outcome() {
    for (name, scene) in [
        ("full contact, record, Object 1", record_map(1, -0.4, 24, None)),
        ("full contact, record, Object 3", record_map(3, 0.4, 24, None)),
        ("full contact, pulse", map("dual", None, 0.5, 40)),
        ("full contact, pulse, v at rest", map("dual", None, 0.0, 40)),
        ("full contact, pulse, horizontal", map("horizontal", None, 0.0, 40)),
    ] {
        let cells = hold(name, &scene, FULL_CONTACT);
        assert!(cells.iter().any(|cell| cell.class == Class::FullContact), "{name}");
    }
}

/// A horizontal motion reversed: A_h < 0 scales the shared motion by a negative number.
#[test]
fn a_shared_full_contact_changes_no_outcome_where_the_pulse_is_reversed() {
    let mut scene = map("dual", None, 0.5, 24);
    scene.set(Parameter::AH, Range::even(-12.0, 12.0, 24));
    hold("full contact, A_h from -12 to 12", &scene, FULL_CONTACT);
}

#[test]
fn a_linear_base_has_no_hysteretic_variable() {
    hold("linear, psi = 1", &map("dual", Some(1.0), 0.5, 40), LINEAR);
    let plan = Plan::new(&map("dual", Some(1.0), 0.5, 4), DEFAULT_STEP).unwrap();
    assert!(!plan.variant().yields && plan.full_model().variant().yields);
}

#[test]
fn all_shortcuts_together_change_no_outcome() {
    hold("all, dual, A_v = 0.5", &map("dual", None, 0.5, 60), Shortcuts::ALL);
    hold("all, dual, psi = 1", &map("dual", Some(1.0), 0.0, 60), Shortcuts::ALL);
    hold("all, none", &map("none", None, 0.5, 60), Shortcuts::ALL);
    hold("all, record, Object 3", &record_map(3, 0.0, 24, Some(40.0)), Shortcuts::ALL);
}

/// The shader leaves out the same.
#[test]
fn shortcuts_of_the_shader_change_no_outcome() {
    let Some(gpu) = gpu("shortcuts in the shader", Precision::F32) else { return };
    for (name, scene) in
        [("pulse", map("dual", None, 0.5, 40)), ("record", record_map(1, -0.4, 16, Some(40.0)))]
    {
        let (grid, plan) = (Grid::of(&scene), Plan::new(&scene, DEFAULT_STEP).unwrap());
        let run = |plan: &Plan| {
            let sweeper = Sweeper::new(&gpu, Precision::F32, plan.variant()).unwrap();
            let began = Instant::now();
            let ran = sweeper.sweep::<f32>(plan, &grid, &all(&grid), &Unwatched).unwrap();
            (ran.block.to_outcomes(), began.elapsed().as_secs_f64())
        };
        let (full, slow) = run(&plan.full_model());
        let (cells, fast) = run(&plan);
        let c = compare(&full, &cells, [slow, fast]);
        say(&format!(
            "shader f32, {name}: {:.2} s, {:.2} s without: {:.1} times; {} differ; zeta {:.0e}",
            c.seconds[0],
            c.seconds[1],
            c.seconds[0] / c.seconds[1],
            c.differ,
            c.zeta
        ));
        assert_eq!(c.differ, 0, "{name}");
        assert!(cells.iter().any(|cell| cell.status == Status::Proved), "{name}");
        let impacts = |cells: &[Outcome]| -> u32 {
            cells.iter().filter(|cell| !cell.class.overturned()).map(|cell| cell.impacts).sum()
        };
        // Under this record blocks have come to rest before it ends.
        let [fewer, all] = [&cells, &full].map(|cells| impacts(cells));
        assert!(name == "record" || 2 * fewer < all, "{name}: {fewer} of {all} impacts");
    }
}

/// And the reference, which leaves out nothing, agrees.
#[test]
fn the_reference_agrees_with_what_is_left() {
    for isolation in ["dual", "none"] {
        let scene = map(isolation, None, 0.5, 24);
        let (grid, plan) = (Grid::of(&scene), Plan::new(&scene, DEFAULT_STEP).unwrap());
        let cells = cpu::sweep(Precision::F64, &plan, &grid, &all(&grid), &Unwatched);
        let differ = (0..grid.len()).filter(|index| {
            let right = reference::run(&scene, &grid.case(*index), &Settings::default());
            right.class != cells[*index].class
        });
        assert_eq!(differ.count(), 0, "{isolation}");
    }
}

proptest! {
    /// The certificate against energies from the other formulation, the reference's: a rocking state after an impact
    /// is proved where what energy it has left is below that of every angle seen so far, and nowhere
    /// else.
    #[test]
    fn the_certificate_knows_the_energy(
        left in any::<bool>(),
        dphi in -0.6..0.6_f64,
        base in ([-0.02..0.02_f64, -0.2..0.2_f64], [-0.02..0.02_f64, -0.2..0.2_f64], -1.0..1.0_f64),
        seen in [0.0..0.14_f64, 0.0..0.14_f64],
    ) {
        let scene = object(1, 0.2, (1.75, 0.75), 0.0, "5", "3");
        let point = Grid::of(&scene).case(0);
        let plan = Plan::new(&scene, DEFAULT_STEP).unwrap();
        let model = plan.model::<f64>(&plan.scene.case());
        let (cell, mut state) = plan.cell::<f64>(&point);
        let set = CellEquations::of(plan.variant(), &model, &cell, &[]);
        let pole = if left { Pole::Left } else { Pole::Right };
        let ([u, du], [lift, dv], z) = base;
        state.mode = if left { ROCKING_LEFT } else { ROCKING_RIGHT };
        let y = &mut state.motion;
        (y.u, y.du, y.v, y.dv, y.z) = (u, du, y.v + lift, dv, z);
        y.dphi = dphi;
        (state.extremes.max_phi_left, state.extremes.max_phi_right) = (seen[0], seen[1]);
        // No matter here.
        (state.extremes.max_u, state.extremes.least_v, state.extremes.most_v) = (100.0, -100.0, 100.0);
        (state.extremes.min_contact, state.extremes.friction) = (-1.0e6, 1.0e6);
        let corner = pivot(&model, state.mode);
        let proved = is_final(&set, &corner, true, true, true, &state.motion, &state.extremes);
        // Before the first uplift from full contact its time is not known.
        prop_assert!(!is_final(&set, &corner, true, true, false, &state.motion, &state.extremes));

        let system = System::new(&scene, &point);
        let mut other = system.at_rest();
        let rest = system.energy(None, &other);
        let y = state.motion;
        (other[U], other[DU], other[V], other[DV], other[Z]) = (y.u, y.du, other[V] + y.v, y.dv, y.z);
        other[DPHI] = y.dphi;
        let energy = (system.energy(Some(pole), &other) - rest) / scene.case().block.mass;
        let height = scene.case().block.height;
        let bound = |side: f64, angle: f64| {
            let (arm, critical) = (scene.case().block.arm(side), scene.case().block.critical_angle(side));
            GRAVITY * (arm.hypot(height) * (critical - angle).cos() - height)
        };
        let least = bound(1.0, seen[0]).min(bound(-1.0, seen[1]));
        if energy < 0.998 * least {
            prop_assert!(proved, "{} of {}", energy, least);
        }
        if energy > least {
            prop_assert!(!proved, "{} of {}", energy, least);
        }
    }
}

/// Under a record with a given yield displacement u is proportional to nothing, and yet each value of T_h has one motion
/// in full contact for all eccentricities, blocks and values of T_v. Where no contact forces are requested, only bounds of
/// the gaps are kept; all else is equal but for rounding.
#[test]
fn a_shared_full_contact_changes_no_outcome_of_a_given_device() {
    for (name, isolation) in [("yields", ""), ("linear", "psi = 1\n")] {
        let text = format!(
            "[block]\nobject = 1\neccentricity = \"0,0.2,0.3\"\n[base]\nt_h = \"0.3:3:10\"\nt_v = \"0.3:1.5:10\"\n\
             u_y = 0.01\n{isolation}"
        );
        let given = SceneBuilder::from_toml(&text).unwrap();
        let scene = given.check_under(Excitation::Record(synthetic_pair())).unwrap();
        let cells = hold(&format!("given u_y, {name}"), &scene, FULL_CONTACT);
        let (grid, plan) = (Grid::of(&scene), Plan::new(&scene, DEFAULT_STEP).unwrap());
        let mut plan = plan.asking(WITHOUT_FORCES);
        plan.shortcuts = FULL_CONTACT;
        let without = cpu::sweep(Precision::F64, &plan, &grid, &all(&grid), &Unwatched);
        let mut others = 0;
        for (all, less) in cells.iter().zip(&without) {
            others += usize::from(all.min_contact != less.min_contact);
            let counts = |cell: &Outcome| (cell.class, cell.impacts, cell.uplifts, cell.status);
            assert_eq!(counts(all), counts(less));
            // A unit in the last place, of a thousand steps, and grown tenfold at each of some impacts at the most.
            let grown = 1.0e3 * f64::EPSILON * 10.0_f64.powi(all.impacts.min(6) as i32);
            let numbers = |cell: &Outcome| [cell.zeta, cell.max_u, cell.max_v, cell.stroke_v];
            for (one, other) in numbers(all).into_iter().zip(numbers(less)) {
                assert!((one - other).abs() <= grown, "{all:?} {less:?}");
            }
        }
        let lifted = cells.iter().filter(|cell| cell.uplifts > 0).count();
        assert!(others > 0 && lifted > 0, "{name}: {others} {lifted}");
    }
}

/// A shared motion that leaves the range of valid motions ends early. The cells that share it integrate by themselves,
/// and are as unresolved as those that share nothing. So soft a base does not let the block lift before.
#[test]
fn a_shared_motion_that_diverges_is_nobodys() {
    let text = "[block]\nobject = 1\neccentricity = \"0:0.3:40\"\n[base]\nisolation = \"vertical\"\n\
                t_v = \"1e4:2e4:12\"\n[record]\nscale = \"1,1e5\"\n[run]\nforce = true\n";
    let given = SceneBuilder::from_toml(text).unwrap();
    let mut pair = synthetic_pair();
    pair.horizontal = vec![0.0; pair.horizontal.len()].into();
    let scene = given.check_under(Excitation::Record(pair)).unwrap();
    let (grid, plan) = (Grid::of(&scene), Plan::new(&scene, DEFAULT_STEP).unwrap());
    let run = |shortcuts: Shortcuts| {
        let mut plan = plan.asking(WITHOUT_FORCES);
        plan.shortcuts = shortcuts;
        cpu::sweep(Precision::F32, &plan, &grid, &all(&grid), &Unwatched)
    };
    let (shared, alone) = (run(FULL_CONTACT), run(Shortcuts::NONE));
    let lost = alone.iter().filter(|cell| cell.status == Status::Diverged).count();
    assert!(2 * lost >= grid.len(), "{lost}");
    for (one, other) in shared.iter().zip(&alone) {
        assert_eq!((one.status, one.class), (other.status, other.class));
    }
}
