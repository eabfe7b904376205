//! From keywords to a scene and to how it is run.

use std::path::{Path, PathBuf};

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyBool, PyByteArray, PyBytes, PyDict, PyType};
use serde_json::{Map, Value, json};
use topple::results::column_set::ColumnSet;
use topple::scene::keys;
use topple::scene::parameters::Section;
use topple::scene::path_text::PathText;
use topple::scene::record::RecordHints;
use topple::scene::record::keys::{Place, RecordKey};
use topple::scene::record::{
    Baseline, Pair, Provenance, Record, RecordText, Stated, joined, missing, synthetic,
};
use topple::sweep::settings::VerifySettings;
use topple::work::threads::{Threads, too_many};
use topple::{Parameter, RefineSettings, RunSettings, Saving, Scene, SceneBuilder, Values};

use crate::errors::{of_keyword, of_scene, warn};

/// What keywords say.
pub struct Request {
    /// The scene, without a record in arrays.
    pub scene: SceneBuilder,
    /// How it is run.
    pub settings: RunSettings,
    /// A motion in arrays, where there is one.
    pub motion: Option<Pair>,
    /// The folder from which record files are looked for.
    pub folder: PathBuf,
    /// What computes on the CPU.
    pub threads: Threads,
}

/// The keywords that say how a scene is run.
pub const SETTINGS: [&str; 13] = [
    "backend",
    "adapter",
    "precision",
    "step",
    "resolve",
    "full_model",
    "repair",
    "columns",
    "verify",
    "out",
    "resume",
    "tile",
    THREADS,
];
/// Those of them that say how a motion is integrated, in a map as in a single cell.
pub const METHOD: [&str; 4] = ["backend", "precision", "step", "full_model"];
/// The keyword of how many threads compute.
const THREADS: &str = "threads";

/// The keywords that say how a map is refined.
pub const REFINING: [&str; 2] = ["refine", "smooth"];

/// The key under which arrays of a record come: see [`pair`].
const MOTION: &str = "motion";
/// The key under which a scene's file comes: its text, and the folder from which record files are looked for.
const FILE: &str = "scene";
/// The key under which the scene of a result comes: its JSON, and that of where its record came from.
const RESULT: &str = "result";

/// What a scene is made of, beside its numbers.
enum Start {
    Words,
    File(String),
    Result(String, Option<String>),
}

impl Request {
    /// Reads keywords; those in `others` are the caller's.
    pub fn of(keywords: &Bound<'_, PyDict>, others: &[&str]) -> PyResult<Request> {
        let mut words: Map<String, Value> = Map::new();
        let mut numbers: Vec<(Parameter, Values)> = Vec::new();
        let (mut settings, mut motion, mut title) = (RunSettings::default(), None, None);
        let (mut start, mut folder, mut threads) = (Start::Words, PathBuf::new(), None);
        for (key, value) in keywords {
            let key: String = key.extract()?;
            if value.is_none() || others.contains(&key.as_str()) {
                continue;
            }
            let section = Section::ALL.into_iter().find(|own| keys::words(*own).contains(&&*key));
            if let Some(parameter) = Parameter::of_key(&key) {
                numbers.push((parameter, values(&key, &value)?));
            } else if let Some(section) = section {
                let word = word(section, &key, &value)?;
                let table = words.entry(section.key()).or_insert_with(|| json!({}));
                table[&key] = word;
            } else if key == "title" {
                title = Some(taken::<String>(&key, &value, "a text")?);
            } else if key == MOTION {
                motion = Some(pair(&value)?);
            } else if key == FILE {
                let (text, place) = value.extract()?;
                (start, folder) = (Start::File(text), place);
            } else if key == RESULT {
                let (scene, record) = value.extract()?;
                start = Start::Result(scene, record);
            } else if key == THREADS {
                threads = Some(taken_number(&key, &value, "a number of threads")?);
            } else if SETTINGS.contains(&key.as_str()) {
                set(&mut settings, &key, &value)?;
            } else {
                return Err(of_keyword(&key, "no keyword of this name; help() lists them"));
            }
        }
        // Of a scene that is there words stay: with other ones its numbers may have no meaning.
        let word = words.values().find_map(|table| table.as_object()?.keys().next());
        if let (Some(key), Start::File(_) | Start::Result(..)) = (word, &start) {
            return Err(of_keyword(key, "the scene tells it; give numbers alone"));
        }
        let mut scene = match start {
            Start::Words => {
                let given = serde_json::from_value(Value::Object(words));
                given.map_err(|error| PyValueError::new_err(error.to_string()))?
            }
            Start::File(text) => SceneBuilder::from_toml(&text).map_err(PyValueError::new_err)?,
            Start::Result(scene, record) => again(&scene, record.as_deref(), motion.is_some())?,
        };
        scene.title = title.or(scene.title);
        for (parameter, values) in numbers {
            scene.numbers.set(parameter, values);
        }
        if let Some(problem) = threads.and_then(too_many) {
            return Err(of_keyword(THREADS, problem));
        }
        let threads = Threads::new(threads).map_err(|error| of_keyword(THREADS, error))?;
        Ok(Request { scene, settings, motion, folder, threads })
    }

