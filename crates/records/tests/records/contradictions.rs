//! Files that contradict themselves: refused, or said.

use topple_records::{Component, Record, RecordHints, read};

use crate::common::motions::Motion;

fn of(text: &str) -> Result<Record, String> {
    read::bytes(text.as_bytes(), &RecordHints::default()).map_err(|error| error.to_string())
}

#[test]
fn a_header_that_contradicts_itself_is_refused() {
    let motion = Motion::made(400, Some(90));
    for (text, said) in [
        (motion.smc().text.replace("component= 090", "component= UP"), "contradict each other"),
        (motion.cosmos().text.replace("cm/sec2(04)", "cm/sec2(02)"), "by number; correct one"),
        (
            motion.cosmos().text.replace("acceleration pts", "velocity     pts"),
            "no points of acceleration",
        ),
        (
            motion.csmip().text.replace("POINTS OF ACCEL", "POINTS OF VELOC"),
            "another writer's volume 2",
        ),
    ] {
        let error = of(&text).unwrap_err();
        assert!(error.contains(said), "{error}");
    }
    let numbered = of(&motion.cosmos().text.replace("cm/sec2(04)", "(04)")).unwrap();
    assert!((numbered.peak() - 3.5).abs() < 1e-3);
}

#[test]
fn a_header_of_knet_may_lack_a_line_and_its_peak_is_compared() {
    let motion = Motion::made(400, Some(90));
    let text = motion.knet().text;
    let short = of(&text.replace("Memo.             \n", "")).unwrap();
    assert_eq!(short.samples.len(), 400, "{:?}", short.notes);
    let whole = of(&text).unwrap();
    assert_eq!(short.samples, whole.samples);
    assert_eq!(whole.notes.len(), 1, "{:?}", whole.notes);
    let scaled = of(&text.replace("1000(gal)", "500(gal)")).unwrap();
    assert!(scaled.notes[1].contains("where its header has 350"), "{:?}", scaled.notes);
}

#[test]
fn numbers_of_kik_net_are_directions() {
    let text = Motion::made(400, Some(90)).knet().text;
    for (number, azimuth, station) in
        [("1", Some(0.0), "ABC borehole"), ("5", Some(90.0), "ABC surface")]
    {
        let record = of(&text.replace("E-W", number)).unwrap();
        assert_eq!((record.stated.azimuth, &*record.stated.station), (azimuth, station));
        assert_eq!(record.stated.component, Some(Component::Horizontal));
    }
    assert_eq!(of(&text.replace("E-W", "6")).unwrap().stated.component, Some(Component::Up));
    assert_eq!(of(&text.replace("E-W", "EW2")).unwrap().stated.azimuth, Some(90.0));
}
