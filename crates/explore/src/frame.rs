//! Arrays on their way to the page: a header in JSON, then the numbers.

use serde_json::{Value, json};

use topple::results::columns::ColumnKind;

/// The types of arrays, as a header names them.
const BYTES: &str = "u8";
const COUNTS: &str = "u32";
const SINGLES: &str = "f32";

/// The numbers of an array.
pub enum Array {
    /// Codes and marks.
    Bytes(Vec<u8>),
    /// Numbers of events.
    Counts(Vec<u32>),
    /// Numbers of cells: pictures need no more digits.
    Singles(Vec<f32>),
}

impl Array {
    fn kind(&self) -> &'static str {
        match self {
            Array::Bytes(_) => BYTES,
            Array::Counts(_) => COUNTS,
            Array::Singles(_) => SINGLES,
        }
    }

    fn len(&self) -> usize {
        match self {
            Array::Bytes(bytes) => bytes.len(),
            Array::Counts(counts) => counts.len(),
            Array::Singles(numbers) => numbers.len(),
        }
    }

    /// Adds it to a frame, the lowest byte of a number first.
    fn write(&self, to: &mut Vec<u8>) {
        match self {
            Array::Bytes(bytes) => to.extend(bytes),
            Array::Counts(counts) => to.extend(counts.iter().flat_map(|count| count.to_le_bytes())),
            Array::Singles(numbers) => {
                to.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
            }
        }
    }
}

/// The type of a column's array.
pub fn type_of(kind: ColumnKind) -> &'static str {
    match kind {
        ColumnKind::Class | ColumnKind::Status => BYTES,
        ColumnKind::Count => COUNTS,
        ColumnKind::Number | ColumnKind::Time => SINGLES,
    }
}

/// Numbers begin at multiples of a given number of bytes, as typed arrays of a page want it.
const ALIGNED: usize = 8;
/// Bytes of the length of a header.
const LENGTH: usize = 4;

/// A frame: the length of its header (four bytes, the lowest first), the header with the names, types and lengths of
/// the arrays, and these. Header and arrays are filled up to multiples of 8 bytes.
pub fn frame(mut header: Value, arrays: &[(&str, Array)]) -> Vec<u8> {
    let told = arrays
        .iter()
        .map(|(name, array)| json!({ "name": name, "type": array.kind(), "length": array.len() }));
    header["arrays"] = Value::Array(told.collect());
    let mut text = header.to_string().into_bytes();
    text.resize((LENGTH + text.len()).next_multiple_of(ALIGNED) - LENGTH, b' ');
    // A header has some hundred bytes.
    let mut bytes = (text.len() as u32).to_le_bytes().to_vec();
    bytes.append(&mut text);
    for (_, array) in arrays {
        array.write(&mut bytes);
        bytes.resize(bytes.len().next_multiple_of(ALIGNED), 0);
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::{Array, frame};
    use serde_json::{Value, json};

    #[test]
    fn arrays_lie_where_their_header_says() {
        let arrays =
            [("kind", Array::Bytes(vec![7; 3])), ("zeta", Array::Singles(vec![0.5, -1.0]))];
        let bytes = frame(json!({ "stage": "fine" }), &arrays);
        let length = u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize;
        let header: Value = serde_json::from_slice(&bytes[4..4 + length]).unwrap();
        assert_eq!(header["stage"], "fine");
        assert_eq!(header["arrays"][1], json!({ "name": "zeta", "type": "f32", "length": 2 }));
        let first = 4 + length;
        assert_eq!((first % 8, bytes.len()), (0, first + 8 + 8));
        assert_eq!(bytes[first..first + 4], [7, 7, 7, 0]);
        assert_eq!(f32::from_le_bytes(bytes[first + 12..].try_into().unwrap()), -1.0);
    }
}
