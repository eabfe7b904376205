//! Finished parts, joined: all cells once, of one scene, run in one way.

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::identity::Identity;
use super::shelf::{Shelf, missing};
use super::tile::Tile;
use super::{Found, IDENTITY, REPORT, StoreError, part};
use crate::scene::Grid;
use crate::sweep::gpu::adapter::Description;

/// How a part was run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// The first of its cells.
    pub first: usize,
    /// How many they are.
    pub cells: usize,
    /// gpu, cpu or reference.
    pub backend: String,
    /// The adapter, for a GPU.
    pub adapter: Option<Description>,
    /// GPUs, or one.
    pub devices: usize,
    /// Threads of the CPU.
    pub threads: usize,
    /// Seconds to open the backend and compile the shader.
    pub start: f64,
    /// Seconds of the sweep, of the cells that the last run of the part had left.
    pub sweep: f64,
    /// Cells that an earlier, interrupted run had done.
    pub resumed_cells: usize,
}

/// Why parts are no map.
#[derive(Debug, thiserror::Error)]
pub enum PartsError {
    /// A directory without parts.
    #[error("{0} holds no part; give directories that runs with --tile were given")]
    None(PathBuf),
    /// A part that is not finished.
    #[error("{place} is unfinished, {cells} are missing; run it again with --resume")]
    Unfinished {
        /// The part's folder.
        place: PathBuf,
        /// The first that are missing.
        cells: String,
    },
    /// A part with a tile that is not whole.
    #[error("{place}: {reason}; run its part again with --resume")]
    Broken {
        /// The tile's file.
        place: PathBuf,
        /// What is wrong.
        reason: &'static str,
    },
    /// A part of something else.
    #[error("{place} is no part of the same map as {first}: {difference}")]
    Other {
        /// The part's folder.
        place: PathBuf,
        /// The first part's folder.
        first: PathBuf,
        /// What is different.
        difference: String,
    },
    /// Cells in two parts.
    #[error("{one} and {other} overlap, both hold {cells}; leave one out")]
    Overlap {
        /// A part's folder.
        one: PathBuf,
        /// Another's.
        other: PathBuf,
        /// The cells.
        cells: String,
    },
    /// Cells in no part.
    #[error("no part holds {cells}; {hint}")]
    Gap {
        /// The cells.
        cells: String,
        /// Which part may be missing.
        hint: String,
    },
    /// A file that cannot be read as what it should be.
    #[error("{place} cannot be read: {reason}")]
    Unreadable {
        /// The file.
        place: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// A file that cannot be read at all.
    #[error(transparent)]
    Store(#[from] StoreError),
}

/// A finished part.
#[derive(Debug)]
struct Piece {
    place: PathBuf,
    identity: Identity,
    report: Report,
    cells: Range<usize>,
    tiles: Vec<Tile>,
}

/// All parts of a map.
#[derive(Debug)]
pub struct Parts {
    /// The identity that they share, the first one's in what ran it.
    pub identity: Identity,
    /// The parts' folders and reports, by their first cells.
    pub reports: Vec<(PathBuf, Report)>,
    /// Their cells.
    pub shelf: Shelf,
}

impl Parts {
    /// Finds the parts in directories, each a run's or a part's own, and joins them; `seen` hears of cells
    /// that are found whole.
    ///
    /// # Errors
    /// [`PartsError`].
    pub fn join(directories: &[PathBuf], seen: &dyn Fn(usize)) -> Result<Parts, PartsError> {
        let mut pieces = Vec::new();
        for directory in directories {
            for place in folders(directory)? {
                pieces.push(Piece::read(place, seen)?);
            }
        }
        let first = pieces.first().ok_or_else(|| PartsError::None(PathBuf::new()))?;
        for piece in &pieces {
            if let Some(difference) = first.identity.apart(piece.identity.text()) {
                let (place, first) = (piece.place.clone(), first.place.clone());
                return Err(PartsError::Other { place, first, difference });
            }
        }
        let grid = Grid::of(first.identity.scene());
        pieces.sort_by_key(|piece| piece.cells.start);
        seamless(&pieces, &grid)?;
        let whole = pieces[0].identity.whole();
        let unreadable = |place: &Path, reason: String| PartsError::Unreadable {
            place: place.to_path_buf(),
            reason,
        };
        let identity = whole.map_err(|e| unreadable(&pieces[0].place, e.to_string()))?;
        let mut tiles = Vec::new();
        let mut reports = Vec::new();
        for piece in pieces {
            tiles.extend(piece.tiles);
            reports.push((piece.place, piece.report));
        }
        let overlap = || unreadable(&reports[0].0, "its tiles overlap".into());
        let shelf = Shelf::new(tiles, grid.len()).ok_or_else(overlap)?;
        Ok(Parts { identity, reports, shelf })
    }
}

impl Piece {
    fn read(place: PathBuf, seen: &dyn Fn(usize)) -> Result<Piece, PartsError> {
        let text = |name: &str| {
            let path = place.join(name);
            fs::read_to_string(&path).map_err(StoreError::file(&path))
        };
        let unreadable = |name: &str, e: serde_json::Error| PartsError::Unreadable {
            place: place.join(name),
            reason: e.to_string(),
        };
        let identity =
            Identity::read(&text(IDENTITY)?).map_err(|error| unreadable(IDENTITY, error))?;
        let found = Found::in_folder(&place, identity.tag(), seen)?;
        if let Some((place, reason)) = found.broken.into_iter().next() {
            return Err(PartsError::Broken { place, reason });
        }
        let count = Grid::of(identity.scene()).len();
        let cells = identity.part().map_or(0..count, |part| part.cells(count));
        if let Some(cells) = missing(&found.tiles, &cells).first() {
            return Err(PartsError::Unfinished { place, cells: words(cells) });
        }
        if !place.join(REPORT).exists() {
            let cells = "its report and perhaps more".into();
            return Err(PartsError::Unfinished { place, cells });
        }
        let report =
            serde_json::from_str(&text(REPORT)?).map_err(|error| unreadable(REPORT, error))?;
        Ok(Piece { identity, report, cells, tiles: found.tiles, place })
    }
}

/// The parts' folders in a run's directory, or the directory if it is such a folder itself.
fn folders(directory: &Path) -> Result<Vec<PathBuf>, PartsError> {
    if directory.join(IDENTITY).exists() {
        return Ok(vec![directory.to_path_buf()]);
    }
    let failed = StoreError::file(directory);
    let mut folders = Vec::new();
    for entry in fs::read_dir(directory).map_err(&failed)? {
        let entry = entry.map_err(&failed)?;
        let is_part = entry.file_name().to_string_lossy().starts_with(part::FOLDER);
        if is_part && entry.path().join(IDENTITY).exists() {
            folders.push(entry.path());
        }
    }
    if folders.is_empty() {
        return Err(PartsError::None(directory.to_path_buf()));
    }
    folders.sort();
    Ok(folders)
}

/// Refuses cells that two parts hold, or none.
fn seamless(pieces: &[Piece], grid: &Grid) -> Result<(), PartsError> {
    let gap = |cells: Range<usize>| {
        let named = pieces.iter().filter_map(|piece| piece.identity.part());
        let lost = named.clone().next().and_then(|part| part.missing_beside(named));
        let hint = lost.map_or("give every part".into(), |part| format!("part {part} is missing"));
        Err(PartsError::Gap { cells: words(&cells), hint })
    };
    for pair in pieces.windows(2) {
        let [one, other] = pair else { continue };
        if other.cells.start < one.cells.end {
            let both = other.cells.start..one.cells.end.min(other.cells.end);
            let (one, other) = (one.place.clone(), other.place.clone());
            return Err(PartsError::Overlap { one, other, cells: words(&both) });
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
