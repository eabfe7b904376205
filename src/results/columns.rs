//! Every column of a map, defined once: columns in memory and on disk, map.csv, map.npz, map.zarr and
//! docs/columns.md are made of this table.

use crate::stepping::outcome::{Class, Outcome, Status};

/// What is known of a cell, a name each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Column {
    /// The class.
    Outcome,
    /// The impacts.
    Impacts,
    /// The uplifts.
    Uplifts,
    /// The end, s.
    TEnd,
    /// The first uplift, s.
    TUplift,
    /// The rocking index.
    Zeta,
    /// The largest phi about the left corner, rad.
    MaxPhiLeft,
    /// The largest -phi about the right corner, rad.
    MaxPhiRight,
    /// The largest |u|, m.
    MaxU,
    /// The largest |v|, m.
    MaxV,
    /// The largest |v + g/omega_v^2|, m.
    StrokeV,
    /// The least contact force over M, m/s^2.
    MinContact,
    /// The friction asked for.
    Friction,
    /// How the integration ended.
    Status,
    /// The time simulated, s.
    TSimulated,
}

/// What a column holds.
#[derive(Clone, Copy)]
pub enum Holds {
    /// A class by its name, as a number its place in [`Class::ALL`].
    Class,
    /// A status by its name, as a number its place in [`STATUS_NAMES`].
    Status,
    /// A number of events.
    Count {
        /// Of a cell.
        get: fn(&Outcome) -> u32,
        /// Its place.
        place: fn(&mut Outcome) -> &mut u32,
        /// Of as many cells as there is room for.
        counts: fn(&[Outcome], &mut [u32]),
    },
    /// A number.
    Number {
        /// Of a cell.
        get: fn(&Outcome) -> f64,
        /// Its place.
        place: fn(&mut Outcome) -> &mut f64,
        /// Of as many cells as there is room for.
        singles: fn(&[Outcome], &mut [f32]),
        /// The same in f64.
        doubles: fn(&[Outcome], &mut [f64]),
    },
    /// A time that not every cell has.
    Time {
        /// Of a cell.
        get: fn(&Outcome) -> Option<f64>,
        /// Its place.
        place: fn(&mut Outcome) -> &mut Option<f64>,
        /// Of as many cells as there is room for; what has no time is not a number.
        singles: fn(&[Outcome], &mut [f32]),
        /// The same in f64.
        doubles: fn(&[Outcome], &mut [f64]),
    },
}

impl Holds {
    /// A cell's value as a number: a code, a count; of a time that it does not have, none at all.
    pub fn number(&self, cell: &Outcome) -> f64 {
        match self {
            Holds::Class => f64::from(class_code(cell.class)),
            Holds::Status => f64::from(status_code(cell.status)),
            Holds::Count { get, .. } => f64::from(get(cell)),
            Holds::Number { get, .. } => get(cell),
            Holds::Time { get, .. } => get(cell).unwrap_or(f64::NAN),
        }
    }
}

/// What is known of a column.
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
    pub holds: Holds,
}

/// The names of statuses in files, by their codes.
pub const STATUS_NAMES: [&str; 6] =
    ["ok", "event_limit", "diverged", "step_limit", "vertical_locked", "undecided"];

/// Of each cell a value. A call of a pointer for each cell would take most of the time of making columns: the
/// pointers of [`Holds`] are to loops.
pub(super) fn each<T>(cells: &[Outcome], values: &mut [T], value: impl Fn(&Outcome) -> T) {
    for (place, cell) in values.iter_mut().zip(cells) {
        *place = value(cell);
    }
}

macro_rules! number {
    ($field:ident) => {
        Holds::Number {
            get: |cell| cell.$field,
            place: |cell| &mut cell.$field,
            singles: |cells, values| each(cells, values, |cell| cell.$field as f32),
            doubles: |cells, values| each(cells, values, |cell| cell.$field),
        }
    };
}

