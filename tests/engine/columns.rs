//! Columns that were wrong once, each with the scene that showed it. The figures are the reference's,
//! which is run here too; an independent program agrees with them.

use topple::backend::cpu;
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::scene::{GRAVITY, Grid, Parameter, Range, Scene};
use topple::stepping::outcome::{Class, Outcome, Status};
use topple::work::observer::Unwatched;

use crate::common::{all, judge, scene, shaken, synthetic_pair, under};

/// Every cell of a scene by both precisions and in full: what is said of all of them holds.
fn swept(scene: &Scene) -> Vec<Vec<Outcome>> {
    let grid = Grid::of(scene);
    let plan = Plan::new(scene, DEFAULT_STEP).unwrap();
    let (single, double) = (plan.at(Precision::F32), plan.at(Precision::F64));
    vec![
        cpu::sweep(Precision::F32, &single, &grid, &all(&grid), &Unwatched),
        cpu::sweep(Precision::F64, &double, &grid, &all(&grid), &Unwatched),
        cpu::sweep_one_by_one(Precision::F64, &double, &grid, &all(&grid), &Unwatched),
        cpu::sweep(Precision::F64, &double.full_model(), &grid, &all(&grid), &Unwatched),
    ]
}

fn near(value: f64, right: f64, share: f64) -> bool {
    (value - right).abs() <= share * right.abs()
}

/// Object 1 on a base shaken upwards alone: X = 0, and both corners lift where Y falls through zero.
/// The larger moment, that of the longer arm, decides; -e is the mirror image.
#[test]
fn both_corners_at_once() {
    let shaken_up = |e: f64| {
        scene(&format!(
            "[block]\nobject = 1\neccentricity = {e}\n[base]\nt_h = 1.75\nt_v = 0.75\n\
             [pulse]\nomega = 4.461538461538462\na_h = 0.0\na_v = 9.0\n[run]\nt_max = 10.0\n"
        ))
    };
    for (e, class) in [(0.3, Class::OverturnedRight), (-0.3, Class::OverturnedLeft)] {
        let scene = shaken_up(e);
        let right = judge(&scene);
        assert_eq!(right.class, class);
        assert!((right.t_end - 1.781_223_4).abs() < 1e-6, "{}", right.t_end);
        for cells in swept(&scene) {
            assert_eq!((cells[0].class, cells[0].impacts), (class, 1), "e = {e}");
            assert!((cells[0].t_end - right.t_end).abs() < 1e-4, "{:?}", cells[0]);
        }
    }
}

/// psi = 1: z has no part in any force, and the full model, which carries it all the same, resolves it.
#[test]
fn a_linear_base_in_the_full_model() {
    let scene = scene(
        "[block]\nobject = 1\n[base]\nt_h = 0.85\nt_v = 0.75\npsi = 1.0\nxi_h = 0.0\nalpha_y = 0.01\n\
         [pulse]\nomega = \"4:10:7\"\na_h = \"1:12:7\"\n[run]\nt_max = 10.0\n",
    );
    let sweeps = swept(&scene);
    for cells in &sweeps {
        assert!(cells.iter().all(|cell| cell.class != Class::Unresolved));
        let differ = cells.iter().zip(&sweeps[1]).filter(|(a, b)| a.class != b.class).count();
        assert_eq!(differ, 0);
    }
}

