//! Suites of a session: how likely a block overturns under one, and where a base keeps within its limits.

use std::collections::HashMap;
use std::fs;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use serde::Deserialize;
use serde_json::{Value, json};

use super::asked::builder;
use super::frame::{Array, frame};
use super::records::plain_name;
use super::refused::Refused;
use super::session::{Ready, Session};
use super::view::{Told, ViewRequest, header};
use crate::scene::Grid;
use crate::suites::SuiteError;
use crate::suites::envelope::{CellEnvelope, Envelope, Limits};
use crate::suites::read::Suite;
use crate::suites::request::SuiteRequest;

/// What a base must do, as the page asks it: numbers in texts, and an empty one for none.
#[derive(Debug, Clone, Default, Deserialize)]
pub struct AskedLimits {
    /// Share of the motions under which the block must stand; all without it.
    pub standing: Option<String>,
    /// Largest max |u|, m.
    pub u: Option<String>,
    /// Largest stroke of v, m.
    pub v: Option<String>,
}

impl AskedLimits {
    /// As numbers.
    ///
    /// # Errors
    /// The keys `standing`, `limit_u` and `limit_v`: no number.
    fn read(&self) -> Result<Limits, Refused> {
        let number = |key: &str, text: &Option<String>| {
            let given = text.as_deref().map(str::trim).filter(|text| !text.is_empty());
            let parsed = given.map(|text| text.parse::<f64>().map_err(|_| text));
            parsed
                .transpose()
                .map_err(|text| Refused::of(key, format!("{text} is no number; give one")))
        };
        let standing = number("standing", &self.standing)?.unwrap_or(1.0);
        Ok(Limits { standing, u: number("limit_u", &self.u)?, v: number("limit_v", &self.v)? })
    }
}

/// Cells along an axis of the coarse and of the fine picture of a suite.
const COUNTS: [(&str, u32); 2] = [("coarse", 13), ("fine", 49)];

/// The suites of a session, by names.
#[derive(Default)]
pub struct Suites(Mutex<HashMap<String, Arc<Suite>>>);

/// A suite in a folder of dropped files: a zip, a list beside its files, or the files themselves.
fn read(folder: &Path, files: &[(String, Vec<u8>)]) -> Result<Suite, SuiteError> {
    let ends = |name: &str, ending: &str| name.to_ascii_lowercase().ends_with(ending);
    if let [(name, _)] = files
        && ends(name, ".zip")
    {
        return Suite::read(&folder.join(plain_name(name)), false);
    }
    let lists = files.iter().filter(|(name, _)| ends(name, ".csv"));
    let mut as_list = lists.map(|(name, _)| Suite::read(&folder.join(plain_name(name)), false));
    as_list.find_map(Result::ok).map_or_else(|| Suite::read(folder, false), Ok)
}

impl Suites {
    /// Reads a suite from dropped files, names with contents, and keeps it; a folder is made for them in `folder`.
    ///
    /// # Errors
    /// That they are none, or have no motion; those of the disk.
    pub fn add(&self, folder: &Path, files: &[(String, Vec<u8>)]) -> Result<Value, Refused> {
        let own = tempfile::Builder::new().prefix("suite-").tempdir_in(folder)?.keep();
        let id = own.file_name().map_or_else(String::new, |name| name.to_string_lossy().into());
        for (name, bytes) in files {
            fs::write(own.join(plain_name(name)), bytes)?;
        }
        let suite = read(&own, files)?;
        let motions = suite.motions().count();
        if motions == 0 {
            let why = suite.left_out().next().map_or("", |(_, why)| why);
            return Err(Refused::of("suite", format!("no motion among these files: {why}")));
        }
        let left_out = suite.left_out().count();
        // What is stored is whole, whoever panicked.
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        known.insert(id.clone(), Arc::new(suite));
        let line = match left_out {
            0 => format!("{motions} motions"),
            _ => format!("{motions} motions, {left_out} left out"),
        };
        Ok(json!({ "id": id, "motions": motions, "left_out": left_out, "line": line }))
    }

    fn get(&self, id: &str) -> Result<Arc<Suite>, Refused> {
        let known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let problem = || format!("{id} is not here; drop the suite's files on the page");
        known.get(id).cloned().ok_or_else(|| Refused::of("suite", problem()))
    }
}

/// Computes a view of a scene under a suite.
///
/// # Errors
/// The first key at fault; those of a sweep; that it was ended.
pub fn run(
    session: &Session,
    request: &ViewRequest,
    id: &str,
    stop: &AtomicBool,
    mut send: impl FnMut(Vec<u8>) -> bool,
) -> Result<(), Refused> {
    let suite = session.suites.get(id)?;
    let limits = request.limits.read()?;
    for (stage, most) in COUNTS {
        let count = request.count.map(|count| count.clamp(2, most));
        let scene = builder(&request.scene, Some(count))?;
        let mut asked = SuiteRequest::new(scene);
        asked.check_envelope(&limits)?;
        let motions = asked.motions(&suite);
        if let Some(first) = motions.first() {
            let grid = Grid::of(&first.under(&asked.scene)?);
            asked.settings.run = session.settings(request.precision.of(&grid));
        }
        let job = asked.open_under(motions)?;
        let method = asked.settings.run.method;
        let began = Instant::now();
        let cells = job.cells();
        let ready = Ready {
            scene: job.scene.clone(),
            grid: job.grid.clone(),
            settings: asked.settings.run.clone(),
            opened: session.opened(method.precision)?,
        };
        let envelope = Envelope::of(job.run(stop)?, limits);
        let seconds = began.elapsed().as_secs_f64();
        let told = Told { stage, cells, seconds, note: "" };
        if !send(frame(header(&envelope.sweep.grid, &ready, &told), &arrays(&envelope))) {
            return Ok(());
        }
    }
    Ok(())
}

/// The arrays of a suite's view.
fn arrays(envelope: &Envelope) -> Vec<(&'static str, Array)> {
    let of = |one: fn(&CellEnvelope) -> f64| {
        Array::Singles(envelope.cells.iter().map(|cell| one(cell) as f32).collect())
    };
    vec![
        ("standing", of(|cell| cell.standing)),
        ("overturned", of(|cell| cell.overturned)),
        ("rocked", of(|cell| cell.rocked)),
        ("max_u", of(|cell| cell.max_u[2])),
        ("stroke_v", of(|cell| cell.stroke_v[2])),
        ("feasible", {
            Array::Bytes(envelope.cells.iter().map(|cell| u8::from(cell.feasible)).collect())
        }),
    ]
}
