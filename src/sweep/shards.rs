//! Joins finished shards: together they must have every cell once, of one scene, computed by one method.

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::error::SweepError;
use super::identity::{Content, MAY_DIFFER};
use super::shards_error::ShardsError;
use crate::backend::report::{self, Report};
use crate::results::about::Source;
use crate::results::chunk_files::ChunkFiles;
use crate::results::chunking::Chunking;
use crate::results::identity::Identity;
use crate::results::reader::{ChunkReader, ShardFolder, missing};
use crate::results::saved_chunks::SavedChunks;
use crate::results::shard;
use crate::results::store::{Contents, IDENTITY, LARGEST_IDENTITY, REPORT, SAMPLES, Store};
use crate::results::store_error::StoreError;
use crate::scene::{Excitation, Grid, bounded, shown};
use crate::work::observer::Observer;

/// Largest file of samples that is read, bytes: more than both components of a record may have.
const LARGEST_SAMPLES: u64 = 1 << 30;

/// A finished shard.
#[derive(Debug)]
struct Piece {
    place: PathBuf,
    identity: Identity,
    content: Content,
    report: Report,
    cells: Range<usize>,
    files: ChunkFiles,
}

/// All shards of a map.
#[derive(Debug)]
pub struct Shards {
    /// The identity of the map; what it says of the backend is that of the first shard.
    pub content: Content,
    /// The shards' folders and reports, by their first cells.
    pub reports: Vec<(PathBuf, Report)>,
    /// Their cells.
    pub reader: ChunkReader,
}

impl Shards {
    /// Finds the shards in directories, each a run's or a shard's own, and joins them; `observer` hears of
    /// cells that are found whole.
    ///
    /// # Errors
    /// [`ShardsError`].
    pub fn join(directories: &[PathBuf], observer: &dyn Observer) -> Result<Shards, ShardsError> {
        let mut pieces: Vec<Piece> = Vec::new();
        for directory in directories {
            for place in folders(directory)? {
                let first = pieces.first().map(|piece| &piece.content);
                let piece = Piece::read(place, first, observer)?;
                pieces.push(piece);
            }
        }
        let first = pieces.first().ok_or_else(|| ShardsError::None(PathBuf::new()))?;
        for piece in &pieces {
            if let Some(difference) =
                first.identity.difference_but(piece.identity.text(), &MAY_DIFFER)
            {
                let (place, first) = (piece.place.clone(), first.place.clone());
                return Err(ShardsError::Other { place, first, difference });
            }
        }
        let grid = Grid::of(&first.content.scene);
        pieces.sort_by_key(|piece| piece.cells.start);
        seamless(&pieces, &grid)?;
        let mut content = pieces[0].content.whole();
        if let Excitation::Record(pair) = &mut content.scene.excitation {
            pair.provenance = pieces[0].report.record.clone().map(Box::new);
        }
        let mut held = Vec::new();
        let mut reports = Vec::new();
        for piece in pieces {
            held.push(ShardFolder { cells: piece.cells, files: piece.files });
            reports.push((piece.place, piece.report));
        }
        let reader = ChunkReader::new(held, grid.len());
        let overlap = || ShardsError::Unreadable {
            place: reports[0].0.clone(),
            reason: "its chunks overlap".into(),
        };
        let reader = reader.ok_or_else(overlap)?;
        Ok(Shards { content, reports, reader })
    }
}

impl Shards {
    /// The folder in a directory that the map is to be written to: no other run writes there, and what an
    /// earlier, interrupted joining of the same shards saved is used. Its identity names all shards, so that no
    /// run takes it for its own.
    ///
    /// # Errors
    /// [`SweepError::Folder`]: another run is there, or an unfinished one of something else.
    pub fn store(&self, directory: &Path) -> Result<Store, SweepError> {
        let grid = Grid::of(&self.content.scene);
        let precision = report::columns(&self.reports, self.content.method.precision);
        let ran = |(_, report): &(_, Report)| {
            let adapter = report.adapter.as_ref().map(|adapter| &adapter.name);
            json!([report.first, report.cells, report.backend, adapter])
        };
        let shards: Vec<Value> = self.reports.iter().map(ran).collect();
        let identity = json!({ "columns": precision, "parts": shards, "map": self.content });
        let identity = Identity::new(format!("{identity:#}"), None);
        let columns = self.content.method.columns;
        let source = Source { scene: &self.content.scene, precision, columns };
        let contents = Contents { grid: &grid, source };
        let opened = Store::open(directory, identity, contents, true);
        Ok(opened.map_err(SweepError::Folder)?.0)
    }
}

