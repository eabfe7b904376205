use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

use topple::work::observer::{Observer, Phase};
use topple_explore::watched::{BETWEEN, Watched};

#[test]
fn a_slow_stage_is_told_and_a_quick_one_is_not() {
    let (stop, frames) = (AtomicBool::new(false), Mutex::new(Vec::new()));
    let tell = |frame: Vec<u8>| frames.lock().unwrap().push(frame);
    let watched = Watched::new("fine", &stop, &tell);
    watched.begins(Phase::Sweeping, 100);
    watched.advance(10);
    assert!(frames.lock().unwrap().is_empty());
    std::thread::sleep(BETWEEN);
    watched.advance(30);
    watched.advance(1);
    let frames = frames.lock().unwrap();
    assert_eq!(frames.len(), 1);
    let text = String::from_utf8_lossy(&frames[0][4..]).into_owned();
    assert!(text.contains(r#""done":40"#) && text.contains(r#""of":100"#), "{text}");
    stop.store(true, Ordering::Relaxed);
    assert!(watched.cancelled());
}
