//! Columns that were wrong once, each with the scene that showed it. The figures are the reference's,
//! which is run here too; an independent program agrees with them.

#![allow(missing_docs, clippy::unwrap_used)] // tests

mod common;

use common::{all, judge, scene, shaken};
use topple::scene::{Grid, Scene};
use topple::stepping::outcome::{Class, Outcome, Status};
use topple::sweep::backend::Precision;
use topple::sweep::clock::DEFAULT_STEP;
use topple::sweep::cpu;
use topple::sweep::plan::Plan;

/// Every cell of a scene by both precisions and in full: what is said of all of them holds.
fn swept(scene: &Scene) -> Vec<Vec<Outcome>> {
    let grid = Grid::of(scene);
    let plan = Plan::new(scene, DEFAULT_STEP).unwrap();
    let (single, double) = (plan.at(Precision::F32), plan.at(Precision::F64));
    vec![
        cpu::sweep::<f32>(&single, &grid, &all(&grid), &|_| ()),
        cpu::sweep::<f64>(&double, &grid, &all(&grid), &|_| ()),
        cpu::sweep_one_by_one::<f64>(&double, &grid, &all(&grid), &|_| ()),
        cpu::sweep::<f64>(&double.full_model(), &grid, &all(&grid), &|_| ()),
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
    let scene = common::object(1, 0.2, (1.75, 0.75), 0.0, "3:15:8", "1:15:8");
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
