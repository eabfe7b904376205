//! What is said about a run.

use std::fmt::Display;
use std::time::Duration;

use super::print::{error_line, print_line};
use topple::drawing::caption;
use topple::map::manifest::Timings;
use topple::model::block::Model;
use topple::model::precision::Precision;
use topple::results::tally::Tally;
use topple::scene::{Case, Directions, Excitation, Grid, Scene, Values};
use topple::stepping::outcome::Class;
use topple::sweep::backend::Backend;
use topple::sweep::plan::Plan;
use topple::sweep::report::{Report, threads};
use topple::sweep::shortcuts::Shortcuts;
use topple::sweep::verification::{Verdict, Verification, ZETA_OFF};

/// Says things, a name and what there is to it a line; or nothing, for who wants quiet.
pub struct Say(bool);

impl Say {
    /// Says nothing where it is to be quiet.
    pub fn unless(quiet: bool) -> Say {
        Say(!quiet)
    }

    /// Says a line.
    pub fn line(&self, name: &str, text: impl Display) {
        if self.0 {
            print_line!("{name:<10} {text}");
        }
    }
}

/// Says on stderr what the user should know though the run goes on.
pub fn warn(text: impl Display) {
    error_line(format_args!("topple: warning: {text}"));
}

/// Settings that messages of the library name.
const KEYS: [&str; 5] = ["adapter", "backend", "precision", "resume", "tile"];

/// A message of the library with flags in the place of its keys: `resume` in backquotes is --resume.
pub fn with_flags(text: &str) -> String {
    let mut flags = String::with_capacity(text.len());
    for (number, piece) in text.split('`').enumerate() {
        match number % 2 {
            1 if KEYS.contains(&piece) => flags.push_str(&format!("--{piece}")),
            // What others quote, such as a field of a damaged file.
            1 => flags.push_str(&format!("`{piece}`")),
            _ => flags.push_str(piece),
        }
    }
    flags
}

/// The points of a grid's axes: `400 x 400`.
pub fn sides(grid: &Grid) -> String {
    let counts: Vec<String> = grid.axes().iter().map(|axis| axis.count().to_string()).collect();
    counts.join(" x ")
}

/// A scene and its cells.
pub fn scene(say: &Say, scene: &Scene, grid: &Grid) {
    say.line("scene", format!("{}, {} cells", scene.title, sides(grid)));
    say.line("", caption::caption(scene));
    if let Excitation::Record(pair) = &scene.excitation {
        say.line("record", format!("{}, {} samples at {} s", pair.title, pair.len(), pair.dt));
        for note in &pair.notes {
            say.line("", note);
        }
    }
}

/// Warns of pulses that end after their run.
pub fn warn_of_cut_pulses(grid: &Grid) {
    if let Some((longest, t_max)) = cut(grid) {
        let whole = longest.ceil();
        warn(format!(
            "the longest pulse lasts {longest:.1} s, but its run ends at {t_max} s; t_max = {whole} covers it"
        ));
    }
}

/// Share of the angular velocity that an impact takes below which it takes none.
const NO_LOSS: f64 = 1.0e-9;

/// Warns of blocks whose impacts take no angular velocity, as where the plates have no mass: they chatter for
/// long, and only the base damps their rocking.
pub fn warn_of_lossless_impacts(plan: &Plan, grid: &Grid) {
    let loss = |case: &Case| {
        let model: Model<f64> = plan.model(case);
        1.0 - model.left.eta_phi.min(model.right.eta_phi)
    };
    if !grid.corners().any(|case| loss(&case) < NO_LOSS) {
        return;
    }
    warn(match plan.scene.isolation {
        Directions::None => "impacts take no speed: restitution is 1",
        _ => {
            "without masses of the plates the law of impact (17) takes no energy, so that the block chatters for \
             long; give plate_h and plate_v"
        }
    });
}

/// Share of a pulse without which it is said to be cut.
const TAIL: f64 = 0.1;

/// The longest pulse that loses more than its tail to the end of its run, s, and that end.
fn cut(grid: &Grid) -> Option<(f64, f64)> {
    let longest = |case: &Case| Some((case.shaking.pulse()?.duration(), case.t_max));
    grid.corners()
        .filter_map(|case| longest(&case))
        .filter(|(pulse, t_max)| *t_max < (1.0 - TAIL) * pulse)
        .max_by(|(a, _), (b, _)| a.total_cmp(b))
}

/// What is about to be run, and on what.
pub fn head(say: &Say, plan: &Plan, grid: &Grid, backends: &[Backend], precision: Precision) {
    scene(say, &plan.scene, grid);
    let several = if backends.len() > 1 { format!("{} x ", backends.len()) } else { String::new() };
    say.line("backend", format!("{several}{}", backend(&backends[0], precision.name())));
    say.line("model", model(plan));
}

