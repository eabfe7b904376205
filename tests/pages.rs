//! Every relative link of the pages leads to a file that exists, and its anchor to a heading of that page; paths of the
//! code that pages name exist; placeholders and tests stand only where the page for contributors says so.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)] // tests

use std::collections::HashMap;
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The Markdown files of the root, of docs and of its notes, and of the bench of a card.
fn pages() -> Vec<PathBuf> {
    let folders = ["", "docs", "docs/notes", "benches/card"].map(|folder| root().join(folder));
    let entries = folders.iter().flat_map(|folder| std::fs::read_dir(folder).unwrap());
    let paths = entries.map(|entry| entry.unwrap().path());
    let mut pages: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|ending| ending == "md")).collect();
    pages.sort();
    pages
}

/// The lines of a page outside of its fenced blocks.
fn prose(text: &str) -> Vec<&str> {
    let mut fenced = false;
    let mut lines = Vec::new();
    for line in text.lines() {
        if line.trim_start().starts_with("```") {
            fenced = !fenced;
        } else if !fenced {
            lines.push(line);
        }
    }
    lines
}

/// The targets of a text's links and pictures: `[words](target)`, code in backquotes left out.
fn targets(text: &str) -> Vec<String> {
    let mut targets = Vec::new();
    for line in prose(text) {
        let words: String = line.split('`').step_by(2).collect();
        for rest in words.split("](").skip(1) {
            targets.extend(rest.split(')').next().map(String::from));
        }
    }
    targets
}

/// The anchors of a page's headings, as GitHub makes them: letters, digits, `-` and `_` in lower case, blanks
/// as `-`; the second heading of the same words ends in -1.
fn anchors(text: &str) -> Vec<String> {
    let mut seen: HashMap<String, usize> = HashMap::new();
    let headings = prose(text).into_iter().filter_map(|line| {
        let words = line.trim_start_matches('#');
        (words.len() < line.len()).then(|| words.strip_prefix(' ')).flatten()
    });
    let mut anchors = Vec::new();
    for heading in headings {
        let kept = heading.trim().to_lowercase();
        let kept = kept.chars().filter(|c| c.is_alphanumeric() || [' ', '-', '_'].contains(c));
        let anchor: String = kept.map(|c| if c == ' ' { '-' } else { c }).collect();
        let earlier = seen.entry(anchor.clone()).or_default();
        anchors.push(if *earlier == 0 { anchor } else { format!("{anchor}-{earlier}") });
        *earlier += 1;
    }
    anchors
}

/// What is wrong with a page's links.
fn broken(page: &Path, text: &str) -> Vec<String> {
    let mut broken = Vec::new();
    for target in targets(text) {
        if target.contains("://") || target.starts_with("mailto:") {
            continue;
        }
        let (file, anchor) = target.split_once('#').unwrap_or((&target, ""));
        let path = if file.is_empty() { page.to_path_buf() } else { page.with_file_name(file) };
        if !path.exists() {
            broken.push(format!("{}: {target}: no such file", page.display()));
        } else if !anchor.is_empty() {
            let there = std::fs::read_to_string(&path).unwrap();
            if !anchors(&there).iter().any(|known| known == anchor) {
                broken.push(format!("{}: {target}: no such heading", page.display()));
            }
        }
    }
    broken
}

