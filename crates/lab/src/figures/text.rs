//! Figures as written: TOML.
//!
//! `[scene]` holds what the panels share, with the keys of a scene; each `[[panel]]` has a `scene`
//! of its own whose keys replace those.

use std::path::Path;

use serde::Deserialize;
use toml::{Table, Value};

use super::error::ReadError;
use super::marks::{self, Point, Window};
use super::motions::{Motion, Motions};
use super::{Figure, Panel, Shows, letter};
use topple::scene::builder::{SceneBuilder, located};
use topple::scene::{Excitation, Range, Scene, SceneError, Values};

/// A figure as written.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct FigureText {
    title: String,
    shows: Shows,
    #[serde(default = "one")]
    columns: usize,
    #[serde(default)]
    scene: Table,
    panel: Vec<PanelText>,
}

fn one() -> usize {
    1
}

/// A panel as written.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct PanelText {
    shows: Option<Shows>,
    motion: Option<String>,
    label: Option<String>,
    fixed_step: Option<f64>,
    window: Option<Window>,
    points: Vec<Point>,
    paths: Vec<marks::Path>,
    cells: Vec<marks::Cell>,
    eccentricities: Option<Values>,
    scene: Table,
}

/// What a figure is read with: the motions, the directory of their files, and the number of points.
#[derive(Debug, Clone, Copy)]
pub struct FigureInputs<'a> {
    /// The motions there are.
    pub motions: &'a Motions,
    /// Where their files are.
    pub records: Option<&'a Path>,
    /// Points of every axis that has several, in place of what is written.
    pub cells: Option<u32>,
}

impl Figure {
    /// Reads a figure from TOML, and opens its motions; returns these too.
    ///
    /// # Errors
    /// [`ReadError`] with the line or the panel at fault.
    pub fn from_toml(
        name: &str,
        text: &str,
        inputs: &FigureInputs,
    ) -> Result<(Figure, Vec<Motion>), ReadError> {
        let written: FigureText =
            toml::from_str(text).map_err(|error| ReadError::new(name, located(text, &error)))?;
        if written.columns == 0 {
            return Err(ReadError::new(name, "columns must be at least 1"));
        }
        let mut motions: Vec<Motion> = Vec::new();
        let mut panels = Vec::with_capacity(written.panel.len());
        for (index, panel) in written.panel.into_iter().enumerate() {
            let place = format!("{name}, panel {}", letter(index));
            let shows = panel.shows.unwrap_or(written.shows);
            panels.push(read(&place, shows, &written.scene, panel, inputs, &mut motions)?);
        }
        if panels.is_empty() {
            return Err(ReadError::new(name, "no panel; give a [[panel]] at least"));
        }
        if let Some(other) =
            panels.iter().find(|panel| panel.shows.family() != panels[0].shows.family())
        {
            let problem = format!("{:?} and {:?} do not go together", panels[0].shows, other.shows);
            return Err(ReadError::new(name, problem));
        }
        let figure = Figure {
            name: name.to_string(),
            title: written.title,
            columns: written.columns,
            panels,
        };
        Ok((figure, motions))
    }
}

fn read(
    place: &str,
    shows: Shows,
    shared: &Table,
    mut panel: PanelText,
    inputs: &FigureInputs,
    motions: &mut Vec<Motion>,
) -> Result<Panel, ReadError> {
    let refused = |problem: String| ReadError::new(place, problem);
    let mut table = shared.clone();
    merge(&mut table, std::mem::take(&mut panel.scene));
    let text: SceneBuilder =
        table.try_into().map_err(|error: toml::de::Error| refused(error.message().to_string()))?;
    let checked = |scene: Result<Scene, SceneError>| scene.map_err(|e| refused(e.to_string()));
    let (mut scene, motion) = match &panel.motion {
        None => (checked(text.check())?, None),
        Some(key) => {
            let Some(motion) = inputs.motions.get(key) else {
                let known: Vec<&str> = inputs.motions.keys().map(String::as_str).collect();
                let problem = format!("no motion '{key}'; there are {}", known.join(", "));
                return Err(refused(problem));
            };
            let opened = match motions.iter().find(|opened| opened.name == motion.name) {
                Some(opened) => opened.clone(),
                None => {
                    motions.push(motion.open(inputs.records)?);
                    motions[motions.len() - 1].clone()
                }
            };
            let label = opened.label();
            let excitation = Excitation::Record(opened.pair);
            (checked(text.check_under(excitation))?, Some(label))
        }
    };
    if let Some(cells) = inputs.cells {
        for parameter in scene.swept() {
            if let Some(Values::Range(range)) = scene.numbers.get(parameter).cloned() {
                scene.set(parameter, Range { count: cells, ..range });
            }
        }
    }
    if let Some(step) = panel.fixed_step
        && !(step > 0.0 && step.is_finite())
    {
        return Err(refused(format!("fixed_step: {step} must be a positive number of seconds")));
    }
    let faults = [
        panel.window.and_then(|window| window.fault()),
        panel.points.iter().find_map(Point::fault),
        panel.paths.iter().find_map(|path| path.fault(&scene)),
        panel.cells.iter().find_map(|cell| cell.fault(&scene)),
        asked_for(shows, &panel, &scene),
    ];
    if let Some(fault) = faults.into_iter().flatten().next() {
        return Err(refused(fault));
    }
    let PanelText { label, fixed_step, window, points, paths, cells, eccentricities, .. } = panel;
    Ok(Panel {
        shows,
        scene,
        motion,
        label,
        fixed_step,
        window,
        points,
        paths,
        cells,
        eccentricities,
    })
}

/// What a panel lacks for what it shows.
fn asked_for(shows: Shows, panel: &PanelText, scene: &Scene) -> Option<String> {
    let pulse = scene.excitation.record().is_none();
    let problem = match (shows, &panel.eccentricities) {
        _ if scene.swept().len() > 2 => {
            "more than two numbers have several values; give the others one"
        }
        (Shows::Shares, None) => "eccentricities: missing; give start:stop:count",
        (Shows::Shares, Some(values))
            if values.count() < 2 || values.iter().any(|e| !(e.abs() < 1.0)) =>
        {
            "eccentricities: two or more, all between -1 and 1"
        }
        (Shows::Motion, _) if panel.cells.is_empty() => "cells: missing; give one at least",
        (Shows::LeastAmplitude, _) if !pulse => "the least amplitude is a pulse's; give no motion",
        _ => return None,
    };
    Some(problem.into())
}

/// Puts the keys of a table over those of another, tables within them key by key.
fn merge(table: &mut Table, over: Table) {
    for (key, value) in over {
        match (table.get_mut(&key), value) {
            (Some(Value::Table(below)), Value::Table(above)) => merge(below, above),
            (_, value) => {
                table.insert(key, value);
            }
        }
    }
}
