//! map.npz: the columns of map.csv as arrays with an index for each axis, the last one fastest: (y, x) for
//! two; with the axes, and with what they are in `about`.

use std::fs::File;
use std::io::{self, BufReader, Seek, Write};
use std::path::Path;

use zip::write::SimpleFileOptions;
use zip::{ZipArchive, ZipWriter};

use super::about::Source;
use super::arrays::{self, ABOUT, ArrayFile, Element, Fill};
use super::listed::FileCells;
use super::npy;
use super::outcomes::Outcomes;
use super::values::bytes_of;
use crate::scene::bounded;
use crate::scene::record::zips;

/// Level of compression: of more, files are hardly smaller and take several times as long.
const LEVEL: i64 = 2;

/// Writes the archive, column by column, never a whole one in memory. Names are codes there, which `about`
/// tells with units, meanings, scene and version, as JSON. `proved`, which goes with the status, is true for
/// cells whose impacts are counted up to `t_simulated`. A list has arrays of one index, the numbers of its cells (`cell`) and
/// their counts among them.
///
/// # Errors
/// Those of the writer, and of reading the outcomes.
pub fn write<'a>(
    cells: impl Into<FileCells<'a>>,
    outcomes: &dyn Outcomes,
    source: Source,
    writer: impl Write + Seek,
) -> io::Result<()> {
    let mut archive = Archive(ZipWriter::new(writer));
    arrays::write(cells.into(), outcomes, source, &mut archive)?;
    archive.0.finish()?;
    Ok(())
}

/// What an archive says of itself: JSON.
///
/// # Errors
/// Those of reading; an archive without `about`.
pub fn about(path: &Path) -> io::Result<String> {
    let file = File::open(path)?;
    zips::check(&file)?;
    let mut archive = ZipArchive::new(BufReader::new(file))?;
    let bytes = bounded::all(archive.by_name(&format!("{ABOUT}.npy"))?, bounded::DOCUMENT)?;
    npy::text(&bytes).map_err(|error| io::Error::other(format!("its `{ABOUT}` is {error}")))
}

/// An archive while it is written.
struct Archive<W: Write + Seek>(ZipWriter<W>);

impl<W: Write + Seek> Archive<W> {
    /// Begins an array of a type by its name in numpy: its bytes are to follow.
    fn begin(&mut self, name: &str, of: &str, shape: &[u64], bytes: u64) -> io::Result<()> {
        // Beyond 4 GiB with its head the archive needs longer numbers.
        let large = bytes >= u64::from(u32::MAX) - (1 << 10);
        let options = SimpleFileOptions::default()
            .compression_method(zip::CompressionMethod::Deflated)
            .compression_level(Some(LEVEL))
            .large_file(large);
        self.0.start_file(format!("{name}.npy"), options)?;
        self.0.write_all(&npy::header(of, shape))
    }
}

impl<W: Write + Seek> ArrayFile for Archive<W> {
    fn array(&mut self, name: &str, of: Element, shape: &[u64], write: Fill) -> io::Result<()> {
        let numpy = match of {
            Element::Bool => "|b1",
            Element::Value(of) => of.in_numpy(),
            Element::Cell => "<u8",
        };
        self.begin(name, numpy, shape, shape.iter().product::<u64>() * of.size() as u64)?;
        write(&mut self.0)
    }

    /// As an array of no index.
    fn text(&mut self, name: &str, text: &str) -> io::Result<()> {
        let letters: Vec<u32> = text.chars().map(u32::from).collect();
        let bytes = bytes_of(&letters, u32::to_le_bytes);
        self.begin(name, &format!("<U{}", letters.len()), &[], bytes.len() as u64)?;
        self.0.write_all(&bytes)
    }
}
