//! Why a backend gave no outcomes.

/// Why a backend gave no outcomes.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BackendError {
    /// No adapter at all.
    #[error("no GPU adapter was found; install its driver, or use `backend` cpu")]
    NoAdapter,
    /// topple without its GPU code.
    #[error("topple was built without its feature gpu; use `backend` cpu")]
    NotBuilt,
    /// An adapter without double precision.
    #[error("{0} has no double precision; use `precision` f32 or `backend` cpu")]
    NoF64(String),
    /// An adapter that is not there.
    #[error("there is no adapter {0}; topple adapters lists them, from 0")]
    NoSuchAdapter(usize),
    /// An adapter of the CPU.
    #[error("the CPU has none; give `backend` gpu, or leave it out")]
    NoneOfCpu,
    /// Adapters that may round differently.
    #[error("{0} and {1} are not alike; give adapters of one kind, or a shard to each by `tile`")]
    Unlike(String, String),
    /// The adapter gave no device.
    #[error("{adapter} gave no device: {reason}")]
    NoDevice {
        /// Name of the adapter.
        adapter: String,
        /// What the driver says.
        reason: String,
    },
    /// The device computes something else than it should.
    #[error("{adapter} failed its first check: {reason}")]
    FailedCheck {
        /// Name of the adapter.
        adapter: String,
        /// What went wrong.
        reason: String,
    },
    /// The device went away.
    #[error("the GPU was lost during the sweep: {0}")]
    Lost(String),
    /// The device's memory does not hold a tile.
    #[error("the GPU has not enough memory: {0}")]
    OutOfMemory(String),
    /// The driver or wgpu refused a command: a mistake in topple.
    #[error("the GPU refused a command: {0}")]
    Refused(String),
    /// The sweep panicked.
    #[error("a sweep broke off: a mistake in topple or in the driver; its cells are not used")]
    BrokeOff,
    /// Whoever watches the sweep ended it.
    #[error("the sweep was cancelled")]
    Cancelled,
    /// Cells came back that never ran to their end.
    #[error("the GPU left {0} cells unfinished; its results are not used")]
    Unfinished(usize),
}