    /// The checked scene; `recorded`: a record shakes it, the synthetic pair where none is given.
    pub fn check(&self, recorded: bool) -> PyResult<Scene> {
        let record = self.scene.record.as_ref();
        let none = record.is_none_or(|record| record.horizontal.is_none());
        // The synthetic pair tells its step and its units, and has both components.
        if let (None, true, Some(record)) = (&self.motion, recorded && none, record) {
            let problem = "no horizontal record is given; give it, or leave this out";
            return Err(of_keyword(record.first_key(), problem));
        }
        let motion = match &self.motion {
            None if recorded && none => Some(synthetic::pair()),
            motion => motion.clone(),
        };
        let checked = match motion {
            Some(motion) => self.scene.check_under_motion_in(motion, &self.folder),
            None => self.scene.check_in(&self.folder),
        };
        let scene = checked.map_err(of_scene)?;
        warn_of_doubts(scene.excitation.record().map_or(&[], |pair| &pair.doubts))?;
        Ok(scene)
    }
}

/// Warns of what may be wrong with the samples of a record.
pub fn warn_of_doubts(doubts: &[String]) -> PyResult<()> {
    Python::attach(|py| doubts.iter().try_for_each(|doubt| warn(py, doubt.replace('`', ""))))
}

/// The scene of a result; `shaken`: its motion is given in arrays.
fn again(scene: &str, record: Option<&str>, shaken: bool) -> PyResult<SceneBuilder> {
    let unread =
        |error| PyValueError::new_err(format!("no scene of this version of topple: {error}"));
    let scene: Scene = serde_json::from_str(scene).map_err(unread)?;
    let record: Option<Provenance> =
        record.map(serde_json::from_str).transpose().map_err(unread)?;
    let found = match (record, scene.excitation.record()) {
        _ if shaken => None,
        (Some(record), _) => {
            let found = RecordText::found(&record, &[Path::new("")]);
            Some(found.map_err(|error| of_keyword("horizontal", error))?)
        }
        (None, Some(_)) => {
            let problem = "missing; the result does not hold its motion";
            return Err(of_keyword("horizontal", problem));
        }
        (None, None) => None,
    };
    Ok(SceneBuilder::again(&scene, found))
}

/// A number, a range as text, or a list.
pub fn values(key: &str, value: &Bound<'_, PyAny>) -> PyResult<Values> {
    let expected = || of_keyword(key, "give a number, a sequence of numbers, or start:stop:count");
    if let Ok(text) = value.extract::<String>() {
        return text.parse().map_err(|error| of_keyword(key, error));
    }
    if !may_hold_numbers(value) {
        return Err(expected());
    }
    unmasked(key, value)?;
    // What has a length is a sequence: numpy makes a number of an array of one value.
    if value.len().is_err() {
        return number(value).map(Into::into).ok_or_else(expected);
    }
    let items: Vec<Bound<'_, PyAny>> = value.extract().map_err(|_| expected())?;
    let mut numbers = Vec::with_capacity(items.len());
    for item in &items {
        unmasked(key, item)?;
        numbers.push(number(item).ok_or_else(expected)?);
    }
    Values::list(numbers).map_err(|error| of_keyword(key, error))
}

