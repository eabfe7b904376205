//! Fragility from the command line: what it counts against single maps, its levels, runs in shards, numbers that vary.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use crate::common::room::{Room, Row, number};
use crate::common::suite::MOTIONS;
use approx::assert_relative_eq;

/// A block on a base, and how its cells are computed.
pub const BASE: &str = "--object 1 --eccentricity 0.2 --u-y 0.01 --backend cpu --precision f64";
const GRID: &str = "--t-h 0.8:3:3 --t-v 0.3:1:2";
/// One cell.
pub const ONE: &str = "--t-h 1.5 --t-v 0.5 --verify none";
/// A fragility of the made suite.
pub const FRAGILITY: &str = "fragility --suite ./list.csv --out ./out";

/// What is counted at a level is what the maps of the motions, scaled to its PGA, say together.
#[test]
fn counts_are_those_of_maps() {
    let room = Room::suite();
    // Out of order on purpose.
    let levels = [3.0, 1.5, 6.0, 12.0];
    let asked = "--levels 3,1.5,6,12 --limit-zeta 0.3 --limit-u 0.4";
    room.run(&format!("{FRAGILITY} {BASE} {GRID} {asked}")).has("theta from");
    let counts = room.rows("out/fragility.csv");
    let columns = ["limit_state", "level", "records", "failed"];
    assert!(columns.iter().all(|column| counts[0].contains_key(*column)), "{:?}", counts[0]);
    let maps = MOTIONS.map(|(name, ..)| {
        levels.map(|level| {
            let record = format!("--horizontal ./{name}.txt --vertical ./{name}_v.txt --dt 0.02");
            let scaled = format!("--units m/s2 --pga {level} --force --verify none --out ./map");
            room.run(&format!("seismic {record} {scaled} {BASE} {GRID}"));
            room.rows("map/map.csv")
        })
    });
    let of = |map: &[Row], row: &Row| -> Row {
        let same = |cell: &&Row| cell["t_h"] == row["t_h"] && cell["t_v"] == row["t_v"];
        map.iter().find(same).unwrap().clone()
    };
    let fails = |state: &str, row: &Row| {
        let over = row["outcome"].starts_with("overturned");
        match state {
            "overturning" => over,
            "uplift" => row["outcome"] != "full_contact",
            "zeta>0.3" => over || number(row, "zeta") > 0.3,
            "max_u>0.4" => over || number(row, "max_u") > 0.4,
            other => panic!("{other}"),
        }
    };
    let mut seen = BTreeMap::<(&str, u32), u32>::new();
    for row in &counts {
        let (state, level) = (row["limit_state"].as_str(), number(row, "level"));
        let k = levels.iter().position(|known| *known == level).unwrap();
        let failed = maps.iter().filter(|map| fails(state, &of(&map[k], row))).count();
        let told = (number(row, "records"), number(row, "failed"));
        assert_eq!(told, (4.0, failed as f64), "{row:?}");
        *seen.entry((state, failed as u32)).or_default() += 1;
    }
    assert_eq!(counts.len(), 6 * 4 * levels.len());
    // Where all counts are alike nothing is shown.
    for state in ["overturning", "uplift", "zeta>0.3", "max_u>0.4"] {
        assert!(seen.keys().filter(|(of, _)| *of == state).count() >= 3, "{seen:?}");
    }
    for row in room.rows("out/capacities.csv") {
        let motion = MOTIONS.iter().position(|(name, ..)| *name == row["record"]).unwrap();
        let over = |k: &usize| fails("overturning", &of(&maps[motion][*k], &row));
        let fallen: Vec<f64> = (0..4).filter(over).map(|k| levels[k]).collect();
        let lowest = fallen.iter().copied().reduce(f64::min);
        assert_eq!(row["lowest"].parse().ok(), lowest, "{row:?}");
        let stands =
            levels.iter().any(|l| lowest.is_some_and(|low| *l > low) && !fallen.contains(l));
        assert_eq!(row["stands_again"] == "1", stands, "{row:?}");
    }
    assert_eq!(room.rows("out/fits.csv").len(), 6 * 4 * 3);
    for picture in ["fragility", "fragility-uplift", "fragility-zeta-0.3", "fragility-max_u-0.4"] {
        assert!(room.has(&format!("out/{picture}.png")), "{picture}");
    }
}

