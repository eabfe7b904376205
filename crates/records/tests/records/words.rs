//! Words of headings and names, and what each reader of words makes of them.

use std::fmt::Debug;

use topple_records::columns::{directions, several, unit_words, values, words};
use topple_records::{Component, Units, component, dated, numbers, other_programs, shown};

use crate::told::told;

fn shows(known: impl Debug) -> String {
    format!("{known:?}")
}

#[test]
fn words_are_read() {
    told("words", |reader, words| {
        Some(match reader {
            "direction" => shows(directions::stated(words)),
            "azimuth of a column" => shows(directions::azimuth_of_column(words)),
            "clock" => shows(unit_words::clock(words).map(|clock| clock.map(|clock| clock.word))),
            "units of a heading" => shows(unit_words::units(words)),
            "step" => shows(values::step(words)),
            "count" => shows(values::count(words)),
            "names columns" => shows(words::names_columns(words)),
            "without units" => shows(words::without_units(words)),
            "azimuth" => shows(component::azimuth(words)),
            "component" => shows(Component::named(words)),
            "component of a channel" => shows(Component::of_channel(words)),
            "units" => match Units::named(words) {
                None if Units::are_meant(words) => "units that are not read".into(),
                units => shows(units),
            },
            "has decimal commas" => shows(several::has_decimal_commas(words)),
            "number" => shows(numbers::number(words)),
            "free" => shows(numbers::free(words)),
            "fixed 10" => shows(numbers::fixed(words, 10)),
            "width" => shows(numbers::width(words)),
            "after NPTS" => shows(numbers::after(words, "NPTS")),
            "after DT" => shows(numbers::after(words, "DT")),
            "dates" => match dated::plain(words, 20) {
                Ok(dated) => shows(dated.map(|dated| (dated.start, dated.text))),
                Err(error) => error.to_string(),
            },
            "text of another program" => shows(other_programs::of_text(words)),
            "word of a shell" => shown::word(words),
            other => panic!("no reader is called {other}"),
        })
    });
}
