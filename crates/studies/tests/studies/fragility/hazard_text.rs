use topple::Units;
use topple::scene::GRAVITY;
use topple_studies::Intensity;
use topple_studies::fragility::Lognormal;
use topple_studies::fragility::hazard_text::{of_bytes, read};

fn error(text: &str) -> String {
    read(text, Intensity::Pga, None).unwrap_err().to_string()
}

/// The levels of a curve's ends.
fn ends(text: &str, measure: Intensity, asked: Option<Units>) -> ([f64; 2], &'static str, bool) {
    let read = read(text, measure, asked).unwrap();
    (read.curve.ends(), read.unit, read.assumed)
}

fn near(found: [f64; 2], wanted: [f64; 2]) -> bool {
    found.iter().zip(wanted).all(|(found, wanted)| (found / wanted - 1.0).abs() < 1.0e-12)
}

#[test]
fn a_bad_table_is_refused_by_its_place() {
    let head = "level,rate\n0.1,0.01\n";
    for (rows, wanted) in [
        ("0.2\n", "line 3: 1 fields where the heading has 2"),
        ("\n0.2,a\n", "line 4, column rate: 'a' is no number such as"),
        ("-1,0.001\n", "line 3, column level: `-1` is no number above zero"),
        ("0.2,0\n", "line 3, column rate: `0`"),
        ("0.2,inf\n", "line 3, column rate: `inf`"),
        ("0.2,\n", "line 3, column rate: `` is no number above zero"),
        ("0.2,0.001,3\n", "line 3: '3' stands in a column without a name"),
        ("0.2,\"0.001\n1,1\n", "line 3: a cell begins with a quote"),
        ("\"1,200\",0.001\n", "line 3, column level: '1,200' may be 1200 or 1.2; write"),
        ("0.1,0.001\n", "line 3: the level"),
        ("0.2,0.02\n", "line 3: the rate"),
    ] {
        let said = error(&format!("{head}{rows}"));
        assert!(said.starts_with(wanted) && !said.contains('\n'), "{rows}: {said}");
    }
    assert!(error("1,x\n2,0.1\n").starts_with("line 1, column rate: 'x' is no number"));
    assert_eq!(error(head), "the curve has 1 points; give two at least");
    assert_eq!(error(""), "the curve has 0 points; give two at least");
    assert_eq!(error("# of a site\n"), "the curve has 0 points; give two at least");
    let separated = error("PGA [g];rate\n200.000;0,01\n");
    assert!(
        separated.starts_with("line 2, column PGA [g]: '200.000' may be 200000 or 200"),
        "{separated}"
    );
}

