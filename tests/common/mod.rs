//! What the tests share.

#![allow(dead_code, clippy::unwrap_used)] // each test binary uses a part of it

#[path = "../../crates/records/tests/common/mod.rs"]
mod records;
pub mod suites;
pub mod values;

pub use records::*;
use topple::backend::backend_error::BackendError;
use topple::backend::description::AdapterDescription;
use topple::backend::gpu::adapter;
use topple::backend::gpu::opened::Gpu;
use topple::model::precision::Precision;
use topple::scene::builder::SceneBuilder;
use topple::scene::record::{Pair, Record, synthetic};
use topple::scene::{Grid, Scene};
use topple::stepping::outcome::Outcome;
use topple::stepping::reference::{self, Settings};

/// The scene of a TOML text.
pub fn scene(text: &str) -> Scene {
    // Tests ask for what is not plausible, too.
    SceneBuilder { force: true, ..SceneBuilder::from_toml(text).unwrap() }.check().unwrap()
}

/// A pulse scene of a block of Table 1 on dual isolation.
pub fn object(
    number: u32,
    eccentricity: f64,
    (t_h, t_v): (f64, f64),
    a_v: f64,
    omega: &str,
    a_h: &str,
) -> Scene {
    scene(&format!(
        "[block]\nobject = {number}\neccentricity = {eccentricity}\n\
         [base]\nt_h = {t_h}\nt_v = {t_v}\n\
         [pulse]\nomega = \"{omega}\"\na_h = \"{a_h}\"\na_v = {a_v}\n"
    ))
}

/// The reference's outcome of a scene of one cell.
pub fn judge(scene: &Scene) -> Outcome {
    reference::run(scene, &Grid::of(scene).case(0), &Settings::default())
}

/// The scene under a record of these samples, m/s^2, to its end.
pub fn shaken(mut scene: Scene, dt: f64, samples: Vec<f64>) -> Scene {
    let record = Record { title: "made".into(), dt, samples, ..Record::default() };
    under(&mut scene, Pair::new(record, None).unwrap());
    scene
}

/// Puts a scene under a pair of records, to its end.
pub fn under(scene: &mut Scene, pair: Pair) {
    scene.shake(pair);
}

/// The synthetic pair.
pub fn synthetic_pair() -> Pair {
    synthetic::pair()
}

/// The adapter to test the shader on. Without one the test is skipped, and says so; where
/// TOPPLE_REQUIRE_ADAPTER is set, that is a failure. An adapter without f64 is there all the same: what
/// is of f64 is skipped on it.
pub fn gpu(test: &str, precision: Precision) -> Option<Gpu> {
    match adapter::best(precision).and_then(|adapter| Gpu::open(&adapter)) {
        Ok(gpu) => {
            let d = &gpu.description;
            say(&format!("{test} ({precision:?}): adapter {} ({}, {})", d.name, d.kind, d.api));
            Some(gpu)
        }
        Err(error @ BackendError::NoF64(_)) => {
            say(&format!("{test} ({precision:?}): SKIPPED, {error}"));
            None
        }
        Err(error) => {
            let required = std::env::var_os("TOPPLE_REQUIRE_ADAPTER").is_some();
            assert!(!required, "{test}: an adapter is required, but: {error}");
            say(&format!("{test} ({precision:?}): SKIPPED, {error}"));
            None
        }
    }
}

/// All adapters of this machine, as [`gpu`] has the best one: a machine may have drivers that are not alike.
pub fn gpus(test: &str, precision: Precision) -> Vec<Gpu> {
    let Some(best) = gpu(test, precision) else { return Vec::new() };
    let others = adapter::all().into_iter().skip(1);
    let able =
        others.filter(|adapter| precision == Precision::F32 || AdapterDescription::of(adapter).f64);
    // A driver may list an adapter and give no device for it.
    let opened = able.filter_map(|adapter| Gpu::open(&adapter).ok()).inspect(|gpu| {
        say(&format!("{test} ({precision:?}): adapter {}, too", gpu.description.name));
    });
    std::iter::once(best).chain(opened).collect()
}

/// The values of a grid's first two axes at a cell.
pub fn xy(grid: &Grid, cell: usize) -> (f64, f64) {
    let at: Vec<f64> = grid.coordinates(cell).collect();
    (at[0], at[1])
}

/// Every cell of a grid.
pub fn all(grid: &Grid) -> Vec<usize> {
    (0..grid.len()).collect()
}
