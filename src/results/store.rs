//! A sweep on disk while it runs: what is done is saved, so that an interrupted run goes on from there.
//!
//! A folder in the run's directory holds the run's [`Identity`], a lock, and a [Zarr group](super::zarr)
//! whose chunks are tiles. A file appears whole or not at all; of a tile's files that of the status comes
//! last, and says which of its cells have run. A whole map's folder is `unfinished`, and goes when the map is
//! written. A part's is `part-3-of-16`, and stays: a report is added when the part is done.

use std::fs::{self, File};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use super::about::Source;
use super::block::Block;
use super::columns::Column;
use super::files::{self, Directory};
use super::group::{self, TileFiles};
use super::identity::Identity;
use super::lock::{self, lock};
use super::rounds::Rounds;
use super::saved_tiles::SavedTiles;
use super::store_error::StoreError;
use super::tiling::Tiling;
use super::{tile, zarr};
use crate::model::precision::Precision;
use crate::scene::Grid;

/// Name of a whole map's folder in a run's directory.
const FOLDER: &str = "unfinished";
/// Name of the identity's file.
pub const IDENTITY: &str = "identity.json";
/// How the names of folders of lists begin.
pub const LISTS: &str = "lists";
/// Name of a finished part's report.
pub const REPORT: &str = "report.json";

/// What a store holds: the outcomes of a grid.
#[derive(Debug, Clone, Copy)]
pub struct Contents<'a> {
    /// The cells.
    pub grid: &'a Grid,
    /// What they are of.
    pub source: Source<'a>,
}

/// A sweep's folder, locked for as long as it lives.
#[derive(Debug)]
pub struct Store {
    folder: Directory,
    path: PathBuf,
    /// None once the folder is no longer this run's.
    lock: Option<File>,
    identity: Identity,
    /// The files that every group has, but its chunks: paths and bytes.
    frame: Vec<(String, Vec<u8>)>,
    tiling: Tiling,
    precision: Precision,
}

impl Store {
    /// Opens the folder in `out` for a run; with `resume` goes on with what an earlier one left.
    ///
    /// # Errors
    /// [`StoreError`]: another run is there, or an unfinished one that is not to be resumed or is not
    /// this one.
    pub fn open(
        out: &Path,
        identity: Identity,
        contents: Contents,
        resume: bool,
    ) -> Result<(Store, SavedTiles), StoreError> {
        let (path, place) = match identity.part() {
            None => (out.join(FOLDER), out.to_path_buf()),
            Some(part) => (out.join(part.folder()), out.join(part.folder())),
        };
        let folder = Directory::open(&path)?;
        let lock = lock(&path, &place)?;
        // Nobody else is writing there: the lock is held.
        folder.remove_leftovers()?;
        if place != path {
            Directory::open(&place)?.remove_leftovers()?;
        }
        let documents = zarr::documents(contents.grid, &contents.source);
        let store = Store {
            folder,
            path,
            lock: Some(lock),
            frame: group::frame(contents.grid, documents, identity.tag()),
            identity,
            tiling: Tiling::of(contents.grid),
            precision: contents.source.precision,
        };
        let before = store.path.join(IDENTITY);
        if !before.exists() {
            // What a run left that was killed while it cleared up, or what is not a run's at all.
            store.folder.clear(&[lock::NAME])?;
            return Ok((store, SavedTiles::default()));
        }
        if !resume && store.path.join(REPORT).exists() {
            return Err(StoreError::Finished(place));
        }
        if !resume {
            return Err(StoreError::Unfinished(place));
        }
        let text = fs::read(&before).map_err(StoreError::file(&before))?;
        let text = String::from_utf8_lossy(&text);
        if let Some(difference) = store.identity.difference(&text) {
            return Err(StoreError::Other { place, difference });
        }
        let found =
            SavedTiles::in_folder(&store.path, &store.tiling, store.identity.tag(), &|_| ())?;
        for (path, _) in &found.broken {
            if path.exists() {
                fs::remove_file(path).map_err(StoreError::file(path))?;
            }
        }
        Ok((store, found))
    }

    /// True where a directory has the folder of a map that runs, or was interrupted.
    pub fn is_begun(out: &Path) -> bool {
        out.join(FOLDER).exists()
    }

    /// The tiles of its grid.
    pub fn tiling(&self) -> &Tiling {
        &self.tiling
    }

    /// The number type of its columns.
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// What ties its tiles to its identity.
    pub fn tag(&self) -> u32 {
        self.identity.tag()
    }

    /// Its folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// True when something was saved in it.
    pub fn is_used(&self) -> bool {
        self.path.join(IDENTITY).exists()
    }

    /// Says whose the folder is, where nothing was saved in it yet.
    fn begin(&self) -> Result<(), StoreError> {
        if !self.is_used() {
            self.write_frame()?;
            self.folder.write(IDENTITY, |w| w.write_all(self.identity.text().as_bytes()))?;
        }
        Ok(())
    }

