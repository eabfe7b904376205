//! Whether a scene's numbers make sense: each by itself, and together.

use super::applies::Choice;
use super::device::{self, OF_MASS, ROUNDING, together};
use super::excitation::Excitation;
use super::grid::AXES;
use super::numbers::Numbers;
use super::parameters::{ALTERNATIVES, Entry, Parameter};
use super::record::ACCEPTED;
use super::{Grid, LONGEST_TITLE, Scene, SceneError, Values};

/// Most cells of a grid.
const MOST_CELLS: usize = 1 << 40;

/// Checks that a title has an end.
///
/// # Errors
/// The key `title`.
pub fn title(title: &str) -> Result<(), SceneError> {
    match title.chars().nth(LONGEST_TITLE) {
        Some(_) => {
            let problem = format!("has more than {LONGEST_TITLE} letters; give a shorter one");
            Err(SceneError::new("title", problem))
        }
        None => Ok(()),
    }
}

/// Checks every number by itself; `force` accepts what is improbable.
///
/// # Errors
/// The first key at fault.
pub(super) fn numbers(numbers: &Numbers, force: bool) -> Result<(), SceneError> {
    for (parameter, values) in numbers.iter() {
        let entry = parameter.entry();
        let refused = |problem| Err(SceneError::new(entry.key, problem));
        // Values that were made, not read, may be none.
        if let Err(error) = values.check() {
            return refused(error.to_string());
        }
        for value in values.iter() {
            if !entry.legal.holds(value) {
                // As of 0,5 where half is meant.
                let hint = match values {
                    Values::List(_) => {
                        "; commas separate the values of a list, decimals have a point"
                    }
                    Values::Range(_) => "",
                };
                return refused(format!("{value} must {}{hint}", entry.legal));
            }
            if !force && !is_plausible(entry, value) {
                return refused(questioned(entry, value));
            }
        }
    }
    for row in ALTERNATIVES {
        let mut given = row.iter().filter(|parameter| numbers.has(**parameter));
        if let (Some(first), Some(second)) = (given.next(), given.next()) {
            if given.next().is_none() && together(*first, *second, numbers) {
                continue;
            }
            let problem = format!("`{}` says it too; give one of them", first.key());
            return Err(SceneError::new(second.key(), problem));
        }
    }
    Ok(())
}

fn is_plausible(entry: &Entry, value: f64) -> bool {
    let (low, high) = entry.plausible;
    value == 0.0 || (low..=high).contains(&value.abs())
}

fn questioned(entry: &Entry, value: f64) -> String {
    let (low, high) = entry.plausible_ends();
    let unit = if entry.unit.is_empty() { "" } else { " " };
    format!(
        "{value}{unit}{} is not plausible ({low} to {high}; {}); {ACCEPTED}",
        entry.unit, entry.perhaps
    )
}

