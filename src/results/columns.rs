//! The columns of a map, each defined once. The columns in memory and on disk, map.csv, map.npz, map.zarr and
//! the table of docs/columns.md are all made from this table.

use super::cell_value::CellValue;
pub use super::cell_value::{ColumnKind, STATUS_NAMES, Shown, class_code, status_code};
use super::values::{ColumnValues, Slots};
use crate::stepping::outcome::{Class, Outcome, Status};

/// The description of a column.
pub struct Entry {
    /// Which one.
    pub column: Column,
    /// Name in files.
    pub name: &'static str,
    /// Unit; empty for a ratio, a number of events, a name.
    pub unit: &'static str,
    /// What it means.
    pub meaning: &'static str,
    /// What it holds.
    pub kind: ColumnKind,
    /// The value of a cell in it as a number.
    pub number: fn(&Outcome) -> f64,
    /// Puts the values of outcomes in slots, each at its place.
    pub(super) put: fn(&mut Slots, &[usize], &[Outcome]),
    /// Sets the values of outcomes from those of the column from a place on.
    pub(super) give: fn(&ColumnValues, usize, &mut [Outcome]),
}

impl Entry {
    /// The value of a cell in it, as it is shown.
    pub fn shown(&self, cell: &Outcome) -> Shown {
        self.kind.shown((self.number)(cell))
    }
}

