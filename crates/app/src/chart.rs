//! `topple chart`.

use std::fs::File;
use std::path::PathBuf;
use std::time::Instant;

use topple::Written;
use topple::backend::gpu::adapter;
use topple::backend::gpu::opened::Gpu;
use topple::backend::report::threads;
use topple::model::precision::Precision;
use topple::results::files::Directory;
use topple::work::observer::Observer;
use topple_lab::chart::bench::{self, Bench, FULL, QUICK};
use topple_lab::chart::errors::{Compared, compare};
use topple_lab::chart::table::{self, Row};
use topple_lab::chart::trial::{self, Method, Trial};
use topple_lab::chart::truth::{self, Solution};
use topple_lab::chart::{figure, peers};

use super::options::flag_error;
use super::print::print_line;
use super::progress::Bar;
use super::record::RecordFlags;
use super::results_directory::{self, write_picture};
use super::seismic::write_synthetic;
use super::{InputError, examples};

/// Draw charts of speed against accuracy for several methods, steps and tolerances.
#[derive(clap::Args)]
#[command(after_help = examples::CHART)]
pub struct ChartCommand {
    /// Directory for the results; created if it does not exist
    #[arg(short, long, value_name = "DIR", default_value = "topple-chart")]
    out: PathBuf,
    #[command(flatten, next_help_heading = "Record")]
    record: RecordFlags,
    /// Results of other programs for the cells of cells.csv, drawn beside those of topple
    #[arg(long, value_name = "FILE")]
    peer: Vec<PathBuf>,
    /// Write only cells.csv and record.csv, for other programs
    #[arg(long)]
    cells_only: bool,
    /// Draw the results of an earlier chart.csv again, without measuring
    #[arg(long, value_name = "FILE", conflicts_with_all = ["peer", "cells_only"])]
    redraw: Option<PathBuf>,
    /// Use few cells, to check that everything works
    #[arg(long)]
    quick: bool,
    /// Leave out the shader
    #[arg(long)]
    no_shader: bool,
    /// Print only errors
    #[arg(short, long)]
    quiet: bool,
}

impl ChartCommand {
    /// Runs the trials and draws them.
    pub fn run(&self) -> anyhow::Result<()> {
        let out = results_directory::open(&self.out)?;
        let mut record = self.record.text();
        if record.horizontal.is_none() && record.vertical.is_none() {
            record = write_synthetic(&out, record)?;
        }
        let sides = if self.quick { QUICK } else { FULL };
        let benches = bench::all(sides, record).map_err(|error| flag_error(&error))?;
        if let Some(path) = &self.redraw {
            let refused =
                |reason: String| InputError(format!("--redraw: {}: {reason}", path.display()));
            let file = File::open(path)
                .map_err(|error| refused(format!("{error}; give a file to read")))?;
            let names: Vec<&'static str> = benches.iter().map(|bench| bench.name).collect();
            let rows = table::read(file, &names).map_err(|error| refused(error.to_string()))?;
            draw(&out, &benches, &rows)?;
            self.say(format!("pictures   {}", out.file("pulse.png").display()));
            return Ok(());
        }
        out.write("cells.csv", |w| peers::write_cells(&benches, w))?;
        out.write("record.csv", |w| peers::write_record(&benches, w))?;
        if self.cells_only {
            self.say(format!("cells      {} with record.csv", out.file("cells.csv").display()));
            return Ok(());
        }
        // Read before anything long begins.
        let mut others = Vec::new();
        for path in &self.peer {
            let refused =
                |reason: String| InputError(format!("--peer: {}: {reason}", path.display()));
            let file = File::open(path)
                .map_err(|error| refused(format!("{error}; give a file to read")))?;
            others.extend(peers::read(file, &benches).map_err(|error| refused(error.to_string()))?);
        }
        let gpu = self.gpu();
        let began = Instant::now();
        let (mut rows, truths) = self.trials(&benches, gpu.as_ref())?;
        rows.extend(others.iter().map(|peer| peer.row(&benches, &truths)));
        out.write("chart.csv", |w| table::write(&rows, w))?;
        draw(&out, &benches, &rows)?;
        self.say(format!("done       in {:.0} s", began.elapsed().as_secs_f64()));
        self.say(format!("pictures   {}", out.file("pulse.png").display()));
        self.say("           with record.png, free.png, maps.png".into());
        self.say(format!("data       {}", out.file("chart.csv").display()));
        Ok(())
    }

