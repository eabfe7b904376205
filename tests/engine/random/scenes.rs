//! Random scenes: any of them again from a seed and its number.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::Rng;
use std::f64::consts::{FRAC_PI_2, TAU};

use topple::scene::builder::SceneBuilder;
use topple::scene::{Excitation, GRAVITY, Scene};

use super::records;

/// Random numbers.
pub struct Dice(Pcg64Mcg);

impl Dice {
    /// Those of a scene; the first numbers of neighbouring seeds are alike and are thrown away.
    pub fn of(seed: u64, number: u64) -> Dice {
        let mut dice = Pcg64Mcg::new((u128::from(seed) << 64) | u128::from(2 * number + 1));
        for _ in 0..16 {
            dice.next_u64();
        }
        Dice(dice)
    }

    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// In a range, to four digits, so that a scene is short to write.
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        short(low + (high - low) * self.unit())
    }

    /// In a range, evenly in its logarithm, to four digits.
    pub fn over(&mut self, low: f64, high: f64) -> f64 {
        short(low * (high / low).powf(self.unit()))
    }

    /// True in a share of cases.
    pub fn chance(&mut self, share: f64) -> bool {
        self.unit() < share
    }

    /// One of some.
    pub fn one_of<T: Copy>(&mut self, some: &[T]) -> T {
        some[((self.unit() * some.len() as f64) as usize).min(some.len() - 1)]
    }

    /// -1 or 1.
    pub fn sign(&mut self) -> f64 {
        self.one_of(&[-1.0, 1.0])
    }
}

/// Four significant digits of a number.
pub fn short(x: f64) -> f64 {
    format!("{x:.3e}").parse().unwrap()
}

/// A random scene.
pub struct Case {
    /// Which of its seed's.
    pub number: u64,
    /// As TOML; without the samples of its record.
    pub text: String,
    /// To run.
    pub scene: Scene,
}

/// A block: its TOML, and the push that lifts it about its weaker corner, m/s^2, its angle of overturning
/// about each corner, rad, and its frequency p, rad/s.
struct Body {
    text: String,
    /// M_t, kg.
    carried: f64,
    least_push: f64,
    critical: [f64; 2],
    p: f64,
}

fn body(dice: &mut Dice) -> Body {
    let half_width = dice.over(0.05, 1.0);
    let height = short(half_width * dice.within(1.5, 8.0));
    let eccentricity = if dice.chance(0.2) { 0.0 } else { dice.within(-0.9, 0.9) };
    let mass = dice.over(1.0, 1.0e4);
    let mut text = format!(
        "[block]\nhalf_width = {half_width:?}\nheight = {height:?}\nmass = {mass:?}\neccentricity = \
         {eccentricity:?}\n"
    );
    let mut carried = mass;
    for plate in ["plate_h", "plate_v"] {
        if dice.chance(0.9) {
            let plate_mass = short(mass * dice.over(0.01, 10.0));
            carried += plate_mass;
            text += &format!("{plate} = {plate_mass:?}\n");
        }
    }
    let square = half_width * half_width + height * height;
    if dice.chance(0.3) {
        text += &format!("inertia = {:?}\n", short(mass * square / 3.0 * dice.over(0.3, 3.0)));
    }
    let arms = [1.0, -1.0].map(|side| half_width * (1.0 + side * eccentricity));
    Body {
        text,
        carried,
        least_push: GRAVITY * arms[0].min(arms[1]) / height,
        critical: arms.map(|arm| arm.atan2(height)),
        p: (0.75 * GRAVITY / square.sqrt()).sqrt(),
    }
}

/// A period as one value or as the range of an axis.
fn period(dice: &mut Dice, (low, high): (f64, f64), points: u32) -> String {
    let start = dice.over(low, high);
    if points == 1 {
        return format!("{start:?}");
    }
    let stop = short(start * dice.over(1.2, 4.0));
    format!("\"{start:?}:{stop:?}:{points}\"")
}

/// The base; with `points` values of each of its periods.
fn base(dice: &mut Dice, body: &Body, directions: &str, points: u32) -> String {
    let mut text = format!("[base]\nisolation = \"{directions}\"\n");
    let moves_h = ["dual", "horizontal"].contains(&directions);
    let pendulum = moves_h && dice.chance(0.25);
    if pendulum {
        let points = if directions == "dual" { points } else { points * points };
        text += &format!("radius = {}\n", period(dice, (0.4, 4.0), points));
        let (mu, u_y) = (dice.within(0.01, 0.15), dice.over(0.0005, 0.005));
        text += &format!("mu = {mu:?}\nu_y = {u_y:?}\n");
        if dice.chance(0.3) {
            text += "pressure = \"constant\"\n";
        }
        if dice.chance(0.3) {
            text += &format!("xi_h = {:?}\n", dice.within(0.0, 0.2));
        }
    }
    if moves_h && dice.chance(0.25) {
        let rate = TAU / dice.over(0.04, 0.4);
        let stiffness = short(body.carried * rate * rate);
        text += &format!("stop_gap = {:?}\nstop_stiffness = {stiffness:?}\n", dice.over(0.01, 0.3));
        if dice.chance(0.6) {
            text += &format!("stop_xi = {:?}\n", dice.within(0.0, 0.5));
        }
    }
    if moves_h && !pendulum {
        let points = if directions == "dual" { points } else { points * points };
        text += &format!("t_h = {}\n", period(dice, (0.3, 4.0), points));
        let psi = match dice.unit() {
            x if x < 0.15 => 0.0,
            x if x < 0.35 => 1.0,
            _ => dice.within(0.01, 0.99),
        };
        let xi_h = if dice.chance(0.15) { 0.0 } else { dice.within(0.0, 0.4) };
        let (alpha_y, n) = (dice.over(0.005, 0.3), dice.one_of(&[1, 2, 2, 3, 4, 5, 6]));
        text +=
            &format!("psi = {psi:?}\nxi_h = {xi_h:?}\nalpha_y = {alpha_y:?}\nbouc_wen_n = {n}\n");
    }
    if ["dual", "vertical"].contains(&directions) {
        let points = if directions == "dual" { points } else { points * points };
        text += &format!("t_v = {}\n", period(dice, (0.12, 30.0), points));
        let xi_v = if dice.chance(0.1) { 0.0 } else { dice.within(0.0, 0.4) };
        text += &format!("xi_v = {xi_v:?}\n");
        if dice.chance(0.2) {
            text += &format!("v_hardening = {:?}\n", dice.over(0.01, 0.5));
            text += &format!("static_deflection = {:?}\n", dice.over(0.001, 0.5));
        }
    }
    text
}

