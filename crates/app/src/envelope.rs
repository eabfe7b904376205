//! `topple envelope`.

use topple::results::earlier::Kind;
use topple::scene::Grid;
use topple::scene::record::rounded;
use topple_manifest::{Run, Site, StudyRun};
use topple_pictures::drawing::error::FigureError;
use topple_pictures::drawing::picture::Picture;
use topple_pictures::drawing::print::Print;
use topple_pictures::drawing::share::percent;
use topple_pictures::studies::{envelope as picture, envelope_curves};
use topple_studies::fragility::HazardText;
use topple_studies::suites::SuiteRequest;
use topple_studies::suites::envelope::{Best, CellEnvelope, Envelope, EnvelopeRequest};
use topple_studies::suites::swept_motion::Values;
use topple_studies::uncertain::{SAMPLES, Varied};

use super::inputs::InputReader;
use super::study::{StudyFlags, warn_of_radius};
use super::study_flags::{FurtherFlags, IntervalFlags, LimitFlags, names, unknown};
use super::study_words::{FALLS, LEAVES, between, digits, warn_of_few};
use super::words::{self, Reporter, counted};
use super::written::one_of;
use super::{InputError, examples};

/// Sweep a scene under every motion of a suite: find the cells in which the block stands within given strokes.
#[derive(clap::Args)]
#[command(after_help = examples::ENVELOPE)]
pub struct EnvelopeFlags {
    #[command(flatten)]
    limits: LimitFlags,
    /// Which feasible cell is the best one: that with the largest reserve (steps of the grid to the nearest cell that fails), or with
    /// the least stroke_u or stroke_v
    #[arg(long, value_name = "WHICH", default_value_t = Best::Reserve, help_heading = "Suite", value_parser = one_of::<Best>())]
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
}

/// The name of the picture.
const PICTURE: &str = "envelope";

/// Best cells that are printed.
const BEST: usize = 3;

impl StudyFlags for EnvelopeFlags {
    type Request = EnvelopeRequest;
    type Record = topple_manifest::Envelope;

    const KIND: Kind = Kind::Envelope;
    const RUN: fn(Box<StudyRun<Self::Record>>) -> Run = Run::Envelope;
    const TITLE: Option<&'static str> = Some("Envelope");

    fn request(
        &self,
        suite: SuiteRequest,
        _: Option<&HazardText>,
        _: &mut InputReader,
    ) -> Result<EnvelopeRequest, InputError> {
        Ok(EnvelopeRequest {
            best: self.best,
            columns: self.further.columns(),
            resample: self.intervals.resample,
            vary: self.vary.clone(),
            samples: self.samples,
            seed: self.intervals.seed,
            ..EnvelopeRequest::new(suite, self.limits.limits())
        })
    }

    fn pictures(&self, _: &EnvelopeRequest) -> Vec<String> {
        vec![PICTURE.into()]
    }

    fn varied(&self) -> &[Varied] {
        &self.vary
    }

    fn draw(
        &self,
        envelope: &Envelope,
        print: Print,
    ) -> Result<Vec<(String, Picture)>, FigureError> {
        let title = format!("Envelope of {} motions", envelope.records());
        let drawn = match envelope.sweep.grid.line() {
            Some(axis) => Some(envelope_curves::draw(envelope, axis, &title, print)),
            None => picture::draw(envelope, &title, print)?,
        };
        Ok(drawn.map(|drawn| (PICTURE.to_string(), drawn)).into_iter().collect())
    }

    fn warn(&self, envelope: &Envelope) {
        let groups = envelope.settings.intervals.as_ref().map(|(groups, _)| groups);
        groups.into_iter().for_each(warn_of_few);
        if let Some(of) = envelope.settings.falling {
            let (some, all) = (of.runs, counted(of.of_runs, "motion"));
            words::warn(format!("under {some} of {all} {FALLS}: {LEAVES}"));
        }
        warn_of_radius(&envelope.sweep);
    }

    fn record(&self, envelope: &Envelope, _: Site) -> Self::Record {
        let best = envelope.best();
        let intervals = envelope.settings.intervals.as_ref();
        Self::Record {
            limits: self.limits.limits(),
            best: self.best,
            feasible: best.len(),
            best_cell: best.first().copied(),
            columns: names(&envelope.settings.columns),
            drawn: self.intervals.record(intervals.map(|(groups, bootstrap)| (groups, bootstrap))),
            unknown: unknown(&self.vary, self.samples),
        }
    }

    fn tell(&self, envelope: &Envelope, say: &Reporter) {
        tell(envelope, &envelope.best(), say);
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
