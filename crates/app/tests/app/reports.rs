//! Reports: what lies in a run's directory is in them, they stand alone, and nothing that is in the way is lost.

use std::fs;

use crate::common::room::{Room, Row, number};
use topple::scene::record::rounded;

/// A small map.
const MAP: &str = "pulse --object 1 --eccentricity 0.2 --t-h 1.75 --t-v 0.75 --omega 2:12:6 --a-h 1:12:6 --backend cpu --verify 8";
const STATUE: &str =
    "--suite ./list.csv --object 1 --t-h 1.2 --t-v 0.4 --u-y 0.01 --backend cpu --verify none";
const SITE: &str = "PGA [m/s2],rate\n0.5,0.05\n4,0.0012\n16,1e-5\n";

fn map(room: &Room) {
    room.run(&format!("{MAP} --out ./map"));
}

/// The page of some runs, with `./` for the room.
#[track_caller]
fn page(room: &Room, runs: &str) -> String {
    let runs: String = runs.split(' ').map(|run| format!(" ./{run}")).collect();
    room.run(&format!("report{runs} --out ./report.html"));
    room.read("report.html").replace(&format!("{}/", room.path().display()), "./")
}

/// Holds a page to texts.
#[track_caller]
fn says(page: &str, texts: &[&str]) {
    for text in texts {
        assert!(page.contains(text), "no '{text}' in: {page}");
    }
}

/// What stands in a page from a text to an end.
#[track_caller]
fn piece<'a>(page: &'a str, from: &str, to: &str) -> &'a str {
    let from = page.find(from).unwrap_or_else(|| panic!("no '{from}' in: {page}"));
    &page[from..from + page[from..].find(to).unwrap()]
}

/// Along one axis the summary says where the block stands, rocks and overturns, by the rows of map.csv.
#[test]
fn along_one_axis_a_report_says_where_the_block_overturns() {
    let room = Room::new();
    let cell = "--object 1 --isolation none --omega 9 --a-h 0.5:12:24";
    room.run(&format!("pulse {cell} --backend cpu --verify none --out ./map"));
    let page = page(&room, "map");
    let rows = room.rows("map/map.csv");
    for (outcome, said) in
        [("full_contact", "stays in full contact with its base"), ("overturned", "overturns")]
    {
        let own = |row: &&Row| row["outcome"].starts_with(outcome);
        let at: Vec<f64> = rows.iter().filter(own).map(|row| number(row, "a_h")).collect();
        let [least, _, .., most] = at[..] else { panic!("{at:?}") };
        let count = at.len();
        let text = piece(&page, &format!("{said} from "), "</li>");
        let ends =
            format!("A<sub>h</sub> = {least} m/s² to A<sub>h</sub> = {most} m/s² ({count} values)");
        assert!(text.contains(&ends), "{ends}: {text}");
    }
}

/// Values with one outcome that do not lie side by side are told apart; a table that is not the run's is refused.
#[test]
fn along_one_axis_stretches_are_told_apart() {
    let room = Room::new();
    let cell = "--object 1 --isolation none --omega 5 --a-h=-8:8:33";
    room.run(&format!("pulse {cell} --backend cpu --verify none --out ./map"));
    let page = page(&room, "map");
    let told = piece(&page, "Over the 33 values", "</li>");
    assert_eq!(told.matches("overturns from").count(), 2, "{told}");
    let table = room.read("map/map.csv");
    for damaged in [
        table.lines().take(20).map(|line| format!("{line}\n")).collect::<String>(),
        table.replacen("overturned_left", "fell", 1),
    ] {
        assert_ne!(damaged, table);
        room.write("map/map.csv", damaged);
        let said = "map.csv: it has not the 33 values";
        room.refuses("report ./map --out ./report.html", &[said]);
    }
}

