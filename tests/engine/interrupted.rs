//! Runs that are interrupted, and go on: chunks on disk, and their folder.

use std::collections::BTreeMap;
use std::fs;
use std::io::ErrorKind;
use std::num::NonZeroUsize;
use std::ops::Range;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use tempfile::TempDir;
use topple::backend::ready::Backend;
use topple::model::precision::Precision;
use topple::results::about::Source;
use topple::results::block::Block;
use topple::results::chunk::{Fault, check, encode, pack};
use topple::results::chunk_files::ChunkFiles;
use topple::results::chunking::Chunking;
use topple::results::collector::{OutcomeCollector, Saver};
use topple::results::column_set::ColumnSet;
use topple::results::columns::Column;
use topple::results::files::{Directory, WriteError};
use topple::results::reader::{ChunkReader, ShardFolder, missing};
use topple::results::saved_chunks::SavedChunks;
use topple::results::store::{Contents, Store};
use topple::results::store_error::StoreError;
use topple::results::zarr;
use topple::scene::{Grid, Scene};
use topple::stepping::outcome::{Class, Outcome, Status};
use topple::sweep::identity::Content;
use topple::sweep::settings::Method;

use crate::common::object;

/// Outcomes of every class, and of numbers that are easily mistaken.
fn outcomes() -> Vec<Outcome> {
    let one = |class, status, t_uplift| Outcome {
        class,
        status,
        t_uplift,
        impacts: u32::MAX,
        t_end: 1.0e-300,
        zeta: 0.1,
        max_u: f64::MAX,
        min_contact: -0.0,
        ..unasked()
    };
    vec![
        one(Class::FullContact, Status::Ok, None),
        one(Class::Rocking, Status::Proved, Some(0.0)),
        one(Class::OverturnedRight, Status::VerticalLocked, Some(1.5)),
        one(Class::Unresolved, Status::Diverged, None),
    ]
}

/// The same as they are in columns of f32.
fn rounded(outcomes: &[Outcome]) -> Vec<Outcome> {
    let round = |x: f64| f64::from(x as f32);
    let of = |cell: &Outcome| Outcome {
        t_uplift: cell.t_uplift.map(round),
        t_end: round(cell.t_end),
        zeta: round(cell.zeta),
        max_u: round(cell.max_u),
        min_contact: round(cell.min_contact),
        ..*cell
    };
    outcomes.iter().map(of).collect()
}

fn block(outcomes: &[Outcome], precision: Precision) -> Block {
    let mut block = Block::pending(outcomes.len(), precision);
    block.put(0, outcomes);
    block
}

/// A cell that has not run, without the columns that a map has on request.
fn unasked() -> Outcome {
    let none = f64::NAN;
    Outcome {
        acc_plate: none,
        acc_block: none,
        acc_plate_total: none,
        acc_block_total: none,
        base_load: none,
        stop_force: none,
        ..Outcome::PENDING
    }
}

/// The files of a block in a chunk of 6 cells, by their arrays.
fn packed(block: &Block, tag: u32) -> BTreeMap<&'static str, Vec<u8>> {
    let of = |(array, column)| (array, pack(&encode(array, column, block, 6), tag, array));
    zarr::columns(ColumnSet::ALL).map(of).collect()
}

/// The files of chunks of so many cells, of which the second has 4.
fn files_of(folder: &Path, precision: Precision, most: usize) -> ChunkFiles {
    ChunkFiles {
        folder: folder.to_path_buf(),
        chunking: Chunking::with(vec![most + 4], most),
        tag: 7,
        columns: ColumnSet::ALL,
        precision,
    }
}

#[test]
fn a_chunk_holds_its_outcomes_bit_by_bit() {
    for precision in [Precision::F32, Precision::F64] {
        let expected = match precision {
            Precision::F32 => rounded(&outcomes()),
            Precision::F64 => outcomes(),
        };
        let folder = TempDir::new().unwrap();
        let files = files_of(folder.path(), precision, 6);
        let to = Directory::open(folder.path()).unwrap();
        assert!(files.write(&to, 1, &block(&outcomes(), precision), &|| true).unwrap());
        let block = files.read(1).unwrap();
        let mut read = vec![Outcome::PENDING; 4];
        block.read(0, &Column::ALL, &mut read);
        assert_eq!(read, expected);
        assert!(read[0].min_contact.is_sign_negative());
        // Some of the cells, and some of what is known of them.
        let mut some = vec![Outcome::PENDING; 2];
        block.read(1, &[Column::Status, Column::TUplift], &mut some);
        let known = |cell: &Outcome| (cell.status, cell.t_uplift);
        assert_eq!(
            some.iter().map(known).collect::<Vec<_>>(),
            [known(&expected[1]), known(&expected[2])]
        );
        assert!(some.iter().all(|cell| cell.class == Outcome::PENDING.class && cell.zeta == 0.0));
    }
}

