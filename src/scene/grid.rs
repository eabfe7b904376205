//! The grid of parameters that a scene sweeps.

use super::case::{Case, Choices};
use super::numbers::Point;
use super::parameters::{Entry, Parameter};
use super::values::Values;
use super::{Excitation, Scene};

/// Most axes of a grid.
pub const AXES: usize = 6;

/// A swept parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// The parameter.
    pub parameter: Parameter,
    /// The values of the parameter.
    pub values: Values,
}

impl Axis {
    /// The description of the parameter.
    pub fn entry(&self) -> &'static Entry {
        self.parameter.entry()
    }

    /// Name of the column and array: `omega`.
    pub fn key(&self) -> &'static str {
        self.parameter.key()
    }

    /// How many values it has.
    pub fn count(&self) -> usize {
        self.values.count()
    }
}

/// The place of a cell along each axis of its grid; zeros beyond the last axis.
pub type Place = [usize; AXES];

/// A box of cells, of one axis at least; the first axis is the fastest.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    axes: Vec<Axis>,
    fixed: Point,
    choices: Choices,
}

/// The axes of a scene in which nothing else is swept, in their order.
fn usual(scene: &Scene) -> [Parameter; 2] {
    match scene.excitation {
        Excitation::Pulse(_) => [Parameter::Omega, Parameter::AH],
        Excitation::Record(_) => [Parameter::TH, Parameter::TV],
    }
}

impl Grid {
    /// The grid of a scene: its swept parameters; (Omega, A_h) for a pulse and (T_h, T_v) for a record
    /// where no other is, without the period of a direction that is locked.
    pub fn of(scene: &Scene) -> Grid {
        let mut axes: Vec<Axis> = Vec::new();
        let usual = usual(scene);
        let swept = scene.swept();
        if swept.iter().all(|parameter| usual.contains(parameter)) {
            // A locked direction has no period. A scene without either has an end all the same.
            let numbers = |parameter| Some((parameter, scene.numbers.get(parameter)?.clone()));
            let axis = |(parameter, values)| Axis { parameter, values };
            axes.extend(usual.into_iter().filter_map(numbers).map(axis));
            if axes.is_empty() {
                let t_max = scene.numbers.get(Parameter::TMax).cloned();
                let values = t_max.unwrap_or_else(|| Values::from(0.0));
                axes.push(Axis { parameter: Parameter::TMax, values });
            }
        } else {
            for parameter in swept {
                axes.extend(
                    scene.numbers.get(parameter).cloned().map(|values| Axis { parameter, values }),
                );
            }
        }
        // Those asked for are the first and the second.
        let take = |asked: Option<Parameter>, axes: &mut Vec<Axis>| {
            let at = axes.iter().position(|axis| Some(axis.parameter) == asked)?;
            Some(axes.remove(at))
        };
        let (x, y) = (take(scene.x, &mut axes), take(scene.y, &mut axes));
        if let Some(y) = y {
            axes.insert(usize::from(x.is_none()).min(axes.len()), y);
        }
        if let Some(x) = x {
            axes.insert(0, x);
        }
        Grid { axes, fixed: scene.numbers.first(), choices: Choices::of(scene) }
    }

    /// The axes; the one that varies fastest from cell to cell comes first.
    pub fn axes(&self) -> &[Axis] {
        &self.axes
    }

    /// The horizontal axis.
    pub fn x(&self) -> &Axis {
        &self.axes[0]
    }

    /// The vertical axis, where there is one.
    pub fn y(&self) -> Option<&Axis> {
        self.axes.get(1)
    }

    /// The places of the axes that tell cells apart or say what they have. A grid of nothing but a cell's end, which lies
    /// elsewhere under each record, has none.
    pub fn told(&self) -> Vec<usize> {
        let end = |axis: &Axis| axis.parameter == Parameter::TMax && axis.count() == 1;
        (0..self.axes.len()).filter(|place| !end(&self.axes[*place])).collect()
    }

    /// The only axis with several values; none where several axes have them.
    pub fn line(&self) -> Option<&Axis> {
        let mut swept = self.axes.iter().filter(|axis| axis.count() > 1);
        swept.next().filter(|_| swept.next().is_none())
    }

    /// The number of columns, and the number of rows of all other axes together.
    pub fn shape(&self) -> (usize, usize) {
        let rows = self.axes[1..].iter().map(Axis::count);
        (self.axes[0].count(), rows.fold(1, usize::saturating_mul))
    }

    /// Values of the axes after the first but the last, 1 for those that it has not.
    pub fn counts(&self) -> [u32; AXES - 2] {
        // An axis has fewer than 2^32 values.
        std::array::from_fn(|k| self.axes.get(k + 1).map_or(1, |axis| axis.count() as u32))
    }

    /// The number of cells, at most the largest that `usize` holds.
    pub fn len(&self) -> usize {
        let (columns, rows) = self.shape();
        columns.saturating_mul(rows)
    }

    /// False: an axis has one value at least.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// A cell's place along each axis.
    #[inline]
    pub fn place(&self, cell: usize) -> Place {
        let mut place = [0; AXES];
        let mut rest = cell;
        for (at, axis) in place.iter_mut().zip(&self.axes) {
            let count = axis.count();
            // Most grids are small enough for the shorter division, which takes half the time.
            (*at, rest) = match (u32::try_from(rest), u32::try_from(count)) {
                (Ok(rest), Ok(count)) => ((rest % count) as usize, (rest / count) as usize),
                _ => (rest % count, rest / count),
            };
        }
        place
    }

