//! Hazard curves as texts: a table of levels and rates, and the curve of a site as OpenQuake exports it.

use std::borrow::Cow;

use super::hazard::HazardCurve;
use super::hazard_heading::{self, ACCELERATION, Heading, Rates};
use super::hazard_openquake::{self, POE};
use crate::sheet::{BLANKS, Row, Rows, Sheet, TableError, comments, is_number};
use crate::suites::intensity::Intensity;
use topple::Written;
use topple::scene::record::Units;
use topple::scene::record::text::decoded;
use topple::scene::shown::shown;

/// A hazard curve with what its text says of its levels.
#[derive(Debug, Clone, PartialEq)]
pub struct HazardText {
    /// The curve, its levels in SI units.
    pub curve: HazardCurve,
    /// The unit that its levels were read in.
    pub unit: &'static str,
    /// True where neither the text nor the caller says the unit of the levels: that of SI was taken.
    pub assumed: bool,
    /// What the curve was read from, in words.
    pub source: String,
}

/// Reads the curve of a file, as [`read`] does.
pub fn of_bytes(
    bytes: &[u8],
    measure: Intensity,
    asked: Option<Units>,
) -> Result<HazardText, TableError> {
    // XML is named as what it is here.
    let text = match bytes.trim_ascii_start().starts_with(b"<") {
        true => String::from_utf8_lossy(bytes).into_owned(),
        false => decoded(bytes).map_err(|error| TableError::whole(error.to_string()))?,
    };
    read(&text, measure, asked)
}

/// Reads a curve of a measure; `asked` is the unit of its accelerations, where the caller says one.
///
/// A table has a level and its annual rate of exceedance, or its return period, in each line. Its heading says what they are, in words of
/// `hazard_heading`. A curve of OpenQuake has the probabilities of one site in a line: `lon,lat,depth,poe-0.05,poe-0.1`, below a comment
/// with the time that they are of.
pub fn read(
    text: &str,
    measure: Intensity,
    asked: Option<Units>,
) -> Result<HazardText, TableError> {
    if asked.is_some() && measure.unit() != ACCELERATION {
        let problem = format!("{measure} is no acceleration; leave the units out");
        return Err(TableError::whole(problem));
    }
    let start = text.trim_start_matches('\u{feff}').trim_start();
    if start.starts_with('<') {
        return Err(TableError::whole(
            "XML, as OpenQuake's NRML, or a web page; give the curve as CSV, which OpenQuake exports as hazard_curve-mean-PGA_1.csv",
        ));
    }
    if start.starts_with('{') || start.starts_with("[{") || start.starts_with("[[") {
        return Err(TableError::whole(
            "JSON, as a service of the USGS gives it; give its levels and annual rates as a table with the heading `PGA [g],rate`",
        ));
    }
    let rows = Rows::of(text, 1, true)?;
    match rows.clone().next().transpose()? {
        None => Err(TableError::whole("the curve has 0 points; give two at least")),
        Some(first) if first.cells.iter().any(|name| name.starts_with(POE)) => {
            let (curve, unit, source) = hazard_openquake::read(text, measure, asked)?;
            Ok(HazardText { curve, unit, assumed: false, source })
        }
        Some(first) => table(text, rows, &first, measure, asked),
    }
}

fn table<'a>(
    text: &'a str,
    mut rows: Rows<'a>,
    first: &Row<'a>,
    measure: Intensity,
    asked: Option<Units>,
) -> Result<HazardText, TableError> {
    let named = named(first);
    let numbers = named.iter().filter(|cell| is_number(cell)).count();
    let by_blanks = rows.separator() == BLANKS;
    if named.len() != 2 && (numbers > 0 || !by_blanks) {
        return Err(TableError::at(first.line, columns(text, &named, numbers)));
    }
    let above = || comments(text).take_while(|(line, _)| *line < first.line);
    let heading = match numbers {
        0 => heading(&named, by_blanks).map(|names| (first.line, names)),
        _ => above().filter_map(|(line, comment)| heading_of(line, comment)).last(),
    };
    let is_heading = |line: usize| heading.as_ref().is_some_and(|(own, _)| *own == line);
    for (line, comment) in above().filter(|(line, _)| !is_heading(*line)) {
        contradicts(line, comment, measure)?;
    }
    if numbers == 0 {
        rows.next();
    }
    let names = match numbers > 0 || by_blanks {
        true => ["level", "rate"].map(Cow::Borrowed).to_vec(),
        false => first.cells.clone(),
    };
    let sheet = Sheet::named(first.line, names, rows, |_| false)?;
    let said = heading
        .as_ref()
        .map(|(line, [level, rate])| hazard_heading::judged(*line, [level, rate], measure, asked));
    let said = said.transpose()?.unwrap_or(Heading { unit: None, rates: Rates::Annual });
    let asked = asked.map(|units| (units.key(), units.factor()));
    let (unit, scale) = asked.or(said.unit).unwrap_or((measure.unit(), 1.0));
    let places: Vec<usize> =
        (0..sheet.names.len()).filter(|at| !sheet.names[*at].is_empty()).collect();
    let mut points: Vec<(usize, [f64; 2])> = Vec::new();
    for row in sheet.rows() {
        let row = row?;
        let positive = |at: usize| {
            let cell = sheet.cell(&row, at);
            let number = cell.number()?.filter(|n| *n > 0.0 && n.is_finite());
            let problem = || {
                let text = shown(cell.text);
                format!("`{text}` is no number above zero; write one, or leave the line out")
            };
            number.ok_or_else(|| cell.refused(problem()))
        };
        let [level, rate] = [positive(places[0])?, positive(places[1])?];
        let rate = if said.rates == Rates::Periods { 1.0 / rate } else { rate };
        points.push((row.line, [scale * level, rate]));
    }
    let curve = HazardCurve::of(&points)?;
    let of = match said.rates {
        Rates::Annual => "annual rates",
        Rates::Periods => "return periods in years",
    };
    let source = match &heading {
        Some((_, [level, rate])) => format!("{of} `{}` of `{}`", shown(rate), shown(level)),
        None => format!("without a heading: levels of {measure} and annual rates are taken"),
    };
    let assumed = asked.or(said.unit).is_none() && measure.unit() != "1";
    Ok(HazardText { curve, unit, assumed, source })
}

