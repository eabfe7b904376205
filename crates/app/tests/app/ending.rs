//! How `topple explore` ends: in good order, whoever ends it, and with the files that were dropped on its page.

#![cfg(unix)]

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;

/// A server whose folders of temporary files lie in one of its own.
struct Server {
    process: Child,
    host: String,
    token: String,
    folder: TempDir,
}

impl Drop for Server {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

impl Server {
    /// Starts one, by another command where one is given. Its output is read up to the address, and closed.
    fn start(by: &[&str]) -> Server {
        let folder = tempfile::tempdir().unwrap();
        let words =
            [by, &[env!("CARGO_BIN_EXE_topple"), "explore", "--no-open", "--backend", "cpu"]]
                .concat();
        let mut command = Command::new(words[0]);
        command.args(&words[1..]);
        let command = command.env("TMPDIR", folder.path()).stdin(Stdio::null());
        let mut process = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(process.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let address = line.split_whitespace().last().unwrap().strip_prefix("http://").unwrap();
        let (host, token) = address.trim_end_matches('/').split_once('/').unwrap();
        Server { host: host.into(), token: token.into(), process, folder }
    }

    /// Drops a record on the page; the status of the answer.
    fn drop_record(&self) -> String {
        let Server { host, token, .. } = self;
        let body = crate::explore::dropped("one.txt", &"0.5\n".repeat(99));
        let mut stream = TcpStream::connect(host).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
        write!(
            stream,
            "POST /{token}/record HTTP/1.1\r\nHost: {host}\r\nX-Topple: page\r\nConnection: close\r\n\
             Content-Length: {}\r\n\r\n",
            body.len()
        )
        .unwrap();
        stream.write_all(&body).unwrap();
        let mut answer = String::new();
        stream.read_to_string(&mut answer).unwrap();
        answer.split_whitespace().nth(1).unwrap().into()
    }

    fn signal(&self, name: &str) {
        let sent = Command::new("kill").args(["-s", name, &self.process.id().to_string()]).status();
        assert!(sent.unwrap().success());
    }

    /// Waits until it has ended; its status, and what it said on stderr.
    fn ended(&mut self) -> (ExitStatus, String) {
        let began = Instant::now();
        let status = loop {
            if let Some(status) = self.process.try_wait().unwrap() {
                break status;
            }
            assert!(began.elapsed() < Duration::from_secs(30), "it goes on");
            std::thread::sleep(Duration::from_millis(20));
        };
        let mut said = String::new();
        self.process.stderr.take().unwrap().read_to_string(&mut said).unwrap();
        (status, said)
    }
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
        assert_eq!(server.drop_record(), "200");
        assert_eq!(files_in(server.folder.path()).len(), 1);
        server.signal(name);
        let (status, said) = server.ended();
        assert!(status.success(), "{name}: {status}");
        assert_eq!((files_in(server.folder.path()), &*said), (vec![], ""), "{name}");
    }
}

/// Under nohup a server outlives its terminal.
#[test]
fn a_hangup_that_is_ignored_stays_so() {
    let mut server = Server::start(&["nohup"]);
    server.signal("HUP");
    std::thread::sleep(Duration::from_millis(400));
    assert_eq!(server.drop_record(), "200");
    server.signal("TERM");
    let (status, _) = server.ended();
    assert!(status.success() && files_in(server.folder.path()).is_empty());
}
