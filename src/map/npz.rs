//! map.npz: the columns of map.csv as arrays of shape (y, x), with the axes.

use std::io::{Seek, Write};

use ndarray::{Array1, Array2};
use ndarray_npy::{NpzWriter, WritableElement, WriteNpzError};

use super::Map;
use crate::integrate::outcome::{Class, Outcome, Status};

/// Code of a class in the array `outcome`; the array `outcome_names` spells them out.
pub fn class_code(class: Class) -> u8 {
    match class {
        Class::FullContact => 0,
        Class::Rocking => 1,
        Class::OverturnedLeft => 2,
        Class::OverturnedRight => 3,
        Class::Unresolved => 4,
    }
}

/// Code of a status in the array `status`.
pub fn status_code(status: Status) -> u8 {
    match status {
        Status::Ok | Status::Proved => 0,
        Status::EventLimit => 1,
        Status::Diverged => 2,
        Status::StepLimit => 3,
        Status::VerticalLocked => 4,
        Status::Undecided => 5,
    }
}

/// Writes the archive. `outcome` is 0 full contact, 1 rocking, 2 overturned left, 3 overturned
/// right, 4 unresolved; `status` is 0 ok, 1 event limit, 2 diverged, 3 step limit,
/// 4 ok with the vertical direction locked, 5 undecided; `t_uplift` is not a number where there is
/// no uplift.
///
/// # Errors
/// Those of the writer.
pub fn write(map: &Map, writer: impl Write + Seek) -> Result<(), WriteNpzError> {
    let mut archive = NpzWriter::new(writer);
    for axis in [&map.grid.x, &map.grid.y] {
        archive.add_array(axis.key, &Array1::from_iter(axis.range.values()))?;
    }
    add(map, &mut archive, "outcome", |cell| class_code(cell.class))?;
    add(map, &mut archive, "impacts", |cell| cell.impacts)?;
    add(map, &mut archive, "uplifts", |cell| cell.uplifts)?;
    add(map, &mut archive, "t_end", |cell| cell.t_end)?;
    add(map, &mut archive, "t_uplift", |cell| cell.t_uplift.unwrap_or(f64::NAN))?;
    add(map, &mut archive, "zeta", |cell| cell.zeta)?;
    add(map, &mut archive, "max_phi_left", |cell| cell.max_phi_left)?;
    add(map, &mut archive, "max_phi_right", |cell| cell.max_phi_right)?;
    add(map, &mut archive, "max_u", |cell| cell.max_u)?;
    add(map, &mut archive, "max_v", |cell| cell.max_v)?;
    add(map, &mut archive, "min_contact", |cell| cell.min_contact)?;
    add(map, &mut archive, "friction", |cell| cell.friction)?;
    add(map, &mut archive, "status", |cell| status_code(cell.status))?;
    archive.finish()?;
    Ok(())
}

fn add<T: WritableElement + Copy, W: Write + Seek>(
    map: &Map,
    archive: &mut NpzWriter<W>,
    name: &str,
    value: impl Fn(&Outcome) -> T,
) -> Result<(), WriteNpzError> {
    let (columns, rows) = map.grid.shape();
    let array =
        Array2::from_shape_fn((rows, columns), |(j, i)| value(&map.outcomes[j * columns + i]));
    archive.add_array(name, &array)
}