/// Parts that ran one by one, a run that goes on, and one that ran at once write the same.
#[test]
fn parts_are_the_whole() {
    let room = Room::suite();
    // Cells enough that a motion is worth a file.
    let grid = "--t-h 0.8:3:40 --t-v 0.3:1:40 --verify none";
    let line = |name: &str, more: &str| {
        format!("envelope --suite ./list.csv {BASE} {grid} --out ./{name} {more}")
    };
    let saved = |out: &str| {
        let files = room.names(&format!("{out}/motions"));
        files.into_iter().filter(|name| name != "lock").collect::<Vec<_>>()
    };
    let same = |one: &str| room.same("whole", one, &["envelope.csv"]);
    room.run(&line("whole", ""));
    assert!(!room.has("whole/motions"));
    room.run(&line("parts", "--tile 1/2")).has("--resume joins the shards");
    assert_eq!((saved("parts").len(), room.has("parts/envelope.csv")), (2, false));
    room.refuses(&line("parts", ""), &["--resume goes on with it"]);
    room.run(&line("parts", "--tile 2/2"));
    let files: Vec<PathBuf> =
        saved("parts").iter().map(|name| room.at("parts/motions").join(name)).collect();
    assert_eq!(files.len(), 4);
    // One of them is cut short, one has a bit turned over.
    let bytes = fs::read(&files[0]).unwrap();
    fs::write(&files[0], &bytes[..bytes.len() / 2]).unwrap();
    let mut bytes = fs::read(&files[1]).unwrap();
    bytes[100] ^= 1;
    fs::write(&files[1], bytes).unwrap();
    room.run(&line("parts", "--resume")).has("2 of 4 motions were done");
    same("parts");
    assert!(!room.has("parts/motions"));
    // Another scene has other motions: nothing of it is taken over.
    room.run(&line("other", "--tile 1/1"));
    room.refuses(&line("other", "--resume --psi 0.3"), &["holds motions of another run"]);
    assert_eq!(saved("other").len(), 4);
    room.run(&line("other", "--resume")).has("4 of 4 motions were done");
    same("other");
    room.run(&line("dry", "--dry-run")).has("6400 together").has("of sweep");
    assert!(!room.has("dry"));
}

/// The curve at a point of numbers that are not known is that of a run with these numbers, and a number that does
/// nothing explains nothing.
#[test]
fn points_are_runs_of_their_numbers() {
    let room = Room::suite();
    let fragility = |name: &str, more: &str| {
        let base = "--isolation horizontal --object 1 --u-y 0.01 --t-h 1.5 --levels 1:16:12:log";
        let common = "--verify none --backend cpu --precision f64";
        room.run(&format!("fragility --suite ./list.csv {base} {common} --out ./{name} {more}"));
    };
    let overturning = |table: &str| -> Vec<Row> {
        let of = |row: &Row| row["limit_state"] == "overturning";
        room.rows(table).into_iter().filter(of).collect()
    };
    let failed =
        |table: &str| overturning(table).iter().map(|row| number(row, "failed")).sum::<f64>();
    let vary = "--vary eccentricity=uniform(-0.3,0.3) --vary t_max=uniform(7,8)";
    fragility("vary", &format!("{vary} --samples 4"));
    let points = overturning("vary/points.csv");
    assert_eq!(points.len(), 8);
    let mut all_failed = 0.0;
    for row in &points {
        let (e, t_max) = (&row["drawn_eccentricity"], &row["drawn_t_max"]);
        fragility("one", &format!("--eccentricity={e} --t-max {t_max} --estimator stripes"));
        let fit = &overturning("one/fits.csv")[0];
        if fit["separable"] == "1" {
            assert_eq!(row["theta"], "", "{row:?}");
        } else {
            assert_eq!((&fit["theta"], &fit["beta"]), (&row["theta"], &row["beta"]));
        }
        all_failed += failed("one/fragility.csv");
    }
    // The curve of all counts the runs of all points.
    assert!(overturning("vary/fragility.csv").iter().all(|row| row["records"] == "32"));
    assert_eq!(failed("vary/fragility.csv"), all_failed);
    // Four samples tell no index.
    for row in room.rows("vary/sensitivity.csv") {
        for name in ["first_low", "first_high", "total_low", "total_high", "first", "total"] {
            assert!(row[name].is_empty(), "{row:?}");
        }
    }
    fragility("more", &format!("{vary} --samples 32"));
    let indices = room.rows("more/sensitivity.csv");
    let of = |parameter: &str| indices.iter().find(|row| row["parameter"] == parameter).unwrap();
    // Free vibration after the motion overturns nothing here.
    assert_eq!(number(of("t_max"), "total"), 0.0);
    assert!(number(of("eccentricity"), "total") > 0.5);
    assert!(!room.has("more/capacities.csv"));
}

