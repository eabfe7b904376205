//! The laws of devices against closed forms, by fixed steps and by the reference.

use rayon::prelude::*;
use topple::backend::cpu;
use topple::backend::gpu::run::Sweeper;
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::model::asked::Asked;
use topple::model::precision::Precision;
use topple::model::pulse::Shape;
use topple::scene::device_numbers::DeviceNumbers;
use topple::scene::{
    Case, Directions, Excitation, GRAVITY, Grid, Parameter as P, Pressure, Range, Scene,
    SceneBuilder,
};
use topple::stepping::outcome::{Class, Outcome, Status};
use topple::stepping::reference::system::{DU, State, U};
use topple::stepping::reference::{self, Settings, Switch};
use topple::work::observer::Unwatched;

use crate::common::{all, gpu, say, synthetic_pair};

/// Masses of the block and of each plate, kg.
const BLOCK: f64 = 900.0;
const PLATE: f64 = 125.0;
const CARRIED: f64 = BLOCK + 2.0 * PLATE;

/// A block that is too low to lift, under rectangular pulses of a duration, s.
fn low(isolation: Directions, (a_h, a_v): (f64, f64), lasts: f64, t_max: f64) -> SceneBuilder {
    SceneBuilder { force: true, ..SceneBuilder::default() }
        .isolated(isolation)
        .pulse(Shape::Rectangle)
        .with(P::HalfWidth, 1.0)
        .with(P::Height, 0.01)
        .with(P::Mass, BLOCK)
        .with(P::PlateH, PLATE)
        .with(P::PlateV, PLATE)
        .with(P::Omega, std::f64::consts::PI / lasts)
        .with(P::AH, a_h)
        .with(P::AV, a_v)
        .with(P::TMax, t_max)
}

/// The cell by fixed steps in f64, all columns asked for, and by the reference.
fn both(scene: &SceneBuilder) -> [Outcome; 2] {
    let scene = scene.check().unwrap();
    let grid = Grid::of(&scene);
    let asked = Asked { accelerations: true, stops: true, ..Asked::ALL };
    let plan = Plan::new(&scene, DEFAULT_STEP).unwrap().at(Precision::F64).asking(asked);
    let cells = cpu::sweep(Precision::F64, &plan, &grid, &all(&grid), &Unwatched);
    let truth = reference::run(&scene, &grid.case(0), &Settings::default());
    for cell in [&cells[0], &truth] {
        assert_eq!(cell.class, Class::FullContact, "{cell:?}");
    }
    [cells[0], truth]
}

fn near(value: f64, wanted: f64, share: f64, what: &str) {
    assert!((value - wanted).abs() <= share * wanted.abs(), "{what}: {value} for {wanted}");
}

/// Displacement of a slider before it slides, m.
const BEFORE: f64 = 1.0e-5;

/// A slider without curvature, which is Coulomb's block.
fn coulomb(scene: SceneBuilder, mu: f64) -> SceneBuilder {
    scene.with(P::Radius, 1.0e5).with(P::Mu, mu).with(P::UY, BEFORE)
}

/// How far Coulomb's block slides under a push of `a` for `lasts`, pressed by `pressing` until then and by the weight from
/// then on, m; and the share by which the displacement before sliding lengthens it: while its force grows the block gains at
/// most mu n sqrt(2 u_y/a') more velocity, a' = a - mu n.
fn slides(mu: f64, a: f64, lasts: f64, pressing: f64) -> (f64, f64) {
    let gained = a - mu * pressing;
    let way = 0.5 * gained * lasts * lasts + (gained * lasts).powi(2) / (2.0 * mu * GRAVITY);
    let more = mu * pressing * (2.0 * BEFORE / gained).sqrt() / (gained * lasts);
    (way, 2.0 * more)
}

fn slid(cell: &Outcome, (way, more): (f64, f64), what: &str) {
    let u = cell.max_u;
    assert!(u > (1.0 - 1.0e-4) * way && u < (1.0 + more) * way, "{what}: {u} for {way} and {more}");
}

