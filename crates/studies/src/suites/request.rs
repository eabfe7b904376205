//! What is asked of a suite: a scene under each of its motions, and how these are run.

use super::envelope::Limits;
use super::read::Suite;
use super::settings::SuiteSettings;
use super::swept::SuiteJob;
use super::wanted::WantedMotion;
use topple::scene::applies::{Choice, ShakenBy};
use topple::scene::excitation;
use topple::scene::record::RecordText;
use topple::scene::{Directions, Parameter, SceneBuilder, SceneError};
use topple::sweep::error::SweepError;

/// A scene under each motion of a suite.
#[derive(Debug, Clone)]
pub struct SuiteRequest {
    /// The scene, without an excitation of its own.
    pub scene: SceneBuilder,
    /// Each motion is taken twice, its horizontal component in both directions.
    pub both_directions: bool,
    /// How the sweeps are run, and where they are saved.
    pub settings: SuiteSettings,
}

/// Largest stroke of a base that is plausible, m.
const MOST_STROKE: f64 = 10.0;

impl SuiteRequest {
    /// A scene under each motion as it is, on the default settings.
    pub fn new(scene: SceneBuilder) -> SuiteRequest {
        SuiteRequest { scene, both_directions: false, settings: SuiteSettings::default() }
    }

    /// Checks what can be checked before a suite is read.
    ///
    /// # Errors
    /// The key `u_y`: a base whose yield displacement follows from a motion's peak is another device under each. The keys
    /// of a pulse, and of a record of the scene's own: the suite's motions shake the base. The key `friction`: no contact
    /// force is computed.
    pub fn check(&self) -> Result<(), SceneError> {
        let pulse = self.scene.numbers.excluded_by(Choice::Excitation(ShakenBy::Record));
        let key = match pulse {
            Some(own) => Some(own.entry().key),
            None if self.scene.shape.is_some() => Some("shape"),
            None => self.scene.record.as_ref().map(RecordText::first_key),
        };
        if let Some(key) = key {
            let problem = "the motions of the suite shake the base; leave it out";
            return Err(SceneError::new(key, problem));
        }
        if self.scene.numbers.has(Parameter::Friction) {
            let problem = "a friction is not judged under a suite; leave it out, and look at single motions with \
                           `topple seismic`";
            return Err(SceneError::new(Parameter::Friction.entry().key, problem));
        }
        let devices = [Parameter::UY, Parameter::YieldForce, Parameter::Qd, Parameter::Radius];
        let fixed = devices.iter().any(|own| self.scene.numbers.has(*own));
        if self.moves().moves_h() && !fixed && !self.scene.force {
            let problem = "missing; `alpha_y` makes another device of the base under each motion: give `u_y` or \
                           `yield_force` (`force` takes alpha_y all the same)";
            return Err(SceneError::new("u_y", problem));
        }
        Ok(())
    }

    /// Checks that the base has the strokes that are limited, and that they are plausible.
    ///
    /// # Errors
    /// The keys `limit_u` and `limit_v`.
    pub fn check_limits(&self, u: &[f64], v: &[f64]) -> Result<(), SceneError> {
        let moves = self.moves();
        for (key, limits, there) in
            [("limit_u", u, moves.moves_h()), ("limit_v", v, moves.moves_v())]
        {
            above_zero(key, limits)?;
            let large = limits.iter().find(|limit| **limit > MOST_STROKE);
            if let (Some(limit), false) = (large, self.scene.force) {
                let problem = format!(
                    "{limit} m is not plausible: metres are meant, not millimetres; `force` takes it"
                );
                return Err(SceneError::new(key, problem));
            }
            if !limits.is_empty() && !there {
                let problem = "the base does not move in this direction; leave it out";
                return Err(SceneError::new(key, problem));
            }
        }
        Ok(())
    }

    /// Checks the limits of an envelope.
    ///
    /// # Errors
    /// The keys `standing`, `limit_u` and `limit_v`.
    pub fn check_envelope(&self, limits: &Limits) -> Result<(), SceneError> {
        if !(limits.standing > 0.0 && limits.standing <= 1.0) {
            let problem = format!("{} must lie above 0 and at most at 1", limits.standing);
            return Err(SceneError::new("standing", problem));
        }
        self.check_limits(limits.u.as_slice(), limits.v.as_slice())
    }

    /// The motions of a suite that the scene is swept under.
    pub fn motions(&self, suite: &Suite) -> Result<Vec<WantedMotion>, SceneError> {
        self.check_scales(suite)?;
        Ok(WantedMotion::of_suite(suite, &self.scene.numbers, self.both_directions))
    }

    /// Refuses factors of the scene that make more of a motion than any ground has, unless that is forced.
    ///
    /// # Errors
    /// The key `scale`, with the first motion.
    pub fn check_scales(&self, suite: &Suite) -> Result<(), SceneError> {
        suite.motions().try_for_each(|(entry, motion)| {
            excitation::check_factors(&motion.pair, &self.scene.numbers, self.scene.force).map_err(
                |error| SceneError::new(error.key, format!("{}: {}", entry.id, error.problem)),
            )
        })
    }

    /// Makes it ready to run.
    ///
    /// # Errors
    /// Those of [`check`](SuiteRequest::check), numbers that make no sense, a backend that cannot be had.
    pub fn open(&self, suite: &Suite) -> Result<SuiteJob, SweepError> {
        self.open_under(self.motions(suite)?)
    }

    /// The same under the caller's own motions.
    pub fn open_under(&self, motions: Vec<WantedMotion>) -> Result<SuiteJob, SweepError> {
        self.check()?;
        SuiteJob::open(&self.scene, motions, self.settings.clone())
    }

    /// Directions in which the base moves.
    fn moves(&self) -> Directions {
        self.scene.isolation.unwrap_or(Directions::Dual)
    }
}

/// Refuses limits that nothing can keep.
///
/// # Errors
/// The key, with the limit at fault.
pub fn above_zero(key: &'static str, limits: &[f64]) -> Result<(), SceneError> {
    match limits.iter().find(|limit| !(limit.is_finite() && **limit > 0.0)) {
        Some(limit) => Err(SceneError::new(key, format!("{limit} must be a positive number"))),
        None => Ok(()),
    }
}
