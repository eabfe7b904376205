//! Rows of three numbers and more: a time and several channels, channels alone that a heading names, or values that run
//! on from row to row.

use super::super::channel::{Channel, choose};
use super::super::hints::RecordHints;
use super::super::lines::MOST_SAMPLES;
use super::super::numbers::number;
use super::super::times::Times;
use super::super::{Raw, RecordError, Units};
use super::told::Told;
use super::{COMMENT, Row, directions, words};
use crate::scene::shown::shown;

/// Most numbers of a row.
const WIDEST: usize = 64;

/// Part of the change from row to row below which values that follow each other in a row change, where they run on.
const RUN_ON: f64 = 0.8;

/// Most that the change from row to row and that within a row are apart, where values run on.
const BETWEEN: f64 = 2.0;

/// Fewest values of a row that runs on: three may be the components of a motion.
const FEWEST: usize = 4;

/// The rows: as many numbers in each, but for the last one, which may have fewer.
struct Table {
    width: usize,
    values: Vec<f64>,
    /// The first two columns, which may be times.
    times: [Times; 2],
    /// The line of the first row, and of one that has fewer numbers.
    first: usize,
    short: Option<usize>,
}

impl Table {
    fn read(text: &str, first: usize) -> Result<Table, RecordError> {
        let mut table = Table {
            width: 0,
            values: Vec::new(),
            times: [Times::default(), Times::default()],
            first,
            short: None,
        };
        let mut empty = None;
        for (index, line) in text.lines().enumerate().skip(first - 1) {
            let (at, line) = (index + 1, line.trim());
            if line.is_empty() || line.starts_with(COMMENT) {
                continue;
            }
            let row = Row::new(line);
            let fields = row.fields();
            let Some(numbers) = super::numbers(&fields) else {
                return Err(RecordError::line(at, "this is not a number"));
            };
            if numbers.is_empty() {
                empty.get_or_insert(at);
                continue;
            }
            if let Some(empty) = empty {
                return Err(super::empty_row(empty));
            }
            if table.width == 0 {
                table.width = numbers.len();
            }
            if let Some(short) = table.short.or((numbers.len() > table.width).then_some(at)) {
                let problem = format!(
                    "another count of columns than the {} of line {first}; write as many in each row",
                    table.width
                );
                return Err(RecordError::line(short, problem));
            }
            if numbers.len() < table.width {
                table.short = Some(at);
            }
            for ((times, field), number) in table.times.iter_mut().zip(&fields).zip(&numbers) {
                times.add(at, field, *number);
            }
            table.values.extend(&numbers);
            if table.width > WIDEST || table.values.len() > 4 * MOST_SAMPLES {
                let problem = format!("more than {WIDEST} columns, or {MOST_SAMPLES} samples");
                return Err(RecordError::line(at, problem));
            }
        }
        Ok(table)
    }

    fn column(&self, column: usize) -> impl Iterator<Item = f64> {
        self.values.iter().skip(column).step_by(self.width).copied()
    }

    /// True where each number of a column is above the one before it.
    fn grows(&self, column: usize) -> bool {
        self.column(column).is_sorted_by(|before, next| before < next)
    }

    /// True where a column counts the rows.
    fn counts(&self, column: usize) -> bool {
        self.column(column).is_sorted_by(|before, next| next - before == 1.0)
    }

    /// True of values that run on from row to row: a motion changes less from one sample to the next than over a row, and
    /// no more from a row's last to the next one's first.
    fn runs_on(&self) -> bool {
        let apart = |apart: usize, counts: &dyn Fn(usize) -> bool| {
            let pairs = self.values.iter().zip(self.values.iter().skip(apart)).enumerate();
            let changes = pairs.filter(|(at, _)| counts(*at)).map(|(_, (a, b))| (b - a).abs());
            let (sum, count) =
                changes.fold((0.0, 0), |(sum, count), change| (sum + change, count + 1));
            sum / f64::from(count.max(1))
        };
        let ends = |at: usize| at % self.width + 1 == self.width;
        let (within, between) = (apart(1, &|at| !ends(at)), apart(1, &ends));
        within < RUN_ON * apart(self.width, &|_| true)
            && between < BETWEEN * within
            && within < BETWEEN * between
    }
}

