//! `topple compare`.

use std::path::{Path, PathBuf};

use serde::Serialize;
use topple::results::earlier::Kind;
use topple::scene::record::text::decoded;
use topple::scene::{Grid, Parameter, Scene, Values, path_text};
use topple_pictures::studies::comparison as picture;
use topple_studies::comparison::{
    self, Comparison, ComparisonError, ComparisonJob, ComparisonRequest, Device, RateRequest,
    devices,
};
use topple_studies::row_in_comment;
use topple_studies::suites::Resample;
use topple_studies::suites::intensity::Intensity;
use topple_studies::suites::verified::Verified;

use super::compare_words;
use super::errors::sweep_error;
use super::fragility_words as told;
use super::further::FurtherFlags;
use super::hazard::HazardFlags;
use super::inputs::{self, InputReader, Inputs};
use super::limits::{IntervalFlags, LimitFlags};
use super::numbers::RecordNumbers;
use super::options::{CommonFlags, RunOptions, flag_error};
use super::results_directory::{Place, picture_files};
use super::suite_run::{self, SuiteFlags, SuiteManifest, Times};
use super::words::{Reporter, counted, with_flags};
use super::{InputError, device_remarks, examples, further, suite, words};

/// Compare the devices of a list under every motion of a suite, side by side.
#[derive(clap::Args)]
// A device has one cell: there are no axes of a picture.
#[command(after_help = examples::COMPARE, mut_args(|flag| suite_run::without(flag, &["x", "y"])))]
pub struct CompareCommand {
    /// List of devices (CSV)
    #[arg(value_name = "DEVICES")]
    pub devices: PathBuf,
    #[command(flatten)]
    common: CommonFlags,
    #[command(flatten)]
    record: RecordNumbers,
    #[command(flatten)]
    pub motions: SuiteFlags,
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
    pub hazard: HazardFlags,
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
    #[command(flatten, next_help_heading = "Computing")]
    pub options: RunOptions,
}

/// run.json of a comparison.
#[derive(Serialize)]
struct Manifest<'a> {
    /// What a run under a suite says; its scene is the first device's.
    #[serde(flatten)]
    suite: SuiteManifest<'a>,
    #[serde(serialize_with = "path_text::serialize")]
    list: &'a Path,
    /// Each device under the first motion.
    devices: Vec<Of<'a>>,
    standing: f64,
    limit_u: Option<f64>,
    limit_v: Option<f64>,
    scales: &'a [f64],
    columns: Vec<&'static str>,
    resample: Resample,
    groups: usize,
    replicates: u32,
    seed: u32,
    im: Option<Intensity>,
    levels: Option<Vec<f64>>,
    #[serde(serialize_with = "path_text::serialize_some")]
    hazard: Option<&'a Path>,
    hazard_units: Option<&'static str>,
    /// The curve that was read: its levels, in SI units, and annual rates.
    #[serde(skip_serializing_if = "Option::is_none")]
    hazard_curve: Option<Vec<[f64; 2]>>,
    /// Checksums of the files that it read beside its motions.
    inputs: Inputs,
    /// The reference's results for a sample.
    verified: &'a Verified,
}

/// A device in run.json.
#[derive(Serialize)]
struct Of<'a> {
    device: &'a str,
    scene: Scene,
}

/// The table, and the name of the picture.
const TABLE: &str = "compare.csv";
const PICTURE: &str = "compare";
/// What to do about a list that cannot be read.
const READABLE: &str = "give a list of devices (CSV) that can be read";
/// Largest list that is read, bytes.
const LARGEST: u64 = 1 << 20;