/// Of a number that is not known: indices that so few samples do not tell are words, and where no run fails at any point it is
/// said, not printed as a number.
#[test]
fn what_explains_nothing_is_said_in_words() {
    let room = Room::suite();
    let device = "--object 1 --u-y 0.01 --backend cpu --precision f64";
    let of = |vary: &str| room.run(&format!("{FRAGILITY} {ONE} {device} --vary {vary}"));
    of("eccentricity=uniform(-0.3,0.3) --levels 1:16:6:log --samples 2")
        .has("explains   eccentricity: not known with so few samples (--samples)")
        .has("varies     eccentricity=uniform(-0.3,0.3)");
    let said = of("eccentricity=normal(0,0.1) --levels 0.2,0.4 --samples 4");
    said.has("explains   eccentricity: not known: at all points as many runs fail");
    assert!(!said.out.contains("NaN") && said.out.contains("--samples"), "{}", said.out);
    for row in room.rows("out/sensitivity.csv") {
        assert!(row["first"].is_empty() && row["total"].is_empty(), "{row:?}");
    }
}

/// One recording alone tells no interval: neither a fitted curve nor separable data have one.
#[test]
fn one_recording_alone_has_no_interval() {
    let room = Room::suite();
    let list = room.read("list.csv");
    room.write("site.csv", "PGA [m/s2],rate\n0.5,0.05\n4,0.0012\n60,1e-6\n");
    let run = |count: usize| {
        room.write("list.csv", list.lines().take(count + 1).collect::<Vec<_>>().join("\n"));
        let site = "--levels 1:40:24:log --hazard ./site.csv --estimator stripes";
        let told = room.run(&format!("{FRAGILITY} {BASE} {ONE} {site}")).out;
        (told, room.rows("out/fits.csv"))
    };
    let (told, fits) = run(1);
    let separable = fits.iter().filter(|fit| fit["separable"] == "1" && !fit["theta"].is_empty());
    assert!(separable.count() > 0, "{fits:?}");
    for fit in &fits {
        for column in ["theta_low", "theta_high", "beta_low", "beta_high"] {
            assert_eq!(fit[column], "", "{column}: {fit:?}");
        }
    }
    for rate in room.rows("out/rates.csv").iter().filter(|rate| !rate["rate"].is_empty()) {
        assert_eq!((&*rate["rate_low"], &*rate["rate_high"]), ("", ""), "{rate:?}");
    }
    assert!(told.contains("beta not known; ") && !told.contains("beta;"), "{told}");
    // Two recordings tell one.
    let (_, fits) = run(2);
    assert!(fits.iter().any(|fit| !fit["theta_low"].is_empty()), "{fits:?}");
}

/// Runs at one level tell no curve, and nothing is made up.
#[test]
fn one_level_is_no_curve() {
    let room = Room::suite();
    room.run(&format!("{FRAGILITY} {BASE} {ONE} --levels 6"))
        .has("no curve; all runs are at one level");
    for row in room.rows("out/fits.csv") {
        assert!(row["theta"].is_empty() && row["beta"].is_empty() && row["separable"] == "0");
    }
}

/// A hazard curve whose rate falls by a power k of the level: the rate of a lognormal fragility has a closed form,
/// lambda(theta) exp(k^2 beta^2/2), where the curve reaches far enough.
#[test]
fn a_rate_over_a_power_law() {
    let room = Room::suite();
    room.write("hazard.csv", "level,rate\n0.0001,1\n1,0.0001\n1000,0.0000001\n");
    let site = "--levels 1:16:12:log --hazard ./hazard.csv --target 0.00005 --estimator stripes";
    room.run(&format!("{FRAGILITY} {BASE} {ONE} {site}"));
    let (fits, rates) = (room.rows("out/fits.csv"), room.rows("out/rates.csv"));
    let mut shown = 0;
    for (fit, rate) in fits.iter().zip(&rates) {
        assert_eq!(fit["limit_state"], rate["limit_state"]);
        if fit["beta"].is_empty() {
            continue;
        }
        let (theta, beta) = (number(fit, "theta"), number(fit, "beta"));
        // Above the curve's last level all fail, and are told apart.
        let closed = 1.0e-4 / theta * (0.5 * beta * beta).exp() - 1.0e-7;
        assert_relative_eq!(number(rate, "missing_above"), 1.0e-7, max_relative = 1e-12);
        assert_relative_eq!(number(rate, "rate"), closed, max_relative = 1e-6);
        let fifty = 1.0 - (-50.0 * closed).exp();
        assert_relative_eq!(number(rate, "in_50_years"), fifty, max_relative = 1e-6);
        assert_eq!(rate["below_target"] == "1", closed + 1.0e-7 <= 5.0e-5, "{rate:?}");
        shown += 1;
    }
    assert!(shown > 0);
}

