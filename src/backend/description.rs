//! A GPU in words.

/// What `topple adapters` shows of an adapter.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct AdapterDescription {
    /// Name of the device.
    pub name: String,
    /// discrete, integrated, virtual, software or other.
    pub kind: String,
    /// Vulkan, Metal or Dx12.
    pub api: String,
    /// Driver and its version.
    pub driver: String,
    /// True where the adapter computes in double precision.
    pub f64: bool,
}
