//! The pictures of the pages: what draws each of them, and that none is older than the program.
//!
//! `TOPPLE_WRITE_PICTURES=1 cargo test --release --test app docs_pictures::` draws all of them anew for which there is what they
//! need, and says which are left; a word in the place of 1 draws those whose place contains it. Without it those that are drawn in seconds are drawn and compared.

use std::collections::{BTreeMap, BTreeSet};
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Deserialize;
use tempfile::TempDir;

use crate::common::picture::differing;

/// Pictures by their places in the repository, each with the file that is drawn, and the lines of a shell that draw them.
#[derive(Deserialize)]
struct Drawn {
    /// What they need beside the program, as data/pictures.toml says.
    needs: String,
    pictures: BTreeMap<String, String>,
    script: String,
}

impl Drawn {
    fn needs(&self, what: &str) -> bool {
        self.needs.contains(what)
    }
}

fn all() -> Vec<Drawn> {
    let mut read: BTreeMap<String, Vec<Drawn>> =
        toml::from_str(include_str!("../data/pictures.toml")).unwrap();
    read.remove("drawn").unwrap()
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

/// The pictures in a folder of the repository, by their places in it.
fn pictures(folder: &Path, found: &mut BTreeSet<String>) {
    for entry in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        let ending = entry.extension().unwrap_or_default().to_string_lossy().into_owned();
        if entry.is_dir() {
            pictures(&entry, found);
        } else if ["png", "gif", "svg", "jpg"].contains(&&*ending) {
            let place = entry.strip_prefix(root()).unwrap().to_string_lossy().replace('\\', "/");
            found.insert(place);
        }
    }
}

#[test]
fn what_draws_each_picture_is_known() {
    let mut found = BTreeSet::new();
    pictures(&root().join("docs"), &mut found);
    pictures(&root().join("python/examples"), &mut found);
    pictures(&root().join("crates/explore/src/page"), &mut found);
    // What the icon's PNG is made of.
    assert!(found.remove("crates/explore/src/page/icon.svg"));
    let all = all();
    let known = all.iter().flat_map(|drawn| drawn.pictures.keys().cloned());
    assert_eq!(known.collect::<BTreeSet<_>>(), found);
    // The command of a page that is drawn as it stands is the one that draws its picture.
    for (page, picture) in
        [("axes", "axes-size"), ("pulses", "pulses-modulated"), ("fragility", "fragility")]
    {
        let text = fs::read_to_string(root().join(format!("docs/{page}.md"))).unwrap();
        let plain = |text: &str| {
            text.replace(['\\', '\n', '\r'], " ").split_whitespace().collect::<Vec<_>>().join(" ")
        };
        let of = |drawn: &&Drawn| drawn.pictures.contains_key(&format!("docs/{picture}.png"));
        let script = all.iter().find(of).unwrap().script.replace("$RECORDS/suite", "records");
        assert!(plain(&text).contains(&plain(&script)), "{page}: {script}");
    }
}

/// The lines that draw pictures; those of a page as it has them.
fn script(drawn: &Drawn) -> String {
    match drawn.script.strip_prefix("PAGE ") {
        Some(page) => crate::first_hour::commands(&crate::first_hour::page(page)).join("\n"),
        None => drawn.script.clone(),
    }
}

/// Draws pictures into a folder; false where the shell does not end well.
fn draw(drawn: &Drawn, folder: &Path, records: Option<&Path>) -> bool {
    let program = crate::common::command::program();
    let others = env::var_os("PATH").unwrap_or_default();
    let folders = std::iter::once(program.parent().unwrap().to_path_buf());
    let path = env::join_paths(folders.chain(env::split_paths(&others))).unwrap();
    let mut shell = Command::new("sh");
    shell.args(["-e", "-c", &script(drawn)]).current_dir(folder).env("PATH", path);
    shell.env("ROOT", root()).env("TOPPLE_COMMAND", program);
    shell.env("RECORDS", records.unwrap_or(Path::new("")));
    let run = shell.output().unwrap();
    if !run.status.success() {
        println!("{}", String::from_utf8_lossy(&run.stderr));
    }
    run.status.success()
}

fn has_shell() -> bool {
    Command::new("sh").args(["-c", "exit 0"]).status().is_ok_and(|status| status.success())
}

fn apart(one: &Path, other: &Path) -> f64 {
    let [one, other] = [one, other].map(|file| fs::read(file).unwrap());
    differing(&one, &other)
}

/// Cells that differ between machines, and edges of letters.
const DIFFERING: f64 = 0.004;

#[test]
fn no_picture_is_older_than_the_program() {
    if !has_shell() {
        eprintln!("skipped: no shell that runs what draws the pictures");
        return;
    }
    let asked = env::var("TOPPLE_WRITE_PICTURES").ok();
    let writes = asked.is_some();
    let is_asked = |drawn: &Drawn| match asked.as_deref() {
        None | Some("1") => true,
        Some(word) => drawn.pictures.keys().any(|place| place.contains(word)),
    };
    let records = env::var_os("TOPPLE_RECORDS").map(PathBuf::from);
    let mut compared = 0;
    for drawn in &all() {
        let has_records = records.is_some() || !drawn.needs("records");
        let wanted = writes && has_records || drawn.needs("seconds");
        if !wanted || !is_asked(drawn) {
            continue;
        }
        let folder = TempDir::new().unwrap();
        let well = draw(drawn, folder.path(), records.as_deref());
        if !well {
            assert!(!drawn.needs("seconds"), "{}", drawn.script);
            eprintln!("not drawn, for what it needs is not here: {:?}", drawn.pictures.keys());
            continue;
        }
        for (place, file) in &drawn.pictures {
            let (kept, new) = (root().join(place), folder.path().join(file));
            // A picture that is as it was stays as it is.
            let is_old =
                !place.ends_with("png") || !kept.exists() || apart(&kept, &new) >= DIFFERING;
            if writes && is_old {
                fs::copy(&new, &kept).unwrap();
            }
            assert!(writes || !is_old, "{place} is older than the program");
            compared += 1;
        }
    }
    assert!(writes || compared >= 11, "{compared}");
}
