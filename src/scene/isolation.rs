//! The isolated base.

use serde::{Deserialize, Serialize};

use super::range::Range;
use super::{SceneError, positive, within};

/// The base: what isolates it in each direction, and the masses of its plates.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Isolation {
    /// m_h, kg.
    pub plate_h: f64,
    /// m_v, kg.
    pub plate_v: f64,
    /// Bouc-Wen, (10a) and (11); `None` where the direction is locked.
    pub horizontal: Option<BoucWen>,
    /// Kelvin-Voigt, (10b); `None` where the direction is locked.
    pub vertical: Option<KelvinVoigt>,
}

/// Hysteretic horizontal isolation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct BoucWen {
    /// T_h of (19), s.
    pub t_h: Range,
    /// psi, post-yield over initial stiffness.
    pub psi: f64,
    /// xi_h, damping ratio.
    pub xi_h: f64,
    /// alpha_y of (21).
    pub alpha_y: f64,
    /// n of (11).
    pub n: u32,
}

/// Viscoelastic vertical isolation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct KelvinVoigt {
    /// T_v of (20), s.
    pub t_v: Range,
    /// xi_v, damping ratio.
    pub xi_v: f64,
}

/// The directions in which the base moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Directions {
    /// Horizontally and vertically.
    Dual,
    /// Horizontally only.
    Horizontal,
    /// Vertically only.
    Vertical,
    /// The block stands on the ground.
    None,
}

/// The base as written.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, clap::Args)]
#[serde(deny_unknown_fields)]
pub struct IsolationText {
    /// Directions in which the base moves; a locked one needs no period [default: dual]
    #[arg(long, value_name = "DIRECTIONS")]
    pub isolation: Option<Directions>,
    /// T_h: period of the horizontal isolation, s
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    pub t_h: Option<Range>,
    /// T_v: period of the vertical isolation, s
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    pub t_v: Option<Range>,
    /// psi: post-yield over initial stiffness, 0 to 1 [default: 0.25]
    #[arg(long, value_name = "PSI", allow_negative_numbers = true)]
    pub psi: Option<f64>,
    /// xi_h: horizontal damping ratio [default: 0.05]
    #[arg(long, value_name = "XI", allow_negative_numbers = true)]
    pub xi_h: Option<f64>,
    /// xi_v: vertical damping ratio [default: 0.1]
    #[arg(long, value_name = "XI", allow_negative_numbers = true)]
    pub xi_v: Option<f64>,
    /// alpha_y: yield displacement as a share of PGA_h/omega_h^2 [default: 0.1]
    #[arg(long, value_name = "A", allow_negative_numbers = true)]
    pub alpha_y: Option<f64>,
    /// n: exponent of the Bouc-Wen law, a whole number from 1 to 100 [default: 2]
    #[arg(long, value_name = "N")]
    pub bouc_wen_n: Option<u32>,
}

/// Least period that is still taken for an isolation, s.
const LEAST_PERIOD: f64 = 1.0e-4;

fn period(key: &'static str, given: Option<Range>) -> Result<Range, SceneError> {
    let Some(range) = given else {
        let problem = "missing; give it in seconds, or lock its direction by isolation";
        return Err(SceneError::new(key, problem));
    };
    positive(key, range.least())?;
    if range.least() < LEAST_PERIOD {
        let problem = format!(
            "{} s is too stiff to resolve; the least is {LEAST_PERIOD} s, or lock the direction",
            range.least()
        );
        return Err(SceneError::new(key, problem));
    }
    Ok(range)
}

fn unused(key: &'static str, given: bool, direction: &str) -> Result<(), SceneError> {
    if given {
        let problem =
            format!("means nothing where the {direction} direction is locked; leave it out");
        return Err(SceneError::new(key, problem));
    }
    Ok(())
}

/// A checked base with plates of `plate_h` and `plate_v` kg.
pub(super) fn check(
    text: &IsolationText,
    plate_h: f64,
    plate_v: f64,
) -> Result<Isolation, SceneError> {
    let directions = text.isolation.unwrap_or(Directions::Dual);
    let moves_h = matches!(directions, Directions::Dual | Directions::Horizontal);
    let moves_v = matches!(directions, Directions::Dual | Directions::Vertical);
    let mut horizontal = None;
    if moves_h {
        let n = text.bouc_wen_n.unwrap_or(2);
        if !(1..=100).contains(&n) {
            return Err(SceneError::new("bouc_wen_n", format!("{n} must lie between 1 and 100")));
        }
        horizontal = Some(BoucWen {
            t_h: period("t_h", text.t_h)?,
            psi: within("psi", text.psi.unwrap_or(0.25), 0.0, 1.0)?,
            xi_h: within("xi_h", text.xi_h.unwrap_or(0.05), 0.0, 10.0)?,
            alpha_y: positive("alpha_y", text.alpha_y.unwrap_or(0.1))?,
            n,
        });
    } else {
        unused("t_h", text.t_h.is_some(), "horizontal")?;
        unused("psi", text.psi.is_some(), "horizontal")?;
        unused("xi_h", text.xi_h.is_some(), "horizontal")?;
        unused("alpha_y", text.alpha_y.is_some(), "horizontal")?;
        unused("bouc_wen_n", text.bouc_wen_n.is_some(), "horizontal")?;
    }
    let mut vertical = None;
    if moves_v {
        vertical = Some(KelvinVoigt {
            t_v: period("t_v", text.t_v)?,
            xi_v: within("xi_v", text.xi_v.unwrap_or(0.1), 0.0, 10.0)?,
        });
    } else {
        unused("t_v", text.t_v.is_some(), "vertical")?;
        unused("xi_v", text.xi_v.is_some(), "vertical")?;
    }
    Ok(Isolation { plate_h, plate_v, horizontal, vertical })
}
