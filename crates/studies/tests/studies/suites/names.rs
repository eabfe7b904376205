use topple_studies::suites::names::{Component, read};

#[test]
fn names_tell_stations_and_components() {
    use Component::{Horizontal, Vertical};
    for (name, group, component) in [
        ("RSN125_FRIULI.A_A-TMZ000.AT2", "/RSN125", Horizontal),
        ("RSN125_FRIULI.A_A-TMZ-UP.AT2", "/RSN125", Vertical),
        ("a/RSN138_TABAS_BOS-L1.at2", "a/RSN138", Horizontal),
        ("RSN138_TABAS_BOS-V1.AT2", "/RSN138", Vertical),
        ("RSN28_PARKF_C12DWN.AT2", "/RSN28", Vertical),
        ("RSN1633_MANJIL_ABBAR--L.AT2", "/RSN1633", Horizontal),
        ("RSN1633_MANJIL_ABBAR--V.AT2", "/RSN1633", Vertical),
        ("RSN6915_DARFIELD_HVSCS26W.AT2", "/RSN6915", Horizontal),
        ("RSN6915_DARFIELD_HVSCUP.AT2", "/RSN6915", Vertical),
        ("RSN8161_DUZCE_CHY002-W.AT2", "/RSN8161", Horizontal),
        ("RSN8161_DUZCE_CHY002-V.AT2", "/RSN8161", Vertical),
        ("RSN8162_DUZCE_ABCH02NS.AT2", "/RSN8162", Horizontal),
        ("RSN8162_DUZCE_ABCH02UD.AT2", "/RSN8162", Vertical),
        ("RSN8166_DUZCE_PRPCS.AT2", "/RSN8166", Horizontal),
        ("RSN8166_DUZCE_PRPCUP.AT2", "/RSN8166", Vertical),
        ("RSN8167_DUZCE_45M01DN.AT2", "/RSN8167", Vertical),
        ("TAZ000.AT2", "/TAZ", Horizontal),
        ("TAZ-UP.AT2", "/TAZ", Vertical),
        (
            "HI.ARS1..HNE.D.20190728.160908.C.ACC.ASC",
            "/HI.ARS1..HN.D.20190728.160908.C.ACC.ASC",
            Horizontal,
        ),
        (
            "HI.ARS1..HNZ.D.20190728.160908.C.ACC.ASC",
            "/HI.ARS1..HN.D.20190728.160908.C.ACC.ASC",
            Vertical,
        ),
        ("AOM0011801241951.EW", "/AOM0011801241951", Horizontal),
        ("AOM0011801241951.UD", "/AOM0011801241951", Vertical),
        ("IWTH010305261824.NS2", "/IWTH0103052618242", Horizontal),
        ("IWTH010305261824.UD1", "/IWTH0103052618241", Vertical),
    ] {
        let named = read(name).unwrap_or_else(|| panic!("{name}"));
        assert_eq!((named.group.as_str(), named.component), (group, component), "{name}");
    }
    for name in
        ["readme.txt", "_SearchResults.csv", "RSN_X.AT2", "UP.AT2", "a.VT2", "b", "PRPCS.AT2"]
    {
        assert_eq!(read(name), None, "{name}");
    }
}
