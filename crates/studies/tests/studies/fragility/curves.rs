use topple::Units;
use topple_studies::Intensity;
use topple_studies::fragility::hazard_heading::*;
use topple_studies::fragility::hazard_text::{HazardText, of_bytes, read};
use topple_studies::fragility::{HazardCurve, Lognormal};

use crate::told::told;

/// What the heading of a curve says.
fn heading([level, rate]: [&str; 2], measure: Intensity) -> String {
    let of = |asked| {
        judged(1, [level, rate], measure, asked).map_err(|error| format!("refused: {error}"))
    };
    let said = match of(None) {
        Ok(Heading { unit, rates }) => {
            format!("{rates:?} in {}", unit.map_or("no unit", |(name, _)| name))
        }
        Err(why) => why,
    };
    // With the unit given, a name of no list is not judged, and no period is missed.
    match (of(None).is_ok(), of(Some(Units::G)).is_ok()) {
        (false, true) => said + "; read where g is given",
        (true, false) => said + "; refused where g is given",
        _ => said,
    }
}

/// What is read of a curve: its ends in SI units, and what is said of it.
fn described(HazardText { curve, unit, assumed, source }: HazardText) -> String {
    let [from, to] = curve.ends();
    let assumed = if assumed { ", which is assumed" } else { "" };
    format!("{from:.9} to {to:.9}, in {unit}{assumed}; {source}")
}

#[test]
fn curves_are_read_or_refused() {
    told("curves", |section, case| {
        if section == "rates" {
            return Some(heading(["PGA [g]", case], Intensity::Pga));
        }
        let (what, measure) = section.split_once(" of ").unwrap();
        let (measure, more) = measure.split_once([' ', ',']).unwrap_or((measure, ""));
        let measure: Intensity = measure.parse().unwrap();
        if what == "levels" {
            return Some(heading(
                <[&str; 2]>::from(case.split_once('|').unwrap_or((case, "rate"))),
                measure,
            ));
        }
        let asked = match more {
            "in g" => Some(Units::G),
            "in m/s2" => Some(Units::MetresPerSecondSquared),
            _ => None,
        };
        Some(read(case, measure, asked).map_or_else(|why| format!("refused: {why}"), described))
    });
}

/// Other files are named, and texts of Windows are read.
#[test]
fn bytes_are_read_as_texts_are() {
    let of = |bytes: &[u8]| of_bytes(bytes, Intensity::Pga, None);
    assert!(of(b"\n<nrml/>").unwrap_err().to_string().starts_with("XML"));
    assert!(of(b"%PDF-1.7").unwrap_err().to_string().starts_with("a PDF"));
    let latin = b"PGA [cm/s\xb2],rate\n10,0.01\n20,0.001\n";
    let wide = "\u{feff}PGA [gal],rate\n10,0.01\n20,0.001\n".encode_utf16();
    let wide: Vec<u8> = wide.flat_map(u16::to_le_bytes).collect();
    for text in [&latin[..], &wide] {
        assert!(described(of(text).unwrap()).starts_with("0.100000000 to 0.200000000, in cm/s2;"));
    }
}

#[test]
fn probabilities_and_return_periods_are_rates() {
    let curve = |text: &str, measure| -> HazardCurve { read(text, measure, None).unwrap().curve };
    let rate = |curve: HazardCurve, theta, beta| curve.rate(Lognormal { theta, beta }).rate;
    // A step below the first level takes the difference of the ends' rates, -ln(1 - p)/50.
    let site = "#,\"generated_by='OpenQuake engine 3.15.0', kind='mean', investigation_time=50.0, imt='PGA'\"\n\
                lon,lat,depth,poe-0.1,poe-0.4,poe-0.6\n0.0,0.0,-0.1,6.081918E-01,3.287217E-01,1.994702E-01\n";
    let found = rate(curve(site, Intensity::Pga), 1.0e-3, 0.0);
    let wanted = ((1.0 - 0.1994702_f64) / (1.0 - 0.6081918)).ln() / 50.0;
    assert!((found / wanted - 1.0).abs() < 1.0e-9, "{found} {wanted}");
    let rates = "pga (g),rate\n0.1,0.00210526315789\n0.2,0.00040404040404\n";
    let periods = "pga (g);Return period [years]\r0,1;475\r0,2;2475\r";
    let gal = "PGA [Gal]\trate\n98.1\t0.00210526315789\n196.2\t0.00040404040404\n";
    for text in [periods, gal] {
        let [one, other] = [text, rates].map(|text| rate(curve(text, Intensity::Pga), 1.3, 0.3));
        assert!((one / other - 1.0).abs() < 1.0e-9, "{one} {other}");
    }
}

/// The page names every word that is read.
#[test]
fn the_page_has_the_lists() {
    let page = include_str!("../../../../../docs/fragility.md");
    let units = [&ACCELERATIONS[..], &VELOCITIES, &RATIOS].concat();
    let units = units.iter().flat_map(|(_, name, _)| name.split('|'));
    let names = MEASURES.iter().flat_map(|(_, names)| names.split('|'));
    let lists = [ANY, ACCELERATION_NAMES, RATES, PER_YEAR, PERIODS, YEARS, COMPONENTS, "gal|-|5%"];
    for word in units.chain(names).chain(lists.iter().flat_map(|list| list.split('|'))) {
        assert!(page.contains(&format!("`{word}`")), "{word}");
    }
}
