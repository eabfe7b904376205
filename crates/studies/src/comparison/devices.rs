//! A list of devices: a CSV whose heading are keys of a scene and `device`, a name.

use std::collections::BTreeMap;

use serde_json::{Map, Value, json};

use crate::sheet::{Cell, Row, Rows, Sheet, TableError};
use topple::Written;
use topple::scene::block::OBJECTS;
use topple::scene::parameters::Section;
use topple::scene::record::text::printable;
use topple::scene::shown::shown;
use topple::scene::{Directions, Overturn, Parameter, Pressure, SceneBuilder, SceneError, keys};

/// The column of the names.
const NAME: &str = "device";
/// Most devices of a list.
const MOST: usize = 1000;
/// Words of a scene that mean nothing of a device.
const NOT_OF_A_DEVICE: [&str; 3] = ["force", "x", "y"];

/// A device with the scene that it is part of.
#[derive(Debug, Clone, PartialEq)]
pub struct Device {
    /// Its name.
    pub name: String,
    /// What all share, with what the device has of its own.
    pub scene: SceneBuilder,
    /// Its line in the list.
    pub line: usize,
    /// The keys that it has a value of.
    own: Vec<&'static str>,
    /// What all share, and its base has no use of: the numbers of a direction in which it does not move.
    pub left_out: Vec<Parameter>,
}

impl Device {
    /// What is wrong with its scene, with its place in the list.
    pub fn refused(&self, error: &SceneError) -> TableError {
        let own = self.own.contains(&error.key);
        // Of what the list has its columns are told, of the rest its keys.
        let named = |(place, piece): (usize, &str)| match place % 2 {
            1 if self.own.contains(&piece) => format!("the column {piece}"),
            1 => format!("`{piece}`"),
            _ => piece.to_string(),
        };
        let problem: String = error.problem.split('`').enumerate().map(named).collect();
        let problem = match own {
            true => problem,
            false => format!("{}: `{}`: {problem}", shown(&self.name), error.key),
        };
        match own {
            true => TableError::of_cell(self.line, error.key, problem),
            false => TableError::at(self.line, problem),
        }
    }
}

/// A column of the list.
enum Column {
    Name,
    Number(Parameter),
    Word(Section, &'static str),
}

impl Column {
    /// The column of a heading.
    fn named(heading: &str) -> Result<Column, String> {
        let key = heading.replace('-', "_");
        if key == NAME {
            return Ok(Column::Name);
        }
        let own = |section: Section| match section {
            Section::Block | Section::Base | Section::Run => Ok(()),
            Section::Pulse | Section::Record => {
                Err("the motions of the suite shake the base; leave the column out".to_string())
            }
        };
        if let Some(parameter) = Parameter::of_key(&key) {
            return own(parameter.entry().section).map(|()| Column::Number(parameter));
        }
        for section in Section::ALL {
            if let Some(word) = keys::words(section).into_iter().find(|word| *word == key) {
                if NOT_OF_A_DEVICE.contains(&word) {
                    return Err("it is of the whole comparison; leave the column out".into());
                }
                return own(section).map(|()| Column::Word(section, word));
            }
        }
        Err(format!(
            "no key has this name; give `{NAME}` and keys of a scene, as t_h, psi, u_y or isolation (docs/parameters.md)"
        ))
    }

    fn key(&self) -> &'static str {
        match self {
            Column::Name => NAME,
            Column::Number(parameter) => parameter.key(),
            Column::Word(_, word) => word,
        }
    }
}

/// The words that a column may have, where it has no numbers.
fn choices(key: &str) -> Vec<String> {
    fn all<T: Written>() -> Vec<String> {
        T::ALL.iter().map(|one| one.key().to_string()).collect()
    }
    match key {
        "isolation" => all::<Directions>(),
        "pressure" => all::<Pressure>(),
        "overturn" => all::<Overturn>(),
        "object" => (1..=OBJECTS.len()).map(|number| number.to_string()).collect(),
        // A key that has no words here is refused with any of them.
        _ => Vec::new(),
    }
}

