//! The files of a map.

use std::iter;
use std::path::PathBuf;

use rayon::prelude::*;
use topple::results::columns::Column;
use topple::results::files::Directory;
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

use super::map_file::MapFile;
use super::progress::Screen;
use super::refined;
use super::results_directory::{picture_files, write_picture};

/// How the names of the pictures of a map begin; that of a whole one has no more.
const MAIN: &str = "map";
/// Name of the file of the boundaries between outcomes.
const BOUNDARIES: &str = "boundaries.csv";

/// The names of the files that the map of a scene gets, those of a refined one among them.
pub fn places(scene: &Scene, grid: &Grid, files: &[MapFile], refines: bool) -> Vec<String> {
    let tables = files.iter().map(|file| file.name().to_string());
    let boundaries = has_boundaries(scene, grid).then(|| BOUNDARIES.to_string());
    let pictures = names_of_pictures(scene, grid).into_iter().flat_map(|name| picture_files(&name));
    let of_leaves = if refines { refined::names(files) } else { Vec::new() };
    tables.chain(boundaries).chain(pictures).chain(of_leaves).collect()
}

/// The names of the pictures of a map.
fn names_of_pictures(scene: &Scene, grid: &Grid) -> Vec<String> {
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

/// Draws the slices of a map.
fn draw(slices: &[Slice]) -> Result<Vec<Figure>, FigureError> {
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
    screen.begins(Phase::Writing, grid.len() * tables * Column::ALL.len());
    let outcomes = ObservedOutcomes::new(&*map.outcomes, screen);
    let (rows, arrays) = rayon::join(
        || -> anyhow::Result<()> {
            if files.contains(&MapFile::Csv) {
                out.write("map.csv", |w| csv::write(grid, &outcomes, w))?;
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
                out.write("map.npz", |w| npz::write(grid, &outcomes, map.source(), w))?;
            }
            Ok(())
        },
    );
    rows.and(arrays)
}

/// Draws the slices of a map and writes the pictures; the paths of those that stand for it.
pub fn pictures(out: &Directory, slices: &[Slice]) -> anyhow::Result<Vec<PathBuf>> {
    let figures = draw(slices)?;
    for (name, svg, png) in &figures {
        write_picture(out, name, svg, png)?;
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
