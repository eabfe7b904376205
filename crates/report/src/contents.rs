//! The whole of a report: what was asked, the block, the motions, what was found, how far it was checked, what is left out, how to
//! repeat it.

use topple::results::earlier::{Kind, RUN};
use topple::scene::path_text::{self, PathText};
use topple::scene::record::{Baseline, Provenance, RecordFile};
use topple::scene::{Excitation, GRAVITY, Scene, shown, words};
use topple_manifest::{CommandLine, Run, Source, Sources};
use topple_pictures::drawing::picture::Picture;
use topple_studies::uncertain::Varied;

use super::document::{Document, Piece};
use super::folder::{Folder, ReportError};
use super::tables::{ROWS, number};
use super::{block, findings, summary};

/// The report of runs, under a title of theirs where none is given.
pub fn of(folders: &[Folder], asked: Option<&str>) -> Result<Document, ReportError> {
    let mut pieces = vec![Piece::Heading(1, "In short".into())];
    for folder in folders {
        if folders.len() > 1 {
            pieces.push(Piece::Heading(2, title(folder)));
        }
        pieces.push(Piece::List(summary::of(folder)?));
    }
    pieces.push(Piece::Heading(1, "What was asked".into()));
    let questions = folders.iter().map(|folder| match folder.scene() {
        Some(scene) => format!("{}: {}", title(folder), sentence(folder, scene)),
        None => format!("{}: {}", title(folder), findings::question(folder)),
    });
    pieces.push(Piece::List(questions.collect()));
    pieces.extend(blocks(folders));
    pieces.push(Piece::Heading(1, "The ground motions".into()));
    pieces.extend(motions(folders));
    pieces.push(Piece::Heading(1, "What was found".into()));
    for folder in folders {
        if folders.len() > 1 {
            pieces.push(Piece::Heading(2, title(folder)));
        }
        pieces.extend(findings::of(folder)?);
    }
    pieces.push(Piece::Heading(1, "How far it was checked".into()));
    let checks =
        folders.iter().map(|folder| format!("{}: {}", title(folder), summary::checked(folder)));
    pieces.push(Piece::List(checks.collect()));
    pieces.extend(warnings(folders));
    pieces.push(Piece::Heading(1, "What the model leaves out".into()));
    pieces.push(Piece::List(LEFT_OUT.map(String::from).to_vec()));
    pieces.push(Piece::Heading(1, "How to repeat it".into()));
    let mut hashes = Vec::new();
    for folder in folders {
        pieces.extend(repeated(folder, &mut hashes));
    }
    let title = match (asked, folders) {
        (Some(asked), _) => asked.to_string(),
        (None, [one]) => one.title().map_or_else(|| title(one), String::from),
        (None, several) => format!("{} runs of topple", several.len()),
    };
    Ok(Document { title, pieces })
}

/// What the runs warned of.
fn warnings(folders: &[Folder]) -> Vec<Piece> {
    let of = |folder| {
        let folder: &Folder = folder;
        folder.manifest.warnings.iter().map(|warning| format!("{}: {warning}", title(folder)))
    };
    let all: Vec<String> = folders.iter().flat_map(of).collect();
    match all.is_empty() {
        true => Vec::new(),
        false => vec![Piece::Text("The runs warned:".into()), Piece::List(all)],
    }
}

/// What no run of topple says anything about.
const LEFT_OUT: [&str; 8] = [
    "The motion is calculated in one vertical plane. A real block also turns about its vertical axis and rocks on its edges and corners.",
    "The block and the plates are rigid, and so is the ground below. A block that bends, cracks or has loose parts behaves otherwise.",
    "The block does not slide on its base. Where a map of the friction that is needed is given, compare it with the friction there is.",
    "The block is lifted at a sharp corner and loses speed at each impact by a formula, not by a measured value.",
    "The base does not pull at the block. Maps mark where it would have to, and histories and comparisons warn of it; envelopes and fragilities warn where \
     the ground itself accelerates downwards by more than g, and do not look further.",
    "Rocking depends on small differences: one single calculation says little of one real event. Shares over many motions say more.",
    "The model was compared with 490 shake-table tests of two granite blocks that stood on the ground. With half the visible width it missed most of the \
     overturnings; with one half-width that was fitted to the tests it was right in about nine of ten. No test of an isolated block was compared.",
    "Whether the ground motions are right for the site, and whether devices keep their numbers over the years, is not examined here.",
];

