use serde_json::{Value, json};
use topple::model::pulse::Shape;
use topple::scene::parameters::Section;
use topple::scene::{SceneBuilder, keys};
use topple_explore::about::tables;

/// The words of a scene that the page offers.
fn words() -> Vec<Value> {
    tables()["words"].as_array().unwrap().clone()
}

/// What the page shows where nothing is chosen is what a scene has by default.
#[test]
fn the_first_word_is_the_default() {
    use topple::scene::Parameter::{AH, Mu, Omega, Radius, TV};
    let scene = SceneBuilder::object(1).pulse(Shape::default());
    let given = [(Radius, 1.5), (Mu, 0.06), (TV, 1.0), (Omega, 1.0), (AH, 1.0)];
    let scene = given.into_iter().fold(scene, |scene, (of, value)| scene.with(of, value));
    let scene = scene.check().unwrap();
    let first = |key: &str| {
        words().iter().find(|word| word["key"] == key).map(|word| word["first"].clone()).unwrap()
    };
    assert_eq!(first("isolation"), json!(scene.isolation));
    assert_eq!(first("overturn"), json!(scene.overturn));
    assert_eq!(first("pressure"), json!(scene.pressure));
    assert_eq!(first("shape"), json!(Shape::default()));
    assert!(first("object").is_null());
}

/// The words of a scene that the page offers are those that its file has, but for the record's files and what
/// a page has no use for.
#[test]
fn every_choice_of_a_scene_is_offered() {
    let offered: Vec<String> =
        words().iter().map(|word| word["key"].as_str().unwrap().to_string()).collect();
    let not_offered = "horizontal vertical horizontal_channel vertical_channel dt units \
        horizontal_2 horizontal_2_channel azimuth horizontal_azimuth \
        horizontal_2_azimuth join join_vertical join_gap floor_period floor_damping \
        floor_factor baseline force x y";
    let not_offered: Vec<&str> = not_offered.split(' ').collect();
    for section in Section::ALL {
        for key in keys::words(section).iter().filter(|key| !not_offered.contains(key)) {
            assert!(offered.iter().any(|own| own == key), "{key}");
        }
    }
}

/// A device has all of its damping by its numbers: no viscous damper, and a pendulum its own displacement before it slides.
#[test]
fn a_device_has_defaults_of_its_own() {
    let tables = tables();
    let defaults = &tables["first"]["defaults"];
    for device in ["pendulum", "bearing"] {
        assert_eq!(defaults[device]["xi_h"], 0.0, "{defaults}");
        assert!(defaults[device].get("xi_v").is_none(), "{defaults}");
    }
    assert_eq!(defaults["pendulum"]["u_y"], 0.0005, "{defaults}");
}
