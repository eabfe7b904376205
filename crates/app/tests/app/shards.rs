//! A map in shards by the command: run apart, by one backend or several, and joined.

use serde_json::Value;
use topple::model::precision::Precision;
use topple::results::about::Source;
use topple::results::block::Block;
use topple::results::column_set::ColumnSet;
use topple::results::identity::Identity;
use topple::results::store::{Contents, Store};
use topple::results::tally::Tally;
use topple::scene::Grid;
use topple::stepping::outcome::Outcome;
use topple::sweep::identity::Content;
use topple::sweep::shards::Shards;
use topple::work::observer::Unwatched;
use topple_pictures::map::thinned::{DRAWN, thinned};

use crate::common::room::Room;
use crate::common::{object, own_lines, xy};

/// What is drawn of a very fine grid: cells spread from end to end, each near its place.
#[test]
fn a_fine_map_is_drawn_with_fewer_cells() {
    let scene = object(1, 0.2, (1.75, 0.75), 0.0, "1:12:5000", "1:12:3");
    let grid = Grid::of(&scene);
    let outcomes: Vec<Outcome> =
        (0..15_000).map(|k| Outcome { impacts: k, ..Outcome::PENDING }).collect();
    let map = thinned(&scene, (&grid, 0), (&outcomes, ColumnSet::ALL), DRAWN).unwrap();
    assert_eq!(map.grid.shape(), (DRAWN, 3));
    assert_eq!((map.outcomes[0].impacts, map.outcomes[map.grid.len() - 1].impacts), (0, 14_999));
    let pitch = 11.0 / 4999.0;
    for (cell, outcome) in map.outcomes.iter().enumerate() {
        let (drawn, own) = (xy(&map.grid, cell), xy(&grid, outcome.impacts as usize));
        assert!((drawn.0 - own.0).abs() <= 0.5001 * pitch && drawn.1 == own.1, "{drawn:?} {own:?}");
    }
    assert_eq!(Tally::of(&grid, &outcomes, ColumnSet::ALL).unwrap().cells, 15_000);
}

/// A small map.
const PULSE: &str =
    "pulse --object 1 --t-h 1.75 --t-v 0.75 --t-max 6 --omega 1:12:30 --a-h 1:12:31 --quiet";
const CPU: &str = "--backend cpu";
const MAP: [&str; 4] = ["map.csv", "map.npz", "map.png", "map.svg"];

#[test]
fn merged_shards_are_the_map() {
    let room = Room::new();
    room.run(&format!("{PULSE} {CPU} --out ./whole"));
    // In one directory, out of order; not of one n: they are what they hold.
    for k in ["4/4", "1/2", "3/4"] {
        room.run(&format!("{PULSE} {CPU} --tile {k} --out ./shards"));
    }
    room.run("merge ./shards --quiet --out ./merged");
    room.same("whole", "merged", &MAP);
    let told = room.json("merged");
    let held = told["parts"].as_array().unwrap();
    let cells = |part: &Value| [&part["first"], &part["cells"]].map(|own| own.as_u64().unwrap());
    let held_cells: Vec<_> = held.iter().map(cells).collect();
    assert_eq!(held_cells, [[0, 465], [465, 232], [697, 233]]);
    assert!(held[0]["folder"].as_str().unwrap().ends_with("part-1-of-2"));
    let whole = room.json("whole");
    for key in ["scene", "cells", "outcomes", "precision", "backend", "steps", "model"] {
        assert_eq!(told[key], whole[key], "{key}");
    }
    assert!(!room.has("merged/unfinished") && room.has("shards/part-4-of-4"));
    // A finished shard that is run again is left as it is; begun anew it is refused.
    let report = room.bytes("shards/part-3-of-4/report.json");
    let again = format!("{PULSE} {CPU} --tile 3/4 --out ./shards");
    room.run(&format!("{again} --resume"));
    assert_eq!(room.bytes("shards/part-3-of-4/report.json"), report);
    room.refused(&again);
}

/// A map of shards may have what the same map has.
#[test]
fn merged_shards_have_spectra() {
    let room = Room::new();
    room.run(&format!("{PULSE} {CPU} --spectrum --out ./whole"));
    let periods = "--t-h 1:2:4 --t-v 0.5:1:4 --omega 5 --a-h 3 --t-max 6 --quiet";
    for k in ["1/2", "2/2"] {
        room.run(&format!("{PULSE} {CPU} --tile {k} --out ./shards"));
        room.run(&format!("pulse --object 1 {periods} {CPU} --tile {k} --out ./other"));
    }
    room.run("merge ./shards --quiet --spectrum --out ./merged");
    room.same("whole", "merged", &["spectrum.csv", "spectrum.svg", "spectrum.png"]);
    // Axes without a strength have none.
    let said = "--spectrum: spectra are of a map of two axes";
    room.refuses("merge ./other --quiet --spectrum --out ./none", &[said]);
    assert!(!room.has("none/map.csv"));
}

