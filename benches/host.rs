//! What the host does for each cell of a GPU sweep, as wall time over cells: it bounds the cells a
//! second of any card.
//!
//! `cargo bench --bench host`; RAYON_NUM_THREADS=2 for two cores.

#![allow(missing_docs, clippy::unwrap_used)] // a bench

mod common;

use std::hint::black_box;
use std::ops::Range;
use std::time::{Duration, Instant};

use common::pulse;
use rayon::prelude::*;
use topple::Written;
use topple::backend::gpu::opened::Gpu;
use topple::backend::gpu::tile::{OwnClocks, Tile};
use topple::backend::gpu::{adapter, outcomes};
use topple::backend::sink::Sink;
use topple::cells::cell_list::CellList;
use topple::cells::cell_tables::CellTables;
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::cells::ready::Cells;
use topple::model::precision::Precision;
use topple::model::real::Real;
use topple::results::collector::OutcomeCollector;
use topple::results::column_set::ColumnSet;
use topple::scene::record::synthetic;
use topple::scene::{self, Grid, Parameter, Scene};
use topple::stepping::state::{FINISHED, State};
use topple::work::observer::Unwatched;

/// Cells of a tile.
const TILE: usize = 1 << 18;
/// Times that each part is measured; the shortest counts.
const TIMES: usize = 7;

/// A map of periods under the synthetic record, and two seconds of rest.
fn record(side: u32) -> Scene {
    let mut scene = pulse(2);
    let pair = synthetic::pair();
    let end = pair.duration() + 2.0;
    scene.shake(pair);
    scene.set(Parameter::TMax, end);
    scene.set(Parameter::TH, scene::Range::even(0.5, 4.0, side));
    scene.set(Parameter::TV, scene::Range::even(0.05, 1.0, side));
    scene
}

/// The shortest time that something took, a cell.
fn each(cells: usize, mut part: impl FnMut()) -> f64 {
    let mut shortest = Duration::MAX;
    for _ in 0..TIMES {
        let began = Instant::now();
        part();
        shortest = shortest.min(began.elapsed());
    }
    shortest.as_secs_f64() * 1.0e9 / cells as f64
}

/// What is handed to the device of a tile.
fn input<R: Real>(tables: &CellTables<R>, tile: Range<usize>) -> Vec<Vec<u8>> {
    let bytes = |own: OwnClocks<R>| {
        vec![bytemuck::cast_slice(&own.numbers).to_vec(), bytemuck::cast_slice(&own.steps).to_vec()]
    };
    OwnClocks::of(tables, tile).map_or(Vec::new(), bytes)
}

/// The tiles of a given number of cells.
fn tiles_of(cells: usize) -> impl Iterator<Item = Range<usize>> {
    (0..cells).step_by(TILE).map(move |first| first..cells.min(first + TILE))
}

fn measure<R: Real>(name: &str, precision: Precision, scene: &Scene, gpu: Option<&Gpu>) {
    let plan = Plan::new(scene, DEFAULT_STEP).unwrap().at(precision);
    let grid = Grid::of(scene);
    let all = CellList::from(0..grid.len());
    let record = plan.record();
    let cells = Cells::<R>::of(&plan, &grid, all, &record, &Unwatched);
    let tables = each(all.len(), || {
        black_box(CellTables::<R>::of(&plan, &grid, all));
    });
    let tiles = each(all.len(), || {
        for tile in tiles_of(all.len()) {
            black_box(Tile::default().place(grid.shape().0, all.part(tile.clone())));
            black_box(OwnClocks::of(&cells.tables, tile));
        }
    });
    let mut upload = f64::NAN;
    let mut size = 0;
    if let Some(gpu) = gpu {
        let parts: Vec<Vec<u8>> =
            tiles_of(all.len()).flat_map(|tile| input(&cells.tables, tile)).collect();
        size = parts.iter().map(Vec::len).sum();
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: size.max(16) as u64,
            usage: wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        upload = each(all.len(), || {
            for part in parts.iter().filter(|part| !part.is_empty()) {
                gpu.queue.write_buffer(&buffer, 0, part);
            }
            gpu.queue.submit([]);
            gpu.wait(None).unwrap();
        });
    }
    let states: Vec<State<R>> = (0..all.len())
        .into_par_iter()
        .map(|index| State { status: FINISHED, uplifts: 1, ..cells.begin(index).1 })
        .collect();
    let begin = each(all.len(), || {
        let states = (0..all.len()).into_par_iter().map(|index| cells.begin(index));
        let (made, states): (Vec<_>, Vec<_>) = states.unzip();
        black_box((made.len(), states.len()));
    });
    let bytes: &[u8] = bytemuck::cast_slice(&states);
    let size_of_state = size_of::<State<R>>();
    let clocks: Vec<Option<OwnClocks<R>>> =
        tiles_of(all.len()).map(|tile| OwnClocks::of(&cells.tables, tile)).collect();
    let read = each(all.len(), || {
        let columns = ColumnSet::ALL.held();
        let collector = OutcomeCollector::in_memory(all.len(), precision, columns);
        let tiles = tiles_of(all.len()).zip(bytes.chunks(TILE * size_of_state)).zip(&clocks);
        for ((tile, bytes), own) in tiles {
            outcomes::read(&cells, tile, own.as_ref(), bytes, Sink::from(0, &collector)).unwrap();
        }
        black_box(collector.into_block().len());
    });
    let total = tables + tiles + read + if upload.is_nan() { 0.0 } else { upload };
    println!(
        "{name:<18} {:<4} tables {tables:5.2}  tiles {tiles:5.2}  handed over {upload:5.2} ({:.1} B)  \
         outcomes {read:5.2}  together {total:5.2} ns a cell  \
         (cells made by the host: {begin:5.1})",
        precision.key(),
        size as f64 / all.len() as f64,
    );
}

fn main() {
    println!("the host's part of a GPU sweep, {} threads", rayon::current_num_threads());
    let gpu = adapter::best(Precision::F32).and_then(|adapter| Gpu::open(&adapter)).ok();
    if gpu.is_none() {
        println!("no adapter: what is handed over is not measured");
    }
    for (name, scene) in [("pulse 1024 x 1024", pulse(1024)), ("record 400 x 400", record(400))] {
        measure::<f32>(name, Precision::F32, &scene, gpu.as_ref());
        measure::<f64>(name, Precision::F64, &scene, gpu.as_ref());
    }
}