/// Refuses what numpy has masked: whoever masks a value does not want it, and what lies below is no number of theirs.
fn unmasked(key: &str, value: &Bound<'_, PyAny>) -> PyResult<()> {
    static ARRAY: PyOnceLock<Py<PyType>> = PyOnceLock::new();
    let masked = ARRAY.import(value.py(), "numpy.ma", "MaskedArray")?;
    if may_hold_numbers(value)
        && value.is_instance(masked)?
        && value.py().import("numpy.ma")?.call_method1("is_masked", (value,))?.extract()?
    {
        return Err(of_keyword(
            key,
            "values are masked; fill them, or leave them out, as compressed() does",
        ));
    }
    Ok(())
}

/// A single number; none of what Python would take for one though it is none: truths, arrays of one value, complex
/// numbers.
fn number(value: &Bound<'_, PyAny>) -> Option<f64> {
    let real = kind_of(value).is_none_or(|kind| "iuf".contains(&kind));
    let single = real && !value.is_instance_of::<PyBool>() && value.len().is_err();
    single.then(|| value.extract().ok()).flatten()
}

/// False of what would pass for numbers, or has a mask of another kind: bytes, arrays of truths and of structures.
fn may_hold_numbers(value: &Bound<'_, PyAny>) -> bool {
    let none = value.is_instance_of::<PyBytes>() || value.is_instance_of::<PyByteArray>();
    // What an array of objects holds is looked at one by one.
    !none && kind_of(value).is_none_or(|kind| "iufO".contains(&kind))
}

/// The kind of numpy's type, of what has one.
fn kind_of(value: &Bound<'_, PyAny>) -> Option<String> {
    value.getattr("dtype").and_then(|dtype| dtype.getattr("kind")).ok()?.extract().ok()
}

/// The value of a key that is no number of the table, as the section of a scene takes it.
fn word(section: Section, key: &str, value: &Bound<'_, PyAny>) -> PyResult<Value> {
    let word = match key {
        "object" => json!(taken_number::<u32>(key, value, "the number of a block, from 1 on")?),
        "force" => json!(taken::<bool>(key, value, "True or False")?),
        _ => match RecordKey::named(key).map(|own| (own.place, own.value)) {
            Some((Place::File(_), _)) => json!(PathText(taken(key, value, "a path")?)),
            Some((Place::Number(..), unit)) => {
                let expected = match unit {
                    "S" => "a number of seconds",
                    "DEG" => "a number of degrees",
                    _ => "a number",
                };
                json!(taken_number::<f64>(key, value, expected)?)
            }
            _ => json!(taken::<String>(key, value, "a word")?),
        },
    };
    let alone = json!({ section.key(): { key: &word } });
    let found: Result<SceneBuilder, _> = serde_json::from_value(alone);
    found.map_err(|error| unknown(key, &brief(value), &error))?;
    Ok(word)
}

/// The error of a word that is none of those known, by serde's: unknown variant `a`, expected one of `b`, `c`.
fn unknown(key: &str, word: &str, error: &serde_json::Error) -> PyErr {
    let text = error.to_string().replace('`', "");
    let known = text.split_once(", expected ").map_or(&*text, |(_, known)| known);
    of_keyword(key, format!("{word} is not known; give {known}"))
}

/// A component in arrays: its step, s, its samples, its title; of a trace also the station, the channel's code and when it
/// begins, s.
type Component = (f64, Vec<f64>, String, Option<(String, String, f64)>);

