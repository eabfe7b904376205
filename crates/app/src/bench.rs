//! `topple bench`: what this machine makes of the same maps, backend by backend.

use std::path::PathBuf;
use std::time::Instant;

use sysinfo::{CpuRefreshKind, RefreshKind, System};
use topple::Written;
use topple::backend::cell_run::CellRun;
use topple::backend::gpu::adapter;
use topple::backend::gpu::opened::Gpu;
use topple::backend::gpu::run::Sweeper;
use topple::backend::report::threads;
use topple::backend::{cpu, lanes};
use topple::cells::clock;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::model::real::Real;
use topple::scene::builder::SceneBuilder;
use topple::scene::record::synthetic;
use topple::scene::{Grid, Parameter, Range, Scene};
use topple::stepping::operations::of_step;
use topple::stepping::outcome::Outcome;
use topple::work::observer::{Observer, Unwatched};

use super::print::print_line;
use super::progress::Bar;
use super::{InputError, examples, ratios, words};

/// Most points of an axis: a map of 4096 x 4096 takes two gigabytes.
const MOST: u32 = 4096;

/// Measure every backend of this machine on the same maps, and print the table.
#[derive(clap::Args)]
#[command(after_help = examples::BENCH)]
pub struct BenchCommand {
    /// Points of each axis of the default map; the other maps have a quarter of that
    #[arg(long, value_name = "N", default_value_t = 400)]
    side: u32,
    /// How often each map is run; the shortest time counts
    #[arg(long, value_name = "N", default_value_t = 3)]
    repeat: u32,
    /// Peak performance of the card in f32, to give the shader's share of it
    #[arg(long, value_name = "TFLOPS")]
    peak: Option<f64>,
    /// Leave out the shader
    #[arg(long)]
    no_shader: bool,
    /// Results of other programs for cells of the pulse map (from benches/peers/ratios.sh): print only the comparison with them
    #[arg(long, value_name = "FILE")]
    peer: Vec<PathBuf>,
}

/// A map that all backends run.
struct Course {
    plan: Plan,
    grid: Grid,
    cells: Vec<usize>,
}

/// What a backend made of the three maps: seconds each.
struct Row {
    name: String,
    precision: Precision,
    shader: bool,
    seconds: [f64; 3],
}

fn scene(rest: &str) -> anyhow::Result<Scene> {
    let text = format!("[block]\nobject = 1\neccentricity = 0.2\n{rest}");
    let text = SceneBuilder::from_toml(&text).map_err(anyhow::Error::msg)?;
    Ok(text.check()?)
}

fn course(scene: &Scene, full: bool) -> anyhow::Result<Course> {
    let plan = Plan::new(scene, clock::DEFAULT_STEP)?;
    let grid = Grid::of(scene);
    let cells = (0..grid.len()).collect();
    Ok(Course { plan: if full { plan.full_model() } else { plan }, grid, cells })
}

impl BenchCommand {
    /// Runs and prints.
    pub fn run(&self) -> anyhow::Result<()> {
        if !(4..=MOST).contains(&self.side) || self.repeat == 0 {
            let problem = format!("--side, --repeat: give 4 to {MOST} points, and once at least");
            return Err(InputError(problem).into());
        }
        if self.peak.is_some_and(|peak| !(peak > 0.0 && peak.is_finite())) {
            return Err(InputError("--peak: give the card's peak in TFLOPS".into()).into());
        }
        let cpus =
            System::new_with_specifics(RefreshKind::nothing().with_cpu(CpuRefreshKind::nothing()));
        let brand = cpus.ok().and_then(|system| Some(system.cpus().first()?.brand().to_string()));
        let brand = brand.unwrap_or_else(|| "processor".into());
        print_line!("{brand}, {} threads, topple {}", threads(), env!("CARGO_PKG_VERSION"));
        if !self.peer.is_empty() {
            return ratios::print(&self.peer);
        }
        let courses = self.courses()?;
        let mut rows = Vec::new();
        for precision in [Precision::F64, Precision::F32] {
            let name = "a cell at a time".to_string();
            rows.push(self.time(name, precision, false, &courses, &|course| {
                let Course { plan, grid, cells } = course;
                cpu::sweep_one_by_one(precision, plan, grid, cells, &Unwatched);
                Ok(())
            })?);
            for (name, level) in lanes::levels() {
                rows.push(self.time(name.into(), precision, false, &courses, &|course| {
                    let Course { plan, grid, cells } = course;
                    let run = CellRun::of(plan, grid, cells, precision);
                    lanes::sweep(&run, &Unwatched, level);
                    Ok(())
                })?);
            }
            if !self.no_shader
                && let Ok(adapter) = adapter::best(precision)
            {
                let gpu = match Gpu::open(&adapter) {
                    Ok(gpu) => gpu,
                    Err(error) => {
                        words::warn(format!("{error}; the shader is left out"));
                        continue;
                    }
                };
                let name = format!("shader, {}", gpu.description.name);
                rows.push(self.time(
                    name,
                    precision,
                    true,
                    &courses,
                    &|course| match precision {
                        Precision::F32 => by_shader::<f32>(&gpu, precision, course),
                        Precision::F64 => by_shader::<f64>(&gpu, precision, course),
                    },
                )?);
            }
        }
        self.print(&rows, &courses);
        Ok(())
    }

