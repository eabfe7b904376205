//! Hazard curves as texts: a table of levels and rates, and the curve of a site as OpenQuake exports it.

use super::hazard::HazardCurve;
use super::hazard_error::HazardError;
use super::hazard_heading::{self, Rates};
use crate::suites::delimited;
use crate::suites::intensity::Intensity;
use topple::Written;
use topple::scene::GRAVITY;
use topple::scene::record::Units;
use topple::scene::shown::shown;

/// A hazard curve with what its text says of its levels.
#[derive(Debug, Clone, PartialEq)]
pub struct HazardText {
    /// The curve, its levels in SI units.
    pub curve: HazardCurve,
    /// The unit that its levels were read in.
    pub unit: &'static str,
    /// True where neither the text nor the caller says the unit of accelerations: m/s^2 was taken.
    pub assumed: bool,
}

/// Reads a curve of a measure; `asked` is the unit of its accelerations, where the caller says one.
///
/// A table has a level and its annual rate of exceedance in each line, with a comma, a semicolon or a tab between; a first
/// line that is no point is a header, whose words may tell the unit: `PGA [g],rate`. A curve of OpenQuake has the
/// probabilities of one site in a line: `lon,lat,depth,poe-0.05,poe-0.1`, below a comment with the time they are of.
pub fn read(
    text: &str,
    measure: Intensity,
    asked: Option<Units>,
) -> Result<HazardText, HazardError> {
    if asked.is_some() && measure.unit() != ACCELERATION {
        return Err(HazardError::NoAcceleration { measure: measure.to_string() });
    }
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    // A line may end as on any system.
    let text = text.replace("\r\n", "\n").replace('\r', "\n");
    let lines = (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty());
    let lines: Vec<(usize, &str)> = lines.collect();
    match lines.iter().find(|(_, line)| !line.starts_with('#')) {
        Some((_, header)) if header.contains(POE) => openquake(&lines, measure, asked),
        _ => table(&lines, measure, asked),
    }
}

/// The unit of the measures that may be given in g.
const ACCELERATION: &str = "m/s²";
/// How OpenQuake's columns of probabilities begin; the level follows.
const POE: &str = "poe-";

/// The name of a unit of accelerations, and what it is in m/s^2.
fn factor(units: Units) -> (&'static str, f64) {
    (units.key(), units.factor())
}

fn table(
    lines: &[(usize, &str)],
    measure: Intensity,
    asked: Option<Units>,
) -> Result<HazardText, HazardError> {
    let mut lines = lines.iter().filter(|(_, line)| !line.starts_with('#')).peekable();
    let number = |text: &str| delimited::number(text);
    let header = lines.next_if(|(_, line)| columns(line).into_iter().all(|c| number(c).is_none()));
    let said = header.and_then(|(_, line)| unit_of(columns(line)[0]));
    let rates = match header {
        Some((_, line)) => hazard_heading::judged(&columns(line), measure)?,
        None => Rates::Annual,
    };
    if let (Some(said), Some(asked)) = (said, asked)
        && said != asked
    {
        return Err(HazardError::Contradicts { said: said.key(), asked: asked.key() });
    }
    let acceleration = measure.unit() == ACCELERATION;
    let units = asked.or(said.filter(|_| acceleration));
    let (unit, scale) = units.map_or((measure.unit(), 1.0), factor);
    let mut points: Vec<(usize, [f64; 2])> = Vec::new();
    for (line, row) in lines {
        let (line, row) = (*line, columns(row));
        let [level, rate] = row[..] else {
            return Err(HazardError::Columns { line, columns: row.len() });
        };
        let positive = |name: &'static str, text: &str| {
            let number = number(text).filter(|n| *n > 0.0 && n.is_finite());
            number.ok_or_else(|| HazardError::Number { line, name, text: shown(text) })
        };
        let level = scale * positive("level", level)?;
        let rate = match rates {
            Rates::Annual => positive("rate", rate)?,
            Rates::Periods => 1.0 / positive("return period", rate)?,
        };
        points.push((line, [level, rate]));
    }
    let curve = HazardCurve::of(&points)?;
    Ok(HazardText { curve, unit, assumed: acceleration && units.is_none() })
}

