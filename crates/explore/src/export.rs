//! The page as a folder of files that any static host serves: it computes in its reader's browser, by WebGPU with this
//! library's shader.

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fs;
use std::io::{self, Write};
use std::path::{Component, Path, PathBuf};
use std::sync::atomic::AtomicBool;

use serde_json::{Value, json};

use super::about;
use super::asked::{AskedPrecision, Flat};
use super::constants::constants;
use super::page::{self, Engine, FILES, INDEX, POLICY};
use super::refused::Refused;
use super::session::Session;
use super::stage::StageSummary;
use super::view;
use topple::backend::gpu::shader::{self, Switches};
use topple::model::precision::Precision;
use topple::results::files::{Directory, WriteError};
use topple::results::{own, temporary};
use topple::scene::record::Pair;
use topple::scene::{Directions, Excitation, Parameter, bounded};

/// Why a page is not exported.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// A folder that holds something else.
    #[error("{}: holds other files; give a folder that is empty, new, or an earlier export", .0.display())]
    Occupied(PathBuf),
    /// The disk.
    #[error("{}: {error}", .path.display())]
    File {
        /// Which file or folder.
        path: PathBuf,
        /// What is wrong.
        error: io::Error,
    },
    /// The folder, or a file that is written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// The scene, or its sweep.
    #[error(transparent)]
    Refused(#[from] Refused),
}

/// What lists the files of an export: a folder that has it may be written again.
const LIST: &str = "export.json";
/// What the list says of the page, by which it is known as an export's.
const PAGE: &str = "topple explore";
/// Cells along each axis of a stored map.
const STORED: u32 = 129;
/// What a browser without WebGPU is shown of stored maps, beside kinds and marks.
pub const COLUMNS: [&str; 9] = [
    "outcome",
    "impacts",
    "zeta",
    "t_end",
    "max_u",
    "max_v",
    "stroke_v",
    "min_contact",
    "friction_demand",
];

/// A file of the folder: its path there, and its bytes.
type File = (String, Vec<u8>);

/// Writes the page of a session to a folder, with its first scene; `stop` ends the sweeps of the stored maps. Returns
/// the bytes written.
///
/// # Errors
/// [`ExportError`]. A folder that holds anything but an earlier export is left as it is, and of an earlier export every
/// file that it did not write.
pub fn export(directory: &Path, session: &Session, stop: &AtomicBool) -> Result<u64, ExportError> {
    let earlier = earlier(directory)?;
    let is_new = !directory.exists();
    let out = Directory::open(directory)?;
    let written = files(session, stop).and_then(|files| write(&out, &earlier, &files));
    if written.is_err() && is_new {
        // One in which something lies stays.
        let _ = fs::remove_dir(directory);
    }
    written
}

/// Writes files in the place of an earlier export's, each whole or not at all.
pub fn write(out: &Directory, earlier: &[String], files: &[File]) -> Result<u64, ExportError> {
    let names: BTreeSet<&str> = files.iter().map(|(name, _)| &**name).collect();
    let is_listed = |name: &str| earlier.iter().any(|listed| listed == name);
    if names.iter().any(|name| !is_listed(name) && out.file(name).symlink_metadata().is_ok()) {
        return Err(ExportError::Occupied(out.path().into()));
    }
    out.remove_leftovers(&[])?;
    let is_old = |name: &&String| !names.contains(&***name) && is_of_page(name, &names);
    for name in earlier.iter().filter(is_old) {
        let path = out.file(name);
        own::gone(fs::remove_file(&path)).map_err(|error| ExportError::File { path, error })?;
    }
    // The list is first, so that a folder whose writing broke off is known as an export.
    let list = json!({ "page": PAGE, "version": env!("CARGO_PKG_VERSION"), "files": names });
    out.write(LIST, |w| w.write_all(format!("{list:#}").as_bytes()))?;
    for (name, bytes) in files {
        out.write(name, |w| w.write_all(bytes))?;
    }
    Ok(files.iter().map(|(_, bytes)| bytes.len() as u64).sum())
}

/// True of a name that an export may have given: whatever somebody wrote into the list, no other kind of file goes.
fn is_of_page(name: &str, names: &BTreeSet<&str>) -> bool {
    let ending = |name: &str| Path::new(name).extension().map(OsStr::to_os_string);
    names.iter().any(|known| ending(known) == ending(name))
}

/// The files of an earlier export in a folder; none where the folder is empty, or is none.
pub fn earlier(directory: &Path) -> Result<Vec<String>, ExportError> {
    let failed = |error| ExportError::File { path: directory.into(), error };
    // What an export that was killed had begun to write is no file.
    let is_whole = |entry: &io::Result<fs::DirEntry>| {
        let begun = |entry: &fs::DirEntry| temporary::is_file(&entry.file_name().to_string_lossy());
        !entry.as_ref().is_ok_and(begun)
    };
    match fs::read_dir(directory).map(|mut entries| entries.find(is_whole)) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(failed(error)),
        Ok(None) => return Ok(Vec::new()),
        Ok(Some(_)) => {}
    }
    let occupied = || ExportError::Occupied(directory.into());
    let text = bounded::read(&directory.join(LIST), bounded::DOCUMENT).map_err(|_| occupied())?;
    let list: Value = serde_json::from_slice(&text).map_err(|_| occupied())?;
    // Other programs have lists of files, too.
    if list["page"] != PAGE {
        return Err(occupied());
    }
    let files = list["files"].as_array().ok_or_else(occupied)?;
    let names = files.iter().filter_map(Value::as_str).map(String::from);
    // A list that was tampered with reaches nothing beyond the folder.
    let within = |name: &String| {
        Path::new(name).components().all(|part| matches!(part, Component::Normal(_)))
    };
    Ok(names.filter(within).collect())
}

