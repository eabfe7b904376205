use topple_pictures::drawing::canvas::Canvas;
use topple_pictures::drawing::letters::{lacking, missing};
use topple_pictures::drawing::picture::Picture;
use topple_pictures::drawing::text::style;

/// A letter for private use of the last plane, which no font has.
const NONE: char = '\u{10fffd}';

fn picture(text: &str) -> Picture {
    let mut canvas = Canvas::new(100.0);
    canvas.text((5.0, 10.0), style(7.0), text);
    canvas.finish(20.0)
}

#[test]
fn letters_that_no_font_has_are_named_with_their_text() {
    let said = missing([&picture(&format!("T_h & <{NONE}>"))]).unwrap().to_string();
    assert!(said.contains(&format!("the letters {NONE} (U+10FFFD) of ")), "{said}");
    assert!(!said.contains('\n') && said.contains("install a font"), "{said}");
    assert!(said.contains(&format!("of \"Th & <{NONE}>\":")), "{said}");
}

#[test]
fn letters_of_the_font_are_no_fault_and_need_no_other_font() {
    let text = "Ünïcødé αβγδεζηθ Москва ≥ ≤ ≈ ± × · − – … ° ² ³ √ ∞ ü";
    assert!(lacking(text).is_empty(), "{:?}", lacking(text));
    assert_eq!(missing([&picture(&format!("{text} v\u{308}_g"))]), None);
    assert!(!lacking("免震 مخمد 면진 🙂").is_empty());
}

#[test]
fn letters_that_no_font_has_stay_text_where_others_become_outlines() {
    assert!(!picture("plain").outlined().contains("<text"));
    let kept = picture(&format!("a{NONE}"));
    let svg = kept.outlined();
    assert!(svg.contains("<text") && svg.contains(NONE), "{svg}");
    assert!(kept.png().is_ok());
}
