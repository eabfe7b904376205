use std::thread;
use std::time::Duration;

use topple::work::observer::Observer;
use topple_app::beside::run;
use topple_app::progress::Screen;

/// What runs until it is asked to end.
fn until_told(observer: &dyn Observer) {
    while !observer.cancelled() {
        thread::sleep(Duration::from_millis(1));
    }
}

#[test]
fn what_fails_ends_what_runs_beside_it() {
    let screen = Screen::new(true);
    let failed = run(&screen, 1, || anyhow::bail!("no room"), Some(until_told));
    let failed: anyhow::Result<((), Option<()>)> = failed;
    assert_eq!(failed.unwrap_err().to_string(), "no room");
}

#[test]
fn both_have_their_results() {
    let screen = Screen::new(true);
    let verify = |observer: &dyn Observer| {
        observer.advance(2);
        "verified"
    };
    let both = run(&screen, 2, || Ok("written"), Some(verify)).unwrap();
    assert_eq!(both, ("written", Some("verified")));
}
