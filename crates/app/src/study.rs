//! The way of `topple envelope`, `fragility` and `compare`: from flags to sweeps under a suite, and from these to files.

use std::path::PathBuf;

use topple::backend::backend_error::BackendError;
use topple::results::earlier::Kind;
use topple::scene::{Grid, Parameter, Scene, Values};
use topple_manifest::{Run, Site, StudyRun};
use topple_pictures::drawing::error::FigureError;
use topple_pictures::drawing::picture::Picture;
use topple_pictures::drawing::print::Print;
use topple_studies::fragility::HazardText;
use topple_studies::suites::saved;
use topple_studies::suites::swept::{SuiteJob, SuiteSweep};
use topple_studies::suites::verified::Verified;
use topple_studies::uncertain::Varied;
use topple_studies::{Study, StudyError, StudyJob, StudyRequest, SuiteRequest};

use super::errors::sweep_error;
use super::estimate::duration;
use super::inputs::InputReader;
use super::numbers::RecordNumbers;
use super::options::{CommonFlags, RunOptions, flag_error};
use super::progress::Screen;
use super::results_directory::{self, Place, picture_files};
use super::study_flags::{self, RateFlags, SuiteFlags};
use super::words::{self, Reporter, counted};
use super::{InputError, device_remarks, study_words, suite};

/// A command that studies a scene, or devices, under the motions of a suite. What is its own stands between the flags of the motions
/// and those of how they are run.
#[derive(clap::Args)]
pub struct StudyCommand<Own: StudyFlags> {
    #[command(flatten)]
    common: CommonFlags,
    #[command(flatten)]
    record: RecordNumbers,
    #[command(flatten)]
    motions: SuiteFlags,
    #[command(flatten)]
    own: Own,
    #[command(flatten, next_help_heading = "Computing")]
    options: RunOptions,
}

/// The command of any study.
pub trait AnyStudy {
    /// What its files are of.
    fn kind(&self) -> Kind;

    /// Runs the sweeps and writes what they tell.
    fn run(&self) -> anyhow::Result<()>;

    /// What a repetition changes: the files that it reads beside the motions, by the flags that name them; the motions; and how they are run.
    fn parts(&mut self) -> (Vec<(&'static str, &mut PathBuf)>, &mut SuiteFlags, &mut RunOptions);
}

/// What comes of a study's sweeps.
pub type StudyOf<Own> = <<Own as StudyFlags>::Request as StudyRequest>::Study;

/// The flags that only one study has, and what it says of its results.
pub trait StudyFlags: clap::Args {
    /// What they ask for.
    type Request: StudyRequest;
    /// What run.json says of it.
    type Record;

    /// What its files are of.
    const KIND: Kind;
    /// Its run.json.
    const RUN: fn(Box<StudyRun<Self::Record>>) -> Run;
    /// The title of its scene.
    const TITLE: Option<&'static str>;
    /// What a motion is swept several times for.
    const TIMES: &'static str = "sets of numbers";
    /// Tables that are named at the end; the others are parts of these.
    const NAMED: usize = 1;

    /// The files that it reads beside the motions, by the flags that name them.
    fn files(&mut self) -> Vec<(&'static str, &mut PathBuf)> {
        Vec::new()
    }

    /// What is asked, of the suite what its flags say.
    fn request(
        &self,
        suite: SuiteRequest,
        hazard: Option<&HazardText>,
        inputs: &mut InputReader,
    ) -> Result<Self::Request, InputError>;

    /// Why it is refused, or failed.
    fn refused(&self, error: StudyError) -> anyhow::Error {
        match error {
            StudyError::Devices(error) => InputError(error.to_string()).into(),
            StudyError::Sweep(error) => sweep_error(error),
        }
    }

    /// The names of the pictures that it may have.
    fn pictures(&self, request: &Self::Request) -> Vec<String>;

    /// What is said where there is none.
    fn not_drawn() -> Option<String> {
        None
    }

    /// The site whose annual rates are told, and the levels of its measure; none of a study that has no rates.
    fn rates(&self) -> Option<RateFlags<'_>> {
        None
    }

    /// Numbers that are not known.
    fn varied(&self) -> &[Varied] {
        &[]
    }

    /// Says what the base is, and warns of what is doubtful there.
    fn tell_of_base(
        &self,
        job: &StudyJob<StudyOf<Self>>,
        options: &RunOptions,
        _say: &Reporter,
    ) -> Result<(), InputError> {
        tell_of_base(&job.sweep, options)
    }

    /// The pictures, with their names.
    fn draw(
        &self,
        study: &StudyOf<Self>,
        print: Print,
    ) -> Result<Vec<(String, Picture)>, FigureError>;

    /// Warns of what the results tell less well than they seem to.
    fn warn(&self, study: &StudyOf<Self>);

    /// What run.json says of it.
    fn record(&self, study: &StudyOf<Self>, site: Site) -> Self::Record;

    /// Says what came of it.
    fn tell(&self, study: &StudyOf<Self>, say: &Reporter);
}

impl<Own: StudyFlags> AnyStudy for StudyCommand<Own> {
    fn kind(&self) -> Kind {
        Own::KIND
    }

