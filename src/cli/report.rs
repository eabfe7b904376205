//! A map from scene to files, and what is said about it.

use std::path::{Path, PathBuf};
use std::time::Instant;

use rayon::prelude::*;
use sysinfo::{MemoryRefreshKind, RefreshKind, System};
use topple::integrate::outcome::{Class, Outcome};
use topple::map::figure::FigureError;
use topple::map::figure::{document, field, frame, overturning};
use topple::map::files::{Directory, WriteError};
use topple::map::manifest::{self, Manifest, Reduced, Steps, Timings};
use topple::map::{self, Map};
use topple::scene::{Excitation, Grid, Scene};
use topple::sweep::backend::Backend;
use topple::sweep::plan::{Plan, Reductions};
use topple::sweep::verification::{self, Verification};

use super::InputError;
use super::options::{RunOptions, flag_error};
use super::progress::Progress;

/// Memory that a cell takes beside its outcome: its number, a column of the archive, its row of the
/// picture, and its share of what the threads hold.
const BYTES_A_CELL: usize = 40;

/// Pixels of a PNG for each of its SVG's units.
pub const PNG_SCALE: f32 = 2.0;

/// Runs a scene's map and writes its files.
pub fn run_map(scene: &Scene, options: &RunOptions) -> anyhow::Result<()> {
    let mut plan = Plan::new(scene, options.step).map_err(|e| flag_error(&e))?;
    if options.full_model {
        plan = plan.full_model();
    }
    let grid = Grid::of(scene);
    // Two sweeps are held beside each other, and parts until they are put in order.
    let held = if options.resolve || plan.rigid_period().is_some() { 2 } else { 1 };
    check_memory(&grid, held)?;
    let out = open(&options.out)?;
    let began = Instant::now();
    let backend = options.open_backend()?;
    let opened = began.elapsed();
    let say = |line: String| {
        if !options.quiet {
            println!("{line}");
        }
    };
    let (columns, rows) = grid.shape();
    let precision = options.precision.name();
    say(format!("scene      {}, {columns} x {rows} cells", scene.title));
    say(format!("           {}", frame::caption(scene)));
    if let Excitation::Record(pair) = &scene.excitation {
        say(format!("record     {}, {} samples at {} s", pair.title, pair.len(), pair.dt));
        for note in &pair.notes {
            say(format!("           {note}"));
        }
    }
    say(format!("backend    {}", describe(&backend, precision)));
    say(format!("model      {}", describe_model(&plan)));
    let runs = if options.resolve { 2 } else { 1 };
    let progress = Progress::new(runs * grid.len(), options.quiet);
    let advance = |cells| progress.advance(cells);
    let swept = if options.resolve {
        backend.sweep_resolved(&plan, &grid, options.precision, &advance)
    } else {
        backend.sweep(&plan, &grid, options.precision, &advance)
    };
    progress.finish();
    let swept = swept?;
    let seconds = swept.elapsed.as_secs_f64();
    let rate = grid.len() as f64 / seconds.max(1.0e-9);
    say(format!("sweep      {seconds:.2} s, {rate:.0} cells/s"));
    let map = Map { scene, grid, outcomes: swept.outcomes };
    say(format!("outcomes   {}", shares(&map)));
    let judged = Instant::now();
    let verification = verification::verify(&plan, &grid, &map.outcomes, verification::SAMPLE);
    let timings = Timings {
        start: (opened + swept.compile).as_secs_f64(),
        sweep: seconds,
        verification: judged.elapsed().as_secs_f64(),
    };
    say(format!("reference  {}", agreement(&verification)));
    let steps = steps(&plan.at(options.precision), &grid);
    let manifest = Manifest {
        version: env!("CARGO_PKG_VERSION"),
        scene,
        cells: grid.len(),
        backend: backend.name(),
        adapter: backend.adapter(),
        threads: threads(),
        precision: options.precision,
        resolve: options.resolve,
        steps,
        timings,
        cells_per_second: rate,
        outcomes: manifest::outcomes(&map),
        tensile_cells: map.tensile(),
        sliding_cells: map.sliding(),
        model: Reduced::of(&plan, &map),
        verification: &verification,
    };
    let picture = write(&out, &map, &manifest)?;
    say(format!("picture    {}", picture.display()));
    say(format!("data       {} with map.npz, map.svg, run.json", out.file("map.csv").display()));
    Ok(())
}

/// Opens the directory for the results.
pub fn open(out: &Path) -> Result<Directory, InputError> {
    Directory::open(out).map_err(|error| InputError(format!("--out: {error}")))
}

/// Threads that a sweep on the CPU takes.
pub fn threads() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

fn check_memory(grid: &Grid, held: usize) -> Result<(), InputError> {
    let memory = RefreshKind::nothing().with_memory(MemoryRefreshKind::nothing().with_ram());
    let available =
        System::new_with_specifics(memory).map_or(0, |system| system.available_memory());
    let needed = grid.len() as u64 * (held * size_of::<Outcome>() + BYTES_A_CELL) as u64;
    // A machine that does not tell has the benefit of the doubt.
    if available == 0 || needed <= available {
        return Ok(());
    }
    let (columns, rows) = grid.shape();
    let giga = |bytes: u64| bytes as f64 / f64::from(1 << 30);
    Err(InputError(format!(
        "--{}, --{}: {columns} x {rows} cells take {:.1} GiB and {:.1} GiB are free; give fewer points",
        grid.x.key.replace('_', "-"),
        grid.y.key.replace('_', "-"),
        giga(needed),
        giga(available)
    )))
}

