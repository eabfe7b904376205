//! A report as a PDF of A4 pages, drawn as the pictures are.

use topple_pictures::colours::BLACK;
use topple_pictures::drawing::canvas::{Canvas, Place, stroke};
use topple_pictures::drawing::error::FigureError;
use topple_pictures::drawing::letters::Missing;
use topple_pictures::drawing::pdf::{self, Placed};
use topple_pictures::drawing::picture::Picture as Drawn;
use topple_pictures::drawing::text::{style, wrapped};
use topple_pictures::drawing::{MILLIMETRE, letters};

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
/// A picture takes no more of a page's height, and is drawn no larger than so many times its own size. Where it takes a smaller
/// one to fit on the rest of a page it is no smaller than this, and letters of 7 points are of 5.6.
const MOST: f64 = 0.6 * (PAGE.1 - 2.0 * MARGIN);
const LARGEST: f64 = 1.2;
const SMALLEST: f64 = 0.8;
/// Two pictures that are no wider than this lie beside each other, so far apart.
const NARROW: f64 = 100.0 * MILLIMETRE;
const APART: f64 = 5.0 * MILLIMETRE;
/// Space within the cells of a table.
const PAD: f64 = 3.0;

/// How a PDF of a report says what it is.
pub fn mark() -> String {
    format!("/Creator ({CREATOR})")
}

/// The pages, and which letters of them no font has.
pub fn write(document: &Document) -> Result<(Vec<u8>, Option<Missing>), FigureError> {
    let mut paper = Paper::new();
    paper.text(&document.title, 17.0, 0.0);
    let mut pieces = &document.pieces[..];
    while let [piece, rest @ ..] = pieces {
        pieces = rest;
        match piece {
            Piece::Picture(..) => {
                let (row, after) = row_of(std::slice::from_ref(piece), rest);
                paper.pictures(&row);
                pieces = after;
            }
            Piece::Heading(level, text) => {
                // A heading goes with its pictures.
                let (row, _) = row_of(&[], rest);
                let words = row.iter().map(Picture::words).fold(0.0, f64::max);
                let with = least(&row) * (height(&row) - words) + words;
                let with = if row.is_empty() { 0.0 } else { with };
                paper.heading(*level, text, with);
            }
            _ => paper.put(piece),
        }
    }
    paper.turn();
    let problem = letters::missing(paper.pages.iter().flatten().map(|placed| &placed.picture));
    Ok((pdf::pages(&paper.pages, PAGE, (&document.title, CREATOR))?, problem))
}

/// A picture in a row of them.
struct Picture<'a> {
    own: &'a Drawn,
    size: (f64, f64),
    scale: f64,
    /// Width that it and its words may take.
    room: f64,
    /// What is said below it.
    words: Vec<String>,
}

impl<'a> Picture<'a> {
    /// One of so many in a row.
    fn of(own: &'a Drawn, meaning: &str, count: usize) -> Picture<'a> {
        let (width, height) = own.points();
        let room = (WIDE - APART * (count as f64 - 1.0)) / count as f64;
        let scale = (room / width).min(MOST / height).min(LARGEST);
        let words = wrapped(meaning, SMALL, room);
        Picture { own, size: (width, height), scale, room, words }
    }

    fn words(&self) -> f64 {
        self.words.len() as f64 * LEADING * SMALL
    }
}

/// Height of a row of pictures and of what is said below them.
fn height(row: &[Picture]) -> f64 {
    let drawn = row.iter().map(|one| one.scale * one.size.1).fold(0.0, f64::max);
    drawn + row.iter().map(Picture::words).fold(0.0, f64::max) + 2.0 * GAP
}

/// How small a row of pictures may become, of what it is.
fn least(row: &[Picture]) -> f64 {
    let scale = row.iter().map(|one| one.scale).fold(f64::INFINITY, f64::min);
    (SMALLEST / scale).min(1.0)
}

/// The pictures of a row, two where the first two are narrow, among pieces of which the first ones may be apart; and what
/// follows them.
fn row_of<'a>(first: &'a [Piece], rest: &'a [Piece]) -> (Vec<Picture<'a>>, &'a [Piece]) {
    let mut pictures = first.iter().chain(rest).map_while(|piece| match piece {
        Piece::Picture(drawn, meaning) => Some((drawn, meaning)),
        _ => None,
    });
    let (one, other) = (pictures.next(), pictures.next());
    let Some((drawn, meaning)) = one else { return (Vec::new(), rest) };
    let is_narrow = |drawn: &Drawn| drawn.points().0 <= NARROW;
    if let Some((next, its)) = other
        && is_narrow(drawn)
        && is_narrow(next)
    {
        let row = vec![Picture::of(drawn, meaning, 2), Picture::of(next, its, 2)];
        return (row, &rest[2 - first.len()..]);
    }
    (vec![Picture::of(drawn, meaning, 1)], &rest[1 - first.len()..])
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
        let text = Placed { picture: page.finish(PAGE.1), x: 0.0, y: 0.0, scale: 1.0 };
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

    /// A heading, not alone at the foot of a page: so much of what follows goes with it.
    fn heading(&mut self, level: u32, text: &str, with: f64) {
        let size = if level == 1 { HEADING } else { 11.0 };
        self.need((3.0 * HEADING + with).max(8.0 * size));
        self.y += GAP;
        self.text(text, size, 0.0);
    }

    fn put(&mut self, piece: &Piece) {
        match piece {
            // Those are put by themselves.
            Piece::Heading(..) | Piece::Picture(..) => {}
            Piece::Text(text) => self.text(text, TEXT, 0.0),
            Piece::List(lines) => {
                for line in lines {
                    self.need(LEADING * TEXT);
                    self.page.text((MARGIN + 2.0, self.y + TEXT), style(TEXT), "•");
                    self.text(line, TEXT, 12.0);
                }
            }
            Piece::Code(lines) => lines.iter().for_each(|line| self.text(line, SMALL, 12.0)),
            Piece::Table(names, rows) => self.table(names, rows),
        }
    }

    fn pictures(&mut self, row: &[Picture]) {
        let words = row.iter().map(Picture::words).fold(0.0, f64::max) + 2.0 * GAP;
        let (whole, left) = (height(row), PAGE.1 - MARGIN - self.y);
        let smaller = ((left - words) / (whole - words)).min(1.0);
        let smaller = if smaller < least(row) { 1.0 } else { smaller };
        self.need(smaller * (whole - words) + words);
        let drawn = smaller * (whole - words);
        let mut x = MARGIN;
        for Picture { own, size: (width, _), scale, room, words } in row {
            let scale = smaller * scale;
            let at = x + 0.5 * (room - scale * width);
            self.pictures.push(Placed { picture: (*own).clone(), x: at, y: self.y, scale });
            let top = self.y + drawn + 2.0 + SMALL;
            for (number, line) in words.iter().enumerate() {
                let y = top + LEADING * SMALL * number as f64;
                self.page.text((x, y), style(SMALL), line);
            }
            x += room + APART;
        }
        self.y += drawn + words;
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
