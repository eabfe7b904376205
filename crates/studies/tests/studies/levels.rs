//! Motions scaled to levels of an intensity measure.

use approx::assert_relative_eq;
use topple::scene::Parameter;
use topple::scene::builder::SceneBuilder;
use topple::scene::record::{Pair, Record};
use topple::scene::{Excitation, Range, Values};
use topple_studies::fragility::levels;
use topple_studies::suites::intensity::Intensity;
use topple_studies::suites::wanted::WantedMotion;

use crate::common::suites::samples;

/// A motion scaled to a level has that level of the measure, whichever it is.
#[test]
fn a_scaled_motion_has_the_level() {
    let pair = |peak: f64, omega: f64| {
        let record = Record {
            title: "made".into(),
            dt: 0.02,
            samples: samples(peak, omega),
            ..Record::default()
        };
        Pair::new(record, None).unwrap()
    };
    let scene = SceneBuilder::object(1)
        .with(Parameter::Eccentricity, 0.2)
        .with(Parameter::TH, 1.75)
        .with(Parameter::TV, 0.75);
    let block = scene.check_under(Excitation::Record(pair(1.0, 4.0))).unwrap().case().block;
    let wanted = Values::from(Range::even(0.5, 4.0, 3));
    for measure in ["pga", "pgv", "arias", "cav", "sa:1.5", "avg-sa:1", "pga*", "pgv*"] {
        let intensity: Intensity = measure.parse().unwrap();
        assert_eq!(intensity.to_string(), measure);
        let mut motions: Vec<WantedMotion> = [(2.0, 4.0), (0.7, 6.0)]
            .map(|(peak, omega)| WantedMotion {
                id: "a".into(),
                weight: 1.0,
                pair: pair(peak, omega),
                ground: pair(peak, omega),
                factors: vec![1.0],
                settings: Vec::new(),
            })
            .into();
        let told = levels::scale(&mut motions, intensity, Some(&wanted), &block).unwrap();
        for (motion, levels) in motions.iter().zip(told) {
            assert_eq!(levels, [0.5, 2.25, 4.0]);
            for (factor, level) in motion.factors.iter().zip(levels) {
                let scaled = motion.pair.clone().scaled(*factor);
                assert_relative_eq!(intensity.of(&scaled, &block), level, max_relative = 1e-12);
            }
        }
    }
    // On a rigid base the block lifts where PGA/(g tan alpha) is 1: alpha of the nearer corner, b = 0.8 B.
    let lifts = 9.81 * 0.8 * 0.175 / 0.95;
    let motion = pair(1.0, 4.0);
    let relative = Intensity::RelativePga.of(&motion, &block);
    assert_relative_eq!(relative, motion.pga_h / lifts, max_relative = 1e-12);
    let square = (0.8_f64 * 0.175).powi(2) + 0.95 * 0.95;
    let p = (895.0 * 9.81 * square.sqrt() / (278.38 + 895.0 * square)).sqrt();
    let pgv = Intensity::Pgv.of(&motion, &block);
    let relative = Intensity::RelativePgv.of(&motion, &block);
    assert_relative_eq!(relative, p * pgv / lifts, max_relative = 1e-12);
    for text in ["sa", "sa:0", "sa:x", "pgd", ""] {
        assert!(text.parse::<Intensity>().is_err(), "{text}");
    }
}
