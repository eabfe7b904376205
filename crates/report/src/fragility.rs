//! What a fragility found: its curves, the hazard of its site, how often the block fails.

use topple::scene::path_text::{self, PathText};
use topple_manifest::{Drawn, Fragility, Site};
use topple_pictures::drawing::share::percent;
use topple_pictures::studies::hazard as picture;
use topple_studies::suites::intensity::Intensity;

use super::document::Piece;
use super::folder::{Folder, ReportError, Row, Rows};
use super::tables::{number, shown, table, value};

/// The estimator whose curves are drawn and told: the first of the run.
fn estimator(run: &Fragility) -> &str {
    run.estimators.first().map_or("stripes", String::as_str)
}

/// The rows of a table that are of this estimator.
fn rows(folder: &Folder, run: &Fragility, name: &str) -> Result<Option<Rows>, ReportError> {
    let by = estimator(run);
    let own = |mut rows: Rows| {
        rows.retain(|row| row.get("estimator").is_none_or(|one| one == by));
        rows.iter_mut().for_each(in_words);
        rows
    };
    Ok(folder.table(name)?.map(own))
}

/// The measure of the levels, as axes are labelled.
fn label(run: &Fragility) -> String {
    run.im.map_or("the ground motion's strength".into(), Intensity::label)
}

/// What is found of overturning, in sentences: of one block or base its median and its rate, of several how many have which.
pub fn shortly(folder: &Folder, run: &Fragility) -> Result<Vec<String>, ReportError> {
    let overturning = |rows: Option<Rows>| {
        let rows = rows.into_iter().flatten();
        rows.filter(|row| row.get("limit_state").is_some_and(|state| state == "overturning"))
            .collect::<Rows>()
    };
    let fits = overturning(rows(folder, run, "fits.csv")?);
    let rates = overturning(rows(folder, run, "rates.csv")?);
    let symbol = run.im.map_or("level".into(), Intensity::symbol);
    let unit = run.im.map_or("1", Intensity::unit);
    let unit = if unit == "1" { String::new() } else { format!(" {unit}") };
    let mut told = Vec::new();
    let known: Vec<f64> = fits.iter().filter_map(|row| value(row, "theta")).collect();
    let (least, most) = known.iter().fold((f64::MAX, 0.0_f64), |(a, b), x| (a.min(*x), b.max(*x)));
    told.push(match (&fits[..], known.is_empty()) {
        (_, true) => "The motions tell no curve of overturning.".into(),
        ([one], _) => format!(
            "Half of the motions overturn the block at {symbol} = {}{unit}{}.",
            shown(one, "theta"),
            within(one, "theta")
        ),
        (all, _) => format!(
            "Half of the motions overturn the block at {symbol} = {} to {}{unit}; {} of {} cells of the grid have such a median.",
            number(least),
            number(most),
            known.len(),
            all.len()
        ),
    });
    let target = run.target;
    if let [one] = &rates[..] {
        if one.get("rate").is_some_and(|rate| !rate.is_empty()) {
            told.push(format!(
                "At this site it overturns {} times a year{}, with a probability of {} in 50 years{}.",
                shown(one, "rate"),
                within(one, "rate"),
                value(one, "in_50_years").map_or("–".into(), probability),
                beyond(one)
            ));
        } else {
            told.push("How often it overturns at this site is not known.".into());
        }
        if let Some(judged) = target.and_then(|target| judged(one, target)) {
            told.push(judged);
        }
    } else if let Some(target) = target.filter(|_| !rates.is_empty()) {
        let keep = rates.iter().filter(|row| row.get("below_target").is_some_and(|is| is == "1"));
        let (keep, of) = (keep.count(), rates.len());
        let target = number(target);
        told.push(format!(
            "{keep} of {of} cells keep the accepted rate of overturning, {target} a year."
        ));
    }
    Ok(told)
}

/// A probability in percent; a small one with three digits, since its size is what counts.
fn probability(p: f64) -> String {
    if p < 0.1 { format!("{} %", number(100.0 * p)) } else { percent(p) }
}

/// Of a row an interval behind its number; nothing where both of its ends are open.
fn within(row: &Row, name: &str) -> String {
    let end = |end: &str| {
        let column = format!("{name}_{end}");
        row.get(&column).filter(|text| !text.is_empty()).map(|_| shown(row, &column))
    };
    match (end("low"), end("high")) {
        (Some(low), Some(high)) => format!(" (95 %: {low} to {high})"),
        (Some(low), None) => format!(" (95 %: above {low})"),
        (None, Some(high)) => format!(" (95 %: below {high})"),
        (None, None) => String::new(),
    }
}

