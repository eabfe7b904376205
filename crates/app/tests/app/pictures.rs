//! Pictures as a reader of a journal sees them: letters, lines and legends in print.

use std::fs;
use std::path::Path;

use crate::common::command::Command;
use tempfile::TempDir;

use super::common::refused;
use super::fragility::{BASE, suite};

/// Points of a millimetre.
const MILLIMETRE: f64 = 72.0 / 25.4;

fn topple(arguments: &[&str], out: &Path) {
    let mut command = Command::topple();
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

/// Width of a PNG, pixels.
fn pixels(file: &Path) -> u32 {
    let file = std::io::BufReader::new(fs::File::open(file).unwrap());
    png::Decoder::new(file).read_info().unwrap().info().width
}

/// Holds a picture to a width in mm, to letters of a size in points, and to a title.
fn is_printed(out: &Path, name: &str, (width, size): (f64, f64), title: &str) {
    let svg = svg(out, name);
    assert!(
        svg.contains(&format!("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\""))
    );
    let view = svg.split("viewBox=\"0 0 ").nth(1).unwrap();
    let view: f64 = view.split(' ').next().unwrap().parse().unwrap();
    let points = width * MILLIMETRE / view;
    // Most lines of a picture are in letters of that size; titles are larger, indices smaller.
    let sizes: Vec<f64> = numbers(&svg, "font-size").iter().map(|own| own * points).collect();
    let asked = sizes.iter().filter(|own| (*own - size).abs() < 0.01).count();
    assert!(asked > 5, "{name}: {sizes:?}");
    assert!(sizes.iter().all(|own| *own < 8.0 / 7.0 * size + 0.01), "{name}: {sizes:?}");
    // Half a pixel at the end.
    let wide = f64::from(pixels(&out.join(format!("{name}.png"))));
    assert!((wide - width / 25.4 * 300.0).abs() <= 0.51, "{name}: {wide} pixels");
    let said = words(&svg);
    assert!(said.starts_with(title), "{name}: {said}");
    // All of it lies on the paper.
    assert!(numbers(&svg, "x").iter().all(|x| *x <= view), "{name}");
}

/// A run: the folder of its results, its arguments, and its pictures, each with what it shows.
type Run<'a> = (&'a str, Vec<&'a str>, &'a [(&'a str, &'a str)]);

#[test]
fn pictures_have_the_width_the_letters_and_the_title_asked_for() {
    let (place, list) = suite();
    let out = |name: &str| place.path().join(name);
    let cell = ["--omega", "9", "--a-h", "8.4"];
    let record = ["seismic", "--object", "1", "--t-h", "0.5:4:6", "--t-v", "0.02:2:6"];
    let cpu = ["--backend", "cpu"];
    let under = ["--suite", &list, "--verify", "none", "--backend", "cpu"];
    let grid = ["--t-h", "0.8:3:3", "--t-v", "0.3:1:2"];
    let one = ["--t-h", "1.5", "--t-v", "0.5"];
    let limits = ["--limit-u", "0.5", "--limit-v", "0.5"];
    let levels = ["--im", "pga", "--levels", "0.1:0.6:3"];
    let vary = ["--vary", "a_v=uniform(0,1)", "--samples", "8"];
    let devices = out("devices.csv");
    fs::write(&devices, "device,t_h,t_v\nsoft,2,0.5\nstiff,1,0.5\n").unwrap();
    let compare = ["compare", devices.to_str().unwrap(), "--object", "1", "--u-y", "0.01"];
    let commands: [Run; 10] = [
        ("map", MAP.to_vec(), &[("map", "A &lt;title&gt; B")]),
        (
            "line",
            [&MAP[..9], &["--omega", "5", "--a-h", "0.1:15:9"], &cpu].concat(),
            &[("map", "A &lt;title&gt; B")],
        ),
        (
            "history",
            [&["history"], &MAP[1..9], &cell].concat(),
            &[("history", "A &lt;title&gt; B")],
        ),
        (
            "record",
            [&record[..], &cpu].concat(),
            &[
                ("map", "A &lt;title&gt;: rocking index Record"),
                ("stroke_v", "A &lt;title&gt;: "),
                ("contact", "A &lt;title&gt;: least contact force and friction needed"),
            ],
        ),
        (
            "vary",
            [&MAP[..9], &["--omega", "0.2:15:4", "--a-h", "0.1:15:4"], &cpu, &vary].concat(),
            &[("probability", "A &lt;title&gt;: probability of overturning")],
        ),
        ("suite", vec!["suite", &list], &[("suite", "A &lt;title&gt; Pseudo")]),
        (
            "envelope",
            [&["envelope"], &BASE[..], &grid, &limits, &under].concat(),
            &[("envelope", "A &lt;title&gt; B")],
        ),
        (
            "fragility",
            [&["fragility"], &BASE[..], &one, &levels, &under].concat(),
            &[("fragility", "A &lt;title&gt; B")],
        ),
        (
            "fragilities",
            [&["fragility"], &BASE[..], &grid, &levels, &under].concat(),
            &[("fragility", "A &lt;title&gt;: overturning B")],
        ),
        ("compare", [&compare[..], &under].concat(), &[("compare", "A &lt;title&gt; the block")]),
    ];
    for (folder, command, pictures) in commands {
        for (width, size) in [(140.0, 9.0), (60.0, 7.0)] {
            let [mm, pt] = [width, size].map(|number: f64| number.to_string());
            let print = ["--title", "A <title>", "--width", &mm, "--font-size", &pt];
            topple(&[&command[..], &print].concat(), &out(folder));
            for (name, title) in pictures {
                is_printed(&out(folder), name, (width, size), title);
            }
        }
    }
}

