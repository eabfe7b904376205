//! The number types of columns.

use std::fmt::Debug;

use serde::Serialize;

use super::npy::ArrayValue;
use crate::model::real::Real;

/// The values of a column, as the library hands them out.
#[derive(Debug, Clone, PartialEq)]
pub enum ColumnValues {
    /// Places in [`Class::ALL`](crate::Class::ALL) or [`Status::ALL`](crate::Status::ALL).
    Codes(Vec<u8>),
    /// Numbers of events.
    Counts(Vec<u32>),
    /// Numbers of a sweep in f32.
    Singles(Vec<f32>),
    /// Numbers of a sweep in f64.
    Doubles(Vec<f64>),
}

/// A number type of columns.
pub trait Element: Copy + Debug + Default + PartialEq + Sync + ArrayValue + Serialize {
    /// Its name in a Zarr document.
    const TYPE: &'static str;

    /// Adds its bytes, the lowest first.
    fn add_to(self, bytes: &mut Vec<u8>);

    /// The first numbers that lie in bytes, so many at most.
    fn first_of(bytes: &[u8], count: usize) -> Vec<Self>;

    /// A column of these numbers as the library hands it out.
    fn handed_out(values: Vec<Self>) -> ColumnValues;
}

macro_rules! element {
    ($number:ty, $name:literal, $variant:ident) => {
        impl Element for $number {
            const TYPE: &'static str = $name;

            fn add_to(self, bytes: &mut Vec<u8>) {
                bytes.extend(self.to_le_bytes());
            }

            fn first_of(bytes: &[u8], count: usize) -> Vec<$number> {
                let (numbers, _) = bytes.as_chunks();
                numbers.iter().take(count).map(|bytes| <$number>::from_le_bytes(*bytes)).collect()
            }

            fn handed_out(values: Vec<$number>) -> ColumnValues {
                ColumnValues::$variant(values)
            }
        }
    };
}

element!(u8, "uint8", Codes);
element!(u32, "uint32", Counts);
element!(f32, "float32", Singles);
element!(f64, "float64", Doubles);

/// A number type that a sweep can run in: that of its columns of numbers.
pub trait ColumnNumber: Element + Real {}

impl ColumnNumber for f32 {}
impl ColumnNumber for f64 {}