/// A rectangular push of A for T leaves a slider the velocity (A - mu n) T, n = g + A_v while the ground pushes up, too; mu g
/// then brings it to rest.
#[test]
fn a_slider_stops_where_coulombs_block_does() {
    let (mu, a, lasts) = (0.1, 3.0, 0.5);
    for a_v in [0.0, 4.0, -4.0] {
        let scene = coulomb(low(Directions::Horizontal, (a, a_v), lasts, 3.0), mu);
        for cell in both(&scene) {
            slid(&cell, slides(mu, a, lasts, GRAVITY + a_v), "follows");
            near(cell.acc_plate, mu * (GRAVITY + a_v.max(0.0)), 1.0e-3, "acceleration");
            near(cell.acc_block, cell.acc_plate, 1.0e-9, "block and plate");
            let pressing = GRAVITY + a_v.max(0.0);
            near(cell.acc_plate_total, pressing * (1.0 + mu * mu).sqrt(), 1.0e-4, "with gravity");
            near(cell.acc_block_total, cell.acc_plate_total, 1.0e-9, "block and plate");
            near(cell.base_load, CARRIED * pressing, 1.0e-9, "what the slider carries");
        }
        let constant = SceneBuilder { pressure: Some(Pressure::Constant), ..scene };
        for cell in both(&constant) {
            slid(&cell, slides(mu, a, lasts, GRAVITY), "constant");
        }
    }
}

/// On a vertical isolation the plate m_h presses with the ground, the rest by the spring: a soft spring carries the weight of
/// what is above, whatever the ground does. In these two seconds it moves by 1e-4 of its force.
#[test]
fn a_soft_spring_presses_with_the_weight_above() {
    let (mu, a, a_v, lasts) = (0.1, 3.0, 4.0, 0.2);
    let scene = coulomb(low(Directions::Dual, (a, a_v), lasts, 2.0), mu);
    for cell in both(&scene.with(P::TV, 300.0).with(P::XiV, 0.0)) {
        let pressing = GRAVITY + a_v * PLATE / CARRIED;
        slid(&cell, slides(mu, a, lasts, pressing), "on a spring");
        near(cell.base_load, CARRIED * pressing, 1.0e-3, "what the slider carries");
        near(cell.acc_plate_total, GRAVITY.hypot(mu * pressing), 1.0e-3, "with gravity");
    }
}

/// A base that is pushed for an instant meets its stop with the velocity v, goes in by v/omega_s, with damping by less, and
/// comes back.
#[test]
fn a_stop_takes_up_the_velocity_that_meets_it() {
    let (lasts, a, gap) = (1.0e-3, -1000.0, 0.05);
    let velocity: f64 = 1.0;
    let rate = 40.0_f64;
    for xi in [0.0_f64, 0.1, 0.4] {
        let scene = low(Directions::Horizontal, (a, 0.0), lasts, 0.3)
            .with(P::TH, 500.0)
            .with(P::Psi, 1.0)
            .with(P::XiH, 0.0)
            .with(P::StopGap, gap)
            .with(P::StopStiffness, CARRIED * rate * rate)
            .with(P::StopXi, xi);
        let turned = (1.0 - xi * xi).sqrt().atan2(xi);
        let depth = velocity / rate * (-xi / (1.0 - xi * xi).sqrt() * turned).exp();
        // k x + c x' of x = v/omega_d exp(-xi omega t) sin(omega_d t): at the start 2 xi, later sin(psi + ...).
        let damped = (1.0 - xi * xi).sqrt();
        let force = |phase: f64| {
            let x = (-xi / damped * phase).exp() * phase.sin() / damped;
            let speed = (-xi / damped * phase).exp() * (phase.cos() - xi / damped * phase.sin());
            x + 2.0 * xi * speed
        };
        let most = (0..=20_000).map(|k| force(f64::from(k) * 1.0e-4)).fold(0.0, f64::max);
        // The push lasts a thousandth of a second, in which the base moves by half a millimetre; its own spring is a 1e-7th
        // of the stop's.
        for cell in both(&scene) {
            near(cell.max_u, gap + depth, 1.0e-5, "depth");
            near(cell.stop_force, CARRIED * velocity * rate * most, 1.0e-4, "force");
            // There and back through 2 d, in 0.3 s: at once, and on the other side where it is fast enough.
            let returns = if xi == 0.0 { 2 } else { 2 - u32::from(xi > 0.3) };
            assert_eq!(cell.stop_hits, returns, "{xi}: {cell:?}");
        }
    }
}

