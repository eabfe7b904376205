//! What a program makes by the library's types is checked as what a file says: it is refused in one line, nothing
//! panics, and no size that it names is taken at its word.

use std::sync::Arc;

use topple::results::shard::Shard;
use topple::scene::record::synthetic;
use topple::{
    Axis, BackendRequest, Excitation, Grid, Method, Pair, Parameter, Range, Record, RunSettings,
    Scene, SceneBuilder, Unwatched, Values, VerifySettings, sweep,
};
use topple_studies::statistics::distribution::Form;
use topple_studies::{
    Distribution, FragilityRequest, Probabilities, StudyRequest, Suite, SuiteEntry, SuiteRequest,
    Uncertainty, Varied,
};

use crate::run::alone;

fn builder() -> SceneBuilder {
    SceneBuilder::object(1)
        .with(Parameter::TH, 1.75)
        .with(Parameter::TV, 0.75)
        .with(Parameter::Omega, 5.0)
        .with(Parameter::AH, 5.0)
}

fn settings() -> RunSettings {
    let mut settings = RunSettings::default();
    settings.backend = BackendRequest::Cpu;
    settings
}

fn line(error: &dyn std::fmt::Display) -> String {
    let line = error.to_string();
    assert!(!line.is_empty() && !line.contains('\n') && line.len() < 400, "{line}");
    line
}

/// Values that no text has.
fn none() -> Vec<Values> {
    let mut all: Vec<Values> = [
        Range::even(1.0, 2.0, 0),
        Range::even(1.0, 2.0, u32::MAX),
        Range::even(1.0, 1.0, 9),
        Range::even(1.0, 2.0, 1),
        Range::even(f64::NAN, 2.0, 9),
        Range::even(1.0, f64::INFINITY, 9),
        Range::single(f64::NAN),
        Range { log: true, ..Range::even(-1.0, 1.0, 9) },
    ]
    .map(Values::from)
    .to_vec();
    all.extend([vec![], vec![1.0], vec![1.0, 1.0], vec![1.0, f64::NAN]].map(Values::List));
    all
}

#[test]
fn values_that_are_none_are_refused() {
    let _alone = alone();
    let good = builder().check().unwrap();
    for values in none() {
        let refused = builder().with(Parameter::Omega, values.clone()).check().unwrap_err();
        assert_eq!(refused.key, "omega", "{values:?}");
        line(&refused);
        // In the place of a scene's numbers.
        let axes = [(Parameter::TH, values.clone())];
        line(&sweep(&good, &axes, &settings(), &Unwatched).map(|_| ()).unwrap_err());
        // What only looks at them finds something.
        let scene = Scene::with(good.clone(), Parameter::TH, values.clone());
        let grid = Grid::of(&scene);
        let _ = (scene.case(), grid.len(), grid.axes().iter().map(Axis::count).sum::<usize>());
        let _ = (values.first(), values.last(), values.value(7), values.ends(), values.refined(2));
        let _ =
            (values.thinned(3), values.coordinate(0.5), values.value_at(0.5), values.to_string());
        let request = FragilityRequest {
            levels: Some(values),
            ..FragilityRequest::new(SuiteRequest::new(builder()))
        };
        assert!(line(&request.check().unwrap_err()).starts_with("levels: "));
    }
}

#[test]
fn motions_that_are_none_are_refused() {
    let _alone = alone();
    let good = synthetic::pair();
    let samples = |samples: &[f64]| -> Arc<[f64]> { samples.into() };
    for pair in [
        Pair { dt: 0.0, ..good.clone() },
        Pair { dt: f64::NAN, ..good.clone() },
        Pair { dt: f64::INFINITY, ..good.clone() },
        Pair { horizontal: samples(&[]), vertical: samples(&[]), ..good.clone() },
        Pair { horizontal: samples(&[1.0]), vertical: samples(&[1.0]), ..good.clone() },
        Pair { vertical: samples(&[0.0, 1.0]), ..good.clone() },
        Pair {
            horizontal: samples(&[0.0, f64::NAN]),
            vertical: samples(&[0.0; 2]),
            ..good.clone()
        },
    ] {
        let bare = SceneBuilder::object(1).with(Parameter::TH, 1.75).with(Parameter::TV, 0.75);
        let refused = bare.check_under(Excitation::Record(pair)).unwrap_err();
        assert_eq!(line(&refused).split(':').next(), Some("horizontal"));
    }
    let record =
        |dt: f64| Record { title: "x".into(), dt, samples: vec![1.0; 4001], ..Record::default() };
    line(&Pair::new(record(0.01), Some(record(1e-9))).unwrap_err());
}