/// A motion in arrays: its components, the factor from their units to m/s^2, whether it is forced, its baseline. Of traces what
/// they state of themselves is judged as what files state is, unless it is forced.
fn pair(value: &Bound<'_, PyAny>) -> PyResult<Pair> {
    let (horizontal, vertical, factor, force, word): (
        Component,
        Option<Component>,
        f64,
        bool,
        Option<String>,
    ) = value.extract()?;
    let baseline = baseline(word)?;
    let record = |key: &str, (dt, samples, title, trace): Component| {
        if !(dt.is_finite() && dt > 0.0) {
            return Err(of_keyword(
                "dt",
                format!("{dt} is no time between samples; give seconds above 0"),
            ));
        }
        let doubts = missing::told(&samples).into_iter().collect();
        let samples: Vec<f64> = samples.iter().map(|sample| factor * sample).collect();
        if samples.len() < 2 || samples.iter().any(|sample| !sample.is_finite()) {
            return Err(of_keyword(key, "give two samples at least, all of them finite"));
        }
        let stated =
            trace.map(|(station, channel, start)| Stated::of_trace(&station, &channel, start));
        let stated = stated.unwrap_or_default();
        Ok(Record { title, dt, samples, stated, doubts, ..Record::default() }.on_baseline(baseline))
    };
    let horizontal = record("horizontal", horizontal)?;
    let vertical = vertical.map(|samples| record("vertical", samples)).transpose()?;
    if horizontal.peak() == 0.0 && vertical.as_ref().is_none_or(|record| record.peak() == 0.0) {
        return Err(of_keyword("horizontal", "all samples are zero; give a motion"));
    }
    let of_traces = [Some(&horizontal), vertical.as_ref()]
        .into_iter()
        .flatten()
        .any(|record| record.stated != Stated::default());
    if of_traces {
        return joined::bring(horizontal, vertical, &RecordHints::default(), force)
            .map_err(of_scene);
    }
    Pair::new(horizontal, vertical).map_err(|error| of_keyword("horizontal", error))
}

/// Sets what a keyword says of the run.
fn set(settings: &mut RunSettings, key: &str, value: &Bound<'_, PyAny>) -> PyResult<()> {
    let text = || value.str().map(|text| text.to_string());
    let named = |problem: &dyn std::fmt::Display| of_keyword(key, problem);
    match key {
        "backend" => settings.backend = named_one(key, &text()?)?,
        "precision" => settings.method.precision = named_one(key, &text()?)?,
        "adapter" => {
            let expected = "the number of an adapter, or a sequence of them";
            settings.adapters = match value.extract::<Vec<Bound<'_, PyAny>>>() {
                Ok(items) => {
                    let items = items.iter().map(|item| taken_number(key, item, expected));
                    items.collect::<PyResult<_>>()?
                }
                Err(_) => vec![taken_number(key, value, expected)?],
            };
        }
        "step" => settings.method.largest_step = taken_number(key, value, "a number of seconds")?,
        "resolve" => settings.method.resolve = taken(key, value, "True or False")?,
        "full_model" => settings.method.full_model = taken(key, value, "True or False")?,
        "repair" => settings.method.repair = taken(key, value, "True or False")?,
        "columns" => {
            let names = match value.extract::<Vec<String>>() {
                Ok(names) => names,
                Err(_) => text()?.split(',').map(String::from).collect(),
            };
            settings.method.columns =
                ColumnSet::of_names(&names).map_err(|error| named(&error.problem))?;
        }
        "verify" => {
            let none = value.extract::<bool>().is_ok_and(|flag| !flag);
            let none = none || value.extract::<String>().is_ok_and(|text| text == "none");
            settings.verify = match none {
                true => VerifySettings::cells(0),
                false => VerifySettings::cells(taken_number(key, value, "a number of cells")?),
            };
        }
        "out" => saving(settings).directory = taken(key, value, "a path")?,
        "resume" => {
            // Without a directory there is nothing to go on from, and False says so.
            if taken::<bool>(key, value, "True or False")? {
                saving(settings).resume = true;
            }
        }
        "tile" => {
            let shard = text()?.parse().map_err(|error| named(&error))?;
            saving(settings).shard = Some(shard);
        }
        // One of `SETTINGS` that has no case here.
        _ => return Err(of_keyword(key, "not read; this is a mistake in topple")),
    }
    Ok(())
}

/// The value of a keyword; without one, and of `None`, none.
pub fn value_of<'py>(
    keywords: &Bound<'py, PyDict>,
    key: &str,
) -> PyResult<Option<Bound<'py, PyAny>>> {
    Ok(keywords.get_item(key)?.filter(|value| !value.is_none()))
}

