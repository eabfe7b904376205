//! From a folder, a zip or a list to the motions of a suite.

use std::collections::{BTreeMap, BTreeSet};
use std::hash::{DefaultHasher, Hasher};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::entry::{Entry, Motion};
use super::files::Files;
use super::found::Unused;
use super::measures::Measures;
use super::{SuiteError, grouped, list, peer, processing, unused};
use crate::sheet::row_in_comment;
use topple::scene::record::ACCEPTED;
use topple::scene::record::zips::MOST_FILES;
use topple::scene::record::{Baseline, Pair, Record, RecordFile, joined, text};
use topple::scene::record::{RecordHints, read};
use topple::scene::{bounded, shown};
use topple::work::parallel;

/// Largest list that is read, bytes.
const LARGEST_LIST: u64 = 64 << 20;
/// Most samples of all motions of a suite, 2 GiB with both components: 1,000 motions of 22 minutes at 100 Hz.
const MOST_SAMPLES: usize = 1 << 27;

/// A set of motions, and what was left out of it.
#[derive(Debug, Clone)]
pub struct Suite {
    /// All lines in order: each with its motion, or with why there is none.
    pub rows: Vec<(Entry, Result<Motion, String>)>,
    /// Files that are no part of any line.
    pub unused: Vec<Unused>,
    /// What may be wrong with its lists, in words.
    pub doubts: Vec<String>,
}

/// How a suite is read.
#[derive(Debug, Clone, Copy, Default)]
pub struct Reading {
    /// Refuses what is missing, ambiguous or unused; else it is a row without a motion, or a file in the list of unused ones.
    pub strict: bool,
    /// What is subtracted from the velocities of motions whose list says nothing of it.
    pub baseline: Option<Baseline>,
}

impl Suite {
    /// Reads a suite: a folder or a zip, with PEER's list or by what the names of its files or the files state, or a list beside its
    /// files.
    ///
    /// # Errors
    /// Those of [`SuiteError`]: nothing can be read, a list is invalid, there are no files.
    pub fn read(path: &Path, strict: bool) -> Result<Suite, SuiteError> {
        Suite::read_as(path, Reading { strict, ..Reading::default() })
    }

    /// The same with all that can be said of the reading.
    pub fn read_as(path: &Path, reading: Reading) -> Result<Suite, SuiteError> {
        let Reading { strict, baseline } = reading;
        let files = Files::of(path)?;
        let Lines { entries, unused, doubts } = entries(path, &files)?;
        let mut entries = with_own_ids(entries);
        if entries.is_empty() {
            return Err(SuiteError::Empty { path: path.into(), unused: unused.len() });
        }
        let samples = AtomicUsize::new(0);
        let motions = parallel::each_slice(&mut entries, 1, |_, entry| {
            let entry = &mut entry[0];
            entry.baseline = entry.baseline.or(baseline);
            // Names in it may be of any length.
            motion(entry, &files, &samples).map_err(|why| shown::line(&why))
        });
        let rows = entries.into_iter().zip(motions).collect();
        if samples.into_inner() > MOST_SAMPLES {
            return Err(SuiteError::Large { path: path.into(), most: MOST_SAMPLES });
        }
        let mut suite = Suite { rows, unused, doubts };
        suite.check_factors(path)?;
        suite.leave_out_copies();
        processing::leave_out_uncorrected(&mut suite.rows);
        if let (None, Some((entry, reason))) = (suite.motions().next(), suite.left_out().next()) {
            let (id, reason) = (entry.id.clone(), reason.to_string());
            return Err(SuiteError::NoMotion { count: suite.rows.len(), id, reason });
        }
        let mut left_out = suite.left_out();
        if let (Some((entry, reason)), true) = (left_out.next(), strict) {
            let (id, reason) = (entry.id.clone(), reason.to_string());
            let count = left_out.count() + 1;
            return Err(SuiteError::Strict { count, all: suite.rows.len(), id, reason });
        }
        drop(left_out);
        if let (Some(Unused { file, why }), true) = (suite.unused.first().cloned(), strict) {
            return Err(SuiteError::Unused { count: suite.unused.len(), file, why });
        }
        Ok(suite)
    }

    /// Refuses factors of a list that make more of a motion than any ground has.
    fn check_factors(&self, path: &Path) -> Result<(), SuiteError> {
        // What is not scaled is as strong as its file has it.
        for (entry, motion) in self.motions().filter(|(entry, _)| entry.scale != 1.0) {
            let [pga_h, pga_v] =
                [motion.pair.pga_h, motion.pair.pga_v].map(|peak| peak / entry.scale);
            let before = Pair { pga_h, pga_v, ..motion.pair.clone() };
            if let Some(beyond) = before.beyond(entry.scale) {
                return Err(SuiteError::Factor { path: path.into(), id: entry.id.clone(), beyond });
            }
        }
        Ok(())
    }

