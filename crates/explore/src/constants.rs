//! What the exported page's engine knows of the model: constants, the parameter table, the blocks of Table 1. Its modules
//! read it from model.json, so that no number is written in them a second time.

use serde_json::{Map, Value, json};

use super::asked::SYNTHETIC;
use super::first;
use super::frame::type_of;
use topple::Written;
use topple::backend::gpu::pace::DISPATCH_TURNS;
use topple::backend::gpu::pipelines::WORKGROUP;
use topple::cells::clock;
use topple::cells::groups::FLIGHTS_A_STEP;
use topple::cells::plan::RIGID_SHARE;
use topple::model::block::Model;
use topple::model::excitation::Cell;
use topple::model::polynomials::SINE_F64;
use topple::model::pulse::{ANTISYMMETRIC_PEAK, Shape};
use topple::results::column_set::ColumnSet;
use topple::results::columns::STATUS_NAMES;
use topple::scene::block::OBJECTS;
use topple::scene::device::{LEAST_PERIOD, Pressure, SLIDER_YIELD};
use topple::scene::record::Pair;
use topple::scene::{Directions, GRAVITY, Overturn, SceneError, description};
use topple::stepping::outcome::Class;
use topple::stepping::state::{
    EVENT_LIMIT, FINISHED, OVERTURNED_LEFT, OVERTURNED_RIGHT, PROVED, RUNNING, State,
};
use topple_pictures::colours::palette::{Kind, OPEN};

/// What the engine knows; `record` is that of the exported scene, where it has one, with its name there.
///
/// # Errors
/// None: a scene from whose completion the defaults are read is a valid one.
pub fn constants(record: Option<(&str, &Pair)>) -> Result<Value, SceneError> {
    Ok(json!({
        "version": env!("CARGO_PKG_VERSION"),
        "gravity": GRAVITY,
        "least_period": LEAST_PERIOD,
        "rigid_share": RIGID_SHARE,
        "slider_yield": SLIDER_YIELD,
        "sine": SINE_F64,
        "antisymmetric_peak": ANTISYMMETRIC_PEAK,
        "objects": objects(),
        "parameters": description::parameters(),
        "alternatives": description::alternatives(),
        "defaults": first::defaults()?,
        "words": {
            "isolation": Directions::ALL,
            "pressure": Pressure::ALL,
            "overturn": Overturn::ALL,
            "shape": Shape::ALL,
        },
        "shapes": Shape::ALL.iter().copied().map(shape).collect::<Vec<Value>>(),
        "steps": {
            "largest_step": clock::DEFAULT_STEP,
            "steps_a_period": clock::STEPS_A_PERIOD,
            "finest": clock::FINEST_STEPS_A_PERIOD[0],
            "most": clock::FINEST_STEPS_A_PERIOD[1],
            "short_period": clock::SHORT_PERIOD,
            "stiff_period": clock::STIFF_PERIOD,
            "steps_a_pulse": clock::STEPS_A_PULSE,
            "flights_a_step": FLIGHTS_A_STEP,
            "step_at_stop": clock::STEP_AT_STOP,
        },
        "kinds": kinds(),
        "codes": { "outcome": Class::ALL.map(Class::name), "status": STATUS_NAMES },
        "columns": columns(),
        "status": {
            "running": RUNNING,
            "finished": FINISHED,
            "overturned_left": OVERTURNED_LEFT,
            "overturned_right": OVERTURNED_RIGHT,
            "event_limit": EVENT_LIMIT,
            "proved": PROVED,
        },
        "words_of": {
            "cell": size_of::<Cell<f32>>() / 4,
            "state": size_of::<State<f32>>() / 4,
            "model": size_of::<Model<f32>>() / 4,
        },
        "workgroup": WORKGROUP,
        "dispatch_turns": DISPATCH_TURNS,
        "record": record.map(samples),
    }))
}

/// The blocks of Table 1 by the keys of their numbers.
fn objects() -> Value {
    let of = |object: &topple::scene::block::Object| {
        let mut numbers = Map::new();
        for (parameter, value) in object.numbers() {
            numbers.insert(parameter.key().into(), json!(value));
        }
        Value::Object(numbers)
    };
    OBJECTS.iter().map(of).collect()
}

fn shape(shape: Shape) -> Value {
    json!({
        "name": shape,
        "code": shape as u8,
        "words": shape.words(),
        "has_cycles": shape.has_cycles(),
        "is_modulated": shape.is_modulated(),
        // Of those that neither cycles nor gamma make.
        "periods": shape.periods(1.0, 1.0),
    })
}

/// The places of kinds in the list of all.
fn kinds() -> Value {
    let all = Kind::all();
    let place = |kind: Kind| all.iter().position(|known| *known == kind);
    json!({
        "full_contact": place(Kind::FullContact),
        "rocking": place(Kind::Rocking),
        "overturned_left": place(Kind::DirectLeft),
        "overturned_right": place(Kind::DirectRight),
        "impacts": place(Kind::Impacts(1)),
        "more": place(Kind::More),
        "unresolved": place(Kind::Unresolved),
        "counted": OPEN,
    })
}

/// The types of columns in f32, by their names.
fn columns() -> Value {
    let told = ColumnSet::ALL.entries();
    told.map(|entry| (entry.name.to_string(), json!(type_of(entry.kind)))).collect()
}

/// A record: both components of each sample.
fn samples((id, pair): (&str, &Pair)) -> Value {
    let both = pair.horizontal.iter().zip(pair.vertical.iter());
    json!({
        "id": id,
        "synthetic": id == SYNTHETIC,
        "dt": pair.dt,
        "length": pair.len(),
        "duration": pair.duration(),
        "factor": pair.factor,
        "pga_h": pair.pga_h,
        "samples": both.flat_map(|(h, v)| [*h, *v]).collect::<Vec<f64>>(),
    })
}
