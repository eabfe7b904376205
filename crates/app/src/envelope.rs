//! `topple envelope`.

use serde::Serialize;
use topple::results::earlier::Kind;
use topple::scene::Grid;
use topple::scene::record::rounded;
use topple_pictures::drawing::share::percent;
use topple_pictures::studies::{envelope as envelope_picture, envelope_curves};
use topple_studies::suites::envelope::{
    self, Best, CellEnvelope, Envelope, EnvelopeJob, EnvelopeRequest,
};
use topple_studies::suites::swept_motion::Values;
use topple_studies::suites::verified::Verified;
use topple_studies::suites::{Falling, Resample};
use topple_studies::uncertain::{SAMPLES, Varied};

use super::errors::sweep_error;
use super::fragility_words::{FALLS, LEAVES, warn_of_few};
use super::further::FurtherFlags;
use super::limits::{IntervalFlags, LimitFlags};
use super::named::best;
use super::numbers::RecordNumbers;
use super::options::{CommonFlags, RunOptions, flag_error};
use super::results_directory::{Place, picture_files};
use super::suite_run::{self, SuiteFlags, SuiteManifest, Times};
use super::words::{self, Reporter, counted};
use super::{InputError, examples, further, suite};

/// Sweep a scene under every motion of a suite: find the cells in which the block stands within given strokes.
#[derive(clap::Args)]
#[command(after_help = examples::ENVELOPE)]
pub struct EnvelopeCommand {
    #[command(flatten)]
    common: CommonFlags,
    #[command(flatten)]
    record: RecordNumbers,
    #[command(flatten)]
    pub motions: SuiteFlags,
    #[command(flatten)]
    limits: LimitFlags,
    /// Which feasible cell is the best one: that with the largest reserve (steps of the grid to the nearest cell that fails), or with
    /// the least stroke_u or stroke_v
    #[arg(long, value_name = "WHICH", default_value_t = Best::Reserve, help_heading = "Suite", value_parser = best)]
    best: Best,
    #[command(flatten)]
    further: FurtherFlags,
    #[command(flatten)]
    intervals: IntervalFlags,
    /// Distribution of a number that is not known: KEY=normal(MEAN,DEVIATION), uniform(LOW,HIGH) or lognormal(MEDIAN,BETA); two more
    /// numbers LOW,HIGH cut it off. Shares are of the motions at all of its points
    #[arg(long, value_name = "KEY=DIST", help_heading = "Uncertainty")]
    vary: Vec<Varied>,
    /// Number of points of the distributions, best a power of two
    #[arg(long, value_name = "N", default_value_t = SAMPLES, help_heading = "Uncertainty", requires = "vary")]
    samples: u32,
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
    best: Best,
    feasible: usize,
    /// The best cell: its axes and its results; none if no cell is feasible.
    best_cell: Option<usize>,
    columns: Vec<&'static str>,
    resample: Option<Resample>,
    groups: Option<usize>,
    seed: u32,
    vary: &'a [Varied],
    samples: Option<u32>,
    /// The reference's results for a sample.
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
        let print = options.pictures.print().map_err(InputError)?;
        let place = Place::of(&options.out, Kind::Envelope)?;
        let text = self.common.text(Some("Envelope"), self.record.placed());
        let limits = self.limits.limits();
        let request = EnvelopeRequest {
            best: self.best,
            columns: self.further.columns(),
            resample: self.intervals.resample,
            vary: self.vary.clone(),
            samples: self.samples,
            seed: self.intervals.seed,
            ..EnvelopeRequest::new(self.motions.request(&self.common, options, text)?, limits)
        };
        request.check().map_err(|error| flag_error(&error))?;
        let names = [TABLE, ZETA].map(String::from).into_iter().chain(picture_files(PICTURE));
        self.motions.refuse_foreign(&place, &names.collect::<Vec<_>>())?;
        let suite = self.motions.read()?;
        let say = Reporter::unless(options.quiet);
        let EnvelopeJob { sweep, settings } = request.open(&suite).map_err(sweep_error)?;
        let down = sweep.downward();
        self.motions.refuse_others(&sweep, options)?;
        suite::count(&suite, &say);
        self.vary.iter().for_each(|varied| say.line("varies", varied));
        self.motions.tell_of_scene(std::slice::from_ref(&sweep.scene), &say);
        suite_run::tell_of_base(&sweep, options)?;
        let times = Times::points(settings.times);
        let Some(swept) = self.motions.run(sweep, times, options, &say)? else {
            return Ok(());
        };
        let mut out = place.open()?;
        let mut envelope = Envelope::of(swept, settings);
        let swept = &envelope.sweep;
        let title = format!("Envelope of {} motions", envelope.records());
        let mut files = [TABLE, ZETA].map(String::from).to_vec();
        let drawn = match swept.grid.line() {
            Some(axis) => Some(envelope_curves::draw(&envelope, axis, &title, print)),
            None => envelope_picture::draw(&envelope, &title, print)?,
        };
        if drawn.is_some() {
            files.extend(picture_files(PICTURE));
        }
        out.begin(files, &say)?;
        out.write(TABLE, |w| envelope::write(&envelope, w))?;
        out.write(ZETA, |w| envelope::write_zeta(&envelope, w))?;
        if let Some(drawn) = &drawn {
            out.picture(PICTURE, drawn, &drawn.png()?)?;
        }
        let best = envelope.best();
        let groups = envelope.settings.intervals.as_ref().map(|(groups, _)| groups);
        groups.into_iter().for_each(warn_of_few);
        warn_of_falling(down.iter().step_by(envelope.settings.times.max(1)).flatten());
        suite_run::warn_of_radius(swept);
        let manifest = Manifest {
            suite: self.motions.manifest(swept, (&suite, options)),
            standing: limits.standing,
            limit_u: limits.u,
            limit_v: limits.v,
            best: self.best,
            feasible: best.len(),
            best_cell: best.first().copied(),
            columns: further::names(&envelope.settings.columns),
            resample: groups.map(|groups| groups.by),
            groups: groups.map(|groups| groups.count),
            seed: self.intervals.seed,
            vary: &self.vary,
            samples: (!self.vary.is_empty()).then_some(self.samples),
            verified: &swept.verified,
        };
        out.finish(&manifest)?;
        tell(&envelope, &best, &say);
        suite_run::tell_verified(swept, &say);
        envelope.sweep.discard_saved()?;
        if drawn.is_some() {
            let [_, png] = picture_files(PICTURE);
            say.line("picture", out.file(&png).display());
        }
        say.line("table", format!("{} with run.json", out.file(TABLE).display()));
        Ok(())
    }
}

