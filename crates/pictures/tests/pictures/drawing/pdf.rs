use std::collections::HashMap;
use std::io::Read;

use flate2::read::ZlibDecoder;

use topple_pictures::drawing::canvas::{Canvas, Place};
use topple_pictures::drawing::pdf::{Placed, pages};
use topple_pictures::drawing::raster::png;
use topple_pictures::drawing::text::style;

/// The packed streams of a PDF.
fn streams(pdf: &[u8]) -> Vec<String> {
    let mark = b"stream\n";
    let starts = (0..pdf.len()).filter(|at| pdf[*at..].starts_with(mark));
    let packed = starts.filter_map(|at| {
        let mut bytes = Vec::new();
        let read = ZlibDecoder::new(&pdf[at + mark.len()..]).read_to_end(&mut bytes);
        read.ok().map(|_| bytes.iter().map(|byte| char::from(*byte)).collect())
    });
    packed.collect()
}

/// The codes of the strings of a line of a page, none of which is that of a bracket.
fn codes(line: &str) -> Vec<u8> {
    let mut codes = Vec::new();
    let mut letters = line.chars();
    while let Some(letter) = letters.next() {
        match letter {
            '(' => {
                while let Some(letter) = letters.next().filter(|letter| *letter != ')') {
                    let mut next = || letters.next().unwrap();
                    codes.push(match letter {
                        '\\' => match next() {
                            'b' => 8,
                            't' => 9,
                            'n' => 10,
                            'f' => 12,
                            'r' => 13,
                            first => {
                                let octal = String::from_iter([first, next(), next()]);
                                u8::from_str_radix(&octal, 8).unwrap()
                            }
                        },
                        plain => plain as u8,
                    });
                }
            }
            '<' => {
                let hex: String = letters.by_ref().take_while(|letter| *letter != '>').collect();
                let pairs = (0..hex.len() / 2).map(|k| &hex[2 * k..2 * k + 2]);
                codes.extend(pairs.map(|pair| u8::from_str_radix(pair, 16).unwrap()));
            }
            _ => {}
        }
    }
    codes
}

#[test]
fn text_of_a_pdf_is_read_back() {
    let text = "T_h = 2 s: Москва, ε ≥ 0 fi AVA 10^{-3}";
    let mut canvas = Canvas::new(200.0);
    canvas.text((10.0, 20.0), style(7.0), text);
    canvas.text((10.0, 90.0), style(7.0).middle().upwards(), "upwards");
    let place = Place { x: 10.0, y: 30.0, width: 20.0, height: 20.0 };
    canvas.image(place, &png((3, 2), |x, _| [9, 9, 9, 255 - x as u8]).unwrap(), true);
    canvas.image(place, &png((3, 2), |x, y| [x as u8, y as u8, 9, 255]).unwrap(), true);
    let placed = Placed { picture: canvas.finish(100.0), x: 5.0, y: 7.0, scale: 0.5 };
    let pdf = pages(&[vec![placed.clone()], vec![placed]], (300.0, 400.0), ("a", "b")).unwrap();
    let plain = String::from_utf8_lossy(&pdf);
    let of = ["/Type3", "/SMask", "/Indexed"].map(|kind| plain.matches(kind).count());
    assert_eq!(of, [1, 2, 2]);
    let streams = streams(&pdf);
    let map = streams.iter().find(|stream| stream.contains("beginbfchar")).unwrap();
    let pairs = map.lines().filter_map(|line| line.strip_prefix('<')?.split_once("> <"));
    let letters: HashMap<u8, String> = pairs
        .map(|(code, letters)| {
            let letters = letters.trim_end_matches('>');
            let units = (0..letters.len() / 4).map(|k| &letters[4 * k..4 * k + 4]);
            let units: Vec<u16> =
                units.map(|unit| u16::from_str_radix(unit, 16).unwrap()).collect();
            (u8::from_str_radix(code, 16).unwrap(), String::from_utf16(&units).unwrap())
        })
        .collect();
    let pages: Vec<&String> = streams.iter().filter(|stream| stream.contains("TJ")).collect();
    assert_eq!(pages.len(), 2);
    for page in pages {
        let shown = page.lines().filter(|line| line.ends_with("TJ")).flat_map(codes);
        let said: String = shown.filter_map(|code| letters.get(&code).cloned()).collect();
        let plain = text.replace("_h", "h").replace("^{-3}", "-3");
        assert_eq!(said, plain + "upwards");
    }
}

/// More letters than a font of bytes has room for.
#[test]
fn many_letters_take_several_fonts() {
    let mut canvas = Canvas::new(9000.0);
    let letters: String = ('\u{21}'..'\u{500}').collect();
    canvas.text((0.0, 20.0), style(7.0), &letters);
    let placed = Placed { picture: canvas.finish(100.0), x: 0.0, y: 0.0, scale: 1.0 };
    let pdf = pages(&[vec![placed]], (300.0, 400.0), ("a", "b")).unwrap();
    let plain = String::from_utf8_lossy(&pdf);
    assert!(plain.matches("/Type3").count() > 2 && plain.contains("/LastChar 255"));
}
