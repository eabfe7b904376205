//! K-NET and KiK-net ASCII: counts of a digitizer with their scale factor.

use super::lines::{Lines, free, number};
use super::{Raw, RecordError, Units};

/// Width of a header's name.
const NAME: usize = 18;
/// Lines of the header.
const HEADER: usize = 17;

/// True where the first line tells the origin time.
pub(crate) fn matches(text: &str) -> bool {
    text.lines().next().is_some_and(|line| line.starts_with("Origin Time"))
}

pub(crate) fn read(text: &str) -> Result<Raw, RecordError> {
    let mut lines = Lines::of(text);
    let (mut station, mut direction, mut rate, mut scale) =
        (String::new(), String::new(), None, None);
    for _ in 0..HEADER {
        let at = lines.number();
        let line = lines.next("header of 17 lines")?;
        let value = line.get(NAME..).unwrap_or_default().trim();
        if line.starts_with("Station Code") {
            station = value.into();
        } else if line.starts_with("Dir.") {
            direction = value.into();
        } else if line.starts_with("Sampling Freq") {
            rate = number(value.trim_end_matches("Hz"));
        } else if line.starts_with("Scale Factor") {
            // 3920(gal)/6182761
            let parts = value.split_once("(gal)/");
            let factor = parts.and_then(|(a, b)| Some(number(a)? / number(b)?));
            let bad =
                || RecordError::line(at, "a scale factor such as 3920(gal)/6182761 belongs here");
            scale = Some(factor.filter(|f| f.is_finite() && *f > 0.0).ok_or_else(bad)?);
        }
    }
    let missing = |what: &str| RecordError::whole(format!("the header has no {what}"));
    let scale = scale.ok_or_else(|| missing("Scale Factor"))?;
    let rate = rate.filter(|r| *r > 0.0).ok_or_else(|| missing("Sampling Freq(Hz)"))?;
    let mut values = lines.numbers(None, free)?;
    // Counts stand on the digitizer's offset; the header's maximum is taken after its removal.
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    for value in &mut values {
        *value = (*value - mean) * scale;
    }
    Ok(Raw {
        title: format!("K-NET {station} {direction}"),
        dt: Some(1.0 / rate),
        units: Some(Units::CentimetresPerSecondSquared),
        values,
        notes: vec!["the mean of the counts is removed".into()],
    })
}