/// Of several estimators a run says which one to use, and prints its rates alone; `rates.csv` has all.
#[test]
fn one_of_several_estimators_is_the_one_to_use() {
    let room = Room::suite();
    room.write("site.csv", "PGA [m/s2],rate\n0.5,0.05\n4,0.0012\n30,1e-6\n");
    for (estimators, told) in [("stripes,ida", 1), ("ida,stripes", 1), ("stripes", 0)] {
        let site = "--levels 1:16:12:log --hazard ./site.csv --bootstrap 39";
        let line = format!("{FRAGILITY} {BASE} {ONE} {site} --estimator {estimators}");
        let said = room.run(&line).out;
        let first = estimators.split(',').next().unwrap();
        assert_eq!(said.matches(&format!("use {first}, which")).count(), told, "{said}");
        // Overturning and uplift.
        assert_eq!(said.matches("annual rate ").count(), 2, "{said}");
        assert!(said.contains(" motions overturn the block"), "{said}");
        let each = estimators.split(',').count();
        assert_eq!(room.rows("out/rates.csv").len(), 2 * each);
    }
}

/// A part of a hazard curve that begins at a strong motion leaves failures out. What it leaves out has a bound, which
/// counts against the target: no cell is below it by the part that is not by the whole.
#[test]
fn a_hazard_curve_that_begins_late_says_what_it_may_miss() {
    let room = Room::suite();
    // lambda = 1e-4/x, so that rates have closed forms (Cornell 1996), each end of a line on the curve.
    let rates = |levels: &[f64]| {
        let line = |level: &f64| format!("{level},{}\n", 1.0e-4 / level);
        room.write(
            "site.csv",
            format!("level,rate\n{}", levels.iter().map(line).collect::<String>()),
        );
        let site = "--levels 1:16:12:log --hazard ./site.csv --target 0.00002 --estimator stripes";
        room.run(&format!("{FRAGILITY} {BASE} {ONE} {site} --bootstrap 39"))
            .has("more above the curve's end, ");
        let head = room.heading("out/rates.csv");
        assert!(head.contains(",below_target,missing_below,"), "{head}");
        room.rows("out/rates.csv")
    };
    let whole = rates(&[1.0e-4, 1.0, 1.0e3]);
    let late = rates(&[6.0, 12.0, 1.0e3]);
    let mut shown = 0;
    for ((fit, whole), late) in room.rows("out/fits.csv").iter().zip(&whole).zip(&late) {
        if fit["beta"].is_empty() {
            continue;
        }
        let missing = number(late, "missing_below");
        let all = number(late, "rate") + missing;
        assert_relative_eq!(all, number(whole, "rate"), max_relative = 1e-6);
        assert!(missing > number(late, "rate") && number(whole, "missing_below") < 1.0e-9);
        let below = all + number(late, "missing_above") <= 2.0e-5;
        assert_eq!(late["below_target"] == "1", below, "{late:?}");
        assert_eq!(late["below_target"], whole["below_target"]);
        // Without what is missing it would be below the target.
        shown += u32::from(!below && number(late, "rate") + 1.0e-7 <= 2.0e-5);
    }
    assert!(shown > 0);
}

