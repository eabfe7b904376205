//! Files that are held as a whole, up to a size.

use std::io;

use topple_records::bounded::{all, opened, read, size, unicode};

#[test]
fn what_is_larger_or_has_no_end_is_refused() {
    assert_eq!(all(&[7; 10][..], 10).unwrap(), [7; 10]);
    let refused = all(io::repeat(7), 3 << 20).unwrap_err();
    assert_eq!(refused.kind(), io::ErrorKind::FileTooLarge);
    assert_eq!(refused.to_string(), "larger than 3 MiB");
    assert_eq!([2 << 30, 1000].map(size), ["2 GiB", "1000 bytes"]);
}

#[cfg(unix)]
#[test]
fn a_pipe_without_a_writer_is_refused_after_a_while() {
    use std::io::Write;
    use std::os::fd::AsRawFd;
    use std::time::Duration;
    let place = tempfile::tempdir().unwrap();
    // Who waited for the first one in vain still does, and would take what is written to it.
    let [path, other] = ["pipe", "other"].map(|name| place.path().join(name));
    let made = std::process::Command::new("mkfifo").args([&path, &other]).status();
    assert!(made.unwrap().success());
    let error = opened(&other, Duration::from_millis(50)).unwrap_err();
    assert_eq!(error.kind(), io::ErrorKind::TimedOut);
    let writer = path.clone();
    let written = std::thread::spawn(move || std::fs::write(writer, "1\n2"));
    assert_eq!(read(&path, 10).unwrap(), b"1\n2");
    written.join().unwrap().unwrap();
    // A pipe of a shell, `<(...)`, has a number for a name.
    let (reader, mut writer) = io::pipe().unwrap();
    writer.write_all(b"3").unwrap();
    drop(writer);
    let path = format!("/dev/fd/{}", reader.as_raw_fd());
    assert_eq!(read(path.as_ref(), 10).unwrap(), b"3");
}

#[test]
fn what_a_shell_of_windows_writes_is_text() {
    let text = "title = \"ä\"\r\n";
    let marked: Vec<u16> = std::iter::once(0xfeff).chain(text.encode_utf16()).collect();
    for order in [u16::to_le_bytes, u16::to_be_bytes] {
        let bytes: Vec<u8> = marked.iter().copied().flat_map(order).collect();
        assert_eq!(unicode(&bytes).as_deref(), Some(text));
    }
    assert_eq!(unicode(format!("\u{feff}{text}").as_bytes()).as_deref(), Some(text));
    assert_eq!(unicode(text.as_bytes()).as_deref(), Some(text));
    assert_eq!(unicode(b"title = \"\xe4\""), None);
}
