//! Tables as columns: the name, the unit, the meaning and the value of a column stand in one place, and files and arrays are made of them.

use std::borrow::Cow;
use std::io::{self, Write};

use serde::{Serialize, Serializer};
use topple::results::csv::Number;
use topple::scene::Grid;

/// The names of the axes of a grid that was swept.
pub fn keys(grid: &Grid) -> impl Iterator<Item = &'static str> {
    grid.told().into_iter().map(|place| grid.axes()[place].key())
}

/// Their values in a cell.
pub fn values(grid: &Grid, cell: usize) -> Vec<Number> {
    let values: Vec<f64> = grid.coordinates(cell).collect();
    grid.told().into_iter().map(|place| Number(values[place])).collect()
}

/// A value of a table.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Field {
    /// A text.
    Name(String),
    /// A whole number.
    Count(u64),
    /// A number; empty where it is not finite.
    Number(#[serde(serialize_with = "in_digits")] f64),
    /// A number that was rounded, in its digits, without an exponent.
    Rounded(#[serde(serialize_with = "in_decimals")] f64),
    /// Nothing is known.
    Empty,
}

fn in_digits<S: Serializer>(number: &f64, to: S) -> Result<S::Ok, S::Error> {
    number.is_finite().then_some(Number(*number)).serialize(to)
}

fn in_decimals<S: Serializer>(number: &f64, to: S) -> Result<S::Ok, S::Error> {
    to.collect_str(number)
}

impl Field {
    /// The number that a reader of the file has; not a number where there is none.
    pub fn number(&self) -> f64 {
        match *self {
            Field::Count(count) => count as f64,
            // A number of f32 is written in the digits of f32.
            Field::Number(number) if f64::from(number as f32) == number => {
                (number as f32).to_string().parse().unwrap_or(number)
            }
            Field::Number(number) | Field::Rounded(number) => number,
            Field::Name(_) | Field::Empty => f64::NAN,
        }
    }

    /// Its text; empty where it is none.
    pub fn text(&self) -> &str {
        if let Field::Name(name) = self { name } else { "" }
    }
}

macro_rules! fields {
    ($($from:ty: $to:expr;)*) => {$(
        impl From<$from> for Field {
            fn from(value: $from) -> Field {
                $to(value)
            }
        }
    )*};
}

fields! {
    String: Field::Name;
    &'static str: |name: &str| Field::Name(name.into());
    f64: Field::Number;
    u32: |count: u32| Field::Count(count.into());
    usize: |count| Field::Count(count as u64);
    bool: |holds: bool| Field::Count(holds.into());
}

impl<T: Into<Field>> From<Option<T>> for Field {
    fn from(known: Option<T>) -> Field {
        known.map_or(Field::Empty, Into::into)
    }
}

/// What a column is.
#[derive(Debug, Clone)]
pub struct Described {
    /// Its name.
    pub name: Cow<'static, str>,
    /// The unit of its numbers, 1 of shares and counts; none of texts.
    pub unit: Option<&'static str>,
    /// What it means.
    pub meaning: Cow<'static, str>,
}

/// A column of a table whose rows are made of an `R` each.
pub(crate) struct TableColumn<R> {
    about: Described,
    value: Box<dyn Fn(&R) -> Field>,
}

/// The columns of a table.
pub(crate) struct Columns<R>(Vec<TableColumn<R>>);

/// A column of numbers of a unit.
pub(crate) fn number<R, V: Into<Field>>(
    name: impl Into<Cow<'static, str>>,
    unit: &'static str,
    meaning: impl Into<Cow<'static, str>>,
    value: impl Fn(&R) -> V + 'static,
) -> TableColumn<R> {
    let about = Described { name: name.into(), unit: Some(unit), meaning: meaning.into() };
    TableColumn { about, value: Box::new(move |row| value(row).into()) }
}

impl<R> Columns<R> {
    /// None so far.
    pub fn new() -> Columns<R> {
        Columns(Vec::new())
    }

    /// Adds a column of texts.
    pub fn text<V: Into<Field>>(
        mut self,
        name: &'static str,
        meaning: &'static str,
        value: impl Fn(&R) -> V + 'static,
    ) -> Columns<R> {
        let about = Described { name: name.into(), unit: None, meaning: meaning.into() };
        self.0.push(TableColumn { about, value: Box::new(move |row| value(row).into()) });
        self
    }

    /// Adds a column of numbers of a unit.
    pub fn number<V: Into<Field>>(
        self,
        name: &'static str,
        unit: &'static str,
        meaning: impl Into<Cow<'static, str>>,
        value: impl Fn(&R) -> V + 'static,
    ) -> Columns<R> {
        self.with([number(name, unit, meaning, value)])
    }

    /// Adds columns.
    pub fn with(mut self, columns: impl IntoIterator<Item = TableColumn<R>>) -> Columns<R> {
        self.0.extend(columns);
        self
    }
}

/// A table whose rows are made as they are needed.
pub struct Table<'a> {
    /// The grid whose cells have rows, which begin with its axes; none of a table that has no axes.
    grid: Option<&'a Grid>,
    columns: Vec<Described>,
    /// The cell of each row, and its fields after the axes.
    rows: Box<dyn Iterator<Item = (usize, Vec<Field>)> + 'a>,
}

/// A column with a value of each row.
pub type TableValues = (Described, Vec<Field>);

impl<'a> Table<'a> {
    /// That of a grid, each of whose rows is of a cell.
    pub(crate) fn of_cells<R: 'a>(
        grid: &'a Grid,
        columns: Columns<R>,
        rows: impl Iterator<Item = (usize, R)> + 'a,
    ) -> Table<'a> {
        Table { grid: Some(grid), ..Table::of_rows(columns, rows) }
    }

    /// One without axes; each of its rows has a number that means nothing.
    pub(crate) fn of_rows<R: 'a>(
        columns: Columns<R>,
        rows: impl Iterator<Item = (usize, R)> + 'a,
    ) -> Table<'a> {
        let (columns, value): (Vec<_>, Vec<_>) =
            columns.0.into_iter().map(|column| (column.about, column.value)).unzip();
        let fields =
            move |(cell, row): (usize, R)| (cell, value.iter().map(|value| value(&row)).collect());
        Table { grid: None, columns, rows: Box::new(rows.map(fields)) }
    }

    /// Writes it as CSV: a header, then the rows.
    pub fn write(self, writer: impl Write) -> io::Result<()> {
        let Table { grid, columns, rows } = self;
        let mut csv = csv::Writer::from_writer(writer);
        for key in grid.into_iter().flat_map(keys) {
            csv.write_field(key)?;
        }
        csv.write_record(columns.iter().map(|column| column.name.as_bytes()))?;
        for (cell, fields) in rows {
            csv.serialize((grid.map(|grid| values(grid, cell)).unwrap_or_default(), fields))?;
        }
        csv.flush()
    }

    /// The cell of each row, and the columns after the axes.
    pub fn into_columns(self) -> (Vec<usize>, Vec<TableValues>) {
        let mut columns: Vec<TableValues> =
            self.columns.into_iter().map(|about| (about, Vec::new())).collect();
        let mut cells = Vec::new();
        for (cell, fields) in self.rows {
            cells.push(cell);
            columns.iter_mut().zip(fields).for_each(|((_, values), field)| values.push(field));
        }
        (cells, columns)
    }
}