/// By what all motions of a suite are multiplied, where it is not 1.
fn scaled(folder: &Folder) -> String {
    let text = |scale| {
        format!(
            " Each is multiplied by {}; the peaks below are those of the records themselves.",
            number(scale)
        )
    };
    folder.scale().map_or(String::new(), text)
}

/// Of how many motions of a suite the baseline was changed; nothing where it was of none.
fn corrected(folder: &Folder) -> String {
    let is_changed = |source: &&Source| {
        let baseline = source.files.as_ref().and_then(|files| files.treatment.baseline);
        baseline.is_some_and(|baseline| baseline != Baseline::None)
    };
    match folder.run().records().into_iter().flat_map(Sources::values).filter(is_changed).count() {
        0 => String::new(),
        count => format!(
            " From the velocity of {count} of them a straight line was subtracted, so that the ground ends nearly at rest; the notes of the suite \
             have its slopes."
        ),
    }
}

/// The title of a run, and where it lies: the one that its pictures have, or that of its scene.
fn title(folder: &Folder) -> String {
    let name = folder.path.file_name().map(|name| name.to_string_lossy());
    let name = name.unwrap_or_else(|| folder.path.to_string_lossy());
    match (folder.title(), folder.scene()) {
        (Some(title), _) => format!("{title} ({name})"),
        // The scene of a comparison is that of its first device.
        (_, Some(scene)) if folder.manifest.kind != Kind::Comparison => {
            format!("{} ({name})", scene.title)
        }
        _ => {
            let kind = folder.manifest.kind.name();
            let kind = kind.split_once(' ').map_or(kind, |(_, kind)| kind);
            let mut letters = kind.chars();
            let first = letters.next().map(|first| first.to_uppercase().to_string());
            format!("{}{} ({name})", first.unwrap_or_default(), letters.as_str())
        }
    }
}

/// What was asked of a scene, and its numbers.
fn sentence(folder: &Folder, scene: &Scene) -> String {
    let mut text = findings::question(folder);
    let swept = scene.swept();
    if !swept.is_empty() {
        let ranges = swept.into_iter().filter_map(|one| {
            let (low, high) = scene.numbers.get(one)?.ends();
            let (entry, count) = (one.entry(), scene.numbers.get(one)?.count());
            let name = entry.meaning.split(';').next().unwrap_or_default();
            let unit =
                if entry.unit.is_empty() { String::new() } else { format!(" {}", entry.unit) };
            Some(format!(
                "{} ({name}) from {} to {}{unit} in {count} values",
                entry.symbol,
                number(low),
                number(high)
            ))
        });
        text += &format!(" Varied: {}.", ranges.collect::<Vec<_>>().join("; "));
    }
    if folder.manifest.kind != Kind::Comparison {
        let varied = folder.run().varied();
        let scene = &Varied::fixed(scene, varied);
        if !varied.is_empty() {
            let words: Vec<String> = varied.iter().map(Varied::words).collect();
            text += &format!(" Not known exactly: {}.", words.join("; "));
        }
        // The scene of a suite's runs has the peaks of its first motion.
        let fixed = match folder.run().study() {
            Some(_) => words::fixed(scene),
            None => words::parameters(scene),
        };
        text += &format!(" Fixed: {}.", fixed.join(", "));
        let usual = words::usual(scene);
        if !usual.is_empty() {
            text += &format!(" Not chosen, but the usual values: {}.", usual.join(", "));
        }
    }
    text
}

/// The block of each run, once where several have the same.
fn blocks(folders: &[Folder]) -> Vec<Piece> {
    let mut drawn: Vec<Picture> = Vec::new();
    let mut pieces = Vec::new();
    for folder in folders {
        let varied = folder.run().varied();
        for scene in folder.scenes() {
            let Some(case) = block::case(scene) else { continue };
            let picture = block::draw(scene, &case);
            if drawn.contains(&picture) || drawn.len() == BLOCKS {
                continue;
            }
            let mut caption = block::caption(scene, &case);
            if !varied.is_empty() {
                let names: Vec<&str> =
                    varied.iter().map(|one| one.parameter.entry().symbol).collect();
                caption += &format!(
                    " Not known exactly, and drawn with one of the values: {}.",
                    names.join(", ")
                );
            }
            pieces.push(Piece::Picture(picture.clone(), format!("{}:{caption}", scene.title)));
            drawn.push(picture);
        }
    }
    if !pieces.is_empty() {
        let shown = Piece::Text(block::SHOWN.into());
        pieces.splice(0..0, [Piece::Heading(1, "The block and its base".into()), shown]);
    }
    pieces
}