macro_rules! count {
    ($field:ident) => {
        Holds::Count {
            get: |cell| cell.$field,
            place: |cell| &mut cell.$field,
            counts: |cells, values| each(cells, values, |cell| cell.$field),
        }
    };
}

const fn entry(
    column: Column,
    (name, unit): (&'static str, &'static str),
    holds: Holds,
    meaning: &'static str,
) -> Entry {
    Entry { column, name, unit, meaning, holds }
}

/// The table, in the order of [`Column`].
pub const TABLE: [Entry; 15] = [
    entry(
        Column::Outcome,
        ("outcome", ""),
        Holds::Class,
        "outcome: full_contact, rocking, overturned_left, overturned_right, unresolved",
    ),
    entry(
        Column::Impacts,
        ("impacts", ""),
        count!(impacts),
        "impacts up to t_end; of a cell that ended early, up to t_simulated",
    ),
    entry(Column::Uplifts, ("uplifts", ""), count!(uplifts), "uplifts from full contact"),
    entry(Column::TEnd, ("t_end", "s"), number!(t_end), "time of overturning, or the run's end"),
    entry(
        Column::TUplift,
        ("t_uplift", "s"),
        Holds::Time {
            get: |cell| cell.t_uplift,
            place: |cell| &mut cell.t_uplift,
            singles: |cells, values| {
                each(cells, values, |cell| cell.t_uplift.map_or(f32::NAN, |t| t as f32));
            },
            doubles: |cells, values| {
                each(cells, values, |cell| cell.t_uplift.unwrap_or(f64::NAN));
            },
        },
        "time of the first uplift; empty, or not a number, where there is none",
    ),
    entry(
        Column::Zeta,
        ("zeta", ""),
        number!(zeta),
        "largest |φ| over the critical angle of its side; 1 when overturned",
    ),
    entry(
        Column::MaxPhiLeft,
        ("max_phi_left", "rad"),
        number!(max_phi_left),
        "largest rotation about the left corner",
    ),
    entry(
        Column::MaxPhiRight,
        ("max_phi_right", "rad"),
        number!(max_phi_right),
        "largest rotation about the right corner",
    ),
    entry(Column::MaxU, ("max_u", "m"), number!(max_u), "largest |u|"),
    entry(Column::MaxV, ("max_v", "m"), number!(max_v), "largest |v|, with the static deflection"),
    entry(
        Column::StrokeV,
        ("stroke_v", "m"),
        number!(stroke_v),
        "largest |v + g/ω_v²|: from the static position",
    ),
    entry(
        Column::MinContact,
        ("min_contact", "m/s²"),
        number!(min_contact),
        "least normal force between block and base over M; below zero the model does not hold",
    ),
    entry(
        Column::Friction,
        ("friction_demand", ""),
        number!(friction),
        "friction coefficient that keeps the block from sliding: largest |horizontal| over normal force while the latter is \
         positive; it grows without bound as that force nears zero",
    ),
    entry(
        Column::Status,
        ("status", ""),
        Holds::Status,
        "how the integration ended: ok, event_limit, diverged, step_limit, vertical_locked, undecided",
    ),
    entry(
        Column::TSimulated,
        ("t_simulated", "s"),
        number!(t_simulated),
        "time up to which the cell was simulated: t_end, or the earlier time at which an energy bound proved that its \
         results can no longer change",
    ),
];

impl Column {
    /// Every column there is.
    pub const ALL: [Column; TABLE.len()] = {
        let mut all = [Column::Outcome; TABLE.len()];
        let mut index = 0;
        while index < all.len() {
            all[index] = TABLE[index].column;
            index += 1;
        }
        all
    };

    /// What is known of it.
    pub fn entry(self) -> &'static Entry {
        &TABLE[self as usize]
    }

    /// Those of map.csv.
    pub fn of_table() -> impl Iterator<Item = &'static Entry> {
        TABLE.iter().filter(|entry| entry.column != Column::TSimulated)
    }
}