impl CompareCommand {
    /// Runs the sweep and writes the comparison.
    pub fn run(&self) -> anyhow::Result<()> {
        let options = &self.options;
        let print = options.pictures.print().map_err(InputError)?;
        let place = Place::of(&options.out, Kind::Comparison)?;
        let im = self.im.unwrap_or(Intensity::Pga);
        let mut inputs = self.motions.inputs();
        let hazard = self.hazard.read(im, &mut inputs)?;
        let text = self.common.text(None, self.record.placed());
        let request = self.motions.request(&self.common, options, text)?;
        let list = self.read(&request.scene, &mut inputs)?;
        let limits = self.limits.limits();
        let rate = hazard.as_ref().map(|hazard| RateRequest {
            im,
            levels: self.levels.clone(),
            hazard: hazard.curve.clone(),
        });
        let request = ComparisonRequest {
            scales: self.scales.clone(),
            columns: self.further.columns(),
            rate,
            resample: self.intervals.resample,
            seed: self.intervals.seed,
            ..ComparisonRequest::new(list, request, limits)
        };
        request.check().map_err(|error| self.refused(error))?;
        let names = [TABLE.to_string()].into_iter().chain(picture_files(PICTURE));
        self.motions.refuse_foreign(&place, &names.collect::<Vec<_>>())?;
        let suite = self.motions.read()?;
        let say = Reporter::unless(options.quiet);
        let job = request.open(&suite).map_err(|error| self.refused(error))?;
        let [falling, at_scales] = job.falling();
        let ComparisonJob { sweep, settings } = job;
        let scenes = sweep.scenes(settings.devices.len());
        self.motions.refuse_others(&sweep, options)?;
        suite::count(&suite, &say);
        if let Some((path, hazard)) = self.hazard.path().zip(hazard.as_ref()) {
            told::hazard(path, hazard, im, &say);
        }
        self.motions.tell_of_scene(&scenes, &say);
        told::levels(self.levels.as_ref(), im, &say);
        if let Some(scales) = &self.scales {
            say.line(
                "factors",
                topple::scene::words::values(scales, |numbers| numbers.to_string()),
            );
        }
        self.tell_of_devices(&settings.devices, &scenes, &say)?;
        let times = Times::devices(settings.devices.len());
        let Some(swept) = self.motions.run(sweep, times, options, &say)? else {
            return Ok(());
        };
        let mut out = place.open()?;
        let mut compared = Comparison::of(swept, settings);
        let devices = counted(compared.devices.len(), "device");
        let motions = counted(compared.records(), "motion");
        let drawn = picture::draw(&compared, &format!("{devices} under {motions}"), print);
        let mut files = vec![TABLE.to_string()];
        files.extend(drawn.iter().flat_map(|_| picture_files(PICTURE)));
        out.begin(files, &say)?;
        out.write(TABLE, |w| comparison::write(&compared, w))?;
        if let Some(drawn) = &drawn {
            out.picture(PICTURE, drawn, &drawn.png()?)?;
        }
        let settings = &compared.settings;
        told::warn_of_few(&settings.groups);
        if let Some(hazard) = &settings.hazard {
            let stripes = compared.devices.iter().flat_map(|device| &device.rate);
            let levels = (im, self.levels.as_ref());
            let stripes = stripes.flat_map(|rated| &rated.stripes);
            told::warn_of_units(stripes, Some(hazard), levels);
            told::warn_of_falling(falling, levels);
            compare_words::warn_of_crossings(&compared, im);
        }
        if let Some(of) = at_scales {
            words::warn(format!(
                "at {} of {} factors of --scales, from {} on, {} under some motions{}: {}",
                of.levels,
                of.of_levels,
                of.from,
                told::FALLS,
                told::half(of.half.map(|factor| format!("from {factor} on"))),
                told::LEAVES
            ));
        }
        let named = settings.devices.iter().zip(scenes);
        let manifest = Manifest {
            suite: self.motions.manifest(&compared.sweep, (&suite, options)),
            list: &self.devices,
            devices: named.map(|(one, scene)| Of { device: &one.name, scene }).collect(),
            standing: limits.standing,
            limit_u: limits.u,
            limit_v: limits.v,
            scales: &settings.scales,
            columns: further::names(&settings.columns),
            resample: settings.groups.by,
            groups: settings.groups.count,
            replicates: settings.bootstrap.replicates,
            seed: self.intervals.seed,
            im: hazard.as_ref().map(|_| im),
            levels: self.levels.as_ref().map(|levels| levels.iter().collect()),
            hazard: self.hazard.path(),
            hazard_units: hazard.as_ref().map(|hazard| hazard.unit),
            hazard_curve: hazard.as_ref().map(|hazard| hazard.curve.points()),
            inputs: inputs.checksums(),
            verified: &compared.sweep.verified,
        };
        compare_words::warn_of_model(&compared);
        out.finish(&manifest)?;
        compare_words::tell(&compared, im, &say);
        suite_run::tell_verified(&compared.sweep, &say);
        compared.sweep.discard_saved()?;
        match drawn {
            Some(_) => say.line("picture", out.file(&picture_files(PICTURE)[1]).display()),
            None => {
                let most = picture::MOST;
                say.line("picture", format!("none: there are more than {most} devices"));
            }
        }
        say.line("table", format!("{} with run.json", out.file(TABLE).display()));
        Ok(())
    }

    /// Reads the list.
    fn read(
        &self,
        shared: &topple::SceneBuilder,
        inputs: &mut InputReader,
    ) -> Result<Vec<Device>, InputError> {
        let bytes = inputs.read(inputs::DEVICES, &self.devices, (LARGEST, READABLE))?;
        let text = decoded(&bytes).map_err(|error| {
            InputError(format!("{}: {error}; {READABLE}", self.devices.display()))
        })?;
        let list = devices::read(&text, shared).map_err(|error| self.refused(error.into()))?;
        if let Some(doubt) = row_in_comment(&text) {
            words::warn(format!("{}: {doubt}", self.devices.display()));
        }
        Ok(list)
    }

    /// What is wrong, with its place in the list or its flag.
    fn refused(&self, error: ComparisonError) -> InputError {
        match error {
            ComparisonError::Devices(error) => {
                let (path, problem) = (self.devices.display(), error.to_string());
                InputError(format!("{path}: {}", with_flags(&problem)))
            }
            ComparisonError::Sweep(error) => InputError(format!("{:#}", sweep_error(error))),
        }
    }

    /// Says what the numbers of each device make of the base, and warns of those whose impacts take no energy.
    fn tell_of_devices(
        &self,
        devices: &[Device],
        scenes: &[Scene],
        say: &Reporter,
    ) -> Result<(), InputError> {
        let mut names = Vec::new();
        let mut remarks: Vec<(String, Vec<&str>)> = Vec::new();
        for (device, scene) in devices.iter().zip(scenes) {
            if !device.left_out.is_empty() {
                let flags: Vec<String> =
                    device.left_out.iter().map(|own| own.entry().flag()).collect();
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
            let plan = self.options.plan(scene).map_err(|error| flag_error(&error))?;
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
}
