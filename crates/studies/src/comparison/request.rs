//! What is asked of a comparison, and the one sweep that answers it.

use super::compared::Comparison;
use super::devices::Device;
use super::settings::ComparisonSettings;
use super::shaken::Shaken;
use super::table::compared;
use crate::fragility::HazardCurve;
use crate::fragility::levels;
use crate::statistics::Bootstrap;
use crate::study::{StudyError, StudyJob, StudyRequest, StudyTable};
use crate::suites::columns::check_further;
use crate::suites::envelope::Limits;
use crate::suites::intensity::Intensity;
use crate::suites::request::{SuiteRequest, above_zero};
use crate::suites::settings::SuiteSettings;
use crate::suites::swept::SuiteJob;
use crate::suites::{Falling, Groups, Resample, Suite};
use topple::results::columns::Column;
use topple::scene::{Grid, Parameter, SceneError, Values};

/// Devices that are to be compared under a suite.
#[derive(Debug, Clone)]
pub struct ComparisonRequest {
    /// The devices.
    pub devices: Vec<Device>,
    /// Which motions each is swept under, and how; its scene is what all devices share.
    pub suite: SuiteRequest,
    /// The limits that each must keep.
    pub limits: Limits,
    /// Factors on the motions for the reserve.
    pub scales: Option<Values>,
    /// Columns of a map whose percentiles are told, too.
    pub columns: Vec<Column>,
    /// The site of which annual rates are told.
    pub rate: Option<RateRequest>,
    /// What is resampled for the intervals; by default events if there are enough, else recordings.
    pub resample: Option<Resample>,
    /// Seed of the sets that are drawn.
    pub seed: u32,
}

/// A site, and the levels that each motion is scaled to for its annual rates.
#[derive(Debug, Clone)]
pub struct RateRequest {
    /// The measure of the hazard.
    pub im: Intensity,
    /// Levels of it; each motion as it is without them.
    pub levels: Option<Values>,
    /// The hazard over it.
    pub hazard: HazardCurve,
}

impl ComparisonRequest {
    /// The comparison of devices within limits.
    pub fn new(devices: Vec<Device>, suite: SuiteRequest, limits: Limits) -> ComparisonRequest {
        ComparisonRequest {
            devices,
            suite,
            limits,
            scales: None,
            columns: Vec::new(),
            rate: None,
            resample: None,
            seed: 1,
        }
    }

    /// A device in the place of the scene of all.
    fn of(&self, device: &Device) -> SuiteRequest {
        let mut scene = device.scene.clone();
        scene.force = self.suite.scene.force;
        SuiteRequest { scene, ..self.suite.clone() }
    }
}

impl StudyRequest for ComparisonRequest {
    type Study = Comparison;

    fn check(&self) -> Result<(), StudyError> {
        let refused = |key, problem: String| Err(SceneError::new(key, problem).into());
        if let Some(Err(error)) = self.scales.as_ref().map(Values::check) {
            return refused("scales", error.to_string());
        }
        let scales: Vec<f64> = self.scales.iter().flat_map(Values::iter).collect();
        above_zero("scales", &scales)?;
        check_further(&self.columns)?;
        let standing = Limits { u: None, v: None, ..self.limits };
        for device in &self.devices {
            let of = self.of(device);
            of.check().map_err(|error| device.refused(&error))?;
            of.check_envelope(&standing)?;
        }
        // A limit means something where one device moves in its direction.
        for (u, v) in [(self.limits.u, None), (None, self.limits.v)] {
            let check = |device| self.of(device).check_limits(u.as_slice(), v.as_slice());
            let checked: Vec<_> = self.devices.iter().map(check).collect();
            if let (false, Some(Err(error))) =
                (checked.iter().any(Result::is_ok), checked.into_iter().next())
            {
                return Err(error.into());
            }
        }
        Ok(())
    }

