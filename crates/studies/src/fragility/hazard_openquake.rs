//! The hazard curve of a site as OpenQuake exports it.

use super::hazard::HazardCurve;
use super::hazard_heading;
use crate::sheet::{Rows, Sheet, TableError, comments};
use crate::suites::intensity::Intensity;
use topple::Written;
use topple::scene::GRAVITY;
use topple::scene::record::Units;
use topple::scene::shown::shown;

/// How the columns of probabilities begin; the level follows.
pub(super) const POE: &str = "poe-";

/// True of a kind that is a curve: of the mean, the largest or a quantile over the branches of the logic tree, or of one branch.
fn is_curve(kind: &str) -> bool {
    ["mean", "max"].contains(&kind) || ["quantile-", "rlz-"].iter().any(|own| kind.starts_with(own))
}

/// The curve of a site, of which the units are known: g of accelerations, cm/s of PGV, m/s of the Arias intensity and g s of CAV
/// (openquake.hazardlib.imt). A probability of 1 tells no rate, one of 0 no logarithm: their levels are left out. With the curve come the
/// unit of its levels and, in words, what it is of.
pub(super) fn read(
    text: &str,
    measure: Intensity,
    asked: Option<Units>,
) -> Result<(HazardCurve, &'static str, String), TableError> {
    let comment: String = comments(text).map(|(_, comment)| comment).collect();
    let no = |what: &str| {
        TableError::whole(format!(
            "no `{what}` above the columns; give the file as OpenQuake exports it"
        ))
    };
    let years = told(&comment, "investigation_time").and_then(|text| text.parse().ok());
    let years = years.filter(|years: &f64| *years > 0.0 && years.is_finite());
    let years = years.ok_or_else(|| no("investigation_time"))?;
    let kind = told(&comment, "kind");
    if let Some(kind) = kind.filter(|kind| !is_curve(kind)) {
        return Err(TableError::whole(format!(
            "`kind='{}'` is no hazard curve (a standard deviation over branches is none); give that of kind mean or quantile",
            shown(kind)
        )));
    }
    let of = told(&comment, "imt").ok_or_else(|| no("imt"))?;
    let (_, unit, scale) = unit_of_openquake(measure).ok_or_else(|| {
        TableError::whole(format!(
            "OpenQuake has no curves of {measure}; give a table of levels and rates"
        ))
    })?;
    let is_measure = hazard_heading::levels(of, measure, None).is_ok_and(|unit| unit.is_none());
    if !is_measure {
        let found = shown(of);
        return Err(TableError::whole(format!(
            "the curve is of {found}, not of {measure}; give that of the measure"
        )));
    }
    if let Some(asked) = asked.filter(|asked| *asked != Units::G) {
        let problem =
            format!("its levels are in {unit}, not in {}; leave the units out", asked.key());
        return Err(TableError::whole(problem));
    }
    let empty = || TableError::whole("it has 0 sites; leave the line of one site below the header");
    let sheet = Sheet::of(Rows::of(text, 1, false)?, |_| false)?.ok_or_else(empty)?;
    let mut rows = sheet.rows();
    let site = rows.next().ok_or_else(empty)??;
    if let Some(next) = rows.next() {
        let count = 2 + rows.count();
        let problem = format!("it has {count} sites; leave the line of one site below the header");
        return Err(TableError::at(next?.line, problem));
    }
    let (mut points, mut place) = (Vec::new(), [None, None]);
    for (at, name) in sheet.names.iter().enumerate() {
        let cell = sheet.cell(&site, at);
        if let Some(own) = ["lon", "lat"].iter().position(|own| name == own) {
            place[own] = cell.number()?;
        }
        let Some(level) = name.strip_prefix(POE) else { continue };
        let no = || {
            cell.refused(
                "no level or no probability; give levels from 0 on, and probabilities from 0 to 1",
            )
        };
        let is_known = |number: &f64| *number >= 0.0 && number.is_finite();
        let level = level.parse().ok().filter(is_known).ok_or_else(no)?;
        let poe = cell.number()?.filter(is_known).filter(|poe| *poe <= 1.0).ok_or_else(no)?;
        if level > 0.0 && poe > 0.0 && poe < 1.0 {
            points.push((site.line, [scale * level, -(-poe).ln_1p() / years]));
        }
    }
    let kind = kind.map_or_else(|| "curve of no stated kind".into(), shown);
    let place = match place {
        [Some(lon), Some(lat)] => format!(", site lon {lon}, lat {lat}"),
        _ => ", of a site that it does not name".into(),
    };
    let source = format!("OpenQuake, {kind}, {}, probabilities in {years} years{place}", shown(of));
    Ok((HazardCurve::of(&points)?, unit, source))
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

/// The value of a name in a comment such as `investigation_time=50.0, imt='PGA'`.
fn told<'a>(comment: &'a str, name: &str) -> Option<&'a str> {
    let key = format!("{name}=");
    let is_word = |at: usize| !comment[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_');
    let at = comment.match_indices(&key).map(|(at, _)| at).find(|at| is_word(*at))?;
    let rest = &comment[at + key.len()..];
    let rest = rest.trim_start_matches('"');
    let end = match rest.strip_prefix('\'') {
        Some(quoted) => return quoted.split('\'').next(),
        None => rest.find([',', '"', ' ']).unwrap_or(rest.len()),
    };
    Some(&rest[..end])
}
