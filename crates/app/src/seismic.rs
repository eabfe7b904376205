//! `topple seismic`.

use std::path::Path;

use topple::results::files::{Directory, WriteError};
use topple::scene::bounded;
use topple::scene::builder::SceneBuilder;
use topple::scene::record::{RecordText, synthetic};

use super::numbers::RecordNumbers;
use super::options::{CommonFlags, MapOptions, flag_error};
use super::record::RecordFlags;
use super::results_directory;
use super::save::{self, save};
use super::{InputError, examples, run};

/// Map the response to a ground-motion record over (T_h, T_v).
#[derive(clap::Args)]
#[command(after_help = examples::SEISMIC)]
pub struct SeismicCommand {
    #[command(flatten)]
    common: CommonFlags,
    #[command(flatten, next_help_heading = "Record")]
    record: RecordFlags,
    #[command(flatten)]
    numbers: RecordNumbers,
    #[command(flatten, next_help_heading = "Computing")]
    options: MapOptions,
}

impl SeismicCommand {
    /// Runs the map.
    pub fn run(&self) -> anyhow::Result<()> {
        let mut record = self.record.text();
        let force = self.options.run.force;
        if record.horizontal.is_none() && record.vertical.is_none() {
            // Nothing is written, the synthetic pair neither, before the scene is known to be right.
            let text = self.common.text(None, self.numbers.placed());
            let text = SceneBuilder { record: Some(record.clone()), force, ..text };
            let scene = text.check_under_motion(synthetic::pair()).map_err(|e| flag_error(&e))?;
            if let Some(path) = &self.common.save_scene {
                if path != Path::new("-") {
                    save::free(path)?;
                }
                // The pair lies beside the scene that names it.
                let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
                record = write_synthetic(
                    &results_directory::open(folder.unwrap_or(Path::new(".")))?,
                    record,
                )?;
                let text = self.common.text(None, self.numbers.placed());
                let text = SceneBuilder { record: Some(record), force, ..text };
                return save(path, text, "run");
            }
            if self.options.dry_run {
                return run::run_map(&scene, &self.options);
            }
            self.options.check(&scene)?;
            run::place(&scene, &self.options)?;
            let out = results_directory::open(&self.options.run.out)?;
            record = write_synthetic(&out, record)?;
        }
        let text = self.common.text(None, self.numbers.placed());
        let text = SceneBuilder { record: Some(record), force, ..text };
        let scene = text.check().map_err(|error| flag_error(&error))?;
        if let Some(path) = &self.common.save_scene {
            return save(path, text, "run");
        }
        run::run_map(&scene, &self.options)
    }
}

/// Writes the synthetic pair into the results' directory; the run then reads it like any other.
pub fn write_synthetic(out: &Directory, mut record: RecordText) -> anyhow::Result<RecordText> {
    use std::io::Write;
    for (name, title, parameters, place) in [
        ("synthetic_h.at2", synthetic::TITLES[0], synthetic::HORIZONTAL, &mut record.horizontal),
        ("synthetic_v.at2", synthetic::TITLES[1], synthetic::VERTICAL, &mut record.vertical),
    ] {
        let text = synthetic::at2(&synthetic::make(title, &parameters));
        let path = out.file(name);
        if path.symlink_metadata().is_ok()
            && !bounded::read(&path, text.len() as u64).is_ok_and(|own| own == text.as_bytes())
        {
            return Err(InputError(WriteError::Foreign(path).to_string()).into());
        }
        *place = Some(out.write(name, |w| w.write_all(text.as_bytes()))?);
    }
    Ok(record)
}
