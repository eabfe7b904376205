use serde_json::json;

use topple_explore::body::read;
use topple_explore::stage::ViewRequest;

#[test]
fn a_value_of_another_type_is_told_by_its_key() {
    let good = json!({ "scene": { "t_h": "1" }, "count": [9, 9] });
    assert!(read::<ViewRequest>(good.to_string().as_bytes()).is_ok());
    for (key, value, line) in [
        ("scene", json!(1), "scene: invalid type: integer 1; give an object"),
        ("scene", json!({ "t_h": 1.5 }), "t_h: invalid type: floating point 1.5; give a text"),
        ("count", json!([9]), "count: invalid length 1; give an array of length 2"),
        (
            "count",
            json!([-1, 9]),
            "count: invalid value: integer -1; give a whole number, 0 or more",
        ),
        ("precision", json!("f16"), "precision: unknown variant f16; give one of auto, f32, f64"),
        ("precision", json!(null), "precision: invalid type: null; give one of its words"),
    ] {
        let mut wrong = good.clone();
        wrong[key] = value;
        let told = read::<ViewRequest>(wrong.to_string().as_bytes()).unwrap_err();
        assert!(told.line.starts_with(line), "{told}");
    }
    for (body, line) in [
        ("", "the request cannot be read: "),
        ("[]", "the request is no object of JSON"),
        (r#"{"count": [9, 9]}"#, "scene: missing; give it"),
        (
            r#"{"scene": {}, "count": [9, 9], "limits": {"u": 1}}"#,
            "u: invalid type: integer 1; give a text",
        ),
    ] {
        let told = read::<ViewRequest>(body.as_bytes()).unwrap_err();
        assert!(told.line.starts_with(line), "{told}");
    }
}
