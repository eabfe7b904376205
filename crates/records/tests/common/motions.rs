//! A motion in each format that is read, as the programs of its publishers write it.

/// g of the files' numbers, m/s^2.
const GRAVITY: f64 = 9.81;

/// A component of a motion.
#[derive(Debug, Clone)]
pub struct Motion {
    /// m/s^2.
    pub samples: Vec<f64>,
    /// Time between samples, s.
    pub dt: f64,
    pub station: &'static str,
    /// Degrees from north; none of a vertical.
    pub azimuth: Option<u32>,
    /// Of a vertical: positive down.
    pub down: bool,
}

/// A file of it.
#[derive(Debug)]
pub struct Written {
    pub format: &'static str,
    pub text: String,
    /// By how much a sample may be off as it is written, m/s^2.
    pub within: f64,
    /// The file does not tell its step, or its units.
    pub needs: (bool, bool),
    /// The file tells which component it is.
    pub tells: bool,
}

impl Motion {
    /// Damped oscillations with a peak of 3.5 m/s^2.
    pub fn made(count: usize, azimuth: Option<u32>) -> Motion {
        let shape = |k: usize| {
            let t = k as f64 / count as f64;
            (31.0 * t).sin() * (-((t - 0.4) / 0.2).powi(2)).exp()
                + 0.2 * (77.0 * t).sin() * (1.0 - t)
        };
        let mut samples: Vec<f64> = (0..count).map(shape).collect();
        let peak = samples.iter().fold(0.0, |peak: f64, a| peak.max(a.abs()));
        samples.iter_mut().for_each(|a| *a *= 3.5 / peak);
        Motion { samples, dt: 0.01, station: "ABC", azimuth, down: false }
    }

    fn direction(&self, up: &str, down: &str) -> String {
        match self.azimuth {
            Some(azimuth) => format!("{azimuth:03}"),
            None if self.down => down.into(),
            None => up.into(),
        }
    }

    fn rows(&self, factor: f64, each: usize, write: impl Fn(f64) -> String) -> String {
        let row = |row: &[f64]| row.iter().map(|a| write(a * factor)).collect::<String>() + "\n";
        self.samples.chunks(each).map(row).collect()
    }

    pub fn at2(&self) -> Written {
        let text = format!(
            "PEER NGA STRONG MOTION DATABASE RECORD\nA Quake, 1/2/2003, {}, {}\n\
             ACCELERATION TIME SERIES IN UNITS OF G\nNPTS= {:6}, DT= {:7.5} SEC,\n{}",
            self.station,
            self.direction("UP", "DWN"),
            self.samples.len(),
            self.dt,
            self.rows(1.0 / GRAVITY, 5, |a| exponential(a, 15, 7)),
        );
        Written { format: "PEER AT2", text, within: 1.0e-6, needs: (false, false), tells: true }
    }

    /// Counts of 1/1000 gal; their mean is taken off by the reader.
    pub fn knet(&self) -> Written {
        let way = if self.azimuth.is_some() { "E-W" } else { "U-D" };
        let text = format!(
            "Origin Time       2001/02/03 04:05:06\nLat.              10.0\nLong.             20.0\n\
             Depth. (km)       30\nMag.              6.2\nStation Code      {}\nStation Lat.      10.1\n\
             Station Long.     20.1\nStation Height(m) 39\nRecord Time       2001/02/03 04:05:20\n\
             Sampling Freq(Hz) {}Hz\nDuration Time(s)  {}\nDir.              {way}\n\
             Scale Factor      1000(gal)/1000000\nMax. Acc. (gal)   350\nLast Correction   2001/02/03 04:05:06\n\
             Memo.             \n{}",
            self.station,
            (1.0 / self.dt).round(),
            self.samples.len() as f64 * self.dt,
            self.rows(1.0e5, 8, |a| format!("{a:9.0}")),
        );
        // Half a count from rounding, and as much at most from the mean of the counts.
        Written {
            format: "K-NET",
            text,
            within: 1.0e-5 + 1.0e-9,
            needs: (false, false),
            tells: true,
        }
    }