    fn open(&self, suite: &Suite) -> Result<StudyJob<Comparison>, StudyError> {
        self.check()?;
        let directions = if self.suite.both_directions { 2 } else { 1 };
        let groups = Groups::of(suite, directions, self.resample)?;
        let mut scales: Vec<f64> = self.scales.iter().flat_map(Values::iter).collect();
        scales.sort_by(f64::total_cmp);
        let requests: Vec<SuiteRequest> =
            self.devices.iter().map(|device| self.of(device)).collect();
        let (mut all, mut shaken) = (Vec::with_capacity(requests.len()), Vec::new());
        for (device, request) in self.devices.iter().zip(&requests) {
            let motions = request.motions(suite);
            let mut motions = motions.map_err(|error| device.refused(&error))?;
            if let Some(first) = motions.first() {
                let scene = first.under(&request.scene).map_err(|error| device.refused(&error))?;
                if let Some(axis) = Grid::of(&scene).axes().iter().find(|axis| axis.count() > 1) {
                    let problem =
                        "has several values; a device has one: give each a line of the list";
                    return Err(device.refused(&SceneError::new(axis.key(), problem)).into());
                }
                let levels = match &self.rate {
                    None => vec![Vec::new(); motions.len()],
                    Some(RateRequest { im, levels, .. }) => {
                        let block = &scene.case().block;
                        levels::scale(&mut motions, *im, levels.as_ref(), block)?
                    }
                };
                for (motion, levels) in motions.iter_mut().zip(levels) {
                    let own = if levels.is_empty() { Vec::new() } else { motion.factors.clone() };
                    shaken.push(Shaken::of(motion, &scales, own, levels));
                    motion.id = format!("{} under {}", device.name, motion.id);
                }
            }
            all.push((&request.scene, motions));
        }
        let mut others = self.columns.clone();
        let has_stop = |device: &Device| device.scene.numbers.has(Parameter::StopGap);
        let stops = self.devices.iter().any(has_stop).then_some(Column::StopHits);
        for column in stops.into_iter().chain([Column::MinContact]) {
            if !others.contains(&column) {
                others.push(column);
            }
        }
        let settings = SuiteSettings { others: others.clone(), ..self.suite.settings.clone() };
        let sweep = SuiteJob::of_scenes(all, settings)?;
        let settings = ComparisonSettings {
            devices: self.devices.clone(),
            limits: self.limits,
            columns: self.columns.clone(),
            others,
            hazard: self.rate.as_ref().map(|rate| rate.hazard.clone()),
            groups,
            bootstrap: Bootstrap { replicates: Bootstrap::usual(1), seed: self.seed.into() },
            scenes: sweep.scenes(self.devices.len()),
            falling: falling(&sweep, (&shaken, self.devices.len()), &scales),
            scales,
            shaken,
        };
        let scenes = settings.scenes.clone();
        Ok(StudyJob { sweep, settings, times: self.devices.len(), scenes })
    }

    fn tables(&self) -> Vec<StudyTable<Comparison>> {
        vec![("compare.csv", compared)]
    }
}

/// The levels of the hazard's measure, and the factors of the reserve, at which the ground accelerates downwards by more than g.
fn falling(
    sweep: &SuiteJob,
    (shaken, devices): (&[Shaken], usize),
    scales: &[f64],
) -> [Option<Falling>; 2] {
    let down = sweep.downward();
    // The motions of all devices are the same.
    let each = shaken.iter().zip(&down).take(shaken.len() / devices.max(1));
    let levels = each.clone().flat_map(|(shaken, down)| {
        shaken.levels.iter().filter_map(|(at, level)| Some((*level, *down.get(*at)?)))
    });
    let scales = each.flat_map(|(shaken, down)| {
        let factors = scales.iter().zip(&shaken.scales);
        factors.filter_map(|(scale, at)| Some((*scale, *down.get(*at)?)))
    });
    [Falling::of(levels), Falling::of(scales)]
}
