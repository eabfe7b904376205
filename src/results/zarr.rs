//! A map, or a list of cells, as a Zarr group (version 3): one array a column and one an axis, which xarray and dask
//! open by themselves. Here are its documents; [`chunk`](super::chunk) has the cells' values.
//!
//! Written after the specification, <https://zarr-specs.readthedocs.io/en/latest/v3/core/index.html>, with
//! its codecs `bytes`, `gzip` and `crc32c`. docs/columns.md says why no library writes them.

use serde_json::{Map, Value, json};

use super::about::Source;
use super::chunking::Chunking;
use super::column_set::ColumnSet;
use super::columns::{Column, ColumnKind, Entry, STATUS_NAMES};
use super::listed::{CELL, CELL_MEANING, FileCells};
use super::values::ValueType;
use crate::model::precision::Precision;
use crate::scene::Grid;
use crate::scene::grid::Axis;
use crate::stepping::outcome::Class;

/// Name of a group's or an array's document.
pub const DOCUMENT: &str = "zarr.json";
/// Folder of the chunks of an array.
pub const CHUNKS: &str = "c";
/// Name of the array that is true for cells that ended early, their results proved final.
pub const PROVED: &str = "proved";
/// Level of compression: of more, files are hardly smaller and take several times as long.
pub const LEVEL: u32 = 1;

/// Values of a type, their number along each axis, and how many of them a chunk has.
struct Array<'a> {
    data_type: &'a str,
    fill: Value,
    shape: &'a [usize],
    chunk: &'a [usize],
    index: &'a [&'a str],
}

impl Array<'_> {
    fn document(&self, attributes: Value) -> Value {
        json!({
            "zarr_format": 3,
            "node_type": "array",
            "shape": self.shape,
            "data_type": self.data_type,
            "chunk_grid": {
                "name": "regular",
                "configuration": { "chunk_shape": self.chunk },
            },
            "chunk_key_encoding": { "name": "default", "configuration": { "separator": "/" } },
            "fill_value": self.fill,
            "codecs": [
                { "name": "bytes", "configuration": { "endian": "little" } },
                { "name": "gzip", "configuration": { "level": LEVEL } },
                { "name": "crc32c" },
            ],
            "attributes": attributes,
            "dimension_names": self.index,
        })
    }
}

/// The description of a column, in the words of the CF conventions.
fn attributes(entry: &Entry) -> Value {
    let mut attributes = Map::new();
    attributes.insert("long_name".into(), json!(entry.meaning));
    if !entry.unit.is_empty() {
        attributes.insert("units".into(), json!(entry.unit));
    }
    let codes = match entry.kind {
        ColumnKind::Class => Class::ALL.map(Class::name).to_vec(),
        ColumnKind::Status => STATUS_NAMES.to_vec(),
        _ => return Value::Object(attributes),
    };
    attributes.insert("flag_values".into(), json!((0..codes.len()).collect::<Vec<_>>()));
    attributes.insert("flag_meanings".into(), json!(codes.join(" ")));
    Value::Object(attributes)
}

/// Data type and fill value of a column of a kind: what a cell has that has not run.
fn data_type(kind: ColumnKind, precision: Precision) -> (&'static str, Value) {
    let filler = match kind.filler() {
        unknown if unknown.is_nan() => json!("NaN"),
        code => json!(code as u8),
    };
    (ValueType::of(kind, precision).in_zarr(), filler)
}

/// The documents of arrays, by their names.
type Documents = Vec<(String, Value)>;

/// How the arrays of cells lie: in which chunks, and over which indices.
struct Layout<'a> {
    chunking: Chunking,
    index: &'a [&'a str],
}

impl Layout<'_> {
    /// The document of an array with a value a cell.
    fn array(&self, (data_type, fill): (&str, Value), attributes: Value) -> Value {
        let (shape, chunk) = (self.chunking.shape(), &self.chunking.chunk_shape()[..]);
        Array { data_type, fill, shape, chunk, index: self.index }.document(attributes)
    }

    /// Those of the columns that are held.
    fn columns(&self, source: &Source) -> Documents {
        let of = |entry: &Entry| {
            let array = self.array(data_type(entry.kind, source.precision), attributes(entry));
            (entry.name.to_string(), array)
        };
        let mut arrays: Documents = source.columns.entries().map(of).collect();
        let meaning = "ended early, because energy proved all that it tells final: impacts and uplifts are counted \
                       up to t_simulated";
        let proved = self.array(("bool", json!(false)), json!({ "long_name": meaning }));
        arrays.push((PROVED.to_string(), proved));
        arrays
    }
}

