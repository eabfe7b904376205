//! Files of a map.

use topple::results::own;

/// A file that holds a whole map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum MapFile {
    /// map.csv: one row per cell.
    Csv,
    /// map.npz: arrays for numpy.
    Npz,
    /// map.zarr: arrays in chunks, for xarray and dask.
    Zarr,
}

impl MapFile {
    /// Its name in the directory.
    pub fn name(self) -> &'static str {
        match self {
            MapFile::Csv => "map.csv",
            MapFile::Npz => "map.npz",
            MapFile::Zarr => own::MAP,
        }
    }

    /// Those among names of files.
    pub fn among(names: &[String]) -> Vec<MapFile> {
        let all = [MapFile::Csv, MapFile::Npz, MapFile::Zarr].into_iter();
        all.filter(|file| names.iter().any(|name| name == file.name())).collect()
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
