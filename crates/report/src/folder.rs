//! The files of a run, as run.json names them.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use topple::results::earlier::RUN;
use topple::results::files::WriteError;
use topple::scene::{Parameter, Scene, bounded};
use topple_manifest::{Manifest, Run};
use topple_pictures::drawing::error::FigureError;
use topple_pictures::drawing::picture::Picture;

/// Why there is no report.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A folder that holds no run.
    #[error(
        "{0}: no results of topple: {1}; give the directory that a command of topple wrote with --out"
    )]
    NoRun(PathBuf, String),
    /// A file that run.json names and that is not as the run wrote it.
    #[error("{0}: {1}; run the command again that wrote the directory")]
    File(PathBuf, String),
    /// A place where the report cannot be.
    #[error("{0}")]
    Place(String),
    /// The disk.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A picture that cannot be made.
    #[error(transparent)]
    Figure(#[from] FigureError),
}

/// A run: its directory and its run.json.
#[derive(Debug)]
pub struct Folder {
    /// Where it is.
    pub path: PathBuf,
    /// Its run.json.
    pub manifest: Manifest,
}

/// A table of a run: each row by the names of the columns.
pub type Rows = Vec<Row>;

/// A row of a table, by its columns.
pub type Row = BTreeMap<String, String>;

impl Folder {
    /// Reads the run.json of a directory, and looks whether all files are there that it names.
    ///
    /// # Errors
    /// [`ReportError`]: no run, or one that lacks a file.
    pub fn read(path: &Path) -> Result<Folder, ReportError> {
        let none = |why: String| ReportError::NoRun(path.into(), why);
        // Its run.json stands for the directory.
        let is_run = path.file_name().is_some_and(|name| name == RUN) && path.is_file();
        let path = match path.parent().filter(|_| is_run) {
            Some(place) if place.as_os_str().is_empty() => Path::new("."),
            Some(place) => place,
            None if path.is_file() => return Err(none("it is a file".into())),
            None => path,
        };
        let manifest = Manifest::read(&path.join(RUN));
        let manifest = manifest.map_err(|error| none(format!("{RUN}: {error}")))?;
        let folder = Folder { path: path.to_path_buf(), manifest };
        for name in &folder.manifest.files {
            if Path::new(name).file_name().is_none_or(|only| only != name.as_str()) {
                return Err(none(format!("{RUN} names {name:?}, which is no file beside it")));
            }
            let place = folder.path.join(name);
            if !place.exists() {
                let problem = format!("{RUN} names it, and it is not there");
                return Err(ReportError::File(place, problem));
            }
        }
        Ok(folder)
    }

    /// The pictures, by their names without an ending.
    pub fn pictures(&self) -> Result<Vec<(&str, Picture)>, ReportError> {
        let names = self.manifest.files.iter().filter_map(|name| name.strip_suffix(".svg"));
        names.map(|name| Ok((name, self.picture(name)?))).collect()
    }

    /// A picture from its SVG; from its PNG where that is not of marks as pictures are: the outlines of a refined map, and what
    /// was changed since.
    fn picture(&self, name: &str) -> Result<Picture, ReportError> {
        let read = |ending| -> Result<(PathBuf, Vec<u8>), ReportError> {
            let path = self.path.join(format!("{name}.{ending}"));
            match bounded::read(&path, bounded::DOCUMENT) {
                Ok(bytes) => Ok((path, bytes)),
                Err(error) => Err(ReportError::File(path, error.to_string())),
            }
        };
        let (_, svg) = read("svg")?;
        if let Some(picture) = std::str::from_utf8(&svg).ok().and_then(Picture::of_svg) {
            return Ok(picture);
        }
        let (path, png) = read("png")?;
        Picture::of_png(png).map_err(|error| ReportError::File(path, error.to_string()))
    }

    /// The rows of a table; none where the run has none of this name.
    pub fn table(&self, name: &str) -> Result<Option<Rows>, ReportError> {
        if !self.manifest.files.iter().any(|file| file == name) {
            return Ok(None);
        }
        let path = self.path.join(name);
        let failed = |error: String| ReportError::File(path.clone(), error);
        let bytes = bounded::read(&path, bounded::DOCUMENT).map_err(|e| failed(e.to_string()))?;
        let mut reader = csv::Reader::from_reader(bytes.as_slice());
        let rows = reader.deserialize().collect::<Result<Rows, csv::Error>>();
        rows.map(Some).map_err(|error| failed(error.to_string()))
    }

    /// What the run was, and what came of it.
    pub fn run(&self) -> &Run {
        &self.manifest.run
    }

    /// The scene, where it has one.
    pub fn scene(&self) -> Option<&Scene> {
        self.run().scene()
    }

    /// The scenes of the run: of a comparison one for each device.
    pub fn scenes(&self) -> Vec<&Scene> {
        match self.run() {
            Run::Comparison(run) if !run.own.devices.is_empty() => {
                run.own.devices.iter().map(|device| &device.scene).collect()
            }
            run => run.scene().into_iter().collect(),
        }
    }

    /// By what all motions of a suite are multiplied, where it is not 1.
    pub fn scale(&self) -> Option<f64> {
        let scale = self.scenes().first()?.numbers.get(Parameter::Scale)?.single()?;
        (scale != 1.0).then_some(scale)
    }

    /// The title that was asked for with the run.
    pub fn title(&self) -> Option<&str> {
        self.run().pictures().title.as_deref()
    }
}
