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
        // What stands in brackets is no part of it: `090 (CUE)`.
        let word = word.split('(').next().unwrap_or_default().to_uppercase();
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
        match word {
            "UP" | "UD" | "U-D" | "UPDO" | "U" | "V" | "V1" | "VER" | "VERT" | "VERTICAL" | "Z"
            | "UPWARD" => Some(Component::Up),
            "DWN" | "DN" | "DOWN" | "DU" | "DOWNWARD" => Some(Component::Down),
            "N" | "E" | "S" | "W" | "NS" | "EW" | "SN" | "WE" | "N-S" | "E-W" | "S-N" | "W-E"
            | "L" | "T" | "L1" | "T1" | "H" | "H1" | "H2" | "LONG" | "TRAN" | "TRANS"
            | "LONGITUDINAL" | "TRANSVERSE" | "HORIZONTAL" | "RADIAL" | "NORTH" | "SOUTH"
            | "EAST" | "WEST" => Some(Component::Horizontal),
            _ if degrees(word) || bearing.is_some_and(degrees) => Some(Component::Horizontal),
            _ => None,
        }
    }

    /// The component of a channel by SEED's code of three letters: `HNZ`, `HNE`, `BN1`.
    pub(super) fn of_channel(code: &str) -> Option<Component> {
        let last = code.trim().chars().last().filter(|_| code.trim().len() == 3)?;
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

#[cfg(test)]
mod tests {
    use super::Component;

    #[test]
    fn words_tell_components() {
        for word in ["UP", "ud", "U-D", "V", "Vert", "UPDO", "up ", "-V", "-up"] {
            assert_eq!(Component::named(word), Some(Component::Up), "{word}");
        }
        for word in ["DWN", "DN", "down"] {
            assert_eq!(Component::named(word), Some(Component::Down), "{word}");
        }
        for word in
            ["228", "0", "360", "N17E", "S 45 W", "EW", "E-W", "T1", "90 Deg", "090 (CUE)", "N00E"]
        {
            assert_eq!(Component::named(word), Some(Component::Horizontal), "{word}");
        }
        for word in ["400", "Rinaldi", "", "acc", "N400E", "-20"] {
            assert_eq!(Component::named(word), None, "{word}");
        }
        assert_eq!(Component::of_channel("HNZ"), Some(Component::Up));
        assert_eq!(Component::of_channel("HNE"), Some(Component::Horizontal));
        assert_eq!(Component::of_channel("Z"), None);
    }
}
