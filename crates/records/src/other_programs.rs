//! Files of other programs, known by their first bytes: what they are, and what to do.

/// What to do with what Python packages read.
macro_rules! by_python {
    ($what:literal, $how:literal) => {
        concat!(
            $what,
            "; read it in Python (",
            $how,
            ") and give topple.seismic the array with dt and units"
        )
    };
}

/// What to do with what obspy reads.
macro_rules! by_obspy {
    ($what:literal) => {
        concat!(
            $what,
            "; in Python give topple.seismic(horizontal=obspy.read(\"FILE\"), units=...), or write its samples as text"
        )
    };
}

/// How files of other programs begin.
const BEGIN: [(&[u8], &str); 17] = [
    // The old format of Excel is an OLE file.
    (b"\xd0\xcf\x11\xe0", "a spreadsheet (.xls); save its sheet as CSV and give that"),
    (b"MS\x03", MINISEED),
    (b"MATLAB 5.0", by_python!("a file of MATLAB (.mat)", "scipy.io.loadmat")),
    // Since version 7.3 it is one of HDF5, with a text of its own before it.
    (b"MATLAB 7", by_python!("a file of MATLAB (.mat, 7.3)", "h5py.File")),
    (b"\x89HDF\r\n\x1a\n", by_python!("a file of HDF5", "h5py.File, or pyasdf of ASDF")),
    (b"\x93NUMPY", by_python!("an array of NumPy (.npy)", "numpy.load")),
    (b"PAR1", by_python!("a table of Parquet", "pandas.read_parquet")),
    (b"WID2 ", by_obspy!("GSE2")),
    (
        b"version https://git-lfs.github.com/spec/",
        "a pointer of Git LFS, not the file that it stands for; run git lfs pull, or download the file itself",
    ),
    (
        b"/annex/objects/",
        "a pointer of git-annex, not the file that it stands for; run git annex get",
    ),
    (b"[InternetShortcut]", "a shortcut to a page; download the file itself"),
    (b"{\\rtf", "a document (.rtf); save it as plain text"),
    (b"7z\xbc\xaf\x27\x1c", "a 7z archive; unpack it and give the file"),
    (b"Rar!\x1a\x07", "a RAR archive; unpack it and give the file"),
    (b"\xfd7zXZ\0", "packed by xz; unpack it and give the file"),
    (b"BZh", "packed by bzip2; unpack it and give the file"),
    (b"\x28\xb5\x2f\xfd", "packed by Zstandard; unpack it and give the file"),
];

const MINISEED: &str = by_obspy!("miniSEED");

/// Where a tape archive says what it is.
const TAPE: std::ops::Range<usize> = 257..262;

/// What a file of another program is, and what to do with it.
pub fn of(bytes: &[u8]) -> Option<&'static str> {
    // A record of miniSEED: a number of six digits, a kind, and a blank (SEED 2.4).
    let is_seed = bytes.len() >= 48
        && bytes[..6].iter().all(u8::is_ascii_digit)
        && matches!(bytes[6], b'D' | b'R' | b'Q' | b'M' | b'V')
        && bytes[7] == b' ';
    if is_seed {
        return Some(MINISEED);
    }
    if bytes.get(TAPE).is_some_and(|word| word == b"ustar") {
        return Some("a tar archive; unpack it and give the file");
    }
    BEGIN.iter().find(|(begins, _)| bytes.starts_with(begins)).map(|(_, what)| *what)
}

/// What a text of another kind is, and what to do with it: a page, XML, JSON, a list in brackets.
pub fn of_text(text: &str) -> Option<String> {
    let start: String = text.trim_start().chars().take(4096).collect();
    let start = start.to_ascii_lowercase();
    let is_tag = |letter: char| letter.is_ascii_alphabetic() || matches!(letter, '!' | '?');
    if start.strip_prefix('<').is_some_and(|rest| rest.starts_with(is_tag)) {
        if ["<!doctype html", "<html", "<head", "<body"].iter().any(|tag| start.contains(tag)) {
            let page = "a web page, not a record: perhaps what a site shows in place of the file (a login); download the file \
                        itself";
            return Some(page.into());
        }
        let kinds = [
            ("quakeml", "QuakeML, which describes earthquakes"),
            ("stationxml", "StationXML, which describes stations"),
        ];
        let kind =
            kinds.iter().find(|(word, _)| start.contains(word)).map_or("XML", |(_, kind)| kind);
        return Some(format!("{kind}, not a record; give the file of accelerations"));
    }
    // A list is closed at the end of the text; a name may stand before it, as a program's variable has one.
    let first = start.lines().next().unwrap_or_default();
    let (before, inner) = first.split_once(['[', '{', '('])?;
    let is_name = before.chars().all(|c| c.is_alphanumeric() || " _.=".contains(c));
    let inner = match inner.trim_start() {
        "" => start.split_once(['[', '{', '('])?.1.trim_start(),
        inner => inner,
    };
    let of_json = |c: char| matches!(c, '"' | '{' | '[' | '\'');
    let of_numbers = |c: char| c.is_ascii_digit() || matches!(c, '-' | '+' | '.' | '[' | '(');
    if !is_name
        || !text.trim_end().ends_with([']', '}', ')', ';'])
        || !inner.starts_with(|c| of_json(c) || of_numbers(c))
    {
        return None;
    }
    let is_json = start.starts_with('{') || inner.starts_with(['{', '"']);
    let kind = if is_json { "JSON" } else { "a list in brackets" };
    Some(format!("{kind}; write its values as text, one a line, without brackets and names"))
}

/// What a zip with files of these names is, and what to do with it.
pub fn of_zip(names: &[String]) -> Option<&'static str> {
    let has = |name: &str| names.iter().any(|one| one == name);
    if has("xl/workbook.xml") || has("xl/workbook.bin") {
        return Some("a spreadsheet (.xlsx); save its sheet as CSV and give that");
    }
    if has("content.xml") && has("META-INF/manifest.xml") {
        return Some("a document of LibreOffice (.ods); save its sheet as CSV and give that");
    }
    let is_array = |name: &String| name.ends_with(".npy");
    (!names.is_empty() && names.iter().all(is_array))
        .then_some(by_python!("arrays of NumPy (.npz)", "numpy.load"))
}