/// True of a row whose commas may be decimal ones: they stand within words that blanks part.
fn has_decimal_commas(line: &str) -> bool {
    let within = |word: &str| word.trim_matches(',').contains(',');
    line.split_whitespace().count() > 1 && line.split_whitespace().any(within)
}

/// The names of the columns: of the last line above the rows that has as many, and neither their units alone nor a
/// statement such as `dt = 0.01`.
fn names(text: &str, first: usize, width: usize) -> Option<(usize, Vec<String>)> {
    let above: Vec<&str> = text.lines().take(first - 1).collect();
    above.iter().enumerate().rev().find_map(|(index, line)| {
        let names = words::columns(line.trim().trim_start_matches(COMMENT));
        let are_units = names.iter().all(|name| Units::are_meant(name) || name == "s");
        let states = names.iter().any(|name| name.contains(['=', ':']) || number(name).is_some());
        (names.len() == width && !are_units && !states).then_some((index + 1, names))
    })
}

/// True where words stand above the rows that state nothing known: names of columns that are not understood.
fn is_headed(text: &str, first: usize) -> bool {
    let above = text.lines().take(first - 1).map(str::trim);
    above.filter(|line| !line.is_empty()).any(|line| {
        let plain = line.trim_start_matches(COMMENT);
        let is_comment = plain.len() < line.len();
        !is_comment && super::numbers(&super::free(line)).is_none() || words::names_columns(plain)
    })
}

/// True of a pair of columns that a heading names as two accelerations, neither of them a time.
pub(super) fn is_pair(text: &str, first: usize) -> bool {
    let named = names(text, first, 2);
    named.is_some_and(|(_, names)| names.iter().all(|name| words::is_channel(name)))
}

/// The columns that are accelerations by their names: where one says so, only those that do; else those whose names are
/// directions.
fn channels<'a>(names: &'a [String], hints: &RecordHints) -> Vec<Channel<'a>> {
    let says = names.iter().any(|name| words::says_acceleration(name));
    let asked = hints.channel.as_deref().is_some_and(|asked| asked.trim().parse::<u32>().is_ok());
    let is_channel = |name: &str| match says {
        true => words::says_acceleration(name),
        // One that is chosen by its number need not be understood.
        false => words::is_channel(name) || asked && !words::says_integral(name),
    };
    let numbered = (1..).zip(names).filter(|(_, name)| is_channel(name));
    let channel = |(number, name): (u32, &'a String)| Channel {
        number: Some(number),
        word: words::direction(name),
        component: directions::of_column(name),
        before: 0,
        text: name,
    };
    numbered.map(channel).collect()
}

