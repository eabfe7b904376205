//! The library's one call: what it returns, how it resumes, how it is ended, what its errors name.

use std::fs;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use tempfile::TempDir;
use topple::backend::cell_run::CellRun;
use topple::backend::ready::Backend;
use topple::backend::request::BackendRequest;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::results::column_set::ColumnSet;
use topple::results::columns::Column;
use topple::scene::{Grid, Parameter, Scene, Values};
use topple::sweep::error::SweepError;
use topple::sweep::run::sweep;
use topple::sweep::settings::{RunSettings, Saving, VerifySettings};
use topple::sweep::verification::Verdict;
use topple::work::observer::{Observer, Phase, Unwatched};

use crate::common::{object, synthetic_pair, under};

/// Sweeps share the threads of one pool: of two at once each waits for the other.
static ALONE: Mutex<()> = Mutex::new(());

fn alone() -> MutexGuard<'static, ()> {
    ALONE.lock().unwrap_or_else(PoisonError::into_inner)
}

fn scene() -> Scene {
    object(1, 0.2, (1.75, 0.75), 0.0, "1:12:24", "1:12:25")
}

fn settings() -> RunSettings {
    let mut settings = RunSettings::default();
    settings.backend = BackendRequest::Cpu;
    settings.verify = VerifySettings::cells(16);
    settings
}

/// Hears phases, and of each how many cells; ends the sweep when so many were heard of.
struct Ear {
    phases: Mutex<Vec<(Phase, usize)>>,
    heard: AtomicUsize,
    ends_at: usize,
}

impl Ear {
    fn ending_at(cells: usize) -> Ear {
        Ear { phases: Mutex::default(), heard: AtomicUsize::new(0), ends_at: cells }
    }
}

impl Observer for Ear {
    fn advance(&self, cells: usize) {
        self.heard.fetch_add(cells, Ordering::Relaxed);
    }

    fn cancelled(&self) -> bool {
        self.heard.load(Ordering::Relaxed) >= self.ends_at
    }

    fn begins(&self, phase: Phase, total: usize) {
        self.phases.lock().unwrap().push((phase, total));
    }
}

/// Columns are those of the cells run alone, axes given with the call take the place of the scene's, and
/// every phase is told with what it has to do.
#[test]
fn a_call_gives_columns_and_tells_its_phases() {
    let _alone = alone();
    let axes = [
        (Parameter::Omega, Values::from("1:9:7".parse::<topple::scene::Range>().unwrap())),
        (Parameter::Eccentricity, Values::from(0.0)),
    ];
    let ear = Ear::ending_at(usize::MAX);
    let map = sweep(&scene(), &axes, &settings(), &ear).unwrap();
    let mut expected = scene();
    for (parameter, values) in axes {
        expected.set(parameter, values);
    }
    assert_eq!(map.plan.scene, expected);
    assert_eq!(map.grid.shape(), (7, 25));
    let alone = {
        let (plan, grid) = (Plan::new(&expected, 1.0 / 128.0).unwrap(), Grid::of(&expected));
        Backend::Cpu
            .run(&CellRun::all(&plan, &grid, Precision::F32), &Unwatched)
            .unwrap()
            .block
            .to_outcomes()
    };
    let (zeta, outcome) = (map.column(Column::Zeta).unwrap(), map.column(Column::Outcome).unwrap());
    for (cell, expected) in alone.iter().enumerate() {
        assert_eq!(zeta[cell], f64::from(expected.zeta as f32));
        assert_eq!(outcome[cell], f64::from(expected.class as u8));
        assert_eq!(map.outcome(cell).unwrap().impacts, expected.impacts);
    }
    let told = ear.phases.into_inner().unwrap();
    let expected = [
        (Phase::Sweeping, 175),
        (Phase::Choosing, 350 + 16 * Column::ALL.len()),
        (Phase::Verifying, 16),
    ];
    assert_eq!(told, expected);
    assert_eq!(ear.heard.into_inner(), expected.iter().map(|(_, cells)| cells).sum::<usize>());
    assert_eq!(map.verification.unwrap().sampled, 16);
}

