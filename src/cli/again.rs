//! The results of an earlier run, whose scene `topple run` runs again.

use std::path::Path;

use serde::Deserialize;
use serde::de::DeserializeOwned;
use topple::map::earlier::{Kind, RUN};
use topple::results::{npz, zarr};
use topple::scene::excitation::RecordText;
use topple::scene::record::Provenance;
use topple::scene::{Numbers, Parameter, Scene, SceneBuilder, bounded, shown};
use topple::sweep::settings::Method;
use topple::uncertain::Uncertainty;

/// What was run.
pub struct Again {
    /// What the results are of.
    pub kind: Kind,
    /// The scene, its record read again.
    pub scene: Scene,
    /// How its cells were computed, where the results tell it.
    pub method: Option<Method>,
    /// What they were computed on, where the results tell it.
    pub backend: Option<String>,
    /// What was not known, of a probability map.
    pub uncertainty: Option<Uncertainty>,
}

/// Of run.json, or of what a map's arrays say of themselves, what makes the run again.
#[derive(Deserialize)]
struct Written {
    kind: Option<Kind>,
    scene: Scene,
    record: Option<Provenance>,
    backend: Option<String>,
    /// The axes of a map's arrays, the last one first: there the scene's keys are in alphabetical order.
    index: Option<Vec<Parameter>>,
    #[serde(flatten)]
    method: Option<Method>,
    #[serde(flatten)]
    uncertainty: Option<Uncertainty>,
}

/// The results at a path: a directory, a run.json, or a map's file; none where it is no such thing.
///
/// # Errors
/// What is wrong with them and what to do.
pub fn at(path: &Path) -> Option<Result<Again, String>> {
    // A map in chunks is a folder beside run.json.
    let is_zarr = path.join(zarr::DOCUMENT).exists();
    let inside = path.is_dir() && !is_zarr;
    let folder = if inside { path } else { path.parent().unwrap_or(Path::new("")) };
    let read = if is_zarr {
        text_of(&path.join(zarr::DOCUMENT)).and_then(|text| {
            let group: Group = parsed(&text)?;
            Ok(group.attributes)
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

/// The document of a Zarr group.
#[derive(Deserialize)]
struct Group {
    attributes: Written,
}

fn ends_in(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|own| own.eq_ignore_ascii_case(ending))
}

fn text_of(path: &Path) -> Result<String, String> {
    let text = bounded::text(path, bounded::DOCUMENT);
    text.map_err(|error| format!("{error}; give results that can be read"))
}

fn parsed<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    #[derive(Deserialize)]
    struct Of {
        kind: Kind,
    }
    match serde_json::from_str(text) {
        Ok(Of { kind: Kind::Suite }) => {
            return Err("a suite is no scene; read it again by topple suite".into());
        }
        Ok(Of { kind: Kind::Envelope }) => {
            return Err("an envelope has many motions; run it again by topple envelope".into());
        }
        _ => {}
    }
    let problem = |error: serde_json::Error| {
        let error = shown::line(&error.to_string());
        format!("no results of this version of topple ({error}); give a scene")
    };
    serde_json::from_str(text).map_err(problem)
}

impl Written {
    /// Checks the scene; files of its record that are not where they were are looked for in `folder` and in
    /// the working directory.
    fn again(mut self, folder: &Path) -> Result<Again, String> {
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
        }
        // A map's arrays have the names of the files alone, run.json beside them has their places.
        if let Some(record) = &self.record
            && let Ok(text) = bounded::text(&folder.join(RUN), bounded::DOCUMENT)
            && let Ok(beside) = serde_json::from_str::<Written>(&text)
            && let Some(there) = beside.record
            && there.without_folders() == record.without_folders()
        {
            self.record = Some(there);
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
        let kind = self.kind.unwrap_or(Kind::Map);
        let Written { method, backend, uncertainty, .. } = self;
        Ok(Again { kind, scene, method, backend, uncertainty })
    }
}
