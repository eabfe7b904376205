//! A run in short: what was asked, what was found, and how sure that is.

use topple::sweep::verification::Verification;
use topple_manifest::{MapRun, Run, SuiteRun};
use topple_pictures::drawing::share::percent;
use topple_studies::Verified;

use super::folder::{Folder, ReportError, Row, Rows};
use super::tables::{number, shown, value};
use super::{along, findings, fragility};

/// Devices that are named.
const NAMED: usize = 6;

/// The three, a line each.
pub fn of(folder: &Folder) -> Result<Vec<String>, ReportError> {
    let mut sure = vec![sentence(&checked(folder))];
    match folder.run() {
        Run::Envelope(run) => sure.extend(fragility::intervals(&run.own.drawn)),
        Run::Fragility(run) => sure.extend(fragility::sureness(folder, &run.own)?),
        Run::Comparison(run) => sure.extend(fragility::intervals(&run.own.drawn)),
        _ => {}
    }
    match &folder.manifest.warnings[..] {
        [] => {}
        [one] => sure.push(format!("The run warned: {one}.")),
        [one, other] => sure.push(format!("The run warned: {one}. And: {other}.")),
        all => sure.push(format!("The run gave {} warnings, which stand below.", all.len())),
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
    Ok(match folder.run() {
        Run::Map(run) => map(folder, run)?,
        Run::History(run) => vec![findings::motion(run)],
        Run::Suite(run) => suite(run, &findings::motions(folder)?),
        Run::Envelope(run) => {
            let best = findings::best(folder, run)?;
            std::iter::once(findings::kept(folder, run)).chain(best).collect()
        }
        Run::Fragility(run) => fragility::shortly(folder, &run.own)?,
        Run::Comparison(run) => {
            let rows = folder.table("compare.csv")?.unwrap_or_default();
            let limits = findings::limits(folder, &run.own.limits);
            std::iter::once(limits).chain(devices(&rows)).collect()
        }
        Run::Probability(run) => vec![findings::probable(run)],
    })
}

/// What becomes of the block along the only axis of a map; else the shares of the map, the largest first.
fn map(folder: &Folder, run: &MapRun) -> Result<Vec<String>, ReportError> {
    let cells = run.cells.max(1);
    if cells == 1 {
        return Ok(findings::single(run).into_iter().chain(findings::tensile(run)).collect());
    }
    if let Some(along) = along::of(folder, cells)? {
        return Ok(std::iter::once(along).chain(findings::tensile(run)).collect());
    }
    let shares = run.outcomes.iter().filter(|(_, count)| **count > 0);
    let shares = shares.map(|(key, count)| (*count as f64 / cells as f64, findings::outcome(key)));
    let mut shares: Vec<(f64, &str)> = shares.collect();
    shares.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let told = shares.into_iter().enumerate().map(|(number, (share, what))| match number {
        0 => format!("In {} of the {cells} points of the map the block {what}", percent(share)),
        _ => format!("in {} it {what}", percent(share)),
    });
    let told = told.collect::<Vec<_>>().join(", ")
        + ". Such a share is no probability: it depends on the ranges of the axes.";
    Ok(std::iter::once(told).chain(findings::tensile(run)).collect())
}

fn suite(run: &SuiteRun, rows: &Rows) -> Vec<String> {
    let peaks = rows.iter().filter_map(|row| value(row, "pga_h"));
    let (least, most) = peaks.fold((f64::MAX, 0.0_f64), |(a, b), peak| (a.min(peak), b.max(peak)));
    let peaks = match most >= least {
        true => format!(", with horizontal peaks from {} to {} m/s²", number(least), number(most)),
        false => String::new(),
    };
    let counted = |count: usize, thing: &str| match count {
        1 => format!("1 {thing}"),
        count => format!("{count} {thing}s"),
    };
    let groups = [(run.recordings, "recording"), (run.events, "earthquake")];
    let of = groups.iter().filter_map(|(count, thing)| Some(counted((*count)?, thing)));
    let of: String = of.map(|of| format!(" of {of}")).collect();
    let mut told = vec![format!("{}{of}{peaks}.", counted(rows.len(), "motion"))];
    let left_out = run.left_out.len();
    if left_out > 0 {
        let have = if left_out == 1 { "has" } else { "have" };
        told.push(format!("{} of the suite {have} no motion.", counted(left_out, "line")));
    }
    told
}

/// Which devices of a comparison keep all limits, or else under which the block stands most often; and which has the lowest rate.
pub fn devices(rows: &Rows) -> Vec<String> {
    let (all, count) = (rows.iter().collect::<Vec<_>>(), rows.len());
    let keeps: Vec<_> =
        rows.iter().filter(|row| row.get("feasible").is_some_and(|is| is == "1")).collect();
    let mut told = Vec::new();
    match (&keeps[..], &all[..]) {
        (_, []) => return told,
        ([], [one]) => told.push(format!(
            "The device does not keep all limits; the block stands under {} of the motions.",
            share(one, "standing")
        )),
        ([], _) => {
            let best = best(&all, "standing", f64::max);
            told.push(format!(
                "None of {count} devices keeps all limits; the block stands most often on {}: under {} of the motions.",
                named(&best),
                best.first().map_or(String::new(), |row| share(row, "standing"))
            ));
        }
        (some, _) => {
            let keep = if some.len() == 1 { "keeps" } else { "keep" };
            told.push(format!(
                "{} of {count} devices {keep} all limits: {}.",
                some.len(),
                named(some)
            ));
        }
    }
    let longest = best(&keeps, "reserve", f64::max);
    if let Some(row) = longest.first().filter(|row| value(row, "reserve").is_some_and(|r| r > 0.0))
    {
        let keep = if longest.len() == 1 { "keeps" } else { "keep" };
        let most = if keeps.len() > longest.len() { ", the others less" } else { "" };
        told.push(format!(
            "{} {keep} them up to {} times the motions{most}.",
            named(&longest),
            shown(row, "reserve")
        ));
    }
    let rarest = best(&all, "rate", f64::min);
    if let Some(row) = rarest.first().filter(|_| count > 1) {
        let within = match (value(row, "rate_low"), value(row, "rate_high")) {
            (Some(low), Some(high)) if rarest.len() == 1 => {
                format!(" (95 %: {} to {})", number(low), number(high))
            }
            _ => String::new(),
        };
        told.push(format!(
            "The lowest rate of overturning is computed on {}: {} a year{within}.",
            named(&rarest),
            shown(row, "rate")
        ));
    }
    told
}

fn share(row: &Row, column: &str) -> String {
    percent(value(row, column).unwrap_or(0.0))
}

/// The rows with the largest, or the least, number of a column: several where it is equal.
fn best<'a>(rows: &[&'a Row], column: &str, of: fn(f64, f64) -> f64) -> Vec<&'a Row> {
    let most = rows.iter().filter_map(|row| value(row, column)).reduce(of);
    rows.iter().copied().filter(|row| most.is_some() && value(row, column) == most).collect()
}

