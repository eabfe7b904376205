//! Words of components and azimuths.

use topple_records::component::{Component, azimuth};

#[test]
fn words_tell_azimuths() {
    for (word, degrees) in [
        ("228", 228.0),
        ("90 Deg", 90.0),
        ("360", 0.0),
        ("090 (CUE)", 90.0),
        ("N17E", 17.0),
        ("N107E", 107.0),
        ("S 45 W", 225.0),
        ("S20E", 160.0),
        ("N17W", 343.0),
        ("N-S", 0.0),
        ("EW", 90.0),
        ("West", 270.0),
        ("HNE", 90.0),
        ("HNN", 0.0),
    ] {
        assert_eq!(azimuth(word), Some(degrees), "{word}");
    }
    for word in ["UP", "HNZ", "HN1", "L", "T1", "radial", "400", "", "N91W", "N400E"] {
        assert_eq!(azimuth(word), None, "{word}");
    }
}

#[test]
fn words_tell_components() {
    for word in ["UP", "ud", "U-D", "V", "Vert", "UPDO", "up ", "-V", "-up", "Z (up)", "V (CUE)"] {
        assert_eq!(Component::named(word), Some(Component::Up), "{word}");
    }
    for word in
        ["DWN", "DN", "down", "Vertical (down)", "VERT-DOWN", "Z down", "Downwards", "Z (DWN)"]
    {
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
    assert_eq!(Component::of_channel("Z-1"), None);
}