impl Piece {
    /// Reads a shard; the samples of its record are those of the `first` shard, where both have the same.
    fn read(
        place: PathBuf,
        first: Option<&Content>,
        observer: &dyn Observer,
    ) -> Result<Piece, ShardsError> {
        let text = |name: &str, most: u64| {
            let path = place.join(name);
            let bytes = bounded::read(&path, most).map_err(StoreError::file(&path))?;
            Ok::<_, StoreError>(String::from_utf8_lossy(&bytes).into_owned())
        };
        let unreadable = |name: &str, e: serde_json::Error| ShardsError::Unreadable {
            place: place.join(name),
            reason: shown::line(&e.to_string()),
        };
        let written = text(IDENTITY, LARGEST_IDENTITY)?;
        let mut content = Content::read(&written).map_err(|error| unreadable(IDENTITY, error))?;
        if content.lacks_samples() && !first.is_some_and(|first| content.share_samples(first)) {
            let path = place.join(SAMPLES);
            let bytes = bounded::read(&path, LARGEST_SAMPLES).map_err(StoreError::file(&path))?;
            if !content.take_samples(&bytes) {
                let reason = "these are not the samples of the record that its identity names; remove the file, and run its shard \
                              again with `resume`";
                let reason = reason.into();
                return Err(ShardsError::Unreadable { place: path, reason });
            }
        }
        // What a run has written was checked; what is there may be another's.
        content.scene.check().map_err(|error| ShardsError::Unreadable {
            place: place.join(IDENTITY),
            reason: error.to_string(),
        })?;
        let identity = Identity::new(written, content.shard);
        let grid = Grid::of(&content.scene);
        let files = ChunkFiles {
            folder: place.clone(),
            chunking: Chunking::of(&grid),
            tag: identity.tag(),
            columns: content.method.columns,
            precision: content.columns(),
        };
        let found = SavedChunks::in_files(&files, &|cells| observer.advance(cells))?;
        let done = found.done();
        if let Some((place, reason)) = found.broken.into_iter().next() {
            return Err(match reason.is_of_another_run() {
                true => ShardsError::Foreign { place, reason },
                false => ShardsError::Broken { place, reason },
            });
        }
        let cells = content.shard.map_or(0..grid.len(), |shard| shard.cells(grid.len()));
        if let Some(cells) = missing(&done, &cells).first() {
            return Err(ShardsError::Unfinished { place, cells: words(cells) });
        }
        if !place.join(REPORT).exists() {
            let cells = "its report and perhaps more".into();
            return Err(ShardsError::Unfinished { place, cells });
        }
        let report = serde_json::from_str(&text(REPORT, bounded::DOCUMENT)?)
            .map_err(|error| unreadable(REPORT, error))?;
        Ok(Piece { identity, content, report, cells, place, files })
    }
}

/// The shards' folders in a run's directory, or the directory if it is such a folder itself.
fn folders(directory: &Path) -> Result<Vec<PathBuf>, ShardsError> {
    if directory.join(IDENTITY).exists() {
        return Ok(vec![directory.to_path_buf()]);
    }
    let failed = StoreError::file(directory);
    let mut folders = Vec::new();
    for entry in fs::read_dir(directory).map_err(&failed)? {
        let entry = entry.map_err(&failed)?;
        let is_shard = entry.file_name().to_string_lossy().starts_with(shard::FOLDER);
        if is_shard && entry.path().join(IDENTITY).exists() {
            folders.push(entry.path());
        }
    }
    if folders.is_empty() {
        return Err(ShardsError::None(directory.to_path_buf()));
    }
    folders.sort();
    Ok(folders)
}

/// Refuses cells that are in two shards or in none.
fn seamless(pieces: &[Piece], grid: &Grid) -> Result<(), ShardsError> {
    let gap = |cells: Range<usize>| {
        let named = pieces.iter().filter_map(|piece| piece.content.shard);
        let lost = named.clone().next().and_then(|shard| shard.missing_beside(named));
        let hint =
            lost.map_or("give every shard".into(), |shard| format!("shard {shard} is missing"));
        Err(ShardsError::Gap { cells: words(&cells), hint })
    };
    for pair in pieces.windows(2) {
        let [one, other] = pair else { continue };
        if other.cells.start < one.cells.end {
            let both = other.cells.start..one.cells.end.min(other.cells.end);
            let (one, other) = (one.place.clone(), other.place.clone());
            return Err(ShardsError::Overlap { one, other, cells: words(&both) });
        }
        if other.cells.start > one.cells.end {
            return gap(one.cells.end..other.cells.start);
        }
    }
    let (first, last) = (&pieces[0].cells, &pieces[pieces.len() - 1].cells);
    if first.start > 0 {
        return gap(0..first.start);
    }
    if last.end < grid.len() {
        return gap(last.end..grid.len());
    }
    Ok(())
}

/// A run of cells as a reader numbers them: both ends counted in, from 0.
fn words(cells: &Range<usize>) -> String {
    format!("cells {} to {}", cells.start, cells.end - 1)
}
