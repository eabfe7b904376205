//! Cells along a line across a map: the paper's paths.

use std::sync::atomic::AtomicBool;

use serde::Deserialize;
use serde_json::{Value, json};

use super::asked::{AskedPrecision, Flat};
use super::refused::Refused;
use super::session::Session;
use super::stages::at_most;
use super::view::{kind, marks};
use topple::scene::{Parameter, Scene, Values};
use topple::sweep::points::sweep_points;
use topple_pictures::colours::palette::Kind;

/// A request for the cells along a line.
#[derive(Debug, Clone, Deserialize)]
pub struct SectionRequest {
    /// The scene, its axes those of the view.
    pub scene: Flat,
    /// Where the line begins: a value of each axis.
    pub from: [f64; 2],
    /// Where it ends.
    pub to: [f64; 2],
    /// Cells along it.
    pub count: u32,
    /// Number type.
    #[serde(default)]
    pub precision: AskedPrecision,
}

/// Cells at most.
const MOST: u32 = 4096;

/// The value a share of the way along an axis: evenly in the logarithm where the axis is so.
fn between(values: &Values, from: f64, to: f64, share: f64) -> f64 {
    match values {
        // Of both ends, so that a line along the other axis has one value here.
        _ if from == to => from,
        Values::Range(range) if range.log => from * (to / from).powf(share),
        _ => from * (1.0 - share) + to * share,
    }
}

/// Runs the cells along a line.
pub fn run(
    session: &Session,
    request: &SectionRequest,
    stop: &AtomicBool,
) -> Result<Value, Refused> {
    let SectionRequest { scene, from, to, precision, .. } = request;
    let count = request.count.clamp(2, MOST);
    let ready = session.ready(scene, at_most(scene, [count, count], count)?, *precision)?;
    let (x, y) = (ready.grid.x(), ready.grid.y());
    let Some(y) = y else { return Err(Refused::of("y", "missing; give a number's key")) };
    for (key, from, to, axis) in [("x", from[0], to[0], x), ("y", from[1], to[1], y)] {
        let log = matches!(&axis.values, Values::Range(range) if range.log);
        if !(from.is_finite() && to.is_finite()) || (log && !(from * to > 0.0)) {
            let problem = format!("no line goes from {from} to {to}; give two values of the axis");
            return Err(Refused::of(key, problem));
        }
    }
    let shares = (0..count).map(|k| f64::from(k) / f64::from(count - 1));
    let points: Vec<[f64; 2]> = shares
        .map(|share| {
            [between(&x.values, from[0], to[0], share), between(&y.values, from[1], to[1], share)]
        })
        .collect();
    let method = ready.settings.method;
    let plan = |scene: &Scene| {
        scene.check()?;
        Ok(method.plan(scene)?)
    };
    let on = (&ready.opened.backends[..], method.precision);
    let parameters = [x.parameter, y.parameter];
    // Along one axis the other one has a single value, and is none.
    let scene = Scene { x: None, y: None, ..ready.scene.clone() };
    let outcomes = sweep_points(&scene, parameters, &points, plan, on, stop)?;
    let friction = |point: &[f64; 2]| match Parameter::Friction {
        own if own == parameters[0] => Some(point[0]),
        own if own == parameters[1] => Some(point[1]),
        own => ready.grid.value(own, 0),
    };
    let kinds = Kind::all();
    let told = outcomes.iter().zip(&points);
    let marks: Vec<u8> =
        told.map(|(cell, at)| marks(cell, cell.is_beyond_the_model(friction(at)))).collect();
    let cells = &outcomes;
    Ok(json!({
        "shape": [count],
        "precision": method.precision,
        "x": points.iter().map(|point| point[0]).collect::<Vec<f64>>(),
        "y": points.iter().map(|point| point[1]).collect::<Vec<f64>>(),
        "kind": cells.iter().map(|cell| kind(cell, &kinds)).collect::<Vec<u8>>(),
        "marks": marks,
        "impacts": cells.iter().map(|cell| cell.impacts).collect::<Vec<u32>>(),
        "zeta": cells.iter().map(|cell| cell.zeta).collect::<Vec<f64>>(),
        "outcome": cells.iter().map(|cell| cell.class as u8).collect::<Vec<u8>>(),
    }))
}
