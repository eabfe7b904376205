//! `topple chart` from outside, and what is read back from other programs.

use std::collections::BTreeSet;
use std::path::Path;

use crate::common::room::Room;

const CHART: &str = "chart --quick --no-shader --quiet --out ./out";

fn rows(path: &Path) -> Vec<Vec<String>> {
    let mut table = csv::Reader::from_path(path).unwrap();
    table.records().map(|row| row.unwrap().iter().map(String::from).collect()).collect()
}

/// The results of a program that solved a scene's cells, all with one outcome.
fn peer(cells: &Path, scene: &str, outcome: &str) -> String {
    let mut text = String::from(
        "scene,method,precision,step,tolerance,threads,seconds_a_cell,start_seconds,runs,cell,outcome,zeta,switches\n",
    );
    for row in rows(cells).iter().filter(|row| row[0] == scene) {
        text.push_str(&format!(
            "{scene},other 1.0,f64,,1e-6,1,0.01,0,1,{},{outcome},0.5,uplift_left 0.5 0 0 0 0 0 0 0\n",
            row[1]
        ));
    }
    text
}

#[test]
fn a_quick_chart_has_every_method_and_its_files() {
    let room = Room::new();
    room.run(&format!("{CHART} --cells-only"));
    assert!(!room.has("out/chart.csv"));
    room.write("other.csv", peer(&room.at("out/cells.csv"), "pulse", "rocking"));
    room.run(&format!("{CHART} --peer ./other.csv"));
    let table = rows(&room.at("out/chart.csv"));
    let methods: BTreeSet<(&str, &str)> =
        table.iter().map(|row| (row[0].as_str(), row[1].as_str())).collect();
    for scene in ["pulse", "record", "free"] {
        for method in ["cpu", "naive", "reference"] {
            assert!(methods.contains(&(scene, method)), "{scene} {method}");
        }
    }
    assert!(methods.contains(&("maps", "cpu")) && methods.contains(&("pulse", "other 1.0")));
    // What a map leaves out changes no outcome, and what is not asked is not there.
    let of_maps = |method: &str, step: &str| -> Vec<String> {
        let row = table
            .iter()
            .find(|row| row[0] == "maps" && row[1] == method && row[2] == "f32" && row[3] == step);
        row.unwrap().clone()
    };
    for step in ["1.5625e-2", "7.8125e-3"] {
        let [whole, shared, outcome] =
            ["cpu", "cpu with shortcuts", "cpu outcome only"].map(|method| of_maps(method, step));
        assert_eq!([&shared[12], &outcome[12]], [&whole[12]; 2], "{step}");
        assert!(!shared[18].is_empty() && outcome[18].is_empty() && outcome[19].is_empty());
    }
    // Switches in the step are of a higher order than at its end: at the same step of 1/128 s, on
    // the scene of free rocking, by far more than a factor of a hundred.
    let time = |method: &str| -> f64 {
        let row = table.iter().find(|row| {
            row[0] == "free" && row[1] == method && row[2] == "f64" && row[3] == "7.8125e-3"
        });
        row.unwrap()[14].parse().unwrap()
    };
    assert!(time("naive") > 100.0 * time("cpu"), "{} {}", time("naive"), time("cpu"));
    for name in ["pulse", "record", "free", "maps"] {
        for kind in ["svg", "png"] {
            assert!(room.bytes(&format!("out/{name}.{kind}")).len() > 1000);
        }
    }
}

#[test]
fn what_another_program_gives_is_checked() {
    let room = Room::new();
    room.run(&format!("{CHART} --cells-only"));
    let good = peer(&room.at("out/cells.csv"), "free", "rocking");
    let short: String = good.lines().take(5).map(|line| format!("{line}\n")).collect();
    for (name, text, says) in [
        ("short", short, "4 cells where there are 64"),
        ("outcome", good.replace("rocking", "tilting"), "'tilting'"),
        ("switch", good.replace("uplift_left 0.5", "uplift_left x"), "uplift_left x"),
        ("scene", good.replace("free,", "nowhere,"), "'nowhere'"),
        ("columns", "a,b\n1,2\n".into(), "missing field"),
    ] {
        room.write(&format!("{name}.csv"), text);
        room.refuses(&format!("{CHART} --peer ./{name}.csv"), &[says]);
    }
    room.refuses(&format!("{CHART} --peer nowhere.csv"), &["nowhere.csv"]);
    assert!(!room.has("out/chart.csv"));
}