#[test]
fn a_page_stands_alone_and_says_what_run_json_says() {
    let room = Room::new();
    map(&room);
    let page = page(&room, "map");
    let run = room.json("map");
    // Nothing is fetched and nothing runs.
    for word in ["http:", "https:", "<script", "<link", "@import", "url("] {
        assert!(!page.contains(word), "{word}");
    }
    let sampled = run["verification"]["sampled"].as_u64().unwrap();
    says(
        &page,
        &[
            "2 to 12 rad/s in 6 values",
            "@page",
            "The block and its base",
            "ε = 0.2",
            "the usual values: ψ = 0.25, ",
            "topple run ./map --out map-again",
            &format!("has repeated {sampled} of 36 calculations"),
        ],
    );
    let counts = run["outcomes"].as_object().unwrap().values();
    let shares = counts.map(|count| 100.0 * count.as_f64().unwrap() / 36.0);
    let shares: Vec<f64> = shares.filter(|share| *share > 0.0).collect();
    shares.iter().for_each(|share| says(&page, &[&format!("<td>{share:.1} %</td>")]));
    assert!(shares.len() > 2);
    // The block and the map.
    assert_eq!(page.matches("data:image/svg+xml;base64,").count(), 2);
}

#[test]
fn a_pdf_has_pages_and_the_same_runs_make_the_same_bytes() {
    let room = Room::new();
    map(&room);
    room.run("report ./map --out ./one.pdf");
    // The file stands for its directory.
    room.run("report ./map/run.json --out ./two.pdf");
    let bytes = room.bytes("one.pdf");
    assert!(bytes.starts_with(b"%PDF-") && bytes.trim_ascii_end().ends_with(b"%%EOF"));
    let text = String::from_utf8_lossy(&bytes);
    assert!(text.matches("/Type /Page\n").count() >= 2);
    // The colours of the map's cells are an image; letters say what they are.
    says(&text, &["/Creator (topple report)", "/Subtype /Image", "/ToUnicode"]);
    assert_eq!(bytes, room.bytes("two.pdf"));
}

#[test]
fn several_runs_of_several_kinds_are_one_report() {
    let room = Room::suite();
    map(&room);
    room.run("suite ./list.csv --out ./suite");
    room.run(&format!("envelope {STATUE} --out ./envelope"));
    room.run(&format!("fragility {STATUE} --levels 1:9:4 --out ./fragility"));
    let page = page(&room, "map suite envelope fragility");
    // The motions with their peaks, those of suite.csv.
    let peak = rounded(number(&room.rows("suite/suite.csv")[0], "pga_h"), 3);
    assert!(page.matches(&format!("<td>{peak}</td>")).count() >= 2, "{peak}");
    let record =
        room.json("suite")["records"].as_object().unwrap().values().next().unwrap().clone();
    says(
        &page,
        &[
            "horizontal peak, PGA [m/s²]",
            "4 runs of topple",
            "(map)",
            "Suite (suite)",
            "(envelope)",
            "(fragility)",
            // The suite is read again in the directory that its path is in, by the words of its command.
            "\ntopple suite ./list.csv --out ./suite</pre>",
            // What fits.csv has is in the table.
            &format!("<td>{}</td>", room.rows("fragility/fits.csv")[0]["limit_state"]),
            record["horizontal"]["sha256"].as_str().unwrap(),
        ],
    );
}

#[test]
fn what_users_wrote_is_no_markup() {
    let room = Room::new();
    map(&room);
    let run = room.read("map/run.json");
    let run = run.replace("Overturning spectral map", "<img src=x onerror=alert(1)>");
    room.write("map/run.json", run);
    let page = page(&room, "map");
    assert!(!page.contains("<img src=x") && page.contains("&lt;img src=x onerror=alert(1)&gt;"));
}

