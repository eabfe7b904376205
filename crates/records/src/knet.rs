//! K-NET and KiK-net ASCII: counts of a digitizer with their scale factor.

use super::component::{self, Component};
use super::hints::RecordHints;
use super::lines::Lines;
use super::numbers::{free, number};
use super::stated::seconds;
use super::{Raw, RecordError, Stated, Step};

/// Width of a header's name.
const NAME: usize = 18;
/// Lines of the header.
const HEADER: usize = 17;

/// True where the first line tells the origin time.
pub(crate) fn matches(text: &str) -> bool {
    text.lines().next().is_some_and(|line| line.starts_with("Origin Time"))
}

/// The direction by a header's word, and the depth: KiK-net numbers those of its borehole by 1 to 3 and those of the
/// surface by 4 to 6, each N-S, E-W, U-D.
fn direction(word: &str) -> (&str, &'static str) {
    let depth = match word {
        "1" | "2" | "3" => " borehole",
        "4" | "5" | "6" => " surface",
        _ => "",
    };
    let way = match word {
        "1" | "4" => "N-S",
        "2" | "5" => "E-W",
        "3" | "6" => "U-D",
        word => word.trim_end_matches(['1', '2']),
    };
    (way, depth)
}

/// Part by which a peak may differ from the header's, which has few digits.
const PEAK: f64 = 0.01;

/// True of a line of samples.
fn are_samples(line: &str) -> bool {
    let fields = free(line);
    fields.len() > 1 && fields.iter().all(|field| number(field).is_some())
}

pub(crate) fn read(text: &str, _: &RecordHints) -> Result<Raw, RecordError> {
    let mut lines = Lines::of(text);
    let (mut origin, mut station, mut way, mut start) = ("", "", "", None);
    let (mut rate, mut duration, mut scale, mut peak) = (None, None, None, None);
    for _ in 0..HEADER {
        let at = lines.number();
        // A header that lacks a line ends at the samples.
        if scale.is_some() && lines.peek().is_some_and(are_samples) {
            break;
        }
        let line = lines.next("header of 17 lines")?;
        let value = line.get(NAME..).unwrap_or_default().trim();
        if line.starts_with("Origin Time") {
            origin = value;
        } else if line.starts_with("Station Code") {
            station = value;
        } else if line.starts_with("Record Time") {
            start = seconds(value);
        } else if line.starts_with("Duration Time") {
            duration = number(value);
        } else if line.starts_with("Dir.") {
            way = value;
        } else if line.starts_with("Sampling Freq") {
            rate = number(value.trim_end_matches("Hz"));
        } else if line.starts_with("Max. Acc.") {
            peak = number(value);
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
    let mut notes = vec!["the mean of the counts is removed".to_string()];
    let wanted = duration.map_or(0.0, |duration| (duration * rate).round());
    if wanted > 0.0 && wanted != values.len() as f64 {
        let few = if (values.len() as f64) < wanted { "; it may be cut off" } else { "" };
        notes.push(format!("{} samples where its header has {wanted}{few}", values.len()));
    }
    // Counts stand on the digitizer's offset; the header's maximum is taken after its removal.
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    for value in &mut values {
        *value = (*value - mean) * scale;
    }
    let found = values.iter().fold(0.0, |peak: f64, value| peak.max(value.abs()));
    if let Some(stated) = peak
        && stated > 0.0
        && (stated - found).abs() > PEAK * found
    {
        notes.push(format!("a peak of {found:.3} gal where its header has {stated}"));
    }
    let (way, depth) = direction(way);
    Ok(Raw {
        title: format!("K-NET {station} {way}"),
        stated: Stated {
            event: origin.into(),
            station: format!("{station}{depth}"),
            component: Component::named(way),
            azimuth: component::azimuth(way),
            start,
            ..Stated::default()
        },
        step: Some(Step::exact(1.0 / rate)),
        units: Some((0, "gal".into())),
        values,
        notes,
    })
}