/// Most blocks that are drawn.
const BLOCKS: usize = 12;

/// What shook the base.
fn motions(folders: &[Folder]) -> Vec<Piece> {
    let mut lines: Vec<(String, String)> = Vec::new();
    let mut tables: Vec<Piece> = Vec::new();
    for folder in folders {
        let line = match (folder.run().study(), folder.scene()) {
            (Some(study), _) => {
                let all = &study.motions;
                let names: Vec<&str> = all.iter().take(NAMED).map(String::as_str).collect();
                let more = if all.len() > NAMED { ", …" } else { "" };
                let suite = study.suite.as_ref();
                let suite = suite.map_or("".into(), |PathText(path)| path_text::text(path));
                let left_out = match study.left_out.len() {
                    0 => String::new(),
                    1 => " One line of it has no motion.".to_string(),
                    count => format!(" {count} lines of it have no motion."),
                };
                let turned = match study.both_directions {
                    true => format!(
                        " Each is taken in both directions, as it is and reversed: {} motions in all.",
                        study.motions()
                    ),
                    false => String::new(),
                };
                // A table names them, too.
                let table = strengths(folder);
                let named = match table.is_empty() {
                    true => format!(": {}{more}", names.join(", ")),
                    false => String::new(),
                };
                if !table.iter().all(|piece| tables.contains(piece)) {
                    tables.extend(table);
                }
                let count = all.len();
                let scaled = scaled(folder);
                let motions = if count == 1 { "motion" } else { "motions" };
                let corrected = corrected(folder);
                format!(
                    "{count} {motions} of the suite {suite}{named}.{scaled}{corrected}{turned}{left_out}"
                )
            }
            (None, Some(scene)) => shaking(scene),
            (None, None) => continue,
        };
        // Runs under the same motions share a line.
        match lines.iter_mut().find(|(_, told)| *told == line) {
            Some((titles, _)) => *titles += &format!(", {}", title(folder)),
            None => lines.push((title(folder), line)),
        }
    }
    let mut lines: Vec<String> =
        lines.into_iter().map(|(titles, line)| format!("{titles}: {line}")).collect();
    if lines.is_empty() {
        lines.push("They are listed below.".into());
    }
    std::iter::once(Piece::List(lines)).chain(tables).collect()
}

/// How strong the motions of a suite are, the strongest first; nothing where the run does not tell it.
fn strengths(folder: &Folder) -> Vec<Piece> {
    // A suite has its own table among what was found.
    let records = folder.run().study().into_iter().flat_map(|study| &study.records);
    let told = records.map(|(id, of)| {
        let text = |text: &str| if text.is_empty() { "–" } else { text }.to_string();
        let vertical = if of.pga_v == 0.0 { "none".into() } else { number(of.pga_v) };
        let names = [id.clone(), text(&of.event), text(&of.station)];
        (of.pga_h, [names, [number(of.pga_h), vertical, number(of.pgv)]].concat())
    });
    let mut told: Vec<(f64, Vec<String>)> = told.collect();
    if told.is_empty() {
        return Vec::new();
    }
    told.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let names = [
        "motion",
        "event",
        "station",
        "horizontal peak, PGA [m/s²]",
        "vertical peak [m/s²]",
        "peak velocity [m/s]",
    ];
    let rows: Vec<Vec<String>> = told.into_iter().map(|(_, row)| row).collect();
    let count = rows.len();
    let scaled = match folder.run() {
        Run::Fragility(run) if run.own.levels.is_some() => ", before they are scaled to levels",
        _ => "",
    };
    let some = match count > ROWS {
        true => format!("The {ROWS} strongest of {count} motions{scaled}:"),
        false => format!("The motions, the strongest first{scaled}:"),
    };
    let rows = rows.into_iter().take(ROWS).collect();
    vec![Piece::Text(some), Piece::Table(names.map(String::from).to_vec(), rows)]
}

/// Most motions that are named.
const NAMED: usize = 30;