/// A hardening spring turns back a velocity where v^2 = omega_v^2 x^2 (1 + x^2/(2 v_c^2)).
#[test]
fn a_hardening_spring_stores_what_it_is_given() {
    let (lasts, a_v, t_v, v_c) = (1.0e-3, -500.0, 1.0, 0.02);
    let velocity: f64 = 0.5;
    let rate = std::f64::consts::TAU / t_v;
    let scene = low(Directions::Vertical, (0.0, a_v), lasts, 2.0)
        .with(P::TV, t_v)
        .with(P::XiV, 0.0)
        .with(P::VHardening, v_c)
        .with(P::StaticDeflection, 0.01);
    let square = (velocity / rate).powi(2);
    let ratio = 1.0 / (2.0 * v_c * v_c);
    let wanted = (((1.0 + 4.0 * ratio * square).sqrt() - 1.0) / (2.0 * ratio)).sqrt();
    for cell in both(&scene) {
        near(cell.stroke_v, wanted, 1.0e-4, "stroke");
        near(cell.max_v, wanted + 0.01, 1.0e-4, "with the deflection");
    }
}

/// The catalogue's numbers and those of the paper make the same base.
#[test]
fn a_device_is_the_base_that_its_numbers_make() {
    let base = low(Directions::Horizontal, (3.0, 0.0), 0.5, 3.0);
    let scene =
        base.clone().with(P::K1, 4.0e4).with(P::K2, 8.0e3).with(P::Qd, 640.0).check().unwrap();
    let numbers = DeviceNumbers::of(&scene).unwrap();
    let t_h = std::f64::consts::TAU * (CARRIED / 4.0e4).sqrt();
    near(numbers.t_h[0], t_h, 1.0e-12, "T_h");
    near(numbers.psi[1], 0.2, 1.0e-12, "psi");
    near(numbers.u_y[0], 0.02, 1.0e-12, "u_y");
    assert_eq!(numbers.c_h, [0.0; 2]);
    let of_paper =
        base.clone().with(P::TH, t_h).with(P::Psi, 0.2).with(P::UY, 0.02).with(P::XiH, 0.0);
    let by_yield = base.clone().with(P::YieldForce, 800.0).with(P::UY, 0.02).with(P::Psi, 0.2);
    let [ours, _] = both(&base.clone().with(P::K1, 4.0e4).with(P::K2, 8.0e3).with(P::Qd, 640.0));
    for other in [of_paper, by_yield] {
        near(ours.max_u, both(&other)[0].max_u, 1.0e-9, "max_u");
    }
    // One stiffness: a linear base, whatever force is given with it.
    let linear = base.clone().with(P::K1, 4.0e4).with(P::K2, 4.0e4).with(P::Qd, 640.0);
    let spring = base.clone().with(P::TH, t_h).with(P::Psi, 1.0).with(P::XiH, 0.0);
    near(both(&linear)[0].max_u, both(&spring)[0].max_u, 1.0e-9, "linear");
    let pendulum =
        low(Directions::Horizontal, (1.0, 0.0), 0.5, 1.0).with(P::Radius, 1.5).with(P::Mu, 0.06);
    let numbers = DeviceNumbers::of(&pendulum.check().unwrap()).unwrap();
    // Worked by hand from omega_h^2 = g/R + mu g/u_y.
    near(numbers.t_h[0], 0.1826, 3.0e-4, "T_h");
    near(numbers.psi[0], 0.005525, 1.0e-4, "psi");
}

