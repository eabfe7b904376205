//! A map in shards: run apart, by one worker or several that may vanish, and joined.

use std::fs;
use std::num::NonZeroUsize;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Barrier, Mutex};
use std::thread;
use std::time::Duration;

use tempfile::TempDir;
use topple::backend::backend_error::BackendError;
use topple::backend::cell_run::CellRun;
use topple::backend::ready::{Backend, RunTimes};
use topple::backend::sink::Sink;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::results::about::Source;
use topple::results::collector::{OutcomeCollector, Saver};
use topple::results::column_set::ColumnSet;
use topple::results::columns::Column;
use topple::results::reader::missing;
use topple::results::shard::Shard;
use topple::results::store::{Contents, Store};
use topple::scene::{Grid, Parameter, Scene};
use topple::stepping::outcome::{Outcome, Status};
use topple::sweep::batches::{self, Sizes, Worker};
use topple::sweep::identity::Content;
use topple::sweep::settings::Method;
use topple::work::observer::Unwatched;

use crate::common::{object, synthetic_pair, under};

#[test]
fn shards_hold_every_cell_once() {
    for (count, of) in [(10, 3), (3, 3), (100, 1), (7, 5), (1 << 40, 1_000_000)] {
        let mut from = 0;
        for number in (1..=of).filter(|number| of < 10 || number % 99_999 < 2 || *number == of) {
            let cells = format!("{number}/{of}").parse::<Shard>().unwrap().cells(count);
            assert!(number % 99_999 > 1 || of < 10 || cells.start <= cells.end);
            if of < 10 {
                assert_eq!(cells.start, from);
                from = cells.end;
            }
            // As even as can be.
            assert!((count / of..=count / of + 1).contains(&cells.len()), "{cells:?}");
        }
        let last: Shard = format!("{of}/{of}").parse().unwrap();
        assert_eq!(last.cells(count).end, count);
    }
    for text in ["0/3", "4/3", "1/0", "1", "", "a/b", "1/3/5", "-1/3", "1.5/3"] {
        assert!(text.parse::<Shard>().unwrap_err().to_string().contains("as in 3/16"), "{text}");
    }
}

fn scene() -> Scene {
    object(1, 0.2, (1.75, 0.75), 0.0, "1:12:24", "1:12:24")
}

fn method() -> Method {
    Method {
        precision: Precision::F32,
        largest_step: 1.0 / 128.0,
        resolve: false,
        full_model: false,
        repair: false,
        columns: ColumnSet::ALL,
    }
}

/// The bytes of a shard's file of samples.
fn samples(scene: &Scene) -> Vec<u8> {
    let pair = scene.excitation.record().unwrap();
    pair.horizontal.iter().chain(pair.vertical.iter()).flat_map(|a| a.to_le_bytes()).collect()
}

/// A scene that went through an identity's text is the scene, to the last bit; the samples of its record are in a file beside it.
#[test]
fn a_scene_comes_back_from_its_identity() {
    let mut shaken = scene();
    under(&mut shaken, synthetic_pair());
    // Numbers whose shortest decimals are easily misread.
    let mut odd = scene();
    odd.set(Parameter::Inertia, 0.1 + 0.2);
    odd.set(Parameter::TMax, f64::MIN_POSITIVE);
    for scene in [scene(), shaken, odd] {
        let shard = Some("2/5".parse().unwrap());
        let content = Content::new(&scene, &Backend::Cpu, &method(), shard);
        let mut read = Content::read(content.identity().unwrap().text()).unwrap();
        assert_eq!(read.lacks_samples(), scene.excitation.record().is_some());
        if read.lacks_samples() {
            let bytes = samples(&scene);
            let mut other = bytes.clone();
            other[8] ^= 1;
            // Both components, and all of them, in this order.
            let swapped = [&bytes[bytes.len() / 2..], &bytes[..bytes.len() / 2]].concat();
            for wrong in [&other[..], &bytes[16..], &bytes[..bytes.len() - 1], &swapped, &[]] {
                assert!(!read.take_samples(wrong) && read.lacks_samples());
            }
            assert!(read.take_samples(&bytes));
        }
        assert_eq!((&read, &read.scene, read.shard), (&content, &scene, shard));
        assert_eq!(read.identity().unwrap(), content.identity().unwrap());
    }
}

