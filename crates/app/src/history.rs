//! `topple history`.

use std::path::PathBuf;

use crate::history_table::{self as table, MoreColumns};
use topple::backend::history as motion;
use topple::backend::request::BackendRequest;
use topple::model::asked::Asked;
use topple::model::precision::Precision;
use topple::results::earlier::Kind;
use topple::scene::builder::SceneBuilder;
use topple::scene::record::RecordText;
use topple::scene::{Grid, Parameter, Scene};
use topple::stepping::outcome::Outcome;
use topple_manifest::{HistoryRun, Motion, Run, SceneRun};
use topple_pictures::map::figure::history as figure;

use super::load::load;
use super::numbers::{PulseFlags, RecordNumbers};
use super::options::{CommonFlags, RunOptions, flag_error};
use super::record::RecordFlags;
use super::results_directory::Place;
use super::save::save;
use super::words::{self, Reporter};
use super::{InputError, device_remarks, examples};

/// Compute the motion of one cell; every number has a single value.
#[derive(clap::Args)]
#[command(after_help = examples::HISTORY)]
pub struct HistoryCommand {
    /// Scene file (TOML), instead of flags
    #[arg(value_name = "SCENE.toml")]
    scene: Option<PathBuf>,
    #[command(flatten)]
    common: CommonFlags,
    #[command(flatten)]
    pulse: PulseFlags,
    #[command(flatten, next_help_heading = "Record")]
    record: RecordFlags,
    #[command(flatten)]
    scale: RecordNumbers,
    /// Further columns of history.csv, or all of them: ground_h, ground_v, acc_plate, acc_plate_v, acc_block, acc_block_v
    /// (m/s², absolute, without gravity), n, s (contact forces, N), base_load (vertical force that the base carries, N)
    #[arg(long, value_name = "NAME,...", help_heading = "Computing")]
    columns: Option<MoreColumns>,
    #[command(flatten, next_help_heading = "Computing")]
    options: RunOptions,
}

impl HistoryCommand {
    /// Runs the cell.
    pub fn run(&self) -> anyhow::Result<()> {
        let options = &self.options;
        let more = self.columns.clone().unwrap_or_default();
        let record = self.record.text();
        let numbers = self.pulse.numbers.placed().chain(self.scale.placed());
        let text = SceneBuilder {
            force: options.force,
            shape: self.pulse.shape,
            record: (record != RecordText::default()).then_some(record),
            ..self.common.text(Some("Time history"), numbers)
        };
        let none =
            SceneBuilder { title: text.title.clone(), force: text.force, ..Default::default() };
        if let Some(path) = &self.scene {
            if text != none {
                let problem = "give a scene's file or the flags of a scene, not both";
                return Err(InputError(format!("{}: {problem}", path.display())).into());
            }
            return run_cell(&load(path, options.force)?, &more, options);
        }
        let scene = text.check().map_err(|error| flag_error(&error))?;
        if let Some(path) = &self.common.save_scene {
            return save(path, text, "history");
        }
        run_cell(&scene, &more, options)
    }
}

/// The table of the switches.
const EVENTS: &str = "events.csv";

/// The largest values of a motion in words.
fn largest(scene: &Scene, outcome: &Outcome) -> String {
    let mut text = String::new();
    if scene.isolation.moves_h() {
        text += &format!("|u| {:.6} m, ", outcome.max_u);
    }
    if scene.isolation.moves_v() {
        text += &format!("stroke of v {:.6} m, ", outcome.stroke_v);
    }
    let phi = outcome.max_phi_left.max(outcome.max_phi_right);
    text += &format!("|phi| {phi:.6} rad; least N/M {:.4} m/s²", outcome.min_contact);
    text += &format!(", friction needed {:.4}", outcome.friction);
    text += &format!(
        "; horizontal accelerations: plate {:.4} m/s², C {:.4} m/s², with gravity and the vertical ones {:.4} and {:.4} m/s²",
        outcome.acc_plate, outcome.acc_block, outcome.acc_plate_total, outcome.acc_block_total
    );
    if scene.numbers.has(Parameter::Mass) {
        text += &format!("; the base carries {:.1} N", outcome.base_load);
    }
    text
}

