//! Which component of a motion a record is: by the words that files have for it.

/// A component of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Component {
    /// Horizontal.
    Horizontal,
    /// Vertical, positive up.
    Up,
    /// Vertical, positive down.
    Down,
}

impl Component {
    /// The component that a word means: an azimuth (`228`, `90 Deg`), a bearing (`N17E`), a direction (`EW`, `U-D`).
    pub fn named(word: &str) -> Option<Component> {
        // What stands in brackets is no part of it, as of `090 (CUE)`, but for the way of `VERTICAL (DOWN)`.
        let upper = word.to_uppercase();
        let (word, bracket) = upper.split_once('(').unwrap_or((&upper, ""));
        let bracket = bracket.trim_end().trim_end_matches(')');
        let word: String = word.chars().filter(|c| !c.is_whitespace() && *c != '°').collect();
        // PEER's newer names have a dash before a letter.
        let letter = word.strip_prefix('-').filter(|word| word.starts_with(char::is_alphabetic));
        let word = letter.unwrap_or(&word);
        let word = ["DEGREES", "DEG.", "DEG"]
            .iter()
            .find_map(|degrees| word.strip_suffix(degrees))
            .unwrap_or(word);
        let degrees =
            |text: &str| text.parse::<f64>().is_ok_and(|degrees| (0.0..=360.0).contains(&degrees));
        let bearing = word.strip_prefix(['N', 'S']).and_then(|rest| rest.strip_suffix(['E', 'W']));
        let axis = ["VERTICAL", "VERT", "UD", "Z"].iter().find_map(|axis| word.strip_prefix(axis));
        let way = axis.map(|rest| rest.trim_start_matches(['-', '_', ':', ',']));
        if [way, axis.and(Some(bracket.trim()))].into_iter().flatten().any(is_down) {
            return Some(Component::Down);
        }
        match word {
            _ if is_down(word) => Some(Component::Down),
            "UP" | "UD" | "U-D" | "UPDO" | "U" | "V" | "V1" | "VER" | "VERT" | "VERTICAL" | "Z"
            | "UPWARD" | "UPWARDS" => Some(Component::Up),
            "N" | "E" | "S" | "W" | "NS" | "EW" | "SN" | "WE" | "N-S" | "E-W" | "S-N" | "W-E"
            | "L" | "T" | "L1" | "T1" | "H" | "H1" | "H2" | "LONG" | "TRAN" | "TRANS"
            | "LONGITUDINAL" | "TRANSVERSE" | "HORIZONTAL" | "RADIAL" | "NORTH" | "SOUTH"
            | "EAST" | "WEST" => Some(Component::Horizontal),
            _ if degrees(word) || bearing.is_some_and(degrees) => Some(Component::Horizontal),
            _ => None,
        }
    }

    /// The component of a channel by SEED's code of three letters: `HNZ`, `HNE`, `BN1`.
    pub fn of_channel(code: &str) -> Option<Component> {
        let code = code.trim();
        let is_code = code.len() == 3 && code.chars().all(char::is_alphanumeric);
        let last = code.chars().last().filter(|_| is_code)?;
        match last.to_ascii_uppercase() {
            'Z' | '3' => Some(Component::Up),
            'N' | 'E' | '1' | '2' | 'X' | 'Y' | 'R' | 'T' => Some(Component::Horizontal),
            _ => None,
        }
    }

    /// True of one that is not horizontal.
    pub fn is_vertical(self) -> bool {
        self != Component::Horizontal
    }
}

/// True of the words for down, in capitals.
fn is_down(word: &str) -> bool {
    ["DWN", "DN", "DOWN", "DU", "D-U", "DOWNWARD", "DOWNWARDS"].contains(&word)
}

/// The azimuth of a word that states one, degrees from north over east: `228`, `S45W`, `NS`, `E-W`, a channel `HNE`.
pub fn azimuth(word: &str) -> Option<f64> {
    if Component::named(word).or_else(|| Component::of_channel(word))? != Component::Horizontal {
        return None;
    }
    let word = word.split('(').next().unwrap_or_default().to_uppercase();
    let is_left_out = |c: char| c.is_whitespace() || c == '°' || c == '-';
    let word: String = word.chars().filter(|c| !is_left_out(*c)).collect();
    let word = word.trim_end_matches("DEGREES").trim_end_matches("DEG.").trim_end_matches("DEG");
    let whole = |degrees: f64| (0.0..=360.0).contains(&degrees).then_some(degrees % 360.0);
    if let Ok(degrees) = word.parse::<f64>() {
        return whole(degrees);
    }
    let between = |from: char, to: char| {
        word.strip_prefix(from)?.strip_suffix(to)?.parse::<f64>().ok().filter(|d| *d >= 0.0)
    };
    let bearing = |from: char, to: char| between(from, to).filter(|d| *d <= 90.0);
    match word {
        "N" | "NS" | "NORTH" => Some(0.0),
        "E" | "EW" | "EAST" => Some(90.0),
        "S" | "SN" | "SOUTH" => Some(180.0),
        "W" | "WE" | "WEST" => Some(270.0),
        // Beyond a right angle N107E is an azimuth, as Japanese records of buildings have it.
        _ => between('N', 'E')
            .or_else(|| bearing('S', 'E').map(|d| 180.0 - d))
            .or_else(|| bearing('S', 'W').map(|d| 180.0 + d))
            .or_else(|| bearing('N', 'W').map(|d| 360.0 - d))
            .or_else(|| match Component::of_channel(word).and(word.chars().last()) {
                Some('N') => Some(0.0),
                Some('E') => Some(90.0),
                _ => None,
            })
            .and_then(whole),
    }
}

/// Where and when, and which component; none where the title has no comma.
pub fn place(title: &str) -> Option<(&str, &str)> {
    title.rsplit_once(',').map(|(place, component)| (place.trim(), component.trim()))
}

/// The event, with its date, and the station of a place: `Northridge-01, 1/17/1994` and `Rinaldi Receiving Sta`.
pub fn event_and_station(place: &str) -> (&str, &str) {
    match place.rsplit_once(',') {
        Some((event, station)) => (event.trim(), station.trim()),
        None => ("", place),
    }
}
