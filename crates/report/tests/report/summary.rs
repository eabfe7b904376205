use std::collections::BTreeMap;

use topple_report::summary::devices;

fn rows(list: &[[&str; 5]]) -> Vec<BTreeMap<String, String>> {
    let columns = ["device", "feasible", "standing", "reserve", "rate"];
    let row = |values: &[&str; 5]| {
        columns.into_iter().zip(*values).map(|(a, b)| (a.into(), b.into())).collect()
    };
    list.iter().map(row).collect()
}

/// Devices that are equal are all named, in whichever order they stand.
#[test]
fn of_equal_devices_none_is_chosen() {
    let mut list = rows(&[
        ["bearing", "0", "0.5", "", "4e-4"],
        ["pendulum, R = 2 m", "0", "0.75", "", ""],
        ["ropes", "0", "0.75", "", "4e-4"],
    ]);
    for _ in 0..2 {
        let told = devices(&list).join(" ");
        assert!(
            told.contains("on pendulum, R = 2 m; ropes: under 75.0 %")
                || told.contains("on ropes; pendulum, R = 2 m: under 75.0 %"),
            "{told}"
        );
        assert!(
            told.contains("computed on bearing; ropes: 0.0004 a year.")
                || told.contains("computed on ropes; bearing: 0.0004 a year."),
            "{told}"
        );
        list.reverse();
    }
    let told = devices(&rows(&[
        ["a", "1", "1", "1.5", ""],
        ["b", "1", "1", "1.5", ""],
        ["c", "1", "1", "1", ""],
        ["d", "0", "1", "", ""],
    ]));
    assert_eq!(
        told,
        [
            "3 of 4 devices keep all limits: a; b; c.",
            "a; b keep them up to 1.5 times the motions, the others less."
        ]
    );
    assert_eq!(
        devices(&rows(&[["a", "0", "0.5", "", "4e-4"]])),
        ["The device does not keep all limits; the block stands under 50.0 % of the motions."]
    );
    assert!(devices(&Vec::new()).is_empty());
}
