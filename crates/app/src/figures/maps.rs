//! Figures of maps.

use std::time::{Duration, Instant};

use serde::Serialize;
use topple::backend::backend_error::BackendError;
use topple::results;
use topple::results::column_set::ColumnSet;
use topple::scene::{Grid, Scene};
use topple::sweep::sample;
use topple::sweep::settings::Method;
use topple::sweep::verification::{self, Verification};
use topple_lab::figures::motions::Motion;
use topple_lab::figures::shares::Shares;
use topple_lab::figures::{Figure, Panel, letter, panels, path};
use topple_pictures::map::Map;

use super::super::errors::of_figure;
use super::super::interrupt;
use super::super::progress::Bar;
use super::{Work, plan};

/// Cells of a panel, and of a path, that the reference runs again.
const SAMPLE: usize = 32;

/// NAME.json of a figure.
#[derive(Serialize)]
struct Manifest<'a> {
    version: &'static str,
    title: &'a str,
    backend: &'static str,
    #[serde(flatten)]
    method: Method,
    sweep_seconds: f64,
    motions: Vec<&'a str>,
    panels: Vec<PanelManifest<'a>>,
}

/// A panel in it.
#[derive(Serialize)]
struct PanelManifest<'a> {
    letter: String,
    scene: &'a Scene,
    shares: Shares,
    verification: Verification,
}

impl Work<'_> {
    /// Runs a figure's panels, and writes picture and data.
    pub(super) fn maps(&self, figure: &Figure, motions: &[Motion]) -> anyhow::Result<()> {
        let cells = figure.cells();
        let progress = Bar::new(cells, self.options.quiet);
        let began = Instant::now();
        let mut maps: Vec<Map> = Vec::with_capacity(figure.panels.len());
        for (k, panel) in figure.panels.iter().enumerate() {
            let place = format!("{}, panel {}", figure.name, letter(k));
            // Two panels may show two sides of the same cells.
            let twin = figure.panels[..k].iter().position(|other| {
                other.scene == panel.scene && other.fixed_step == panel.fixed_step
            });
            let outcomes = match twin {
                Some(twin) => maps[twin].outcomes.clone(),
                None => self.sweep(&panel.scene, panel.fixed_step, &place, &progress)?.into(),
            };
            let grid = Grid::of(&panel.scene);
            maps.push(Map { scene: &panel.scene, grid, outcomes, columns: ColumnSet::ALL });
        }
        progress.finish();
        let seconds = began.elapsed().as_secs_f64();
        let mut told = Vec::with_capacity(maps.len());
        for (k, (panel, map)) in figure.panels.iter().zip(&maps).enumerate() {
            let name = format!("{}-{}", figure.name, letter(k));
            self.out.write(&format!("{name}.csv"), |w| {
                results::csv::write(&map.grid, map, map.columns, w)
            })?;
            told.push(PanelManifest {
                letter: letter(k),
                scene: &panel.scene,
                shares: Shares::of(&map.outcomes),
                verification: self.judge(map, &name)?,
            });
            self.paths(panel, &name)?;
        }
        let mut caption: Vec<String> = motions.iter().map(|m| format!("{}.", m.line)).collect();
        caption.push(self.how());
        let picture = panels::draw(figure, &maps, &caption)?;
        let (sampled, differ) = told.iter().fold((0, 0), |(sampled, differ), panel| {
            (sampled + panel.verification.sampled, differ + panel.verification.differ)
        });
        let manifest = Manifest {
            version: env!("CARGO_PKG_VERSION"),
            title: &figure.title,
            backend: self.backend.name(),
            method: self.options.method(),
            sweep_seconds: seconds,
            motions: motions.iter().map(|motion| motion.line.as_str()).collect(),
            panels: told,
        };
        let json = format!("{}.json", figure.name);
        self.out.write(&json, |w| serde_json::to_writer_pretty(w, &manifest))?;
        let what = format!(
            "{cells} cells in {seconds:.1} s, {differ} of {sampled} differ from the reference"
        );
        self.picture(&figure.name, &picture, &what)
    }

    /// A sample of a map's cells by the reference.
    fn judge(&self, map: &Map, place: &str) -> anyhow::Result<Verification> {
        let by_steps = plan(self.options, map.scene, None, place)?;
        let chosen = sample::sample(&map.grid, map, SAMPLE)?;
        let sample = (&chosen[..], Duration::MAX);
        let of = (&by_steps, map.columns);
        let verified = verification::verify(of, &map.grid, sample, interrupt::flag());
        verified.ok_or_else(|| of_figure(BackendError::Cancelled.into()))
    }

    /// What the paths of a panel meet: a picture and a table each.
    fn paths(&self, panel: &Panel, panel_name: &str) -> anyhow::Result<()> {
        for along in &panel.paths {
            let Some(scene) = along.scene(&panel.scene) else { continue };
            // A name may hold what a file's may not.
            let plain = |c: char| if c.is_alphanumeric() { c.to_ascii_lowercase() } else { '-' };
            let slug: String = along.name.chars().map(plain).collect();
            let name = format!("{panel_name}-{slug}");
            let progress = Bar::new(Grid::of(&scene).len(), self.options.quiet);
            let outcomes = self.sweep(&scene, panel.fixed_step, &name, &progress)?;
            progress.finish();
            let (grid, outcomes) = (Grid::of(&scene), outcomes.into());
            let map = Map { scene: &scene, grid, outcomes, columns: ColumnSet::ALL };
            let judged = self.judge(&map, &name)?;
            self.out.write(&format!("{name}.csv"), |w| {
                results::csv::write(&map.grid, &map, map.columns, w)
            })?;
            let title = format!("{}: upwards at Ω = {} rad/s", along.name, along.omega);
            let caption = format!(
                "Object and base of {panel_name}, ε = {}; {}",
                scene.case().block.eccentricity,
                self.how()
            );
            let picture = path::draw(&title, &map, &caption)?;
            let what = format!(
                "{} cells, {} of {} differ from the reference",
                map.outcomes.len(),
                judged.differ,
                judged.sampled
            );
            self.picture(&name, &picture, &what)?;
        }
        Ok(())
    }
}
