//! Arrays on their way to the page: a header in JSON, then the numbers.

use serde_json::{Value, json};

use topple::model::precision::Precision;
use topple::results::columns::ColumnKind;
use topple::results::values::{ColumnValues, ValueType};

/// Number type of the arrays: pictures need no more digits.
pub const PRECISION: Precision = Precision::F32;

/// A type of arrays, as a header names it.
fn name(of: ValueType) -> &'static str {
    match of {
        ValueType::U8 => "u8",
        ValueType::U32 => "u32",
        ValueType::F32 => "f32",
        ValueType::F64 => "f64",
    }
}

/// The type of a column's array.
pub fn type_of(kind: ColumnKind) -> &'static str {
    name(ValueType::of(kind, PRECISION))
}

/// Numbers begin at multiples of a given number of bytes, as typed arrays of a page want it.
const ALIGNED: usize = 8;
/// Bytes of the length of a header.
const LENGTH: usize = 4;

/// A frame: the length of its header (four bytes, the lowest first), the header with the names, types and lengths of
/// the arrays, and these. Header and arrays are filled up to multiples of 8 bytes.
pub fn frame(mut header: Value, arrays: &[(&str, ColumnValues)]) -> Vec<u8> {
    let told = arrays
        .iter()
        .map(|(of, array)| json!({ "name": of, "type": name(array.value_type()), "length": array.len() }));
    header["arrays"] = Value::Array(told.collect());
    let mut text = header.to_string().into_bytes();
    text.resize((LENGTH + text.len()).next_multiple_of(ALIGNED) - LENGTH, b' ');
    // A header has some hundred bytes.
    let mut bytes = (text.len() as u32).to_le_bytes().to_vec();
    bytes.append(&mut text);
    for (_, array) in arrays {
        bytes.extend(array.to_bytes());
        bytes.resize(bytes.len().next_multiple_of(ALIGNED), 0);
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::{ColumnValues, frame};
    use serde_json::{Value, json};

    #[test]
    fn arrays_lie_where_their_header_says() {
        let arrays = [
            ("kind", ColumnValues::Codes(vec![7; 3])),
            ("zeta", ColumnValues::Singles(vec![0.5, -1.0])),
        ];
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