/// The curve of a site in OpenQuake's export, of which the units are known: g of accelerations, cm/s of PGV, m/s of the
/// Arias intensity and g s of CAV (openquake.hazardlib.imt). A probability of 1 tells no rate, one of 0 no logarithm: their
/// levels are left out.
fn openquake(
    lines: &[(usize, &str)],
    measure: Intensity,
    asked: Option<Units>,
) -> Result<HazardText, HazardError> {
    if let Some(asked) = asked.filter(|asked| *asked != Units::G) {
        return Err(HazardError::Contradicts { said: Units::G.key(), asked: asked.key() });
    }
    let comment: String =
        lines.iter().filter(|(_, line)| line.starts_with('#')).map(|(_, line)| *line).collect();
    let years = told(&comment, "investigation_time")
        .and_then(|text| text.parse().ok())
        .filter(|years: &f64| *years > 0.0 && years.is_finite())
        .ok_or(HazardError::NoTime)?;
    let of = told(&comment, "imt").ok_or(HazardError::NoMeasure)?;
    let (name, unit, scale) = unit_of_openquake(measure)
        .ok_or_else(|| HazardError::NotOfOpenQuake { measure: measure.to_string() })?;
    if !is_same_measure(of, &name) {
        return Err(HazardError::Measure { found: shown(of), wanted: measure.to_string() });
    }
    let mut rows = lines.iter().filter(|(_, line)| !line.starts_with('#'));
    let header = rows.next().map_or(Vec::new(), |(_, line)| columns(line));
    let (line, site) = rows.next().ok_or(HazardError::Sites { count: 0 })?;
    if rows.next().is_some() {
        return Err(HazardError::Sites { count: 2 + rows.count() });
    }
    let site = columns(site);
    if site.len() != header.len() {
        return Err(HazardError::Columns { line: *line, columns: site.len() });
    }
    let mut points = Vec::new();
    for (name, text) in header.iter().zip(site) {
        let Some(level) = name.strip_prefix(POE) else { continue };
        let number = |name, text: &str| {
            let number = text.parse().ok().filter(|n: &f64| *n >= 0.0 && n.is_finite());
            number.ok_or_else(|| HazardError::Number { line: *line, name, text: shown(text) })
        };
        let (level, poe) = (number("level", level)?, number("probability", text)?);
        if level > 0.0 && poe > 0.0 && poe < 1.0 {
            points.push((*line, [scale * level, -(-poe).ln_1p() / years]));
        }
    }
    Ok(HazardText { curve: HazardCurve::of(&points)?, unit, assumed: false })
}

/// What OpenQuake calls a measure, the unit in which it has its levels, and what that is in SI units; none of a measure
/// that it has not.
pub fn unit_of_openquake(measure: Intensity) -> Option<(String, &'static str, f64)> {
    match measure {
        Intensity::Pga => Some(("PGA".into(), "g", GRAVITY)),
        Intensity::Sa(period) => Some((format!("SA({period})"), "g", GRAVITY)),
        Intensity::Pgv => Some(("PGV".into(), "cm/s", 0.01)),
        Intensity::Arias => Some(("IA".into(), "m/s", 1.0)),
        Intensity::Cav => Some(("CAV".into(), "g s", GRAVITY)),
        Intensity::AverageSa(_) | Intensity::RelativePga | Intensity::RelativePgv => None,
    }
}

/// True of two names of a measure that differ in the digits of a period alone.
fn is_same_measure(one: &str, other: &str) -> bool {
    let period = |name: &str| {
        let inside = name.strip_prefix("SA(")?.strip_suffix(')')?;
        inside.parse::<f64>().ok()
    };
    one == other || period(one).is_some_and(|of| period(other) == Some(of))
}

/// The value of a name in a comment such as `investigation_time=50.0, imt='PGA'`.
fn told<'a>(comment: &'a str, name: &str) -> Option<&'a str> {
    let (_, rest) = comment.split_once(&format!("{name}="))?;
    let rest = rest.trim_start_matches('"');
    let end = match rest.strip_prefix('\'') {
        Some(quoted) => return quoted.split('\'').next(),
        None => rest.find([',', '"', ' ']).unwrap_or(rest.len()),
    };
    Some(&rest[..end])
}

/// The parts of a line; beside semicolons or tabs commas are decimal ones.
fn columns(line: &str) -> Vec<&str> {
    let separator = [';', '\t'].into_iter().find(|one| line.contains(*one)).unwrap_or(',');
    line.split(separator).map(|part| part.trim().trim_matches('"').trim()).collect()
}