/// The largest rate that motions beyond the ends of the hazard curve may add.
fn missing(row: &Row) -> f64 {
    ["missing_above", "missing_below"].iter().filter_map(|name| value(row, name)).sum()
}

/// The upper end of a rate's interval, with all that may be missing.
fn highest(row: &Row) -> Option<f64> {
    Some(value(row, "rate_high")? + missing(row))
}

/// What the hazard curve leaves out, where it adds a hundredth of the rate or more.
fn beyond(row: &Row) -> String {
    let rate = value(row, "rate").unwrap_or(0.0);
    let missing = missing(row);
    match missing > 0.0 && missing >= 0.01 * rate {
        true => format!(
            "; beyond the ends of the hazard curve up to {} more a year may be missing",
            number(missing)
        ),
        false => String::new(),
    }
}

/// Whether a rate keeps the target, with all that may be missing at the ends of the hazard curve, and whether the upper end of its
/// interval does.
pub fn judged(row: &Row, target: f64) -> Option<String> {
    let accepted = format!("the accepted rate, {} a year", number(target));
    Some(match row.get("below_target")?.as_str() {
        "1" => match highest(row) {
            Some(high) if high <= target => {
                format!("This keeps {accepted}, and so does the upper end of its interval.")
            }
            _ => format!(
                "This keeps {accepted}, but the upper end of its interval exceeds it: with other motions it may not be kept."
            ),
        },
        "0" if value(row, "rate").is_some_and(|rate| rate > target) => {
            format!("This exceeds {accepted}.")
        }
        "0" => match value(row, "rate").map(|rate| rate + missing(row)) {
            _ if highest(row).is_none() => {
                format!("Whether this keeps {accepted} is not known: the rate has no upper bound.")
            }
            Some(most) if most > target => {
                format!("With what the hazard curve may leave out, this may exceed {accepted}.")
            }
            _ => format!("By the upper end of its interval this may exceed {accepted}."),
        },
        _ => return None,
    })
}

/// What the intervals of a study rest on, in a sentence.
pub fn intervals(drawn: &Drawn) -> Option<String> {
    let by = drawn.resample?;
    Some(match drawn.groups? {
        1 => format!(
            "All motions are of one {by}: how the answer changes with the choice of motions is not known."
        ),
        count => format!(
            "The intervals rest on {count} {by}s: they say how the answer changes with the choice of motions, not whether the model is right."
        ),
    })
}

/// How sure the curves are, in sentences.
pub fn sureness(folder: &Folder, run: &Fragility) -> Result<Vec<String>, ReportError> {
    let mut told: Vec<String> = intervals(&run.drawn).into_iter().collect();
    let rates = rows(folder, run, "rates.csv")?.unwrap_or_default();
    if let [one, ..] = &rates[..]
        && rates.iter().all(|row| cell(folder, row) == cell(folder, one))
        && let Some(share) = value(one, "share_without_failures")
    {
        told.push(format!(
            "{} of the rate of overturning comes from levels at which no motion overturns it: from the shape of the curve, not from a calculation.",
            percent(share)
        ));
    }
    Ok(told)
}

/// Where a row lies on the axes of the run.
fn cell<'a>(folder: &Folder, row: &'a Row) -> Vec<Option<&'a String>> {
    axes(folder).iter().map(|(key, _)| row.get(key)).collect()
}

/// The hazard of the site: its curve as a picture, and what the run was to keep.
fn site(run: &Fragility, label: &str) -> Vec<Piece> {
    let Site { hazard, hazard_units, hazard_source, hazard_curve, .. } = &run.site;
    let points = hazard_curve.as_ref();
    let Some(picture) = points.and_then(|of| picture::draw(of, label, run.target)) else {
        return Vec::new();
    };
    let mut text = format!(
        "The hazard of the site, {}: how often a year the ground shakes more strongly than a level.",
        hazard.as_ref().map_or("".into(), |PathText(path)| path_text::text(path))
    );
    if let (Some(unit), Some(source)) = (hazard_units, hazard_source) {
        text += &format!(" How it was read: levels in {unit}; {source}.");
    }
    if let Some(target) = run.target {
        text += &format!(
            " The dashed line is the accepted rate of failure, {} a year: a block that fails exactly from the level on at which the line meets the curve has this rate.",
            number(target)
        );
    }
    vec![Piece::Picture(picture, text)]
}

