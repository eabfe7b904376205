//! The command line that a thread works for: its words, where it prints, and what it has warned of.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::env;
use std::ffi::OsString;
use std::io::{self, Write};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

use anstream::{StripStream, stderr, stdout};
use topple::scene::path_text::PathText;
use topple_manifest::CommandLine;

type Stream = Box<dyn Write + Send>;

/// Where a command prints.
pub struct Streams {
    out: Mutex<Stream>,
    err: Mutex<Stream>,
    /// A bar of progress is drawn on the terminal of the process alone.
    has_bars: bool,
}

impl Streams {
    /// Those of the process, in colour where they show any.
    pub fn of_the_process() -> Streams {
        Streams {
            out: Mutex::new(Box::new(stdout())),
            err: Mutex::new(Box::new(stderr())),
            has_bars: true,
        }
    }

    /// Others, which show no colour.
    pub fn plain(out: impl Write + Send + 'static, err: impl Write + Send + 'static) -> Streams {
        let [out, err]: [Stream; 2] = [Box::new(out), Box::new(err)];
        let plain = |stream| Mutex::new(Box::new(StripStream::new(stream)) as Stream);
        Streams { out: plain(out), err: plain(err), has_bars: false }
    }
}

/// A command line that is run.
pub struct Call {
    /// Its words after the program's name.
    pub words: Vec<OsString>,
    streams: Streams,
    /// Why the first line that could not be printed was not.
    pub failed: OnceLock<io::Error>,
    /// What it has warned of, for run.json.
    pub warnings: Mutex<Vec<String>>,
    /// Letters that it has warned of.
    pub letters: Mutex<BTreeSet<char>>,
}

thread_local! {
    static CURRENT: RefCell<Option<Arc<Call>>> = const { RefCell::new(None) };
}

impl Call {
    /// That of these words, the program's name first.
    pub fn of(words: &[OsString], streams: Streams) -> Arc<Call> {
        Arc::new(Call {
            words: words.iter().skip(1).cloned().collect(),
            streams,
            failed: OnceLock::new(),
            warnings: Mutex::default(),
            letters: Mutex::default(),
        })
    }

    /// That which this thread works for. A thread that prints or warns takes it along by [`Call::scope`].
    pub fn current() -> Arc<Call> {
        let current = CURRENT.with_borrow(Clone::clone);
        current.unwrap_or_else(|| Call::of(&[], Streams::of_the_process()))
    }

    /// Works for it.
    pub fn scope<T>(self: &Arc<Call>, work: impl FnOnce() -> T) -> T {
        /// Puts back what was there, whoever panics.
        struct Before(Option<Arc<Call>>);
        impl Drop for Before {
            fn drop(&mut self) {
                CURRENT.set(self.0.take());
            }
        }
        let _before = Before(CURRENT.replace(Some(self.clone())));
        work()
    }

    /// What repeats it, for run.json.
    pub fn command_line(&self) -> CommandLine {
        let arguments = self.words.iter().map(|word| PathText(word.into())).collect();
        CommandLine { arguments, directory: PathText(env::current_dir().unwrap_or_default()) }
    }

    /// Prints on stdout.
    pub fn out(&self, print: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
        print(&mut **lock(&self.streams.out))
    }

    /// Prints on stderr.
    pub fn err(&self, print: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
        print(&mut **lock(&self.streams.err))
    }

    /// True where a bar shows on the terminal.
    pub fn has_bars(&self) -> bool {
        self.streams.has_bars
    }
}

/// What a lock holds: each change of it is whole, also that of a thread that panicked.
pub fn lock<T: ?Sized>(of: &Mutex<T>) -> MutexGuard<'_, T> {
    of.lock().unwrap_or_else(PoisonError::into_inner)
}
