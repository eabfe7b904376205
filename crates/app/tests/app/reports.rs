//! Reports: what lies in a run's directory is in them, they stand alone, and nothing that is in the way is lost.

use std::fs;
use std::path::Path;

use crate::common::command::Command;
use tempfile::TempDir;

use super::common::refused;
use super::fragility::suite;

fn topple(place: &TempDir, arguments: &[&str]) -> crate::common::command::Assert {
    let mut command = Command::topple();
    command.current_dir(place.path()).args(arguments).assert()
}

/// A small map.
const MAP: &str = "pulse --object 1 --eccentricity 0.2 --t-h 1.75 --t-v 0.75 --omega 2:12:6 --a-h 1:12:6 --backend cpu --verify 8";

fn map(place: &TempDir, out: &str) {
    let arguments: Vec<&str> = MAP.split(' ').chain(["--out", out]).collect();
    topple(place, &arguments).success();
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap()
}

/// Along one axis the summary says where the block stands, rocks and overturns, by the rows of map.csv.
#[test]
fn along_one_axis_a_report_says_where_the_block_overturns() {
    let place = TempDir::new().unwrap();
    let line = "pulse --object 1 --isolation none --omega 9 --a-h 0.5:12:24 --backend cpu --verify none --out map";
    topple(&place, &line.split(' ').collect::<Vec<_>>()).success();
    topple(&place, &["report", "map", "--out", "report.html"]).success();
    let page = read(&place.path().join("report.html"));
    let table = read(&place.path().join("map/map.csv"));
    let of = |word: &str| -> Vec<f64> {
        let rows = table.lines().skip(1).filter(|row| row.contains(word));
        rows.map(|row| row.split(',').nth(1).unwrap().parse().unwrap()).collect()
    };
    for (word, said) in
        [("full_contact", "stays in full contact with its base"), ("overturned", "overturns")]
    {
        let at = of(word);
        let [least, most] = [at[0], at[at.len() - 1]];
        assert!(at.len() > 2);
        let wanted = format!("{said} from ");
        let text = page.find(&wanted).map(|from| &page[from..from + 200]);
        let ends = format!(
            "A<sub>h</sub> = {least} m/s² to A<sub>h</sub> = {most} m/s² ({} values)",
            at.len()
        );
        assert!(text.is_some_and(|text| text.contains(&ends)), "{wanted}{ends}: {text:?}");
    }
}

/// Values with one outcome that do not lie side by side are told apart; a table that is not the run's is refused.
#[test]
fn along_one_axis_stretches_are_told_apart() {
    let place = TempDir::new().unwrap();
    let line = "pulse --object 1 --isolation none --omega 5 --a-h=-8:8:33 --backend cpu --verify none --out map";
    topple(&place, &line.split(' ').collect::<Vec<_>>()).success();
    let report = ["report", "map", "--out", "report.html"];
    topple(&place, &report).success();
    let page = read(&place.path().join("report.html"));
    let from = page.find("Over the 33 values").unwrap();
    let told = &page[from..from + page[from..].find("</li>").unwrap()];
    assert_eq!(told.matches("overturns from").count(), 2, "{told}");
    let path = place.path().join("map/map.csv");
    let table = read(&path);
    for damaged in [
        table.lines().take(20).map(|line| format!("{line}\n")).collect::<String>(),
        table.replacen("overturned_left", "fell", 1),
    ] {
        assert_ne!(damaged, table);
        fs::write(&path, damaged).unwrap();
        let said = topple(&place, &report).code(2).get_output().stderr.clone();
        let said = String::from_utf8(said).unwrap();
        assert!(said.contains("map.csv: it has not the 33 values"), "{said}");
    }
}

