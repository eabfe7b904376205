//! The table of parameters as a page: docs/parameters.md.

use std::fmt::Write;

use super::parameters::{PARAMETERS, Section};
use crate::Written;
use crate::model::pulse::Shape;

const HEAD: &str = "# Every number of a scene

Generated from the table in `src/scene/parameters.rs`; `TOPPLE_WRITE_DOCS=1 cargo test --test app parameters::` writes this page
again. SI units everywhere.

A key stands in its table of a scene file (`[block]`, `[base]`, ...); with dashes in place of underscores it is a flag
(`t_h`, `--t-h`), and it names the column and the array of an axis. A number can be written in these ways:

| written | values |
|---|---|
| `2` | one |
| `0.5:4:400` | 400 from 0.5 to 4, both included, equally spaced |
| `0.01:10:50:log` | 50 from 0.01 to 10, each the same factor larger |
| `0.5,1,2` | these values, in this order |

Numbers with several values are the axes of the sweep, at most six. `--x KEY` and `--y KEY` choose the axes of the picture;
otherwise omega, a_h, t_h and t_v come first, then the others in the given order. A value outside of the plausible range is
refused; `--force` (in a file `force = true` under `[run]`) accepts it.
";

const SHAPES: &str = "
`shape` in a file, or the flag `--pulse`, chooses the shape. The largest acceleration is A_h horizontally and A_v vertically,
for every shape.

| shape | acceleration |
|---|---|
";

/// The page.
pub fn page() -> String {
    let mut page = String::from(HEAD);
    for section in Section::ALL {
        // Writing to a text does not fail.
        let _ = write!(
            page,
            "\n## [{}]\n\n| key | symbol | unit | meaning | rule | plausible | default | source |\n\
             |---|---|---|---|---|---|---|---|\n",
            section.key()
        );
        for entry in PARAMETERS.iter().filter(|entry| entry.section == section) {
            let plausible = match entry.plausible_ends() {
                (_, high) if high.is_infinite() => String::new(),
                (low, high) => format!("{low} to {high}"),
            };
            let _ = writeln!(
                page,
                "| `{}` | {} | {} | {} | {} | {plausible} | {} | {} |",
                entry.key,
                entry.symbol.replace('|', "\\|"),
                if entry.unit.is_empty() { "–" } else { entry.unit },
                entry.meaning,
                entry.legal,
                entry.default,
                entry.source
            );
        }
        if section == Section::Pulse {
            page.push_str(SHAPES);
            for shape in Shape::ALL {
                let _ = writeln!(page, "| `{}` | {} |", shape.key(), shape.help());
            }
        }
    }
    page
}
