//! What the heading of a hazard curve says of its two columns, in the words of short lists: what says nothing of them, or another thing
//! than the study needs, is refused.

use crate::sheet::TableError;
use crate::suites::intensity::Intensity;
use topple::Written;
use topple::scene::GRAVITY;
use topple::scene::record::Units;

/// A unit: its spellings, its name, and what it is in SI units.
type Unit = (&'static str, &'static str, f64);

/// Units of accelerations. The names are those of `--hazard-units`.
pub const ACCELERATIONS: [Unit; 3] = [
    ("g", "g", GRAVITY),
    ("m/s2|m/s/s|ms-2", "m/s2", 1.0),
    ("cm/s2|cm/s/s|cms-2|gal|gals", "cm/s2", 0.01),
];
/// Units of velocities, in which the Arias intensity is, too, and of the cumulative absolute velocity.
pub const VELOCITIES: [Unit; 3] =
    [("m/s|ms-1", "m/s", 1.0), ("cm/s|cms-1", "cm/s", 0.01), ("gs", "g s", GRAVITY)];
/// What stands for the unit of a ratio.
pub const RATIOS: [Unit; 1] = [("-|1", "1", 1.0)];

/// The measures by their words of `--im`, with the names of their levels in small letters.
pub const MEASURES: [(&str, &str); 8] = [
    ("pga", "pga|peak ground acceleration"),
    ("pgv", "pgv|peak ground velocity"),
    ("sa", "sa|psa|spectral acceleration|pseudo acceleration|pseudo spectral acceleration"),
    ("avg-sa", "avg sa|avgsa|sa avg|saavg|average sa|average spectral acceleration"),
    ("arias", "arias|arias intensity|ia"),
    ("cav", "cav|cumulative absolute velocity"),
    ("pga*", "pga*"),
    ("pgv*", "pgv*"),
];
/// Names of levels of any measure.
pub const ANY: &str = "level|im|iml|intensity measure|intensity measure level|intensity level|intensity|ground motion";
/// Names of levels of any acceleration.
pub const ACCELERATION_NAMES: &str = "acc|acceleration";
/// Measures that no study has.
const OTHERS: &str = "pgd|mmi|ems|jma|sd|sv|psv|psd";
/// The horizontal component whose median is that of one component; what else a component is called is not read.
pub const COMPONENTS: &str = "rotd50|gmrotd50|gmroti50|geomean|horizontal";
/// The damping of `sa` and `avg-sa`.
const DAMPING: &str = "5%|damping|damped";
/// The unit of a period.
const SECONDS: &str = "seconds|second|sec|s";

/// Names of annual rates without their first words, `mean`, `annual` or `yearly`.
pub const RATES: &str = "rate|frequency|rate of exceedance|frequency of exceedance|exceedance rate|exceedance frequency|lambda|\u{3bb}|maf|mafe|mar|\
                     mre|afe|afoe|exceedances|events";
/// What may stand behind them.
pub const PER_YEAR: &str = "1/yr|1/year|1/a|1/y|/yr|/year|/a|/y|yr-1|year-1|a-1|per year|per yr|per annum|1/jahr|/jahr|pro jahr|par an";
/// Names of return periods.
pub const PERIODS: &str =
    "return period|mean return period|recurrence interval|mean recurrence interval|tr|t r|rp|mri";
/// What may stand behind them.
pub const YEARS: &str = "years|year|yrs|yr|y|a";
/// What is part of a word for a probability, or is one.
const PROBABILITIES: &str = "prob|poe|wahrsch|w-keit|percent|prozent|%|verosim|vjerojat|pravd|вероятн|πιθαν|olasıl|sannol|todenn|kans|確率|概率|확률|احتمال";
const PROBABILITY_WORDS: &str = "p|pe|pp|ep|ape|aep|wkt";

/// True of a word of a list.
fn is_of(list: &str, word: &str) -> bool {
    list.split('|').any(|known| known == word)
}

/// True of a text that has a word of a list in it.
fn has(list: &str, text: &str) -> bool {
    list.split('|').any(|part| text.contains(part))
}

