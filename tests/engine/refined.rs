//! Refined maps against sweeps of the whole finest grid.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::{AtomicUsize, Ordering};

use tempfile::TempDir;
use topple::backend::ready::Backend;
use topple::model::precision::Precision;
use topple::refine::codes::code;
use topple::refine::refined::RefinedMap;
use topple::refine::run::{refine, refine_on};
use topple::refine::settings::RefineSettings;
use topple::results::column_set::ColumnSet;
use topple::results::columns::Column;
use topple::results::outcomes::Outcomes;
use topple::{
    BackendRequest, Observer, Outcome, RunSettings, Saving, Scene, SweepError, Unwatched,
    VerifySettings, sweep,
};

use crate::common::{gpu, object, say, scene};

fn refined(scene: &Scene, on: Backend, settings: &RefineSettings) -> RefinedMap {
    refined_of(ColumnSet::ALL, scene, on, settings)
}

/// The same of a map of some columns.
fn refined_of(
    columns: ColumnSet,
    scene: &Scene,
    on: Backend,
    settings: &RefineSettings,
) -> RefinedMap {
    let mut run = RunSettings::default();
    run.method.columns = columns;
    run.backend = BackendRequest::Cpu;
    run.verify = VerifySettings::cells(0);
    let map = sweep(scene, &[], &run, &Unwatched).unwrap();
    refine_on(&map, &[on], settings, &Unwatched).unwrap()
}

/// All cells of the finest grid, run.
fn dense(map: &RefinedMap) -> Vec<Outcome> {
    let mut run = RunSettings::default();
    run.backend = BackendRequest::Cpu;
    run.verify = VerifySettings::cells(0);
    let dense = sweep(&map.scene, &[], &run, &Unwatched).unwrap();
    dense.outcomes.read(0..map.grid.len(), &Column::ALL).unwrap().into_owned()
}

/// Cells whose outcome differs from that of a dense sweep; those that were run have it to the last bit.
fn wrong(map: &RefinedMap, dense: &[Outcome]) -> usize {
    let told = map.read(0..map.grid.len(), &Column::ALL).unwrap();
    for cell in map.cells() {
        assert_eq!(told[*cell], dense[*cell], "cell {cell} was run");
    }
    told.iter().zip(dense).filter(|(told, right)| code(told) != code(right)).count()
}

/// Leaves in which a cell that was run differs from the first: none may be left.
fn mixed(map: &RefinedMap) -> usize {
    let told = map.read(0..map.grid.len(), &Column::ALL).unwrap();
    let (columns, rows) = map.report.shape;
    let mut first = vec![0; columns * rows];
    for leaf in map.leaves() {
        let own = code(&told[leaf.row * columns + leaf.column]);
        for row in leaf.row..leaf.row + leaf.height {
            first[row * columns + leaf.column..][..leaf.width].fill(own);
        }
    }
    map.cells().iter().filter(|cell| code(&told[**cell]) != first[**cell]).count()
}

fn levels(levels: u32, probes: usize) -> RefineSettings {
    let mut settings = RefineSettings::levels(levels);
    settings.probes = probes;
    settings
}

/// The default map from 25 x 25 cells to 385 x 385.
#[test]
fn a_refined_map_is_the_dense_one_by_a_share_of_its_cells() {
    let scene = object(1, 0.2, (1.75, 0.75), 0.0, "0.2:15:25", "0.1:15:25");
    let map = refined(&scene, Backend::Cpu, &RefineSettings::levels(4));
    let dense = dense(&map);
    let (all, wrong) = (dense.len(), wrong(&map, &dense));
    say(&format!("{wrong} of {all} cells wrong, {} run: {:?}", map.cells().len(), map.report));
    assert_eq!(map.report.shape, (385, 385));
    assert_eq!(map.report.cells, map.cells().len());
    let last = map.report.last_round().unwrap();
    assert!(wrong as f64 <= last.share_missed_at_most * last.left_alone as f64);
    assert!(wrong <= 3);
    // Probes are most of the cells of so small a grid.
    let probes: usize =
        map.report.levels.iter().flat_map(|level| &level.probes).map(|round| round.probes).sum();
    assert!(10 * (map.cells().len() - probes) < all, "{probes} of them probes");
    assert!(map.report.levels.iter().all(|level| level.probes[0].probes == 3000));
    // Each cell of the finest grid is in one leaf, which has its outcome.
    let mut times = vec![0; all];
    for leaf in map.leaves() {
        let first = code(&dense[leaf.row * 385 + leaf.column]);
        for row in leaf.row..leaf.row + leaf.height {
            for column in leaf.column..leaf.column + leaf.width {
                times[row * 385 + column] += 1;
                assert!(wrong > 0 || code(&dense[row * 385 + column]) == first);
            }
        }
    }
    assert!(times.iter().all(|times| *times == 1));
}

