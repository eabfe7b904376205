//! What the page asks: a scene in flat keys, with two ranges for its axes.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::{Value, json};

use super::refused::Refused;
use topple::model::precision::Precision;
use topple::scene::keys;
use topple::scene::parameters::Section;
use topple::scene::{FIRST, Grid, Parameter, Range, Scene, SceneBuilder, Values};

/// The keys of a scene with their values as on a command line; the two axes are `start:stop`, or `start:stop:log`.
pub type Flat = BTreeMap<String, String>;

/// The word in the place of a record's file for the synthetic pair.
pub const SYNTHETIC: &str = "synthetic";

/// A number type, or the one that the view needs.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum AskedPrecision {
    /// f32 where neighbouring cells have values that it tells apart.
    #[default]
    Auto,
    /// f32.
    F32,
    /// f64.
    F64,
}

/// Neighbouring values differ by so many roundings of f32 at least: the boundary between two cells is then off by
/// a thirtieth of a cell at most.
const ROUNDINGS: f64 = 32.0;

impl AskedPrecision {
    /// The number type for a grid.
    pub fn of(self, grid: &Grid) -> Precision {
        match self {
            AskedPrecision::F32 => Precision::F32,
            AskedPrecision::F64 => Precision::F64,
            AskedPrecision::Auto if grid.axes().iter().any(|axis| is_fine(&axis.values)) => {
                Precision::F64
            }
            AskedPrecision::Auto => Precision::F32,
        }
    }
}

/// Values along an axis of which neighbours are to be told apart, however many cells are requested: a view, its
/// sections and its files are of one number type.
const VALUES: u32 = 1025;

/// True where f32 hardly tells neighbouring values apart.
fn is_fine(values: &Values) -> bool {
    let Values::Range(range) = values else { return false };
    if range.count < 2 {
        return false;
    }
    let range = Range { count: VALUES, ..*range };
    [0, VALUES / 2, VALUES - 2].into_iter().any(|at| {
        let (one, next) = (range.value(at), range.value(at + 1));
        (next - one).abs() < ROUNDINGS * f64::from(f32::EPSILON) * one.abs().max(next.abs())
    })
}

/// The two axes of a scene in flat keys.
///
/// # Errors
/// The keys `x` and `y`: none, one that is no number, the same twice.
pub fn axes(flat: &Flat) -> Result<[Parameter; 2], Refused> {
    let [x, y] = ["x", "y"].map(|key| {
        let name = flat.get(key).ok_or_else(|| Refused::of(key, "missing; give a number's key"))?;
        Parameter::of_key(name).ok_or_else(|| {
            Refused::of(key, format!("there is no number {}; give a key", quoted(name)))
        })
    });
    let [x, y] = [x?, y?];
    if x == y {
        return Err(Refused::of("y", format!("{} is the other axis, too; give another", x.key())));
    }
    Ok([x, y])
}

/// Reads a scene whose axes have a given number of values; none: every number is single.
pub fn builder(flat: &Flat, count: Option<[u32; 2]>) -> Result<SceneBuilder, Refused> {
    let counted = match count {
        Some(count) => axes(flat)?.into_iter().zip(count).collect(),
        None => Vec::new(),
    };
    let mut words = serde_json::Map::new();
    let mut numbers: Vec<(Parameter, Values)> = Vec::new();
    for (key, text) in flat {
        if let Some(parameter) = Parameter::of_key(key) {
            let count = counted.iter().find(|(axis, _)| *axis == parameter);
            numbers.push((parameter, values(key, text, count.map(|(_, count)| *count))?));
        } else if matches!(&**key, "x" | "y") {
            // Of a single cell there is none.
            if count.is_some() {
                add(&mut words, Section::Run, key, json!(text));
            }
        } else if key == "title" {
            words.insert(key.clone(), json!(text));
        } else {
            let section = Section::ALL.into_iter().find(|own| keys::words(*own).contains(&&**key));
            let section =
                section.ok_or_else(|| Refused::of(key, "a scene has no such key; leave it out"))?;
            add(&mut words, section, key, word(key, text)?);
        }
    }
    for (axis, _) in &counted {
        if !flat.contains_key(axis.key()) {
            return Err(Refused::of(axis.key(), "missing; give start:stop, for it is an axis"));
        }
    }
    let mut scene: SceneBuilder = serde_json::from_value(Value::Object(words))
        .map_err(|error| Refused::told(error.to_string()))?;
    numbers.sort_by_key(|(parameter, _)| *parameter);
    scene.numbers.extend(numbers);
    Ok(scene)
}

/// Puts a word in the table of its section.
fn add(words: &mut serde_json::Map<String, Value>, section: Section, key: &str, word: Value) {
    let table = words.entry(section.key()).or_insert_with(|| json!({}));
    table[key] = word;
}

