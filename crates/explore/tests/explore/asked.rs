use topple::model::precision::Precision;
use topple::scene::Grid;
use topple_explore::asked::{AskedPrecision, builder};

use crate::flat;

const SCENE: &str = "object=1 t_h=1.75 t_v=0.75 omega=0.2:15 a_h=0.1:15:log";

#[test]
fn a_scene_goes_to_flat_keys_and_back() {
    let asked = flat(SCENE);
    let given = builder(&asked, Some([5, 3])).unwrap();
    let scene = given.check().unwrap();
    assert_eq!(Grid::of(&scene).shape(), (5, 3));
    assert_eq!(topple_explore::asked::flat(&scene, &given), asked);
}

#[test]
fn what_is_wrong_names_its_key() {
    for (key, text, said) in [
        ("omega", "3", "start:stop"),
        ("omega", "3:1:9", "start:stop"),
        ("omega", "3:1", "smaller one first"),
        ("omega", "1:1", "smaller one first"),
        ("omega", ":1", "finite number"),
        ("omega", "NaN:1", "finite number"),
        ("omega", "1:1e999", "finite number"),
        ("t_h", "", "'' is not"),
        ("t_h", "0x10", "finite number"),
        ("t_h", "1:2", "finite number"),
        ("t_h", "x", "finite number"),
        ("object", "-1", "number of a block"),
        ("isolation", "both", "dual"),
        ("overturn", "never", "critical-angle"),
        ("colour", "red", "no such key"),
        ("y", "omega", "other axis"),
        ("x", "width", "no number"),
    ] {
        let mut asked = flat(SCENE);
        asked.insert(key.into(), text.into());
        let refused = builder(&asked, Some([5, 3])).unwrap_err();
        assert_eq!(refused.key.as_deref(), Some(key), "{refused}");
        assert!(refused.line.contains(said), "{refused}");
        asked.insert(key.into(), format!("{text}{}", "\u{660}\n9".repeat(900)));
        let refused = builder(&asked, Some([5, 3])).unwrap_err();
        assert!(!refused.line.contains('\n') && refused.line.len() < 300, "{refused}");
    }
}

/// f32 has 24 bits: of values near 4 the spacing is 2^-21.
#[test]
fn a_deep_view_is_computed_in_f64() {
    for (stop, expected) in [("4.1", Precision::F32), ("4.01", Precision::F64)] {
        let mut asked = flat(SCENE);
        asked.insert("omega".into(), format!("4:{stop}"));
        let grid = |count| Grid::of(&builder(&asked, Some([count, 3])).unwrap().check().unwrap());
        for count in [3, 257, 2049] {
            assert_eq!(AskedPrecision::Auto.of(&grid(count)), expected, "{stop} {count}");
        }
        let grid = grid(257);
        assert_eq!(AskedPrecision::F32.of(&grid), Precision::F32);
    }
}