#[test]
fn tables_of_any_program_are_read() {
    let wanted = ([0.1 * GRAVITY, 0.2 * GRAVITY], "g", false);
    for text in [
        "PGA [g],rate\n0.1,0.01\n0.2,0.001\n",
        "PGA (g);annual rate of exceedance\n0,1;0,01\n0,2;0,001\n",
        "\u{feff}sep=;\r\nPGA [g];rate\r\n0,1;0,01\r\n0,2;0,001\r\n",
        "sep=,\nPGA [g],rate\n0.1,0.01\n0.2,0.001\n",
        "PGA [g]\trate\n0.1\t0.01\n0.2\t0.001\n",
        "PGA [g],rate,,\n0.1,0.01,,\n,,,\n0.2,0.001,,\n,,,\n",
        "\"PGA [g]\",\"rate\"\n\"0.1\",\"0.01\"\n\"0.2\",\"0.001\"\n",
        "\"PGA [g],rate\"\n\"0.1,0.01\"\n\"0.2,0.001\"\n",
        "# PGA [g],rate\n0.1,0.01\n0.2,0.001\n",
        "# PGA [g], rate\n1.0e-01 1.0e-02\n2.0e-01 1.0e-03\n",
        "# a title\n\npga_g afe\n  0.1   0.01\n# between\n  0.2   0.001\n",
        "PGA [g]   annual rate of exceedance\n0.1 0.01\n0.2 0.001\n",
        "PGA [g];rate\n0.100;0.010\n0.200;0.001\n",
    ] {
        let (levels, unit, assumed) = ends(text, Intensity::Pga, None);
        assert!(near(levels, wanted.0), "{text:?}: {levels:?}");
        assert_eq!((unit, assumed), (wanted.1, wanted.2), "{text:?}");
    }
    // Without a heading, by blanks and by semicolons.
    for text in [" 1.0E-01   1.0E-02\n 2.0E-01   1.0E-03\n", "0,1;0,01\n0,2;0,001\n"] {
        let read = |units| read(text, Intensity::Pga, units).unwrap();
        assert!(near(read(Some(Units::G)).curve.ends(), wanted.0), "{text}");
        let bare = read(None);
        assert!(bare.assumed && near(bare.curve.ends(), [0.1, 0.2]), "{text}");
        assert_eq!(bare.source, "without a heading: levels of pga and annual rates are taken");
    }
    let said = read("PGA [g],AFE\n0.1,0.01\n0.2,0.001\n", Intensity::Pga, None).unwrap();
    assert_eq!(said.source, "annual rates `AFE` of `PGA [g]`");
    // What numpy writes above the numbers is judged as a heading is.
    let of_numpy = "# PGA [g], PoE50\n1.0e-01 1.0e-02\n2.0e-01 1.0e-03\n";
    let said = error(of_numpy);
    assert!(said.starts_with("line 1, column PoE50: says no annual rate"), "{said}");
    let rows = "0.1 0.01\n0.2 0.001\n";
    for (comment, wanted) in [
        ("# PGA PoE50", Err("line 1, column PoE50: says no annual rate")),
        ("# SA(0.2) rate", Err("line 1, column SA(0.2): these are no levels of pga")),
        ("# PoE in 50 years", Err("line 1: the comment says that these are no annual rates")),
        ("# 10 % in 50 years\n# Rome", Err("line 1: the comment says")),
        ("# PGA [g] annual rate", Ok("g")),
        ("# PSA(T=0.2s)", Err("line 1: the comment says that these are no levels of pga")),
        ("# Rome, 2020", Ok("m/s²")),
        ("# my site", Ok("m/s²")),
    ] {
        let text = format!("{comment}\n{rows}");
        match (read(&text, Intensity::Pga, None), wanted) {
            (Ok(read), Ok(unit)) => assert_eq!(read.unit, unit, "{comment}"),
            (Err(said), Err(wanted)) => {
                assert!(said.to_string().starts_with(wanted), "{comment}: {said}");
            }
            (found, _) => panic!("{comment}: {found:?}"),
        }
    }
}

/// What a comment above a heading names is compared where it is a name of levels and nothing else.
#[test]
fn comments_above_a_heading_name_the_same_levels() {
    let no = "line 2: the comment says that these are no levels of";
    for (comment, measure, is_refused) in [
        ("PSA(T=0.2s)", "sa:1", true),
        ("SA(0.2) [g]", "sa:1", true),
        ("PGA", "sa:1", true),
        ("PGV [cm/s]", "pga", true),
        ("SA(0.2), rate", "sa:1", true),
        ("SA(1.0)", "sa:1", false),
        ("SA [g]", "sa:1", false),
        ("PSA(T=1.0s, 5% damping) [g]", "sa:1", false),
        ("PGA [g]", "pga", false),
        ("intensity", "pga", false),
        ("PGA of Rome", "pgv", false),
        ("PGV was measured, PGA was not", "pga", false),
    ] {
        let text = format!("# Rome\n# {comment}\nlevel,rate\n0.1,0.01\n0.2,0.001\n");
        let said = read(&text, measure.parse().unwrap(), None).map(|read| read.unit);
        let said = said.map_err(|error| error.to_string());
        assert_eq!(said.is_err_and(|said| said.starts_with(no)), is_refused, "{comment}");
    }
}

