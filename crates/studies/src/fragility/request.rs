//! What is asked of a fragility: limit states, levels, estimators, and what is not known.

use super::estimate::Estimator;
use super::export::Export;
use super::hazard::HazardCurve;
use super::levels;
use super::limit_state::LimitState;
use super::sensitivity::Unknown;
use super::study::{FragilityStudy, StudySettings};
use super::tables;
use crate::statistics::Bootstrap;
use crate::statistics::bca::FEWEST;
use crate::statistics::bootstrap::MANY;
use crate::study::{StudyError, StudyExport, StudyJob, StudyRequest, StudyTable};
use crate::suites::intensity::Intensity;
use crate::suites::request::{SuiteRequest, above_zero};
use crate::suites::swept::{MOST_CELLS, MOST_SWEEPS};
use crate::suites::wanted::WantedMotion;
use crate::suites::{Falling, Groups, Resample, Suite};
use crate::uncertain::{Ensemble, SAMPLES, Varied, check_samples};
use topple::Written;
use topple::scene::parameters::Section;
use topple::scene::{Parameter, Scene, SceneError, Values};

/// A scene whose fragility under a suite is requested.
///
/// ```no_run
/// use topple::{Parameter, Range, SceneBuilder, Unwatched};
/// use topple_studies::{FragilityRequest, StudyRequest, Suite, SuiteRequest};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let suite = Suite::read("records".as_ref(), false)?;
/// let scene = SceneBuilder::object(1)
///     .with(Parameter::UY, 0.01)
///     .with(Parameter::TH, 2.0)
///     .with(Parameter::TV, 0.5);
/// // Every motion at eight levels of PGA, m/s^2.
/// let levels = Some(Range::even(2.0, 16.0, 8).into());
/// let request = FragilityRequest { levels, ..FragilityRequest::new(SuiteRequest::new(scene)) };
/// let study = request.open(&suite)?.run(&Unwatched)?;
/// let overturning = &study.cells[0].states[0].estimates[0];
/// println!("median {:?} m/s^2, beta {:?}", overturning.theta, overturning.beta);
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone)]
pub struct FragilityRequest {
    /// The scene, its motions, and how they are run.
    pub suite: SuiteRequest,
    /// The measure of the fragility.
    pub im: Intensity,
    /// Levels of it, in SI units, that each motion is scaled to; each motion as it is without them.
    pub levels: Option<Values>,
    /// Limits of the rocking index.
    pub limit_zeta: Vec<f64>,
    /// Limits of max |u|, m.
    pub limit_u: Vec<f64>,
    /// Limits of the stroke of v, m.
    pub limit_v: Vec<f64>,
    /// Estimators; all that the levels allow where none is named.
    pub estimators: Vec<Estimator>,
    /// What is resampled for the intervals; by default events if there are enough, else recordings.
    pub resample: Option<Resample>,
    /// The hazard of the site over the measure, where annual rates are wanted.
    pub hazard: Option<HazardCurve>,
    /// Sets that are drawn for the intervals; 1000 of a few cells and 100 of many without it.
    pub bootstrap: Option<u32>,
    /// Seed of what is drawn: of the sets of records, and of the points of numbers that are not known.
    pub seed: u32,
    /// Numbers that are not known.
    pub vary: Vec<Varied>,
    /// Points N that are drawn of k of these: N (k + 2) are run.
    pub samples: u32,
    /// The annual rate that is accepted, which those of the hazard are compared with.
    pub target: Option<f64>,
    /// Formats of other programs that the curves are also written in.
    pub exports: Vec<Export>,
}

/// Each run by itself, of a few cells.
pub const RUNS: &str = "runs.csv";
/// Most sets that are drawn.
const MOST_REPLICATES: u32 = 1_000_000;
/// Most limits of one kind.
const MOST_LIMITS: usize = 100;
/// Most estimates: cells, limit states and estimators, some 200 bytes each.
const MOST_ESTIMATES: usize = 1 << 24;

impl FragilityRequest {
    /// The fragility of overturning and of uplift over PGA, each motion as it is.
    pub fn new(suite: SuiteRequest) -> FragilityRequest {
        FragilityRequest {
            suite,
            im: Intensity::Pga,
            levels: None,
            limit_zeta: Vec::new(),
            limit_u: Vec::new(),
            limit_v: Vec::new(),
            estimators: Vec::new(),
            resample: None,
            hazard: None,
            bootstrap: None,
            seed: 1,
            vary: Vec::new(),
            samples: SAMPLES,
            target: None,
            exports: Vec::new(),
        }
    }
}

impl StudyRequest for FragilityRequest {
    type Study = FragilityStudy;

