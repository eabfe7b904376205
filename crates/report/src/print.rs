//! A report as a PDF of A4 pages, drawn as the pictures are.

use topple::results::colour::BLACK;
use topple_pictures::drawing::canvas::{Canvas, Place, stroke};
use topple_pictures::drawing::error::FigureError;
use topple_pictures::drawing::pdf::{self, Placed};
use topple_pictures::drawing::text::{style, wrapped};
use topple_pictures::drawing::{MILLIMETRE, render};

use super::CREATOR;
use super::document::{Document, Piece};

/// A4, and the margin on each side, points.
const PAGE: (f64, f64) = (210.0 * MILLIMETRE, 297.0 * MILLIMETRE);
const MARGIN: f64 = 18.0 * MILLIMETRE;
const WIDE: f64 = PAGE.0 - 2.0 * MARGIN;
/// Sizes of letters.
const TEXT: f64 = 9.5;
const SMALL: f64 = 8.0;
const HEADING: f64 = 13.0;
const CELL: f64 = 7.0;
/// From one line to the next, over the size of its letters, and between two parts.
const LEADING: f64 = 1.4;
const GAP: f64 = 7.0;
/// A picture takes no more of a page's height.
const MOST: f64 = 0.6 * (PAGE.1 - 2.0 * MARGIN);
/// Space within the cells of a table.
const PAD: f64 = 3.0;

/// How a PDF of a report says what it is.
pub fn mark() -> String {
    format!("/Creator ({CREATOR})")
}

/// The pages.
///
/// # Errors
/// [`FigureError`]: a picture that cannot be drawn.
pub fn write(document: &Document) -> Result<Vec<u8>, FigureError> {
    let mut paper = Paper::new();
    paper.text(&document.title, 17.0, 0.0);
    let mut pieces = document.pieces.iter().peekable();
    while let Some(piece) = pieces.next() {
        if let (Piece::Heading(..), Some(Piece::Picture(svg, meaning))) = (piece, pieces.peek()) {
            // A heading goes with its picture.
            paper.need(Picture::of(svg, meaning)?.height() + 3.0 * HEADING);
        }
        paper.put(piece)?;
    }
    paper.turn();
    pdf::pages(&paper.pages, PAGE, (&document.title, CREATOR))
}

/// A picture on a page.
struct Picture {
    size: (f64, f64),
    scale: f64,
    /// Height of what is said below it.
    words: f64,
}

impl Picture {
    fn of(svg: &str, meaning: &str) -> Result<Picture, FigureError> {
        let (width, height) = render::size(svg)?;
        let scale = (WIDE / width).min(MOST / height).min(1.0);
        let words = wrapped(meaning, SMALL, WIDE).len() as f64 * LEADING * SMALL;
        Ok(Picture { size: (width, height), scale, words })
    }

    /// Height of it and of what is said below it.
    fn height(&self) -> f64 {
        self.scale * self.size.1 + self.words + 2.0 * GAP
    }
}

/// Pages, and the one that is written on.
struct Paper {
    pages: Vec<Vec<Placed>>,
    page: Canvas,
    pictures: Vec<Placed>,
    y: f64,
}

impl Paper {
    fn new() -> Paper {
        Paper { pages: Vec::new(), page: Canvas::new(PAGE.0), pictures: Vec::new(), y: MARGIN }
    }

    /// Ends the page.
    fn turn(&mut self) {
        let number = (self.pages.len() + 1).to_string();
        let foot = (0.5 * PAGE.0, PAGE.1 - 0.5 * MARGIN);
        self.page.text(foot, style(SMALL).middle(), &number);
        let page = std::mem::replace(&mut self.page, Canvas::new(PAGE.0));
        let text = Placed { svg: page.finish(PAGE.1), x: 0.0, y: 0.0, scale: 1.0 };
        let mut all = vec![text];
        all.append(&mut self.pictures);
        self.pages.push(all);
        self.y = MARGIN;
    }

    /// Ends the page where so much does not fit on it.
    fn need(&mut self, height: f64) {
        if self.y + height > PAGE.1 - MARGIN && self.y > MARGIN {
            self.turn();
        }
    }