/// Sweeps a small map in batches of 50 cells by workers that `fail` tells when to, given the worker and
/// how many batches it has done; the outcomes so far, and the work or its error.
fn sweep(
    workers: usize,
    fail: impl Fn(usize, usize) -> Option<BackendError> + Sync,
) -> (Vec<Outcome>, Result<batches::WorkReport, BackendError>) {
    let scene = scene();
    let (plan, grid) = (Plan::new(&scene, 1.0 / 128.0).unwrap(), Grid::of(&scene));
    let collector = OutcomeCollector::in_memory(grid.len(), Precision::F32, ColumnSet::EVERY);
    let (fail, plan, grid, to) = (&fail, &plan, &grid, &collector);
    let double = |number: usize| -> Worker<'_> {
        let done = AtomicUsize::new(0);
        Box::new(move |cells: Range<usize>| {
            if let Some(error) = fail(number, done.fetch_add(1, Ordering::Relaxed)) {
                return Err(error);
            }
            let run = CellRun::of(plan, grid, cells.clone(), Precision::F32);
            Backend::Cpu.run_into(&run, Sink::from(cells.start, to), &Unwatched)
        })
    };
    let workers: Vec<Worker> = (0..workers).map(double).collect();
    let all = 0..grid.len();
    let took = batches::sweep(&workers, &[all], Sizes::fixed(50));
    drop(workers);
    (collector.into_block().to_outcomes(), took)
}

/// Several workers make the map that one makes, also when some vanish, or break off, on the way; when
/// all do, the sweep ends with the error, and what was done before has been kept.
#[test]
fn adapters_that_vanish_lose_nothing() {
    let (alone, took) = sweep(1, |_, _| None);
    assert!(took.unwrap().lost.is_empty());
    assert!(alone.iter().all(|cell| *cell != Outcome::PENDING));
    let (four, took) = sweep(4, |_, _| None);
    assert!(took.unwrap().lost.is_empty() && four == alone);
    let lost = || BackendError::Lost("unplugged".into());
    // The worker that stays waits until the others are gone: alone it could be done before they begin.
    let vanished = Barrier::new(3);
    let (left, took) = sweep(3, |worker, done| {
        let vanishes = worker > 0 && done >= worker;
        if vanishes || (worker, done) == (0, 0) {
            vanished.wait();
        }
        vanishes.then(lost)
    });
    let gone: Vec<usize> = took.unwrap().lost.iter().map(|(worker, _)| *worker).collect();
    assert!(left == alone && gone.len() == 2 && !gone.contains(&0), "{gone:?}");
    let (left, took) = sweep(2, |worker, _| {
        assert!(worker == 0, "the driver falls");
        None
    });
    assert!(matches!(&took.unwrap().lost[..], [(1, BackendError::BrokeOff)]) && left == alone);
    let (some, took) = sweep(2, |_, done| (done >= 3).then(lost));
    assert!(matches!(took, Err(BackendError::Lost(_))));
    let done = some.iter().filter(|cell| **cell != Outcome::PENDING).count();
    assert_eq!(done, 2 * 3 * 50);
    assert!(some.iter().zip(&alone).all(|(a, b)| *a == Outcome::PENDING || a == b));
}

/// Batches are as many cells as a worker does in the time that they are to take: fewer where cells are slow,
/// at most four times the last where they are fast, and never more than fit.
#[test]
fn batches_are_sized_by_time() {
    // A second a cell up to the hundredth, then a millisecond.
    let ran = Mutex::new(Vec::new());
    let double = |cells: Range<usize>| {
        ran.lock().unwrap().push((cells.start, cells.len()));
        let elapsed = cells.map(|cell| if cell < 100 { 1.0 } else { 1.0e-3 }).sum();
        Ok(RunTimes { elapsed: Duration::from_secs_f64(elapsed), ..RunTimes::default() })
    };
    let sizes = Sizes { first: 50, most: 1000, takes: Duration::from_secs(2) };
    let workers: Vec<Worker> = vec![Box::new(double)];
    let took = batches::sweep(&workers, &[0..110, 200..3000], sizes);
    assert!(took.unwrap().lost.is_empty());
    drop(workers);
    let ran = ran.into_inner().unwrap();
    // 50 s for the first; then 2 s each.
    assert_eq!(ran[..3], [(0, 50), (50, 2), (52, 2)]);
    let fast: Vec<usize> =
        ran.iter().filter(|(first, _)| *first >= 100).map(|(_, cells)| *cells).collect();
    assert_eq!(fast, [2, 8, 32, 128, 512, 1000, 1000, 128]);
    let cells: usize = ran.iter().map(|(_, cells)| cells).sum();
    assert_eq!(cells, 110 + 2800);
}