    fn parts(&mut self) -> (Vec<(&'static str, &mut PathBuf)>, &mut SuiteFlags, &mut RunOptions) {
        (self.own.files(), &mut self.motions, &mut self.options)
    }

    fn run(&self) -> anyhow::Result<()> {
        let StudyCommand { common, record, motions, own, options } = self;
        let print = options.pictures.print().map_err(InputError)?;
        let place = Place::of(&options.out, Own::KIND)?;
        let mut inputs = InputReader::new(motions.repeats.as_ref().map(|earlier| &earlier.inputs));
        let hazard = match own.rates() {
            Some(rates) => rates.hazard.read(rates.im, &mut inputs)?,
            None => None,
        };
        let text = common.text(Own::TITLE, record.placed());
        let request = motions.request(common, options, text)?;
        let request = own.request(request, hazard.as_ref(), &mut inputs)?;
        request.check().map_err(|error| own.refused(error))?;
        let exports = request.exports();
        let exported = exports.iter().map(|(file, _)| *file);
        let tables = request.tables().into_iter().map(|(file, _)| file);
        let tables = tables.chain(exported).map(String::from);
        let pictures = own.pictures(&request).into_iter().flat_map(|name| picture_files(&name));
        // A dry run and a shard write none of them.
        if !motions.dry_run && motions.tile.is_none() {
            place.refuse_foreign(&tables.chain(pictures).collect::<Vec<_>>())?;
        }
        let suite = motions.read()?;
        let say = Reporter::unless(options.quiet);
        let job = request.open(&suite).map_err(|error| own.refused(error))?;
        // Before anything is warned of: what is refused is one line.
        if job.sweep.finds_others().map_err(sweep_error)? && motions.resume {
            let problem = format!(
                "--resume: {} holds motions of another run; give the flags of that run, or another directory",
                saved::folder(&options.out).display()
            );
            return Err(InputError(problem).into());
        }
        suite::count(&suite, &say);
        own.varied().iter().for_each(|varied| say.line("varies", varied));
        if let (Some(rates), Some(hazard)) = (own.rates(), &hazard) {
            study_words::hazard(&rates, hazard, &say);
        }
        tell_of_scenes(motions, &job.scenes, &say);
        if let Some(rates) = own.rates() {
            study_words::levels(&rates, &say);
        }
        own.tell_of_base(&job, options, &say)?;
        let StudyJob { sweep, settings, times, .. } = job;
        let Some(swept) = sweep_under(motions, sweep, (times, Own::TIMES), options, &say)? else {
            return Ok(());
        };
        let screen = Screen::new(options.quiet);
        let Some(mut study) = StudyOf::<Own>::of(swept, settings, &screen) else {
            return Err(sweep_error(BackendError::Cancelled.into()));
        };
        screen.clear();
        let mut out = place.open()?;
        let pictures = own.draw(&study, print)?;
        let pictures = pictures.into_iter().map(|(name, drawn)| {
            let png = drawn.png()?;
            Ok((name, drawn, png))
        });
        let pictures: Vec<_> = pictures.collect::<Result<_, FigureError>>()?;
        let has = |file: &str| request.has(&study, file);
        let tables = request.tables().into_iter().filter(|(file, _)| has(file));
        let tables: Vec<_> = tables.map(|(file, of)| (file, of(&study))).collect();
        let exports: Vec<_> = exports.into_iter().filter(|(file, _)| has(file)).collect();
        let exported = exports.iter().map(|(file, _)| *file);
        let files: Vec<&str> = tables.iter().map(|(file, _)| *file).chain(exported).collect();
        let names = files.iter().map(|file| file.to_string());
        let drawn = pictures.iter().flat_map(|(name, ..)| picture_files(name));
        out.begin(names.chain(drawn).collect(), &say)?;
        for (file, table) in tables {
            out.write(file, |to| table.write(to))?;
        }
        for (file, write) in exports {
            out.write(file, |mut to| write(&study, &mut to))?;
        }
        for (name, drawn, png) in &pictures {
            out.picture(name, drawn, png)?;
        }
        own.warn(&study);
        let path = own.rates().and_then(|rates| rates.hazard.path());
        let site = study_flags::site(path, hazard, inputs.checksums());
        let record = own.record(&study, site);
        let swept = study.sweep();
        out.finish(Own::RUN(Box::new(StudyRun {
            study: motions.record(swept, &suite, options),
            own: record,
            verified: swept.verified.clone(),
        })))?;
        own.tell(&study, &say);
        tell_verified(study.sweep(), &say);
        study.sweep().discard_saved()?;
        for (name, ..) in &pictures {
            say.line("picture", out.file(&picture_files(name)[1]).display());
        }
        if let (Some(why), []) = (Own::not_drawn(), &pictures[..]) {
            say.line("picture", why);
        }
        let named = &files[..Own::NAMED.min(files.len())];
        let name = if named.len() == 1 { "table" } else { "tables" };
        let first = out.file(named[0]);
        let files = [&[&*first.display().to_string()], &named[1..]].concat().join(", ");
        say.line(name, format!("{files} with run.json"));
        Ok(())
    }
}

/// Says what is swept, and that both directions of a block without an eccentricity are the same.
fn tell_of_scenes(motions: &SuiteFlags, scenes: &[Scene], say: &Reporter) {
    let parts = match scenes {
        [] => return,
        [scene] => topple::scene::words::fixed(scene),
        scenes => words::shared_block(scenes),
    };
    let suite = motions.suite.display();
    say.line("scene", format!("{}, under the motions of {suite}", parts.join(", ")));
    if let [scene] = scenes {
        words::axes(say, &Grid::of(scene));
        words::block(say, scene);
    }
    let leans = |scene: &Scene| {
        let of_centre = [Parameter::Eccentricity, Parameter::Offset];
        let values = of_centre.into_iter().filter_map(|of| scene.numbers.get(of));
        values.flat_map(Values::iter).any(|value| value != 0.0)
    };
    if motions.both_directions && !scenes.iter().any(leans) {
        words::warn(
            "both directions of a motion are the same for a block without an eccentricity: --both-directions doubles the time, and nothing else",
        );
    }
}

/// Runs a scene under motions, each so many times for something; none where no result is wanted: of a dry run,
/// and of a shard.
fn sweep_under(
    motions: &SuiteFlags,
    job: SuiteJob,
    times: (usize, &str),
    options: &RunOptions,
    say: &Reporter,
) -> anyhow::Result<Option<SuiteSweep>> {
    let screen = Screen::new(options.quiet);
    options.warn_of(&job.backends().passed_over, &job.backends().backends[0]);
    let (cells, each, count) = (job.cells(), job.grid.len(), job.motions().len());
    let levels = cells / (each * count).max(1);
    let size = size(&job, times, levels);
    if motions.dry_run {
        let seconds = job.estimate(&screen).map_err(sweep_error)?;
        screen.clear();
        // The requested answer is printed even with --quiet.
        let say = Reporter::unless(false);
        say.line("cells", format!("{size}, {cells} together"));
        say.line("time", format!("about {} of sweep", duration(seconds)));
        return Ok(None);
    }
    results_directory::open(&options.out)?;
    let swept = job.run(&screen).map_err(sweep_error)?;
    screen.clear();
    if motions.resume {
        say.line("resumed", format!("{} of {count} motions were done", swept.resumed));
    }
    let ran = cells - swept.resumed * each * levels;
    if ran > 0 {
        let speed = ran as f64 / swept.seconds.max(1.0e-9);
        let text = format!("{size}, {:.2} s, {speed:.0} motions x cells a second", swept.seconds);
        say.line("sweep", text);
    }
    if let Some(shard) = motions.tile {
        tell_verified(&swept, say);
        let folder = saved::folder(&options.out);
        let joins = "the same command without --tile and with --resume joins the shards";
        say.line("motions", format!("shard {shard} in {}; {joins}", folder.display()));
        return Ok(None);
    }
    Ok(Some(swept))
}

/// Says what a device's numbers make of the base, and warns of a scene whose impacts take no energy.
fn tell_of_base(job: &SuiteJob, options: &RunOptions) -> Result<(), InputError> {
    let plan = options.plan(&job.scene).map_err(|error| flag_error(&error))?;
    words::device(&Reporter::unless(options.quiet), None, &job.scene);
    device_remarks::warn(&job.scene);
    words::warn_of_lossless_impacts(&plan, &job.grid);
    Ok(())
}

/// Warns of runs whose stroke no friction pendulum has.
pub fn warn_of_radius(swept: &SuiteSweep) {
    let (cells, largest) = swept.beyond_radius();
    match (swept.grid.len(), cells) {
        (_, 0) => {}
        (1, _) => {
            words::warn_of_radius(None, swept.scene.numbers.get(Parameter::Radius), largest);
        }
        _ => words::warn_of_radii(cells),
    }
}

/// How much is swept, in words: cells, motions, what each is swept several times for, levels.
fn size(job: &SuiteJob, (count, what): (usize, &str), levels: usize) -> String {
    let counts: Vec<String> = job
        .grid
        .axes()
        .iter()
        .filter(|axis| axis.count() > 1)
        .map(|axis| axis.count().to_string())
        .collect();
    let cells = match counts.is_empty() {
        true => "1 cell".to_string(),
        false => format!("{} cells", counts.join(" x ")),
    };
    // A shard has a part of them.
    let motions = job.motions().len().div_ceil(count.max(1));
    let mut text = format!("{cells} under {}", counted(motions, "motion"));
    if count > 1 {
        text += &format!(" with {count} {what}");
    }
    if levels > 1 {
        text += &format!(" at {levels} levels");
    }
    text
}

/// Says what the reference says.
fn tell_verified(swept: &SuiteSweep, say: &Reporter) {
    let Verified { sampled, differ, inside, wrong } = &swept.verified;
    if *sampled == 0 {
        return;
    }
    say.line("reference", words::reference(*sampled as usize, *differ as usize, *inside as usize));
    for place in wrong.iter().take(SHOWN) {
        say.line("", place);
    }
}

/// Wrong cells that are printed.
const SHOWN: usize = 3;
