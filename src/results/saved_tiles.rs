//! What an earlier run left in its folder: tiles, and the cells of them that have run.

use std::io::ErrorKind;
use std::ops::Range;
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::columns::{Column, of};
use super::store_error::StoreError;
use super::tiling::Tiling;
use super::{block, tile, zarr};
use crate::scene::bounded;

/// A tile of which cells were saved.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SavedTile {
    /// Its number.
    pub tile: usize,
    /// The runs of cells that have run.
    pub done: Vec<Range<usize>>,
}

/// What an earlier run left.
#[derive(Debug, Default)]
pub struct SavedTiles {
    /// Its whole tiles.
    pub tiles: Vec<SavedTile>,
    /// Files that are not whole, and whose tiles are run again: each with what is wrong.
    pub broken: Vec<(PathBuf, &'static str)>,
}

impl SavedTiles {
    /// The tiles of an identity's tag in a folder; `progress` hears of the cells of each.
    ///
    /// # Errors
    /// Those of the disk.
    pub fn in_folder(
        folder: &Path,
        tiling: &Tiling,
        tag: u32,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<SavedTiles, StoreError> {
        let find = |tile| {
            let found = find(folder, tiling, tile, tag)?;
            if let Some(Ok(saved)) = &found {
                progress(saved.done.iter().map(Range::len).sum());
            }
            Ok(found)
        };
        let all = (0..tiling.count()).into_par_iter().map(find);
        let mut found = SavedTiles::default();
        for one in all.collect::<Result<Vec<_>, StoreError>>()?.into_iter().flatten() {
            match one {
                Ok(saved) => found.tiles.push(saved),
                Err(broken) => found.broken.extend(broken),
            }
        }
        Ok(found)
    }

    /// The runs of cells that have run.
    pub fn done(&self) -> Vec<Range<usize>> {
        self.tiles.iter().flat_map(|saved| saved.done.iter().cloned()).collect()
    }
}

/// A tile in a folder: the cells of it that have run; or of one that is broken the files that must go, each
/// with what is wrong, that of the status among them.
type Tile = Result<SavedTile, Vec<(PathBuf, &'static str)>>;

/// Finds a tile in a folder, if its status is there.
fn find(folder: &Path, tiling: &Tiling, tile: usize, tag: u32) -> Result<Option<Tile>, StoreError> {
    let name = |array: &str| zarr::chunk_path(array, tiling, tile);
    let path = |array: &str| folder.join(name(array));
    let status = path(Column::Status.entry().name);
    if !status.exists() {
        return Ok(None);
    }
    let mut broken = Vec::new();
    for (array, _) in zarr::columns() {
        let path = path(array);
        match bounded::read(&path, tile::LARGEST) {
            Ok(bytes) => {
                let problem = tile::check(&bytes, tag, &name(array)).err();
                broken.extend(problem.map(|what| (path, what)));
            }
            Err(e) if e.kind() == ErrorKind::NotFound => broken.push((path, "missing")),
            Err(e) => return Err(StoreError::file(&path)(e)),
        }
    }
    let (cells, whole) = (tiling.cells(tile), tiling.tile_cells());
    let codes = || -> Result<Option<Vec<Range<usize>>>, StoreError> {
        let mut chunks = |array: &str, count| {
            let path = path(array);
            let packed = bounded::read(&path, tile::LARGEST).map_err(StoreError::file(&path))?;
            Ok(tile::unpack(&packed, count))
        };
        // Only which cells have run is asked for, which every number type has alike.
        let codes = tile::decode::<of::Status, f32, StoreError>((cells.len(), whole), &mut chunks)?;
        Ok(codes.map(|codes| block::done(&codes)))
    };
    if broken.is_empty() {
        if let Some(done) = codes()? {
            let at = |run: Range<usize>| cells.start + run.start..cells.start + run.end;
            return Ok(Some(Ok(SavedTile { tile, done: done.into_iter().map(at).collect() })));
        }
        broken.push((status.clone(), "damaged"));
    }
    if broken.iter().all(|(path, _)| *path != status) {
        broken.push((status, "its tile is broken"));
    }
    Ok(Some(Err(broken)))
}
