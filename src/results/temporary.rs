//! Names of what is not whole yet, or is going, in a run's directory: so exact that nobody else's file has one.

/// How all of them begin.
const BEGINS: &str = ".topple-";
/// How those of files end.
const FILE: &str = ".part";
/// The file in which a run says which files it is about to write, until its run.json says which it wrote.
pub const ABOUT_TO_WRITE: &str = ".topple-about-to-write.json";
/// Letters and digits before that, which no two files have alike.
pub const RANDOM: usize = 6;

/// What a file's temporary name begins and ends with; [`RANDOM`] letters stand between.
pub fn file(name: &str) -> (String, &'static str) {
    (format!("{BEGINS}{}.", name.replace('/', "-")), FILE)
}

/// True for a file's temporary name.
pub fn is_file(name: &str) -> bool {
    let inner = name.strip_prefix(BEGINS).and_then(|rest| rest.strip_suffix(FILE));
    let parts = inner.and_then(|inner| inner.rsplit_once('.'));
    parts.is_some_and(|(name, random)| {
        !name.is_empty()
            && random.len() == RANDOM
            && random.bytes().all(|letter| letter.is_ascii_alphanumeric())
    })
}

/// The name of a folder while it is written.
pub fn begun(folder: &str) -> String {
    format!("{BEGINS}{folder}.new")
}

/// That of a folder which is not needed any more.
pub fn aside(folder: &str) -> String {
    format!("{BEGINS}{folder}.old")
}

/// That of the lock of a folder, which lies beside it.
pub fn lock(folder: &str) -> String {
    format!("{BEGINS}{folder}.lock")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_names_that_a_run_gives_are_temporary() {
        for name in ["map.csv", "zeta/c/0/0"] {
            let (before, after) = file(name);
            assert!(is_file(&format!("{before}aB3xY9{after}")), "{name}");
        }
        for name in [
            ".topple-notes",
            ".topple-thesis.backup",
            ".topple-map.csv.part",
            ".topple-map.csv.aB3xY.part",
            ".topple-map.csv.aB3x-9.part",
            ".topple-.aB3xY9.part",
            "topple-map.csv.aB3xY9.part",
            ".topple-map.csv.aB3xY9.part.txt",
            &aside("map.zarr"),
            &begun("map.zarr"),
            &lock("unfinished"),
        ] {
            assert!(!is_file(name), "{name}");
        }
    }
}