fn shaking(scene: &Scene) -> String {
    match &scene.excitation {
        Excitation::Pulse(_) => {
            let pulse = scene.excitation.other_pulse().unwrap_or("one full cycle of a sine");
            format!(
                "a pulse, {pulse}: a simple stand-in for the strongest part of a motion near a fault. Ω is its circular frequency, A_h and \
                 A_v its largest accelerations horizontally and vertically."
            )
        }
        Excitation::Record(pair) => {
            let peak = |a: f64| format!("{} m/s² ({} g)", number(a), number(a / GRAVITY));
            let vertical = match pair.pga_v {
                0.0 => "no vertical motion".to_string(),
                peak_v => format!("vertical peak {}", peak(peak_v)),
            };
            let changed = pair.notes.iter().filter(|note| note.contains("baseline: "));
            let changed: String = changed.map(|note| format!(" Changed: {note}.")).collect();
            let (title, peak_h) = (&pair.title, peak(pair.pga_h));
            format!("the record {title}: horizontal peak {peak_h}, {vertical}.{changed}")
        }
    }
}

/// A date of run.json for readers: the day and the minute.
fn day(date: &str) -> String {
    match date.split_once('T') {
        Some((day, time)) => format!("{day} at {} UTC", time.get(..5).unwrap_or(time)),
        None => date.into(),
    }
}

/// Why no command repeats a run; none where one does.
fn unrepeatable(folder: &Folder) -> Option<&'static str> {
    let run = folder.run();
    let recorded = folder.scene().is_some_and(|scene| scene.excitation.record().is_some());
    match (run.records(), run.command()) {
        (Some(_), None) => Some(
            "No command repeats it: its run.json does not say which one was given. Give the whole command again.",
        ),
        (None, _) if recorded && run.record().is_none() => Some(
            "No command repeats it: its run.json does not say where its record lies. Give the record to topple seismic again.",
        ),
        _ => None,
    }
}

/// A directory for the repetition of a run, another one for each run.
fn again(folder: &Folder) -> String {
    let name = folder.path.file_name().map(|name| name.to_string_lossy());
    shown::word(&name.map_or("again".into(), |name| format!("{name}-again")))
}

/// How a run is made again, and what its inputs were; those that are already `told` are not told again.
fn repeated(folder: &Folder, told: &mut Vec<String>) -> Vec<Piece> {
    let mut pieces = vec![Piece::Text(format!(
        "{}: topple {}{}, results in {}. Everything about the run is in its {RUN}.",
        title(folder),
        folder.manifest.version,
        folder.manifest.date.as_deref().map_or(String::new(), |date| format!(", {}", day(date))),
        folder.path.display()
    ))];
    if let Some(problem) = unrepeatable(folder) {
        pieces.push(Piece::Text(problem.into()));
        return pieces;
    }
    let lines = match folder.run().command() {
        Some(CommandLine { arguments, directory }) => {
            let word = |PathText(path): &PathText| shown::word(&path_text::text(path));
            let words = std::iter::once("topple".to_string()).chain(arguments.iter().map(word));
            let command = words.collect::<Vec<_>>().join(" ");
            vec![format!("cd {}", word(directory)), command]
        }
        None => {
            let path = shown::word(&folder.path.to_string_lossy());
            vec![format!("topple run {path} --out {}", again(folder))]
        }
    };
    pieces.push(Piece::Code(lines));
    let run = folder.run();
    let of_suite = run.records().into_iter().flat_map(Sources::values);
    let read = run.record().into_iter().chain(of_suite.filter_map(|source| source.files.as_ref()));
    let mut hashes: Vec<String> = Vec::new();
    for RecordFile { path, sha256, .. } in read.flat_map(Provenance::files) {
        let line = format!("{sha256}  {}", path_text::text(path));
        if !hashes.contains(&line) {
            hashes.push(line);
        }
    }
    let all = hashes.len();
    hashes.retain(|hash| !told.contains(hash));
    told.extend(hashes.iter().cloned());
    if all > hashes.len() {
        let text = format!("{} of its files are those of a run above.", all - hashes.len());
        pieces.push(Piece::Text(text));
    }
    if !hashes.is_empty() {
        pieces.push(Piece::Text("The files that were read, each with its SHA-256:".into()));
        let more = hashes.len().saturating_sub(ROWS);
        hashes.truncate(ROWS);
        pieces.push(Piece::Code(hashes));
        if more > 0 {
            pieces.push(Piece::Text(format!("{more} more files are in {RUN}, under `records`.")));
        }
    }
    pieces
}