/// The unit of accelerations that a header's words tell, in brackets or after an underscore: `PGA [g]`, `sa (m/s2)`, `pga_g`.
fn unit_of(header: &str) -> Option<Units> {
    let after = header.rsplit(['[', '(', '_', ' ']).next()?;
    Units::named(after.trim_end_matches([']', ')']))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fragility::Lognormal;

    fn error(text: &str) -> String {
        read(text, Intensity::Pga, None).unwrap_err().to_string()
    }

    /// The levels of a curve's ends.
    fn ends(
        text: &str,
        measure: Intensity,
        asked: Option<Units>,
    ) -> ([f64; 2], &'static str, bool) {
        let read = read(text, measure, asked).unwrap();
        (read.curve.ends(), read.unit, read.assumed)
    }

    fn near(found: [f64; 2], wanted: [f64; 2]) -> bool {
        found.iter().zip(wanted).all(|(found, wanted)| (found / wanted - 1.0).abs() < 1.0e-12)
    }

    #[test]
    fn a_bad_table_is_refused_by_its_line() {
        let head = "level,rate\n0.1,0.01\n";
        assert!(error(&format!("{head}0.2\n")).starts_with("line 3: it has 1 columns"));
        assert!(error(&format!("{head}\n0.2,a\n")).starts_with("line 4: rate `a` is no number"));
        assert!(error(&format!("{head}-1,0.001\n")).starts_with("line 3: level `-1`"));
        assert!(error(&format!("{head}0.2,0\n")).starts_with("line 3: rate `0`"));
        assert!(error(&format!("{head}0.2,inf\n")).starts_with("line 3: rate `inf`"));
        assert!(error(&format!("{head}0.1,0.001\n")).starts_with("line 3: the level"));
        assert!(error(&format!("{head}0.2,0.02\n")).starts_with("line 3: the rate"));
        assert!(error("1,x\n2,0.1\n").starts_with("line 1: rate `x`"));
        assert_eq!(error(head), "the curve has 1 points; give two at least");
        assert_eq!(error(""), "the curve has 0 points; give two at least");
    }

    #[test]
    fn a_header_has_any_name_and_may_tell_the_unit() {
        let rows = "0.1,0.01\n0.2,0.001\n";
        for (header, unit, scale, assumed) in [
            ("level,rate\n", "m/s²", 1.0, true),
            ("", "m/s²", 1.0, true),
            ("PGA (g);annual rate of exceedance\n", "g", GRAVITY, false),
            ("acc [m/s2],lambda\n", "m/s2", 1.0, false),
            ("pga_g,afe\n", "g", GRAVITY, false),
            ("\u{feff}# of a site\nim,mafe\n", "m/s²", 1.0, true),
        ] {
            let (levels, of, taken) = ends(&format!("{header}{rows}"), Intensity::Pga, None);
            assert!(near(levels, [0.1 * scale, 0.2 * scale]), "{header}: {levels:?}");
            assert_eq!((of, taken), (unit, assumed), "{header}");
        }
        let rows = format!("level,rate\n{rows}");
        let (levels, unit, assumed) = ends(&rows, Intensity::Sa(1.0), Some(Units::G));
        assert!(near(levels, [0.1 * GRAVITY, 0.2 * GRAVITY]) && unit == "g" && !assumed);
        // A velocity has one unit, and none is assumed.
        assert_eq!(
            ends(&rows, Intensity::Pgv, None),
            ([0.1_f64.ln().exp(), 0.2_f64.ln().exp()], "m/s", false)
        );
        let refused =
            |text: &str, measure, asked| read(text, measure, asked).unwrap_err().to_string();
        let problem = refused(&rows, Intensity::Pgv, Some(Units::G));
        assert_eq!(problem, "pgv is no acceleration; leave the units out");
        let said = "pga [g],rate\n0.1,0.01\n0.2,0.001\n";
        let problem = refused(said, Intensity::Pga, Some(Units::MetresPerSecondSquared));
        assert_eq!(problem, "its levels are in g, not in m/s2; leave the units out");
    }

    /// As version 3.15 exports it, with the probabilities of 50 years; those of 1 and 0 tell nothing.
    const SITE: &str = "#,,,,,\"generated_by='OpenQuake engine 3.15.0', start_date='2022-04-20', checksum=1, kind='mean', \
        investigation_time=50.0, imt='SA(0.5)'\"\n\
        lon,lat,depth,poe-0.0050000,poe-0.1000000,poe-0.4000000,poe-0.6000000,poe-2.0000000\n\
        0.00000,0.00000,-0.10000,1.000000E+00,6.081918E-01,3.287217E-01,1.994702E-01,0.000000E+00\n";

    #[test]
    fn a_curve_of_openquake_has_rates_in_g() {
        let (levels, unit, assumed) = ends(SITE, Intensity::Sa(0.5), None);
        assert!(near(levels, [0.1 * GRAVITY, 0.6 * GRAVITY]) && unit == "g" && !assumed);
        // A step below the first level takes the difference of the ends' rates, -ln(1 - p)/50.
        let curve = read(SITE, Intensity::Sa(0.5), Some(Units::G)).unwrap().curve;
        let rate = curve.rate(Lognormal { theta: 1.0e-3, beta: 0.0 }).rate;
        let wanted = ((1.0 - 0.1994702_f64) / (1.0 - 0.6081918)).ln() / 50.0;
        assert!((rate / wanted - 1.0).abs() < 1.0e-9, "{rate} {wanted}");
        // Older versions quote the measure otherwise.
        let older = "# source_model_tree_path=('b1',), investigation_time=1.0,imt=\"PGA\"\n\
            lon,lat,depth,poe-0.1,poe-0.4\n0.0,0.0,-0.1,4.5E-01,5.6E-02\n";
        assert!(near(ends(older, Intensity::Pga, None).0, [0.1 * GRAVITY, 0.4 * GRAVITY]));
        let of = |text: &str, measure, asked| read(text, measure, asked).unwrap_err().to_string();
        assert!(of(SITE, Intensity::Pga, None).starts_with("the curve is of SA(0.5), not of pga"));
        let other = of(SITE, Intensity::Sa(0.5), Some(Units::MetresPerSecondSquared));
        assert!(other.starts_with("its levels are in g, not in m/s2"), "{other}");
        assert!(of(SITE, Intensity::AverageSa(0.5), None).contains("has no curves of avg-sa:0.5"));
        let row = SITE.lines().last().unwrap();
        let two = of(&format!("{SITE}{row}\n{row}\n"), Intensity::Sa(0.5), None);
        assert!(two.starts_with("it has 3 sites"), "{two}");
        let bare: String = SITE.lines().skip(1).map(|line| format!("{line}\n")).collect();
        assert!(of(&bare, Intensity::Sa(0.5), None).contains("investigation_time"));
    }

    #[test]
    fn a_heading_that_says_another_thing_is_refused_and_periods_are_converted() {
        let rows = "0.1,0.01\n0.2,0.001\n";
        for (heading, wanted) in [
            ("pga,probability of exceedance in 50 years", "these are probabilities"),
            ("pga,poe", "these are probabilities"),
            ("annual rate,pga", "the levels come first"),
            ("lambda,PGA (g)", "the levels come first"),
            ("sa(1.0),rate", "these are levels of sa, not of pga"),
            ("PGV (cm/s),rate", "these are levels of pgv, not of pga"),
            ("pga (mg),rate", "levels in mg are not read"),
            ("pga [%g],rate", "levels in %g are not read"),
        ] {
            let said = error(&format!("{heading}\n{rows}"));
            assert!(
                said.starts_with("the heading `") && said.contains(wanted),
                "{heading}: {said}"
            );
        }
        let periods =
            read("pga (g);Return period [years]\r0,1;475\r0,2;2475\r", Intensity::Pga, None)
                .unwrap();
        let rates = read(
            "pga (g),rate\n0.1,0.00210526315789\n0.2,0.00040404040404\n",
            Intensity::Pga,
            None,
        );
        let step = Lognormal { theta: 1.3, beta: 0.3 };
        let [one, other] = [periods, rates.unwrap()].map(|text| text.curve.rate(step).rate);
        assert!((one / other - 1.0).abs() < 1.0e-9, "{one} {other}");
        let velocities =
            read("PGV (cm/s),rate\n10,0.01\n20,0.001\n", Intensity::Pgv, None).unwrap_err();
        assert!(velocities.to_string().contains("give m/s"), "{velocities}");
    }
}