    pub fn esm(&self) -> Written {
        let mut head = vec!["EVENT_NAME: A QUAKE".to_string()];
        head.extend((0..56).map(|k| format!("KEY_{k}: ")));
        head.extend([
            format!("STATION_CODE: {}", self.station),
            "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS: 20010203_040510.000".into(),
            format!("SAMPLING_INTERVAL_S: {:.6}", self.dt),
            format!("NDATA: {}", self.samples.len()),
            format!("STREAM: {}", if self.azimuth.is_some() { "HNE" } else { "HNZ" }),
            "UNITS: cm/s^2".into(),
            "DATA_TYPE: ACCELERATION".into(),
        ]);
        let text = format!("{}\n{}", head.join("\n"), self.rows(100.0, 1, |a| format!("{a:.6}")));
        Written { format: "ESM", text, within: 1.0e-8, needs: (false, false), tells: true }
    }

    pub fn smc(&self) -> Written {
        let mut text = format!(
            "2 CORRECTED ACCELEROGRAM\n*\nXXX\n     2003  01  02    0304 A Quake\nMoment Mag=  6.0\n\
             station = {}    component= {}\nepicentral dist =\ninst type=\n*\n*\n*\n",
            self.station,
            self.direction("up", "down"),
        );
        let mut integers = [-32768; 48];
        let angle = if self.azimuth.is_some() { 90 } else { 180 * i32::from(self.down) };
        (integers[12], integers[15], integers[16]) = (angle, 1, self.samples.len() as i32);
        for line in integers.chunks(8) {
            text.extend(line.iter().map(|integer| format!("{integer:10}")));
            text.push('\n');
        }
        let mut reals = [1.7e38; 50];
        reals[1] = 1.0 / self.dt;
        for line in reals.chunks(5) {
            text.extend(line.iter().map(|real| exponential(*real, 15, 7)));
            text.push('\n');
        }
        text += "| a comment\n";
        text += &self.rows(100.0, 8, |a| {
            // Five digits, and one of the exponent.
            let plain = format!("{a:.4e}");
            let (digits, exponent) = plain.split_once('e').unwrap();
            let exponent: i32 = exponent.parse().unwrap();
            match exponent >= -9 {
                true => format!("{digits:>7}E{exponent:+}"),
                false => " 0.0000E+0".into(),
            }
        });
        Written { format: "SMC", text, within: 2.0e-4, needs: (false, false), tells: true }
    }

    /// Corrected: volume 2.
    pub fn csmip(&self) -> Written {
        let way = match self.azimuth {
            Some(azimuth) => format!("{azimuth:3} DEG"),
            None => self.direction("UP", "DOWN"),
        };
        let text = format!(
            "CORRECTED ACCELEROGRAM   00001-A0001-00001.01       CHAN  1: {way}     FROM\n\
             UNCORRECTED ACCELEROGRAM DATA\nA QUAKE\nJAN 6, 2020\n\nSTATION NO. {}  10.0N, 20.0W\n\
             {:6} POINTS OF ACCEL DATA EQUALLY SPACED AT  {:.3} SEC.  (UNITS: CM/SEC/SEC)\n{}\
             /&  ----------  END OF DATA FOR CHANNEL  1  ----------\n",
            self.station,
            self.samples.len(),
            self.dt,
            self.rows(100.0, 8, |a| format!("{a:10.3}")),
        );
        Written { format: "CSMIP", text, within: 6.0e-6, needs: (false, false), tells: true }
    }

