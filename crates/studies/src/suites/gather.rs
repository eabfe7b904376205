//! From the map of a motion at some levels to the motion's cells.

use super::swept_motion::SweptMotion;
use topple::results::column_set::ColumnSet;
use topple::results::columns::Column;
use topple::scene::grid::AXES;
use topple::scene::{Grid, Parameter};
use topple::stepping::outcome::Class;
use topple::sweep::error::SweepError;
use topple::sweep::map::MapSweep;

/// The columns of a map that a motion's cells are made of, and others that are requested.
pub(super) fn columns(others: &[Column]) -> ColumnSet {
    let own = [Column::Outcome, Column::MaxU, Column::StrokeV, Column::Zeta];
    ColumnSet::of(&[&own, others].concat())
}

/// Adds the cells of a map to a motion's, level by level in the order of a grid. Levels may lie along any axis of the map.
pub(super) fn gather(
    map: &MapSweep,
    grid: &Grid,
    levels: usize,
    others: &[Column],
    motion: &mut SweptMotion,
) -> Result<(), SweepError> {
    let axis = |parameter| map.grid.axes().iter().position(|axis| axis.parameter == parameter);
    let along: Vec<Option<usize>> = grid.axes().iter().map(|of| axis(of.parameter)).collect();
    let of_level = axis(Parameter::Scale).filter(|_| levels > 1);
    let cell_of = |level: usize, cell: usize| {
        let mut there = [0; AXES];
        for (at, along) in grid.place(cell).iter().zip(&along) {
            if let Some(along) = along {
                there[*along] = *at;
            }
        }
        if let Some(of_level) = of_level {
            there[of_level] = level;
        }
        map.grid.cell(&there)
    };
    let order: Vec<usize> = (0..levels)
        .flat_map(|level| (0..grid.len()).map(move |cell| (level, cell)))
        .map(|(level, cell)| cell_of(level, cell))
        .collect();
    let column = |column| map.column(column);
    let put = |values: Vec<f64>, to: &mut Vec<f32>| {
        to.extend(order.iter().map(|cell| values[*cell] as f32));
    };
    // Codes are places among the classes.
    let class = |code: f64| Class::ALL.get(code as usize).copied().unwrap_or(Class::Unresolved);
    let codes = column(Column::Outcome)?;
    motion.outcomes.extend(order.iter().map(|cell| class(codes[*cell])));
    put(column(Column::MaxU)?, &mut motion.max_u);
    put(column(Column::StrokeV)?, &mut motion.stroke_v);
    put(column(Column::Zeta)?, &mut motion.zeta);
    for (other, to) in others.iter().zip(&mut motion.others) {
        put(column(*other)?, to);
    }
    Ok(())
}