#[test]
fn links_lead_somewhere() {
    let pages = pages();
    assert!(pages.len() > 15, "{pages:?}");
    let broken: Vec<String> = pages
        .iter()
        .flat_map(|page| broken(page, &std::fs::read_to_string(page).unwrap()))
        .collect();
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

#[test]
fn a_link_that_leads_nowhere_is_found() {
    let page = root().join("docs").join("map.md");
    let text = "# A heading\n[one](gone.md) ![two](gone.png) [three](#no-heading) [four](../README.md#gone)\n";
    assert_eq!(broken(&page, text).len(), 4);
    let text = "[one](map.md) [two](https://example.org/x) `[three](gone.md)`\n```\n[four](gone.md)\n```\n";
    assert!(broken(&page, text).is_empty());
    let headings =
        "# The strip at very small T_v (9)\n## ζ, and more\n## ζ, and more\n#no heading\n";
    let expected = ["the-strip-at-very-small-t_v-9", "ζ-and-more", "ζ-and-more-1"];
    assert_eq!(anchors(headings), expected);
}

/// Each page of docs is reached from the README, through other pages or at once.
#[test]
fn every_page_is_linked() {
    let text = |page: &Path| std::fs::read_to_string(page).unwrap();
    let mut reached = vec![root().join("README.md")];
    let mut next = 0;
    while let Some(page) = reached.get(next).cloned() {
        next += 1;
        for target in targets(&text(&page)) {
            let file = target.split('#').next().unwrap_or_default();
            let path = page.with_file_name(file);
            let Ok(path) = path.canonicalize() else { continue };
            if path.extension().is_some_and(|ending| ending == "md") && !reached.contains(&path) {
                reached.push(path);
            }
        }
    }
    let reached: Vec<PathBuf> =
        reached.iter().filter_map(|page| page.canonicalize().ok()).collect();
    for page in pages() {
        assert!(
            reached.contains(&page.canonicalize().unwrap()),
            "{} is linked by no page",
            page.display()
        );
    }
}

/// What stands in backquotes and is a path of the repository: it has a slash, or is a folder of the root.
fn paths(text: &str) -> Vec<&str> {
    let roots = ["src", "shaders", "tests", "benches", "crates", "python"];
    let quoted = prose(text).into_iter().flat_map(|line| line.split('`').skip(1).step_by(2));
    quoted.filter(|words| roots.iter().any(|root| words.split('/').next() == Some(*root))).collect()
}

#[test]
fn paths_of_the_pages_on_the_code_exist() {
    for (page, least) in [("ARCHITECTURE.md", 30), ("TESTING.md", 30)] {
        let text = std::fs::read_to_string(root().join(page)).unwrap();
        let named = paths(&text);
        assert!(named.len() >= least, "{page} names {} paths", named.len());
        let dead: Vec<_> = named.iter().filter(|path| !root().join(path).exists()).collect();
        assert!(dead.is_empty(), "{page} names what is not there: {dead:?}");
    }
    assert_eq!(paths("`src/gone.rs` `--flag/x` src/x `crates`"), ["src/gone.rs", "crates"]);
}

/// What is to be filled in before a release.
const PLACEHOLDERS: [&str; 7] =
    ["<this repository>", "no public address", "TODO", "FIXME", "CHANGEME", "<your ", "<insert "];

/// Files of text below a folder that have a placeholder. What a build or a run makes is passed over.
fn with_placeholders(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() {
            let made = ["target", "topple-out", "topple-chart", "topple-ratios", "shared"];
            if !name.starts_with(".git") && !made.contains(&name.as_str()) {
                with_placeholders(&path, found);
            }
        } else if !path.ends_with(file!())
            && std::fs::read_to_string(&path)
                .is_ok_and(|text| PLACEHOLDERS.iter().any(|words| text.contains(words)))
        {
            found.push(path);
        }
    }
}

#[test]
fn placeholders_stand_where_the_page_for_contributors_says() {
    let page = std::fs::read_to_string(root().join("CONTRIBUTING.md")).unwrap();
    let line = page.lines().find(|line| line.starts_with("Placeholders stand in")).unwrap();
    let mut said: Vec<PathBuf> =
        line.split('`').skip(1).step_by(2).map(|path| root().join(path)).collect();
    let mut found = Vec::new();
    with_placeholders(root(), &mut found);
    said.sort();
    found.sort();
    assert_eq!(found, said);
}

/// Cargo runs no test in the `src` of these crates: their libraries are no test targets.
#[test]
fn tests_of_crates_stand_in_their_folder_tests() {
    let crates = std::fs::read_dir(root().join("crates")).unwrap();
    let mut paths: Vec<PathBuf> = crates.map(|own| own.unwrap().path().join("src")).collect();
    paths.push(root().join("python/src"));
    let mut files = 0;
    while let Some(path) = paths.pop() {
        if path.is_dir() {
            paths.extend(std::fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()));
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            let text = std::fs::read_to_string(&path).unwrap();
            assert!(!text.contains("#[cfg(test)]"), "{}", path.display());
            files += 1;
        }
    }
    assert!(files > 100, "{files} files");
}