/// How a map is refined, where keywords ask for it: only one that is held in memory is.
pub fn refining(
    keywords: &Bound<'_, PyDict>,
    settings: &RunSettings,
) -> PyResult<Option<RefineSettings>> {
    let [refine, smooth] = REFINING;
    let smoothness = value_of(keywords, smooth)?;
    let Some(levels) = value_of(keywords, refine)? else {
        return match smoothness {
            Some(_) => Err(of_keyword(smooth, "it says how a map is refined; give refine, too")),
            None => Ok(None),
        };
    };
    let mut refining = RefineSettings::levels(taken_number(refine, &levels, "a number of levels")?);
    if let Some(share) = smoothness {
        let share = taken_number(smooth, &share, "a share of a range")?;
        if !(share > 0.0 && share < 1.0) {
            return Err(of_keyword(smooth, "give a share above 0 and below 1"));
        }
        refining.smooth = Some(share);
    }
    if settings.saving.is_some() {
        return Err(of_keyword(
            refine,
            "the leaves are held in memory; leave out, resume and tile out",
        ));
    }
    if settings.method.repair {
        return Err(of_keyword(refine, "a repaired map is not refined; leave repair out"));
    }
    Ok(Some(refining))
}

/// A type that a value is read as.
pub trait Taken<'py>: for<'a> FromPyObject<'a, 'py, Error = PyErr> {}

impl<'py, T: for<'a> FromPyObject<'a, 'py, Error = PyErr>> Taken<'py> for T {}

/// The number of a keyword, where it is given.
pub fn number_of<'py, T: Taken<'py>>(
    keywords: &Bound<'py, PyDict>,
    key: &str,
    expected: &str,
) -> PyResult<Option<T>> {
    value_of(keywords, key)?.map(|value| taken_number(key, &value, expected)).transpose()
}

/// The value of a keyword that is no number, where it is given.
pub fn given<'py, T: Taken<'py>>(
    keywords: &Bound<'py, PyDict>,
    key: &str,
    expected: &str,
) -> PyResult<Option<T>> {
    value_of(keywords, key)?.map(|value| taken(key, &value, expected)).transpose()
}

/// A number of a type; `expected` says which. Neither a truth nor an array is one.
pub fn taken_number<'py, T: Taken<'py>>(
    key: &str,
    value: &Bound<'py, PyAny>,
    expected: &str,
) -> PyResult<T> {
    unmasked(key, value)?;
    match number(value) {
        Some(_) => taken(key, value, expected),
        None => Err(of_keyword(key, format!("{} is not {expected}", brief(value)))),
    }
}

/// A value of a type; `expected` says which. Numbers are [`taken_number`]s.
pub fn taken<'py, T: Taken<'py>>(
    key: &str,
    value: &Bound<'py, PyAny>,
    expected: &str,
) -> PyResult<T> {
    let problem = |_| of_keyword(key, format!("{} is not {expected}", brief(value)));
    value.extract().map_err(problem)
}

/// A value in a line.
fn brief(value: &Bound<'_, PyAny>) -> String {
    let text = value.repr().map_or_else(|_| "it".into(), |text| text.to_string());
    let line = text.lines().next().unwrap_or_default();
    if line.chars().count() <= BRIEF { line.into() } else { "it".into() }
}

/// Letters of a value that is told.
const BRIEF: usize = 40;

/// What is subtracted from the velocities of a motion.
pub fn baseline(word: Option<String>) -> PyResult<Option<Baseline>> {
    word.map(|word| named_one("baseline", &word)).transpose()
}

/// A word of a list that the library knows.
pub fn named_one<T: serde::de::DeserializeOwned>(key: &str, text: &str) -> PyResult<T> {
    serde_json::from_value(json!(text)).map_err(|error| unknown(key, text, &error))
}

fn saving(settings: &mut RunSettings) -> &mut Saving {
    // Who presses Ctrl-C in a notebook waits for nothing.
    settings.saving.get_or_insert_with(|| Saving { ends_at_once: true, ..Saving::to("") })
}

/// The texts of a keyword: one, or several in a sequence.
pub fn several(keywords: &Bound<'_, PyDict>, key: &str) -> PyResult<Vec<String>> {
    let Some(value) = value_of(keywords, key)? else {
        return Ok(Vec::new());
    };
    if let Ok(one) = value.extract() {
        return Ok(vec![one]);
    }
    let items = value.try_iter().map_err(|error| of_keyword(key, error))?;
    items.map(|one| taken(key, &one?, "a text")).collect()
}
