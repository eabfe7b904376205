//! What a run found, in sentences, tables and its pictures.

use std::collections::BTreeSet;

use topple::results::columns::TABLE;
use topple::results::earlier::Kind;
use topple::scene::words;
use topple::stepping::outcome::Class;
use topple_manifest::{
    Comparison, Envelope, HistoryRun, MapRun, Motion, MotionRead, ProbabilityRun, Run, StudyRun,
    SuiteRun,
};
use topple_pictures::drawing::share::{given, percent};
use topple_studies::uncertain::Varied;
use topple_studies::{Best, Limits};

use super::document::Piece;
use super::folder::{Folder, ReportError, Row, Rows};
use super::fragility;
use super::tables::{ROWS, more, number, shown, table, value};

/// What a picture shows, by its name and the kind of the run.
fn meaning(kind: Kind, name: &str) -> &'static str {
    match (kind, name) {
        (Kind::History, _) => {
            "The motion of the block and of its base over time: one calculation. φ is the block's angle, which overturns \
             at the dotted line; u and v are the displacements of the base; the marks are the moments at which the block lifts and hits."
        }
        (Kind::Suite, _) => "The ground motions of the suite.",
        (Kind::Envelope, _) => {
            "All motions of the suite together: where the base keeps the limits that were set. The axes are the numbers of the base or \
             of the block that were varied."
        }
        (Kind::Fragility, _) => {
            "How likely the block fails, over the strength of the ground motion: the farther to the right a curve lies, the stronger \
             the motions that the block survives. A mark is the share of the motions that make the block fail at this strength; a curve is \
             fitted to the marks. A band shows how uncertain its curve is: it holds the curves with θ anywhere in its 95 % interval."
        }
        (Kind::Comparison, _) => {
            "The devices side by side: under which share of the motions the block stands, how far each base moves under these motions (one \
             that overturns the block is left out) and, where factors on the motions were tried, how much stronger the motions may become."
        }
        (Kind::Probability, _) => {
            "How likely the block overturns where numbers are not known exactly: each point is the share of many calculations."
        }
        (Kind::Map, "displacement_u") => {
            "The largest horizontal displacement of the base. So much room is needed on each side."
        }
        (Kind::Map, "displacement_v") => {
            "The largest vertical displacement of the base, the deflection under the weight included."
        }
        (Kind::Map, "stroke_v") => {
            "The largest vertical stroke of the base about its place at rest: what a spring or a damper must allow."
        }
        (Kind::Map, "contact") => {
            "The force between block and base: how small it becomes, and how much friction is needed so that the block does not slide."
        }
        (Kind::Map, "single") => "What becomes of the block, and how far block and base move.",
        (Kind::Map, _) => {
            "A map of what becomes of the block. Each point is one calculation with the numbers of its axes; the legend says what the \
             colours mean and how much of the map they take."
        }
    }
}

/// What a run was to find out, in a sentence.
pub fn question(folder: &Folder) -> String {
    match folder.manifest.kind {
        Kind::Map => {
            "Does the block stay in contact with its base, rock, or overturn, and how does that depend on the numbers of the map's axes?"
        }
        Kind::History => "How does the block move in one case?",
        Kind::Suite => "Which ground motions are used, and how strong are they?",
        Kind::Envelope => "Which base keeps the block standing under the motions of a suite, and within which strokes?",
        Kind::Fragility => "How likely is it that the block overturns, given the strength of the ground motion?",
        Kind::Comparison => "Which of the devices of a list keeps the block standing, and how far does each move?",
        Kind::Probability => "How likely is it that the block overturns, where some numbers are not known exactly?",
    }
    .into()
}

