//! The share of each outcome in the plane, against the eccentricity.

use std::io::Write;

use serde::Serialize;

use topple::results::csv::Number;
use topple::scene::{Parameter, Scene};
use topple::stepping::outcome::{Class, Outcome};
use topple_pictures::colours::palette::Parity;

/// Shares of the cells of a map; together they are 1.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Shares {
    /// In full contact throughout.
    pub full_contact: f64,
    /// Rocking, not overturned.
    pub rocking: f64,
    /// Overturned about the left corner without an impact.
    pub direct_left: f64,
    /// Overturned about the right corner without an impact.
    pub direct_right: f64,
    /// Overturned after an odd number of impacts.
    pub odd: f64,
    /// Overturned after an even number of impacts.
    pub even: f64,
    /// Overturned after a rest between impacts.
    pub rested: f64,
    /// Unresolved.
    pub unresolved: f64,
}

/// A share's name in files, and what it is of.
pub const NAMES: [&str; 8] = [
    "full_contact",
    "rocking",
    "direct_left",
    "direct_right",
    "odd",
    "even",
    "rested",
    "unresolved",
];

impl Shares {
    /// The shares of a map's outcomes.
    pub fn of(outcomes: &[Outcome]) -> Shares {
        let mut shares = Shares::default();
        let cell = 1.0 / outcomes.len().max(1) as f64;
        for outcome in outcomes {
            let share = match (Parity::of(outcome), outcome.class) {
                (Parity::Unresolved, _) => &mut shares.unresolved,
                (Parity::Stands, Class::FullContact) => &mut shares.full_contact,
                (Parity::Stands, _) => &mut shares.rocking,
                (Parity::Direct, Class::OverturnedLeft) => &mut shares.direct_left,
                (Parity::Direct, _) => &mut shares.direct_right,
                (Parity::Odd, _) => &mut shares.odd,
                (Parity::Even, _) => &mut shares.even,
                (Parity::Rested, _) => &mut shares.rested,
            };
            *share += cell;
        }
        shares
    }

    /// The shares in the order of [`NAMES`].
    pub fn all(&self) -> [f64; 8] {
        [
            self.full_contact,
            self.rocking,
            self.direct_left,
            self.direct_right,
            self.odd,
            self.even,
            self.rested,
            self.unresolved,
        ]
    }

    /// The share that does not overturn.
    pub fn stable(&self) -> f64 {
        self.full_contact + self.rocking
    }
}

/// The scene at another eccentricity.
pub fn at(scene: &Scene, eccentricity: f64) -> Scene {
    scene.clone().with(Parameter::Eccentricity, eccentricity)
}

/// Writes shares, a row an eccentricity.
pub fn write(rows: &[(f64, Shares)], writer: impl Write) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_writer(writer);
    table.write_field("eccentricity")?;
    table.write_record(NAMES)?;
    for (eccentricity, shares) in rows {
        table.serialize((Number(*eccentricity), shares.all().map(Number)))?;
    }
    table.flush()?;
    Ok(())
}
