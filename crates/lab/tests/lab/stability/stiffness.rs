//! RK4's limit of stability.

use std::f64::consts::TAU;

use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::scene::{Grid, Parameter, Scene};
use topple::stepping::outcome::Class;

use crate::common::{object, say, scene};

use super::{exactly, limit, swept, truth};

/// |R(z)| of RK4 at z = h lambda.
fn amplification(re: f64, im: f64) -> f64 {
    // 1 + z (1 + z/2 (1 + z/3 (1 + z/4)))
    let (mut a, mut b) = (1.0, 0.0);
    for k in [4.0, 3.0, 2.0, 1.0] {
        (a, b) = (1.0 + (re * a - im * b) / k, (re * b + im * a) / k);
    }
    f64::hypot(a, b)
}

/// A block in full contact on a stiff vertical isolation: v alone moves.
fn oscillator(t_v: f64, xi: f64, omega: f64, t_max: f64) -> Scene {
    scene(&format!(
        "[block]\nobject = 1\n[base]\nisolation = \"vertical\"\nt_v = {t_v}\nxi_v = {xi}\n\
         [pulse]\nomega = {omega}\na_h = 0.0\na_v = 0.5\n[run]\nt_max = {t_max}\n"
    ))
}

/// The vertical oscillator in full contact breaks at omega h = 2.83 undamped and 2.95 at xi = 0.1,
/// the roots of |R(h lambda)| = 1; a sweep's own step stays far below.
#[test]
fn rk4_on_the_vertical_oscillator() {
    for xi in [0.0, 0.1] {
        let expected =
            limit(2.0, 4.0, 1e-9, |x| amplification(-xi * x, x * f64::sqrt(1.0 - xi * xi)) <= 1.0);
        let omega_v = TAU / 0.02;
        // The pulse takes 64 whole steps, so that every step is as long as asked.
        let run = |x: f64| {
            let h = x / omega_v;
            let scene = oscillator(0.02, xi, TAU / (64.0 * h), 4064.0 * h);
            exactly::<f64>(&scene, h * (1.0 + 1e-9))
        };
        // Four thousand steps of growth by (1 + x) show an x of 1e-3.
        let found = limit(2.0, 4.0, 1e-4, |x| {
            let cell = run(x);
            cell.class == Class::FullContact && cell.max_v < 1.0
        });
        say(&format!(
            "rk4_on_the_vertical_oscillator: xi = {xi}: omega h = {found:.3} ({expected:.3})"
        ));
        assert!((found - expected).abs() < 4e-3, "xi = {xi}: {found} {expected}");
        // Past it the base leaps, and throws the block over: a blown-up cell looks like an
        // overturned one.
        assert_ne!(run(1.05 * expected).class, Class::FullContact);
        // The sweep's own step.
        let scene = oscillator(0.02, xi, 5.0, 4.0);
        let clock = Plan::new(&scene, DEFAULT_STEP).unwrap().clock(&Grid::of(&scene).case(0));
        assert!(omega_v * clock.step_free < 0.1 * expected);
        let (cell, right) = (swept::<f64>(&scene), truth(&scene));
        assert_eq!(cell.class, Class::FullContact);
        assert!((cell.max_v - right.max_v).abs() < 1e-6 * right.max_v);
    }
}

/// While the block rocks, its base is stiffer: a part of it no longer moves along. The limit lies
/// below 2.83 of the base alone, and at or above the bound by which a sweep chooses its step.
#[test]
fn the_coupled_limit_while_rocking() {
    // A squat block on a plate of a hundredth of its mass, let go at a tilt: it rocks for long.
    let scene = |h: f64| {
        scene(&format!(
            "[block]\nhalf_width = 0.5\nheight = 0.5\nmass = 1000.0\nplate_h = 10.0\nplate_v = 10.0\n\
             [base]\nisolation = \"vertical\"\nt_v = 0.02\nxi_v = 0.0\n\
             [pulse]\nomega = {}\na_h = 0.0\n[run]\nt_max = 0.2\ntilt = 0.3\n",
            TAU / (16.0 * h)
        ))
    };
    let omega_v = TAU / 0.02;
    let right = truth(&scene(0.001));
    let found = limit(0.2, 2.9, 1e-3, |x| {
        let h = x / omega_v;
        let cell = exactly::<f64>(&scene(h), h * (1.0 + 1e-9));
        cell.class == right.class && cell.max_v < 1.2 * right.max_v
    });
    let plan = Plan::new(&scene(0.001), 1.0).unwrap();
    let step = plan.clock(&Grid::of(&plan.scene).case(0)).step_free;
    say(&format!(
        "the_coupled_limit_while_rocking: omega_v h = {found:.2}; a sweep takes {:.3}",
        omega_v * step
    ));
    assert!(found < 2.8, "{found}: as if the block were not there");
    assert!(omega_v * step < 0.5 * found);
    let cell = swept::<f64>(&scene(0.001));
    assert_eq!((cell.class, cell.impacts), (right.class, right.impacts));
    assert!((cell.max_v - right.max_v).abs() < 1e-4 * right.max_v);
}

/// T_v from 1 s to 1e-4 s: a step fit for the slow end breaks at the stiff one, and what it then
/// paints is no outcome of the block; the sweep's step follows the period.
#[test]
fn periods_from_a_second_to_a_tenth_of_a_millisecond() {
    let fixed = 1.0 / 256.0;
    let mut wrong = Vec::new();
    let mut right_to = f64::INFINITY;
    for t_v in [1.0, 0.3, 0.1, 0.03, 0.01, 3.0e-3, 1.0e-3, 3.0e-4, 1.0e-4] {
        let mut scene = object(1, 0.2, (1.75, t_v), 0.5, "5", "3");
        scene.set(Parameter::TMax, 1.0);
        let (cell, right) = (swept::<f64>(&scene), truth(&scene));
        assert_eq!((cell.class, cell.impacts), (right.class, right.impacts), "T_v = {t_v}");
        let raw = exactly::<f64>(&scene, fixed);
        if raw.class == right.class {
            right_to = right_to.min(t_v);
        } else {
            wrong.push((t_v, raw.class.name()));
        }
    }
    say(&format!(
        "periods_from_a_second: a step of 1/256 s is right down to T_v = {right_to} s, then {wrong:?}"
    ));
    // omega h = 2.83 is T_v = 8.7 ms.
    assert_eq!(wrong.first().map(|w| w.0), Some(3.0e-3));
    assert_eq!(right_to, 0.01);
}