#[test]
fn a_page_stands_alone_and_says_what_run_json_says() {
    let place = TempDir::new().unwrap();
    map(&place, "map");
    topple(&place, &["report", "map", "--out", "report.html"]).success();
    let page = read(&place.path().join("report.html"));
    let run: serde_json::Value =
        serde_json::from_str(&read(&place.path().join("map/run.json"))).unwrap();
    // Nothing is fetched and nothing runs.
    for word in ["http:", "https:", "<script", "<link", "@import", "url("] {
        assert!(!page.contains(word), "{word}");
    }
    for word in [
        "2 to 12 rad/s in 6 values",
        "@page",
        "The block and its base",
        "ε = 0.2",
        "the usual values: ψ = 0.25, ",
        "topple run map --out map-again",
    ] {
        assert!(page.contains(word), "{word}: {page}");
    }
    let (mut shares, cells) = (0, run["cells"].as_f64().unwrap());
    for (class, count) in run["outcomes"].as_object().unwrap() {
        let share = 100.0 * count.as_f64().unwrap() / cells;
        if share > 0.0 {
            shares += 1;
            assert!(page.contains(&format!("<td>{share:.1} %</td>")), "{class}: {share}");
        }
    }
    assert!(shares > 2);
    let sampled = run["verification"]["sampled"].as_u64().unwrap();
    assert!(page.contains(&format!("has repeated {sampled} of 36 calculations")), "{page}");
    // The block and the map.
    assert_eq!(page.matches("data:image/svg+xml;base64,").count(), 2);
}

#[test]
fn a_pdf_has_pages_and_the_same_runs_make_the_same_bytes() {
    let place = TempDir::new().unwrap();
    map(&place, "map");
    topple(&place, &["report", "map", "--out", "one.pdf"]).success();
    // The file stands for its directory.
    topple(&place, &["report", "map/run.json", "--out", "two.pdf"]).success();
    let bytes = fs::read(place.path().join("one.pdf")).unwrap();
    assert!(bytes.starts_with(b"%PDF-") && bytes.trim_ascii_end().ends_with(b"%%EOF"));
    let text = String::from_utf8_lossy(&bytes);
    assert!(text.contains("/Creator (topple report)"));
    assert!(text.matches("/Type /Page\n").count() >= 2);
    // The colours of the map's cells are an image; letters say what they are.
    assert!(text.contains("/Subtype /Image") && text.contains("/ToUnicode"));
    assert_eq!(bytes, fs::read(place.path().join("two.pdf")).unwrap());
}

#[test]
fn several_runs_of_several_kinds_are_one_report() {
    let (place, records) = suite();
    map(&place, "map");
    let statue =
        ["--object", "1", "--t-h", "1.2", "--t-v", "0.4", "--u-y", "0.01", "--backend", "cpu"];
    topple(&place, &["suite", &records, "--out", "suite"]).success();
    topple(
        &place,
        &[&["envelope", "--suite", &records, "--out", "envelope"][..], &statue].concat(),
    )
    .success();
    let levels = ["--levels", "1:9:4", "--out", "fragility"];
    topple(&place, &[&["fragility", "--suite", &records][..], &statue, &levels].concat()).success();
    let folders = ["map", "suite", "envelope", "fragility"];
    topple(&place, &[&["report"][..], &folders, &["--out", "report.html"]].concat()).success();
    let page = read(&place.path().join("report.html"));
    // The motions with their peaks, those of suite.csv.
    let suite = read(&place.path().join("suite/suite.csv"));
    let column = |name: &str| suite.lines().next().unwrap().split(',').position(|own| own == name);
    let peak = suite.lines().nth(1).unwrap().split(',').nth(column("pga_h").unwrap()).unwrap();
    let peak = topple::scene::record::rounded(peak.parse().unwrap(), 3);
    assert!(page.contains("horizontal peak, PGA [m/s²]"), "{page}");
    assert!(page.matches(&format!("<td>{peak}</td>")).count() >= 2, "{peak}");
    for kind in ["4 runs of topple", "(map)", "Suite (suite)", "(envelope)", "(fragility)"] {
        assert!(page.contains(kind), "{kind}");
    }
    // The suite is read again in the directory that its path is in, by the words of its command.
    let again = format!("\ntopple suite {records} --out suite</pre>");
    assert!(page.contains(&again), "{again}: {page}");
    // What fits.csv has is in the table: theta in three digits.
    let fits = read(&place.path().join("fragility/fits.csv"));
    let (head, row) = (fits.lines().next().unwrap(), fits.lines().nth(1).unwrap());
    let at = head.split(',').position(|name| name == "limit_state").unwrap();
    assert!(page.contains(&format!("<td>{}</td>", row.split(',').nth(at).unwrap())));
    let sha =
        serde_json::from_str::<serde_json::Value>(&read(&place.path().join("suite/run.json")))
            .unwrap();
    let record = sha["records"].as_object().unwrap().values().next().unwrap();
    assert!(page.contains(record["horizontal"]["sha256"].as_str().unwrap()));
}

