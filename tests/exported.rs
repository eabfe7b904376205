//! What the exported page computes by: its tables against the library's. The page runs in a browser: this test writes what the
//! library has for a set of scenes, tests/explore/test_webgpu.py compares.

#![cfg(feature = "explore")]
#![allow(missing_docs, clippy::unwrap_used, clippy::panic)] // tests

mod common;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use common::{all, gpu, scene, synthetic_pair, under};
use serde_json::{Value, json};
use topple::explore::known::{RECORD, known};
use topple::explore::export;
use topple::model::precision::Precision;
use topple::scene::keys;
use topple::scene::parameters::Section;
use topple::scene::{Grid, Parameter, Scene};
use topple::stepping::outcome::Outcome;
use topple::sweep::cell_tables::{CellTables, Clocks};
use topple::sweep::cells::Cells;
use topple::sweep::clock::DEFAULT_STEP;
use topple::sweep::gpu::opened::Gpu;
use topple::sweep::gpu::run::Sweeper;
use topple::sweep::plan::Plan;
use topple::sweep::progress::Unwatched;
use topple::sweep::table::Window;

/// Scenes as the page asks for them: a name, the keys, and the values of each axis.
const SCENES: [(&str, &str, [u32; 2]); 22] = [
    ("dual", "object=1 eccentricity=0.2 t_h=1.75 t_v=0.75 omega=0.2:15 a_h=0.1:15", [24, 20]),
    ("vertical ground", "object=1 t_h=1.75 t_v=0.75 a_v=0.5 omega=0.2:15 a_h=-7:15", [20, 20]),
    ("horizontal", "object=2 isolation=horizontal t_h=2 omega=0.5:9 a_h=0.5:20", [16, 16]),
    ("vertical", "object=3 isolation=vertical t_v=0.4 omega=0.5:9 a_h=0.5:20", [16, 16]),
    ("fixed", "half_width=0.5 height=1.5 isolation=none omega=0.5:9 a_h=0.5:20", [16, 16]),
    ("sizes", "slenderness=3 isolation=none size=0.3:3:log a_h=3 omega=0.5:9:log", [16, 16]),
    ("offset", "object=1 offset=-0.04 t_h=1.3 t_v=0.2 omega=1:12 a_h=1:20", [12, 12]),
    ("one cosine", "object=1 shape=one-cosine cycles=1.5 t_h=1.75 t_v=0.75 omega=1:12:log a_h=1:20", [14, 12]),
    ("two cycles", "object=1 cycles=2 t_h=1.75 t_v=0.75 omega=1:12 a_h=1:20", [12, 12]),
    ("half sine", "object=1 shape=half-sine t_h=1.75 t_v=0.75 omega=1:12 a_h=1:20", [12, 12]),
    ("rectangle", "object=2 shape=rectangle isolation=none omega=1:12 a_h=1:20", [12, 12]),
    ("ricker", "object=1 shape=ricker t_h=1.75 t_v=0.75 omega=1:12 a_h=1:20", [12, 12]),
    ("ricker antisymmetric", "object=1 shape=ricker-antisymmetric t_h=1.75 t_v=0.75 omega=1:12 a_h=1:20", [12, 12]),
    ("modulated", "object=1 shape=mavroeidis-papageorgiou phase=0.7 t_h=1.75 t_v=0.75 gamma=1:4 a_h=1:20 omega=5", [12, 12]),
    ("exponents", "object=1 t_h=1.75 t_v=0.75 bouc_wen_n=5 omega=1:12 a_h=1:20", [12, 12]),
    ("strength", "object=1 t_h=1.75 t_v=0.75 u_y=0.01 omega=1:12 a_h=1:20", [12, 12]),
    ("yield force", "object=2 t_h=1.75 t_v=0.75 yield_force=900 omega=2 a_h=1:20 t_h=0.5:4", [12, 12]),
    ("linear to yielding", "object=1 t_h=1.75 t_v=0.75 psi=0.1:1 xi_h=0.02:0.4 omega=3 a_h=9", [13, 12]),
    ("tilted", "object=1 isolation=none tilt=-0.08:0.08 a_h=0:9 omega=4", [13, 12]),
    ("restitution", "object=1 eccentricity=0.1 isolation=none restitution=0.5:1 a_h=2:12 omega=4 overturn=quarter-turn", [12, 12]),
    ("eccentricities", "object=1 eccentricity=-0.4:0.4 t_h=1.75 t_v=0.05:1 omega=4 a_h=8 t_max=12 friction=0.4", [13, 12]),
    ("record", "object=1 eccentricity=0.2 horizontal=exported t_h=0.5:4 t_v=0.001:1", [12, 12]),
];

/// The keys of a scene's text.
fn flat(text: &str) -> BTreeMap<String, String> {
    let pair = |pair: &str| pair.split_once('=').map(|(key, value)| (key.into(), value.into()));
    text.split(' ').filter_map(pair).collect()
}

/// The two axes: the keys of ranges, in the text's order.
fn axes(text: &str) -> Vec<&str> {
    text.split(' ').filter(|pair| pair.contains(':')).map(|pair| pair.split('=').next().unwrap()).collect()
}

