//! Pictures as a reader of a journal sees them: letters, lines and legends in print.

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use tempfile::TempDir;

/// Points of a millimetre.
const MILLIMETRE: f64 = 72.0 / 25.4;

fn topple(arguments: &[&str], out: &Path) {
    let mut command = Command::cargo_bin("topple").unwrap();
    command.args(arguments).arg("--out").arg(out).arg("--quiet").assert().success();
}

/// A map with blocks that overturn about either corner.
const MAP: [&str; 15] = [
    "pulse",
    "--object",
    "1",
    "--eccentricity",
    "0.2",
    "--t-h",
    "1.75",
    "--t-v",
    "0.75",
    "--omega",
    "0.2:15:30",
    "--a-h",
    "0.1:15:30",
    "--backend",
    "cpu",
];

fn svg(out: &Path, name: &str) -> String {
    fs::read_to_string(out.join(format!("{name}.svg"))).unwrap()
}

/// The numbers of an attribute.
fn numbers(svg: &str, attribute: &str) -> Vec<f64> {
    let marker = format!(" {attribute}=\"");
    svg.split(&marker)
        .skip(1)
        .map(|rest| rest.split('"').next().unwrap().parse().unwrap())
        .collect()
}

/// What a picture says, its lines joined.
fn words(svg: &str) -> String {
    let texts = svg.lines().filter(|line| line.starts_with("<text"));
    let plain = |line: &str| {
        let pieces = line.split('<').filter_map(|piece| Some(piece.split_once('>')?.1));
        pieces.collect::<String>()
    };
    texts.map(plain).collect::<Vec<_>>().join(" ")
}

/// Holds a picture to 90 mm, letters of 6 points and lines of a quarter of a point: those that journals ask for.
fn is_printable(svg: &str, name: &str) {
    assert!(svg.contains("width=\"90mm\""), "{name}: {}", &svg[..200]);
    let view = svg.split("viewBox=\"0 0 ").nth(1).unwrap();
    let width: f64 = view.split(' ').next().unwrap().parse().unwrap();
    let points = 90.0 * MILLIMETRE / width;
    let least = |attribute| {
        let all = numbers(svg, attribute);
        assert!(!all.is_empty(), "{name}: no {attribute}");
        points * all.into_iter().fold(f64::INFINITY, f64::min)
    };
    // A length is written to hundredths.
    assert!(least("font-size") > 5.99, "{name}: letters of {} points", least("font-size"));
    assert!(least("stroke-width") > 0.249, "{name}: lines of {} points", least("stroke-width"));
}

#[test]
fn maps_and_histories_are_readable_in_a_column() {
    let out = TempDir::new().unwrap();
    topple(&MAP, &out.path().join("map"));
    topple(
        &[&MAP[..9], &["--omega", "5", "--a-h", "0.1:15:30"]].concat(),
        &out.path().join("line"),
    );
    let record = ["seismic", "--object", "1", "--t-h", "0.5:4:12", "--t-v", "0.02:2:12"];
    topple(&[&record[..], &["--backend", "cpu"]].concat(), &out.path().join("record"));
    let names = ["map", "displacement_u", "displacement_v", "stroke_v", "contact"];
    let pictures = [("map", "map"), ("line", "map")];
    for (folder, name) in pictures.into_iter().chain(names.map(|name| ("record", name))) {
        is_printable(&svg(&out.path().join(folder), name), &format!("{folder}/{name}"));
    }
    // Two maps share a legend, which says a thing once.
    let contact = words(&svg(&out.path().join("record"), "contact"));
    assert_eq!(contact.matches("border of overturning").count(), 1, "{contact}");
    let line = words(&svg(&out.path().join("line"), "map"));
    assert!(line.contains("along Ah") && line.contains(" %"), "{line}");
}

#[test]
fn a_chart_is_readable_in_a_column() {
    let out = TempDir::new().unwrap();
    topple(&["chart", "--quick", "--no-shader"], out.path());
    for name in ["pulse", "record", "free", "maps"] {
        is_printable(&svg(out.path(), name), name);
    }
}

