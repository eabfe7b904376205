//! Boundaries as curves: the reference is asked on the threads of a call.

use std::collections::BTreeSet;
use std::num::NonZeroUsize;
use std::sync::Mutex;
use std::sync::atomic::AtomicBool;

use topple::cells::plan::Plan;
use topple::scene::{Parameter, Scene, SceneBuilder};
use topple::stepping::outcome::Outcome;
use topple::sweep::error::SweepError;
use topple::work::observer::Observer;
use topple::work::threads::Threads;
use topple_lab::figures::bisection::{Curve, CurvePoint, ReferenceWord};

/// Hears on how many threads it is asked whether to go on.
#[derive(Default)]
struct Ear(Mutex<BTreeSet<usize>>);

impl Observer for Ear {
    fn cancelled(&self) -> bool {
        self.0.lock().unwrap().insert(rayon::current_num_threads());
        false
    }
}

/// Asks the reference at points of a block on the ground, whose change is not looked for.
fn ask(observer: &dyn Observer) -> Result<ReferenceWord, SweepError> {
    let text = "[block]\nobject = 1\n[base]\nisolation = \"none\"\n[pulse]\nomega = 6\na_h = 6\n[run]\nt_max = 2\n";
    let scene = SceneBuilder::from_toml(text).unwrap().check().unwrap();
    let plan = |scene: &Scene| Ok(Plan::new(scene, 1.0 / 128.0)?);
    let curve = Curve {
        scene: &scene,
        parameters: [Parameter::Omega, Parameter::AH],
        is_beyond: &|outcome| outcome.class.overturned(),
        plan: &plan,
        within: 1.0e-3,
    };
    let point = |k: u32| {
        let (at, outcome) = (4.0 + f64::from(k), Some(Outcome::PENDING));
        CurvePoint { at, value: 5.0, outcome, reference: None }
    };
    curve.ask_reference(&mut (0..4).map(point).collect::<Vec<_>>(), 4, observer)
}

#[test]
fn the_reference_is_asked_on_the_threads_of_the_call_until_it_is_ended() {
    // More than one, and not as many as the process has.
    let count = rayon::current_num_threads() + 1;
    let (threads, ear) = (Threads::new(NonZeroUsize::new(count)).unwrap(), Ear::default());
    assert_eq!(threads.scope(|| ask(&ear)).unwrap().asked, 4);
    assert_eq!(ear.0.into_inner().unwrap(), BTreeSet::from([count]));
    assert!(ask(&AtomicBool::new(true)).unwrap_err().is_cancelled());
}
