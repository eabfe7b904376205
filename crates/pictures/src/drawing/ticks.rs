//! The numbers of an axis: 1, 2 or 5 of a decimal place, decades of a logarithm, those of a list.

/// A mark of an axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Tick {
    /// Its coordinate.
    pub at: f64,
    /// Its number; none at a small mark.
    pub text: String,
}

/// How values lie along an axis.
#[derive(Debug, Clone, PartialEq)]
pub enum Scale {
    /// By themselves.
    Linear,
    /// By their decimal logarithm, that of negative ones with its sign turned: see
    /// [`Values::coordinate`](topple::scene::Values::coordinate).
    Log {
        /// True where they lie below zero.
        negative: bool,
    },
    /// By their place in a list.
    List(Vec<f64>),
}

/// Least numbers of an axis, where there is room for them.
const LEAST: usize = 2;
/// Most numbers of an axis.
const MOST: usize = 11;

/// The marks of an axis from one coordinate to another, which may be the lower one: the most that fit.
pub fn of(scale: &Scale, (from, to): (f64, f64), fits: impl Fn(&[Tick]) -> bool) -> Vec<Tick> {
    let (low, high) = (from.min(to), from.max(to));
    let candidates = match scale {
        Scale::Linear => linear(low, high),
        Scale::Log { negative } => logarithmic(low, high, *negative),
        Scale::List(values) => list(values),
    };
    let numbers = |ticks: &[Tick]| ticks.iter().filter(|tick| !tick.text.is_empty()).count();
    let good = candidates.iter().find(|ticks| numbers(ticks) <= MOST && fits(ticks));
    // Where none has room the one with the fewest numbers, of which two at least.
    let fallback = || candidates.iter().rev().find(|ticks| numbers(ticks) >= LEAST);
    good.filter(|ticks| numbers(ticks) >= LEAST || candidates.len() == 1)
        .or_else(fallback)
        .or(candidates.first())
        .cloned()
        .unwrap_or_default()
}

/// Steps of 1, 2 or 5 of a decimal place, from fine ones to that of a span's length.
fn steps(span: f64) -> Vec<f64> {
    let place = (span / 20.0).log10().floor() as i32;
    let digits = [1.0, 2.0, 5.0];
    let all = (place..place + 4).flat_map(|k| digits.map(|digit| digit * 10.0_f64.powi(k)));
    all.filter(|step| *step >= span / 20.0 && *step <= span).collect()
}

fn linear(low: f64, high: f64) -> Vec<Vec<Tick>> {
    if !(high > low) {
        return vec![vec![Tick { at: low, text: rounded(low, low.abs().max(1.0e-3)) }]];
    }
    let span = high - low;
    let largest = low.abs().max(high.abs());
    steps(span)
        .into_iter()
        .map(|step| {
            let first = (low / step - 1.0e-6).ceil() as i64;
            let last = (high / step + 1.0e-6).floor() as i64;
            let tick = |k: i64| {
                let at = step * k as f64;
                Tick { at, text: number(at, step, largest) }
            };
            (first..=last).map(tick).collect()
        })
        .collect()
}

fn logarithmic(low: f64, high: f64, negative: bool) -> Vec<Vec<Tick>> {
    let sign = if negative { -1.0 } else { 1.0 };
    // Decades of the magnitudes.
    let (bottom, top) = if negative { (-high, -low) } else { (low, high) };
    let (first, last) = ((bottom - 1.0e-9).floor() as i32, (top + 1.0e-9).ceil() as i32);
    let inside = |place: f64| place >= bottom - 1.0e-6 && place <= top + 1.0e-6;
    let plain = first >= -3 && last <= 4;
    let marks = |digits: &[u32], every: i32| -> Vec<Tick> {
        let mut ticks = Vec::new();
        for decade in first..=last {
            for digit in 1..=9 {
                let place = f64::from(decade) + f64::from(digit).log10();
                let named = digits.contains(&digit) && decade.rem_euclid(every) == 0;
                // Between decades that are left out there are none.
                if !inside(place) || (!named && every > 1 && digit > 1) {
                    continue;
                }
                let text = match (named, plain, digit) {
                    (false, ..) => String::new(),
                    (_, true, _) => {
                        let value = sign * f64::from(digit) * 10.0_f64.powi(decade);
                        number(value, 10.0_f64.powi(decade), value.abs())
                    }
                    (_, _, 1) => format!("{}10^{{{decade}}}", if negative { "-" } else { "" }),
                    _ => format!("{}·10^{{{decade}}}", sign * f64::from(digit)),
                };
                ticks.push(Tick { at: sign * place, text });
            }
        }
        ticks
    };
    let mut candidates = Vec::new();
    if top - bottom < 1.0 {
        // Less than a decade has few of those: steps as between the values themselves.
        let (least, most) = (10.0_f64.powf(bottom), 10.0_f64.powf(top));
        candidates.extend(linear(least, most).into_iter().map(|ticks| {
            let bent = |tick: Tick| {
                let text = if negative { format!("-{}", tick.text) } else { tick.text };
                Tick { at: sign * tick.at.log10(), text }
            };
            ticks.into_iter().filter(|tick| tick.at > 0.0).map(bent).collect()
        }));
    }
    candidates.push(marks(&[1, 2, 5], 1));
    candidates.extend([1, 2, 3, 5, 10, 20, 50].map(|every| marks(&[1], every)));
    candidates
}

fn list(values: &[f64]) -> Vec<Vec<Tick>> {
    let every = |step: usize| {
        let tick = |k: usize| {
            let text =
                if k.is_multiple_of(step) { format!("{}", values[k]) } else { String::new() };
            Tick { at: k as f64, text }
        };
        (0..values.len()).map(tick).collect()
    };
    (1..=values.len().max(1)).map(every).collect()
}

/// A number of an axis with steps of some size, the largest of which is `largest`.
fn number(value: f64, step: f64, largest: f64) -> String {
    if value.abs() < 1.0e-9 * step.abs() {
        return "0".into();
    }
    let place = (step.abs().log10() + 1.0e-6).floor() as i32;
    if largest >= 1.0e5 || place < -4 {
        let power = largest.log10().floor() as i32;
        let digits = (power - place).max(0) as usize;
        return format!("{:.digits$}·10^{{{power}}}", value / 10.0_f64.powi(power));
    }
    let digits = (-place).max(0) as usize;
    format!("{value:.digits$}")
}

/// A number among others over a range that is `width` wide: no more digits than tell them apart.
pub fn rounded(value: f64, width: f64) -> String {
    if value.abs() < 1.0e-9 * width {
        return "0".into();
    }
    let digits = (2.0 - width.log10().floor()).clamp(0.0, 9.0) as usize;
    let text = format!("{value:.digits$}");
    if digits == 0 {
        return text;
    }
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}
