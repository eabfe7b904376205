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
use topple_pictures::drawing::share::{given, percent};
use topple_pictures::studies::comparison as picture;
use topple_studies::comparison::{
    Compared, Comparison, ComparisonRequest, ComparisonSettings, Device, RateRequest, Rated,
    STATES, devices,
};
use topple_studies::fragility::HazardText;
use topple_studies::suites::SuiteRequest;
use topple_studies::suites::envelope::{CellEnvelope, Limits, NotKept};
use topple_studies::suites::intensity::Intensity;
use topple_studies::{StudyError, StudyJob, TableError, row_in_comment};

use super::errors::sweep_error;
use super::inputs::{self, InputReader};
use super::options::{RunOptions, flag_error};
use super::study::StudyFlags;
use super::study_flags::{
    FurtherFlags, HazardFlags, IntervalFlags, LimitFlags, RateFlags, names, without,
};
use super::study_words::{
    FALLS, LEAVES, between, crosses, digits, half, intervals, rate_lines, unit, warn_of_falling,
    warn_of_few, warn_of_units,
};
use super::words::{self, Reporter, counted, with_flags};
use super::{InputError, device_remarks, examples};

/// Compare the devices of a list under every motion of a suite, side by side.
#[derive(clap::Args)]
// A device has one cell: there are no axes of a picture.
#[command(after_help = examples::COMPARE, mut_args(|flag| without(flag, &["x", "y"])))]
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
        warn(compared, &self.site());
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
            limits: self.limits.limits(),
            scales: settings.scales.clone(),
            columns: names(&settings.columns),
            drawn: self.intervals.record(Some((&settings.groups, &settings.bootstrap))),
            im: settings.hazard.as_ref().map(|_| self.im()),
            levels: self.levels.as_ref().map(|levels| levels.iter().collect()),
            site,
        }
    }

    fn tell(&self, compared: &Comparison, say: &Reporter) {
        tell(compared, self.im(), say);
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

/// Says what became of each device.
fn tell(compared: &Comparison, im: Intensity, say: &Reporter) {
    let unit = &unit(im);
    let groups = &compared.settings.groups;
    say.line("intervals", intervals(groups, compared.records()));
    for (number, (name, device)) in compared.rows().enumerate() {
        say.line(if number == 0 { "devices" } else { "" }, one(name, device, compared));
        if let Some(rated) = &device.rate {
            let Rated { estimate, stripes, empirical, .. } = rated;
            let mut lines = rate_lines((stripes, *empirical), estimate, unit, None);
            if let (true, Some(note)) = (lines.is_empty(), &estimate.note) {
                lines.push(format!("annual rate not known: {note}"));
            }
            lines.iter().for_each(|line| say.line("", format!("  {line}")));
        }
    }
    say.line("limits", kept(compared));
}

/// Devices whose names are printed.
const NAMED: usize = 12;

/// The devices that keep all limits under the motions as they are.
fn kept(compared: &Comparison) -> String {
    let keeps = compared.rows().filter(|(_, device)| device.cell.feasible);
    let names: Vec<&str> = keeps.map(|(name, _)| name).collect();
    let of = counted(compared.devices.len(), "device");
    match names.len() {
        0 => format!("none of {of} keeps all limits"),
        1 => format!("1 of {of} keeps all limits: {}", names[0]),
        count if count <= NAMED => format!("{count} of {of} keep all limits: {}", names.join("; ")),
        count => format!("{count} of {of} keep all limits; the column feasible is 1 for these"),
    }
}

/// Warns of what the results tell less well than they seem to.
fn warn(compared: &Comparison, of: &RateFlags) {
    let settings = &compared.settings;
    let [falling, at_scales] = settings.falling;
    warn_of_few(&settings.groups);
    if let Some(hazard) = &settings.hazard {
        let stripes = compared.devices.iter().flat_map(|device| &device.rate);
        warn_of_units(stripes.flat_map(|rated| &rated.stripes), Some(hazard), of);
        warn_of_falling(falling, of);
        warn_of_crossings(compared, of.im);
    }
    if let Some(of) = at_scales {
        words::warn(format!(
            "at {} of {} factors of --scales, from {} on, {FALLS} under some motions{}: {LEAVES}",
            of.levels,
            of.of_levels,
            of.from,
            half(of.half.map(|factor| format!("from {factor} on"))),
        ));
    }
    warn_of_model(compared);
}

/// Warns of curves of overturning that are above those of uplift.
fn warn_of_crossings(compared: &Comparison, im: Intensity) {
    for (name, device) in compared.rows() {
        let Some(rated) = &device.rate else { continue };
        if let Some(crossing) = &rated.crossing {
            let rate = rated.estimate.rate.as_ref();
            let unit = unit(im);
            let crosses = crosses(&STATES, crossing, rate, &unit);
            words::warn(format!("{name}: {crosses}"));
        }
    }
}

/// Warns of devices under which the model does not hold.
fn warn_of_model(compared: &Comparison) {
    let tensile = compared.rows().filter(|(_, device)| device.tensile > 0);
    let tensile: Vec<String> =
        tensile.map(|(name, device)| format!("{name} under {}", device.tensile)).collect();
    if !tensile.is_empty() {
        words::warn(format!(
            "{}: {} of {}",
            words::TENSILE,
            tensile.join(", "),
            counted(compared.records(), "motion")
        ));
    }
    for ((name, device), of) in compared.rows().zip(&compared.settings.devices) {
        words::warn_of_radius(
            Some(name),
            of.scene.numbers.get(Parameter::Radius),
            device.cell.max_u[2],
        );
    }
}

/// A device in words.
fn one(name: &str, device: &Compared, of: &Comparison) -> String {
    let Compared { cell, reserve, stop_from, .. } = device;
    let mut text = format!("{name}: stands under {}", percent(cell.standing));
    text += &format!(
        ", overturning has P = {}{}",
        digits(cell.overturned),
        between(cell.overturned_within)
    );
    let strokes = [
        ("|u|", cell.max_u[2], of.settings.limits.u),
        ("stroke of v", cell.stroke_v[2], of.settings.limits.v),
    ];
    for (what, value, limit) in strokes {
        if value > 0.0 {
            let limit = limit.map_or(String::new(), |limit| format!(" of {limit} m"));
            text += &format!(", {what} up to {value:.3} m{limit}");
        }
    }
    text += &match stop_from {
        Some(1.0) => ", meets its end stop".to_string(),
        Some(factor) => format!(", meets its end stop at {factor} times the motions"),
        None => String::new(),
    };
    if let Some(reserve) = reserve {
        text += &match (reserve.keeps, reserve.fails) {
            (None, Some(fails)) => {
                format!(
                    ", no reserve: exceeds a limit already at {fails} times the motions, the smallest factor"
                )
            }
            (None, None) => ", no reserve".to_string(),
            (Some(keeps), Some(fails)) => {
                format!(
                    ", keeps all limits up to {keeps} times the motions, and exceeds one at {fails} times"
                )
            }
            (Some(keeps), None) => {
                format!(", keeps all limits up to {keeps} times the motions, the largest factor")
            }
        };
    }
    if !cell.feasible {
        text += &format!("; {}", not_kept(cell, of.settings.limits));
    }
    text
}

/// Which limits are not kept.
fn not_kept(cell: &CellEnvelope, limits: Limits) -> String {
    let words = |kind: NotKept| match (kind, limits.standing) {
        (NotKept::Standing, 1.0) => "the block does not stand under all motions".to_string(),
        (NotKept::Standing, share) => {
            format!("the block stands under less than {} of the motions", given(share))
        }
        (NotKept::U, _) => "|u| exceeds its limit".to_string(),
        (NotKept::V, _) => "the stroke of v exceeds its limit".to_string(),
    };
    let kinds = limits.not_kept(cell.standing, cell.max_u[2], cell.stroke_v[2]);
    kinds.map(words).collect::<Vec<_>>().join(", ")
}
