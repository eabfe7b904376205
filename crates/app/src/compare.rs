//! `topple compare`.

use std::path::PathBuf;

use topple::results::earlier::Kind;
use topple::scene::path_text::PathText;
use topple::scene::record::text::decoded;
use topple::scene::{Grid, Parameter, Scene, SceneBuilder, Values};
use topple_manifest::{DeviceRun, Run, Site, StudyRun};
use topple_pictures::drawing::error::FigureError;
use topple_pictures::drawing::picture::Picture;
use topple_pictures::drawing::print::Print;
use topple_pictures::studies::comparison as picture;
use topple_studies::comparison::{
    Comparison, ComparisonRequest, ComparisonSettings, Device, RateRequest, devices,
};
use topple_studies::fragility::HazardText;
use topple_studies::suites::SuiteRequest;
use topple_studies::suites::intensity::Intensity;
use topple_studies::{StudyError, StudyJob, TableError, row_in_comment};

use super::errors::sweep_error;
use super::inputs::{self, InputReader};
use super::options::{RunOptions, flag_error};
use super::study::StudyFlags;
use super::study_flags::{FurtherFlags, HazardFlags, IntervalFlags, LimitFlags, RateFlags, names};
use super::suite_run;
use super::words::{self, Reporter, counted, with_flags};
use super::{InputError, compare_words, device_remarks, examples};

/// Compare the devices of a list under every motion of a suite, side by side.
#[derive(clap::Args)]
// A device has one cell: there are no axes of a picture.
#[command(after_help = examples::COMPARE, mut_args(|flag| suite_run::without(flag, &["x", "y"])))]
pub struct CompareFlags {
    /// List of devices (CSV)
    #[arg(value_name = "DEVICES")]
    devices: PathBuf,
    #[command(flatten)]
    limits: LimitFlags,
    /// Factors on the motions for the reserve: the largest of them, and of 1, up to which all limits are kept; it is as exact as they are close
    #[arg(long, value_name = "FACTORS", help_heading = "Suite", allow_hyphen_values = true)]
    scales: Option<Values>,
    #[command(flatten)]
    further: FurtherFlags,
    #[command(flatten)]
    intervals: IntervalFlags,
    #[command(flatten)]
    hazard: HazardFlags,
    /// With --hazard: the intensity measure of the hazard curve, of the horizontal component: pga, pgv, arias, cav, sa:T, avg-sa:T (T in s), or 'pga*',
    /// 'pgv*' (in quotes for a shell) relative to the block [default: pga]
    #[arg(long, value_name = "MEASURE", help_heading = "Fragility", requires = "hazard")]
    im: Option<Intensity>,
    /// With --hazard: levels of the measure to which each motion is scaled, in SI units [default: each motion as it is]
    #[arg(
        long,
        value_name = "LEVELS",
        help_heading = "Fragility",
        requires = "hazard",
        allow_hyphen_values = true
    )]
    levels: Option<Values>,
}

/// The name of the picture.
const PICTURE: &str = "compare";
/// What to do about a list that cannot be read.
const READABLE: &str = "give a list of devices (CSV) that can be read";
/// Largest list that is read, bytes.
const LARGEST: u64 = 1 << 20;

impl StudyFlags for CompareFlags {
    type Request = ComparisonRequest;
    type Record = topple_manifest::Comparison;

    const KIND: Kind = Kind::Comparison;
    const RUN: fn(Box<StudyRun<Self::Record>>) -> Run = Run::Comparison;
    const TITLE: Option<&'static str> = None;
    const TIMES: &'static str = "devices";

    fn files(&mut self) -> Vec<(&'static str, &mut PathBuf)> {
        [(inputs::DEVICES, &mut self.devices)].into_iter().chain(self.hazard.file()).collect()
    }

    fn request(
        &self,
        suite: SuiteRequest,
        hazard: Option<&HazardText>,
        inputs: &mut InputReader,
    ) -> Result<ComparisonRequest, InputError> {
        let list = self.read(&suite.scene, inputs)?;
        let rate = hazard.map(|hazard| RateRequest {
            im: self.im(),
            levels: self.levels.clone(),
            hazard: hazard.curve.clone(),
        });
        Ok(ComparisonRequest {
            scales: self.scales.clone(),
            columns: self.further.columns(),
            rate,
            resample: self.intervals.resample,
            seed: self.intervals.seed,
            ..ComparisonRequest::new(list, suite, self.limits.limits())
        })
    }

    fn refused(&self, error: StudyError) -> anyhow::Error {
        match error {
            StudyError::Devices(error) => self.of_list(&error).into(),
            StudyError::Sweep(error) => sweep_error(error),
        }
    }

    fn pictures(&self, _: &ComparisonRequest) -> Vec<String> {
        vec![PICTURE.into()]
    }

    fn not_drawn() -> Option<String> {
        Some(format!("none: there are more than {} devices", picture::MOST))
    }

