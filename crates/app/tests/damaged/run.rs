//! Runs cases, one at a time, and judges each.

use std::io::Write;
use std::panic::{self, AssertUnwindSafe};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use crate::damage::{Chance, damaged};
use crate::memory;
use crate::readers::{Read, Reader};

/// Most bytes that a case may hold: those of the largest motion that is read, 10^7 samples of both components, before
/// and after it is scaled, and as much again.
pub const MOST_BYTES: usize = 640 << 20;
/// Most letters of a line.
pub const LONGEST_LINE: usize = 2000;
/// Time of a case beyond which it is one that does not end, on a slow and busy machine.
const LONGEST: Duration = Duration::from_secs(120);

/// How many cases of each reader are tried.
const CASES: &str = "TOPPLE_DAMAGED_CASES";
/// The one case that is tried: reader/number.
const CASE: &str = "TOPPLE_DAMAGED_CASE";

static ALONE: Mutex<()> = Mutex::new(());

/// Memory is the whole process's: while one test counts it, no other takes any, or gives it back.
pub fn alone() -> MutexGuard<'static, ()> {
    ALONE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Says something past the test harness.
fn say(line: std::fmt::Arguments) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// The damaged file of a case: a whole one, by its number, and what happens to it.
fn case(reader: &Reader, number: u64) -> Vec<u8> {
    let of_name = crc32c::crc32c(reader.name.as_bytes());
    let mut chance = Chance::of(u64::from(of_name) << 32 ^ number);
    let file = chance.below(reader.files.len());
    damaged(&reader.files[file], &mut chance)
}

/// Reads bytes; what the reader said, or which rule it broke.
pub fn judge(read: Read, bytes: &[u8]) -> Result<Result<(), String>, String> {
    let before = memory::begin();
    let read = panic::catch_unwind(AssertUnwindSafe(|| read(bytes)));
    let held = memory::most().saturating_sub(before);
    let read = read.map_err(|panic| {
        let text = panic.downcast_ref::<String>().map(String::as_str);
        format!("it panicked: {}", text.or(panic.downcast_ref::<&str>().copied()).unwrap_or("?"))
    })?;
    if held > MOST_BYTES {
        return Err(format!("it held {held} bytes of memory, more than {MOST_BYTES}"));
    }
    if let Err(line) = &read
        && (line.trim().is_empty() || line.contains('\n') || line.chars().count() > LONGEST_LINE)
    {
        let shown: String = line.chars().take(300).collect();
        return Err(format!("it does not say one line of up to {LONGEST_LINE} letters: {shown:?}"));
    }
    Ok(read)
}

/// The same by itself, without the words of a panic.
pub fn quietly(read: Read, bytes: &[u8]) -> Result<Result<(), String>, String> {
    let _alone = alone();
    let hook = panic::take_hook();
    panic::set_hook(Box::new(|_| {}));
    let judged = judge(read, bytes);
    panic::set_hook(hook);
    judged
}

/// Ends the process where a case takes too long, and names the case.
struct Watch<'a> {
    name: &'a str,
    number: AtomicU64,
    began: Mutex<Instant>,
    over: AtomicBool,
}

impl Watch<'_> {
    fn look(&self) {
        while !self.over.load(Ordering::Relaxed) {
            thread::sleep(Duration::from_millis(20));
            if self.began.lock().unwrap().elapsed() > LONGEST {
                let number = self.number.load(Ordering::Relaxed);
                say(format_args!("{CASE}={}/{number} takes more than {LONGEST:?}", self.name));
                std::process::abort();
            }
        }
    }
}

/// Tries the cases that the environment asks for, of all readers.
pub fn all(readers: &[Reader]) {
    let _alone = alone();
    let asked = std::env::var(CASE).ok();
    let cases = std::env::var(CASES).ok().map(|count| count.parse().expect(CASES));
    let mut broken = Vec::new();
    for reader in readers {
        let numbers = match &asked {
            Some(asked) => match asked.split_once('/').filter(|(name, _)| *name == reader.name) {
                Some((_, number)) => {
                    let number: u64 = number.parse().expect(CASE);
                    number..number + 1
                }
                None => continue,
            },
            None => 0..cases.unwrap_or(reader.few) as u64,
        };
        broken.extend(of(reader, numbers, asked.is_some()));
    }
    assert!(broken.is_empty(), "{} broken:\n{}", broken.len(), broken.join("\n"));
}

/// Tries some cases of a reader; which of them broke a rule.
fn of(reader: &Reader, numbers: std::ops::Range<u64>, aloud: bool) -> Vec<String> {
    let began = Instant::now();
    let (mut broken, mut refused) = (Vec::new(), 0);
    let watch = Watch {
        name: reader.name,
        number: AtomicU64::new(numbers.start),
        began: Mutex::new(began),
        over: AtomicBool::new(false),
    };
    let count = numbers.end - numbers.start;
    thread::scope(|scope| {
        scope.spawn(|| watch.look());
        for number in numbers {
            watch.number.store(number, Ordering::Relaxed);
            *watch.began.lock().unwrap() = Instant::now();
            let bytes = case(reader, number);
            if aloud {
                say(format_args!("{}", String::from_utf8_lossy(&bytes)));
            }
            match judge(reader.read, &bytes) {
                Ok(read) => {
                    if aloud {
                        say(format_args!("{read:?}"));
                    }
                    refused += usize::from(read.is_err());
                }
                Err(rule) => broken.push(format!("{CASE}={}/{number}: {rule}", reader.name)),
            }
        }
        watch.over.store(true, Ordering::Relaxed);
    });
    let seconds = began.elapsed().as_secs_f64();
    say(format_args!(
        "{}: {count} damaged files, {refused} refused, {} broken, {seconds:.1} s",
        reader.name,
        broken.len()
    ));
    broken
}
