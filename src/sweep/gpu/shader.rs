//! The shader's text, put together from `shaders/`.

use super::super::backend::Precision;

/// The files of a shader in order, with their names; the first one sets the number type.
pub fn files(precision: Precision) -> [(&'static str, &'static str); 11] {
    let real = match precision {
        Precision::F32 => ("real_f32.wgsl", include_str!("../../../shaders/real_f32.wgsl")),
        Precision::F64 => ("real_f64.wgsl", include_str!("../../../shaders/real_f64.wgsl")),
    };
    [
        real,
        ("block.wgsl", include_str!("../../../shaders/block.wgsl")),
        ("excitation.wgsl", include_str!("../../../shaders/excitation.wgsl")),
        ("isolation.wgsl", include_str!("../../../shaders/isolation.wgsl")),
        ("dynamics.wgsl", include_str!("../../../shaders/dynamics.wgsl")),
        ("impact.wgsl", include_str!("../../../shaders/impact.wgsl")),
        ("rk4.wgsl", include_str!("../../../shaders/rk4.wgsl")),
        ("state.wgsl", include_str!("../../../shaders/state.wgsl")),
        ("locate.wgsl", include_str!("../../../shaders/locate.wgsl")),
        ("switching.wgsl", include_str!("../../../shaders/switching.wgsl")),
        ("sweep.wgsl", include_str!("../../../shaders/sweep.wgsl")),
    ]
}

/// The whole text.
pub fn source(precision: Precision) -> String {
    files(precision).map(|(_, text)| text).join("\n")
}