    fn check(&self) -> Result<(), StudyError> {
        let refused = |key, problem: String| Err(SceneError::new(key, problem).into());
        for (key, limits) in [
            ("limit_zeta", &self.limit_zeta),
            ("limit_u", &self.limit_u),
            ("limit_v", &self.limit_v),
        ] {
            if limits.len() > MOST_LIMITS {
                let problem = format!("{} limits are more than {MOST_LIMITS}", limits.len());
                return refused(key, problem);
            }
        }
        if let Some(Err(error)) = self.levels.as_ref().map(Values::check) {
            return refused("levels", error.to_string());
        }
        let numbers = &self.suite.scene.numbers;
        for scaling in [Parameter::Scale, Parameter::Pga] {
            if let (Some(values), key) = (numbers.get(scaling), scaling.key()) {
                if self.levels.is_some() {
                    let problem = "`levels` say how strong each motion is; leave one out";
                    return refused(key, problem.to_string());
                }
                if scaling == Parameter::Pga && values.count() > 1 {
                    let problem = "several peaks are levels; give them as `levels` of `im` pga";
                    return refused(key, problem.to_string());
                }
                let values: Vec<f64> = values.iter().collect();
                above_zero(key, &values)?;
            }
        }
        above_zero("limit_zeta", &self.limit_zeta)?;
        if let Some(limit) = self.limit_zeta.iter().find(|limit| **limit >= 1.0) {
            let problem =
                format!("{limit} is not below 1, the rocking index of a block that has overturned");
            return refused("limit_zeta", problem);
        }
        self.suite.check_limits(&self.limit_u, &self.limit_v)?;
        if let Some(sets) = self.bootstrap
            && !(FEWEST..=MOST_REPLICATES).contains(&sets)
        {
            return refused("bootstrap", format!("{sets} is not in {FEWEST} to {MOST_REPLICATES}"));
        }
        check_samples(self.samples)?;
        if self.levels.is_none() && self.estimators.contains(&Estimator::Ida) {
            let problem = "ida scales each motion up until it overturns; give `levels`";
            return refused("estimator", problem.to_string());
        }
        let other = self.estimators.iter().find(|one| **one != Estimator::Stripes);
        if let (false, Some(other)) = (self.vary.is_empty(), other) {
            let problem = format!("{} takes a number for known; `vary` has stripes", other.key());
            return refused("estimator", problem);
        }
        self.suite.check()?;
        above_zero("target", self.target.as_slice())?;
        Ok(self.exports.iter().try_for_each(|export| export.check(self.im))?)
    }

    fn open(&self, suite: &Suite) -> Result<StudyJob<FragilityStudy>, StudyError> {
        self.check()?;
        let (asked, factors) = self.with_factors();
        self.suite.check_scales(suite)?;
        let both = asked.both_directions;
        let mut motions = WantedMotion::of_suite(suite, &asked.scene.numbers, both);
        if let Some(factors) = factors {
            motions.iter_mut().for_each(|motion| motion.factors.clone_from(&factors));
        }
        self.check_runs(motions.len())?;
        let directions = if self.suite.both_directions { 2 } else { 1 };
        let groups = Groups::of(suite, directions, self.resample)?;
        let (mut own, mut unknown) = (Vec::new(), None);
        if let Some(first) = motions.first() {
            let scene = first.under(&asked.scene)?;
            own = self.scaled(&scene, &mut motions)?;
            unknown = self.unknown(&scene)?;
        }
        let (mut times, mut drawn) = (1, 1);
        if let Some(unknown) = &unknown {
            (times, drawn) = (unknown.points(), unknown.drawn());
            motions = unknown.spread(motions);
            own = own.into_iter().flat_map(|own| vec![own; times]).collect();
        }
        let sweep = asked.open_under(motions)?;
        let (states, estimators) = (self.limit_states(), self.estimators());
        let estimates = sweep.grid.len().saturating_mul(states.len() * estimators.len());
        if estimates > MOST_ESTIMATES {
            let problem = format!(
                "{estimates} estimates of all cells and limit states are more than {MOST_ESTIMATES}; give fewer points"
            );
            return Err(SceneError::new("estimator", problem).into());
        }
        let usual = Bootstrap::usual(sweep.grid.len());
        let bootstrap =
            Bootstrap { replicates: self.bootstrap.unwrap_or(usual), seed: self.seed.into() };
        let down = sweep.downward();
        // Numbers that are not known change no motion.
        let each = own.iter().zip(&down).step_by(times);
        let runs = each.flat_map(|(levels, down)| levels.iter().copied().zip(down.iter().copied()));
        let settings = StudySettings {
            im: self.im,
            falling: Falling::of(runs),
            levels: own,
            times,
            drawn,
            unknown,
            states,
            estimators,
            bootstrap,
            groups,
            hazard: self.hazard.clone(),
            target: self.target,
        };
        let scenes = vec![sweep.scene.clone()];
        Ok(StudyJob { sweep, settings, times, scenes })
    }

