//! The commands of pages, run in their order in an empty directory, and the files that the page names.

/// The pages of docs whose commands stand alone.
const PAGES: [&str; 3] = ["first-hour", "compare", "report"];

/// Endings of the files that a page may name.
const ENDINGS: [&str; 9] =
    [".csv", ".npz", ".png", ".svg", ".json", ".toml", ".at2", ".html", ".pdf"];

pub fn page(name: &str) -> String {
    let path = format!("{}/../../docs/{name}.md", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).unwrap().replace("\r\n", "\n")
}

/// The commands of the page's `sh` blocks; one that goes on after a backslash is one command.
pub fn commands(page: &str) -> Vec<String> {
    let mut commands = Vec::new();
    let mut inside = false;
    let mut command = String::new();
    for line in page.lines() {
        if line.starts_with("```") {
            inside = line == "```sh";
        } else if inside {
            match line.strip_suffix('\\') {
                Some(part) => command.push_str(part),
                None => commands.push(std::mem::take(&mut command) + line),
            }
        }
    }
    commands
}

/// The results that the page's text names in backquotes: `first/map.png`.
fn files(page: &str) -> Vec<&str> {
    let text = page.lines().filter(|line| !line.starts_with("```"));
    let quoted = text.flat_map(|line| line.split('`').skip(1).step_by(2));
    let named = quoted.filter(|word| !word.contains(' '));
    named.filter(|word| ENDINGS.iter().any(|ending| word.ends_with(ending))).collect()
}

#[test]
fn the_page_has_commands_and_files() {
    let page = page(PAGES[0]);
    let commands = commands(&page);
    assert!(commands.len() >= 12, "{commands:#?}");
    assert!(commands.iter().all(|command| !command.contains('\\')), "{commands:#?}");
    let files = files(&page);
    for name in ["first/map.png", "cell/history.csv", "record/contact.png", "dual/map.png"] {
        assert!(files.contains(&name), "{name}: {files:?}");
    }
}

/// A map on a page is small, so that the test is quick.
#[test]
fn the_grids_of_the_pages_are_small() {
    for command in PAGES.iter().flat_map(|name| commands(&page(name))) {
        for word in command.split_whitespace() {
            let parts: Vec<&str> = word.split(':').collect();
            if let [_, _, count] = parts[..]
                && let Ok(count) = count.parse::<u32>()
            {
                assert!(count <= 60, "{command}");
            }
        }
    }
}

#[cfg(not(unix))]
#[test]
fn the_commands_of_the_pages_work() {
    println!("SKIPPED: there is no sh to run the pages' commands");
}

#[cfg(unix)]
#[test]
fn the_commands_of_the_pages_work() {
    PAGES.iter().for_each(|name| runs(name));
}

/// Runs the commands of a page, and looks for its files.
#[cfg(unix)]
fn runs(name: &str) {
    let directory = tempfile::TempDir::new().unwrap();
    let programs = directory.path().join("programs");
    let work = directory.path().join("work");
    std::fs::create_dir(&programs).unwrap();
    std::fs::create_dir(&work).unwrap();
    std::os::unix::fs::symlink(env!("CARGO_BIN_EXE_topple"), programs.join("topple")).unwrap();
    let mut path = programs.into_os_string();
    path.push(":");
    path.push(std::env::var_os("PATH").unwrap());
    let page = page(name);
    let commands = commands(&page);
    assert!(commands.len() > 3, "{name}: {commands:#?}");
    for command in commands {
        let run = std::process::Command::new("sh")
            .args(["-c", &command])
            .current_dir(&work)
            .env("PATH", &path)
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&run.stdout);
        let error = String::from_utf8_lossy(&run.stderr);
        assert!(run.status.success(), "{command}\n{said}\n{error}");
    }
    for name in files(&page) {
        let file = work.join(name);
        let length = std::fs::metadata(&file).map(|metadata| metadata.len()).unwrap_or(0);
        assert!(length > 0, "{name} is on the page, and not made by its commands");
    }
}
