use topple_pictures::drawing::FONT;
use topple_pictures::drawing::text::{
    marked_up, shortened, shortened_by, width, wrapped, wrapped_by,
};

#[test]
fn symbols_have_indices_and_names_of_files_have_none() {
    let marked = marked_up("T_h = 2 s, max |v + g/ω_v²|, AT_h.at2, T_hx", 7.0);
    let lowered = |letter: &str, index: &str| {
        format!("{letter}<tspan baseline-shift=\"sub\" font-size=\"6.00\">{index}</tspan>")
    };
    assert!(marked.starts_with(&format!("{} = 2 s", lowered("T", "h"))), "{marked}");
    assert!(marked.contains(&format!("{}²|", lowered("ω", "v"))), "{marked}");
    assert!(marked.ends_with("AT_h.at2, T_hx"), "{marked}");
    assert_eq!(
        marked_up("10^{-3}", 7.0),
        "10<tspan baseline-shift=\"super\" font-size=\"6.00\">-3</tspan>"
    );
}

#[test]
fn what_xml_reserves_is_escaped_and_what_it_forbids_is_left_out() {
    let marked = marked_up("<a href='x'>\"&\u{1}\u{7}", 7.0);
    assert_eq!(marked, "&lt;a href=&apos;x&apos;&gt;&quot;&amp;");
}

#[test]
fn lines_are_no_wider_than_they_may_be() {
    let text =
        "B = 0.175 m, H = 0.95 m, a_name_that_has_no_space_in_it_and_is_far_too_long_for_a_line";
    let lines = wrapped(text, FONT, 90.0);
    assert!(lines.len() > 3 && lines.iter().all(|line| width(line, FONT) <= 90.0), "{lines:?}");
    assert_eq!(lines.concat().replace(' ', ""), text.replace(' ', ""));
    let short = shortened(text, FONT, 90.0);
    assert!(short.contains(" … ") && short.starts_with("B = 0.1") && short.ends_with("line"));
    assert!(width(&short, FONT) <= 90.0 && width(&short, FONT) > 75.0);
    assert_eq!(shortened("short", FONT, 90.0), "short");
}

#[test]
fn a_letter_is_measured_once_however_long_a_text_is() {
    // Letters without a width, too: a line of them has no end.
    for letter in ["a", "a_name ", "\u{301}", "漢", " "] {
        let text = letter.repeat(100_000);
        let letters = text.chars().count();
        let mut measured = 0;
        let mut advance = |letter: char| {
            measured += 1;
            if letter == '\u{301}' { 0.0 } else { 0.5 }
        };
        let short = shortened_by(&text, FONT, 400.0, &mut advance);
        assert!(short.len() == text.len() || short.chars().count() <= 120, "{letter:?}");
        wrapped_by(&text, FONT, 200.0, &mut advance);
        assert!(measured <= 2 * letters + 3, "{letter:?}: {measured}");
    }
}

#[test]
fn a_symbol_and_its_index_stay_on_one_line() {
    let text = "T_h ".repeat(12).replace(' ', ",");
    for line in wrapped(&text, FONT, 30.0) {
        assert!(!line.starts_with("_h") && !line.ends_with('_'), "{line}");
    }
}
