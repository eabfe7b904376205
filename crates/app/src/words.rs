//! What is said about a run.

use std::fmt::Display;

use anstyle::Style;

use super::call::{Call, lock};
use super::print::{self, NOTICE, PLAIN, RIGHT, WRONG};
use topple::Written;
use topple::backend::ready::Backend;
use topple::backend::report::{Report, threads};
use topple::cells::plan::Plan;
use topple::cells::shortcuts::Shortcuts;
use topple::model::block::Model;
use topple::model::precision::Precision;
use topple::refine::report::{ProbeRound, RefineReport};
use topple::results::tally::Tally;
use topple::scene::device_numbers::DeviceNumbers;
use topple::scene::keys;
use topple::scene::parameters::{Caption, PARAMETERS, Section};
use topple::scene::record::rounded;
use topple::scene::{Case, Directions, Excitation, Grid, Parameter, Scene, Values};
use topple::stepping::outcome::Class;
use topple::sweep::repaired::Repair;
use topple::sweep::verdict;
use topple::sweep::verification::{Verdict, Verification};
use topple_manifest::Timings;
use topple_pictures::drawing::letters::Missing;
use topple_pictures::drawing::share;
use topple_studies::sharpness::{Estimate, Sharpness};

/// Says things, a name and what there is to it a line; or nothing, for who wants quiet.
pub struct Reporter(bool);

impl Reporter {
    /// Says nothing where it is to be quiet.
    pub fn unless(quiet: bool) -> Reporter {
        Reporter(!quiet)
    }

    /// Says a line.
    pub fn line(&self, name: &str, text: impl Display) {
        self.styled(name, text, PLAIN);
    }

    /// Says a line in a style.
    pub fn styled(&self, name: &str, text: impl Display, style: Style) {
        if self.0 {
            print::named(name, &text.to_string(), style);
        }
    }
}

/// Says on stderr what the user should know though the run goes on.
pub fn warn(text: impl Display) {
    let text = text.to_string();
    print::warning(&text);
    lock(&Call::current().warnings).push(text);
}

/// Warns of letters of a picture that no font has, once for all pictures of a run.
pub fn warn_of_letters(missing: Option<Missing>) {
    let Some(missing) = missing else { return };
    let call = Call::current();
    let mut said = lock(&call.letters);
    if !missing.letters.is_subset(&said) {
        said.extend(&missing.letters);
        warn(missing);
    }
}

/// What the command has warned of until now.
pub fn warnings() -> Vec<String> {
    lock(&Call::current().warnings).clone()
}

/// Settings that messages of the library name.
const SETTINGS: [&str; 10] =
    ["adapter", "backend", "im", "levels", "precision", "resume", "step", "strict", "tile", "vary"];

/// The flag of a key of the library.
fn flag(key: &str) -> Option<String> {
    let mut words = Section::ALL.into_iter().flat_map(keys::words);
    match key {
        "shape" => Some("--pulse".into()),
        _ if SETTINGS.contains(&key) || words.any(|word| word == key) => {
            Some(format!("--{}", key.replace('_', "-")))
        }
        _ => Parameter::of_key(key).map(|parameter| parameter.entry().flag()),
    }
}

/// A message of the library with flags in the place of its keys: `resume` in backquotes is --resume.
pub fn with_flags(text: &str) -> String {
    in_place_of_keys(text, flag)
}

/// The same about a suite's list, where the keys of a record are columns.
pub fn with_columns(text: &str) -> String {
    in_place_of_keys(text, |key| match keys::words(Section::Record).contains(&key) {
        true => Some(format!("the column {key}")),
        false => flag(key),
    })
}

/// A message of the library about a scene's file: keys stay keys, settings are flags.
pub fn with_keys(text: &str) -> String {
    in_place_of_keys(text, |key| match key {
        "force" => Some("`force = true` under [run]".into()),
        _ if SETTINGS.contains(&key) => flag(key),
        _ => None,
    })
}

/// A message with other words in the place of the keys that it has in backquotes. What nothing is known of, such
/// as a field of a damaged file, stays.
fn in_place_of_keys(text: &str, other: impl Fn(&str) -> Option<String>) -> String {
    let pieces = text.split('`').enumerate().map(|(number, piece)| match number % 2 {
        1 => other(piece).unwrap_or_else(|| format!("`{piece}`")),
        _ => piece.into(),
    });
    pieces.collect()
}