    /// Leaves out what is there twice, in two lists or under two names: of each motion the first stays, unless
    /// the others are scaled otherwise, or read with another time step or in other units.
    fn leave_out_copies(&mut self) {
        let mut known: BTreeMap<(String, Option<String>, [u64; 4]), String> = BTreeMap::new();
        for (entry, motion) in &mut self.rows {
            let Ok(Motion { pair, measures }) = motion else { continue };
            let Some(files) = &pair.provenance else { continue };
            let vertical = files.vertical.as_ref().map(|file| file.sha256.clone());
            let [scale, dt, pga] = [entry.scale, pair.dt, measures.pga_h].map(f64::to_bits);
            // Of one file there may be several channels.
            let read_as = [scale, dt, pga, checksum(pair)];
            let key = (files.horizontal.sha256.clone(), vertical, read_as);
            if let Some(first) = known.get(&key) {
                *motion = Err(format!("the same motion as {}", shown::shown(first)));
            } else {
                known.insert(key, entry.id.clone());
            }
        }
    }

    /// Its motions.
    pub fn motions(&self) -> impl Iterator<Item = (&Entry, &Motion)> {
        self.rows.iter().filter_map(|(entry, motion)| Some((entry, motion.as_ref().ok()?)))
    }

    /// What has no motion, and why.
    pub fn left_out(&self) -> impl Iterator<Item = (&Entry, &str)> {
        self.rows
            .iter()
            .filter_map(|(entry, motion)| Some((entry, motion.as_ref().err()?.as_str())))
    }
}

/// True of a file that is a list of records: PEER's, or one whose header names its columns.
pub fn is_list(bytes: &[u8]) -> bool {
    text::decoded(bytes).is_ok_and(|text| peer::matches(&text) || list::matches(&text))
}

/// A number that two motions do not share unless their samples are the same.
fn checksum(pair: &Pair) -> u64 {
    let mut hasher = DefaultHasher::new();
    for sample in pair.horizontal.iter().chain(pair.vertical.iter()) {
        hasher.write_u64(sample.to_bits());
    }
    hasher.finish()
}

/// The lines of a suite, files that none of them has, and what may be wrong with lists.
#[derive(Default)]
struct Lines {
    entries: Vec<Entry>,
    unused: Vec<Unused>,
    doubts: Vec<String>,
}

fn entries(path: &Path, files: &Files) -> Result<Lines, SuiteError> {
    let refused = |path: &Path, problem: String| SuiteError::List {
        path: path.into(),
        problem: shown::line(&problem),
    };
    let is_list = path.is_file()
        && ["csv", "tsv", "txt"].iter().any(|own| ending(&path.to_string_lossy(), own));
    let is_sheet = ["xlsx", "xls", "ods"].iter().any(|own| ending(&path.to_string_lossy(), own));
    if path.is_file() && is_sheet {
        let problem =
            "a list in a spreadsheet is not read; save its sheet as CSV beside the records";
        return Err(refused(path, problem.to_string()));
    }
    if path.is_file() && !is_list && !ending(&path.to_string_lossy(), "zip") {
        let problem = "neither a folder, a zip nor a list (.csv); give the folder of the records";
        return Err(refused(path, problem.to_string()));
    }
    let mut doubts = Vec::new();
    let mut lists: BTreeSet<&str> = BTreeSet::new();
    let mut listed: Vec<Entry> = Vec::new();
    if is_list {
        let bytes = bounded::read(path, LARGEST_LIST)
            .map_err(|reason| SuiteError::Read { path: path.into(), reason })?;
        let text = text::decoded(&bytes).map_err(|error| refused(path, error.to_string()))?;
        let (read, doubt) = match peer::matches(&text) {
            true => (peer::read(&text, "", files), None),
            false => (list::read(&text, "", files), doubt(path, &text)),
        };
        let entries = read.map_err(|problem| refused(path, problem.to_string()))?;
        let doubts = doubt.into_iter().collect();
        return Ok(Lines { entries: of_list(entries), doubts, ..Lines::default() });
    }
    for name in files.names().iter().filter(|name| ending(name, "csv") || ending(name, "tsv")) {
        let Some(bytes) = files.peek(name, LARGEST_LIST) else { continue };
        // What is no text is no list.
        let Ok(text) = text::decoded(&bytes) else { continue };
        let read = match (peer::matches(&text), list::matches(&text)) {
            (true, _) => peer::read(&text, name, files),
            (_, true) => {
                doubts.extend(doubt(&files.path(name), &text));
                list::read(&text, name, files)
            }
            _ => continue,
        };
        let read = read.map_err(|problem| refused(&files.path(name), problem.to_string()))?;
        listed.extend(of_list(read));
        lists.insert(name);
        if listed.len() > MOST_FILES {
            let problem = format!("with it there are more than {MOST_FILES} motions in all lists");
            return Err(refused(&files.path(name), problem));
        }
    }
    let of_entry = |entry: &Entry| {
        [Some(entry.horizontal.clone()), entry.vertical.clone()].into_iter().flatten()
    };
    let taken: BTreeSet<String> = listed.iter().flat_map(of_entry).collect();
    let rest: Vec<&str> = files
        .names()
        .iter()
        .map(String::as_str)
        .filter(|name| !taken.contains(*name) && !lists.contains(name))
        .collect();
    let (mut named, unused) = grouped::entries(&rest, files);
    if !lists.is_empty() {
        for entry in &mut named {
            entry.notes.push("not in the list".into());
        }
    }
    listed.extend(named);
    if listed.len() > MOST_FILES {
        return Err(refused(path, format!("more than {MOST_FILES} motions; give fewer")));
    }
    let mut unused = unused::explained(unused, files, !lists.is_empty())
        .map_err(|(name, problem)| refused(&files.path(&name), problem))?;
    unused.extend(files.others().iter().cloned());
    Ok(Lines { entries: listed, unused, doubts })
}