/// Runs a cell and writes its history.
pub fn run_cell(scene: &Scene, more: &MoreColumns, options: &RunOptions) -> anyhow::Result<()> {
    options.set_threads()?;
    let print = options.pictures.print().map_err(InputError)?;
    if let Some(swept) = scene.swept().first() {
        let flag = swept.entry().flag();
        let problem = format!("{flag}: a history is of one cell; give a single number");
        return Err(InputError(problem).into());
    }
    if options.backend() == BackendRequest::Gpu {
        let problem = "--backend: the shader keeps no history; use cpu or reference";
        return Err(InputError(problem.into()).into());
    }
    let mut plan = options.plan(scene).map_err(|e| flag_error(&e))?;
    // A history is the motion to its end, proved or not.
    plan.shortcuts.certificate = false;
    plan.asked = Asked { accelerations: true, stops: true, ..Asked::ALL };
    words::warn_of_doubts(scene);
    words::warn_of_cut_pulses(&Grid::of(scene));
    words::warn_of_lossless_impacts(&plan, &Grid::of(scene));
    let place = Place::of(&options.out, Kind::History)?;
    let files = ["history.csv", "history.svg", "history.png", EVENTS].map(String::from);
    place.refuse_foreign(&files)?;
    let mut out = place.open_alone()?;
    device_remarks::warn(scene);
    let case = scene.case();
    let (rows, outcome) = match (options.backend(), options.precision()) {
        (BackendRequest::Reference, _) => motion::by_reference(scene, &case),
        (_, Precision::F32) => motion::by_steps::<f32>(&plan.at(Precision::F32), &case),
        (_, Precision::F64) => motion::by_steps::<f64>(&plan.at(Precision::F64), &case),
    };
    motion::check_rows(&rows).map_err(|error| flag_error(&error))?;
    if outcome.class.stands() {
        words::warn_of_radius(None, scene.numbers.get(Parameter::Radius), outcome.max_u);
    }
    if outcome.loses_contact() {
        words::warn(words::TENSILE);
    }
    let picture = figure::draw(scene, &case, &rows, &outcome, print)?;
    let png = picture.png()?;
    out.begin(files.to_vec(), &Reporter::unless(options.quiet))?;
    let forces = if more.is_empty() { Vec::new() } else { motion::forces(scene, &case, &rows) };
    out.write("history.csv", |w| table::write(&rows, (more, &forces), w))?;
    out.write(EVENTS, |w| table::write_events(&motion::events(&rows, &outcome), w))?;
    out.picture("history", &picture, &png)?;
    let backend = if options.backend() == BackendRequest::Reference { "reference" } else { "cpu" };
    out.finish(Run::History(Box::new(HistoryRun {
        of: SceneRun::of(scene, backend.into(), options.method(), options.pictures.record()),
        outcome: Some(Motion::Whole(Box::new(outcome))),
        more_columns: more.clone().into(),
    })))?;
    let say = Reporter::unless(options.quiet);
    words::device(&say, None, scene);
    words::record(&say, scene);
    let name = outcome.class.name().replace('_', " ");
    let impacts = match outcome.impacts {
        1 => "1 impact".into(),
        impacts => format!("{impacts} impacts"),
    };
    say.line("outcome", format!("{name} after {impacts}, t_end = {:.6} s", outcome.t_end));
    if let Some(t) = outcome.t_uplift {
        say.line("uplift", format!("{t:.6} s, zeta = {:.6}", outcome.zeta));
    }
    say.line("largest", largest(scene, &outcome));
    say.line("picture", out.file("history.png").display());
    say.line(
        "data",
        format!("{} with events.csv, history.svg, run.json", out.file("history.csv").display()),
    );
    Ok(())
}
