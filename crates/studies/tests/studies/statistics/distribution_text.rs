use topple_studies::{Distribution, DistributionError};

#[test]
fn what_is_no_distribution_is_refused_with_its_reason() {
    let error = |text: &str| text.parse::<Distribution>().unwrap_err();
    assert_eq!(error("0.1"), DistributionError::Form("0.1".into()));
    assert_eq!(error("gauss(1,2)"), DistributionError::Form("gauss(1,2)".into()));
    assert!(matches!(error("normal(1)"), DistributionError::Count(_, 1, "normal", _)));
    assert!(matches!(error("normal(1,2,3)"), DistributionError::Count(_, 3, ..)));
    assert!(matches!(error("normal(1,x)"), DistributionError::Number(..)));
    assert!(matches!(error("normal(1,inf)"), DistributionError::Number(..)));
    assert!(matches!(error("normal(1,0)"), DistributionError::NotPositive("the deviation", ..)));
    assert!(matches!(error("lognormal(0,1)"), DistributionError::NotPositive("the median", ..)));
    assert!(matches!(error("uniform(2,1)"), DistributionError::Order(..)));
    assert!(matches!(error("normal(0,1,5,5)"), DistributionError::Order(..)));
    assert!(matches!(error("uniform(0,1,2,3)"), DistributionError::Empty(..)));
    let line = error("normal(0,1,3)").to_string();
    assert_eq!(
        line,
        "'normal(0,1,3)' has 3 numbers; normal has two, MEAN,DEVIATION, and two more, LOW,HIGH, where it \
         is to be cut off"
    );
}
