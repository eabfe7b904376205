//! Files of what is in view: those that a command line would write.

use std::io::Cursor;
use std::sync::atomic::AtomicBool;

use serde::Deserialize;

use super::asked::{self, AskedPrecision, Flat};
use super::command::toml;
use super::refused::Refused;
use super::session::Session;
use super::stages::Stages;
use super::view::{sweep, whole};
use topple::results::{csv, npz};
use topple_pictures::drawing::letters;
use topple_pictures::drawing::picture::Picture;
use topple_pictures::drawing::print::Print;
use topple_pictures::map::figure::{field, fields, main};

/// A kind of file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// The picture, in pixels.
    Png,
    /// The picture, in lines.
    Svg,
    /// All columns, as arrays.
    Npz,
    /// All columns, as a table.
    Csv,
    /// The scene.
    Toml,
}

/// A request for a file.
#[derive(Debug, Clone, Deserialize)]
pub struct SaveRequest {
    /// The scene.
    pub scene: Flat,
    /// Cells along each axis.
    pub count: [u32; 2],
    /// Number type.
    #[serde(default)]
    pub precision: AskedPrecision,
    /// Which one.
    pub kind: Kind,
    /// The column that a picture shows as a shade, or outcome.
    #[serde(default)]
    pub show: Option<String>,
}

/// The bytes of a file, and what a browser calls it.
pub fn run(
    session: &Session,
    request: &SaveRequest,
    stop: &AtomicBool,
) -> Result<(Vec<u8>, &'static str), Refused> {
    let SaveRequest { scene, count, precision, .. } = request;
    let count = Stages::of(scene, *count)?.count(0);
    if request.kind == Kind::Toml {
        let given = asked::builder(scene, Some(count))?;
        session.records.check(&given)?;
        return Ok((toml(session, &given)?.into_bytes(), "text/plain; charset=utf-8"));
    }
    let ready = session.ready(scene, count, *precision)?;
    let map = sweep(&ready, stop)?;
    let field =
        fields::all().find(|field| request.show.as_deref() == Some(field.column.entry().name));
    let picture = || -> Result<Picture, Refused> {
        let map = whole(&map)?;
        Ok(match field {
            Some(field) => field::draw(&map, field, "", Print::default())?,
            None => main::draw(&map, "", Print::default())?,
        })
    };
    let mut file = Cursor::new(Vec::new());
    match request.kind {
        Kind::Png => {
            let picture = picture()?;
            if let Some(problem) = letters::missing([&picture]) {
                return Err(Refused::told(format!("{problem}; or save the SVG")));
            }
            return Ok((picture.png()?, "image/png"));
        }
        Kind::Svg => return Ok((picture()?.svg().into_bytes(), "image/svg+xml")),
        Kind::Npz => npz::write(&map.grid, &*map.outcomes, map.source(), &mut file)?,
        _ => csv::write(&map.grid, &*map.outcomes, map.method.columns, &mut file)
            .map_err(Refused::told)?,
    }
    let kind = if request.kind == Kind::Npz { "application/octet-stream" } else { "text/csv" };
    Ok((file.into_inner(), kind))
}
