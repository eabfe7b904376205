//! The reference against programs that this project did not write, and against another method.

use approx::assert_abs_diff_eq;
use topple::scene::{Grid, Parameter, Range, Scene, SceneBuilder};
use topple::stepping::outcome::{Class, Outcome};
use topple::stepping::reference::system::{Drive, PHI, Phase, State as Cell, System};
use topple::stepping::reference::{self, Instant, Settings, Switch, run};

use crate::common::{judge, object, scene};

/// 66 cells of the three objects, integrated by a program apart from this project at two
/// tolerances that agree: times to 1e-6 s, zeta to 1e-6. Impacts are left open for cells that go
/// on rocking.
#[test]
fn cells_of_an_independent_program() {
    let mut table = csv::Reader::from_path("tests/data/reference-cells.csv").unwrap();
    let mut cells = 0;
    for row in table.records() {
        let row = row.unwrap();
        let text = |column: usize| row[column].to_string();
        let number = |column: usize| row[column].parse::<f64>().unwrap();
        let periods = (number(2), number(3));
        let scene =
            object(row[0].parse().unwrap(), number(1), periods, number(4), &text(5), &text(6));
        let cell = judge(&scene);
        assert_eq!(cell.class.name(), &row[7], "{row:?}");
        assert_abs_diff_eq!(cell.t_end, number(9), epsilon = 1e-6);
        assert_abs_diff_eq!(cell.zeta, number(11), epsilon = 1e-6);
        assert_eq!(cell.t_uplift.is_some(), !row[10].is_empty(), "{row:?}");
        if let Some(t) = cell.t_uplift {
            assert_abs_diff_eq!(t, number(10), epsilon = 1e-6);
        }
        if !row[8].is_empty() {
            assert_eq!(cell.impacts.to_string(), &row[8], "{row:?}");
        }
        if !row[12].is_empty() {
            // That program took the largest of its samples, up to 9e-7 rad below the crest.
            assert_abs_diff_eq!(cell.max_phi_left, number(12), epsilon = 1e-6);
            assert_abs_diff_eq!(cell.max_phi_right, number(13), epsilon = 1e-6);
        }
        cells += 1;
    }
    assert_eq!(cells, 66);
}

/// Object 1, e = 0, T_h = 1.75 s, T_v = 0.75 s, A_v = 0, Omega = 5 rad/s, found twice by
/// independent integrations at a tolerance of 1e-11.
#[test]
fn the_first_overturnings_as_the_amplitude_grows() {
    let cell = |a_h: &str| judge(&object(1, 0.0, (1.75, 0.75), 0.0, "5", a_h));
    assert_eq!(cell("3").class, Class::FullContact);
    let nine = cell("3.5");
    assert_eq!((nine.class, nine.impacts), (Class::OverturnedRight, 9));
    // Printed to two decimals: 2.6255 s.
    assert_abs_diff_eq!(nine.t_end, 2.62, epsilon = 1e-2);
    // Handed down as 0.660471; four integrators agree on 0.6604702 to all these digits.
    assert_abs_diff_eq!(nine.t_uplift.unwrap(), 0.660_470_2, epsilon = 5e-8);
    let one = cell("4");
    assert_eq!((one.class, one.impacts), (Class::OverturnedRight, 1));
    for a_h in ["4.5", "6", "9"] {
        let none = cell(a_h);
        assert_eq!((none.class, none.impacts), (Class::OverturnedLeft, 0), "A_h = {a_h}");
    }
}