/// What stands beside the levels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rates {
    /// Annual rates of exceedance.
    Annual,
    /// Return periods, years.
    Periods,
}

/// What a heading says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Heading {
    /// The name of the levels' unit, and what it is in SI units; none where the heading has none.
    pub unit: Option<(&'static str, f64)>,
    /// What the second column has.
    pub rates: Rates,
}

/// Judges the heading of a line: `asked` is the unit that the caller gives.
pub fn judged(
    line: usize,
    [level, rate]: [&str; 2],
    measure: Intensity,
    asked: Option<Units>,
) -> Result<Heading, TableError> {
    if is_of_rates(level) && !is_of_rates(rate) {
        let problem = "the levels come first, their annual rates second; exchange the columns";
        return Err(TableError::of_cell(line, level, problem));
    }
    let unit = levels(level, measure, asked)
        .map_err(|problem| TableError::of_cell(line, level, problem))?;
    let rates = match rates(rate) {
        Some(rates) => rates,
        None if is_probability(rate) => {
            let problem = "says no annual rate of exceedance, but a probability; write rates and call them `rate`: a probability p \
                           in T years, as a share and not in percent, is a rate of -ln(1 - p)/T";
            return Err(TableError::of_cell(line, rate, problem));
        }
        None => {
            let problem = "says no annual rate of exceedance; if the numbers are such rates, call them `rate`, and return periods \
                           `return period`; a probability p in T years is a rate of -ln(1 - p)/T";
            return Err(TableError::of_cell(line, rate, problem));
        }
    };
    Ok(Heading { unit, rates })
}

/// The unit that the name of the levels tells, where it names the measure.
pub(super) fn levels(
    heading: &str,
    measure: Intensity,
    asked: Option<Units>,
) -> Result<Option<(&'static str, f64)>, String> {
    let units = units(measure);
    let (key, own_period) = of_measure(measure);
    let wanted = || {
        let period = own_period.map_or_else(String::new, |period| format!("({period})"));
        // In the unit that the heading has, so that nobody who follows the advice changes it.
        let has = |of: &str| words(heading).iter().any(|word| is_of(of, &spelled(word)));
        let own = units.iter().find(|(spellings, ..)| has(spellings)).unwrap_or(&units[0]);
        let unit = Some(own.1).filter(|unit| *unit != "1");
        format!("{key}{period}{}", unit.map_or_else(String::new, |unit| format!(" [{unit}]")))
    };
    let words = words(heading);
    let Some(named) = Named::of(&words, measure) else {
        return match asked {
            Some(units) if !contradicts_levels(heading, &words, units) => Ok(None),
            _ => Err(format!(
                "names no measure that is read; call levels of {measure} `{}`",
                wanted()
            )),
        };
    };
    let Named { is_own, is_other, period, rest } = named;
    if is_own && own_period.is_some() && period.is_none() && asked.is_none() {
        return Err(format!("names no period; write `{}`", wanted()));
    }
    if is_other {
        return Err(format!(
            "these are no levels of {measure}; give the curve of {measure}, or another measure"
        ));
    }
    if rest.is_empty() {
        return Ok(None);
    }
    let of = spelled(&rest.concat());
    let unit = units.iter().find(|(spellings, ..)| is_of(spellings, &of));
    let (_, name, factor) = *unit.ok_or_else(|| {
        let names: Vec<&str> = units.iter().map(|(_, name, _)| *name).collect();
        let divided = if of.contains('%') { ", the numbers divided by 100" } else { "" };
        format!("levels in `{}` are not read; give {}{divided}", rest.join(" "), names.join(", "))
    })?;
    match asked {
        Some(asked) if asked.key() != name => {
            Err(format!("its levels are in {name}, not in {}; leave the units out", asked.key()))
        }
        _ => Ok(Some((name, factor))),
    }
}

