//! What is not known: probabilities over distributions and pixels, and how sharp boundaries are.

mod ensemble;
mod indices;
mod pixel;
mod points;

use topple::backend::request::BackendRequest;
use topple::results::columns::Column;
use topple::scene::{Grid, Parameter, Range, Scene, Values};
use topple::stepping::outcome::{Class, Outcome};
use topple::sweep::run::sweep;
use topple::sweep::settings::{RunSettings, VerifySettings};
use topple::work::observer::Unwatched;
use topple_studies::Sharpness;
use topple_studies::uncertain::points::{shares, values};
use topple_studies::uncertain::{Probabilities, Uncertainty, Varied};

use crate::common::{scene, synthetic_pair, under};

/// So many points, each with a value of every parameter.
fn points(varied: &[Varied], samples: usize, seed: u32) -> Vec<Vec<f64>> {
    shares(varied.len(), samples, seed).iter().map(|shares| values(varied, shares)).collect()
}

fn settings() -> RunSettings {
    let mut settings = RunSettings::default();
    (settings.backend, settings.verify) = (BackendRequest::Cpu, VerifySettings::cells(0));
    settings
}

fn uncertainty(vary: &[&str], pixel: bool, samples: u32) -> Uncertainty {
    let vary = vary.iter().map(|text| text.parse().unwrap()).collect();
    Uncertainty { vary, pixel, samples, seed: 1 }
}

fn probabilities(scene: &Scene, uncertainty: &Uncertainty) -> Probabilities {
    Probabilities::run(scene, uncertainty, false, &settings(), &Unwatched).unwrap()
}

/// Shares of overturning in boxes of `each` cells a side of a dense sweep.
fn dense(scene: &Scene, each: usize) -> Vec<f64> {
    let map = sweep(scene, &[], &settings(), &Unwatched).unwrap();
    let (columns, rows) = map.grid.shape();
    let (wide, high) = (columns / each, rows / each);
    let mut shares = vec![0.0; wide * high];
    for (cell, code) in map.column(Column::Outcome).unwrap().into_iter().enumerate() {
        let place = cell / columns / each * wide + cell % columns / each;
        let overturned = Class::ALL[code as usize].overturned();
        shares[place] += f64::from(u8::from(overturned)) / (each * each) as f64;
    }
    shares
}

/// Under the synthetic record with T_v below 0.3 s rocking is chaotic. There a pixel has a probability; it is that of
/// 8 x 8 cells that lie evenly in the same pixel.
#[test]
fn a_pixel_has_the_probability_of_many_cells_in_it() {
    const EACH: usize = 8;
    const CELLS: usize = 8;
    let (t_h, t_v) = ((1.65, 1.85), (0.1, 0.14));
    let made = |count: usize, inside: f64| {
        // The dense grid has its cells at the middles of the parts of a pixel.
        let range = |(low, high): (f64, f64)| {
            let step = (high - low) / (CELLS - 1) as f64;
            Range::even(low - inside * step, high + inside * step, count as u32)
        };
        let mut scene =
            scene("[block]\nobject = 1\n[base]\nt_h = 1\nt_v = 1\n[pulse]\nomega = 1\na_h = 1\n");
        under(&mut scene, synthetic_pair());
        scene.with(Parameter::TH, range(t_h)).with(Parameter::TV, range(t_v))
    };
    let fine = dense(&made(CELLS * EACH, 0.5 - 0.5 / EACH as f64), EACH);
    let samples = (EACH * EACH) as u32;
    let all = probabilities(&made(CELLS, 0.0), &uncertainty(&[], true, samples));
    let mut between = 0;
    let mut sum = 0.0;
    for (cell, other) in fine.iter().enumerate() {
        let own = all.overturns(cell);
        let mean = 0.5 * (own + other);
        if mean == 0.0 || mean == 1.0 {
            continue;
        }
        between += usize::from(own > 0.0 && own < 1.0);
        // Both have the binomial variance of their cells at most.
        let z = (own - other) / (2.0 * mean * (1.0 - mean) / f64::from(samples)).sqrt();
        assert!(z.abs() < 4.0, "cell {cell}: {own} and {other}");
        sum += z * z;
    }
    assert!(between >= 20, "{between} of {} cells are not certain", fine.len());
    // The mean square of so many differences is below 1, by its own scatter of root 2/n.
    let mean = sum / between as f64;
    assert!(mean < 1.0 + 3.0 * (2.0 / between as f64).sqrt(), "{mean} over {between} cells");
    assert!(all.largest_error() <= 0.5 / f64::from(samples).sqrt());
    assert!(all.certain() < 0.7, "{}", all.certain());
}