fn describe(backend: &Backend, precision: &str) -> String {
    match backend {
        Backend::Gpu(gpu) => {
            let adapter = &gpu.description;
            format!("gpu, {precision}, {} ({}, {})", adapter.name, adapter.kind, adapter.api)
        }
        Backend::Cpu => {
            let threads = threads();
            format!("cpu, {precision}, {threads} threads")
        }
        Backend::Reference => "reference, f64, adaptive".into(),
    }
}

/// The coordinates that are integrated, and what is left out.
fn describe_model(plan: &Plan) -> String {
    let variant = plan.variant();
    let mut state = Vec::new();
    if variant.isolated_h {
        state.push(if variant.yields { "u z" } else { "u" });
    }
    if variant.isolated_v {
        state.push("v");
    }
    state.push("φ");
    let reductions = plan.reductions;
    let mut parts = vec![state.join(" ")];
    if reductions == Reductions::NONE {
        parts.push("nothing left out".into());
    }
    if reductions.certificate {
        parts.push("cells end where energy proves them final".into());
    }
    if reductions.full_contact && plan.scene.tilt == 0.0 {
        parts.push("full contact shared".into());
    }
    parts.join(", ")
}

fn shares(map: &Map) -> String {
    let total = map.outcomes.len() as f64;
    let mut parts = Vec::new();
    for class in Class::ALL {
        let count = map.count(class);
        if count > 0 {
            let percent = 100.0 * count as f64 / total;
            parts.push(format!("{} {percent:.1} %", class.name().replace('_', " ")));
        }
    }
    let tensile = map.tensile();
    if tensile > 0 {
        let percent = 100.0 * tensile as f64 / total;
        parts.push(format!("contact force tensile in {percent:.1} %"));
    }
    if let (Some(sliding), Some(mu)) = (map.sliding(), map.scene.friction) {
        let percent = 100.0 * sliding as f64 / total;
        parts.push(format!("friction above {mu} asked for in {percent:.1} %"));
    }
    parts.join(", ")
}

fn agreement(v: &Verification) -> String {
    let unresolved = match v.unresolved {
        0 => String::new(),
        count => format!("{count} unresolved, "),
    };
    format!(
        "{} cells again, {} beside a boundary: {unresolved}{} differ in outcome, {} in impacts; \
         t_end within {:.0e} s, zeta within {:.0e}",
        v.sampled, v.beside_boundary, v.differ, v.impacts_differ, v.worst_t_end, v.worst_zeta
    )
}

fn steps(plan: &Plan, grid: &Grid) -> Steps {
    let mut steps =
        Steps { largest: plan.resolution.largest_step, shortest: f64::INFINITY, most: 0 };
    for index in 0..grid.len() {
        let clock = plan.clock(&grid.point(index));
        let step = if clock.step_free > 0.0 { clock.step_free } else { clock.step_forced };
        steps.shortest = steps.shortest.min(step);
        steps.most = steps.most.max(clock.steps);
    }
    steps
}

fn write(out: &Directory, map: &Map, manifest: &Manifest) -> anyhow::Result<PathBuf> {
    let figures = figures(map)?;
    out.write("map.csv", |w| map::csv::write(map, w))?;
    out.write("map.npz", |w| map::npz::write(map, w))?;
    if matches!(map.scene.excitation, Excitation::Record(_)) {
        out.write("boundaries.csv", |w| map::boundaries::write(map, w))?;
    }
    for (name, svg, png) in &figures {
        write_figure(out, name, svg, png)?;
    }
    write_json(out, manifest)?;
    Ok(out.file("map.png"))
}

/// A picture's name, its SVG and its PNG.
type Figure = (&'static str, String, Vec<u8>);

/// The pictures of a map: its outcomes for a pulse, its fields for a record.
fn figures(map: &Map) -> Result<Vec<Figure>, FigureError> {
    let finish = |name, svg: String| {
        let png = document::render(&svg, PNG_SCALE)?;
        Ok((name, svg, png))
    };
    match map.scene.excitation {
        Excitation::Pulse(_) => Ok(vec![finish("map", overturning::draw(map)?)?]),
        Excitation::Record(_) => {
            let mut figures: Vec<Figure> = field::FIELDS
                .par_iter()
                .map(|field| finish(field.name, field::draw(map, field)?))
                .collect::<Result<_, _>>()?;
            let [normal, friction] = &field::CONTACT;
            let (left, right) = (field::draw(map, normal)?, field::draw(map, friction)?);
            figures.push(finish(normal.name, document::beside(frame::SIZE, &left, &right))?);
            Ok(figures)
        }
    }
}

/// Writes a picture as NAME.svg and NAME.png.
pub fn write_figure(out: &Directory, name: &str, svg: &str, png: &[u8]) -> Result<(), WriteError> {
    use std::io::Write;
    out.write(&format!("{name}.svg"), |w| w.write_all(svg.as_bytes()))?;
    out.write(&format!("{name}.png"), |w| w.write_all(png))?;
    Ok(())
}

/// Writes run.json.
pub fn write_json(out: &Directory, manifest: &impl serde::Serialize) -> Result<(), WriteError> {
    out.write("run.json", |w| serde_json::to_writer_pretty(w, manifest))?;
    Ok(())
}