/// What was asked of the pictures is in run.json, and asked again by a repetition, which can ask for something else.
#[test]
fn a_repeated_run_prints_its_pictures_alike() {
    let out = TempDir::new().unwrap();
    let at = |name: &str| out.path().join(name);
    let print = ["--title", "Its title", "--width", "100", "--font-size", "8"];
    let cell = ["--omega", "9", "--a-h", "8.4"];
    let map =
        [&MAP[..9], &["--omega", "0.2:15:4", "--a-h", "0.1:15:4", "--backend", "cpu"]].concat();
    let history = [&["history"], &MAP[1..9], &cell].concat();
    for (name, command) in [("map", map), ("history", history)] {
        topple(&[&command[..], &print].concat(), &at(name));
        let first = fs::read(at(name).join(format!("{name}.png"))).unwrap();
        let again = at(&format!("{name} again"));
        topple(&["run", at(name).to_str().unwrap()], &again);
        assert!(fs::read(again.join(format!("{name}.png"))).unwrap() == first, "{name}");
        topple(&["run", at(name).to_str().unwrap(), "--width", "120"], &again);
        is_printed(&again, name, (120.0, 8.0), "Its title B");
    }
}

#[test]
fn what_cannot_be_printed_is_refused_before_anything_is_made() {
    let (place, list) = suite();
    let out = place.path().join("out");
    let to = ["--out", out.to_str().unwrap()];
    let bad: [(&[&str], &str); 9] = [
        (&["--width", "39.9"], "--width: a picture is 40 to 600 mm wide, not 39.9"),
        (&["--width", "601"], "--width: a picture is 40 to 600 mm wide, not 601"),
        (&["--width", "nan"], "--width: "),
        (&["--font-size", "3.9"], "--font-size: letters are of 4 to 40 pt, not 3.9"),
        (&["--font-size", "41"], "--font-size: letters are of 4 to 40 pt, not 41"),
        (&["--font-size", "-1"], "--font-size: "),
        (
            &["--font-size", "20"],
            "--font-size: letters of 20 pt need a picture that is 163 mm wide, not 90",
        ),
        (&["--width", "50"], "--width: letters of 7 pt need a picture that is 57 mm wide, not 50"),
        (&["--title", " "], "--title"),
    ];
    for (print, problem) in bad {
        let one = ["--t-h", "1.5", "--t-v", "0.5"];
        let envelope = [&["envelope"], &BASE[..], &one, &["--suite", &list]].concat();
        let history = [&["history"], &MAP[1..9], &["--omega", "5", "--a-h", "3"]].concat();
        for command in [&MAP[..], &["suite", &list], &envelope, &history] {
            let said = refused(&[command, print, &to].concat());
            assert!(said.contains(problem), "{said}");
            assert!(!out.exists(), "{print:?}");
        }
    }
    let said = refused(&[&MAP[..], &["--tile", "1/2", "--width", "90"], &to].concat());
    assert!(said.contains("--tile: a shard has no pictures"), "{said}");
}