/// The record in a text whose first row of several columns stands in line `first`; `title` is the first line of words.
pub(super) fn read(
    text: &str,
    first: usize,
    hints: &RecordHints,
    mut told: Told,
    title: String,
) -> Result<Raw, RecordError> {
    let line = text.lines().nth(first - 1).unwrap_or_default();
    if !line.contains(';') && has_decimal_commas(line) {
        return Err(super::rows::too_many(first, super::free(line).len(), line));
    }
    let table = Table::read(text, first)?;
    let names = names(text, first, table.width);
    // Some programs count the rows before the times.
    let grows = table.grows(0);
    let timed = match grows {
        true if table.counts(0) && table.grows(1) => Some(1),
        true => Some(0),
        false => None,
    };
    if let (Some(short), true) = (table.short, grows) {
        let problem =
            "fewer columns than in the rows above; complete this row, or cut the record before it";
        return Err(RecordError::line(short, problem));
    }
    let timed = timed.filter(|_| table.values.len() > table.width);
    // Names of columns are no title.
    let is_of = |line: usize| {
        text.lines().nth(line - 1).is_some_and(|line| line.trim().starts_with(&title))
    };
    let is_names = names.as_ref().is_some_and(|(line, _)| is_of(*line));
    let mut raw = super::titled(Raw::default(), if is_names { String::new() } else { title });
    let from = match timed {
        Some(column) => {
            let timed = told.step_of(&table.times[column], hints.dt, None)?;
            raw.step = Some(timed.step);
            raw.stated.start = timed.start;
            raw.notes.extend(timed.note);
            column + 1
        }
        None => 0,
    };
    let headed = is_headed(text, first);
    if timed.is_none() && (names.is_none() || table.short.is_some()) {
        let known = hints.dt.is_some() || told.has_step();
        if !known || headed || table.width < FEWEST || !table.runs_on() {
            let problem = format!(
                "{} columns here; one of values, or a time and values, are read. If the values run on from row to row, \
                 write their count and step above them, as in '4000 0.01'; else name the columns",
                table.width
            );
            return Err(RecordError::line(table.first, problem));
        }
        raw.notes.push(format!("values run on from row to row, {} in each", table.width));
        raw.values = table.values;
        return told.complete(raw);
    }
    let key = hints.channel_key();
    if headed && names.is_none() && hints.channel.is_none() {
        let problem = format!(
            "the lines above do not name {} columns; name each, or choose one by `{key}` (1 is the first behind the times)",
            table.width
        );
        return Err(RecordError::line(first, problem));
    }
    let named = names.is_some();
    // Without names each column may be one.
    let (line, names) = names.unwrap_or((first, vec!["acc".to_string(); table.width]));
    let channels = channels(&names[from..], hints);
    if channels.is_empty() {
        let problem = format!(
            "no column is an acceleration by its name; name one acc or by its direction, or choose one by `{key}` (1 is the \
             first behind the times)"
        );
        return Err(RecordError::line(line, problem));
    }
    let lone = channels.len() == 1;
    let (channel, note) = choose(channels, hints, &mut raw.stated)?;
    raw.notes.extend(note);
    let column = from + channel.number.map_or(0, |number| number as usize - 1);
    raw.values = table.column(column).collect();
    let own = words::bracket(channel.text).map(|words| (line, words.to_string()));
    raw.stated.azimuth = directions::azimuth_of_column(channel.text).filter(|_| named);
    // What is told of the whole file, its title's last word too, may be of another column.
    if !(lone || !named) {
        raw.stated.component = None;
        told.forget_direction();
    }
    raw.stated.component = channel.component.or(raw.stated.component);
    let mut raw = told.complete(raw)?;
    if let Some((line, words)) = own {
        if Units::named(&words).is_none() && !Units::are_meant(&words) {
            let problem = format!("'{}' is no unit of a column of accelerations", shown(&words));
            return Err(RecordError::line(line, problem));
        }
        raw.units = Some((line, words));
    }
    Ok(raw)
}

#[cfg(test)]
mod tests {
    use super::super::read;
    use super::*;
    use crate::scene::record::Component;
    use std::fmt::Write as _;

    /// A motion of 2 Hz in steps of 0.01 s, in m/s2.
    fn motion(k: usize) -> f64 {
        (0.1257 * k as f64).sin() + 0.2 * (0.03 * k as f64).cos()
    }

    fn rows(heading: &str, row: impl Fn(usize) -> String) -> String {
        (0..200).fold(heading.to_string(), |mut text, k| {
            let _ = writeln!(text, "{}", row(k));
            text
        })
    }

    fn channel(word: &str) -> RecordHints {
        RecordHints { channel: Some(word.into()), ..RecordHints::default() }
    }

    #[test]
    fn a_channel_is_chosen_by_its_number_or_direction() {
        let text = rows("Time (s), NS (g), EW (g), UD (gal)\n", |k| {
            format!(
                "{:.2}, {}, {}, {}",
                0.01 * k as f64,
                motion(k),
                2.0 * motion(k),
                3.0 * motion(k)
            )
        });
        let first = read(&text, &RecordHints::default()).unwrap();
        assert!(
            first.notes[0].contains("the first of 3 channels is taken, 1 (NS)"),
            "{:?}",
            first.notes
        );
        assert_eq!((first.values[7], first.step.unwrap().seconds), (motion(7), 0.01));
        for (asked, factor, unit) in [("EW", 2.0, "g"), ("2", 2.0, "g"), ("ud", 3.0, "gal")] {
            let raw = read(&text, &channel(asked)).unwrap();
            assert_eq!(raw.values[7], factor * motion(7), "{asked}");
            assert_eq!(raw.units.unwrap().1, unit, "{asked}");
        }
        let up = RecordHints { vertical: Some(true), ..RecordHints::default() };
        assert_eq!(read(&text, &up).unwrap().stated.component, Some(Component::Up));
        assert!(read(&text, &channel("T")).is_err());
    }

