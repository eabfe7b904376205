//! Texts of tables, lists, names and distributions: what is read of each, and what is refused.

use std::fmt::{Debug, Display};
use std::fs;

use tempfile::TempDir;
use topple::scene::{Parameter, SceneBuilder, Values};
use topple_studies::comparison::devices::{self, Device};
use topple_studies::sheet::{Rows, Sheet, TableError, comments, row_in_comment};
use topple_studies::suites::{Suite, names, processing};
use topple_studies::{Distribution, Varied};

use crate::told::told;

/// What was read, or why it was not.
fn read(known: Result<impl Debug, impl Display>) -> String {
    known.map_or_else(|why| format!("refused: {why}"), |known| format!("{known:?}"))
}

/// What was read, as it is written.
fn written(known: Result<impl Display, impl Display>) -> String {
    known.map_or_else(|why| format!("refused: {why}"), |known| known.to_string())
}

/// The lines and the cells of rows.
fn rows(text: &str, blanks: bool) -> Result<Vec<(usize, Vec<String>)>, TableError> {
    let of =
        |cells: Vec<std::borrow::Cow<str>>| cells.iter().map(|cell| cell.to_string()).collect();
    Rows::of(text, 1, blanks)?.map(|row| row.map(|row| (row.line, of(row.cells)))).collect()
}

/// How many rows a sheet has.
fn sheet(text: &str) -> Result<usize, TableError> {
    let sheet = Sheet::of(Rows::of(text, 1, false)?, |_| false)?.unwrap();
    Ok(sheet.rows().collect::<Result<Vec<_>, _>>()?.len())
}

/// The numbers of the first row of a sheet, and of a column that it has not.
fn numbers(text: &str) -> String {
    let rows = Rows::of(text, 1, false).unwrap();
    let sheet = Sheet::of(rows, |name| name == "device").unwrap().unwrap();
    let row = sheet.rows().next().unwrap().unwrap();
    [0, 1, 7].map(|at| read(sheet.cell(&row, at).number())).join(", ")
}

/// The names, lines and periods of devices.
fn list_of_devices(text: &str) -> Result<Vec<String>, TableError> {
    let shared = SceneBuilder::object(1).with(Parameter::XiV, 0.2).with(Parameter::UY, 0.01);
    let of = |device: &Device| {
        let t_h = device.scene.numbers.get(Parameter::TH).map(Values::first);
        format!("{} in line {}, T_h {t_h:?}", device.name, device.line)
    };
    Ok(devices::read(text, &shared)?.iter().map(of).collect())
}

/// What is said of a list of motions without files.
fn list_of_motions(text: &str) -> String {
    let folder = TempDir::new().unwrap();
    let list = folder.path().join("mine.csv");
    fs::write(&list, text).unwrap();
    let told = read(Suite::read(&list, false).map(|suite| suite.motions().count()));
    told.replace(&format!("{}/", folder.path().display()), "")
}

fn varied(text: &str, force: bool) -> String {
    let varied = text.parse::<Varied>().map_err(|why| why.to_string());
    let checked =
        |varied: Varied| varied.check(force).map(|()| varied).map_err(|why| why.to_string());
    written(varied.and_then(checked))
}

#[test]
fn texts_are_read_or_refused() {
    told("texts", |section, text| {
        Some(match section {
            "rows" => read(rows(text, true)),
            "rows that no blanks part" => read(rows(text, false)),
            "comments" => format!("{:?}", comments(text).collect::<Vec<_>>()),
            "separator" => format!("{:?}", Rows::of(text, 1, true).unwrap().separator()),
            "sheet" => read(sheet(text)),
            "row in a comment" => row_in_comment(text).unwrap_or("none".into()),
            "cells" => numbers(text),
            "devices" => read(list_of_devices(text)),
            "list of motions" => list_of_motions(text),
            "name of a file" => {
                let named = names::read(text);
                format!("{:?}", named.map(|named| (named.group, named.component)))
            }
            "stream of a file" => format!("{:?}", processing::of_name(text)),
            "distribution" => written(text.parse::<Distribution>()),
            "number that varies" => varied(text, false),
            "number that varies, forced" => varied(text, true),
            other => panic!("nothing is called {other}"),
        })
    });
}