/// Every shortening and every bit turned over is found, in each array.
#[test]
fn a_damaged_chunk_is_refused() {
    for (array, bytes) in packed(&block(&outcomes(), Precision::F64), 7) {
        assert_eq!(check(&bytes, 7, array), Ok(()));
        for length in 0..bytes.len() {
            assert!(
                check(&bytes[..length], 7, array).is_err(),
                "{array}: {length} bytes pass for whole"
            );
        }
        for bit in 0..8 * bytes.len() {
            let mut damaged = bytes.clone();
            damaged[bit / 8] ^= 1 << (bit % 8);
            assert_eq!(check(&damaged, 7, array), Err(Fault::Damaged), "{array}: bit {bit} passes");
        }
        assert!(check(&[&bytes[..], &[0]].concat(), 7, array).is_err());
        assert_eq!(check(&bytes, 8, array), Err(Fault::OtherRun));
        assert_eq!(check(&bytes, 7, "other"), Err(Fault::OtherFile));
    }
}

#[test]
fn what_is_missing_is_what_was_not_done() {
    let run = |first: usize, count: usize| first..first + count;
    assert_eq!(missing(&[], &(0..10)), vec![0..10; 1]);
    assert_eq!(missing(&[run(3, 2), run(7, 3)], &(0..10)), [0..3, 5..7]);
    // Out of order, one within another, and beside one another.
    let some = [run(4, 4), run(0, 2), run(5, 1), run(2, 2)];
    assert_eq!(missing(&some, &(0..10)), vec![8..10; 1]);
    assert!(missing(&[run(0, 10)], &(0..10)).is_empty());
    // Of a shard, with what lies before and behind it.
    assert_eq!(missing(&[run(0, 1), run(6, 2), run(12, 3)], &(5..10)), [5..6, 8..10]);
}

/// A map of 70,000 cells: two chunks, of 65,000 and 5,000.
fn scene(eccentricity: f64) -> Scene {
    object(1, eccentricity, (1.75, 0.75), 0.0, "1:9:1000", "1:9:70")
}

fn open(
    out: &Path,
    scene: &Scene,
    precision: Precision,
    resume: bool,
) -> Result<(Store, SavedChunks), StoreError> {
    let method = Method { precision, ..Method::default() };
    let content = Content::new(scene, &Backend::Cpu, &method, None);
    let grid = Grid::of(scene);
    let contents =
        Contents { grid: &grid, source: Source { scene, precision, columns: ColumnSet::ALL } };
    Store::open(out, content.identity().unwrap(), contents, resume)
}

/// Saves outcomes at the beginning of a chunk and, of the first, from cell 8 on.
fn save(store: &Store, chunk: usize) {
    let mut block = Block::pending(store.files().chunking.cells(chunk).len(), Precision::F32);
    block.put(0, &outcomes());
    block.put(8 * (1 - chunk), &outcomes());
    store.save(chunk, &block).unwrap();
}