/// A map full of thin bands: whatever probes and islands find, no leaf is left with cells that differ, and what was not run
/// is as the last round says.
#[test]
fn where_boundaries_are_everywhere_no_leaf_is_left_mixed() {
    let text = "[block]\nobject = 1\neccentricity = 0.2\n[base]\nt_h = 3\nt_v = 0.2\n[run]\nt_max = 10\n\
                [pulse]\nshape = \"ricker\"\nomega = \"0.5:4:13\"\na_h = \"0.5:4:13\"\na_v = 5\n";
    let map = refined(&scene(text), Backend::Cpu, &levels(3, 300));
    let dense = dense(&map);
    let (wrong, last) = (wrong(&map, &dense), *map.report.last_round().unwrap());
    say(&format!("{wrong} of {} cells wrong, {} run: {last:?}", dense.len(), map.cells().len()));
    assert_eq!(mixed(&map), 0);
    assert!(wrong as f64 <= last.share_missed_at_most * last.left_alone as f64);
    assert!(2 * map.cells().len() < dense.len());
}

/// The same cells on the shader, whose outcomes are the CPU's but beside boundaries.
#[test]
fn the_shader_refines() {
    let Some(gpu) = gpu("the_shader_refines", Precision::F32) else { return };
    let scene = object(1, 0.2, (1.75, 0.75), 0.0, "0.2:15:13", "0.1:15:13");
    let settings = levels(2, 200);
    let on_cpu = refined(&scene, Backend::Cpu, &settings);
    let on_gpu = refined(&scene, Backend::Gpu(Box::new(gpu)), &settings);
    let all = 0..on_cpu.grid.len();
    let codes = |map: &RefinedMap| -> Vec<u8> {
        map.read(all.clone(), &Column::ALL).unwrap().iter().map(code).collect()
    };
    let differ = codes(&on_cpu).iter().zip(codes(&on_gpu)).filter(|(a, b)| **a != *b).count();
    assert!(differ <= 2, "{differ} of {} cells", all.len());
}

/// A window of the default map in whose four cells a side one outcome is all there is: a band of many outcomes, thinner
/// than a tenth of their distance, lies between them.
fn window() -> Scene {
    object(1, 0.2, (1.75, 0.75), 0.0, "0.29:0.41:4", "2.16:2.46:4")
}

/// Subdivision alone follows the boundaries that it meets: here none. Probes find the band.
#[test]
fn islands_smaller_than_the_first_grid_are_found_by_probes() {
    let plain = refined(&window(), Backend::Cpu, &levels(6, 0));
    let probed = refined(&window(), Backend::Cpu, &levels(6, 300));
    let dense = dense(&plain);
    let (missed, left) = (wrong(&plain, &dense), wrong(&probed, &dense));
    say(&format!("{missed} cells wrong without probes, {left} with: {:?}", probed.report));
    assert_eq!((plain.cells().len(), mixed(&plain), mixed(&probed)), (16, 0, 0));
    assert!(plain.report.levels.iter().all(|level| level.boxes == 0));
    assert_eq!(plain.report.last_round().unwrap().share_missed_at_most, 1.0);
    assert!(missed > 20 && 5 * left < missed, "{missed} without probes, {left} with");
    let found: usize = probed.report.levels.iter().map(|level| level.probes[0].missed).sum();
    assert!(found > 0 && 3 * probed.cells().len() < dense.len(), "{found} found");
    let last = probed.report.last_round().unwrap();
    assert!(left as f64 <= last.share_missed_at_most * last.left_alone as f64);
}

