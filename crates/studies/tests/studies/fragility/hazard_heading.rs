use topple::Units;
use topple_studies::fragility::hazard_heading::*;

fn of(heading: [&str; 2], measure: &str, asked: Option<Units>) -> Result<Heading, String> {
    let measure = measure.parse().unwrap();
    judged(1, heading, measure, asked).map_err(|error| error.to_string())
}

#[test]
fn names_of_levels_are_those_of_the_measure() {
    let g = Some("g");
    for (heading, measure, unit) in [
        ("level", "pga", None),
        ("IML", "sa:1", None),
        ("acc [m/s2]", "avg-sa:1", Some("m/s2")),
        ("PGA", "pga", None),
        ("pga_g", "pga", g),
        ("PGA [cm/s²]", "pga", Some("cm/s2")),
        ("PGA (gal)", "pga", Some("cm/s2")),
        ("PGA [m/sec**2]", "pga", Some("m/s2")),
        ("PGA [m·s⁻²]", "pga", Some("m/s2")),
        ("Peak Ground Acceleration, g", "pga", g),
        ("RotD50 PGA [g]", "pga", g),
        ("PGA_RotD50 (g)", "pga", g),
        ("SA(1.8) [g]", "sa:1.8", g),
        ("Sa(1.80 s) (g)", "sa:1.8", g),
        ("sa_1.8s_g", "sa:1.8", g),
        ("SA1.8 [g]", "sa:1.8", g),
        ("Sa(1,8 s) [g]", "sa:1.8", g),
        ("PSA (T=1.8s, 5%) [g]", "sa:1.8", g),
        ("pseudo-spectral acceleration 1.8 s [m/s/s]", "sa:1.8", Some("m/s2")),
        ("AvgSA(1.8) [g]", "avg-sa:1.8", g),
        ("avg-sa:1.8 [g]", "avg-sa:1.8", g),
        ("Peak ground velocity [cm/s]", "pgv", Some("cm/s")),
        ("PGV [m/s]", "pgv", Some("m/s")),
        ("PGV", "pgv", None),
        ("IA (cm/s)", "arias", Some("cm/s")),
        ("CAV [g·s]", "cav", Some("g s")),
        ("CAV (g-sec)", "cav", Some("g s")),
        ("pga* [-]", "pga*", Some("1")),
        ("pgv*", "pgv*", None),
    ] {
        let said = of([heading, "rate"], measure, None);
        let said = said.map(|said| said.unit.map(|(name, _)| name));
        assert_eq!(said, Ok(unit), "{heading} {measure}");
    }
}

#[test]
fn other_measures_periods_and_units_are_refused() {
    let other = "these are no levels of";
    for (heading, measure, wanted) in [
        ("PSA [g]", "pga", other),
        ("Sa(0.2 s) (g)", "pga", other),
        ("PGA [g]", "sa:1.8", other),
        ("PGV (cm/s)", "pga", other),
        ("Peak Ground Velocity [m/s]", "pga", other),
        ("RotD50 PGA [g]", "pgv", other),
        ("PGA [g]", "pga*", other),
        ("PGV [m/s]", "pgv*", other),
        ("pga*", "pga", other),
        ("acc [m/s2]", "pgv", other),
        ("SA(0.2) [g]", "sa:1.8", other),
        ("SA(0.2) [g]", "avg-sa:1.8", other),
        ("SA(1.8) [g]", "avg-sa:1.8", other),
        ("SA_1.0 [g]", "sa:1.8", other),
        ("sa_0.2s", "sa:1.8", other),
        ("SA [g]", "sa:1.8", "names no period; write `sa(1.8) [g]`"),
        ("SA(1.8 Hz) [g]", "sa:1.8", "levels in `hz g` are not read"),
        ("SA(1.8, 2%) [g]", "sa:1.8", "levels in `2% g` are not read"),
        ("PGD [m]", "pga", "names no measure that is read; call levels of pga `pga [g]`"),
        ("MMI", "pga", "names no measure"),
        ("RotD100 PGA [g]", "pga", "names no measure"),
        ("accelerazione [g]", "pga", "names no measure"),
        ("PGA (mg)", "pga", "levels in `mg` are not read; give g, m/s2, cm/s2"),
        ("PGA [%g]", "pga", "levels in `%g` are not read"),
        ("PGA [g_n]", "pga", "levels in `g n` are not read"),
        ("PGA_cms2", "pga", "levels in `cms2` are not read"),
        ("PGA [ft/s2]", "pga", "levels in `ft/s2` are not read"),
        ("PGA [mm/s²]", "pga", "levels in `mm/s2` are not read"),
        ("PGA [m/s]", "pga", "levels in `m/s` are not read"),
        ("PGA vertical [g]", "pga", "levels in `vertical g` are not read"),
        ("PGA 0.1 [g]", "pga", "levels in `0.1 g` are not read"),
        ("PGV [g]", "pgv", "levels in `g` are not read; give m/s, cm/s"),
        ("PGV [in/s]", "pgv", "levels in `in/s` are not read"),
        ("Arias [g s]", "arias", "are not read; give m/s, cm/s"),
        ("pga* [g]", "pga*", "levels in `g` are not read"),
    ] {
        let said = of([heading, "rate"], measure, None).unwrap_err();
        let place = "line 1, column ";
        assert!(said.starts_with(place) && said.contains(wanted), "{heading}: {said}");
        // With the unit given, a name of no list is not judged, and no period is missed.
        if ["pga", "sa:1.8", "avg-sa:1.8"].contains(&measure) {
            let given = of([heading, "rate"], measure, Some(Units::G));
            let open = ["accelerazione [g]", "SA [g]"].contains(&heading);
            assert_eq!(given.is_ok(), open, "{heading} {given:?}");
        }
    }
}