#[test]
fn what_users_wrote_is_no_markup() {
    let place = TempDir::new().unwrap();
    map(&place, "map");
    let path = place.path().join("map/run.json");
    let text = read(&path).replace("Overturning spectral map", "<img src=x onerror=alert(1)>");
    fs::write(&path, text).unwrap();
    topple(&place, &["report", "map", "--out", "report.html"]).success();
    let page = read(&place.path().join("report.html"));
    assert!(!page.contains("<img src=x") && page.contains("&lt;img src=x onerror=alert(1)&gt;"));
}

#[test]
fn what_is_no_run_and_what_is_in_the_way_is_refused() {
    let place = TempDir::new().unwrap();
    map(&place, "map");
    let at = |name: &str| place.path().join(name);
    let (map, html) = (at("map").display().to_string(), at("report.html").display().to_string());
    let said = refused(&["report", "nowhere", "--out", &html]);
    assert!(said.contains("no results of topple"), "{said}");
    let table = at("map/map.csv").display().to_string();
    let said = refused(&["report", &table, "--out", &html]);
    assert!(said.contains("it is a file; give the directory"), "{said}");
    let text = at("report.txt").display().to_string();
    assert!(refused(&["report", &map, "--out", &text]).contains(".html or .pdf"));
    for (name, other) in [("report.html", "<html>mine</html>"), ("report.pdf", "%PDF-1.7 mine")] {
        fs::write(at(name), other).unwrap();
        let said = refused(&["report", &map, "--out", &at(name).display().to_string()]);
        assert!(said.contains("no report of topple"), "{said}");
        assert_eq!(read(&at(name)), other);
        fs::remove_file(at(name)).unwrap();
        // A report gives way to the next.
        for _ in 0..2 {
            topple(&place, &["report", "map", "--out", name]).success();
        }
    }
    fs::remove_file(at("report.html")).unwrap();
    fs::remove_file(at("map/map.svg")).unwrap();
    let said = refused(&["report", &map, "--out", &html]);
    assert!(said.contains("map.svg") && said.contains("it is not there"), "{said}");
    let run = read(&at("map/run.json"));
    fs::write(at("map/run.json"), run.replace("\"map.svg\"", "\"../map.svg\"")).unwrap();
    assert!(refused(&["report", &map, "--out", &html]).contains("no file beside it"));
    assert!(!at("report.html").exists());
}

#[test]
fn a_report_has_the_title_that_is_asked_for_and_what_its_runs_warned_of() {
    let place = TempDir::new().unwrap();
    // The pulse of 0.5 rad/s lasts longer than the run.
    let line = MAP.replace("2:12:6", "0.5:12:6");
    let arguments: Vec<&str> = line.split(' ').chain(["--t-max", "5", "--out", "map"]).collect();
    topple(&place, &arguments).success();
    let json = read(&place.path().join("map/run.json"));
    let run: serde_json::Value = serde_json::from_str(&json).unwrap();
    let (warning, date) = (run["warnings"][0].as_str().unwrap(), run["date"].as_str().unwrap());
    assert!(warning.contains("but its run ends at 5 s"), "{warning}");
    let written = fs::metadata(place.path().join("map/run.json")).unwrap().modified().unwrap();
    let seconds = written.duration_since(std::time::UNIX_EPOCH).unwrap().as_secs();
    // Of the day the seconds are those of the clock, a few apart.
    let of_day: Vec<u64> = date[11..19].split(':').map(|part| part.parse().unwrap()).collect();
    let told = 3600 * of_day[0] + 60 * of_day[1] + of_day[2];
    assert!((seconds % 86_400).abs_diff(told) < 60, "{date} {seconds}");
    for name in ["report.html", "report.pdf"] {
        topple(&place, &["report", "map", "--title", "For the council & others", "--out", name])
            .success();
    }
    let page = read(&place.path().join("report.html"));
    let title = "For the council &amp; others";
    assert!(page.contains(&format!("<title>{title}</title>")), "{page}");
    assert!(page.contains(&format!("<h1>{title}</h1>")), "{page}");
    assert!(
        page.contains("The runs warned:") && page.contains("but its run ends at 5 s"),
        "{page}"
    );
    assert!(page.contains(&format!(", {} at {} UTC, results in", &date[..10], &date[11..16])));
    let pdf = fs::read(place.path().join("report.pdf")).unwrap();
    assert!(String::from_utf8_lossy(&pdf).contains("For the council & others"));
    let (map, html) = (place.path().join("map"), place.path().join("other.html"));
    let [map, html] = [map, html].map(|path| path.display().to_string());
    let said = refused(&["report", &map, "--title", "", "--out", &html]);
    assert!(said.contains("must be one line of text"), "{said}");
}