#[test]
fn what_is_no_table_of_one_curve_is_named() {
    let of_openquake = |heading: &str| {
        let made = "generated_by='OpenQuake engine 3.20.1', kind='mean', investigation_time=50.0";
        format!("#,,,\"{made}\"\n{heading}\n11.1,45.2,0.1,0.2\n")
    };
    let no_curve = "line 2: an export of OpenQuake that is no hazard curve";
    for (text, wanted) in [
        ("<?xml version=\"1.0\"?>\n<nrml><hazardCurves/></nrml>".to_string(), "XML, as"),
        ("\u{feff} <nrml>".into(), "XML"),
        ("{\"status\":\"success\",\"response\":[]}".into(), "JSON"),
        ("[{\"metadata\":{}}]".into(), "JSON"),
        (
            "name,lon,lat,0.005,0.01,0.02\nA,-100,40,0.2,0.07,0.02\n".into(),
            "line 1: levels stand in its heading",
        ),
        ("lon,lat,PGA [g],rate\n1,2,0.1,0.01\n1,2,0.2,0.001\n".into(), "line 1: a grid of"),
        (of_openquake("lon,lat,PGA-0.1,PGA-0.02"), no_curve),
        (of_openquake("lon,lat,0.1~PGA,0.1~SA(0.2)"), no_curve),
        (
            "PGA [g],rate,source\n0.1,0.01,a\n".into(),
            "line 1: it has 3 columns (PGA [g], rate, source); leave two",
        ),
        ("PGA [g],mean,84 %\n0.1,0.01,0.02\n".into(), "line 1: it has 3 columns"),
        ("0.1,0.01,0.02\n0.2,0.001,0.002\n".into(), "line 1: it has 3 columns"),
        ("0.1 0.01 0.02\n0.2 0.001 0.002\n".into(), "line 1: it has 3 columns"),
        ("rate\n0.1\n".into(), "line 1: it has 1 columns"),
    ] {
        for units in [None, Some(Units::G)] {
            let said = read(&text, Intensity::Pga, units).unwrap_err().to_string();
            assert!(said.starts_with(wanted) && !said.contains('\n'), "{text}: {said}");
        }
    }
    let bytes = |bytes: &[u8]| of_bytes(bytes, Intensity::Pga, None);
    assert!(bytes(b"\n<nrml/>").unwrap_err().to_string().starts_with("XML"));
    assert!(bytes(b"%PDF-1.7").unwrap_err().to_string().starts_with("a PDF"));
    // Windows' letters, and UTF-16.
    let latin = b"PGA [cm/s\xb2],rate\n10,0.01\n20,0.001\n";
    let wide = "\u{feff}PGA [gal],rate\n10,0.01\n20,0.001\n".encode_utf16();
    let wide: Vec<u8> = wide.flat_map(u16::to_le_bytes).collect();
    for text in [&latin[..], &wide] {
        let read = bytes(text).unwrap();
        assert!(near(read.curve.ends(), [0.1, 0.2]) && read.unit == "cm/s2", "{read:?}");
    }
}

#[test]
fn the_caller_may_say_the_unit() {
    let rows = "0.1,0.01\n0.2,0.001\n";
    for heading in ["level,rate\n", "", "# of a site\nim,mafe\n"] {
        let (levels, of, taken) = ends(&format!("{heading}{rows}"), Intensity::Pga, None);
        assert!(near(levels, [0.1, 0.2]) && (of, taken) == ("m/s²", true), "{heading}");
    }
    let rows = format!("level,rate\n{rows}");
    let (levels, unit, assumed) = ends(&rows, Intensity::Sa(1.0), Some(Units::G));
    assert!(near(levels, [0.1 * GRAVITY, 0.2 * GRAVITY]) && unit == "g" && !assumed);
    // A velocity whose heading has no unit is taken in m/s, which is warned of.
    assert_eq!(
        ends(&rows, Intensity::Pgv, None),
        ([0.1_f64.ln().exp(), 0.2_f64.ln().exp()], "m/s", true)
    );
    let refused = |text: &str, measure, asked| read(text, measure, asked).unwrap_err().to_string();
    let problem = refused(&rows, Intensity::Pgv, Some(Units::G));
    assert_eq!(problem, "pgv is no acceleration; leave the units out");
    let said = "pga [g],rate\n0.1,0.01\n0.2,0.001\n";
    let problem = refused(said, Intensity::Pga, Some(Units::MetresPerSecondSquared));
    let wanted = "its levels are in g, not in m/s2; leave the units out";
    assert_eq!(problem, format!("line 1, column pga [g]: {wanted}"));
}

/// As version 3.15 exports it, with the probabilities of 50 years; those of 1 and 0 tell nothing.
const SITE: &str = "#,,,,,\"generated_by='OpenQuake engine 3.15.0', start_date='2022-04-20', checksum=1, kind='mean', \
    investigation_time=50.0, imt='SA(0.5)'\"\n\
    lon,lat,depth,poe-0.0050000,poe-0.1000000,poe-0.4000000,poe-0.6000000,poe-2.0000000\n\
    0.00000,0.00000,-0.10000,1.000000E+00,6.081918E-01,3.287217E-01,1.994702E-01,0.000000E+00\n";

