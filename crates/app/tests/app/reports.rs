//! Reports: what lies in a run's directory is in them, they stand alone, and nothing that is in the way is lost.

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use tempfile::TempDir;

use super::common::refused;
use super::fragility::suite;

fn topple(place: &TempDir, arguments: &[&str]) -> assert_cmd::assert::Assert {
    let mut command = Command::cargo_bin("topple").unwrap();
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
        "topple run map --out again",
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
    topple(&place, &["report", "map", "--out", "two.pdf"]).success();
    let bytes = fs::read(place.path().join("one.pdf")).unwrap();
    assert!(bytes.starts_with(b"%PDF-") && bytes.trim_ascii_end().ends_with(b"%%EOF"));
    let text = String::from_utf8_lossy(&bytes);
    assert!(text.contains("/Creator (topple report)"));
    assert!(text.matches("/Type /Page\n").count() >= 2);
    // The colours of the map's cells are an image; nothing else is, text is paths.
    assert!(text.contains("/Subtype /Image") && !text.contains("/Font"));
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
    for kind in ["4 runs of topple", "(map)", "Suite (suite)", "(envelope)", "(fragility)"] {
        assert!(page.contains(kind), "{kind}");
    }
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
