//! A small record in each format that has a heading.

pub const AT2: &str = "PEER NGA STRONG MOTION DATABASE RECORD\nA STATION, 90\n\
    ACCELERATION TIME SERIES IN UNITS OF G\nNPTS=      7, DT=   .0100 SEC,   0 POLE @ 30. HZ\n  \
    .1000000E+00  -.2000000E+00   .3000000E-01-.4000000E-01-.5000000E-01\n   .6000000E-01   .7E-1\n";

pub const KNET: &str = "Origin Time       2018/01/24 19:51:00\nLat.              41.0\n\
    Long.             142.5\nDepth. (km)       30\nMag.              6.2\n\
    Station Code      AOM001\nStation Lat.      41.5267\nStation Long.     140.9244\n\
    Station Height(m) 39\nRecord Time       2018/01/24 19:51:43\nSampling Freq(Hz) 100Hz\n\
    Duration Time(s)  1\nDir.              E-W\nScale Factor      3920(gal)/6182761\n\
    Max. Acc. (gal)   4.078\nLast Correction   2018/01/24 19:51:43\nMemo.             \n  \
    -12085    3000   -12070   -12060\n   9000   -12083\n";

pub fn esm() -> String {
    let mut lines: Vec<String> = vec!["EVENT_NAME: A QUAKE".into()];
    lines.extend((0..57).map(|k| format!("KEY_{k}: ")));
    lines.extend(
        [
            "STATION_CODE: ARS1",
            "SAMPLING_INTERVAL_S: 0.005000",
            "NDATA: 3",
            "STREAM: HNE",
            "UNITS: cm/s^2",
            "DATA_TYPE: ACCELERATION",
        ]
        .map(String::from),
    );
    assert_eq!(lines.len(), 64);
    format!("{}\n10.0\n-25.0\n0.3\n", lines.join("\n"))
}

pub fn smc() -> String {
    let mut text =
        String::from("2 CORRECTED ACCELEROGRAM\n*\nSAF0A\nA QUAKE\nMag\nstation\na\nb\n*\n*\n*\n");
    let mut integers = [-32768; 48];
    (integers[15], integers[16]) = (2, 5);
    for line in integers.chunks(8) {
        text.extend(line.iter().map(|i| format!("{i:10}")));
        text.push('\n');
    }
    let mut reals = [1.7e38; 50];
    reals[1] = 200.0;
    for line in reals.chunks(5) {
        text.extend(line.iter().map(|r| format!("{r:15.7E}")));
        text.push('\n');
    }
    text + "|\n| a comment 1.0\n 1.5057E+0-2.2223E+0-1.9234E+1-3.1562E+0\n-3.2440E+0\n"
}

pub const CSMIP: &str = "CORRECTED ACCELEROGRAM   36456  CHAN  1:  90 DEG\nUNCORRECTED\nA QUAKE\n\
    3 POINTS OF ACCEL DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM/SEC/SEC)\n    \
    -3.038   -99.787     2.288\n 3 POINTS OF VELOC DATA\n     1.0\n/&\nCORRECTED ACCELEROGRAM   36456  CHAN  2:  UP\nUNCORRECTED\nA QUAKE\n\
    3 POINTS OF ACCEL DATA EQUALLY SPACED AT  .020 SEC.\n";

pub fn cosmos() -> String {
    let mut text = String::from(
        "Corrected acceleration    (Format v01.20 with 13 text lines)\nRecord of A Quake\n\
         100 Real-header values follow on  20 lines, Format= (5F15.6)\n",
    );
    let mut reals = [-999.0; 100];
    reals[62] = 5.0;
    for line in reals.chunks(5) {
        text.extend(line.iter().map(|r| format!("{r:15.6}")));
        text.push('\n');
    }
    text + "1 Comment line(s) follow\n| 3 words\n       4 acceleration pts, approx  0.02 secs, \
            units=cm/sec2(04),Format=(2E12.4)\n  1.0000e+01-2.0000e+01\n -3.0000e+01 4.0000e+00\n"
}
