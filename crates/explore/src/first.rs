//! The numbers that the page gives where a change of the scene leaves one missing, and what scenes have by default.

use serde_json::{Map, Value, json};
use topple::model::pulse::Shape;
use topple::scene::{GRAVITY, Parameter, SceneBuilder, SceneError};

use Parameter::{AH, Eccentricity, K1, K2, Mu, Omega, Qd, Radius, Scale, TH, TV, UY};

/// A bearing that is proposed: its period after it yields, s; its stiffness before, over that after; its strength, over the
/// weight.
const BEARING: [(&str, f64); 3] = [("period", 2.0), ("stiffer", 10.0), ("strength", 0.05)];

/// What a scene has by default with a base of the paper, read off one that was completed.
///
/// # Errors
/// None: the scene is a valid one.
pub fn defaults() -> Result<Map<String, Value>, SceneError> {
    of_base(&[(TH, 1.0)])
}

/// What a scene has by default with a horizontal base of these numbers.
fn of_base(base: &[(Parameter, f64)]) -> Result<Map<String, Value>, SceneError> {
    let given = [base, &[(TV, 1.0), (Omega, 1.0), (AH, 1.0)]].concat();
    let scene = SceneBuilder::object(1).pulse(Shape::MavroeidisPapageorgiou);
    let scene = given.iter().fold(scene, |scene, (of, value)| scene.with(*of, *value)).check()?;
    let own = scene.numbers.iter().filter(|(of, _)| given.iter().all(|(known, _)| known != of));
    Ok(own.map(|(of, values)| (of.key().to_string(), json!(values.first()))).collect())
}

/// What a base has by default that a base of the paper has not, or has otherwise.
fn apart(base: &[(Parameter, f64)]) -> Map<String, Value> {
    let (Ok(own), Ok(paper)) = (of_base(base), defaults()) else { return Map::new() };
    own.into_iter().filter(|(key, value)| paper.get(key) != Some(value)).collect()
}

/// The numbers that a change gives, as texts of fields.
pub fn first() -> Value {
    let texts = |numbers: &[(Parameter, &str)]| -> Map<String, Value> {
        numbers.iter().map(|(of, text)| (of.key().to_string(), json!(text))).collect()
    };
    let periods = [TH, TV, Eccentricity, Scale].map(Parameter::key);
    let of_pulse = [Omega, AH].map(Parameter::key);
    let bearing: Map<_, _> =
        BEARING.iter().map(|(key, value)| (key.to_string(), json!(value))).collect();
    json!({
        // What a moving base must have.
        "needed": texts(&[(TH, "1.75"), (TV, "0.75")]),
        // Under a suite a base stays the same whatever shakes it: it yields at a displacement.
        "yield": { "key": UY.key(), "text": "0.02" },
        // Axes to fall back on, by what shakes the base.
        "axes": { "pulse": of_pulse, "record": periods, "suite": periods },
        "pendulum": texts(&[(Radius, "1.5"), (Mu, "0.06")]),
        "bearing": bearing,
        "gravity": GRAVITY,
        "defaults": {
            "spring": {},
            "pendulum": apart(&[(Radius, 1.5), (Mu, 0.06)]),
            "bearing": apart(&[(K1, 1e4), (K2, 1e3), (Qd, 100.0)]),
        },
    })
}
