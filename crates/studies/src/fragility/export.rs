//! Fragilities for other programs: OpenQuake's NRML 0.5 and pelicun's table of damage parameters.

use std::io::{self, Write};

use serde::{Deserialize, Serialize};

use super::curve::Lognormal;
use super::hazard_openquake::unit_of_openquake;
use super::limit_state::LimitState;
use super::order::implies;
use super::study::FragilityStudy;
use crate::study::StudyExport;
use crate::suites::intensity::Intensity;
use crate::table;
use topple::Written;
use topple::scene::SceneError;

topple::written! {
    /// A format of another program.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
    pub enum Export {
        /// The fragility model of OpenQuake, NRML 0.5 (openquake.risklib.read_nrml, version 3.26): lognormal functions by the mean and
        /// the standard deviation of the level itself, in OpenQuake's units.
        Nrml = "nrml",
        /// The damage parameters of pelicun (version 3.10): a component in each row, with the medians and the deviations of its limit states.
        Pelicun = "pelicun",
    }
}

/// The deviation of ln(level) that a step is written with: other programs divide by it.
pub const STEP: f64 = 0.01;

/// Deviations of ln(level) below and above the median where the levels of a function of OpenQuake end. Weaker motions make none
/// fail there, though they are many, so that little may be missing: 6e-16. For stronger motions it takes the probability at
/// the end, of which 3e-5 are missing; an end further up would be at levels that no motion has.
const FAR_BELOW: f64 = 8.0;
/// See [`FAR_BELOW`].
const FAR_ABOVE: f64 = 4.0;

impl Export {
    /// The name of its file.
    pub fn file(self) -> &'static str {
        match self {
            Export::Nrml => "fragility.xml",
            Export::Pelicun => "fragility_pelicun.csv",
        }
    }

    /// Refuses a measure that the other program has not.
    ///
    /// # Errors
    /// The key `export`.
    pub fn check(self, measure: Intensity) -> Result<(), SceneError> {
        let has = match self {
            Export::Nrml => unit_of_openquake(measure).is_some(),
            Export::Pelicun => demand(measure).is_some(),
        };
        if has {
            return Ok(());
        }
        let problem = format!("{} has no {measure}; give pga, pgv or sa:T", self.key());
        Err(SceneError::new("export", problem))
    }

    /// The file of the curves of a study by its first estimator.
    pub fn writer(&self) -> StudyExport<FragilityStudy> {
        match self {
            Export::Nrml => (self.file(), write_nrml),
            Export::Pelicun => (self.file(), write_pelicun),
        }
    }

    /// True where a study has nothing for it: in each cell a limit state has no curve.
    pub fn is_empty(self, study: &FragilityStudy) -> bool {
        self.left_out(study).1 == study.cells.len()
    }

    /// What of a study is in no row or function: limit states that do not follow each other, and how many cells have a limit state
    /// without a curve.
    pub fn left_out(self, study: &FragilityStudy) -> (Vec<LimitState>, usize) {
        let chains = chains(&study.settings.states);
        let written = match self {
            Export::Nrml => &chains[..1],
            Export::Pelicun => &chains[..],
        };
        let states = study.settings.states.iter();
        let others = states.filter(|state| !written.iter().any(|(_, chain)| chain.contains(state)));
        let whole =
            |cell: &usize| written.iter().all(|(_, chain)| curves(study, *cell, chain).is_some());
        (others.copied().collect(), (0..study.cells.len()).filter(|cell| !whole(cell)).count())
    }
}

/// Limit states of which each implies those before it, with a name: that of rocking, and where they are requested those of the base's
/// strokes. All of them end with overturning.
fn chains(states: &[LimitState]) -> Vec<(&'static str, Vec<LimitState>)> {
    let is_of = |kind: &str, state: &LimitState| match state {
        LimitState::Overturning => false,
        LimitState::Uplift | LimitState::Zeta(_) => kind == "rocking",
        LimitState::U(_) => kind == "max_u",
        LimitState::V(_) => kind == "stroke_v",
    };
    let chain = |kind: &'static str| {
        let mut chain: Vec<LimitState> =
            states.iter().copied().filter(|state| is_of(kind, state)).collect();
        chain.sort_by(|a, b| implies(*a, *b).cmp(&implies(*b, *a)));
        chain.push(LimitState::Overturning);
        (chain.len() > 1).then_some((kind, chain))
    };
    ["rocking", "max_u", "stroke_v"].into_iter().filter_map(chain).collect()
}

/// The curves of some limit states of a cell by the first estimator, a step as a steep curve; none unless each has one.
fn curves(study: &FragilityStudy, cell: usize, chain: &[LimitState]) -> Option<Vec<Lognormal>> {
    let of = |state: &LimitState| {
        let number = study.settings.states.iter().position(|known| known == state)?;
        // Other programs have lognormal curves alone.
        let curve = study.cells[cell].states[number].estimates[0].curve?.lognormal();
        Some(Lognormal { beta: curve.beta.max(STEP), ..curve })
    };
    chain.iter().map(of).collect()
}

