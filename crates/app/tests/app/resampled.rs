//! What is drawn for the intervals of a fragility: which motions are one recording, and which one event.

use std::fmt::Write as _;

use topple_studies::Suite;
use topple_studies::suites::Groups;
use topple_studies::suites::Resample;

use crate::common::room::Room;
use crate::common::suites::samples;

/// The groups of a list of motions, by their events, stations and vertical components.
fn groups(rows: &[(&str, &str, &str)], directions: usize, asked: Option<Resample>) -> Groups {
    let room = Room::suite();
    let mut list = "id,event,station,horizontal,vertical,dt,units\n".to_string();
    for (k, (event, station, vertical)) in rows.iter().enumerate() {
        // Each its own motion: one that is there twice is left out.
        let text = samples(2.0 + 0.05 * k as f64, 4.0)
            .iter()
            .fold(String::new(), |text, a| text + &format!("{a:.6}\n"));
        room.write(&format!("m{k}.txt"), text);
        writeln!(list, "m{k},{event},{station},m{k}.txt,{vertical},0.02,m/s2").unwrap();
    }
    room.write("events.csv", list);
    let suite = Suite::read(&room.at("events.csv"), false).unwrap();
    assert_eq!(suite.motions().count(), rows.len());
    Groups::of(&suite, directions, asked).unwrap()
}

#[test]
fn events_are_drawn_where_there_are_enough_and_recordings_elsewhere() {
    // Two stations of each of ten events, two components each.
    let names: Vec<String> = (0..10).map(|k| format!("event{k}")).collect();
    let rows = |events: usize| -> Vec<(&str, &str, &str)> {
        let event = |name| ["one", "one", "two", "two"].map(|station| (name, station, "a_v.txt"));
        names[..events].iter().flat_map(|name| event(name.as_str())).collect()
    };
    let ten = groups(&rows(10), 1, None);
    assert_eq!((ten.by, ten.count, ten.events), (Resample::Event, 10, Some(10)));
    assert_eq!(ten.of[..9], [0, 0, 0, 0, 1, 1, 1, 1, 2]);
    // Of nine the recordings, with a direction after the other.
    let nine = groups(&rows(9), 2, None);
    assert_eq!((nine.by, nine.count, nine.events), (Resample::Recording, 18, Some(9)));
    assert_eq!(nine.of[..9], [0, 0, 0, 0, 1, 1, 1, 1, 2]);
    let asked = groups(&rows(9), 2, Some(Resample::Event));
    assert_eq!((asked.by, asked.count, asked.of.len()), (Resample::Event, 9, 72));
    let motions = groups(&rows(10), 2, Some(Resample::Motion));
    assert_eq!((motions.count, motions.of.len()), (80, 80));
    // Without names those of one vertical component are one recording.
    let nameless =
        [("", "", "a_v.txt"), ("", "", "a_v.txt"), ("", "", "b_v.txt"), ("e", "", "b_v.txt")];
    let nameless = groups(&nameless, 1, None);
    assert_eq!((nameless.by, nameless.events), (Resample::Recording, None));
    assert_eq!(nameless.of, [0, 0, 1, 1]);
}
