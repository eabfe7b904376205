//! A sweep on disk while it runs: what is done is saved, so that an interrupted run goes on from there.
//!
//! A folder in the run's directory holds the run's [`Identity`], a lock, and a [Zarr group](super::zarr)
//! of the grid's chunks. A file appears whole or not at all; of a chunk's files that of the status comes
//! last, and says which of its cells have run. A whole map's folder is `unfinished`, and goes when the map is
//! written. A shard's is `part-3-of-16`, and stays: a report is added when the shard is done.
//!
//! What goes is what a run wrote, by its [names](super::own); a folder in which something else lies is not a run's
//! before it has an identity, and stays with that after.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use super::about::Source;
use super::block::Block;
use super::chunk_files::ChunkFiles;
use super::chunking::Chunking;
use super::files::{self, Directory, WriteError};
use super::group;
use super::identity::Identity;
use super::lock::{self, Holds, Lock, lock};
use super::own::{self, Kind};
pub use super::own::{IDENTITY, LISTS, REPORT, SAMPLES};
use super::rounds::Rounds;
use super::saved_chunks::SavedChunks;
use super::store_error::StoreError;
use super::{temporary, zarr};
use crate::scene::record::Pair;
use crate::scene::{Grid, bounded};

/// Largest identity that is read, bytes: long lists of numbers may stand in it.
pub const LARGEST_IDENTITY: u64 = 1 << 30;
/// Name of a whole map's folder in a run's directory.
const FOLDER: &str = "unfinished";
/// The folders that a whole map's run makes in its directory and renames.
const RENAMED: [&str; 3] = [FOLDER, own::MAP, own::LEAVES];

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
    files: ChunkFiles,
    identity: Identity,
    /// The files that every group has, but those of its chunks: paths and bytes.
    metadata: Vec<(String, Vec<u8>)>,
    /// The record of a shard: its samples are saved, because whoever joins shards has no scene with them.
    record: Option<Pair>,
    /// The metadata and the samples are there.
    has_metadata: AtomicBool,
    /// Given up last, when the folder is no longer this run's.
    _lock: Lock,
}

impl Store {
    /// Opens the folder in `out` for a run; with `resume` goes on with what an earlier one left.
    ///
    /// # Errors
    /// [`StoreError`]: another run is there, an unfinished one that is not to be resumed or is not this one, or what no
    /// run wrote.
    pub fn open(
        out: &Path,
        identity: Identity,
        contents: Contents,
        resume: bool,
    ) -> Result<(Store, SavedChunks), StoreError> {
        let (path, place) = match identity.shard() {
            None => (out.join(FOLDER), out.to_path_buf()),
            Some(shard) => (out.join(shard.folder()), out.join(shard.folder())),
        };
        let directory = Directory::open(out)?;
        let lock = lock(&path, &place, Holds::Alone)?;
        if !path.join(IDENTITY).exists()
            && let Some(foreign) =
                own::foreign(&path, Kind::Empty).map_err(StoreError::file(&path))?
        {
            return Err(WriteError::Foreign(foreign).into());
        }
        let folder = Directory::open(&path)?;
        // Nobody else is writing there: the lock is held.
        folder.remove_leftovers(&[])?;
        if identity.shard().is_none() {
            directory.remove_leftovers(&RENAMED)?;
        }
        let documents = zarr::documents(contents.grid, &contents.source);
        let files = ChunkFiles {
            folder: path,
            chunking: Chunking::of(contents.grid),
            tag: identity.tag(),
            columns: contents.source.columns,
            precision: contents.source.precision,
        };
        let store = Store {
            folder,
            files,
            metadata: group::metadata_files(contents.grid, documents, identity.tag()),
            record: contents
                .source
                .scene
                .excitation
                .record()
                .cloned()
                .filter(|_| identity.shard().is_some()),
            has_metadata: AtomicBool::new(false),
            identity,
            _lock: lock,
        };
        let before = store.path().join(IDENTITY);
        if !before.exists() {
            return Ok((store, SavedChunks::default()));
        }
        if !resume && store.path().join(REPORT).exists() {
            return Err(StoreError::Finished(place));
        }
        if !resume {
            return Err(StoreError::Unfinished(place));
        }
        let text = bounded::read(&before, LARGEST_IDENTITY).map_err(StoreError::file(&before))?;
        let text = String::from_utf8_lossy(&text);
        if let Some(difference) = store.identity.difference(&text) {
            return Err(StoreError::Other { place, difference });
        }
        let found = store.found()?;
        if let Some((path, _)) = found.broken.iter().find(|(_, fault)| fault.is_of_another_run()) {
            return Err(StoreError::NotOfThisRun(path.clone()));
        }
        for (path, _) in &found.broken {
            own::gone(fs::remove_file(path)).map_err(StoreError::file(path))?;
        }
        Ok((store, found))
    }

    /// Locks a directory for a command that saves nothing on its way: no map runs there meanwhile.
    ///
    /// # Errors
    /// [`StoreError::InUse`]; those of the disk.
    pub fn lock(out: &Path) -> Result<Lock, StoreError> {
        lock(&out.join(FOLDER), out, Holds::Alone)
    }

    /// True where a directory has the folder of a map that runs, or was interrupted.
    pub fn is_begun(out: &Path) -> bool {
        let path = out.join(FOLDER);
        let is_a_runs = |kind| matches!(own::foreign(&path, kind), Ok(None));
        lock::is_held(&path)
            || path.join(IDENTITY).exists()
            || (path.exists() && is_a_runs(Kind::Empty))
    }

    /// The files of its chunks.
    pub fn files(&self) -> &ChunkFiles {
        &self.files
    }

