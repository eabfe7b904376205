use std::f64::consts::TAU;

use topple::scene::record::rounded;
use topple::scene::{GRAVITY, Scene, SceneBuilder};
use topple_report::block::{case, draw};

fn scene(base: &str) -> Scene {
    let text = format!(
        "[block]\nobject = 1\n[base]\nisolation = \"horizontal\"\n{base}\n[pulse]\nomega = 5.0\na_h = 3.0\n"
    );
    SceneBuilder::from_toml(&text).unwrap().check().unwrap()
}

/// The text of a picture.
fn words(scene: &Scene) -> String {
    let svg = draw(scene, &case(scene).unwrap()).svg();
    svg.split('<').filter_map(|piece| Some(piece.split_once('>')?.1)).collect()
}

#[test]
fn a_block_has_its_mass_where_the_scene_tells_it() {
    // Of the paper's first block; the numbers of a block without plates need none.
    assert!(words(&scene("t_h = 1.5")).contains("M = 895 kg"));
    let text = "[block]\nhalf_width = 0.2\nheight = 1.0\n[base]\nisolation = \"none\"\n[pulse]\nomega = 5.0\na_h = 3.0\n";
    let without = SceneBuilder::from_toml(text).unwrap().check().unwrap();
    let told = words(&without);
    assert!(told.contains("H = 1 m") && !told.contains(" kg"), "{told}");
}

#[test]
fn devices_are_drawn_with_their_numbers_and_their_periods() {
    let pendulum = words(&scene("radius = 1.5\nmu = 0.06"));
    // A pendulum of the radius.
    let sliding = TAU * (1.5 / GRAVITY).sqrt();
    for part in ["= 1.5 m", "= 0.06", &format!("T = {} s sliding", rounded(sliding, 4))] {
        assert!(pendulum.contains(part), "{part}: {pendulum}");
    }
    let scene_of_bearing = scene("k1 = 50000.0\nk2 = 5000.0\nqd = 300.0");
    let bearing = words(&scene_of_bearing);
    let before = case(&scene_of_bearing).unwrap().isolation.horizontal.unwrap().t_h;
    // A tenth of the stiffness.
    let yielded = format!("T = {} s yielded", rounded(before * 10.0_f64.sqrt(), 4));
    for part in ["= 50000 N/m", "= 5000 N/m", "= 300 N", &yielded] {
        assert!(bearing.contains(part), "{part}: {bearing}");
    }
    // A base of the paper has rollers, which are circles.
    let rings = |scene: &Scene| draw(scene, &case(scene).unwrap()).svg().matches("<circle").count();
    assert_eq!(rings(&scene("t_h = 1.5")), rings(&scene_of_bearing) + 3);
}
