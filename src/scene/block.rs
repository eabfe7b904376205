//! The rigid block.

use serde::{Deserialize, Serialize};

use super::{SceneError, positive};

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
struct Object {
    half_width: f64,
    height: f64,
    mass: f64,
    inertia: f64,
    plate: f64,
}

const OBJECTS: [Object; 3] = [
    Object { half_width: 0.175, height: 0.95, mass: 895.0, inertia: 278.38, plate: 43.3 },
    Object { half_width: 0.3, height: 1.1, mass: 676.0, inertia: 292.93, plate: 254.3 },
    Object { half_width: 0.19, height: 0.82, mass: 68.0, inertia: 16.06, plate: 100.7 },
];

/// The block and its plates as written.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, clap::Args)]
#[serde(deny_unknown_fields)]
pub struct BlockText {
    /// A block of the paper's Table 1 with its plates: 1 caryatid, 2 server cabinet, 3 hospital
    /// cabinet
    #[arg(long, value_name = "1|2|3")]
    pub object: Option<u32>,
    /// B: half the width of the base, m
    #[arg(long, value_name = "B")]
    pub half_width: Option<f64>,
    /// H: height of the centre of mass, m
    #[arg(long, value_name = "H")]
    pub height: Option<f64>,
    /// M: mass, kg (needed only with plates)
    #[arg(long, value_name = "M")]
    pub mass: Option<f64>,
    /// J_C: moment of inertia about the centre of mass, kg m^2 [default: the uniform rectangle's]
    #[arg(long, value_name = "J")]
    pub inertia: Option<f64>,
    /// m_h: mass of the plate that moves horizontally, kg
    #[arg(long, value_name = "KG")]
    pub plate_h: Option<f64>,
    /// m_v: mass of the plate that moves vertically, kg
    #[arg(long, value_name = "KG")]
    pub plate_v: Option<f64>,
    /// epsilon = e/B: offset of the centre of mass to the right, over B [default: 0]
    #[arg(long, value_name = "E", allow_negative_numbers = true)]
    pub eccentricity: Option<f64>,
}

impl Block {
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
}

/// A checked block with the masses m_h and m_v of its plates, kg.
pub(super) fn check(text: &BlockText) -> Result<(Block, f64, f64), SceneError> {
    let eccentricity = text.eccentricity.unwrap_or(0.0);
    if !(eccentricity.abs() < 1.0) {
        let problem = format!(
            "{eccentricity} puts the centre of mass outside the base; e/B must lie between -1 and 1"
        );
        return Err(SceneError::new("eccentricity", problem));
    }
    let plate = |key, value: Option<f64>, default: f64| match value {
        Some(m) if m.is_finite() && m >= 0.0 => Ok(m),
        Some(m) => Err(SceneError::new(key, format!("{m} must be a mass of 0 kg or more"))),
        None => Ok(default),
    };
    if let Some(number) = text.object {
        let own = [
            ("half_width", text.half_width),
            ("height", text.height),
            ("mass", text.mass),
            ("inertia", text.inertia),
        ];
        if let Some((key, _)) = own.into_iter().find(|(_, value)| value.is_some()) {
            let problem = "object already fixes this; give one or the other";
            return Err(SceneError::new(key, problem));
        }
        let object = match number {
            1..=3 => &OBJECTS[number as usize - 1],
            _ => return Err(SceneError::new("object", format!("{number} must be 1, 2 or 3"))),
        };
        let block = Block {
            half_width: object.half_width,
            height: object.height,
            mass: object.mass,
            inertia: object.inertia,
            eccentricity,
        };
        let plate_h = plate("plate_h", text.plate_h, object.plate)?;
        let plate_v = plate("plate_v", text.plate_v, object.plate)?;
        return Ok((block, plate_h, plate_v));
    }
    let (Some(half_width), Some(height)) = (text.half_width, text.height) else {
        let problem = "no block: give object (1, 2 or 3), or half_width and height";
        return Err(SceneError::new("object", problem));
    };
    let half_width = positive("half_width", half_width)?;
    let height = positive("height", height)?;
    let plate_h = plate("plate_h", text.plate_h, 0.0)?;
    let plate_v = plate("plate_v", text.plate_v, 0.0)?;
    let mass = match text.mass {
        Some(mass) => positive("mass", mass)?,
        None if plate_h == 0.0 && plate_v == 0.0 && text.inertia.is_none() => 1.0,
        None => {
            let problem = "missing; a plate's mass or an inertia means nothing without it";
            return Err(SceneError::new("mass", problem));
        }
    };
    let inertia = match text.inertia {
        Some(inertia) => positive("inertia", inertia)?,
        // A uniform rectangle of 2B by 2H about its centre.
        None => mass * (half_width * half_width + height * height) / 3.0,
    };
    Ok((Block { half_width, height, mass, inertia, eccentricity }, plate_h, plate_v))
}
