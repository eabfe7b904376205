//! The pulses: each wave against its formula's peak, length and spectrum, on both sides, and what a jump
//! of the ground does.

use std::f64::consts::{PI, TAU};

use bytemuck::Zeroable;
use topple::Written;
use topple::backend::cpu;
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::model::excitation::Cell;
use topple::model::precision::Precision;
use topple::model::pulse::{Modulation, Shape, wave};
use topple::model::real::Real;
use topple::scene::{GRAVITY, Grid, Scene};
use topple::stepping::outcome::Outcome;
use topple::work::observer::Unwatched;

use crate::common::{judge, say, scene};

/// A pulse, its numbers, and its length in periods by its authors.
#[derive(Debug, Clone, Copy)]
struct Sample {
    shape: Shape,
    cycles: f64,
    gamma: f64,
    nu: f64,
    periods: f64,
}

fn samples() -> Vec<Sample> {
    let plain = |shape, periods| Sample { shape, cycles: 1.0, gamma: 1.0, nu: 0.0, periods };
    let cycled = |shape, cycles| Sample { cycles, ..plain(shape, cycles) };
    let modulated = |gamma, nu| Sample { gamma, nu, ..plain(Shape::MavroeidisPapageorgiou, gamma) };
    vec![
        cycled(Shape::OneSine, 1.0),
        cycled(Shape::OneSine, 3.0),
        cycled(Shape::OneSine, 1.5),
        cycled(Shape::OneCosine, 1.0),
        cycled(Shape::OneCosine, 2.0),
        cycled(Shape::OneCosine, 1.25),
        plain(Shape::HalfSine, 0.5),
        plain(Shape::Rectangle, 0.5),
        plain(Shape::Ricker, 3.0),
        plain(Shape::RickerAntisymmetric, 4.0),
        modulated(1.0, 0.0),
        modulated(1.3, 0.4),
        modulated(2.0, PI / 2.0),
        modulated(3.7, -2.0),
        modulated(12.0, 5.0),
    ]
}

impl Sample {
    /// The wave as a number type makes it, by the periods that have passed.
    fn wave<R: Real>(&self) -> impl Fn(f64) -> f64 {
        let mut cell = Cell::<R>::zeroed();
        let mut scale = 1.0;
        if self.shape.is_modulated() {
            let modulation = Modulation::of(self.gamma, self.nu);
            cell.drive.envelope = R::of(modulation.envelope);
            cell.drive.carrier = R::of(modulation.carrier);
            scale = self.shape.peak(self.gamma, self.nu);
        }
        let kind = (self.shape, self.cycles > 1.0);
        move |phase| wave(kind, &cell, R::of(phase)).to_f64() / scale
    }

    /// |F| at a frequency in cycles a period, by the formula's own integral.
    fn spectrum(&self, f: f64) -> f64 {
        let d = self.periods;
        // The integral of exp(2 pi i k x) from a to a + d, as real and imaginary part.
        let integral = |k: f64, a: f64| -> [f64; 2] {
            if k.abs() < 1e-12 {
                return [d, 0.0];
            }
            let at = |x: f64| [(TAU * k * x).sin() / (TAU * k), -(TAU * k * x).cos() / (TAU * k)];
            let (start, end) = (at(a), at(a + d));
            [end[0] - start[0], end[1] - start[1]]
        };
        // That of cos(2 pi k x + nu) exp(-2 pi i f x).
        let cosine = |k: f64, nu: f64, a: f64| -> [f64; 2] {
            let (up, down) = (integral(k - f, a), integral(-k - f, a));
            let (c, s) = (nu.cos() / 2.0, nu.sin() / 2.0);
            [
                c * (up[0] + down[0]) - s * (up[1] - down[1]),
                c * (up[1] + down[1]) + s * (up[0] - down[0]),
            ]
        };
        let size = |[re, im]: [f64; 2]| f64::hypot(re, im);
        match self.shape {
            Shape::OneSine | Shape::HalfSine => size(cosine(1.0, -PI / 2.0, 0.0)),
            Shape::OneCosine => size(cosine(1.0, 0.0, 0.0)),
            Shape::Rectangle => size(integral(-f, 0.0)),
            // Of derivatives of a Gauss function.
            Shape::Ricker => 2.0 * f * f * (-f * f).exp() / PI.sqrt(),
            Shape::RickerAntisymmetric => {
                let top = (3.0 - 6.0_f64.sqrt()).sqrt();
                let beta = top * (3.0 - top * top) * (-0.5 * top * top).exp();
                let width = TAU.sqrt() * 3.0_f64.sqrt() / TAU;
                27.0_f64.sqrt() * f.powi(3) * width * (-1.5 * f * f).exp() / beta
            }
            Shape::MavroeidisPapageorgiou => {
                // 2 pi f times that of the velocity, which is zero at both ends.
                let slow = 1.0 / self.gamma;
                let a = -0.5 * d;
                let parts = [
                    (1.0, cosine(1.0, self.nu, a)),
                    (0.5, cosine(1.0 + slow, self.nu, a)),
                    (0.5, cosine(1.0 - slow, self.nu, a)),
                ];
                let sum = parts.iter().fold([0.0, 0.0], |sum, (share, part)| {
                    [sum[0] + share * part[0], sum[1] + share * part[1]]
                });
                TAU * f * size(sum) / self.steepest()
            }
        }
    }