#[test]
fn names_of_rates_are_of_a_list() {
    let headings = "rate|Rate [1/yr]|annual rate|Annual rate of exceedance (1/year)|\
        annual_frequency_of_exceedance|Mean annual frequency of exceedance [1/a]|\
        annual exceedance frequency|exceedance rate, per year|rate/yr|rate [yr⁻¹]|\
        rate (yr^-1)|lambda|λ [1/a]|MAF|MAFE|AFE|exceedances per year|events/year|MRE|\
        rate (1/y)|Annual Frequency of Exceedence";
    for heading in headings.split('|') {
        let said = of(["PGA [g]", heading], "pga", None).map(|said| said.rates);
        assert_eq!(said, Ok(Rates::Annual), "{heading}");
    }
    let headings =
        "Return period|return period [years]|T_R [yr]|TR|rp|Mean recurrence interval (a)";
    for heading in headings.split('|') {
        let said = of(["PGA [g]", heading], "pga", None).map(|said| said.rates);
        assert_eq!(said, Ok(Rates::Periods), "{heading}");
    }
    let headings = "exceedance (50 years)|Exceedance in 50 yr [%]|50-year-probability|PE50|PoE50|PE|\
        poe|rate in 50 years|rate [1/50yr]|annual rate [%]|\
        probability of exceedance in 50 years|annual probability of exceedance|APE|\
        rate per day|rate [1/month]|rate per decade|probabilidad anual|\
        Überschreitungswahrscheinlichkeit|P(PGA > x)|return period [days]|\
        return period [%]|rate x 1000|10^-4 1/yr|number of events in 475 years";
    for heading in headings.split('|') {
        for asked in [None, Some(Units::G)] {
            let said = of(["PGA [g]", heading], "pga", asked).unwrap_err();
            assert!(said.contains("says no annual rate of exceedance"), "{heading}: {said}");
        }
    }
    // With the unit of the levels given, the names of levels of no list are not judged, those of the rates are.
    let headings = "x|hazard|exceedances|frequenza annua|超過確率|chance|daily rate|T [Jahre]";
    for heading in headings.split('|') {
        for asked in [None, Some(Units::G)] {
            assert!(of(["PGA [g]", heading], "pga", asked).is_err(), "{heading}");
        }
    }
    assert!(of(["anything", "rate"], "pga", Some(Units::G)).is_ok());
    for heading in [["annual rate", "pga"], ["lambda", "PGA (g)"], ["return period", "PGA [g]"]] {
        let said = of(heading, "pga", None).unwrap_err();
        assert!(said.contains("the levels come first"), "{said}");
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