/// Checks the numbers of a scene together: at the corners of its grid, for each condition rises or falls
/// along every axis.
///
/// # Errors
/// The first key at fault.
pub(super) fn scene(scene: &Scene) -> Result<(), SceneError> {
    let swept = scene.swept();
    if swept.len() > AXES {
        let problem = format!(
            "{} parameters have several values; {} at most may, give the others one",
            swept.len(),
            AXES
        );
        return Err(SceneError::new(swept[AXES].key(), problem));
    }
    let counts = swept.iter().filter_map(|parameter| scene.numbers.get(*parameter));
    let cells = counts.fold(1, |cells: usize, values| cells.saturating_mul(values.count()));
    if let Some(last) = swept.last()
        && cells > MOST_CELLS
    {
        let problem = format!("{cells} cells are over {MOST_CELLS}; give fewer points");
        return Err(SceneError::new(last.key(), problem));
    }
    let grid = Grid::of(scene);
    if let (Some(x), Some(y)) = (scene.x, scene.y)
        && x == y
    {
        let problem = format!("`{}` is along the other axis, too; choose another for one", y.key());
        return Err(SceneError::new("y", problem));
    }
    for (key, asked) in [("x", scene.x), ("y", scene.y)] {
        if let Some(asked) = asked
            && !grid.axes().iter().any(|axis| axis.parameter == asked)
        {
            let asked = asked.key();
            let problem = format!("`{asked}` is no axis: give it several values, start:stop:count");
            return Err(SceneError::new(key, problem));
        }
    }
    let numbers = &scene.numbers;
    let applies = Parameter::Restitution.entry().applies;
    if numbers.has(Parameter::Restitution) && !applies.beside(Choice::Isolation(scene.isolation)) {
        let problem = "replaces the law of impact only where `isolation` is none";
        return Err(SceneError::new("restitution", problem));
    }
    let of_mass = OF_MASS.into_iter().find(|own| numbers.has(*own));
    if let Some(own) = of_mass.filter(|_| !numbers.has(Parameter::Mass)) {
        let problem = format!("missing; `{}` means nothing without it", own.key());
        return Err(SceneError::new("mass", problem));
    }
    let duration = match &scene.excitation {
        Excitation::Pulse(_) => 0.0,
        Excitation::Record(pair) => {
            pair.check().map_err(|error| SceneError::new("horizontal", error.to_string()))?;
            pair.duration()
        }
    };
    for case in grid.corners() {
        let (e, b) = (case.block.offset(), case.block.half_width);
        if !(b > 0.0 && case.block.height > 0.0) {
            let problem = "half the diagonal must be larger than `half_width` and `height`";
            return Err(SceneError::new("size", problem));
        }
        if !(e.abs() < b) {
            let problem = format!("{e} m lies outside the base, whose half is {b} m");
            return Err(SceneError::new("offset", problem));
        }
        if let Some(law) = &case.isolation.horizontal {
            device::check(law, numbers)?;
        }
        let (factor, most) = (case.restitution_factor, case.most_restitution_factor());
        if factor > most * (1.0 + ROUNDING) {
            let problem =
                format!("{factor} must be at most {most:.6}: beyond, impacts raise the energy");
            return Err(SceneError::new("restitution_factor", problem));
        }
        let most = case.overturning_angle(case.tilt.signum());
        if !(case.tilt.abs() < most) {
            let problem =
                format!("{} must be below the overturning angle, {most:.4} rad", case.tilt);
            return Err(SceneError::new("tilt", problem));
        }
        if case.t_max < duration {
            let t_max = case.t_max;
            let problem = format!("{t_max} s ends before the record, {duration} s; lengthen it");
            return Err(SceneError::new("t_max", problem));
        }
    }
    Ok(())
}

/// Questions what a device's stiffnesses and forces make of the base, where it is beyond what the period and the yield
/// displacement themselves may be.
///
/// # Errors
/// The key of the stiffness or the force.
pub(super) fn plausible_device(scene: &Scene) -> Result<(), SceneError> {
    use Parameter::{K1, Qd, TH, UY, YieldForce};
    let given = |of: [Parameter; 2]| of.into_iter().find(|own| scene.numbers.has(*own));
    let beyond = |of: Parameter, value: f64| value > of.entry().plausible.1;
    for case in Grid::of(scene).corners() {
        let Some(law) = case.isolation.horizontal else { continue };
        let made = [(TH, law.t_h, given([K1, YieldForce])), (UY, law.u_y, given([Qd, YieldForce]))];
        for (of, value, key) in made {
            if let Some(key) = key.filter(|_| beyond(of, value) && !scene.numbers.has(of)) {
                let problem = format!(
                    "with the masses it makes {}, which is not plausible (N and N/m are meant, not kN and kN/m); {ACCEPTED}",
                    of.entry().written(format!("{value:.3}"))
                );
                return Err(SceneError::new(key.key(), problem));
            }
        }
    }
    Ok(())
}