/// In greys nothing has a hue, in letters, lines and images; a repetition keeps them.
#[test]
fn a_grey_print_has_no_colours() {
    let out = TempDir::new().unwrap();
    let at = |name: &str| out.path().join(name);
    let hues = |name: &str| {
        let file = std::io::BufReader::new(fs::File::open(at(name).join("map.png")).unwrap());
        let mut decoder = png::Decoder::new(file);
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        let samples = info.color_type.samples();
        assert!(samples >= 3, "{samples}");
        pixels.chunks(samples).filter(|pixel| pixel[0] != pixel[1] || pixel[1] != pixel[2]).count()
    };
    let record =
        ["seismic", "--object", "1", "--t-h", "0.5:4:6", "--t-v", "0.02:2:6", "--backend", "cpu"];
    for (name, command) in [("pulse", &MAP[..]), ("record", &record)] {
        topple(command, &at(name));
        assert!(hues(name) > 1000, "{name}");
        topple(&[command, &["--palette", "grey"]].concat(), &at(name));
        assert_eq!(hues(name), 0, "{name}");
        topple(&["run", at(name).to_str().unwrap()], &at("again"));
        assert_eq!(hues("again"), 0, "{name}");
    }
    // Dark red and black, which are one in a grey print of the colours, differ: one of them has lines.
    let said = words(&svg(&at("pulse"), "map"));
    assert!(said.contains("0 impacts, right corner"), "{said}");
    let said =
        refused(&[&MAP[..], &["--palette", "red", "--out", at("none").to_str().unwrap()]].concat());
    assert!(said.contains("--palette"), "{said}");
}

/// Letters as outlines: the picture is the same, in the same size, and needs no font; a repetition keeps them.
#[test]
fn letters_become_outlines_where_they_are_asked_for() {
    let out = TempDir::new().unwrap();
    let at = |name: &str| out.path().join(name);
    let record =
        ["seismic", "--object", "1", "--t-h", "0.5:4:6", "--t-v", "0.02:2:6", "--backend", "cpu"];
    let cell = [&["history"], &MAP[1..9], &["--omega", "9", "--a-h", "8.4"]].concat();
    let pictures =
        [("pulse", &MAP[..], "map"), ("record", &record, "contact"), ("history", &cell, "history")];
    for (folder, command, name) in pictures {
        let plain = [command, &["--font-size", "8"]].concat();
        topple(&plain, &at(folder));
        let (text, png) =
            (svg(&at(folder), name), fs::read(at(folder).join(format!("{name}.png"))));
        assert!(text.matches("<text").count() > 8, "{folder}");
        topple(&[&plain[..], &["--outline-text"]].concat(), &at(folder));
        let outlined = svg(&at(folder), name);
        assert!(!outlined.contains("<text") && !outlined.contains("font-family"), "{folder}");
        assert!(outlined.matches("<path").count() > text.matches("<path").count(), "{folder}");
        let size = |svg: &str| {
            ["width", "height"].map(|side| {
                let marker = format!(" {side}=\"");
                let length = svg.split(&marker).nth(1).unwrap().split_once("mm\"").unwrap().0;
                length.parse::<f64>().unwrap()
            })
        };
        // A length of the one is written to hundredths of a millimetre.
        let apart = size(&text).into_iter().zip(size(&outlined)).map(|(a, b)| (a - b).abs());
        assert!(
            apart.fold(0.0, f64::max) < 0.02,
            "{folder}: {:?} {:?}",
            size(&text),
            size(&outlined)
        );
        let again = fs::read(at(folder).join(format!("{name}.png"))).unwrap();
        let apart = differing(&png.unwrap(), &again);
        assert!(apart < 0.002, "{folder}: {apart}");
        let again = at(&format!("{folder} again"));
        topple(&["run", at(folder).to_str().unwrap()], &again);
        assert!(svg(&again, name) == outlined, "{folder}");
    }
}