/// The word of a measure in [`MEASURES`], and its period.
fn of_measure(measure: Intensity) -> (String, Option<f64>) {
    match measure {
        Intensity::Sa(period) => ("sa".into(), Some(period)),
        Intensity::AverageSa(period) => ("avg-sa".into(), Some(period)),
        other => (other.to_string(), None),
    }
}

/// A heading that begins with a name of levels, against the measure of a study.
struct Named<'a> {
    /// It names the measure.
    is_own: bool,
    /// It names another measure, or another period.
    is_other: bool,
    period: Option<f64>,
    /// The words behind, without a damping.
    rest: Vec<&'a str>,
}

impl<'a> Named<'a> {
    fn of(words: &'a [String], measure: Intensity) -> Option<Named<'a>> {
        let words: Vec<&str> =
            words.iter().map(String::as_str).filter(|word| !is_of(COMPONENTS, word)).collect();
        let heads = (1..=4).rev().filter_map(|count| Some((words.get(..count)?.join(" "), count)));
        let (name, count) = { heads }.find(|(name, _)| is_name(name))?;
        let is_of_key =
            |key: &str| MEASURES.iter().any(|(own, names)| *own == key && is_of(names, &name));
        let mut rest = &words[count..];
        let has_period = is_of_key("sa") || is_of_key("avg-sa");
        let period = rest.first().filter(|_| has_period).and_then(|word| period(word));
        if period.is_some() {
            let behind = rest.get(1).is_some_and(|word| is_of(SECONDS, word));
            rest = &rest[1 + usize::from(behind)..];
        }
        let (key, own_period) = of_measure(measure);
        let is_general =
            is_of(ANY, &name) || is_of(ACCELERATION_NAMES, &name) && measure.unit() == ACCELERATION;
        let is_own = is_of_key(&key);
        let is_other = if is_own { period.is_some() && period != own_period } else { !is_general };
        let rest = rest.iter().copied().filter(|word| !is_of(DAMPING, word)).collect();
        Some(Named { is_own, is_other, period, rest })
    }
}

/// True of a comment that is a name of levels of another measure or of another period, with nothing but their unit behind it.
pub(super) fn is_of_another(comment: &str, measure: Intensity) -> bool {
    let words = words(comment);
    let Some(Named { is_other, rest, .. }) = Named::of(&words, measure) else { return false };
    let unit = spelled(&rest.concat());
    let units = [&ACCELERATIONS[..], &VELOCITIES, &RATIOS].concat();
    is_other && (unit.is_empty() || units.iter().any(|(spellings, ..)| is_of(spellings, &unit)))
}

/// The unit of the measures that may be given in g.
pub(super) const ACCELERATION: &str = "m/s²";

/// The units that a measure may have.
fn units(measure: Intensity) -> &'static [Unit] {
    match measure {
        Intensity::Pga | Intensity::Sa(_) | Intensity::AverageSa(_) => &ACCELERATIONS,
        Intensity::Pgv | Intensity::Arias => &VELOCITIES[..2],
        Intensity::Cav => &VELOCITIES,
        Intensity::RelativePga | Intensity::RelativePgv => &RATIOS,
    }
}

/// True of a name of levels of a list.
fn is_name(name: &str) -> bool {
    is_of(ANY, name) || is_of_measure(name)
}

/// True of the name of a measure, or of an acceleration.
fn is_of_measure(name: &str) -> bool {
    is_of(ACCELERATION_NAMES, name) || MEASURES.iter().any(|(_, names)| is_of(names, name))
}

/// True of words of a probability.
pub(super) fn is_of_probabilities(text: &str) -> bool {
    has(PROBABILITIES, &text.to_lowercase())
}

/// True of two names that are a heading, and not words of a comment: one of them is of a list.
pub(super) fn is_meant([level, rate]: [&str; 2]) -> bool {
    let is_level = words(level).first().is_some_and(|word| is_name(word));
    is_level || is_of_rates(rate)
}

/// True of a name of annual rates or of return periods.
pub(super) fn is_of_rates(heading: &str) -> bool {
    rates(heading).is_some()
}

