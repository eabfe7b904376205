//! The shader on devices that make use of what WGSL permits them: divisions and roots that are not exact,
//! other rounding, fused products, denormals flushed, no NaN. Each such device is the shader itself with
//! calls of functions (`device.wgsl`) in place of its operations, run on an adapter that has f64.
//!
//! `cargo bench --profile dev --bench worst_device`, and part of a device's name for some of them.

#![allow(missing_docs, clippy::unwrap_used)] // a bench

mod perturb;

use std::time::Instant;

use perturb::{Device, Fusing, Rounding};
use topple::backend::gpu::adapter;
use topple::backend::gpu::opened::Gpu;
use topple::backend::gpu::run::Sweeper;
use topple::backend::gpu::shader::{self, Switches};
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::scene::builder::SceneBuilder;
use topple::scene::{Grid, Scene};
use topple::stepping::outcome::Outcome;
use topple::work::observer::Unwatched;
use topple_lab::chart::bench::MAPS;

/// What a device is to show.
#[derive(Clone, Copy, PartialEq)]
enum Expected {
    /// Every field of every outcome as the shader has it.
    Nothing,
    /// The same outcomes, and impact counts that differ in fewer than one cell in `RARE`.
    SameOutcomes,
    /// Impact counts that differ in more cells: what is not permitted must show.
    Difference,
}

/// See [`Expected`].
const RARE: usize = 100;

/// A map of the ten in crates/lab/tests/lab/agreement.rs.
fn map((a_v, e): (f64, f64)) -> Scene {
    let text = format!(
        "[block]\nobject = 1\neccentricity = {e}\n[base]\nt_h = 1.75\nt_v = 0.75\n\
         [pulse]\nomega = \"0.2:15:60\"\na_h = \"0.1:15:60\"\na_v = {a_v}\n"
    );
    SceneBuilder::from_toml(&text).unwrap().check().unwrap()
}

/// The ten maps by a shader's text.
fn sweep(gpu: &Gpu, source: &str) -> Vec<Outcome> {
    let mut compiled: Vec<(_, Sweeper)> = Vec::new();
    let mut outcomes = Vec::new();
    for scene in MAPS.map(map) {
        let plan = Plan::new(&scene, DEFAULT_STEP).unwrap().at(Precision::F32);
        let variant = plan.variant();
        if !compiled.iter().any(|(known, _)| *known == variant) {
            compiled.push((variant, Sweeper::from_source(gpu, source, variant, 0).unwrap()));
        }
        let (_, sweeper) = compiled.iter().find(|(known, _)| *known == variant).unwrap();
        let grid = Grid::of(&scene);
        let all: Vec<usize> = (0..grid.len()).collect();
        outcomes.extend(
            sweeper.sweep::<f32>(&plan, &grid, &all, &Unwatched).unwrap().block.to_outcomes(),
        );
    }
    outcomes
}

/// The devices.
fn devices() -> Vec<(String, Device, Expected)> {
    let exact = Device::EXACT;
    let least_normal = f32::MIN_POSITIVE.to_bits();
    let all = Device {
        division: (-2, 2),
        root: (-4, 4),
        rounding: Rounding::EitherWay,
        fusing: Fusing::Left,
        flushed_below: least_normal,
        nans_inverted: true,
        indeterminate: true,
        ..exact
    };
    let permitted = [
        ("nothing, by calls", Device { everywhere: true, ..exact }),
        (
            "divisions 2 ULP, roots 4 ULP too large",
            Device { division: (2, 2), root: (4, 4), ..exact },
        ),
        (
            "divisions 2 ULP, roots 4 ULP too small",
            Device { division: (-2, -2), root: (-4, -4), ..exact },
        ),
        (
            "divisions within 2 ULP, roots within 4",
            Device { division: (-2, 2), root: (-4, 4), ..exact },
        ),
        (
            "sums and products rounded toward zero",
            Device { rounding: Rounding::TowardZero, ..exact },
        ),
        ("sums and products rounded either way", Device { rounding: Rounding::EitherWay, ..exact }),
        ("products fused, the left of two", Device { fusing: Fusing::Left, ..exact }),
        ("products fused, the right of two", Device { fusing: Fusing::Right, ..exact }),
        ("denormals flushed", Device { flushed_below: least_normal, ..exact }),
        ("comparisons of a NaN hold", Device { nans_inverted: true, ..exact }),
        ("infinities and NaNs are any number", Device { indeterminate: true, ..exact }),
        ("all of these, the left of two fused", all),
        ("all of these, the right of two fused", Device { fusing: Fusing::Right, seed: 1, ..all }),
        ("all of these, unfused", Device { fusing: Fusing::None, seed: 2, ..all }),
    ];
    let controls = [
        ("divisions within 2^12 ULP", Device { division: (-4096, 4096), ..exact }),
        ("divisions within 2^16 ULP", Device { division: (-65536, 65536), ..exact }),
        ("numbers below 1e-5 flushed", Device { flushed_below: 1.0e-5_f32.to_bits(), ..exact }),
    ];
    let mut devices = vec![("nothing".to_string(), exact, Expected::Nothing)];
    let named = |name: &str, device, expected| (name.to_string(), device, expected);
    devices.extend(permitted.map(|(name, device)| named(name, device, Expected::SameOutcomes)));
    devices.extend(controls.map(|(name, device)| {
        named(&format!("not permitted: {name}"), device, Expected::Difference)
    }));
    devices
}

fn main() {
    let wanted = std::env::args().skip(1).find(|word| !word.starts_with('-')).unwrap_or_default();
    let gpu = Gpu::open(&adapter::best(Precision::F64).unwrap()).unwrap();
    let source = shader::source(Precision::F32, Switches::Forgotten);
    let reference = sweep(&gpu, &source);
    println!("{}, {} cells of the ten maps in f32", gpu.description.name, reference.len());
    println!(
        "| what the device does | operations altered | outcomes that differ | impact counts | all fields equal | s |"
    );
    println!("|---|--:|--:|--:|--:|--:|");
    let mut wrong = Vec::new();
    for (name, device, expected) in devices() {
        if !name.contains(&wanted) {
            continue;
        }
        let (altered, places) = perturb::shader(&source, &device);
        let began = Instant::now();
        let outcomes = sweep(&gpu, &altered);
        let count = |alike: fn(&Outcome, &Outcome) -> bool| {
            outcomes.iter().zip(&reference).filter(|(one, other)| alike(one, other)).count()
        };
        let classes = count(|one, other| one.class != other.class);
        let impacts = count(|one, other| one.impacts != other.impacts);
        let equal = count(|one, other| one == other);
        println!(
            "| {name} | {places} | {classes} | {impacts} | {equal} | {:.0} |",
            began.elapsed().as_secs_f64()
        );
        let holds = match expected {
            Expected::Nothing => equal == reference.len(),
            Expected::SameOutcomes => classes == 0 && impacts * RARE < reference.len(),
            Expected::Difference => impacts * RARE > reference.len(),
        };
        if !holds {
            wrong.push(name);
        }
    }
    if !wrong.is_empty() {
        eprintln!("not as expected: {}", wrong.join("; "));
        std::process::exit(1);
    }
}
