//! Checks from outside: closed forms and published figures that no part of topple was made from.

use approx::assert_abs_diff_eq;
use topple::backend::cpu;
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::scene::{GRAVITY, Grid, Parameter, Scene};
use topple::stepping::outcome::Outcome;
use topple::work::observer::Unwatched;

use crate::common::{judge, object, say, scene, shaken};

/// p of the block of Zhang & Makris (2001), rad/s.
const P: f64 = 2.14;

/// A uniform rectangle of slenderness `alpha` with p = sqrt(3 g/(4 R)), on the ground.
fn slender(alpha: f64, rest: &str) -> Scene {
    let radius = 3.0 * GRAVITY / (4.0 * P * P);
    scene(&format!(
        "[block]\nhalf_width = {}\nheight = {}\n[base]\nisolation = \"none\"\n{rest}",
        radius * alpha.sin(),
        radius * alpha.cos()
    ))
}

/// One-sine pulses of omega_p/p = `w` and a_p/(alpha g) = `a`.
fn pulse(alpha: f64, w: f64, a: f64) -> Scene {
    slender(
        alpha,
        &format!(
            "[pulse]\nomega = {}\na_h = {}\n[run]\nrestitution = 0.9\noverturn = \"quarter-turn\"\nt_max = 25.0\n",
            w * P,
            a * alpha * GRAVITY
        ),
    )
}

fn swept(scene: &Scene) -> Outcome {
    let plan = Plan::new(scene, DEFAULT_STEP).unwrap();
    cpu::sweep(Precision::F64, &plan, &Grid::of(scene), &[0], &Unwatched)[0]
}

/// Impacts before overturning; none for a block that stands.
fn overturns(cell: &Outcome) -> Option<u32> {
    cell.class.overturned().then_some(cell.impacts)
}

