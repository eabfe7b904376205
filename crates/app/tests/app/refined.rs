//! Refined maps by the command: their pictures and their leaves.

use std::collections::{BTreeMap, BTreeSet};

use png::Transformations;

use crate::common::picture;
use crate::common::room::{Room, Row, number};

const PULSE: &str = "pulse --object 1 --t-h 1.75 --t-v 0.75 --t-max 6 --eccentricity 0.2 --omega 1:12:12 --a-h 1:12:11 \
    --backend cpu --verify none --out ./out";

/// The cells that the leaves of a table cover.
fn area(leaves: &[Row], height: &str) -> usize {
    let side = |leaf: &Row, of: &str| leaf[of].parse::<usize>().unwrap();
    leaves.iter().map(|leaf| side(leaf, "width") * side(leaf, height)).sum()
}

#[test]
fn the_command_writes_pictures_and_leaves() {
    let room = Room::new();
    room.run(&format!("{PULSE} --refine 4"))
        .has("refined    177 x 161 cells by ")
        .has("at 95 % no more");
    let json = room.json("out");
    assert_eq!(json["refined"]["shape"], serde_json::json!([177, 161]));
    assert_eq!(json["refined"]["levels"].as_array().unwrap().len(), 4);
    assert_eq!(json["drawn"], serde_json::json!([177, 161]));
    for name in ["leaves.csv", "leaves.npz", "refined.png", "refined.svg", "map.csv", "map.png"] {
        assert!(json["files"].as_array().unwrap().contains(&name.into()), "{name}");
        assert!(room.has(&format!("out/{name}")), "{name}");
    }
    // The leaves cover the grid; each has the outcome that the picture has.
    let head = room.heading("out/leaves.csv");
    assert!(head.starts_with("omega,a_h,level,width,height,beside,impacts_differ,outcome,"));
    let leaves = room.rows("out/leaves.csv");
    assert_eq!(area(&leaves, "height"), 177 * 161);
    let (info, pixels) = picture::pixels(&room.bytes("out/refined.png"), Transformations::IDENTITY);
    assert_eq!((info.width, info.height), (177, 161));
    let mut outcomes: BTreeMap<u8, BTreeSet<String>> = BTreeMap::new();
    for leaf in &leaves {
        let i = ((number(leaf, "omega") - 1.0) * 16.0).round() as usize;
        let j = ((number(leaf, "a_h") - 1.0) / 1.1 * 16.0).round() as usize;
        assert!(j < 161 && i < 177, "{leaf:?}");
        let kind = match (&*leaf["outcome"], &*leaf["impacts"]) {
            // After impacts the colour tells their number, not the corner.
            ("overturned_left" | "overturned_right", impacts) if impacts != "0" => "impacts",
            (outcome, _) => outcome,
        };
        outcomes.entry(pixels[(160 - j) * 177 + i]).or_default().insert(kind.into());
    }
    assert!(outcomes.len() >= 4 && outcomes.values().all(|names| names.len() == 1), "{outcomes:?}");
    // In greys nothing has a hue, and lines are over classes that share one.
    room.run(&format!("{PULSE} --refine 4 --palette grey"));
    let (_, pixels) = picture::pixels(&room.bytes("out/refined.png"), Transformations::EXPAND);
    assert!(pixels.chunks(3).all(|pixel| pixel[0] == pixel[1] && pixel[1] == pixel[2]));
    let svg = room.read("out/refined.svg");
    let hexes = svg.split('#').skip(1).filter(|rest| !rest.starts_with("lines"));
    let greys = hexes.map(|rest| (&rest[..2], &rest[2..4], &rest[4..6])).collect::<Vec<_>>();
    assert!(greys.len() > 4 && greys.iter().all(|(r, g, b)| r == g && g == b), "{greys:?}");
    for lines in ["<pattern id=\"lines3\"", "fill=\"url(#lines3)\""] {
        assert!(svg.contains(lines), "{svg}");
    }
    // A run without it takes the files away.
    room.run(PULSE);
    assert!(!room.has("out/leaves.csv") && !room.has("out/refined.svg"));
}

/// Two columns of one name would be one array, and the archive has no two of a name.
#[test]
fn the_height_of_a_leaf_and_that_of_the_block_have_names_of_their_own() {
    let room = Room::new();
    let block = "pulse --half-width 0.1:0.4:9 --height 0.5:2:9 --isolation none --omega 5 --a-h 4";
    let asked = "--refine 2 --backend cpu --verify none --files csv,npz,zarr --out ./out";
    room.run(&format!("{block} {asked}"));
    let head = room.heading("out/leaves.csv");
    assert!(head.starts_with("half_width,height,level,width,leaf_height,"), "{head}");
    assert_eq!(area(&room.rows("out/leaves.csv"), "leaf_height"), 33 * 33);
    assert!(room.has("out/leaves.zarr/leaf_height/zarr.json"));
}

/// Chunks of the leaves' arrays, and what is left of an earlier run's.
#[test]
fn leaves_in_the_store_go_with_their_map() {
    let room = Room::new();
    room.run(&format!("{PULSE} --refine 2 --files csv,zarr"));
    let cells = room.bytes("out/leaves.zarr/cell/c/0");
    // A chunk that only an earlier run with more leaves has.
    room.write("out/leaves.zarr/cell/c/7", "");
    room.run(&format!("{PULSE} --refine 3 --files csv,zarr"));
    assert!(!room.has("out/leaves.zarr/cell/c/7"));
    assert_ne!(room.bytes("out/leaves.zarr/cell/c/0"), cells);
    let names = room.names("out");
    assert!(!names.iter().any(|name| name.starts_with('.') || name.ends_with(".old")), "{names:?}");
    // A map without leaves, and leaves without the store.
    for more in ["--files csv,zarr", "--refine 2 --files csv"] {
        room.run(&format!("{PULSE} --refine 2 --files zarr"));
        assert!(room.has("out/leaves.zarr/zarr.json"));
        room.run(&format!("{PULSE} {more}")).has("leaves.zarr");
        assert!(!room.has("out/leaves.zarr"));
    }
}
