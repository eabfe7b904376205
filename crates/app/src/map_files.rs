//! The files of a map.

use std::iter;
use std::path::PathBuf;

use topple::results::column_set::ColumnSet;
use topple::results::files::Directory;
use topple::results::observed::ObservedOutcomes;
use topple::results::{csv, mat, npz};
use topple::scene::{Grid, Scene};
use topple::sweep::map::MapSweep;
use topple::work::observer::{Observer, Phase};
use topple::work::parallel;
use topple_pictures::drawing::error::FigureError;
use topple_pictures::drawing::picture::Picture;
use topple_pictures::drawing::print::Print;
use topple_pictures::map::figure::fields::Field;
use topple_pictures::map::figure::{field, fields, main, spectra};
use topple_pictures::map::slices::{MOST, Slice};
use topple_pictures::map::spectrum::Spectrum;
use topple_pictures::map::{self, Map};

use super::map_file::{MapFile, SPECTRUM};
use super::options::MapParts;
use super::progress::Screen;
use super::refined;
use super::results_directory::{picture_files, write_picture};

/// How the names of the pictures of a map begin; that of a whole one has no more.
const MAIN: &str = "map";
/// Name of the file of the boundaries between outcomes.
const BOUNDARIES: &str = "boundaries.csv";
/// Name of the picture of the spectra.
const SPECTRA: &str = "spectrum";

/// The names of the files that the map of a scene gets of which some columns are requested, those beside it among them.
pub fn places(
    (scene, grid, asked): (&Scene, &Grid, ColumnSet),
    files: &[MapFile],
    parts: &MapParts,
) -> Vec<String> {
    let tables = files.iter().map(|file| file.name().to_string());
    let boundaries = has_boundaries(scene, grid).then(|| BOUNDARIES.to_string());
    let pictures =
        names_of_pictures(scene, grid, asked).into_iter().flat_map(|name| picture_files(&name));
    let of_leaves = if parts.refine.is_some() { refined::names(files) } else { Vec::new() };
    let spectra =
        parts.spectrum.then(|| [SPECTRUM.to_string()].into_iter().chain(picture_files(SPECTRA)));
    tables
        .chain(boundaries)
        .chain(pictures)
        .chain(of_leaves)
        .chain(spectra.into_iter().flatten())
        .collect()
}

/// The names of the pictures of a map.
fn names_of_pictures(scene: &Scene, grid: &Grid, asked: ColumnSet) -> Vec<String> {
    match grid.slices() {
        1 if scene.excitation.record().is_none() || !has_fields(grid) => vec![MAIN.into()],
        1 => {
            let fields = fields_of(scene, asked).map(|field| field.name);
            let contact = contact(asked).first().map(|field| field.name);
            iter::once(MAIN).chain(fields).chain(contact).map(String::from).collect()
        }
        slices if slices <= MOST => (0..slices).map(name_of).collect(),
        _ => Vec::new(),
    }
}

/// Draws the slices of a map.
fn draw(slices: &[Slice], print: Print) -> Result<Vec<Figure>, FigureError> {
    match slices {
        [whole] => figures(&whole.map, print),
        slices => parallel::each(slices.len(), 1, |number| {
            let slice = &slices[number];
            main_figure(&slice.map, &slice.at, &name_of(number), print)
        })
        .into_iter()
        .collect(),
    }
}

/// True where fields are drawn over two axes: neither curves of one, nor the values of one cell.
fn has_fields(grid: &Grid) -> bool {
    grid.line().is_none() && grid.len() > 1
}

/// Writes the spectra of a map, their table and their picture.
pub fn spectra(out: &Directory, map: &Map, print: Print) -> anyhow::Result<()> {
    if let Some(spectrum) = Spectrum::of(map) {
        out.write(SPECTRUM, |w| spectrum.write(map, w))?;
    }
    if let Some(picture) = spectra::draw(map, print)? {
        write_picture(out, SPECTRA, &picture, &picture.png()?)?;
    }
    Ok(())
}

/// True where the boundaries between outcomes are written as curves: of a record's map with two axes.
fn has_boundaries(scene: &Scene, grid: &Grid) -> bool {
    scene.excitation.record().is_some() && grid.axes().len() == 2 && grid.line().is_none()
}

