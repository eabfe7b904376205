//! What the heading of a hazard curve says of its two columns, in the words of short lists: what says nothing of them, or another thing
//! than the study needs, is refused.

use crate::sheet::TableError;
use crate::suites::intensity::Intensity;
use topple::Written;
use topple::scene::record::Units;

/// A unit with the spellings that are read, its name, and what it is in SI units.
type Unit = (&'static [&'static str], &'static str, f64);

/// Units of accelerations. The names are those of `--hazard-units`.
const ACCELERATIONS: [Unit; 3] = [
    (&["g"], "g", topple::scene::GRAVITY),
    (&["m/s2", "m/s/s", "ms-2"], "m/s2", 1.0),
    (&["cm/s2", "cm/s/s", "cms-2", "gal"], "cm/s2", 0.01),
];
/// Units of velocities, in which the Arias intensity is, too.
const VELOCITIES: [Unit; 2] = [(&["m/s", "ms-1"], "m/s", 1.0), (&["cm/s", "cms-1"], "cm/s", 0.01)];
/// Units of the cumulative absolute velocity.
const CUMULATIVE: [Unit; 3] =
    [VELOCITIES[0], VELOCITIES[1], (&["gs"], "g s", topple::scene::GRAVITY)];
/// What stands for the unit of a ratio.
const RATIOS: [Unit; 1] = [(&["-", "1"], "1", 1.0)];

/// What a name of levels says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Named {
    Any,
    Acceleration,
    Pga,
    Pgv,
    Sa,
    AverageSa,
    Arias,
    Cav,
    RelativePga,
    RelativePgv,
}

/// The names of levels, in small letters.
const NAMES: [(&str, Named); 30] = [
    ("level", Named::Any),
    ("im", Named::Any),
    ("iml", Named::Any),
    ("intensity measure", Named::Any),
    ("intensity measure level", Named::Any),
    ("acc", Named::Acceleration),
    ("acceleration", Named::Acceleration),
    ("pga", Named::Pga),
    ("peak ground acceleration", Named::Pga),
    ("pgv", Named::Pgv),
    ("peak ground velocity", Named::Pgv),
    ("sa", Named::Sa),
    ("psa", Named::Sa),
    ("spectral acceleration", Named::Sa),
    ("pseudo acceleration", Named::Sa),
    ("pseudo spectral acceleration", Named::Sa),
    ("avgsa", Named::AverageSa),
    ("saavg", Named::AverageSa),
    ("avg sa", Named::AverageSa),
    ("sa avg", Named::AverageSa),
    ("average sa", Named::AverageSa),
    ("average spectral acceleration", Named::AverageSa),
    ("arias", Named::Arias),
    ("arias intensity", Named::Arias),
    ("ia", Named::Arias),
    ("cav", Named::Cav),
    ("cumulative absolute velocity", Named::Cav),
    ("pga*", Named::RelativePga),
    ("pgv*", Named::RelativePgv),
    ("intensity level", Named::Any),
];
/// Measures that no study has.
const OTHERS: [&str; 8] = ["pgd", "mmi", "ems", "jma", "sd", "sv", "psv", "psd"];
/// The horizontal component whose median is that of one component; what else a component is called is not read.
const COMPONENTS: [&str; 5] = ["rotd50", "gmrotd50", "gmroti50", "geomean", "horizontal"];
/// The damping of `sa` and `avg-sa`.
const DAMPING: [&str; 3] = ["5%", "damping", "damped"];

/// What stands beside the levels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rates {
    /// Annual rates of exceedance.
    Annual,
    /// Return periods, years.
    Periods,
}

/// Names of annual rates without their first words, `mean`, `annual` or `yearly`.
const RATES: [&str; 14] = [
    "rate",
    "frequency",
    "rate of exceedance",
    "frequency of exceedance",
    "exceedance rate",
    "exceedance frequency",
    "lambda",
    "\u{3bb}",
    "maf",
    "mafe",
    "mar",
    "afe",
    "afoe",
    "exceedances",
];
/// What may stand behind them.
const PER_YEAR: [&str; 12] = [
    "1/yr",
    "1/year",
    "1/a",
    "/yr",
    "/year",
    "/a",
    "yr-1",
    "year-1",
    "a-1",
    "per year",
    "per yr",
    "per annum",
];
/// Names of return periods.
const PERIODS: [&str; 8] = [
    "return period",
    "mean return period",
    "recurrence interval",
    "mean recurrence interval",
    "tr",
    "t r",
    "rp",
    "mri",
];
/// What may stand behind them.
const YEARS: [&str; 5] = ["years", "year", "yrs", "yr", "a"];
/// What is part of a word for a probability.
const PROBABILITIES: [&str; 6] = ["prob", "poe", "wahrsch", "percent", "prozent", "%"];
/// What may be of another time than a year.
const TIMES: [&str; 6] = ["day", "week", "month", "decade", "century", "exceedance"];