/// A device lost in the middle: what was kept on disk is found, and the rest makes the same map, in
/// memory or on disk.
#[test]
fn after_a_lost_device_the_run_goes_on() {
    let scene = scene();
    let (plan, grid) = (Plan::new(&scene, 1.0 / 128.0).unwrap(), Grid::of(&scene));
    let all = CellRun::all(&plan, &grid, Precision::F32);
    let alone = Backend::Cpu.run(&all, &Unwatched).unwrap().block.to_outcomes();
    for in_memory in [true, false] {
        let out = TempDir::new().unwrap();
        let open = || {
            let content = Content::new(&scene, &Backend::Cpu, &method(), None);
            let source =
                Source { scene: &scene, precision: Precision::F32, columns: ColumnSet::ALL };
            let contents = Contents { grid: &grid, source };
            Store::open(out.path(), content.identity().unwrap(), contents, true).unwrap()
        };
        for fails in [true, false] {
            let (store, found) = open();
            let left = missing(&found.done(), &(0..grid.len()));
            assert_eq!(left.iter().map(Range::len).sum::<usize>(), if fails { 576 } else { 376 });
            let saver = Saver {
                store: &store,
                patience: Duration::ZERO,
                holds: in_memory,
                threads: NonZeroUsize::MIN,
                go_on: &|| true,
            };
            let collector = OutcomeCollector::saving(saver, &found, 0..grid.len()).unwrap();
            let (to, done) = (&collector, AtomicUsize::new(0));
            let worker: Worker = Box::new(|cells| {
                if fails && done.fetch_add(1, Ordering::Relaxed) == 4 {
                    return Err(BackendError::Lost("unplugged".into()));
                }
                let run = CellRun::of(&plan, &grid, cells.clone(), Precision::F32);
                Backend::Cpu.run_into(&run, Sink::from(cells.start, to), &Unwatched)
            });
            let swept = batches::sweep(&[worker], &left, Sizes::fixed(50));
            assert_eq!(swept.is_err(), fails);
            match fails {
                true => assert!(collector.rescue().unwrap()),
                false => {
                    let outcomes = collector.finish().unwrap();
                    assert_eq!(outcomes.read(0..grid.len(), &Column::ALL).unwrap(), alone);
                }
            }
        }
    }
}

/// Chunks that are complete leave memory while cells run; where one cannot be written, the run hears of it, and what puts
/// outcomes does not wait for it.
#[test]
fn chunks_leave_memory_or_the_run_ends() {
    let text = "[pulse]\nomega = \"1:2:600\"\na_h = \"1:2:1000\"\n[block]\nobject = 1\n[base]\nt_h = 1.75\nt_v = 0.75\n";
    let scene = crate::common::scene(text);
    let grid = Grid::of(&scene);
    let content = Content::new(&scene, &Backend::Cpu, &method(), None);
    for spoiled in [false, true] {
        let out = TempDir::new().unwrap();
        let source = Source { scene: &scene, precision: Precision::F32, columns: ColumnSet::ALL };
        let contents = Contents { grid: &grid, source };
        let (store, found) =
            Store::open(out.path(), content.identity().unwrap(), contents, true).unwrap();
        if spoiled {
            fs::remove_dir_all(store.path()).unwrap();
            fs::write(store.path(), "not a folder").unwrap();
        }
        let patience = Duration::from_secs(3600);
        let saver = Saver {
            store: &store,
            patience,
            holds: false,
            threads: NonZeroUsize::MIN,
            go_on: &|| true,
        };
        let collector = OutcomeCollector::saving(saver, &found, 0..grid.len()).unwrap();
        let cell = |k: usize| Outcome { impacts: k as u32, status: Status::Ok, ..Outcome::PENDING };
        let saved = thread::scope(|scope| {
            let saved = scope.spawn(|| collector.save_meanwhile());
            for first in (0..grid.len()).step_by(1000) {
                let cells: Vec<usize> = (first..first + 1000).collect();
                let outcomes: Vec<Outcome> = cells.iter().map(|k| cell(*k)).collect();
                collector.put(&cells, &outcomes);
            }
            if !spoiled {
                // The last chunks go, too.
                while collector.cells_on_disk() < grid.len() {
                    thread::sleep(Duration::from_millis(1));
                }
            }
            collector.ends();
            saved.join().unwrap()
        });
        assert_eq!((saved.is_err(), collector.failed()), (spoiled, spoiled));
        if !spoiled {
            let read = collector.finish().unwrap();
            let some = read.read(65_530..65_540, &[Column::Impacts]).unwrap();
            assert!(some.iter().map(|cell| cell.impacts).eq(65_530..65_540));
        }
    }
}
