//! What a record's title says of its component: PEER's ends with it, after the last comma
//! (`Northridge-01, 1/17/1994, Rinaldi Receiving Sta, UP`).

/// A vertical component, by which way is positive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Vertical {
    /// Up.
    Up,
    /// Down.
    Down,
}

/// Where and when, and which component; none where the title has no comma.
pub fn place(title: &str) -> Option<(&str, &str)> {
    title.rsplit_once(',').map(|(place, component)| (place.trim(), component.trim()))
}

/// True of a title that names a horizontal component: an azimuth in degrees, a bearing, or a direction.
pub fn is_horizontal(title: &str) -> bool {
    let Some((_, component)) = place(title) else { return false };
    let component = component.to_uppercase();
    let degrees =
        |text: &str| text.parse::<f64>().is_ok_and(|degrees| (0.0..=360.0).contains(&degrees));
    let bearing = component.strip_prefix(['N', 'S']).and_then(|rest| rest.strip_suffix(['E', 'W']));
    degrees(&component)
        || bearing.is_some_and(degrees)
        || matches!(
            component.as_str(),
            "N" | "E"
                | "S"
                | "W"
                | "NS"
                | "EW"
                | "N-S"
                | "E-W"
                | "L"
                | "T"
                | "L1"
                | "T1"
                | "H1"
                | "H2"
        )
}

/// The event, with its date, and the station of a place: `Northridge-01, 1/17/1994` and `Rinaldi Receiving Sta`.
pub fn event_and_station(place: &str) -> (&str, &str) {
    match place.rsplit_once(',') {
        Some((event, station)) => (event.trim(), station.trim()),
        None => ("", place),
    }
}

/// The vertical component that a title names; none for a horizontal one, and where it says nothing.
pub fn vertical(title: &str) -> Option<Vertical> {
    let (_, component) = place(title)?;
    match component.to_uppercase().as_str() {
        "UP" | "UD" | "V" | "V1" | "VER" | "VERT" | "VERTICAL" => Some(Vertical::Up),
        "DWN" | "DN" | "DOWN" => Some(Vertical::Down),
        _ => None,
    }
}

/// True where two titles name two stations or events.
pub fn apart(one: &str, other: &str) -> bool {
    match (place(one), place(other)) {
        (Some((here, _)), Some((there, _))) => !here.eq_ignore_ascii_case(there),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::{Vertical, apart, is_horizontal, vertical};

    #[test]
    fn titles_tell_components_and_stations() {
        let rinaldi = |component: &str| format!("Northridge-01, 1/17/1994, Rinaldi, {component}");
        assert_eq!(vertical(&rinaldi("UP")), Some(Vertical::Up));
        assert_eq!(vertical(&rinaldi("DWN")), Some(Vertical::Down));
        assert_eq!(vertical(&rinaldi("228")), None);
        assert_eq!(vertical("El Centro UP"), None);
        for component in ["228", "0", "N17E", "EW", "T1"] {
            assert!(is_horizontal(&rinaldi(component)), "{component}");
        }
        for component in ["UP", "DWN", "400", "Rinaldi", ""] {
            assert!(!is_horizontal(&rinaldi(component)), "{component}");
        }
        assert!(!apart(&rinaldi("228"), &rinaldi("UP")));
        assert!(apart(&rinaldi("228"), "Northridge-01, 1/17/1994, Sylmar, UP"));
        assert!(!apart("El Centro", "Northridge-01, 1/17/1994, Sylmar, UP"));
    }
}