/// The state at the end of a step: modified midpoint rules of 2, 4, 6 ... substeps, extrapolated to substeps of no length
/// (Gragg, Bulirsch and Stoer). Nothing of this method is in the reference's. The last two rows must agree.
fn extrapolated(rates: impl Fn(f64, &Cell) -> Cell, [t, end]: [f64; 2], y: &Cell) -> Cell {
    const ROWS: usize = 10;
    let mut row: Vec<Cell> = Vec::new();
    for k in 1..=ROWS {
        let h = (end - t) / (2 * k) as f64;
        let (mut before, mut now) = (*y, y + h * rates(t, y));
        for substep in 1..2 * k {
            (before, now) = (now, before + 2.0 * h * rates(t + substep as f64 * h, &now));
        }
        let mut next = vec![0.5 * (before + now + h * rates(end, &now))];
        for (j, above) in row.iter().enumerate() {
            let ratio = (k as f64 / (k - 1 - j) as f64).powi(2);
            next.push(next[j] + (next[j] - above) / (ratio - 1.0));
        }
        row = next;
    }
    let [.., last, best] = row[..] else { unreachable!("rows") };
    assert!((best - last).amax() < 1e-11, "{last} {best}");
    best
}

/// What the reference saw at an instant.
struct Seen {
    t: f64,
    phase: Phase,
    y: Cell,
    switch: Option<Switch>,
}

fn watch(scene: &Scene) -> Vec<Seen> {
    let mut seen = Vec::new();
    let point = Grid::of(scene).case(0);
    reference::observe(scene, &point, &Settings::default(), &mut |i| {
        seen.push(Seen { t: i.t, phase: i.phase, y: *i.y, switch: i.switch });
    });
    seen
}

/// An eccentric block that chatters on a yielding base: no flight goes on after its impact, also where a
/// kink of the law follows at once and the step was too long for both.
#[test]
fn no_step_ends_beyond_an_impact() {
    let text = "[block]\nhalf_width = 0.1721\nheight = 0.8791\nmass = 184.0\neccentricity = -0.7648\n\
        plate_h = 27.51\nplate_v = 14.28\n\
        [base]\nt_h = 0.3063\npsi = 0.4148\nxi_h = 0.2156\nalpha_y = 0.02037\nbouc_wen_n = 4\n\
        t_v = 0.3295\nxi_v = 0.006\n\
        [pulse]\nomega = 4.816833333333333\na_h = -0.4335\n\
        [run]\nt_max = 1.6\noverturn = \"quarter-turn\"\n";
    let scene = scene(text);
    let mut rocked = 0;
    let see = &mut |seen: &Instant| {
        if let Some(pole) = seen.phase {
            rocked += 1;
            let angle = pole.sign() * seen.y[PHI];
            // EVENT_TIME at the speeds of this motion.
            assert!(angle > -1.0e-12, "{} s: {angle} rad about {pole:?}", seen.t);
        }
    };
    reference::observe(&scene, &Grid::of(&scene).case(0), &Settings::default(), see);
    assert!(rocked > 100, "{rocked}");
}

/// Every step of a run again, from its first state, by another method: it must end in the same state, and at a switch on
/// the switching surface.
#[test]
fn every_step_again_by_another_method() {
    for (e, a_v, omega, a_h) in
        [(0.0, 0.0, "5", "3.5"), (0.1, 0.5, "7.75", "6.99"), (0.2, 0.0, "9", "8.4")]
    {
        let scene = object(1, e, (1.75, 0.75), a_v, omega, a_h);
        let system = System::new(&scene, &Grid::of(&scene).case(0));
        let mut switches = 0;
        for pair in watch(&scene).windows(2) {
            let (from, to) = (&pair[0], &pair[1]);
            let drive = if to.t <= system.pulse_end() { Drive::Pulse } else { Drive::Free };
            let mut y = from.y;
            if to.t > from.t {
                let rates = |t: f64, y: &Cell| system.derivative(from.phase, t, drive, y);
                y = extrapolated(rates, [from.t, to.t], &from.y);
            }
            match to.switch {
                Some(Switch::Uplift(pole)) => {
                    // The uplift's two sides change by some m/s^2 in a tenth of a second.
                    assert_abs_diff_eq!(system.uplift(pole, to.t, drive, &y), 0.0, epsilon = 1e-8);
                }
                Some(Switch::Impact(pole)) => {
                    assert_abs_diff_eq!(y[PHI], 0.0, epsilon = 1e-11);
                    y = system.impact(pole, &y);
                }
                Some(Switch::Overturn(pole)) => {
                    let angle = system.critical_angle(pole);
                    assert_abs_diff_eq!(pole.sign() * y[PHI], angle, epsilon = 1e-11);
                }
                None => {}
            }
            switches += usize::from(to.switch.is_some());
            // The reference's tolerance of 1e-10 is relative to 1e-2 m and 1e-1 for z.
            assert!((y - to.y).amax() < 1e-9, "t = {}: {} {}", to.t, y, to.y);
        }
        assert!(switches >= 5, "{switches} switches");
    }
}