    #[test]
    fn what_a_heading_does_not_name_as_an_acceleration_is_not_taken() {
        let of = |heading: &str, channel: Option<&str>| {
            let text = rows(heading, |k| {
                format!(
                    "{:.2},{},{},{}",
                    0.01 * k as f64,
                    motion(k),
                    2.0 * motion(k),
                    3.0 * motion(k)
                )
            });
            let channel = channel.map(String::from);
            read(&text, &RecordHints { channel, vertical: Some(false), ..RecordHints::default() })
        };
        for (heading, factor) in [
            ("t,NS,EW,UD\n", 1.0),
            ("t,UD,NS,EW,\n", 2.0),
            ("t,Down,NS,EW\n", 2.0),
            ("time,HNZ,HNN,HNE\n", 2.0),
            ("t,acc-UD,acc-NS,acc-EW\n", 2.0),
            ("t,Up-Down,UD2,IWT010.EW\n", 3.0),
            ("t,ground velocity,force,ground acceleration\n", 3.0),
            ("t,d_ns,v_ns,a_ns\n", 3.0),
            ("t,PSA,error,acc\n", 3.0),
            ("t,udot,u,acc EW\n", 3.0),
            ("200 0.01\nTime (s),Z (down),vert.,NS (g)\n", 3.0),
        ] {
            let raw = of(heading, None).unwrap_or_else(|error| panic!("{heading}: {error}"));
            assert_eq!(raw.values[9], factor * motion(9), "{heading}");
            assert_eq!(raw.step.unwrap().seconds, 0.01, "{heading}");
        }
        for heading in [
            "Time,UD,NS\n",
            "a station of three words\n",
            "t,force,temperature,flag\n",
            "t,EW_vel,NS_vel,UD_vel\n",
            "Time,desplazamiento,geschwindigkeit,x\n",
            "Period (s),SA (g),SD (cm),PSV\n",
            "depth (m),acc,acc2,acc3\n",
            "# response spectrum, 5% damping\n",
        ] {
            assert!(of(heading, None).is_err(), "{heading}");
        }
        assert_eq!(of("t,force,CH1,CH2\n", Some("2")).unwrap().values[9], 2.0 * motion(9));
        assert!(of("t,force,vel,CH2\n", Some("2")).is_err());
    }

    #[test]
    fn a_title_says_nothing_of_the_direction_of_named_columns() {
        let text = rows("Quake, 1/2/1990, Station, UP\nt,NS,EW,UD\n", |k| {
            format!("{:.2},{},{},{}", 0.01 * k as f64, motion(k), motion(k), motion(k))
        });
        let raw = read(&text, &RecordHints::default()).unwrap();
        assert_eq!(raw.stated.component, Some(Component::Horizontal));
        assert_eq!((&*raw.stated.station, raw.stated.channels.len()), ("Station", 3));
    }

    #[test]
    fn two_named_columns_without_a_time_are_channels() {
        let text = rows("# dt = 0.01\nNS (g), EW (g)\n", |k| {
            format!("{}, {}", motion(k), 2.0 * motion(k))
        });
        let raw = read(&text, &channel("EW")).unwrap();
        assert_eq!((raw.values[4], raw.step.unwrap().seconds), (2.0 * motion(4), 0.01));
    }

