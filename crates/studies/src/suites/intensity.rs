//! Intensity measures of a fragility, and how they grow with the motion.

use std::fmt;
use std::ops::RangeInclusive;
use std::str::FromStr;

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::measures::Measures;
use topple::scene::record::Pair;
use topple::scene::shown::shown;
use topple::scene::{Block, GRAVITY};

/// A measure of a motion's strength; all but the vertical one are of the horizontal component.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Intensity {
    /// Largest acceleration, m/s^2.
    Pga,
    /// Largest velocity, m/s.
    Pgv,
    /// Arias intensity, m/s.
    Arias,
    /// Cumulative absolute velocity, m/s.
    Cav,
    /// Pseudo-acceleration at a period in s and 5 % of damping, m/s^2.
    Sa(f64),
    /// Its geometric mean from 0.2 to 3 times a period in s, m/s^2.
    AverageSa(f64),
    /// PGA/(g tan alpha) of the block: at 1 it lifts on a rigid base.
    RelativePga,
    /// p PGV/(g tan alpha) of the block, with p = sqrt(M g R/I_O).
    RelativePgv,
}

/// Periods that a record tells anything of, s.
const PERIODS: RangeInclusive<f64> = 0.01..=100.0;

/// A text that is no measure.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "'{0}' is no intensity measure; give pga, pgv, arias, cav, sa:T, avg-sa:T with a period of 0.01 to 100 s, or pga*, pgv*"
)]
pub struct IntensityError(String);

impl Intensity {
    /// True of those that are told relative to the block.
    pub fn is_of_block(self) -> bool {
        matches!(self, Intensity::RelativePga | Intensity::RelativePgv)
    }

    /// That of a motion that shakes a block.
    pub fn of(self, pair: &Pair, block: &Block) -> f64 {
        let measures = || Measures::of(pair);
        // Over the corner that is nearer to overturning.
        let sides = [1.0, -1.0].map(|side| (block.critical_angle(side), block.frequency(side)));
        let (alpha, p) = if sides[0].0 <= sides[1].0 { sides[0] } else { sides[1] };
        let threshold = GRAVITY * alpha.tan();
        match self {
            Intensity::Pga => measures().pga_h,
            Intensity::Pgv => measures().pgv,
            Intensity::Arias => measures().arias,
            Intensity::Cav => measures().cav,
            Intensity::Sa(period) => Measures::sa(pair, period),
            Intensity::AverageSa(period) => Measures::average_sa(pair, period),
            Intensity::RelativePga => measures().pga_h / threshold,
            Intensity::RelativePgv => p * measures().pgv / threshold,
        }
    }

    /// The factor on a motion by which its measure grows by another.
    pub fn factor(self, growth: f64) -> f64 {
        match self {
            Intensity::Arias => growth.sqrt(),
            _ => growth,
        }
    }

    /// By what its measure grows where a motion grows by a factor: what [`factor`](Intensity::factor) turns around.
    pub fn growth(self, factor: f64) -> f64 {
        match self {
            Intensity::Arias => factor * factor,
            _ => factor,
        }
    }

    /// Its unit; 1 of those that are relative to the block.
    pub fn unit(self) -> &'static str {
        match self {
            Intensity::Pga | Intensity::Sa(_) | Intensity::AverageSa(_) => "m/s²",
            Intensity::Pgv | Intensity::Arias | Intensity::Cav => "m/s",
            Intensity::RelativePga | Intensity::RelativePgv => "1",
        }
    }

    /// Its symbol.
    pub fn symbol(self) -> String {
        match self {
            Intensity::Pga => "PGA".into(),
            Intensity::Pgv => "PGV".into(),
            Intensity::Arias => "Arias intensity".into(),
            Intensity::Cav => "CAV".into(),
            Intensity::Sa(period) => format!("Sa({period} s)"),
            Intensity::AverageSa(period) => format!("average Sa({period} s)"),
            Intensity::RelativePga => "PGA/(g tan α)".into(),
            Intensity::RelativePgv => "p PGV/(g tan α)".into(),
        }
    }

    /// Symbol and unit, for axes.
    pub fn label(self) -> String {
        match self.unit() {
            "1" => self.symbol(),
            unit => format!("{} [{unit}]", self.symbol()),
        }
    }
}

impl fmt::Display for Intensity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Intensity::Pga => f.write_str("pga"),
            Intensity::Pgv => f.write_str("pgv"),
            Intensity::Arias => f.write_str("arias"),
            Intensity::Cav => f.write_str("cav"),
            Intensity::Sa(period) => write!(f, "sa:{period}"),
            Intensity::AverageSa(period) => write!(f, "avg-sa:{period}"),
            Intensity::RelativePga => f.write_str("pga*"),
            Intensity::RelativePgv => f.write_str("pgv*"),
        }
    }
}

impl FromStr for Intensity {
    type Err = IntensityError;

    fn from_str(text: &str) -> Result<Intensity, IntensityError> {
        let lower = text.trim().to_ascii_lowercase();
        let period = |text: &str| {
            let period = text.trim().trim_end_matches('s').trim().parse::<f64>().ok();
            period.filter(|period| PERIODS.contains(period))
        };
        let known = match lower.split_once(':') {
            Some(("sa", at)) => period(at).map(Intensity::Sa),
            Some(("avg-sa" | "avg_sa" | "average-sa", at)) => period(at).map(Intensity::AverageSa),
            Some(_) => None,
            None => match lower.as_str() {
                "pga" => Some(Intensity::Pga),
                "pgv" => Some(Intensity::Pgv),
                "arias" => Some(Intensity::Arias),
                "cav" => Some(Intensity::Cav),
                "pga*" => Some(Intensity::RelativePga),
                "pgv*" => Some(Intensity::RelativePgv),
                _ => None,
            },
        };
        known.ok_or_else(|| IntensityError(shown(text)))
    }
}

impl Serialize for Intensity {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Intensity {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Intensity, D::Error> {
        String::deserialize(deserializer)?.parse().map_err(Error::custom)
    }
}