/// Devices stand beside each other, with names in words; what none of them has is left out, and a file that two runs read is
/// told once.
#[test]
fn devices_stand_beside_each_other_and_a_file_is_told_once() {
    let (place, records) = suite();
    let list = "device,isolation,radius,mu\nfloor,none,,\npendulum,horizontal,1.5,0.06\n";
    fs::write(place.path().join("devices.csv"), list).unwrap();
    let statue = ["--object", "1", "--backend", "cpu", "--both-directions", "--scales", "1,2"];
    let compare = ["compare", "devices.csv", "--suite", &records, "--out", "compared"];
    topple(&place, &[&compare[..], &statue].concat()).success();
    topple(&place, &["suite", &records, "--out", "suite"]).success();
    topple(&place, &["report", "compared", "suite", "--out", "report.html"]).success();
    let page = read(&place.path().join("report.html"));
    assert!(page.contains("<th>device</th><th>floor</th><th>pendulum</th>"), "{page}");
    assert!(page.contains("exceeds a limit at so many times the motions"), "{page}");
    assert!(!page.contains("fails_at") && !page.contains("vertical stroke"), "{page}");
    let run: serde_json::Value =
        serde_json::from_str(&read(&place.path().join("suite/run.json"))).unwrap();
    for record in run["records"].as_object().unwrap().values() {
        let hash = record["horizontal"]["sha256"].as_str().unwrap();
        assert_eq!(page.matches(hash).count(), 1, "{hash}");
    }
}

/// A summary comes first; the site's hazard and the accepted rate are shown, and the estimator is that of the run.
#[test]
fn a_fragility_begins_in_short_and_shows_its_hazard() {
    let (place, records) = suite();
    fs::write(place.path().join("site.csv"), "PGA [m/s2],rate\n0.5,0.05\n4,0.0012\n16,1e-5\n")
        .unwrap();
    let statue =
        ["--object", "1", "--t-h", "1.2", "--t-v", "0.4", "--u-y", "0.01", "--backend", "cpu"];
    let rate = ["--levels", "1:40:9:log", "--hazard", "site.csv", "--target", "0.0004"];
    for by in ["stripes", "ida"] {
        let by = ["--estimator", by, "--out", by];
        topple(&place, &[&["fragility", "--suite", &records][..], &statue, &rate, &by].concat())
            .success();
        let name = format!("{}.html", by[1]);
        topple(&place, &["report", by[1], "--out", &name]).success();
        let page = read(&place.path().join(&name));
        let at = |text: &str| page.find(text).unwrap_or_else(|| panic!("{text}: {page}"));
        assert!(at("<h2>In short</h2>") < at("<h2>What was asked</h2>"));
        // Three digits of what the tables have, in the summary and in the tables of the report.
        let of = |file: &str, column: &str| {
            let table = read(&place.path().join(by[1]).join(file));
            let head = table.lines().next().unwrap().split(',').position(|own| own == column);
            let row = table.lines().nth(1).unwrap();
            assert!(row.contains("overturning"), "{row}");
            let value = row.split(',').nth(head.unwrap()).unwrap().parse().unwrap();
            topple::scene::record::rounded(value, 3)
        };
        let (theta, rate) = (of("fits.csv", "theta"), of("rates.csv", "rate"));
        at(&format!("overturn the block at PGA = {theta} m/s² (95 %: "));
        at(&format!("it overturns {rate} times a year"));
        for cell in [theta, rate] {
            at(&format!("<td>{cell}</td>"));
        }
        let keeps = of("rates.csv", "below_target") == 1.0;
        at(match (keeps, of("rates.csv", "rate_high") <= 0.0004, rate > 0.0004) {
            (true, true, _) => {
                "This keeps the accepted rate, 0.0004 a year, and so does the upper end"
            }
            (true, false, _) => "This keeps the accepted rate, 0.0004 a year, but the upper end",
            (false, _, true) => "This exceeds the accepted rate, 0.0004 a year.",
            (false, ..) => "this may exceed the accepted rate, 0.0004 a year.",
        });
        at("<th>keeps the accepted rate, 0.0004 a year</th>");
        at("The hazard of the site, site.csv");
        at("How it was read: levels in m/s2; annual rates `rate` of `PGA [m/s2]`.");
        // The block, the hazard and the curves.
        assert_eq!(page.matches("data:image/svg+xml;base64,").count(), 3);
        let json = read(&place.path().join(by[1]).join("run.json"));
        let run: serde_json::Value = serde_json::from_str(&json).unwrap();
        let curve = serde_json::json!([[0.5, 0.05], [4.0, 0.0012], [16.0, 0.00001]]);
        assert_eq!(run["hazard_curve"], curve);
    }
}

