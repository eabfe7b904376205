//! The files of a refined map.

use topple::refine::refined::RefinedMap;
use topple::results::files::Directory;
use topple::results::own::LEAVES;
use topple::results::{csv, group, mat, npz};
use topple_pictures::colours::print_palette::Palette;
use topple_pictures::map::refined::{write_png, write_svg};

use super::map_file::MapFile;

/// The picture of a pixel a cell, and the outlines.
const PICTURES: [&str; 2] = ["refined.png", "refined.svg"];

/// The names of the files that hold the leaves, beside one that holds the map.
fn leaves(file: MapFile) -> &'static [&'static str] {
    match file {
        MapFile::Csv => &["leaves.csv"],
        MapFile::Npz => &["leaves.npz"],
        MapFile::Zarr => &["leaves.npz", LEAVES],
        MapFile::Mat => &["leaves.mat"],
    }
}

/// The names of a refined map's files, beside these of the map.
pub fn names(files: &[MapFile]) -> Vec<String> {
    let mut names: Vec<&str> = files.iter().flat_map(|file| leaves(*file)).copied().collect();
    names.sort_unstable();
    names.dedup();
    names.into_iter().chain(PICTURES).map(String::from).collect()
}

/// Writes them.
pub fn write(
    out: &Directory,
    map: &RefinedMap,
    files: &[MapFile],
    palette: Palette,
) -> anyhow::Result<()> {
    let (names, source) = (names(files), map.source());
    map.listed(|listed, outcomes| -> anyhow::Result<()> {
        for name in &names {
            match name.as_str() {
                "leaves.csv" => {
                    out.write(name, |w| csv::write(listed, outcomes, source.columns, w))?
                }
                "leaves.npz" => out.write(name, |w| npz::write(listed, outcomes, source, w))?,
                "leaves.mat" => out.write(name, |w| mat::write(listed, outcomes, source, w))?,
                LEAVES => group::write_list(out, name, (listed, outcomes), source)?,
                "refined.png" => out.write(name, |w| write_png(map, palette, w))?,
                "refined.svg" => out.write(name, |w| write_svg(map, palette, w))?,
                // One of `names` that has no case here.
                other => anyhow::bail!("{other}: not written; this is a mistake in topple"),
            };
        }
        Ok(())
    })
}
