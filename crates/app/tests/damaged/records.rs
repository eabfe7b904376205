//! Records of every format, plain and packed, each alone and beside another component.

use std::io::{Cursor, Write};
use std::path::Path;

use flate2::Compression;
use flate2::write::GzEncoder;
use topple::scene::record::{Record, Units, joined};
use topple::scene::record::{RecordHints, read};
use topple::scene::{Excitation, Parameter, SceneBuilder};
use topple::sweep::settings::Method;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

#[path = "../../../records/tests/common/formats.rs"]
mod formats;

pub use formats::AT2;

use crate::motions::Motion;

/// The files of a zip by their names.
pub fn zipped(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in files {
        archive.start_file(*name, SimpleFileOptions::default()).unwrap();
        archive.write_all(bytes).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

pub fn files() -> Vec<Vec<u8>> {
    let mut packed = GzEncoder::new(Vec::new(), Compression::fast());
    packed.write_all(AT2.as_bytes()).unwrap();
    let wide = format!("\u{feff}{AT2}").encode_utf16().flat_map(u16::to_le_bytes).collect();
    let columns: String = (0..40).map(|k| format!("{} {}\n", 0.01 * f64::from(k), k % 7)).collect();
    let texts = [
        AT2.to_string(),
        formats::KNET.into(),
        formats::CSMIP.into(),
        formats::esm(),
        formats::smc(),
        formats::cosmos(),
        columns,
        "Time (s);Acc (cm/s^2)\n0;150\n0,01;-250\n0,02;300\n".into(),
    ];
    // As publishers write them, of several channels too.
    let short = Motion::made(40, Some(90));
    let mut written: Vec<String> = short.files().into_iter().map(|file| file.text).collect();
    let up = Motion { azimuth: None, ..short.clone() };
    written.extend([short.broadband().text, short.afad().text]);
    written.push(short.csmip().text + &up.csmip().text);
    written.push(short.geonet().text + &up.geonet().text);
    let plain = texts.into_iter().chain(written).map(String::into_bytes);
    let zip = zipped(&[("dir/a.at2", AT2.as_bytes())]);
    let sac = [short.sac(true), up.sac(false)];
    plain.chain([packed.finish().unwrap(), zip, wide]).chain(sac).collect()
}

/// A record that was read is one.
fn sane(record: &Record) {
    assert!(record.dt > 0.0 && record.dt <= 1.0, "{}", record.dt);
    assert!(record.samples.len() >= 2 && record.samples.iter().all(|a| a.is_finite()));
}

/// What is said of a file that does not tell its step and its units; every format but plain columns tells them.
fn hints() -> [RecordHints; 3] {
    let units = Some(Units::MetresPerSecondSquared);
    [
        RecordHints::default(),
        RecordHints { dt: Some(0.01), units, scaled: true, ..RecordHints::default() },
        RecordHints { dt: None, units, scaled: false, ..RecordHints::default() },
    ]
}

/// The first that reads it, or why the last one does not.
fn any(bytes: &[u8]) -> Result<Record, String> {
    let mut last = String::new();
    for hints in hints() {
        match read::bytes(bytes, &hints) {
            Ok(record) => return Ok(record),
            Err(error) => last = error.to_string(),
        }
    }
    Err(last)
}

pub fn read(bytes: &[u8]) -> Result<(), String> {
    any(bytes).map(|record| sane(&record))
}

/// The damaged record and a whole one of 40 s as components of one motion, in either order, up to the plan of a scene.
pub fn pair(bytes: &[u8]) -> Result<(), String> {
    any(bytes)?;
    let long: String = (0..4000).map(|k| format!("{}\n", 0.1 * f64::from(k % 11))).collect();
    let found = hints()
        .into_iter()
        .find_map(|hints| read::of_bytes(Path::new("damaged"), bytes, &hints).ok());
    let given = RecordHints {
        dt: Some(0.01),
        units: Some(Units::G),
        scaled: true,
        ..RecordHints::default()
    };
    let other = read::of_bytes(Path::new("long"), long.as_bytes(), &given).unwrap();
    let damaged = found.unwrap();
    for (h, v) in [(&damaged, &other), (&other, &damaged)] {
        let pair = joined::join(h.clone(), Some(v.clone()), &given, true);
        let pair = pair.map_err(|error| error.to_string())?;
        assert!(pair.horizontal.len() == pair.vertical.len() && pair.duration() >= 39.98);
        let scene = SceneBuilder::object(1)
            .with(Parameter::TH, 2.0)
            .with(Parameter::TV, 0.5)
            .with(Parameter::Pga, 3.0);
        let scene = scene.check_under_motion(pair).map_err(|error| error.to_string())?;
        assert!(matches!(scene.excitation, Excitation::Record(_)));
        Method::default().plan(&scene).map_err(|error| error.to_string())?;
    }
    Ok(())
}