#[test]
fn a_folder_is_one_runs_at_a_time_and_of_one_scene() {
    let out = TempDir::new().unwrap();
    let f32 = Precision::F32;
    let (store, found) = open(out.path(), &scene(0.2), f32, false).unwrap();
    assert!(found.chunks.is_empty());
    assert!(matches!(open(out.path(), &scene(0.2), f32, true), Err(StoreError::InUse(_))));
    save(&store, 0);
    save(&store, 1);
    drop(store);
    // Not begun anew by mistake, and not mixed with another run.
    assert!(matches!(open(out.path(), &scene(0.2), f32, false), Err(StoreError::Unfinished(_))));
    for (other, precision, said) in [
        (scene(0.4), f32, "scene.numbers.eccentricity is 0.2 there and 0.4 here"),
        (scene(0.2), Precision::F64, "precision is \"f32\" there and \"f64\" here"),
    ] {
        let error = open(out.path(), &other, precision, true).unwrap_err();
        assert!(
            matches!(&error, StoreError::Other { difference, .. } if difference == said),
            "{error}"
        );
    }
    let (store, found) = open(out.path(), &scene(0.2), f32, true).unwrap();
    let left = missing(&found.done(), &(0..70_000));
    assert_eq!(left, [4..8, 12..65_000, 65_004..70_000]);
    store.discard().unwrap();
    assert_eq!(fs::read_dir(out.path()).unwrap().count(), 0);
    // A run that saved nothing leaves nothing.
    drop(open(out.path(), &scene(0.2), f32, false).unwrap());
    assert_eq!(fs::read_dir(out.path()).unwrap().count(), 0);
}

/// Cells are read across chunks, whatever the pieces, as they were saved or held in memory.
#[test]
fn outcomes_are_read_across_chunks() {
    let (scene, all) = (scene(0.2), 0..70_000);
    let cell = |k: usize| Outcome { impacts: k as u32, status: Status::Ok, ..unasked() };
    let outcomes: Vec<Outcome> = all.clone().map(cell).collect();
    let out = TempDir::new().unwrap();
    let across = vec![66_000..70_000, 0..10, 10..64_999, 64_999..66_000];
    let whole = vec![65_000..70_000, 0..65_000];
    for (holds, pieces) in [(true, &across), (false, &across), (true, &whole), (false, &whole)] {
        let (store, found) = open(out.path(), &scene, Precision::F32, true).unwrap();
        let saver = Saver {
            store: &store,
            patience: Duration::from_secs(3600),
            holds,
            threads: NonZeroUsize::MIN,
            go_on: &|| true,
        };
        let collector = OutcomeCollector::saving(saver, &found, all.clone()).unwrap();
        let put = |cells: Vec<usize>| {
            let some: Vec<Outcome> = cells.iter().map(|cell| outcomes[*cell]).collect();
            collector.put(&cells, &some);
        };
        // The last piece comes first; pieces lie across the chunks, or are one each.
        for piece in pieces {
            // Every second cell first; then all come, twice.
            if pieces == &across {
                put(piece.clone().step_by(2).collect());
            }
            for _ in 0..2 {
                put(piece.clone().collect());
            }
        }
        let read = collector.finish().unwrap();
        for (start, end) in
            [(0, 70_000), (0, 1), (64_998, 65_003), (65_000, 65_001), (69_999, 70_000)]
        {
            let cells = read.read(start..end, &Column::ALL).unwrap();
            assert_eq!(cells, &outcomes[start..end], "{start} to {end}");
        }
        store.discard().unwrap();
    }
    let files = || files_of("".as_ref(), Precision::F32, 6);
    let held = |cells: Range<usize>| ShardFolder { cells, files: files() };
    let reader = |held: &[ShardFolder]| ChunkReader::new(held.to_vec(), 10);
    let (one, other) = (held(6..10), held(0..6));
    assert!(reader(&[one.clone(), other.clone()]).is_some());
    assert!(reader(std::slice::from_ref(&one)).is_none(), "cells are missing");
    assert!(reader(&[one.clone(), one, other]).is_none(), "a shard twice");
}

/// What a killed run had begun to write goes when the next one begins.
#[test]
fn leftovers_are_removed() {
    let out = TempDir::new().unwrap();
    fs::write(out.path().join(".topple-map.csv.aB3xY9.part"), "half a map").unwrap();
    for folder in ["map.zarr.old", "leaves.zarr.new", "unfinished.old"] {
        let folder = out.path().join(format!(".topple-{folder}"));
        fs::create_dir_all(folder.join("zeta/c/0")).unwrap();
        fs::write(folder.join("zeta/c/0/0"), "half a chunk").unwrap();
    }
    let mine = [".mine", ".topple-notes", ".topple-thesis.backup", ".topple-unfinished.new"];
    mine.iter().for_each(|name| fs::write(out.path().join(name), "not ours").unwrap());
    let (store, _) = open(out.path(), &scene(0.2), Precision::F32, false).unwrap();
    store.discard().unwrap();
    let entries = fs::read_dir(out.path()).unwrap();
    let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, mine);
}