/// What says a base twice, or not wholly, is refused by the key at fault.
#[test]
fn a_device_that_makes_no_base_is_refused() {
    let base = || low(Directions::Horizontal, (3.0, 0.0), 0.5, 3.0);
    let key = |scene: SceneBuilder| scene.check().unwrap_err().key;
    assert_eq!(key(base()), "t_h");
    assert_eq!(key(base().with(P::K1, 1.0e4)), "k2");
    assert_eq!(key(base().with(P::K1, 1.0e4).with(P::K2, 1.0e3)), "qd");
    assert_eq!(key(base().with(P::K1, 1.0e3).with(P::K2, 1.0e4).with(P::Qd, 1.0)), "k2");
    let given = || SceneBuilder { force: false, ..base() };
    // Kilonewtons in the place of newtons.
    assert_eq!(key(given().with(P::K1, 40.0).with(P::K2, 4.0).with(P::Qd, 6.0)), "k1");
    assert_eq!(key(given().with(P::K1, 4.0e4).with(P::K2, 4.0e3).with(P::Qd, 6.0e5)), "qd");
    assert_eq!(key(base().with(P::K2, 1.0e3).with(P::Qd, 1.0)), "k1");
    assert_eq!(key(base().with(P::Radius, 1.5)), "mu");
    assert_eq!(key(base().with(P::Mu, 0.1)), "radius");
    assert_eq!(key(base().with(P::Radius, 1.5).with(P::TH, 1.0)), "radius");
    assert_eq!(key(base().with(P::Radius, 1.5).with(P::Mu, 0.1).with(P::AlphaY, 0.1)), "alpha_y");
    assert_eq!(key(base().with(P::TH, 1.0).with(P::StopGap, 0.1)), "stop_stiffness");
    assert_eq!(key(base().with(P::TH, 1.0).with(P::StopXi, 0.1)), "stop_gap");
    let constant = SceneBuilder { pressure: Some(Pressure::Constant), ..base() };
    assert_eq!(key(constant.with(P::TH, 1.0)), "pressure");
    let mut massless = base();
    massless.numbers.remove(P::Mass);
    massless.numbers.remove(P::PlateH);
    massless.numbers.remove(P::PlateV);
    assert_eq!(key(massless.with(P::K1, 1.0e4).with(P::K2, 1.0e3).with(P::Qd, 1.0)), "mass");
    let locked = low(Directions::Vertical, (3.0, 0.0), 0.5, 3.0).with(P::TV, 1.0);
    assert_eq!(key(locked.with(P::Radius, 1.5).with(P::Mu, 0.1)), "radius");
}

/// A scene without a device is what it was: its plan has no law of one.
#[test]
fn a_scene_without_devices_has_none_of_their_laws() {
    let scene: Scene = crate::common::object(1, 0.2, (1.75, 0.75), 0.5, "5", "5");
    let variant = Plan::new(&scene, DEFAULT_STEP).unwrap().variant();
    assert!(!(variant.follows || variant.stops || variant.hardens));
    assert!(variant.certificate && !variant.asked.accelerations && !variant.asked.stops);
}

/// A slender block that rocks on a pendulum, the vertical direction locked: its rotation presses on the pendulum, too. Nothing
/// is proved of a base that is not passive: the cell runs to its end.
#[test]
fn a_rocking_block_presses_on_its_pendulum() {
    let scene = SceneBuilder::object(1)
        .isolated(Directions::Horizontal)
        .with(P::Radius, 1.0)
        .with(P::Mu, 0.3)
        .with(P::UY, 0.002)
        .with(P::Omega, 5.0)
        .with(P::AH, 2.3)
        .with(P::AV, 2.0)
        .with(P::TMax, 10.0)
        .check()
        .unwrap();
    let grid = Grid::of(&scene);
    let plan = Plan::new(&scene, DEFAULT_STEP).unwrap().at(Precision::F64);
    let cell = cpu::sweep(Precision::F64, &plan, &grid, &all(&grid), &Unwatched)[0];
    let truth = reference::run(&scene, &grid.case(0), &Settings::default());
    assert_eq!((cell.class, truth.class), (Class::Rocking, Class::Rocking), "{cell:?}");
    assert!(!plan.variant().certificate);
    assert_eq!(cell.status, Status::Ok, "{cell:?}");
    near(cell.max_u, truth.max_u, 1.0e-5, "max_u");
    near(cell.zeta, truth.zeta, 1.0e-4, "zeta");
    near(cell.min_contact, truth.min_contact, 1.0e-3, "min_contact");
}

