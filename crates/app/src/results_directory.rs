//! The directory of a command's results: what is in the way of it is refused before anything is computed, what an earlier
//! command left goes when the first file is written, and run.json comes last.

use std::fs;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use topple::results::earlier::{self, Earlier, Kind};
use topple::results::files::{Directory, WriteError};
use topple::results::lock::Lock;
use topple::results::store::Store;
use topple_manifest::{Manifest, Run};
use topple_pictures::drawing::letters;
use topple_pictures::drawing::picture::Picture;
use topple_studies::suites::saved;

use super::words::{self, Reporter};
use super::{COMMIT, InputError, date};

fn refused(error: impl std::fmt::Display) -> InputError {
    InputError(format!("--out: {error}"))
}

/// Opens a directory.
pub fn open(out: &Path) -> Result<Directory, InputError> {
    Directory::open(out).map_err(refused)
}

/// The files of a picture.
pub fn picture_files(name: &str) -> [String; 2] {
    [format!("{name}.svg"), format!("{name}.png")]
}

/// Writes a picture as NAME.svg and NAME.png, and warns of letters that no font has.
pub fn write_picture(
    out: &Directory,
    name: &str,
    picture: &Picture,
    png: &[u8],
) -> Result<(), WriteError> {
    words::warn_of_letters(letters::missing([picture]));
    let [of_svg, of_png] = picture_files(name);
    out.write(&of_svg, |w| w.write_all(picture.svg().as_bytes()))?;
    out.write(&of_png, |w| w.write_all(png))?;
    Ok(())
}

/// A directory that was looked at: nothing is made there yet.
pub struct Place {
    path: PathBuf,
    /// What an earlier command left there.
    earlier: Earlier,
}

impl Place {
    /// A directory for results of a kind.
    ///
    /// # Errors
    /// It holds something of another kind, or another run is at work there: its files are not to lie beside the new ones.
    pub fn of(out: &Path, kind: Kind) -> Result<Place, InputError> {
        let earlier = Earlier::of(out).map_err(refused)?;
        let of_suite = kind.study().is_some();
        let at_work = [
            ("a map runs", kind != Kind::Map && Store::is_begun(out)),
            ("a sweep under a suite runs", !of_suite && saved::is_taken(out)),
        ];
        let place = out.display();
        if let Some((what, _)) = at_work.iter().find(|(_, is_begun)| *is_begun) {
            let problem = "or was interrupted; give another directory";
            return Err(refused(format_args!("{what} in {place}, {problem}")));
        }
        if let Some(other) = earlier.kind.filter(|other| *other != kind) {
            let (other, new) = (other.name(), kind.name());
            let problem = format!("{place} holds {other}; give {new} a directory of its own");
            return Err(refused(problem));
        }
        Ok(Place { path: out.to_path_buf(), earlier })
    }

    /// Refuses something that no run wrote and that has the place of one of these files.
    pub fn refuse_foreign(&self, names: &[String]) -> Result<(), InputError> {
        self.earlier.refuse_foreign(names, &self.path).map_err(refused)
    }

    /// The checksum of what the map that lies there depends on.
    pub fn tag(&self) -> Option<u32> {
        self.earlier.tag
    }

    /// Makes the directory, if need be.
    pub fn open(self) -> Result<Results, InputError> {
        let out = open(&self.path)?;
        Ok(Results { out, place: self, files: Vec::new(), _held: None })
    }

    /// The same of a command that saves nothing on its way: no other run begins there while its results live.
    pub fn open_alone(self) -> Result<Results, InputError> {
        let is_new = !self.path.exists();
        let out = open(&self.path)?;
        let lock = Some(Store::lock(&self.path).map_err(refused)?);
        let held = Held { lock, path: self.path.clone(), is_new };
        Ok(Results { out, place: self, files: Vec::new(), _held: Some(held) })
    }
}

/// A directory that no other run begins in.
struct Held {
    /// Gone before the directory is.
    lock: Option<Lock>,
    path: PathBuf,
    is_new: bool,
}

impl Drop for Held {
    /// A directory that was made, and in which nothing was written, goes.
    fn drop(&mut self) {
        drop(self.lock.take());
        if self.is_new {
            // One in which something lies stays.
            let _ = fs::remove_dir(&self.path);
        }
    }
}

/// The results of a command.
pub struct Results {
    /// Where they are.
    pub out: Directory,
    place: Place,
    files: Vec<String>,
    _held: Option<Held>,
}

impl Results {
    /// Says which files come, removes what an earlier command left that is not among them, and tells it.
    pub fn begin(&mut self, files: Vec<String>, say: &Reporter) -> anyhow::Result<()> {
        let removed = self.place.earlier.begin(&files, &self.out).map_err(|error| match error {
            error @ WriteError::Foreign(_) => refused(error).into(),
            error => anyhow::Error::from(error),
        })?;
        if !removed.is_empty() {
            say.line("removed", format!("{} of the run before", removed.join(", ")));
        }
        self.files = files;
        Ok(())
    }

    /// Writes a file.
    pub fn write<E: std::fmt::Display>(
        &self,
        name: &str,
        contents: impl FnOnce(&mut BufWriter<&mut fs::File>) -> Result<(), E>,
    ) -> Result<PathBuf, WriteError> {
        self.out.write(name, contents)
    }

    /// Writes a picture as NAME.svg and NAME.png.
    pub fn picture(&self, name: &str, picture: &Picture, png: &[u8]) -> Result<(), WriteError> {
        write_picture(&self.out, name, picture, png)
    }

    /// The path of a file.
    pub fn file(&self, name: &str) -> PathBuf {
        self.out.file(name)
    }

    /// run.json of a run.
    pub fn run(&self, run: Run) -> Manifest {
        Manifest {
            kind: run.kind(),
            version: env!("CARGO_PKG_VERSION").into(),
            commit: COMMIT.map(String::from),
            date: Some(date::now()),
            run,
            warnings: words::warnings(),
            files: self.files.clone(),
        }
    }

    /// Writes run.json.
    pub fn finish(&self, run: Run) -> Result<(), WriteError> {
        earlier::finish(&self.out, &self.run(run))
    }
}
