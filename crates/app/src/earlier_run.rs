//! The results of an earlier run, whose scene `topple run` runs again.

use std::ffi::OsStr;
use std::fs;
use std::path::Path;

use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::{Map, Value};
use topple::results::earlier::RUN;
use topple::results::store::IDENTITY;
use topple::results::{npz, shard, zarr};
use topple::scene::record::{Provenance, RecordText};
use topple::scene::{Numbers, Parameter, Scene, SceneBuilder, bounded, shown};
use topple_manifest::{Manifest, Run};

/// What was run.
pub struct EarlierRun {
    /// The scene, its record read again.
    pub scene: Scene,
    /// How it was computed, and what it had besides; none of a map's arrays, which tell the scene alone.
    pub manifest: Option<Manifest>,
}

/// What a map's arrays say of themselves.
#[derive(Deserialize)]
struct Arrays {
    scene: Scene,
    record: Option<Provenance>,
    /// The axes, the last one first: the scene's keys are in alphabetical order.
    index: Option<Vec<Parameter>>,
}

/// Of what arrays say of themselves that they are leaves of a refined map, which have these columns in the place of a grid.
#[derive(Deserialize)]
struct Leaves {
    #[serde(rename = "counts")]
    _counts: IgnoredAny,
}

/// The results at a path: a directory, a run.json, or a map's file; none where it is no such thing.
pub fn at(path: &Path) -> Option<Result<EarlierRun, String>> {
    // Its cells are saved as those of a map in chunks.
    if holds_shards(path) {
        return Some(Err(
            "shards of a map; join them by topple merge, and run the map again".into()
        ));
    }
    // A map in chunks is a folder beside run.json.
    let is_zarr = path.join(zarr::DOCUMENT).exists();
    let inside = path.is_dir() && !is_zarr;
    let folder = if inside { path } else { path.parent().unwrap_or(Path::new("")) };
    let run = |path: &Path| text_of(path).and_then(|text| of_run(&text, folder));
    Some(if is_zarr {
        text_of(&path.join(zarr::DOCUMENT)).and_then(|text| {
            let Group { attributes } = serde_json::from_str(&text).map_err(unread)?;
            of_arrays(&Value::Object(zarr::nested(attributes)).to_string(), folder)
        })
    } else if path.is_dir() {
        let inside = path.join(RUN);
        match inside.exists() {
            true => run(&inside),
            false => Err(format!("a directory without {RUN}; give a scene's file, or results")),
        }
    } else if ends_in(path, "npz") {
        let about = npz::about(path)
            .map_err(|error| format!("{}; give a map of topple", shown::line(&error.to_string())));
        about.and_then(|text| of_arrays(&text, folder))
    } else if ends_in(path, "csv") {
        let beside = folder.join(RUN);
        match beside.exists() {
            true => run(&beside),
            false => Err(format!("a table holds no scene, and no {RUN} lies beside it; give that")),
        }
    } else if ends_in(path, "json") {
        run(path)
    } else {
        return None;
    })
}

/// True of a directory with shards of a map and no whole one, and of a shard's own.
fn holds_shards(path: &Path) -> bool {
    let is_shard = |name: &OsStr| name.to_string_lossy().starts_with(shard::FOLDER);
    let entries = || fs::read_dir(path).into_iter().flatten().flatten();
    let has_shards = || entries().any(|entry| is_shard(&entry.file_name()));
    path.join(IDENTITY).exists() || (!path.join(RUN).exists() && has_shards())
}

/// The document of a Zarr group.
#[derive(Deserialize)]
struct Group {
    attributes: Map<String, Value>,
}

fn ends_in(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|own| own.eq_ignore_ascii_case(ending))
}

fn text_of(path: &Path) -> Result<String, String> {
    let text = bounded::text(path, bounded::DOCUMENT);
    text.map_err(|error| format!("{error}; give results that can be read"))
}

fn unread(error: serde_json::Error) -> String {
    let error = shown::line(&error.to_string());
    format!("no results of this version of topple ({error}); give a scene")
}

/// The run of a run.json.
fn of_run(text: &str, folder: &Path) -> Result<EarlierRun, String> {
    let manifest = Manifest::parse(text).map_err(unread)?;
    if let Run::Suite(_) = &manifest.run {
        return Err("a suite is no scene; read it again by topple suite".into());
    }
    if let Some(name) = manifest.run.kind().study() {
        return Err(format!("its {RUN} has no command; run it again by topple {name}"));
    }
    let Some(scene) = manifest.run.scene() else {
        return Err("it has no scene; give one".into());
    };
    let scene = checked(scene, manifest.run.record(), folder)?;
    Ok(EarlierRun { scene, manifest: Some(manifest) })
}

/// The run of what a map's arrays say of themselves.
fn of_arrays(text: &str, folder: &Path) -> Result<EarlierRun, String> {
    if serde_json::from_str::<Leaves>(text).is_ok() {
        return Err(format!("leaves of a refined map; give the {RUN} beside them"));
    }
    let Arrays { mut scene, mut record, index } = serde_json::from_str(text).map_err(unread)?;
    let mut numbers = Numbers::default();
    for parameter in index.iter().flatten().rev() {
        let values = scene.numbers.get(*parameter).cloned();
        numbers.extend(values.map(|values| (*parameter, values)));
    }
    for (parameter, values) in scene.numbers.iter() {
        numbers.set(parameter, values.clone());
    }
    scene.numbers = numbers;
    // They have the names of the record's files alone, run.json beside them has their places.
    if let Some(bare) = &record
        && let Ok(Manifest { run, .. }) = Manifest::read(&folder.join(RUN))
        && let Some(there) = run.record()
        && there.without_folders() == bare.without_folders()
    {
        record = Some(there.clone());
    }
    let scene = checked(&scene, record.as_ref(), folder)?;
    Ok(EarlierRun { scene, manifest: None })
}

/// Checks a scene; files of its record that are not where they were are looked for in `folder` and in the working directory.
fn checked(scene: &Scene, record: Option<&Provenance>, folder: &Path) -> Result<Scene, String> {
    let record = match (record, scene.excitation.record()) {
        (Some(record), _) => Some(RecordText::found(record, &[folder, Path::new("")])?),
        (None, Some(_)) => {
            let problem = "it does not say where its record lies; give that to topple seismic";
            return Err(problem.into());
        }
        (None, None) => None,
    };
    SceneBuilder::again(scene, record).check().map_err(|error| error.to_string())
}