/// Numbers on the lines of a map do not lie in heaps: each has room around it, one of the same value more.
#[test]
fn numbers_on_lines_are_apart() {
    let out = TempDir::new().unwrap();
    let record = ["seismic", "--object", "1", "--eccentricity", "0.2", "--backend", "cpu"];
    let grid = ["--t-h", "0.5:4:40", "--t-v", "0.02:2:40", "--verify", "none"];
    topple(&[&record[..], &grid].concat(), out.path());
    let mut compared = 0;
    for name in ["displacement_u", "displacement_v", "stroke_v", "contact"] {
        let svg = svg(out.path(), name);
        // White behind a number, and the number.
        let lines: Vec<&str> = svg.lines().collect();
        let written: Vec<([f64; 4], &str)> = lines
            .windows(2)
            .filter(|pair| pair[0].contains("fill-opacity=\"0.85\""))
            .map(|pair| {
                let of = |attribute| numbers(pair[0], attribute)[0];
                let text = pair[1].split_once('>').unwrap().1.split('<').next().unwrap();
                ([of("x"), of("y"), of("width"), of("height")], text)
            })
            .collect();
        for (k, ([x, y, width, height], text)) in written.iter().enumerate() {
            for ([other_x, other_y, other_width, other_height], other) in &written[k + 1..] {
                let across = (x - other_x - other_width).max(other_x - x - width);
                let upwards = (y - other_y - other_height).max(other_y - y - height);
                // Lengths are written to hundredths. The two halves of a picture each have their own numbers.
                let least = if text == other && name != "contact" { 60.0 } else { 4.95 };
                assert!(across.max(upwards) > least, "{name}: {text} beside {other}");
                compared += 1;
            }
        }
    }
    assert!(compared > 20, "{compared}");
}

/// A map of one cell has no axes: its picture says what becomes of the block, and has no field beside it.
#[test]
fn one_cell_is_told_in_words() {
    let out = TempDir::new().unwrap();
    let at = |name: &str| out.path().join(name);
    let record = ["seismic", "--object", "1", "--t-h", "2", "--t-v", "0.5", "--backend", "cpu"];
    topple(&record, &at("record"));
    topple(&[&MAP[..9], &["--omega", "5", "--a-h", "1", "--backend", "cpu"]].concat(), &at("map"));
    let value = |folder: &str, column: &str| -> f64 {
        let table = fs::read_to_string(at(folder).join("map.csv")).unwrap();
        let place = table.lines().next().unwrap().split(',').position(|own| own == column);
        table.lines().nth(1).unwrap().split(',').nth(place.unwrap()).unwrap().parse().unwrap()
    };
    for folder in ["record", "map"] {
        let svg = svg(&at(folder), "map");
        is_printable(&svg, folder);
        let said = words(&svg);
        let of = topple::scene::record::rounded(value(folder, "max_u"), 3);
        assert!(said.contains("Outcome of one case") && said.contains("max |u| = "), "{said}");
        assert!(said.contains(&format!("max |u| = {of}")), "{of}: {said}");
        assert!(!svg.contains("<image"), "{folder}");
        let files: Vec<_> = fs::read_dir(at(folder)).unwrap().collect();
        let pictures = files.into_iter().filter(|file| {
            file.as_ref().unwrap().path().extension().is_some_and(|own| own == "svg")
        });
        assert_eq!(pictures.count(), 1, "{folder}");
    }
}

/// The share of the pixels of two pictures that differ by more than the edge of a letter does.
fn differing(one: &[u8], other: &[u8]) -> f64 {
    let pixels = |bytes: &[u8]| {
        let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes.to_vec()));
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        pixels
    };
    let (one, other) = (pixels(one), pixels(other));
    assert_eq!(one.len(), other.len());
    let apart = one.iter().zip(&other).filter(|(a, b)| a.abs_diff(**b) > 24).count();
    apart as f64 / one.len() as f64
}