/// The pictures and tables of a run, each with what it means.
pub fn of(folder: &Folder) -> Result<Vec<Piece>, ReportError> {
    let mut pieces = match folder.run() {
        Run::Map(run) => outcomes(run),
        Run::History(run) => vec![Piece::Text(motion(run))],
        Run::Suite(run) => suite(folder, run)?,
        Run::Envelope(run) => envelope(folder, run)?,
        Run::Fragility(run) => fragility::of(folder, &run.own)?,
        Run::Comparison(run) => comparison(folder, &run.own)?,
        Run::Probability(run) => probability(run),
    };
    let kind = folder.manifest.kind;
    let is_single = matches!(folder.run(), Run::Map(run) if run.cells == 1);
    let mut before: Option<&str> = None;
    for (name, picture) in folder.pictures()? {
        let own = meaning(kind, if is_single { "single" } else { name });
        let caption = if before == Some(own) { AS_BEFORE } else { own };
        pieces.push(Piece::Picture(picture, caption.into()));
        before = Some(own);
    }
    if kind == Kind::Map && before.is_none() {
        pieces.push(Piece::Text(
            "The run has no picture: its map has more than two axes, and so many pairs of two that none is drawn. Its tables have all of it."
                .into(),
        ));
    }
    Ok(pieces)
}

/// What is said of a picture that shows what the one before it does.
const AS_BEFORE: &str = "The same as the picture before, with the numbers that stand above it.";

/// What an outcome is, in words.
pub fn outcome(key: &str) -> &str {
    match key {
        "full_contact" => "stays in full contact with its base",
        "rocking" => "rocks and stays standing",
        "overturned_left" => "overturns about the left corner",
        "overturned_right" => "overturns about the right corner",
        "unresolved" => "has an outcome that is not decided",
        other => other,
    }
}

/// What becomes of the block in a map of a single cell.
pub fn single(run: &MapRun) -> Option<String> {
    let (key, _) = run.outcomes.iter().find(|(_, count)| **count == 1)?;
    Some(format!("The run has one calculation. The block {}.", outcome(key)))
}

fn outcomes(run: &MapRun) -> Vec<Piece> {
    let cells = run.cells.max(1);
    if let (1, Some(text)) = (cells, single(run)) {
        return std::iter::once(text).chain(tensile(run)).map(Piece::Text).collect();
    }
    let mut pieces = vec![Piece::Text(format!("The run has {cells} calculations."))];
    let rows = run.outcomes.iter().filter(|(_, count)| **count > 0);
    let rows = rows
        .map(|(key, count)| vec![outcome(key).to_string(), percent(*count as f64 / cells as f64)]);
    let names = vec!["the block".into(), "share of the map".into()];
    pieces.push(Piece::Table(names, rows.collect()));
    pieces.push(Piece::Text(
        "A share of the map is no probability: it says how much of the area of the map has this outcome."
            .into(),
    ));
    pieces.extend(tensile(run).map(Piece::Text));
    pieces
}

/// That in a part of a map, or in its single cell, the base would have to pull at the block.
pub fn tensile(run: &MapRun) -> Option<String> {
    let tensile = run.tensile_cells.filter(|count| *count > 0)?;
    Some(match run.cells.max(1) {
        1 => PULLS.into(),
        cells => format!(
            "In {} of the map the base would have to pull at the block. There the model does not hold; the map is hatched.",
            percent(tensile as f64 / cells as f64)
        ),
    })
}

/// What is said of a motion in which the base would have to pull at the block.
const PULLS: &str = "The contact force becomes tensile: the base would have to pull at the block. From then on the model does not hold, and the result is \
                     not reliable.";

/// What a single motion does, in sentences.
pub fn motion(run: &HistoryRun) -> String {
    let MotionRead { class, impacts, t_end, max_u, stroke_v, min_contact, acc_block, base_load } =
        match &run.outcome {
            Some(Motion::Read(of)) => *of,
            _ => MotionRead::default(),
        };
    let mut text = format!("The block {}.", outcome(class.map_or("", Class::name)));
    if class.is_some_and(Class::overturned)
        && let Some(end) = t_end
    {
        text += &format!(" That is at {} s; what follows is of the time up to then.", number(end));
    }
    text += &match impacts {
        Some(1) => " It hits its base once.".to_string(),
        Some(impacts) => format!(" It hits its base {} times.", number(impacts.into())),
        None => String::new(),
    };
    let numbers = [
        (max_u, "The base moves horizontally by up to", "m"),
        (stroke_v, "Its vertical stroke is up to", "m"),
        (acc_block, "The largest horizontal acceleration of its centre of mass is", "m/s²"),
        (base_load, "The base carries at most", "N"),
    ];
    for (value, what, unit) in numbers {
        if let Some(value) = value.filter(|value| *value > 0.0) {
            text += &format!(" {what} {} {unit}.", number(value));
        }
    }
    if let (Some(class), Some(least)) = (class, min_contact)
        && class.loses_contact(least)
    {
        text += &format!(" {PULLS}");
    }
    text
}