    /// Lists of cells of another grid that are saved beside the tiles, in a folder of this name.
    ///
    /// # Errors
    /// [`StoreError::Write`].
    pub fn rounds(&self, name: &str) -> Result<Rounds, StoreError> {
        self.begin()?;
        Rounds::open(&self.path.join(name), self.identity.tag(), self.precision)
    }

    /// Saves a tile of which some cells at least have run: they are on disk, whole, when this returns.
    ///
    /// # Errors
    /// [`StoreError::Write`]; what was saved of the tile before is still there.
    pub fn save(&self, tile: usize, block: &Block) -> Result<(), StoreError> {
        self.save_while(tile, block, &|| true).map(|_| ())
    }

    /// The same while it is to `go_on`, which is asked before each file; false where it ended early, and the tile
    /// is as it was. Of a run that had saved nothing, and is not to go on, nothing is left.
    ///
    /// # Errors
    /// Those of [`Store::save`].
    pub fn save_while(
        &self,
        tile: usize,
        block: &Block,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<bool, StoreError> {
        if !go_on() {
            return Ok(false);
        }
        self.begin()?;
        let to = TileFiles { folder: &self.folder, tiling: &self.tiling, tag: self.identity.tag() };
        Ok(to.write(tile, block, go_on)?)
    }

    /// Writes the files of the group, but the chunks of its columns.
    fn write_frame(&self) -> Result<(), StoreError> {
        for (path, bytes) in &self.frame {
            self.folder.write(path, |w| w.write_all(bytes))?;
        }
        Ok(())
    }

    /// Reads a tile that was found whole.
    ///
    /// # Errors
    /// Those of the disk, with the file's name.
    pub fn read(&self, tile: usize) -> io::Result<Block> {
        let chunk = |array: &str| fs::read(self.chunk(array, tile));
        let sizes = (self.tiling.cells(tile).len(), self.tiling.tile_cells());
        tile::decode_all(sizes, self.precision, chunk)?.ok_or_else(|| {
            let path = self.chunk(Column::Status.entry().name, tile);
            let problem = format!("{}: its tile was damaged since it was found", path.display());
            io::Error::new(ErrorKind::InvalidData, problem)
        })
    }

    fn chunk(&self, array: &str, tile: usize) -> PathBuf {
        self.path.join(zarr::chunk_path(array, &self.tiling, tile))
    }

    /// Says that all of a part is there, and how it was run, in its report; one that is there already
    /// and is `resumed` whole stays.
    ///
    /// # Errors
    /// [`StoreError::Write`], with nothing left behind.
    pub fn finish(
        self,
        report: &impl serde::Serialize,
        resumed: bool,
    ) -> Result<PathBuf, StoreError> {
        if !(resumed && self.path.join(REPORT).exists()) {
            self.folder.write(REPORT, |w| serde_json::to_writer_pretty(w, report))?;
        }
        Ok(self.path.clone())
    }

    /// Gives the folder the name of a finished map in its directory, in the place of one that is there, and
    /// takes away what only a running sweep needs.
    ///
    /// # Errors
    /// [`StoreError::File`]; the map that was there is there still, or the new one is.
    pub fn publish(mut self, place: &Path) -> Result<(), StoreError> {
        // Whatever became of them while the tiles were looked after.
        self.write_frame()?;
        // An open file keeps a folder's name on some systems.
        drop(self.lock.take());
        let path = &self.path;
        let aside = files::put(path, place).map_err(StoreError::file(path))?;
        for name in [lock::NAME, IDENTITY] {
            remove(&place.join(name))?;
        }
        for folder in fs::read_dir(place).map_err(StoreError::file(place))? {
            let folder = folder.map_err(StoreError::file(place))?;
            if folder.file_name().to_string_lossy().starts_with(LISTS) {
                remove(&folder.path())?;
            }
        }
        remove(&aside)
    }

    /// Removes the folder: its run is finished, or left nothing to go on with.
    ///
    /// # Errors
    /// [`StoreError::File`].
    pub fn discard(mut self) -> Result<(), StoreError> {
        // An open file cannot be removed everywhere.
        drop(self.lock.take());
        // First what says that the tiles are a run's: of some of them none is to go on.
        remove(&self.path.join(IDENTITY))?;
        remove(&self.path)
    }
}

/// Removes a file or a folder, if it is there.
fn remove(path: &Path) -> Result<(), StoreError> {
    files::remove(path).map_err(StoreError::file(path))
}

/// A folder in which nothing was saved goes.
impl Drop for Store {
    fn drop(&mut self) {
        // One that was published is not there any more.
        if self.lock.take().is_some() && !self.is_used() {
            // What cannot be removed does no harm: the next run finds an empty folder.
            let _ = fs::remove_dir_all(&self.path);
        }
    }
}
