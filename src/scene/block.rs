//! The rigid block.

use serde::{Deserialize, Serialize};

use super::applies::{BlockBy, Choice};
use super::numbers::{Numbers, Point};
use super::parameters::Parameter;
use super::{GRAVITY, Overturn, SceneError};

/// A rigid block, Fig. 1(a) of the paper.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Block {
    /// B, half the base, m.
    pub half_width: f64,
    /// H, height of the centre of mass, m.
    pub height: f64,
    /// M, kg.
    pub mass: f64,
    /// J_C, moment of inertia about the centre of mass, kg m^2.
    pub inertia: f64,
    /// epsilon = e/B: the centre of mass lies to the right of the middle where it is positive.
    pub eccentricity: f64,
}

/// A block of Table 1 with the masses of its base's plates (section 3.3).
pub struct Object {
    half_width: f64,
    height: f64,
    mass: f64,
    inertia: f64,
    plate: f64,
}

/// The blocks of Table 1.
pub const OBJECTS: [Object; 3] = [
    Object { half_width: 0.175, height: 0.95, mass: 895.0, inertia: 278.38, plate: 43.3 },
    Object { half_width: 0.3, height: 1.1, mass: 676.0, inertia: 292.93, plate: 254.3 },
    Object { half_width: 0.19, height: 0.82, mass: 68.0, inertia: 16.06, plate: 100.7 },
];

impl Object {
    /// Its numbers.
    pub fn numbers(&self) -> [(Parameter, f64); 6] {
        use Parameter::{HalfWidth, Height, Inertia, Mass, PlateH, PlateV};
        [
            (HalfWidth, self.half_width),
            (Height, self.height),
            (Mass, self.mass),
            (Inertia, self.inertia),
            (PlateH, self.plate),
            (PlateV, self.plate),
        ]
    }
}

impl Block {
    /// The block of these numbers; zeros stand for what is missing, which a checked scene has none of.
    pub(super) fn of(point: &Point) -> Block {
        let of = |parameter| point.get(parameter).unwrap_or(0.0);
        let (half_width, height) = sides(point);
        // Without plates no number of the motion depends on the mass.
        let mass = point.get(Parameter::Mass).unwrap_or(1.0);
        // A uniform rectangle of 2B by 2H about its centre.
        let uniform = mass * (half_width * half_width + height * height) / 3.0;
        let inertia = point.get(Parameter::Inertia).unwrap_or(uniform);
        let eccentricity = match point.get(Parameter::Offset) {
            Some(offset) => offset / half_width,
            None => of(Parameter::Eccentricity),
        };
        Block { half_width, height, mass, inertia, eccentricity }
    }

    /// e, m.
    pub fn offset(&self) -> f64 {
        self.eccentricity * self.half_width
    }

    /// Lever arm of the centre of mass about the left corner (`side` +1) or the right (-1), m.
    pub fn arm(&self, side: f64) -> f64 {
        self.half_width + side * self.offset()
    }

    /// Critical angle about a corner, rad (section 2.6).
    pub fn critical_angle(&self, side: f64) -> f64 {
        self.arm(side).atan2(self.height)
    }

    /// p = sqrt(M g R/I_O), its frequency parameter about a corner, rad/s.
    pub fn frequency(&self, side: f64) -> f64 {
        let radius = self.arm(side).hypot(self.height);
        (self.mass * GRAVITY * radius / (self.inertia + self.mass * radius * radius)).sqrt()
    }

    /// |phi| at which it counts as overturned about a corner, rad.
    pub fn overturning_angle(&self, side: f64, when: Overturn) -> f64 {
        match when {
            Overturn::CriticalAngle => self.critical_angle(side),
            Overturn::QuarterTurn => std::f64::consts::FRAC_PI_2,
        }
    }
}

/// B and H, m, of the two of B, H, lambda = H/B and R = sqrt(B^2 + H^2) that a scene gives; not a number
/// where R is no more than the other.
fn sides(point: &Point) -> (f64, f64) {
    let of = |parameter| point.get(parameter);
    let other = |size: f64, side: f64| ((size - side) * (size + side)).sqrt();
    match SHAPE.map(of) {
        [Some(b), Some(h), ..] => (b, h),
        [Some(b), _, Some(lambda), _] => (b, lambda * b),
        [Some(b), _, _, Some(size)] => (b, other(size, b)),
        [_, Some(h), Some(lambda), _] => (h / lambda, h),
        [_, Some(h), _, Some(size)] => (other(size, h), h),
        [_, _, Some(lambda), Some(size)] => {
            let b = size / lambda.hypot(1.0);
            (b, lambda * b)
        }
        _ => (0.0, 0.0),
    }
}

/// What says how wide and how high a block is: two of them.
const SHAPE: [Parameter; 4] =
    [Parameter::HalfWidth, Parameter::Height, Parameter::Slenderness, Parameter::Size];

/// Adds to the numbers what a block of Table 1 has, and what a block must have; `object` is its number.
///
/// # Errors
/// The key that is missing, or is given twice.
pub(super) fn complete(object: Option<u32>, numbers: &mut Numbers) -> Result<(), SceneError> {
    use Parameter::{Inertia, Mass, PlateH, PlateV};
    if let Some(number) = object {
        if let Some(given) = numbers.excluded_by(Choice::Block(BlockBy::Object)) {
            let problem = "`object` already fixes this; give one or the other";
            return Err(SceneError::new(given.key(), problem));
        }
        let object = match number {
            1..=3 => &OBJECTS[number as usize - 1],
            _ => return Err(SceneError::new("object", format!("{number} must be 1, 2 or 3"))),
        };
        for (parameter, value) in object.numbers() {
            numbers.set_missing(parameter, value);
        }
    }
    let given: Vec<Parameter> =
        SHAPE.into_iter().filter(|parameter| numbers.has(*parameter)).collect();
    if given.is_empty() {
        let problem = "no block: give `object` (1, 2 or 3), or `half_width` and `height`";
        return Err(SceneError::new("object", problem));
    }
    if let [one] = given[..] {
        let others = SHAPE.into_iter().filter(|other| *other != one);
        let others: Vec<String> = others.map(|other| format!("`{}`", other.key())).collect();
        let problem = format!("one number is no block; give one of {} too", others.join(", "));
        return Err(SceneError::new(one.key(), problem));
    }
    if let Some(third) = given.get(2) {
        let (one, other) = (given[0].key(), given[1].key());
        let problem = format!("follows from `{one}` and `{other}`; give two of the three");
        return Err(SceneError::new(third.key(), problem));
    }
    for plate in [PlateH, PlateV] {
        numbers.set_missing(plate, 0.0);
    }
    let plates = [PlateH, PlateV].into_iter().filter_map(|plate| numbers.get(plate));
    let plated = plates.into_iter().any(|values| values.ends().1 > 0.0);
    if !numbers.has(Mass) && (plated || numbers.has(Inertia)) {
        let problem = "missing; a plate's mass or an inertia means nothing without it";
        return Err(SceneError::new("mass", problem));
    }
    if !numbers.has(Parameter::Offset) {
        numbers.set_missing(Parameter::Eccentricity, 0.0);
    }
    Ok(())
}
