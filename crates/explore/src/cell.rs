//! A cell of a map: its numbers, and its motion.

use std::f64::consts::TAU;
use std::sync::atomic::{AtomicBool, Ordering};

use serde::Deserialize;
use serde_json::{Map as Object, Value, json};

use super::asked::{self, AskedPrecision, Flat};
use super::command;
use super::refused::Refused;
use super::session::Session;
use super::view::kind;
use topple::backend::history::{Row, by_steps_while};
use topple::model::precision::Precision;
use topple::results::column_set::ColumnSet;
use topple::results::columns::Shown;
use topple::scene::isolation::KelvinVoigt;
use topple::scene::{Case, Pressure};
use topple::stepping::outcome::Outcome;
use topple::sweep::motion_of_cell::{self as motion, What};
use topple_pictures::colours::palette::Kind;

/// A request for a cell.
#[derive(Debug, Clone, Deserialize)]
pub struct CellRequest {
    /// The scene, all of its numbers single.
    pub scene: Flat,
    /// Number type.
    #[serde(default)]
    pub precision: AskedPrecision,
    /// The motion is wanted, too.
    #[serde(default)]
    pub motion: bool,
}

/// Steps of a motion at most: more than a page can hold well.
const MOST: usize = 200_000;

/// The places of modes in the page's list.
fn mode(name: &str) -> u8 {
    match name {
        "rocking_left" => 1,
        "rocking_right" => 2,
        _ => 0,
    }
}

/// Runs a cell: its columns and, where it is wanted, its motion.
///
/// # Errors
/// The first key at fault; the key `t_max` of a motion of too many steps.
pub fn run(session: &Session, request: &CellRequest, stop: &AtomicBool) -> Result<Value, Refused> {
    let given = asked::builder(&request.scene, None)?;
    let scene = session.records.check(&given)?;
    let precision = match request.precision {
        AskedPrecision::F64 => Precision::F64,
        _ => Precision::F32,
    };
    let mut plan = session.settings(precision).method.plan(&scene)?;
    // A motion is told to its end, proved or not.
    plan.shortcuts.certificate = false;
    let case = scene.case();
    let go_on = |rows: usize| rows <= MOST && !stop.load(Ordering::Relaxed);
    let (rows, outcome) = by_steps_while(precision, &plan.at(precision), &case, &go_on);
    if rows.len() > MOST {
        let problem =
            format!("the motion has more than {MOST} steps; shorten it, or use the command");
        return Err(Refused::of("t_max", problem));
    }
    let block = &case.block;
    let mut told = json!({
        "columns": columns(&outcome),
        "kind": kind(&outcome, &Kind::all()),
        "words": motion::told(&outcome),
        "block": {
            "half_width": block.half_width,
            "height": block.height,
            "eccentricity": block.eccentricity,
        },
        "base": base(&case),
        "critical": [case.overturning_angle(1.0), case.overturning_angle(-1.0)],
        "deflection": case.isolation.vertical.as_ref().map_or(0.0, KelvinVoigt::deflection),
        "t_max": case.t_max,
        "command": command::history(session, &given, precision),
    });
    if request.motion {
        let end = rows.last().map_or(0.0, |row| row.t);
        told["motion"] = coordinates(&rows);
        let [horizontal, vertical] = motion::ground(&scene, &case, &rows, end);
        let of = |points: &[motion::Point], one: fn(&motion::Point) -> f64| -> Vec<f64> {
            points.iter().map(one).collect()
        };
        told["ground"] = json!({
            "t": of(&horizontal, |point| point.0),
            "a_h": of(&horizontal, |point| point.1),
            "a_v": of(&vertical, |point| point.1),
        });
        told["events"] = events(&rows, &outcome);
    }
    Ok(told)
}

/// The base of a cell, by which its device's force is drawn: what it carries, its laws over that mass, its end stop.
fn base(case: &Case) -> Value {
    let isolation = &case.isolation;
    let mass = case.block.mass + isolation.plate_h + isolation.plate_v;
    let horizontal = isolation.horizontal.as_ref();
    let vertical = isolation.vertical.as_ref();
    json!({
        "mass": mass,
        "plate": isolation.plate_h / mass,
        "horizontal": horizontal.map(|law| json!({
            "omega": TAU / law.t_h,
            "psi": law.psi,
            "xi": law.xi_h,
            "u_y": law.u_y,
            "follows": law.pressure == Some(Pressure::Follows),
        })),
        "stop": isolation.stop.map(|stop| json!({
            "gap": stop.gap, "stiffness": stop.stiffness, "damping": stop.damping,
        })),
        "vertical": vertical.map(|law| json!({
            "omega": TAU / law.t_v, "xi": law.xi_v, "hardening": law.hardening,
        })),
    })
}

/// The columns of a cell by their names.
fn columns(outcome: &Outcome) -> Object<String, Value> {
    let value = |shown: Shown| match shown {
        Shown::Code(_, name) => json!(name),
        Shown::Count(count) => json!(count),
        // A number that is none becomes null.
        Shown::Number(_) | Shown::Time(_) => json!(shown.number()),
    };
    ColumnSet::ALL
        .entries()
        .map(|entry| (entry.name.to_string(), value(entry.shown(outcome))))
        .collect()
}

/// The coordinates of a motion, an array each.
fn coordinates(rows: &[Row]) -> Value {
    let of = |one: fn(&Row) -> f64| -> Vec<f64> { rows.iter().map(one).collect() };
    json!({
        "t": of(|row| row.t),
        "u": of(|row| row.u),
        "du": of(|row| row.du),
        "v": of(|row| row.v),
        "dv": of(|row| row.dv),
        "z": of(|row| row.z),
        "phi": of(|row| row.phi),
        "dphi": of(|row| row.dphi),
        "mode": rows.iter().map(|row| mode(row.mode)).collect::<Vec<u8>>(),
    })
}

/// Uplifts, impacts, rests, and the overturning.
fn events(rows: &[Row], outcome: &Outcome) -> Value {
    let mut events: Vec<Value> = motion::switches(rows)
        .iter()
        .map(|switch| {
            let what = match switch.what {
                What::Uplift => "uplift",
                What::Impact if mode(switch.mode) == 0 => "rest",
                What::Impact => "impact",
            };
            json!({ "t": switch.t, "what": what, "mode": mode(switch.mode) })
        })
        .collect();
    if outcome.class.overturned() {
        let last = rows.last().map_or(0, |row| mode(row.mode));
        events.push(json!({ "t": outcome.t_end, "what": "overturned", "mode": last }));
    }
    Value::Array(events)
}