/// A chunk of which one file is damaged or gone is run again, the others are not.
#[test]
fn a_damaged_chunk_is_run_again() {
    type Change = fn(&mut Vec<u8>) -> bool;
    let turned: Change = |bytes| {
        bytes[20] ^= 1;
        true
    };
    let removed: Change = |_| false;
    for (array, change, fault) in [
        ("zeta", turned, Fault::Damaged),
        ("status", turned, Fault::Damaged),
        ("proved", removed, Fault::Missing),
    ] {
        let out = TempDir::new().unwrap();
        let (store, _) = open(out.path(), &scene(0.2), Precision::F32, false).unwrap();
        save(&store, 0);
        save(&store, 1);
        drop(store);
        let path = out.path().join("unfinished").join(array).join("c/1/0");
        let mut bytes = fs::read(&path).unwrap();
        match change(&mut bytes) {
            true => fs::write(&path, bytes).unwrap(),
            false => fs::remove_file(&path).unwrap(),
        }
        let (_store, found) = open(out.path(), &scene(0.2), Precision::F32, true).unwrap();
        assert_eq!(missing(&found.done(), &(65_000..70_000)), vec![65_000..70_000; 1]);
        assert_eq!(missing(&found.done(), &(0..12)), vec![4..8; 1]);
        assert!(found.broken.contains(&(path.clone(), fault)) && !path.exists(), "{array}");
    }
}

/// A chunk that another run wrote is not taken for one that is damaged: the run is refused, and the chunk stays. The same holds
/// for one that is of the run, and has numbers of another type.
#[test]
fn a_chunk_of_another_run_stays() {
    for same_run in [false, true] {
        let out = TempDir::new().unwrap();
        let (store, _) = open(out.path(), &scene(0.2), Precision::F32, false).unwrap();
        save(&store, 0);
        let tag = if same_run { store.tag() } else { store.tag() ^ 1 };
        drop(store);
        let path = out.path().join("unfinished/zeta/c/0/0");
        // 65,000 numbers of f32, or of f64.
        let count = if same_run { 8 * 65_000 } else { 4 * 65_000 };
        let foreign = pack(&vec![0; count], tag, "zeta/c/0/0");
        fs::write(&path, &foreign).unwrap();
        match open(out.path(), &scene(0.2), Precision::F32, true) {
            Err(StoreError::NotOfThisRun(place)) => assert_eq!(place, path),
            other => panic!("{:?}", other.map(|(_, found)| found)),
        }
        assert_eq!(fs::read(&path).unwrap(), foreign);
    }
}

/// Files of one run that change places are found: of two columns, of two chunks.
#[test]
fn files_that_change_places_are_found() {
    for [one, other] in [["zeta/c/0/0", "max_u/c/0/0"], ["status/c/0/0", "status/c/1/0"]] {
        let out = TempDir::new().unwrap();
        let (store, _) = open(out.path(), &scene(0.2), Precision::F32, false).unwrap();
        save(&store, 0);
        save(&store, 1);
        drop(store);
        let [one, other] = [one, other].map(|name| out.path().join("unfinished").join(name));
        let aside = out.path().join("aside");
        for (from, to) in [(&one, &aside), (&other, &one), (&aside, &other)] {
            fs::rename(from, to).unwrap();
        }
        let (_store, found) = open(out.path(), &scene(0.2), Precision::F32, true).unwrap();
        let wrong = |path: &Path| found.broken.iter().any(|(broken, _)| broken == path);
        assert!(wrong(&one) && wrong(&other), "{:?}", found.broken);
    }
}

/// Columns of another width are no values, though every byte is as it was written.
#[test]
fn a_chunk_of_another_length_is_refused() {
    let folder = TempDir::new().unwrap();
    let to = Directory::open(folder.path()).unwrap();
    let files = |precision, most| files_of(folder.path(), precision, most);
    files(Precision::F64, 6).write(&to, 1, &block(&outcomes(), Precision::F64), &|| true).unwrap();
    assert!(files(Precision::F64, 6).read(1).is_ok());
    for files in [files(Precision::F32, 6), files(Precision::F64, 5)] {
        assert_eq!(files.read(1).unwrap_err().kind(), ErrorKind::InvalidData);
    }
}