/// A base that swings on after the pulse: least force and friction are those of the whole run, though
/// the cell ends before.
#[test]
fn contact_forces_after_a_proof() {
    let vertical = scene(
        "[block]\nobject = 1\neccentricity = 0.2\n[base]\nisolation = \"vertical\"\nt_v = 0.75\nxi_v = 0.02\n\
         [pulse]\nomega = 10.293\na_h = 0.2\na_v = -4.0\n[run]\nt_max = 20.0\n",
    );
    for cells in swept(&vertical) {
        assert!(near(cells[0].min_contact, 0.406_272_9, 1e-3), "{:?}", cells[0]);
    }
    let both = scene(
        "[block]\nobject = 1\neccentricity = 0.3\n[base]\nt_h = 2.0079\npsi = 1.0\nxi_h = 0.3\n\
         t_v = 0.7711674671600832\nxi_v = 0.03\n\
         [pulse]\nomega = 10.48\na_h = 0.2\na_v = -4.346\n[run]\nt_max = 15.0\nfriction = 0.05\n",
    );
    for cells in swept(&both) {
        assert!(near(cells[0].min_contact, 0.671_810_7, 1e-3), "{:?}", cells[0]);
        assert!(near(cells[0].friction, 0.081_745_4, 1e-3), "{:?}", cells[0]);
    }
    // And the proof still ends cells early.
    let scene = crate::common::object(1, 0.2, (1.75, 0.75), 0.0, "3:15:8", "1:15:8");
    let cells = &swept(&scene)[1];
    assert!(cells.iter().filter(|cell| cell.status == Status::Proved).count() > 20);
}

/// A tilted block that comes to rest and lifts once more: the proof knows that its first uplift is
/// still to come.
#[test]
fn the_first_uplift_of_a_tilted_block() {
    let scene = scene(
        "[block]\nobject = 1\n[base]\nt_h = 0.6\nt_v = 0.3\n[pulse]\nomega = \"3:12:6\"\na_h = \"1:6:6\"\n\
         [run]\nt_max = 20.0\ntilt = 0.02\n",
    );
    let sweeps = swept(&scene);
    let full = &sweeps[3];
    for cells in &sweeps[1..3] {
        for (cell, full) in cells.iter().zip(full).filter(|(cell, _)| !cell.class.overturned()) {
            assert_eq!(cell.t_uplift.is_some(), full.t_uplift.is_some(), "{cell:?} {full:?}");
        }
    }
}

/// The ground jumps and the block lifts at that instant: the force of full contact does not exist.
#[test]
fn a_jump_that_lifts() {
    let block = scene(
        "[block]\nobject = 1\n[base]\nisolation = \"none\"\n[pulse]\nomega = 5.0\na_h = 1.0\n",
    );
    let scene = shaken(block, 0.01, vec![4.0; 200]);
    for cells in swept(&scene) {
        assert_eq!(cells[0].class, Class::OverturnedLeft);
        assert!(near(cells[0].friction, 0.238_473_5, 1e-3), "{:?}", cells[0]);
    }
}

/// A pulse that the run's end cuts: the last instant counts, also where full contact is shared.
#[test]
fn the_last_instant() {
    let scene = scene(
        "[block]\nobject = 1\n[base]\nisolation = \"none\"\n\
         [pulse]\nomega = \"2:2.2:2\"\na_h = \"1:1.5:2\"\n[run]\nt_max = 0.4\n",
    );
    let right = [0.073_124_984, 0.078_566_654, 0.109_687_476, 0.117_849_981];
    for cells in swept(&scene) {
        for (cell, right) in cells.iter().zip(right) {
            assert!(near(cell.friction, right, 1e-5), "{} {right}", cell.friction);
        }
    }
}

/// A coefficient of restitution on an eccentric block: landing on the longer arm raises the energy, and
/// the certificate lets it.
#[test]
fn restitution_on_an_eccentric_block() {
    let mut proved = 0;
    for e in [-0.6, -0.3, 0.3, 0.6] {
        let scene = scene(&format!(
            "[block]\nhalf_width = 0.5\nheight = 0.9\neccentricity = {e}\n[base]\nisolation = \"none\"\n\
             [pulse]\nomega = \"3:9:6\"\na_h = \"4:9:8\"\n[run]\nt_max = 20.0\nrestitution = 0.98\n"
        ));
        let sweeps = swept(&scene);
        for (cell, full) in sweeps[1].iter().zip(&sweeps[3]) {
            assert_eq!(cell.class, full.class);
            proved += usize::from(cell.status == Status::Proved);
            for (value, right) in [
                (cell.max_phi_left, full.max_phi_left),
                (cell.max_phi_right, full.max_phi_right),
                (cell.zeta, full.zeta),
            ] {
                assert!(value >= right - 1e-9, "e = {e}: {value} {right}");
            }
        }
    }
    assert!(proved > 10, "{proved}");
}