/// A sweep that is ended says what is saved; resumed, it runs the rest only and makes the same map. On the CPU
/// that is in the middle of a batch, also where each cell runs twice and where some are of another model.
#[test]
fn what_is_saved_is_resumed() {
    let _alone = alone();
    let mut rigid = scene();
    under(&mut rigid, synthetic_pair());
    rigid.set(Parameter::TH, "0.5:4:24".parse::<topple::scene::Range>().unwrap());
    rigid.set(Parameter::TV, "0.001:2:25".parse::<topple::scene::Range>().unwrap());
    for (scene, backend, resolve, ends_at) in [
        (scene(), BackendRequest::Reference, false, 520),
        (scene(), BackendRequest::Cpu, false, 300),
        (scene(), BackendRequest::Cpu, true, 900),
        (rigid, BackendRequest::Cpu, false, 400),
    ] {
        let out = TempDir::new().unwrap();
        let mut settings = settings();
        settings.backend = backend;
        settings.method.resolve = resolve;
        settings.verify = VerifySettings::cells(0);
        let whole = sweep(&scene, &[], &settings, &Unwatched).unwrap();
        let saving = Saving { every: Duration::ZERO, resume: true, ..Saving::to(out.path()) };
        settings.saving = Some(saving);
        let Err(error) = sweep(&scene, &[], &settings, &Ear::ending_at(ends_at)) else { panic!() };
        assert!(error.is_cancelled());
        let SweepError::Stopped { saved, cells, folder, .. } = &error else { panic!("{error}") };
        assert!(*saved > 0 && saved < cells && *cells == 600 && folder.exists(), "{error}");
        let said = error.to_string();
        assert!(said.contains(&format!("{saved} of 600 cells are saved in")), "{said}");
        let ear = Ear::ending_at(usize::MAX);
        let mut map = sweep(&scene, &[], &settings, &ear).unwrap();
        let left = (600 - saved) * if resolve { 2 } else { 1 };
        assert_eq!(*ear.phases.lock().unwrap(), [(Phase::Sweeping, left)]);
        for column in ColumnSet::ALL.columns() {
            let bits = |values: Vec<f64>| values.into_iter().map(f64::to_bits).collect::<Vec<_>>();
            let [one, other] = [&whole, &map].map(|map| bits(map.column(column).unwrap()));
            assert_eq!(one, other, "{column:?}");
        }
        map.discard_saved().unwrap();
        assert_eq!(fs::read_dir(out.path()).unwrap().count(), 0);
    }
}

/// A run under a record of a million samples goes on where it was ended: what it says of itself is a few kilobytes, whatever the
/// record holds, and tells the samples apart.
#[test]
fn a_run_under_a_long_record_is_resumed() {
    let _alone = alone();
    let samples = |factor: f64| -> Vec<f64> {
        (0..1_000_000).map(|k| factor * (0.01 * f64::from(k)).sin() / 3.0).collect()
    };
    let shaken = |factor: f64| {
        let text =
            "[block]\nobject = 1\n[base]\nisolation = \"none\"\n[pulse]\nomega = 5\na_h = 1\n";
        // Most of the cells overturn within seconds, of a hundred.
        let scene = crate::common::scene(text);
        let mut scene = crate::common::shaken(scene, 1.0e-4, samples(factor));
        scene.set(Parameter::Scale, "0.1:400:72".parse::<topple::scene::Range>().unwrap());
        scene
    };
    let out = TempDir::new().unwrap();
    let mut settings = settings();
    settings.verify = VerifySettings::cells(0);
    let saving = Saving { every: Duration::ZERO, resume: true, ..Saving::to(out.path()) };
    settings.saving = Some(saving);
    let scene = shaken(1.0);
    let Err(error) = sweep(&scene, &[], &settings, &Ear::ending_at(1)) else { panic!() };
    let SweepError::Stopped { saved, .. } = error else { panic!("{error}") };
    assert!(saved > 0 && saved < 72, "{saved}");
    let identity = fs::metadata(out.path().join("unfinished/identity.json")).unwrap();
    assert!(identity.len() < 10_000, "{} bytes", identity.len());
    // One sample in the last digit.
    let mut other = samples(1.0);
    other[777_777] = f64::from_bits(other[777_777].to_bits() + 1);
    let mut another = scene.clone();
    another = crate::common::shaken(another, 1.0e-4, other);
    let Err(error) = sweep(&another, &[], &settings, &Unwatched) else { panic!() };
    assert!(error.to_string().contains("samples is"), "{error}");
    let ear = Ear::ending_at(usize::MAX);
    let mut map = sweep(&scene, &[], &settings, &ear).unwrap();
    assert_eq!(*ear.phases.lock().unwrap(), [(Phase::Sweeping, 72 - saved)]);
    assert_eq!(map.shards[0].1.resumed_cells, saved);
    map.discard_saved().unwrap();
}

