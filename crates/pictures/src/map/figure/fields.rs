//! The columns that maps show, with their titles and scales.

use topple::results::columns::Column;
use topple::scene::Directions;
use topple::stepping::outcome::Outcome;

/// A column that is drawn over the grid.
#[derive(Debug, Clone, Copy)]
pub struct Field {
    /// Which one.
    pub column: Column,
    /// Name of the files.
    pub name: &'static str,
    /// Title of the figure.
    pub title: &'static str,
    /// Symbol and unit at the scale.
    pub label: &'static str,
    /// Fixed ends of the scale; those of the values where there are none.
    pub ends: Option<(f64, f64)>,
    /// True where a small value is dark: dark is what is worse for the block.
    pub falls: bool,
}

/// A field on the scale of its values.
const fn field(
    column: Column,
    name: &'static str,
    title: &'static str,
    label: &'static str,
) -> Field {
    Field { column, name, title, label, ends: None, falls: false }
}

/// The rocking index, the displacements and the vertical stroke, a figure each.
pub const FIELDS: [Field; 4] = [
    Field {
        ends: Some((0.0, 1.0)),
        ..field(Column::Zeta, "map", "rocking index", "ζ = max |φ| / α")
    },
    field(Column::MaxU, "displacement_u", "horizontal displacement of the base", "max |u| [m]"),
    field(Column::MaxV, "displacement_v", "vertical displacement of the base", "max |v| [m]"),
    field(
        Column::StrokeV,
        "stroke_v",
        "vertical stroke of the base about its static position",
        "max |v + g/ω_v²| [m]",
    ),
];

/// The contact forces, the two halves of a figure.
pub const CONTACT: [Field; 2] = [
    Field {
        ends: Some((0.0, 10.0)),
        falls: true,
        ..field(Column::MinContact, "contact", "least contact force", "min N/M [m/s²]")
    },
    field(Column::Friction, "friction", "friction needed", "max |S|/N (up to 1)"),
];

/// All of them.
pub fn all() -> impl Iterator<Item = &'static Field> {
    FIELDS.iter().chain(&CONTACT)
}

/// The names of the columns of which a small value is dark.
pub fn falling() -> Vec<&'static str> {
    all().filter(|field| field.falls).map(|field| field.column.entry().name).collect()
}

/// Friction above which all values are alike: nothing holds there.
const FRICTION: f64 = 1.0;

impl Field {
    /// The value of a cell.
    pub fn value(&self, cell: &Outcome) -> f64 {
        let number = (self.column.entry().number)(cell);
        if self.column == Column::Friction { number.min(FRICTION) } else { number }
    }

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
