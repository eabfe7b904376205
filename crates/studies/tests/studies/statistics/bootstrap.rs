use topple_studies::Bootstrap;

#[test]
fn a_draw_is_even_and_every_set_has_as_many_items() {
    let mut counts = [0_u32; 7];
    let bootstrap = Bootstrap { replicates: 10_000, seed: 3 };
    for replicate in 0..bootstrap.replicates {
        let times = bootstrap.multipliers(7, replicate);
        assert_eq!(times.iter().sum::<u32>(), 7);
        counts.iter_mut().zip(&times).for_each(|(count, times)| *count += times);
    }
    // 70,000 draws in seven: the standard deviation of a count is 93.
    for count in counts {
        assert!(count.abs_diff(10_000) < 400, "{counts:?}");
    }
}
