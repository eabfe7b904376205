//! Where panels, legend and caption of a figure lie.

use crate::map::figure::document::Place;

/// Room left of the panels, for an axis.
const LEFT: i32 = 66;
/// Room below a panel, for an axis.
pub const BELOW: i32 = 44;
/// Room above a panel, for its label.
pub const ABOVE: i32 = 24;
/// Room above all, for the title.
const TOP: i32 = 52;
/// Width of the legend.
const LEGEND: i32 = 216;
/// Space between panels that share an axis.
const GAP: i32 = 14;
/// White margin.
const MARGIN: i32 = 16;
/// Width of panels, gaps and left room together, at most.
const ACROSS: i32 = 1000;
/// Side of a panel at most.
const WIDEST: i32 = 340;
/// Height of a line of the caption.
pub const LINE: i32 = 17;
/// Characters of a caption that fit into a unit of width.
const CHARACTERS: f64 = 0.24;

/// The layout of a figure.
#[derive(Debug, Clone)]
pub struct Layout {
    /// Size of the document.
    pub size: (u32, u32),
    /// The panels' plots.
    pub plots: Vec<Place>,
    /// Where the legend begins.
    pub legend: (i32, i32),
    /// Where the caption begins.
    pub caption: (i32, i32),
    /// The caption, line by line.
    pub lines: Vec<String>,
}

/// Which panels write out their axes.
#[derive(Debug, Clone, Copy)]
pub struct Written {
    /// A panel within the figure writes numbers on its vertical axis.
    pub inner_y: bool,
    /// A panel within the figure writes numbers on its horizontal axis.
    pub inner_x: bool,
}

impl Layout {
    /// Lays out `count` square panels in rows of `columns`, beside a legend of some height.
    pub fn new(
        count: usize,
        columns: usize,
        written: Written,
        legend: i32,
        caption: &[String],
    ) -> Layout {
        let columns = columns.clamp(1, count.max(1)) as i32;
        let rows = (count as i32 + columns - 1) / columns;
        let gap_x = if written.inner_y { LEFT } else { GAP };
        let gap_y = ABOVE + if written.inner_x { BELOW } else { GAP / 2 };
        let side = ((ACROSS - LEFT - gap_x * (columns - 1)) / columns).min(WIDEST);
        let place = |k: i32| Place {
            x: MARGIN + LEFT + k % columns * (side + gap_x),
            y: TOP + ABOVE + k / columns * (side + gap_y),
            width: side,
            height: side,
        };
        let plots: Vec<Place> = (0..count as i32).map(place).collect();
        let right = MARGIN + LEFT + columns * (side + gap_x) - gap_x;
        let bottom = TOP + ABOVE + rows * (side + gap_y) - gap_y + BELOW;
        let width = right + MARGIN + LEGEND;
        let fits = (f64::from(right - MARGIN) * CHARACTERS) as usize;
        let lines: Vec<String> = caption
            .iter()
            .flat_map(|text| textwrap::wrap(text, fits))
            .map(|line| line.into_owned())
            .collect();
        let written = bottom + MARGIN + LINE * lines.len() as i32;
        let height = written.max(TOP + ABOVE + legend) + MARGIN;
        Layout {
            size: (width as u32, height as u32),
            plots,
            legend: (right + MARGIN + 4, TOP + ABOVE),
            caption: (MARGIN, bottom + MARGIN),
            lines,
        }
    }

    /// Room for the axes of a panel: (left, below), where it writes them.
    pub fn room(y: bool, x: bool) -> (Option<i32>, Option<i32>) {
        (y.then_some(LEFT - 10), x.then_some(BELOW))
    }

    /// The title's place.
    pub fn title(&self) -> (i32, i32) {
        (MARGIN, MARGIN)
    }
}