/// The motions of a suite: the rows of its table that have numbers. The others are lines without a motion.
pub fn motions(folder: &Folder) -> Result<Rows, ReportError> {
    let mut rows = folder.table("suite.csv")?.unwrap_or_default();
    rows.retain(|row| value(row, "pga_h").is_some());
    Ok(rows)
}

fn suite(folder: &Folder, run: &SuiteRun) -> Result<Vec<Piece>, ReportError> {
    let rows = motions(folder)?;
    let mut pieces = vec![Piece::Text(format!(
        "Motions of the suite: {}. Their peaks are with the scale factors of a list, where it has any.",
        rows.len()
    ))];
    let columns = [
        ("id", "motion"),
        ("event", "event"),
        ("station", "station"),
        ("duration", "duration [s]"),
        ("pga_h", "horizontal peak [m/s²]"),
        ("pga_v", "vertical peak [m/s²]"),
        ("pgv", "peak velocity [m/s]"),
    ];
    pieces.extend(table(&rows, &columns));
    let left_out = &run.left_out;
    if !left_out.is_empty() {
        let more = left_out.len().saturating_sub(ROWS);
        let told = left_out.iter().take(ROWS);
        let told = told.map(|(name, why)| format!("{name} is left out: {why}"));
        pieces.push(Piece::List(told.collect()));
        if more > 0 {
            let text = format!("{more} more lines have no motion; run.json says why.");
            pieces.push(Piece::Text(text));
        }
    }
    Ok(pieces)
}

/// What a base must keep, in a sentence.
pub fn limits(folder: &Folder, of: &Limits) -> String {
    let mut text = match of.standing {
        1.0 => "Limits: the block stands under all motions".to_string(),
        share => {
            format!("Limits: the block stands under at least {} of the motions", given(share))
        }
    };
    for (limit, what) in
        [(of.u, "the base moves horizontally by at most"), (of.v, "its vertical stroke is at most")]
    {
        if let Some(limit) = limit {
            text += &format!("; {what} {limit} m");
        }
    }
    if let Some(scale) = folder.scale() {
        text += &format!("; the motions are multiplied by {}", number(scale));
    }
    text + "."
}

/// How many bases keep their limits, in sentences.
pub fn kept(folder: &Folder, run: &StudyRun<Envelope>) -> String {
    let (motions, limits) = (run.study.motions(), limits(folder, &run.own.limits));
    let kept = match (run.study.cells, run.own.feasible) {
        (1, 1) => "The base keeps all limits.".to_string(),
        (1, _) => "The base does not keep all limits.".to_string(),
        (cells, feasible) => format!("{feasible} of {cells} bases keep all limits."),
    };
    format!("{limits} Each base is tried under {motions} motions. {kept}")
}