/// What cannot be saved ends the sweep with its error long before its last cell.
#[test]
fn what_cannot_be_saved_ends_the_sweep() {
    /// Puts a file in the place of the folder of what is saved, while cells run.
    struct Spoils(PathBuf);
    impl Observer for Spoils {
        fn advance(&self, _: usize) {
            // The folder may be written to at this moment, and is removed after the next cell then.
            let _ = fs::remove_dir_all(&self.0);
            let _ = fs::write(&self.0, "not a folder");
        }
    }
    let _alone = alone();
    let out = TempDir::new().unwrap();
    let mut settings = settings();
    settings.backend = BackendRequest::Reference;
    settings.saving = Some(Saving { every: Duration::ZERO, ..Saving::to(out.path()) });
    let large = object(1, 0.2, (1.75, 0.75), 0.0, "0.2:15:3000", "0.1:15:3000");
    let spoils = Spoils(out.path().join("unfinished"));
    let Err(error) = sweep(&large, &[], &settings, &spoils) else { panic!("it ran to its end") };
    assert!(!error.is_cancelled() && error.to_string().contains("unfinished"), "{error}");
}

/// What was not asked for is compared with nothing: neither zeta beside another angle, nor times.
#[test]
fn only_columns_that_are_held_are_compared() {
    let _alone = alone();
    for (columns, [zeta, t_end]) in [
        (&["max_phi_left"][..], [false, false]),
        (&["zeta"], [true, false]),
        (&["max_phi_left", "t_end"], [false, true]),
    ] {
        let mut settings = settings();
        settings.method.columns = ColumnSet::of_names(columns).unwrap();
        let verified = sweep(&scene(), &[], &settings, &Unwatched).unwrap().verification.unwrap();
        assert_eq!(verified.verdict, Verdict::Right, "{columns:?}: {verified:?}");
        let known = [verified.worst_zeta, verified.worst_t_end].map(|worst| worst.is_some());
        assert_eq!(known, [zeta, t_end], "{columns:?}");
        assert!(verified.worst_zeta.is_none_or(|worst| worst < 0.01), "{verified:?}");
    }
}

/// A verification without time says that nothing is verified; the map is there.
#[test]
fn a_verification_keeps_to_its_time() {
    let _alone = alone();
    let mut settings = settings();
    settings.verify.within = Duration::ZERO;
    let map = sweep(&scene(), &[], &settings, &Unwatched).unwrap();
    let verification = map.verification.unwrap();
    assert_eq!((verification.chosen, verification.sampled), (16, 0));
    assert_eq!(verification.verdict, Verdict::Nothing);
}

