//! `--save-scene`: what flags say, as a scene's file.

use std::io::Write;
use std::path::Path;

use topple::results::files::Directory;
use topple::scene::builder::SceneBuilder;
use topple::scene::record::keys::{Place, RECORD_KEYS};
use topple::scene::{FIRST, Parameter};

use super::InputError;
use super::print::print_line;
use super::words::Reporter;

/// Writes what flags say of a scene as a file that a command takes; `-` is the standard output. Paths of a record
/// are absolute there, for a file's are looked for from its own folder.
///
/// # Errors
/// A file that is there; axes in an order that a file cannot have; those of the disk.
pub fn save(path: &Path, mut scene: SceneBuilder, command: &str) -> anyhow::Result<()> {
    if let Some(record) = &mut scene.record {
        for key in &RECORD_KEYS {
            if let Place::File(of) = key.place
                && let Some(file) = of(record)
            {
                *file = std::path::absolute(&*file)?;
            }
        }
    }
    let refused =
        |reason: String| InputError(format!("--save-scene: {}: {reason}", path.display()));
    let text = scene.to_toml().map_err(refused)?;
    // Flags may come in any order, a file has them table by table.
    let again = SceneBuilder::from_toml(&text).map_err(refused)?;
    if axes(&again) != axes(&scene) {
        let problem = "in a file the axes would have another order; give the flags with several values of one section \
                       one after another";
        return Err(refused(problem.into()).into());
    }
    if path == Path::new("-") {
        print_line!("{}", text.trim_end());
        return Ok(());
    }
    let name = free(path)?;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = Directory::open(folder.unwrap_or(Path::new(".")));
    let folder = folder.map_err(|error| refused(error.to_string()))?;
    folder.write(name, |w| w.write_all(text.as_bytes()))?;
    let path = path.display();
    Reporter::unless(false).line("scene", format!("{path}; topple {command} {path} runs it"));
    Ok(())
}

/// The name of a new file, which is none of one that is there.
///
/// # Errors
/// A file that is there; a name that is none, or is no text.
pub fn free(path: &Path) -> Result<&str, InputError> {
    let refused = |problem| InputError(format!("--save-scene: {}: {problem}", path.display()));
    if path.symlink_metadata().is_ok() {
        return Err(refused("is there already; give another name, or remove it"));
    }
    let name = path
        .file_name()
        .ok_or_else(|| refused("no name of a file; give one, such as scene.toml"))?;
    name.to_str().ok_or_else(|| refused("the name is no text (UTF-8); give another one"))
}

/// The numbers of several values, in their order.
fn axes(scene: &SceneBuilder) -> Vec<Parameter> {
    let swept = scene.numbers.iter().filter(|(_, values)| values.count() > 1);
    swept.map(|(parameter, _)| parameter).filter(|parameter| !FIRST.contains(parameter)).collect()
}
