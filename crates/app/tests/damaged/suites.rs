//! Suites: a list beside whole records, and a zip.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use tempfile::TempDir;
use topple::SceneBuilder;
use topple_studies::comparison::devices;
use topple_studies::suites::Suite;

use crate::records::{AT2, zipped};

const OWN: &str = "id,event,station,horizontal,vertical,dt,units,scale,weight\n\
    one,A quake,Here,RSN1_A_090.AT2,RSN1_A_UP.AT2,,,1.5,2\ntwo,,,RSN2_B_090.AT2,,0.01,g,,\n";
const PEERS: &str = "A line of words\n\nResult ID, Record Sequence Number, Earthquake Name, Year, Station Name, \
    Scale Factor, Horizontal-1 Acc. Filename, Horizontal-2 Acc. Filename, Vertical Acc. Filename\n\
    1, 1, \"A, quake\" , 1994, \"Here\", 1.2, RSN1_A_090.AT2, RSN2_B_090.AT2, RSN1_A_UP.AT2\n\nOther\n";

/// The records of all suites.
fn records() -> [(&'static str, String); 4] {
    let of = |component: &str, first: &str| {
        AT2.replace("A STATION, 90", &format!("A QUAKE, HERE, {component}"))
            .replace(".1000000E+00", first)
    };
    [
        ("RSN1_A_090.AT2", of("90", ".1")),
        ("RSN1_A_UP.AT2", of("UP", ".12")),
        ("RSN2_B_090.AT2", of("90", ".13")),
        ("RSN2_B_UP.AT2", of("UP", ".14")),
    ]
}

pub fn lists() -> Vec<Vec<u8>> {
    [OWN, PEERS].map(|text| text.as_bytes().to_vec()).to_vec()
}

/// A suite that was read has motions, and of the others it says why not, in a line each.
fn sane(path: &Path) -> Result<(), String> {
    for strict in [true, false] {
        match Suite::read(path, strict) {
            Err(error) if strict => drop(error),
            Err(error) => {
                // The folder has another name each time.
                let place = path.display().to_string();
                return Err(error.to_string().replace(&place, "SUITE"));
            }
            Ok(suite) => {
                for (entry, motion) in suite.motions() {
                    motion.pair.check().unwrap();
                    assert!(motion.measures.arias.is_finite() && entry.weight > 0.0);
                }
                for (_, why) in suite.left_out() {
                    assert!(!why.is_empty() && !why.contains('\n') && why.len() < 2000, "{why:?}");
                }
            }
        }
    }
    Ok(())
}

/// The bytes as the list of a folder, and as a list by itself.
pub fn list(bytes: &[u8]) -> Result<(), String> {
    let folder = TempDir::new().unwrap();
    for (name, text) in records() {
        fs::write(folder.path().join(name), text).unwrap();
    }
    let list = folder.path().join("list.csv");
    fs::write(&list, bytes).unwrap();
    sane(&list)?;
    sane(folder.path())
}

pub fn zips() -> Vec<Vec<u8>> {
    let records = records();
    let mut files: Vec<(&str, &[u8])> =
        records.iter().map(|(name, text)| (*name, text.as_bytes())).collect();
    let bare = zipped(&files);
    files.push(("list.csv", OWN.as_bytes()));
    vec![bare, zipped(&files)]
}

pub fn zip(bytes: &[u8]) -> Result<(), String> {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("suite.zip");
    fs::write(&path, bytes).unwrap();
    sane(&path)
}

const DEVICES: &str = "device,isolation,t_h,psi,xi-h,u_y,object\n\"soft, old\",dual,2.5,0.1,,0.01,1\n\
    floor,none,,,,,2\nrope,horizontal,1.2,0.4,0.15,0.02,\n";

pub fn devices() -> Vec<Vec<u8>> {
    let spread = DEVICES.replace("\"soft, old\"", "soft").replace(',', ";").replace('.', ",");
    vec![DEVICES.as_bytes().to_vec(), format!("sep=;\r\n{spread}").into_bytes()]
}

/// A list that was read has devices of names of their own.
pub fn device_list(bytes: &[u8]) -> Result<(), String> {
    let text = String::from_utf8_lossy(bytes);
    let devices =
        devices::read(&text, &SceneBuilder::object(1)).map_err(|error| error.to_string())?;
    let names: BTreeSet<&str> = devices.iter().map(|device| device.name.as_str()).collect();
    assert!(!devices.is_empty() && names.len() == devices.len() && !names.contains(""));
    Ok(())
}
