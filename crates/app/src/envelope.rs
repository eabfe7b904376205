//! `topple envelope`.

use serde::Serialize;
use topple::results::earlier::Kind;
use topple::scene::Grid;
use topple::scene::record::rounded;
use topple_pictures::drawing::render;
use topple_pictures::studies::{envelope as envelope_picture, envelope_curves};
use topple_studies::suites::envelope::{self, CellEnvelope, Envelope, Limits};
use topple_studies::suites::swept_motion::Values;
use topple_studies::suites::verified::Verified;

use super::errors::sweep_error;
use super::numbers::RecordNumbers;
use super::options::{CommonFlags, RunOptions, flag_error, number};
use super::results_directory::{Place, picture_files};
use super::suite_run::{self, SuiteFlags, SuiteManifest};
use super::words::Reporter;
use super::{examples, suite};

/// Sweep a scene under every motion of a suite: which cells keep the block standing, within which strokes.
#[derive(clap::Args)]
#[command(after_help = examples::ENVELOPE)]
pub struct EnvelopeCommand {
    #[command(flatten)]
    common: CommonFlags,
    #[command(flatten)]
    record: RecordNumbers,
    #[command(flatten)]
    pub motions: SuiteFlags,
    /// Share of the motions under which the block must stand
    #[arg(
        long,
        value_name = "SHARE",
        default_value = "1",
        help_heading = "Suite",
        value_parser = number,
        allow_negative_numbers = true
    )]
    standing: f64,
    /// Largest max |u| that there is room for, m [default: any]
    #[arg(long, value_name = "M", help_heading = "Suite", value_parser = number, allow_negative_numbers = true)]
    limit_u: Option<f64>,
    /// Largest stroke of v that there is room for, m [default: any]
    #[arg(long, value_name = "M", help_heading = "Suite", value_parser = number, allow_negative_numbers = true)]
    limit_v: Option<f64>,
    #[command(flatten, next_help_heading = "Computing")]
    pub options: RunOptions,
}

/// run.json of an envelope.
#[derive(Serialize)]
struct Manifest<'a> {
    #[serde(flatten)]
    suite: SuiteManifest<'a>,
    standing: f64,
    limit_u: Option<f64>,
    limit_v: Option<f64>,
    feasible: usize,
    /// What the reference says of a sample.
    verified: &'a Verified,
}

/// The tables, and the name of the picture.
const TABLE: &str = "envelope.csv";
const ZETA: &str = "zeta.csv";
const PICTURE: &str = "envelope";

/// Best cells that are printed.
const BEST: usize = 3;

impl EnvelopeCommand {
    /// Runs the sweeps and writes the envelope.
    pub fn run(&self) -> anyhow::Result<()> {
        let options = &self.options;
        let place = Place::of(&options.out, Kind::Envelope)?;
        let text = self.common.text(Some("Envelope"), self.record.placed());
        let limits = Limits { standing: self.standing, u: self.limit_u, v: self.limit_v };
        let request = self.motions.request(&self.common, options, text)?;
        request.check().map_err(|error| flag_error(&error))?;
        request.check_envelope(&limits).map_err(|error| flag_error(&error))?;
        let names = [TABLE, ZETA].map(String::from).into_iter().chain(picture_files(PICTURE));
        self.motions.refuse_foreign(&place, &names.collect::<Vec<_>>())?;
        let suite = self.motions.read()?;
        let say = Reporter::unless(options.quiet);
        suite::count(&suite, &say);
        let job = request.open(&suite).map_err(sweep_error)?;
        let Some(swept) = self.motions.run(job, 1, options, &say)? else {
            return Ok(());
        };
        let mut out = place.open()?;
        let mut envelope = Envelope::of(swept, limits);
        let swept = &envelope.sweep;
        let title = format!("Envelope of {} motions", swept.motions.len());
        let mut files = [TABLE, ZETA].map(String::from).to_vec();
        let svg = match swept.grid.line() {
            Some(axis) => Some(envelope_curves::draw(&envelope, axis, &title)),
            None => envelope_picture::draw(&envelope, &title)?,
        };
        if svg.is_some() {
            files.extend(picture_files(PICTURE));
        }
        out.begin(files, &say)?;
        out.write(TABLE, |w| envelope::write(&envelope, w))?;
        out.write(ZETA, |w| envelope::write_zeta(&envelope, w))?;
        if let Some(svg) = &svg {
            out.picture(PICTURE, svg, &render::png(svg)?)?;
        }
        let best = envelope.best();
        let motions = swept.motions.iter().map(|motion| motion.id.as_str()).collect();
        let manifest = Manifest {
            suite: self.motions.manifest(swept, motions, (&suite, options)),
            standing: limits.standing,
            limit_u: limits.u,
            limit_v: limits.v,
            feasible: best.len(),
            verified: &swept.verified,
        };
        out.finish(&manifest)?;
        tell(&envelope, &best, &say);
        suite_run::tell_verified(swept, &say);
        envelope.sweep.discard_saved()?;
        if svg.is_some() {
            let [_, png] = picture_files(PICTURE);
            say.line("picture", out.file(&png).display());
        }
        say.line("table", format!("{} with run.json", out.file(TABLE).display()));
        Ok(())
    }
}

