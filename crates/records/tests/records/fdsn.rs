//! The texts of FDSN services.

use topple_records::stated::seconds;
use topple_records::{Component, RecordHints, read};

const SLIST: &str = "TIMESERIES XX_ST1__HNE_D, 4 samples, 100 sps, 2003-01-02T03:04:05.000000, SLIST, FLOAT, M/S**2\n\
                     1.0\t-2.0\t3.0\n-1.0\n";
const TSPAIR: &str = "TIMESERIES XX_ST1__HNE_D, 4 samples, 100 sps, 2003-01-02T03:04:05.000000, TSPAIR, FLOAT, M/S**2\n\
                      2003-01-02T03:04:05.000000  1.0\n2003-01-02T03:04:05.010000  -2.0\n\
                      2003-01-02T03:04:05.020000  3.0\n2003-01-02T03:04:05.030000  -1.0\n";
const GEOCSV: &str = "# dataset: GeoCSV 2.0\n# delimiter: ,\n# SID: XX_ST1__H_N_E\n# sample_count: 4\n\
                      # sample_rate_hz: 100\n# start_time: 2003-01-02T03:04:05.000000Z\n# field_unit: UTC, m/s**2\n\
                      # field_type: datetime, FLOAT\nTime, Sample\n2003-01-02T03:04:05.000000Z,1.0\n\
                      2003-01-02T03:04:05.010000Z,-2.0\n2003-01-02T03:04:05.020000Z,3.0\n\
                      2003-01-02T03:04:05.030000Z,-1.0\n";

#[test]
fn the_three_texts_of_a_service_are_one_record() {
    let of = |text: &str| read::bytes(text.as_bytes(), &RecordHints::default()).unwrap();
    let one = of(SLIST);
    assert_eq!((one.dt, &one.samples[..]), (0.01, &[1.0, -2.0, 3.0, -1.0][..]));
    assert_eq!(one.stated.component, Some(Component::Horizontal));
    assert_eq!((one.stated.station.as_str(), one.stated.azimuth), ("XX.ST1", Some(90.0)));
    assert_eq!(one.stated.start, seconds("2003/01/02 03:04:05"));
    for text in [TSPAIR, GEOCSV] {
        let other = of(text);
        assert_eq!((other.dt, &other.samples, &other.stated), (one.dt, &one.samples, &one.stated));
    }
}

#[test]
fn a_series_that_is_cut_uneven_or_of_other_units_is_refused() {
    let of =
        |text: &str| read::bytes(text.as_bytes(), &RecordHints::default()).unwrap_err().to_string();
    for (text, said) in [
        (SLIST.replace("-1.0\n", ""), "states 4 samples, and 3 follow"),
        (SLIST.replace("M/S**2", "Counts"), "line 1: units of 'Counts' are not read"),
        (SLIST.replace("SLIST", "BINARY"), "'BINARY' is not read; give TSPAIR or SLIST"),
        (format!("{SLIST}{SLIST}"), "line 4: a second series begins here"),
        (TSPAIR.replace("100 sps", "50 sps"), "not apart by the rate of its header"),
        (TSPAIR.replace("05.030000  -1", "05.050000  -1"), "are missing"),
        (GEOCSV.replace("m/s**2", "m/s"), "line 7: units of 'm/s' are not read"),
    ] {
        let problem = of(&text);
        assert!(problem.contains(said), "{problem}");
    }
}
