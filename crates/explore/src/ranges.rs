//! The ranges of the page's sliders and of its new axes: those that are of use for most blocks. Fields take any number.

use std::f64::consts::PI;

use serde::Serialize;
use topple::scene::Parameter;

/// A range of a slider.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Handy {
    /// Its first place.
    pub low: f64,
    /// Its last place.
    pub high: f64,
    /// Places lie evenly by the logarithm, or by the value.
    pub log: bool,
}

/// The range of a number.
pub fn handy(parameter: Parameter) -> Handy {
    use Parameter::{
        AH, AV, AlphaY, BoucWenN, Cycles, Eccentricity, Friction, Gamma, HalfWidth, Height,
        Inertia, K1, K2, Mass, Mu, Offset, Omega, Pga, Phase, PlateH, PlateV, Psi, Qd, Radius,
        Restitution, RestitutionFactor, Scale, Size, Slenderness, StaticDeflection, StopGap,
        StopStiffness, StopXi, TH, TMax, TV, Tilt, UY, VHardening, XiH, XiV, YieldForce,
    };
    let by = |log, low, high| Handy { low, high, log };
    let (even, log) = (|low, high| by(false, low, high), |low, high| by(true, low, high));
    match parameter {
        HalfWidth => log(0.02, 2.0),
        Height | Size => log(0.1, 10.0),
        Slenderness => log(1.0, 20.0),
        Mass => log(10.0, 1e5),
        Inertia => log(1.0, 1e6),
        Eccentricity => even(-0.8, 0.8),
        Offset => even(-0.5, 0.5),
        PlateH | PlateV => even(0.0, 2000.0),
        TH => even(0.2, 6.0),
        TV => even(0.05, 3.0),
        Psi => even(0.0, 1.0),
        XiH | XiV | StopXi | StaticDeflection => even(0.0, 0.5),
        AlphaY => log(0.01, 1.0),
        UY => log(0.001, 0.5),
        YieldForce => log(10.0, 1e5),
        BoucWenN => even(1.0, 9.0),
        K1 => log(1e3, 1e8),
        K2 => log(1e2, 1e7),
        Qd => log(10.0, 1e6),
        Radius => even(0.3, 6.0),
        Mu => even(0.01, 0.2),
        StopGap => even(0.02, 1.0),
        StopStiffness => log(1e4, 1e9),
        VHardening => log(0.005, 0.5),
        Omega => even(0.2, 20.0),
        AH => even(0.0, 20.0),
        AV => even(-10.0, 10.0),
        Cycles => even(0.5, 10.0),
        Gamma => even(1.0, 6.0),
        Phase => even(-PI, PI),
        Scale => log(0.1, 10.0),
        Pga => even(0.5, 20.0),
        TMax => even(5.0, 120.0),
        Tilt => even(-0.3, 0.3),
        Friction => log(0.05, 2.0),
        Restitution => even(0.3, 1.0),
        RestitutionFactor => even(0.5, 1.0),
    }
}