/// The library's scene of such a text.
fn checked(text: &str, count: [u32; 2]) -> Scene {
    let (flat, axes) = (flat(text), axes(text));
    let mut toml = String::new();
    for section in Section::ALL {
        let own = |key: &str| {
            keys::words(section).contains(&key)
                || Parameter::of_key(key).is_some_and(|of| of.entry().section == section)
        };
        toml.push_str(&format!("[{}]\n", section.key()));
        for (key, value) in flat.iter().filter(|(key, _)| own(key) && *key != "horizontal") {
            let counted = match axes.iter().position(|axis| axis == key) {
                Some(axis) => {
                    let (range, log) = match value.strip_suffix(":log") {
                        Some(range) => (range, ":log"),
                        None => (&value[..], ""),
                    };
                    format!("{range}:{}{log}", count[axis])
                }
                None => value.clone(),
            };
            let quote = if counted.parse::<f64>().is_ok() { "" } else { "\"" };
            toml.push_str(&format!("{key} = {quote}{counted}{quote}\n"));
        }
        if section == Section::Run {
            toml.push_str(&format!("x = \"{}\"\ny = \"{}\"\n", axes[0], axes[1]));
        }
    }
    let recorded = flat.contains_key("horizontal");
    // A record takes the place of a pulse, with which a scene is checked here.
    let toml = if recorded { toml.replace("[pulse]\n[record]\n", "[pulse]\nomega = 1\na_h = 1\n") } else { toml.replace("[record]\n", "") };
    let mut scene = scene(&toml);
    if recorded {
        under(&mut scene, synthetic_pair());
    }
    scene
}

fn words<T: bytemuck::Pod>(items: &[T]) -> Vec<u32> {
    bytemuck::pod_collect_to_vec(items)
}

/// The numbers of a plan's cells: the tables of all, and each cell as its integration begins.
fn tables(plan: &Plan, grid: &Grid, cells: &[usize]) -> Value {
    let mut tables: CellTables<f32> = CellTables::of(plan, grid, &Window::around(grid, cells));
    // The page has a list of a clock for each cell.
    let clocks = match std::mem::replace(&mut tables.clocks, Clocks::Shared(empty())) {
        Clocks::Shared(table) => {
            json!(words(&table.entries.iter().map(|(_, steps)| *steps).collect::<Vec<_>>()))
        }
        Clocks::Own(_) => Value::Null,
    };
    let record = plan.record::<f32>();
    let all = Cells::<f32>::of(plan, grid, cells, &record, &Unwatched);
    let begun: Vec<_> = cells.iter().map(|&cell| all.begin(cell)).collect();
    json!({
        "bodies": words(&tables.bodies.entries),
        "horizontal": words(&tables.horizontal.entries),
        "vertical": words(&tables.vertical.entries),
        "drive": words(&tables.drive.entries),
        "clocks": clocks,
        "cells": words(&begun.iter().map(|(cell, _)| *cell).collect::<Vec<_>>()),
        "states": words(&begun.iter().map(|(_, state)| *state).collect::<Vec<_>>()),
    })
}

fn empty<T>() -> topple::sweep::table::Table<T> {
    topple::sweep::table::Table { entries: Vec::new(), strides: [0; 6], before: 0 }
}

fn outcome(outcome: &Outcome) -> Value {
    let Outcome { impacts, uplifts, t_end, t_simulated, t_uplift, zeta, .. } = *outcome;
    json!({
        "outcome": outcome.class.name(),
        "status": outcome.status.name(),
        "impacts": impacts,
        "uplifts": uplifts,
        "t_end": t_end,
        "t_simulated": t_simulated,
        "t_uplift": t_uplift,
        "zeta": zeta,
        "max_phi_left": outcome.max_phi_left,
        "max_phi_right": outcome.max_phi_right,
        "max_u": outcome.max_u,
        "max_v": outcome.max_v,
        "stroke_v": outcome.stroke_v,
        "min_contact": outcome.min_contact,
        "friction_demand": outcome.friction,
    })
}

/// What the library has for a scene, part by part.
fn library(scene: &Scene, gpu: Option<&Gpu>) -> Value {
    // The page integrates the full contact of each cell by itself.
    let mut plan = Plan::new(scene, DEFAULT_STEP).unwrap();
    plan.reductions.full_contact = false;
    let grid = Grid::of(scene);
    let parts = plan.parts(&grid, &all(&grid));
    let told = parts.iter().map(|part| {
        let outcomes = gpu.map(|gpu| {
            let sweeper = Sweeper::new(gpu, Precision::F32, part.plan.variant()).unwrap();
            let swept = sweeper.sweep::<f32>(&part.plan, &grid, &part.cells, &Unwatched).unwrap();
            swept.outcomes.iter().map(outcome).collect::<Vec<_>>()
        });
        json!({
            "cells": part.cells,
            "verticalLocked": part.vertical_locked,
            "tables": tables(&part.plan, &grid, &part.cells),
            "outcomes": outcomes,
        })
    });
    told.collect()
}

/// Where the browser's test looks.
fn folder() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("exported")
}

#[test]
fn what_the_browser_is_compared_with_is_written() {
    let gpu = gpu("outcomes for the exported page", Precision::F32);
    let folder = folder();
    fs::create_dir_all(&folder).unwrap();
    let record = synthetic_pair();
    let write = |name: &str, text: String| fs::write(folder.join(name), text).unwrap();
    write("model.json", known(Some(&record)).unwrap().to_string());
    write("sweep.wgsl", export::shader());
    for (number, (name, text, count)) in SCENES.iter().enumerate() {
        let scene = checked(text, *count);
        let axes = axes(text);
        let mut asked = flat(text);
        asked.insert("x".into(), axes[0].into());
        asked.insert("y".into(), axes[1].into());
        assert!(asked.get("horizontal").is_none_or(|id| id == RECORD));
        let told = json!({
            "name": name,
            "scene": asked,
            "count": count,
            "parts": library(&scene, gpu.as_ref()),
        });
        write(&format!("scene-{number}.json"), told.to_string());
    }
}
