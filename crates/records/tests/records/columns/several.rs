//! Files of several columns: which one is taken, and what is refused.

use std::fmt::Write as _;

use topple_records::columns::read;
use topple_records::columns::several::has_decimal_commas;
use topple_records::{Component, RecordHints};

use super::signs::REFUSED;

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
        format!("{:.2}, {}, {}, {}", 0.01 * k as f64, motion(k), 2.0 * motion(k), 3.0 * motion(k))
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
            format!("{:.2},{},{},{}", 0.01 * k as f64, motion(k), 2.0 * motion(k), 3.0 * motion(k))
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
    let text =
        rows("# dt = 0.01\nNS (g), EW (g)\n", |k| format!("{}, {}", motion(k), 2.0 * motion(k)));
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

#[test]
fn columns_have_their_units_in_a_line_below_their_names() {
    let row =
        |k: usize| format!("{:.2},{},{},{}", 0.01 * k as f64, 100.0 * motion(k), k % 5, k % 7);
    let raw = read(&rows("Time,Acc,Vel,Disp\ns,cm/s2,cm/s,cm\n", row), &RecordHints::default());
    let raw = raw.unwrap();
    assert_eq!((raw.values[9], raw.units), (100.0 * motion(9), Some((2, "cm/s2".to_string()))));
    let mixed = rows("Time,UD,NS,EW\ns,cm,gal,m/s2\n", row);
    assert_eq!(read(&mixed, &channel("EW")).unwrap().units.unwrap().1, "m/s2");
    assert!(read(&mixed, &channel("UD")).is_err());
}

#[test]
fn a_dead_sensor_or_a_counter_is_left_out_and_said() {
    for (heading, other) in [("t,NS,EW\n", "0.5"), ("t,n,EW\n", "")] {
        let text = rows(heading, |k| {
            let other = if other.is_empty() { k.to_string() } else { other.to_string() };
            format!("{:.2},{other},{}", 0.01 * k as f64, motion(k))
        });
        let raw = read(&text, &RecordHints::default()).unwrap();
        assert_eq!(raw.values[9], motion(9), "{heading}");
        assert!(raw.notes[0].contains("is left out: "), "{:?}", raw.notes);
        assert_ne!(read(&text, &channel("1")).unwrap().values[9], motion(9));
    }
}

#[test]
fn beside_a_z_the_letters_x_and_y_are_directions() {
    let text = rows("Time (s),X (m/s2),Y (m/s2),Z (m/s2)\n", |k| {
        format!("{:.2},{},{},{}", 0.01 * k as f64, motion(k), 2.0 * motion(k), 3.0 * motion(k))
    });
    let of = |vertical| RecordHints { vertical: Some(vertical), ..RecordHints::default() };
    let raw = read(&text, &of(false)).unwrap();
    assert_eq!((raw.values[9], raw.stated.component), (motion(9), Some(Component::Horizontal)));
    assert_eq!(read(&text, &of(true)).unwrap().values[9], 3.0 * motion(9));
}

#[test]
fn a_d_beside_north_and_east_is_down() {
    let of = |heading: &str, channel: Option<&str>| {
        let text = rows(heading, |k| {
            format!("{:.2},{},{},{}", 0.01 * k as f64, motion(k), 2.0 * motion(k), 3.0 * motion(k))
        });
        let channel = channel.map(String::from);
        read(&text, &RecordHints { channel, vertical: Some(true), ..RecordHints::default() })
    };
    for heading in ["Time,N,E,D\n", "Time,acc_N,acc_E,acc_D\n", "time;NS;EW;d\n"] {
        for channel in [None, Some("3"), Some("D")] {
            let raw = of(heading, channel).unwrap();
            let found = (raw.values[9], raw.stated.component);
            assert_eq!(found, (3.0 * motion(9), Some(Component::Down)), "{heading}");
            let said = |note: &String| note.ends_with("stands beside north and east: it is down");
            assert!(raw.notes.iter().any(said), "{heading}: {:?}", raw.notes);
        }
    }
    for heading in ["Time,H1,H2,D\n", "Time,N,Z,D\n"] {
        assert!(of(heading, Some("3")).unwrap_err().to_string().contains(REFUSED), "{heading}");
    }
    for heading in ["Time,N,E,Z\n", "Time,N,E,U\n", "Time,N,E,V\n"] {
        assert_eq!(of(heading, None).unwrap().stated.component, Some(Component::Up), "{heading}");
    }
}