/// The best base of an envelope, by its place on the axes, with its strokes and its reserve; none where no base keeps its limits.
pub fn best(folder: &Folder, run: &StudyRun<Envelope>) -> Result<Option<String>, ReportError> {
    let rows = folder.table("envelope.csv")?.unwrap_or_default();
    let Some(row) = run.own.best_cell.and_then(|cell| rows.get(cell)) else { return Ok(None) };
    let swept = folder.scene().map(|scene| scene.swept()).unwrap_or_default();
    let at =
        swept.iter().filter_map(|one| Some(one.entry().written(number(value(row, one.key())?))));
    let at: Vec<String> = at.collect();
    let mut text = match &at[..] {
        [] => "The block".to_string(),
        at => {
            let by = match run.own.best {
                Best::StrokeU => "with the smallest horizontal displacement",
                Best::StrokeV => "with the smallest vertical stroke",
                Best::Reserve if run.own.feasible == run.study.cells => {
                    "with the smallest horizontal displacement, since all keep the limits"
                }
                Best::Reserve => "the farthest on the map from bases that do not keep all limits",
            };
            format!("The best base, {by}, has {}: on it the block", at.join(", "))
        }
    };
    text += &match value(row, "standing").unwrap_or(0.0) {
        1.0 => " stands under all motions".to_string(),
        share => format!(" stands under {} of the motions", percent(share)),
    };
    for (column, what) in [
        ("max_u_100", "the base moves horizontally by up to"),
        ("stroke_v_100", "its vertical stroke is up to"),
    ] {
        if let Some(stroke) = value(row, column).filter(|stroke| *stroke > 0.0) {
            text += &format!(", {what} {} m", number(stroke));
        }
    }
    text += ".";
    text += &match value(row, "reserve").filter(|_| rows.len() > 1) {
        None => String::new(),
        Some(1.0) => " A base beside it on the map does not keep all limits: its reserve is 1 step of the map.".into(),
        Some(steps) => format!(" Its reserve is {steps} steps of the map to the nearest base that does not keep all limits."),
    };
    Ok(Some(text))
}

fn envelope(folder: &Folder, run: &StudyRun<Envelope>) -> Result<Vec<Piece>, ReportError> {
    let found = std::iter::once(kept(folder, run)).chain(best(folder, run)?);
    let mut pieces = vec![Piece::Text(found.collect::<Vec<_>>().join(" "))];
    let rows = folder.table("envelope.csv")?.unwrap_or_default();
    if rows.len() == 1 {
        // The reserve of an envelope is in steps of its grid, and one cell has no neighbours.
        let columns: Vec<(&str, &str)> =
            STROKES.iter().copied().filter(|(column, _)| *column != "reserve").collect();
        pieces.extend(table(&rows, &columns));
    }
    Ok(pieces)
}

/// Columns of what becomes of a base under a suite.
const STROKES: [(&str, &str); 16] = [
    ("standing", "share of the motions under which the block stands"),
    ("overturned", "probability that a motion overturns it"),
    ("overturned_low", "lower end of its 95 % interval"),
    ("overturned_high", "upper end of its 95 % interval"),
    ("lifted", "share of the motions under which it lifts"),
    ("max_u_50", "|u| not exceeded under 50 % [m]"),
    ("max_u_84", "|u| not exceeded under 84 % [m]"),
    ("max_u_100", "|u| not exceeded under 100 % [m]"),
    ("stroke_v_100", "largest vertical stroke [m]"),
    ("feasible", "keeps all limits"),
    ("reserve", "keeps all limits up to so many times the motions"),
    ("fails_at", "exceeds a limit at so many times the motions"),
    ("rate", "overturnings a year"),
    ("rate_low", "lower end of its 95 % interval"),
    ("rate_high", "upper end of its 95 % interval"),
    (
        "rate_with_missing",
        "overturnings a year, with what may be missing beyond both ends of the hazard curve",
    ),
];

/// Devices whose numbers stand beside each other.
const BESIDE: usize = 5;

/// The rows of a table beside each other: names of columns, then a column for each row. What no row has, and displacements in a
/// direction in which none moves, are left out.
fn beside(rows: &Rows, (key, columns): (&str, &[(&str, &str)])) -> Vec<Piece> {
    let tells = |column: &str| {
        let moves = |text: &String| !column.starts_with("stroke_v") || text.parse() != Ok(0.0);
        rows.iter().filter_map(|row| row.get(column)).any(|text| !text.is_empty() && moves(text))
    };
    let told: Vec<&(&str, &str)> = columns.iter().filter(|(column, _)| tells(column)).collect();
    let some = &rows[..rows.len().min(ROWS)];
    let table = |rows: &[Row]| {
        let names = rows.iter().map(|row| shown(row, key));
        let cell = |row: &Row, column: &str| match (column, shown(row, column).as_str()) {
            ("feasible", "1") => "yes".to_string(),
            ("feasible", "0") => "no".to_string(),
            (_, text) => text.to_string(),
        };
        let line = |(column, name): &&(&str, &str)| {
            let values = rows.iter().map(|row| cell(row, column));
            std::iter::once(name.to_string()).chain(values).collect()
        };
        let names = std::iter::once(key.to_string()).chain(names).collect();
        Piece::Table(names, told.iter().map(line).collect())
    };
    let mut pieces: Vec<Piece> = some.chunks(BESIDE).map(table).collect();
    pieces.extend(more(rows));
    pieces
}