    /// Lines of a text, `left` points in.
    fn text(&mut self, text: &str, size: f64, left: f64) {
        for line in text.split('\n').flat_map(|line| wrapped(line, size, WIDE - left)) {
            self.need(LEADING * size);
            self.page.text((MARGIN + left, self.y + size), style(size), &line);
            self.y += LEADING * size;
        }
        self.y += 0.4 * size;
    }

    fn put(&mut self, piece: &Piece) -> Result<(), FigureError> {
        match piece {
            Piece::Heading(level, text) => {
                let size = if *level == 1 { HEADING } else { 11.0 };
                // Not alone at the foot of a page.
                self.need(8.0 * size);
                self.y += GAP;
                self.text(text, size, 0.0);
            }
            Piece::Text(text) => self.text(text, TEXT, 0.0),
            Piece::List(lines) => {
                for line in lines {
                    self.need(LEADING * TEXT);
                    self.page.text((MARGIN + 2.0, self.y + TEXT), style(TEXT), "•");
                    self.text(line, TEXT, 12.0);
                }
            }
            Piece::Code(lines) => lines.iter().for_each(|line| self.text(line, SMALL, 12.0)),
            Piece::Picture(svg, meaning) => self.picture(svg, meaning)?,
            Piece::Table(names, rows) => self.table(names, rows),
        }
        Ok(())
    }

    fn picture(&mut self, svg: &str, meaning: &str) -> Result<(), FigureError> {
        let picture = Picture::of(svg, meaning)?;
        let Picture { size: (width, height), scale, .. } = picture;
        self.need(picture.height());
        let x = MARGIN + 0.5 * (WIDE - scale * width);
        self.pictures.push(Placed { svg: svg.into(), x, y: self.y, scale });
        self.y += scale * height + 2.0;
        self.text(meaning, SMALL, 0.0);
        self.y += GAP;
        Ok(())
    }

    fn table(&mut self, names: &[String], rows: &[Vec<String>]) {
        let columns = names.len().max(1);
        // Each column as wide as its longest word needs, the rest by the length of its texts.
        let longest = |column: usize| {
            let all = std::iter::once(names).chain(rows.iter().map(Vec::as_slice));
            let texts = all.filter_map(|row| row.get(column));
            texts.map(|text| text.chars().count().clamp(4, 40)).max().unwrap_or(4) as f64
        };
        let weights: Vec<f64> = (0..columns).map(|column| longest(column).sqrt()).collect();
        let whole: f64 = weights.iter().sum();
        let wide = WIDE.min(90.0 * columns as f64);
        let widths: Vec<f64> = weights.iter().map(|weight| wide * weight / whole).collect();
        self.row(names, &widths, true);
        for row in rows {
            if self.row_turns(row, &widths) {
                self.turn();
                self.row(names, &widths, true);
            }
            self.row(row, &widths, false);
        }
        self.y += GAP;
    }

    fn lines(row: &[String], widths: &[f64]) -> Vec<Vec<String>> {
        let cells = row.iter().zip(widths);
        cells.map(|(text, width)| wrapped(text, CELL, width - 2.0 * PAD)).collect()
    }

    fn height(lines: &[Vec<String>]) -> f64 {
        let most = lines.iter().map(Vec::len).max().unwrap_or(1);
        most as f64 * 1.25 * CELL + 2.0 * PAD
    }

    fn row_turns(&self, row: &[String], widths: &[f64]) -> bool {
        self.y + Self::height(&Self::lines(row, widths)) > PAGE.1 - MARGIN
    }

    fn row(&mut self, row: &[String], widths: &[f64], head: bool) {
        let lines = Self::lines(row, widths);
        let height = Self::height(&lines);
        self.need(height);
        let mut x = MARGIN;
        for (lines, width) in lines.iter().zip(widths) {
            let place = Place { x, y: self.y, width: *width, height };
            if head {
                self.page.fill(place, [0xee, 0xee, 0xee]);
            }
            self.page.outline(place, stroke(BLACK, 0.3));
            for (number, line) in lines.iter().enumerate() {
                let foot = self.y + PAD + CELL + 1.25 * CELL * number as f64;
                self.page.text((x + PAD, foot), style(CELL), line);
            }
            x += width;
        }
        self.y += height;
    }
}