    fn rates(&self) -> Option<RateFlags<'_>> {
        Some(self.site())
    }

    fn tell_of_base(
        &self,
        job: &StudyJob<Comparison>,
        options: &RunOptions,
        say: &Reporter,
    ) -> Result<(), InputError> {
        if let Some(scales) = &self.scales {
            let written = |numbers: &str| numbers.to_string();
            say.line("factors", topple::scene::words::values(scales, written));
        }
        tell_of_devices(&job.settings, options, say)
    }

    fn draw(
        &self,
        compared: &Comparison,
        print: Print,
    ) -> Result<Vec<(String, Picture)>, FigureError> {
        let devices = counted(compared.devices.len(), "device");
        let motions = counted(compared.records(), "motion");
        let drawn = picture::draw(compared, &format!("{devices} under {motions}"), print);
        Ok(drawn.map(|drawn| (PICTURE.to_string(), drawn)).into_iter().collect())
    }

    fn warn(&self, compared: &Comparison) {
        compare_words::warn(compared, &self.site());
    }

    fn record(&self, compared: &Comparison, site: Site) -> Self::Record {
        let settings = &compared.settings;
        let named = settings.devices.iter().zip(&settings.scenes);
        let of = |(one, scene): (&Device, &Scene)| DeviceRun {
            device: one.name.clone(),
            scene: scene.clone(),
        };
        Self::Record {
            list: Some(PathText(self.devices.clone())),
            devices: named.map(of).collect(),
            limits: self.limits.record(),
            scales: settings.scales.clone(),
            columns: names(&settings.columns),
            drawn: self.intervals.record(Some((&settings.groups, &settings.bootstrap))),
            im: settings.hazard.as_ref().map(|_| self.im()),
            levels: self.levels.as_ref().map(|levels| levels.iter().collect()),
            site,
        }
    }

    fn tell(&self, compared: &Comparison, say: &Reporter) {
        compare_words::tell(compared, self.im(), say);
    }
}

impl CompareFlags {
    /// The measure of the hazard.
    fn im(&self) -> Intensity {
        self.im.unwrap_or(Intensity::Pga)
    }

    /// What annual rates are told over.
    fn site(&self) -> RateFlags<'_> {
        RateFlags { hazard: &self.hazard, im: self.im(), levels: self.levels.as_ref() }
    }

    /// Reads the list.
    fn read(
        &self,
        shared: &SceneBuilder,
        inputs: &mut InputReader,
    ) -> Result<Vec<Device>, InputError> {
        let bytes = inputs.read(inputs::DEVICES, &self.devices, (LARGEST, READABLE))?;
        let text = decoded(&bytes).map_err(|error| {
            InputError(format!("{}: {error}; {READABLE}", self.devices.display()))
        })?;
        let list = devices::read(&text, shared).map_err(|error| self.of_list(&error))?;
        if let Some(doubt) = row_in_comment(&text) {
            words::warn(format!("{}: {doubt}", self.devices.display()));
        }
        Ok(list)
    }

    /// What is wrong in the list, with its place.
    fn of_list(&self, error: &TableError) -> InputError {
        let (path, problem) = (self.devices.display(), error.to_string());
        InputError(format!("{path}: {}", with_flags(&problem)))
    }
}

/// Says what the numbers of each device make of the base, and warns of those whose impacts take no energy.
fn tell_of_devices(
    of: &ComparisonSettings,
    options: &RunOptions,
    say: &Reporter,
) -> Result<(), InputError> {
    let mut names = Vec::new();
    let mut remarks: Vec<(String, Vec<&str>)> = Vec::new();
    for (device, scene) in of.devices.iter().zip(&of.scenes) {
        if !device.left_out.is_empty() {
            let flags: Vec<String> = device.left_out.iter().map(|own| own.entry().flag()).collect();
            let text = "of all, which its base has not";
            say.line("left out", format!("{}: {} {text}", device.name, flags.join(", ")));
        }
        words::device(say, Some(&device.name), scene);
        let is_default = !device.scene.numbers.has(Parameter::XiH);
        let damper = device_remarks::damper(scene).filter(|_| is_default);
        for remark in damper.into_iter().chain(device_remarks::implausible(scene)) {
            match remarks.iter_mut().find(|(other, _)| *other == remark) {
                Some((_, names)) => names.push(&device.name),
                None => remarks.push((remark, vec![&device.name])),
            }
        }
        let plan = options.plan(scene).map_err(|error| flag_error(&error))?;
        if words::has_lossless_impacts(&plan, &Grid::of(scene)) {
            names.push(device.name.as_str());
        }
    }
    for (remark, names) in remarks {
        words::warn(format!("{}: {remark}", names.join(", ")));
    }
    if !names.is_empty() {
        words::warn(with_flags(&format!(
            "{}: impacts take no energy, so that the block chatters for long; give the plates' masses (`plate_h`, `plate_v`), or \
             of a block on the ground no restitution of 1",
            names.join(", ")
        )));
    }
    Ok(())
}
