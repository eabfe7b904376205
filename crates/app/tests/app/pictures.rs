//! Pictures as a reader of a journal sees them: letters, lines and legends in print.

use png::Transformations;

use crate::common::picture::{pixels, words};
use crate::common::room::{Room, number};

/// Points of a millimetre.
const MILLIMETRE: f64 = 72.0 / 25.4;

/// A block on a base, and maps of it with blocks that overturn about either corner.
const CELL: &str = "--object 1 --eccentricity 0.2 --t-h 1.75 --t-v 0.75";

const GRID: &str = "--omega 0.2:15:30 --a-h 0.1:15:30 --backend cpu";

const SMALL: &str = "--omega 0.2:15:4 --a-h 0.1:15:4 --backend cpu";

const LINE: &str = "--omega 5 --a-h 0.1:15:9 --backend cpu";

const HISTORY: &str = "--omega 9 --a-h 8.4";

const RECORD: &str = "seismic --object 1 --t-h 0.5:4:6 --t-v 0.02:2:6 --backend cpu";

fn map() -> String {
    format!("pulse {CELL} {GRID}")
}

/// Runs a command into a folder.
#[track_caller]
fn run(room: &Room, line: &str, out: &str) {
    room.run(&format!("{line} --quiet --out ./{out}"));
}

fn svg(room: &Room, name: &str) -> String {
    room.read(&format!("{name}.svg"))
}

/// The numbers of an attribute.
fn numbers(svg: &str, attribute: &str) -> Vec<f64> {
    let marker = format!(" {attribute}=\"");
    svg.split(&marker)
        .skip(1)
        .map(|rest| rest.split('"').next().unwrap().parse().unwrap())
        .collect()
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
    let room = Room::new();
    run(&room, &map(), "map");
    run(&room, &format!("pulse {CELL} --omega 5 --a-h 0.1:15:30"), "line");
    run(&room, "seismic --object 1 --t-h 0.5:4:12 --t-v 0.02:2:12 --backend cpu", "record");
    let names = ["map", "displacement_u", "displacement_v", "stroke_v", "contact"];
    let of_record = names.map(|name| format!("record/{name}"));
    for name in ["map/map".to_string(), "line/map".into()].into_iter().chain(of_record) {
        is_printable(&svg(&room, &name), &name);
    }
    // Two maps share a legend, which says a thing once.
    let contact = words(&svg(&room, "record/contact"));
    assert_eq!(contact.matches("border of overturning").count(), 1, "{contact}");
    let line = words(&svg(&room, "line/map"));
    assert!(line.contains("along Ah") && line.contains(" %"), "{line}");
}

#[test]
fn a_chart_is_readable_in_a_column() {
    let room = Room::new();
    run(&room, "chart --quick --no-shader", "out");
    for name in ["out/pulse", "out/record", "out/free", "out/maps"] {
        is_printable(&svg(&room, name), name);
    }
}

/// The ground, and marks for uplifts and impacts that differ, all of them in the legend.
#[test]
fn a_history_shows_what_shakes_and_what_switches() {
    let room = Room::new();
    run(&room, &format!("history {CELL} {HISTORY} --a-v 0.5"), "out");
    let svg = svg(&room, "out/history");
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
    let room = Room::new();
    run(&room, &format!("{} --friction 0.1", map()), "hatched");
    run(&room, &map(), "plain");
    let [hatched, plain] = ["hatched/map", "plain/map"].map(|name| svg(&room, name));
    assert!(words(&hatched).contains("friction &gt; 0.1: the model does not hold"));
    assert!(!words(&plain).contains("does not hold"));
    // The swatch's lines are cut at its edge; so are rings at the map's.
    assert_eq!(hatched.matches("<clipPath").count(), plain.matches("<clipPath").count() + 1);
    assert!(words(&plain).contains("with dots: over the right corner"));
}