    pub fn cosmos(&self) -> Written {
        let code = self.azimuth.map_or(if self.down { 401 } else { 400 }, |azimuth| azimuth as i32);
        let mut text = format!(
            "Corrected acceleration    (Format v01.20 with 13 text lines)\n\
             Record of A Quake of Mon Jan 06, 2020 10:00 UTC\nHypocenter: 1.0 2.0 H= 5km Mw=6.0\n\
             Origin: 2020/01/06 10:00:00 UTC\nStatn No: 00-0001 Code:XX-{}  Some Station\nCoords: 1.0 2.0\n\
             Recorder: x\nRcrd start time: 2020/01/06 10:00:05.000 UTC\nSta Chan   1: {} (Rcrdr Chan  1)\n\
             Raw record length\nProcessed:\nRecord filtered\nValues used when unknown: -999, -999.00\n\
             100 Integer-header values follow on  10 lines, Format= (10I8)\n",
            self.station,
            self.direction("Up", "Down"),
        );
        let mut integers = [-999; 100];
        integers[53] = code;
        for line in integers.chunks(10) {
            text.extend(line.iter().map(|integer| format!("{integer:8}")));
            text.push('\n');
        }
        text += " 100 Real-header values follow on  20 lines, Format= (5F15.6)\n";
        let mut reals = [-999.0; 100];
        reals[61] = 1000.0 * self.dt;
        for line in reals.chunks(5) {
            text.extend(line.iter().map(|real| format!("{real:15.6}")));
            text.push('\n');
        }
        text += &format!(
            "   1 Comment line(s) follow, each starting with a \"|\":\n| made\n{:8} acceleration pts, approx {:4.0} secs, \
             units=cm/sec2(04),Format=(8F10.4)\n{}End-of-data for Chan  1 acceleration\n",
            self.samples.len(),
            self.samples.len() as f64 * self.dt,
            self.rows(100.0, 8, |a| format!("{a:10.4}")),
        );
        Written { format: "COSMOS", text, within: 6.0e-7, needs: (false, false), tells: true }
    }

    /// GeoNet's corrected accelerogram, V2A, of one component.
    pub fn geonet(&self) -> Written {
        let mut lines = vec![
            "Corrected accelerogram 20160214_001343_ABC_20 GNS Science".to_string(),
            format!("Site {}      43 30 25S  172 43 53E", self.station),
            "A town".into(),
        ];
        lines.extend((3..12).map(|k| format!("Text {k}")));
        let way = self.azimuth.map_or(self.direction("Up", "Down"), |azimuth| match azimuth {
            0..=90 => format!("N{azimuth:02}E"),
            91..=180 => format!("S{:02}E", 180 - azimuth),
            181..=270 => format!("S{:02}W", azimuth - 180),
            _ => format!("N{:02}W", 360 - azimuth),
        });
        lines.push(format!("Component {way}"));
        lines.extend((13..16).map(|k| format!("Text {k}")));
        let mut whole = [0_i64; 40];
        for (place, value) in [(9, 2016), (10, 2), (19, 14), (20, 0), (39, 13), (40, 43_500)] {
            whole[place - 1] = value;
        }
        (whole[30], whole[33]) = (self.samples.len() as i64, self.samples.len() as i64);
        lines.extend(whole.chunks(10).map(|row| row.iter().map(|n| format!("{n:8}")).collect()));
        let mut others = [0.0; 60];
        (others[24], others[25]) = (self.dt, self.dt);
        lines.extend(others.chunks(10).map(|row| row.iter().map(|n| format!("{n:8.4}")).collect()));
        let text =
            format!("{}\n{}", lines.join("\n"), self.rows(1000.0, 10, |a| format!("{a:8.1}")));
        Written { format: "GeoNet", text, within: 5.1e-5, needs: (false, false), tells: true }
    }

    /// A time and three components, the others zero but for a sample.
    pub fn broadband(&self) -> Written {
        let column = if self.azimuth.is_some() { 0 } else { 2 };
        let row = |(k, a): (usize, &f64)| {
            let mut values = [0.001; 3];
            values[column] = 100.0 * a;
            let values: String = values.iter().map(|a| format!("{a:16.7e}")).collect();
            format!("{:16.7e}{values}\n", k as f64 * self.dt)
        };
        let rows: String = self.samples.iter().enumerate().map(row).collect();
        let names = "#    time(sec)      N-S(cm/s/s)      E-W(cm/s/s)      U-D(cm/s/s)\n";
        let text = format!("# Sim stats: NGA\n#\n{names}{rows}");
        Written {
            format: "Broadband Platform",
            text,
            within: 1.0e-7,
            needs: (false, false),
            tells: false,
        }
    }