/// What has no identity is no run's, be it the copy of a map: it stays, and is not mixed with a run's.
#[test]
fn a_folder_without_an_identity_is_refused_and_stays() {
    let out = TempDir::new().unwrap();
    let (store, _) = open(out.path(), &scene(0.2), Precision::F32, false).unwrap();
    save(&store, 0);
    drop(store);
    let identity = out.path().join("unfinished/identity.json");
    let text = fs::read(&identity).unwrap();
    fs::remove_file(&identity).unwrap();
    let before = files(out.path());
    for resume in [false, true] {
        let error = open(out.path(), &scene(0.2), Precision::F32, resume).unwrap_err();
        assert!(matches!(error, StoreError::Write(WriteError::Foreign(_))), "{error}");
        assert_eq!(files(out.path()), before);
    }
    fs::write(&identity, text).unwrap();
    open(out.path(), &scene(0.2), Precision::F32, true).unwrap();
    fs::write(out.path().join("unfinished/identity.json"), [0xff, 0x7b]).unwrap();
    let error = open(out.path(), &scene(0.2), Precision::F32, true).unwrap_err().to_string();
    assert!(error.contains("its identity cannot be read") && error.len() < 300, "{error}");
}

/// All files of a folder.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let entry = entry.unwrap();
        let name = entry.file_name().into_string().unwrap();
        match entry.file_type().unwrap().is_dir() {
            true => found.extend(
                files(&entry.path())
                    .into_iter()
                    .map(|(within, bytes)| (format!("{name}/{within}"), bytes)),
            ),
            false => {
                found.insert(name, fs::read(entry.path()).unwrap());
            }
        }
    }
    found
}

/// A file that somebody put into a run's folder is there when the run has taken its own away.
#[test]
fn what_somebody_else_put_into_a_runs_folder_stays() {
    let mine = ["unfinished/thesis", "unfinished/zeta/notes", "unfinished/lists-9x9/mine"];
    let out = TempDir::new().unwrap();
    let begun = || {
        let (store, _) = open(out.path(), &scene(0.2), Precision::F32, true).unwrap();
        save(&store, 0);
        for name in mine {
            let path = out.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, name).unwrap();
        }
        store
    };
    let left: BTreeMap<String, Vec<u8>> =
        mine.iter().map(|name| ((*name).into(), name.as_bytes().to_vec())).collect();
    begun().discard().unwrap();
    assert_eq!(files(out.path()), left);
    // Now it is in the way of the next run.
    let error = open(out.path(), &scene(0.2), Precision::F32, true).unwrap_err();
    assert!(error.to_string().contains("was written by no run and is in the way"), "{error}");
    assert_eq!(files(out.path()), left);
    fs::remove_dir_all(out.path().join("unfinished")).unwrap();
    // It goes along with the map that the folder becomes, and a map that has it is not replaced.
    let place = out.path().join("map.zarr");
    begun().publish(&place).unwrap();
    for name in mine {
        let path = place.join(name.strip_prefix("unfinished/").unwrap());
        assert_eq!(fs::read_to_string(path).unwrap(), name);
    }
    let before = files(&place);
    let (store, _) = open(out.path(), &scene(0.2), Precision::F32, true).unwrap();
    save(&store, 0);
    let error = store.publish(&place).unwrap_err();
    assert!(matches!(error, StoreError::Write(WriteError::Foreign(_))), "{error}");
    assert_eq!(files(&place), before);
    assert!(out.path().join("unfinished/status/c/0/0").exists(), "what was saved still is");
}

/// A run has its folder until it is gone: of several that begin and end there none loses what it saved.
#[test]
fn no_run_takes_away_what_another_saves() {
    let out = TempDir::new().unwrap();
    let scene = scene(0.2);
    let running = AtomicUsize::new(0);
    let run = &|number: usize| {
        let mut ended = 0;
        while ended < 6 {
            let store = match open(out.path(), &scene, Precision::F32, true) {
                Ok((store, _)) => store,
                Err(StoreError::InUse(_)) => continue,
                Err(error) => panic!("{error}"),
            };
            assert_eq!(running.fetch_add(1, Ordering::SeqCst), 0, "two runs in a folder");
            save(&store, 1);
            assert!(store.is_used() && store.files().read(1).is_ok(), "what was saved is gone");
            running.fetch_sub(1, Ordering::SeqCst);
            match ended % 3 {
                0 => store.discard().unwrap(),
                1 => store.publish(&out.path().join(format!("map-{number}"))).unwrap(),
                _ => drop(store),
            }
            ended += 1;
        }
    };
    std::thread::scope(|scope| {
        for number in 0..3 {
            scope.spawn(move || run(number));
        }
    });
    let hidden = |name: &String| name.starts_with('.');
    assert!(!files(out.path()).keys().any(hidden), "a lock is left");
}

