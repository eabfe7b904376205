//! Which largest and least values of a cell somebody asks for. What nobody asks for is not looked for, and a cell may end
//! before it is final.

/// Groups of values, each of which is looked for or is not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Asked {
    /// The largest rotations, and with them the rocking index.
    pub angles: bool,
    /// The largest |u| and |v|.
    pub displacements: bool,
    /// The least contact force and the friction asked for.
    pub forces: bool,
    /// The largest accelerations of the upper plate and of the centre of mass, and the largest force that the base
    /// carries.
    pub accelerations: bool,
    /// The largest force on the end stop, and how often the base meets it.
    pub stops: bool,
}

impl Asked {
    /// Those of the columns that a map has by default.
    pub const ALL: Asked = Asked {
        angles: true,
        displacements: true,
        forces: true,
        accelerations: false,
        stops: false,
    };
}