#[test]
fn what_is_no_run_and_what_is_in_the_way_is_refused() {
    let room = Room::new();
    map(&room);
    for (words, said) in [
        ("./nowhere --out ./report.html", "no results of topple"),
        ("./map/map.csv --out ./report.html", "it is a file; give the directory"),
        ("./map --out ./report.txt", ".html or .pdf"),
        ("./map --title '' --out ./report.html", "must be one line of text"),
    ] {
        room.refuses(&format!("report {words}"), &[said]);
    }
    for (name, other) in [("report.html", "<html>mine</html>"), ("report.pdf", "%PDF-1.7 mine")] {
        let line = format!("report ./map --out ./{name}");
        room.write(name, other);
        room.refuses(&line, &["no report of topple"]);
        assert_eq!(room.read(name), other);
        room.remove(name);
        // A report gives way to the next.
        room.run(&line);
        room.run(&line);
    }
    room.remove("report.html");
    room.remove("map/map.svg");
    room.refuses("report ./map --out ./report.html", &["map.svg", "it is not there"]);
    let run = room.read("map/run.json").replace("\"map.svg\"", "\"../map.svg\"");
    room.write("map/run.json", run);
    room.refuses("report ./map --out ./report.html", &["no file beside it"]);
    assert!(!room.has("report.html"));
}

#[test]
fn a_report_has_the_title_that_is_asked_for_and_what_its_runs_warned_of() {
    let room = Room::new();
    // The pulse of 0.5 rad/s lasts longer than the run.
    room.run(&format!("{} --t-max 5 --out ./map", MAP.replace("2:12:6", "0.5:12:6")));
    let run = room.json("map");
    let (warning, date) = (run["warnings"][0].as_str().unwrap(), run["date"].as_str().unwrap());
    assert!(warning.contains("but its run ends at 5 s"), "{warning}");
    let written = fs::metadata(room.at("map/run.json")).unwrap().modified().unwrap();
    let seconds = written.duration_since(std::time::UNIX_EPOCH).unwrap().as_secs();
    // Of the day the seconds are those of the clock, a few apart.
    let of_day: Vec<u64> = date[11..19].split(':').map(|part| part.parse().unwrap()).collect();
    let told = 3600 * of_day[0] + 60 * of_day[1] + of_day[2];
    assert!((seconds % 86_400).abs_diff(told) < 60, "{date} {seconds}");
    for name in ["report.html", "report.pdf"] {
        room.run(&format!("report ./map --title 'For the council & others' --out ./{name}"));
    }
    says(
        &room.read("report.html"),
        &[
            "<title>For the council &amp; others</title>",
            "<h1>For the council &amp; others</h1>",
            "The runs warned:",
            "but its run ends at 5 s",
            &format!(", {} at {} UTC, results in", &date[..10], &date[11..16]),
        ],
    );
    let pdf = room.bytes("report.pdf");
    assert!(String::from_utf8_lossy(&pdf).contains("For the council & others"));
}

/// Devices stand beside each other, with names in words; what none of them has is left out, and a file that two runs read is
/// told once.
#[test]
fn devices_stand_beside_each_other_and_a_file_is_told_once() {
    let room = Room::suite();
    let list = "device,isolation,radius,mu\nfloor,none,,\npendulum,horizontal,1.5,0.06\n";
    room.write("devices.csv", list);
    let statue = "--object 1 --backend cpu --both-directions --scales 1,2";
    room.run(&format!("compare ./devices.csv --suite ./list.csv {statue} --out ./compared"));
    room.run("suite ./list.csv --out ./suite");
    let page = page(&room, "compared suite");
    says(&page, &["<th>device</th><th>floor</th><th>pendulum</th>"]);
    says(&page, &["exceeds a limit at so many times the motions"]);
    assert!(!page.contains("fails_at") && !page.contains("vertical stroke"), "{page}");
    for record in room.json("suite")["records"].as_object().unwrap().values() {
        let hash = record["horizontal"]["sha256"].as_str().unwrap();
        assert_eq!(page.matches(hash).count(), 1, "{hash}");
    }
}

