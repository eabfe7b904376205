//! Tiles on the device: two at once, in whatever order their cells end, make the map of one.

use std::sync::atomic::{AtomicUsize, Ordering};

use topple::backend::gpu::opened::Gpu;
use topple::backend::gpu::run::DeviceOutcomes;
use topple::backend::gpu::run::Sweeper;
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::model::real::Real;
use topple::scene::{Grid, Parameter, Range, Scene};
use topple::work::observer::Observer;

use crate::common::{all, gpu, object, synthetic_pair, under};

/// Cells that overturn at once beside some that rock to the end.
fn pulse() -> Scene {
    object(1, 0.2, (1.75, 0.75), 0.5, "0.5:15:30", "0.1:15:20")
}

/// Periods under a record, with clocks of their own.
fn record() -> Scene {
    let mut scene = object(1, 0.2, (1.75, 0.75), 0.0, "5", "3");
    under(&mut scene, synthetic_pair());
    let longer = scene.case().t_max + 3.0;
    scene.set(Parameter::TMax, longer);
    scene.set(Parameter::TH, Range::even(0.5, 3.0, 17));
    scene.set(Parameter::TV, Range::even(0.1, 1.0, 11));
    scene
}

/// Counts the cells that it hears of.
struct Heard(AtomicUsize);

impl Observer for Heard {
    fn advance(&self, cells: usize) {
        self.0.fetch_add(cells, Ordering::Relaxed);
    }
}

fn swept<R: Real>(
    gpu: &Gpu,
    precision: Precision,
    scene: &Scene,
    (tile, events): (usize, usize),
    cells: impl Fn(&Grid) -> Vec<usize>,
) -> DeviceOutcomes<R> {
    let (plan, grid) = (Plan::new(scene, DEFAULT_STEP).unwrap(), Grid::of(scene));
    let cells = cells(&grid);
    let sweeper = match events {
        0 => Sweeper::new(gpu, precision, plan.variant()).unwrap(),
        _ => Sweeper::keeping(gpu, precision, plan.variant(), events).unwrap(),
    };
    let heard = Heard(AtomicUsize::new(0));
    let ran = sweeper.in_tiles_of(tile).sweep::<R>(&plan, &grid, &cells, &heard).unwrap();
    assert_eq!(ran.block.len(), cells.len());
    assert_eq!(heard.0.into_inner(), cells.len(), "progress counts every cell once");
    ran
}

/// The number of tiles, and the dispatches that follow from the clock, have no say in any bit.
#[test]
fn many_tiles_make_the_map_of_one() {
    let Some(gpu) = gpu("many tiles", Precision::F32) else { return };
    for scene in [pulse(), record()] {
        let one = swept::<f32>(&gpu, Precision::F32, &scene, (1 << 15, 0), all).block.to_outcomes();
        for tile in [1, 37, 64] {
            // Tiles of a cell are as many as cells: some will do.
            let few = |grid: &Grid| if tile == 1 { (0..40).collect() } else { all(grid) };
            let many =
                swept::<f32>(&gpu, Precision::F32, &scene, (tile, 0), few).block.to_outcomes();
            assert_eq!(many, one[..many.len()], "tiles of {tile}");
        }
        let odd = |grid: &Grid| all(grid).into_iter().rev().filter(|cell| cell % 3 != 0).collect();
        let chosen = swept::<f32>(&gpu, Precision::F32, &scene, (50, 0), odd).block.to_outcomes();
        for (outcome, cell) in chosen.iter().zip(odd(&Grid::of(&scene))) {
            assert_eq!(*outcome, one[cell], "cell {cell} among others");
        }
    }
}

/// The same in f64, where there is f64.
#[test]
fn many_tiles_make_the_map_of_one_in_f64() {
    let Some(gpu) = gpu("many tiles", Precision::F64) else { return };
    for scene in [pulse(), record()] {
        let one = swept::<f64>(&gpu, Precision::F64, &scene, (1 << 15, 0), all).block.to_outcomes();
        let many = swept::<f64>(&gpu, Precision::F64, &scene, (64, 0), all).block.to_outcomes();
        assert_eq!(many, one);
    }
}

/// The switches that are kept are those of their cells, whatever tile was in their place before.
#[test]
fn switches_stay_with_their_cells() {
    let Some(gpu) = gpu("switches of many tiles", Precision::F32) else { return };
    let one = swept::<f32>(&gpu, Precision::F32, &pulse(), (1 << 15, 4), all);
    let many = swept::<f32>(&gpu, Precision::F32, &pulse(), (64, 4), all);
    assert_eq!(one.events.len(), 4 * one.block.len());
    assert!(one.events.iter().filter(|event| event.kind != 0).count() > 400, "too few to tell");
    assert_eq!(one.events, many.events);
}
