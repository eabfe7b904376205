//! Tables and arrays of a map, written and read back.

use topple::model::precision::Precision;
use topple::results::block::Block;
use topple::results::chunking::Chunking;
use topple::results::column_set::ColumnSet;
use topple::results::columns::{Column, Shown};
use topple::results::csv;
use topple::results::outcomes::Outcomes as _;
use topple::results::reader::BlocksInMemory;
use topple::scene::Grid;
use topple::stepping::outcome::{Class, Outcome, Status};

use crate::common::object;

/// Outcomes with every kind of value: none, not a number, infinite, of f32 and of f64, whole, small and large.
fn outcomes(cells: usize) -> Vec<Outcome> {
    let numbers = [0.0, -0.0, 1.0, 0.1, f64::from(0.1_f32), 1.0e-300, 1.0e300, f64::INFINITY];
    let cell = |k: usize| Outcome {
        class: Class::ALL[k % 5],
        status: Status::ALL[k % Status::ALL.len()],
        impacts: 3 * k as u32,
        t_end: numbers[k % numbers.len()],
        t_uplift: (!k.is_multiple_of(3)).then_some(k as f64 / 7.0),
        zeta: if k.is_multiple_of(4) { f64::NAN } else { k as f64 },
        max_u: -(k as f64),
        ..Outcome::PENDING
    };
    (0..cells).map(cell).collect()
}

fn written(grid: &Grid, outcomes: &[Outcome], columns: &[&str]) -> String {
    let mut table = Vec::new();
    let columns = ColumnSet::of_names(columns).unwrap();
    csv::write(grid, &outcomes.to_vec(), columns, &mut table).unwrap();
    String::from_utf8(table).unwrap()
}

/// A program that reads CSV finds in map.csv the axes and the values of each cell, numbers to the last bit.
#[test]
fn a_table_is_read_back() {
    let grid = Grid::of(&object(1, 0.2, (1.75, 0.75), 0.0, "0.1:0.3:7", "1:2:3"));
    let outcomes = outcomes(grid.len());
    let text = written(&grid, &outcomes, &["all", "t_simulated"]);
    let mut reader = ::csv::Reader::from_reader(text.as_bytes());
    let names: Vec<String> = reader.headers().unwrap().iter().map(String::from).collect();
    assert_eq!(names[..2], ["omega", "a_h"]);
    let mut rows = 0;
    for (number, row) in reader.records().enumerate() {
        let row = row.unwrap();
        let axes = grid.coordinates(number).zip(&row);
        axes.for_each(|(value, field)| assert_eq!(field.parse::<f64>().unwrap(), value));
        for (name, field) in names.iter().zip(&row).skip(2) {
            let entry = Column::ALL.into_iter().map(Column::entry).find(|entry| entry.name == name);
            // Of a number of f32 the digits are those that tell it from others of f32.
            let single: f64 = field.parse::<f32>().map_or(f64::NAN, f64::from);
            let bits = |value: f64| value.to_bits();
            match entry.unwrap().shown(&outcomes[number]) {
                Shown::Code(_, code) => assert_eq!(field, code),
                Shown::Count(count) => assert_eq!(field.parse::<u32>().unwrap(), count),
                Shown::Number(value) if value.is_nan() => assert_eq!(field, "NaN"),
                Shown::Number(value) | Shown::Time(Some(value)) => {
                    let read = [field.parse().unwrap(), single].map(bits);
                    assert!(read.contains(&bits(value)), "{name}: {field} for {value}");
                }
                Shown::Time(None) => assert_eq!(field, ""),
            }
        }
        rows += 1;
    }
    assert_eq!(rows, grid.len());
}

/// A column of some cells is that of their outcomes, whatever the blocks in which they stay and the number types.
#[test]
fn a_column_is_that_of_the_outcomes() {
    let outcomes = outcomes(99);
    for (held, asked) in [(Precision::F32, Precision::F64), (Precision::F64, Precision::F32)] {
        let chunking = Chunking::with(vec![99], 40);
        let block = |chunk| Block::of_outcomes(&outcomes[chunking.cells(chunk)], held);
        let blocks = (0..chunking.count()).map(block).collect();
        let kept = BlocksInMemory::new(chunking.clone(), blocks);
        let read = Block::of_outcomes(&outcomes, held).to_outcomes();
        for column in Column::ALL {
            let one = kept.column(7..91, column, asked).unwrap();
            let other = read.column(7..91, column, asked).unwrap();
            assert_eq!(one.to_bytes(), other.to_bytes(), "{column:?}");
        }
    }
}