/// The value of a key that is no number of the table.
fn word(key: &str, text: &str) -> Result<Value, Refused> {
    let refused =
        |expected: &str| Refused::of(key, format!("{} is not {expected}; give one", quoted(text)));
    let word = match key {
        "object" => json!(text.parse::<u32>().map_err(|_| refused("the number of a block"))?),
        "force" => json!(text.parse::<bool>().map_err(|_| refused("true or false"))?),
        "dt" => match text.parse::<f64>() {
            Ok(dt) if dt.is_finite() => json!(dt),
            _ => return Err(refused("a number of seconds")),
        },
        _ => json!(text),
    };
    let section = Section::ALL.into_iter().find(|own| keys::words(*own).contains(&key));
    let alone = json!({ section.map_or("", Section::key): { key: &word } });
    // serde tells what is known: unknown variant `a`, expected one of `b`, `c`.
    serde_json::from_value::<SceneBuilder>(alone).map_err(|error| {
        let told = error.to_string().replace('`', "");
        let known = told.split_once(", expected ").map_or(&*told, |(_, known)| known).to_string();
        Refused::of(key, format!("{} is not known; give {known}", quoted(text)))
    })?;
    Ok(word)
}

/// The values of a number: of an axis so many of a range, else a single one.
fn values(key: &str, text: &str, count: Option<u32>) -> Result<Values, Refused> {
    let finite = |text: &str| match text.trim().parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => Err(Refused::of(key, format!("{} is not a finite number; give one", quoted(text)))),
    };
    let Some(count) = count else { return finite(text).map(Values::from) };
    let no_range =
        |remedy: &str| Refused::of(key, format!("{} is no range; {remedy}", quoted(text)));
    let parts: Vec<&str> = text.trim().split(':').collect();
    let (start, stop, log) = match parts[..] {
        [start, stop] => (start, stop, ""),
        [start, stop, "log"] => (start, stop, ":log"),
        _ => return Err(no_range("give start:stop, for it is an axis")),
    };
    if finite(start)? >= finite(stop)? {
        return Err(no_range("give two values, the smaller one first"));
    }
    format!("{start}:{stop}:{count}{log}").parse().map_err(|error| Refused::of(key, error))
}

/// Letters of a text that a message repeats at most.
const REPEATED: usize = 40;

/// A text as a message repeats it.
fn quoted(text: &str) -> String {
    let text = text.trim();
    match text.char_indices().nth(REPEATED) {
        Some((end, _)) => format!("'{}…'", &text[..end]),
        None => format!("'{text}'"),
    }
}

/// A text of a range's ends, as the page has them: the smaller one first.
fn ends(values: &Values) -> String {
    let (first, last) = (values.first(), values.last());
    let log = matches!(values, Values::Range(range) if range.log);
    format!("{}:{}{}", first.min(last), first.max(last), if log { ":log" } else { "" })
}

/// A range around a single value, for an axis that a scene does not have.
fn around(value: f64) -> Values {
    let reach = if value == 0.0 { 1.0 } else { 0.5 * value.abs() };
    Values::Range(Range::even(value - reach, value + reach, 2))
}

/// A scene in flat keys, with two axes: its own first two, others at their first values. `given` is what the user
/// gave of it: of what is not given the page shows defaults.
pub fn flat(scene: &Scene, given: &SceneBuilder) -> Flat {
    let grid = Grid::of(scene);
    let mut axes: Vec<(Parameter, Values)> = Vec::new();
    for axis in grid.axes().iter().take(2) {
        let values =
            if axis.count() > 1 { axis.values.clone() } else { around(axis.values.first()) };
        axes.push((axis.parameter, values));
    }
    // Beside an axis alone a period or the pulse is the other one.
    let mut others = FIRST.iter().filter(|parameter| **parameter != axes[0].0);
    if axes.len() < 2
        && let Some((parameter, values)) =
            others.find_map(|parameter| Some((*parameter, scene.numbers.get(*parameter)?)))
    {
        axes.push((parameter, around(values.first())));
    }
    let mut flat = Flat::new();
    for (parameter, values) in given.numbers.iter() {
        flat.insert(parameter.key().into(), values.first().to_string());
    }
    for (name, (parameter, values)) in ["x", "y"].into_iter().zip(&axes) {
        flat.insert(name.into(), parameter.key().into());
        flat.insert(parameter.key().into(), ends(values));
    }
    let text = |value: Value| match value {
        Value::String(text) => text,
        other => other.to_string(),
    };
    // Words as a file has them.
    let written = serde_json::to_value(given).unwrap_or_default();
    for section in Section::ALL {
        for key in keys::words(section).iter().filter(|key| !matches!(**key, "x" | "y")) {
            if let Some(word) = written[section.key()].get(key) {
                flat.insert((*key).into(), text(word.clone()));
            }
        }
    }
    flat
}
