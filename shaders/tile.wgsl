// A tile's cells: which of the grid's they are, and where the tables hold their numbers.
// Twin: src/sweep/gpu/tile.rs.

// A tile's cells, and where their numbers lie.
struct Tile {
    // Tables: place of the first entry, and from a column and from a row to the next.
    horizontal: vec4<u32>,
    vertical: vec4<u32>,
    drive: vec4<u32>,
    // The same of the clocks; w: 1 where each cell has the number of its clock in `words`, from x on.
    clock: vec4<u32>,
    // Motions: place in `words` of the first one's first sample, motions from a column and from a row
    // to the next, samples of all motions.
    across: vec4<u32>,
    up: vec4<u32>,
    // Place of the vertical motions in `tracks`.
    up_values: u32,
    // 1 where there are shared motions.
    shared_contact: u32,
    // 1 where the base does not move vertically before the block lifts.
    still: u32,
    // The corner that a tilted block turns about.
    mode: u32,
    // Cells of the tile.
    cells: u32,
    // Columns of the grid.
    columns: u32,
    // Column and row of the tile's first cell.
    first_column: u32,
    first_row: u32,
    // How threads take cells: IN_ORDER, IN_BLOCKS or LISTED.
    order: u32,
    // Blocks in a row of the grid; for LISTED the place in `words` of the first cell's column.
    blocks: u32,
    // The tile's first slot, and the slots of all tiles.
    first_slot: u32,
    slots: u32,
    // Number of the chunk that is to run the cells first.
    number: u32,
    padding_0: u32,
    padding_1: u32,
    padding_2: u32,
}

// A tile's cells follow one another in the grid, and threads take them so.
const IN_ORDER = 0u;
// They follow one another, and threads take them in blocks of 8 by 4, so that those of a warp are
// near neighbours.
const IN_BLOCKS = 1u;
// Each cell's column and row stand in a list.
const LISTED = 2u;

const BLOCK_WIDTH = 8u;
const BLOCK_HEIGHT = 4u;
const BLOCK_CELLS = 32u;

@group(0) @binding(8) var<uniform> tile: Tile;
// Numbers of clocks, places of motions, and cells of a list.
@group(0) @binding(11) var<storage, read> words: array<u32>;

// A cell's number in its tile, its column and its row; the number is no less than the tile's cells
// for a thread that has none.
struct Place {
    number: u32,
    column: u32,
    row: u32,
}

fn place_of(thread: u32) -> Place {
    if tile.order == IN_BLOCKS {
        let block = thread / BLOCK_CELLS;
        let within = thread % BLOCK_CELLS;
        let column = block % tile.blocks * BLOCK_WIDTH + within % BLOCK_WIDTH;
        let rows = block / tile.blocks * BLOCK_HEIGHT + within / BLOCK_WIDTH;
        let from_row = rows * tile.columns + column;
        // Beside the grid, or before the tile's first cell.
        if column >= tile.columns || from_row < tile.first_column {
            return Place(tile.cells, 0u, 0u);
        }
        return Place(from_row - tile.first_column, column, tile.first_row + rows);
    }
    if tile.order == LISTED {
        let at = tile.blocks + 2u * min(thread, tile.cells - 1u);
        return Place(thread, words[at], words[at + 1u]);
    }
    let from_row = tile.first_column + thread;
    return Place(thread, from_row % tile.columns, tile.first_row + from_row / tile.columns);
}

// Place of a cell's entry in a table.
fn entry(table: vec4<u32>, place: Place) -> u32 {
    return table.x + place.column * table.y + place.row * table.z;
}
