//! What an envelope says beside shares and strokes: which cell is the best, and how likely a block falls of which something is
//! not known. And what a factor on the motions of a suite is.

use crate::common::room::{Room, number};

use super::fragility::BASE;

const ENVELOPE: &str = "envelope --suite ./list.csv --verify none";
const CELL: &str = "--t-h 1.5 --t-v 0.4 --verify none";

/// The steps of a column and a row to the nearest cell that is not feasible, cell by cell.
#[test]
fn the_best_cell_lies_farthest_from_cells_that_fail() {
    let room = Room::suite();
    let (columns, count) = (14, 14 * 6);
    let run = |more: &str| {
        let grid = "--t-h 0.5:5:14 --t-v 0.1:1:6 --limit-u 0.75 --limit-v 0.03 --scale 0.7";
        let said = room.run(&format!("{ENVELOPE} {BASE} {grid} --out ./out {more}")).out;
        let best = room.json("out")["best_cell"].as_u64().unwrap() as usize;
        (room.rows("out/envelope.csv"), best, said)
    };
    let (cells, best, said) = run("");
    assert_eq!(cells.len(), count);
    let feasible: Vec<bool> = cells.iter().map(|cell| cell["feasible"] == "1").collect();
    let kept = feasible.iter().filter(|kept| **kept).count();
    assert!(kept > 3 && kept < count, "{kept}");
    let steps = |cell: usize| {
        let away = |other: usize| {
            let along = (cell % columns).abs_diff(other % columns);
            along.max((cell / columns).abs_diff(other / columns))
        };
        (0..count).filter(|other| !feasible[*other]).map(away).min().unwrap()
    };
    for (cell, row) in cells.iter().enumerate() {
        assert_eq!(row["reserve"], steps(cell).to_string(), "{row:?}");
    }
    let most = (0..count).map(steps).max().unwrap();
    assert!(most > 1, "{most}");
    assert_eq!(steps(best), most);
    let least = |among: &dyn Fn(usize) -> bool, column: &str| {
        (0..count)
            .filter(|cell| among(*cell))
            .map(|cell| number(&cells[cell], column))
            .fold(f64::MAX, f64::min)
    };
    assert_eq!(number(&cells[best], "max_u_100"), least(&|cell| steps(cell) == most, "max_u_100"));
    assert!(said.contains("by reserve (--best): the most steps of the grid"), "{said}");
    assert!(said.contains(&format!("{most} steps from a cell that fails")), "{said}");
    let at_end = |cell: usize| {
        let (column, row) = (cell % columns, cell / columns);
        [(column, columns, "t_h"), (row, count / columns, "t_v")]
            .iter()
            .filter(|(at, of, _)| *at == 0 || at + 1 == *of)
            .map(|(.., key)| *key)
            .collect::<Vec<_>>()
            .join(" and ")
    };
    let mut ends = 0;
    let mut check = |best: usize, said: &str| {
        let told = said.contains("a larger grid may have a better one");
        assert_eq!(told, !at_end(best).is_empty(), "{said}");
        assert!(!told || said.contains(&format!("at the end of {}:", at_end(best))), "{said}");
        ends += usize::from(told);
    };
    check(best, &said);
    for (by, column) in [("stroke_u", "max_u_100"), ("stroke-v", "stroke_v_100")] {
        let (_, best, said) = run(&format!("--best {by}"));
        // A cell whose neighbours all fail is no choice.
        let beside = |cell: usize| {
            let (column, row) = (cell % columns, cell / columns);
            let along = [(column > 0).then(|| cell - 1), (column + 1 < columns).then(|| cell + 1)];
            let across = [
                (row > 0).then(|| cell - columns),
                (cell + columns < count).then(|| cell + columns),
            ];
            along.into_iter().chain(across).flatten().any(|other| feasible[other])
        };
        let wanted = least(&|cell| feasible[cell] && beside(cell), column);
        assert_eq!(number(&cells[best], column), wanted, "{by}");
        check(best, &said);
    }
    assert!(ends > 0, "no best cell lies at an end");
}