/// Tolerance, rest speed and longest steps are no parameters of the answer.
#[test]
fn the_reference_does_not_depend_on_its_own_settings() {
    let standard = Settings::default();
    let tight = Settings { tolerance: 1e-12, rest_speed: 1e-6, ..standard };
    let loose = Settings {
        tolerance: 1e-8,
        rest_speed: 1e-4,
        longest: 0.025,
        longest_free: 0.05,
        ..standard
    };
    for (eccentricity, periods, a_v) in [(0.2, (1.75, 0.75), 0.5), (-0.3, (4.0, 2.0), 2.0)] {
        let scene = object(1, eccentricity, periods, a_v, "0.5:14.5:6", "0.5:14.5:6");
        let grid = Grid::of(&scene);
        for index in 0..grid.len() {
            let point = grid.case(index);
            let a = run(&scene, &point, &standard);
            for other in [&tight, &loose] {
                let b = run(&scene, &point, other);
                assert_eq!(a.class, b.class, "{point:?}");
                assert_abs_diff_eq!(a.t_end, b.t_end, epsilon = 1e-5);
                assert_abs_diff_eq!(a.zeta, b.zeta, epsilon = 1e-5);
            }
        }
    }
}

/// A cell that ends once it is decided has the outcome, the first uplift and the zeta of its whole run, to the last
/// bit, on every base whose energy does not rise; and it ends early where it rocks.
#[test]
fn what_is_decided_is_final() {
    let decided = Settings { ends_decided: true, ..Settings::default() };
    let base = |eccentricity, t_h, t_v| {
        SceneBuilder::object(1)
            .with(Parameter::Eccentricity, eccentricity)
            .with(Parameter::TH, t_h)
            .with(Parameter::TV, t_v)
            .with(Parameter::AV, 1.0)
            .with(Parameter::Omega, Range::even(5.0, 13.0, 7))
            .with(Parameter::AH, Range::even(2.0, 11.0, 7))
    };
    let scenes = [
        base(0.2, 1.75, 0.75),
        base(-0.3, 4.0, 0.3),
        base(0.0, 1.0, 1.5).with(Parameter::Psi, 0.9).with(Parameter::RestitutionFactor, 0.8),
        base(0.4, 2.5, 0.5).with(Parameter::StopGap, 0.1).with(Parameter::StopStiffness, 2.0e5),
        base(0.1, 2.0, 0.5).with(Parameter::VHardening, 0.05),
        base(0.2, 1.75, 0.75).with(Parameter::Tilt, 0.01),
    ];
    for (number, scene) in scenes.into_iter().enumerate() {
        let scene = scene.check().unwrap();
        let grid = Grid::of(&scene);
        let mut early = 0;
        for cell in 0..grid.len() {
            let case = grid.case(cell);
            let mut steps = [0; 2];
            let mut run = |k: usize, settings: &Settings| {
                reference::observe(&scene, &case, settings, &mut |_| steps[k] += 1)
            };
            let (whole, short) = (run(0, &Settings::default()), run(1, &decided));
            let of = |cell: &Outcome| (cell.class, cell.t_end, cell.t_uplift, cell.zeta);
            assert_eq!(of(&whole), of(&short), "scene {number}, cell {cell}");
            early += usize::from(2 * steps[1] < steps[0]);
        }
        assert!(early > 0, "scene {number}: no cell ended early");
    }
}