/// Shards under a record, and of two backends: the manifest says which cells came from where.
#[test]
fn shards_may_come_from_different_backends() {
    let room = Room::new();
    let seismic = "seismic --object 1 --t-h 0.5:4:7 --t-v 0.001:2:6 --quiet";
    let one = format!("{seismic} {CPU} --tile 1/2 --out ./one");
    room.run(&format!("{seismic} {CPU} --out ./whole"));
    room.run(&one);
    room.run(&format!("{seismic} --backend reference --tile 2/2 --out ./other"));
    room.run("merge ./other ./one --quiet --out ./merged");
    let told = room.json("merged");
    assert_eq!(told["backend"], "cpu+reference");
    let from = |shard: &Value| (shard["first"].clone(), shard["backend"].clone());
    assert_eq!(
        told["parts"].as_array().unwrap().iter().map(from).collect::<Vec<_>>(),
        [(0.into(), "cpu".into()), (21.into(), "reference".into())]
    );
    // A shard has the samples of its record in a file, which its identity names; without it the map cannot be verified.
    let samples = "one/part-1-of-2/samples.f64";
    let bytes = room.bytes(samples);
    let identity = room.bytes("one/part-1-of-2/identity.json");
    assert!(bytes.len() > 10 * identity.len(), "{} {}", bytes.len(), identity.len());
    room.write(samples, &bytes[8..]);
    let merge = "merge ./one ./other --quiet --out ./none";
    room.refuses(merge, &["not the samples of the record"]);
    room.remove(samples);
    room.refuses(merge, &["samples.f64"]);
    // Whoever goes on with the shard writes it again.
    room.run(&format!("{one} --resume"));
    assert_eq!(room.bytes(samples), bytes);
    // Half of the rows are the CPU's, the others not.
    let (cpu, both) = (room.rows("whole/map.csv"), room.rows("merged/map.csv"));
    assert_eq!((cpu.len(), both.len()), (42, 42));
    assert!(cpu[..21] == both[..21] && cpu[21..] != both[21..]);
    for name in ["contact.png", "displacement_u.svg", "boundaries.csv"] {
        assert!(room.has(&format!("merged/{name}")), "{name}");
    }
    // What a joining saves is no run's: neither takes the other's for its own.
    let shards = Shards::join(&[room.at("one"), room.at("other")], &Unwatched).unwrap();
    let whole = shards.content.whole();
    let store = shards.store(&room.at("joining")).unwrap();
    assert_eq!(store.files().precision, Precision::F64);
    assert_ne!(store.tag(), whole.identity().unwrap().tag());
}

/// Batches go to each of several devices; here the same adapter's, opened twice.
#[test]
fn two_devices_make_the_map_of_one() {
    if crate::common::gpu("two_devices_make_the_map_of_one", Precision::F32).is_none() {
        return;
    }
    let room = Room::new();
    for (out, adapters, devices) in [("one", "0", 1), ("two", "0,0", 2)] {
        room.run(&format!("{PULSE} --backend gpu --adapter {adapters} --out ./{out}"));
        assert_eq!(room.json(out)["parts"][0]["devices"], devices);
    }
    room.same("one", "two", &MAP);
    for (more, wanted) in [
        ("--backend gpu --adapter 0,99", "there is no adapter 99"),
        ("--backend cpu --adapter 0", "--adapter: the CPU has none"),
    ] {
        let said = room.ended(&format!("{PULSE} {more} --out ./none"));
        let [line] = &own_lines(&said.err)[..] else { panic!("{said:?}") };
        assert!(said.code == 2 && line.contains(wanted), "{line}");
    }
}