/// A summary comes first; the site's hazard and the accepted rate are shown, and the estimator is that of the run.
#[test]
fn a_fragility_begins_in_short_and_shows_its_hazard() {
    let room = Room::suite();
    room.write("site.csv", SITE);
    for by in ["stripes", "ida"] {
        let rate = "--levels 1:40:9:log --hazard ./site.csv --target 0.0004";
        room.run(&format!("fragility {STATUE} {rate} --estimator {by} --out ./{by}"));
        let page = page(&room, by);
        let at = |text: &str| page.find(text).unwrap_or_else(|| panic!("{text}: {page}"));
        assert!(at("<h2>In short</h2>") < at("<h2>What was asked</h2>"));
        // Three digits of what the tables have, in the summary and in the tables of the report.
        let of = |file: &str, column: &str| {
            let row = room.rows(&format!("{by}/{file}")).remove(0);
            assert_eq!(row["limit_state"], "overturning");
            rounded(number(&row, column), 3)
        };
        let (theta, rate) = (of("fits.csv", "theta"), of("rates.csv", "rate"));
        let (keeps, high) = (of("rates.csv", "below_target"), of("rates.csv", "rate_high"));
        says(
            &page,
            &[
                &format!("overturn the block at PGA = {theta} m/s² (95 %: "),
                &format!("it overturns {rate} times a year"),
                &format!("<td>{theta}</td>"),
                &format!("<td>{rate}</td>"),
                match (keeps == 1.0, high <= 0.0004, rate > 0.0004) {
                    (true, true, _) => {
                        "This keeps the accepted rate, 0.0004 a year, and so does the upper end"
                    }
                    (true, false, _) => {
                        "This keeps the accepted rate, 0.0004 a year, but the upper end"
                    }
                    (false, _, true) => "This exceeds the accepted rate, 0.0004 a year.",
                    (false, ..) => "this may exceed the accepted rate, 0.0004 a year.",
                },
                "<th>keeps the accepted rate, 0.0004 a year</th>",
                "The hazard of the site, ./site.csv",
                "How it was read: levels in m/s2; annual rates `rate` of `PGA [m/s2]`.",
            ],
        );
        // The block, the hazard and the curves.
        assert_eq!(page.matches("data:image/svg+xml;base64,").count(), 3);
        let curve = serde_json::json!([[0.5, 0.05], [4.0, 0.0012], [16.0, 0.00001]]);
        assert_eq!(room.json(by)["hazard_curve"], curve);
    }
}

#[test]
fn a_report_counts_the_motions_whose_baseline_was_changed() {
    let room = Room::suite();
    for (baseline, is_told) in [("none", false), ("line", true)] {
        room.run(&format!("envelope {STATUE} --baseline {baseline} --out ./{baseline}"));
        let page = page(&room, baseline);
        assert_eq!(page.contains("a straight line was subtracted"), is_told, "{page}");
    }
}

/// Every command names a motion once, and says that it is taken in both directions.
#[test]
fn a_motion_in_both_directions_is_named_once_by_every_command() {
    let room = Room::suite();
    room.write("devices.csv", "device,isolation\nfloor,none\n");
    let compare = "compare ./devices.csv --suite ./list.csv --object 1 --backend cpu --verify none";
    for (name, line) in [
        ("compare", compare.to_string()),
        ("fragility", format!("fragility {STATUE} --levels 2,4")),
        ("envelope", format!("envelope {STATUE}")),
    ] {
        room.run(&format!("{line} --eccentricity 0.2 --both-directions --out ./{name}"));
        let run = room.json(name);
        assert_eq!(run["motions"], serde_json::json!(["a", "b", "c", "d"]));
        assert_eq!(run["both_directions"], true);
        says(&page(&room, name), &["as it is and reversed: 8 motions in all"]);
    }
}

#[test]
fn fits_are_told_with_why_they_are_open_and_motions_in_both_directions() {
    let room = Room::suite();
    room.run(&format!("fragility {STATUE} --levels 0.5,1 --both-directions --out ./low"));
    says(
        &page(&room, "low"),
        &[
            "4 motions of the suite",
            "Each is taken in both directions",
            "overturning: no run fails up to the highest level, 1",
            "–: the motions tell no curve",
        ],
    );
    // A median that is known about is told so.
    let head = room.heading("low/fits.csv");
    let open = head.split(',').map(|name| match name {
        "limit_state" => "overturning",
        "estimator" => "stripes",
        "theta" => "3.25",
        "theta_low" => "2.5",
        _ => "",
    });
    let open = open.collect::<Vec<_>>().join(",");
    room.write("low/fits.csv", format!("{head}\n{open}\n"));
    let page = page(&room, "low");
    says(
        &page,
        &["<td>about 3.25</td><td>2.5</td>", "<td>not known</td>", "About: at most one level"],
    );
}

