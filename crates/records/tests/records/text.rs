//! From bytes to text, packed ones too.

use std::io::{Cursor, Write};

use flate2::Compression;
use flate2::write::GzEncoder;
use topple_records::RecordError;
use topple_records::packed::unpacked;
use topple_records::text::{LARGEST, LONGEST_LINE, decoded, printable};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

fn of(bytes: &[u8], most: u64) -> Result<(String, Option<String>), RecordError> {
    let (bytes, note) = unpacked(bytes, most)?;
    Ok((decoded(&bytes)?, note))
}

fn zipped(files: &[(&str, &str)]) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, text) in files {
        archive.start_file(*name, SimpleFileOptions::default()).unwrap();
        archive.write_all(text.as_bytes()).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

#[test]
fn a_line_without_an_end_is_refused() {
    let long = [b"1\n", &vec![b'1'; LONGEST_LINE + 1][..]].concat();
    let error = of(&long, LARGEST).unwrap_err().to_string();
    assert_eq!(error, "line 2: longer than 16 MiB; give the record with a few values a line");
}

#[test]
fn other_encodings_are_read() {
    let text = "\u{feff}Erdbeben ä\n1\n";
    let (read, _) = of(text.as_bytes(), LARGEST).unwrap();
    assert_eq!(read, "Erdbeben ä\n1\n");
    for order in [u16::to_le_bytes, u16::to_be_bytes] {
        let bytes: Vec<u8> = text.encode_utf16().flat_map(order).collect();
        assert_eq!(of(&bytes, LARGEST).unwrap().0, "Erdbeben ä\n1\n");
    }
}

#[test]
fn lines_end_however_systems_end_them() {
    for text in [
        "1\r2\r3",
        "1\r\n2\r\n3",
        "1\r\r\n2\r\r\n3\r\r\n",
        "1\n2\n3\n\x1a",
        "1\n2\r\n3\r\n\x1a\x1a\0\0",
        "\u{feff}\u{feff}1\n2\n3",
    ] {
        let (read, _) = of(text.as_bytes(), LARGEST).unwrap();
        assert_eq!(read.lines().collect::<Vec<_>>(), ["1", "2", "3"], "{text:?}");
    }
    // Amid a text it ends nothing.
    assert!(of(b"1\n\x1a2\n", LARGEST).unwrap().0.contains('\x1a'));
    let wide: Vec<u8> =
        "0.123456 0.234567\n0.3".encode_utf16().flat_map(u16::to_le_bytes).collect();
    assert_eq!(of(&wide, LARGEST).unwrap().0, "0.123456 0.234567\n0.3");
}

#[test]
fn what_is_no_record_is_named() {
    let xlsx = zipped(&[("xl/workbook.xml", ""), ("xl/a.xml", "")]);
    let mut seed = b"000001D XXX  HNE".to_vec();
    seed.resize(512, 0);
    for (bytes, said) in [(&xlsx, "save its sheet as CSV"), (&seed, "miniSEED")] {
        let error = of(bytes, LARGEST).unwrap_err().to_string();
        assert!(error.contains(said), "{error}");
        // Lists and hazard curves are not unpacked.
        let error = decoded(bytes).unwrap_err().to_string();
        assert!(error.contains(said), "{error}");
    }
    for (bytes, said) in [
        (&b"  <!DOCTYPE html><html>"[..], "a web page"),
        (b"<html><body>Login", "a web page"),
        (b"%PDF-1.7", "a PDF"),
        (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "a binary file"),
    ] {
        let error = of(bytes, LARGEST).unwrap_err().to_string();
        assert!(error.contains(said), "{error}");
    }
    assert_eq!(printable("a\u{1b}[31mb\u{7}"), "a[31mb");
    assert_eq!(printable("a\r\nb\tc\nd"), "a b c d");
    let hidden = "\u{202a}\u{202b}\u{202c}\u{202d}\u{202e}\u{2066}\u{2067}\u{2068}\u{2069}\u{200b}\u{200d}\u{2060}\u{feff}\u{200e}\u{ad}";
    assert_eq!(printable(&format!("a{hidden}b \u{627}\u{3b1}")), "ab \u{627}\u{3b1}");
}

#[test]
fn packed_files_are_unpacked() {
    let mut packed = GzEncoder::new(Vec::new(), Compression::fast());
    packed.write_all(b"1\n2\n").unwrap();
    let packed = packed.finish().unwrap();
    assert_eq!(of(&packed, LARGEST).unwrap(), ("1\n2\n".into(), Some("unpacked from gzip".into())));
    for cut in 2..packed.len() {
        assert!(of(&packed[..cut], LARGEST).is_err(), "cut to {cut}");
    }
    let one = zipped(&[("dir/", ""), ("dir/a.at2", "1\n")]);
    assert_eq!(of(&one, LARGEST).unwrap(), ("1\n".into(), Some("dir/a.at2 from a zip".into())));
    let two = of(&zipped(&[("a.at2", "1"), ("b.at2", "2")]), LARGEST).unwrap_err().to_string();
    assert!(two.contains("a zip of 2 files (a.at2, b.at2); unpack it"), "{two}");
    assert!(of(&one[..one.len() - 9], LARGEST).is_err());
}

/// Of a gzip file that says so a thousandth lies on disk, and what a zip declares is not believed.
#[test]
fn what_is_packed_is_read_up_to_a_size() {
    let large = vec![b'1'; 3000];
    let mut gzip = GzEncoder::new(Vec::new(), Compression::fast());
    gzip.write_all(&large).unwrap();
    let gzip = gzip.finish().unwrap();
    let mut zip = zipped(&[("a.at2", &"1".repeat(3000))]);
    let plain = (b"1\n".repeat(1500), "1\n".repeat(1500));
    assert!(gzip.len() < 200 && of(&gzip, 3000).is_ok() && of(&zip, 3000).is_ok());
    assert_eq!(of(&plain.0, 3000).unwrap().0, plain.1);
    // The size in the directory, at 24 bytes from its beginning, is said to be 5.
    let directory = zip.windows(4).position(|bytes| bytes == b"PK\x01\x02").unwrap();
    for packed in [&gzip, &zip, &plain.0] {
        assert_eq!(of(packed, 2999), Err(RecordError::Large { most: 2999 }));
    }
    zip[directory + 24..directory + 28].copy_from_slice(&5_u32.to_le_bytes());
    assert!(of(&zip, 2999).is_err());
}
