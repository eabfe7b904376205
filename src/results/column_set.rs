//! The columns that a user asks for. What a sweep computes, stores and writes follows from them.

use std::fmt;
use std::str::FromStr;

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::columns::{Column, Entry, TABLE};
use crate::model::asked::Asked;
use crate::scene::SceneError;

/// Some of the columns of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ColumnSet(u32);

impl Default for ColumnSet {
    fn default() -> ColumnSet {
        ColumnSet::ALL
    }
}

impl ColumnSet {
    /// The columns that a map has by default.
    pub const ALL: ColumnSet = ColumnSet((1 << Column::BY_DEFAULT) - 1);

    /// Every column that there is.
    pub const EVERY: ColumnSet = ColumnSet::of(&Column::ALL);

    /// The columns that tell whether a cell has run, and those that pictures and counts need. A sweep always holds them, because
    /// every cell has them anyway.
    const HELD: ColumnSet = ColumnSet::of(&[
        Column::Outcome,
        Column::Impacts,
        Column::Uplifts,
        Column::Status,
        Column::TSimulated,
    ]);

    /// The columns that tell where the model is not valid.
    const FORCES: ColumnSet = ColumnSet::of(&[Column::MinContact, Column::Friction]);

    /// The columns of a list.
    pub const fn of(columns: &[Column]) -> ColumnSet {
        let (mut set, mut next) = (0, 0);
        while next < columns.len() {
            set |= 1 << columns[next] as u32;
            next += 1;
        }
        ColumnSet(set)
    }

    /// The columns of these names; the name `all` stands for those that a map has by default.
    ///
    /// # Errors
    /// The key `columns`: no name, or one that no column has.
    pub fn of_names<N: AsRef<str>>(names: &[N]) -> Result<ColumnSet, SceneError> {
        let all = || TABLE.iter().map(|entry| entry.name).collect::<Vec<_>>().join(", ");
        if names.is_empty() {
            let problem = format!("names none; give some of {}", all());
            return Err(SceneError { key: "columns", problem });
        }
        names.iter().try_fold(ColumnSet(0), |set, name| {
            let name = name.as_ref().trim();
            if name == "all" {
                return Ok(ColumnSet(set.0 | ColumnSet::ALL.0));
            }
            let known = TABLE.iter().find(|entry| entry.name == name);
            known.map(|entry| ColumnSet(set.0 | 1 << entry.column as u32)).ok_or_else(|| {
                let problem = format!("no column is called '{name}'; they are {}", all());
                SceneError { key: "columns", problem }
            })
        })
    }

    /// True where the set contains a column.
    pub fn has(self, column: Column) -> bool {
        self.0 >> column as u32 & 1 == 1
    }

    /// True where the set is that of a map by default.
    pub fn is_all(&self) -> bool {
        *self == ColumnSet::ALL
    }

    /// The descriptions of the columns, in the order of the table.
    pub fn entries(self) -> impl Iterator<Item = &'static Entry> {
        TABLE.iter().filter(move |entry| self.has(entry.column))
    }

    /// The columns, in the order of the table.
    pub fn columns(self) -> impl Iterator<Item = Column> {
        self.entries().map(|entry| entry.column)
    }

    /// The columns of map.csv: it has the simulated time only where that was requested by name.
    pub fn of_table(self) -> impl Iterator<Item = &'static Entry> {
        let whole = self.0 & ColumnSet::ALL.0 == ColumnSet::ALL.0;
        self.entries().filter(move |entry| !whole || entry.column != Column::TSimulated)
    }

    /// The columns that a running sweep saves, and that its map.zarr has.
    pub fn held(self) -> ColumnSet {
        let forces = if self.asked().forces { ColumnSet::FORCES.0 } else { 0 };
        ColumnSet(self.0 | ColumnSet::HELD.0 | forces)
    }

    /// The largest and least values of a motion from which the columns are computed.
    pub fn asked(self) -> Asked {
        let any = |columns: &[Column]| columns.iter().any(|column| self.has(*column));
        Asked {
            angles: any(&[Column::Zeta, Column::MaxPhiLeft, Column::MaxPhiRight]),
            displacements: any(&[Column::MaxU, Column::MaxV, Column::StrokeV]),
            forces: any(&[Column::MinContact, Column::Friction]),
            accelerations: any(&[
                Column::AccPlate,
                Column::AccBlock,
                Column::AccPlateTotal,
                Column::AccBlockTotal,
                Column::BaseLoad,
            ]),
            stops: any(&[Column::StopForce, Column::StopHits]),
        }
    }
}

