//! The whole of a report: what was asked, the block, the motions, what was found, how far it was checked, what is left out, how to
//! repeat it.

use serde_json::Value;
use topple::results::earlier::{Kind, RUN};
use topple::scene::{Excitation, GRAVITY, Scene, shown, words};

use super::document::{Document, Piece};
use super::findings::{number, percent};
use super::folder::{Folder, ReportError};
use super::{block, findings};

/// The report of runs.
///
/// # Errors
/// [`ReportError`]: a file of a run that cannot be read.
pub fn of(folders: &[Folder]) -> Result<Document, ReportError> {
    let mut pieces = vec![Piece::Heading(1, "What was asked".into())];
    let asked = folders.iter().map(|folder| match &folder.scene {
        Some(scene) => format!("{}: {}", title(folder), sentence(folder, scene)),
        None => format!("{}: {}", title(folder), findings::question(folder)),
    });
    pieces.push(Piece::List(asked.collect()));
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
    let checks = folders.iter().map(|folder| format!("{}: {}", title(folder), checked(folder)));
    pieces.push(Piece::List(checks.collect()));
    pieces.push(Piece::Heading(1, "What the model leaves out".into()));
    pieces.push(Piece::List(LEFT_OUT.map(String::from).to_vec()));
    pieces.push(Piece::Heading(1, "How to repeat it".into()));
    for folder in folders {
        pieces.extend(repeated(folder));
    }
    let title = match folders {
        [one] => title(one),
        several => format!("{} runs of topple", several.len()),
    };
    Ok(Document { title, pieces })
}

/// What no run of topple says anything about.
const LEFT_OUT: [&str; 7] = [
    "The motion is calculated in one vertical plane. A real block also turns about its vertical axis and rocks on its edges and corners.",
    "The block and the plates are rigid, and so is the ground below. A block that bends, cracks or has loose parts behaves otherwise.",
    "The block does not slide on its base. Where a map of the friction that is needed is given, compare it with the friction there is.",
    "The block is lifted at a sharp corner and loses speed at each impact by a formula, not by a measured value.",
    "The base does not pull at the block. Maps mark where it would have to; comparisons and fragilities do not look for it.",
    "Rocking depends on small differences: one single calculation says little of one real event. Shares over many motions say more.",
    "Whether the ground motions are right for the site, and whether devices keep their numbers over the years, is not examined here.",
];