/// So many things: `1 motion`, `2 motions`.
pub fn counted(count: usize, thing: &str) -> String {
    format!("{count} {thing}{}", if count == 1 { "" } else { "s" })
}

/// The points of a grid's axes: `400 x 400`.
pub fn sides(grid: &Grid) -> String {
    let counts: Vec<String> = grid.axes().iter().map(|axis| axis.count().to_string()).collect();
    counts.join(" x ")
}

/// A scene and its cells.
pub fn scene(say: &Reporter, scene: &Scene, grid: &Grid) {
    say.line("scene", {
        let cells =
            if grid.len() == 1 { "1 cell".into() } else { format!("{} cells", sides(grid)) };
        format!("{}, {cells}", scene.title)
    });
    say.line("", topple::scene::words::line(scene));
    axes(say, grid);
    block(say, scene);
    device(say, None, scene);
    record(say, scene);
    warn_of_doubts(scene);
}

/// What is swept, a line for each axis: a decimal comma makes a list of two numbers.
pub fn axes(say: &Reporter, grid: &Grid) {
    for axis in grid.axes().iter().filter(|axis| axis.count() > 1) {
        say.line("axis", topple::scene::words::axis(axis));
    }
}

/// The size of a scene's block, so that nobody takes half of the width for the width.
pub fn block(say: &Reporter, scene: &Scene) {
    if let Some(size) = topple::scene::words::size(scene) {
        say.line("block", size);
    }
}

/// Warns of what may be wrong with a scene's record.
pub fn warn_of_doubts(scene: &Scene) {
    let doubts = scene.excitation.record().map_or(&[][..], |pair| &pair.doubts);
    doubts.iter().for_each(|doubt| warn(with_flags(doubt)));
}

/// The record of a scene, with what was decided of it.
pub fn record(say: &Reporter, scene: &Scene) {
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
            "the longest pulse lasts {longest:.1} s, but its run ends at {t_max} s; a t_max of {whole} s covers it"
        ));
    }
}

/// Says what the numbers of a device make of the base.
pub fn device(say: &Reporter, name: Option<&str>, scene: &Scene) {
    let name = name.map(|name| format!("{name}: ")).unwrap_or_default();
    if let Some(device) = DeviceNumbers::of(scene) {
        say.line("device", format!("{name}{device}"));
    }
    if let Some(stop) = stop(scene) {
        say.line("stop", format!("{name}{stop}"));
    }
}

/// The end stop of a base in words.
fn stop(scene: &Scene) -> Option<String> {
    let parts = [Parameter::StopGap, Parameter::StopStiffness, Parameter::StopXi]
        .map(|own| Some(own.entry().written(scene.numbers.get(own)?)));
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    (scene.isolation.moves_h() && scene.numbers.has(Parameter::StopGap)).then(|| parts.join(", "))
}

/// What all scenes have of the block, in words.
pub fn shared_block(scenes: &[Scene]) -> Vec<String> {
    let own = PARAMETERS.iter().filter(|entry| entry.section == Section::Block);
    own.filter_map(|entry| {
        let of = |scene: &Scene| scene.numbers.get(entry.parameter).and_then(Values::single);
        let first = of(scenes.first()?)?;
        let usual = entry.caption == Caption::Always;
        (usual && scenes.iter().all(|scene| of(scene) == Some(first))).then(|| entry.written(first))
    })
    .collect()
}

/// Warns of a friction pendulum that moves farther than its radius: its dish has an end before.
pub fn warn_of_radius(name: Option<&str>, radius: Option<&Values>, largest: f64) {
    let name = name.map(|name| format!("{name}: ")).unwrap_or_default();
    let radius = radius.map(|radius| radius.iter().fold(f64::INFINITY, f64::min));
    if let Some(radius) = radius.filter(|radius| largest > *radius) {
        warn(with_flags(&format!(
            "{name}max |u| of {} m is beyond the radius of the pendulum, {radius} m: {BEYOND}",
            rounded(largest, 3)
        )));
    }
}