#[test]
fn a_curve_of_openquake_has_rates_in_g() {
    let (levels, unit, assumed) = ends(SITE, Intensity::Sa(0.5), None);
    assert!(near(levels, [0.1 * GRAVITY, 0.6 * GRAVITY]) && unit == "g" && !assumed);
    // A step below the first level takes the difference of the ends' rates, -ln(1 - p)/50.
    let curve = read(SITE, Intensity::Sa(0.5), Some(Units::G)).unwrap().curve;
    let rate = curve.rate(Lognormal { theta: 1.0e-3, beta: 0.0 }).rate;
    let wanted = ((1.0 - 0.1994702_f64) / (1.0 - 0.6081918)).ln() / 50.0;
    assert!((rate / wanted - 1.0).abs() < 1.0e-9, "{rate} {wanted}");
    // Older versions quote the measure otherwise.
    let older = "# source_model_tree_path=('b1',), investigation_time=1.0,imt=\"PGA\"\n\
        lon,lat,depth,poe-0.1,poe-0.4\n0.0,0.0,-0.1,4.5E-01,5.6E-02\n";
    assert!(near(ends(older, Intensity::Pga, None).0, [0.1 * GRAVITY, 0.4 * GRAVITY]));
    let of = |text: &str, measure, asked| read(text, measure, asked).unwrap_err().to_string();
    assert!(of(SITE, Intensity::Pga, None).starts_with("the curve is of SA(0.5), not of pga"));
    let other = of(SITE, Intensity::Sa(0.5), Some(Units::MetresPerSecondSquared));
    assert!(other.starts_with("its levels are in g, not in m/s2"), "{other}");
    assert!(of(SITE, Intensity::AverageSa(0.5), None).contains("has no curves of avg-sa:0.5"));
    let row = SITE.lines().last().unwrap();
    let two = of(&format!("{SITE}{row}\n{row}\n"), Intensity::Sa(0.5), None);
    assert!(two.starts_with("line 4: it has 3 sites"), "{two}");
    let bare: String = SITE.lines().skip(1).map(|line| format!("{line}\n")).collect();
    assert!(of(&bare, Intensity::Sa(0.5), None).contains("investigation_time"));
}

/// Of all kinds the curves are read, and the words say which it was.
#[test]
fn a_curve_of_openquake_says_its_kind_time_and_site() {
    let of = |kind: &str| {
        let text = SITE.replace("kind='mean'", &format!("kind='{kind}'"));
        read(&text, Intensity::Sa(0.5), None)
    };
    for kind in ["mean", "max", "quantile-0.84", "rlz-003"] {
        let place = "probabilities in 50 years, site lon 0, lat 0";
        assert_eq!(of(kind).unwrap().source, format!("OpenQuake, {kind}, SA(0.5), {place}"));
    }
    for kind in ["std", "cov", "meanstd", ""] {
        let said = of(kind).unwrap_err().to_string();
        assert!(said.starts_with(&format!("`kind='{kind}'` is no hazard curve")), "{said}");
    }
}

#[test]
fn return_periods_and_other_units_are_converted() {
    let rate = |text: &str, measure| {
        let step = Lognormal { theta: 1.3, beta: 0.3 };
        read(text, measure, None).unwrap().curve.rate(step).rate
    };
    let rates = "pga (g),rate\n0.1,0.00210526315789\n0.2,0.00040404040404\n";
    let periods = "pga (g);Return period [years]\r0,1;475\r0,2;2475\r";
    let gal = "PGA [Gal]\trate\n98.1\t0.00210526315789\n196.2\t0.00040404040404\n";
    for text in [periods, gal] {
        let [one, other] = [text, rates].map(|text| rate(text, Intensity::Pga));
        assert!((one / other - 1.0).abs() < 1.0e-9, "{one} {other}");
    }
    for (unit, factor, measure) in [
        ("PGV [cm/s]", 100.0, Intensity::Pgv),
        ("PGV (cm/sec)", 100.0, Intensity::Pgv),
        ("Arias [cm/sec]", 100.0, Intensity::Arias),
        ("CAV [g s]", 1.0 / GRAVITY, Intensity::Cav),
        ("CAV [cm/s]", 100.0, Intensity::Cav),
    ] {
        let text = format!("{unit},rate\n{},0.01\n{},0.001\n", factor, 2.0 * factor);
        let ends = read(&text, measure, None).unwrap().curve.ends();
        assert!(near(ends, [1.0, 2.0]), "{unit}: {ends:?}");
    }
}
