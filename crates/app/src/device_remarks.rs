//! What a user should know of a scene's device: a damper that nobody gave, and numbers that no isolation has.

use std::f64::consts::TAU;

use topple::scene::device::{BoucWen, DEFAULT_XI_H};
use topple::scene::record::rounded;
use topple::scene::{Device, GRAVITY, Grid, Parameter, Scene, Values};

use super::words;

/// Longest period of an isolation, s: before it yields, or of a pendulum while it slides. Isolations have 1 to 5 s (Naeim & Kelly
/// 1999, Design of Seismic Isolated Structures; the equivalent lateral force procedure of ASCE/SEI 7-16, 17.4.1, ends at 5 s), and
/// less before they yield; the limit is twice the longest. Stiffnesses in kN/m where N/m are meant make each period √1000 = 32 times
/// as long, so that all devices of 0.32 s and more before they yield are found. Of a flat slider the period after yielding may be as
/// long as it likes: it has no limit.
const LONGEST: f64 = 10.0;
/// Shortest period after an isolation yields or while it slides, s: ASCE/SEI 7-16, 11.2, calls a component of 0.06 s or less rigid.
/// Before a device yields or slides it may be as stiff as its friction makes it.
const SHORTEST: f64 = 0.06;
/// Least force of a device at zero displacement over the weight that it carries. Those of devices lie between about 0.1 % (rollers of
/// steel) and 20 % (dry sliding); a force in kN where N are meant makes a thousandth of that, 0.02 % at most.
const WEAKEST: f64 = 3.0e-4;
/// Largest ratio of the stiffnesses after and before yielding of a device that has such a force: rubber alone has nearly none.
const YIELDS: f64 = 0.5;

/// Warns of what a user should know of a scene's device.
pub fn warn(scene: &Scene) {
    damper(scene).into_iter().chain(implausible(scene)).for_each(words::warn);
}

/// That a damper acts beside a base of the paper that yields at a given displacement or force, where none was given: a device whose
/// friction or yielding is all of its damping has none.
pub fn damper(scene: &Scene) -> Option<String> {
    let given = |own: &Parameter| scene.numbers.has(*own);
    let strength = [Parameter::UY, Parameter::YieldForce].into_iter().find(given)?;
    let damper = scene.numbers.get(Parameter::XiH).and_then(Values::single);
    let is_default = Device::of(&scene.numbers) == Device::Paper && damper == Some(DEFAULT_XI_H);
    is_default.then(|| {
        let flag = strength.entry().flag();
        format!("{flag}: 5 % of damping on the initial stiffness acts beside the device; --xi-h 0 leaves it out")
    })
}

/// What stiffnesses, forces and radii make of the base where no isolation is so.
pub fn implausible(scene: &Scene) -> Vec<String> {
    use Parameter::{K1, K2, Psi, Qd, Radius, UY, YieldForce};
    if !scene.isolation.moves_h() {
        return Vec::new();
    }
    let device = Device::of(&scene.numbers);
    let laws: Vec<BoucWen> =
        Grid::of(scene).corners().filter_map(|case| case.isolation.horizontal).collect();
    let most = |of: &dyn Fn(&BoucWen) -> f64| laws.iter().map(of).reduce(f64::max);
    let least = |of: &dyn Fn(&BoucWen) -> f64| laws.iter().map(of).reduce(f64::min);
    let after = |law: &BoucWen| law.t_h / law.psi.sqrt();
    let flags = |of: &[Parameter]| -> String {
        let given = of.iter().filter(|own| scene.numbers.has(**own));
        given.map(|own| own.entry().flag()).collect::<Vec<_>>().join(", ")
    };
    let short = |value: f64| rounded(value, 3);
    let of_stiffness = [K1, K2, Psi, YieldForce, UY];
    let mut found = Vec::new();
    let (longest, when, of, asked) = match device {
        Device::Paper => (None, "", &[][..], ""),
        Device::Bilinear => (
            most(&|law| law.t_h),
            "before the device yields",
            &of_stiffness[..],
            "stiffnesses in N/m and forces in N, for all devices under the block together",
        ),
        Device::Pendulum => (most(&after), "while the pendulum slides", &[Radius][..], "in metres"),
    };
    if let Some(period) = longest.filter(|period| *period > LONGEST) {
        found.push(format!(
            "{}: T = {} s {when}; no isolation has more than {LONGEST} s: give {asked}",
            flags(of),
            short(period)
        ));
    }
    let shortest = least(&after).filter(|period| device != Device::Paper && *period < SHORTEST);
    if let Some(period) = shortest {
        let (of, asked) = match device {
            Device::Pendulum => (flags(&[Radius]), "the radius in metres"),
            _ => (flags(&of_stiffness), "stiffnesses in N/m"),
        };
        found.push(format!(
            "{of}: T = {} s after it yields or slides; below {SHORTEST} s a base is rigid and isolates nothing: give {asked}",
            short(period)
        ));
    }
    // Of a pendulum the friction says it, and of a base of the paper its strength may be a share of the motion's.
    let has_force =
        scene.numbers.has(Qd) || scene.numbers.has(YieldForce) || device == Device::Bilinear;
    let force = |law: &BoucWen| {
        let per_mass = (1.0 - law.psi) * law.u_y * (TAU / law.t_h).powi(2);
        if law.psi > YIELDS { f64::INFINITY } else { per_mass / GRAVITY }
    };
    if let Some(share) = least(&force).filter(|share| has_force && *share < WEAKEST) {
        found.push(format!(
            "{}: the device holds {} % of the weight before it yields; those of isolations hold 0.1 % or more: give forces in N and stiffnesses in N/m",
            flags(&[Qd, YieldForce, K1, UY]),
            short(100.0 * share)
        ));
    }
    found
}