/// A title from a file may be of any length, and hold what XML reserves.
#[test]
fn a_records_name_stands_on_its_maps() {
    let room = Room::new();
    let title = format!("<b>A&B</b> \"STATION\", {} 90", "VERY LONG NAME ".repeat(20));
    let at2 = format!(
        "PEER NGA STRONG MOTION DATABASE RECORD\n{title}\nACCELERATION TIME SERIES IN UNITS OF G\n\
         NPTS= 8, DT= .0100 SEC\n 0 .1 .5 -.5 .2 .1 -.1 0\n"
    );
    room.write("a.at2", at2);
    let cell = "seismic --object 1 --t-h 0.5:4:3 --t-v 0.1:2:3";
    run(&room, &format!("{cell} --horizontal ./a.at2"), "out");
    for name in ["out/map", "out/displacement_u", "out/contact"] {
        let svg = svg(&room, name);
        let said = words(&svg);
        assert!(said.contains("Record: &lt;b&gt;A&amp;B&lt;/b&gt; &quot;STATION&quot;"), "{said}");
        assert!(said.contains(" … ") && said.contains("no vertical motion"), "{said}");
        is_printable(&svg, name);
    }
}

/// A layout program that reads the PNG places it in the size of the SVG.
#[test]
fn a_png_says_how_large_it_is_in_print() {
    let room = Room::new();
    run(&room, &map(), "out");
    let (info, _) = pixels(&room.bytes("out/map.png"), Transformations::EXPAND);
    let size = info.pixel_dims.unwrap();
    assert_eq!(size.unit, png::Unit::Meter);
    assert_eq!((size.xppu, size.yppu), (11_811, 11_811), "300 pixels an inch");
    let wide = f64::from(info.width) / f64::from(size.xppu) * 1000.0;
    let svg = svg(&room, "out/map");
    let width = svg.split("width=\"").nth(1).unwrap().split("mm").next().unwrap();
    let stated: f64 = width.parse().unwrap();
    // Half a pixel at each side.
    assert!((wide - stated).abs() < 0.1, "{wide} mm, {stated} mm");
}

/// Holds a picture to a width in mm, to letters of a size in points, and to a title.
fn is_printed(room: &Room, name: &str, (width, size): (f64, f64), title: &str) {
    let svg = svg(room, name);
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
    let wide =
        f64::from(pixels(&room.bytes(&format!("{name}.png")), Transformations::EXPAND).0.width);
    assert!((wide - width / 25.4 * 300.0).abs() <= 0.51, "{name}: {wide} pixels");
    let said = words(&svg);
    assert!(said.starts_with(title), "{name}: {said}");
    // All of it lies on the paper.
    assert!(numbers(&svg, "x").iter().all(|x| *x <= view), "{name}");
}

#[test]
fn pictures_have_the_width_the_letters_and_the_title_asked_for() {
    let room = Room::suite();
    room.write("devices.csv", "device,t_h,t_v\nsoft,2,0.5\nstiff,1,0.5\n");
    let under = "--object 1 --eccentricity 0.2 --u-y 0.01 --suite ./list.csv --verify none";
    let under = format!("{under} --backend cpu");
    let (grid, one) = ("--t-h 0.8:3:3 --t-v 0.3:1:2", "--t-h 1.5 --t-v 0.5");
    let levels = "--im pga --levels 0.1:0.6:3";
    for (line, pictures) in [
        (map(), &[("map", "A &lt;title&gt; B")][..]),
        (format!("pulse {CELL} {LINE}"), &[("map", "A &lt;title&gt; B")]),
        (format!("history {CELL} {HISTORY}"), &[("history", "A &lt;title&gt; B")]),
        (
            RECORD.into(),
            &[
                ("map", "A &lt;title&gt;: rocking index Record"),
                ("stroke_v", "A &lt;title&gt;: "),
                ("contact", "A &lt;title&gt;: least contact force and friction needed"),
            ],
        ),
        (
            format!("pulse {CELL} {SMALL} --vary a_v=uniform(0,1) --samples 8"),
            &[("probability", "A &lt;title&gt;: probability of overturning")],
        ),
        ("suite ./list.csv".into(), &[("suite", "A &lt;title&gt; Pseudo")]),
        (
            format!("envelope {under} {grid} --limit-u 0.5 --limit-v 0.5"),
            &[("envelope", "A &lt;title&gt; B")],
        ),
        (format!("fragility {under} {one} {levels}"), &[("fragility", "A &lt;title&gt; B")]),
        (
            format!("fragility {under} {grid} {levels}"),
            &[("fragility", "A &lt;title&gt;: overturning B")],
        ),
        (format!("compare ./devices.csv {under}"), &[("compare", "A &lt;title&gt; the block")]),
    ] {
        for (width, size) in [(140.0, 9.0), (60.0, 7.0)] {
            let print = format!("--title 'A <title>' --width {width} --font-size {size}");
            run(&room, &format!("{line} {print}"), "out");
            for (name, title) in pictures {
                is_printed(&room, &format!("out/{name}"), (width, size), title);
            }
        }
        room.remove("out");
    }
}

