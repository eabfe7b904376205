//! The values of a cell that maps show, with their titles and scales.

use topple::results::columns::Column;
use topple::scene::Directions;
use topple::stepping::outcome::Outcome;

/// A value that is drawn over the grid.
#[derive(Debug, Clone, Copy)]
pub struct Field {
    /// The column that it shows.
    pub column: Column,
    /// Name of the files.
    pub name: &'static str,
    /// Title of the figure.
    pub title: &'static str,
    /// Symbol and unit at the scale.
    pub label: &'static str,
    /// The value of a cell.
    pub value: fn(&Outcome) -> f64,
    /// Fixed ends of the scale; those of the values where there are none.
    pub ends: Option<(f64, f64)>,
    /// True where a small value is dark: dark is what is worse for the block.
    pub falls: bool,
}

/// The rocking index, the displacements and the vertical stroke, a figure each.
pub const FIELDS: [Field; 4] = [
    Field {
        column: Column::Zeta,
        name: "map",
        title: "rocking index",
        label: "ζ = max |φ| / α",
        value: |cell| cell.zeta,
        ends: Some((0.0, 1.0)),
        falls: false,
    },
    Field {
        column: Column::MaxU,
        name: "displacement_u",
        title: "horizontal displacement of the base",
        label: "max |u| [m]",
        value: |cell| cell.max_u,
        ends: None,
        falls: false,
    },
    Field {
        column: Column::MaxV,
        name: "displacement_v",
        title: "vertical displacement of the base",
        label: "max |v| [m]",
        value: |cell| cell.max_v,
        ends: None,
        falls: false,
    },
    Field {
        column: Column::StrokeV,
        name: "stroke_v",
        title: "vertical stroke of the base about its static position",
        label: "max |v + g/ω_v²| [m]",
        value: |cell| cell.stroke_v,
        ends: None,
        falls: false,
    },
];

/// The contact forces, the two halves of a figure.
pub const CONTACT: [Field; 2] = [
    Field {
        column: Column::MinContact,
        name: "contact",
        title: "least contact force",
        label: "min N/M [m/s²]",
        value: |cell| cell.min_contact,
        ends: Some((0.0, 10.0)),
        falls: true,
    },
    Field {
        column: Column::Friction,
        name: "friction",
        title: "friction needed",
        label: "max |S|/N (up to 1)",
        value: |cell| cell.friction.min(FRICTION),
        ends: None,
        falls: false,
    },
];

/// Friction above which all values are alike: nothing holds there.
const FRICTION: f64 = 1.0;

impl Field {
    /// True where it changes at all: a direction that is locked has no displacement.
    pub fn moves(&self, directions: Directions) -> bool {
        match self.column {
            Column::MaxU => directions.moves_h(),
            Column::MaxV | Column::StrokeV => directions.moves_v(),
            _ => true,
        }
    }

    /// True where a cell's value has a place on the scale: that of an overturned cell tells how far it came,
    /// not how far it can.
    pub fn counts(cell: &Outcome) -> bool {
        cell.class.stands()
    }
}
