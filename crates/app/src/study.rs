//! The way of `topple envelope`, `fragility` and `compare`: from flags to sweeps under a suite, and from these to files.

use std::path::PathBuf;

use topple::backend::backend_error::BackendError;
use topple::results::earlier::Kind;
use topple_manifest::{Run, Site, StudyRun};
use topple_pictures::drawing::error::FigureError;
use topple_pictures::drawing::picture::Picture;
use topple_pictures::drawing::print::Print;
use topple_studies::fragility::HazardText;
use topple_studies::uncertain::Varied;
use topple_studies::{Study, StudyError, StudyJob, StudyRequest, SuiteRequest};

use super::errors::sweep_error;
use super::inputs::InputReader;
use super::numbers::RecordNumbers;
use super::options::{CommonFlags, RunOptions};
use super::progress::Screen;
use super::results_directory::{Place, picture_files};
use super::study_flags::{self, RateFlags};
use super::suite_run::{SuiteFlags, tell_of_base, tell_verified};
use super::words::Reporter;
use super::{InputError, study_words, suite};

/// A command that studies a scene, or devices, under the motions of a suite. What is its own stands between the flags of the motions
/// and those of how they are run.
#[derive(clap::Args)]
pub struct StudyCommand<Own: StudyFlags> {
    #[command(flatten)]
    common: CommonFlags,
    #[command(flatten)]
    record: RecordNumbers,
    #[command(flatten)]
    pub motions: SuiteFlags,
    #[command(flatten)]
    pub own: Own,
    #[command(flatten, next_help_heading = "Computing")]
    pub options: RunOptions,
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

impl<Own: StudyFlags> StudyCommand<Own> {
    /// Runs the sweeps and writes what they tell.
    pub fn run(&self) -> anyhow::Result<()> {
        let StudyCommand { common, record, motions, own, options } = self;
        let print = options.pictures.print().map_err(InputError)?;
        let place = Place::of(&options.out, Own::KIND)?;
        let mut inputs = motions.inputs();
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
        motions.refuse_foreign(&place, &tables.chain(pictures).collect::<Vec<_>>())?;
        let suite = motions.read()?;
        let say = Reporter::unless(options.quiet);
        let job = request.open(&suite).map_err(|error| own.refused(error))?;
        motions.refuse_others(&job.sweep, options)?;
        suite::count(&suite, &say);
        own.varied().iter().for_each(|varied| say.line("varies", varied));
        if let (Some(rates), Some(hazard)) = (own.rates(), &hazard) {
            study_words::hazard(&rates, hazard, &say);
        }
        motions.tell_of_scene(&job.scenes, &say);
        if let Some(rates) = own.rates() {
            study_words::levels(&rates, &say);
        }
        own.tell_of_base(&job, options, &say)?;
        let StudyJob { sweep, settings, times, .. } = job;
        let Some(swept) = motions.run(sweep, (times, Own::TIMES), options, &say)? else {
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