/// Writes the tables of a map, but map.zarr, at the same time.
pub fn tables(
    out: &Directory,
    map: &MapSweep,
    slices: &[Slice],
    files: &[MapFile],
    screen: &Screen,
) -> anyhow::Result<()> {
    let grid = &map.grid;
    let tables = files.iter().filter(|file| **file != MapFile::Zarr).count();
    screen.begins(Phase::Writing, grid.len() * tables * map.method.columns.columns().count());
    let outcomes = ObservedOutcomes::new(&*map.outcomes, screen);
    let (rows, arrays) = rayon::join(
        || -> anyhow::Result<()> {
            if files.contains(&MapFile::Csv) {
                out.write(MapFile::Csv.name(), |w| {
                    csv::write(grid, &outcomes, map.method.columns, w)
                })?;
            }
            if let [whole] = slices
                && has_boundaries(&map.plan.scene, grid)
            {
                out.write(BOUNDARIES, |w| map::boundaries::write(&whole.map, w))?;
            }
            Ok(())
        },
        || -> anyhow::Result<()> {
            if files.contains(&MapFile::Npz) {
                let name = MapFile::Npz.name();
                out.write(name, |w| npz::write(grid, &outcomes, map.source(), w))?;
            }
            if files.contains(&MapFile::Mat) {
                let name = MapFile::Mat.name();
                out.write(name, |w| mat::write(grid, &outcomes, map.source(), w))?;
            }
            Ok(())
        },
    );
    rows.and(arrays)
}

/// Draws the slices of a map and writes the pictures; the paths of those that stand for it.
pub fn pictures(out: &Directory, slices: &[Slice], print: Print) -> anyhow::Result<Vec<PathBuf>> {
    let figures = draw(slices, print)?;
    for (name, picture, png) in &figures {
        write_picture(out, name, picture, png)?;
    }
    let maps = figures.iter().filter(|(name, ..)| name.starts_with(MAIN));
    Ok(maps.map(|(name, ..)| out.file(&format!("{name}.png"))).collect())
}

/// A picture, its name before and its PNG behind it.
pub type Figure = (String, Picture, Vec<u8>);

/// The name of a slice's picture.
fn name_of(number: usize) -> String {
    format!("{MAIN}-{:02}", number + 1)
}

/// The fields of a scene that have a picture each, beside the main one, of the requested columns.
fn fields_of(scene: &Scene, asked: ColumnSet) -> impl Iterator<Item = &'static Field> {
    let directions = scene.isolation;
    let others = fields::FIELDS[1..].iter();
    others.filter(move |field| field.moves(directions) && asked.has(field.column))
}

/// The fields of the picture of contact forces, of the requested columns: two, one or none.
fn contact(asked: ColumnSet) -> Vec<&'static Field> {
    fields::CONTACT.iter().filter(|field| asked.has(field.column)).collect()
}

/// The picture of a map that stands for all of it.
fn main_figure(map: &Map, at: &str, name: &str, print: Print) -> Result<Figure, FigureError> {
    let picture = main::draw(map, at, print)?;
    let png = picture.png()?;
    Ok((name.into(), picture, png))
}

/// The pictures of a map: its outcomes for a pulse, its fields for a record, curves along one axis.
fn figures(map: &Map, print: Print) -> Result<Vec<Figure>, FigureError> {
    let mut figures = vec![main_figure(map, "", MAIN, print)?];
    if map.scene.excitation.record().is_none() || !has_fields(&map.grid) {
        return Ok(figures);
    }
    let finish = |name: &str, picture: Picture| -> Result<Figure, FigureError> {
        let png = picture.png()?;
        Ok((name.into(), picture, png))
    };
    let shown: Vec<_> = fields_of(map.scene, map.columns).collect();
    let others = parallel::each(shown.len(), 1, |number| {
        let field = shown[number];
        finish(field.name, field::draw(map, field, "", print)?)
    });
    figures.extend(others.into_iter().collect::<Result<Vec<_>, _>>()?);
    let contact = contact(map.columns);
    if let Some(first) = contact.first() {
        let titles: Vec<&str> = contact.iter().map(|field| field.title).collect();
        let title =
            format!("{}: {}", print.title.unwrap_or(&map.scene.title), titles.join(" and "));
        figures.push(finish(first.name, field::beside(map, &contact, &title, print)?)?);
    }
    Ok(figures)
}
