use topple_pictures::drawing::ticks::{Scale, Tick, of};

fn texts(scale: &Scale, ends: (f64, f64), most: usize) -> Vec<String> {
    let named = |ticks: &[Tick]| ticks.iter().filter(|tick| !tick.text.is_empty()).count();
    let ticks = of(scale, ends, |ticks| named(ticks) <= most);
    ticks.into_iter().map(|tick| tick.text).filter(|text| !text.is_empty()).collect()
}

#[test]
fn even_axes_have_round_numbers_in_either_direction() {
    let up = texts(&Scale::Linear, (0.2, 15.0), 8);
    assert_eq!(up, ["2", "4", "6", "8", "10", "12", "14"]);
    assert_eq!(texts(&Scale::Linear, (15.0, 0.2), 8), up);
    assert_eq!(texts(&Scale::Linear, (-0.004, 0.0061), 3), ["0", "0.005"]);
    assert_eq!(texts(&Scale::Linear, (1.0e6, 3.0e6), 3), ["1·10^{6}", "2·10^{6}", "3·10^{6}"]);
}

#[test]
fn logarithmic_axes_have_more_than_two_numbers() {
    let log = Scale::Log { negative: false };
    let over = |low: f64, high: f64, most| texts(&log, (low.log10(), high.log10()), most);
    assert_eq!(over(0.2, 15.0, 8), ["0.2", "0.5", "1", "2", "5", "10"]);
    assert_eq!(over(15.0, 0.2, 8), ["0.2", "0.5", "1", "2", "5", "10"]);
    assert_eq!(over(0.5, 4.0, 8), ["0.5", "1.0", "1.5", "2.0", "2.5", "3.0", "3.5", "4.0"]);
    assert_eq!(over(1.0e-13, 1.0, 5), ["10^{-12}", "10^{-9}", "10^{-6}", "10^{-3}", "10^{0}"]);
    let below = Scale::Log { negative: true };
    assert_eq!(texts(&below, (1.0, -1.0), 5), ["-0.1", "-1", "-10"]);
}

#[test]
fn lists_have_their_own_numbers() {
    let list = Scale::List(vec![-0.4, 0.0, 0.4, 0.5]);
    assert_eq!(texts(&list, (-0.5, 3.5), 9), ["-0.4", "0", "0.4", "0.5"]);
    assert_eq!(texts(&list, (-0.5, 3.5), 2), ["-0.4", "0.4"]);
}