/// The pieces of a fragility.
pub fn of(folder: &Folder, run: &Fragility) -> Result<Vec<Piece>, ReportError> {
    let (label, by) = (label(run), estimator(run));
    let axes: Vec<(String, String)> = axes(folder);
    let mut columns: Vec<(&str, &str)> =
        axes.iter().map(|(key, name)| (key.as_str(), name.as_str())).collect();
    columns.push(("limit_state", "the block fails by"));
    let mut fits = columns.clone();
    let median = format!("half fail at {label} (θ)");
    fits.extend([
        ("theta", median.as_str()),
        ("theta_low", "lower end of its 95 % interval"),
        ("theta_high", "upper end"),
        ("beta", "spread (β)"),
    ]);
    let levels = match run.levels.is_some() {
        true => format!("The motions of the suite are scaled to levels of {label}."),
        false => format!(
            "The motions of the suite are used as they are; {label} tells how strong each is."
        ),
    };
    let mut pieces = vec![Piece::Text(format!(
        "{levels} The curves are estimated by {by}. θ is the level at which half of the motions make the block fail; \
         β is the standard deviation of the natural logarithm of this level from motion to motion."
    ))];
    // The other estimates are in the run's directory.
    let mut fitted = rows(folder, run, "fits.csv")?.unwrap_or_default();
    let open = |row: &&mut Row| {
        row.get("beta").is_some_and(String::is_empty)
            && row.get("theta").is_some_and(|theta| !theta.is_empty())
    };
    let mut is_about = false;
    for row in fitted.iter_mut().filter(open) {
        let theta = format!("about {}", shown(row, "theta"));
        row.insert("theta".into(), theta);
        row.insert("beta".into(), "not known".into());
        is_about = true;
    }
    pieces.extend(table(&fitted, &fits));
    if is_about {
        pieces.push(Piece::Text(
            "About: at most one level has motions that fail beside motions that do not, so that β is not known and θ lies somewhere \
             between the levels around it. More levels there would tell both."
                .into(),
        ));
    }
    if fitted.iter().any(|row| row.get("theta").is_some_and(String::is_empty)) {
        pieces.push(Piece::Text("–: the motions tell no curve, or no end of its interval.".into()));
    }
    let of_notes = format!(", {by}: ");
    let notes = run.notes.iter().filter(|note| note.contains(&of_notes));
    let notes: Vec<String> = notes.map(|note| note.replacen(&of_notes, ": ", 1)).collect();
    if !notes.is_empty() {
        pieces.push(Piece::List(notes));
    }
    if let Some(mut found) = rows(folder, run, "rates.csv")? {
        let target = run.target.map(number);
        let accepted = run.target.unwrap_or(f64::INFINITY);
        for row in &mut found {
            let keeps = row.get("below_target").map(String::as_str);
            let keeps = keeps.and_then(|keeps| match keeps {
                "1" if highest(row).is_some_and(|high| high <= accepted) => Some("yes"),
                "1" => Some("yes, its interval not"),
                "0" if value(row, "rate").is_some_and(|rate| rate > accepted) => Some("no"),
                "0" => Some("not surely"),
                _ => None,
            });
            if let Some(keeps) = keeps {
                row.insert("below_target".into(), keeps.into());
            }
        }
        let keeps = target.map(|target| format!("keeps the accepted rate, {target} a year"));
        let mut rates = columns;
        rates.extend([
            ("rate", "so often a year"),
            ("rate_low", "lower end of its 95 % interval"),
            ("rate_high", "upper end"),
            ("in_50_years", "probability in 50 years"),
            ("rate_empirical", "a year, by counted motions alone"),
            ("share_without_failures", "share from levels without a failure"),
        ]);
        rates.extend(keeps.iter().map(|keeps| ("below_target", keeps.as_str())));
        pieces.push(Piece::Text(
            "Together with the hazard of the site, which says how often a year such ground motions come, this is how often the block is \
             expected to fail. Where a large share comes from levels at which no motion fails, the rate rests on the shape of a curve, \
             not on a calculation."
                .into(),
        ));
        pieces.extend(table(&found, &rates));
        pieces.extend(site(run, &label));
    }
    Ok(pieces)
}

/// Puts the limit state of a row in words.
fn in_words(row: &mut Row) {
    let Some(state) = row.get_mut("limit_state") else { return };
    let words = [
        ("zeta>", "ζ above ", ""),
        ("max_u>", "|u| above ", " m"),
        ("stroke_v>", "a stroke of v above ", " m"),
    ];
    if let Some((key, words, unit)) = words.into_iter().find(|(key, ..)| state.starts_with(*key)) {
        *state = format!("{words}{}{unit}", &state[key.len()..]);
    }
}

/// The axes of a run, by their keys, and how they are labelled.
fn axes(folder: &Folder) -> Vec<(String, String)> {
    let swept = folder.scene().map(|scene| scene.swept()).unwrap_or_default();
    swept.into_iter().map(|one| (one.key().to_string(), one.entry().label())).collect()
}
