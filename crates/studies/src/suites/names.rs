//! What the name of a file says of it: which files belong together, and which component each is.

/// A component, as a file's name tells it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Component {
    /// Horizontal.
    Horizontal,
    /// Vertical.
    Vertical,
}

/// What a name says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Named {
    /// What the files of one station and event have in common.
    pub group: String,
    /// Which component it is.
    pub component: Component,
}

/// Endings of PEER's verticals; longer ones first.
const VERTICAL: [&str; 14] =
    ["-VER", "--V", "-UP", "-UD", "-V1", "DWN", "VER", "-DN", "-V", "-Z", "UP", "UD", "V1", "DN"];
/// Endings of its horizontals that are no azimuth.
const HORIZONTAL: [&str; 22] = [
    "--L", "--T", "--N", "--E", "--1", "--2", "-L1", "-T1", "-H1", "-H2", "-NS", "-EW", "-N", "-E",
    "-S", "-W", "-L", "-T", "L1", "T1", "NS", "EW",
];
/// Those that a letter tells where the record has a number: `RSN8166_DUZCE_PRPCS`.
const LETTERS: [&str; 4] = ["N", "S", "E", "W"];

/// What a file's name says; none where it follows no pattern that is known.
pub fn read(name: &str) -> Option<Named> {
    let (folder, file) = name.rsplit_once('/').unwrap_or(("", name));
    let named =
        |group: String, component| Some(Named { group: format!("{folder}/{group}"), component });
    let (stem, ending) = file.rsplit_once('.')?;
    // K-NET and KiK-net: AOM0011801241951.EW, .NS, .UD; with 1 (borehole) or 2 (surface) at the end.
    let upper = ending.to_uppercase();
    let (direction, place) = match upper.strip_suffix(['1', '2']) {
        Some(direction) => (direction, &upper[direction.len()..]),
        None => (upper.as_str(), ""),
    };
    match direction {
        "EW" | "NS" => return named(format!("{stem}{place}"), Component::Horizontal),
        "UD" => return named(format!("{stem}{place}"), Component::Vertical),
        _ => {}
    }
    if let Some((group, component)) = channel(file) {
        return named(group, component);
    }
    if upper == "AT2" {
        peer(stem).and_then(|(group, component)| named(group, component))
    } else {
        None
    }
}

/// ESM: HI.ARS1..HNE.D.20190728.160908.C.ACC.ASC: network, station, location, channel.
fn channel(file: &str) -> Option<(String, Component)> {
    let mut parts: Vec<&str> = file.split('.').collect();
    let channel = *parts.get(3)?;
    let bytes = channel.as_bytes();
    let is_channel = bytes.len() == 3 && bytes.iter().all(u8::is_ascii_alphanumeric);
    if parts.len() < 5
        || !is_channel
        || !matches!(bytes[1].to_ascii_uppercase(), b'N' | b'H' | b'L')
    {
        return None;
    }
    let component = match bytes[2].to_ascii_uppercase() {
        b'E' | b'N' | b'1' | b'2' | b'X' | b'Y' => Component::Horizontal,
        b'Z' | b'3' => Component::Vertical,
        _ => return None,
    };
    parts[3] = &channel[..2];
    Some((parts.join("."), component))
}

/// PEER: RSN125_FRIULI.A_A-TMZ000: what comes last is an azimuth, or one of some endings.
fn peer(stem: &str) -> Option<(String, Component)> {
    let upper = stem.to_uppercase();
    let cut = |ending: &str| upper.strip_suffix(ending).filter(|rest| !rest.is_empty());
    // The number of a record says it all.
    let number = upper.split('_').next().filter(|first| {
        first.strip_prefix("RSN").is_some_and(|rest| {
            !rest.is_empty() && rest.bytes().all(|digit| digit.is_ascii_digit())
        })
    });
    let letters = if number.is_some() { &LETTERS[..] } else { &[] };
    let vertical = VERTICAL.iter().find_map(|ending| cut(ending));
    let (rest, component) = match vertical {
        Some(rest) => (rest, Component::Vertical),
        None => (
            azimuth(&upper)
                .or_else(|| HORIZONTAL.iter().chain(letters).find_map(|ending| cut(ending)))?,
            Component::Horizontal,
        ),
    };
    let group = number.map_or_else(|| rest.trim_end_matches('-').to_string(), String::from);
    Some((group, component))
}

/// A name without the azimuth at its end: three digits, or such as N17E.
fn azimuth(upper: &str) -> Option<&str> {
    let rest = upper.len().checked_sub(3).and_then(|at| upper.get(at..))?;
    if rest.bytes().all(|c| c.is_ascii_digit()) {
        return upper.get(..upper.len() - 3).filter(|rest| !rest.is_empty());
    }
    let tail = upper.len().checked_sub(4).and_then(|at| upper.get(at..))?;
    let bytes = tail.as_bytes();
    let is_bearing = matches!(bytes[0], b'N' | b'S')
        && bytes[1].is_ascii_digit()
        && bytes[2].is_ascii_digit()
        && matches!(bytes[3], b'E' | b'W');
    if is_bearing { upper.get(..upper.len() - 4).filter(|rest| !rest.is_empty()) } else { None }
}
