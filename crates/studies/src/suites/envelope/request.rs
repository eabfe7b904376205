//! What is asked of an envelope.

use super::{Best, Envelope, EnvelopeSettings, Limits, table};
use crate::statistics::Bootstrap;
use crate::study::{StudyError, StudyJob, StudyRequest, StudyTable};
use crate::suites::columns::check_further;
use crate::suites::request::SuiteRequest;
use crate::suites::resample::{Groups, Resample};
use crate::suites::wanted::WantedMotion;
use crate::suites::{Falling, Suite};
use crate::uncertain::{SAMPLES, Varied, check_samples, checked_points};
use topple::results::columns::Column;
use topple::scene::Parameter;

/// A scene whose envelope under a suite is requested.
///
/// ```no_run
/// use topple::{Parameter, Range, SceneBuilder, Unwatched};
/// use topple_studies::{EnvelopeRequest, Limits, StudyRequest, Suite, SuiteRequest};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let suite = Suite::read("records".as_ref(), false)?;
/// let scene = SceneBuilder::object(1)
///     .with(Parameter::UY, 0.01)
///     .with(Parameter::TH, Range::even(1.0, 4.0, 31))
///     .with(Parameter::TV, Range::even(0.1, 1.0, 19));
/// let limits = Limits { standing: 1.0, u: Some(0.3), v: Some(0.05) };
/// let request = EnvelopeRequest::new(SuiteRequest::new(scene), limits);
/// let envelope = request.open(&suite)?.run(&Unwatched)?;
/// if let Some(cell) = envelope.best().first() {
///     println!("cell {cell}: |u| up to {} m", envelope.cells[*cell].max_u[2]);
/// }
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone)]
pub struct EnvelopeRequest {
    /// The scene, its motions, and how they are run.
    pub suite: SuiteRequest,
    /// The limits that a base must keep.
    pub limits: Limits,
    /// Which of the feasible cells is called the best.
    pub best: Best,
    /// Columns of a map whose percentiles are also given.
    pub columns: Vec<Column>,
    /// What is resampled for the intervals; by default events if there are enough, else recordings.
    pub resample: Option<Resample>,
    /// Numbers that are not known: shares are of the motions at all their points.
    pub vary: Vec<Varied>,
    /// Points of these.
    pub samples: u32,
    /// Seed of what is drawn: of the sets of records, and of the points.
    pub seed: u32,
}

impl EnvelopeRequest {
    /// The envelope of a scene in which all is known.
    pub fn new(suite: SuiteRequest, limits: Limits) -> EnvelopeRequest {
        EnvelopeRequest {
            suite,
            limits,
            best: Best::default(),
            columns: Vec::new(),
            resample: None,
            vary: Vec::new(),
            samples: SAMPLES,
            seed: 1,
        }
    }
}

impl StudyRequest for EnvelopeRequest {
    type Study = Envelope;

    fn check(&self) -> Result<(), StudyError> {
        check_samples(self.samples)?;
        check_further(&self.columns)?;
        self.suite.check()?;
        Ok(self.suite.check_envelope(&self.limits)?)
    }

    fn open(&self, suite: &Suite) -> Result<StudyJob<Envelope>, StudyError> {
        self.check()?;
        let mut motions = self.suite.motions(suite)?;
        let directions = if self.suite.both_directions { 2 } else { 1 };
        let groups = Groups::of(suite, directions, self.resample)?;
        let mut times = 1;
        if let (Some(first), false) = (motions.first(), self.vary.is_empty()) {
            let scene = first.under(&self.suite.scene)?;
            let how_many = (self.samples as usize, self.seed);
            let points = checked_points(&scene, &self.vary, how_many, self.suite.scene.force)?;
            let parameters: Vec<Parameter> = self.vary.iter().map(|one| one.parameter).collect();
            times = points.len();
            motions = WantedMotion::spread(&motions, &parameters, points.iter());
        }
        let mut request = self.suite.clone();
        request.settings.others.clone_from(&self.columns);
        let sweep = request.open_under(motions)?;
        let replicates = Bootstrap::usual(sweep.grid.len());
        let bootstrap = Bootstrap { replicates, seed: self.seed.into() };
        let intervals = Some((groups, bootstrap));
        let columns = self.columns.clone();
        let (limits, best, varied) = (self.limits, self.best, self.vary.clone());
        // Numbers that are not known change no motion.
        let down = sweep.downward().into_iter().step_by(times).flatten();
        let falling = Falling::of(down.map(|down| (1.0, down)));
        let settings =
            EnvelopeSettings { limits, best, times, varied, intervals, columns, falling };
        let scenes = vec![sweep.scene.clone()];
        Ok(StudyJob { sweep, settings, times, scenes })
    }

    fn tables(&self) -> Vec<StudyTable<Envelope>> {
        vec![("envelope.csv", table::envelope), ("zeta.csv", table::zeta)]
    }
}