    fn say(&self, line: String) {
        if !self.quiet {
            print_line!("{line}");
        }
    }

    /// The device for the shader, a software one if there is no other.
    fn gpu(&self) -> Option<Gpu> {
        if self.no_shader {
            return None;
        }
        match adapter::best(Precision::F32).and_then(|adapter| Gpu::open(&adapter)) {
            Ok(gpu) => {
                let d = &gpu.description;
                self.say(format!("shader     {} ({}, {})", d.name, d.kind, d.api));
                Some(gpu)
            }
            Err(error) => {
                self.say(format!("shader     left out: {error}"));
                None
            }
        }
    }

    /// Every trial of every bench, and the benches' truths.
    fn trials(
        &self,
        benches: &[Bench],
        gpu: Option<&Gpu>,
    ) -> anyhow::Result<(Vec<Row>, Vec<Vec<Solution>>)> {
        let threads = threads();
        let (mut rows, mut truths) = (Vec::new(), Vec::new());
        for bench in benches {
            self.say(format!("{:<10} {} ({} cells)", bench.name, bench.title, bench.len()));
            let progress = Bar::new(bench.len(), self.quiet);
            let truth =
                truth::of_bench(bench, &truth::settings(bench), &|cells| progress.advance(cells));
            progress.finish();
            for trial in trial::of(bench, gpu) {
                let (solutions, time) = trial.run(bench, gpu)?;
                let cells = bench.len() as f64;
                let row = Row {
                    bench: bench.name,
                    method: trial.method.name().into(),
                    precision: trial.precision.key(),
                    steps: trial.method != Method::Reference,
                    setting: trial.setting,
                    threads,
                    seconds: time.whole / cells,
                    device: time.device.map(|device| device / cells),
                    start: time.start,
                    runs: time.runs,
                    errors: compare(
                        &truth,
                        &solutions,
                        Compared { switches: bench.whole, zeta: trial.method.has_zeta() },
                    ),
                };
                self.say(line(&trial, &row));
                rows.push(row);
            }
            truths.push(truth);
        }
        Ok((rows, truths))
    }
}

/// Draws the charts of all benches that have rows.
fn draw(out: &Directory, benches: &[Bench], rows: &[Row]) -> anyhow::Result<()> {
    for bench in benches {
        let of_bench: Vec<Row> =
            rows.iter().filter(|row| row.bench == bench.name).cloned().collect();
        if of_bench.is_empty() {
            continue;
        }
        let picture = figure::draw(&bench.title, &of_bench)?;
        write_picture(out, bench.name, &picture, &picture.png()?)?;
    }
    Ok(())
}

/// A trial in one line.
fn line(trial: &Trial, row: &Row) -> String {
    let setting = if row.steps {
        format!("1/{:.0} s", 1.0 / trial.setting)
    } else {
        format!("{:.0e}", trial.setting)
    };
    let e = &row.errors;
    let median = |spread: Option<topple_lab::chart::errors::Spread>| {
        spread.map_or("-".into(), |spread| format!("{:.1e}", spread.median))
    };
    format!(
        "  {:<19}{} {setting:>9} {:>9.1e} s/cell {:>6} differ {:>4} failed   t {:>7}   zeta {:>7}",
        row.method,
        row.precision,
        row.seconds,
        e.differ,
        e.failed,
        median(e.time),
        median(e.zeta)
    )
}
