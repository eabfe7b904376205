use topple::scene::{Parameter, SceneBuilder, Values};
use topple_studies::uncertain::pixel::{axes, moved};

#[test]
fn pixels_of_ranges_and_lists_touch_and_do_not_overlap() {
    for (text, low, high) in [
        ("1:3:3", [0.5, 1.5, 2.5], [1.5, 2.5, 3.5]),
        ("3:1:3", [2.5, 1.5, 0.5], [3.5, 2.5, 1.5]),
        (
            "1:100:3:log",
            [0.1_f64.sqrt(), 10.0_f64.sqrt(), 1000.0_f64.sqrt()],
            [10.0_f64.sqrt(), 1000.0_f64.sqrt(), 100_000.0_f64.sqrt()],
        ),
        ("4,1,2", [3.0, 0.5, 1.5], [5.0, 1.5, 3.0]),
    ] {
        let values: Values = text.parse().unwrap();
        for (share, wanted) in [(0.0, low), (1.0, high)] {
            let found: Vec<f64> = moved(&values, share).iter().collect();
            for (found, wanted) in found.iter().zip(wanted) {
                assert!(
                    (found / wanted - 1.0).abs() < 1e-12,
                    "{text} at {share}: {found}, {wanted}"
                );
            }
        }
        if !text.contains(',') {
            let middle = moved(&values, 0.5);
            assert!(middle.iter().zip(values.iter()).all(|(a, b)| (a / b - 1.0).abs() < 1e-12));
        }
    }
    let below: Values = "-100:-1:3:log".parse().unwrap();
    let (low, high) = (moved(&below, 0.0).first(), moved(&below, 1.0).first());
    assert!(low < -100.0 && high > -100.0, "{low} {high}");
    assert_eq!(moved(&Values::from(2.0), 0.9), Values::from(2.0));
}

#[test]
fn what_has_no_pixels_is_refused() {
    let scene = |t_v: &str, n: &str| {
        let numbers: [(Parameter, Values); 3] = [
            (Parameter::TH, 1.0.into()),
            (Parameter::TV, t_v.parse().unwrap()),
            (Parameter::BoucWenN, n.parse().unwrap()),
        ];
        let mut scene =
            SceneBuilder::object(1).with(Parameter::Omega, 5.0).with(Parameter::AH, 5.0);
        scene.numbers.extend(numbers);
        scene.check().unwrap()
    };
    let refused = |t_v, n| axes(&scene(t_v, n)).unwrap_err().to_string();
    assert!(refused("1", "2").contains("no number has several values"));
    assert!(
        refused("0.1:1:3", "2").contains("a pixel of t_v reaches -0.125, which must be a positive")
    );
    assert!(refused("1:2:3", "1,2,3").contains("bouc_wen_n is a whole number"));
    assert_eq!(axes(&scene("0.5:1.5:2", "2")).unwrap()[0].0, Parameter::TV);
}