/// The spectra of a map are the least values of its cells, and are repeated with it.
#[test]
fn spectra_are_the_least_values_that_lift_and_overturn() {
    let out = TempDir::new().unwrap();
    let at = |name: &str| out.path().join(name);
    // Blocks under quick pulses do not overturn up to 8 m/s².
    let grid = ["--omega", "0.2:15:30", "--a-h", "0.1:8:30", "--backend", "cpu", "--spectrum"];
    topple(&[&MAP[..9], &grid].concat(), &at("map"));
    let read = |name: &str| fs::read_to_string(at("map").join(name)).unwrap();
    let cells = read("map.csv");
    let spectrum = read("spectrum.csv");
    let mut lines = spectrum.lines();
    assert_eq!(lines.next().unwrap(), "omega,lifts,overturns");
    let (mut compared, mut open) = (0, 0);
    for line in lines {
        let [omega, lifts, overturns] = line.split(',').collect::<Vec<_>>()[..] else { panic!() };
        let least = |does: fn(&str) -> bool| {
            let of = cells.lines().skip(1).map(|row| row.split(',').collect::<Vec<_>>());
            let of = of.filter(|row| row[0] == omega && does(row[2]));
            of.map(|row| row[1].parse::<f64>().unwrap()).reduce(f64::min)
        };
        let lifted = least(|outcome| outcome != "full_contact");
        let overturned = least(|outcome| outcome.starts_with("overturned"));
        for (told, wanted) in [(lifts, lifted), (overturns, overturned)] {
            assert_eq!(told.parse::<f64>().ok(), wanted, "{line}");
            compared += usize::from(wanted.is_some());
            open += usize::from(wanted.is_none());
        }
    }
    assert!(compared > 30 && open > 10, "{compared} {open}");
    let svg = svg(&at("map"), "spectrum");
    is_printable(&svg, "spectrum");
    let said = words(&svg);
    for part in
        ["Least Ah that lifts and overturns, over Ω", "overturns from here on", "ζ at Ah = 8 m/s²"]
    {
        assert!(said.contains(part), "{part}: {said}");
    }
    // Where both least values are the same, one line shows between the dashes of the other.
    assert!(svg.contains("stroke-dasharray=\"4 2.4\""), "{svg}");
    topple(&["run", at("map").to_str().unwrap()], &at("again"));
    assert_eq!(fs::read_to_string(at("again").join("spectrum.csv")).unwrap(), spectrum);
    let line = [&MAP[..9], &["--omega", "5", "--a-h", "0.1:15:9", "--spectrum"]].concat();
    let said = refused(&[&line[..], &["--out", at("line").to_str().unwrap()]].concat());
    assert!(said.contains("--spectrum: spectra are of a map of two axes"), "{said}");
    // The least of amplitudes of both signs is none.
    let line = [&MAP[..9], &["--omega", "1:9:4", "--a-h=-5:5:5", "--spectrum"]].concat();
    let said = refused(&[&line[..], &["--out", at("signed").to_str().unwrap()]].concat());
    assert!(said.contains("how strong the shaking is"), "{said}");
}

/// Letters that no font has would be empty boxes: a line names them and the texts that have them, once for all pictures of a run, and
/// run.json and a report as PDF say it, too. (U+10FFFD is for private use: no font has it.)
#[test]
fn letters_that_no_font_has_are_said() {
    let place = TempDir::new().unwrap();
    let (map, report) = (place.path().join("map"), place.path().join("report.pdf"));
    let warned = |run: crate::common::command::Assert| {
        let said = String::from_utf8(run.success().get_output().stderr.clone()).unwrap();
        said.lines().filter(|line| line.contains("U+10FFFD")).map(String::from).collect::<Vec<_>>()
    };
    let mut command = Command::topple();
    let title = ["--title", "Statue \u{10fffd}", "--spectrum", "--verify", "none", "--out"];
    let said = warned(command.args(MAP).args(title).arg(&map).assert());
    assert!(said.len() == 1 && said[0].contains("of \"Statue \u{10fffd}\""), "{said:?}");
    let run: serde_json::Value =
        serde_json::from_slice(&fs::read(map.join("run.json")).unwrap()).unwrap();
    assert!(run["warnings"][0].as_str().unwrap().contains("U+10FFFD"), "{run}");
    let mut command = Command::topple();
    let said = warned(command.arg("report").arg(&map).arg("--out").arg(&report).assert());
    assert_eq!(said.len(), 1, "{said:?}");
    let mut command = Command::topple();
    let page = place.path().join("report.html");
    let said = warned(command.arg("report").arg(&map).arg("--out").arg(&page).assert());
    assert!(said.is_empty(), "{said:?}");

    let (folder, list) = suite();
    let devices = folder.path().join("devices.csv");
    fs::write(&devices, "device,isolation\nfirst \u{10fffd},none\nsecond,none\n").unwrap();
    let mut command = Command::topple();
    command.arg("compare").arg(&devices).args(["--object", "1", "--suite", &list]);
    command.args(["--verify", "none", "--backend", "cpu", "--out"]).arg(folder.path().join("out"));
    let said = warned(command.assert());
    assert!(said.len() == 1 && said[0].contains("of \"first \u{10fffd}\""), "{said:?}");
}

/// A title has an end, wherever it is given.
#[test]
fn a_title_without_an_end_is_refused() {
    let place = TempDir::new().unwrap();
    let title = "a".repeat(10_001);
    let scene = place.path().join("scene.toml");
    fs::write(&scene, format!("title = \"{title}\"\n")).unwrap();
    let line = refused(&["run", scene.to_str().unwrap()]);
    assert!(line.contains("title: has more than 10000 letters"), "{line}");
    let line = refused(&["pulse", "--object", "1", "--t-h", "1", "--title", &title]);
    assert!(line.contains("must have 10000 letters at most"), "{}", &line[line.len() - 300..]);
}
