//! The units that columns of times are in.

/// The unit of a column of times.
#[derive(Debug, Clone, PartialEq)]
pub struct Clock {
    /// s in one of them.
    pub seconds: f64,
    /// What messages call it.
    pub word: &'static str,
}

impl Default for Clock {
    fn default() -> Clock {
        Clock { seconds: 1.0, word: "s" }
    }
}

impl Clock {
    /// The unit of time that a word means.
    pub fn named(word: &str) -> Option<Clock> {
        let (seconds, word) = match word.trim().trim_end_matches('.').to_lowercase().as_str() {
            "s" | "sec" | "secs" | "second" | "seconds" | "sek" => (1.0, "s"),
            "ms" | "msec" | "msecs" | "millisecond" | "milliseconds" => (1.0e-3, "ms"),
            "us" | "µs" | "μs" | "usec" | "microsecond" | "microseconds" => (1.0e-6, "µs"),
            "min" | "mins" | "minute" | "minutes" => (60.0, "min"),
            "h" | "hr" | "hrs" | "hour" | "hours" => (3600.0, "h"),
            _ => return None,
        };
        Some(Clock { seconds, word })
    }
}
