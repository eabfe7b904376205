//! What is made of a record before it shakes a base: turned, followed by another, on a floor. The motions themselves are held to
//! closed forms by the tests of the records.

use crate::common::room::Room;

/// Writes a component at an azimuth, of a given number of samples of 0.01 s.
fn component(room: &Room, name: &str, azimuth: &str, count: usize) {
    let mut text = format!(
        "PEER NGA STRONG MOTION DATABASE RECORD\nA Quake, 1/2/2003, Town, {azimuth}\n\
         ACCELERATION TIME SERIES IN UNITS OF G\nNPTS= {count}, DT= 0.01 SEC\n"
    );
    for k in 0..count {
        let phase = 0.07 * k as f64 + name.len() as f64;
        text.push_str(&format!("{:.7e}\n", 0.4 * phase.sin()));
    }
    room.write(name, text);
}

const CELL: &str = "history --object 1 --t-h 1.75 --t-v 0.75 --quiet";

#[test]
fn what_is_made_of_a_record_is_in_run_json_and_made_again() {
    let room = Room::new();
    component(&room, "a.at2", "228", 300);
    component(&room, "b1.at2", "318", 280);
    let floor = "--floor-period 0.5 --floor-damping 0.02 --floor-factor 1.3";
    let turned = format!("--horizontal ./a.at2 --horizontal-2 ./b1.at2 --azimuth 10 {floor}");
    let joined = "--horizontal ./a.at2 --join ./b1.at2 --join-gap 0.5";
    // From its results, and from a scene's file, each is the same motion to the byte.
    for (name, flags) in [("turned", &*turned), ("joined", joined)] {
        room.run(&format!("{CELL} {flags} --out ./{name}"));
        room.run(&format!("{CELL} {flags} --save-scene ./{name}.toml"));
        for again in [format!("run ./{name}"), format!("history ./{name}.toml")] {
            room.run(&format!("{again} --out ./again"));
            room.same(name, "again", &["history.csv"]);
            room.remove("again");
        }
    }
    let run = room.json("turned");
    let record = &run["record"];
    assert_eq!(record["horizontal_2"]["samples"], 280);
    assert_eq!(record["treatment"]["azimuth"], 10.0);
    assert_eq!(record["treatment"]["floor_factor"], 1.3);
    let notes = run["scene"]["excitation"]["record"]["notes"].to_string();
    for note in [
        "turned to 10 degrees, of 'A Quake, 1/2/2003, Town, 228' at 228 and",
        "an oscillator of 0.5 s and damping 0.02, 1.3 times",
    ] {
        assert!(notes.contains(note), "{notes}");
    }
    let run = room.json("joined");
    // 300 samples, 50 zeros, 280 samples.
    assert_eq!(run["scene"]["excitation"]["record"]["horizontal"], 630);
    assert!(run["record"].get("horizontal_2").is_none());
}

/// Writes a file of 20 s whose ground ends at rest, or with the velocity of an offset.
fn on_offset(room: &Room, name: &str, offset: f64) {
    let row = |k: u32| {
        let t = 0.01 * f64::from(k);
        let envelope = (0.05 * std::f64::consts::PI * t).sin().powi(2);
        let a = 3.0 * envelope * (2.0 * std::f64::consts::PI * t).sin();
        format!("{t:.2},{:.6}\n", a + offset)
    };
    room.write(
        name,
        "time (s),acc (m/s2)\n".to_string() + &(0..=2000).map(row).collect::<String>(),
    );
}

#[test]
fn an_offset_is_warned_of_and_a_line_takes_it_away() {
    let room = Room::new();
    on_offset(&room, "clean.csv", 0.0);
    on_offset(&room, "off.csv", 0.3);
    let run = |file: &str, out: &str| {
        let base = "--u-y 0.01 --psi 0.1 --xi-h 0";
        let said = room.run(&format!("{CELL} {base} --horizontal {file} --out ./{out}")).err;
        let manifest = room.json(out);
        (said, manifest["outcome"]["max_u"].as_f64().unwrap(), manifest)
    };
    let warning = "horizontal: the ground ends with the velocity 6 m/s, ";
    let (said, still, _) = run("./clean.csv", "clean");
    assert!(!said.contains("the ground ends"), "{said}");
    let (said, drifts, manifest) = run("./off.csv", "off");
    assert!(said.contains(warning) && said.contains("--baseline line subtracts"), "{said}");
    assert!(manifest["warnings"].to_string().contains(warning), "{manifest}");
    let (said, level, manifest) = run("./off.csv --baseline line", "line");
    // What the line leaves of the offset is its own part of the motion's velocity.
    assert!(drifts > 2.0 * still && (level / still - 1.0).abs() < 0.05, "{still} {drifts} {level}");
    assert!(!said.contains("the ground ends"), "{said}");
    let notes = manifest["scene"]["excitation"]["record"]["notes"].to_string();
    assert!(notes.contains("an offset of 0.3 m/s2 (0.0306 g) subtracted"), "{notes}");
    assert_eq!(manifest["record"]["treatment"]["baseline"], "line");
    // From its results it is the same motion, to the byte.
    room.run("run ./line --out ./again");
    room.same("line", "again", &["history.csv"]);
    // In a scene's file, and refused there and here.
    let text = "[block]\nobject = 1\n\n[base]\nt_h = 1.75\nt_v = 0.75\nu_y = 0.01\npsi = 0.1\nxi_h = 0\n\n[record]\n\
                horizontal = \"off.csv\"\nbaseline = \"line\"\n";
    room.write("scene.toml", text);
    room.run("history ./scene.toml --out ./file");
    room.same("line", "file", &["history.csv"]);
    room.write("scene.toml", text.replace("\"line\"", "\"poly\""));
    room.refused("history ./scene.toml --out ./no");
}

#[test]
fn a_floor_bears_the_synthetic_pair_too() {
    let room = Room::new();
    let periods = "--t-h 1:2:2 --t-v 0.5 --floor-period 0.4";
    room.run(&format!("seismic --object 1 {periods} --verify none --backend cpu --out ./out"));
    let pair = &room.json("out")["scene"]["excitation"]["record"];
    // The synthetic pair has 0.6 g.
    assert!(pair["pga_h"].as_f64().unwrap() > 8.0, "{pair}");
}