/// Makes the enum of columns and their descriptions from one table. A row of the table has the name of the column in Rust, the
/// field of an [`Outcome`] and its type, the name in files, the unit and the meaning.
macro_rules! columns {
    ($(
        $(#[$doc:meta])* $column:ident = $field:ident: $value:ty, $name:literal, $unit:literal, $meaning:literal;
    )*) => {
        /// What is known of a cell: one variant for each column.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum Column {
            $($(#[$doc])* $column,)*
        }

        impl Column {
            /// All columns.
            pub const ALL: [Column; [$($name),*].len()] = [$(Column::$column),*];
        }

        /// The descriptions of all columns, in the order of [`Column`].
        pub const TABLE: [Entry; Column::ALL.len()] = [$(Entry {
            column: Column::$column,
            name: $name,
            unit: $unit,
            meaning: $meaning,
            kind: <$value as CellValue>::KIND,
            number: |cell| cell.$field.number(),
            put: |slots, places, outcomes| slots.put(places, outcomes, |cell| cell.$field.number()),
            give: |values, first, outcomes| {
                values.give(first, outcomes, |cell, number| cell.$field = CellValue::of(number));
            },
        }),*];
    };
}

columns! {
    /// The class.
    Outcome = class: Class, "outcome", "",
        "outcome: full_contact, rocking, overturned_left, overturned_right, unresolved";
    /// The impacts.
    Impacts = impacts: u32, "impacts", "",
        "number of impacts. For a block that stays up only those up to the time after which no impact can change another \
         column of the map: this number depends on `--columns`, on the step and on `--full-model`, and is not one of the \
         block. Use `--full-model` or `topple history` to count its impacts, without those of flights that are left out";
    /// The uplifts.
    Uplifts = uplifts: u32, "uplifts", "",
        "uplifts from full contact, counted as long as impacts are; a block that rests where flights are left out may lift \
         once more";
    /// The end, s.
    TEnd = t_end: f64, "t_end", "s", "time of overturning, or the run's end";
    /// The first uplift, s.
    TUplift = t_uplift: Option<f64>, "t_uplift", "s",
        "time of the first uplift from full contact; empty, or not a number, where there is none. A block that starts tilted \
         must rest before, and its time depends on the flights that are left out";
    /// The rocking index.
    Zeta = zeta: f64, "zeta", "", "largest |φ| divided by the critical angle of its side; 1 if the block overturned";
    /// The largest phi about the left corner, rad.
    MaxPhiLeft = max_phi_left: f64, "max_phi_left", "rad", "largest rotation about the left corner";
    /// The largest -phi about the right corner, rad.
    MaxPhiRight = max_phi_right: f64, "max_phi_right", "rad", "largest rotation about the right corner";
    /// The largest |u|, m.
    MaxU = max_u: f64, "max_u", "m", "largest |u|";
    /// The largest |v|, m.
    MaxV = max_v: f64, "max_v", "m", "largest |v|, with the static deflection";
    /// The largest |v + g/omega_v^2|, m.
    StrokeV = stroke_v: f64, "stroke_v", "m",
        "stroke of v: largest vertical displacement of the base from the static position, |v + g/ω_v²|";
    /// The least contact force over M, m/s^2.
    MinContact = min_contact: f64, "min_contact", "m/s²",
        "least normal force between block and base divided by the mass of the block, 9.81 at rest; at zero and below the model is not \
         valid";
    /// The friction asked for.
    Friction = friction: f64, "friction_demand", "",
        "friction coefficient that keeps the block from sliding: largest |horizontal force| divided by the normal force while that \
         is positive; it grows without bound as the normal force approaches zero";
    /// How the integration ended.
    Status = status: Status, "status", "",
        "how the integration ended: ok, event_limit, diverged, step_limit, vertical_locked, undecided";
    /// The time simulated, s.
    TSimulated = t_simulated: f64, "t_simulated", "s",
        "time up to which the cell was simulated: t_end, or the earlier time at which an energy bound proved that its \
         results can no longer change";
    /// The acceleration of the plate, m/s^2.
    AccPlate = acc_plate: f64, "acc_plate", "m/s²",
        "largest absolute horizontal acceleration of the upper plate; only on request";
    /// The acceleration of the centre of mass, m/s^2.
    AccBlock = acc_block: f64, "acc_block", "m/s²",
        "largest absolute horizontal acceleration of the block's centre of mass; only on request";
    /// The acceleration of the plate with gravity, m/s^2.
    AccPlateTotal = acc_plate_total: f64, "acc_plate_total", "m/s²",
        "largest acceleration of the upper plate with gravity, horizontal and vertical together: what an accelerometer on it \
         measures, 9.81 at rest; only on request";
    /// The acceleration of the centre of mass with gravity, m/s^2.
    AccBlockTotal = acc_block_total: f64, "acc_block_total", "m/s²",
        "largest acceleration of the centre of mass of the block with gravity, horizontal and vertical together, 9.81 at rest; only \
         on request";
    /// What the base carries, N.
    BaseLoad = base_load: f64, "base_load", "N",
        "largest vertical force that the base carries: of block and plates on a horizontal or dual isolation, of block and upper \
         plate on a vertical one, of the block without isolation; only on request";
    /// The force on the end stop, N.
    StopForce = stop_force: f64, "stop_force", "N",
        "largest force on the end stop; only on request";
    /// How often the base met its end stop.
    StopHits = stop_hits: u32, "stop_hits", "",
        "number of times at which the end stop began to push the base; only on request";
}

impl Column {
    /// How many of the table a map has by default: the first.
    pub const BY_DEFAULT: usize = Column::TSimulated as usize + 1;

    /// Its description.
    pub fn entry(self) -> &'static Entry {
        &TABLE[self as usize]
    }
}

/// The rows of the table in docs/columns.md.
pub fn rows() -> String {
    let row = |entry: &Entry| {
        let kind = match entry.kind {
            ColumnKind::Class | ColumnKind::Status => "code, u8",
            ColumnKind::Count => "u32",
            ColumnKind::Number | ColumnKind::Time => "f32 or f64",
        };
        let unit = if entry.unit.is_empty() { "–" } else { entry.unit };
        let meaning = entry.meaning.replace('|', "\\|");
        format!("| `{}` | {unit} | {kind} | {meaning} |\n", entry.name)
    };
    TABLE.iter().map(row).collect()
}