#[test]
fn a_report_counts_the_motions_whose_baseline_was_changed() {
    let (place, records) = suite();
    for (out, baseline, is_told) in [("plain", "none", false), ("line", "line", true)] {
        let line = format!(
            "envelope --object 1 --t-h 1.2 --t-v 0.4 --u-y 0.01 --backend cpu --verify none --baseline {baseline} --out {out}"
        );
        let arguments = line.split(' ').chain(["--suite", &records]);
        topple(&place, &arguments.collect::<Vec<_>>()).success();
        topple(&place, &["report", out, "--out", "report.html"]).success();
        let page = read(&place.path().join("report.html"));
        assert_eq!(page.contains("a straight line was subtracted"), is_told, "{page}");
        fs::remove_file(place.path().join("report.html")).unwrap();
    }
}

/// Both commands name a motion once, and say that it is taken in both directions.
#[test]
fn a_motion_in_both_directions_is_named_once_by_every_command() {
    let (place, records) = suite();
    fs::write(place.path().join("devices.csv"), "device,isolation\nfloor,none\n").unwrap();
    let common =
        ["--suite", &records, "--object", "1", "--eccentricity", "0.2", "--backend", "cpu"];
    let common = [&common[..], &["--both-directions", "--verify", "none"]].concat();
    let base = ["--t-h", "1.2", "--t-v", "0.4", "--u-y", "0.01"];
    topple(&place, &[&["compare", "devices.csv", "--out", "compare"][..], &common].concat())
        .success();
    for command in [&["fragility", "--levels", "2,4"][..], &["envelope"]] {
        let out = ["--out", command[0]];
        topple(&place, &[command, &common, &base, &out].concat()).success();
    }
    for name in ["compare", "fragility", "envelope"] {
        let json = read(&place.path().join(name).join("run.json"));
        let run: serde_json::Value = serde_json::from_str(&json).unwrap();
        let ids = read(Path::new(&records));
        let ids: Vec<&str> =
            ids.lines().skip(1).map(|line| line.split(',').next().unwrap()).collect();
        assert_eq!(
            (&run["motions"], &run["both_directions"]),
            (&serde_json::json!(ids), &true.into())
        );
        topple(&place, &["report", name, "--out", "report.html"]).success();
        let page = read(&place.path().join("report.html"));
        let all = format!("as it is and reversed: {} motions in all", 2 * ids.len());
        assert!(page.contains(&all), "{name}: {page}");
    }
}

