use topple::scene::Parameter;
use topple_studies::{Varied, VariedError};

fn read(text: &str) -> Varied {
    text.parse().unwrap()
}

#[test]
fn keys_are_written_as_flags_or_as_keys() {
    for text in ["t_h=normal(1.75,0.1)", "t-h=normal(1.75,0.1)", " t-h = normal( 1.75 , 0.1 ) "] {
        assert_eq!(read(text).parameter, Parameter::TH);
        assert_eq!(read(text).to_string(), "t_h=normal(1.75,0.1)");
    }
    assert!(matches!("t_h".parse::<Varied>(), Err(VariedError::Text(_))));
    assert!(matches!("th=normal(1,1)".parse::<Varied>(), Err(VariedError::Key(_))));
    let error = "t_h=normal(1)".parse::<Varied>().unwrap_err().to_string();
    assert!(error.starts_with("t_h: 'normal(1)' has 1 numbers"), "{error}");
}

#[test]
fn values_outside_the_range_are_refused_with_their_share() {
    let refused = |text: &str, force| read(text).check(force).unwrap_err().to_string();
    let line = refused("t_h=normal(0.2,0.1)", true);
    assert!(line.contains("2.3 % of its values lie outside the range"), "{line}");
    assert!(line.contains("normal(0.2,0.1,LOW,HIGH)"), "{line}");
    let line = refused("eccentricity=uniform(0,2)", true);
    assert!(line.contains("50.0 %"), "{line}");
    let line = refused("half_width=uniform(10,30)", false);
    assert!(line.contains("50.0 % of its values are not plausible (0.002 to 20; metres"), "{line}");
    assert!(refused("bouc_wen_n=uniform(1,3)", true).contains("is a whole number"));
    for (text, force) in [
        ("half_width=uniform(10,30)", true),
        ("t_h=normal(0.2,0.1,0.01,0.4)", false),
        // 17 standard deviations: no point is there.
        ("t_h=normal(1.75,0.1)", false),
        ("a_h=normal(0,3)", false),
        ("psi=uniform(0,1)", false),
    ] {
        assert_eq!(read(text).check(force), Ok(()), "{text}");
    }
}