/// A pulse that the run's end cuts: the friction asked for is that of the last instant too, also where
/// the ground moves vertically under a grid whose cells share their full contact.
#[test]
fn friction_where_the_ground_rises_and_the_run_is_cut() {
    let scene = scene(
        "[block]\nobject = 1\n[base]\nt_h = 1.5\nt_v = 0.8\n\
         [pulse]\nomega = 3.0\na_h = \"0.1:0.4:4\"\na_v = 3.0\n[run]\nt_max = 0.3\n",
    );
    for cells in swept(&scene) {
        for (row, cell) in cells.iter().enumerate() {
            let right = 0.005_772_336 * (row + 1) as f64 / 4.0;
            assert!(near(cell.friction, right, 1e-4), "row {row}: {} for {right}", cell.friction);
        }
    }
}

/// A base so stiff vertically that a record's gap holds much of its period, or more than one: where full
/// contact is shared, and where it is not for that reason, friction is that of the full model.
#[test]
fn friction_under_a_record_on_a_stiff_base() {
    let mut scene = scene(
        "[block]\nobject = 2\n[base]\nt_h = 1.0\nt_v = 0.5\nxi_v = 0.02\n\
         [pulse]\nomega = 1.0\na_h = 1.0\n",
    );
    under(&mut scene, synthetic_pair());
    scene.set(Parameter::TH, Range::even(1.5, 4.0, 4));
    scene.set(Parameter::TV, Range::even(0.01, 0.06, 6));
    let sweeps = swept(&scene);
    let mut held = 0;
    for (cell, full) in sweeps[1].iter().zip(&sweeps[3]) {
        // A force that comes near zero makes any friction.
        if full.min_contact > 1.0 {
            assert!(near(cell.friction, full.friction, 1e-3), "{cell:?} for {full:?}");
            held += 1;
        }
    }
    assert!(held >= 12, "{held}");
}

/// A block that barely lifts between two steps does so about either corner: the scene and its mirror
/// image.
#[test]
fn a_grazing_uplift_and_its_mirror_image() {
    for sign in [1.0, -1.0] {
        let scene = scene(&format!(
            "[block]\nhalf_width = 0.4\nheight = 0.6\nmass = 500.0\nplate_h = 100.0\nplate_v = 100.0\neccentricity = {}\n\
             [base]\nt_h = 0.9\nt_v = 0.6\npsi = 1.0\nxi_h = 0.05\n\
             [pulse]\nomega = 9.0\na_h = {}\na_v = -6.0\n[run]\nt_max = 0.35\n",
            0.8 * sign,
            1.116_945_5 * sign
        ));
        let grid = Grid::of(&scene);
        let plan = Plan::new(&scene, DEFAULT_STEP).unwrap().at(Precision::F64).full_model();
        let cells = cpu::sweep(Precision::F64, &plan, &grid, &all(&grid), &Unwatched);
        assert!(cells[0].uplifts > 0, "{sign}: {:?}", cells[0]);
    }
}

