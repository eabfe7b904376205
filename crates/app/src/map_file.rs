//! Files of a map, and what a map has besides its cells.

use topple::results::own;
use topple_manifest::Pictures;

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

/// What a map has besides its cells, or a history besides its motion: what an earlier one had.
#[derive(Debug, Clone, Default)]
pub struct Besides {
    /// Levels that it was refined in.
    pub refine: Option<u32>,
    /// The share of their range that numbers were smooth to.
    pub smooth: Option<f64>,
    /// It was asked how sharp its boundaries are.
    pub sharpness: bool,
    /// Its spectra were drawn.
    pub spectrum: bool,
    /// Its files.
    pub files: Vec<MapFile>,
    /// How its pictures are printed.
    pub pictures: Pictures,
    /// More columns of a history.
    pub more_columns: String,
}

/// Most cells of a map that is written as a table: of 4096 x 4096 it has 2.5 GB.
const LARGE: usize = 1 << 24;