/// Ended by a flag at some moment, on each backend and in the verification, a sweep is over within a tenth of a second on a
/// machine that has nothing else to do. A busy one may have ten times as many threads as cores, and take ten times as long:
/// the median of three moments must be below a second, and all are printed.
#[test]
fn a_flag_ends_a_sweep_at_once() {
    let _alone = alone();
    let mut shaken = object(1, 0.2, (1.75, 0.75), 0.0, "1:12:24", "1:12:25");
    under(&mut shaken, synthetic_pair());
    shaken.set(Parameter::TH, "0.5:4:600".parse::<topple::scene::Range>().unwrap());
    shaken.set(Parameter::TV, "0.1:2:600".parse::<topple::scene::Range>().unwrap());
    let pulse = object(1, 0.2, (1.75, 0.75), 0.0, "0.2:15:3000", "0.1:15:3000");
    for (scene, backend) in [
        (&pulse, BackendRequest::Cpu),
        (&shaken, BackendRequest::Cpu),
        (&pulse, BackendRequest::Reference),
        (&shaken, BackendRequest::Reference),
    ] {
        let mut settings = settings();
        settings.backend = backend;
        let mut late = Vec::new();
        for after in [20, 150, 700] {
            let flag = AtomicBool::new(false);
            let (error, elapsed) = std::thread::scope(|scope| {
                let run = scope.spawn(|| {
                    let error = sweep(scene, &[], &settings, &flag).err();
                    (error, Instant::now())
                });
                std::thread::sleep(Duration::from_millis(after));
                let set = Instant::now();
                flag.store(true, Ordering::Relaxed);
                let (error, ended) = run.join().unwrap();
                (error, ended.saturating_duration_since(set))
            });
            assert!(error.is_some_and(|error| error.is_cancelled()), "it ran to its end");
            late.push(elapsed.as_secs_f64());
        }
        crate::common::say(&format!("{backend:?}: ended after {late:.3?} s"));
        late.sort_by(f64::total_cmp);
        assert!(late[1] < 1.0, "{backend:?}: {late:?}");
    }
}

/// Errors name keys, never flags: who has flags puts them in.
#[test]
fn errors_name_keys() {
    let _alone = alone();
    let key = |scene: &Scene, settings: &RunSettings| {
        let error = sweep(scene, &[], settings, &Unwatched).err().unwrap();
        let said = error.to_string();
        assert!(!said.contains("--"), "{said}");
        (error.key(), said)
    };
    let negative = scene().with(Parameter::TH, -1.0);
    assert_eq!(
        key(&negative, &settings()),
        (Some("t_h"), "t_h: -1 must be a positive number".into())
    );
    let mut finer = settings();
    finer.method.largest_step = -1.0;
    assert_eq!(key(&scene(), &finer).0, Some("step"));
    let mut of_cpu = settings();
    of_cpu.adapters = vec![0];
    let (of, said) = key(&scene(), &of_cpu);
    assert!(of == Some("adapter") && said.contains("give `backend` gpu"), "{said}");
    let out = TempDir::new().unwrap();
    let mut saving = settings();
    saving.backend = BackendRequest::Reference;
    saving.saving = Some(Saving { every: Duration::ZERO, ..Saving::to(out.path()) });
    assert!(sweep(&scene(), &[], &saving, &Ear::ending_at(520)).is_err());
    let (of, said) = key(&scene(), &saving);
    assert!(of == Some("out") && said.contains("`resume` goes on with it"), "{said}");
    saving.saving = Some(Saving { shard: Some("1/2".parse().unwrap()), ..Saving::to(out.path()) });
    assert_eq!(key(&scene(), &saving).0, Some("tile"));
}

/// Of a run that its observer ends, what was done since the last saving is saved, unless it is to end at once.
#[test]
fn a_run_that_is_to_end_at_once_saves_nothing_more() {
    let _alone = alone();
    for at_once in [false, true] {
        let out = TempDir::new().unwrap();
        let mut saving = settings();
        saving.backend = BackendRequest::Reference;
        let hour = Duration::from_secs(3600);
        // Of a map that memory does not hold all is saved at the end, however short the run was.
        saving.saving = Some(Saving {
            every: hour,
            memory: 0,
            ends_at_once: at_once,
            ..Saving::to(out.path())
        });
        let swept = sweep(&scene(), &[], &saving, &Ear::ending_at(300));
        let Err(error) = swept else { panic!("it was not ended") };
        assert!(error.is_cancelled(), "{error}");
        let saved = out.path().join("unfinished/identity.json").exists();
        assert_eq!(saved, !at_once, "{error}");
        let whole =
            Saving { resume: true, memory: 0, ends_at_once: at_once, ..Saving::to(out.path()) };
        saving.saving = Some(whole);
        let map = sweep(&scene(), &[], &saving, &Unwatched).unwrap();
        assert_eq!(map.shards[0].1.resumed_cells > 0, !at_once);
    }
}
