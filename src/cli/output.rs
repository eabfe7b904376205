//! The files of a map.

use std::path::{Path, PathBuf};

use rayon::prelude::*;
use topple::map::figure::FigureError;
use topple::map::figure::{document, field, frame, overturning};
use topple::map::files::{Directory, WriteError};
use topple::map::manifest::Manifest;
use topple::map::outcomes::Outcomes;
use topple::map::{self, Map};
use topple::scene::{Excitation, Grid};

use super::InputError;

/// Pixels of a PNG for each of its SVG's units.
pub const PNG_SCALE: f32 = 2.0;

/// Opens the directory for the results.
pub fn open(out: &Path) -> Result<Directory, InputError> {
    Directory::open(out).map_err(|error| InputError(format!("--out: {error}")))
}

/// Writes the files of a map, of which `map` is what is drawn; the path of its picture.
pub fn write(
    out: &Directory,
    grid: &Grid,
    outcomes: &dyn Outcomes,
    map: &Map,
    manifest: &Manifest,
) -> anyhow::Result<PathBuf> {
    let figures = figures(map)?;
    out.write("map.csv", |w| map::csv::write(grid, outcomes, w))?;
    out.write("map.npz", |w| map::npz::write(grid, outcomes, w))?;
    if matches!(map.scene.excitation, Excitation::Record(_)) {
        out.write("boundaries.csv", |w| map::boundaries::write(map, w))?;
    }
    for (name, svg, png) in &figures {
        write_figure(out, name, svg, png)?;
    }
    write_json(out, manifest)?;
    Ok(out.file("map.png"))
}

/// A picture's name, its SVG and its PNG.
type Figure = (&'static str, String, Vec<u8>);

/// The pictures of a map: its outcomes for a pulse, its fields for a record.
fn figures(map: &Map) -> Result<Vec<Figure>, FigureError> {
    let finish = |name, svg: String| {
        let png = document::render(&svg, PNG_SCALE)?;
        Ok((name, svg, png))
    };
    match map.scene.excitation {
        Excitation::Pulse(_) => Ok(vec![finish("map", overturning::draw(map)?)?]),
        Excitation::Record(_) => {
            let mut figures: Vec<Figure> = field::FIELDS
                .par_iter()
                .map(|field| finish(field.name, field::draw(map, field)?))
                .collect::<Result<_, _>>()?;
            let [normal, friction] = &field::CONTACT;
            let (left, right) = (field::draw(map, normal)?, field::draw(map, friction)?);
            figures.push(finish(normal.name, document::beside(frame::SIZE, &left, &right))?);
            Ok(figures)
        }
    }
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
