//! What the methods are tried on.

use std::f64::consts::TAU;

use topple::scene::builder::SceneBuilder;
use topple::scene::record::RecordText;
use topple::scene::{Directions, Grid, Numbers, Parameter, Range, Scene, SceneError};

/// Scenes that are charted together.
#[derive(Debug, Clone)]
pub struct Bench {
    /// Short name, as in chart.csv.
    pub name: &'static str,
    /// One line for figures.
    pub title: String,
    /// The scenes; their cells are numbered on from one scene to the next.
    pub scenes: Vec<Scene>,
    /// Shortest step tried: 2 to the power of minus this, s.
    pub finest: u32,
    /// Every method is tried, and switches are compared; else only sweeps by their outcomes.
    pub whole: bool,
}

impl Bench {
    /// Number of cells.
    pub fn len(&self) -> usize {
        self.scenes.iter().map(|scene| Grid::of(scene).len()).sum()
    }

    /// True without cells.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Points of the grids' axes, and how fine the steps become.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sides {
    /// Of the pulse map.
    pub pulse: u32,
    /// Of the record map.
    pub record: u32,
    /// Of the ten maps.
    pub maps: u32,
    /// Shortest step: 2 to the power of minus this, s; of the ten maps, of minus `finest_of_maps`.
    pub finest: u32,
    /// See `finest`.
    pub finest_of_maps: u32,
}

/// What the charts of the documentation are made with.
pub const FULL: Sides = Sides { pulse: 16, record: 12, maps: 60, finest: 13, finest_of_maps: 9 };
/// Enough to see that everything works.
pub const QUICK: Sides = Sides { pulse: 4, record: 3, maps: 4, finest: 8, finest_of_maps: 7 };

/// (A_v, e) of the six maps of the paper's Fig. 11 and the four of Fig. 13.
pub const MAPS: [(f64, f64); 10] = [
    (0.0, 0.0),
    (0.0, 0.2),
    (0.0, 0.4),
    (0.5, 0.0),
    (0.5, 0.2),
    (0.5, 0.4),
    (0.0, -0.2),
    (0.0, -0.4),
    (0.5, -0.2),
    (0.5, -0.4),
];

/// The numbers of Object 1 on an isolated base, which are not its own.
fn object_1(eccentricity: f64) -> Numbers {
    Numbers::default().with(Parameter::Eccentricity, eccentricity)
}

/// A scene of Object 1.
fn scene(numbers: Numbers) -> SceneBuilder {
    SceneBuilder { object: Some(1), numbers, ..SceneBuilder::default() }
}

/// A map of Figs. 11 and 13.
fn overturning_map(a_v: f64, e: f64, side: u32) -> Result<Scene, SceneError> {
    let numbers = object_1(e)
        .with(Parameter::TH, 1.75)
        .with(Parameter::TV, 0.75)
        .with(Parameter::Omega, Range::even(0.2, 15.0, side))
        .with(Parameter::AH, Range::even(0.1, 15.0, side))
        .with(Parameter::AV, a_v);
    scene(numbers).check()
}

/// The pulse map of Fig. 11, lower row, middle, with `side` points an axis.
///
/// # Errors
/// None for one point and more.
pub fn pulse(side: u32, finest: u32) -> Result<Bench, SceneError> {
    Ok(Bench {
        name: "pulse",
        title: "Pulse map of Fig. 11: Object 1, ε = 0.2, A_v = 0.5 m/s², 30 s".into(),
        scenes: vec![overturning_map(0.5, 0.2, side)?],
        finest,
        whole: true,
    })
}

/// A record's map, from T_v = 0.3 s on: below, rocking is chaotic and no method decides.
fn record(side: u32, record: RecordText, finest: u32) -> Result<Bench, SceneError> {
    let numbers = object_1(-0.4)
        .with(Parameter::TH, Range::even(0.5, 4.0, side))
        .with(Parameter::TV, Range::even(0.3, 2.0, side));
    let scene = SceneBuilder { record: Some(record), ..scene(numbers) }.check()?;
    let name = scene.excitation.record().map_or("no record", |pair| pair.title.as_str());
    let title = format!("Record map: Object 1, ε = -0.4, {name}");
    Ok(Bench { name: "record", title, scenes: vec![scene], finest, whole: true })
}

/// One block on the ground, let go at half its critical angle. The pulse is of no strength: it only
/// makes each cell's steps differ a little in length, so that switches fall anywhere in a step.
fn free(finest: u32) -> Result<Bench, SceneError> {
    let numbers = object_1(0.0)
        .with(Parameter::Omega, Range::even(TAU / 0.9, TAU / 1.1, 64))
        .with(Parameter::AH, 0.0)
        .with(Parameter::TMax, 8.0)
        .with(Parameter::Tilt, 0.1);
    let scene = SceneBuilder { isolation: Some(Directions::None), ..scene(numbers) }.check()?;
    Ok(Bench {
        name: "free",
        title: "Free rocking of Object 1 on the ground from φ = 0.1 rad, 8 s".into(),
        scenes: vec![scene],
        finest,
        whole: true,
    })
}

/// The ten maps of Figs. 11 and 13, by which the default step is chosen.
fn maps(side: u32, finest: u32) -> Result<Bench, SceneError> {
    let scenes = MAPS.into_iter().map(|(a_v, e)| overturning_map(a_v, e, side));
    Ok(Bench {
        name: "maps",
        title: "The ten maps of Figs. 11 and 13: Object 1, 30 s".into(),
        scenes: scenes.collect::<Result<_, _>>()?,
        finest,
        whole: false,
    })
}

/// All benches; `motion` is the record to use.
///
/// # Errors
/// Those of the record's files.
pub fn all(sides: Sides, motion: RecordText) -> Result<Vec<Bench>, SceneError> {
    let Sides { pulse: of_pulse, record: of_record, maps: of_maps, finest, finest_of_maps } = sides;
    Ok(vec![
        pulse(of_pulse, finest)?,
        record(of_record, motion, finest)?,
        free(finest)?,
        maps(of_maps, finest_of_maps)?,
    ])
}
