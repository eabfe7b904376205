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
        for (text, wanted) in [
            ("device,t_h,,\na,1.5,,\nb,2,,\n,,,\n", [1.5, 2.0]),
            ("device,t_h,,\na,1.5\nb,2,,,,\n", [1.5, 2.0]),
            (
                "#TYPE System.Object\n\"device\",\"t_h\"\n# stiff\n\"a\",\"1.5\"\n#c,3\n\"b\",\"2\"\n",
                [1.5, 2.0],
            ),
            ("device,,t_h\n\"#1\",,1.5\nb,,2.000\n", [1.5, 2.0]),
            ("device;t_h\na;1,5\nb;1,250\n", [1.5, 1.25]),
            ("device;t_h\na;1.5\nb;1.250\n", [1.5, 1.25]),
            ("device\tt_h\na\t1,5\nb\t1,250\n", [1.5, 1.25]),
        ] {
            let devices = read(text, &shared()).unwrap();
            let t_h = |at: usize| devices[at].scene.numbers.get(Parameter::TH).unwrap().first();
            assert_eq!((devices.len(), [t_h(0), t_h(1)]), (2, wanted), "{text:?}");
        }
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
            ("device,t_h,,\na,1,,2\n", "line 2: '2' stands in a column without a name"),
            ("device,t_h\n#1,2\nb,2\n", "line 2: `#` begins a comment, and this one has the cells"),
            ("device,t_h\n\"a,2\nb,2\n", "line 2: a cell begins with a quote"),
            (
                "device,isolation\na,Horizontal\n",
                "line 2, column isolation: 'Horizontal' is not known; give one of dual, horizontal, vertical, none",
            ),
            (
                "device,isolation,t_h\n-,-,s\n",
                "line 2, column isolation: '-' is not known; give one",
            ),
            (
                "device,pressure\na,on\n",
                "line 2, column pressure: 'on' is not known; give one of follows, constant",
            ),
            (
                "device,object\na,one\n",
                "line 2, column object: 'one' is not known; give one of 1, 2, 3",
            ),
            (
                "device,object\na,4\n",
                "line 2, column object: '4' is not known; give one of 1, 2, 3",
            ),
            (
                "device,overturn\na,x\n",
                "line 2, column overturn: 'x' is not known; give one of critical-angle, quarter-turn",
            ),
            (
                "device,k1\na,\"200,000\"\n",
                "line 2, column k1: '200,000' may be 200000 or 200; write",
            ),
            ("device\tk1\na\t1,250\n", "line 2, column k1: '1,250' may be 1250 or 1.25"),
            ("device\tk1\na\t1.250\n", "line 2, column k1: '1.250' may be 1250 or 1.25"),
            ("device;k1\na;200.000\n", "line 2, column k1: '200.000' may be 200000 or 200"),
            ("device;k1;t_h\na;200.000;1,5\n", "line 2, column k1: '200.000' may be"),
            ("device;k1;t_h\na;200,000;1.5\n", "line 2, column k1: '200,000' may be"),
            ("device,k1\na,1.250.000\n", "line 2, column k1: '1.250.000' is no number"),
            ("device,k1\na,200 000\n", "line 2, column k1: '200 000' is no number"),
        ] {
            let line = refused(text);
            assert!(line.starts_with(wanted) && !line.contains('\n'), "{text:?}: {line}");
        }
    }
}