/// The names of devices, which may have commas of their own.
fn named(rows: &[&Row]) -> String {
    let names = rows.iter().take(NAMED).filter_map(|row| row.get("device").cloned());
    names.collect::<Vec<_>>().join("; ") + if rows.len() > NAMED { "; …" } else { "" }
}

/// What a second calculation says of a run.
pub fn checked(folder: &Folder) -> String {
    let second = "A second, independent and slower calculation has repeated";
    let none = "nothing was calculated a second time.".to_string();
    let (sampled, differ) = match folder.run() {
        Run::Map(run) => match &run.verification {
            Some(of) if of.sampled > 0 => {
                let Verification { sampled, differ, beside_boundary, .. } = of;
                return format!(
                    "{second} {sampled} of {} calculations; the outcome differs in {differ} ({}). {beside_boundary} of the repeated ones \
                     lie beside another outcome, where outcomes are hardest to tell.",
                    run.cells,
                    percent(*differ as f64 / *sampled as f64),
                );
            }
            _ => return none,
        },
        Run::Probability(run) => (run.verified[0], run.verified[1]),
        Run::Envelope(run) => counts(&run.verified),
        Run::Fragility(run) => counts(&run.verified),
        Run::Comparison(run) => counts(&run.verified),
        Run::History(_) | Run::Suite(_) => return none,
    };
    match sampled {
        0 => none,
        _ => format!("{second} {sampled} of the calculations; the outcome differs in {differ}."),
    }
}

/// Cells that the reference ran again, and those of another outcome.
fn counts(of: &Verified) -> (usize, usize) {
    (of.sampled as usize, of.differ as usize)
}