#[test]
fn fits_are_told_with_why_they_are_open_and_motions_in_both_directions() {
    let (place, records) = suite();
    let statue =
        ["--object", "1", "--t-h", "1.2", "--t-v", "0.4", "--u-y", "0.01", "--backend", "cpu"];
    let levels = ["--levels", "0.5,1", "--both-directions", "--out", "low"];
    topple(&place, &[&["fragility", "--suite", &records][..], &statue, &levels].concat()).success();
    topple(&place, &["report", "low", "--out", "report.html"]).success();
    let page = read(&place.path().join("report.html"));
    let count = read(Path::new(&records)).lines().count() - 1;
    assert!(page.contains(&format!("{count} motions of the suite")), "{page}");
    assert!(page.contains("Each is taken in both directions"), "{page}");
    assert!(page.contains("overturning: no run fails up to the highest level, 1"), "{page}");
    assert!(page.contains("–: the motions tell no curve"), "{page}");
    // A median that is known about is told so.
    let path = place.path().join("low/fits.csv");
    let fits = read(&path);
    let head: Vec<&str> = fits.lines().next().unwrap().split(',').collect();
    let open = head.iter().map(|name| match *name {
        "limit_state" => "overturning",
        "estimator" => "stripes",
        "theta" => "3.25",
        "theta_low" => "2.5",
        _ => "",
    });
    let open = open.collect::<Vec<_>>().join(",");
    fs::write(&path, format!("{}\n{open}\n", head.join(","))).unwrap();
    topple(&place, &["report", "low", "--out", "report.html"]).success();
    let page = read(&place.path().join("report.html"));
    assert!(page.contains("<td>about 3.25</td><td>2.5</td>"), "{page}");
    assert!(page.contains("<td>not known</td>") && page.contains("About: at most one level"));
}

#[test]
fn what_no_command_repeats_is_said() {
    let place = TempDir::new().unwrap();
    let record =
        "seismic --object 1 --t-h 0.5:4:3 --t-v 0.02:2:3 --backend cpu --verify none --out record";
    topple(&place, &record.split(' ').collect::<Vec<_>>()).success();
    let report = || {
        topple(&place, &["report", "record", "--out", "report.html"]).success();
        read(&place.path().join("report.html"))
    };
    assert!(report().contains("topple run record --out record-again"));
    let path = place.path().join("record/run.json");
    let mut run: serde_json::Value = serde_json::from_str(&read(&path)).unwrap();
    run["record"] = serde_json::Value::Null;
    fs::write(&path, run.to_string()).unwrap();
    let page = report();
    assert!(
        page.contains("No command repeats it: its run.json does not say where its record lies")
    );
    assert!(!page.contains("topple run record"), "{page}");
    // So it is: the command says the same.
    let said = refused(&["run", &path.display().to_string()]);
    assert!(said.contains("it does not say where its record lies"), "{said}");
}

/// Pictures that are narrow lie beside each other: of a map of many slices a page has four.
#[test]
fn many_pictures_take_few_pages() {
    let place = TempDir::new().unwrap();
    let slices = MAP.replace("--t-v 0.75", "--t-v 0.3:1:20");
    let arguments: Vec<&str> = slices.split(' ').chain(["--out", "slices"]).collect();
    topple(&place, &arguments).success();
    topple(&place, &["report", "slices", "--out", "report.pdf"]).success();
    let pdf = fs::read(place.path().join("report.pdf")).unwrap();
    let pages = String::from_utf8_lossy(&pdf).matches("/Type /Page\n").count();
    // Five pages of pictures, and what stands before and after.
    assert!((6..=9).contains(&pages), "{pages}");
    let more = MAP.replace("--t-v 0.75", "--t-v 0.3:1:25").replace("2:12:6", "2:12:3");
    let arguments: Vec<&str> = more.split(' ').chain(["--out", "more"]).collect();
    topple(&place, &arguments).success();
    topple(&place, &["report", "more", "--out", "report.html"]).success();
    assert!(read(&place.path().join("report.html")).contains("The run has no picture"));
}

