//! The command in this process, and as a process of its own: its words, where it runs, and what it ended with.

use std::ffi::{OsStr, OsString};
use std::fmt::Debug;
use std::io::Write;
use std::iter;
use std::path::Path;
use std::process::{Child, Output, Stdio};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

use topple_app::Streams;

/// The built program.
pub fn program() -> &'static Path {
    Path::new(env!("CARGO_BIN_EXE_topple"))
}

/// What a stream was given.
#[derive(Clone, Default)]
struct Kept(Arc<Mutex<Vec<u8>>>);

impl Write for Kept {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().unwrap().write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

impl Kept {
    fn text(self) -> String {
        String::from_utf8(self.0.lock().unwrap().clone()).unwrap()
    }
}

/// Runs the command in this process: its status, and what it wrote to stdout and to stderr.
pub fn run(words: impl IntoIterator<Item = OsString>) -> (u8, String, String) {
    let [out, err] = [(); 2].map(|()| Kept::default());
    let words = iter::once("topple".into()).chain(words);
    let code = topple_app::run(words, Streams::plain(out.clone(), err.clone()));
    (code, out.text(), err.text())
}

/// A process of `topple` that is prepared.
pub struct Command {
    process: std::process::Command,
    longest: Option<Duration>,
}

impl Command {
    pub fn topple() -> Command {
        let process = std::process::Command::new(program());
        Command { process, longest: None }
    }

    pub fn arg(&mut self, argument: impl AsRef<OsStr>) -> &mut Command {
        self.process.arg(argument);
        self
    }

    pub fn args<A: AsRef<OsStr>>(
        &mut self,
        arguments: impl IntoIterator<Item = A>,
    ) -> &mut Command {
        self.process.args(arguments);
        self
    }

    pub fn env(&mut self, name: impl AsRef<OsStr>, value: impl AsRef<OsStr>) -> &mut Command {
        self.process.env(name, value);
        self
    }

    pub fn env_remove(&mut self, name: impl AsRef<OsStr>) -> &mut Command {
        self.process.env_remove(name);
        self
    }

    pub fn current_dir(&mut self, directory: impl AsRef<Path>) -> &mut Command {
        self.process.current_dir(directory);
        self
    }

    /// A run that takes longer is ended, and the test with it.
    pub fn timeout(&mut self, longest: Duration) -> &mut Command {
        self.longest = Some(longest);
        self
    }

    /// Begins it.
    pub fn spawn(&mut self) -> Child {
        let pipes = self.process.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        pipes.spawn().unwrap()
    }

    /// Runs the command to its end.
    pub fn output(&mut self) -> std::io::Result<Output> {
        let child = self.spawn();
        match self.longest {
            None => child.wait_with_output(),
            Some(longest) => within(child, longest),
        }
    }

    /// The same, for the test to say how it must have ended.
    #[track_caller]
    pub fn assert(&mut self) -> Assert {
        let output = self.output().unwrap();
        Assert { run: format!("{:?}", self.process), output }
    }
}

/// Sends Ctrl-C to a child.
#[cfg(unix)]
pub fn interrupt(child: &Child) {
    let sent = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(sent.unwrap().success());
}

/// The output of a child that must end in time.
fn within(mut child: Child, longest: Duration) -> std::io::Result<Output> {
    let (mut stdout, mut stderr) = (child.stdout.take().unwrap(), child.stderr.take().unwrap());
    let read = |pipe: &mut dyn std::io::Read| {
        let mut bytes = Vec::new();
        pipe.read_to_end(&mut bytes).map(|_| bytes)
    };
    thread::scope(|scope| {
        let (out, err) =
            (scope.spawn(move || read(&mut stdout)), scope.spawn(move || read(&mut stderr)));
        let began = Instant::now();
        let status = loop {
            match child.try_wait()? {
                Some(status) => break status,
                None if began.elapsed() > longest => {
                    child.kill()?;
                    break child.wait()?;
                }
                None => thread::sleep(Duration::from_millis(5)),
            }
        };
        Ok(Output { status, stdout: out.join().unwrap()?, stderr: err.join().unwrap()? })
    })
}

/// A run that has ended.
pub struct Assert {
    run: String,
    output: Output,
}

impl Assert {
    #[track_caller]
    fn must(self, ended: bool, how: impl Debug) -> Assert {
        let Output { status, stdout, stderr } = &self.output;
        let (out, err) = (String::from_utf8_lossy(stdout), String::from_utf8_lossy(stderr));
        assert!(ended, "{}\nmust end with {how:?}: {status}\n{out}\n{err}", self.run);
        self
    }

    #[track_caller]
    pub fn success(self) -> Assert {
        let ended = self.output.status.success();
        self.must(ended, "success")
    }

    #[track_caller]
    pub fn code(self, code: i32) -> Assert {
        let ended = self.output.status.code() == Some(code);
        self.must(ended, code)
    }

    pub fn get_output(&self) -> &Output {
        &self.output
    }
}