/// v about the static position under an upward sine, in full contact and without damping, in closed form:
/// x = -A/(w^2 - W^2) (sin W t - W/w sin w t).
#[test]
fn the_stroke_is_from_the_static_position() {
    let a_v = 1.0;
    for (t_v, omega) in [(0.5, 4.0), (0.47, 3.3), (0.9, 2.0), (1.3, 7.0)] {
        let w = std::f64::consts::TAU / t_v;
        let end = std::f64::consts::TAU / omega;
        let scene = scene(&format!(
            "[block]\nobject = 1\n[base]\nisolation = \"vertical\"\nt_v = {t_v}\nxi_v = 0.0\n\
             [pulse]\nomega = {omega}\na_h = 0.0\na_v = {a_v}\n[run]\nt_max = {end}\n"
        ));
        let x = |t: f64| {
            -a_v / (w * w - omega * omega) * ((omega * t).sin() - omega / w * (w * t).sin())
        };
        let range = (0..=200_000).map(|k| x(f64::from(k) / 2.0e5 * end));
        let (low, high) =
            range.fold((0.0_f64, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
        let deflection = GRAVITY / (w * w);
        let (stroke, max_v) = (high.max(-low), deflection - low);
        for cells in [&swept(&scene)[..], &[vec![judge(&scene)]]].concat() {
            let cell = cells[0];
            // 80 steps a period: (2 pi/80)^4/120 in every radian.
            assert!((cell.stroke_v - stroke).abs() < 1e-5 * stroke, "{cell:?} for {stroke}");
            assert!((cell.max_v - max_v).abs() < 1e-6 * max_v, "{cell:?} for {max_v}");
        }
    }
}

/// A jump of the ground lifts the block at once: it never feels the force that full contact would have
/// after the jump, whether it shares its full contact with other amplitudes or not.
#[test]
fn a_jump_at_the_start() {
    for base in ["isolation = \"none\"\n", "isolation = \"horizontal\"\nt_h = 2.0\n"] {
        for shape in ["one-cosine", "rectangle"] {
            let scene = scene(&format!(
                "[block]\nobject = 2\neccentricity = 0.1\n[base]\n{base}[pulse]\nshape = \"{shape}\"\n\
                 omega = 12.0\na_h = \"8,10,12\"\na_v = -10.0\n[run]\nt_max = 3.0\n"
            ));
            let grid = Grid::of(&scene);
            for cells in swept(&scene) {
                for (index, cell) in cells.iter().enumerate() {
                    let case = grid.case(index);
                    let right =
                        topple::stepping::reference::run(&scene, &case, &Default::default());
                    let off = (cell.min_contact - right.min_contact).abs();
                    // The step's error in the acceleration, of the weight.
                    assert!(off < 1e-3 * GRAVITY, "{shape} {base} {index}: {cell:?} for {right:?}");
                }
            }
        }
    }
}

/// Impacts that lose more or hardly less than the law's: maps of the sweep have the reference's outcomes, and what is proved
/// stays so.
#[test]
fn a_restitution_factor() {
    let (mut proved, mut changed) = (0, 0);
    for (isolation, base, r) in [
        ("dual", "t_h = 1.75\nt_v = 0.75", 0.8),
        ("dual", "t_h = 1.75\nt_v = 0.75", 1.002),
        ("none", "", 0.9),
        ("vertical", "t_v = 0.75", 0.95),
    ] {
        let scene = scene(&format!(
            "[block]\nobject = 1\neccentricity = 0.2\n[base]\nisolation = \"{isolation}\"\n{base}\n\
             [pulse]\nomega = \"4:9:7\"\na_h = \"2:9:12\"\n[run]\nrestitution_factor = {r}\n"
        ));
        let sweeps = swept(&scene);
        let grid = Grid::of(&scene);
        for cell in all(&grid) {
            let mut one = scene.clone();
            for (axis, value) in grid.axes().iter().zip(grid.coordinates(cell)) {
                one.set(axis.parameter, value);
            }
            let right = judge(&one);
            for sweep in &sweeps {
                assert_eq!(sweep[cell].class, right.class, "{isolation}, r = {r}, cell {cell}");
                // Of few impacts: later ones tell roundings apart.
                if right.class.overturned() && right.impacts < 4 {
                    assert_eq!(sweep[cell].impacts, right.impacts);
                    assert!((sweep[cell].t_end - right.t_end).abs() < 1e-3);
                }
                proved += usize::from(sweep[cell].status == Status::Proved);
            }
        }
        // Another law of impact is another map.
        let mut law = scene.clone();
        law.set(Parameter::RestitutionFactor, 1.0);
        let same = |one: &Outcome, other: &Outcome| {
            (one.class, one.impacts, one.zeta) == (other.class, other.impacts, other.zeta)
        };
        changed += swept(&law)[1].iter().zip(&sweeps[1]).filter(|(a, b)| !same(a, b)).count();
    }
    assert!(changed > 5, "{changed}");
    assert!(proved > 100, "{proved}");
}
