use std::path::Path;

use topple_explore::records::{Records, plain_name};

#[test]
fn a_name_leads_nowhere_else() {
    for (name, plain) in [
        ("../../etc/passwd", "passwd"),
        ("C:\\records\\h.at2", "h.at2"),
        ("..", "record"),
        ("a\0b.txt", "ab.txt"),
        ("H+90 (1).AT2", "H+90 (1).AT2"),
        ("", "record"),
        ("nul", "record-nul"),
        ("Aux .v2", "record-Aux .v2"),
        ("com1.txt", "record-com1.txt"),
        ("com0.txt", "com0.txt"),
        ("console.txt", "console.txt"),
    ] {
        assert_eq!(plain_name(name), plain);
    }
}

#[test]
fn a_file_is_kept_once_and_another_of_its_name_beside_it() {
    let records = Records::default();
    assert_eq!(records.add("h.at2", b"one").unwrap(), "h.at2");
    assert_eq!(records.add("h.at2", b"one").unwrap(), "h.at2");
    assert_eq!(records.add("x/h.at2", b"two").unwrap(), "2-h.at2");
    // The word of the pair that is made.
    assert_eq!(records.add("synthetic", b"two").unwrap(), "2-synthetic");
    let long = "\u{6f22}".repeat(128);
    assert!(records.add(&long, b"one").unwrap().len() <= 256);
    assert_eq!(records.know("a/rec.txt".as_ref()), "rec.txt");
    assert_eq!(records.know("b/rec.txt".as_ref()), "2-rec.txt");
    assert_eq!(records.know("a/rec.txt".as_ref()), "rec.txt");
}

#[test]
fn the_folder_of_dropped_files_goes() {
    let records = Records::default();
    let id = records.add("h.at2", b"one").unwrap();
    assert_eq!(records.written(id.as_ref()), id.as_ref() as &Path);
    let folder = records.folder().unwrap();
    assert!(folder.join("h.at2").exists());
    records.forget();
    assert!(!folder.exists());
}