    /// The number of the cell at a place.
    pub fn cell(&self, place: &Place) -> usize {
        let axes = self.axes.iter().zip(place).rev();
        axes.fold(0, |cell, (axis, at)| cell * axis.count() + at)
    }

    /// The neighbours of a cell along the first two axes, which lie in its slice.
    pub fn neighbours(&self, cell: usize) -> impl Iterator<Item = usize> + use<> {
        let columns = self.x().count();
        let rows = self.y().map_or(1, Axis::count);
        let (column, row) = (cell % columns, cell / columns % rows);
        let along = [(column > 0).then(|| cell - 1), (column + 1 < columns).then(|| cell + 1)];
        let across = [(row > 0).then(|| cell - columns), (row + 1 < rows).then(|| cell + columns)];
        along.into_iter().chain(across).flatten()
    }

    /// The values of all axes at a cell.
    pub fn coordinates(&self, cell: usize) -> impl Iterator<Item = f64> + '_ {
        let place = self.place(cell);
        self.axes.iter().zip(place).map(|(axis, at)| axis.values.value(at))
    }

    /// The value of a parameter in a cell, where it has one.
    pub fn value(&self, parameter: Parameter, cell: usize) -> Option<f64> {
        match self.axes.iter().position(|axis| axis.parameter == parameter) {
            Some(axis) => Some(self.axes[axis].values.value(self.place(cell)[axis])),
            None => self.fixed.get(parameter),
        }
    }

    /// The numbers of the cell at a place.
    pub fn case_at(&self, place: &Place) -> Case {
        self.choices.case(&self.point(place))
    }

    /// The same with a parameter of another value.
    pub fn case_with(&self, place: &Place, parameter: Parameter, value: f64) -> Case {
        let mut point = self.point(place);
        point.set(parameter, value);
        self.choices.case(&point)
    }

    fn point(&self, place: &Place) -> Point {
        let mut point = self.fixed;
        for (axis, at) in self.axes.iter().zip(place) {
            point.set(axis.parameter, axis.values.value(*at));
        }
        point
    }

    /// The numbers of a cell.
    pub fn case(&self, cell: usize) -> Case {
        self.case_at(&self.place(cell))
    }

    /// The cells at the corners of the grid: its axes' smallest and largest values in every combination.
    pub fn corners(&self) -> impl Iterator<Item = Case> + '_ {
        (0..1_usize << self.axes.len()).map(|corner| {
            let mut point = self.fixed;
            for (number, axis) in self.axes.iter().enumerate() {
                let (low, high) = axis.values.ends();
                point.set(axis.parameter, if corner >> number & 1 == 1 { high } else { low });
            }
            self.choices.case(&point)
        })
    }

    /// True where one of these parameters is swept.
    pub fn sweeps(&self, parameters: &[Parameter]) -> bool {
        let swept = |axis: &Axis| axis.count() > 1 && parameters.contains(&axis.parameter);
        self.axes.iter().any(swept)
    }

    /// True where the base's yield displacement is given, not tied to the ground's peak by (21).
    pub fn gives_strength(&self) -> bool {
        let given = |parameter| {
            self.fixed.get(parameter).is_some()
                || self.axes.iter().any(|axis| axis.parameter == parameter)
        };
        [Parameter::UY, Parameter::YieldForce, Parameter::Qd].into_iter().any(given)
    }

    /// True where the block of some cell begins tilted.
    pub fn tilts(&self) -> bool {
        self.corners().any(|case| case.tilt != 0.0)
    }

    /// The same cells along their only axis, where they lie along one.
    pub fn along_line(&self) -> Option<Grid> {
        let axis = self.line()?.clone();
        let mut fixed = self.fixed;
        for other in self.axes.iter().filter(|other| other.parameter != axis.parameter) {
            fixed.set(other.parameter, other.values.first());
        }
        Some(Grid { axes: vec![axis], fixed, ..self.clone() })
    }

    /// The slices of the first two axes: a single one where there are no other axes.
    pub fn slices(&self) -> usize {
        self.axes.iter().skip(2).map(Axis::count).product()
    }

    /// A slice of the first two axes, the others fixed, and what they are fixed at.
    pub fn slice(&self, number: usize) -> (Grid, Vec<(Parameter, f64)>) {
        let area: usize = self.axes.iter().take(2).map(Axis::count).product();
        let place = self.place(number * area);
        let mut slice = self.clone();
        let others = slice.axes.split_off(2.min(self.axes.len()));
        let mut fixed = Vec::with_capacity(others.len());
        for (axis, at) in others.iter().zip(&place[2..]) {
            let value = axis.values.value(*at);
            slice.fixed.set(axis.parameter, value);
            fixed.push((axis.parameter, value));
        }
        (slice, fixed)
    }

    /// The same grid with at most a given number of values of each of its first two axes.
    pub fn thinned(&self, most: usize) -> Grid {
        let mut thin = self.clone();
        for axis in thin.axes.iter_mut().take(2) {
            axis.values = axis.values.thinned(most);
        }
        thin
    }
}