/// A block on the ground overturns under a pulse from an amplitude on; where the amplitude is uniform the probability
/// is the share of the distribution above it.
#[test]
fn a_distribution_is_cut_where_the_outcome_changes() {
    let made = |a_h: Values| {
        let text = "[block]\nhalf_width = 0.2\nheight = 0.8\n[base]\nisolation = \"none\"\n[pulse]\nomega = 5\n\
                    a_h = 1\n[run]\nt_max = 5\n";
        scene(text).with(Parameter::AH, a_h)
    };
    let samples = 256;
    let all = probabilities(&made(2.0.into()), &uncertainty(&["a_h=uniform(1,9)"], false, samples));
    let fine = dense(&made(Range::even(1.0 + 1.0 / 256.0, 9.0 - 1.0 / 256.0, 1024).into()), 1);
    let share = fine.iter().sum::<f64>() / fine.len() as f64;
    // Each of the intervals has one sample: the share is off by one for each end of a range that overturns.
    let own = all.overturns(0);
    assert!(
        own > 0.1 && own < 0.9 && (own - share).abs() < 4.0 / f64::from(samples),
        "{own}, {share}"
    );
    // Its own value is no axis of the results.
    assert_eq!(all.axes(&uncertainty(&["a_h=uniform(1,9)"], false, 1)), [0]);
    assert_eq!(all.counts[0].iter().sum::<u32>(), samples);
}

/// What varies and what is moved in its pixel are coordinates of their own: 16 points fill 4 x 4 boxes evenly.
#[test]
fn distributions_and_pixels_are_independent() {
    let text =
        "[block]\nobject = 1\n[base]\nt_h = 1\nt_v = 1\n[pulse]\nomega = \"1:2:2\"\na_h = 1\n";
    let scene = scene(text);
    let unknown = uncertainty(&["psi=uniform(0,1)"], true, 16);
    let points = unknown.check(&scene, false).unwrap();
    let mut count = [0; 16];
    for number in 0..16 {
        let made = points.scene(&scene, number).unwrap();
        let first = |parameter| made.numbers.get(parameter).unwrap().first();
        let (psi, moved) = (first(Parameter::Psi), first(Parameter::Omega) - 0.5);
        count[4 * (4.0 * psi) as usize + (4.0 * moved) as usize] += 1;
    }
    assert_eq!(count, [1; 16]);
}

/// What is read of a slice of rows at a time is what the whole map says, for grids of any number of axes.
#[test]
fn sharpness_is_of_all_slices_together() {
    let grid = |t_v: &str| {
        let text = format!(
            "[block]\nobject = 1\n[base]\nt_h = 1\nt_v = {t_v}\n[pulse]\nomega = \"1:2:200\"\na_h = \"1:2:150\"\n"
        );
        Grid::of(&scene(&text))
    };
    let class = |cell: usize| {
        let (x, y) = (cell % 200, cell / 200 % 150);
        if x * x + y * y < 20_000 { Class::Rocking } else { Class::OverturnedLeft }
    };
    let of = |grid: &Grid| {
        let all = (0..grid.len()).map(|cell| Outcome { class: class(cell), ..Outcome::PENDING });
        Sharpness::of(grid, &all.collect::<Vec<_>>()).unwrap()
    };
    let (one, three) = (of(&grid("1")), of(&grid("\"1,2,3\"")));
    assert_eq!((one.boxes, three.boxes), (1200, 3600));
    assert_eq!(
        (&one.uncertain, one.s_bb.unwrap().value),
        (&three.uncertain, three.s_bb.unwrap().value)
    );
    assert!((one.dimension.unwrap().value - 1.0).abs() < 0.05, "{one:?}");
    assert_eq!(one.distances, [1, 2, 4, 8, 16]);
}