/// The title of a run: that of its scene, and where it lies.
fn title(folder: &Folder) -> String {
    let name = folder.path.file_name().map(|name| name.to_string_lossy());
    let name = name.unwrap_or_else(|| folder.path.to_string_lossy());
    match &folder.scene {
        // The scene of a comparison is that of its first device.
        Some(scene) if folder.kind != Kind::Comparison => format!("{} ({name})", scene.title),
        _ => {
            let kind = folder.kind.name();
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
    if folder.kind != Kind::Comparison {
        // The scene of a suite's runs has the peaks of its first motion.
        let fixed = match folder.run.get("motions") {
            Some(_) => words::fixed(scene),
            None => words::parameters(scene),
        };
        text += &format!(" Fixed: {}.", fixed.join(", "));
    }
    text
}

/// The block of each run, once where several have the same.
fn blocks(folders: &[Folder]) -> Vec<Piece> {
    let mut drawn: Vec<String> = Vec::new();
    let mut pieces = Vec::new();
    for scene in folders.iter().flat_map(Folder::scenes) {
        let Some(case) = block::case(&scene) else { continue };
        let svg = block::draw(&case);
        if drawn.contains(&svg) || drawn.len() == BLOCKS {
            continue;
        }
        let Ok(outlined) = topple_pictures::drawing::render::outlined(&svg) else { continue };
        let caption = block::caption(&scene, &case);
        pieces.push(Piece::Picture(outlined, format!("{}: {caption}", scene.title)));
        drawn.push(svg);
    }
    if !pieces.is_empty() {
        pieces.insert(0, Piece::Heading(1, "The block and its base".into()));
    }
    pieces
}

/// Most blocks that are drawn.
const BLOCKS: usize = 12;

/// What shook the base.
fn motions(folders: &[Folder]) -> Vec<Piece> {
    let mut lines: Vec<(String, String)> = Vec::new();
    for folder in folders {
        let line = match (folder.run.get("motions").and_then(Value::as_array), &folder.scene) {
            (Some(all), _) => {
                let names: Vec<&str> = all.iter().filter_map(Value::as_str).take(NAMED).collect();
                let more = if all.len() > NAMED { ", …" } else { "" };
                let suite = folder.text("suite").unwrap_or_default();
                let left_out = folder.run.get("left_out").and_then(Value::as_object);
                let left_out = match left_out.map_or(0, |left_out| left_out.len()) {
                    0 => String::new(),
                    count => format!(" {count} motions of it are left out."),
                };
                format!(
                    "{} motions of the suite {suite}: {}{more}.{left_out}",
                    all.len(),
                    names.join(", ")
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
    vec![Piece::List(lines)]
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
            format!("the record {}: horizontal peak {}, {vertical}.", pair.title, peak(pair.pga_h))
        }
    }
}

/// What a second calculation says of a run.
fn checked(folder: &Folder) -> String {
    let second = "A second, independent and slower calculation has repeated";
    let count = |of: &Value, key: &str| of.get(key).and_then(Value::as_f64).unwrap_or(0.0);
    let none = "nothing was calculated a second time.".to_string();
    let repeated_of = |sampled: f64, differ: f64| match sampled {
        0.0 => none.clone(),
        _ => format!("{second} {sampled} of the calculations; the outcome differs in {differ}."),
    };
    match (folder.run.get("verification"), folder.run.get("verified")) {
        (Some(of), _) if of.is_object() => {
            let (sampled, differ) = (count(of, "sampled"), count(of, "differ"));
            if sampled == 0.0 {
                return none;
            }
            format!(
                "{second} {sampled} of {} calculations; the outcome differs in {differ} ({}). {} of the repeated ones lie beside \
                 another outcome, where outcomes are hardest to tell.",
                folder.number("cells").unwrap_or(sampled),
                percent(differ / sampled),
                count(of, "beside_boundary")
            )
        }
        (_, Some(of)) if of.is_object() => repeated_of(count(of, "sampled"), count(of, "differ")),
        (_, Some(Value::Array(of))) => {
            let of: Vec<f64> = of.iter().filter_map(Value::as_f64).collect();
            match of[..] {
                [sampled, differ] => repeated_of(sampled, differ),
                _ => none,
            }
        }
        _ => none,
    }
}

/// How a run is made again, and what its inputs were.
fn repeated(folder: &Folder) -> Vec<Piece> {
    let mut pieces = vec![Piece::Text(format!(
        "{}: topple {}, results in {}. Everything about the run is in its {RUN}.",
        title(folder),
        folder.version,
        folder.path.display()
    ))];
    let command = folder.run.get("command").and_then(|command| command.get("arguments"));
    let arguments = command.and_then(Value::as_array);
    let mut lines = match arguments {
        Some(arguments) => {
            let words = arguments.iter().filter_map(Value::as_str).map(shown::word);
            vec![std::iter::once("topple".to_string()).chain(words).collect::<Vec<_>>().join(" ")]
        }
        None if matches!(folder.kind, Kind::Suite) => {
            vec![format!(
                "topple suite {} --out again",
                shown::word(folder.text("suite").unwrap_or_default())
            )]
        }
        None => {
            vec![format!("topple run {} --out again", shown::word(&folder.path.to_string_lossy()))]
        }
    };
    if let Some(place) = folder.run.get("command").and_then(|command| command.get("directory"))
        && let Some(place) = place.as_str()
    {
        lines.insert(0, format!("cd {}", shown::word(place)));
    }
    pieces.push(Piece::Code(lines));
    let mut hashes = Vec::new();
    for key in ["record", "records"] {
        if let Some(of) = folder.run.get(key) {
            gather(of, &mut hashes);
        }
    }
    if !hashes.is_empty() {
        pieces.push(Piece::Text("The files that were read, each with its SHA-256:".into()));
        pieces.push(Piece::Code(hashes));
    }
    pieces
}

/// The files among what run.json says of records, each once.
fn gather(value: &Value, hashes: &mut Vec<String>) {
    let text = |key: &str| value.get(key).and_then(Value::as_str);
    if let (Some(path), Some(hash)) = (text("path"), text("sha256")) {
        let line = format!("{hash}  {path}");
        if !hashes.contains(&line) {
            hashes.push(line);
        }
    }
    if let Some(inner) = value.as_object() {
        inner.values().for_each(|value| gather(value, hashes));
    }
}