fn comparison(folder: &Folder, run: &Comparison) -> Result<Vec<Piece>, ReportError> {
    let rows = folder.table("compare.csv")?.unwrap_or_default();
    let mut pieces = vec![Piece::Text(format!(
        "{} Displacements, accelerations and forces are those of the motions under which the block stands: a motion that overturns it is not \
         counted, and may give larger ones. u is the displacement of the base.",
        limits(folder, &run.limits)
    ))];
    let scenes = folder.scenes();
    let numbers =
        scenes.iter().map(|scene| format!("{}: {}", scene.title, words::fixed(scene).join(", ")));
    pieces.push(Piece::List(numbers.collect()));
    // Columns that were asked for have their own names.
    let of_tables = ["device", "records", "stroke_v_50", "stroke_v_84", "rate_ordered"];
    let known = |column: &str| {
        of_tables.contains(&column) || STROKES.iter().any(|(known, _)| *known == column)
    };
    let asked = rows.iter().flat_map(|row| row.keys()).filter(|column| !known(column));
    // By their percentiles, 50 before 100.
    let asked: BTreeSet<(&str, u32, &String)> = asked.filter_map(place).collect();
    let named: Vec<(&str, String)> =
        asked.into_iter().map(|(_, _, column)| (column.as_str(), percentile(column))).collect();
    let mut columns = STROKES.to_vec();
    columns.extend(named.iter().map(|(column, name)| (*column, name.as_str())));
    pieces.extend(beside(&rows, ("device", &columns)));
    Ok(pieces)
}

/// The place of a percentile of a column among others: by the name of the column, then by the percentage.
fn place(column: &String) -> Option<(&str, u32, &String)> {
    let (name, share) = column.rsplit_once('_').unwrap_or((column, "0"));
    Some((name, share.parse().unwrap_or(0), column))
}

/// What a percentile of a column of a map is, by its name: `zeta_84`.
fn percentile(name: &str) -> String {
    let of = || {
        let (column, share) = name.rsplit_once('_')?;
        let entry = TABLE.iter().find(|entry| entry.name == column)?;
        let meaning = entry.meaning.split([';', ':']).next().unwrap_or_default();
        let unit = if entry.unit.is_empty() { String::new() } else { format!(" [{}]", entry.unit) };
        Some(format!("{meaning}, not exceeded under {share} % of these motions{unit}"))
    };
    of().unwrap_or_else(|| name.into())
}

/// How likely a map of unknown numbers has overturning, in sentences.
pub fn probable(run: &ProbabilityRun) -> String {
    let mut text = String::from(
        "Some numbers are not known exactly; each point of the map is calculated with many values of them",
    );
    if let Some(uncertainty) = &run.uncertainty {
        text += &format!(", {} in all", uncertainty.samples);
    }
    text += ".";
    if let Some(mean) = run.mean_probability {
        text += &format!(
            " Over the whole map the block overturns in {} of the calculations.",
            percent(mean)
        );
    }
    text
}

fn probability(run: &ProbabilityRun) -> Vec<Piece> {
    let varied = run.uncertainty.iter().flat_map(|of| &of.vary);
    let varied: Vec<String> = varied.map(Varied::words).collect();
    let mut pieces = vec![Piece::Text(probable(run))];
    if !varied.is_empty() {
        pieces.push(Piece::List(varied));
    }
    pieces
}
