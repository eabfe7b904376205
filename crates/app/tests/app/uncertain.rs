//! Probabilities over numbers that are not known, and how sharp boundaries are, by the command.

#[cfg(unix)]
use crate::common::command::interrupt;
use crate::common::room::Room;

const SCENE: &str =
    "pulse --object 1 --eccentricity 0.1 --t-h 1.75 --t-v 0.75 --omega 2:9:6 --a-h 2:9:5";
const CPU: &str = "--backend cpu --verify none";

#[test]
fn probabilities_are_written_and_made_again() {
    let room = Room::new();
    let vary = "--vary t-h=normal(1.75,0.2) --pixel --samples 16 --seed 3";
    room.run(&format!("{SCENE} {CPU} {vary} --out ./first"))
        .has("16 samples of 30 cells")
        .has("standard error");
    let table = room.read("first/probability.csv");
    let head = "omega,a_h,samples,full_contact,rocking,overturned_left,overturned_right,unresolved";
    assert_eq!((table.lines().next().unwrap(), table.lines().count()), (head, 31));
    for line in table.lines().skip(1) {
        let numbers: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
        let sum = numbers[3..].iter().sum::<f64>();
        assert!((sum - 1.0).abs() < 1e-12 && numbers[2] == 16.0, "{line}");
    }
    let run = room.json("first");
    assert_eq!(run["kind"], "probability");
    assert_eq!(run["vary"][0], "t_h=normal(1.75,0.2)");
    assert_eq!(
        (&run["pixel"], &run["samples"], &run["seed"]),
        (&true.into(), &16.into(), &3.into())
    );
    assert!(room.has("first/probability.png") && !room.has("first/map.csv"));
    // An earlier run again, what was not known with it.
    room.run(&format!("run ./first {CPU} --out ./again"));
    room.same("first", "again", &["probability.csv"]);
    // Another seed, another table; along one axis a curve, and the axis that varies is no column.
    room.run(&format!("run ./first {CPU} --seed 4 --out ./again"));
    assert_ne!(room.read("again/probability.csv"), table);
    let line = "pulse --object 1 --t-h 1.75 --t-v 0.75 --omega 5 --a-h 1:9:5";
    let vary = "--vary omega=uniform(4,6) --samples 4";
    room.run(&format!("{line} {CPU} {vary} --out ./again"));
    assert!(room.heading("again/probability.csv").starts_with("a_h,samples,"));
    assert!(room.has("again/probability.svg"));
}

#[test]
fn sharpness_is_told_where_it_is_asked_for() {
    let room = Room::new();
    let cell = "pulse --object 1 --eccentricity 0.2 --t-h 1.75 --t-v 0.75";
    let grid = "--omega 0.2:15:120 --a-h 0.1:15:120 --sharpness --out ./out";
    room.run(&format!("{cell} {CPU} {grid}"))
        .has("sharpness  S_b = ")
        .has("over distances of 1 to 8 cells, D = ");
    let sharpness = &room.json("out")["sharpness"];
    assert_eq!(sharpness["box_cells"], serde_json::json!([5, 5]));
    assert_eq!(sharpness["boxes"], 576);
    let (alpha, dimension) = (&sharpness["alpha"]["value"], &sharpness["dimension"]["value"]);
    assert!((alpha.as_f64().unwrap() + dimension.as_f64().unwrap() - 2.0).abs() < 1e-12);
    let said = room.run(&format!("{SCENE} {CPU} --out ./out")).out;
    assert!(said.lines().all(|line| !line.starts_with("sharpness")));
    assert!(room.json("out")["sharpness"].is_null());
}

/// Ctrl-C ends the sweeps, and nothing is there.
#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_nothing() {
    let room = Room::new();
    let cell = "pulse --object 1 --t-h 1.75 --t-v 0.75 --omega 0.2:15:400 --a-h 0.1:15:400";
    let pixels = "--pixel --samples 4096 --quiet --out out";
    let mut run = room.process(&format!("{cell} {CPU} {pixels}")).spawn();
    std::thread::sleep(std::time::Duration::from_secs(4));
    assert!(run.try_wait().unwrap().is_none());
    interrupt(&run);
    let ended = run.wait_with_output().unwrap();
    assert_eq!(ended.status.code(), Some(130));
    let said = String::from_utf8(ended.stderr).unwrap();
    assert!(said.contains("cancelled") && said.contains("nothing was saved"), "{said}");
    assert!(!room.has("out"));
}