/// The share of the motions at points that are drawn is the mean of what each motion alone has at the same points.
#[test]
fn a_number_that_is_not_known_is_drawn_under_every_motion() {
    let room = Room::suite();
    let vary = "--vary eccentricity=uniform(0,0.5) --samples 16 --seed 7";
    let scene = "--isolation horizontal --t-h 1.5 --psi 0.5 --scale 1.5 --verify none";
    let envelope = format!("envelope --suite ./list.csv {BASE} {scene} --out ./envelope");
    let said = room.run(&format!("{envelope} {vary}")).out;
    let shares = ["a", "b", "c", "d"].map(|name| {
        let record = format!("--horizontal ./{name}.txt --vertical ./{name}_v.txt --dt 0.02");
        room.run(&format!("seismic {record} --units m/s2 {BASE} {scene} {vary} --out ./one"));
        let row = &room.rows("one/probability.csv")[0];
        number(row, "overturned_left") + number(row, "overturned_right")
    });
    let mean = shares.iter().sum::<f64>() / 4.0;
    assert!(
        mean > 0.0 && mean < 1.0 && shares.iter().any(|one| *one > 0.0 && *one < 1.0),
        "{shares:?}"
    );
    let row = &room.rows("envelope/envelope.csv")[0];
    assert!((number(row, "overturned") - mean).abs() < 1e-12, "{mean} {row:?}");
    assert_eq!(row["records"], "4");
    let [low, high] = ["overturned_low", "overturned_high"].map(|end| number(row, end));
    assert!(low <= mean && mean <= high && low < high, "{row:?}");
    let line = said.lines().find(|line| line.starts_with("likely")).unwrap();
    for part in [
        "overturning has P = ",
        "under 4 motions and 16 sets of what is not known; 95 %, by recording, 4 of them",
    ] {
        assert!(line.contains(part), "{line}");
    }
}

/// Factors are no axis of a fragility but levels of each motion.
#[test]
fn factors_are_levels_of_a_fragility() {
    let room = Room::suite();
    let fragility = format!("fragility --suite ./list.csv {BASE} {CELL} --out ./fragility");
    let factors = "--scale 2,0.5,1,4";
    room.run(&format!("{fragility} {factors}"));
    room.run(&format!("{ENVELOPE} {BASE} --t-h 1.5 --t-v 0.4 {factors} --out ./envelope"));
    let all = room.rows("fragility/fragility.csv");
    let counts: Vec<_> = all.iter().filter(|row| row["limit_state"] == "overturning").collect();
    let sum = |column: &str| counts.iter().map(|row| number(row, column)).sum::<f64>();
    let cells = room.rows("envelope/envelope.csv");
    let fallen: f64 = cells.iter().map(|cell| 4.0 * number(cell, "overturned")).sum();
    assert_eq!((sum("records"), sum("failed")), (16.0, fallen));
    assert!(fallen > 0.0 && fallen < 16.0, "{fallen}");
    room.run("suite ./list.csv --out ./suite");
    let peaks = room.rows("suite/suite.csv");
    let peaks = peaks.iter().map(|row| number(row, "pga_h"));
    let mut wanted: Vec<f64> =
        peaks.flat_map(|peak| [0.5, 1.0, 2.0, 4.0].map(|factor| factor * peak)).collect();
    wanted.sort_by(f64::total_cmp);
    let levels: Vec<f64> = counts
        .iter()
        .flat_map(|row| vec![number(row, "level"); number(row, "records") as usize])
        .collect();
    // suite.csv has seven digits.
    let near = |(own, peak): (&f64, &f64)| (own / peak - 1.0).abs() < 1e-6;
    assert!(levels.iter().zip(&wanted).all(near), "{levels:?}");
}

/// A factor of the scene is on the motions as the suite has them: on those that a list scales, too.
#[test]
fn a_factor_is_on_what_a_list_has_scaled() {
    let room = Room::suite();
    let list = room.read("list.csv");
    let (head, rows) = list.split_once('\n').unwrap();
    let rows: String = rows.lines().map(|line| format!("{line},2\n")).collect();
    room.write("doubled.csv", format!("{head},scale\n{rows}"));
    let run = |list: &str| {
        room.run(&format!("envelope {BASE} {CELL} --out ./out --suite {list}"));
        room.rows("out/envelope.csv")
    };
    let plain = run("./list.csv");
    assert_eq!(run("./doubled.csv --scale 0.5"), plain);
    let cells = run("./doubled.csv --scale 0.5,1");
    assert_eq!(cells[0]["max_u_100"], plain[0]["max_u_100"]);
    assert_eq!(cells[1]["max_u_100"], run("./doubled.csv")[0]["max_u_100"]);
    assert_ne!(cells[0]["max_u_100"], cells[1]["max_u_100"]);
}
