//! The files of a map.

use std::fs;
use std::iter;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use topple::results::columns::Column;
use topple::results::earlier::{Earlier, Kind};
use topple::results::files::{Directory, WriteError};
use topple::results::lock::Lock;
use topple::results::store::Store;
use topple::results::{csv, npz};
use topple::scene::{Grid, Scene};
use topple::sweep::map::MapSweep;
use topple::work::observed::ObservedOutcomes;
use topple::work::observer::{Observer, Phase};
use topple_pictures::drawing::error::FigureError;
use topple_pictures::drawing::render;
use topple_pictures::map::figure::fields::Field;
use topple_pictures::map::figure::{field, fields, main};
use topple_pictures::map::slices::{MOST, Slice};
use topple_pictures::map::{self, Map};
use topple_studies::suites::saved;

use super::map_file::MapFile;
use super::progress::Screen;
use super::words::Reporter;
use super::{InputError, refined};

/// How the names of the pictures of a map begin; that of a whole one has no more.
const MAIN: &str = "map";
/// Name of the file of the boundaries between outcomes.
const BOUNDARIES: &str = "boundaries.csv";

/// Opens the directory for the results.
pub fn open(out: &Path) -> Result<Directory, InputError> {
    Directory::open(out).map_err(|error| InputError(format!("--out: {error}")))
}

/// The directory of a command that saves nothing on its way: no other run begins there while it is held.
pub struct Held {
    /// Gone before the directory is.
    lock: Option<Lock>,
    path: PathBuf,
    is_new: bool,
}

/// Opens the directory for the results, and holds it.
pub fn open_alone(out: &Path) -> Result<(Directory, Held), InputError> {
    let is_new = !out.exists();
    let directory = open(out)?;
    let lock = Store::lock(out).map_err(|error| InputError(format!("--out: {error}")))?;
    Ok((directory, Held { lock: Some(lock), path: out.into(), is_new }))
}

impl Drop for Held {
    /// A directory that was made, and in which nothing was written, goes.
    fn drop(&mut self) {
        drop(self.lock.take());
        if self.is_new {
            // One in which something lies stays.
            let _ = fs::remove_dir(&self.path);
        }
    }
}

/// Refuses a directory that holds something of another kind: its files are not to lie beside the new ones.
pub fn refuse_other(out: &Path, kind: Kind) -> Result<Earlier, InputError> {
    let earlier = Earlier::of(out).map_err(|error| InputError(format!("--out: {error}")))?;
    let of_suite = matches!(kind, Kind::Envelope | Kind::Fragility);
    let at_work = [
        ("a map runs", kind != Kind::Map && Store::is_begun(out)),
        ("a sweep under a suite runs", !of_suite && saved::is_taken(out)),
    ];
    if let Some((what, _)) = at_work.iter().find(|(_, is_begun)| *is_begun) {
        let problem =
            format!("{what} in {}, or was interrupted; give another directory", out.display());
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

/// The names of the files that the map of a scene gets, those of a refined one among them.
pub fn places(scene: &Scene, grid: &Grid, files: &[MapFile], refines: bool) -> Vec<String> {
    let tables = files.iter().map(|file| file.name().to_string());
    let boundaries = has_boundaries(scene, grid).then(|| BOUNDARIES.to_string());
    let pictures = pictures(scene, grid).into_iter().flat_map(|name| picture_files(&name));
    let of_leaves = if refines { refined::names(files) } else { Vec::new() };
    tables.chain(boundaries).chain(pictures).chain(of_leaves).collect()
}

/// The names of the pictures of a map.
fn pictures(scene: &Scene, grid: &Grid) -> Vec<String> {
    match grid.slices() {
        1 if scene.excitation.record().is_none() || grid.line().is_some() => vec![MAIN.into()],
        1 => {
            let [contact, _] = &fields::CONTACT;
            let fields = fields_of(scene).map(|field| field.name);
            iter::once(MAIN).chain(fields).chain([contact.name]).map(String::from).collect()
        }
        slices if slices <= MOST => (0..slices).map(name_of).collect(),
        _ => Vec::new(),
    }
}

/// The files of a picture.
pub fn picture_files(name: &str) -> [String; 2] {
    [format!("{name}.svg"), format!("{name}.png")]
}

/// Refuses a directory in which something that no run wrote has the place of one of these files.
pub fn refuse_foreign(out: &Path, earlier: &Earlier, names: &[String]) -> Result<(), InputError> {
    let free = earlier.refuse_foreign(names, out);
    free.map_err(|error| InputError(format!("--out: {error}")))
}

/// Makes the directory ready for these files: removes what an earlier command left that a new one does not write, and
/// says it.
pub fn replace(
    out: &Directory,
    earlier: &Earlier,
    files: &[String],
    say: &Reporter,
) -> anyhow::Result<()> {
    let removed = earlier.begin(files, out).map_err(|error| match error {
        error @ WriteError::Foreign(_) => InputError(format!("--out: {error}")).into(),
        error => anyhow::Error::from(error),
    })?;
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
fn has_boundaries(scene: &Scene, grid: &Grid) -> bool {
    scene.excitation.record().is_some() && grid.axes().len() == 2 && grid.line().is_none()
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
        && has_boundaries(&map.plan.scene, grid)
    {
        out.write(BOUNDARIES, |w| map::boundaries::write(&whole.map, w))?;
    }
    for (name, svg, png) in figures {
        write_figure(out, name, svg, png)?;
    }
    let maps = figures.iter().filter(|(name, ..)| name.starts_with(MAIN));
    Ok(maps.map(|(name, ..)| out.file(&format!("{name}.png"))).collect())
}

/// A picture's name, its SVG and its PNG.
pub type Figure = (String, String, Vec<u8>);

/// The name of a slice's picture.
fn name_of(number: usize) -> String {
    format!("{MAIN}-{:02}", number + 1)
}

/// The fields of a scene that have a picture each, beside the main one.
fn fields_of(scene: &Scene) -> impl Iterator<Item = &'static Field> {
    let directions = scene.isolation;
    fields::FIELDS[1..].iter().filter(move |field| field.moves(directions))
}

/// The picture of a map that stands for all of it.
fn main_figure(map: &Map, at: &str, name: &str) -> Result<Figure, FigureError> {
    let svg = main::draw(map, at)?;
    let png = render::png(&svg)?;
    Ok((name.into(), svg, png))
}

/// The pictures of a map: its outcomes for a pulse, its fields for a record, curves along one axis.
fn figures(map: &Map) -> Result<Vec<Figure>, FigureError> {
    let mut figures = vec![main_figure(map, "", MAIN)?];
    if map.scene.excitation.record().is_none() || map.grid.line().is_some() {
        return Ok(figures);
    }
    let finish = |name: &str, svg: String| -> Result<Figure, FigureError> {
        let png = render::png(&svg)?;
        Ok((name.into(), svg, png))
    };
    let shown: Vec<_> = fields_of(map.scene).collect();
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
    let [of_svg, of_png] = picture_files(name);
    out.write(&of_svg, |w| w.write_all(svg.as_bytes()))?;
    out.write(&of_png, |w| w.write_all(png))?;
    Ok(())
}