/// A base that swings from stop to stop after the excitation is not final, though its block can never lift.
#[test]
fn hits_to_come_are_counted() {
    let scene = low(Directions::Horizontal, (-500.0, 0.0), 1.0e-3, 60.0)
        .with(P::TH, 1.0)
        .with(P::Psi, 1.0)
        .with(P::XiH, 0.02)
        .with(P::StopGap, 0.03)
        .with(P::StopStiffness, CARRIED * 400.0)
        .check()
        .unwrap();
    let grid = Grid::of(&scene);
    let asked =
        Asked { angles: false, displacements: false, forces: false, stops: true, ..Asked::ALL };
    let plan = Plan::new(&scene, DEFAULT_STEP).unwrap().at(Precision::F64).asking(asked);
    let cell = cpu::sweep(Precision::F64, &plan, &grid, &all(&grid), &Unwatched)[0];
    let truth = reference::run(&scene, &grid.case(0), &Settings::default());
    assert!(truth.stop_hits > 3, "{truth:?}");
    assert_eq!(cell.stop_hits, truth.stop_hits);
    near(cell.stop_force, truth.stop_force, 1.0e-6, "force");
    // Once the stop is out of reach the cell ends.
    assert_eq!(cell.status, Status::Proved, "{cell:?}");
}

/// The damper of an end stop pushes while the base moves towards it: beyond the gap, a base that moves back fast enough is not
/// pushed, and an impact of the block, which changes u', can begin a push. The count is that of the reference in all cells in which
/// the reference's does not depend on its tolerance, on its rest speed, or on a ten-millionth of the block's width.
#[test]
fn a_push_that_an_impact_begins_is_counted() {
    let (mut compared, mut of_impacts) = (0, 0);
    for (plate, rate) in [(50.0, 40.0_f64), (5.0, 25.0)] {
        let scene = SceneBuilder { force: true, ..SceneBuilder::default() }
            .isolated(Directions::Horizontal)
            .with(P::HalfWidth, 0.4)
            .with(P::Height, 1.0)
            .with(P::Mass, BLOCK)
            .with(P::PlateH, plate)
            .with(P::TH, 2.0)
            .with(P::Psi, 1.0)
            .with(P::XiH, 0.05)
            .with(P::StopGap, Range::even(0.01, 0.1, 6))
            .with(P::StopStiffness, (BLOCK + plate) * rate * rate)
            .with(P::StopXi, Range::even(0.1, 0.9, 3))
            .with(P::Scale, Range::even(0.6, 2.0, 4))
            .check_under(Excitation::Record(synthetic_pair()))
            .unwrap();
        let grid = Grid::of(&scene);
        let asked = Asked { stops: true, ..Asked::ALL };
        let plan = Plan::new(&scene, DEFAULT_STEP).unwrap().at(Precision::F64).asking(asked);
        let mut ways =
            vec![("cpu", cpu::sweep(Precision::F64, &plan, &grid, &all(&grid), &Unwatched))];
        if let Some(gpu) = gpu("stop hits", Precision::F64) {
            let sweeper = Sweeper::new(&gpu, Precision::F64, plan.variant()).unwrap();
            let swept = sweeper.sweep::<f64>(&plan, &grid, &all(&grid), &Unwatched).unwrap();
            ways.push(("shader", swept.block.to_outcomes()));
        }
        let wanted = |index: usize| {
            let case = grid.case(index);
            let hits = |case: &Case, settings| {
                let cell = reference::run(&scene, case, &settings);
                (cell.class, cell.stop_hits)
            };
            let one = hits(&case, Settings::default());
            let mut wider = case;
            wider.block.half_width *= 1.0 + 1.0e-7;
            let (tolerance, rest_speed) = (1.0e-12, 1.0e-3);
            let other = Settings { tolerance, rest_speed, ..Settings::default() };
            let same = one == hits(&case, other) && one == hits(&wider, Settings::default());
            same.then(|| (one, begun_by_impacts(&scene, &case)))
        };
        let wanted: Vec<_> = (0..grid.len()).into_par_iter().map(wanted).collect();
        for (index, wanted) in wanted.into_iter().enumerate() {
            let Some((wanted, begun)) = wanted.filter(|(of, _)| of.0 == Class::Rocking) else {
                continue;
            };
            for (way, cells) in &ways {
                let cell = &cells[index];
                let what = format!("{way}, {plate}, cell {index}: {begun} by impacts");
                assert_eq!((cell.class, cell.stop_hits), wanted, "{what}");
            }
            compared += 1;
            of_impacts += u32::from(begun > 0);
        }
    }
    say(&format!(
        "stop hits: {compared} cells compared, {of_impacts} with pushes that impacts begin"
    ));
    assert!(compared >= 20 && of_impacts >= 5, "{compared} {of_impacts}");
}

