//! What the heading of a hazard curve says of its columns: what is not what is read below it is refused.

use super::hazard_error::HazardError;
use crate::suites::intensity::Intensity;
use topple::scene::shown::shown;

/// What stands beside the levels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rates {
    /// Annual rates of exceedance.
    Annual,
    /// Return periods, years.
    Periods,
}

/// Words of a second column, in a first one a sign that both are exchanged.
const OF_RATES: [&str; 6] = ["rate", "frequency", "lambda", "afe", "mafe", "exceedance"];
/// Units that are not read.
const UNITS: [&str; 7] = ["mg", "%g", "%", "mm/s2", "cm/s", "mm/s", "in/s"];

/// Judges a heading.
pub(super) fn judged(heading: &[&str], measure: Intensity) -> Result<Rates, HazardError> {
    let refused =
        |word: &str, problem: String| Err(HazardError::Heading { heading: shown(word), problem });
    let (Some(level), Some(rate)) = (heading.first(), heading.get(1)) else {
        return Ok(Rates::Annual);
    };
    let [of_level, of_rate] = [level, rate].map(|word| words(word));
    let has = |words: &[String], wanted: &[&str]| {
        words.iter().any(|word| wanted.contains(&word.as_str()))
    };
    if has(&of_level, &OF_RATES) || of_level.iter().any(|word| word.starts_with("prob")) {
        let problem = "the levels come first, their annual rates second; exchange the columns";
        return refused(level, problem.into());
    }
    let name = measure.to_string();
    let own = name.split([':', '*']).next().unwrap_or_default();
    let known = ["pga", "pgv", "sa", "arias", "cav"];
    let found = of_level.first().map(String::as_str).filter(|word| known.contains(word));
    if let Some(found) = found
        && own.trim_start_matches("avg-") != found
    {
        let problem = format!(
            "these are levels of {found}, not of {name}; give their curve, or another measure"
        );
        return refused(level, problem);
    }
    // Behind the name, so that a level in percent of g is none of g.
    if let Some(unit) = of_level.iter().skip(1).find(|word| UNITS.contains(&word.as_str())) {
        let wanted = if measure.unit() == "m/s²" { "g or m/s2" } else { measure.unit() };
        return refused(level, format!("levels in {unit} are not read; give {wanted}"));
    }
    if of_rate.iter().any(|word| word.starts_with("prob") || word == "poe") {
        let problem = "these are probabilities; give annual rates of exceedance, -ln(1 - p)/T of a probability p in T years";
        return refused(rate, problem.into());
    }
    let periods = has(&of_rate, &["period", "tr", "rp"]);
    Ok(if periods { Rates::Periods } else { Rates::Annual })
}

/// The words of a heading, in small letters.
fn words(heading: &str) -> Vec<String> {
    let between = |c: char| c.is_whitespace() || "()[]_".contains(c);
    let words = heading.split(between).filter(|word| !word.is_empty());
    words.map(str::to_lowercase).collect()
}