    /// The default map, the same with nothing left out, and a record's.
    fn courses(&self) -> anyhow::Result<[Course; 3]> {
        let quarter = self.side.div_ceil(4).max(2);
        let map = |side: u32| {
            scene(&format!(
                "[base]\nt_h = 1.75\nt_v = 0.75\n[pulse]\nomega = \"0.2:15:{side}\"\n\
                 a_h = \"0.1:15:{side}\"\n"
            ))
        };
        let mut shaken = scene("[base]\nt_h = 1.0\nt_v = 1.0\n[pulse]\nomega = 5.0\na_h = 1.0\n")?;
        shaken.set(Parameter::TH, Range::even(0.5, 4.0, quarter));
        shaken.set(Parameter::TV, Range::even(0.02, 2.0, quarter));
        shaken.shake(synthetic::pair());
        Ok([
            course(&map(self.side)?, false)?,
            course(&map(quarter)?, true)?,
            course(&shaken, false)?,
        ])
    }

    /// A backend's shortest times on the courses.
    fn time(
        &self,
        name: String,
        precision: Precision,
        shader: bool,
        courses: &[Course; 3],
        sweep: &dyn Fn(&Course) -> anyhow::Result<()>,
    ) -> anyhow::Result<Row> {
        let progress = Bar::new(courses.len(), false);
        let mut seconds = [f64::INFINITY; 3];
        for (course, shortest) in courses.iter().zip(&mut seconds) {
            let Course { plan, grid, cells } = course;
            let (plan, grid, cells) = (plan.at(precision), grid.clone(), cells.clone());
            let course = Course { plan, grid, cells };
            for _ in 0..self.repeat {
                let began = Instant::now();
                sweep(&course)?;
                *shortest = shortest.min(began.elapsed().as_secs_f64());
            }
            progress.advance(1);
        }
        progress.finish();
        Ok(Row { name, precision, shader, seconds })
    }

    fn print(&self, rows: &[Row], courses: &[Course; 3]) {
        let cells = courses.each_ref().map(|course| course.cells.len() as f64);
        // A cell at a time in f64: the other results are given as multiples of it.
        let base = rows[0].seconds;
        let steps = steps(&courses[1]) as f64;
        print_line!("cells a second, and times a cell at a time in f64:\n");
        print_line!(
            "| {:<40} | numbers | default map {1}² |      × | all 30 s {2}² |     × | record {2}² |     × | Gflop/s |",
            "backend",
            self.side,
            courses[1].grid.shape().0
        );
        print_line!("|{}|---|--:|--:|--:|--:|--:|--:|--:|", "-".repeat(42));
        for row in rows {
            let rate = |i: usize| match cells[i] / row.seconds[i] {
                // A slow machine has some, too.
                few if few < 10.0 => format!("{few:.3}"),
                many => format!("{many:.0}"),
            };
            let times = |i: usize| base[i] / row.seconds[i];
            let flops = f64::from(self.flops(&courses[1], row.precision));
            let giga = flops * steps / row.seconds[1] / 1.0e9;
            print_line!(
                "| {:<40} | {:<7} | {:>17} | {:>6.2} | {:>14} | {:>5.2} | {:>10} | {:>5.2} | {:>7.3} |",
                row.name,
                row.precision.key(),
                rate(0),
                times(0),
                rate(1),
                times(1),
                rate(2),
                times(2),
                giga
            );
        }
        let variant = courses[1].plan.variant();
        for (phase, rocking) in [("full contact", false), ("rocking", true)] {
            let one = of_step(variant, rocking, false);
            print_line!(
                "\na step in {phase}: {} flops ({} sums, {} products, {} fused, {} divisions)",
                one.flops(),
                one.sums,
                one.products,
                one.fused,
                one.divisions
            );
        }
        print_line!(
            "Gflop/s are those of the equations in full contact over all steps: a lower bound"
        );
        let shader = rows.iter().find(|row| row.shader && row.precision == Precision::F32);
        match (shader, self.peak) {
            (Some(row), Some(peak)) => {
                let flops = f64::from(self.flops(&courses[1], row.precision));
                let share = flops * steps / row.seconds[1] / (peak * 1.0e12);
                print_line!("share of the card's peak of {peak} Tflop/s: {:.1} %", 100.0 * share);
            }
            (Some(_), None) => print_line!("share of the card's peak: ____ (give --peak TFLOPS)"),
            (None, _) => print_line!("no shader was run: without a GPU there is none to measure"),
        }
    }

    /// Operations of a step in full contact, as most are when nothing is left out.
    fn flops(&self, course: &Course, precision: Precision) -> u32 {
        of_step(course.plan.variant(), false, precision == Precision::F64).flops()
    }
}

fn by_shader<R: Real>(gpu: &Gpu, precision: Precision, course: &Course) -> anyhow::Result<()> {
    let Course { plan, grid, cells } = course;
    let sweeper = Sweeper::new(gpu, precision, plan.variant())?;
    sweeper.sweep::<R>(plan, grid, cells, &Unwatched)?;
    Ok(())
}

/// Steps that all cells of a course take.
fn steps(course: &Course) -> u64 {
    let Course { plan, grid, cells } = course;
    let outcomes = cpu::sweep(Precision::F32, plan, grid, cells, &Unwatched);
    let of = |(&index, cell): (&usize, &Outcome)| {
        plan.clock(&grid.case(index)).steps_until(cell.t_simulated)
    };
    cells.iter().zip(&outcomes).map(of).sum()
}