/// The pulse of a map, and the time that it takes at most, s.
fn pulse(dice: &mut Dice, body: &Body, points: u32) -> (String, f64) {
    let omega = short(body.p * dice.over(0.7, 8.0));
    let fastest = short(omega * dice.over(1.1, 2.5));
    let strongest = short(body.least_push * dice.over(0.8, 10.0)) * dice.sign();
    let weakest = match dice.unit() {
        x if x < 0.15 => 0.0,
        x if x < 0.4 => -strongest,
        _ => short(strongest * dice.within(0.1, 0.8)),
    };
    let (low, high) = (weakest.min(strongest), weakest.max(strongest));
    let a_v = if dice.chance(0.4) { 0.0 } else { dice.sign() * dice.over(0.5, 12.0) };
    let mut text = format!(
        "[pulse]\nomega = \"{omega:?}:{fastest:?}:{points}\"\na_h = \"{low:?}:{high:?}:{points}\"\na_v = {a_v:?}\n"
    );
    let (name, mut periods) = dice.one_of(&[
        ("one-sine", 1.0),
        ("one-sine", 1.0),
        ("one-sine", 1.0),
        ("one-cosine", 1.0),
        ("half-sine", 0.5),
        ("rectangle", 0.5),
        ("ricker", 3.0),
        ("ricker-antisymmetric", 4.0),
        ("mavroeidis-papageorgiou", 1.0),
    ]);
    text += &format!("shape = \"{name}\"\n");
    if name == "mavroeidis-papageorgiou" {
        periods = dice.within(1.0, 4.0);
        text += &format!("gamma = {periods:?}\nphase = {:?}\n", dice.within(-3.0, 3.0));
    } else if periods == 1.0 && dice.chance(0.3) {
        periods = dice.one_of(&[0.5, 1.25, 2.0, 3.0]);
        text += &format!("cycles = {periods:?}\n");
    }
    (text, periods * TAU / omega)
}

/// The rest of a scene, of which a forced part takes `forced` s.
fn run(dice: &mut Dice, body: &Body, directions: &str, forced: f64, cuts: bool) -> String {
    let t_max = if cuts && dice.chance(0.15) {
        short(forced * dice.within(0.3, 1.0))
    } else {
        forced + dice.over(0.5, 12.0)
    };
    let mut text = format!("[run]\nt_max = {t_max:?}\n");
    let quarter = dice.chance(0.2);
    if quarter {
        text += "overturn = \"quarter-turn\"\n";
    }
    if dice.chance(0.15) {
        let side = dice.sign();
        let most = if quarter { FRAC_PI_2 } else { body.critical[usize::from(side < 0.0)] };
        let share = dice.within(0.05, if quarter { 0.3 } else { 0.9 });
        text += &format!("tilt = {:?}\n", side * short(most * share));
    }
    if directions == "none" && dice.chance(0.5) {
        text += &format!(
            "restitution = {:?}\n",
            if dice.chance(0.2) { 1.0 } else { dice.within(0.3, 1.0) }
        );
    } else if dice.chance(0.25) {
        text += &format!("restitution_factor = {:?}\n", dice.within(0.3, 1.0));
    }
    text
}

/// The scene of a number under a seed.
pub fn case(seed: u64, number: u64) -> Case {
    let dice = &mut Dice::of(seed, number);
    let body = body(dice);
    let directions = dice.one_of(&[
        "dual",
        "dual",
        "dual",
        "horizontal",
        "vertical",
        "vertical",
        "none",
        "none",
    ]);
    let points = dice.one_of(&[3, 3, 4, 5, 7]);
    if dice.chance(0.4) {
        let pair = records::pair(dice, body.least_push);
        // Nothing shortens a record, and a duration must not be below it.
        let run = run(dice, &body, directions, pair.duration(), false);
        let text = body.text.clone() + &base(dice, &body, directions, points) + &run;
        let written = SceneBuilder { force: true, ..SceneBuilder::from_toml(&text).unwrap() };
        let scene = written.check_under(Excitation::Record(pair)).unwrap();
        return Case { number, text, scene };
    }
    let (pulse, longest) = pulse(dice, &body, points);
    let text = body.text.clone()
        + &base(dice, &body, directions, 1)
        + &pulse
        + &run(dice, &body, directions, longest, true);
    let scene =
        SceneBuilder { force: true, ..SceneBuilder::from_toml(&text).unwrap() }.check().unwrap();
    Case { number, text, scene }
}