#[test]
fn a_sign_in_brackets_is_no_unit() {
    let of = |heading: &str, channel: &str| {
        let text = rows(heading, |k| {
            format!("{:.2},{},{},{}", 0.01 * k as f64, motion(k), 2.0 * motion(k), 3.0 * motion(k))
        });
        read(&text, &self::channel(channel))
    };
    for heading in [
        "# units: g\nTime,NS (+),EW (+),UD (+)\n",
        "# units: g\nTime,NS (N),EW (E),UD (positive down)\n",
        "Time,NS (+) (g),EW (g) (+),UD (g) (+)\n",
    ] {
        for (channel, factor) in [("NS", 1.0), ("EW", 2.0), ("UD", 3.0)] {
            let raw = of(heading, channel).unwrap_or_else(|why| panic!("{heading}: {why}"));
            assert_eq!((raw.values[9], raw.units.unwrap().1.as_str()), (factor * motion(9), "g"));
        }
    }
    let error = of("# units: g\nTime,NS (+),EW (+),UD (-)\n", "UD").unwrap_err().to_string();
    assert!(error.starts_with("line 2: 'UD (-)'") && error.contains(REFUSED), "{error}");
    let error = of("# units: g\nTime,NS (ticks),EW (g),UD (g)\n", "NS").unwrap_err().to_string();
    assert!(error.contains("'ticks' is no unit"), "{error}");
}

/// Of several columns the factor of another one does not matter.
#[test]
fn a_factor_is_that_of_its_column() {
    let text = rows("Time,N,E,Z*-1\n", |k| {
        format!("{:.2},{},{},{}", 0.01 * k as f64, motion(k), 2.0 * motion(k), 3.0 * motion(k))
    });
    let of = |vertical| RecordHints { vertical: Some(vertical), ..RecordHints::default() };
    assert!(read(&text, &of(true)).unwrap_err().to_string().contains(REFUSED));
    assert_eq!(read(&text, &of(false)).unwrap().values[9], motion(9));
}

/// In German files a point may separate thousands: 1.234 cm/s2 of a peak above 1 g.
#[test]
fn a_point_beside_decimal_commas_is_refused() {
    for columns in [1, 2] {
        let text = rows("", |k| {
            let value = if k == 90 { "1.234" } else { "981,5" };
            format!("0,{k:03};{}", vec![value; columns].join(";"))
        });
        let error = read(&text, &RecordHints::default()).unwrap_err().to_string();
        assert!(
            error.starts_with("line 91: '0,090' has a comma and '1.234' a point"),
            "{columns}: {error}"
        );
    }
    let text = rows("", |k| format!("2020-01-02T03:04:{:05.2};{},5", 0.01 * k as f64, k % 7));
    assert!(read(&text, &RecordHints::default()).is_ok());
}

/// A spectrum is no motion, however its first column is called.
#[test]
fn a_column_of_frequencies_is_no_time() {
    for heading in
        ["f (Hz),a (g)", "Freq. [Hz];a [m/s2]", "omega (rad/s),acc (g)", "Frequenz,acc (g)"]
    {
        let separator = if heading.contains(';') { ";" } else { "," };
        let text = rows(&format!("{heading}\n"), |k| {
            format!("{:.2}{separator}{}", 0.1 * k as f64, motion(k))
        });
        let error = read(&text, &RecordHints::default()).unwrap_err().to_string();
        assert!(error.contains("this is no motion over time"), "{heading}: {error}");
    }
}

/// Nothing but separators above the samples is no sample, in a table as in one column; amid them one may be missing.
#[test]
fn a_row_of_separators_above_the_samples_says_nothing() {
    let of = |width: usize, row: usize| {
        let mut lines: Vec<String> = (0..50)
            .map(|k| {
                format!("{:.2}", 0.01 * k as f64) + &format!(",{:.4}", motion(k)).repeat(width)
            })
            .collect();
        lines.insert(row, ",".repeat(width));
        let hints = RecordHints { force: true, ..RecordHints::default() };
        read(&format!("time{}\n{}\n", ",acc".repeat(width), lines.join("\n")), &hints)
    };
    for width in [1, 2] {
        assert_eq!(of(width, 0).unwrap().values.len(), 50);
        let error = of(width, 9).unwrap_err().to_string();
        assert!(error.starts_with("line 11: an empty row amid the samples"), "{error}");
    }
}

#[test]
fn decimal_commas_are_said_wherever_they_begin() {
    for rows in ["0;0;0\n0,01;0,5;0,25\n0,02;0,75;0,5\n", "0;0\n0,01;0,5\n0,02;0,75\n"] {
        let raw = read(rows, &channel("1")).unwrap();
        assert_eq!((raw.values.len(), raw.values[1]), (3, 0.5));
        assert!(raw.notes.iter().any(|note| note == "decimal commas"), "{:?}", raw.notes);
    }
}