/// What the name of the second column says; none where it is of no list.
fn rates(heading: &str) -> Option<Rates> {
    let said = words(heading).join(" ").replace('^', "");
    let with = |ends: &str, is: &dyn Fn(&str) -> bool| {
        let mut ends = ends.split('|');
        ends.any(|end| match said.strip_suffix(end) {
            Some(name) if name.ends_with(' ') || end.starts_with('/') => is(name.trim_end()),
            _ => false,
        })
    };
    let is_rate = |name: &str| {
        let name = name.strip_prefix("mean ").unwrap_or(name);
        let first = ["annual ", "yearly "].into_iter().find_map(|first| name.strip_prefix(first));
        is_of(RATES, first.unwrap_or(name))
    };
    let is_period = |name: &str| is_of(PERIODS, name);
    // Alone these words say no time.
    if with(PER_YEAR, &is_rate) || is_rate(&said) && !is_of("exceedances|events", &said) {
        return Some(Rates::Annual);
    }
    (with(YEARS, &is_period) || is_period(&said)).then_some(Rates::Periods)
}

/// True of a name of a probability.
fn is_probability(heading: &str) -> bool {
    let is_word = |word: &String| is_of(PROBABILITY_WORDS, word);
    is_of_probabilities(heading) || words(heading).iter().any(is_word)
}

/// True of a name of levels, of no list, that has a measure, or in brackets a unit, of its own.
fn contradicts_levels(heading: &str, said: &[String], units: Units) -> bool {
    let brackets =
        heading.split(['(', '[']).skip(1).filter_map(|part| part.split([')', ']']).next());
    let is_other = |unit: &str| {
        let of = spelled(&words(unit).concat());
        !ACCELERATIONS.iter().any(|(all, name, _)| *name == units.key() && is_of(all, &of))
    };
    said.iter().any(|word| is_of(OTHERS, word) || is_of_measure(word)) || { brackets }.any(is_other)
}

/// A period, s: `0.2`, `0.2s`, `t=0.2`, `0p2`.
fn period(word: &str) -> Option<f64> {
    let word = word.strip_prefix("t=").unwrap_or(word);
    let word = SECONDS.split('|').find_map(|unit| word.strip_suffix(unit)).unwrap_or(word);
    word.replace('p', ".").parse().ok().filter(|period: &f64| *period > 0.0)
}

/// A unit without what differs from writer to writer.
fn spelled(unit: &str) -> String {
    let unit = unit.replace("seconds", "s").replace("second", "s").replace("sec", "s");
    unit.chars().filter(|c| !matches!(c, '^' | '*' | '.' | '\u{b7}')).collect()
}

/// The words of a heading in small letters: what brackets, underscores, commas and blanks part, and hyphens between letters. A measure
/// with a number behind it is two words: `sa0.2`. A comma between digits is a decimal one.
fn words(heading: &str) -> Vec<String> {
    let letters: Vec<char> =
        heading.to_lowercase().replace("exceedence", "exceedance").chars().collect();
    let mut plain = String::with_capacity(heading.len());
    for (at, letter) in letters.iter().enumerate() {
        let beside = |at: usize| letters.get(at).copied().unwrap_or(' ');
        let before = if at > 0 { letters[at - 1] } else { ' ' };
        let between = |is: fn(char) -> bool| is(before) && is(beside(at + 1));
        plain.push(match letter {
            ',' if between(|c| c.is_ascii_digit()) => '.',
            '-' if between(char::is_alphabetic) => ' ',
            '[' | ']' | '(' | ')' | '{' | '}' | '_' | ',' | ':' | ';' | '"' => ' ',
            '\u{2212}' | '\u{207b}' => '-',
            '\u{b9}' => '1',
            '\u{b2}' => '2',
            letter => *letter,
        });
    }
    let mut words: Vec<String> = plain.split_whitespace().map(String::from).collect();
    if let Some(first) = words.first_mut()
        && let Some(at) = first.find(|c: char| c.is_ascii_digit())
        && ["sa", "psa", "avgsa"].contains(&&first[..at])
    {
        let period = first.split_off(at);
        words.insert(1, period);
    }
    words
}