/// What a cell is called: `block`, or the values of its axes, `t_h:1.5/t_v:0.5`. pelicun separates what it knows of a component
/// by `-`, so that a number below zero has an `m` in its place.
fn name(study: &FragilityStudy, cell: usize) -> String {
    let grid = &study.sweep.grid;
    let values = table::values(grid, cell);
    let parts: Vec<String> = table::keys(grid)
        .zip(values)
        .map(|(key, value)| format!("{key}:{}", value.0).replace('-', "m"))
        .collect();
    if grid.len() == 1 || parts.is_empty() { "block".into() } else { parts.join("/") }
}

/// What OpenQuake calls a limit state: a name of letters and digits.
fn identifier(state: &LimitState) -> String {
    state.file().replace(['-', '.'], "_")
}

/// The mean and the standard deviation of a lognormal variable.
fn moments(curve: &Lognormal) -> [f64; 2] {
    let square = curve.beta * curve.beta;
    let mean = curve.theta * (0.5 * square).exp();
    [mean, mean * square.exp_m1().sqrt()]
}

fn write_nrml(study: &FragilityStudy, out: &mut dyn Write) -> io::Result<()> {
    let measure = study.settings.im;
    let unnamed = || io::Error::new(io::ErrorKind::InvalidInput, "OpenQuake has no such measure");
    let (imt, unit, scale) = unit_of_openquake(measure).ok_or_else(unnamed)?;
    let chains = chains(&study.settings.states);
    let chain = chains.first().map_or(&[][..], |(_, chain)| chain);
    let names: Vec<String> = chain.iter().map(identifier).collect();
    let by = study.settings.estimators[0].key();
    let motions = study.records().count();
    let version = env!("CARGO_PKG_VERSION");
    writeln!(out, r#"<?xml version="1.0" encoding="UTF-8"?>"#)?;
    writeln!(out, r#"<nrml xmlns="http://openquake.org/xmlns/nrml/0.5">"#)?;
    writeln!(
        out,
        r#"  <fragilityModel id="topple" assetCategory="contents" lossCategory="contents">"#
    )?;
    writeln!(
        out,
        "    <description>topple {version}: a rigid block under {motions} motions, by {by}; levels in {unit}</description>"
    )?;
    writeln!(out, "    <limitStates>{}</limitStates>", names.join(" "))?;
    for cell in 0..study.cells.len() {
        let Some(curves) = curves(study, cell, chain) else { continue };
        let end = |side: f64| curves.iter().map(move |c| c.theta * (side * c.beta).exp() / scale);
        let (low, high) =
            (end(-FAR_BELOW).fold(f64::MAX, f64::min), end(FAR_ABOVE).fold(0.0, f64::max));
        let id = name(study, cell);
        writeln!(out, r#"    <fragilityFunction id="{id}" format="continuous" shape="logncdf">"#)?;
        writeln!(out, r#"      <imls imt="{imt}" minIML="{low:.6e}" maxIML="{high:.6e}"/>"#)?;
        for (name, curve) in names.iter().zip(&curves) {
            let [mean, deviation] = moments(curve).map(|value| value / scale);
            writeln!(out, r#"      <params ls="{name}" mean="{mean}" stddev="{deviation}"/>"#)?;
        }
        writeln!(out, "    </fragilityFunction>")?;
    }
    writeln!(out, "  </fragilityModel>")?;
    writeln!(out, "</nrml>")
}

/// What pelicun calls a measure, and its unit there, which is that of the study.
fn demand(measure: Intensity) -> Option<(String, &'static str)> {
    match measure {
        Intensity::Pga => Some(("Peak Ground Acceleration".into(), "mps2")),
        Intensity::Pgv => Some(("Peak Ground Velocity".into(), "mps")),
        Intensity::Sa(period) => Some((format!("Spectral Acceleration|{period}"), "mps2")),
        _ => None,
    }
}

fn write_pelicun(study: &FragilityStudy, out: &mut dyn Write) -> io::Result<()> {
    let measure = study.settings.im;
    let unnamed = || io::Error::new(io::ErrorKind::InvalidInput, "pelicun has no such measure");
    let (demand, unit) = demand(measure).ok_or_else(unnamed)?;
    let chains = chains(&study.settings.states);
    let most = chains.iter().map(|(_, chain)| chain.len()).max().unwrap_or(0);
    let mut csv = csv::Writer::from_writer(out);
    let mut header: Vec<String> =
        ["ID", "Incomplete", "Demand-Type", "Demand-Unit", "Demand-Offset", "Demand-Directional"]
            .map(String::from)
            .into();
    for k in 1..=most {
        let parts = ["Family", "Theta_0", "Theta_1", "DamageStateWeights"];
        header.extend(parts.map(|part| format!("LS{k}-{part}")));
    }
    csv.write_record(&header)?;
    for cell in 0..study.cells.len() {
        for (kind, chain) in &chains {
            let Some(curves) = curves(study, cell, chain) else { continue };
            let id = format!("{}.{kind}", name(study, cell));
            let mut row = [&id, "0", &demand, unit, "0", "1"].map(String::from).to_vec();
            for curve in curves {
                let (theta, beta) = (curve.theta.to_string(), curve.beta.to_string());
                row.extend(["lognormal".into(), theta, beta, String::new()]);
            }
            row.resize(header.len(), String::new());
            csv.write_record(&row)?;
        }
    }
    csv.flush()
}