/// Warns of so many cells of a map with such a pendulum.
pub fn warn_of_radii(cells: usize) {
    warn(with_flags(&format!(
        "in {} the block stands and max |u| is beyond the radius of the pendulum: {BEYOND}",
        verdict::cells(cells)
    )));
}

/// What is wrong where the base would have to pull the block down.
pub const TENSILE: &str = "the contact force is tensile, and the model does not hold";

/// What is wrong with a stroke beyond the radius, and what to do.
const BEYOND: &str =
    "no dish is so large, and the law is that of small angles; give its end stop (`stop_gap`)";

/// Share of the angular velocity that an impact takes below which it takes none.
const NO_LOSS: f64 = 1.0e-9;

/// True of blocks whose impacts take no angular velocity, as where the plates have no mass: they chatter for long, and
/// only the base damps their rocking.
pub fn has_lossless_impacts(plan: &Plan, grid: &Grid) -> bool {
    let loss = |case: &Case| {
        let model: Model<f64> = plan.model(case);
        1.0 - model.left.eta_phi.min(model.right.eta_phi)
    };
    grid.corners().any(|case| loss(&case) < NO_LOSS)
}

/// Warns of such blocks.
pub fn warn_of_lossless_impacts(plan: &Plan, grid: &Grid) {
    if !has_lossless_impacts(plan, grid) {
        return;
    }
    warn(match plan.scene.isolation {
        Directions::None => "impacts take no speed: restitution is 1",
        _ => {
            "without masses of the plates the law of impact (17) takes no energy, so that the block chatters for \
             long; give the plates' masses (plate_h, plate_v)"
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
pub fn head(say: &Reporter, plan: &Plan, grid: &Grid, backends: &[Backend], precision: Precision) {
    scene(say, &plan.scene, grid);
    let several = if backends.len() > 1 { format!("{} x ", backends.len()) } else { String::new() };
    say.line("backend", format!("{several}{}", backend(&backends[0], precision.key())));
    let by_reference = matches!(backends[0], Backend::Reference);
    say.line("model", if by_reference { model(&plan.full_model()) } else { model(plan) });
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
            format!("cpu, {precision}, {}", counted(threads, "thread"))
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
    let shortcuts = plan.shortcuts;
    let mut parts = vec![state.join(" ")];
    if shortcuts == Shortcuts::NONE {
        parts.push("nothing left out".into());
    }
    if variant.certificate {
        parts.push("cells end early when an energy bound proves their results final".into());
    }
    if shortcuts.full_contact && plan.shares_contact() && !Grid::of(&plan.scene).tilts() {
        parts.push("full contact is integrated once for all cells that share it".into());
    }
    parts.join(", ")
}

/// The share of each outcome.
pub fn shares(tally: &Tally, friction: Option<&Values>) -> String {
    let percent = |count: usize| share::percent(count as f64 / tally.cells as f64);
    let mut parts = Vec::new();
    for class in Class::ALL {
        let count = tally.count(class);
        if count > 0 {
            parts.push(format!("{} {}", class.name().replace('_', " "), percent(count)));
        }
    }
    match tally.tensile {
        Some(0) => {}
        Some(tensile) => parts.push(format!("contact force tensile in {}", percent(tensile))),
        None => parts.push(
            "contact forces not asked for, and cells where they are tensile not hatched".into(),
        ),
    }
    if let (Some(sliding), Some(mu)) = (tally.sliding, friction) {
        let mu = if mu.count() == 1 { mu.to_string() } else { "μ".into() };
        parts.push(format!("friction above {mu} needed in {}", percent(sliding)));
    }
    parts.join(", ")
}

/// How sharp boundaries are, in lines.
pub fn sharpness(sharpness: &Sharpness) -> Vec<String> {
    let told = |estimate: &Estimate| {
        let Estimate { value, low, high } = estimate;
        format!("{value:.3} ({low:.3} to {high:.3})")
    };
    let mut lines = Vec::new();
    let [wide, high] = sharpness.box_cells;
    let boxes = format!("in boxes of {wide} x {high} cells");
    if let (Some(s_b), Some(s_bb)) = (&sharpness.s_b, &sharpness.s_bb) {
        let says = match sharpness.above_ln_2 {
            true => "above ln 2: a boundary is fractal",
            false => "not above ln 2: no conclusion",
        };
        lines.push(format!("S_b = {:.3}, S_bb = {} {boxes}, {says}", s_b.value, told(s_bb)));
    } else if let Some(s_b) = &sharpness.s_b {
        lines.push(format!("S_b = {} {boxes}", told(s_b)));
    }
    if let (Some(alpha), Some(dimension), Some(farthest)) =
        (&sharpness.alpha, &sharpness.dimension, sharpness.distances.last())
    {
        let over = format!("over distances of 1 to {farthest} cells");
        lines.push(format!("α = {} {over}, D = {}", told(alpha), told(dimension)));
    }
    lines.extend(
        sharpness.not_told.iter().map(|why| format!("not told: {}", why.replace("alpha", "α"))),
    );
    lines
}

/// How a map was refined, in lines.
pub fn refined(report: &RefineReport) -> Vec<String> {
    let (columns, rows) = report.shape;
    let dense = columns as f64 * rows as f64;
    let mut lines = vec![format!(
        "{columns} x {rows} cells by {}, one of {:.0}; {} leaves; {:.2} s",
        report.cells,
        dense / report.cells as f64,
        report.leaves,
        report.seconds
    )];
    if report.marked > 0 {
        lines.push(format!(
            "{} cells not run, {:.2} %, are less sure: beside smaller leaves {}, between different numbers of impacts {}",
            report.marked,
            100.0 * report.marked as f64 / dense,
            report.beside,
            report.impacts_differ
        ));
    }
    if let Some(last) = report.last_round().filter(|last| last.left_alone > last.probes) {
        let ProbeRound { left_alone, probes, missed, share_missed_at_most, .. } = last;
        let most = share_missed_at_most * *left_alone as f64;
        lines.push(format!(
            "{missed} of {probes} cells drawn from the {left_alone} not run have another outcome: at 95 % no more \
             than {:.2} % of them, {most:.0}, have",
            100.0 * share_missed_at_most
        ));
        if let (Some(smooth), Some(share)) = (report.smooth, last.share_rough_at_most) {
            lines.push(format!(
                "of {} of them a number is off by more than {smooth} of its range: at 95 % of no more than {:.2} %",
                last.rough,
                100.0 * share
            ));
        }
    }
    lines
}

/// What the reference says of a sample of cells: so many that were computed again, of another outcome, and of these inside an area of
/// one outcome.
pub fn reference(sampled: usize, differ: usize, inside: usize) -> String {
    let again = format!("{sampled} cells computed again");
    let count =
        if differ == 1 { "1 outcome differs".into() } else { format!("{differ} outcomes differ") };
    match (differ, inside) {
        (0, _) => format!("{again}: all outcomes are equal"),
        (_, 0) => {
            format!(
                "{again}: {count}, where this is expected: beside a boundary between outcomes, or in chaotic motion"
            )
        }
        (_, some) => {
            format!(
                "{again}: {count}, {some} of them inside an area of one outcome: wrong there, or chaotic"
            )
        }
    }
}

/// How a map was repaired whose sweep took so many seconds.
pub fn repair(repair: &Repair, sweep: f64) -> String {
    let Repair { checked, changed, undecided, rounds, seconds, .. } = repair;
    let undecided = match undecided {
        0 => String::new(),
        count => format!(", {count} undecided"),
    };
    format!(
        "{} beside a boundary again in {rounds} rounds, in f64 with half the step: {changed} changed{undecided}; \
         {seconds:.2} s, {:.2} of the sweep's time",
        verdict::cells(*checked),
        seconds / sweep.max(1.0e-9)
    )
}

/// Cells that took so many seconds.
pub fn speed(cells: usize, seconds: f64) -> String {
    format!("{seconds:.2} s, {:.0} cells/s", cells as f64 / seconds.max(1.0e-9))
}

/// What a shard is, in a line.
pub fn shard(report: &Report) -> String {
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

/// How the verdict is said.
pub fn style(v: &Verification) -> Style {
    match v.verdict {
        Verdict::Right => RIGHT,
        Verdict::AsExpected => NOTICE,
        Verdict::Wrong => WRONG,
        Verdict::Nothing => WRONG,
    }
}
