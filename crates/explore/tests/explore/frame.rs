use serde_json::{Value, json};
use topple::results::values::ColumnValues;
use topple_explore::frame::frame;

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