#[test]
fn what_is_no_map_is_refused_by_name() {
    let room = Room::new();
    let refused = |shards: &str, said: &[&str]| {
        let shards: String = shards.split(' ').map(|name| format!(" ./{name}")).collect();
        room.refuses(&format!("merge{shards} --quiet --out ./out"), said);
        assert!(!room.has("out"), "{shards}: something was written");
    };
    let shard = |place: &str, of: &str, more: &str| {
        room.run(&format!("{PULSE} {CPU} --tile {of} --out ./{place} {more}"));
    };
    for k in ["1/3", "2/3", "3/3"] {
        shard(&k[..1], k, "");
    }
    refused("1 3", &["no shard holds cells 310 to 619", "shard 2/3 is missing"]);
    refused("2 3", &["cells 0 to 309", "1/3"]);
    refused("1 2", &["cells 620 to 929", "3/3"]);
    shard("half", "1/2", "");
    refused("1 2 3 half", &["part-1-of-3", "part-1-of-2", "overlap", "0 to 309"]);
    refused("1 1 2 3", &["overlap"]);
    shard("other", "2/3", "--eccentricity 0.2");
    let told = "scene.numbers.eccentricity is 0.2 there and 0.0 here";
    refused("1 other 3", &["other/part-2-of-3", "1/part-1-of-3", told]);
    shard("finer", "2/3", "--precision f64");
    refused("1 finer 3", &["finer/part-2-of-3", "precision is \"f64\" there"]);
    room.folder("empty");
    refused("1 empty", &["empty holds no shard"]);
    refused("1 2 nowhere", &["nowhere"]);
    // Without its report a shard is not finished, nor without a chunk.
    let two = "2/part-2-of-3";
    let [report, status, zeta, identity] =
        ["report.json", "status/c/0/0", "zeta/c/0/0", "identity.json"]
            .map(|name| format!("{two}/{name}"));
    let (whole_report, whole_status, whole_zeta) =
        (room.bytes(&report), room.bytes(&status), room.bytes(&zeta));
    room.remove(&report);
    refused("1 2 3", &["part-2-of-3 is unfinished"]);
    room.write(&report, &whole_report);
    room.remove(&status);
    refused("1 2 3", &["unfinished, cells 310 to 619 are missing", "--resume"]);
    room.write(&status, &whole_status);
    let mut damaged = whole_zeta.clone();
    damaged[100] ^= 4;
    room.write(&zeta, damaged);
    refused("1 2 3", &["zeta/c/0/0: damaged", "--resume"]);
    // A column of a shard of another precision is not merged, and --resume does not take it away.
    let finer = room.bytes("finer/part-2-of-3/zeta/c/0/0");
    room.write(&zeta, &finer);
    refused("1 2 3", &["zeta/c/0/0: a chunk of another run; give the folder"]);
    let said = "zeta/c/0/0 is a chunk of another run; move it away";
    room.refuses(&format!("{PULSE} {CPU} --tile 2/3 --resume --out ./2"), &[said]);
    assert_eq!(room.bytes(&zeta), finer);
    room.remove(&zeta);
    refused("1 2 3", &["zeta/c/0/0: missing", "--resume"]);
    // What merge refuses, --resume mends.
    shard("2", "2/3", "--resume");
    assert_eq!((room.bytes(&status), room.bytes(&zeta)), (whole_status, whole_zeta));
    // Another version's shard.
    let version = concat!("\"version\": \"", env!("CARGO_PKG_VERSION"), "\"");
    let old = room.read(&identity).replace(version, "\"version\": \"0.0.1\"");
    let Content { scene, shard: number, .. } = Content::read(&old).unwrap();
    let grid = Grid::of(&scene);
    let source = Source { scene: &scene, precision: Precision::F32, columns: ColumnSet::ALL };
    let contents = Contents { grid: &grid, source };
    let (store, _) =
        Store::open(&room.at("old"), Identity::new(old.clone(), number), contents, false).unwrap();
    let mut block = Block::pending(grid.len(), Precision::F32);
    block.put(310, &vec![Outcome::PENDING; 310]);
    store.save(0, &block).unwrap();
    let report: Value = serde_json::from_slice(&whole_report).unwrap();
    store.finish(&report, false).unwrap();
    refused("1 old 3", &["old/part-2-of-3", "version is \"0.0.1\" there"]);
    // Its identity, with chunks of this one's.
    room.write(&identity, old);
    refused("1 2 3", &["a chunk of another run"]);
    // The same of one that has run no cell of it.
    room.remove(&status);
    refused("1 2 3", &["part-2-of-3 is unfinished"]);
    room.write(&identity, "{");
    refused("1 2 3", &["identity.json cannot be read"]);
    room.refused(&format!("{PULSE} --tile 5/1000000 --out ./out"));
    room.refused(&format!("{PULSE} --tile 3/2 --out ./out"));
}
