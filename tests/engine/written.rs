//! Choices: the words in files are those of the flags.

use serde::Serialize;
use serde::de::DeserializeOwned;
use topple::model::precision::Precision;
use topple::model::pulse::Shape;
use topple::{BackendRequest, Directions, Overturn, Units, Written};

fn is_read_as_written<T: Written + PartialEq + std::fmt::Debug + Serialize + DeserializeOwned>() {
    for one in T::ALL {
        assert_eq!(serde_json::to_value(one).unwrap(), one.key());
        for word in one.aliases().iter().chain([&one.key()]) {
            assert_eq!(T::of_key(word), Some(*one), "{word}");
            assert_eq!(serde_json::from_value::<T>((*word).into()).unwrap(), *one, "{word}");
        }
        let help = one.help();
        assert!(!help.is_empty() && help == help.trim() && !help.ends_with('.'), "{help}");
    }
    assert_eq!(T::of_key(""), None);
}

#[test]
fn a_choice_has_one_word_in_files_and_as_a_flag() {
    is_read_as_written::<Precision>();
    is_read_as_written::<Shape>();
    is_read_as_written::<Units>();
    is_read_as_written::<Overturn>();
    is_read_as_written::<Directions>();
    is_read_as_written::<BackendRequest>();
    assert_eq!(Units::of_key("gal"), Some(Units::CentimetresPerSecondSquared));
    assert_eq!(Shape::default(), Shape::OneSine);
    let help = "The pulse of Mavroeidis & Papageorgiou (2003), for gamma periods: its velocity is a cosine of phase \
                ν under a bell, 1 + cos(Ωτ/γ)";
    assert_eq!(Shape::MavroeidisPapageorgiou.help(), help);
}
