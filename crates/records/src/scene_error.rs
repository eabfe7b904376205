//! What is wrong with a key of a scene.

/// What is wrong with a scene: the key (a flag of the same name on the command line), and one
/// clause that says the fault and the remedy.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{key}: {problem}")]
pub struct SceneError {
    /// The key at fault, as written in TOML: `t_h`.
    pub key: &'static str,
    /// The fault and the remedy.
    pub problem: String,
}

impl SceneError {
    /// That of a key: what is wrong, and what to do.
    pub fn new(key: &'static str, problem: impl Into<String>) -> SceneError {
        SceneError { key, problem: problem.into() }
    }

    /// The flag of the same name: `--t-h`.
    pub fn flag(&self) -> String {
        format!("--{}", self.key.replace('_', "-"))
    }
}

/// How what is improbable is accepted.
pub const ACCEPTED: &str = "`force` accepts it";
