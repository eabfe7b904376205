//! The files of a map.

use std::path::{Path, PathBuf};

use rayon::prelude::*;
use topple::drawing::error::FigureError;
use topple::drawing::render;
use topple::map::earlier::{Earlier, Kind, RUN};
use topple::map::figure::{field, fields, main};
use topple::map::slices::Slice;
use topple::map::{self, Map};
use topple::results::columns::Column;
use topple::results::files::{Directory, WriteError, free};
use topple::results::store::Store;
use topple::results::{csv, npz};
use topple::sweep::map::MapSweep;
use topple::sweep::observed::ObservedOutcomes;
use topple::sweep::observer::{Observer, Phase};

use super::map_file::MapFile;
use super::progress::Screen;
use super::words::Say;
use super::{InputError, refined};

/// Name of the file of the boundaries between outcomes.
const BOUNDARIES: &str = "boundaries.csv";

/// Opens the directory for the results.
pub fn open(out: &Path) -> Result<Directory, InputError> {
    Directory::open(out).map_err(|error| InputError(format!("--out: {error}")))
}

/// Refuses a directory that holds something of another kind: its files are not to lie beside the new ones.
pub fn refuse_other(out: &Path, kind: Kind) -> Result<Earlier, InputError> {
    let earlier = Earlier::of(out).map_err(|error| InputError(format!("--out: {error}")))?;
    if kind != Kind::Map && Store::is_begun(out) {
        let problem =
            format!("a map runs in {}, or was interrupted; give another directory", out.display());
        return Err(InputError(format!("--out: {problem}")));
    }
    match earlier.kind {
        Some(other) if other != kind => {
            let (other, new) = (other.name(), kind.name());
            let problem =
                format!("{} holds {other}; give {new} a directory of its own", out.display());
            Err(InputError(format!("--out: {problem}")))
        }
        _ => Ok(earlier),
    }
}

/// The names of a map's tables and arrays, and of those of a refined one.
pub fn places(files: &[MapFile], refines: bool) -> Vec<String> {
    let of_map = files.iter().map(|file| file.name().to_string());
    let of_leaves = if refines { refined::names(files) } else { Vec::new() };
    of_map.chain(of_leaves).collect()
}

/// Refuses a directory in which something that no run wrote has the place of one of these files of a map.
pub fn refuse_foreign(out: &Directory, names: &[String]) -> Result<(), InputError> {
    let free = |name: &String| {
        let path = out.file(name);
        match path.extension().is_some_and(|ending| ending == "zarr") {
            true => free(&path),
            false if path.is_dir() => Err(WriteError::Foreign(path)),
            false => Ok(()),
        }
    };
    let refused = |error: WriteError| InputError(format!("--out: {error}"));
    names.iter().try_for_each(|name| free(name).map_err(refused))
}

/// Removes what an earlier command left that a new one does not write, and says it.
pub fn replace(out: &Path, earlier: &Earlier, files: &[String], say: &Say) -> anyhow::Result<()> {
    let removed = earlier.remove_but(files, out);
    let removed = removed.map_err(|error| anyhow::anyhow!("{}: {error}", out.display()))?;
    if !removed.is_empty() {
        say.line("removed", format!("{} of the run before", removed.join(", ")));
    }
    Ok(())
}

/// Draws the slices of a map.
pub fn draw(slices: &[Slice]) -> Result<Vec<Figure>, FigureError> {
    match slices {
        [whole] => figures(&whole.map),
        slices => slices
            .par_iter()
            .enumerate()
            .map(|(number, slice)| main_figure(&slice.map, &slice.at, &name_of(number)))
            .collect(),
    }
}

/// True where the boundaries between outcomes are written as curves: of a record's map with two axes.
fn has_boundaries(map: &MapSweep, slices: &[Slice]) -> bool {
    let grid = &map.grid;
    matches!(slices, [_])
        && map.plan.scene.excitation.record().is_some()
        && grid.axes().len() == 2
        && grid.line().is_none()
}

/// The names of a map's files, but run.json.
pub fn names(
    map: &MapSweep,
    slices: &[Slice],
    figures: &[Figure],
    files: &[MapFile],
) -> Vec<String> {
    let pictures =
        figures.iter().flat_map(|(name, ..)| [format!("{name}.svg"), format!("{name}.png")]);
    let boundaries = has_boundaries(map, slices).then(|| BOUNDARIES.to_string());
    files.iter().map(|file| file.name().to_string()).chain(boundaries).chain(pictures).collect()
}

/// Writes the files of a map, but map.zarr and run.json; the paths of its pictures.
pub fn write(
    out: &Directory,
    map: &MapSweep,
    (slices, figures): (&[Slice], &[Figure]),
    files: &[MapFile],
    screen: &Screen,
) -> anyhow::Result<Vec<PathBuf>> {
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
        && has_boundaries(map, slices)
    {
        out.write(BOUNDARIES, |w| map::boundaries::write(&whole.map, w))?;
    }
    for (name, svg, png) in figures {
        write_figure(out, name, svg, png)?;
    }
    let maps = figures.iter().filter(|(name, ..)| name.starts_with("map"));
    Ok(maps.map(|(name, ..)| out.file(&format!("{name}.png"))).collect())
}

/// A picture's name, its SVG and its PNG.
pub type Figure = (String, String, Vec<u8>);

/// The name of a slice's picture.
fn name_of(number: usize) -> String {
    format!("map-{:02}", number + 1)
}

/// The picture of a map that stands for all of it.
fn main_figure(map: &Map, at: &str, name: &str) -> Result<Figure, FigureError> {
    let svg = main::draw(map, at)?;
    let png = render::png(&svg)?;
    Ok((name.into(), svg, png))
}

/// The pictures of a map: its outcomes for a pulse, its fields for a record, curves along one axis.
fn figures(map: &Map) -> Result<Vec<Figure>, FigureError> {
    let mut figures = vec![main_figure(map, "", "map")?];
    if map.scene.excitation.record().is_none() || map.grid.line().is_some() {
        return Ok(figures);
    }
    let finish = |name: &str, svg: String| -> Result<Figure, FigureError> {
        let png = render::png(&svg)?;
        Ok((name.into(), svg, png))
    };
    let directions = map.scene.isolation;
    let shown: Vec<_> =
        fields::FIELDS[1..].iter().filter(|field| field.moves(directions)).collect();
    let others: Vec<Figure> = shown
        .into_par_iter()
        .map(|field| finish(field.name, field::draw(map, field, "")?))
        .collect::<Result<_, _>>()?;
    figures.extend(others);
    let [normal, friction] = &fields::CONTACT;
    let title = format!("{}: {} and {}", map.scene.title, normal.title, friction.title);
    figures.push(finish(normal.name, field::beside(map, &[normal, friction], &title)?)?);
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
    out.write(RUN, |w| serde_json::to_writer_pretty(w, manifest))?;
    Ok(())
}
