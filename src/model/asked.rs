//! Which largest and least values of a cell are requested. A value that is not requested is not searched for, and a
//! cell may end before that value is final.

/// The groups of values that can be requested.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Asked {
    /// The largest rotations, and with them the rocking index.
    pub angles: bool,
    /// The largest |u| and |v|.
    pub displacements: bool,
    /// The least normal contact force, and the friction coefficient that keeps the block from sliding.
    pub forces: bool,
    /// The largest accelerations of the upper plate and of the centre of mass, and the largest force that the base
    /// carries.
    pub accelerations: bool,
    /// The largest force on the end stop, and how often it begins to push the base.
    pub stops: bool,
}

impl Asked {
    /// The groups that the default columns of a map need.
    pub const ALL: Asked = Asked {
        angles: true,
        displacements: true,
        forces: true,
        accelerations: false,
        stops: false,
    };
}
