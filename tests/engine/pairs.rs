//! The two components of a scene's record: brought together, or refused.

use topple::scene::builder::SceneBuilder;
use topple::scene::record::Pair;

use crate::common::formats::AT2;

/// A pair of files by their titles, checked as a scene's record.
fn pair_of(horizontal: &str, vertical: &str, force: bool) -> Result<Pair, String> {
    let directory = tempfile::TempDir::new().unwrap();
    for (name, title, scale) in [("h.at2", horizontal, "1"), ("v.at2", vertical, "2")] {
        let text = AT2.replace("A STATION, 90", title).replace(".7E-1", &format!(".{scale}E-1"));
        std::fs::write(directory.path().join(name), text).unwrap();
    }
    let scene = format!(
        "[block]\nobject = 1\n[base]\nt_h = 1\nt_v = 1\n[run]\nforce = {force}\n\
         [record]\nhorizontal = \"h.at2\"\nvertical = \"v.at2\"\npga = 3\n"
    );
    let text = SceneBuilder::from_toml(&scene).unwrap();
    let scene = text.check_in(directory.path()).map_err(|error| error.to_string())?;
    Ok(scene.excitation.record().unwrap().clone())
}

#[test]
fn a_vertical_that_is_positive_down_is_turned_over() {
    let up = pair_of("A QUAKE, HERE, 90", "A QUAKE, HERE, UP", false).unwrap();
    let down = pair_of("A QUAKE, HERE, 90", "A QUAKE, HERE, DWN", false).unwrap();
    assert!(up.vertical.iter().zip(down.vertical.iter()).all(|(up, down)| *up == -down));
    assert_eq!(up.horizontal, down.horizontal);
    assert!(down.notes.iter().any(|note| note.contains("turned over")), "{:?}", down.notes);
    assert!(!up.notes.iter().any(|note| note.contains("turned over")));
}

#[test]
fn pairs_that_are_none_are_refused_and_accepted_when_forced() {
    for (horizontal, vertical, said) in [
        ("A QUAKE, HERE, UP", "A QUAKE, HERE, UP", "horizontal: 'A QUAKE, HERE, UP' is a vertical"),
        ("A QUAKE, HERE, 90", "A QUAKE, THERE, UP", "vertical: 'A QUAKE, THERE, UP' is of another"),
        (
            "A QUAKE, HERE, 90",
            "A QUAKE, HERE, 180",
            "vertical: 'A QUAKE, HERE, 180' is a horizontal",
        ),
    ] {
        let error = pair_of(horizontal, vertical, false).unwrap_err();
        assert!(error.starts_with(said) && error.contains("; `force` accepts it"), "{error}");
        assert!(pair_of(horizontal, vertical, true).is_ok());
    }
    let directory = tempfile::TempDir::new().unwrap();
    std::fs::write(directory.path().join("h.at2"), AT2).unwrap();
    let twice = "[block]\nobject = 1\n[base]\nt_h = 1\nt_v = 1\n\
                 [record]\nhorizontal = \"h.at2\"\nvertical = \"h.at2\"\n";
    let error = SceneBuilder::from_toml(twice).unwrap().check_in(directory.path()).unwrap_err();
    assert!(error.to_string().starts_with("vertical: the same motion"), "{error}");
    // Multiples of g taken for m/s^2: 0.07 g where 0.7 g was meant.
    std::fs::write(directory.path().join("h.txt"), "0.1\n-0.7\n0.2\n").unwrap();
    let weak = |more: &str, force: &str| {
        let text = format!(
            "[block]\nobject = 1\n[base]\nt_h = 1\nt_v = 1\n{force}\
             [record]\nhorizontal = \"h.txt\"\ndt = 0.01\n{more}\n"
        );
        SceneBuilder::from_toml(&text).unwrap().check_in(directory.path())
    };
    let error = weak("units = \"m/s2\"", "").unwrap_err().to_string();
    let said =
        "units: in m/s2 the peak is 0.071 g, a weak motion; if the numbers are in g, it is 0.70 g";
    assert!(error.starts_with(said) && error.contains("; `force` accepts it"), "{error}");
    assert!(weak("units = \"m/s2\"", "[run]\nforce = true\n").is_ok());
    assert!(weak("units = \"m/s2\"\nscale = 3", "").is_err());
    assert!(weak("units = \"m/s2\"\npga = 3", "").is_ok());
    assert!(weak("units = \"g\"", "").is_ok());
}
