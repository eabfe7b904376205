//! The motions in full contact that cells share: the integration of a cell begins where it may first lift.

pub(crate) mod bounded_motions;
pub(crate) mod dependence;
pub(crate) mod full_contact;
pub(crate) mod kept_motions;
pub(crate) mod motion_cache;
pub mod motions;
pub(crate) mod sampling;
pub(crate) mod shared;
pub(crate) mod shared_contact;
pub(crate) mod shared_friction;
pub(crate) mod shared_motion;
pub(crate) mod sharing;
pub(crate) mod written_motions;
