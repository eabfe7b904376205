//! SAC, binary, of either byte order: a header of 158 words, and samples of four bytes. Words and their meaning are those of
//! IRIS' SAC manual, "SAC Data File Format".

use super::component::Component;
use super::lines::MOST_SAMPLES;
use super::shown::decimal;
use super::stated::{seconds, tidy};
use super::{Raw, RecordError, Stated, Step};

/// Bytes of the header, and of the doubles that version 7 has after the samples.
const HEADER: usize = 632;
const FOOTER: usize = 176;
/// What stands where nothing is known.
const UNDEFINED: i32 = -12345;

/// Words of the header, from 0.
const DELTA: usize = 0;
const BEGIN: usize = 5;
const AZIMUTH: usize = 57;
const INCIDENCE: usize = 58;
const YEAR: usize = 70;
const VERSION: usize = 76;
const COUNT: usize = 79;
const FILE_TYPE: usize = 85;
const DEPENDENT: usize = 86;
const EVEN: usize = 105;

/// A time series, among the types of files; displacements, velocities and volts among dependent variables.
const TIME_SERIES: i32 = 1;
const NO_ACCELERATION: [(i32, &str); 3] = [(6, "displacements"), (7, "velocities"), (50, "volts")];

/// The header of a file, and the order of its bytes.
struct Header<'a> {
    bytes: &'a [u8],
    little: bool,
}

impl Header<'_> {
    fn of(bytes: &[u8]) -> Option<Header<'_>> {
        let versions = 6..=7;
        [true, false].into_iter().find_map(|little| {
            let header = Header { bytes: bytes.get(..HEADER)?, little };
            // Undefined words are there in every file.
            let known = (0..110).any(|word| header.real(word) == Some(UNDEFINED as f32));
            let count = header.whole(COUNT)?;
            (versions.contains(&header.whole(VERSION)?) && count > 0 && known).then_some(header)
        })
    }

    fn word(&self, word: usize) -> Option<[u8; 4]> {
        let mut bytes = <[u8; 4]>::try_from(self.bytes.get(4 * word..4 * word + 4)?).ok()?;
        if !self.little {
            bytes.reverse();
        }
        Some(bytes)
    }

    fn whole(&self, word: usize) -> Option<i32> {
        self.word(word).map(i32::from_le_bytes)
    }

    fn real(&self, word: usize) -> Option<f32> {
        self.word(word).map(f32::from_le_bytes)
    }

    /// A number that is known.
    fn known(&self, word: usize) -> Option<f32> {
        self.real(word).filter(|value| value.is_finite() && *value != UNDEFINED as f32)
    }

    /// A text that is known, from a byte on.
    fn text(&self, from: usize, length: usize) -> String {
        let bytes = self.bytes.get(from..from + length).unwrap_or_default();
        let text: String =
            bytes.iter().take_while(|byte| **byte != 0).map(|byte| char::from(*byte)).collect();
        let text = tidy(&text);
        if text == UNDEFINED.to_string() { String::new() } else { text }
    }
}

/// True of bytes that begin as a file of SAC.
pub(super) fn matches(bytes: &[u8]) -> bool {
    Header::of(bytes).is_some()
}

pub(super) fn read(bytes: &[u8]) -> Result<Raw, RecordError> {
    let refused = |problem: String| Err(RecordError::whole(problem));
    let Some(header) = Header::of(bytes) else { return refused("no header of SAC".into()) };
    if header.whole(FILE_TYPE) != Some(TIME_SERIES) || header.whole(EVEN) == Some(0) {
        return refused("a file of SAC that is no evenly sampled time series; write one".into());
    }
    let dependent = header.whole(DEPENDENT);
    if let Some((_, what)) = NO_ACCELERATION.iter().find(|(code, _)| Some(*code) == dependent) {
        return refused(format!("{what} by the header of SAC (IDEP); give the acceleration file"));
    }
    let count = header.whole(COUNT).and_then(|count| usize::try_from(count).ok()).unwrap_or(0);
    if count > MOST_SAMPLES {
        return refused(format!("{count} samples are more than {MOST_SAMPLES}"));
    }
    let body = bytes.get(HEADER..).unwrap_or_default();
    let (words, _) = body.as_chunks::<4>();
    if words.len() < count {
        return refused(format!("the file ends after {} of its {count} samples", words.len()));
    }
    let sample = |word: &[u8; 4]| match header.little {
        true => f32::from_le_bytes(*word),
        false => f32::from_be_bytes(*word),
    };
    // A number of 32 bits is one of 64 bits without loss.
    let values: Vec<f64> = words.iter().take(count).map(|word| f64::from(sample(word))).collect();
    if let Some(wrong) = values.iter().position(|value| !value.is_finite()) {
        return refused(format!("sample {} is not a finite number; fill the gap in", wrong + 1));
    }
    let over = body.len() - 4 * count;
    let is_footer = header.whole(VERSION) == Some(7) && over == FOOTER;
    let notes = (over > 0 && !is_footer).then(|| {
        format!("{over} bytes after the {count} samples that its header states are left out")
    });
    let code = header.text(600, 8);
    let component = match header.known(INCIDENCE) {
        Some(0.0) => Some(Component::Up),
        Some(180.0) => Some(Component::Down),
        Some(90.0) => Some(Component::Horizontal),
        _ => Component::of_channel(&code).or_else(|| Component::named(&code)),
    };
    let way = match (&*code, header.known(AZIMUTH)) {
        ("", Some(azimuth)) => azimuth.to_string(),
        (code, _) => code.to_string(),
    };
    let [network, station, hole] = [header.text(608, 8), header.text(440, 8), header.text(464, 8)];
    let place: Vec<String> =
        [network, station, hole].into_iter().filter(|part| !part.is_empty()).collect();
    let station = place.join(".");
    Ok(Raw {
        title: tidy(&format!("SAC {station} {way}")),
        stated: Stated {
            event: header.text(448, 16),
            station,
            component,
            azimuth: header
                .known(AZIMUTH)
                .filter(|_| component == Some(Component::Horizontal))
                .map(|degrees| f64::from(degrees).rem_euclid(360.0)),
            start: start(&header),
            ..Stated::default()
        },
        step: header
            .known(DELTA)
            .filter(|delta| *delta > 0.0)
            .map(|delta| Step::exact(decimal(delta))),
        units: None,
        values,
        notes: notes.into_iter().collect(),
    })
}

/// When the first sample was taken: the header's reference time, whose day is one of the year, and the begin after it.
fn start(header: &Header<'_>) -> Option<f64> {
    let mut parts = [0; 6];
    for (part, word) in parts.iter_mut().zip(YEAR..) {
        *part = header.whole(word).filter(|part| *part >= 0)?;
    }
    let [year, day, hour, minute, second, thousandth] = parts;
    let first = seconds(&format!("{year}/1/1 {hour}:{minute}:{second}"))?;
    let begin = header.known(BEGIN).map_or(0.0, decimal);
    let day = f64::from(day.clamp(1, 366) - 1);
    Some(first + 86400.0 * day + f64::from(thousandth) * 1.0e-3 + begin)
}