/// Many files, which take their time to be removed.
fn fill(folder: &Path) {
    fs::create_dir_all(folder.join("zeta/c/7")).unwrap();
    (0..3000).for_each(|k| fs::write(folder.join(format!("zeta/c/7/{k}")), "").unwrap());
}

/// Whoever gets the lock finds nothing that is still being removed.
#[test]
fn a_lock_is_held_until_all_is_removed() {
    for (publishes, with_a_file_of_mine) in [(false, false), (false, true), (true, false)] {
        let out = TempDir::new().unwrap();
        let (store, _) = open(out.path(), &scene(0.2), Precision::F32, false).unwrap();
        save(&store, 1);
        fill(&out.path().join(if publishes { "map.zarr" } else { "unfinished" }));
        if with_a_file_of_mine {
            fs::write(out.path().join("unfinished/thesis"), "mine").unwrap();
        }
        let lock = out.path().join(".topple-unfinished.lock");
        // Nobody holds what has no name any more.
        let is_free = || {
            let lock = fs::OpenOptions::new().write(true).open(&lock);
            lock.map_or(true, |lock| lock.try_lock().is_ok())
        };
        let going = ["unfinished/zeta", ".topple-unfinished.old", ".topple-map.zarr.old"];
        let is_gone = || going.iter().all(|name| !out.path().join(name).exists());
        assert!(!is_free());
        std::thread::scope(|scope| {
            let waits = scope.spawn(|| {
                while !is_free() {}
                is_gone()
            });
            match publishes {
                true => store.publish(&out.path().join("map.zarr")).unwrap(),
                false => store.discard().unwrap(),
            }
            assert!(waits.join().unwrap(), "{publishes}, {with_a_file_of_mine}");
        });
    }
}

/// A map takes the place of the one before as a whole, its documents made anew.
#[test]
fn a_published_map_replaces_the_one_before() {
    let out = TempDir::new().unwrap();
    let place = out.path().join("map.zarr");
    fs::create_dir_all(place.join("max_v/c/9")).unwrap();
    fs::write(place.join("max_v/c/9/9"), "").unwrap();
    let (store, _) = open(out.path(), &scene(0.2), Precision::F32, false).unwrap();
    save(&store, 0);
    for name in ["zarr.json", "zeta/zarr.json", "omega/c/0"] {
        fs::remove_file(out.path().join("unfinished").join(name)).unwrap();
    }
    store.publish(&place).unwrap();
    let names = |place: &Path| fs::read_dir(place).unwrap().count();
    assert_eq!(names(out.path()), 1, "no leftovers");
    for name in ["zarr.json", "zeta/zarr.json", "omega/c/0", "status/c/0/0"] {
        assert!(place.join(name).exists(), "{name}");
    }
    for name in ["max_v/c/9", "identity.json"] {
        assert!(!place.join(name).exists(), "{name}");
    }
}

/// A kill between the files of a chunk that is saved again: what the last status says is there.
#[test]
fn a_chunk_half_saved_again_is_as_it_was() {
    let out = TempDir::new().unwrap();
    let (store, _) = open(out.path(), &scene(0.2), Precision::F32, false).unwrap();
    save(&store, 0);
    let status = out.path().join("unfinished/status/c/0/0");
    let before = fs::read(&status).unwrap();
    let mut more = store.files().read(0).unwrap();
    more.put(4, &outcomes());
    store.save(0, &more).unwrap();
    drop(store);
    fs::write(&status, before).unwrap();
    let (_store, found) = open(out.path(), &scene(0.2), Precision::F32, true).unwrap();
    assert_eq!(missing(&found.done(), &(0..12)), vec![4..8; 1]);
    assert!(found.broken.is_empty());
}