/// A window of the last panel of Fig. 14: blocks overturn after 40 to 60 impacts, and between two numbers of them they
/// rock on, in bands thinner than a cell. Those that no cell of a leaf's border shows lie in leaves that are marked.
#[test]
fn bands_thinner_than_a_cell_lie_in_leaves_that_are_marked() {
    let scene = scene(
        "[block]\nobject = 1\neccentricity = -0.4\n[base]\nt_h = 1.75\nt_v = 0.75\n[run]\nt_max = 30\n\
         [pulse]\nomega = \"2.296875:2.33125:9\"\na_h = \"0.990:1.020:21\"\na_v = 0.5\n",
    );
    let map = refined(&scene, Backend::Cpu, &levels(2, 0));
    let dense = dense(&map);
    let told = map.read(0..dense.len(), &Column::ALL).unwrap();
    let columns = map.report.shape.0;
    // Of each mark the cells that were not run; wrong cells beside smaller leaves, marked otherwise, and not marked.
    let (mut not_run, mut wrong) = ([0; 3], [0; 3]);
    for leaf in map.leaves() {
        for row in leaf.row..leaf.row + leaf.height {
            for cell in row * columns + leaf.column..row * columns + leaf.column + leaf.width {
                let alone = usize::from(map.cells().binary_search(&cell).is_err());
                for (count, is_of) in
                    not_run.iter_mut().zip([leaf.beside, leaf.impacts_differ, leaf.is_marked()])
                {
                    *count += alone * usize::from(is_of);
                }
                let place = if leaf.beside { 0 } else { 2 - usize::from(leaf.is_marked()) };
                wrong[place] += usize::from(code(&told[cell]) != code(&dense[cell]));
            }
        }
    }
    say(&format!("{wrong:?} wrong of {} cells, {not_run:?} of marks", dense.len()));
    let report = &map.report;
    assert_eq!(not_run, [report.beside, report.impacts_differ, report.marked]);
    assert!(wrong[1] > 0, "no band crosses a leaf unseen");
    assert_eq!(wrong[2], 0);
}

/// What 40 draws of 60 cells say of the share missed, before what they find is mended: each is one of up to three, and so
/// too small in one of 60, so that of 40 no more than 3 are, with a chance of 99 %.
#[test]
fn the_bound_of_what_is_missed_holds_as_often_as_it_says() {
    let plain = refined(&window(), Backend::Cpu, &levels(5, 0));
    let dense = dense(&plain);
    let share = wrong(&plain, &dense) as f64 / (dense.len() - plain.cells().len()) as f64;
    let mut ran = BTreeSet::new();
    let bounds: Vec<(usize, f64)> = (1..=40)
        .map(|seed| {
            let mut settings = levels(5, 60);
            settings.seed = seed;
            let map = refined(&window(), Backend::Cpu, &settings);
            ran.insert(map.cells().to_vec());
            let first = map.report.levels[0].probes[0];
            (first.missed, first.share_missed_at_most)
        })
        .collect();
    assert_eq!(ran.len(), 40, "two seeds draw the same cells");
    let too_small = bounds.iter().filter(|(_, bound)| *bound < share).count();
    let none = bounds.iter().filter(|(missed, _)| *missed == 0).count();
    say(&format!(
        "{share:.4} missed; {none} of 40 draws found none, {too_small} bounds were too small"
    ));
    assert!(too_small <= 3 && none > 0 && none < 40);
}

/// Ends a sweep after so many cells.
struct Ends(AtomicUsize);

impl Observer for Ends {
    fn advance(&self, cells: usize) {
        let left = self.0.load(Ordering::Relaxed);
        self.0.store(left.saturating_sub(cells), Ordering::Relaxed);
    }

    fn cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed) == 0
    }
}