    /// The largest rate of [1 + cos(2 pi x/gamma)] cos(2 pi x + nu), by differences.
    fn steepest(&self) -> f64 {
        let velocity = |x: f64| (1.0 + (TAU * x / self.gamma).cos()) * (TAU * x + self.nu).cos();
        let count = (self.gamma * 20_000.0) as u32;
        let (apart, h) = (self.gamma / f64::from(count), 1e-5);
        (0..=count)
            .map(|k| f64::from(k) * apart - 0.5 * self.gamma)
            .map(|x| ((velocity(x + h) - velocity(x - h)) / (2.0 * h)).abs())
            .fold(0.0, f64::max)
    }
}

/// Simpson's rule over the wave times cosine and sine; the wave's ends are taken from inside.
fn measured<R: Real>(sample: &Sample, f: f64) -> f64 {
    let count = 2 * (sample.periods * 1000.0).ceil() as u32;
    let apart = sample.periods / f64::from(count);
    let (mut re, mut im) = (0.0, 0.0);
    let wave = sample.wave::<R>();
    for k in 0..=count {
        let weight = match k {
            0 => 1.0,
            _ if k == count => 1.0,
            _ if k % 2 == 1 => 4.0,
            _ => 2.0,
        };
        let x = f64::from(k) * apart;
        let value = weight * apart / 3.0 * wave(x);
        re += value * (TAU * f * x).cos();
        im -= value * (TAU * f * x).sin();
    }
    f64::hypot(re, im)
}

#[test]
fn each_wave_has_the_peak_and_the_spectrum_of_its_formula() {
    for sample in samples() {
        let count = (sample.periods * 5000.0).ceil();
        let wave = sample.wave::<f64>();
        let peak = (0..=count as u32)
            .map(|k| wave(f64::from(k) / count * sample.periods).abs())
            .fold(0.0, f64::max);
        // A sample within 1e-4 of a period of the crest misses (2 pi 1e-4)^2/2 of it, three times as
        // much where a wavelet bends more.
        assert!((peak - 1.0).abs() < 1e-6, "{sample:?}: peak {peak}");
        for f in [0.0, 0.3, 0.7, 1.0, 1.4, 2.6] {
            let formula = sample.spectrum(f);
            // Simpson's error is of the fourth order: a thousandth of a period to it is 1e-9 of the
            // length at most. In f32 the phase is rounded to 2^-24 of itself, and the wave with it.
            for (name, value, allowed) in [
                ("f64", measured::<f64>(&sample, f), 1e-8),
                ("f32", measured::<f32>(&sample, f), 6e-7 * sample.periods),
            ] {
                let off = (value - formula).abs();
                assert!(
                    off < allowed * sample.periods.max(1.0),
                    "{sample:?} {name} at {f}: {value} for {formula}"
                );
            }
        }
    }
}

#[test]
fn the_wavelets_are_strongest_at_omega() {
    for sample in samples() {
        if matches!(sample.shape, Shape::Ricker | Shape::RickerAntisymmetric) {
            let at = measured::<f64>(&sample, 1.0);
            for f in [0.9, 0.97, 1.03, 1.1] {
                assert!(measured::<f64>(&sample, f) < at, "{sample:?} at {f}");
            }
        }
    }
}

/// A block on the ground under a pulse of 2 rad/s.
fn standing(sample: &Sample, a_h: f64, rest: &str) -> Scene {
    let mut pulse =
        format!("[pulse]\nshape = \"{}\"\nomega = 2.0\na_h = {a_h:?}\n", sample.shape.key());
    if sample.shape.has_cycles() {
        pulse += &format!("cycles = {:?}\n", sample.cycles);
    }
    if sample.shape.is_modulated() {
        pulse += &format!("gamma = {:?}\nphase = {:?}\n", sample.gamma, sample.nu);
    }
    scene(&format!(
        "[block]\nhalf_width = 0.2\nheight = 1.0\n[base]\nisolation = \"none\"\n{pulse}{rest}"
    ))
}