    /// The chunks that are saved in it.
    ///
    /// # Errors
    /// Errors of the disk.
    pub fn found(&self) -> Result<SavedChunks, StoreError> {
        SavedChunks::in_files(&self.files, &|_| ())
    }

    /// What ties its chunks to its identity.
    pub fn tag(&self) -> u32 {
        self.files.tag
    }

    /// Its folder.
    pub fn path(&self) -> &Path {
        &self.files.folder
    }

    /// True when something was saved in it.
    pub fn is_used(&self) -> bool {
        self.path().join(IDENTITY).exists()
    }

    /// Says whose the folder is, before anything else is saved in it: killed at any time, a run leaves nothing that
    /// would not be known as a run's.
    fn begin(&self) -> Result<(), StoreError> {
        if !self.is_used() {
            self.folder.write(IDENTITY, |w| w.write_all(self.identity.text().as_bytes()))?;
        }
        if !self.has_metadata.load(Ordering::Relaxed) {
            self.write_metadata(|path| !self.path().join(path).exists())?;
            if let Some(pair) = self.record.as_ref().filter(|_| !self.path().join(SAMPLES).exists())
            {
                self.folder.write(SAMPLES, |w| w.write_all(&pair.bytes()))?;
            }
            self.has_metadata.store(true, Ordering::Relaxed);
        }
        Ok(())
    }

    /// Lists of cells of another grid that are saved beside the chunks, in a folder of this name.
    ///
    /// # Errors
    /// [`StoreError::Write`].
    pub fn rounds(&self, name: &str) -> Result<Rounds, StoreError> {
        self.begin()?;
        Rounds::open(&self.path().join(name), self.files.tag, self.files.precision)
    }

    /// Saves a chunk of which some cells at least have run: they are on disk, whole, when this returns.
    ///
    /// # Errors
    /// [`StoreError::Write`]; what was saved of the chunk before is still there.
    pub fn save(&self, chunk: usize, block: &Block) -> Result<(), StoreError> {
        self.save_while(chunk, block, &|| true).map(|_| ())
    }

    /// The same while it is to `go_on`, which is asked before each file; false where it ended early, and the chunk
    /// is as it was. Of a run that had saved nothing, and is not to go on, nothing is left.
    ///
    /// # Errors
    /// Those of [`Store::save`].
    pub fn save_while(
        &self,
        chunk: usize,
        block: &Block,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<bool, StoreError> {
        if !go_on() {
            return Ok(false);
        }
        self.begin()?;
        Ok(self.files.write(&self.folder, chunk, block, go_on)?)
    }

    /// Writes those files of the group, but those of its chunks, that are wanted by their paths.
    fn write_metadata(&self, wanted: impl Fn(&str) -> bool) -> Result<(), StoreError> {
        for (path, bytes) in self.metadata.iter().filter(|(path, _)| wanted(path)) {
            self.folder.write(path, |w| w.write_all(bytes))?;
        }
        Ok(())
    }

    /// Says that all of a shard is there, and how it was run, in its report; one that is there already
    /// and is `resumed` whole stays.
    ///
    /// # Errors
    /// [`StoreError::Write`], with nothing left behind.
    pub fn finish(
        self,
        report: &impl serde::Serialize,
        resumed: bool,
    ) -> Result<PathBuf, StoreError> {
        // Somebody may have taken away what joining it needs.
        self.begin()?;
        if !(resumed && self.path().join(REPORT).exists()) {
            self.folder.write(REPORT, |w| serde_json::to_writer_pretty(w, report))?;
        }
        Ok(self.path().to_path_buf())
    }

    /// Gives the folder the name of a finished map in its directory, in the place of one that is there, and
    /// takes away what only a running sweep needs. What somebody put into the folder goes along.
    ///
    /// # Errors
    /// [`StoreError::File`]; the map that was there is there still, or the new one is. [`WriteError::Foreign`] where
    /// what no run wrote is in the place: what is saved is still saved.
    pub fn publish(self, place: &Path) -> Result<(), StoreError> {
        // Whatever became of them while the chunks were looked after.
        self.write_metadata(|_| true)?;
        let aside = files::put(self.path(), place)?;
        let failed = StoreError::file(place);
        own::gone(fs::remove_file(place.join(IDENTITY))).map_err(&failed)?;
        for folder in fs::read_dir(place).map_err(&failed)? {
            let folder = folder.map_err(&failed)?;
            if own::is_lists(&folder.file_name().to_string_lossy()) {
                own::remove(&folder.path(), Kind::Lists).map_err(&failed)?;
            }
        }
        Ok(files::remove(&aside)?)
    }

    /// Removes what was saved: its run is finished, or left nothing to go on with. What somebody else put into the
    /// folder stays, and the folder with it.
    ///
    /// # Errors
    /// [`StoreError::File`].
    pub fn discard(self) -> Result<(), StoreError> {
        let failed = StoreError::file(self.path());
        // Under another name half of it is nobody's to go on with.
        let name = self.path().file_name().unwrap_or_default().to_string_lossy();
        let aside = self.path().with_file_name(temporary::aside(&name));
        let is_whole = own::foreign(self.path(), Kind::Group).map_err(&failed)?.is_none();
        let moved = is_whole && !aside.exists() && fs::rename(self.path(), &aside).is_ok();
        let folder = if moved { &aside } else { self.path() };
        if own::remove(folder, Kind::Group).map_err(&failed)?.is_some() && moved {
            // Somebody was faster, and is to find it where it was put.
            fs::rename(&aside, self.path()).map_err(&failed)?;
        }
        Ok(())
    }
}

/// A folder in which nothing was saved goes.
impl Drop for Store {
    fn drop(&mut self) {
        if !self.is_used() {
            // One that was published is not there any more; one in which something lies stays.
            let _ = fs::remove_dir(self.path());
        }
    }
}