#[test]
fn what_no_command_repeats_is_said() {
    let room = Room::new();
    let periods = "--t-h 0.5:4:3 --t-v 0.02:2:3";
    room.run(&format!("seismic --object 1 {periods} --backend cpu --verify none --out ./record"));
    says(&page(&room, "record"), &["topple run ./record --out record-again"]);
    let mut run = room.json("record");
    run["record"] = serde_json::Value::Null;
    room.write("record/run.json", run.to_string());
    let page = page(&room, "record");
    says(&page, &["No command repeats it: its run.json does not say where its record lies"]);
    assert!(!page.contains("topple run"), "{page}");
    // So it is: the command says the same.
    room.refuses("run ./record/run.json", &["it does not say where its record lies"]);
}

/// Pictures that are narrow lie beside each other: of a map of many slices a page has four.
#[test]
fn many_pictures_take_few_pages() {
    let room = Room::new();
    room.run(&format!("{} --out ./slices", MAP.replace("--t-v 0.75", "--t-v 0.3:1:20")));
    room.run("report ./slices --out ./report.pdf");
    let pdf = room.bytes("report.pdf");
    let pages = String::from_utf8_lossy(&pdf).matches("/Type /Page\n").count();
    // Five pages of pictures, and what stands before and after.
    assert!((6..=9).contains(&pages), "{pages}");
    let more = MAP.replace("--t-v 0.75", "--t-v 0.3:1:25").replace("2:12:6", "2:12:3");
    room.run(&format!("{more} --out ./more"));
    says(&page(&room, "more"), &["The run has no picture"]);
}

/// Columns that were asked for have names in words, as the others do.
#[test]
fn a_report_of_devices_has_no_raw_names() {
    let room = Room::suite();
    room.write("devices.csv", "device,isolation,radius,mu\nfloor,none,,\nfps,horizontal,1,0.06\n");
    room.write("site.csv", SITE);
    let asked = "--columns all --scales 0.5,2 --hazard ./site.csv --levels 1:16:8:log";
    let common = "--object 1 --suite ./list.csv --backend cpu --verify none --out ./compared";
    room.run(&format!("compare ./devices.csv {common} {asked}"));
    let page = page(&room, "compared");
    let heading = room.heading("compared/compare.csv");
    for name in ["friction_demand_84", "rate_with_missing"] {
        assert!(heading.contains(name), "{heading}");
    }
    for name in heading.split(',').filter(|name| name.contains('_')) {
        assert!(!page.contains(&format!("<td>{name}</td>")), "{name}");
    }
    says(
        &page,
        &[
            "<td>largest |φ| divided by the critical angle of its side, not exceeded under 84 % of these motions</td>",
            "<td>overturnings a year, with what may be missing beyond both ends of the hazard curve</td>",
        ],
    );
    assert!(!page.contains("a year at most"), "{page}");
}

/// A run's own title is its heading, and that of its report where it is alone.
#[test]
fn the_title_of_a_run_is_its_heading() {
    let room = Room::suite();
    let cell = "--object 1 --t-h 1.2 --t-v 0.4 --omega 4 --a-h 2 --backend cpu";
    for (name, line) in [
        ("map", MAP.to_string()),
        ("history", format!("history {cell}")),
        ("envelope", format!("envelope {STATUE}")),
        ("fragility", format!("fragility --levels 2,8 {STATUE}")),
        ("suite", "suite ./list.csv".into()),
    ] {
        room.run(&format!("{line} --title 'The statue, base 2' --out ./{name}"));
        says(&page(&room, name), &["<h1>The statue, base 2</h1>"]);
    }
    room.run("report ./map ./fragility --title 'All of it' --out ./report.html");
    let page = room.read("report.html");
    says(&page, &["<h1>All of it</h1>", "<h3>The statue, base 2 (fragility)</h3>"]);
}