    #[test]
    fn a_row_that_is_cut_off_is_no_sign_of_values_that_run_on() {
        let hints = RecordHints { dt: Some(0.01), ..RecordHints::default() };
        for heading in ["Time (s),NS (g),EW (g)\n", ""] {
            let text = rows(heading, |k| match k {
                199 => "1.99,0.5".into(),
                k => format!("{:.2},{},{}", 0.01 * k as f64, motion(k), motion(k)),
            });
            let error = read(&text, &hints).unwrap_err().to_string();
            assert!(error.contains("fewer columns than in the rows above"), "{error}");
        }
        // Channels alike, side by side, in which the change within a row is least.
        let alike = rows("", |k| match k {
            199 => "0.5 0.5".into(),
            k => format!("{0} {0} {0} {0} {0}", motion(k)),
        });
        assert!(read(&alike, &hints).is_err());
    }

    #[test]
    fn velocities_beside_accelerations_are_no_channels() {
        let text = rows("# t [s]\tacc [m/s2]\tvel [m/s]\tdisp [m]\n", |k| {
            format!("{:.2}\t{}\t5\t6", 0.01 * k as f64, motion(k))
        });
        let raw = read(&text, &RecordHints::default()).unwrap();
        assert_eq!((raw.values[3], raw.units.unwrap().1.as_str()), (motion(3), "m/s2"));
        assert!(raw.stated.channels.is_empty());
        let text = text.replace("acc [m/s2]", "u [m]");
        assert!(read(&text, &RecordHints::default()).is_err());
    }

    #[test]
    fn rows_that_are_counted_have_their_times_behind_the_count() {
        let text = rows("", |k| format!("{} {:.3} {}", k + 1, 0.005 * k as f64, motion(k)));
        let raw = read(&text, &RecordHints::default()).unwrap();
        assert_eq!((raw.step.unwrap().seconds, raw.values[9]), (0.005, motion(9)));
    }

    #[test]
    fn values_run_on_where_a_step_is_known_and_they_change_less_along_a_row() {
        let long = |heading: &str, last: usize| {
            let mut text = heading.to_string();
            for k in 0..200 * 8 + last {
                let end = if k % 8 == 7 { '\n' } else { ' ' };
                let _ = write!(text, "{:.5}{end}", motion(k));
            }
            text
        };
        for last in [0, 3] {
            let raw = read(&long("# dt = 0.01 s\n# units: m/s2\n", last), &RecordHints::default());
            let raw = raw.unwrap();
            assert_eq!(raw.values.len(), 1600 + last);
            assert!((raw.values[13] - motion(13)).abs() < 1e-5);
            assert!(raw.notes.iter().any(|note| note.contains("run on")), "{:?}", raw.notes);
        }
        // Without a step nothing says that they are no channels side by side; and three that are, are not one motion.
        assert!(read(&long("", 0), &RecordHints::default()).is_err());
        let side = rows("# dt = 0.01\n", |k| {
            format!("{} {} {}", motion(k), -motion(k + 40), 0.1 * motion(k + 90))
        });
        let error = read(&side, &RecordHints::default()).unwrap_err().to_string();
        assert!(error.starts_with("line 2: 3 columns here"), "{error}");
        let named = side.replace("# dt = 0.01\n", "# dt = 0.01\n# NS EW UD\n");
        let raw = read(&named, &channel("UD")).unwrap();
        assert_eq!((raw.step.unwrap().seconds, raw.values[5]), (0.01, 0.1 * motion(95)));
    }

    #[test]
    fn rows_of_other_lengths_are_told_with_their_line() {
        let text = rows("", |k| match k {
            20 => "0.2 1 1 1".into(),
            k => format!("{:.2} 1 2", 0.01 * k as f64),
        });
        let error = read(&text, &RecordHints::default()).unwrap_err().to_string();
        assert!(error.starts_with("line 21: another count of columns"), "{error}");
        let text = rows("", |k| format!("{},5 0,{k}", k).replace(' ', "\t"));
        let error = read(&text, &RecordHints::default()).unwrap_err().to_string();
        assert!(error.contains("if its commas are decimal ones, write points"), "{error}");
        assert!(!has_decimal_commas("0.1, 2, 3") && !has_decimal_commas("0.1,2,3 "));
    }
}