/// What a heading says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Heading {
    /// The name of the levels' unit, and what it is in SI units; none where the heading has none.
    pub unit: Option<(&'static str, f64)>,
    /// What the second column has.
    pub rates: Rates,
}

/// Judges the heading of a line: `asked` is the unit that the caller gives.
pub(super) fn judged(
    line: usize,
    [level, rate]: [&str; 2],
    measure: Intensity,
    asked: Option<Units>,
) -> Result<Heading, TableError> {
    let refused = |word: &str, problem: String| TableError::of_cell(line, word, problem);
    if rates(level).is_some() && rates(rate).is_none() {
        let problem = "the levels come first, their annual rates second; exchange the columns";
        return Err(refused(level, problem.into()));
    }
    let unit = levels(level, measure, asked).map_err(|problem| refused(level, problem))?;
    let rates = match rates(rate) {
        Some(rates) => rates,
        None if asked.is_some() && !contradicts_rates(rate) => Rates::Annual,
        None => {
            let problem = "says no annual rate of exceedance; if the numbers are such rates, call them `rate`, and return periods \
                           `return period`; a probability p in T years is a rate of -ln(1 - p)/T";
            return Err(refused(rate, problem.into()));
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
    let wanted = || {
        let unit = units(measure).first().map_or("", |(_, name, _)| name);
        let unit = if unit == "1" { String::new() } else { format!(" [{unit}]") };
        match measure {
            Intensity::Sa(period) => format!("sa({period}){unit}"),
            Intensity::AverageSa(period) => format!("avg-sa({period}){unit}"),
            other => format!("{other}{unit}"),
        }
    };
    let words = words(heading);
    let is_component = |word: &&str| !COMPONENTS.contains(word);
    let words: Vec<&str> = words.iter().map(String::as_str).filter(is_component).collect();
    let phrase = |count: usize| {
        let name = words.get(..count)?.join(" ");
        NAMES.iter().find(|(known, _)| *known == name).map(|(_, named)| (*named, count))
    };
    let Some((named, count)) = (1..=4).rev().find_map(phrase) else {
        return match asked {
            Some(units) if !contradicts_levels(heading, &words, units) => Ok(None),
            _ => Err(format!(
                "names no measure that is read; call levels of {measure} `{}`",
                wanted()
            )),
        };
    };
    let mut rest = &words[count..];
    let other = || {
        Err(format!(
            "these are no levels of {measure}; give the curve of {measure}, or another --im"
        ))
    };
    let own = match (named, measure) {
        (Named::Any, _) => true,
        (Named::Acceleration, of) => of.unit() == ACCELERATION,
        (Named::Sa, Intensity::Sa(own)) | (Named::AverageSa, Intensity::AverageSa(own)) => {
            match rest.first().and_then(|word| period(word)) {
                Some(period) if period == own => {
                    rest = &rest[1..];
                    let is_second = |word: &&&str| SECONDS.contains(*word);
                    rest = &rest[usize::from(rest.first().filter(is_second).is_some())..];
                    true
                }
                Some(_) => false,
                None if asked.is_some() => true,
                None => return Err(format!("names no period; write `{}`", wanted())),
            }
        }
        (named, measure) => Some(named) == named_of(measure),
    };
    if !own {
        return other();
    }
    let rest: Vec<&str> = rest.iter().copied().filter(|word| !DAMPING.contains(word)).collect();
    let of = spelled(&rest.concat());
    if of.is_empty() {
        return Ok(None);
    }
    let units = units(measure);
    let unit = units.iter().find(|(spellings, ..)| spellings.contains(&of.as_str()));
    let (_, name, factor) = unit.ok_or_else(|| {
        let names: Vec<&str> = units.iter().map(|(_, name, _)| *name).collect();
        format!("levels in `{}` are not read; give {}", rest.join(" "), names.join(", "))
    })?;
    match asked {
        Some(asked) if asked.key() != *name => {
            Err(format!("its levels are in {name}, not in {}; leave the units out", asked.key()))
        }
        _ => Ok(Some((name, *factor))),
    }
}

/// The unit of the measures that may be given in g.
pub(super) const ACCELERATION: &str = "m/s²";
/// Words of a period's unit.
const SECONDS: [&str; 4] = ["s", "sec", "second", "seconds"];

/// The units that a measure may have.
fn units(measure: Intensity) -> &'static [Unit] {
    match measure {
        Intensity::Pga | Intensity::Sa(_) | Intensity::AverageSa(_) => &ACCELERATIONS,
        Intensity::Pgv | Intensity::Arias => &VELOCITIES,
        Intensity::Cav => &CUMULATIVE,
        Intensity::RelativePga | Intensity::RelativePgv => &RATIOS,
    }
}

/// What a measure without a period is called.
fn named_of(measure: Intensity) -> Option<Named> {
    match measure {
        Intensity::Pga => Some(Named::Pga),
        Intensity::Pgv => Some(Named::Pgv),
        Intensity::Arias => Some(Named::Arias),
        Intensity::Cav => Some(Named::Cav),
        Intensity::RelativePga => Some(Named::RelativePga),
        Intensity::RelativePgv => Some(Named::RelativePgv),
        Intensity::Sa(_) | Intensity::AverageSa(_) => None,
    }
}

/// True of words of a probability.
pub(super) fn is_of_probabilities(text: &str) -> bool {
    let text = text.to_lowercase();
    PROBABILITIES.iter().any(|part| text.contains(part))
}

/// True of two names that are a heading, and not words of a comment: one of them is of a list, or the second is of a probability.
pub(super) fn is_meant([level, rate]: [&str; 2]) -> bool {
    let words = words(level);
    let is_first = |(name, _): &(&str, Named)| words.first().is_some_and(|word| word == name);
    is_of_rates(rate) || is_of_probabilities(rate) || NAMES.iter().any(is_first)
}

/// True of a name of annual rates or of return periods.
pub(super) fn is_of_rates(heading: &str) -> bool {
    rates(heading).is_some()
}

/// What the name of the second column says; none where it is of no list.
fn rates(heading: &str) -> Option<Rates> {
    let said = words(heading).join(" ").replace("^", "");
    let said = said.as_str();
    let without = |ends: &[&'static str]| -> Vec<&str> {
        let ended = |end: &&str| {
            let name = said.strip_suffix(end)?;
            (name.ends_with(' ') || end.starts_with('/')).then_some(name.trim_end())
        };
        ends.iter().filter_map(ended).chain([said]).collect()
    };
    let is_rate = |name: &&str| {
        let name = name.strip_prefix("mean ").unwrap_or(name);
        let first = ["annual ", "yearly "].into_iter().find_map(|first| name.strip_prefix(first));
        RATES.contains(&first.unwrap_or(name))
    };
    if without(&PER_YEAR).iter().any(is_rate) && said != "exceedances" {
        return Some(Rates::Annual);
    }
    let is_period = |name: &&str| PERIODS.contains(name);
    without(&YEARS).iter().any(is_period).then_some(Rates::Periods)
}

/// True of a name of the second column, of no list, that may be of something else than annual rates.
fn contradicts_rates(heading: &str) -> bool {
    let said = heading.to_lowercase();
    let is_probability = |word: &String| ["p", "pe", "pp", "ape", "aep"].contains(&word.as_str());
    said.contains(char::is_numeric)
        || is_of_probabilities(heading)
        || TIMES.iter().any(|part| said.contains(part))
        || words(heading).iter().any(is_probability)
}

/// True of a name of levels, of no list, that has a measure, or in brackets a unit, of its own.
fn contradicts_levels(heading: &str, said: &[&str], units: Units) -> bool {
    let is_named = |word: &&str| {
        let other = |(known, named): &(&str, Named)| known == word && *named != Named::Any;
        OTHERS.contains(word) || NAMES.iter().any(other)
    };
    let brackets =
        heading.split(['(', '[']).skip(1).filter_map(|part| part.split([')', ']']).next());
    let is_other = |unit: &str| {
        let spelled = spelled(&words(unit).concat());
        !ACCELERATIONS.iter().any(|(all, name, _)| *name == units.key() && all.contains(&&*spelled))
    };
    said.iter().any(is_named) || brackets.map(is_other).any(|other| other)
}

/// A period, s: `0.2`, `0.2s`, `t=0.2`, `0p2`.
fn period(word: &str) -> Option<f64> {
    let word = word.strip_prefix("t=").unwrap_or(word);
    let word = SECONDS.iter().rev().find_map(|unit| word.strip_suffix(unit)).unwrap_or(word);
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
    let letters: Vec<char> = heading.to_lowercase().chars().collect();
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

#[cfg(test)]
mod tests {
    use super::*;

    fn of(heading: [&str; 2], measure: &str, asked: Option<Units>) -> Result<Heading, String> {
        let measure = measure.parse().unwrap();
        judged(1, heading, measure, asked).map_err(|error| error.to_string())
    }

    #[test]
    fn names_of_levels_are_those_of_the_measure() {
        let g = Some("g");
        for (heading, measure, unit) in [
            ("level", "pga", None),
            ("IML", "sa:1", None),
            ("acc [m/s2]", "avg-sa:1", Some("m/s2")),
            ("PGA", "pga", None),
            ("pga_g", "pga", g),
            ("PGA [cm/s²]", "pga", Some("cm/s2")),
            ("PGA (gal)", "pga", Some("cm/s2")),
            ("PGA [m/sec**2]", "pga", Some("m/s2")),
            ("PGA [m·s⁻²]", "pga", Some("m/s2")),
            ("Peak Ground Acceleration, g", "pga", g),
            ("RotD50 PGA [g]", "pga", g),
            ("PGA_RotD50 (g)", "pga", g),
            ("SA(1.8) [g]", "sa:1.8", g),
            ("Sa(1.80 s) (g)", "sa:1.8", g),
            ("sa_1.8s_g", "sa:1.8", g),
            ("SA1.8 [g]", "sa:1.8", g),
            ("Sa(1,8 s) [g]", "sa:1.8", g),
            ("PSA (T=1.8s, 5%) [g]", "sa:1.8", g),
            ("pseudo-spectral acceleration 1.8 s [m/s/s]", "sa:1.8", Some("m/s2")),
            ("AvgSA(1.8) [g]", "avg-sa:1.8", g),
            ("avg-sa:1.8 [g]", "avg-sa:1.8", g),
            ("Peak ground velocity [cm/s]", "pgv", Some("cm/s")),
            ("PGV [m/s]", "pgv", Some("m/s")),
            ("PGV", "pgv", None),
            ("IA (cm/s)", "arias", Some("cm/s")),
            ("CAV [g·s]", "cav", Some("g s")),
            ("CAV (g-sec)", "cav", Some("g s")),
            ("pga* [-]", "pga*", Some("1")),
            ("pgv*", "pgv*", None),
        ] {
            let said = of([heading, "rate"], measure, None);
            let said = said.map(|said| said.unit.map(|(name, _)| name));
            assert_eq!(said, Ok(unit), "{heading} {measure}");
        }
    }

    #[test]
    fn other_measures_periods_and_units_are_refused() {
        let other = "these are no levels of";
        for (heading, measure, wanted) in [
            ("PSA [g]", "pga", other),
            ("Sa(0.2 s) (g)", "pga", other),
            ("PGA [g]", "sa:1.8", other),
            ("PGV (cm/s)", "pga", other),
            ("Peak Ground Velocity [m/s]", "pga", other),
            ("RotD50 PGA [g]", "pgv", other),
            ("PGA [g]", "pga*", other),
            ("PGV [m/s]", "pgv*", other),
            ("pga*", "pga", other),
            ("acc [m/s2]", "pgv", other),
            ("SA(0.2) [g]", "sa:1.8", other),
            ("SA(0.2) [g]", "avg-sa:1.8", other),
            ("SA(1.8) [g]", "avg-sa:1.8", other),
            ("SA_1.0 [g]", "sa:1.8", other),
            ("sa_0.2s", "sa:1.8", other),
            ("SA [g]", "sa:1.8", "names no period; write `sa(1.8) [g]`"),
            ("SA(1.8 Hz) [g]", "sa:1.8", "levels in `hz g` are not read"),
            ("SA(1.8, 2%) [g]", "sa:1.8", "levels in `2% g` are not read"),
            ("PGD [m]", "pga", "names no measure that is read; call levels of pga `pga [g]`"),
            ("MMI", "pga", "names no measure"),
            ("RotD100 PGA [g]", "pga", "names no measure"),
            ("accelerazione [g]", "pga", "names no measure"),
            ("PGA (mg)", "pga", "levels in `mg` are not read; give g, m/s2, cm/s2"),
            ("PGA [%g]", "pga", "levels in `%g` are not read"),
            ("PGA [g_n]", "pga", "levels in `g n` are not read"),
            ("PGA_cms2", "pga", "levels in `cms2` are not read"),
            ("PGA [ft/s2]", "pga", "levels in `ft/s2` are not read"),
            ("PGA [mm/s²]", "pga", "levels in `mm/s2` are not read"),
            ("PGA [m/s]", "pga", "levels in `m/s` are not read"),
            ("PGA vertical [g]", "pga", "levels in `vertical g` are not read"),
            ("PGA 0.1 [g]", "pga", "levels in `0.1 g` are not read"),
            ("PGV [g]", "pgv", "levels in `g` are not read; give m/s, cm/s"),
            ("PGV [in/s]", "pgv", "levels in `in/s` are not read"),
            ("Arias [g s]", "arias", "are not read; give m/s, cm/s"),
            ("pga* [g]", "pga*", "levels in `g` are not read"),
        ] {
            let said = of([heading, "rate"], measure, None).unwrap_err();
            let place = "line 1, column ";
            assert!(said.starts_with(place) && said.contains(wanted), "{heading}: {said}");
            // With the unit given, a name of no list is not judged, and no period is missed.
            if ["pga", "sa:1.8", "avg-sa:1.8"].contains(&measure) {
                let given = of([heading, "rate"], measure, Some(Units::G));
                let open = ["accelerazione [g]", "SA [g]"].contains(&heading);
                assert_eq!(given.is_ok(), open, "{heading} {given:?}");
            }
        }
    }

    #[test]
    fn names_of_rates_are_of_a_list() {
        for heading in [
            "rate",
            "Rate [1/yr]",
            "annual rate",
            "Annual rate of exceedance (1/year)",
            "annual_frequency_of_exceedance",
            "Mean annual frequency of exceedance [1/a]",
            "annual exceedance frequency",
            "exceedance rate, per year",
            "rate/yr",
            "rate [yr⁻¹]",
            "rate (yr^-1)",
            "lambda",
            "λ [1/a]",
            "MAF",
            "MAFE",
            "AFE",
            "exceedances per year",
        ] {
            let said = of(["PGA [g]", heading], "pga", None).map(|said| said.rates);
            assert_eq!(said, Ok(Rates::Annual), "{heading}");
        }
        for heading in [
            "Return period",
            "return period [years]",
            "T_R [yr]",
            "TR",
            "rp",
            "Mean recurrence interval (a)",
        ] {
            let said = of(["PGA [g]", heading], "pga", None).map(|said| said.rates);
            assert_eq!(said, Ok(Rates::Periods), "{heading}");
        }
        for heading in [
            "exceedance (50 years)",
            "Exceedance in 50 yr [%]",
            "50-year-probability",
            "PE50",
            "PoE50",
            "PE",
            "poe",
            "rate in 50 years",
            "rate [1/50yr]",
            "annual rate [%]",
            "probability of exceedance in 50 years",
            "annual probability of exceedance",
            "APE",
            "rate per day",
            "rate [1/month]",
            "rate per decade",
            "probabilidad anual",
            "Überschreitungswahrscheinlichkeit",
            "P(PGA > x)",
            "return period [days]",
            "return period [%]",
            "rate x 1000",
            "10^-4 1/yr",
            "number of events in 475 years",
        ] {
            for asked in [None, Some(Units::G)] {
                let said = of(["PGA [g]", heading], "pga", asked).unwrap_err();
                assert!(said.contains("says no annual rate of exceedance"), "{heading}: {said}");
            }
        }
        // With the unit given, words of no list are not judged.
        for heading in ["x", "hazard", "exceedances", "frequenza annua"] {
            assert!(of(["PGA [g]", heading], "pga", None).is_err(), "{heading}");
            let given = of(["anything", heading], "pga", Some(Units::G));
            assert_eq!(given.is_ok(), heading != "exceedances", "{heading}");
        }
        for heading in [["annual rate", "pga"], ["lambda", "PGA (g)"], ["return period", "PGA [g]"]]
        {
            let said = of(heading, "pga", None).unwrap_err();
            assert!(said.contains("the levels come first"), "{said}");
        }
    }

    /// The page names every word that is read.
    #[test]
    fn the_page_has_the_lists() {
        let page = include_str!("../../../../docs/fragility.md");
        let units = [&ACCELERATIONS[..], &CUMULATIVE, &RATIOS].concat();
        let units = units.iter().map(|(spellings, ..)| spellings[0]).filter(|one| *one != "gs");
        let names = NAMES.iter().map(|(name, _)| *name);
        let lists = [&RATES[..], &PER_YEAR, &PERIODS, &YEARS, &COMPONENTS, &["gal", "g s", "5%"]];
        for word in units.chain(names).chain(lists.concat()) {
            assert!(page.contains(&format!("`{word}`")), "{word}");
        }
    }
}
