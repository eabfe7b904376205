//! How sharp the boundaries between a map's outcomes are: basin entropy and the uncertainty exponent.
//!
//! Basin entropy is that of Daza et al. (2016), Scientific Reports 6:31416: in a box of cells with shares p of the
//! outcomes S = -sum p ln p; S_b is the mean of all boxes, S_bb that of the boxes with two outcomes or more. A smooth
//! boundary separates two outcomes and has S_bb <= ln 2: a larger value is a sufficient sign of a fractal one, a smaller one allows no conclusion.
//!
//! The uncertainty exponent is that of Grebogi et al. (1983), Physics Letters A 99:415-418: the share f of cells whose
//! outcome another has at a distance of a given number of cells along an axis is proportional to the distance to the power
//! alpha, and the boundary's dimension is D = d - alpha over d axes.

pub mod blocks;
pub mod figures;

use std::io;
use std::ops::Range;

use serde::{Deserialize, Serialize};

use topple::results::observed::ObservedOutcomes;
use topple::results::outcomes::Outcomes;
use topple::scene::Grid;
use topple::scene::grid::Axis;
use topple::sweep::error::SweepError;
use topple::sweep::map::MapSweep;
use topple::work::observer::{Observer, Phase};

use blocks::{classes, sums};
use figures::of_blocks;

/// Cells of a box along an axis.
pub const BOX: usize = 5;
/// The largest distance is at most this share of the shorter axis, and at most a given number of cells.
const FARTHEST: (usize, usize) = (8, 32);

/// A value, with an interval of 95 %.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// Low end.
    pub low: f64,
    /// High end.
    pub high: f64,
}

/// How sharp the boundaries of a map are.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sharpness {
    /// Cells of a box along the first two axes.
    pub box_cells: [usize; 2],
    /// Boxes.
    pub boxes: usize,
    /// Those with two outcomes or more.
    pub boundary_boxes: usize,
    /// Basin entropy; none where there are no boxes.
    pub s_b: Option<Estimate>,
    /// Boundary basin entropy; none where too few boxes have two outcomes.
    pub s_bb: Option<Estimate>,
    /// True where the interval of S_bb lies above ln 2: there is a fractal boundary. False allows no conclusion.
    pub above_ln_2: bool,
    /// Distances, in cells.
    pub distances: Vec<usize>,
    /// Shares of the pairs of cells at these distances whose outcomes differ.
    pub uncertain: Vec<f64>,
    /// The exponent alpha, its interval the wider one of resampled blocks and of the line's slope; none where the grid
    /// is too coarse.
    pub alpha: Option<Estimate>,
    /// The standard error of the straight line's slope.
    pub alpha_error: Option<f64>,
    /// The boundary's dimension.
    pub dimension: Option<Estimate>,
    /// Why what is missing is not told.
    pub not_told: Vec<String>,
}

impl Sharpness {
    /// Goes through the outcomes of a grid, a few rows at a time. Of more than two axes all slices of the first two
    /// count together.
    pub fn of(grid: &Grid, outcomes: &dyn Outcomes) -> io::Result<Sharpness> {
        let (columns, rows) = (grid.x().count(), grid.y().map_or(1, Axis::count));
        let sides = [columns, rows];
        let long = sides.into_iter().filter(|count| *count > 1);
        let shorter = long.clone().min().unwrap_or(1);
        let farthest = (shorter / FARTHEST.0).clamp(1, FARTHEST.1);
        let distances: Vec<usize> =
            (0..).map(|k| 1 << k).take_while(|distance| *distance <= farthest).collect();
        let sizes = sides.map(|count| if count > 1 { BOX } else { 1 });
        let mut blocks = Vec::new();
        for slice in 0..grid.slices() {
            let first = slice * columns * rows;
            let read = |rows: Range<usize>| {
                classes(outcomes, first + rows.start * columns..first + rows.end * columns)
            };
            blocks.extend(sums((columns, rows), sizes, &distances, read)?);
        }
        Ok(of_blocks(&blocks, sizes, distances, long.count()))
    }

    /// That of a map; `observer` hears of its cells.
    ///
    /// # Errors
    /// Those of reading; [`SweepError::Read`] where it is cancelled.
    pub fn of_map(map: &MapSweep, observer: &dyn Observer) -> Result<Sharpness, SweepError> {
        observer.begins(Phase::Counting, map.grid.len());
        Ok(Sharpness::of(&map.grid, &ObservedOutcomes::new(&*map.outcomes, observer))?)
    }
}
