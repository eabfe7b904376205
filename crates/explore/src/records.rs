//! The records of a session: the file that the first scene has, and files that were dropped on the page.

use std::collections::{BTreeMap, HashMap};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use serde_json::{Value, json};
use tempfile::TempDir;

use super::asked::SYNTHETIC;
use super::refused::Refused;
use super::room::{Room, Taken};
use topple::scene::excitation::check_record;
use topple::scene::record::{Pair, RecordText, Units, synthetic};
use topple::scene::shown::is_hidden;
use topple::scene::{Numbers, Parameter, Scene, SceneBuilder};

/// What a motion that was read hangs on: its files by their names here with what was given of them, written out, and the
/// peak that they are scaled to.
type Key = (String, Option<u64>);

/// Motions that are kept read, and samples of all of them, 512 MiB with both components.
const KEPT: (usize, usize) = (8, 1 << 25);

/// Files of records by names, and the motions that were read from them.
#[derive(Default)]
pub struct Records {
    /// Where dropped files lie: made for the first one, and taken away with the session.
    folder: Mutex<Option<TempDir>>,
    places: Mutex<BTreeMap<String, PathBuf>>,
    /// The room that dropped files take, also those of suites.
    pub room: Room,
    taken: Mutex<Vec<Taken>>,
    read: Mutex<HashMap<Key, Pair>>,
}

/// Bytes of a name at most: the system's limit, less what tells names apart.
const LONGEST: usize = 200;

/// The last part of a name that a browser gave, without what a file's name cannot have on some system.
pub fn plain_name(name: &str) -> String {
    let last = name.rsplit(['/', '\\']).next().unwrap_or_default();
    let kept = |c: &char| !is_hidden(*c) && !"<>:\"|?*".contains(*c);
    let mut plain = String::new();
    for letter in last.chars().filter(kept) {
        if plain.len() + letter.len_utf8() > LONGEST {
            break;
        }
        plain.push(letter);
    }
    let name = plain.trim_matches([' ', '.']).to_string();
    match name {
        name if name.is_empty() => "record".into(),
        name if is_device(&name) => format!("record-{name}"),
        name => name,
    }
}

/// True of a name that opens a device on Windows, whatever stands behind its first dot.
fn is_device(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or_default().trim_end().to_ascii_lowercase();
    let numbered = stem.strip_prefix("com").or(stem.strip_prefix("lpt"));
    ["con", "prn", "aux", "nul"].contains(&stem.as_str())
        || numbered.is_some_and(|number| {
            number.len() == 1 && number != "0" && number.parse::<u8>().is_ok()
        })
}

/// The first name, of that given and those with numbers before it, that is free, or whose file `is_it`.
fn name_for(
    places: &BTreeMap<String, PathBuf>,
    plain: &str,
    is_it: impl Fn(&Path) -> bool,
) -> String {
    let numbered = (2_u64..).map(|number| format!("{number}-{plain}"));
    let is_free = |id: &String| id != SYNTHETIC && places.get(id).is_none_or(|place| is_it(place));
    // There are more numbers than files.
    std::iter::once(plain.to_string()).chain(numbered).find(is_free).unwrap_or_default()
}

impl Records {
    /// The folder that goes with the session.
    pub fn folder(&self) -> io::Result<PathBuf> {
        // What is stored is whole, whoever panicked.
        let mut folder = self.folder.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(folder) = &*folder {
            return Ok(folder.path().into());
        }
        let made = tempfile::Builder::new().prefix("topple-explore-").tempdir()?;
        Ok(folder.insert(made).path().into())
    }

    /// True of a file that was dropped.
    fn is_dropped(&self, place: &Path) -> bool {
        let folder = self.folder.lock().unwrap_or_else(PoisonError::into_inner);
        folder.as_ref().is_some_and(|folder| place.starts_with(folder.path()))
    }

    /// Takes the folder away, whoever still computes with what was in it.
    pub fn forget(&self) {
        drop(self.folder.lock().unwrap_or_else(PoisonError::into_inner).take());
    }

    /// Keeps a file's bytes; its name here. A file of the same name and other contents has another one.
    ///
    /// # Errors
    /// Errors of the disk, and more bytes than a session keeps.
    pub fn add(&self, name: &str, bytes: &[u8]) -> Result<String, Refused> {
        let mut places = self.places.lock().unwrap_or_else(PoisonError::into_inner);
        let is_it = |place: &Path| fs::read(place).is_ok_and(|known| known == bytes);
        let id = name_for(&places, &plain_name(name), is_it);
        if !places.contains_key(&id) {
            let taken = self.room.take(bytes.len() as u64)?;
            let place = self.folder()?.join(&id);
            fs::write(&place, bytes)?;
            // A record stays as long as the session.
            self.taken.lock().unwrap_or_else(PoisonError::into_inner).push(taken);
            places.insert(id.clone(), place);
        }
        Ok(id)
    }

