//! What the page has to know: the tables of parameters and columns, words, colours, and the first scene.

use serde_json::{Value, json};

use super::first::first;
use super::frame::type_of;
use super::session::Session;
use super::shown::shown;
use super::stages::MOST;
use topple::Written;
use topple::backend::report::threads;
use topple::model::precision::Precision;
use topple::model::pulse::Shape;
use topple::results::column_set::ColumnSet;
use topple::scene::description::{self, Description};
use topple::scene::parameters::{Entry, PARAMETERS, Section};
use topple::scene::{Directions, Overturn, Pressure};
use topple::stepping::outcome::Class;
use topple_pictures::colours::Colour;
use topple_pictures::colours::palette::{CURVES, DOTTED, FALLEN, Kind, MARKED, OUTLINE, dots};
use topple_pictures::colours::ramp::{GREYS, PROBABILITY};
use topple_pictures::map::figure::fields;

/// A colour as a page writes it.
fn hex([r, g, b]: Colour) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// A choice of words: the key, its section, and each word with its meaning, the default one first.
fn choice(section: Section, key: &str, words: &[(Value, &str)]) -> Value {
    let told = words.iter().map(|(word, label)| json!({ "value": word, "label": label }));
    json!({
        "key": key,
        "section": section.key(),
        "applies": section.applies(),
        "values": told.collect::<Vec<Value>>(),
        // A block is one of the reader's own by default.
        "first": words.first().filter(|_| key != "object").map(|(word, _)| word),
    })
}

/// The choices of a scene that are no numbers.
fn words() -> Vec<Value> {
    let shapes: Vec<_> = Shape::ALL.iter().map(|shape| (json!(shape), shape.words())).collect();
    vec![
        choice(
            Section::Block,
            "object",
            &[
                (json!("1"), "caryatid"),
                (json!("2"), "server cabinet"),
                (json!("3"), "hospital cabinet"),
            ],
        ),
        choice(
            Section::Base,
            "isolation",
            &[
                (json!(Directions::Dual), "horizontal and vertical"),
                (json!(Directions::Horizontal), "horizontal alone"),
                (json!(Directions::Vertical), "vertical alone"),
                (json!(Directions::None), "none: a block on the ground"),
            ],
        ),
        choice(
            Section::Base,
            "pressure",
            &[
                (json!(Pressure::Follows), "by what stands on it at each instant"),
                (json!(Pressure::Constant), "by the weight"),
            ],
        ),
        choice(Section::Pulse, "shape", &shapes),
        choice(
            Section::Run,
            "overturn",
            &[
                (json!(Overturn::CriticalAngle), "at the critical angle"),
                (json!(Overturn::QuarterTurn), "at 90°"),
            ],
        ),
    ]
}

/// The columns of a map.
fn columns() -> Vec<Value> {
    let told = ColumnSet::ALL.entries().map(|entry| {
        json!({
            "name": entry.name,
            "unit": entry.unit,
            "meaning": entry.meaning,
            "type": type_of(entry.kind),
        })
    });
    told.collect()
}

/// The colours of outcomes.
fn kinds() -> Vec<Value> {
    let told = Kind::all().into_iter().map(|kind| {
        let colour = kind.colour();
        json!({
            "label": kind.label(),
            "colour": hex(colour),
            "dots": hex(dots(colour)),
            "overturns": overturns(kind),
            "unresolved": kind == Kind::Unresolved,
        })
    });
    told.collect()
}

/// The table of parameters, each with the range of its slider and its group.
fn parameters() -> Vec<Value> {
    let with_range = |(entry, described): (&Entry, Description)| {
        let mut told = json!(described);
        told["handy"] = json!(entry.slider);
        told["group"] = json!(entry.group);
        told
    };
    PARAMETERS.iter().zip(description::parameters()).map(with_range).collect()
}

/// True of the classes of blocks that overturn.
fn overturns(kind: Kind) -> bool {
    matches!(kind, Kind::DirectLeft | Kind::DirectRight | Kind::Impacts(_) | Kind::More)
}

/// The codes of the column `outcome` that the page draws in a colour of their own.
fn codes() -> Value {
    let overturned = Class::ALL.iter().enumerate().filter(|(_, class)| class.overturned());
    json!({
        "overturned": overturned.map(|(code, _)| code).collect::<Vec<usize>>(),
        "unresolved": Class::ALL.iter().position(|class| *class == Class::Unresolved),
    })
}

/// All that does not depend on a session.
pub fn tables() -> Value {
    let sections = Section::ALL
        .map(|own| json!({ "key": own.key(), "heading": own.heading(), "applies": own.applies() }));
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "sections": sections,
        "parameters": parameters(),
        "alternatives": description::alternatives(),
        "words": words(),
        "columns": columns(),
        "kinds": kinds(),
        "codes": codes(),
        "dotted": DOTTED,
        "hatched": "contact force tensile, or friction beyond what is given: the model is not valid",
        "shown": shown(),
        "first": first(),
        "shades": {
            "fallen": hex(FALLEN),
            "marked": hex(MARKED),
            "outline": hex(OUTLINE),
            "now": hex(CURVES[1]),
            "greys": GREYS,
            "falls": fields::falling(),
            "probability": PROBABILITY,
        },
        "limits": { "cells": MOST },
    })
}

/// What the page of a session has to know.
pub fn about(session: &Session) -> Value {
    let mut about = tables();
    let opened = session.opened(Precision::F32).ok();
    let backend = opened.as_ref().map(|opened| &opened.backends[0]);
    let adapter = backend.and_then(|backend| backend.adapter());
    let entries = [
        ("engine", json!("server")),
        ("backend", json!(backend.map(|backend| backend.name()))),
        ("adapter", json!(adapter.map(|adapter| &adapter.name))),
        ("cores", json!(threads())),
        ("precision", json!([Precision::F32, Precision::F64])),
        ("scene", json!(session.first)),
    ];
    for (key, value) in entries {
        about[key] = value;
    }
    about
}
