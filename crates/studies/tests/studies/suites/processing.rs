use topple_studies::suites::processing::of_name;

#[test]
fn names_of_one_stream_differ_by_its_processing_alone() {
    for (uncorrected, corrected) in [
        ("XX.ST1.00.HNE.D.20010203.040506.U.ACC.ASC", "XX.ST1.00.HNE.D.20010203.040506.C.ACC.ASC"),
        ("HI.ARS1..HNE.D.20190728.160908.CV.ACC.ASC", "HI.ARS1..HNE.D.20190728.160908.MP.ACC.ASC"),
        ("unprocessed/a.at2", "processed/a.at2"),
        ("q/raw/a.at2", "q/Corrected/a.at2"),
        ("Vol1/CE36456.V1", "Vol2/CE36456.V2"),
        ("CE36456.V1c", "CE36456.v2c"),
        ("20030102_ABC_raw.txt", "20030102_ABC_corrected.txt"),
    ] {
        let (one, other) = (of_name(uncorrected).unwrap(), of_name(corrected).unwrap());
        assert_eq!((&one.0, one.1, other.1), (&other.0, false, true), "{uncorrected}");
    }
    for name in ["RSN1_A_B-C000.AT2", "u.at2", "c/a.at2", "ABCV1.AT2", "A.C.at2"] {
        assert_eq!(of_name(name), None, "{name}");
    }
}