    /// AFAD's older format: three components in a row, the others of 1 gal.
    pub fn afad(&self) -> Written {
        let column = if self.azimuth.is_some() { 1 } else { 2 };
        let row = |a: &f64| {
            let mut values = [1.0; 3];
            values[column] = 100.0 * a;
            values.iter().map(|a| format!("{a:14.7}")).collect::<String>() + "\n"
        };
        let mut head: Vec<String> = (0..18).map(|k| format!("KEY {k} :")).collect();
        head[0] = "STRONG GROUND MOTION RECORDS OF TURKIYE".into();
        for (line, text) in [
            (1, "PLACE : A town".to_string()),
            (6, format!("STATION ID : {}", self.station)),
            (11, "RECORD TIME : 03/02/2001 04:05:10.000000 (GMT)".into()),
            (12, format!("NUMBER OF DATA : {}", self.samples.len())),
            (13, format!("SAMPLING INTERVAL(sec) : {}", self.dt)),
            (17, "     N-S           E-W           U-D".into()),
        ] {
            head[line] = text;
        }
        let rows: String = self.samples.iter().map(row).collect();
        let text = format!("{}\n{rows}", head.join("\n"));
        Written { format: "AFAD", text, within: 1.0e-8, needs: (false, false), tells: false }
    }

    /// SAC: 158 words, and samples of 32 bits, in m/s^2, which the file does not tell.
    pub fn sac(&self, little: bool) -> Vec<u8> {
        let mut words = vec![(-12345.0_f32).to_le_bytes(); 70];
        words.extend([(-12345_i32).to_le_bytes(); 40]);
        words[0] = (self.dt as f32).to_le_bytes();
        words[5] = 0.25_f32.to_le_bytes();
        let down = if self.down { 180.0_f32 } else { 0.0 };
        words[58] = self.azimuth.map_or(down, |_| 90.0).to_le_bytes();
        let whole = [
            (70, 2003),
            (71, 33),
            (72, 4),
            (73, 5),
            (74, 6),
            (75, 500),
            (76, 6),
            (79, self.samples.len() as i32),
            (85, 1),
            (86, 8),
            (105, 1),
        ];
        for (word, value) in whole {
            words[word] = i32::to_le_bytes(value);
        }
        let mut text = [b' '; 192];
        for (place, part) in [(0, self.station), (8, "A Quake"), (160, "HN")] {
            text[place..place + part.len()].copy_from_slice(part.as_bytes());
        }
        let samples = self.samples.iter().map(|a| (*a as f32).to_le_bytes());
        let order = |mut word: [u8; 4]| {
            if !little {
                word.reverse();
            }
            word
        };
        let head = words.into_iter().flat_map(order).chain(text);
        head.chain(samples.flat_map(order)).collect()
    }

    /// One column, with neither step nor units.
    pub fn column(&self) -> Written {
        let text = self.rows(1.0, 1, |a| format!("{a:.8}"));
        Written { format: "columns", text, within: 1.0e-8, needs: (true, true), tells: false }
    }

    /// Time and value, with units, as a spreadsheet of half the world saves it.
    pub fn two_columns(&self) -> Written {
        let row =
            |(k, a): (usize, &f64)| format!("{:.4};{a:.8}\n", k as f64 * self.dt).replace('.', ",");
        let rows: String = self.samples.iter().enumerate().map(row).collect();
        let text = format!("Time (s);Acc (m/s²)\n{rows}");
        Written { format: "columns", text, within: 1.0e-8, needs: (false, false), tells: false }
    }

    /// The count and the step, then several values in a row.
    pub fn counted(&self) -> Written {
        let count = format!("{} {:.4}\n", self.samples.len(), self.dt);
        let text = count + &self.rows(1.0 / GRAVITY, 6, |a| format!("{a:13.9}"));
        Written { format: "columns", text, within: 1.0e-8, needs: (false, true), tells: false }
    }

    /// The file in each format.
    pub fn files(&self) -> Vec<Written> {
        let mut files = vec![
            self.at2(),
            self.smc(),
            self.csmip(),
            self.cosmos(),
            self.geonet(),
            self.column(),
            self.two_columns(),
            self.counted(),
        ];
        // Verticals of these are positive up.
        if !self.down {
            files.extend([self.knet(), self.esm()]);
        }
        files
    }
}

/// A number as FORTRAN's E format has it.
fn exponential(value: f64, width: usize, digits: usize) -> String {
    let plain = format!("{value:.digits$e}");
    let (digits, exponent) = plain.split_once('e').unwrap();
    let exponent: i32 = exponent.parse().unwrap();
    let sign = if exponent < 0 { '-' } else { '+' };
    format!("{:>width$}", format!("{digits}E{sign}{:02}", exponent.abs()))
}
