//! Files of a map.

use clap::ValueEnum;
use topple::results::{mat, own};

use super::InputError;

/// A file that holds a whole map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum MapFile {
    /// map.csv: one row per cell.
    Csv,
    /// map.npz: arrays for numpy.
    Npz,
    /// map.zarr: arrays in chunks, for xarray and dask.
    Zarr,
    /// map.mat: arrays for MATLAB and Octave.
    Mat,
}

impl MapFile {
    /// Its name in the directory.
    pub fn name(self) -> &'static str {
        match self {
            MapFile::Csv => "map.csv",
            MapFile::Npz => "map.npz",
            MapFile::Zarr => own::MAP,
            MapFile::Mat => "map.mat",
        }
    }

    /// Those among names of files.
    pub fn among(names: &[String]) -> Vec<MapFile> {
        let is_there = |file: &&MapFile| names.iter().any(|name| name == file.name());
        MapFile::value_variants().iter().filter(is_there).copied().collect()
    }

    /// Refuses files that cannot hold a map of a given number of cells.
    pub fn check(files: &[MapFile], cells: usize) -> Result<(), InputError> {
        // Numbers have eight bytes at most.
        let most = mat::LARGEST / 8;
        if files.contains(&MapFile::Mat) && cells as u64 > most {
            let problem = format!(
                "--files mat: a MAT-file holds {most} cells at most, and the map has {cells}; \
                 use `--files zarr`"
            );
            return Err(InputError(problem));
        }
        Ok(())
    }

    /// Those of a map of a given number of cells, unless others are requested.
    pub fn of(cells: usize) -> Vec<MapFile> {
        if cells <= LARGE { vec![MapFile::Csv, MapFile::Npz] } else { vec![MapFile::Zarr] }
    }
}

/// Name of the table of a map's spectra.
pub const SPECTRUM: &str = "spectrum.csv";

/// Most cells of a map that is written as a table: of 4096 x 4096 it has 2.5 GB.
const LARGE: usize = 1 << 24;