/// The backend, in a few words.
fn backend(backend: &Backend, precision: &str) -> String {
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
fn model(plan: &Plan) -> String {
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
    if reductions == Shortcuts::NONE {
        parts.push("nothing left out".into());
    }
    if reductions.certificate {
        parts.push("cells stop early when energy proves their outcome final".into());
    }
    if reductions.full_contact && !Grid::of(&plan.scene).tilts() {
        parts.push("full contact shared".into());
    }
    parts.join(", ")
}

/// The share of each outcome.
pub fn shares(tally: &Tally, friction: Option<&Values>) -> String {
    let percent = |count: usize| 100.0 * count as f64 / tally.cells as f64;
    let mut parts = Vec::new();
    for class in Class::ALL {
        let count = tally.count(class);
        if count > 0 {
            parts.push(format!("{} {:.1} %", class.name().replace('_', " "), percent(count)));
        }
    }
    if tally.tensile > 0 {
        parts.push(format!("contact force tensile in {:.1} %", percent(tally.tensile)));
    }
    if let (Some(sliding), Some(mu)) = (tally.sliding, friction) {
        let mu = if mu.count() == 1 { mu.to_string() } else { "μ".into() };
        parts.push(format!("friction above {mu} asked for in {:.1} %", percent(sliding)));
    }
    parts.join(", ")
}

/// Cells that took so many seconds.
pub fn speed(cells: usize, seconds: f64) -> String {
    format!("{seconds:.2} s, {:.0} cells/s", cells as f64 / seconds.max(1.0e-9))
}

/// What a part is, in a line.
pub fn part(report: &Report) -> String {
    let on = match &report.adapter {
        Some(adapter) => format!("{}, {}", report.backend, adapter.name),
        None => report.backend.clone(),
    };
    format!("{} cells from number {} on, {on}", report.cells, report.first)
}

/// The time of each phase of a map.
pub fn phases(took: &Timings) -> String {
    let Timings { start, estimate, sweep, counting, drawing, writing, verification } = *took;
    let phases = [
        ("start", Some(start)),
        ("estimate", Some(estimate)),
        ("sweep", Some(sweep)),
        ("counting", Some(counting)),
        ("drawing", Some(drawing)),
        ("writing", Some(writing)),
        ("verification", verification),
    ];
    let told = phases.iter().filter_map(|(name, took)| Some(format!("{name} {:.2} s", (*took)?)));
    told.collect::<Vec<_>>().join(", ")
}

/// How the reference's sample came out, which had so much time.
pub fn agreement(v: &Verification, within: Duration) -> String {
    let left_out = match v.chosen - v.sampled {
        0 => String::new(),
        _ => format!(" of {}, as many as {} s allowed", v.chosen, within.as_secs()),
    };
    let unresolved = match v.unresolved {
        0 => String::new(),
        count => format!("{count} unresolved, "),
    };
    format!(
        "{} cells again{left_out}, {} beside a boundary: {unresolved}{} differ in outcome, {} in impacts; \
         t_end within {:.0e} s, zeta within {:.0e}",
        v.sampled, v.beside_boundary, v.differ, v.impacts_differ, v.worst_t_end, v.worst_zeta
    )
}

/// So many cells.
fn cells(count: usize) -> String {
    if count == 1 { "1 cell".into() } else { format!("{count} cells") }
}

/// What the sample says of the map, in a sentence.
pub fn verdict(v: &Verification) -> String {
    let places = [
        (v.differ_tensile, "where the contact force is tensile (hatched)"),
        (v.differ_beside_boundary, "beside a boundary"),
        (v.differ_inside(), "amid cells of one outcome"),
    ];
    let places: Vec<String> = places
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, place)| format!("{count} {place}"))
        .collect();
    let places = places.join(", ");
    match v.verdict {
        Verdict::Right if v.worst_zeta > ZETA_OFF => format!(
            "every outcome of the sample is right, but zeta of one cell at least is off by {:.0e}",
            v.worst_zeta
        ),
        Verdict::Right => "every outcome of the sample is right".into(),
        Verdict::AsExpected => {
            format!(
                "the map is right as far as can be expected: {} differ, {places}",
                cells(v.differ)
            )
        }
        Verdict::Wrong if v.differ == 0 => format!(
            "the map is not right: half of the rocking cells are off by {:.0e} in zeta or more; \
             try a smaller --step or --precision f64",
            v.median_zeta
        ),
        Verdict::Wrong => format!(
            "the map is not right: {} differ, {places}; try a smaller --step, --precision f64 or --resolve",
            cells(v.differ)
        ),
        Verdict::Nothing => {
            format!("nothing is verified; --verify {} takes the time that it needs", v.chosen)
        }
    }
}
