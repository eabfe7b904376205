//! Outcomes of which some cells have others in their place.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io;
use std::ops::Range;
use std::path::Path;

use super::block::Block;
use super::columns::Column;
use super::outcomes::Outcomes;
use crate::model::precision::Precision;
use crate::stepping::outcome::Outcome;

/// Outcomes with some replaced.
pub struct ReplacedOutcomes {
    all: Box<dyn Outcomes>,
    replaced: BTreeMap<usize, Outcome>,
}

impl ReplacedOutcomes {
    /// Puts outcomes in the place of those of some cells, their numbers as wide as the columns of all.
    pub fn new(
        all: Box<dyn Outcomes>,
        replaced: impl IntoIterator<Item = (usize, Outcome)>,
        precision: Precision,
    ) -> ReplacedOutcomes {
        let (cells, mut outcomes): (Vec<usize>, Vec<Outcome>) = replaced.into_iter().unzip();
        let mut block = Block::pending(cells.len(), precision);
        block.put(0, &outcomes);
        block.read(0, &Column::ALL, &mut outcomes);
        ReplacedOutcomes { all, replaced: cells.into_iter().zip(outcomes).collect() }
    }
}

impl Outcomes for ReplacedOutcomes {
    fn read(&self, cells: Range<usize>, columns: &[Column]) -> io::Result<Cow<'_, [Outcome]>> {
        let mut read = self.all.read(cells.clone(), columns)?;
        for (cell, outcome) in self.replaced.range(cells.clone()) {
            read.to_mut()[cell - cells.start] = *outcome;
        }
        Ok(read)
    }

    fn into_block(self: Box<Self>, cells: usize, precision: Precision) -> io::Result<Block> {
        let mut block = self.all.into_block(cells, precision)?;
        self.replaced.iter().for_each(|(cell, outcome)| block.put(*cell, &[*outcome]));
        Ok(block)
    }

    fn moved(&mut self, from: &Path, to: &Path) {
        self.all.moved(from, to);
    }
}
