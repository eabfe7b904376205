use std::fs;

use serde_json::json;
use topple::results::columns::{ColumnKind, TABLE};
use topple::results::files::Directory;
use topple_explore::export::{COLUMNS, ExportError, earlier, index, scenes, write};

use crate::flat;

#[test]
fn the_page_says_what_it_may_load() {
    let text = index();
    assert!(text.contains("default-src 'self'") && !text.contains("frame-ancestors"));
}

#[test]
fn stored_columns_are_columns_of_numbers_and_codes() {
    for name in COLUMNS {
        let entry = TABLE.iter().find(|entry| entry.name == name);
        // A time that a cell has not is no number, which the page tells apart by its column.
        assert!(entry.is_some_and(|entry| entry.kind != ColumnKind::Time), "{name}");
    }
}

#[test]
fn the_first_stored_map_is_the_first_scenes() {
    let first = flat("isolation=vertical t_v=0.5 omega=1:2");
    let scenes = scenes(&first);
    assert_eq!(scenes[0].1, first);
    let ground = &scenes.iter().find(|(title, _)| title == "on the ground").unwrap().1;
    assert_eq!(*ground, flat("isolation=none omega=1:2"));
    assert_eq!(scenes.len(), 4);
}

#[test]
fn a_folder_of_other_files_is_left_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    assert!(earlier(&path.join("none")).unwrap().is_empty());
    assert!(earlier(path).unwrap().is_empty());
    fs::write(path.join("thesis.tex"), "mine").unwrap();
    assert!(matches!(earlier(path), Err(ExportError::Occupied(_))));
    let names = ["about.json", "../thesis.tex", "/etc/passwd"];
    let list = json!({ "files": names });
    fs::write(path.join("export.json"), list.to_string()).unwrap();
    assert!(matches!(earlier(path), Err(ExportError::Occupied(_))));
    let list = json!({ "page": "topple explore", "files": names });
    fs::write(path.join("export.json"), list.to_string()).unwrap();
    assert_eq!(earlier(path).unwrap(), ["about.json"]);
}

/// Of an earlier export goes what it wrote, and nothing is overwritten that it did not.
#[test]
fn an_export_writes_over_its_own_files_alone() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let file = |name: &str| (name.to_string(), name.as_bytes().to_vec());
    let out = || Directory::open(path).unwrap();
    fs::write(path.join(".topple-export.json.aB3xY9.part"), "half").unwrap();
    let begun = earlier(path).unwrap();
    write(&out(), &begun, &[file("index.html"), file("old/page.html")]).unwrap();
    assert!(!path.join(".topple-export.json.aB3xY9.part").exists());
    fs::write(path.join("thesis.tex"), "mine").unwrap();
    let mut listed = earlier(path).unwrap();
    listed.push("thesis.tex".into());
    write(&out(), &listed, &[file("index.html")]).unwrap();
    assert!(!path.join("old/page.html").exists());
    assert_eq!(fs::read(path.join("thesis.tex")).unwrap(), b"mine");
    fs::write(path.join("sweep.wgsl"), "mine").unwrap();
    let refused = write(&out(), &earlier(path).unwrap(), &[file("sweep.wgsl")]);
    assert!(matches!(refused, Err(ExportError::Occupied(_))));
    assert_eq!(fs::read(path.join("sweep.wgsl")).unwrap(), b"mine");
}
