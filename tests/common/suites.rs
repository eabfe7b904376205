//! Suites of records as users have them.

/// A file of PEER's form.
pub fn at2(title: &str, dt: f64, samples: &[f64]) -> String {
    let values: Vec<String> = samples.iter().map(|a| format!("{a:.7E}")).collect();
    format!(
        "PEER NGA STRONG MOTION DATABASE RECORD\n{title}\nACCELERATION TIME SERIES IN UNITS OF G\n\
         NPTS=  {}, DT= {dt} SEC,\n{}\n",
        samples.len(),
        values.join("  ")
    )
}

pub const RISING: [f64; 6] = [0.0, 0.1, 0.3, -0.2, 0.1, 0.0];

pub const OTHER: [f64; 4] = [0.0, 0.1, -0.2, 0.0];

pub const SECOND: [f64; 4] = [0.0, -0.15, 0.2, 0.0];

/// What users have, by its place: a whole triple, a vertical that is positive down, one too few, one too many,
/// K-NET's and ESM's names, and files that are none.
pub fn downloaded() -> Vec<(&'static str, String)> {
    let title = |component: &str| format!("A Quake, 1/2/1990, A Town, {component}");
    vec![
        ("RSN1_QUAKE_TWN000.AT2", at2(&title("0"), 0.01, &RISING)),
        ("RSN1_QUAKE_TWN090.AT2", at2(&title("90"), 0.01, &SECOND)),
        ("RSN1_QUAKE_TWN-UP.AT2", at2(&title("UP"), 0.005, &OTHER)),
        ("sub/RSN2_QUAKE_CTY010.AT2", at2(&title("10"), 0.01, &RISING)),
        ("sub/RSN2_QUAKE_CTYDWN.AT2", at2(&title("DWN"), 0.01, &OTHER)),
        ("RSN3_QUAKE_VIL000.AT2", at2(&title("0"), 0.01, &RISING)),
        ("RSN4_QUAKE_HAM000.AT2", at2(&title("0"), 0.01, &RISING)),
        ("RSN4_QUAKE_HAM-UP.AT2", at2(&title("UP"), 0.01, &OTHER)),
        ("RSN4_QUAKE_HAMDWN.AT2", at2(&title("DWN"), 0.01, &OTHER)),
        ("RSN5_QUAKE_FAR-UP.AT2", at2(&title("UP"), 0.01, &OTHER)),
        ("RSN6_QUAKE_BAD000.AT2", "no record".into()),
        ("RSN6_QUAKE_BAD-UP.AT2", at2(&title("UP"), 0.01, &OTHER)),
        ("notes.txt", "mine".into()),
    ]
}

/// Samples of a motion of six seconds, of a peak about as large.
pub fn samples(peak: f64, omega: f64) -> Vec<f64> {
    let sample = |k: u32| {
        let t = 0.02 * f64::from(k);
        let envelope = (t / 1.5) * (1.0 - t / 1.5).exp();
        peak * envelope * ((omega * t).sin() + 0.4 * (2.3 * omega * t).cos())
    };
    (0..300).map(sample).collect()
}
