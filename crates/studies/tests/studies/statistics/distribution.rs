use topple_studies::Distribution;

fn read(text: &str) -> Distribution {
    text.parse().unwrap()
}

/// scipy 1.17.1: norm(1, 0.5), lognorm(0.4, scale=2), uniform(1, 2), truncnorm(-1, 3, 1, 0.5), and the
/// far tail truncnorm(6, 7, 0, 1).
#[test]
fn quantiles_are_those_of_scipy() {
    for (text, wanted) in [
        ("normal(1,0.5)", [-0.5451161530839066, 0.7377997436459796, 1.0, 1.979981992270027]),
        ("lognormal(2,0.4)", [0.5810341523133201, 1.62155728651761, 2.0, 4.380368154417211]),
        ("uniform(1,3)", [1.002, 1.6, 2.0, 2.95]),
        (
            "normal(1,0.5,0.5,2.5)",
            [0.501732734161232, 0.887068140483091, 1.0992239498017236, 2.003735486021077],
        ),
        (
            "normal(0,1,6,7)",
            [6.000162245969133, 6.0575631913034345, 6.111358215508885, 6.565596387454304],
        ),
    ] {
        let distribution = read(text);
        assert_eq!(distribution.to_string(), text);
        for (share, wanted) in [0.001, 0.3, 0.5, 0.975].into_iter().zip(wanted) {
            let found: f64 = distribution.quantile(share);
            assert!((found / wanted - 1.0).abs() < 1e-12, "{text} at {share}: {found}, {wanted}");
        }
    }
}

#[test]
fn what_is_cut_off_is_never_drawn_and_shares_are_of_what_is_left() {
    for text in ["normal(0.1,0.2,0,0.3)", "lognormal(1,2,0.5,4)", "uniform(-1,1,-0.5,2)"] {
        let (distribution, cut) = (read(text), read(text).cut.unwrap());
        let (low, high) = (distribution.quantile(0.0), distribution.quantile(1.0));
        assert!(low >= cut.0 && high <= cut.1 && high > low, "{text}: {low}, {high}");
        assert_eq!(distribution.outside(cut.0, cut.1), (0.0, 0.0), "{text}");
        for share in [0.1, 0.5, 0.8] {
            let value = distribution.quantile(share);
            let (below, above) = distribution.outside(value, value);
            assert!((below - share).abs() < 1e-12 && (above + share - 1.0).abs() < 1e-12);
        }
    }
    let (below, above) = read("normal(0.2,0.1)").outside(0.0, f64::INFINITY);
    assert!((below - 0.022_750_131_948_179_2).abs() < 1e-15 && above == 0.0, "{below}");
}