/// The code of a class.
pub fn class_code(class: Class) -> u8 {
    class as u8
}

/// The code of a status; one that was proved, the second, is as good as one that ran to its end, the first.
pub fn status_code(status: Status) -> u8 {
    (status as u8).saturating_sub(1)
}

const HEAD: &str = "# Columns

Generated from the table in `src/results/columns.rs`; `TOPPLE_WRITE_DOCS=1 cargo test --test app parameters::` writes this page again.

`map.csv` has a row a cell: its place along each axis (columns named by the axes' keys, [parameters.md](parameters.md)), then
the columns below in this order, but for `t_simulated`. `map.npz` holds each as an array with an index for each axis, the
first axis last: (A_h, Ω) for a map over (Ω, A_h). Names are codes there. Numbers are f32 where the sweep was (`--precision`),
axes f64. The array `proved` is true for a cell that ended early: an energy bound shows that its results
can no longer change (its impacts are counted up to `t_simulated`), and `about`, a text in JSON: units, meanings, the names of the codes, the scene,
the version.

```python
import json, numpy
z = numpy.load(\"map.npz\")
about = json.loads(str(z[\"about\"]))
left = z[\"outcome\"] == about[\"outcome\"].index(\"overturned_left\")
```

| column | unit | type | meaning |
|---|---|---|---|
";

const TAIL: &str = "
## map.zarr

`--files zarr` writes the same arrays as a Zarr group, version 3, in chunks of 65,536 to 1,048,576 cells; a map of more than
16.7 million cells is written so alone (`--files csv,npz` writes them, too). xarray and dask open it by themselves:

```python
import xarray
ds = xarray.open_zarr(\"map.zarr\")
ds.zeta.sel(omega=9.0, method=\"nearest\").max().compute()
ds.outcome.attrs[\"flag_meanings\"], ds.zeta.attrs[\"long_name\"], ds.attrs[\"scene\"]
```

Each array has its axes as dimensions, with `units`, `long_name` and, of codes, `flag_values` and `flag_meanings` (CF
conventions); the group has what `about` has in map.npz. Codecs are `bytes` (little-endian), `gzip` (level 1) and `crc32c`, all
of the core specification. The same group is what an unfinished run saves its tiles in ([interrupted.md](interrupted.md)):
there `status` is 255 for a cell that has not run. `leaves.zarr` of a [refined map](refined.md) is such a group over the dimension `leaf`.

topple writes these files itself, some 300 lines with flate2 and crc32c: the crate zarrs (0.23, features crc32c and zstd
only) brings 47 crates and takes 195 s of a release build on two cores, 330 s of processor time, where the whole of topple took
241 s. `python benches/files/open.py DIR` opens map.zarr by xarray, map.npz by numpy, and compares them.
";

/// The page docs/columns.md.
pub fn page() -> String {
    let mut page = String::from(HEAD);
    for entry in &TABLE {
        let kind = match entry.holds {
            Holds::Class | Holds::Status => "code, u8",
            Holds::Count { .. } => "u32",
            Holds::Number { .. } | Holds::Time { .. } => "f32 or f64",
        };
        let unit = if entry.unit.is_empty() { "–" } else { entry.unit };
        let meaning = entry.meaning.replace('|', "\\|");
        page.push_str(&format!("| `{}` | {unit} | {kind} | {meaning} |\n", entry.name));
    }
    page.push_str(TAIL);
    page
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_in_the_order_of_its_columns() {
        for (index, entry) in TABLE.iter().enumerate() {
            assert_eq!(entry.column as usize, index, "{}", entry.name);
        }
    }

    #[test]
    fn every_class_and_status_has_a_code() {
        for (index, class) in Class::ALL.into_iter().enumerate() {
            assert_eq!(usize::from(class_code(class)), index);
        }
        for status in Status::ALL {
            assert_eq!(STATUS_NAMES[usize::from(status_code(status))], status.name());
        }
    }
}