fn swept(scene: &Scene) -> Outcome {
    let plan = Plan::new(scene, DEFAULT_STEP).unwrap();
    cpu::sweep(Precision::F64, &plan, &Grid::of(scene), &[0], &Unwatched)[0]
}

#[test]
fn a_pulse_lasts_as_long_as_its_authors_say() {
    for sample in samples() {
        let scene = standing(&sample, 1.0, "[run]\nt_max = 60.0\n");
        let plan = Plan::new(&scene, DEFAULT_STEP).unwrap();
        let clock = plan.clock(&scene.case());
        let lasts = f64::from(clock.steps_forced) * clock.step_forced;
        let wanted = sample.periods * PI;
        assert!((lasts - wanted).abs() < 1e-12 * wanted, "{sample:?}: {lasts} for {wanted}");
    }
}

/// A_h is the ground's peak for every shape: a block of B/H = 0.2 lifts just above 0.2 g, and not just
/// below; one under a jump at once.
#[test]
fn a_block_lifts_where_the_peak_exceeds_wests_value() {
    for sample in samples() {
        let limit = 0.2 * GRAVITY;
        let lifts = |share: f64| {
            // Small enough a tilt of the ground to land again.
            let scene = standing(&sample, share * limit, "[run]\nt_max = 60.0\n");
            [swept(&scene), judge(&scene)]
        };
        let [above, right] = lifts(1.0 + 1e-5);
        assert!(above.uplifts > 0 && right.uplifts > 0, "{sample:?}: {above:?} {right:?}");
        let (t, want) = (above.t_uplift.unwrap(), right.t_uplift.unwrap());
        // At a crest time goes by the root of the height: 1e-5 leaves 1e-3 of a period, which a
        // parabola through a step finds to a hundredth of that.
        assert!((t - want).abs() < 1e-3, "{sample:?}: {t} for {want}");
        if matches!(sample.shape, Shape::OneCosine | Shape::Rectangle) {
            assert_eq!((t, want), (0.0, 0.0), "{sample:?}");
        }
        let [below, right] = lifts(1.0 - 1e-5);
        assert_eq!((below.uplifts, right.uplifts), (0, 0), "{sample:?}: {below:?}");
        assert!((below.friction - right.friction).abs() < 1e-4 * right.friction, "{sample:?}");
        say(&format!("{:?}: uplift at {t:.6} s ({want:.6})", sample.shape));
    }
}

/// What sine and cosine of half a cycle and more have in common with the half-sine.
#[test]
fn half_a_cycle_is_the_half_sine() {
    let of = |shape, cycles| Sample { shape, cycles, gamma: 1.0, nu: 0.0, periods: 0.5 };
    for a_h in [2.5, 4.0, 9.0] {
        let [one, other] = [of(Shape::OneSine, 0.5), of(Shape::HalfSine, 1.0)]
            .map(|sample| swept(&standing(&sample, a_h, "")));
        assert_eq!(one, other);
    }
}

/// An isolated block whose base is moved by each pulse: sweep and reference, which share no formula.
#[test]
fn sweep_and_reference_agree_on_an_isolated_base() {
    for sample in samples() {
        for a_h in [1.5, 4.0] {
            let mut scene = standing(&sample, a_h, "[run]\nt_max = 10.0\n");
            let base = scene_on_base();
            scene.isolation = base.isolation;
            for (parameter, values) in base.numbers.iter() {
                if !scene.numbers.has(parameter) {
                    scene.set(parameter, values.clone());
                }
            }
            let (got, want) = (swept(&scene), judge(&scene));
            assert_eq!(got.class, want.class, "{sample:?} {a_h}");
            // The error of 64 steps a period and more, grown over the impacts.
            for (name, a, b) in [
                ("zeta", got.zeta, want.zeta),
                ("max_u", got.max_u, want.max_u),
                ("max_v", got.max_v, want.max_v),
                ("stroke_v", got.stroke_v, want.stroke_v),
            ] {
                assert!((a - b).abs() <= 1e-4 * b.abs() + 1e-7, "{sample:?} {name}: {a} {b}");
            }
        }
    }
}

/// The base of the test above, under nothing.
fn scene_on_base() -> Scene {
    scene(
        "[block]\nhalf_width = 0.2\nheight = 1.0\nmass = 500.0\nplate_h = 50.0\nplate_v = 50.0\n\
         [base]\nt_h = 1.5\nt_v = 0.4\n[pulse]\nomega = 2.0\na_h = 1.0\na_v = 0.7\n",
    )
}