/// What an interrupted run had refined is taken from its files, and the map is the same.
#[test]
fn an_interrupted_refinement_goes_on() {
    let dir = TempDir::new().unwrap();
    let scene = object(1, 0.2, (1.75, 0.75), 0.0, "1:12:12", "1:12:12");
    let mut run = RunSettings::default();
    run.backend = BackendRequest::Cpu;
    run.verify = VerifySettings::cells(0);
    let map = || {
        let mut run = run.clone();
        run.saving = Some(Saving { resume: true, ..Saving::to(dir.path()) });
        sweep(&scene, &[], &run, &Unwatched).unwrap()
    };
    let settings = levels(4, 1000);
    let alone = refined(&scene, Backend::Cpu, &settings);
    let first = map();
    let error = refine(&first, &settings, &run, &Ends(AtomicUsize::new(2500))).err().unwrap();
    assert!(error.is_cancelled());
    // Of the lists, too, it is said how much is saved.
    let SweepError::Stopped { saved: cells_saved, cells, .. } = error else { panic!("{error}") };
    assert!(144 < cells_saved && cells_saved < cells && cells < alone.cells().len());
    drop(first);
    let lists = dir.path().join("unfinished/lists-177x177");
    let saved = || -> BTreeMap<String, std::time::SystemTime> {
        let files = std::fs::read_dir(&lists).unwrap().map(Result::unwrap);
        let of = |file: std::fs::DirEntry| {
            (file.file_name().into_string().unwrap(), file.metadata().unwrap().modified().unwrap())
        };
        files.map(of).collect()
    };
    let before = saved();
    assert!(before.len() >= 2, "{before:?}");
    let mut second = map();
    let resumed = refine(&second, &settings, &run, &Unwatched).unwrap();
    let after = saved();
    assert!(after.len() > before.len() && before.iter().all(|(name, time)| after[name] == *time));
    assert_eq!(resumed.cells(), alone.cells());
    assert!(
        resumed.read(0..177 * 177, &Column::ALL).unwrap()
            == alone.read(0..177 * 177, &Column::ALL).unwrap()
    );
    second.discard_saved().unwrap();
    assert!(!lists.exists());
}

/// With numbers that are to be smooth, those between cells that were run are right to the tolerance wherever a cell of
/// the dense sweep says so, but for no more than the probes' bound.
#[test]
fn numbers_between_cells_are_within_their_tolerance() {
    let scene = object(1, 0.2, (1.75, 0.75), 0.0, "4:12:9", "2:12:9");
    let mut settings = levels(4, 1000);
    settings.smooth = Some(0.02);
    let plain = refined(&scene, Backend::Cpu, &levels(4, 1000));
    let smooth = refined(&scene, Backend::Cpu, &settings);
    let dense = dense(&smooth);
    let all = 0..dense.len();
    let told = smooth.read(all.clone(), &Column::ALL).unwrap();
    let numbers = |cell: &Outcome| [cell.zeta, cell.min_contact, cell.max_u, cell.stroke_v];
    let range = |k: usize| {
        // That of the cells of the map, as the tolerance is.
        let of = |cell: usize| numbers(&dense[cell])[k];
        let map = (0..129).step_by(16).flat_map(|j| (0..129).step_by(16).map(move |i| j * 129 + i));
        let ends = map.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), cell| {
            (low.min(of(cell)), high.max(of(cell)))
        });
        ends.1 - ends.0
    };
    let ranges = [0, 1, 2, 3].map(range);
    let off = |told: &[Outcome]| {
        let is_off = |cell: &usize| {
            let (told, right) = (numbers(&told[*cell]), numbers(&dense[*cell]));
            (0..4).any(|k| (told[k] - right[k]).abs() > 0.02 * ranges[k] + 1e-6)
        };
        all.clone().filter(is_off).count()
    };
    let (rough, before) = (off(&told), off(&plain.read(all.clone(), &Column::ALL).unwrap()));
    let last = *smooth.report.last_round().unwrap();
    say(&format!("{rough} of {} cells off, {before} without smooth; {last:?}", dense.len()));
    let most =
        (last.share_rough_at_most.unwrap() + last.share_missed_at_most) * last.left_alone as f64;
    assert!(rough as f64 <= most && 5 * rough < before, "{rough} off, at most {most}");
    assert!(smooth.cells().len() > plain.cells().len());
}

/// A number that was not asked for is not to be smooth, also where another one of its kind was: else every cell would run.
#[test]
fn only_columns_that_are_held_are_to_be_smooth() {
    let scene = object(1, 0.2, (1.75, 0.75), 0.0, "4:12:9", "2:12:9");
    let mut settings = levels(3, 100);
    settings.smooth = Some(0.02);
    let cells = |columns: &[&str], settings: &RefineSettings| {
        let columns = ColumnSet::of_names(columns).unwrap();
        refined_of(columns, &scene, Backend::Cpu, settings).cells().len()
    };
    let none = cells(&["max_phi_left"], &settings);
    let one = cells(&["max_u"], &settings);
    let both = cells(&["max_u", "stroke_v"], &settings);
    assert!(none <= one && one <= both && both < 65 * 65, "{none}, {one}, {both}");
}
