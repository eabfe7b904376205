//! Scenes from files.

use std::io::ErrorKind;
use std::path::Path;

use topple::scene::builder::SceneBuilder;
use topple::scene::record::read::format_of;
use topple::scene::{Scene, bounded};

use super::InputError;
use super::words::with_keys;

/// What only a figure's file has.
pub const FIGURE: &str = "[[panel]]";

/// Largest scene file that is read, bytes.
const LARGEST: u64 = 1 << 20;

/// The scene of a file; a record's files are looked for from its folder.
pub fn load(path: &Path, force: bool) -> Result<Scene, InputError> {
    check(path, &given(path, force)?)
}

/// Checks what a file gives of a scene.
pub fn check(path: &Path, given: &SceneBuilder) -> Result<Scene, InputError> {
    let directory = path.parent().unwrap_or(Path::new(""));
    given.check_in(directory).map_err(|error| refused(path, with_keys(&error.to_string())))
}

/// What a file gives of a scene, unchecked.
pub fn given(path: &Path, force: bool) -> Result<SceneBuilder, InputError> {
    let refused = |reason| refused(path, reason);
    let text = read(path).map_err(refused)?;
    if let Some(format) = format_of(&text) {
        return Err(refused(format!(
            "a record ({format}), not a scene; give it to topple seismic --horizontal"
        )));
    }
    if text.contains(FIGURE) {
        let problem = "this is a figure of several panels; run it by topple figures --scenes";
        return Err(refused(problem.into()));
    }
    let mut scene = SceneBuilder::from_toml(&text).map_err(refused)?;
    scene.force |= force;
    Ok(scene)
}

fn refused(path: &Path, reason: String) -> InputError {
    InputError(format!("{}: {reason}", path.display()))
}

/// Reads a scene's file.
pub fn read(path: &Path) -> Result<String, String> {
    bounded::text(path, LARGEST).map_err(|error| match error.kind() {
        ErrorKind::FileTooLarge => format!("{error}; this is no scene"),
        _ => format!("{error}; give a scene that can be read"),
    })
}