/// What was asked of the pictures is in run.json, and asked again by a repetition, which can ask for something else.
#[test]
fn a_repeated_run_prints_its_pictures_alike() {
    let room = Room::new();
    for (name, line) in
        [("map", format!("pulse {CELL} {SMALL}")), ("history", format!("history {CELL} {HISTORY}"))]
    {
        run(&room, &format!("{line} --title 'Its title' --width 100 --font-size 8"), name);
        let again = format!("{name}-again");
        run(&room, &format!("run ./{name}"), &again);
        room.same(name, &again, &[&format!("{name}.png")]);
        run(&room, &format!("run ./{name} --width 120"), &again);
        is_printed(&room, &format!("{again}/{name}"), (120.0, 8.0), "Its title B");
    }
}

/// In greys nothing has a hue, in letters, lines and images; a repetition keeps them.
#[test]
fn a_grey_print_has_no_colours() {
    let room = Room::new();
    let hues = |out: &str| {
        let (info, pixels) =
            pixels(&room.bytes(&format!("{out}/map.png")), Transformations::EXPAND);
        let samples = pixels.len() / (info.width * info.height) as usize;
        assert!(samples >= 3, "{samples}");
        pixels.chunks(samples).filter(|pixel| pixel[0] != pixel[1] || pixel[1] != pixel[2]).count()
    };
    for (name, line) in [("pulse", &*map()), ("record", RECORD)] {
        run(&room, line, name);
        assert!(hues(name) > 1000, "{name}");
        run(&room, &format!("{line} --palette grey"), name);
        assert_eq!(hues(name), 0, "{name}");
        run(&room, &format!("run ./{name}"), "again");
        assert_eq!(hues("again"), 0, "{name}");
    }
    // Dark red and black, which are one in a grey print of the colours, differ: one of them has lines.
    let said = words(&svg(&room, "pulse/map"));
    assert!(said.contains("0 impacts, right corner"), "{said}");
}

