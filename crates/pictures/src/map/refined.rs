//! Pictures of a refined map at its full resolution: a pixel a cell, and the outlines of its outcomes. In greys lines tell
//! outcomes of one grey apart: every [`PITCH`]th row or column of their cells.

use std::collections::HashMap;
use std::io::{self, Write};

use crate::colours::palette::{Kind, dots};
use crate::colours::print_palette::{Palette, Texture};
use crate::drawing::error::FigureError;
use crate::drawing::svg::hex;
use topple::refine::refined::RefinedMap;
use topple::results::columns::Column;
use topple::results::outcomes::Outcomes;

/// The columns that a cell's colour depends on.
const COLOUR: [Column; 3] = [Column::Outcome, Column::Impacts, Column::Uplifts];

/// The places of the kinds of a row's cells among all kinds.
fn kinds_of(map: &RefinedMap, all: &[Kind], row: usize) -> io::Result<Vec<u8>> {
    let columns = map.report.shape.0;
    let outcomes = map.read(row * columns..(row + 1) * columns, &COLOUR)?;
    let place = |kind| all.iter().position(|other| *other == kind).unwrap_or(0) as u8;
    let mut kinds: Vec<u8> = Vec::with_capacity(columns);
    // Most cells are like the one before.
    for alike in
        outcomes.chunk_by(|a, b| (a.class, a.impacts, a.uplifts) == (b.class, b.impacts, b.uplifts))
    {
        kinds.resize(kinds.len() + alike.len(), place(Kind::of(&alike[0])));
    }
    Ok(kinds)
}

/// From one line over a grey to the next, cells.
const PITCH: usize = 4;

/// Writes the map as a PNG of a pixel a cell, the last row of the second axis at the top: nothing but the colours of
/// the outcomes in a palette.
pub fn write_png(
    map: &RefinedMap,
    palette: Palette,
    writer: impl Write,
) -> Result<(), FigureError> {
    let failed = |e: &dyn std::fmt::Display| FigureError::Encode(e.to_string());
    let all = Kind::all();
    let (columns, rows) = map.report.shape;
    let side = |n: usize| u32::try_from(n).map_err(|e| failed(&e));
    let mut encoder = png::Encoder::new(writer, side(columns)?, side(rows)?);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Fast);
    // Those of the kinds, and behind them those of the lines over them.
    let colours = all.iter().map(|kind| palette.of(kind.colour()));
    let lines = colours.clone().map(dots);
    encoder.set_palette(colours.chain(lines).flatten().collect::<Vec<u8>>());
    let mut writer = encoder.write_header().map_err(|e| failed(&e))?;
    let mut stream = writer.stream_writer().map_err(|e| failed(&e))?;
    for row in (0..rows).rev() {
        let mut kinds = kinds_of(map, &all, row).map_err(|e| failed(&e))?;
        if palette == Palette::Grey {
            for (column, kind) in kinds.iter_mut().enumerate() {
                let is_line = match palette.texture(all[usize::from(*kind)].colour()) {
                    Texture::Plain => false,
                    Texture::Across => row.is_multiple_of(PITCH),
                    Texture::Upright => column.is_multiple_of(PITCH),
                };
                *kind += if is_line { all.len() as u8 } else { 0 };
            }
        }
        stream.write_all(&kinds).map_err(|e| failed(&e))?;
    }
    stream.finish().map_err(|e| failed(&e))?;
    writer.finish().map_err(|e| failed(&e))
}