    /// Knows a file where it lies; its name here.
    pub fn know(&self, path: &Path) -> String {
        let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into());
        let place = std::path::absolute(path).unwrap_or_else(|_| path.into());
        let mut places = self.places.lock().unwrap_or_else(PoisonError::into_inner);
        let id = name_for(&places, &plain_name(&name), |known| known == place);
        places.insert(id.clone(), place);
        id
    }

    /// Where a file lies.
    ///
    /// # Errors
    /// A name that is not known.
    fn place(&self, key: &str, id: &Path) -> Result<PathBuf, Refused> {
        let places = self.places.lock().unwrap_or_else(PoisonError::into_inner);
        let place = id.to_str().and_then(|id| places.get(id));
        place.cloned().ok_or_else(|| {
            Refused::of(
                key,
                format!("{} is not here; drop the record's file on the page", id.display()),
            )
        })
    }

    /// The file as a command line names it: where it lay before it was dropped is not known.
    pub fn written(&self, id: &Path) -> PathBuf {
        match self.place("", id) {
            Ok(place) if !self.is_dropped(&place) => place,
            _ => id.into(),
        }
    }

    /// Checks a scene, under its record where it has one.
    pub fn check(&self, given: &SceneBuilder) -> Result<Scene, Refused> {
        let Some(text) = &given.record else { return Ok(given.check()?) };
        // Files of the computer are known to a page by what was dropped on it alone.
        if let Some(key) = text.treated_key() {
            let problem = "the page shows records as they are; topple seismic turns and joins them";
            return Err(Refused::of(key, problem));
        }
        if text.horizontal.as_deref() == Some(Path::new(SYNTHETIC)) {
            return Ok(given.check_under_motion(synthetic::pair())?);
        }
        let pair = self.pair(text, &given.numbers, given.force)?;
        Ok(given.check_under_motion(pair)?)
    }

    /// A record's motion, as it is in its files.
    fn pair(&self, text: &RecordText, numbers: &Numbers, force: bool) -> Result<Pair, Refused> {
        // Files without units are read where a peak is given.
        let pga = numbers.get(Parameter::Pga).map(topple::scene::Values::first);
        let key = (format!("{text:?}"), pga.map(f64::to_bits));
        if let Some(pair) = self.read.lock().unwrap_or_else(PoisonError::into_inner).get(&key) {
            return Ok(pair.clone());
        }
        let place =
            |key, id: &Option<PathBuf>| id.as_deref().map(|id| self.place(key, id)).transpose();
        let places = RecordText {
            horizontal: place("horizontal", &text.horizontal)?,
            vertical: place("vertical", &text.vertical)?,
            ..text.clone()
        };
        let peak =
            pga.map_or_else(Numbers::default, |pga| Numbers::default().with(Parameter::Pga, pga));
        let pair = check_record(&places, &peak, Path::new(""), force).map_err(|error| {
            // A file is identified by its name, not by its folder.
            let names =
                [(&places.horizontal, &text.horizontal), (&places.vertical, &text.vertical)];
            let problem = names.into_iter().fold(error.problem, |problem, names| match names {
                (Some(place), Some(id)) => {
                    problem.replace(&*place.to_string_lossy(), &id.to_string_lossy())
                }
                _ => problem,
            });
            Refused::of(error.key, problem)
        })?;
        let mut read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
        let samples: usize = read.values().map(Pair::len).sum();
        let (motions, most) = KEPT;
        if read.len() >= motions || samples.saturating_add(pair.len()) > most {
            read.clear();
        }
        read.insert(key, pair.clone());
        Ok(pair)
    }

    /// What a dropped file is: its title, duration and peaks; or what it `needs` beside it, `dt` or `units`.
    ///
    /// # Errors
    /// The key `horizontal`, with what is wrong with the file.
    pub fn told(&self, id: &str) -> Result<Value, Refused> {
        let with = |(dt, units): (Option<f64>, Option<Units>)| {
            let text =
                RecordText { horizontal: Some(id.into()), dt, units, ..RecordText::default() };
            self.pair(&text, &Numbers::default(), true)
        };
        let pair = match with((None, None)) {
            Ok(pair) => pair,
            Err(error) => {
                // Any will do to see what is missing.
                let (dt, units) = (Some(0.01), Some(Units::G));
                let tries = [
                    ((dt, None), &["dt"][..]),
                    ((None, units), &["units"]),
                    ((dt, units), &["dt", "units"]),
                ];
                let needs = tries.into_iter().find(|(given, _)| with(*given).is_ok());
                let (_, needs) = needs.ok_or_else(|| error.clone())?;
                return Ok(json!({ "id": id, "title": id, "needs": needs, "line": error.line }));
            }
        };
        let (peak, duration) = (pair.pga_h, pair.duration());
        let doubts: String = pair.doubts.iter().map(|doubt| format!("; {doubt}")).collect();
        let doubts = doubts.replace("`baseline` line", "topple seismic --baseline line");
        Ok(json!({
            "id": id,
            "title": pair.title,
            "dt": pair.dt,
            "duration": duration,
            "peak_h": peak,
            "peak_v": pair.pga_v,
            "line": format!("{}: {duration:.2} s, largest acceleration {peak:.3} m/s²{doubts}", pair.title),
        }))
    }
}