/// All files of an export.
fn files(session: &Session, stop: &AtomicBool) -> Result<Vec<File>, ExportError> {
    let scene = exported(&session.first);
    let pair = record(session)?;
    let record = pair.as_ref().zip(scene.get("horizontal")).map(|(pair, id)| (&**id, pair));
    let constants = constants(record).map_err(Refused::from)?;
    let mut files = Vec::new();
    for file in FILES {
        let bytes = if file.path == INDEX { index().into_bytes() } else { file.bytes.to_vec() };
        files.push((file.path.into(), bytes));
    }
    let (listed, maps) = stored(session, stop)?;
    files.extend(maps);
    let mut about = about::about(session);
    let own = [
        ("engine", json!("webgpu")),
        ("backend", Value::Null),
        ("adapter", Value::Null),
        ("cores", Value::Null),
        ("precision", json!([Precision::F32])),
        ("scene", json!(scene)),
        ("stored", json!(listed)),
    ];
    for (key, value) in own {
        about[key] = value;
    }
    files.push(("about.json".into(), about.to_string().into_bytes()));
    files.push(("model.json".into(), constants.to_string().into_bytes()));
    files.push(("sweep.wgsl".into(), shader().into_bytes()));
    Ok(files)
}

/// The record of the first scene as it is in its files: the page scales it itself. One whose files tell no units is
/// scaled to its peak all the same.
fn record(session: &Session) -> Result<Option<Pair>, Refused> {
    let mut unscaled = session.first.clone();
    for parameter in [Parameter::Scale, Parameter::Pga] {
        unscaled.remove(parameter.key());
    }
    let ready = |flat: &Flat| session.ready(flat, [2, 2], AskedPrecision::F32);
    let ready = ready(&unscaled).or_else(|_| ready(&session.first))?;
    Ok(match ready.scene.excitation {
        Excitation::Record(pair) => Some(pair),
        Excitation::Pulse(_) => None,
    })
}

/// The shader's text for a page.
pub fn shader() -> String {
    shader::source(Precision::F32, Switches::Forgotten)
}

/// The page with the engine that computes in the browser, and with what a server would tell a browser of it.
pub fn index() -> String {
    // A page cannot say itself who may frame it.
    let rules = POLICY.split("; ").filter(|rule| !rule.starts_with("frame-ancestors"));
    let policy = rules.collect::<Vec<&str>>().join("; ");
    let line = format!("<meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">\n");
    page::index(Engine::WebGpu, &line)
}

/// A scene as the exported page has it: its record is known by its name alone, with both components in it.
fn exported(scene: &Flat) -> Flat {
    let mut scene = scene.clone();
    for key in ["vertical", "horizontal_channel", "vertical_channel", "dt", "units"] {
        scene.remove(key);
    }
    scene
}

/// The first scene, and the same on the other kinds of base, each with its title.
pub fn scenes(first: &Flat) -> Vec<(String, Flat)> {
    let kinds = [
        (Directions::Dual, "isolated horizontally and vertically"),
        (Directions::Horizontal, "isolated horizontally alone"),
        (Directions::Vertical, "isolated vertically alone"),
        (Directions::None, "on the ground"),
    ];
    let own = first.get("isolation").map_or("dual", |own| &**own);
    let mut scenes = Vec::new();
    for (directions, title) in kinds {
        let word = json!(directions);
        let word = word.as_str().unwrap_or_default();
        let mut scene = first.clone();
        if word != own {
            scene.insert("isolation".into(), word.into());
            for parameter in directions.locked() {
                scene.remove(parameter.key());
            }
        }
        let at = if word == own { 0 } else { scenes.len() };
        scenes.insert(at, (title.to_string(), scene));
    }
    scenes
}

/// The stored maps: what about.json lists of each, and their files. A scene that makes no sense on another kind of base,
/// such as one without the period that it then needs, has no map.
fn stored(session: &Session, stop: &AtomicBool) -> Result<(Vec<Value>, Vec<File>), Refused> {
    let (mut listed, mut files) = (Vec::new(), Vec::new());
    let columns = COLUMNS.map(String::from);
    for (number, (title, scene)) in scenes(&session.first).into_iter().enumerate() {
        let ready = match session.ready(&scene, [STORED, STORED], AskedPrecision::F32) {
            Ok(ready) => ready,
            Err(refused) if number == 0 => return Err(refused),
            Err(_) => continue,
        };
        let map = view::sweep(&ready, stop)?;
        let told = StageSummary { stage: "stored", cells: map.grid.len(), seconds: None, note: "" };
        let file = format!("stored-{number}.bin");
        files.push((file.clone(), view::framed(&view::whole(&map)?, &ready, &told, &columns)));
        listed.push(json!({ "title": title, "scene": exported(&scene), "file": file }));
    }
    Ok((listed, files))
}
