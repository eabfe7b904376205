use topple::scene::{Parameter, Range, Scene, SceneBuilder};
use topple_studies::uncertain::{Ensemble, Varied};

use super::points;

fn scene() -> Scene {
    let scene = SceneBuilder::object(1)
        .with(Parameter::TH, 1.75)
        .with(Parameter::TV, 0.75)
        .with(Parameter::Omega, Range::even(1.0, 9.0, 3))
        .with(Parameter::AH, 5.0);
    scene.check().unwrap()
}

fn varied(texts: &[&str]) -> Vec<Varied> {
    texts.iter().map(|text| text.parse().unwrap()).collect()
}

#[test]
fn each_point_is_the_scene_with_its_numbers() {
    let scene = scene();
    // What the object fixes varies, too.
    let varied = varied(&["eccentricity=uniform(0,0.3)", "half-width=normal(0.175,0.01)"]);
    let points = points(&varied, 8, 0);
    let ensemble = Ensemble::of(&scene, &varied, false).unwrap();
    for (point, made) in points.iter().zip(ensemble.scenes(&points).unwrap()) {
        let case = made.unwrap().case();
        assert_eq!((case.block.eccentricity, case.block.half_width), (point[0], point[1]));
        assert_eq!(case.block.height, 0.95);
    }
}

#[test]
fn what_cannot_vary_is_refused_before_anything_runs() {
    let scene = scene();
    let refused = |texts: &[&str]| {
        let varied = varied(texts);
        Ensemble::of(&scene, &varied, false).unwrap_err().to_string()
    };
    assert!(refused(&["omega=uniform(1,2)"]).contains("omega is an axis of the map"));
    assert!(refused(&["scale=uniform(1,2)"]).contains("is no number of this scene"));
    assert!(refused(&["friction=uniform(1,2)"]).contains("give `friction` a value"));
    assert!(refused(&["psi=uniform(0,1)", "psi=uniform(0,1)"]).contains("psi varies twice"));
    assert!(refused(&["t_h=normal(0.2,0.1)"]).contains("2.3 %"));
    // Each by itself makes sense, but a block of this tilt has overturned.
    let varied = varied(&["tilt=uniform(0,0.5)"]);
    let points = points(&varied, 8, 0);
    let ensemble = Ensemble::of(&scene, &varied, false).unwrap();
    let line = ensemble.scenes(&points).map(|_| ()).unwrap_err().to_string();
    assert!(line.starts_with("vary: at tilt = 0.") && line.contains("overturning angle"), "{line}");
}
