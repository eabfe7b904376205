//! Paths in documents.

use std::path::Path;

use topple_records::path_text::{PathText, path, text};

#[test]
fn a_path_that_is_text_stands_as_it_is() {
    for name in ["mine.at2", "/records/café 1.at2", "file:/a.at2", "file:%", "file:%C3%A9", ""] {
        assert_eq!(text(Path::new(name)), name);
        assert_eq!(path(name), Path::new(name));
    }
}

#[cfg(unix)]
#[test]
fn a_path_that_is_no_text_is_read_back_to_the_byte() {
    use std::os::unix::ffi::OsStrExt;
    let every: Vec<u8> = (1..=255).collect();
    for (bytes, written) in [
        (&b"/tmp/caf\xe9 1/x.at2"[..], Some("file:/tmp/caf%E9%201/x.at2")),
        (b"caf\xe9%41", Some("file:caf%E9%2541")),
        (&every, None),
    ] {
        let place = Path::new(std::ffi::OsStr::from_bytes(bytes));
        let told = text(place);
        assert!(written.is_none_or(|written| written == told), "{told}");
        assert_eq!(path(&told), place);
        let json = serde_json::to_string(&PathText(place.into())).unwrap();
        assert_eq!(serde_json::from_str::<PathText>(&json).unwrap().0, place);
    }
}
