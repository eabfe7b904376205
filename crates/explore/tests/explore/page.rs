use std::fs;
use std::path::{Path, PathBuf};

use topple_explore::page::{Engine, FILES, index, served};

#[test]
fn the_page_names_its_engine_and_the_modules_that_it_runs() {
    let names = |text: &str, path: &str| text.contains(&format!("modulepreload\" href=\"{path}\""));
    let pages = [
        (Engine::Server, "server", &["gpu/engine.js", "gpu/known.js"][..]),
        (Engine::WebGpu, "webgpu", &["server.js"]),
    ]
    .map(|(engine, word, others)| {
        let text = index(engine, "<meta name=\"more\">\n");
        assert_eq!(text.matches("<meta name=\"topple-engine\"").count(), 1);
        assert!(text.contains(&format!("content=\"{word}\"")) && text.contains("\"more\""));
        assert!(others.iter().all(|path| !names(&text, path)), "{engine:?}");
        for path in ["main.js", "engine.js", "frames.js"] {
            assert!(names(&text, path), "{engine:?} {path}");
        }
        text
    });
    for file in FILES.iter().filter(|file| file.path.ends_with(".js")) {
        assert!(pages.iter().any(|page| names(page, file.path)), "{}", file.path);
    }
    assert_eq!(served("").unwrap().1, index(Engine::Server, "").as_bytes());
}

fn files_in(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() { files_in(&path, found) } else { found.push(path) }
    }
}

#[test]
fn every_file_of_the_folder_is_served() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/page");
    let mut found = Vec::new();
    files_in(&folder, &mut found);
    let mut names: Vec<String> = found
        .iter()
        .map(|path| path.strip_prefix(&folder).unwrap().to_str().unwrap().replace('\\', "/"))
        .collect();
    names.sort();
    let mut served: Vec<&str> = FILES.iter().map(|file| file.path).collect();
    served.sort_unstable();
    assert_eq!(names, served);
}
