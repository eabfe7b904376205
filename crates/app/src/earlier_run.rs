//! The results of an earlier run, whose scene `topple run` runs again.

use std::ffi::OsStr;
use std::fs;
use std::path::Path;

use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::{Map, Value};
use topple::results::earlier::{Kind, RUN};
use topple::results::store::IDENTITY;
use topple::results::{npz, shard, zarr};
use topple::scene::excitation::RecordText;
use topple::scene::record::Provenance;
use topple::scene::{Numbers, Parameter, Scene, SceneBuilder, bounded, shown};
use topple::sweep::settings::Method;
use topple_studies::uncertain::Uncertainty;

use super::history_table::MoreColumns;
use super::map_file::{Besides, MapFile, SPECTRUM};
use super::picture_flags::PictureFlags;

/// What was run.
pub struct EarlierRun {
    /// What the results are of.
    pub kind: Kind,
    /// The scene, its record read again.
    pub scene: Scene,
    /// How its cells were computed, where the results tell it.
    pub method: Option<Method>,
    /// What they were computed on, where the results tell it.
    pub backend: Option<String>,
    /// The distributions of a probability map.
    pub uncertainty: Option<Uncertainty>,
    /// What the map had besides.
    pub besides: Besides,
}

/// Of results what says that they are not run again.
#[derive(Clone, Copy, Default, Deserialize)]
struct Of {
    kind: Option<Kind>,
    /// Columns that leaves have in the place of a grid.
    counts: Option<IgnoredAny>,
}

/// Of run.json, or of what a map's arrays say of themselves, what makes the run again.
#[derive(Deserialize)]
struct Written {
    #[serde(flatten)]
    of: Of,
    scene: Scene,
    record: Option<Provenance>,
    backend: Option<String>,
    /// The axes of a map's arrays, the last one first: there the scene's keys are in alphabetical order.
    index: Option<Vec<Parameter>>,
    /// How a map was refined.
    refined: Option<Refined>,
    /// How sharp its boundaries are: that it was requested is enough.
    sharpness: Option<IgnoredAny>,
    /// How its pictures are printed.
    #[serde(default)]
    pictures: PictureFlags,
    /// More columns of a history.
    #[serde(default)]
    more_columns: MoreColumns,
    /// Names of the files beside run.json.
    #[serde(default)]
    files: Vec<String>,
    #[serde(flatten)]
    method: Option<Method>,
    #[serde(flatten)]
    uncertainty: Option<Uncertainty>,
}

/// Of a map's refinement what was requested.
#[derive(Deserialize)]
struct Refined {
    levels: Vec<IgnoredAny>,
    smooth: Option<f64>,
}

/// The results at a path: a directory, a run.json, or a map's file; none where it is no such thing.
///
/// # Errors
/// What is wrong with them and what to do.
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
    let read = if is_zarr {
        text_of(&path.join(zarr::DOCUMENT)).and_then(|text| {
            let Group { attributes } = serde_json::from_str(&text).map_err(unread)?;
            parsed(&Value::Object(zarr::nested(attributes)).to_string())
        })
    } else if path.is_dir() {
        let inside = path.join(RUN);
        match inside.exists() {
            true => text_of(&inside).and_then(|text| parsed(&text)),
            false => Err(format!("a directory without {RUN}; give a scene's file, or results")),
        }
    } else if ends_in(path, "npz") {
        let about = npz::about(path)
            .map_err(|error| format!("{}; give a map of topple", shown::line(&error.to_string())));
        about.and_then(|text| parsed(&text))
    } else if ends_in(path, "csv") {
        let beside = folder.join(RUN);
        match beside.exists() {
            true => text_of(&beside).and_then(|text| parsed(&text)),
            false => Err(format!("a table holds no scene, and no {RUN} lies beside it; give that")),
        }
    } else if ends_in(path, "json") {
        text_of(path).and_then(|text| parsed(&text))
    } else {
        return None;
    };
    Some(read.and_then(|written| written.again(folder)))
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

fn parsed(text: &str) -> Result<Written, String> {
    let written: Result<Written, _> = serde_json::from_str(text);
    let of = match &written {
        Ok(written) => written.of,
        // What is not run again may lack a scene.
        Err(_) => serde_json::from_str(text).unwrap_or_default(),
    };
    if let Some(problem) = of.kind.and_then(not_of_a_scene) {
        return Err(problem.into());
    }
    if of.counts.is_some() {
        return Err(format!("leaves of a refined map; give the {RUN} beside them"));
    }
    written.map_err(unread)
}

fn unread(error: serde_json::Error) -> String {
    let error = shown::line(&error.to_string());
    format!("no results of this version of topple ({error}); give a scene")
}

/// Why results of a kind are not run again by `topple run`; none where they are.
fn not_of_a_scene(kind: Kind) -> Option<&'static str> {
    match kind {
        Kind::Map | Kind::History | Kind::Probability => None,
        Kind::Suite => Some("a suite is no scene; read it again by topple suite"),
        Kind::Envelope => Some("its run.json has no command; run it again by topple envelope"),
        Kind::Fragility => Some("its run.json has no command; run it again by topple fragility"),
        Kind::Comparison => Some("its run.json has no command; run it again by topple compare"),
    }
}

impl Written {
    /// Checks the scene; files of its record that are not where they were are looked for in `folder` and in
    /// the working directory.
    fn again(mut self, folder: &Path) -> Result<EarlierRun, String> {
        if let Some(index) = &self.index {
            let mut numbers = Numbers::default();
            for parameter in index.iter().rev() {
                let values = self.scene.numbers.get(*parameter).cloned();
                numbers.extend(values.map(|values| (*parameter, values)));
            }
            for (parameter, values) in self.scene.numbers.iter() {
                numbers.set(parameter, values.clone());
            }
            self.scene.numbers = numbers;
            // A map's arrays have the names of the files alone, run.json beside them has their places.
            if let Some(record) = &self.record
                && let Ok(text) = bounded::text(&folder.join(RUN), bounded::DOCUMENT)
                && let Ok(beside) = serde_json::from_str::<Written>(&text)
                && let Some(there) = beside.record
                && there.without_folders() == record.without_folders()
            {
                self.record = Some(there);
            }
        }
        let record = match (&self.record, self.scene.excitation.record()) {
            (Some(record), _) => Some(RecordText::found(record, &[folder, Path::new("")])?),
            (None, Some(_)) => {
                let problem = "it does not say where its record lies; give that to topple seismic";
                return Err(problem.into());
            }
            (None, None) => None,
        };
        let scene = SceneBuilder::again(&self.scene, record).check();
        let scene = scene.map_err(|error| error.to_string())?;
        let kind = self.of.kind.unwrap_or(Kind::Map);
        let Written { method, backend, uncertainty, refined, sharpness, files, .. } = self;
        let (pictures, more_columns) = (self.pictures, self.more_columns);
        let besides = Besides {
            refine: refined.as_ref().map(|refined| refined.levels.len() as u32),
            smooth: refined.and_then(|refined| refined.smooth),
            sharpness: sharpness.is_some(),
            spectrum: files.iter().any(|file| file == SPECTRUM),
            files: MapFile::among(&files),
            pictures,
            more_columns,
        };
        Ok(EarlierRun { kind, scene, method, backend, uncertainty, besides })
    }
}