/// The pushes that begin at impacts, by the reference.
fn begun_by_impacts(scene: &Scene, case: &Case) -> u32 {
    let stop = case.isolation.stop.unwrap();
    let pushed = |y: &State| {
        let (side, depth) = (y[U].signum(), y[U].abs() - stop.gap);
        depth > 0.0 && stop.stiffness * depth + stop.damping * side * y[DU] > 0.0
    };
    let (mut begun, mut before) = (0, false);
    reference::observe(scene, case, &Settings::default(), &mut |instant| {
        let now = pushed(instant.y);
        // What is seen last before an impact is the end of the step before; a push that begins in the step cuts it.
        begun += u32::from(matches!(instant.switch, Some(Switch::Impact(_))) && now && !before);
        before = now;
    });
    begun
}

/// The ground falls faster than the block: nothing presses on the pendulum, and its force is zero. The moments of both corners then
/// pass zero at the same instant, and the larger one, that of the longer arm, decides; for equal arms the left one. Rounding does
/// not. Such a cell loses its contact, and is marked.
#[test]
fn a_block_in_free_fall_lifts_about_its_longer_arm() {
    for (isolation, a_v) in [(Directions::Dual, -12.0), (Directions::Horizontal, -12.0)] {
        for (eccentricity, class) in [
            (0.3, Class::OverturnedLeft),
            (-0.3, Class::OverturnedRight),
            (0.0, Class::OverturnedLeft),
        ] {
            let mut scene = SceneBuilder { force: true, ..SceneBuilder::default() }
                .isolated(isolation)
                .pulse(Shape::Rectangle)
                .with(P::HalfWidth, 0.3)
                .with(P::Height, 1.0)
                .with(P::Eccentricity, eccentricity)
                .with(P::Mass, 500.0)
                .with(P::PlateH, 20.0)
                .with(P::PlateV, 20.0)
                .with(P::Radius, 1.5)
                .with(P::Mu, 0.06)
                .with(P::Omega, 4.0)
                .with(P::AH, Range::even(0.1, 2.0, 16))
                .with(P::AV, a_v)
                .with(P::TMax, 3.0);
            if isolation == Directions::Dual {
                scene = scene.with(P::TV, 0.5);
            }
            let scene = scene.check().unwrap();
            let (plan, grid) = (Plan::new(&scene, DEFAULT_STEP).unwrap(), Grid::of(&scene));
            for precision in [Precision::F32, Precision::F64] {
                let plan = plan.at(precision);
                let cells = cpu::sweep(precision, &plan, &grid, &all(&grid), &Unwatched);
                for cell in cells {
                    assert_eq!(
                        cell.class, class,
                        "{isolation:?}, {eccentricity}, {precision:?}: {cell:?}"
                    );
                    assert!(cell.loses_contact());
                }
            }
            let truth = reference::run(&scene, &grid.case(3), &Settings::default());
            assert_eq!(truth.class, class, "{isolation:?}, {eccentricity}: {truth:?}");
            assert!(truth.loses_contact());
        }
    }
}

/// The ground falls as fast as the block: no moment lifts it, and no contact force is left. The cell is marked.
#[test]
fn a_block_without_weight_stays_and_is_marked() {
    let scene = low(Directions::Horizontal, (1.0, -GRAVITY), 0.3, 1.0)
        .with(P::Radius, 1.5)
        .with(P::Mu, 0.06);
    for cell in both(&scene) {
        assert_eq!(cell.min_contact, 0.0);
        assert!(cell.loses_contact());
    }
}