    fn tables(&self) -> Vec<StudyTable<FragilityStudy>> {
        let mut all: Vec<StudyTable<FragilityStudy>> =
            vec![("fragility.csv", tables::counts), ("fits.csv", tables::fits)];
        if self.vary.is_empty() {
            all.push(("capacities.csv", tables::capacities));
            all.push((RUNS, tables::runs));
        } else {
            all.push(("sensitivity.csv", tables::sensitivity));
            all.push(("points.csv", tables::points));
        }
        if self.hazard.is_some() {
            all.push(("rates.csv", tables::rates));
        }
        all
    }

    fn exports(&self) -> Vec<StudyExport<FragilityStudy>> {
        Export::ALL.iter().filter(|one| self.exports.contains(one)).map(Export::writer).collect()
    }

    fn has(&self, study: &FragilityStudy, file: &str) -> bool {
        match Export::ALL.iter().find(|export| export.file() == file) {
            Some(export) => !export.is_empty(study),
            None => file != RUNS || study.cells.len() <= MANY,
        }
    }
}

impl FragilityRequest {
    /// The limit states.
    pub fn limit_states(&self) -> Vec<LimitState> {
        let zeta = self.limit_zeta.iter().copied().map(LimitState::Zeta);
        let u = self.limit_u.iter().copied().map(LimitState::U);
        let v = self.limit_v.iter().copied().map(LimitState::V);
        let all = [LimitState::Overturning, LimitState::Uplift].into_iter().chain(zeta);
        once(all.chain(u).chain(v))
    }

    /// The estimators; the first is the one that is drawn.
    fn estimators(&self) -> Vec<Estimator> {
        match &self.estimators[..] {
            [] if !self.vary.is_empty() => vec![Estimator::Stripes],
            [] => {
                let all = Estimator::ALL.iter().copied();
                all.filter(|one| self.levels.is_some() || *one != Estimator::Ida).collect()
            }
            asked => once(asked.iter().copied()),
        }
    }

    /// The request of the suite, and the factors on its motions where the scene has several: they are no axis but levels of each
    /// motion, by what its own is.
    fn with_factors(&self) -> (SuiteRequest, Option<Vec<f64>>) {
        let mut asked = self.suite.clone();
        let scales = asked.scene.numbers.get(Parameter::Scale).filter(|scales| scales.count() > 1);
        let Some(mut factors) = scales.map(|scales| scales.iter().collect::<Vec<f64>>()) else {
            return (asked, None);
        };
        factors.sort_by(f64::total_cmp);
        asked.scene.numbers.remove(Parameter::Scale);
        (asked, Some(factors))
    }

    /// Refuses more runs of a cell than are held, under so many motions.
    fn check_runs(&self, motions: usize) -> Result<(), SceneError> {
        let scales = self.suite.scene.numbers.get(Parameter::Scale);
        let levels = self.levels.as_ref().or(scales).map_or(1, Values::count);
        let points = match self.vary.len() {
            0 => 1,
            varied => (self.samples as usize).saturating_mul(varied + 2),
        };
        let sweeps = motions.saturating_mul(points);
        let (key, runs, most) = match sweeps > MOST_SWEEPS {
            true => ("samples", sweeps, MOST_SWEEPS),
            false => ("levels", sweeps.saturating_mul(levels), MOST_CELLS),
        };
        if runs > most {
            let problem = format!("{runs} runs of each cell are more than {most}; give fewer");
            return Err(SceneError::new(key, problem));
        }
        Ok(())
    }

    /// Gives the motions their factors, and tells the levels of each.
    fn scaled(
        &self,
        scene: &Scene,
        motions: &mut [WantedMotion],
    ) -> Result<Vec<Vec<f64>>, SceneError> {
        let mut body = Parameter::of_section(Section::Block);
        let differs =
            |own| scene.swept().contains(&own) || self.vary.iter().any(|one| one.parameter == own);
        if self.im.is_of_block() && body.any(differs) {
            let problem = format!("{} is another measure for each block", self.im);
            return Err(SceneError::new("im", format!("{problem}; give pga or pgv")));
        }
        levels::scale(motions, self.im, self.levels.as_ref(), &scene.case().block)
    }

    /// The numbers that are not known, where there are any, each point of them checked.
    fn unknown(&self, scene: &Scene) -> Result<Option<Unknown>, SceneError> {
        if self.vary.is_empty() {
            return Ok(None);
        }
        let unknown = Unknown::of(self.vary.clone(), self.samples as usize, self.seed);
        let ensemble = Ensemble::of(scene, &self.vary, self.suite.scene.force)?;
        let points: Vec<Vec<f64>> = unknown.design.rows().cloned().collect();
        let _checked = ensemble.scenes(&points)?;
        Ok(Some(unknown))
    }
}

/// The same without what is there before.
fn once<T: PartialEq>(all: impl Iterator<Item = T>) -> Vec<T> {
    all.fold(Vec::new(), |mut kept, one| {
        if !kept.contains(&one) {
            kept.push(one);
        }
        kept
    })
}
