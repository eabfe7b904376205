//! A report as one page of HTML: no network, no scripts, and it prints to A4.

use std::fmt::Write as _;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use topple::scene::shown::is_hidden;
use topple_pictures::drawing::text::{self, Piece as Letters};

use super::CREATOR;
use super::document::{Document, Piece};

const STYLE: &str = include_str!("report.css");

/// How a page of a report says what it is.
pub fn mark() -> String {
    format!("<meta name=\"generator\" content=\"{CREATOR}\">")
}

/// The page.
pub fn write(document: &Document) -> String {
    let title = escaped(&document.title);
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n{}\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{title}</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n<h1>{title}</h1>\n",
        mark()
    );
    let is_picture = |piece: &Piece| matches!(piece, Piece::Picture(..));
    for alike in document.pieces.chunk_by(|one, next| is_picture(one) && is_picture(next)) {
        // Pictures in succession lie beside each other where there is room.
        let (before, after) = match alike {
            [_, _, ..] => ("<div class=\"pictures\">\n", "</div>\n"),
            _ => ("", ""),
        };
        page += before;
        alike.iter().for_each(|piece| push(&mut page, piece));
        page += after;
    }
    page + "</main>\n</body>\n</html>\n"
}

/// Writes a part. Writing into a string cannot fail.
fn push(page: &mut String, piece: &Piece) {
    let _ = match piece {
        Piece::Heading(level, text) => {
            let level = level + 1;
            writeln!(page, "<h{level}>{}</h{level}>", escaped(text))
        }
        Piece::Text(text) => writeln!(page, "<p>{}</p>", marked_up(text)),
        Piece::List(lines) => {
            let lines = lines.iter().map(|line| format!("<li>{}</li>\n", marked_up(line)));
            writeln!(page, "<ul>\n{}</ul>", lines.collect::<String>())
        }
        Piece::Table(names, rows) => {
            let row = |cells: &[String], tag: &str| {
                let cells = cells.iter().map(|cell| format!("<{tag}>{}</{tag}>", marked_up(cell)));
                format!("<tr>{}</tr>\n", cells.collect::<String>())
            };
            let rows = rows.iter().map(|cells| row(cells, "td")).collect::<String>();
            let head = row(names, "th");
            writeln!(
                page,
                "<div class=\"wide\"><table>\n<thead>{head}</thead>\n<tbody>\n{rows}</tbody>\n</table></div>"
            )
        }
        Piece::Picture(picture, meaning) => {
            let (data, plain) = (STANDARD.encode(picture.outlined()), escaped(meaning));
            writeln!(
                page,
                "<figure>\n<img alt=\"{plain}\" src=\"data:image/svg+xml;base64,{data}\">\n\
                 <figcaption>{}</figcaption>\n</figure>",
                marked_up(meaning)
            )
        }
        Piece::Code(lines) => writeln!(page, "<pre>{}</pre>", escaped(&lines.join("\n"))),
    };
}

/// A text with its symbols' indices below the line.
fn marked_up(text: &str) -> String {
    let pieces = text::pieces(text).into_iter().map(|(_, piece)| match piece {
        Letters::Plain(letter) => escaped(letter.encode_utf8(&mut [0; 4])),
        Letters::Symbol(letter, index) => {
            format!("{}<sub>{}</sub>", escaped(letter), escaped(index))
        }
        Letters::Power(power) => format!("<sup>{}</sup>", escaped(power)),
    });
    pieces.collect()
}

/// A text without what HTML reads as its own.
fn escaped(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => plain.push_str("&amp;"),
            '<' => plain.push_str("&lt;"),
            '>' => plain.push_str("&gt;"),
            '"' => plain.push_str("&quot;"),
            '\'' => plain.push_str("&#39;"),
            c if is_hidden(c) && c != '\n' => plain.push(char::REPLACEMENT_CHARACTER),
            c => plain.push(c),
        }
    }
    plain
}
