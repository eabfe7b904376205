//! Repair: cells beside a boundary that the step has wrong are mended.

use topple::Unwatched;
use topple::sweep::shards::Shards;

use crate::common::room::Room;
use crate::common::synthetic_pair;

/// Shards are repaired when they are joined: a shard does not know its neighbours.
#[test]
fn the_command_repairs_and_says_it_and_so_does_a_merge() {
    let room = Room::new();
    let pair = synthetic_pair();
    for (name, samples) in [("h.txt", &pair.horizontal), ("v.txt", &pair.vertical)] {
        room.write(name, samples.iter().map(|a| format!("{a}\n")).collect::<String>());
    }
    let record = "--horizontal ./h.txt --vertical ./v.txt --dt 0.01 --units m/s2 --scale 2";
    let grid = "--object 1 --eccentricity 0.2 --t-h 0.5:4:24 --t-v 0.03:0.12:24 --backend cpu";
    let run = |more: &str| room.run(&format!("seismic {record} {grid} {more}"));
    run("--repair --files csv,zarr --verify none --out ./whole").has("repair     ").has(" changed");
    let json = room.json("whole");
    assert_eq!(json["repair"], true);
    assert!(json["repaired"]["changed"].as_u64().unwrap() >= 3, "{}", json["repaired"]);
    run("--repair --tile 1/2 --out ./shards");
    run("--repair --tile 2/2 --out ./shards");
    room.run("merge ./shards --files csv,zarr --quiet --verify none --out ./joined");
    room.same("whole", "joined", &["map.csv"]);
    run("--files csv --verify none --out ./plain");
    assert!(room.json("plain")["repaired"].is_null());
    assert!(room.read("whole/map.csv") != room.read("plain/map.csv"));
    // What was saved while the sweep ran is not what map.zarr holds: its chunks are those of the repaired map.
    assert!(room.has("whole/map.zarr/status/c/0/0"), "a chunk of the column");
    let shards = Shards::join(&[room.at("shards")], &Unwatched).unwrap();
    assert!(shards.content.method.repair);
}