/// The shares by weight that the marks of a picture show are those that are fitted, and nothing is drawn over them.
#[test]
fn marks_are_shares_by_weight_above_all_bands() {
    let room = Room::suite();
    let weights = [8.0, 1.0, 1.0, 0.5];
    let column = [",weight".into()].into_iter().chain(weights.map(|weight| format!(",{weight}")));
    let list: Vec<String> = room
        .read("list.csv")
        .lines()
        .zip(column)
        .map(|(line, weight)| line.to_string() + &weight)
        .collect();
    room.write("list.csv", list.join("\n"));
    room.run(&format!("{FRAGILITY} {BASE} {ONE} --levels 1:16:12:log --estimator stripes"));
    let svg = room.read("out/fragility.svg");
    assert!(svg.contains("shares of the motions by weight"), "{svg}");
    let attribute = |line: &str, name: &str| -> f64 {
        let rest = line.split(&format!(" {name}=\"")).nth(1).unwrap_or_else(|| panic!("{line}"));
        rest.split('"').next().unwrap().parse().unwrap()
    };
    // Overturning has discs; from the first of them on there is no band and no line.
    let lines: Vec<&str> = svg.lines().collect();
    let first = lines.iter().position(|line| line.starts_with("<circle")).unwrap();
    let discs: Vec<&&str> = lines.iter().filter(|line| line.starts_with("<circle")).collect();
    // The last one is that of the legend, where the mark stands on its line.
    let (_, discs) = discs.split_last().unwrap();
    // Bands show through each other: none hides another.
    let is_band = |line: &&str| line.ends_with("Z\" fill=\"#b02020\" fill-opacity=\"0.18\"/>");
    let other_band = |line: &&str| line.ends_with("Z\" fill=\"#2c5fb8\" fill-opacity=\"0.18\"/>");
    let last_band = lines.iter().rposition(|line| is_band(line) || other_band(line));
    assert!(last_band.unwrap() < first, "a band lies above a mark");
    assert!(lines.iter().any(is_band) && lines.iter().any(other_band));
    // The curve is dashed up to the lowest level at which a motion fails, and whole from there on.
    let ends = |line: &str| -> [f64; 2] {
        let path = line.split(" d=\"").nth(1).unwrap().split('"').next().unwrap();
        let x = |point: &str| point.split([' ', ',']).next().unwrap().parse().unwrap();
        let points: Vec<f64> = path.split(['M', 'L']).skip(1).map(x).collect();
        [points[0], points[points.len() - 1]]
    };
    let red = lines.iter().find(|line| line.contains("stroke-dasharray")).unwrap();
    let colour = red.split("stroke=\"").nth(1).unwrap().split('"').next().unwrap();
    let curve = |dashed: bool| {
        let is_it = |line: &&&str| {
            line.starts_with("<path")
                && line.contains("fill=\"none\"")
                && line.contains(colour)
                && line.contains("dasharray") == dashed
        };
        ends(lines.iter().find(is_it).unwrap())
    };
    let standing = discs.iter().rfind(|disc| attribute(disc, "cy") == attribute(discs[0], "cy"));
    let failing = discs.iter().find(|disc| attribute(disc, "cy") < attribute(discs[0], "cy"));
    let [standing, failing] = [standing, failing].map(|disc| attribute(disc.unwrap(), "cx"));
    let ([_, dashed], [whole, _]) = (curve(true), curve(false));
    assert!(standing < dashed && (dashed - failing).abs() < 0.05 && (whole - failing).abs() < 0.05);
    let mut by_level: BTreeMap<String, [f64; 2]> = BTreeMap::new();
    for row in room.rows("out/runs.csv") {
        let of = MOTIONS.iter().position(|(name, ..)| *name == row["record"]).unwrap();
        let [all, failed] = by_level.entry(row["level"].clone()).or_default();
        *all += weights[of];
        *failed += if row["outcome"].starts_with("overturned") { weights[of] } else { 0.0 };
    }
    let mut shares: Vec<(f64, f64)> = by_level
        .iter()
        .map(|(level, [all, failed])| (level.parse().unwrap(), failed / all))
        .collect();
    shares.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert_eq!(discs.len(), shares.len());
    let heights: Vec<f64> = discs.iter().map(|disc| attribute(disc, "cy")).collect();
    let (top, bottom) = (
        heights.iter().copied().fold(f64::MAX, f64::min),
        heights.iter().copied().fold(0.0, f64::max),
    );
    assert!(shares[0].1 == 0.0 && shares[shares.len() - 1].1 == 1.0, "{shares:?}");
    for ((level, share), height) in shares.iter().zip(&heights) {
        let drawn = (bottom - height) / (bottom - top);
        assert!((drawn - share).abs() < 1.0e-3, "at {level} the share is {share}, drawn {drawn}");
    }
    let uneven = |(_, share): &&(f64, f64)| (4.0 * share).fract() > 0.01;
    assert!(shares.iter().filter(uneven).count() > 2, "{shares:?}");
}
