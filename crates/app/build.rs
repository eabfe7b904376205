//! Tells the command the commit that it is built from, and leaves the names of functions out of it. Both in a release build only:
//! a test build would be made anew for every commit.

use std::env;
use std::path::Path;
use std::process::Command;

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-env-changed=TOPPLE_SYMBOLS");
    let is = |key: &str, value: &str| env::var(key).is_ok_and(|text| text == value);
    if !is("PROFILE", "release") {
        return;
    }
    if let Some(commit) = commit() {
        println!("cargo:rustc-env=TOPPLE_COMMIT={commit}");
    }
    // The names are a sixth of the program; a profiler needs them: `TOPPLE_SYMBOLS=1 cargo build --release`. `strip` of the profile
    // has no effect on a package with settings of its own in the profile, as this one is. Elsewhere the names are in a file of
    // their own (Windows), or the linker is another one (macOS).
    if is("CARGO_CFG_TARGET_OS", "linux") && !is("TOPPLE_SYMBOLS", "1") {
        println!("cargo:rustc-link-arg-bins=-Wl,--strip-all");
    }
}

/// The commit of the checkout; none without git, or if the checkout is another project's.
fn commit() -> Option<String> {
    let asked = ["rev-parse", "--show-prefix", "--git-path", "logs/HEAD", "--short=12", "HEAD"];
    let said = Command::new("git").args(asked).output().ok()?;
    let said = String::from_utf8(said.stdout).ok().filter(|_| said.status.success())?;
    let [folder, log, commit] = said.lines().collect::<Vec<_>>().try_into().ok()?;
    if Path::new(folder) != Path::new("crates/app") {
        return None;
    }
    println!("cargo:rerun-if-changed={log}");
    Some(commit.to_string())
}