/// Says which cells keep the limits, how far these are, and which motions govern.
fn tell(envelope: &Envelope, best: &[usize], say: &Reporter) {
    let cells = envelope.cells.len();
    let share = 100.0 * best.len() as f64 / cells.max(1) as f64;
    say.line("feasible", format!("{} of {cells} cells, {share:.1} %", best.len()));
    for (number, cell) in best.iter().take(BEST).enumerate() {
        say.line(if number == 0 { "best" } else { "" }, one(envelope, *cell));
    }
    if best.is_empty()
        && let Some(cell) = envelope.nearest()
    {
        say.line("nearest", one(envelope, cell));
    }
    let moves = envelope.sweep.scene.isolation;
    if let Some(cell) = best.first().copied().or(envelope.nearest()) {
        let by = |values: Values| envelope.governing(cell, values).unwrap_or("none");
        let u = moves.moves_h().then(|| format!("|u| by {}", by(|motion| &motion.max_u)));
        let v = moves
            .moves_v()
            .then(|| format!("the stroke of v by {}", by(|motion| &motion.stroke_v)));
        let both: Vec<String> = u.into_iter().chain(v).collect();
        if !both.is_empty() {
            say.line("governed", format!("there {}", both.join(", ")));
        }
    }
    let worst = envelope.worst();
    let worst = worst.iter().take(BEST).filter(|(_, share)| *share > 0.0);
    let worst: Vec<String> =
        worst.map(|(id, share)| format!("{id} in {:.0} % of the cells", 100.0 * share)).collect();
    if !worst.is_empty() {
        say.line("overturns", format!("most often {}", worst.join(", ")));
    }
}

/// A cell in words: where it is, and what it does against the limits.
fn one(envelope: &Envelope, cell: usize) -> String {
    let grid: &Grid = &envelope.sweep.grid;
    let coordinates: Vec<f64> = grid.coordinates(cell).collect();
    let at = grid
        .told()
        .into_iter()
        .map(|place| grid.axes()[place].entry().written(rounded(coordinates[place], 4)));
    let at: Vec<String> = at.collect();
    let at = if at.is_empty() { "the block".to_string() } else { at.join(", ") };
    let CellEnvelope { standing, max_u, stroke_v, .. } = envelope.cells[cell];
    let limit = |limit: Option<f64>| limit.map_or(String::new(), |limit| format!(" of {limit} m"));
    let mut text = format!("{at}: stands under {:.1} %", 100.0 * standing);
    // The strokes of those that overturn it do not count.
    let of = if standing < 1.0 { ", of these " } else { ", " };
    let moves = envelope.sweep.scene.isolation;
    if moves.moves_h() {
        text += &format!("{of}|u| up to {:.3} m{}", max_u[2], limit(envelope.limits.u));
    }
    if moves.moves_v() {
        let of = if moves.moves_h() { ", " } else { of };
        text += &format!("{of}stroke of v up to {:.3} m{}", stroke_v[2], limit(envelope.limits.v));
    }
    if envelope.cells[cell].feasible && envelope.is_alone(cell) {
        text += "; no cell beside it is feasible";
    }
    text
}
