//! The files of a map.

use std::path::{Path, PathBuf};

use rayon::prelude::*;
use topple::map::figure::FigureError;
use topple::map::figure::{curves, document, field, fields, frame, overturning};
use topple::map::manifest::Manifest;
use topple::map::slices::Slice;
use topple::map::{self, Map};
use topple::results::columns::Column;
use topple::results::files::{Directory, WriteError};
use topple::results::{csv, npz};
use topple::sweep::map::MapSweep;
use topple::sweep::observed::ObservedOutcomes;
use topple::sweep::observer::{Observer, Phase};

use super::InputError;
use super::options::MapFile;
use super::progress::Screen;

/// Pixels of a PNG for each of its SVG's units.
pub const PNG_SCALE: f32 = 2.0;

/// Opens the directory for the results.
pub fn open(out: &Path) -> Result<Directory, InputError> {
    Directory::open(out).map_err(|error| InputError(format!("--out: {error}")))
}

/// Writes the files of a map, of which `slices` are drawn, but map.zarr; the paths of its pictures.
pub fn write(
    out: &Directory,
    map: &MapSweep,
    slices: &[Slice],
    (manifest, files): (&Manifest, &[MapFile]),
    screen: &Screen,
) -> anyhow::Result<Vec<PathBuf>> {
    let figures: Vec<Figure> = match slices {
        [whole] => figures(&whole.map)?,
        slices => slices
            .par_iter()
            .enumerate()
            .map(|(number, slice)| main_figure(&slice.map, &slice.at, &name_of(number)))
            .collect::<Result<_, _>>()?,
    };
    let grid = &map.grid;
    let tables = files.iter().filter(|file| **file != MapFile::Zarr).count();
    screen.begins(Phase::Writing, grid.len() * tables * Column::ALL.len());
    let outcomes = ObservedOutcomes::new(&*map.outcomes, screen);
    if files.contains(&MapFile::Csv) {
        out.write("map.csv", |w| csv::write(grid, &outcomes, w))?;
    }
    if files.contains(&MapFile::Npz) {
        out.write("map.npz", |w| npz::write(grid, &outcomes, map.source(), w))?;
    }
    if let [whole] = slices
        && whole.map.scene.excitation.record().is_some()
        && grid.axes().len() == 2
        && grid.line().is_none()
    {
        out.write("boundaries.csv", |w| map::boundaries::write(&whole.map, w))?;
    }
    for (name, svg, png) in &figures {
        write_figure(out, name, svg, png)?;
    }
    write_json(out, manifest)?;
    let maps = figures.iter().filter(|(name, ..)| name.starts_with("map"));
    Ok(maps.map(|(name, ..)| out.file(&format!("{name}.png"))).collect())
}

/// A picture's name, its SVG and its PNG.
type Figure = (String, String, Vec<u8>);

/// The name of a slice's picture.
fn name_of(number: usize) -> String {
    format!("map-{:02}", number + 1)
}

/// The picture of a map that stands for all of it: its outcomes for a pulse, the rocking index for a
/// record; of one axis curves. `at` tells what the map is a slice at.
fn main_figure(map: &Map, at: &str, name: &str) -> Result<Figure, FigureError> {
    let svg = if let Some(axis) = map.grid.line() {
        curves::draw(map, axis)?
    } else if map.scene.excitation.record().is_none() {
        overturning::draw(map, at)?
    } else {
        field::draw(map, &fields::FIELDS[0], at)?
    };
    let png = document::render(&svg, PNG_SCALE)?;
    Ok((name.into(), svg, png))
}

/// The pictures of a map: its outcomes for a pulse, its fields for a record, curves along one axis.
fn figures(map: &Map) -> Result<Vec<Figure>, FigureError> {
    let mut figures = vec![main_figure(map, "", "map")?];
    if map.scene.excitation.record().is_none() || map.grid.line().is_some() {
        return Ok(figures);
    }
    let finish = |name: &str, svg: String| -> Result<Figure, FigureError> {
        let png = document::render(&svg, PNG_SCALE)?;
        Ok((name.into(), svg, png))
    };
    let others: Vec<Figure> = fields::FIELDS[1..]
        .par_iter()
        .map(|field| finish(field.name, field::draw(map, field, "")?))
        .collect::<Result<_, _>>()?;
    figures.extend(others);
    let [normal, friction] = &fields::CONTACT;
    let (left, right) = (field::draw(map, normal, "")?, field::draw(map, friction, "")?);
    figures.push(finish(normal.name, document::beside(frame::SIZE, &left, &right))?);
    Ok(figures)
}

/// Writes a picture as NAME.svg and NAME.png.
pub fn write_figure(out: &Directory, name: &str, svg: &str, png: &[u8]) -> Result<(), WriteError> {
    use std::io::Write;
    out.write(&format!("{name}.svg"), |w| w.write_all(svg.as_bytes()))?;
    out.write(&format!("{name}.png"), |w| w.write_all(png))?;
    Ok(())
}

/// Writes run.json.
pub fn write_json(out: &Directory, manifest: &impl serde::Serialize) -> Result<(), WriteError> {
    out.write("run.json", |w| serde_json::to_writer_pretty(w, manifest))?;
    Ok(())
}