/// The ground, and marks for uplifts and impacts that differ, all of them in the legend.
#[test]
fn a_history_shows_what_shakes_and_what_switches() {
    let out = TempDir::new().unwrap();
    let cell = ["--omega", "9", "--a-h", "8.4", "--a-v", "0.5"];
    topple(&[&["history"], &MAP[1..9], &cell].concat(), out.path());
    let svg = svg(out.path(), "history");
    is_printable(&svg, "history");
    let said = words(&svg);
    for word in
        ["üg [m/s²]", "v¨g [m/s²]", "uplift", "impact", "after 9 impacts", "overturning angle"]
    {
        assert!(said.contains(word), "{word}: {said}");
    }
    // Triangles are polygons, circles have an edge; the legend has one of each too.
    let triangles = svg.lines().filter(|line| line.contains("Z\" fill=\"#000000\"")).count();
    let circles =
        svg.lines().filter(|line| line.starts_with("<circle") && line.contains("fill=\"none\""));
    assert_eq!((triangles, circles.count()), (2, 10));
}

/// The legend has what the map has: a friction coefficient that no motion keeps to hatches it.
#[test]
fn a_legend_explains_hatches_where_there_are_some() {
    let out = TempDir::new().unwrap();
    let hatched = [&MAP[..], &["--friction", "0.1"]].concat();
    topple(&hatched, &out.path().join("hatched"));
    topple(&MAP, &out.path().join("plain"));
    let (hatched, plain) =
        ["hatched", "plain"].map(|name| svg(&out.path().join(name), "map")).into();
    assert!(words(&hatched).contains("friction &gt; 0.1: the model does not hold"));
    assert!(!words(&plain).contains("does not hold"));
    // The swatch's lines are cut at its edge; so are rings at the map's.
    assert_eq!(hatched.matches("<clipPath").count(), plain.matches("<clipPath").count() + 1);
    assert!(words(&plain).contains("with dots: over the right corner"));
}

/// A title from a file may be of any length, and hold what XML reserves.
#[test]
fn a_records_name_stands_on_its_maps() {
    let out = TempDir::new().unwrap();
    let title = format!("<b>A&B</b> \"STATION\", {} 90", "VERY LONG NAME ".repeat(20));
    let at2 = format!(
        "PEER NGA STRONG MOTION DATABASE RECORD\n{title}\nACCELERATION TIME SERIES IN UNITS OF G\n\
         NPTS= 8, DT= .0100 SEC\n 0 .1 .5 -.5 .2 .1 -.1 0\n"
    );
    let file = out.path().join("a.at2");
    fs::write(&file, at2).unwrap();
    let record =
        ["seismic", "--object", "1", "--t-h", "0.5:4:3", "--t-v", "0.1:2:3", "--horizontal"];
    topple(&[&record[..], &[file.to_str().unwrap()]].concat(), out.path());
    for name in ["map", "displacement_u", "contact"] {
        let svg = svg(out.path(), name);
        let said = words(&svg);
        assert!(said.contains("Record: &lt;b&gt;A&amp;B&lt;/b&gt; &quot;STATION&quot;"), "{said}");
        assert!(said.contains(" … ") && said.contains("no vertical motion"), "{said}");
        is_printable(&svg, name);
    }
}

/// A layout program that reads the PNG places it in the size of the SVG.
#[test]
fn a_png_says_how_large_it_is_in_print() {
    let out = TempDir::new().unwrap();
    topple(&MAP, out.path());
    let file = std::io::BufReader::new(fs::File::open(out.path().join("map.png")).unwrap());
    let reader = png::Decoder::new(file).read_info().unwrap();
    let size = reader.info().pixel_dims.unwrap();
    assert_eq!(size.unit, png::Unit::Meter);
    assert_eq!((size.xppu, size.yppu), (11_811, 11_811), "300 pixels an inch");
    let wide = f64::from(reader.info().width) / f64::from(size.xppu) * 1000.0;
    let svg = svg(out.path(), "map");
    let width = svg.split("width=\"").nth(1).unwrap().split("mm").next().unwrap();
    let stated: f64 = width.parse().unwrap();
    // Half a pixel at each side.
    assert!((wide - stated).abs() < 0.1, "{wide} mm, {stated} mm");
}