/// The devices of a list, each with what `shared` says of all. Fields that are empty are left out.
///
/// # Errors
/// The line and the column at fault, with what to do.
pub fn read(text: &str, shared: &SceneBuilder) -> Result<Vec<Device>, TableError> {
    let is_words =
        |name: &str| !matches!(Column::named(&name.to_lowercase()), Ok(Column::Number(_)));
    let Some(sheet) = Sheet::of(Rows::of(text, 1, false)?, is_words)? else {
        let problem =
            format!("the list is empty; give a heading with `{NAME}` and keys of a scene");
        return Err(TableError::at(1, problem));
    };
    let columns = columns(&sheet)?;
    let sheet = sheet.without_numbered_comments(text)?;
    let (mut devices, mut lines) = (Vec::<Device>::new(), BTreeMap::new());
    for row in sheet.rows() {
        let row = row?;
        if devices.len() == MOST {
            let problem = format!("more than {MOST} devices; give several lists");
            return Err(TableError::at(row.line, problem));
        }
        let device = device(&sheet, &row, &columns, shared)?;
        if let Some(first) = lines.insert(device.name.clone(), row.line) {
            let name = shown(&device.name);
            let problem =
                format!("the name {name} stands in line {first}, too; give each device its own");
            return Err(TableError::of_cell(row.line, NAME, problem));
        }
        devices.push(device);
    }
    match devices.is_empty() {
        true => Err(TableError::at(1, "no device below the heading; give each a line")),
        false => Ok(devices),
    }
}

/// The columns of the heading with their places.
fn columns(sheet: &Sheet) -> Result<Vec<(usize, Column)>, TableError> {
    let mut columns = Vec::with_capacity(sheet.names.len());
    for (at, heading) in sheet.names.iter().enumerate().filter(|(_, name)| !name.is_empty()) {
        let column = Column::named(&heading.to_lowercase())
            .map_err(|problem| TableError::of_cell(sheet.line, heading, problem))?;
        columns.push((at, column));
    }
    if !columns.iter().any(|(_, column)| matches!(column, Column::Name)) {
        let problem = format!("no column `{NAME}`; give each device a name in it");
        return Err(TableError::at(sheet.line, problem));
    }
    Ok(columns)
}

/// The section of a field, and its value as a file of a scene has it.
fn value(cell: Cell, column: &Column) -> Result<Option<(Section, Value)>, TableError> {
    let text = cell.text;
    match column {
        Column::Name => Ok(None),
        Column::Number(_) if text.contains(':') => {
            let text = shown(text);
            let problem = "has several values; a device has one: give each a line";
            Err(cell.refused(format!("'{text}' {problem}")))
        }
        Column::Number(parameter) => {
            let number = cell.number()?;
            if number.is_some_and(|number| !number.is_finite()) {
                let text = shown(text);
                return Err(cell.refused(format!("'{text}' is no number such as 0.0004; give one")));
            }
            Ok(number.map(|number| (parameter.entry().section, json!(number))))
        }
        Column::Word(section, key) => {
            let known = choices(key);
            if !known.iter().any(|one| one == text) {
                let (text, known) = (shown(text), known.join(", "));
                return Err(cell.refused(format!("'{text}' is not known; give one of {known}")));
            }
            let value = text.parse::<u64>().map_or_else(|_| json!(text), |whole| json!(whole));
            Ok(Some((*section, value)))
        }
    }
}

/// The device of a line.
fn device(
    sheet: &Sheet,
    row: &Row,
    columns: &[(usize, Column)],
    shared: &SceneBuilder,
) -> Result<Device, TableError> {
    // What a scene's file has is read in one way, whatever keys there are.
    let whole = |error: serde_json::Error| {
        TableError::at(row.line, format!("{error}; give values that can be written"))
    };
    let mut scene = serde_json::to_value(shared).map_err(whole)?;
    let (mut name, mut own) = (String::new(), Vec::new());
    for (at, column) in columns {
        let (cell, key) = (sheet.cell(row, *at), column.key());
        if cell.text.is_empty() {
            continue;
        }
        let Some((section, value)) = value(cell, column)? else {
            name = printable(cell.text);
            continue;
        };
        own.push(key);
        let tables = scene
            .as_object_mut()
            .map(|tables| tables.entry(section.key()).or_insert_with(|| Value::Object(Map::new())));
        if let Some(Value::Object(table)) = tables {
            table.insert(key.into(), value);
        }
    }
    if name.is_empty() {
        return Err(TableError::of_cell(row.line, NAME, "empty; give each device a name"));
    }
    let mut scene: SceneBuilder = serde_json::from_value(scene).map_err(whole)?;
    scene.title = Some(name.clone());
    // A factor on the motions is written where a record is, and is none.
    scene.record.clone_from(&shared.record);
    if !own.contains(&"pressure") && topple::Device::of(&scene.numbers) != topple::Device::Pendulum
    {
        // What all share of pendulums is not for other devices.
        scene.pressure = None;
    }
    let isolation = scene.isolation.unwrap_or(Directions::Dual);
    let is_of_all =
        |parameter: &Parameter| scene.numbers.has(*parameter) && !own.contains(&parameter.key());
    let left_out: Vec<Parameter> = isolation.locked().filter(is_of_all).collect();
    left_out.iter().for_each(|parameter| scene.numbers.remove(*parameter));
    Ok(Device { name, scene, line: row.line, own, left_out })
}