/// Exceedances a year above which a rate is doubted: what shakes a site each month makes no hazard curve.
const PLAUSIBLE: f64 = 10.0;

impl HazardText {
    /// What a reader must be warned of; `units` is how the caller gives the unit of accelerations.
    pub fn doubts(&self, measure: Intensity, units: &str) -> Vec<String> {
        let mut doubts = Vec::new();
        if self.assumed {
            let unit = self.unit.replace('²', "2");
            let remedy = match measure.unit() == ACCELERATION {
                true => format!("give {units} g or m/s2"),
                false => format!("write it into the heading, as `{measure} [{unit}]`"),
            };
            doubts.push(format!("nothing tells the unit of its levels, {unit} is taken; {remedy}"));
        }
        let most = self.curve.most();
        if most > PLAUSIBLE {
            doubts.push(format!(
                "its rates begin with {most:.3} a year; are they annual rates, and not percent?"
            ));
        }
        doubts
    }
}

/// What is wrong with a first row that has not two cells.
fn columns(text: &str, named: &[&str], numbers: usize) -> String {
    let is_place = |name: &&str| {
        let name = name.to_lowercase();
        ["lon", "lat", "longitude", "latitude"].contains(&&*name)
    };
    if comments(text).any(|(_, comment)| comment.contains("OpenQuake")) {
        return "an export of OpenQuake that is no hazard curve (a map or a spectrum of a probability); give its \
                hazard_curve-mean-PGA_1.csv, with columns poe-0.05, ..."
            .into();
    }
    let count = named.len();
    if numbers > 1 && numbers < count {
        return "levels stand in its heading, with a site in each line, as in curves of NSHMP; write those of one site as lines of a \
                level and its annual rate below `PGA [g],rate`"
            .into();
    }
    if named.iter().any(is_place) {
        return "a grid of sites; leave the level and the annual rate of one site, below `PGA [g],rate`".into();
    }
    let names: Vec<String> = named.iter().take(6).map(|name| shown(name)).collect();
    format!(
        "it has {count} columns ({}); leave two, a level and its annual rate, or give the one site of OpenQuake",
        names.join(", ")
    )
}

/// The heading in a comment, as numpy writes it: two names, of which one at least is known.
fn heading_of(line: usize, comment: &str) -> Option<(usize, [String; 2])> {
    let rows = Rows::of(comment, line, true).ok()?;
    let by_blanks = rows.separator() == BLANKS;
    let row = rows.into_iter().next()?.ok()?;
    let heading = heading(&named(&row), by_blanks)?;
    let [level, rate] = &heading;
    hazard_heading::is_meant([level, rate]).then_some((line, heading))
}

/// Refuses a comment above the numbers that says that they are others than the study needs.
fn contradicts(line: usize, comment: &str, measure: Intensity) -> Result<(), TableError> {
    if hazard_heading::is_of_probabilities(comment) {
        let problem = "the comment says that these are no annual rates; give such rates, below a heading such as `PGA [g],rate`, or take the \
                       comment out";
        return Err(TableError::at(line, problem));
    }
    let is_another = |name: &str| hazard_heading::is_of_another(name, measure);
    let of_heading = || {
        let (_, [level, rate]) = heading_of(line, comment)?;
        Some(hazard_heading::is_of_rates(&rate) && is_another(&level))
    };
    if is_another(comment) || of_heading() == Some(true) {
        let problem = format!(
            "the comment says that these are no levels of {measure}; give the curve of {measure}, or take the comment out"
        );
        return Err(TableError::at(line, problem));
    }
    Ok(())
}

/// The cells of a row in which something stands.
fn named<'a>(row: &'a Row) -> Vec<&'a str> {
    row.cells.iter().map(|cell| &**cell).filter(|cell| !cell.is_empty()).collect()
}

/// The two names of a heading, by its cells, or by its words where blanks part them.
fn heading(named: &[&str], by_blanks: bool) -> Option<[String; 2]> {
    match named {
        _ if by_blanks => Some(parted(named)),
        [level, rate] => Some([level.to_string(), rate.to_string()]),
        _ => None,
    }
}

/// A heading whose words blanks part: the second name begins at the first word of a rate or of a period.
fn parted(words: &[&str]) -> [String; 2] {
    let halves = |at: usize| [words[..at].join(" "), words[at..].join(" ")];
    let at = (1..words.len()).find(|at| hazard_heading::is_of_rates(&halves(*at)[1]));
    halves(at.unwrap_or(1.min(words.len())))
}