/// Where `holds` changes from one end to the other.
fn threshold(mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let at_low = holds(low);
    assert_ne!(at_low, holds(high), "no change from {low} to {high}");
    while high - low > 1e-7 {
        let middle = 0.5 * (low + high);
        if holds(middle) == at_low { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// West's formula: a block on the ground lifts where the acceleration exceeds g b/H, b the lever
/// arm of the corner that it would turn about.
#[test]
fn wests_formula_for_uplift() {
    for e in [0.0, 0.3, -0.3] {
        for sign in [1.0, -1.0] {
            // An acceleration to the right (positive) turns the block about its left corner.
            let arm = 0.2 * (1.0 + sign * e);
            let lifts = |margin: f64| {
                let peak = sign * GRAVITY * arm / 1.0 * (1.0 + margin);
                let scene = scene(&format!(
                    "[block]\nhalf_width = 0.2\nheight = 1.0\neccentricity = {e}\n[base]\nisolation = \"none\"\n\
                     [pulse]\nomega = 5.0\na_h = 0.0\n"
                ));
                // Half a sine: no acceleration of the other sign.
                let samples: Vec<f64> = (0..=100)
                    .map(|k| peak * f64::sin(std::f64::consts::PI * f64::from(k) / 100.0))
                    .collect();
                let scene = shaken(scene, 0.01, samples);
                (swept(&scene).uplifts > 0, judge(&scene).uplifts > 0)
            };
            assert_eq!(lifts(1e-6), (true, true), "e = {e}, {sign}");
            assert_eq!(lifts(-1e-6), (false, false), "e = {e}, {sign}");
        }
    }
}

/// Zhang & Makris: alpha = 0.25, eta = 0.9, omega_p/p = 5. Overturning after one impact from A =
/// 3.0323, none from 6.743, without an impact from 7.493 (two independent integrations).
#[test]
fn the_safe_gap_of_the_free_standing_block() {
    let cell = |a: f64| pulse(0.25, 5.0, a);
    for (name, run) in
        [("sweep", swept as fn(&Scene) -> Outcome), ("reference", judge as fn(&Scene) -> Outcome)]
    {
        let first = threshold(2.9, 3.2, |a| overturns(&run(&cell(a))) == Some(1));
        let safe = threshold(6.6, 6.9, |a| overturns(&run(&cell(a))).is_some());
        let direct = threshold(7.3, 7.7, |a| overturns(&run(&cell(a))) == Some(0));
        say(&format!("the_safe_gap, {name}: {first:.4}, {safe:.4}, {direct:.4}"));
        assert_abs_diff_eq!(first, 3.0323, epsilon = 6e-5);
        assert_abs_diff_eq!(safe, 6.743, epsilon = 6e-4);
        assert_abs_diff_eq!(direct, 7.493, epsilon = 6e-4);
    }
    // By the paper's convention, falling at the critical angle, there is no such gap.
    let mut early = cell(7.1);
    early.overturn = topple::scene::Overturn::CriticalAngle;
    assert!(swept(&early).class.overturned() && !swept(&cell(7.1)).class.overturned());
}

/// The same of the linear equation, which a block of alpha = 0.001 obeys to 1e-6.
#[test]
fn the_safe_gap_of_the_linear_equation() {
    let cell = |a: f64| pulse(0.001, 5.0, a);
    let first = threshold(2.9, 3.2, |a| overturns(&swept(&cell(a))) == Some(1));
    let safe = threshold(6.2, 6.5, |a| overturns(&swept(&cell(a))).is_some());
    let direct = threshold(7.0, 7.4, |a| overturns(&swept(&cell(a))) == Some(0));
    say(&format!("the_safe_gap_of_the_linear_equation: {first:.4}, {safe:.4}, {direct:.5}"));
    assert_abs_diff_eq!(first, 3.019, epsilon = 6e-4);
    assert_abs_diff_eq!(safe, 6.318, epsilon = 6e-4);
    assert_abs_diff_eq!(direct, 7.16813, epsilon = 3e-5);
}

/// Overturning without an impact, in closed form: W sin psi - cos psi = -exp(-(2 pi - psi)/W),
/// sin psi = 1/A.
#[test]
fn direct_overturning_in_closed_form() {
    for (w, listed) in
        [(2.0, 2.34990), (3.0, 3.63115), (5.0, 7.16813), (8.0, 14.87135), (10.0, 21.59999)]
    {
        let closed = threshold(listed * 0.9, listed * 1.1, |a| {
            let psi = f64::asin(1.0 / a);
            w * psi.sin() - psi.cos() > -f64::exp(-(std::f64::consts::TAU - psi) / w)
        });
        assert_abs_diff_eq!(closed, listed, epsilon = 6e-6);
        let found = threshold(0.97 * listed, 1.03 * listed, |a| {
            overturns(&swept(&pulse(0.001, w, a))) == Some(0)
        });
        say(&format!("direct_overturning_in_closed_form: W = {w}: {found:.5} ({closed:.5})"));
        // alpha^2 and the step.
        assert_abs_diff_eq!(found, closed, epsilon = 1e-5 * closed);
    }
}

/// A rectangular pulse overturns from A = 1/(1 - exp(-p t_d)). A record's last gap falls linearly to
/// zero; the linear equation weighs a pulse by p exp(-p t), so that the gap counts by its integral.
#[test]
fn a_rectangular_pulse_in_closed_form() {
    let alpha = 0.001;
    for t_d in [0.2, 0.5, 1.0] {
        let (dt, count) = (t_d / 200.0, 200);
        // int of exp(-p t) (1 - (t - t_d)/dt) p dt from t_d to t_d + dt.
        let x = P * dt;
        let gap = f64::exp(-P * t_d) * (1.0 - (1.0 - f64::exp(-x)) / x);
        let closed = 1.0 / (1.0 - f64::exp(-P * t_d) + gap);
        let plain = 1.0 / (1.0 - f64::exp(-P * t_d));
        let cell = |a: f64| {
            let mut samples = vec![a * alpha * GRAVITY; count + 1];
            samples.push(0.0);
            let mut scene = slender(
                alpha,
                "[pulse]\nomega = 5.0\na_h = 0.0\n[run]\noverturn = \"quarter-turn\"\n",
            );
            scene = shaken(scene, dt, samples);
            scene.set(Parameter::TMax, 20.0);
            swept(&scene)
        };
        let found = threshold(0.97 * closed, 1.03 * closed, |a| overturns(&cell(a)) == Some(0));
        say(&format!(
            "a_rectangular_pulse: t_d = {t_d} s: {found:.6} ({closed:.6}; without the gap {plain:.4})"
        ));
        assert_abs_diff_eq!(found, closed, epsilon = 1e-5 * closed);
    }
}

/// A symmetric block on a horizontally isolated plate of gamma times its mass: eta = 1 - 2 sin^2
/// alpha/[4/3 - cos^2 alpha/(1 + gamma)].
#[test]
fn restitution_on_an_isolated_plate() {
    let alpha = 0.25_f64;
    for (gamma, listed) in [(0.5, 0.82697), (1.0, 0.85830), (4.0, 0.89314)] {
        let scene = scene(&format!(
            "[block]\nhalf_width = {}\nheight = {}\nmass = 100.0\nplate_h = {}\n\
             [base]\nisolation = \"horizontal\"\nt_h = 2.0\n[pulse]\nomega = 5.0\na_h = 1.0\n",
            alpha.sin(),
            alpha.cos(),
            100.0 * gamma
        ));
        let eta = Plan::new(&scene, DEFAULT_STEP).unwrap().model::<f64>(&scene.case()).left.eta_phi;
        let closed =
            1.0 - 2.0 * alpha.sin().powi(2) / (4.0 / 3.0 - alpha.cos().powi(2) / (1.0 + gamma));
        assert_abs_diff_eq!(eta, closed, epsilon = 1e-14);
        assert_abs_diff_eq!(eta, listed, epsilon = 6e-6);
    }
}

/// The paper's contrast: without isolation the least amplitude that overturns rises with the
/// frequency; with dual isolation it has a minimum inside the range.
#[test]
fn isolation_makes_a_frequency_dangerous() {
    let least = |isolated: bool| -> Vec<f64> {
        let text = |omega: f64| {
            if isolated {
                object(1, 0.2, (1.75, 0.75), 0.0, &omega.to_string(), "0.05:15:300")
            } else {
                scene(&format!(
                    "[block]\nobject = 1\neccentricity = 0.2\n[base]\nisolation = \"none\"\n\
                     [pulse]\nomega = {omega}\na_h = \"0.05:15:300\"\n"
                ))
            }
        };
        (0..12)
            .map(|k| {
                let scene = text(0.8 + 0.6 * f64::from(k));
                let grid = Grid::of(&scene);
                let plan = Plan::new(&scene, DEFAULT_STEP).unwrap();
                let cells = cpu::sweep(
                    Precision::F64,
                    &plan,
                    &grid,
                    &crate::common::all(&grid),
                    &Unwatched,
                );
                let first = cells.iter().position(|cell| cell.class.overturned());
                first.map_or(f64::INFINITY, |index| grid.case(index).shaking.peak_h())
            })
            .collect()
    };
    let (bare, dual) = (least(false), least(true));
    say(&format!("isolation_makes_a_frequency_dangerous: without {bare:.2?}"));
    say(&format!("  dual {dual:.2?}"));
    assert!(bare.windows(2).all(|pair| pair[1] >= pair[0]), "{bare:?}");
    let lowest = (0..dual.len()).min_by(|a, b| dual[*a].total_cmp(&dual[*b])).unwrap();
    assert!(lowest > 0 && lowest + 1 < dual.len(), "{dual:?}");
    assert!(dual[0] > 1.1 * dual[lowest] && dual[dual.len() - 1] > 1.1 * dual[lowest]);
}

/// A block of Zhang & Makris (2001) under a pulse of omega_p/p = 3 and a_p/(alpha g) = `a`.
fn shaped(alpha: f64, shape: &str, w: f64, a: f64) -> Scene {
    slender(
        alpha,
        &format!(
            "[pulse]\nshape = \"{shape}\"\nomega = {}\na_h = {}\n[run]\nrestitution = 0.9\n\
             overturn = \"quarter-turn\"\nt_max = 25.0\n",
            w * P,
            a * alpha * GRAVITY
        ),
    )
}

/// alpha = 0.25, eta = 0.9, omega_p/p = 3, by SciPy's DOP853 (tests/data/free_standing.py): where the block
/// first overturns, where it stands again, and where it overturns once more, with the impacts before.
#[test]
fn one_cosine_and_ricker_overturn_where_scipy_says() {
    for (shape, listed) in [
        ("one-cosine", [(1.90758, Some(1)), (6.54194, None), (11.18847, Some(0))]),
        ("ricker", [(2.76528, Some(1)), (13.21479, None), (14.31217, Some(2))]),
        ("ricker-antisymmetric", [(1.75765, Some(1)), (2.67753, None), (4.04140, Some(3))]),
    ] {
        for (name, run) in [
            ("sweep", swept as fn(&Scene) -> Outcome),
            ("reference", judge as fn(&Scene) -> Outcome),
        ] {
            for (at, then) in listed {
                let found = threshold(at - 0.02, at + 0.02, |a| {
                    overturns(&run(&shaped(0.25, shape, 3.0, a))) == then
                });
                say(&format!("{shape}, {name}: {then:?} from {found:.5} ({at})"));
                // The figures' last digit, and the sweep's step.
                assert_abs_diff_eq!(found, at, epsilon = 2e-5 * at);
            }
        }
    }
}

/// Overturning without an impact under a one-cosine pulse, of the linear equation: the growing part of the
/// motion is not positive at the pulse's end below A = (1 + W^2)/(1 - exp(-2 pi/W)).
#[test]
fn a_one_cosine_pulse_in_closed_form() {
    for w in [2.0, 3.0, 5.0] {
        let closed = (1.0 + w * w) / (1.0 - f64::exp(-std::f64::consts::TAU / w));
        let found = threshold(0.98 * closed, 1.02 * closed, |a| {
            overturns(&swept(&shaped(0.001, "one-cosine", w, a))) == Some(0)
        });
        say(&format!("a_one_cosine_pulse_in_closed_form: W = {w}: {found:.5} ({closed:.5})"));
        // alpha^2 and the step.
        assert_abs_diff_eq!(found, closed, epsilon = 1e-5 * closed);
    }
}

/// A rectangular pulse with its jumps: A = 1/(1 - exp(-p t_d)), t_d = pi/omega.
#[test]
fn a_rectangular_pulse_with_jumps_in_closed_form() {
    for w in [1.0, 3.0, 8.0] {
        let closed = 1.0 / (1.0 - f64::exp(-std::f64::consts::PI / w));
        for (name, run) in [
            ("sweep", swept as fn(&Scene) -> Outcome),
            ("reference", judge as fn(&Scene) -> Outcome),
        ] {
            let found = threshold(0.98 * closed, 1.02 * closed, |a| {
                overturns(&run(&shaped(0.001, "rectangle", w, a))) == Some(0)
            });
            say(&format!("a rectangle, {name}: W = {w}: {found:.6} ({closed:.6})"));
            assert_abs_diff_eq!(found, closed, epsilon = 1e-5 * closed);
        }
    }
}
