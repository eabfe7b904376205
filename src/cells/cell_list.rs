//! The cells of a run, by their numbers in the grid.

use std::ops::Range;

/// Cells of a grid, in any order. Those of a sweep follow one another, and are not written down one by one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CellList<'a> {
    /// Consecutive cells: the first one, and how many there are.
    Consecutive(usize, usize),
    /// The numbers of the cells.
    Listed(&'a [usize]),
}

impl<'a> CellList<'a> {
    /// The number of cells.
    pub fn len(self) -> usize {
        match self {
            CellList::Consecutive(_, count) => count,
            CellList::Listed(cells) => cells.len(),
        }
    }

    /// True where there is no cell.
    pub fn is_empty(self) -> bool {
        self.len() == 0
    }

    /// The number in the grid of the cell at a place of the list.
    #[inline(always)]
    pub fn at(self, place: usize) -> usize {
        match self {
            CellList::Consecutive(first, _) => first + place,
            CellList::Listed(cells) => cells[place],
        }
    }

    /// The cells at some places of the list.
    pub fn part(self, places: Range<usize>) -> CellList<'a> {
        match self {
            CellList::Consecutive(first, _) => {
                CellList::Consecutive(first + places.start, places.len())
            }
            CellList::Listed(cells) => CellList::Listed(&cells[places]),
        }
    }

    /// The cells, in the order of the list.
    pub fn iter(self) -> impl Iterator<Item = usize> + 'a {
        (0..self.len()).map(move |place| self.at(place))
    }

    /// The first of the cells, if they follow one another.
    pub fn first_of_consecutive(self) -> Option<usize> {
        match self {
            CellList::Consecutive(first, _) => Some(first),
            CellList::Listed(cells) => cells
                .windows(2)
                .all(|pair| pair[1] == pair[0] + 1)
                .then(|| cells.first().copied().unwrap_or(0)),
        }
    }

    /// The least and the largest of the numbers; zero where there is no cell.
    pub fn ends(self) -> [usize; 2] {
        match self {
            CellList::Consecutive(first, count) => [first, first + count.max(1) - 1],
            CellList::Listed(cells) => {
                [cells.iter().min(), cells.iter().max()].map(|cell| cell.copied().unwrap_or(0))
            }
        }
    }
}

impl From<Range<usize>> for CellList<'_> {
    fn from(cells: Range<usize>) -> Self {
        CellList::Consecutive(cells.start, cells.len())
    }
}

impl<'a> From<&'a [usize]> for CellList<'a> {
    fn from(cells: &'a [usize]) -> CellList<'a> {
        CellList::Listed(cells)
    }
}

impl<'a> From<&'a Vec<usize>> for CellList<'a> {
    fn from(cells: &'a Vec<usize>) -> CellList<'a> {
        CellList::Listed(cells)
    }
}
