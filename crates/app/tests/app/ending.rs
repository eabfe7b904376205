//! How `topple explore` ends: in good order, whoever ends it, and with the files that were dropped on its page.

#![cfg(unix)]

use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Command, ExitStatus};
use std::time::{Duration, Instant};

use crate::explore::{Server, dropped};

/// Drops a record on the page; the status of the answer.
fn drop_record(server: &Server) -> u16 {
    server.post_bytes("record", &dropped("one.txt", &"0.5\n".repeat(99))).status
}

fn signal(server: &Server, name: &str) {
    let sent = Command::new("kill").args(["-s", name, &server.process.id().to_string()]).status();
    assert!(sent.unwrap().success());
}

/// Waits until a server has ended; its status, and what it said on stderr.
fn ended(server: &mut Server) -> (ExitStatus, String) {
    let began = Instant::now();
    let status = loop {
        if let Some(status) = server.process.try_wait().unwrap() {
            break status;
        }
        assert!(began.elapsed() < Duration::from_secs(30), "it goes on");
        std::thread::sleep(Duration::from_millis(20));
    };
    let mut said = String::new();
    server.process.stderr.take().unwrap().read_to_string(&mut said).unwrap();
    (status, said)
}

fn files_in(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect()
}

/// Whether a process that is started here ignores a hangup, as Linux tells it.
fn ignores_hangups() -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    ignored.is_some_and(|signals| u64::from_str_radix(signals.trim(), 16).unwrap() & 1 == 1)
}

#[test]
fn a_signal_takes_the_dropped_files_away() {
    // Linux alone tells whether a hangup is ignored.
    let hangup = cfg!(target_os = "linux").then_some("HUP");
    // Where the tests themselves run under nohup.
    let by: &[&str] = if ignores_hangups() { &["env", "--default-signal=HUP"] } else { &[] };
    for name in ["TERM", "INT"].into_iter().chain(hangup) {
        let mut server = Server::start(by);
        assert_eq!(files_in(server.folder.path()), [""; 0], "nothing was dropped");
        assert_eq!(drop_record(&server), 200);
        assert_eq!(files_in(server.folder.path()).len(), 1);
        signal(&server, name);
        let (status, said) = ended(&mut server);
        assert!(status.success(), "{name}: {status}");
        assert_eq!((files_in(server.folder.path()), &*said), (vec![], ""), "{name}");
    }
}

/// Under nohup a server outlives its terminal.
#[test]
fn a_hangup_that_is_ignored_stays_so() {
    let mut server = Server::start(&["nohup"]);
    signal(&server, "HUP");
    std::thread::sleep(Duration::from_millis(400));
    assert_eq!(drop_record(&server), 200);
    signal(&server, "TERM");
    let (status, _) = ended(&mut server);
    assert!(status.success() && files_in(server.folder.path()).is_empty());
}
