//! The hysteretic law where it is not smooth, and where it is stiff.

use topple::backend::history::{by_reference, by_steps};
use topple::cells::clock::{DEFAULT_STEP, Resolution};
use topple::cells::plan::Plan;
use topple::scene::{Grid, Scene};
use topple::stepping::outcome::Class;
use topple_lab::chart::fit::slope;

use crate::common::{say, scene};

use super::truth;

/// A block too broad to lift on a horizontal isolation.
fn sliding(rest: &str) -> Scene {
    scene(&format!(
        "[block]\nhalf_width = 2.0\nheight = 1.0\nmass = 1000.0\nplate_h = 100.0\n\
         [base]\nisolation = \"horizontal\"\nt_h = 1.5\n{rest}\n\
         [pulse]\nomega = 4.0\na_h = 4.0\n[run]\nt_max = 4.0\n"
    ))
}

/// Where u' or z changes sign the law has a kink. Steps across it are of second order; cut there,
/// of fourth.
#[test]
fn order_across_the_kinks() {
    let scene = sliding("");
    let (rows, _) = by_reference(&scene, &Grid::of(&scene).case(0));
    let right = rows.last().unwrap().u;
    let order = |kinks: bool| {
        let error = |power: i32| {
            let h = 0.5_f64.powi(power);
            let resolution = Resolution::exactly(h);
            let resolution = if kinks { resolution } else { resolution.across_kinks() };
            let plan = Plan::resolved(&scene, resolution).unwrap();
            let (rows, _) = by_steps::<f64>(&plan, &Grid::of(&scene).case(0));
            (h, (rows.last().unwrap().u - right).abs())
        };
        slope(&(6..=11).map(error).collect::<Vec<_>>()).unwrap()
    };
    let (cut, across) = (order(true), order(false));
    say(&format!("order_across_the_kinks: {cut:.2} cut there, {across:.2} across"));
    assert!(cut >= 3.5, "{cut}");
    assert!(across < 3.0, "{across}");
}

/// |z| <= 1 for small yield displacements and large exponents: there the law is stiff, and a step
/// too long for it overshoots, or keeps z from where it belongs.
#[test]
fn the_hysteretic_variable_stays_within_one() {
    let run = |alpha_y: f64, n: u32, resolution: Resolution| {
        let scene = sliding(&format!("alpha_y = {alpha_y}\nbouc_wen_n = {n}"));
        let plan = Plan::resolved(&scene, resolution).unwrap();
        let (rows, cell) = by_steps::<f64>(&plan, &Grid::of(&scene).case(0));
        let z = rows.iter().fold(0.0, |most: f64, row| most.max(row.z.abs()));
        (z, (cell.max_u - truth(&scene).max_u).abs(), cell.class)
    };
    for (alpha_y, n) in
        [(0.1, 2), (0.01, 2), (1e-3, 2), (1e-4, 2), (0.1, 1), (0.1, 20), (0.1, 100), (1e-3, 100)]
    {
        let (z, off, class) = run(alpha_y, n, Resolution::bounded(DEFAULT_STEP));
        let (raw_z, raw_off, raw) = run(alpha_y, n, Resolution::exactly(1.0 / 16.0).across_kinks());
        say(&format!(
            "the_hysteretic_variable_stays_within_one: alpha_y = {alpha_y}, n = {n}: |z| - 1 = {:.0e}, max|u| off \
             by {off:.0e} m; a plain step of 1/16 s: {:.0e}, {raw_off:.0e} m, {}",
            z - 1.0,
            raw_z - 1.0,
            raw.name()
        ));
        assert!(z <= 1.0 + 1e-3, "alpha_y = {alpha_y}, n = {n}: |z| = {z}");
        assert_eq!(class, Class::FullContact);
        assert!(off < 1e-5, "alpha_y = {alpha_y}, n = {n}: {off}");
        // Steps of the default length alone, cut where z would settle too fast for them.
        let (cut_z, cut_off, cut) = run(alpha_y, n, Resolution::exactly(DEFAULT_STEP));
        assert!(
            cut == Class::Unresolved || (cut_z <= 1.0 + 1e-3 && cut_off < 1e-4),
            "alpha_y = {alpha_y}, n = {n}: |z| = {cut_z}, {cut_off}"
        );
        // Where a plain step of an ordinary length breaks.
        if alpha_y < 0.1 || n > 2 {
            assert!(raw_z > 1.1 || raw_off > 1e-3 || raw == Class::Unresolved, "{raw_z} {raw_off}");
        }
    }
}
