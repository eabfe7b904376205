//! Packed files.

use std::io::{Cursor, Write};

use flate2::Compression;
use flate2::write::GzEncoder;
use topple_records::RecordError;
use topple_records::packed::unpacked;
use topple_records::text::LARGEST;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

fn of(bytes: &[u8], most: u64) -> Result<(String, Option<String>), RecordError> {
    let (bytes, note) = unpacked(bytes, most)?;
    Ok((String::from_utf8_lossy(&bytes).into_owned(), note))
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