/// Writes the map as an SVG of the exact outlines of its outcomes, one path a colour; a unit is a cell. The colour with
/// the most of them is a rectangle beneath the others, whose outlines its own would repeat.
pub fn write_svg(map: &RefinedMap, palette: Palette, mut writer: impl Write) -> io::Result<()> {
    let all = Kind::all();
    let (columns, rows) = map.report.shape;
    let mut outlines = Outlines::default();
    // From the top: a row above the first and one below the last are of no kind.
    let mut above = vec![None; columns];
    for line in 0..=rows {
        let below: Vec<Option<u8>> = match rows.checked_sub(line + 1) {
            Some(row) => kinds_of(map, &all, row)?.into_iter().map(Some).collect(),
            None => vec![None; columns],
        };
        outlines.line(line, &above, &below);
        above = below;
    }
    writeln!(
        writer,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {columns} {rows}\" \
         shape-rendering=\"crispEdges\">"
    )?;
    for (number, paths) in outlines.paths((columns, rows)) {
        let (colour, label) = (all[usize::from(number)].colour(), all[usize::from(number)].label());
        let own = palette.of(colour);
        let line = match palette.texture(colour) {
            Texture::Plain => None,
            Texture::Across => Some("M0 0.5H4"),
            Texture::Upright => Some("M0.5 0V4"),
        };
        let mut fill = hex(own);
        if let Some(line) = line {
            writeln!(
                writer,
                "<pattern id=\"lines{number}\" width=\"{PITCH}\" height=\"{PITCH}\" patternUnits=\"userSpaceOnUse\">\
                 <rect width=\"{PITCH}\" height=\"{PITCH}\" fill=\"{fill}\"/><path d=\"{line}\" stroke=\"{}\"/></pattern>",
                hex(dots(own))
            )?;
            fill = format!("url(#lines{number})");
        }
        writeln!(writer, "<path fill=\"{fill}\" d=\"{paths}\"><title>{label}</title></path>")?;
    }
    writeln!(writer, "</svg>")
}

/// A corner of cells: its column and its line from the top.
type Corner = (u32, u32);

/// Borders of regions of one kind, piece by piece, each with the region on its right: by kind from a corner to the next
/// ones, of which there are two where regions touch in it.
#[derive(Default)]
pub struct Outlines(HashMap<u8, HashMap<Corner, Vec<Corner>>>);

impl Outlines {
    /// Adds a piece between two kinds, `right` on its right.
    fn add(&mut self, [left, right]: [Option<u8>; 2], from: Corner, to: Corner) {
        if left == right {
            return;
        }
        for (kind, from, to) in [(right, from, to), (left, to, from)] {
            if let Some(kind) = kind {
                self.0.entry(kind).or_default().entry(from).or_default().push(to);
            }
        }
    }

    /// Adds the horizontal pieces of a line, and the vertical ones of the row below it.
    pub fn line(&mut self, line: usize, above: &[Option<u8>], below: &[Option<u8>]) {
        // A grid has fewer than 2^32 columns and rows.
        let y = line as u32;
        let mut left = None;
        for (x, (&above, &below)) in (0..).zip(above.iter().zip(below)) {
            self.add([above, below], (x, y), (x + 1, y));
            self.add([left, below], (x, y + 1), (x, y));
            left = below;
        }
        let end = below.len() as u32;
        self.add([left, None], (end, y + 1), (end, y));
    }

    /// The data of each kind's path in the order of painting: a rectangle of the kind with the most pieces, and the closed
    /// outlines of the others.
    pub fn paths(self, (columns, rows): (usize, usize)) -> Vec<(u8, String)> {
        let mut kinds: Vec<_> = self.0.into_iter().collect();
        let most = kinds.iter().map(|(_, next)| next.len()).max();
        kinds.sort_unstable_by_key(|(kind, next)| (Some(next.len()) != most, *kind));
        let whole = format!("M0 0H{columns}V{rows}H0Z");
        let data =
            |(place, (kind, next))| (kind, if place == 0 { whole.clone() } else { path(next) });
        kinds.into_iter().enumerate().map(data).collect()
    }
}

/// Joins the pieces to closed outlines.
fn path(mut next: HashMap<Corner, Vec<Corner>>) -> String {
    use std::fmt::Write;
    let mut starts: Vec<Corner> = next.keys().copied().collect();
    starts.sort_unstable_by_key(|(x, y)| (*y, *x));
    let mut data = String::new();
    for start in starts {
        // The leftmost of the highest corners of what is left: an outline turns there.
        while let Some(first) = next.get_mut(&start).and_then(Vec::pop) {
            // Nothing that is written to a text fails.
            let _ = write!(data, "M{} {}", start.0, start.1);
            let (mut from, mut at) = (start, first);
            while at != start {
                let Some(to) = next.get_mut(&at).and_then(Vec::pop) else { break };
                let _ = match (from.1 == at.1, at.1 == to.1) {
                    (true, false) => write!(data, "H{}", at.0),
                    (false, true) => write!(data, "V{}", at.1),
                    _ => Ok(()),
                };
                (from, at) = (at, to);
            }
            data.push('Z');
        }
    }
    data
}
