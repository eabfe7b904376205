//! The cells of a list, and which combinations of values they have.
//!
//! The cells of a sweep have nearly all combinations of the values in a window, and find their entry of a table by
//! their place. The cells of a refined map have few of them: a table for these cells holds each combination that
//! occurs once, and a cell finds its entry by its number in the list.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use rayon::slice::ParallelSliceMut;

use super::cell_list::CellList;
use super::window::{Combinations, Strides, Window, offset};
use crate::scene::grid::Place;
use crate::scene::{Grid, Parameter};
use crate::work::parallel::{self, LOOKUPS};
use crate::work::threads::install;

/// The most combinations per cell of a list for which a table holds all combinations of a window: a batch of a sweep
/// has no more.
const ALL: usize = 2;

/// A cell of a list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CellAt {
    /// Its number in the list.
    pub number: usize,
    /// Its place in the grid.
    pub place: Place,
}

/// Where the cells of a list find their entries.
#[derive(Debug, Clone)]
pub enum Index {
    /// By their places: the entries between two values of each axis, and the entries before the first.
    ByPlace(Strides, usize),
    /// By their numbers in the list.
    ByNumber(Arc<[u32]>),
}

impl Index {
    /// The number of a cell's entry.
    #[inline(always)]
    pub fn of(&self, cell: &CellAt) -> usize {
        match self {
            Index::ByPlace(strides, before) => offset(strides, &cell.place) - before,
            Index::ByNumber(numbers) => numbers[cell.number] as usize,
        }
    }
}

/// The combinations of values that have an entry.
#[derive(Debug, Clone)]
pub struct Entries {
    combinations: Combinations,
    /// The combinations that have an entry, in order; none where all have one.
    occurring: Option<Vec<usize>>,
}

impl Entries {
    /// One entry for each combination.
    pub fn all(combinations: Combinations) -> Entries {
        Entries { combinations, occurring: None }
    }

    /// One entry for each combination that occurs, given in order; `combinations` are those of the whole grid.
    pub fn some(combinations: Combinations, occurring: Vec<usize>) -> Entries {
        Entries { combinations, occurring: Some(occurring) }
    }

    /// The number of entries.
    pub fn count(&self) -> usize {
        self.occurring.as_ref().map_or_else(|| self.combinations.count(), Vec::len)
    }

    /// The combination of an entry.
    pub fn combination(&self, entry: usize) -> usize {
        self.occurring.as_ref().map_or(entry, |occurring| occurring[entry])
    }

    /// The entry of a combination, if it has one.
    pub fn entry(&self, combination: usize) -> Option<usize> {
        match &self.occurring {
            Some(occurring) => occurring.binary_search(&combination).ok(),
            None => Some(combination),
        }
    }

    /// The place of a cell that has this entry.
    pub fn place(&self, entry: usize) -> Place {
        self.combinations.place(self.combination(entry))
    }

    /// True where each cell of a list has an entry.
    pub fn hold(&self, grid: &Grid, cells: CellList) -> bool {
        let has = |key: &usize| self.entry(*key).is_some();
        self.occurring.is_none() || keys(grid, &self.combinations.strides(), cells).iter().all(has)
    }

    /// Where the cells of a list find their entries, which all of them have.
    pub fn index(&self, grid: &Grid, cells: CellList) -> Index {
        let strides = self.combinations.strides();
        if self.occurring.is_none() {
            return Index::ByPlace(strides, self.combinations.before());
        }
        // A list has fewer than 2^32 cells, because memory cannot hold more numbers.
        let keys = keys(grid, &strides, cells);
        let number = |cell: usize| self.entry(keys[cell]).unwrap_or(0) as u32;
        let numbers: Vec<u32> = parallel::each(keys.len(), LOOKUPS, number);
        Index::ByNumber(numbers.into())
    }
}

/// The combination of each cell, by these strides of a whole grid.
fn keys(grid: &Grid, strides: &Strides, cells: CellList) -> Vec<usize> {
    // The key is not larger than the number of the cell.
    parallel::each(cells.len(), LOOKUPS, |number| offset(strides, &grid.place(cells.at(number))))
}

/// The combinations that some cells of a grid have, each once and in order.
pub fn occurring(grid: &Grid, combinations: &Combinations, cells: CellList) -> Vec<usize> {
    let mut keys = keys(grid, &combinations.strides(), cells);
    install(|| keys.par_sort_unstable());
    keys.dedup();
    keys
}

/// The cells of a list.
#[derive(Debug)]
pub struct Listing<'a> {
    grid: &'a Grid,
    cells: CellList<'a>,
    window: Window,
    /// The entries of the tables so far, and where cells find them: tables of the same axes share them.
    known: RefCell<Vec<Rc<(Entries, Index)>>>,
}

impl<'a> Listing<'a> {
    /// The list of these cells of a grid.
    pub fn of(grid: &'a Grid, cells: CellList<'a>) -> Listing<'a> {
        let window = Window::around(grid, cells);
        Listing { grid, cells, window, known: RefCell::default() }
    }

    /// The grid.
    pub fn grid(&self) -> &'a Grid {
        self.grid
    }

    /// True where cells may have the same combination of these parameters' values.
    pub fn share(&self, parameters: &[Parameter]) -> bool {
        self.window.combinations(self.grid, parameters).count() < self.window.cells()
    }

    /// The entries of a table of these parameters, and where the cells find their entries.
    pub fn entries(&self, parameters: &[Parameter]) -> Rc<(Entries, Index)> {
        let (grid, cells) = (self.grid, self.cells);
        let in_window = self.window.combinations(grid, parameters);
        let all = in_window.count() <= ALL * cells.len().max(1);
        // Combinations are distinguished by their number in the whole grid.
        let whole = Window::whole(grid).combinations(grid, parameters);
        let combinations = if all { in_window } else { whole };
        let mut known = self.known.borrow_mut();
        if let Some(same) = known.iter().find(|known| known.0.combinations == combinations) {
            return Rc::clone(same);
        }
        let entries = match all {
            true => Entries::all(combinations),
            false => Entries::some(combinations, occurring(grid, &combinations, cells)),
        };
        let index = entries.index(grid, cells);
        let both = Rc::new((entries, index));
        known.push(Rc::clone(&both));
        both
    }
}