/// 2^40 cells, each of some 60 bytes; 2^30 sweeps; every cell of a map by the reference.
#[test]
fn no_size_is_taken_at_its_word() {
    let _alone = alone();
    let large = Range::even(1.0, 2.0, 1 << 20);
    let scene = builder().with(Parameter::Omega, large).with(Parameter::AH, large).check().unwrap();
    let refused = sweep(&scene, &[], &settings(), &Unwatched).map(|_| ()).unwrap_err();
    assert!(line(&refused).starts_with("out: 1099511627776 cells"), "{refused}");

    let uncertainty = |samples| Uncertainty {
        vary: vec!["t_h=normal(1.75,0.1)".parse().unwrap()],
        pixel: false,
        samples,
        seed: 1,
    };
    let good = builder().check().unwrap();
    for samples in [0, 1, 1 << 30, u32::MAX] {
        let refused = uncertainty(samples).check(&good, false).map(|_| ()).unwrap_err();
        assert_eq!(refused.key, "samples", "{}", line(&refused));
    }
    let few = uncertainty(4);
    let refused =
        Probabilities::run(&scene, &few, false, &settings(), &Unwatched).map(|_| ()).unwrap_err();
    assert!(line(&refused).starts_with("out: "), "{refused}");

    let side = Range::even(1.0, 2.0, 1 << 11);
    let scene = builder().with(Parameter::Omega, side).with(Parameter::AH, side).check().unwrap();
    let mut all = settings();
    all.verify = VerifySettings::cells(usize::MAX);
    let refused = sweep(&scene, &[], &all, &Unwatched).map(|_| ()).unwrap_err();
    assert_eq!(line(&refused), "verify: 4194304 cells are more than 1048576; give fewer");

    for part in ["4294967295/4294967295", "1/4294967295"] {
        let part: Shard = part.parse().unwrap();
        assert!(part.cells(1 << 40).len() <= 257);
    }
}

#[test]
fn distributions_that_are_none_are_refused() {
    let _alone = alone();
    let scene = builder().check().unwrap();
    let normal = Form::Normal { mean: 1.75, deviation: 0.1 };
    for distribution in [
        Distribution { form: normal, cut: Some((2.0, 1.0)) },
        Distribution { form: normal, cut: Some((f64::NAN, 1.0)) },
        Distribution { form: normal, cut: Some((1e9, 2e9)) },
        Distribution::of(Form::Normal { mean: f64::NAN, deviation: 1.0 }),
        Distribution::of(Form::Normal { mean: 1.75, deviation: -1.0 }),
        Distribution::of(Form::Uniform { low: 2.0, high: 1.0 }),
        Distribution::of(Form::Lognormal { median: 0.0, beta: f64::INFINITY }),
    ] {
        let vary = vec![Varied { parameter: Parameter::TH, distribution }];
        let uncertainty = Uncertainty { vary, pixel: false, samples: 4, seed: 1 };
        let refused = uncertainty.check(&scene, true).map(|_| ()).unwrap_err();
        assert_eq!(refused.key, "vary", "{}", line(&refused));
    }
}

/// A suite of motions that are the synthetic pair.
fn suite(count: usize) -> Suite {
    let pair = synthetic::pair();
    let measures = topple_studies::Measures::of(&pair);
    let row = |number: usize| {
        let mut entry = SuiteEntry::of("h.at2");
        entry.id = number.to_string();
        (entry, Ok(topple_studies::Motion { pair: pair.clone(), measures }))
    };
    Suite { rows: (0..count).map(row).collect(), unused: Vec::new(), doubts: Vec::new() }
}

#[test]
fn a_suite_of_more_cells_than_are_held_is_refused() {
    let _alone = alone();
    let suite = suite(300);
    let scene = SceneBuilder::object(1).with(Parameter::UY, 0.01).with(Parameter::TV, 0.5);
    let large = scene.clone().with(Parameter::TH, Range::even(1.0, 4.0, 1 << 20));
    let refused = SuiteRequest::new(large).open(&suite).map(|_| ()).unwrap_err();
    assert!(line(&refused).starts_with("suite: 314572800 cells"), "{refused}");
    let request = |levels: u32, samples: u32| FragilityRequest {
        levels: Some(Range::even(1.0, 2.0, levels).into()),
        vary: vec!["t_v=normal(0.5,0.01)".parse().unwrap()],
        samples,
        estimators: vec![],
        ..FragilityRequest::new(SuiteRequest::new(scene.clone().with(Parameter::TH, 2.0)))
    };
    for (levels, samples, key) in [(1 << 20, 2, "levels"), (2, 1 << 16, "samples")] {
        let refused = request(levels, samples).open(&suite).map(|_| ()).unwrap_err();
        assert!(line(&refused).starts_with(&format!("{key}: ")), "{refused}");
    }
    let many = FragilityRequest { limit_u: vec![0.1; 101], ..request(2, 2) };
    assert!(line(&many.check().unwrap_err()).starts_with("limit_u: "));
}

#[test]
fn a_method_is_bounded_by_its_steps() {
    let _alone = alone();
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-300] {
        let method = Method { largest_step: step, ..Method::default() };
        line(&method.plan(&builder().check().unwrap()).unwrap_err());
    }
}