/// An envelope's summary names the best base; that of a motion says where the contact force is tensile.
#[test]
fn a_summary_names_the_best_base_and_tensile_contact() {
    let room = Room::suite();
    room.run(
        "envelope --object 1 --eccentricity 0.2 --u-y 0.01 --t-h 0.5:5:14 --t-v 0.1:1:6 --scale 0.7 --suite ./list.csv \
         --limit-u 0.75 --limit-v 0.03 --backend cpu --verify none --out ./envelope",
    );
    let short = |run: &str| {
        let page = page(&room, run);
        let short = page.split("<h2>What was asked</h2>").next().unwrap();
        short.replace("<sub>", "_").replace("</sub>", "")
    };
    let best = room.json("envelope")["best_cell"].as_u64().unwrap() as usize;
    let row = &room.rows("envelope/envelope.csv")[best];
    let of = |column: &str| rounded(number(row, column), 3);
    let (t_h, t_v, u, v) = (of("t_h"), of("t_v"), of("max_u_100"), of("stroke_v_100"));
    says(
        &short("envelope"),
        &[
            &format!("has T_h = {t_h} s, T_v = {t_v} s"),
            &format!("horizontally by up to {u} m, its vertical stroke is up to {v} m"),
            &format!("Its reserve is {} steps of the map", of("reserve")),
        ],
    );
    let block = "--half-width 0.6 --height 0.2 --mass 900 --isolation none";
    let pulse = "--omega 10 --a-h 4 --t-max 4 --force --backend cpu";
    for (a_v, pulls) in [("30", true), ("0", false)] {
        for command in ["history", "pulse"] {
            room.run(&format!("{command} {block} {pulse} --a-v {a_v} --out ./{command}"));
            let told = short(command).contains("The contact force becomes tensile");
            assert_eq!(told, pulls, "{command} {a_v}");
        }
    }
}

/// A report counts motions, not the lines of a list, and names the lines that have none.
#[test]
fn a_report_counts_motions_and_names_lines_without_one() {
    let room = Room::suite();
    let list = room.read("list.csv");
    let more = "gone,gone.txt,gone_v.txt,0.02,m/s2\nlost,lost.txt,,0.02,m/s2\n";
    room.write("list.csv", list + more);
    room.run("suite ./list.csv --out ./suite");
    let of_suite = page(&room, "suite");
    says(
        &of_suite,
        &[
            "Found: 4 motions of 4 recordings, with horizontal peaks from",
            "2 lines of the suite have no motion.",
            "Motions of the suite: 4.",
            "gone is left out: ",
            "<td>a</td>",
        ],
    );
    // The table of motions has them alone.
    assert!(!of_suite.contains("<td>gone</td>"));
    room.run(&format!("envelope {STATUE} --out ./envelope"));
    let page = page(&room, "envelope");
    says(&page, &["4 motions of the suite ./list.csv", "2 lines of it have no motion."]);
}

/// What a run did not take as known is not called fixed.
#[test]
fn numbers_that_vary_are_not_fixed() {
    let room = Room::suite();
    let block = "--half-width 0.3 --height 1 --isolation none --verify none --backend cpu";
    let vary = "--vary height=uniform(0.6,1.3) --samples 2";
    for line in [
        "fragility --suite ./list.csv --levels 1:20:6:log",
        "envelope --suite ./list.csv",
        "pulse --omega 2:8:3 --a-h 1:8:3",
    ] {
        room.run(&format!("{line} {block} {vary} --out ./run"));
        let page = page(&room, "run");
        says(&page, &["Not known exactly: H, uniform from 0.6 to 1.3 m."]);
        let fixed = piece(&page, "Fixed: ", "</li>");
        assert!(fixed.contains("B = 0.3 m") && !fixed.contains("H = "), "{line}: {fixed}");
        says(&page, &["drawn with one of the values: H."]);
        // Nor does a picture of the run say it.
        if line.starts_with("fragility") {
            assert!(!room.read("run/fragility.svg").contains("H = 1 m"), "{line}");
        }
        room.remove("run");
    }
}
