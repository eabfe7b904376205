//! The text of the shader, joined from the files in `shaders/`.

use crate::model::precision::Precision;

/// Whether a shader keeps the first switches of each cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Switches {
    /// The switches are not kept, as in any sweep.
    Forgotten,
    /// The switches are kept, for a chart or a test.
    Kept,
}

/// The files of a shader in order, with their names; the first file defines the number type.
pub fn files(precision: Precision, switches: Switches) -> [(&'static str, &'static str); 28] {
    let real = match precision {
        Precision::F32 => ("real_f32.wgsl", include_str!("../../../shaders/real_f32.wgsl")),
        Precision::F64 => ("real_f64.wgsl", include_str!("../../../shaders/real_f64.wgsl")),
    };
    let log = match switches {
        Switches::Forgotten => ("quiet.wgsl", include_str!("../../../shaders/quiet.wgsl")),
        Switches::Kept => ("log.wgsl", include_str!("../../../shaders/log.wgsl")),
    };
    [
        real,
        ("block.wgsl", include_str!("../../../shaders/block.wgsl")),
        ("excitation.wgsl", include_str!("../../../shaders/excitation.wgsl")),
        ("motion.wgsl", include_str!("../../../shaders/motion.wgsl")),
        ("pulse.wgsl", include_str!("../../../shaders/pulse.wgsl")),
        ("isolation.wgsl", include_str!("../../../shaders/isolation.wgsl")),
        ("dynamics.wgsl", include_str!("../../../shaders/dynamics.wgsl")),
        ("impact.wgsl", include_str!("../../../shaders/impact.wgsl")),
        ("rk4.wgsl", include_str!("../../../shaders/rk4.wgsl")),
        ("state.wgsl", include_str!("../../../shaders/state.wgsl")),
        log,
        ("guards.wgsl", include_str!("../../../shaders/guards.wgsl")),
        ("forcing.wgsl", include_str!("../../../shaders/forcing.wgsl")),
        ("extremes.wgsl", include_str!("../../../shaders/extremes.wgsl")),
        ("cubic.wgsl", include_str!("../../../shaders/cubic.wgsl")),
        ("search.wgsl", include_str!("../../../shaders/search.wgsl")),
        ("crossing.wgsl", include_str!("../../../shaders/crossing.wgsl")),
        ("span.wgsl", include_str!("../../../shaders/span.wgsl")),
        ("switching.wgsl", include_str!("../../../shaders/switching.wgsl")),
        ("certificate.wgsl", include_str!("../../../shaders/certificate.wgsl")),
        ("early_rest.wgsl", include_str!("../../../shaders/early_rest.wgsl")),
        ("turn.wgsl", include_str!("../../../shaders/turn.wgsl")),
        ("sweep.wgsl", include_str!("../../../shaders/sweep.wgsl")),
        ("tile.wgsl", include_str!("../../../shaders/tile.wgsl")),
        ("shared_contact.wgsl", include_str!("../../../shaders/shared_contact.wgsl")),
        ("shared_friction.wgsl", include_str!("../../../shaders/shared_friction.wgsl")),
        ("at_rest.wgsl", include_str!("../../../shaders/at_rest.wgsl")),
        ("begin.wgsl", include_str!("../../../shaders/begin.wgsl")),
    ]
}

/// The whole text.
pub fn source(precision: Precision, switches: Switches) -> String {
    files(precision, switches).map(|(_, text)| text).join("\n")
}
