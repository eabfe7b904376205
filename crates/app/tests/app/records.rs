//! What a command says of records.

use topple::scene::record::{Record, synthetic};

use crate::common::formats::AT2;
use crate::common::motions::Motion;
use crate::common::room::Room;

#[test]
fn a_command_under_a_step_far_too_fine_says_so_in_one_line() {
    let room = Room::new();
    room.write("h.at2", AT2.replace(".0100", "1E-6"));
    let long =
        Record { title: "long".into(), dt: 0.01, samples: vec![1.0; 4001], ..Record::default() };
    room.write("v.at2", synthetic::at2(&long));
    let pair = "--horizontal ./h.at2 --vertical ./v.at2 --force";
    let line = room.refused(&format!("seismic --object 1 --t-h 1 --t-v 1 {pair}"));
    assert!(line.starts_with("topple: --vertical: steps of 0.000001 s and 0.01 s"), "{line}");
}

/// What is decided of a record is printed, of a single motion as of a map.
#[test]
fn a_history_says_what_was_made_of_a_sign() {
    let room = Room::new();
    let write = |name: &str, heading: &str, factor: f64| {
        let samples = Motion::made(400, Some(90)).samples;
        let row = |(k, a): (usize, &f64)| format!("{:.2} {:.8}\n", 0.01 * k as f64, a / factor);
        let rows: String = samples.iter().enumerate().map(row).collect();
        room.write(name, format!("{heading}\n{rows}"));
    };
    write("h.txt", "Time (s) NS (m/s2)", 1.0);
    let line = "history --object 1 --t-h 1 --t-v 0.5 --horizontal ./h.txt --vertical ./v.txt";
    let line = format!("{line} --out ./out");
    write("v.txt", "# positive north, east, down\nTime (s) UD (m/s2)", 2.0);
    let said = room.run(&line).words();
    assert!(said.contains("vertical: positive down by its file: turned over"), "{said}");
    write("v.txt", "# polarity: reversed\nTime (s) UD (m/s2)", 2.0);
    let said = room.refused(&line);
    let doubt = "v.txt: line 1: 'polarity: reversed': 'polarity' may tell a sign or a factor";
    assert!(said.contains(doubt) && said.trim_end().ends_with("--force accepts it"), "{said}");
    room.run(&format!("{line} --force"));
}