/// Columns that were asked for have names in words, as the others do.
#[test]
fn a_report_of_devices_has_no_raw_names() {
    let (place, records) = suite();
    fs::write(
        place.path().join("devices.csv"),
        "device,isolation,radius,mu\nfloor,none,,\nfps,horizontal,1,0.06\n",
    )
    .unwrap();
    fs::write(place.path().join("site.csv"), "PGA [m/s2],rate\n0.5,0.05\n4,0.0012\n16,1e-5\n")
        .unwrap();
    let line = format!(
        "compare devices.csv --object 1 --suite {records} --backend cpu --verify none --columns all --scales 0.5,2 \
         --hazard site.csv --levels 1:16:8:log --out compared"
    );
    topple(&place, &line.split(' ').collect::<Vec<_>>()).success();
    topple(&place, &["report", "compared", "--out", "report.html"]).success();
    let page = read(&place.path().join("report.html"));
    let table = read(&place.path().join("compared/compare.csv"));
    let heading = table.lines().next().unwrap();
    assert!(
        heading.contains("friction_demand_84") && heading.contains("rate_with_missing"),
        "{heading}"
    );
    for name in heading.split(',').filter(|name| name.contains('_')) {
        assert!(!page.contains(&format!("<td>{name}</td>")), "{name}");
    }
    assert!(
        page.contains(
            "<td>largest |φ| divided by the critical angle of its side, not exceeded under 84 % of these motions</td>"
        ),
        "{page}"
    );
    let missing =
        "overturnings a year, with what may be missing beyond both ends of the hazard curve";
    assert!(
        page.contains(&format!("<td>{missing}</td>")) && !page.contains("a year at most"),
        "{page}"
    );
}

/// A run's own title is its heading, and that of its report where it is alone.
#[test]
fn the_title_of_a_run_is_its_heading() {
    let (place, records) = suite();
    let statue = "--object 1 --t-h 1.2 --t-v 0.4 --u-y 0.01 --backend cpu --verify none";
    let title = ["--title", "The statue, base 2"];
    for (name, words) in [
        ("map", MAP.to_string()),
        (
            "history",
            "history --object 1 --t-h 1.2 --t-v 0.4 --omega 4 --a-h 2 --backend cpu".into(),
        ),
        ("envelope", format!("envelope --suite {records} {statue}")),
        ("fragility", format!("fragility --levels 2,8 --suite {records} {statue}")),
        ("suite", format!("suite {records}")),
    ] {
        let words: Vec<&str> = words.split(' ').chain(title).chain(["--out", name]).collect();
        topple(&place, &words).success();
        topple(&place, &["report", name, "--out", "report.html"]).success();
        let page = read(&place.path().join("report.html"));
        assert!(page.contains("<h1>The statue, base 2</h1>"), "{name}: {page}");
    }
    topple(&place, &["report", "map", "fragility", "--title", "All of it", "--out", "report.html"])
        .success();
    let page = read(&place.path().join("report.html"));
    assert!(page.contains("<h1>All of it</h1>"), "{page}");
    assert!(page.contains("<h3>The statue, base 2 (fragility)</h3>"), "{page}");
}

/// An envelope's summary names the best base; that of a motion says where the contact force is tensile.
#[test]
fn a_summary_names_the_best_base_and_tensile_contact() {
    let (place, records) = suite();
    let line = format!(
        "envelope --object 1 --eccentricity 0.2 --u-y 0.01 --t-h 0.5:5:14 --t-v 0.1:1:6 --scale 0.7 --suite {records} --limit-u 0.75 \
         --limit-v 0.03 --backend cpu --verify none --out envelope"
    );
    topple(&place, &line.split(' ').collect::<Vec<_>>()).success();
    let short = |run: &str| {
        topple(&place, &["report", run, "--out", "report.html"]).success();
        let page = read(&place.path().join("report.html"));
        let short = page.split("<h2>What was asked</h2>").next().unwrap();
        short.replace("<sub>", "_").replace("</sub>", "")
    };
    let page = short("envelope");
    let json: serde_json::Value =
        serde_json::from_str(&read(&place.path().join("envelope/run.json"))).unwrap();
    let table = read(&place.path().join("envelope/envelope.csv"));
    let head: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    let best = json["best_cell"].as_u64().unwrap() as usize;
    let row: Vec<&str> = table.lines().nth(best + 1).unwrap().split(',').collect();
    let of = |column: &str| {
        let value = row[head.iter().position(|own| *own == column).unwrap()].parse().unwrap();
        topple::scene::record::rounded(value, 3)
    };
    for wanted in [
        format!("has T_h = {} s, T_v = {} s", of("t_h"), of("t_v")),
        format!(
            "horizontally by up to {} m, its vertical stroke is up to {} m",
            of("max_u_100"),
            of("stroke_v_100")
        ),
        format!("Its reserve is {} steps of the map", of("reserve")),
    ] {
        assert!(page.contains(&wanted), "{wanted}: {page}");
    }
    let pulse = "--half-width 0.6 --height 0.2 --mass 900 --isolation none --omega 10 --a-h 4 --t-max 4 --force --backend cpu";
    for (a_v, pulls) in [("30", true), ("0", false)] {
        for command in ["history", "pulse"] {
            let words = pulse.split(' ').chain(["--a-v", a_v, "--out", command]);
            topple(&place, &std::iter::once(command).chain(words).collect::<Vec<_>>()).success();
            assert_eq!(
                short(command).contains("The contact force becomes tensile"),
                pulls,
                "{command} {a_v}"
            );
        }
    }
}

