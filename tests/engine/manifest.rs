//! The manifest: it asks for a compiler that all locked dependencies can be built with.

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

use serde_json::Value;

/// Parts of a version: `1.95` and `1.95.0` are the same.
fn version(text: &str) -> [u32; 3] {
    let mut parts = text.split('.').map(|part| part.parse().unwrap());
    [(); 3].map(|()| parts.next().unwrap_or(0))
}

/// All crates that are locked, those of the Python package with them, which no build in the root fetches: Cargo fetches
/// what is missing, so tests that ask for them are run by their names alone.
fn packages() -> Vec<Value> {
    let manifest = concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml");
    let told = Command::new("rustc").arg("-vV").output().unwrap().stdout;
    let told = String::from_utf8(told).unwrap();
    let host = told.lines().find_map(|line| line.strip_prefix("host: ")).unwrap();
    // What other platforms need may not be here.
    let run = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--locked"])
        .args(["--filter-platform", host, "--manifest-path", manifest])
        .output()
        .unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let metadata: Value = serde_json::from_slice(&run.stdout).unwrap();
    let packages = metadata["packages"].as_array().unwrap();
    assert!(packages.len() > 50, "{} packages", packages.len());
    packages.clone()
}

#[test]
#[ignore = "needs the network: cargo test --test engine manifest:: -- --ignored"]
fn the_compiler_asked_for_is_new_enough_for_every_dependency() {
    let asked = version(env!("CARGO_PKG_RUST_VERSION"));
    for package in packages() {
        if let Some(needs) = package["rust_version"].as_str() {
            assert!(version(needs) <= asked, "{} needs Rust {needs}", package["name"]);
        }
    }
}

/// Licences under which a program with these crates can be given away under MIT with their texts.
const LICENCES: &str = "0BSD | Apache-2.0 | Apache-2.0 WITH LLVM-exception | BSD-2-Clause | BSD-3-Clause | BSL-1.0 | CC0-1.0 | \
    ISC | MIT | MIT-0 | OFL-1.1 | Ubuntu-font-1.0 | Unicode-3.0 | Zlib";

/// True where an SPDX expression of terms with AND, each in brackets or a choice with OR, can be kept by [`LICENCES`] alone.
/// Older manifests write a choice with a slash.
fn permits(expression: &str) -> bool {
    expression.split(" AND ").all(|term| {
        let term = term.trim_start_matches('(').trim_end_matches(')');
        let is_known = |choice: &str| LICENCES.split(" | ").any(|known| known == choice.trim());
        term.replace('/', " OR ").split(" OR ").any(is_known)
    })
}

#[test]
fn choices_of_licences_are_read() {
    for good in ["MIT", "GPL-3.0 OR MIT", "Unlicense/MIT", "(MIT OR Apache-2.0) AND Unicode-3.0"] {
        assert!(permits(good), "{good}");
    }
    for bad in ["GPL-3.0", "", "(MIT OR Apache-2.0) AND GPL-3.0", "MITX", "AGPL-3.0 OR MPL-2.0"] {
        assert!(!permits(bad), "{bad}");
    }
}

#[test]
#[ignore = "needs the network: cargo test --test engine manifest:: -- --ignored"]
fn every_dependency_has_a_permissive_licence_and_comes_from_the_registry() {
    let registry = "registry+https://github.com/rust-lang/crates.io-index";
    for package in packages() {
        let licence = package["license"].as_str().unwrap_or_default();
        assert!(permits(licence), "{}: the licence {licence:?}", package["name"]);
        let source = package["source"].as_str();
        assert!(source.is_none_or(|source| source == registry), "{}: {source:?}", package["name"]);
    }
}

/// The crates below some of the workspace's, of what runs and of what builds it: a line each, in `cargo tree`'s format.
fn tree(format: &str, arguments: &[&str]) -> Vec<String> {
    let run = Command::new(env!("CARGO"))
        .args(["tree", "--locked", "--edges", "normal,build"])
        .args(["--prefix", "none", "--format", format, "--manifest-path"])
        .arg(concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml"))
        .args(arguments)
        .output()
        .unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let told = String::from_utf8(run.stdout).unwrap();
    // What was told before is marked.
    told.lines().map(|line| line.trim_end_matches(" (*)").to_string()).collect()
}

/// A crate that both use is built once, in whichever order. Cargo fetches what is missing.
#[test]
#[ignore = "needs the network: cargo test --test engine manifest:: -- --ignored"]
fn the_command_and_the_python_package_share_what_is_built() {
    let features = |package: &str| -> BTreeMap<String, BTreeSet<String>> {
        let mut found: BTreeMap<_, BTreeSet<_>> = BTreeMap::new();
        for line in tree("{p}|{f}", &["-p", package]) {
            if let Some((name, features)) = line.split_once('|') {
                found.entry(name.into()).or_default().insert(features.into());
            }
        }
        found
    };
    let (command, python) = (features("topple-app"), features("topple-python"));
    let shared: Vec<_> = command.keys().filter(|name| python.contains_key(*name)).collect();
    assert!(shared.len() > 100, "{shared:?}");
    for name in shared {
        let problem = "name what one lacks in crates/features/Cargo.toml";
        assert_eq!(
            command[name], python[name],
            "features of {name}, command and Python: {problem}"
        );
    }
}

/// A library user without pictures, the page and the GPU builds none of their dependencies.
#[test]
fn each_crate_leaves_out_what_is_of_others() {
    let tree = |arguments: &[&str]| -> Vec<String> {
        let lines = tree("{p}", &[&["--offline"], arguments].concat());
        let name = |line: &String| Some(line.split_whitespace().next()?.to_string());
        lines.iter().filter_map(name).collect()
    };
    let command = ["anyhow", "clap", "ctrlc", "indicatif", "sysinfo"];
    let gpu = ["naga", "pollster", "wgpu"];
    let pictures = ["contour", "harfrust", "png", "skrifa", "tiny-skia"];
    let page = ["hyper", "tokio"];
    let holds = |tree: &[String], names: &[&str]| -> usize {
        names.iter().filter(|name| tree.iter().any(|known| known == *name)).count()
    };
    let none = (0, 0, 0, 0);
    for (arguments, expected) in [
        (&["-p", "topple", "--no-default-features"][..], none),
        (&["-p", "topple"][..], (0, gpu.len(), 0, 0)),
        (&["-p", "topple-studies"][..], none),
        (&["-p", "topple-pictures"][..], (0, 0, pictures.len(), 0)),
        (&["-p", "topple-app"][..], (command.len(), gpu.len(), pictures.len(), page.len())),
    ] {
        let tree = tree(arguments);
        assert!(tree.len() > 20, "{arguments:?}: {tree:?}");
        let of = |names: &[&str]| holds(&tree, names);
        assert_eq!((of(&command), of(&gpu), of(&pictures), of(&page)), expected, "{arguments:?}");
    }
}