/// Numbers on the lines of a map do not lie in heaps: each has room around it, one of the same value more.
#[test]
fn numbers_on_lines_are_apart() {
    let room = Room::new();
    let grid = "--eccentricity 0.2 --t-h 0.5:4:40 --t-v 0.02:2:40 --verify none --backend cpu";
    run(&room, &format!("seismic --object 1 {grid}"), "out");
    let mut compared = 0;
    for name in ["displacement_u", "displacement_v", "stroke_v", "contact"] {
        let svg = svg(&room, &format!("out/{name}"));
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
    let room = Room::new();
    for (folder, line) in [
        ("record", "seismic --object 1 --t-h 2 --t-v 0.5 --backend cpu".into()),
        ("map", format!("pulse {CELL} --omega 5 --a-h 1 --backend cpu")),
    ] {
        run(&room, &line, folder);
        let svg = svg(&room, &format!("{folder}/map"));
        is_printable(&svg, folder);
        let said = words(&svg);
        let max_u = number(&room.rows(&format!("{folder}/map.csv"))[0], "max_u");
        let wanted = format!("max |u| = {}", topple::scene::record::rounded(max_u, 3));
        assert!(said.contains("Outcome of one case") && said.contains(&wanted), "{said}");
        assert!(!svg.contains("<image"), "{folder}");
        let pictures = room.names(folder).into_iter().filter(|name| name.ends_with(".svg"));
        assert_eq!(pictures.count(), 1, "{folder}");
    }
}

/// The spectra of a map are the least values of its cells, and are repeated with it.
#[test]
fn spectra_are_the_least_values_that_lift_and_overturn() {
    let room = Room::new();
    // Blocks under quick pulses do not overturn up to 8 m/s².
    let grid = "--omega 0.2:15:30 --a-h 0.1:8:30 --backend cpu --spectrum";
    run(&room, &format!("pulse {CELL} {grid}"), "map");
    let cells = room.rows("map/map.csv");
    assert_eq!(room.heading("map/spectrum.csv"), "omega,lifts,overturns");
    let (mut compared, mut open) = (0, 0);
    for line in room.rows("map/spectrum.csv") {
        let least = |does: fn(&str) -> bool| {
            let of =
                cells.iter().filter(|row| row["omega"] == line["omega"] && does(&row["outcome"]));
            of.map(|row| number(row, "a_h")).reduce(f64::min)
        };
        let lifted = least(|outcome| outcome != "full_contact");
        let overturned = least(|outcome| outcome.starts_with("overturned"));
        for (column, wanted) in [("lifts", lifted), ("overturns", overturned)] {
            assert_eq!(line[column].parse::<f64>().ok(), wanted, "{line:?}");
            compared += usize::from(wanted.is_some());
            open += usize::from(wanted.is_none());
        }
    }
    assert!(compared > 30 && open > 10, "{compared} {open}");
    let svg = svg(&room, "map/spectrum");
    is_printable(&svg, "spectrum");
    let said = words(&svg);
    for part in
        ["Least Ah that lifts and overturns, over Ω", "overturns from here on", "ζ at Ah = 8 m/s²"]
    {
        assert!(said.contains(part), "{part}: {said}");
    }
    // Where both least values are the same, one line shows between the dashes of the other.
    assert!(svg.contains("stroke-dasharray=\"4 2.4\""), "{svg}");
    run(&room, "run ./map", "again");
    room.same("map", "again", &["spectrum.csv"]);
}

/// Letters that no font has would be empty boxes: a line names them and the texts that have them, once for all pictures of a run, and
/// run.json and a report as PDF say it, too. (U+10FFFD is for private use: no font has it.)
#[test]
fn letters_that_no_font_has_are_said() {
    let room = Room::suite();
    room.write("devices.csv", "device,isolation\nfirst \u{10fffd},none\nsecond,none\n");
    let warned = |line: &str| {
        let said = room.run(line).err;
        said.lines().filter(|line| line.contains("U+10FFFD")).map(String::from).collect::<Vec<_>>()
    };
    let title = "--title 'Statue \u{10fffd}' --spectrum --verify none --out ./map";
    let said = warned(&format!("{} {title}", map()));
    assert!(said.len() == 1 && said[0].contains("of \"Statue \u{10fffd}\""), "{said:?}");
    let run = room.json("map");
    assert!(run["warnings"][0].as_str().unwrap().contains("U+10FFFD"), "{run}");
    assert_eq!(warned("report ./map --out ./report.pdf").len(), 1);
    assert_eq!(warned("report ./map --out ./report.html"), [""; 0]);
    let suite = "--object 1 --suite ./list.csv --verify none --backend cpu --out ./out";
    let said = warned(&format!("compare ./devices.csv {suite}"));
    assert!(said.len() == 1 && said[0].contains("of \"first \u{10fffd}\""), "{said:?}");
}

/// A title has an end, wherever it is given.
#[test]
fn a_title_without_an_end_is_refused() {
    let room = Room::new();
    let title = "a".repeat(10_001);
    room.write("scene.toml", format!("title = \"{title}\"\n"));
    room.refuses("run ./scene.toml", &["title: has more than 10000 letters"]);
    let said = "must have 10000 letters at most";
    room.refuses(&format!("pulse --object 1 --t-h 1 --title {title}"), &[said]);
}