/// A report counts motions, not the lines of a list, and names the lines that have none.
#[test]
fn a_report_counts_motions_and_names_lines_without_one() {
    let (place, list) = suite();
    let mut text = read(Path::new(&list));
    text += "gone,gone.txt,gone_v.txt,0.02,m/s2\nlost,lost.txt,,0.02,m/s2\n";
    fs::write(&list, text).unwrap();
    topple(&place, &["suite", "list.csv", "--out", "suite"]).success();
    topple(&place, &["report", "suite", "--out", "report.html"]).success();
    let page = read(&place.path().join("report.html"));
    for part in [
        "Found: 4 motions of 4 recordings, with horizontal peaks from",
        "2 lines of the suite have no motion.",
        "Motions of the suite: 4.",
        "gone is left out: ",
    ] {
        assert!(page.contains(part), "{part}");
    }
    // The table of motions has them alone.
    assert!(!page.contains("<td>gone</td>") && page.contains("<td>a</td>"));
    let base = ["--object", "1", "--u-y", "0.01", "--t-h", "1", "--t-v", "0.5", "--verify", "none"];
    let envelope = ["envelope", "--suite", "list.csv", "--out", "envelope"];
    topple(&place, &[&envelope[..], &base].concat()).success();
    topple(&place, &["report", "envelope", "--out", "report.html"]).success();
    let page = read(&place.path().join("report.html"));
    assert!(
        page.contains("4 motions of the suite list.csv")
            && page.contains("2 lines of it have no motion.")
    );
}

/// What a run did not take as known is not called fixed.
#[test]
fn numbers_that_vary_are_not_fixed() {
    let (place, _) = suite();
    let block = "--half-width 0.3 --height 1 --isolation none --verify none --backend cpu";
    let vary = "--vary height=uniform(0.6,1.3) --samples 2";
    let runs = [
        format!("fragility {block} {vary} --suite list.csv --levels 1:20:6:log --out run"),
        format!("envelope {block} {vary} --suite list.csv --out run"),
        format!("pulse {block} {vary} --omega 2:8:3 --a-h 1:8:3 --out run"),
    ];
    for line in runs {
        topple(&place, &line.split(' ').collect::<Vec<_>>()).success();
        topple(&place, &["report", "run", "--out", "report.html"]).success();
        let page = read(&place.path().join("report.html"));
        assert!(page.contains("Not known exactly: H, uniform from 0.6 to 1.3 m."), "{line}");
        let from = page.find("Fixed: ").unwrap();
        let fixed = &page[from..from + page[from..].find("</li>").unwrap()];
        assert!(fixed.contains("B = 0.3 m") && !fixed.contains("H = "), "{line}: {fixed}");
        assert!(page.contains("drawn with one of the values: H."), "{line}");
        // Nor does a picture of the run say it.
        if line.starts_with("fragility") {
            assert!(!read(&place.path().join("run/fragility.svg")).contains("H = 1 m"), "{line}");
        }
        fs::remove_dir_all(place.path().join("run")).unwrap();
    }
}