/// Reads the names of columns, separated by commas.
impl FromStr for ColumnSet {
    type Err = String;

    fn from_str(text: &str) -> Result<ColumnSet, String> {
        let names: Vec<&str> = text.split(',').filter(|name| !name.trim().is_empty()).collect();
        ColumnSet::of_names(&names).map_err(|error| error.problem)
    }
}

/// Writes the names of the columns, separated by commas.
impl fmt::Display for ColumnSet {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.entries().map(|entry| entry.name).collect::<Vec<_>>().join(","))
    }
}

/// A set in JSON and TOML is a list of names.
impl Serialize for ColumnSet {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.entries().map(|entry| entry.name))
    }
}

impl<'de> Deserialize<'de> for ColumnSet {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<ColumnSet, D::Error> {
        let names = Vec::<String>::deserialize(deserializer)?;
        ColumnSet::of_names(&names).map_err(|error| D::Error::custom(error.problem))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_asked_for_by_their_names() {
        let some = ColumnSet::of_names(&["zeta", " outcome"]).unwrap();
        assert_eq!(some.columns().collect::<Vec<_>>(), [Column::Outcome, Column::Zeta]);
        assert_eq!(some.to_string(), "outcome,zeta");
        let text = serde_json::to_string(&some).unwrap();
        assert_eq!(serde_json::from_str::<ColumnSet>(&text).unwrap(), some);
        let problem = |names: &[&str]| ColumnSet::of_names(names).unwrap_err().problem;
        assert!(
            problem(&["zeta", "max_w"])
                .starts_with("no column is called 'max_w'; they are outcome, ")
        );
        assert!(problem(&[]).starts_with("names none"));
        assert!(ColumnSet::of_names(&["all"]).unwrap().is_all());
        let more = ColumnSet::of_names(&["all", "acc_plate"]).unwrap();
        assert!(
            more.has(Column::Zeta) && more.has(Column::AccPlate) && !more.has(Column::AccBlock)
        );
        assert!(more.of_table().all(|entry| entry.column != Column::TSimulated));
    }

    /// Every number of an outcome that is looked for belongs to a group, and each group is requested by its columns alone.
    #[test]
    fn what_is_looked_for_follows_from_the_columns() {
        assert_eq!(ColumnSet::ALL.asked(), Asked::ALL);
        let of = |names: &str| {
            let set = ColumnSet::of_names(&names.split(',').collect::<Vec<_>>()).unwrap();
            let Asked { angles, displacements, forces, accelerations, stops } = set.asked();
            [angles, displacements, forces, accelerations, stops]
        };
        for names in ["zeta", "max_phi_left", "max_phi_right"] {
            assert_eq!(of(names), [true, false, false, false, false]);
        }
        for names in ["max_u", "max_v", "stroke_v"] {
            assert_eq!(of(names), [false, true, false, false, false]);
        }
        for names in ["min_contact", "friction_demand"] {
            assert_eq!(of(names), [false, false, true, false, false]);
        }
        for names in ["acc_plate", "acc_block", "acc_plate_total", "acc_block_total", "base_load"] {
            assert_eq!(of(names), [false, false, false, true, false]);
        }
        for names in ["stop_force", "stop_hits"] {
            assert_eq!(of(names), [false, false, false, false, true]);
        }
        let others = "outcome,impacts,uplifts,t_end,t_uplift,status,t_simulated";
        assert_eq!(of(others), [false; 5]);
        assert_eq!(TABLE.len(), 15 + others.split(',').count());
    }

    #[test]
    fn the_time_simulated_is_in_a_table_where_it_is_asked_for() {
        let has = |set: ColumnSet| set.of_table().any(|entry| entry.column == Column::TSimulated);
        assert!(!has(ColumnSet::ALL));
        assert!(has(ColumnSet::of(&[Column::TSimulated])));
    }
}