/// The documents of a grid's axes.
fn axes(grid: &Grid) -> Documents {
    let of = |axis: &Axis| {
        let (entry, count) = (axis.entry(), [axis.count()]);
        let (data_type, fill) = ("float64", json!("NaN"));
        let array = Array { data_type, fill, shape: &count, chunk: &count, index: &[entry.key] };
        let attributes = json!({ "long_name": entry.meaning, "units": entry.unit });
        (entry.key.to_string(), array.document(attributes))
    };
    grid.axes().iter().map(of).collect()
}

/// The documents of a map, or of a list, each with its path: the arrays', and last the group's, which holds them all. A list has
/// the numbers of its cells and their counts beside the axes.
pub fn documents<'a>(cells: impl Into<FileCells<'a>>, source: &Source) -> Documents {
    let cells: FileCells = cells.into();
    let layout = Layout { chunking: cells.chunking(), index: &cells.index() };
    let source = Source { columns: source.columns.held(), ..*source };
    let mut arrays = layout.columns(&source);
    let whole =
        |data_type, meaning| layout.array((data_type, json!(0)), json!({ "long_name": meaning }));
    if cells.list.is_some() {
        arrays.push((CELL.to_string(), whole("uint64", CELL_MEANING)));
    }
    let counts = cells.counts().iter();
    arrays.extend(counts.map(|count| (count.name.to_string(), whole("uint32", count.meaning))));
    arrays.extend(axes(cells.grid));
    group(arrays, cells.about(source))
}

/// Attributes that other formats can store, such as NetCDF: what is nested is a text in JSON.
fn flat(about: Map<String, Value>) -> Map<String, Value> {
    let one = |value: Value| match value {
        Value::Object(_) | Value::Array(_) => Value::String(value.to_string()),
        plain => plain,
    };
    about.into_iter().map(|(key, value)| (key, one(value))).collect()
}

/// The attributes of a group as they were before they were stored: the texts of objects and arrays are these again.
pub fn nested(attributes: Map<String, Value>) -> Map<String, Value> {
    let one = |value: Value| match value {
        Value::String(text) if text.starts_with(['{', '[']) => {
            // Any other text that begins so, such as a title, is no JSON.
            serde_json::from_str(&text).unwrap_or(Value::String(text))
        }
        plain => plain,
    };
    attributes.into_iter().map(|(key, value)| (key, one(value))).collect()
}

/// The documents of a group of arrays, each with its path: the arrays', and last its own.
fn group(arrays: Documents, about: Map<String, Value>) -> Documents {
    let consolidated: Map<String, Value> = arrays.iter().cloned().collect();
    let group = json!({
        "zarr_format": 3,
        "node_type": "group",
        "attributes": flat(about),
        "consolidated_metadata": {
            "kind": "inline",
            "must_understand": false,
            "metadata": consolidated,
        },
    });
    let paths = arrays.into_iter().map(|(name, array)| (format!("{name}/{DOCUMENT}"), array));
    paths.chain([(DOCUMENT.to_string(), group)]).collect()
}

/// The values of an axis as bytes, and the path of the only file that they are in.
pub fn axis_chunk(axis: &Axis) -> (String, Vec<u8>) {
    let bytes = axis.values.iter().flat_map(f64::to_le_bytes).collect();
    (format!("{}/{CHUNKS}/0", axis.key()), bytes)
}

/// The path of a chunk's file in an array.
pub fn chunk_path(array: &str, chunking: &Chunking, chunk: usize) -> String {
    format!("{array}/{CHUNKS}/{}", chunking.key(chunk))
}

/// The names of the arrays that hold requested columns, each with its column; the status comes last, so that
/// what it says has run is there.
pub fn columns(asked: ColumnSet) -> impl Iterator<Item = (&'static str, Column)> {
    let others = asked.held().entries().filter(|entry| entry.column != Column::Status);
    let others = others.map(|entry| (entry.name, entry.column));
    others.chain([(PROVED, Column::Status), (Column::Status.entry().name, Column::Status)])
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::{flat, nested};

    #[test]
    fn attributes_are_texts_and_numbers_and_come_back() {
        let Value::Object(about) = json!({
            "scene": { "title": "{no JSON", "numbers": { "t_h": 2.5 } },
            "index": ["t_h", "omega"],
            "version": "0.1.0",
            "other": "{no JSON",
            "count": 3,
        }) else {
            panic!("an object")
        };
        let stored = flat(about.clone());
        assert!(stored.values().all(|value| value.is_string() || value.is_number()), "{stored:?}");
        assert_eq!(nested(stored), about);
    }
}
