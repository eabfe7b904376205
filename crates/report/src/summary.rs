//! A run in short: what was asked, what was found, and how sure that is.

use serde_json::Value;
use topple::results::earlier::Kind;

use super::folder::{Folder, ReportError, Rows};
use super::tables::{number, percent, shown};
use super::{findings, fragility};

/// Devices that are named.
const NAMED: usize = 6;

/// The three, a line each.
///
/// # Errors
/// [`ReportError::File`]: a table that cannot be read.
pub fn of(folder: &Folder) -> Result<Vec<String>, ReportError> {
    let mut sure = vec![sentence(&checked(folder))];
    sure.extend(fragility::sureness(folder)?);
    match folder.warnings.len() {
        0 => {}
        1 => sure.push("The run gave a warning, which stands below.".into()),
        count => sure.push(format!("The run gave {count} warnings, which stand below.")),
    }
    Ok(vec![
        format!("Asked: {}", findings::question(folder)),
        format!("Found: {}", found(folder)?.join(" ")),
        format!("How sure: {}", sure.join(" ")),
    ])
}

/// A text that begins as a sentence does.
fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|first| first.to_uppercase().to_string());
    format!("{}{}", first.unwrap_or_default(), letters.as_str())
}

fn found(folder: &Folder) -> Result<Vec<String>, ReportError> {
    Ok(match folder.kind {
        Kind::Map => map(folder),
        Kind::History => vec![findings::motion(folder)],
        Kind::Suite => suite(&folder.table("suite.csv")?.unwrap_or_default()),
        Kind::Envelope => vec![findings::kept(folder)],
        Kind::Fragility => fragility::shortly(folder)?,
        Kind::Comparison => devices(&folder.table("compare.csv")?.unwrap_or_default()),
        Kind::Probability => vec![findings::probable(folder)],
    })
}

/// The shares of a map, the largest first.
fn map(folder: &Folder) -> Vec<String> {
    let cells = folder.number("cells").unwrap_or(0.0).max(1.0);
    if cells == 1.0 {
        return findings::single(folder).into_iter().collect();
    }
    let counts = folder.run.get("outcomes").and_then(Value::as_object);
    let shares = counts.into_iter().flatten().filter_map(|(key, count)| {
        let share = count.as_f64()? / cells;
        (share > 0.0).then_some((share, findings::outcome(key)))
    });
    let mut shares: Vec<(f64, &str)> = shares.collect();
    shares.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let told = shares.into_iter().enumerate().map(|(number, (share, what))| match number {
        0 => format!("In {} of the {cells} points of the map the block {what}", percent(share)),
        _ => format!("in {} it {what}", percent(share)),
    });
    vec![told.collect::<Vec<_>>().join(", ") + "."]
}

fn suite(rows: &Rows) -> Vec<String> {
    let peaks = rows.iter().filter_map(|row| row.get("pga_h")?.parse::<f64>().ok());
    let (least, most) = peaks.fold((f64::MAX, 0.0_f64), |(a, b), peak| (a.min(peak), b.max(peak)));
    let peaks = match most >= least {
        true => format!(", with horizontal peaks from {} to {} m/s²", number(least), number(most)),
        false => String::new(),
    };
    let count = rows.len();
    vec![format!("{count} {}{peaks}.", if count == 1 { "motion" } else { "motions" })]
}

/// Which devices of a comparison keep all limits, or else under which one the block stands most often.
fn devices(rows: &Rows) -> Vec<String> {
    let name = |row: &std::collections::BTreeMap<String, String>| {
        row.get("device").cloned().unwrap_or_default()
    };
    let keeps = rows.iter().filter(|row| row.get("feasible").is_some_and(|is| is == "1"));
    let mut keeps: Vec<String> = keeps.map(name).collect();
    if keeps.is_empty() {
        let standing = |row: &&std::collections::BTreeMap<String, String>| -> f64 {
            row.get("standing").and_then(|text| text.parse().ok()).unwrap_or(0.0)
        };
        let best = rows.iter().max_by(|a, b| standing(a).total_cmp(&standing(b)));
        return match best {
            Some(_) if rows.len() == 1 => vec![format!(
                "The device does not keep all limits; the block stands under {} of the motions.",
                percent(rows.first().map_or(0.0, |row| standing(&row)))
            )],
            Some(best) => vec![format!(
                "None of {} devices keeps all limits; the block stands most often on {}: under {} of the motions.",
                rows.len(),
                name(best),
                percent(standing(&best))
            )],
            None => Vec::new(),
        };
    }
    let (count, more) = (keeps.len(), keeps.len() > NAMED);
    keeps.truncate(NAMED);
    let named = keeps.join(", ") + if more { ", …" } else { "" };
    let keep = if count == 1 { "keeps" } else { "keep" };
    let mut told = vec![format!("{count} of {} devices {keep} all limits: {named}.", rows.len())];
    let reserve = |row: &&std::collections::BTreeMap<String, String>| -> f64 {
        row.get("reserve").and_then(|text| text.parse().ok()).unwrap_or(0.0)
    };
    let best = rows.iter().max_by(|a, b| reserve(a).total_cmp(&reserve(b)));
    if let Some(best) = best.filter(|best| reserve(best) > 0.0) {
        let most = if count == 1 { "" } else { ", more than the others or as much" };
        told.push(format!(
            "{} keeps them up to {} times the motions{most}.",
            name(best),
            shown(best, "reserve")
        ));
    }
    told
}

/// What a second calculation says of a run.
pub fn checked(folder: &Folder) -> String {
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
