//! The law of impact at its limits.

use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::scene::{Grid, Scene};
use topple::stepping::outcome::Class;
use topple::stepping::reference::{self, Settings};

use crate::common::{say, scene};

use super::all_swept;

/// Sweeps a grid in both precisions: cells whose outcome is not the reference's, and the largest
/// eta_phi of the two corners.
fn against_the_reference(name: &str, scene: &Scene, allowed: usize) {
    let grid = Grid::of(scene);
    let model = Plan::new(scene, DEFAULT_STEP).unwrap().model::<f64>(&scene.case());
    let (short, long) = (all_swept::<f32>(scene), all_swept::<f64>(scene));
    let mut differ = [0, 0];
    let mut rocking = 0;
    for index in 0..grid.len() {
        let right = reference::run(scene, &grid.case(index), &Settings::default());
        rocking += usize::from(right.class != Class::FullContact);
        for (count, cells) in differ.iter_mut().zip([&short, &long]) {
            assert_ne!(cells[index].class, Class::Unresolved, "{name}: {:?}", cells[index]);
            *count += usize::from(cells[index].class != right.class);
        }
    }
    say(&format!(
        "{name}: eta = {:.4}, {:.4}; f32 {}, f64 {} of {} cells differ, {rocking} lift",
        model.left.eta_phi,
        model.right.eta_phi,
        differ[0],
        differ[1],
        grid.len()
    ));
    assert!(3 * rocking > grid.len(), "{name}: too few cells lift");
    assert!(differ.iter().all(|count| *count <= allowed), "{name}: {differ:?}");
}

fn pulses(block: &str, base: &str, a_h: &str) -> Scene {
    scene(&format!(
        "[block]\n{block}\n[base]\n{base}\n[pulse]\nomega = \"2:9:8\"\na_h = \"{a_h}\"\n[run]\nt_max = 6.0\n"
    ))
}

/// eta <= 0: a squat or strongly eccentric block has no rebound, and stands still after its first
/// impact; on the other side of zero it goes on.
#[test]
fn blocks_without_a_rebound() {
    let none = "isolation = \"none\"";
    for (name, b) in [("squat, eta < 0", 1.5), ("eta just above zero", 1.41)] {
        let block = format!("half_width = {b}\nheight = 1.0");
        let scene = pulses(&block, none, "10:60:8");
        let eta = Plan::new(&scene, DEFAULT_STEP).unwrap().model::<f64>(&scene.case()).left.eta_phi;
        assert_eq!(eta > 0.0, b < f64::sqrt(2.0), "eta = {eta}");
        against_the_reference(&format!("blocks_without_a_rebound: {name}"), &scene, 0);
    }
    // One impact, then rest: every uplift is followed by at most one impact.
    let scene = pulses("half_width = 1.5\nheight = 1.0", none, "10:60:8");
    assert!(all_swept::<f64>(&scene).iter().all(|cell| cell.impacts <= cell.uplifts));
    let eccentric = pulses("half_width = 0.9\nheight = 1.0\neccentricity = 0.8", none, "2:25:8");
    against_the_reference("blocks_without_a_rebound: eccentric", &eccentric, 0);
}

/// e close to B: one corner carries almost everything, and the block lifts at a breath.
#[test]
fn an_eccentricity_close_to_the_edge() {
    for e in [0.9, 0.99, 0.999] {
        let block = format!("object = 1\neccentricity = {e}");
        let scene = pulses(&block, "t_h = 1.75\nt_v = 0.75", "0.3:4:8");
        against_the_reference(&format!("an_eccentricity_close_to_the_edge: {e}"), &scene, 1);
    }
}

/// Plates from a millionth of the block's mass to a million times it. At the heavy end the block no
/// longer moves its base.
#[test]
fn plates_from_nothing_to_everything() {
    for share in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
        let plate = 895.0 * share;
        let block = format!(
            "half_width = 0.175\nheight = 0.95\nmass = 895.0\ninertia = 278.38\neccentricity = 0.2\n\
             plate_h = {plate}\nplate_v = {plate}"
        );
        let scene = pulses(&block, "t_h = 1.75\nt_v = 0.75", "2:9:8");
        against_the_reference(&format!("plates_from_nothing_to_everything: {share:e}"), &scene, 1);
    }
}

/// A small moment of inertia: the denominator of phi'' comes near zero, the base's coupled period
/// becomes short, and the step with it.
#[test]
fn a_small_moment_of_inertia() {
    for share in [1.0, 1e-2, 1e-3] {
        let inertia = 278.38 * share;
        let block = format!(
            "half_width = 0.175\nheight = 0.95\nmass = 895.0\ninertia = {inertia}\neccentricity = 0.2\n\
             plate_h = 43.3\nplate_v = 43.3"
        );
        let scene = pulses(&block, "t_h = 1.75\nt_v = 0.75", "2:9:8");
        let plan = Plan::new(&scene, DEFAULT_STEP).unwrap();
        let step = plan.clock(&Grid::of(&scene).case(0)).step_free;
        against_the_reference(
            &format!("a_small_moment_of_inertia: {share} of it, step {step:.1e} s"),
            &scene,
            1,
        );
    }
}