/// Warns of motions under which the ground accelerates downwards by more than g.
fn warn_of_falling<'a>(down: impl Iterator<Item = &'a f64>) {
    if let Some(of) = Falling::of(down.map(|down| (1.0, *down))) {
        let (some, all) = (of.runs, counted(of.of_runs, "motion"));
        words::warn(format!("under {some} of {all} {FALLS}: {LEAVES}"));
    }
}

/// Says which cells keep the limits, how far these are, and which motions govern.
fn tell(envelope: &Envelope, best: &[usize], say: &Reporter) {
    let cells = envelope.cells.len();
    let share = percent(best.len() as f64 / cells.max(1) as f64);
    say.line("feasible", format!("{} of {cells} cells, {share}", best.len()));
    if let Some(first) = best.first().filter(|_| cells > 1) {
        let by = envelope.settings.best;
        say.line("best", format!("by {by} (--best): {}", by.words()));
        if let [_, ..] = &envelope.at_ends(*first)[..] {
            let axes = envelope.at_ends(*first).join(" and ");
            say.line(
                "",
                format!("the first lies at the end of {axes}: a larger grid may have a better one"),
            );
        }
    }
    for (number, cell) in best.iter().take(BEST).enumerate() {
        let name = if number == 0 && cells == 1 { "best" } else { "" };
        say.line(name, one(envelope, *cell));
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
    if let Some(cell) = best.first().copied().or(envelope.nearest()) {
        say.line("likely", likely(envelope, cell));
    }
    let worst = envelope.worst();
    let worst = worst.iter().take(BEST).filter(|(_, share)| *share > 0.0);
    let worst: Vec<String> =
        worst.map(|(id, share)| format!("{id} in {} of the cells", percent(*share))).collect();
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
    let mut text = format!("{at}: stands under {}", percent(standing));
    // The strokes of those that overturn it do not count.
    let of = if standing < 1.0 { ", of these " } else { ", " };
    let moves = envelope.sweep.scene.isolation;
    // Nothing is known of strokes where the block stands under no motion.
    let stands = standing > 0.0;
    if stands && moves.moves_h() {
        text += &format!("{of}|u| up to {:.3} m{}", max_u[2], limit(envelope.settings.limits.u));
    }
    if stands && moves.moves_v() {
        let of = if moves.moves_h() { ", " } else { of };
        text += &format!(
            "{of}stroke of v up to {:.3} m{}",
            stroke_v[2],
            limit(envelope.settings.limits.v)
        );
    }
    if envelope.cells[cell].feasible && envelope.cells.len() > 1 {
        text += &match envelope.cells[cell].reserve {
            _ if envelope.is_alone(cell) => "; no cell beside it is feasible".to_string(),
            Some(1) => ", 1 step from a cell that fails".to_string(),
            Some(steps) => format!(", {steps} steps from a cell that fails"),
            None => String::new(),
        };
    }
    text
}

/// How likely the block of a cell overturns, in words.
fn likely(envelope: &Envelope, cell: usize) -> String {
    let CellEnvelope { overturned, overturned_within, .. } = envelope.cells[cell];
    let place = if envelope.cells.len() > 1 { "there overturning" } else { "overturning" };
    let within = between(overturned_within);
    let mut text = format!("{place} has P = {}{within}", digits(overturned));
    text += &format!(" under {}", counted(envelope.records(), "motion"));
    if envelope.settings.times > 1 {
        text += &format!(" and {} sets of what is not known", envelope.settings.times);
    }
    if let Some((groups, _)) = &envelope.settings.intervals {
        text += &format!("; 95 %, by {}, {} of them", groups.by, groups.count);
    }
    text
}

/// A share in words.
pub fn digits(share: f64) -> String {
    rounded(share, 3).to_string()
}

/// The interval of a share, behind it.
pub fn between(within: [Option<f64>; 2]) -> String {
    match within {
        [Some(low), Some(high)] => format!(" ({} to {})", digits(low), digits(high)),
        _ => String::new(),
    }
}
