//! A list of devices: a CSV whose heading are keys of a scene and `device`, a name.

use std::collections::BTreeMap;

use serde_json::{Map, Value, json};

use super::devices_error::DevicesError;
use crate::suites::delimited;
use topple::scene::parameters::Section;
use topple::scene::record::text::printable;
use topple::scene::shown::shown;
use topple::scene::{Directions, Parameter, SceneBuilder, SceneError, keys};

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
    pub line: u64,
    /// The keys that it has a value of.
    own: Vec<&'static str>,
    /// What all share, and its base has no use of: the numbers of a direction in which it does not move.
    pub left_out: Vec<Parameter>,
}

impl Device {
    /// What is wrong with its scene, with its place in the list.
    pub fn refused(&self, error: &SceneError) -> DevicesError {
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
        DevicesError { line: self.line, column: own.then(|| error.key.into()), problem }
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

/// The devices of a list, each with what `shared` says of all. Fields that are empty are left out.
///
/// # Errors
/// The line and the column at fault, with what to do.
pub fn read(text: &str, shared: &SceneBuilder) -> Result<Vec<Device>, DevicesError> {
    let refused = |line: u64, column: Option<&str>, problem: String| DevicesError {
        line,
        column: column.map(String::from),
        problem,
    };
    let plain = delimited::plain(text.trim_start_matches('\u{feff}'));
    let heading = plain.lines().find(|line| !line.trim().is_empty()).unwrap_or_default();
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .trim(csv::Trim::All)
        .flexible(true)
        .delimiter(delimited::separator(heading) as u8)
        .from_reader(plain.as_bytes());
    let mut columns: Option<Vec<Column>> = None;
    let (mut devices, mut lines) = (Vec::<Device>::new(), BTreeMap::new());
    for row in reader.records() {
        let row = row.map_err(|error| {
            let at = error.position().map_or(1, csv::Position::line);
            refused(at, None, format!("{error}; give text with commas between"))
        })?;
        let line = row.position().map_or(1, |at| delimited::line(&plain, at) as u64);
        if row.iter().all(str::is_empty) {
            continue;
        }
        let Some(columns) = &columns else {
            columns = Some(headings(&row, line)?);
            continue;
        };
        if row.len() != columns.len() {
            let [own, wanted] = [row.len(), columns.len()];
            let problem =
                format!("{own} fields where the heading has {wanted}; give each column a field");
            return Err(refused(line, None, problem));
        }
        if devices.len() == MOST {
            let problem = format!("more than {MOST} devices; give several lists");
            return Err(refused(line, None, problem));
        }
        let device = device(&row, line, columns, shared)?;
        if let Some(first) = lines.insert(device.name.clone(), line) {
            let problem = format!(
                "the name {} stands in line {first}, too; give each device its own",
                shown(&device.name)
            );
            return Err(refused(line, Some(NAME), problem));
        }
        devices.push(device);
    }
    if devices.is_empty() {
        let problem = match columns {
            None => format!("the list is empty; give a heading with `{NAME}` and keys of a scene"),
            Some(_) => "no device below the heading; give each a line".to_string(),
        };
        return Err(refused(1, None, problem));
    }
    Ok(devices)
}

/// The columns of the heading.
fn headings(row: &csv::StringRecord, line: u64) -> Result<Vec<Column>, DevicesError> {
    let refused =
        |column: &str, problem: String| DevicesError { line, column: Some(column.into()), problem };
    let mut columns: Vec<Column> = Vec::with_capacity(row.len());
    for heading in row {
        let heading = heading.to_lowercase();
        let column = Column::named(&heading).map_err(|problem| refused(&heading, problem))?;
        if columns.iter().any(|other| other.key() == column.key()) {
            return Err(refused(&heading, "it stands twice; leave one out".into()));
        }
        columns.push(column);
    }
    if !columns.iter().any(|column| matches!(column, Column::Name)) {
        let problem = format!("no column `{NAME}`; give each device a name in it");
        return Err(DevicesError { line, column: None, problem });
    }
    Ok(columns)
}

/// The device of a line.
fn device(
    row: &csv::StringRecord,
    line: u64,
    columns: &[Column],
    shared: &SceneBuilder,
) -> Result<Device, DevicesError> {
    let refused =
        |column: &str, problem: String| DevicesError { line, column: Some(column.into()), problem };
    // What a scene's file has is read in one way, whatever keys there are.
    let whole = |error: serde_json::Error| DevicesError {
        line,
        column: None,
        problem: format!("{error}; give values that can be written"),
    };
    let mut scene = serde_json::to_value(shared).map_err(whole)?;
    let (mut name, mut own) = (String::new(), Vec::new());
    for (column, field) in columns.iter().zip(row) {
        let key = column.key();
        if field.is_empty() {
            continue;
        }
        let (section, value) = match column {
            Column::Name => {
                name = printable(field);
                continue;
            }
            Column::Number(parameter) => {
                let number = delimited::number(field).filter(|number| number.is_finite());
                let number = number.ok_or_else(|| {
                    let problem = match field.contains(':') {
                        true => "has several values; a device has one: give each a line",
                        false => "is no number such as 0.0004 or 4e-4; give it without its unit",
                    };
                    refused(key, format!("'{}' {problem}", shown(field)))
                })?;
                (parameter.entry().section, json!(number))
            }
            Column::Word(section, _) => {
                let value =
                    field.parse::<u64>().map_or_else(|_| json!(field), |whole| json!(whole));
                (*section, value)
            }
        };
        // Alone it tells what is wrong with it, and nothing else.
        let alone = json!({ section.key(): { key: value } });
        if let Err(error) = serde_json::from_value::<SceneBuilder>(alone) {
            return Err(refused(key, format!("{error}; give one that is known")));
        }
        own.push(key);
        let tables = scene
            .as_object_mut()
            .map(|tables| tables.entry(section.key()).or_insert_with(|| Value::Object(Map::new())));
        if let Some(Value::Object(table)) = tables {
            table.insert(key.into(), value);
        }
    }
    if name.is_empty() {
        return Err(refused(NAME, "empty; give each device a name".into()));
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
    Ok(Device { name, scene, line, own, left_out })
}

#[cfg(test)]
mod tests {
    use super::read;
    use topple::scene::{Directions, Parameter, SceneBuilder, Values};

    fn shared() -> SceneBuilder {
        SceneBuilder::object(1).with(Parameter::XiV, 0.2).with(Parameter::UY, 0.01)
    }

    #[test]
    fn a_device_is_what_all_share_with_what_it_has_of_its_own() {
        let text = "device,t_h,isolation,XI-V,object\n\"soft, old\",2.5,dual,,\nnone,,none,0.1,2\nrigid,,none,,\n";
        let devices = read(text, &shared()).unwrap();
        let [soft, none, rigid] = &devices[..] else { panic!("{devices:?}") };
        assert_eq!((soft.name.as_str(), soft.line), ("soft, old", 2));
        let number = |device: &super::Device, parameter| {
            device.scene.numbers.get(parameter).and_then(Values::single)
        };
        assert_eq!(number(soft, Parameter::TH), Some(2.5));
        assert_eq!(number(soft, Parameter::XiV), Some(0.2));
        assert_eq!(number(soft, Parameter::UY), Some(0.01));
        assert_eq!((soft.scene.object, soft.scene.isolation), (Some(1), Some(Directions::Dual)));
        assert_eq!((none.scene.object, none.scene.isolation), (Some(2), Some(Directions::None)));
        assert_eq!((number(none, Parameter::TH), number(none, Parameter::XiV)), (None, Some(0.1)));
        // What all share means nothing of a base that does not move; its own stays, to be refused.
        assert_eq!((number(rigid, Parameter::XiV), number(rigid, Parameter::UY)), (None, None));
        assert!(
            rigid.left_out.contains(&Parameter::XiV) && rigid.left_out.contains(&Parameter::UY)
        );
        assert_eq!((&soft.left_out[..], &none.left_out[..]), (&[][..], &[Parameter::UY][..]));
    }

    #[test]
    fn a_name_is_one_line() {
        let devices = read("device,t_h\n\"A\nB\u{1b}[2J\",1\n", &shared()).unwrap();
        assert_eq!(devices[0].name, "A B[2J");
        let error = read("device,t_h\n\"A\nB\",1\nA B,2\n", &shared()).unwrap_err().to_string();
        assert!(error.contains("the name A B stands in line 2, too"), "{error}");
    }

    #[test]
    fn what_spreadsheets_save_is_read() {
        let text = "\u{feff}sep=;\r\ndevice;t_h\r\n\r\na;1,5\r\nb;2\r\n";
        let devices = read(text, &shared()).unwrap();
        let t_h: Vec<f64> = devices
            .iter()
            .map(|one| one.scene.numbers.get(Parameter::TH).unwrap().first())
            .collect();
        assert_eq!((t_h, devices[1].line), (vec![1.5, 2.0], 5));
    }

    #[test]
    fn what_is_wrong_is_told_with_its_place() {
        let refused = |text: &str| read(text, &shared()).unwrap_err().to_string();
        for (text, wanted) in [
            ("", "line 1: the list is empty; give a heading with `device`"),
            ("device,t_h\n", "line 1: no device below the heading"),
            ("name,t_h\na,1\n", "line 1, column name: no key has this name"),
            ("t_h,t_v\n1,1\n", "line 1: no column `device`"),
            ("device,t_h,t-h\na,1,1\n", "line 1, column t-h: it stands twice"),
            ("device,omega\na,1\n", "line 1, column omega: the motions of the suite shake"),
            ("device,dt\na,1\n", "line 1, column dt: the motions of the suite shake"),
            ("device,force\na,true\n", "line 1, column force: it is of the whole comparison"),
            ("device,t_h\na,1\na,2\n", "line 3, column device: the name a stands in line 2, too"),
            ("device,t_h\na,1\n\n,2\n", "line 4, column device: empty; give each device a name"),
            ("device,t_h\na,fast\n", "line 2, column t_h: 'fast' is no number such as"),
            ("device,t_h\na,1:2:3\n", "line 2, column t_h: '1:2:3' has several values"),
            ("device,t_h\na,nan\n", "line 2, column t_h: 'nan' is no number"),
            ("device,t_h\na\n", "line 2: 1 fields where the heading has 2"),
            ("device,isolation\na,sideways\n", "line 2, column isolation: "),
            ("device,object\na,one\n", "line 2, column object: "),
        ] {
            let line = refused(text);
            assert!(line.starts_with(wanted) && !line.contains('\n'), "{text:?}: {line}");
        }
    }
}
