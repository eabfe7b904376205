//! The reference's word on what is in view.

use std::sync::atomic::AtomicBool;
use std::time::Duration;

use serde::Deserialize;
use serde_json::{Value, json};

use super::asked::{AskedPrecision, Flat};
use super::refused::Refused;
use super::session::Session;
use super::stages::at_most;
use super::view::sweep;
use topple::sweep::settings::VerifySettings;
use topple::sweep::verdict;

/// A request for the reference's word.
#[derive(Debug, Clone, Deserialize)]
pub struct VerifyRequest {
    /// The scene.
    pub scene: Flat,
    /// Cells along each axis.
    pub count: [u32; 2],
    /// Cells that the reference runs again.
    pub cells: usize,
    /// Number type.
    #[serde(default)]
    pub precision: AskedPrecision,
}

/// Time that the reference has.
const WITHIN: Duration = Duration::from_secs(20);
/// Cells at most.
const MOST: usize = 4096;
/// Cells along an axis at most: so many are swept again for it.
const SIDE: u32 = 513;

/// Sweeps a view and has the reference run a sample of it.
pub fn run(
    session: &Session,
    request: &VerifyRequest,
    stop: &AtomicBool,
) -> Result<Value, Refused> {
    let count = at_most(&request.scene, request.count, SIDE)?;
    let ready = session.ready(&request.scene, count, request.precision)?;
    let map = sweep(&ready, stop)?;
    let settings = VerifySettings { cells: request.cells.clamp(1, MOST), within: WITHIN };
    let told = map.verify(&settings, stop)?;
    Ok(json!({
        "sampled": told.sampled,
        "differ": told.differ,
        "unresolved": told.unresolved,
        "verdict": told.verdict,
        "precision": ready.settings.method.precision,
        "line": format!("{}: {}", verdict::told(&told), verdict::agreement(&told, WITHIN)),
    }))
}
