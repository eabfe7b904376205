//! What a report consists of, before it becomes a page or a print.

use topple_pictures::drawing::picture::Picture;

/// A report.
#[derive(Debug, Clone, PartialEq)]
pub struct Document {
    /// Its title.
    pub title: String,
    /// Its parts, in their order.
    pub pieces: Vec<Piece>,
}

/// A part of a report.
#[derive(Debug, Clone, PartialEq)]
pub enum Piece {
    /// A heading; of a section where the number is 1, of a part of it where it is 2.
    Heading(u32, String),
    /// A paragraph.
    Text(String),
    /// Sentences, one below the other.
    List(Vec<String>),
    /// A table: its columns and its rows.
    Table(Vec<String>, Vec<Vec<String>>),
    /// A picture, and what it shows.
    Picture(Picture, String),
    /// Lines of a command or of a file.
    Code(Vec<String>),
}