/// What may be wrong with a list of one's own.
fn doubt(path: &Path, text: &str) -> Option<String> {
    row_in_comment(text).map(|doubt| format!("{}: {doubt}", path.display()))
}

/// Lines of a list, as such.
fn of_list(entries: Vec<Entry>) -> Vec<Entry> {
    entries.into_iter().map(|entry| Entry { listed: true, ..entry }).collect()
}

/// The same lines, each with an id of its own: where names are alike in two folders, with the folders'.
fn with_own_ids(mut entries: Vec<Entry>) -> Vec<Entry> {
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    for entry in &entries {
        *counts.entry(entry.id.clone()).or_default() += 1;
    }
    let mut known = BTreeMap::new();
    for entry in &mut entries {
        if counts.get(&entry.id).is_some_and(|count| *count > 1) {
            entry.id.clone_from(&entry.horizontal);
        }
        let times: &mut usize = known.entry(entry.id.clone()).or_default();
        *times += 1;
        if *times > 1 {
            entry.id = format!("{} ({times})", entry.id);
        }
    }
    entries
}

fn ending(name: &str, wanted: &str) -> bool {
    name.rsplit_once('.').is_some_and(|(_, ending)| ending.eq_ignore_ascii_case(wanted))
}

/// Reads the motion of a line, and says in the line what was decided; its `samples` are added to those of the others, and
/// none is read where these are too many already.
fn motion(entry: &mut Entry, files: &Files, samples: &AtomicUsize) -> Result<Motion, String> {
    if let Some(missing) = &entry.missing {
        return Err(missing.clone());
    }
    if samples.load(Ordering::Relaxed) > MOST_SAMPLES {
        return Err("the motions before have too many samples".into());
    }
    if entry.vertical.is_none() && !entry.horizontal_alone {
        return Err("no vertical; a list with an empty vertical takes the horizontal alone".into());
    }
    let hints = RecordHints {
        dt: entry.dt,
        units: entry.units,
        baseline: entry.baseline,
        ..RecordHints::default()
    };
    // Here nothing is forced: a list says what is meant.
    let plain =
        |problem: &str| problem.trim_end_matches(ACCEPTED).trim_end_matches("; ").to_string();
    let record = |name: &str, vertical: bool| -> Result<(Record, RecordFile), String> {
        let bytes = files.read(name).map_err(|error| format!("{name}: {error}"))?;
        let channel = entry.channels[usize::from(vertical)].clone();
        let hints = RecordHints { vertical: Some(vertical), channel, ..hints.clone() };
        read::of_bytes(&files.path(name), &bytes, &hints)
            .map_err(|error| format!("{name}: {}", plain(&error.to_string())))
    };
    let horizontal = record(&entry.horizontal, false)?;
    let vertical = entry.vertical.as_deref().map(|name| record(name, true)).transpose()?;
    let stated = &horizontal.0.stated;
    if entry.event.is_empty() {
        entry.event.clone_from(&stated.event);
    }
    if entry.station.is_empty() {
        entry.station.clone_from(&stated.station);
    }
    let channel = entry.channels[0].as_deref().unwrap_or_default();
    let of_name = processing::of_name(&entry.horizontal);
    entry
        .streams
        .extend(of_name.map(|(stream, corrected)| (format!("{stream} {channel}"), corrected)));
    entry.streams.extend(processing::of_stated(stated));
    let pair = joined::join(horizontal, vertical, &hints, false);
    let mut pair = pair.map_err(|error| format!("{}: {}", error.key, plain(&error.problem)))?;
    samples.fetch_add(pair.len(), Ordering::Relaxed);
    entry.notes.extend(pair.notes.iter().chain(&pair.doubts).cloned());
    if let Some(provenance) = &mut pair.provenance {
        provenance.treatment.baseline = entry.baseline;
    }
    if entry.scale != 1.0 {
        pair = pair.scaled(entry.scale);
    }
    let measures = Measures::of(&pair);
    Ok(Motion { pair, measures })
}
